//! Systems of contact forces: resultants, use of the sections, lines of thrust.

use analysis::{Outcome, coulomb::Found};
use base::{number::short, tolerance};
use check::question::QuestionKind;
use check::{
    proof::{certificate::Certificate, result::ResultFile},
    verdict::{
        Forces, Verdict,
        evidence::{ContactForces, read_forces},
        section::sections,
    },
};
use model::interface::Model;
use nalgebra::Vector3;
use scene::Friction;

/// What a system of forces, or a mechanism, is to the answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ViewPart {
    /// It goes with the answer.
    Answer,
    /// Forces that stand beside it: without the self-stress, or at a load factor at which the scene
    /// stands.
    Base,
    /// With dry friction.
    Dry,
    /// Of the least thrust.
    Least,
    /// Of the greatest thrust.
    Greatest,
    /// Under the dead load alone.
    Dead,
}

impl ViewPart {
    /// What the names of its arrays end with in files for other programs: the same for every answer
    /// of a kind, nothing for what goes with the answer itself.
    pub fn suffix(self) -> &'static str {
        match self {
            Self::Answer => "",
            Self::Base => "_base",
            Self::Dry => "_dry",
            Self::Least => "_least",
            Self::Greatest => "_greatest",
            Self::Dead => "_dead",
        }
    }
}

/// One system of contact forces.
#[derive(Clone, Debug)]
pub struct ViewState {
    /// What it is to the answer.
    pub part: ViewPart,
    /// Whether it balances what it is about; otherwise it is what comes closest.
    pub balances: bool,
    /// Whether live loads act.
    pub live: bool,
    /// Unit vector against gravity, turned where the ground is tipped.
    pub up: Vector3<f64>,
    /// What it is, in a few words.
    pub name: String,
    /// The number of the answer that it belongs to, with its name: `load_factor`, `tilt_deg`,
    /// `thrust` (N).
    pub value: Option<(&'static str, f64)>,
    /// Force on the second block at each point of each joint, N.
    pub forces: Vec<Vec<Vector3<f64>>>,
    /// Resultant at each joint; `None` where it carries nothing.
    pub resultants: Vec<Option<Resultant>>,
    /// Share of its joints that each block uses: the greatest of its joints; `None` where nothing
    /// presses on it.
    pub used: Vec<Option<f64>>,
    /// The line of thrust.
    pub line: Vec<Segment>,
}

/// The resultant at a joint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Resultant {
    /// Force on the second block, N.
    pub force: Vector3<f64>,
    /// Normal force, N, pressure positive.
    pub normal: f64,
    /// Shear force, N.
    pub shear: f64,
    /// Centre of pressure, m.
    pub at: Vector3<f64>,
    /// Distance of that from the centroid, m.
    pub eccentricity: f64,
    /// Share of the section used: 0 at the centroid, 1 at the edge.
    pub used: f64,
    /// Whether the whole section presses.
    pub in_kern: bool,
    /// Share of the friction used; `None` where friction has no limit, or is not all that resists.
    pub mobilised: Option<f64>,
}

impl Resultant {
    /// The greater of both shares.
    pub fn share(&self) -> f64 {
        self.used.max(self.mobilised.unwrap_or(0.0))
    }
}

/// A piece of a line of thrust inside a block.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Segment {
    /// Index of the block.
    pub body: usize,
    /// From the centre of pressure of this joint
    pub joint: usize,
    /// to that of this one, or to the line on which the block's loads act.
    pub other: Option<usize>,
    /// Where it begins, m.
    pub from: Vector3<f64>,
    /// Where it ends, m.
    pub to: Vector3<f64>,
    /// The force that passes, N.
    pub force: f64,
}

impl ViewState {
    fn new(model: &Model, Named { part, name, value, .. }: Named, forces: &Forces) -> Self {
        let list = sections(&model.interfaces, forces);
        let mean =
            list.iter().map(|s| s.normal.hypot(s.shear)).sum::<f64>() / list.len().max(1) as f64;
        let resultants: Vec<Option<Resultant>> = list
            .iter()
            .zip(forces)
            .map(|(s, forces)| {
                let law = &model.interfaces.list[s.interface].law;
                let carries = s.normal.hypot(s.shear) > tolerance::UNLOADED * mean;
                carries.then(|| Resultant {
                    force: forces.iter().map(|w| w.force).sum(),
                    normal: s.normal,
                    shear: s.shear,
                    at: s.at,
                    eccentricity: s.eccentricity.norm(),
                    used: s.used,
                    in_kern: s.in_kern,
                    mobilised: match law.friction {
                        Friction::Coefficient(mu)
                            if mu > 0.0 && s.normal > 0.0 && law.friction_only() =>
                        {
                            Some(s.shear / (mu * s.normal))
                        }
                        _ => None,
                    },
                })
            })
            .collect();
        let forces = forces.iter().map(|list| list.iter().map(|w| w.force).collect()).collect();
        let (used, line) = (used(model, &resultants), line(model, &resultants));
        let up = -model.assembly.gravity.normalize();
        Self { part, balances: true, live: false, up, name, value, forces, resultants, used, line }
    }
}

