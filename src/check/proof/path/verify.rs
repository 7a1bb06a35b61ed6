//! Verifying paths: every point from its poses alone, and the answer from the points.

use super::{DrivenBy, Hinge, PathAnswer, PathPoint, PathResult, PathStatus, hinges, slips};
use crate::{
    path::{Carried, Drive, Move, Moves, reaction, saved::read_poses},
    proof::{
        certificate::Certificate,
        result::{QuestionKind, ResultFile},
        verify::{Verification, failure, require},
    },
    verdict::{
        Evidence, Forces, Rate,
        claim::{self, Claim, Findings},
        evidence::{read_forces, read_members, read_rates},
    },
};
use base::tolerance;
use model::{assembly::Pose, interface::Model};
use nalgebra::Vector3;

/// Adds the parts of a result of `settle` or `push`.
pub fn verify(all: &mut Verification, file: &ResultFile, model: &Model) {
    let (Some(said), Some(path)) = (file.answer.path(), &file.path) else {
        return all.part("answer", failure("the answer is not one to its question"));
    };
    curve(all, said, path, model, file.question);
    let mut f = Findings::default();
    require(&mut f, file.certificate.claim.is_none(), "nothing else is claimed");
    all.part("answer", f);
    all.claimed = said.value.is_some();
}

/// Adds the parts of a curve: its points, and what is said of them.
pub fn curve(
    all: &mut Verification,
    said: &PathAnswer,
    path: &PathResult,
    model: &Model,
    question: QuestionKind,
) {
    let drive = match drive(model, path, question) {
        Ok(drive) => drive,
        Err(text) => return all.part("answer", failure(text)),
    };
    let carried = Carried::new(model);
    let mut stands = Vec::new();
    for (k, point) in path.points.iter().enumerate() {
        let findings = check_point(&carried, &drive, point);
        stands.push(findings.fails.is_empty() && point.certificate.claim.is_some());
        all.part(format!("point {} at {}", k + 1, point.value), findings);
    }
    for (end, point) in ["last that stands", "first that falls"].iter().zip(&path.ends) {
        all.part(format!("{end}, at {}", point.value), check_point(&carried, &drive, point));
    }
    for (k, pair) in path.points.windows(2).enumerate() {
        let mut f = Findings::default();
        between(&mut f, &carried, [&pair[0], &pair[1]]);
        all.part(format!("between points {} and {}", k + 1, k + 2), f);
    }
    let mut f = Findings::default();
    let ordered = path.points.windows(2).all(|w| w[0].value <= w[1].value);
    require(&mut f, ordered, "the points are in order");
    require(
        &mut f,
        says(said, path, &drive, claim::natural_factor(&model.assembly)),
        "the answer is that of its points",
    );
    if let (Drive::Settle(moves), Some(least)) = (&drive, &path.least) {
        least_reaction(&mut f, model, moves, said, least);
    } else {
        require(
            &mut f,
            said.least_reaction.is_none(),
            "no least reaction is claimed without evidence",
        );
    }
    f.holds.push("that the poses are on the way is computed, not proved: what is proved is what each point says of the scene there".into());
    all.part("curve", f);
}

fn drive(model: &Model, path: &PathResult, question: QuestionKind) -> Result<Drive, String> {
    let find = |id: &str, support: bool| {
        model
            .assembly
            .find(id)
            .filter(|&i| model.assembly.blocks[i].support == support)
            .ok_or_else(|| format!("the scene has no such block to move: {id}"))
    };
    match (&path.driven_by, question) {
        (DrivenBy::Supports(list), QuestionKind::Settle) => {
            let moves = list.iter().map(|m| {
                let support = find(&m.support, true)?;
                Ok(Move { support, way: m.way.into(), turn: m.turn.into() })
            });
            Ok(Drive::Settle(Moves(moves.collect::<Result<_, String>>()?)))
        }
        (
            DrivenBy::Control { block, point, toward },
            QuestionKind::Push | QuestionKind::Kinematic,
        ) => Ok(Drive::Push {
            block: find(block, false)?,
            point: (*point).into(),
            toward: Vector3::from(*toward).normalize(),
        }),
        _ => Err("what moves it is not what was asked".into()),
    }
}

