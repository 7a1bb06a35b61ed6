//! A machine through a motion of the ground, from event to event.

use super::{
    Machine, Sense,
    step::{Phase, Under},
};
use crate::ground::{Jump, Motion, Piece, Shape, When};
use nalgebra::Vector3;

/// How a machine is run.
#[derive(Clone, Debug, PartialEq)]
pub struct RunSettings {
    /// Where it begins, as a part of the unstable equilibrium of the sense of its sign.
    pub from: f64,
    /// When it ends at the latest, s; by default when it is at rest or has overturned after the
    /// ground has come to rest, and at the latest 100 of its own times 1/p later.
    pub until: Option<f64>,
    /// It counts as overturned from this multiple of its unstable equilibrium on; by default where
    /// no acceleration still to come could bring it back.
    pub overturned_at: Option<f64>,
    /// End as soon as it is known whether it overturns: when the ground is at rest and the joints
    /// have closed out of either sense, for from then on it only loses energy.
    pub fate_only: bool,
    /// Keep where it is after every step.
    pub keep: bool,
    /// Errors of a step, over the unstable equilibrium.
    pub tolerance: f64,
}

impl Default for RunSettings {
    fn default() -> Self {
        Self {
            from: 0.0,
            until: None,
            overturned_at: None,
            fate_only: false,
            keep: false,
            tolerance: TOLERANCE,
        }
    }
}

/// Error of a step, over the unstable equilibrium, as the lower order of the pair has it; the higher
/// one goes on, and is a hundred times better. Larger: overturning amplitudes have fewer than seven
/// digits. Smaller: records sampled at 200 Hz take two steps a sample.
const TOLERANCE: f64 = 1e-11;
/// After an impact slower than this × (unstable equilibrium × p) it is at rest. Larger: decays end
/// early. Smaller: hundreds of hops that nobody sees.
const REST: f64 = 1e-9;
/// More impacts than this are no history.
const MOST_IMPACTS: usize = 1_000_000;
/// After the ground has come to rest it is watched for this many 1/p.
const AFTER: f64 = 100.0;
/// A step is at most this long within a sine, over 1/ω.
const OF_A_SINE: f64 = 0.25;

/// Where it is at one time.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sample {
    /// s.
    pub time: f64,
    /// The coordinate; < 0 in the second sense.
    pub q: f64,
    /// Its rate, 1/s.
    pub rate: f64,
}

/// An impact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Impact {
    /// s.
    pub time: f64,
    /// The rate before it; its sign is that of the motion.
    pub before: f64,
    /// What was left of it.
    pub factor: f64,
    /// The greatest coordinate since the last impact.
    pub peak: f64,
}

/// What became of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fate {
    /// It came to rest where it was.
    Rests,
    /// It still rocked when the time was over.
    Rocks,
    /// It overturned.
    Overturns {
        /// When no acceleration to come could bring it back any more, s.
        time: f64,
    },
}

/// A history.
#[derive(Clone, Debug, PartialEq)]
pub struct History {
    /// What became of it.
    pub fate: Fate,
    /// When it first moved, s.
    pub released: Option<f64>,
    /// Its impacts.
    pub impacts: Vec<Impact>,
    /// The farthest coordinate, with its sign and time.
    pub greatest: Sample,
    /// Where it is at the end.
    pub last: Sample,
    /// Where it was after every step, if that was asked for.
    pub samples: Vec<Sample>,
    /// Steps taken.
    pub steps: usize,
    /// It was seen that it cannot overturn any more, although it still rocks.
    pub returns: bool,
}

impl History {
    /// Whether it overturned.
    pub fn overturned(&self) -> bool {
        matches!(self.fate, Fate::Overturns { .. })
    }
}

/// In a sense (0 or 1), or at rest.
#[derive(Clone, Copy, PartialEq)]
enum Now {
    Rest,
    In(usize, Phase),
}

struct Run<'a> {
    machine: &'a Machine,
    settings: &'a RunSettings,
    now: Now,
    time: f64,
    step: f64,
    peak: f64,
    waiting: Option<Jump>,
    /// Senses that have ended since the ground is at rest.
    back: [bool; 2],
    history: History,
}

