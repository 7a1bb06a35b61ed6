//! Paths: every point from its poses alone, and the answer from the points.

use super::{
    Bracketed, DrivenBy, MovingSupport, PathAnswer, PathEventKind, PathPoint, PathResult,
    PathStatus, Reaction, hinges, slips,
};
use crate::{
    path::{Carried, Drive, Moves, reaction, saved::read_poses},
    proof::{
        answer::Answer,
        certificate::{Certificate, Proven},
        derive::{Derivation, require},
        evidence::{EndEvidence, PathEvidence, PointEvidence},
        told::Told,
    },
    question::Question,
    verdict::{
        claim::{self, Claim, Findings},
        evidence::read_rates,
    },
};
use base::tolerance;
use model::{assembly::Pose, interface::Model};
use std::sync::Arc;

/// The answer of `settle` or `push`.
pub(in crate::proof) fn derive(d: &mut Derivation, e: &PathEvidence) -> Result<Told, String> {
    let assembly = &d.model.assembly;
    let drive = match d.question {
        Question::Settle(o) => Drive::settle(assembly, o),
        Question::Push(o) => Drive::push(assembly, o),
        _ => return Err("the question is about no path".into()),
    };
    let drive = drive.map_err(|e| e.to_string())?;
    let (answer, path) = curve(d, d.model, &drive, e)?;
    d.check.claimed = answer.value.is_some();
    let mut told = Told::new(d.model, Answer::Path(Box::new(answer)), &Arc::default());
    told.path = Some(path);
    Ok(told)
}

/// A curve: its points, and what is said of them.
pub(in crate::proof) fn curve(
    d: &mut Derivation,
    model: &Model,
    drive: &Drive,
    e: &PathEvidence,
) -> Result<(PathAnswer, PathResult), String> {
    let carried = Carried::new(model);
    let mut points = Vec::new();
    let mut poses = Vec::new();
    for (k, own) in e.points.iter().enumerate() {
        let title = format!("point {} at {}", k + 1, own.value);
        let (told, here) = point(d, title, (&carried, drive), own)?;
        points.push(told);
        poses.push(here);
    }
    let mut ends = Vec::new();
    for (word, own) in ["last that stands", "first that falls"].iter().zip(&e.ends) {
        let title = format!("{word}, at {}", own.value);
        ends.push(point(d, title, (&carried, drive), own)?.0);
    }
    let mut f = Findings::default();
    let ordered = points.windows(2).all(|w| w[0].value <= w[1].value);
    require(&mut f, ordered, "the points are in order");
    events_hold(&mut f, &carried, e, &poses)?;
    for (k, pair) in poses.windows(2).enumerate() {
        between(&mut f, &carried, k, [&points[k], &points[k + 1]], [&pair[0], &pair[1]]);
    }
    let natural = claim::natural_factor(&model.assembly);
    let least_reaction = match (drive, &e.least) {
        (Drive::Settle(moves), Some(least)) => least_power(&mut f, model, moves, least),
        (_, Some(_)) => return Err("a least reaction is none of this question".into()),
        _ => None,
    };
    let ends_well = (ends.len() == 2) == (e.end == EndEvidence::Falls) && ends.len() != 1;
    require(&mut f, ends_well, "the poses at which it falls are given where it does");
    let (status, value, falls_at) = status(drive, (&points, &ends), &e.end, natural);
    let why = match (&e.end, status) {
        (EndEvidence::Slides([a, b]), PathStatus::Slides) => {
            known(&carried, &[a.clone(), b.clone()])?;
            Some(format!("{a} and {b} slide on each other"))
        }
        _ => None,
    };
    f.holds.push("that the poses are on the way is computed, not proved: what is proved is what each point says of the scene there".into());
    f.computed = true;
    d.part("curve", f);
    let answer = PathAnswer { status, value, falls_at, least_reaction, why };
    let path = PathResult {
        driven_by: driven_by(model, drive),
        points,
        events: e.events.clone(),
        ends,
        least: e.least.clone(),
    };
    Ok((answer, path))
}

fn driven_by(model: &Model, drive: &Drive) -> DrivenBy {
    let id = |i: usize| model.assembly.blocks[i].id.clone();
    match drive {
        Drive::Settle(moves) => {
            let list = moves.0.iter().map(|m| MovingSupport {
                support: id(m.support),
                way: m.way.into(),
                turn: m.turn.into(),
            });
            DrivenBy::Supports(list.collect())
        }
        Drive::Push { block, point, toward } => DrivenBy::Control {
            block: id(*block),
            point: (*point).into(),
            toward: (*toward).into(),
        },
    }
}

