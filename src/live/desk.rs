//! What is wanted and what was found last: where the threads meet.

use crate::{
    analysis::{AssessOptions, Question},
    deadline::Cancel,
    error::InputError,
};
use serde_json::Value;
use std::{
    collections::BTreeMap,
    sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError},
    time::Duration,
};

/// Values in the place of those of the file, by JSON pointer.
pub type Edits = BTreeMap<String, Value>;

/// What one job is about.
#[derive(Clone)]
pub struct Job {
    /// Counts what was wanted: the greatest one is wanted now.
    pub revision: u64,
    /// Counts what was read of the file.
    pub epoch: u64,
    /// The file, or why it cannot be read.
    pub file: Arc<Result<Vec<u8>, InputError>>,
    /// What is changed in it.
    pub edits: Edits,
    /// What is asked.
    pub question: Question,
}

/// The kinds of news; of each a page needs the last one only.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum News {
    /// The numbers that may vary.
    Scene,
    /// The last answer.
    Answer,
    /// What is being done, or an error.
    Status,
}

impl News {
    /// Its name on the wire.
    pub fn word(self) -> &'static str {
        match self {
            Self::Scene => "scene",
            Self::Answer => "answer",
            Self::Status => "status",
        }
    }
}

/// A piece of news with its number.
pub type Said = (u64, News, Arc<str>);

struct DeskState {
    wanted: Job,
    taken: u64,
    said: Vec<Said>,
    count: u64,
}

/// The desk.
pub struct Desk {
    state: Mutex<DeskState>,
    changed: Condvar,
    cancel: &'static Cancel,
}

impl Desk {
    /// An empty one: nothing is wanted before a file was read.
    pub fn new() -> Self {
        let wanted = Job {
            revision: 0,
            epoch: 0,
            file: Arc::new(Ok(Vec::new())),
            edits: Edits::new(),
            question: Question::Assess(AssessOptions::default()),
        };
        Self {
            state: Mutex::new(DeskState { wanted, taken: 0, said: Vec::new(), count: 0 }),
            changed: Condvar::new(),
            cancel: Cancel::new(),
        }
    }

    /// The flag that a newer wish raises.
    pub fn cancel(&self) -> &'static Cancel {
        self.cancel
    }

    fn state(&self) -> MutexGuard<'_, DeskState> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The file has other contents: what was changed in the page is changed no more.
    pub fn file(&self, file: Result<Vec<u8>, InputError>) {
        self.want(|job| {
            job.epoch += 1;
            job.file = Arc::new(file);
            job.edits.clear();
        });
    }

    /// The page asks something. Changes to a file that has other contents by now are left out.
    pub fn ask(&self, question: Question, epoch: u64, edits: Edits) -> u64 {
        self.want(|job| {
            job.question = question;
            if job.epoch == epoch {
                job.edits = edits;
            }
        })
    }

    fn want(&self, change: impl FnOnce(&mut Job)) -> u64 {
        let mut state = self.state();
        change(&mut state.wanted);
        state.wanted.revision += 1;
        // Under the same lock as where it is lowered: the flag always belongs to an older job.
        self.cancel.raise();
        self.changed.notify_all();
        state.wanted.revision
    }

    /// The next job; waits until there is one.
    pub fn next(&self) -> Job {
        let mut state = self.state();
        while state.wanted.epoch == 0 || state.taken == state.wanted.revision {
            state = self.changed.wait(state).unwrap_or_else(PoisonError::into_inner);
        }
        state.taken = state.wanted.revision;
        self.cancel.lower();
        state.wanted.clone()
    }

    /// What is wanted now.
    pub fn wanted(&self) -> Job {
        self.state().wanted.clone()
    }

    /// Says something about a job, unless another one is wanted by now. Whether it was said.
    pub fn say(&self, revision: u64, news: News, text: String) -> bool {
        let mut state = self.state();
        if state.wanted.revision != revision {
            return false;
        }
        state.count += 1;
        let number = state.count;
        state.said.retain(|s| s.1 != news);
        state.said.push((number, news, text.into()));
        self.changed.notify_all();
        true
    }

    /// What was said after number `seen`, oldest first; waits that long for something.
    pub fn news(&self, seen: u64, patience: Duration) -> Vec<Said> {
        let state = self.state();
        let nothing = |s: &mut DeskState| s.said.iter().all(|s| s.0 <= seen);
        let (state, _) = self
            .changed
            .wait_timeout_while(state, patience, nothing)
            .unwrap_or_else(PoisonError::into_inner);
        state.said.iter().filter(|s| s.0 > seen).cloned().collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::deadline::Deadline;

    fn question() -> Question {
        Question::Assess(AssessOptions::default())
    }

    #[test]
    fn a_newer_wish_ends_the_older_and_silences_it() {
        let desk = Desk::new();
        desk.file(Ok(b"{}".to_vec()));
        let first = desk.next();
        let deadline = Deadline::NEVER.or_when(desk.cancel());
        assert!(!deadline.is_over());
        assert!(desk.say(first.revision, News::Status, "asking".into()));
        let edits = Edits::from([("/a".to_string(), 1.into())]);
        desk.ask(question(), first.epoch, edits.clone());
        assert!(deadline.is_over());
        assert!(!desk.say(first.revision, News::Answer, "late".into()));
        let second = desk.next();
        assert!(!deadline.is_over() && second.edits == edits);
        // Of each kind the last one is kept.
        desk.say(second.revision, News::Answer, "coarse".into());
        desk.say(second.revision, News::Answer, "fine".into());
        let said: Vec<_> =
            desk.news(0, Duration::ZERO).iter().map(|s| (s.1, s.2.to_string())).collect();
        assert_eq!(said, [(News::Status, "asking".into()), (News::Answer, "fine".into())]);
        // A save puts back what was changed, and what the page sends for the older file is none.
        desk.file(Ok(b"{ }".to_vec()));
        desk.ask(question(), first.epoch, edits);
        assert!(desk.wanted().edits.is_empty());
    }
}