/// Block, joint and resultant wherever one presses on the other.
fn pressed<'a>(
    model: &'a Model,
    resultants: &'a [Option<Resultant>],
) -> impl Iterator<Item = (usize, usize, &'a Resultant)> {
    let there = resultants.iter().enumerate().filter_map(|(k, r)| Some((k, r.as_ref()?)));
    there.flat_map(|(k, r)| {
        [model.interfaces.list[k].a, model.interfaces.list[k].b].into_iter().map(move |i| (i, k, r))
    })
}

fn used(model: &Model, resultants: &[Option<Resultant>]) -> Vec<Option<f64>> {
    let mut used: Vec<Option<f64>> = vec![None; model.assembly.blocks.len()];
    for (i, _, r) in pressed(model, resultants) {
        used[i] = Some(used[i].unwrap_or(0.0).max(r.share()));
    }
    used
}

/// Loads act off the centre of mass when they do by this × the block's size. Larger: small loads
/// far out are drawn through the centre. Smaller: rounding bends every line.
const OFF_CENTRE: f64 = 1e-3;

/// Where the loads of a block act: the point of their line of action next to the centre of mass,
/// and their force. Both follow from the joints, which balance them, so that it does not matter
/// what they are multiplied by. `None` where that point lies off the block by more than its size:
/// what is left of forces that nearly cancel has no place.
fn action(
    model: &Model,
    body: usize,
    joints: &[(usize, &Resultant)],
) -> Option<(Vector3<f64>, Vector3<f64>)> {
    let block = &model.assembly.blocks[body];
    let on = |joint: usize| if model.interfaces.list[joint].b == body { 1.0 } else { -1.0 };
    let force: Vector3<f64> = joints.iter().map(|&(k, r)| r.force * -on(k)).sum();
    let moment: Vector3<f64> =
        joints.iter().map(|&(k, r)| (r.at - block.centroid).cross(&r.force) * -on(k)).sum();
    let off = force.cross(&moment) / force.norm_squared();
    (off.norm() <= block.size).then_some((block.centroid + off, force))
}

/// Where the line through a centre of pressure meets the line of action of the loads, inside or
/// near the block.
fn meeting(
    r: &Resultant,
    (at, load): (Vector3<f64>, Vector3<f64>),
    near: Vector3<f64>,
    size: f64,
) -> Option<Vector3<f64>> {
    let (u, v) = (r.force.normalize(), load.normalize());
    let cos = u.dot(&v);
    // Parallel lines meet nowhere, and nearly parallel ones far away.
    let along = ((at - r.at).dot(&u) - (at - r.at).dot(&v) * cos) / (1.0 - cos * cos);
    let point = r.at + u * along;
    (along.is_finite() && (point - near).norm() <= size).then_some(point)
}

/// Through every block from one centre of pressure to the other, over the line of action of its
/// loads where they act off the centre of mass; where more or fewer than two joints press, from
/// there to the place where its loads act.
fn line(model: &Model, resultants: &[Option<Resultant>]) -> Vec<Segment> {
    let mut joints: Vec<Vec<(usize, &Resultant)>> = vec![Vec::new(); model.assembly.blocks.len()];
    for (body, joint, r) in pressed(model, resultants) {
        joints[body].push((joint, r));
    }
    let mut line = Vec::new();
    for body in model.assembly.free() {
        let block = &model.assembly.blocks[body];
        let action = action(model, body, &joints[body]);
        let hub = action.map_or(block.centroid, |(at, _)| at);
        let off = (hub - block.centroid).norm() > OFF_CENTRE * block.size;
        match joints[body][..] {
            [(joint, r), (other, s)] => {
                if let Some(to) = action
                    .filter(|_| off)
                    .and_then(|action| meeting(r, action, block.centroid, block.size))
                {
                    for (joint, r) in [(joint, r), (other, s)] {
                        line.push(Segment {
                            body,
                            joint,
                            other: None,
                            from: r.at,
                            to,
                            force: r.force.norm(),
                        });
                    }
                    continue;
                }
                let force = 0.5 * (r.force.norm() + s.force.norm());
                line.push(Segment { body, joint, other: Some(other), from: r.at, to: s.at, force });
            }
            _ => line.extend(joints[body].iter().map(|&(joint, r)| Segment {
                body,
                joint,
                other: None,
                from: r.at,
                to: if off { hub } else { block.centroid },
                force: r.force.norm(),
            })),
        }
    }
    line
}

/// Forces that leave something out of balance.
const CLOSEST: &str = "forces closest to equilibrium";