/// Status and value follow from the points; load factors are measured by the natural one.
fn status(
    drive: &Drive,
    (points, ends): (&[PathPoint], &[PathPoint]),
    end: &EndEvidence,
    natural: f64,
) -> (PathStatus, Option<f64>, Option<f64>) {
    let claim = |p: &PathPoint| p.proved;
    let good = |p: &&PathPoint| claim(p).is_some_and(|c| super::is_good(&c));
    let last = points.iter().take_while(good).last().map(|p| p.value);
    let whole = points.iter().all(|p| good(&p));
    let open = (PathStatus::Open, last, None);
    match (end, ends) {
        (EndEvidence::Falls, [stands, falls])
            if claim(stands) == Some(Claim::Stable)
                && claim(falls) == Some(Claim::Unstable)
                && stands.value < falls.value =>
        {
            (PathStatus::Falls, Some(stands.value), Some(falls.value))
        }
        (EndEvidence::Reached, _) if whole && (drive.is_push() || last == Some(1.0)) => {
            (PathStatus::Reached, last, None)
        }
        (EndEvidence::Vanishes, _) if whole && drive.is_push() => {
            let zero = points.last().and_then(|p| p.load_factor);
            match zero.is_some_and(|l| l.abs() <= tolerance::VANISHES * natural) {
                true => (PathStatus::Vanishes, last, None),
                false => open,
            }
        }
        (EndEvidence::Slides(_), _) => (PathStatus::Slides, last, None),
        _ => open,
    }
}

/// One point: its contacts from its poses, its claim from these.
fn point(
    d: &mut Derivation,
    title: String,
    (carried, drive): (&Carried, &Drive),
    e: &PointEvidence,
) -> Result<(PathPoint, Vec<Pose>), String> {
    let mut f = Findings::default();
    let assembly = &carried.start.assembly;
    let poses = read_poses(assembly, &e.poses).map_err(|text| format!("{title}: {text}"))?;
    follows(&mut f, carried, drive, &poses, e.value);
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
    let proven = e.certificate.prove(&mut f, model, d.known());
    let claim = proven.as_ref().and_then(|p| p.claim);
    let load_factor = match claim {
        Some(Claim::LoadFactor { value, .. } | Claim::DryLoadFactor { value }) => Some(value),
        _ => None,
    };
    let fits = match claim {
        None => true,
        Some(Claim::Stable | Claim::Unstable) => !drive.is_push(),
        Some(_) => drive.is_push() && load_factor.is_some(),
    };
    require(&mut f, fits, "what is proved of it is what was asked");
    let most = bound(&mut f, (model, d.known()), load_factor, (claim, e))?;
    let moving: Vec<usize> = match drive {
        Drive::Settle(moves) => moves.0.iter().map(|m| m.support).collect(),
        Drive::Push { .. } => Vec::new(),
    };
    let proved = proven.as_ref().filter(|p| p.claim.is_some());
    let reactions = proved.map_or_else(Vec::new, |p: &Proven| {
        let on = |&i: &usize| {
            let w = reaction::on_support(model, &p.forces, i);
            Reaction {
                support: assembly.blocks[i].id.clone(),
                force: w.force.into(),
                moment: w.moment.into(),
            }
        };
        moving.iter().map(on).collect()
    });
    d.part(title, f);
    let told = PathPoint {
        value: e.value,
        load_factor,
        reactions,
        hinges: hinges(carried, &poses),
        slips: slips(carried, &poses),
        poses: e.poses.clone(),
        certificate: e.certificate.clone(),
        proved: claim,
        most,
    };
    Ok((told, poses))
}

/// A load factor with dry friction is at most its bound, and only such a one has a bound.
fn bound(
    f: &mut Findings,
    (model, known): (&Model, bool),
    load_factor: Option<f64>,
    (claim, e): (Option<Claim>, &PointEvidence),
) -> Result<Option<f64>, String> {
    // Without one the forces alone say that no bound can be less.
    let Some(bound) = &e.bound else { return Ok(None) };
    let dry = matches!(claim, Some(Claim::DryLoadFactor { .. }));
    let mut own = Findings::default();
    let proven = bound.prove(&mut own, model, known);
    f.grade = f.grade.and(own.grade);
    f.holds.extend(own.holds.into_iter().map(|t| format!("bound: {t}")));
    f.fails.extend(own.fails.into_iter().map(|t| format!("bound: {t}")));
    let Some(Claim::LoadFactor { upper, .. }) = proven.and_then(|p| p.claim) else {
        return Err("the bound of a point claims no load factor".into());
    };
    require(
        f,
        dry && load_factor.is_some_and(|l| l <= upper),
        format!("the load factor with dry friction is at most {upper}"),
    );
    Ok(Some(upper))
}

