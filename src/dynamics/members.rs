//! Members in time: lines, pushes and strips as spring-dampers, cut at their bounds.
//!
//! A member without a stiffness of its own is as stiff as a step allows, like the contacts; one
//! with, at most that. What passes a bound yields for good (a bar that was drawn out is longer
//! afterwards); at a bound of zero nothing yields, a tie is slack there and tight again where it
//! was. Lines follow their ends, strips turn with the block before the joint, soil pushes in the
//! direction that it has. Dowels and fingers are left out.

use super::{bodies::Body, rapier::World, units::Units};
use model::{
    assembly::{Action, Member, MemberKind},
    interface::Interfaces,
};
use nalgebra::Vector3;
use std::collections::BTreeMap;

/// Natural frequency of a member against the blocks at its ends × step. Larger: ties that hold many
/// blocks shake, for their forces are those of the step before. Smaller: they give way by more than
/// what counts as rest ([`base::tolerance::SETTLED_FINE`]).
const FREQUENCY: f64 = 0.3;
/// Damping ratio of a member.
const DAMPING: f64 = 0.7;

/// Force and torque about the centre of mass by block, in the engine's units.
pub(super) type Pulls = BTreeMap<usize, (Vector3<f64>, Vector3<f64>)>;

/// The members that the simulation does not have: dowels and fingers that could take a force.
pub(super) fn left_out(interfaces: &Interfaces) -> impl Iterator<Item = &Member> {
    interfaces
        .members
        .iter()
        .filter(|m| !m.is_idle() && matches!(m.action, Action::Shear { .. } | Action::Press { .. }))
}

/// The members of a run.
pub(super) struct Springs {
    list: Vec<Spring>,
}

/// A place that moves with a block: the arm from its centre of mass at the start, or, on the
/// ground, where it is.
#[derive(Clone, Copy)]
struct Anchor {
    block: Option<usize>,
    arm: Vector3<f64>,
}

/// How a member pulls.
enum Course {
    /// Along the straight pieces between these places.
    Line(Vec<Anchor>),
    /// Along `direction` on the first place and against it on the second; the direction turns with
    /// a block, where one is named.
    Push { on: Anchor, from: Anchor, direction: Vector3<f64>, turns_with: Option<usize> },
}

/// One member, in the engine's units.
struct Spring {
    course: Course,
    least: f64,
    greatest: f64,
    prestress: f64,
    stiffness: f64,
    damping: f64,
    /// Lengthening, from the length at the start, at which it bears its prestress.
    ease: f64,
    /// Length at the start.
    length: f64,
}

/// What a member of amount one does at one place: force there, place, block.
struct Leg {
    block: Option<usize>,
    at: Vector3<f64>,
    direction: Vector3<f64>,
}

impl Springs {
    /// The members of a scene, for steps of length `dt`.
    pub fn new(interfaces: &Interfaces, bodies: &[Body], units: &Units, dt: f64) -> Self {
        let moved = |place: &Anchor| place.block.filter(|&i| !bodies[i].support);
        let mut list: Vec<Spring> = interfaces
            .members
            .iter()
            .filter(|m| !m.is_idle())
            .filter_map(|m| Spring::of(m, bodies, units))
            .collect();
        let mut sharing: BTreeMap<usize, f64> = BTreeMap::new();
        for spring in &list {
            spring.places().filter_map(moved).for_each(|i| *sharing.entry(i).or_default() += 1.0);
        }
        for spring in &mut list {
            // How easily a unit of force moves its ends, each as if all members there acted alike.
            let legs = spring.legs(&|place| place.start(bodies), &|v, _| v);
            let ease = |leg: &Leg| {
                let Some(i) = leg.block.filter(|&i| !bodies[i].support) else { return 0.0 };
                let body = &bodies[i];
                let lever = (leg.at - body.center).cross(&leg.direction);
                let turning = body.inertia.cholesky().map_or(0.0, |c| lever.dot(&c.solve(&lever)));
                sharing[&i] * (leg.direction.norm_squared() / body.mass + turning)
            };
            let mobility: f64 = legs.iter().map(ease).sum();
            if mobility > 0.0 {
                let mass = 1.0 / mobility;
                spring.stiffness = spring.stiffness.min(mass * (FREQUENCY / dt).powi(2));
                spring.damping = 2.0 * DAMPING * (spring.stiffness * mass).sqrt();
            } else {
                spring.stiffness = 0.0;
            }
        }
        list.retain(|spring| spring.stiffness > 0.0);
        Self { list }
    }

