//! A film of a simulation: a limited number of frames, evenly spread over the time that it took,
//! whatever that turns out to be.

use dynamics::{Fidelity, Frame};

/// Frames in a page at most. More: nothing is seen between them.
const FRAMES: usize = 120;
/// Poses of blocks in a page at most, of 12 bytes each.
const POSES: usize = 150_000;

/// Frames of the run that is under way.
#[derive(Clone, Debug)]
pub struct Film {
    most: usize,
    /// Every so many moments is kept.
    stride: usize,
    seen: usize,
    frames: Vec<Frame>,
}

impl Film {
    /// So many frames at most; at least 2.
    pub fn new(most: usize) -> Self {
        Self { most: most.max(2), stride: 1, seen: 0, frames: Vec::new() }
    }

    /// A film of a scene of so many blocks for a page: at most 1.8 MB, and at least its end.
    pub fn fitting(blocks: usize) -> Self {
        Self::new((POSES / blocks.max(1)).min(FRAMES))
    }

    /// Looks at the next moment. Where there are too many frames, every other one is dropped; where
    /// a new run begins, all are.
    pub fn see(&mut self, frame: &Frame) {
        if self.run().is_some_and(|r| r != frame.fidelity) {
            *self = Self::new(self.most);
        }
        if self.seen.is_multiple_of(self.stride) {
            if self.frames.len() == self.most {
                let mut k = 0;
                self.frames.retain(|_| {
                    k += 1;
                    k % 2 == 1
                });
                self.stride *= 2;
            }
            if self.seen.is_multiple_of(self.stride) {
                self.frames.push(frame.clone());
            }
        }
        self.seen += 1;
    }

    fn run(&self) -> Option<Fidelity> {
        self.frames.first().map(|f| f.fidelity)
    }

    /// The frames of the last run.
    pub fn frames(self) -> Vec<Frame> {
        self.frames
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frame(time: usize, fidelity: Fidelity) -> Frame {
        Frame { time: time as f64, fidelity, relative: 0.0, energy: 0.0, blocks: Vec::new() }
    }

    #[test]
    fn frames_are_evenly_spread_however_long_it_takes() {
        for count in [1, 7, 8, 9, 100, 1001] {
            let mut film = Film::new(8);
            film.see(&frame(3, Fidelity::Fast));
            (0..count).for_each(|t| film.see(&frame(t, Fidelity::Fine)));
            let times: Vec<f64> = film.frames().iter().map(|f| f.time).collect();
            assert!(
                times[0] == 0.0 && times.len() <= 8 && times.len() >= count.min(4),
                "{count}: {times:?}"
            );
            let apart: Vec<f64> = times.windows(2).map(|w| w[1] - w[0]).collect();
            let left = count as f64 - 1.0 - times[times.len() - 1];
            assert!(
                apart.iter().all(|d| *d == apart[0]) && left < apart.last().copied().unwrap_or(1.0),
                "{times:?}"
            );
        }
    }
}