/// Joints that are spoken of are joints of the scene, and what is said of them shows at the points.
fn events_hold(
    f: &mut Findings,
    carried: &Carried,
    e: &PathEvidence,
    poses: &[Vec<Pose>],
) -> Result<(), String> {
    let first = e.points.first().map_or(0.0, |p| p.value);
    let last = e.points.iter().chain(&e.ends).map(|p| p.value).fold(first, f64::max);
    for event in &e.events {
        let joints = event.opens.iter().chain(&event.closes).chain(&event.slides);
        for pair in joints {
            known(carried, pair)?;
        }
        let members = &carried.start.interfaces.members;
        if let Some(id) = event.yields.iter().find(|id| members.iter().all(|m| m.id != **id)) {
            return Err(format!("the scene has no member {id}"));
        }
        let small = 1e-9 * last.abs().max(first.abs());
        require(
            f,
            (first - small..=last + small).contains(&event.value),
            format!("what happens at {} is on the way", event.value),
        );
        if event.kind != PathEventKind::Jumps && event.jump.is_some() {
            return Err("a jump is told where there is none".into());
        }
        let Some(said) = event.jump else { continue };
        let at = (1..poses.len()).find(|&k| {
            e.points[k].value == e.points[k - 1].value
                && (e.points[k].value - event.value).abs() <= small
        });
        let Some(k) = at else { continue };
        let ways = poses[k].iter().zip(&poses[k - 1]).map(|(a, b)| (a.shift - b.shift).norm());
        let here = ways.fold(0.0, f64::max);
        require(
            f,
            (here - said).abs() <= tolerance::SAVED * here.max(said) || here <= said,
            format!("by the jump at {} blocks go {said} m at most", event.value),
        );
    }
    Ok(())
}

fn known(carried: &Carried, [a, b]: &[String; 2]) -> Result<(), String> {
    let id = |i: usize| &carried.start.assembly.blocks[i].id;
    let is = |k: &model::interface::Interface| id(k.a) == a && id(k.b) == b;
    match carried.joints.iter().any(is) {
        true => Ok(()),
        false => Err(format!("the scene has no joint between {a} and {b}")),
    }
}

/// Part of the way between two points at which it is looked whether anything overlaps.
const BETWEEN: [f64; 3] = [0.25, 0.5, 0.75];

/// No joint closes on the way between two neighbouring points beyond what straight ways between
/// their poses, which are curved ones in truth, may be off by: a block's way × its turn, eight times
/// what a turn about a fixed point is, for blocks do not turn in proportion to each other.
fn between(
    f: &mut Findings,
    carried: &Carried,
    k: usize,
    ends: [&PathPoint; 2],
    [from, to]: [&[Pose]; 2],
) {
    if ends[0].value == ends[1].value {
        return f.holds.push("a jump, which is not followed".into());
    }
    let assembly = &carried.start.assembly;
    let off: Vec<f64> = from
        .iter()
        .zip(to)
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
        .map(|k| [from, to].iter().any(|poses| carried.slid(poses, k).is_some()))
        .collect();
    for share in BETWEEN {
        let poses: Vec<Pose> = from
            .iter()
            .zip(to)
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
        format!(
            "no joint closes between points {} and {}: by {:.1e} of its block at most",
            k + 1,
            k + 2,
            deepest.max(0.0)
        ),
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

/// The least power that supports can have on what they carry as they begin to move.
fn least_power(
    f: &mut Findings,
    model: &Model,
    moves: &Moves,
    evidence: &Certificate,
) -> Option<Bracketed> {
    let read = || -> Result<_, String> {
        let (forces, _) = evidence.read(model)?;
        Ok((forces, read_rates(&model.assembly, &evidence.rates)?))
    };
    let (forces, mut rates) = match read() {
        Ok(read) => read,
        Err(text) => {
            f.fails.push(text);
            return None;
        }
    };
    for (i, rate) in moves.rates(model).into_iter().enumerate() {
        if model.assembly.blocks[i].support {
            rates[i] = rate;
        }
    }
    let least = reaction::least(model, &forces, &rates);
    let told = Bracketed { value: least.value, lower: least.lower, upper: least.upper };
    least.holds.then_some(told)
}