/// A system of forces as it was saved.
struct Named<'a> {
    part: ViewPart,
    name: String,
    value: Option<(&'static str, f64)>,
    saved: &'a [ContactForces],
}

/// Every system of forces that a result holds.
pub(super) fn of(model: &Model, file: &ResultFile) -> Result<Vec<ViewState>, String> {
    let mut list: Vec<Named> = Vec::new();
    let own = |c: &Certificate| !c.forces.is_empty();
    let tips = file.question.kind() == QuestionKind::Tilt;
    let at = |v: Option<f64>| match v {
        None => String::new(),
        Some(v) if tips => format!(" at {}°", short(v.atan().to_degrees())),
        Some(v) => format!(" at λ = {}", short(v)),
    };
    let number = |v: Option<f64>| {
        v.map(|v| if tips { ("tilt_deg", v.atan().to_degrees()) } else { ("load_factor", v) })
    };
    if own(&file.certificate) {
        let (name, value) = match (file.answer.verdict(), file.answer.bound()) {
            (_, Some(l)) => match l.status {
                Outcome::Found => {
                    (format!("forces in equilibrium{}", at(l.value)), number(l.value))
                }
                Outcome::Unbounded => {
                    ("forces in equilibrium with the live load alone".into(), None)
                }
                Outcome::Impossible | Outcome::Undecided => (CLOSEST.into(), None),
            },
            (Some(Verdict::Stable), _) => ("forces in equilibrium".into(), None),
            (Some(Verdict::Conditional), _) => ("forces with self-stress".into(), None),
            _ => (CLOSEST.into(), None),
        };
        list.push(Named { part: ViewPart::Answer, name, value, saved: &file.certificate.forces });
    }
    if let Some(base) = &file.certificate.base {
        let name = if file.answer.verdict() == Some(Verdict::Conditional) {
            "forces without self-stress"
        } else {
            "forces in equilibrium with the dead load"
        };
        list.push(Named { part: ViewPart::Base, name: name.into(), value: None, saved: base });
    }
    // Where nothing slides they are the same.
    if let Some(dry) = file
        .dry
        .as_ref()
        .filter(|d| own(&d.certificate) && d.value.is_some() && d.found != Found::NothingSlides)
    {
        list.push(Named {
            part: ViewPart::Dry,
            name: format!("forces with dry friction{}", at(dry.value)),
            value: number(dry.value),
            saved: &dry.certificate.forces,
        });
    }
    if let (Some(thrust), Some(answer)) = (&file.thrust, file.answer.thrust()) {
        let ends = [
            (ViewPart::Least, "forces at the least thrust", &thrust.least, &answer.least),
            (
                ViewPart::Greatest,
                "forces at the greatest thrust",
                &thrust.greatest,
                &answer.greatest,
            ),
        ];
        for (part, name, certificate, end) in
            ends.into_iter().filter(|(_, _, c, _)| own(c) && c.claim.is_some())
        {
            let newton = end.value.map_or(String::new(), |v| format!(", {} N", short(v)));
            list.push(Named {
                part,
                name: format!("{name}{newton}"),
                value: end.value.map(|v| ("thrust", v)),
                saved: &certificate.forces,
            });
        }
    }
    if let Some(dead) = file.dead_load.as_ref().filter(|d| own(&d.certificate)) {
        let stands = matches!(dead.answer.verdict(), Some(Verdict::Stable));
        let name = if stands {
            "forces under the dead load"
        } else {
            "forces closest to equilibrium under the dead load"
        };
        let saved = &dead.certificate.forces;
        list.push(Named { part: ViewPart::Dead, name: name.into(), value: None, saved });
    }
    let tangent = |part: ViewPart| match (file.question.kind(), part) {
        (QuestionKind::Tilt, ViewPart::Answer) => {
            file.answer.bound().and_then(|b| b.value).unwrap_or(0.0)
        }
        (QuestionKind::Tilt, ViewPart::Dry) => {
            file.dry.as_ref().and_then(|d| d.value).unwrap_or(0.0)
        }
        _ => 0.0,
    };
    let state = |named: Named| {
        let (part, mut forces) = (named.part, read_forces(model, named.saved)?);
        // Forces of a tilt are divided by its cosine, so that gravity keeps its part across the
        // ground.
        let tangent = tangent(part);
        forces.iter_mut().flatten().for_each(|w| *w = *w * (1.0 / 1f64.hypot(tangent)));
        let mut state = ViewState::new(model, named, &forces);
        state.balances = !state.name.contains(CLOSEST);
        let pushes = matches!(
            file.question.kind(),
            QuestionKind::Limit | QuestionKind::Moving | QuestionKind::Kinematic
        );
        state.live = pushes && part != ViewPart::Dead;
        if let Some(toward) = file.answer.toward() {
            state.up = (state.up - Vector3::from(toward) * tangent).normalize();
        }
        Ok(state)
    };
    list.into_iter().map(state).collect()
}
