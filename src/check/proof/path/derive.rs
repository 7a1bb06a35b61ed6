//! Paths: every point from its poses alone, and the answer from the points.

use super::{
    Bracketed, DrivenBy, MovingSupport, PathAnswer, PathPoint, PathResult, PathStatus, Reaction,
    hinges,
    links::{self, Seen, Step},
    slips,
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
        Forces, certificate,
        claim::{self, Claim, Findings},
        evidence::{read_forces, read_rates},
    },
};
use base::tolerance;
use model::{
    assembly::{Assembly, Pose},
    interface::Model,
};
use std::sync::Arc;

/// The answer of `settle` or `push`.
pub(in crate::proof) fn derive(d: &mut Derivation, e: &PathEvidence) -> Result<Told, String> {
    let assembly = &d.model.assembly;
    let drive = match d.question {
        Question::Settle(o) => Drive::settle(assembly, o),
        Question::Push(o) => Drive::push(assembly, o),
        _ => return Err("the question follows no path".into()),
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
    let (mut points, mut seen) = (Vec::new(), Vec::new());
    for (k, own) in e.points.iter().enumerate() {
        let title = format!("point {} at {}", k + 1, own.value);
        let (told, here) = point(d, title, (&carried, drive), own)?;
        points.push(told);
        seen.push(here);
    }
    let (mut ends, mut ends_seen) = (Vec::new(), Vec::new());
    for (word, own) in ["last pose that stands", "first pose that falls"].iter().zip(&e.ends) {
        let title = format!("{word}, at {}", own.value);
        let (told, here) = point(d, title, (&carried, drive), own)?;
        ends.push(told);
        ends_seen.push(here);
    }
    let mut f = Findings::default();
    let ordered = points.windows(2).all(|w| w[0].value <= w[1].value);
    require(&mut f, ordered, "the points are in order");
    if let Some(first) = seen.first() {
        begins(&mut f, d.question, &model.assembly, first)?;
    }
    let steps: Vec<Step> = seen.windows(2).map(|w| w[0].step(&carried, &w[1])).collect();
    let chain = Chain::of(&carried, &seen, &steps, &ends_seen);
    let natural = claim::natural_factor(&model.assembly);
    let least_reaction = match (drive, &e.least) {
        (Drive::Settle(moves), Some(least)) => least_power(&mut f, model, moves, least),
        (_, Some(_)) => return Err("this question has no least reaction".into()),
        _ => None,
    };
    let ends_well = (ends.len() == 2) == (e.end == EndEvidence::Falls) && ends.len() != 1;
    require(
        &mut f,
        ends_well,
        "the poses just before and after the fall are given where it falls, and only there",
    );
    let whole = chain.broken.is_none();
    let linked = &points[..chain.broken.map_or(points.len(), |k| k + 1)];
    let end = if whole { &e.end } else { &EndEvidence::Open };
    let (status, value, falls_at) = status(drive, (linked, &ends), end, natural);
    // Where a joint slides and that is not followed, what is proved is the bound, and no load factor.
    if status == PathStatus::Slides
        && matches!(d.question, Question::Push(_))
        && let Some(last) = points.last_mut().filter(|p| p.most.is_none())
    {
        last.most = last.load_factor.take();
    }
    let why = match (&e.end, chain.broken) {
        (_, Some(k)) => Some(format!(
            "between {} and {} {}: the two poses are not linked",
            points[k].value,
            points.get(k + 1).or(ends.last()).map_or(points[k].value, |p| p.value),
            match steps.get(k).is_some_and(Step::closes) {
                true => "a joint closes",
                false => "the contacts that carry do not stay in place",
            }
        )),
        (EndEvidence::Slides([a, b]), None) => {
            known(&carried, &[a.clone(), b.clone()])?;
            Some(format!("{a} and {b} slide against each other"))
        }
        _ => None,
    };
    let linked = || steps.iter().enumerate().filter(|(k, _)| !chain.jumps.contains(k));
    let off = linked().map(|(_, s)| s.off).fold(0.0, f64::max);
    let sinks = linked().map(|(_, s)| s.sinks).fold(0.0, f64::max);
    f.holds.push(match whole {
        true => format!(
            "contacts that carry at a point were closed at the point before (within {off:.0e} of the block size), and no joint closes in between (within {sinks:.0e})"
        ),
        false => "some contacts that carry at a point were open at the point before: nothing is claimed from there on".into(),
    });
    f.holds.push("each point is proved for its own poses; that the scene passes through these poses is computed, not proved".into());
    f.computed = true;
    d.part("curve", f);
    let jumps_at = chain.jumps.first().map(|&k| points[k].value);
    let answer = PathAnswer { status, value, falls_at, jumps_at, least_reaction, why };
    let events = links::events(&carried, &seen, &steps, &ends_seen);
    let path = PathResult {
        driven_by: driven_by(model, drive),
        points,
        events,
        ends,
        least: e.least.clone(),
    };
    Ok((answer, path))
}

/// How far poses are linked.
struct Chain {
    /// The points after which it goes on by a jump.
    jumps: Vec<usize>,
    /// The first point after which it does not go on at all.
    broken: Option<usize>,
}

impl Chain {
    fn of(carried: &Carried, points: &[Seen], steps: &[Step], ends: &[Seen]) -> Self {
        let last = points.last().map_or(0.0, |p| p.value);
        let jump = |k: &usize| points[*k].jumps_to(&points[k + 1], &steps[*k], last);
        let jumps: Vec<usize> = (0..steps.len()).filter(jump).collect();
        let broken = (0..steps.len()).find(|k| !jumps.contains(k) && !steps[*k].links());
        let falls = match (points.last(), ends) {
            (Some(last), [stands, falls]) => {
                last.step(carried, stands).links()
                    && stands.step_on(carried, falls).links_straight()
            }
            _ => true,
        };
        let end = points.len().checked_sub(1).filter(|_| !falls);
        Self { jumps, broken: broken.or(end) }
    }
}

/// The first pose is that of the scene, or the one that the question begins at.
fn begins(
    f: &mut Findings,
    question: &Question,
    assembly: &Assembly,
    first: &Seen,
) -> Result<(), String> {
    let from = match question {
        Question::Settle(o) => &o.from[..],
        Question::Push(o) => &o.from[..],
        _ => &[],
    };
    let there = read_poses(assembly, from)?;
    let off =
        first.poses.iter().zip(&there).zip(&assembly.blocks).map(|((a, b), block)| {
            (a.shift - b.shift).norm() / block.size + a.turn.angle_to(&b.turn)
        });
    let off = off.fold(0.0, f64::max);
    let word =
        if from.is_empty() { "that of the scene" } else { "the one that the question starts from" };
    require(f, off <= tolerance::ON_THE_WAY, format!("the first pose is {word}"));
    Ok(())
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
            if whole
                && claim(stands) == Some(Claim::Stable)
                && claim(falls) == Some(Claim::Unstable)
                && stands.value < falls.value =>
        {
            (PathStatus::Falls, Some(stands.value), Some(falls.value))
        }
        (EndEvidence::Reached, _) if whole && !drive.is_push() && last == Some(1.0) => {
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
) -> Result<(PathPoint, Seen), String> {
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
            "no two blocks overlap (deepest corner: {:.1e} of the block size)",
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
    require(&mut f, fits, "the proved claim answers the question");
    let most = bound(&mut f, (model, d.known()), load_factor, (claim, e))?;
    let moving: Vec<usize> = match drive {
        Drive::Settle(moves) => moves.0.iter().map(|m| m.support).collect(),
        Drive::Push { .. } => Vec::new(),
    };
    let proved = proven.as_ref().filter(|p| p.claim.is_some());
    let falls = proved.filter(|_| claim == Some(Claim::Unstable)).map(|p| &p.rates[..]);
    let motion = motion(&mut f, model, load_factor.unwrap_or(0.0), e)?;
    let rests = proved.filter(|_| claim != Some(Claim::Unstable));
    let rests = rests.map(|p| motion.as_ref().unwrap_or(&p.forces));
    let seen = Seen::new(carried, (e.value, poses.clone()), (model, &displaced.from), rests, falls);
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
    Ok((told, seen))
}

/// The forces that the motion has, where they are given: they balance the loads as those of a motion
/// under dry friction do.
fn motion(
    f: &mut Findings,
    model: &Model,
    load_factor: f64,
    e: &PointEvidence,
) -> Result<Option<Forces>, String> {
    if e.motion.is_empty() {
        return Ok(None);
    }
    let forces = read_forces(model, &e.motion)?;
    let left = certificate::statics(model, &forces, load_factor);
    require(
        f,
        left.equilibrium_error <= tolerance::DRY_BALANCE && left.cone_excess <= tolerance::CONE,
        format!(
            "the forces of the motion balance the loads, within {:.0e}",
            left.equilibrium_error
        ),
    );
    Ok(Some(forces))
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
        return Err("the bound of a point is not a load factor".into());
    };
    require(
        f,
        dry && load_factor.is_some_and(|l| l <= upper),
        format!("the load factor with dry friction is at most {upper}"),
    );
    Ok(Some(upper))
}

fn known(carried: &Carried, [a, b]: &[String; 2]) -> Result<(), String> {
    let id = |i: usize| &carried.start.assembly.blocks[i].id;
    let is = |k: &model::interface::Interface| id(k.a) == a && id(k.b) == b;
    match carried.joints.iter().any(is) {
        true => Ok(()),
        false => Err(format!("the scene has no joint between {a} and {b}")),
    }
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
    require(
        f,
        off <= tolerance::ON_THE_WAY,
        format!("the supports lie where the movement at {value} puts them"),
    );
    if let Some(d) = drive.demand(value) {
        let way = poses[d.block].way(&blocks[d.block].centroid, &d.point);
        let off = (way.dot(&d.toward) - value).abs() / blocks[d.block].size;
        require(f, off <= tolerance::ON_THE_WAY, format!("the control point has moved {value} m"));
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
