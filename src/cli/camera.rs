//! Who watches what happens in time.

use super::{progress::Bar, question::Session, report};
use std::ops::ControlFlow;
use voussoir::{
    analysis::{Answer, Question, Watch},
    dynamics::{Frame, Progress},
    report::view::Film,
};

/// Who watches a simulation: under a bar, until the time limit, with a film where there is to be
/// one.
pub struct Camera {
    threads: usize,
    frames: usize,
    keep_frames: bool,
    film: Option<Film>,
}

impl Camera {
    pub fn new(session: &Session, threads: u16, is_filmed: bool) -> Self {
        let threads = super::terminal::threads(threads);
        let film = is_filmed.then(|| Film::fitting(session.model.assembly.blocks.len()));
        Self { threads, frames: 0, keep_frames: true, film }
    }

    /// Takes so many frames, which the answer keeps where that is wanted.
    pub fn taking(self, frames: usize, keep_frames: bool) -> Self {
        Self { frames, keep_frames, ..self }
    }

    /// Asks a question of the scene in time; `keep` hears of every frame.
    pub fn ask(
        &mut self,
        session: &Session,
        question: &Question,
        keep: &mut dyn FnMut(&Frame) -> ControlFlow<()>,
    ) -> anyhow::Result<Answer> {
        let bar = Bar::new(session.shows_progress());
        let deadline = session.control().deadline;
        let Self { threads, frames, keep_frames, film } = self;
        let every_step = film.is_some();
        let mut each = |progress: &Progress| {
            bar.show(progress);
            report::see(film, progress.moment);
            if deadline.is_over() {
                return ControlFlow::Break(());
            }
            progress.frame.map_or(ControlFlow::Continue(()), &mut *keep)
        };
        let watch = Watch {
            threads: *threads,
            frames: *frames,
            keep_frames: *keep_frames,
            every_step,
            each: &mut each,
        };
        session.ask_watched(question, watch)
    }

    /// What was filmed.
    pub fn frames(&mut self) -> Vec<Frame> {
        self.film.take().map(Film::frames).unwrap_or_default()
    }
}