/// One point: its contacts from its poses, its claim from these.
fn check_point(carried: &Carried, drive: &Drive, point: &PathPoint) -> Findings {
    let mut f = Findings::default();
    let assembly = &carried.start.assembly;
    let poses = match read_poses(assembly, &point.poses) {
        Ok(poses) => poses,
        Err(text) => return failure(text),
    };
    follows(&mut f, carried, drive, &poses, point.value);
    let displaced = carried.displaced(&poses);
    let depth = displaced.deepest.map_or(0.0, |c| c.gap);
    require(
        &mut f,
        depth >= -tolerance::JOINT_CLOSED,
        format!(
            "no two blocks overlap: the deepest corner by {:.1e} of its block",
            (-depth).max(0.0)
        ),
    );
    let model = &displaced.model;
    let evidence = &point.certificate;
    let read = || -> Result<(Forces, Vec<Rate>), String> {
        let mut forces = read_forces(model, &evidence.forces)?;
        read_members(model, &evidence.members, &mut forces)?;
        Ok((forces, read_rates(&model.assembly, &evidence.rates)?))
    };
    let (forces, rates) = match read() {
        Ok(read) => read,
        Err(text) => {
            f.fails.push(text);
            return f;
        }
    };
    let Some(claim) = &evidence.claim else {
        require(&mut f, point.load_factor.is_none(), "undecided: nothing is claimed");
        return f;
    };
    let said = match (claim, drive) {
        (Claim::Stable | Claim::Unstable, Drive::Settle(_)) => point.load_factor.is_none(),
        (Claim::LoadFactor { value, .. } | Claim::DryLoadFactor { value }, Drive::Push { .. }) => {
            point.load_factor == Some(*value)
        }
        _ => false,
    };
    require(&mut f, said, "the point says what its certificate claims");
    let claimed = claim::verify(model, claim, Evidence::new(&forces, &rates));
    f.grade = claimed.grade;
    f.holds.extend(claimed.holds);
    f.fails.extend(claimed.fails);
    bounded(&mut f, model, point);
    let total: f64 = assembly.free().map(|i| assembly.weight(i)).sum();
    let near = |a: &[f64; 3], b: Vector3<f64>, scale: f64| {
        (Vector3::from(*a) - b).norm() <= tolerance::SAVED * scale
    };
    let moving: Vec<usize> = match drive {
        Drive::Settle(moves) => moves.0.iter().map(|m| m.support).collect(),
        Drive::Push { .. } => Vec::new(),
    };
    let reactions = point.reactions.len() == moving.len()
        && point.reactions.iter().zip(&moving).all(|(said, &i)| {
            let w = reaction::on_support(model, &forces, i);
            let block = &assembly.blocks[i];
            said.support == block.id
                && near(&said.force, w.force, total)
                && near(&said.moment, w.moment, total * block.size)
        });
    require(&mut f, reactions, "the reactions are those of the forces");
    let here = hinges(carried, &poses);
    let size = |h: &Hinge| {
        h.width.max(assembly.find(&h.between[0]).map_or(0.0, |i| assembly.blocks[i].size))
    };
    let same = here.len() == point.hinges.len()
        && here.iter().zip(&point.hinges).all(|(a, b)| {
            a.between == b.between
                && (Vector3::from(a.at) - Vector3::from(b.at)).norm()
                    <= tolerance::JOINT_CLOSED * size(a)
                && (a.width - b.width).abs() <= tolerance::JOINT_CLOSED * size(a)
        });
    require(&mut f, same, format!("its hinges are those of its poses, {} of them", here.len()));
    let slid = slips(carried, &poses);
    let size = |id: &str| assembly.find(id).map_or(0.0, |i| assembly.blocks[i].size);
    let same = slid.len() == point.slips.len()
        && slid.iter().zip(&point.slips).all(|(a, b)| {
            let small = tolerance::JOINT_CLOSED * size(&a.between[0]).max(a.way);
            a.between == b.between
                && (Vector3::from(a.at) - Vector3::from(b.at)).norm() <= small
                && (a.way - b.way).abs() <= small
        });
    require(&mut f, same, format!("its slips are those of its poses, {} of them", slid.len()));
    f
}

