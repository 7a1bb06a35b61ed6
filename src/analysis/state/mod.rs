//! The state of elastic joints: under the dead load, and along the live load.
//!
//! The dead load is one step from the state in which nothing has moved. Along the live load the
//! load factor grows in steps that end where a joint opens, parts, slips, slides or sticks again
//! (found by halving), so that friction is followed and not guessed; towards the bound of limit
//! analysis steps halve what is left. Where no displacements balance the loads any more, the path
//! has ended.

mod equations;
mod heap;
mod incomplete;
mod newton;

use check::question::StateOptions;

use super::{
    Assessment, Control, Law, LoadFactor, Outcome, Proved, assess, kinematic::control_of, limit,
    proved::Claims,
};
use base::error::{InputError, JsonPath};
use check::{
    elastic::{ElasticState, Joints, Quadrature, Step, System, Track, events},
    terms::Bound,
    verdict::{Evidence, Forces, Rate, Verdict, claim, claim::Claim, no_forces},
};
use model::{assembly::Wrench, interface::Model};
use nalgebra::Vector3;
use newton::Newton;

/// The answer of `state`.
#[derive(Clone, Debug)]
pub struct Stated {
    /// Where its joints yield.
    pub quadrature: Quadrature,
    /// The joints.
    pub joints: Joints,
    /// The states that were found; nothing where the dead load is not balanced.
    pub track: Option<Track>,
    /// The forces under the dead load, as proof that it stands.
    pub rest: Proved<Rest>,
    /// Where no state was found: the verdict on the scene.
    pub verdict: Option<Proved<Assessment>>,
    /// Along a live load: the bound by limit analysis.
    pub bound: Option<Proved<LoadFactor>>,
    /// The point that is watched.
    pub control: Option<(usize, Vector3<f64>)>,
    /// How the path ended.
    pub end: PathEnd,
    /// Steps of Newton's method.
    pub steps: usize,
}

pub use check::elastic::{PathEnd, PathFactor};

/// Forces that balance the dead load.
#[derive(Clone, Debug)]
pub struct Rest {
    forces: Forces,
    found: bool,
}

impl Claims for Rest {
    fn claim(&self) -> Option<Claim> {
        self.found.then_some(Claim::Stable)
    }

    fn evidence(&self) -> Evidence<'_> {
        Evidence::new(&self.forces, &[])
    }

    fn withdraw(&mut self) {
        self.found = false;
    }
}

/// Load factors are followed up to this share of the bound where nothing slides, and the bound is the
/// load factor of the path. More: contacts shrink to nothing, which rounding cannot follow. Less: what
/// slides last goes unseen.
const UP_TO: f64 = 1.0 - 1e-3;
/// Where anything slides, and displacements do not grow without end, they are followed on, up to this
/// share. More: as above. Less: the load factor of a path that ends at its bound has fewer digits.
const UP_TO_SLIDING: f64 = 1.0 - 5e-7;
/// Displacements that grow with less than this power of the distance from the bound do not grow
/// without end: of what tips it is 2, of what slides 0. More: minutes, and rounding, on what tips.
/// Less: what slides is not followed.
const GROWS: f64 = 0.5;
/// Steps along the live load at least, in shares of the bound.
const STEP: f64 = 0.05;
/// Steps shorter than this share of the load factor end the path; of one that is small beside the
/// bound, of that share of the bound. More: the load factor has fewer digits. Less: minutes at its
/// end.
const LEAST: f64 = 1e-7;
const SMALL: f64 = 1e-2;
/// Events are found to this share of the bound.
const EVENT: f64 = 1e-7;
/// Multiples of the last step at which a search may begin.
const AHEAD: [f64; 5] = [0.5, 1.0, 2.0, 3.0, 4.0];
/// Most steps of a path.
const MOST: usize = 2000;
/// Newton's steps on a path at most, a joint. Fewer: paths along which much happens are given up.
/// More: time lost where a joint all but parts, and what presses shrinks from state to state.
const STEPS_A_JOINT: usize = 500;
/// Without a bound, the path is followed up to this many times the load factor at which live and
/// dead load weigh the same.
const WITHOUT_END: f64 = 10.0;

/// Answers `state`: as asked, or with elastic joints at their corners where over their area nothing
/// is found, or the search is given up.
pub(super) fn state(
    options: &StateOptions,
    model: &Model,
    control: &Control,
) -> Result<Stated, InputError> {
    let own = stated(options, options.quadrature, model, control)?;
    let is_whole = |s: &Stated| s.track.is_some() && s.end != PathEnd::Open;
    let falls = own.standing() == Verdict::Unstable;
    if options.quadrature == Quadrature::Corners || falls || is_whole(&own) {
        return Ok(own);
    }
    let other = stated(options, Quadrature::Corners, model, control)?;
    Ok(if is_whole(&other) { other } else { own })
}

