//! When work has to end: a moment, and a flag that whoever waits may raise before. Every loop that
//! can take long asks it; what remains is computed here and nowhere else.

use crate::clock::Instant;
use std::{
    sync::{
        OnceLock,
        atomic::{AtomicBool, Ordering},
    },
    time::Duration,
};

/// Seconds since this was first asked: for how long something took.
pub fn clock() -> f64 {
    static START: OnceLock<Instant> = OnceLock::new();
    START.get_or_init(Instant::now).elapsed().as_secs_f64()
}

/// A flag by which a caller ends work on another thread. It lasts as long as the program: one for
/// each thing that can be cancelled, to be lowered and used again, not one for each question.
#[derive(Debug, Default)]
pub struct Cancel(AtomicBool);

impl Cancel {
    /// A flag that is not raised.
    pub fn new() -> &'static Self {
        Box::leak(Box::default())
    }

    /// Ends what hears it.
    pub fn raise(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    /// Lets work go on that begins from now on.
    pub fn lower(&self) {
        self.0.store(false, Ordering::Relaxed);
    }
}

/// When work has to end.
#[derive(Clone, Copy, Debug, Default)]
pub struct Deadline {
    end: Option<Instant>,
    cancel: Option<&'static Cancel>,
}

impl Deadline {
    /// No end.
    pub const NEVER: Self = Self { end: None, cancel: None };

    /// So many seconds from now; what no clock can show is no end. Less than nothing, and what is
    /// no number, is over at once.
    pub fn within(seconds: f64) -> Self {
        let now = Instant::now();
        let end = if seconds > 0.0 {
            Duration::try_from_secs_f64(seconds).ok().and_then(|d| now.checked_add(d))
        } else {
            Some(now)
        };
        Self { end, cancel: None }
    }

    /// The same, and as soon as the flag is raised.
    #[must_use]
    pub fn or_when(self, cancel: &'static Cancel) -> Self {
        Self { cancel: Some(cancel), ..self }
    }

    /// This share of what is left.
    #[must_use]
    pub fn share(self, of: f64) -> Self {
        self.at_most(of * self.left())
    }

    /// The same, but no more than so many seconds from now.
    #[must_use]
    pub fn at_most(self, seconds: f64) -> Self {
        if self.left() <= seconds { self } else { Self { end: Self::within(seconds).end, ..self } }
    }

    /// Seconds left: 0 where it is over, infinite where there is no end.
    pub fn left(&self) -> f64 {
        if self.cancel.is_some_and(|c| c.0.load(Ordering::Relaxed)) {
            return 0.0;
        }
        self.end.map_or(f64::INFINITY, |end| {
            end.saturating_duration_since(Instant::now()).as_secs_f64()
        })
    }

    /// Whether there is nothing left.
    pub fn is_over(&self) -> bool {
        self.left() <= 0.0
    }

    /// Whether it is over at some moment, whoever cancels it or not.
    pub fn is_timed(&self) -> bool {
        self.end.is_some()
    }

    /// Whether it can be over at all.
    pub fn is_set(&self) -> bool {
        self.end.is_some() || self.cancel.is_some()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_left_never_grows() {
        assert!(
            Deadline::NEVER.left().is_infinite()
                && !Deadline::NEVER.is_over()
                && !Deadline::NEVER.is_set()
        );
        for over in [0.0, -1.0, f64::NAN, f64::NEG_INFINITY] {
            assert!(Deadline::within(over).is_over(), "{over}");
        }
        assert!(!Deadline::within(1e300).is_over() && !Deadline::within(f64::INFINITY).is_set());
        let hour = Deadline::within(3600.0);
        assert!(hour.left() <= 3600.0 && hour.left() > 3500.0);
        assert!(
            hour.share(0.5).left() <= 1800.0
                && hour.at_most(1e9).left() <= 3600.0
                && hour.at_most(1.0).left() <= 1.0
        );
        assert!(
            Deadline::NEVER.share(0.5).left().is_infinite()
                && Deadline::NEVER.at_most(1.0).left() <= 1.0
        );
    }

    #[test]
    fn a_raised_flag_ends_it() {
        let flag = Cancel::new();
        let deadline = Deadline::within(3600.0).or_when(flag);
        assert!(!deadline.is_over() && deadline.at_most(1800.0).is_set());
        let alone = Deadline::NEVER.or_when(flag);
        assert!(alone.is_set() && !alone.is_timed() && alone.at_most(1.0).is_timed());
        flag.raise();
        assert!(
            deadline.is_over()
                && deadline.share(1.0).is_over()
                && Deadline::NEVER.or_when(flag).is_over()
        );
        flag.lower();
        assert!(!deadline.is_over());
    }
}