    /// The forces of all members where the blocks are now, with `part` of their prestress; members
    /// that yield are longer or shorter from now on. Blocks with a member are always among them.
    pub fn pulls(&mut self, world: &World, bodies: &[Body], part: f64) -> Pulls {
        let mut pulls = Pulls::new();
        for spring in &mut self.list {
            let legs = spring.legs(
                &|place| match place.block {
                    Some(i) => {
                        let (center, turn) = world.pose(i);
                        center + turn * place.arm
                    }
                    None => place.arm,
                },
                &|v, block| world.pose(block).1 * v,
            );
            let rate: f64 = legs
                .iter()
                .filter_map(|leg| {
                    let block = leg.block?;
                    let (velocity, spin) = world.velocity(block);
                    let arm = leg.at - world.pose(block).0;
                    Some(-leg.direction.dot(&(velocity + spin.cross(&arm))))
                })
                .sum();
            let amount = spring.amount(spring.lengthening(&legs), rate, part);
            for leg in &legs {
                let Some(i) = leg.block.filter(|&i| !bodies[i].support) else { continue };
                let force = leg.direction * amount;
                let (sum, torque) = pulls.entry(i).or_default();
                *sum += force;
                *torque += (leg.at - world.pose(i).0).cross(&force);
            }
        }
        pulls
    }
}

impl Anchor {
    fn start(&self, bodies: &[Body]) -> Vector3<f64> {
        self.block.map_or(self.arm, |i| bodies[i].center + self.arm)
    }
}

impl Spring {
    fn of(member: &Member, bodies: &[Body], units: &Units) -> Option<Self> {
        let place = |block: Option<usize>, at: &Vector3<f64>| {
            let at = units.place(*at);
            Anchor { block, arm: block.map_or(at, |i| at - bodies[i].center) }
        };
        let course = match &member.action {
            Action::Line(anchors) => {
                Course::Line(anchors.iter().map(|a| place(a.block, &a.at)).collect())
            }
            Action::Push { on, from, at, direction } => Course::Push {
                on: place(Some(*on), at),
                from: place(*from, at),
                direction: *direction,
                turns_with: from.filter(|_| member.kind == MemberKind::Strip),
            },
            Action::Shear { .. } | Action::Press { .. } => return None,
        };
        let mut spring = Self {
            course,
            least: member.least / units.force(),
            greatest: member.greatest / units.force(),
            prestress: member.prestress / units.force(),
            stiffness: member.stiffness.map_or(f64::INFINITY, |k| k * units.length / units.force()),
            damping: 0.0,
            ease: 0.0,
            length: 0.0,
        };
        let legs = spring.legs(&|place| place.start(bodies), &|v, _| v);
        spring.length = spring.lengthening(&legs);
        Some(spring)
    }

    fn places(&self) -> impl Iterator<Item = &Anchor> {
        match &self.course {
            Course::Line(places) => places.iter().collect::<Vec<_>>(),
            Course::Push { on, from, .. } => vec![on, from],
        }
        .into_iter()
    }

    /// What it does where the places are now; `turned` turns a direction with a block.
    fn legs(
        &self,
        at: &dyn Fn(&Anchor) -> Vector3<f64>,
        turned: &dyn Fn(Vector3<f64>, usize) -> Vector3<f64>,
    ) -> Vec<Leg> {
        match &self.course {
            Course::Line(places) => {
                let points: Vec<Vector3<f64>> = places.iter().map(at).collect();
                let towards = |k: usize, other: Option<usize>| {
                    let other = points.get(other?)?;
                    (other - points[k]).try_normalize(0.0)
                };
                let leg = |(k, place): (usize, &Anchor)| {
                    let before = towards(k, k.checked_sub(1)).unwrap_or_default();
                    let after = towards(k, Some(k + 1)).unwrap_or_default();
                    Leg { block: place.block, at: points[k], direction: before + after }
                };
                places.iter().enumerate().map(leg).collect()
            }
            Course::Push { on, from, direction, turns_with } => {
                let direction = turns_with.map_or(*direction, |i| turned(*direction, i));
                vec![
                    Leg { block: on.block, at: at(on), direction },
                    Leg { block: from.block, at: at(from), direction: -direction },
                ]
            }
        }
    }

    /// Its length, less that at the start: the sum of what each leg is drawn against its direction.
    fn lengthening(&self, legs: &[Leg]) -> f64 {
        let long = match self.course {
            Course::Line(_) => legs.windows(2).map(|l| (l[1].at - l[0].at).norm()).sum::<f64>(),
            Course::Push { .. } => -legs.iter().map(|l| l.direction.dot(&l.at)).sum::<f64>(),
        };
        long - self.length
    }

    /// The amount at a lengthening and its rate.
    fn amount(&mut self, lengthening: f64, rate: f64, part: f64) -> f64 {
        let rest = self.prestress * part;
        let still = rest + self.stiffness * (lengthening - self.ease);
        if self.greatest > 0.0 && still > self.greatest {
            self.ease = lengthening - (self.greatest - rest) / self.stiffness;
        } else if self.least < 0.0 && still < self.least {
            self.ease = lengthening - (self.least - rest) / self.stiffness;
        }
        let still = still.clamp(self.least, self.greatest);
        (still + self.damping * rate).clamp(self.least, self.greatest)
    }
}