fn stated(
    options: &StateOptions,
    quadrature: Quadrature,
    model: &Model,
    control: &Control,
) -> Result<Stated, InputError> {
    let joints = Joints::new(model, quadrature)?;
    let live = model.assembly.live.iter().any(|w| *w != Wrench::zero());
    if !live && (options.control.is_some() || !options.at.is_empty()) {
        let path = JsonPath::root().key("loads").key("live");
        return Err(InputError::at(path, "the scene has no live load on a free block")
            .hint("add one, or leave out the control point and the load factors"));
    }
    let point = options.control.as_ref().map(|c| control_of(model, c)).transpose()?;
    let live = live && !options.dead_only;
    let start = ElasticState::start(model, &joints);
    let system = System::new(model, &joints);
    let mut newton = Newton::new(&system);
    let guess = newton.guess(&start, &model.assembly.dead, control);
    let found = newton.rest(&start, &model.assembly.dead, &guess, control);
    let mut track = found.map(|displaced| Track::start(model, &joints, displaced));
    let forces = track.as_ref().map_or_else(|| no_forces(&model.interfaces), |t| t.forces.clone());
    let rest = Proved::new(model, Rest { forces, found: track.is_some() });
    let stands = rest.claim().is_some();
    let verdict = (!stands).then(|| assess(model, control));
    let mut bound = None;
    let mut end = PathEnd::None;
    if let Some(track) = track.as_mut().filter(|_| stands && live) {
        let associative = Control { law: Law::Associative, ..*control };
        let asked = limit(model, &associative);
        let top = match asked.outcome {
            Outcome::Found => asked.value,
            Outcome::Unbounded => Some(WITHOUT_END * both_weigh(model, &joints)),
            Outcome::Impossible | Outcome::Undecided => None,
        };
        end = match top {
            Some(top) if top > 0.0 => {
                let last = if asked.outcome == Outcome::Found { UP_TO * top } else { top };
                let mut walk = Walk { model, joints: &joints, newton: &mut newton, control, top };
                let mut end = walk.along(track, last, &options.at);
                let found = asked.outcome == Outcome::Found;
                if end == PathEnd::Bound
                    && found
                    && track.slides(&joints)
                    && settles(track, &joints, top)
                {
                    end = walk.along(track, UP_TO_SLIDING * top, &options.at);
                }
                match (end, asked.outcome) {
                    (PathEnd::Bound, Outcome::Unbounded) => PathEnd::Unbounded,
                    (end, _) => end,
                }
            }
            _ => PathEnd::Open,
        };
        bound = Some(asked);
    }
    let control = point.or_else(|| live.then(|| most_loaded(model)).flatten());
    let steps = newton.steps;
    drop(newton);
    Ok(Stated {
        quadrature,
        track: track.filter(|_| stands),
        joints,
        rest,
        verdict,
        bound,
        control,
        end,
        steps,
    })
}

/// Whether displacements do not grow without end towards the bound, by the last state and the last
/// one at least twice as far from it: block by block of what the live load reaches, so that nothing
/// beside hides one that tips, or seems to tip itself.
fn settles(track: &Track, joints: &Joints, top: f64) -> bool {
    let Some(b) = track.steps.last() else { return false };
    let far_off = |s: &&Step| top - s.load_factor >= 2.0 * (top - b.load_factor);
    let Some(a) = track.steps.iter().rev().find(far_off) else { return false };
    let grows = ((top - a.load_factor) / (top - b.load_factor)).powf(GROWS);
    let far = |s: &Step, i: usize| s.displaced[i].velocity.norm();
    joints.reached.iter().all(|&i| far(b, i) <= far(a, i) * grows)
}

/// The load factor at which live and dead load weigh the same, on the structures that the live load
/// acts on.
fn both_weigh(model: &Model, joints: &Joints) -> f64 {
    let mut assembly = model.assembly.clone();
    let beside = |i: &usize| !joints.reached.contains(i);
    (0..assembly.dead.len()).filter(beside).for_each(|i| assembly.dead[i] = Wrench::zero());
    claim::natural_factor(&assembly)
}

/// The block with the greatest live load, and its centre of mass.
fn most_loaded(model: &Model) -> Option<(usize, Vector3<f64>)> {
    let size = |i: &usize| {
        let w = &model.assembly.live[*i];
        w.force.norm() + w.moment.norm() / model.assembly.blocks[*i].size
    };
    let most = model.assembly.free().max_by(|a, b| size(a).total_cmp(&size(b)))?;
    Some((most, model.assembly.blocks[most].centroid))
}