/// A load factor with dry friction is at most its bound, and only such a one has a bound.
fn bounded(f: &mut Findings, model: &Model, point: &PathPoint) {
    let dry = matches!(point.certificate.claim, Some(Claim::DryLoadFactor { .. }));
    let Some(bound) = &point.bound else {
        // The forces alone say that no bound can be less.
        return;
    };
    let Some(Claim::LoadFactor { upper, .. }) = bound.claim else {
        return f.fails.push("its bound claims no load factor".into());
    };
    require(
        f,
        dry && point.load_factor.is_some_and(|l| l <= upper),
        format!("the load factor with dry friction is at most {upper}"),
    );
    let read = || -> Result<(Forces, Vec<Rate>), String> {
        let mut forces = read_forces(model, &bound.forces)?;
        read_members(model, &bound.members, &mut forces)?;
        Ok((forces, read_rates(&model.assembly, &bound.rates)?))
    };
    match (read(), &bound.claim) {
        (Ok((forces, rates)), Some(claim)) => {
            let found = claim::verify(model, claim, Evidence::new(&forces, &rates));
            f.grade = f.grade.and(found.grade);
            f.holds.extend(found.holds.into_iter().map(|t| format!("bound: {t}")));
            f.fails.extend(found.fails.into_iter().map(|t| format!("bound: {t}")));
        }
        (Err(text), _) => f.fails.push(text),
        (Ok(_), None) => {}
    }
}

/// Part of the way between two points at which it is looked whether anything overlaps.
const BETWEEN: [f64; 3] = [0.25, 0.5, 0.75];

/// No joint closes on the way between two neighbouring points beyond what straight ways between
/// their poses, which are curved ones in truth, may be off by: a block's way × its turn, eight times
/// what a turn about a fixed point is, for blocks do not turn in proportion to each other.
fn between(f: &mut Findings, carried: &Carried, ends: [&PathPoint; 2]) {
    if ends[0].value == ends[1].value {
        return f.holds.push("a jump, which is not followed".into());
    }
    let assembly = &carried.start.assembly;
    let (Ok(from), Ok(to)) =
        (read_poses(assembly, &ends[0].poses), read_poses(assembly, &ends[1].poses))
    else {
        return f.fails.push("their poses are none of the scene".into());
    };
    let off: Vec<f64> = from
        .iter()
        .zip(&to)
        .zip(&assembly.blocks)
        .map(|((a, b), block)| {
            let turn = a.turn.angle_to(&b.turn);
            turn * ((b.shift - a.shift).norm() + turn * block.size)
        })
        .collect();
    let list = &carried.joints;
    let mut deepest = 0.0_f64;
    // Where a joint has slid its faces are what may run into each other.
    let by_faces: Vec<bool> = (0..list.len())
        .map(|k| [&from, &to].iter().any(|poses| carried.slid(poses, k).is_some()))
        .collect();
    for share in BETWEEN {
        let poses: Vec<Pose> = from
            .iter()
            .zip(&to)
            .map(|(a, b)| Pose {
                shift: a.shift.lerp(&b.shift, share),
                turn: a.turn.slerp(&b.turn, share),
            })
            .collect();
        for (k, face) in list.iter().enumerate() {
            let Some(gap) = carried.depth(&poses, k, by_faces[k]) else { continue };
            let allowed = (off[face.a] + off[face.b]) / carried.size(k);
            deepest = deepest.max(-gap - allowed);
        }
    }
    require(
        f,
        deepest <= tolerance::JOINT_CLOSED,
        format!("no joint closes on the way: by {:.1e} of its block at most", deepest.max(0.0)),
    );
}

