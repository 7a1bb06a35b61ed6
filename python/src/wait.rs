//! Work on another thread while this one listens for signals: the interpreter is free meanwhile,
//! and Ctrl-C is heard at once.

use crate::error::Trouble;
use pyo3::prelude::*;
use std::{
    panic::{AssertUnwindSafe, catch_unwind},
    sync::{
        Arc, Mutex, PoisonError,
        mpsc::{RecvTimeoutError, channel},
    },
    thread,
    time::Duration,
};
use voussoir::{
    deadline::{Cancel, Deadline},
    error::{InputError, JsonPath},
};

/// How often signals are looked for. More: Ctrl-C is late. Less: the interpreter is held for
/// nothing.
const STEP: Duration = Duration::from_millis(20);
/// Stack of a worker, bytes, as the library's own threads have it.
const STACK: usize = 16 << 20;

/// Flags that nobody uses: they last as long as the process, so they are used again.
static IDLE: Mutex<Vec<&'static Cancel>> = Mutex::new(Vec::new());

/// What a worker knows of the one who waits.
pub struct Watch {
    cancel: &'static Cancel,
    latest: Mutex<Option<(f64, f64, String)>>,
}

impl Watch {
    fn new() -> Self {
        let idle = IDLE.lock().unwrap_or_else(PoisonError::into_inner).pop();
        Self { cancel: idle.unwrap_or_else(Cancel::new), latest: Mutex::new(None) }
    }

    /// When work has to end: after so many seconds, or when nobody waits any longer.
    pub fn deadline(&self, seconds: Option<f64>) -> Deadline {
        seconds.map_or(Deadline::NEVER, Deadline::within).or_when(self.cancel)
    }

    /// Whether nobody waits any longer.
    pub fn is_cancelled(&self) -> bool {
        Deadline::NEVER.or_when(self.cancel).is_over()
    }

    /// Says how far the work is: so much of so much, and what it does.
    pub fn tell(&self, done: f64, total: f64, words: impl FnOnce() -> String) {
        if let Ok(mut latest) = self.latest.try_lock() {
            *latest = Some((done, total, words()));
        }
    }

    fn heard(&self) -> Option<(f64, f64, String)> {
        self.latest.lock().unwrap_or_else(PoisonError::into_inner).take()
    }
}

impl Drop for Watch {
    /// With the last of both who held it: no work hears the flag any more.
    fn drop(&mut self) {
        self.cancel.lower();
        IDLE.lock().unwrap_or_else(PoisonError::into_inner).push(self.cancel);
    }
}

/// A number of threads: 0 for one a processor. More than four a processor are not started.
pub fn threads(py: Python, asked: i64) -> PyResult<usize> {
    usize::try_from(asked).map_err(|_| {
        let path = JsonPath::root().key("threads");
        let error = InputError::at(path, format!("must be ≥ 0, got {asked}"));
        Trouble::from(error.hint("0: one a processor")).raise(py)
    })
}

/// Does `work` while the interpreter is free. `progress` is called with what the work says, some
/// fifty times a second at most. A signal's exception, or one of `progress`, ends the wait at once,
/// and the work as soon as it hears of it.
pub fn run<T: Send + 'static>(
    py: Python,
    progress: Option<&Bound<PyAny>>,
    work: impl FnOnce(&Watch) -> Result<T, Trouble> + Send + 'static,
) -> PyResult<T> {
    let watch = Arc::new(Watch::new());
    let (outbox, inbox) = channel();
    let theirs = watch.clone();
    let serve = move || {
        let done = catch_unwind(AssertUnwindSafe(|| work(&theirs)));
        // Nobody may be there any more.
        let _ = outbox.send(done.unwrap_or_else(|_| {
            Err(Trouble::Other("the program failed on this scene (please report it)".into()))
        }));
    };
    let worker = thread::Builder::new().name("voussoir".into()).stack_size(STACK).spawn(serve);
    worker.map_err(|e| Trouble::Other(format!("cannot start a thread: {e}")).raise(py))?;
    // A receiver is for one thread at a time, which this one is.
    let inbox = Mutex::new(inbox);
    let wait = || inbox.lock().unwrap_or_else(PoisonError::into_inner).recv_timeout(STEP);
    let done = loop {
        match py.detach(wait) {
            Ok(done) => break done,
            Err(RecvTimeoutError::Disconnected) => {
                break Err(Trouble::Other("the program failed".into()));
            }
            Err(RecvTimeoutError::Timeout) => {
                if let Err(e) = py.check_signals().and_then(|()| call(progress, &watch)) {
                    watch.cancel.raise();
                    return Err(e);
                }
            }
        }
    };
    call(progress, &watch)?;
    done.map_err(|e| e.raise(py))
}

fn call(progress: Option<&Bound<PyAny>>, watch: &Watch) -> PyResult<()> {
    let Some((progress, heard)) = progress.zip(watch.heard()) else { return Ok(()) };
    progress.call1(heard).map(drop)
}