struct Walk<'a, 'b, 'c> {
    model: &'a Model,
    joints: &'a Joints,
    newton: &'b mut Newton<'c>,
    control: &'a Control,
    top: f64,
}

impl Walk<'_, '_, '_> {
    /// The displacements at a load factor, from the last state.
    fn at(&mut self, track: &Track, lambda: f64) -> Option<Vec<Rate>> {
        let loads: Vec<Wrench> = self
            .model
            .assembly
            .dead
            .iter()
            .zip(&self.model.assembly.live)
            .map(|(d, l)| {
                let mut w = *d;
                w += *l * lambda;
                w
            })
            .collect();
        // What grows without end grows fourfold while the distance from the end is halved.
        let here = &track.state.displaced;
        let mut from = vec![here.clone()];
        if let [.., before, _] = &track.steps[..] {
            let on = |by: f64| {
                let one = |(a, b): (&Rate, &Rate)| Rate {
                    velocity: a.velocity + (a.velocity - b.velocity) * by,
                    spin: a.spin + (a.spin - b.spin) * by,
                };
                here.iter().zip(&before.displaced).map(one).collect()
            };
            from.extend(AHEAD.map(on));
        }
        let from = self.newton.nearest(&track.state, &loads, from);
        self.newton.follow(&track.state, &loads, &from, self.control)
    }

    /// Follows the live load.
    fn along(&mut self, track: &mut Track, last: f64, at: &[f64]) -> PathEnd {
        let mut wanted: Vec<f64> = at.iter().copied().filter(|v| *v < last).collect();
        wanted.sort_by(f64::total_cmp);
        let mut step = STEP * self.top;
        let most = STEPS_A_JOINT * self.joints.list.len();
        while track.steps.len() < MOST {
            if self.control.deadline.is_over() || self.newton.steps > most {
                return PathEnd::Open;
            }
            let lambda = track.steps.last().map_or(0.0, |s| s.load_factor);
            if lambda >= last {
                return PathEnd::Bound;
            }
            wanted.retain(|v| *v > lambda);
            let ahead = wanted.first().copied().unwrap_or(f64::INFINITY).min(last);
            // Half of what is left, so that what grows without end is seen to grow.
            let half = (lambda + 0.5 * (self.top - lambda)).max(lambda + LEAST * self.top);
            let goal = (lambda + step).min(half).min(ahead);
            let Some(displaced) = self.at(track, goal) else {
                step = 0.5 * (goal - lambda);
                if step < LEAST * lambda.max(SMALL * self.top) {
                    return PathEnd::NoBalance;
                }
                continue;
            };
            let (goal, displaced) = self.until_event(track, lambda, goal, displaced);
            track.push(self.model, self.joints, goal, displaced);
            step = (2.0 * step).min(STEP * self.top);
        }
        PathEnd::Open
    }

    /// The first event between the last state and the next, or the next state where there is none.
    fn until_event(
        &mut self,
        track: &Track,
        lambda: f64,
        goal: f64,
        displaced: Vec<Rate>,
    ) -> (f64, Vec<Rate>) {
        let before = &track.steps[track.steps.len() - 1].conditions;
        let happens = |displaced: &[Rate]| {
            !events(before, &track.ahead(self.model, self.joints, displaced)).is_empty()
        };
        if !happens(&displaced) {
            return (goal, displaced);
        }
        let (mut low, mut high) = (lambda, (goal, displaced));
        while high.0 - low > EVENT * self.top {
            let middle = 0.5 * (low + high.0);
            match self.at(track, middle) {
                Some(displaced) => {
                    let track: &Track = track;
                    let before = &track.steps[track.steps.len() - 1].conditions;
                    let next = track.ahead(self.model, self.joints, &displaced);
                    if events(before, &next).is_empty() {
                        low = middle;
                    } else {
                        high = (middle, displaced);
                    }
                }
                None => break,
            }
        }
        high
    }
}

impl Stated {
    /// How far the path goes, where there is one.
    pub fn factor(&self) -> Option<PathFactor> {
        let bound = self.bound.as_ref()?;
        let bound = Bound::new(bound.outcome, bound.value, bound.bracket);
        self.track.as_ref().map(|track| PathFactor::new(self.end, track, &self.joints, bound))
    }

    /// The verdict on the dead load.
    pub fn standing(&self) -> Verdict {
        match &self.verdict {
            None => Verdict::Stable,
            Some(other) => match other.verdict {
                // Forces exist, but the state was not found.
                Verdict::Stable => Verdict::Undecided,
                verdict => verdict,
            },
        }
    }
}
