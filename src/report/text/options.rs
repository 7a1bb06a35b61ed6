//! How much is said.

/// How much is said.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct TextOptions {
    /// Lists in full, and every attempt at a program.
    pub verbose: bool,
    /// The first line only.
    pub brief: bool,
}

/// A list shows this many items unless everything is asked for.
pub(crate) const SHOWN: usize = 6;

/// The first items of a list, and how many there are more.
pub(crate) fn cut(items: &[String], most: usize, options: TextOptions) -> Vec<String> {
    // "and 1 more" takes the line that the item itself would.
    let shown = if options.verbose || items.len() <= most + 1 { items.len() } else { most };
    let mut list = items[..shown].to_vec();
    if shown < items.len() {
        list.push(format!("… and {} more (--verbose for all)", items.len() - shown));
    }
    list
}