/// Runs a machine through a motion of the ground.
pub fn run(machine: &Machine, motion: &Motion, settings: &RunSettings) -> History {
    let senses = || machine.senses.iter().flatten();
    let own = senses().filter_map(Sense::frequency).fold(f64::INFINITY, f64::min);
    let own = if own.is_finite() { 1.0 / own } else { 1.0 };
    let waiting = motion.jumps.iter().copied().find(|j| j.when == When::FirstLanding);
    let sense = usize::from(settings.from < 0.0);
    let now = match &machine.senses[sense] {
        Some(s) if settings.from != 0.0 => Now::In(sense, [settings.from.abs() * s.scale(), 0.0]),
        _ => Now::Rest,
    };
    let history = History {
        fate: Fate::Rests,
        released: None,
        impacts: Vec::new(),
        greatest: Sample::default(),
        last: Sample::default(),
        samples: Vec::new(),
        steps: 0,
        returns: false,
    };
    let mut run = Run {
        machine,
        settings,
        now,
        time: 0.0,
        step: 0.01 * own,
        peak: 0.0,
        waiting,
        back: [false; 2],
        history,
    };
    run.note();
    let (pieces, jumps) = (stretches(motion, settings.until, AFTER * own), jumps(motion));
    let mut ahead = vec![0.0; pieces.len() + 1];
    for k in (0..pieces.len()).rev() {
        ahead[k] = pieces[k].peak().max(ahead[k + 1]);
    }
    let mut next_jump = 0;
    for (k, piece) in pieces.iter().enumerate() {
        // A jump to come counts as more than any acceleration.
        while let Some((_, jump)) = jumps.get(next_jump).filter(|(t, _)| *t <= piece.start) {
            run.time = piece.start;
            run.jump(jump);
            next_jump += 1;
        }
        let peak = if next_jump < jumps.len() { f64::INFINITY } else { ahead[k] };
        let over = k + 1 == pieces.len();
        if run.piece(piece, peak, over).is_break() {
            break;
        }
    }
    run.history.last = run.sample();
    if !run.history.overturned() && run.now != Now::Rest {
        run.history.fate = Fate::Rocks;
    }
    run.history
}

/// Jumps with a time of their own.
fn jumps(motion: &Motion) -> Vec<(f64, Jump)> {
    let mut list: Vec<(f64, Jump)> = motion
        .jumps
        .iter()
        .filter_map(|j| match j.when {
            When::At(t) => Some((t, *j)),
            When::FirstLanding => None,
        })
        .collect();
    list.sort_by(|a, b| a.0.total_cmp(&b.0));
    list
}

/// Pieces without gaps from 0 to the end, cut where the velocity jumps.
fn stretches(motion: &Motion, until: Option<f64>, after: f64) -> Vec<Piece> {
    let end = motion.end();
    let last = until.unwrap_or(end + after);
    let still = |start: f64, end: f64| Piece {
        start,
        end,
        shape: Shape::Line { from: Vector3::zeros(), slope: Vector3::zeros() },
    };
    let mut list: Vec<Piece> = Vec::with_capacity(motion.pieces.len() + 2);
    let mut time = 0.0;
    for piece in &motion.pieces {
        if piece.start > time {
            list.push(still(time, piece.start));
        }
        list.push(*piece);
        time = piece.end;
    }
    if last > time {
        list.push(still(time, last));
    }
    for (t, _) in jumps(motion) {
        let Some(k) = list.iter().position(|p| p.start < t && t < p.end) else { continue };
        let (begin, end) = (list[k].start, list[k].end);
        let shape = match list[k].shape {
            Shape::Line { from, slope } => Shape::Line { from: from + slope * (t - begin), slope },
            Shape::Sine { amplitude, omega, phase } => {
                Shape::Sine { amplitude, omega, phase: phase + omega * (t - begin) }
            }
        };
        list[k].end = t;
        list.insert(k + 1, Piece { start: t, end, shape });
    }
    list.retain(|p| p.start < last);
    if let Some(p) = list.last_mut() {
        p.end = p.end.min(last);
    }
    list
}