/// Supports and control point are where the parameter puts them.
fn follows(f: &mut Findings, carried: &Carried, drive: &Drive, poses: &[Pose], value: f64) {
    let blocks = &carried.start.assembly.blocks;
    let supports = (0..blocks.len()).filter(|&i| blocks[i].support);
    let off = supports
        .map(|i| {
            let (here, there) = (&poses[i], drive.pose(i, value));
            let turn = here.turn.angle_to(&there.turn);
            (here.shift - there.shift).norm() / blocks[i].size + turn
        })
        .fold(0.0, f64::max);
    require(f, off <= tolerance::ON_THE_WAY, format!("the supports are where {value} puts them"));
    if let Some(d) = drive.demand(value) {
        let way = poses[d.block].way(&blocks[d.block].centroid, &d.point);
        let off = (way.dot(&d.toward) - value).abs() / blocks[d.block].size;
        require(f, off <= tolerance::ON_THE_WAY, format!("the control point has gone {value} m"));
    }
}

/// Whether status and value follow from the points; load factors are measured by the natural one.
fn says(said: &PathAnswer, path: &PathResult, drive: &Drive, natural: f64) -> bool {
    let claim = |p: &PathPoint| p.certificate.claim;
    let good = |p: &&PathPoint| claim(p).is_some_and(|c| super::is_good(&c));
    let last = path.points.iter().take_while(good).last().map(|p| p.value);
    match said.status {
        PathStatus::Falls => match &path.ends[..] {
            [stands, falls] => {
                claim(stands) == Some(Claim::Stable)
                    && claim(falls) == Some(Claim::Unstable)
                    && stands.value < falls.value
                    && said.value == Some(stands.value)
                    && said.falls_at == Some(falls.value)
            }
            _ => false,
        },
        _ if !path.ends.is_empty() || said.falls_at.is_some() => false,
        PathStatus::Reached => {
            let whole = !matches!(drive, Drive::Settle(_)) || last == Some(1.0);
            said.value == last && whole && path.points.iter().all(|p| good(&p))
        }
        PathStatus::Vanishes => {
            let zero = path.points.last().and_then(|p| p.load_factor);
            said.value == last
                && matches!(drive, Drive::Push { .. })
                && path.points.iter().all(|p| good(&p))
                && zero.is_some_and(|l| l.abs() <= tolerance::VANISHES * natural)
        }
        PathStatus::Slides | PathStatus::Open => said.value == last,
    }
}

fn least_reaction(
    f: &mut Findings,
    model: &Model,
    moves: &Moves,
    said: &PathAnswer,
    evidence: &Certificate,
) {
    let read = || -> Result<(Forces, Vec<Rate>), String> {
        let mut forces = read_forces(model, &evidence.forces)?;
        read_members(model, &evidence.members, &mut forces)?;
        Ok((forces, read_rates(&model.assembly, &evidence.rates)?))
    };
    let (forces, mut rates) = match read() {
        Ok(read) => read,
        Err(text) => return f.fails.push(text),
    };
    for (i, rate) in moves.rates(model).into_iter().enumerate() {
        if model.assembly.blocks[i].support {
            rates[i] = rate;
        }
    }
    let Some(said) = said.least_reaction else {
        return f.holds.push("no least reaction is claimed".into());
    };
    let least = reaction::least(model, &forces, &rates);
    let near = |a: f64, b: f64| (a - b).abs() <= tolerance::SAVED * least.value.abs();
    let agrees = least.holds
        && near(least.value, said.value)
        && near(least.lower, said.lower)
        && near(least.upper, said.upper);
    require(
        f,
        agrees,
        format!("least reaction recomputed: between {:.9e} and {:.9e} J", least.lower, least.upper),
    );
}
