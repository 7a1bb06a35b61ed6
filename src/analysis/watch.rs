//! Who watches a long question: what it is doing, and what it already has.

/// What somebody who watches hears, from any thread.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Watched {
    /// What is known already, and stays true: the bound, say.
    Known(String),
    /// What is being done, and how far that is.
    Doing(String),
}

/// Hears of the work; nobody where absent.
pub type Watcher = Option<fn(Watched)>;

/// Where work on a list is, whatever the threads it is on.
pub(crate) struct Counted<'a> {
    watcher: Watcher,
    what: &'a str,
    of: usize,
    begun: std::sync::atomic::AtomicUsize,
}

impl<'a> Counted<'a> {
    /// Of so many; nothing is said of a single one.
    pub fn new(watcher: Watcher, what: &'a str, of: usize) -> Self {
        Self { watcher, what, of, begun: 0.into() }
    }

    /// The next one begins.
    pub fn next(&self) {
        let begun = 1 + self.begun.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
        if let Some(hear) = self.watcher.filter(|_| self.of > 1) {
            hear(Watched::Doing(format!("{} {begun} of {}", self.what, self.of)));
        }
    }
}