impl Run<'_> {
    fn sense(&self, k: usize) -> Option<&Sense> {
        self.machine.senses[k].as_ref()
    }

    fn sample(&self) -> Sample {
        let (q, rate) = match self.now {
            Now::Rest => (0.0, 0.0),
            Now::In(k, [q, u]) => {
                if k == 0 {
                    (q, u)
                } else {
                    (-q, -u)
                }
            }
        };
        Sample { time: self.time, q, rate }
    }

    fn note(&mut self) {
        let here = self.sample();
        self.farthest(here);
        if self.settings.keep {
            self.history.samples.push(here);
        }
    }

    fn farthest(&mut self, s: Sample) {
        if s.q.abs() > self.history.greatest.q.abs() {
            self.history.greatest = s;
        }
        self.peak = self.peak.max(s.q.abs());
    }

    /// The velocity of the ground jumps.
    fn jump(&mut self, jump: &Jump) {
        let push = |k: usize, q: f64| {
            let v = self.sense(k)?.law.at(q);
            Some(-jump.by.dot(&v.grip) / v.inertia)
        };
        let (k, q, u) = match self.now {
            Now::In(k, [q, u]) => (k, q, u),
            Now::Rest => (0, 0.0, 0.0),
        };
        let same = push(k, q).map(|p| p + u);
        // With the joints closed momentum goes on in the sense in which it finds a way.
        let other = push(1 - k, 0.0).map(|p| p - self.machine.restitution[k] * u);
        self.now = match (same, other) {
            (Some(u), _) if q > 0.0 || u > 0.0 => Now::In(k, [q, u]),
            (_, Some(u)) if u > 0.0 => Now::In(1 - k, [0.0, u]),
            _ => Now::Rest,
        };
        if self.now != Now::Rest {
            self.history.released.get_or_insert(self.time);
        }
        self.note();
    }

    /// One piece; ends where nothing can happen any more. `peak`: the greatest acceleration from
    /// here on. `still`: the last one.
    fn piece(&mut self, piece: &Piece, peak: f64, still: bool) -> std::ops::ControlFlow<()> {
        use std::ops::ControlFlow::{Break, Continue};
        self.time = self.time.max(piece.start);
        while self.time < piece.end {
            match self.now {
                Now::Rest => {
                    let Some((t, k)) = self.release(piece) else {
                        if still && peak == 0.0 {
                            return Break(());
                        }
                        self.time = piece.end;
                        self.note();
                        return Continue(());
                    };
                    self.time = t;
                    self.history.released.get_or_insert(t);
                    self.now = Now::In(k, [0.0, 0.0]);
                }
                Now::In(k, state) => self.advance(piece, k, state),
            }
            if self.is_over(peak) || self.history.impacts.len() > MOST_IMPACTS {
                return Break(());
            }
            if still && peak == 0.0 && self.cannot_overturn() {
                self.history.returns = true;
                if self.settings.fate_only {
                    return Break(());
                }
            }
        }
        Continue(())
    }

    /// When the ground sets it moving in this piece, and in which sense.
    fn release(&self, piece: &Piece) -> Option<(f64, usize)> {
        let after = self.time - piece.start;
        let of = |k: usize| {
            let v = self.sense(k)?.at_start;
            let t = piece.exceeds(after, -v.resistance, &-v.grip)?;
            Some((piece.start + t, k))
        };
        [of(0), of(1)].into_iter().flatten().min_by(|a, b| a.0.total_cmp(&b.0))
    }

    fn advance(&mut self, piece: &Piece, k: usize, y: Phase) {
        let Some(sense) = self.machine.senses[k].as_ref() else { return };
        let under = Under { law: &sense.law, piece };
        let t = self.time - piece.start;
        let left = piece.end - self.time;
        let most = match piece.shape {
            Shape::Sine { omega, .. } => OF_A_SINE / omega,
            Shape::Line { .. } => f64::INFINITY,
        };
        let scale = [sense.scale(), sense.scale() * sense.frequency().unwrap_or(1.0)];
        let (next, h) = loop {
            let h = self.step.min(left).min(most);
            let (next, error) = under.step(t, y, h);
            self.history.steps += 1;
            let size = (0..2).map(|i| (error[i] / scale[i]).abs()).fold(0.0, f64::max);
            let ratio = size / self.settings.tolerance;
            let grow = if ratio > 0.0 { (0.9 * ratio.powf(-0.2)).clamp(0.2, 4.0) } else { 4.0 };
            if ratio <= 1.0 || h < 1e-12 * self.time.max(piece.end - piece.start) {
                // A step that was cut short says nothing against a longer one.
                self.step = self.step.max(h * grow).min(if h < self.step {
                    f64::INFINITY
                } else {
                    h * grow
                });
                break (next, h);
            }
            if !size.is_finite() {
                self.step = 0.2 * h;
                continue;
            }
            self.step = h * grow;
        };
        let sign = if k == 0 { 1.0 } else { -1.0 };
        let whole = h >= left;
        // The lowest point of a step that turns outwards within it.
        let mut end = (h, next);
        if y[1] < 0.0 && next[1] > 0.0 && next[0] > 0.0 {
            let low = under.crossing(t, y, h, |h, s| [-s[1], -under.rates(t + h, s)[1]]);
            let state = under.step(t, y, low).0;
            if state[0] <= 0.0 {
                end = (low, state);
            }
        }
        if end.1[0] <= 0.0 {
            let at = if y[0] > 0.0 {
                under.crossing(t, y, end.0, |_, s| s)
            } else if y[1] > 0.0 {
                under.crossing(t, y, end.0, |h, s| [s[0] / h, (s[1] - s[0] / h) / h])
            } else {
                // It has not moved off.
                self.time = if whole { piece.end } else { self.time + end.0 };
                self.now = Now::Rest;
                return self.note();
            };
            self.turning(&under, t, y, at, sign);
            let state = under.step(t, y, at).0;
            self.time = if whole && at >= h { piece.end } else { self.time + at };
            return self.impact(k, state[1].min(0.0), &piece.at(t + at));
        }
        self.turning(&under, t, y, h, sign);
        self.time = if whole { piece.end } else { self.time + h };
        self.now = Now::In(k, next);
        self.note();
    }

    /// Looks at the farthest point where a step turns back.
    fn turning(&mut self, under: &Under, t: f64, y: Phase, h: f64, sign: f64) {
        if y[1] > 0.0 && y[0] + y[1] * h > self.peak {
            let next = under.step(t, y, h).0;
            if next[1] < 0.0 {
                let at = under.crossing(t, y, h, |h, s| [s[1], under.rates(t + h, s)[1]]);
                let q = under.step(t, y, at).0[0];
                let time = self.time + at;
                self.farthest(Sample { time, q: sign * q, rate: 0.0 });
            }
        }
    }

    /// The joints close at this rate (< 0 in the sense that ends).
    fn impact(&mut self, k: usize, rate: f64, ground: &Vector3<f64>) {
        let factor = self.machine.restitution[k];
        let other = if self.sense(1 - k).is_some() { 1 - k } else { k };
        let sign = if k == 0 { 1.0 } else { -1.0 };
        let (time, peak) = (self.time, std::mem::replace(&mut self.peak, 0.0));
        self.history.impacts.push(Impact { time, before: sign * rate, factor, peak });
        let speed = (-rate * factor).max(0.0);
        let slow = self
            .sense(other)
            .is_none_or(|s| speed <= REST * s.scale() * s.frequency().unwrap_or(0.0));
        self.now = if slow { Now::Rest } else { Now::In(other, [0.0, speed]) };
        if slow {
            // What drives it already sets it off again at once.
            let drive = |k: usize| Some((k, self.sense(k)?.drive(ground)));
            let best =
                [drive(0), drive(1)].into_iter().flatten().max_by(|a, b| a.1.total_cmp(&b.1));
            if let Some((k, _)) = best.filter(|b| b.1 > 0.0) {
                self.now = Now::In(k, [0.0, speed.max(0.0)]);
            }
        }
        self.note();
        if *ground == Vector3::zeros() {
            self.back[k] = true;
        } else {
            self.back = [false; 2];
        }
        if let Some(jump) = self.waiting.take() {
            self.jump(&jump);
            self.back = [false; 2];
        }
    }

    /// Whether it has come back from wherever it can go, with nothing left to drive it.
    fn cannot_overturn(&self) -> bool {
        self.waiting.is_none()
            && [0, 1].into_iter().all(|k| self.sense(k).is_none() || self.back[k])
            && self.machine.restitution.iter().all(|&e| e <= 1.0)
    }

    /// Whether it has overturned.
    fn is_over(&mut self, peak: f64) -> bool {
        let Now::In(k, [q, u]) = self.now else { return false };
        let Some(sense) = self.sense(k) else { return false };
        let beyond = match self.settings.overturned_at {
            Some(at) => q >= at * sense.scale(),
            None => {
                let waits = self.waiting.is_some();
                q >= sense.end || (u >= 0.0 && !waits && sense.is_beyond_return(q, peak))
            }
        };
        if beyond {
            self.history.fate = Fate::Overturns { time: self.time };
        }
        beyond
    }
}
