//! What an answer took, and what is said of how it came about.

use crate::{
    Answer as Answered, Assessment, LoadFactor, Proved,
    coulomb::DryLoadFactor,
    follow::{End, answer::Followed},
    geometric::Geometric,
    stages::Staged,
    tilt::Tilt,
};
use base::error::{Finding, FindingCode};
use check::{kinematic::oblique, proof::Run, terms::Attempt, verdict::claim::Claim};
use model::interface::Model;
use scene::Scene;

/// What came beside an answer.
pub(super) fn of(scene: &Scene, model: &Model, answer: &Answered) -> Run {
    let mut run = Run::new(model.timings);
    run.warnings.clone_from(&model.assembly.said);
    match answer {
        Answered::Assess(a) => assessed(&mut run, a),
        Answered::Limit(l) => {
            bound(&mut run, &l.bound);
            l.dead.iter().for_each(|a| dead(&mut run, a));
            l.dry.iter().for_each(|dry| friction(&mut run, dry));
        }
        Answered::Moving(m) => {
            for s in &m.positions {
                bound(&mut run, &s.bound);
                s.dry.iter().for_each(|dry| friction(&mut run, dry));
            }
            if !scene.loads.live.is_empty() {
                let text = "live loads of the scene: the train replaces them";
                run.left_out.push(text.into());
            }
            m.dead.iter().for_each(|a| dead(&mut run, a));
        }
        Answered::Tilt(t) => {
            t.directions.iter().for_each(|tilt| tilted(&mut run, tilt));
            t.level.iter().for_each(|a| dead(&mut run, a));
        }
        Answered::Critical(c) => {
            for probe in c.changes.iter().flat_map(|f| [&f.below, &f.above]).chain(&c.ends) {
                warn(&mut run, &probe.assessment);
            }
            run.scenes = c.probes;
            run.why.range.clone_from(&c.notes);
            let error = |s: &crate::critical::Scanned| {
                Some((s.value, s.outcome.as_ref().err()?.to_string()))
            };
            run.why.no_scene = c.scan.iter().filter_map(error).collect();
        }
        Answered::Thrust(t) => {
            for end in &t.ends {
                run.trace.extend(end.attempts.iter().cloned());
                warn(&mut run, end);
            }
            if let Some(least) = t.ends.first() {
                run.left_out.clone_from(&least.left_out);
            }
            match &t.factor {
                Some(Geometric::Found(flip)) => {
                    warn(&mut run, &flip.stands.assessment);
                    warn(&mut run, &flip.falls.assessment);
                }
                Some(Geometric::Beyond(probe)) => warn(&mut run, &probe.assessment),
                Some(Geometric::Open(why)) => run.why.without_factor = Some(why.clone()),
                None => {}
            }
            dead(&mut run, &t.standing);
        }
        Answered::Path(p) => followed(&mut run, p),
        Answered::Kinematic(k) => {
            for d in &k.directions {
                bound(&mut run, &d.bound);
                d.dry.iter().for_each(|dry| friction(&mut run, dry));
            }
            k.curve.iter().for_each(|c| followed(&mut run, c));
            if let Some(Ok(tied)) = &k.with_members {
                let why = run.why.path.take();
                followed(&mut run, tied);
                run.why.path = why;
            }
            run.why.no_curve.clone_from(&k.why);
            run.why.no_curve_with_members =
                k.with_members.as_ref().and_then(|t| t.as_ref().err()).cloned();
            if !scene.loads.live.is_empty() {
                let text = "live loads of the scene: the earthquake replaces them";
                run.left_out.push(text.into());
            }
            run.warnings.extend(oblique(scene, model).into_iter().map(|k| {
                let text = format!("loads.dead[{k}] pulls down and sideways: it counts as a force without mass. If it contains a weight, split it in two, with the weight straight down; if not, set \"massless\": true");
                Finding::new(FindingCode::Loads, text)
            }));
            k.dead.iter().for_each(|a| dead(&mut run, a));
        }
        Answered::Stages(s) => {
            if model.interfaces.left_out.is_some() {
                let text = "contacts between blocks that overlap or nearly touch are left out at every stage: no stage is computed again with them closed; `assess` does that for the whole scene";
                run.warnings.push(Finding::new(FindingCode::ContactIgnored, text.to_string()));
            }
            s.stages.iter().for_each(|s| stage(&mut run, s));
        }
        Answered::Without(w) => {
            if model.interfaces.left_out.is_some() {
                let text = "contacts between blocks that overlap or nearly touch are left out: nothing is computed again with them closed; `assess` does that for the whole scene";
                run.warnings.push(Finding::new(FindingCode::ContactIgnored, text.to_string()));
            }
            for l in &w.each {
                let mut own = Run::default();
                dead(&mut own, &l.verdict);
                together(&mut run, own);
            }
        }
        Answered::Combinations(c) => {
            c.list.iter().for_each(|c| together(&mut run, c.file.run.clone()));
        }
        Answered::Meet(m) => {
            for probe in m.sides.iter().flatten() {
                together(&mut run, probe.file.run.clone());
            }
            run.scenes = m.probes;
            run.why.no_scene.clone_from(&m.no_scene);
        }
        Answered::State(s) => {
            run.warnings.extend(s.joints.findings.iter().cloned());
            if s.track.is_some() || s.rest.refused().is_some() {
                warn(&mut run, &s.rest);
            }
            s.bound.iter().for_each(|l| bound(&mut run, l));
            run.newton_steps = s.steps;
            s.verdict.iter().for_each(|a| dead(&mut run, a));
        }
        Answered::Rock(r) => {
            for (_, proved) in &r.built.proofs {
                bound(&mut run, proved);
            }
            run.left_out.clone_from(&r.built.proofs[0].1.left_out);
        }
        Answered::Simulate(outcome) => {
            run.warnings.extend(outcome.findings.iter().cloned());
            run.frames =
                outcome.frames.iter().map(|f| super::in_time::frame(f, &outcome.runs)).collect();
        }
        Answered::Shake(s) => {
            run.warnings.extend(s.shaken.findings.iter().cloned());
            run.timings.simulate = s.shaken.seconds;
            run.frames = s.shaken.frames.iter().map(|f| super::in_time::frame(f, &[])).collect();
        }
        Answered::Repose(_) => {}
    }
    run
}

/// Takes over what the check of an answer took, and why it took the answer back.
fn warn<T>(run: &mut Run, proved: &Proved<T>) {
    run.timings.check += proved.seconds();
    refused(run, &proved.findings().fails);
}

fn refused(run: &mut Run, fails: &[String]) {
    for f in fails {
        let finding = Finding::new(FindingCode::Numerics, format!("certificate rejected: {f}"));
        if !run.warnings.contains(&finding) {
            run.warnings.push(finding);
        }
    }
}

fn assessed(run: &mut Run, a: &Proved<Assessment>) {
    run.left_out.clone_from(&a.left_out);
    run.state_steps = a.state.as_ref().map(|s| s.steps.clone()).unwrap_or_default();
    dead(run, a);
}

fn dead(run: &mut Run, a: &Proved<Assessment>) {
    run.trace.extend(a.attempts.iter().cloned());
    warn(run, a);
}

fn bound(run: &mut Run, l: &Proved<LoadFactor>) {
    if run.left_out.is_empty() {
        run.left_out.clone_from(&l.left_out);
    }
    run.trace.extend(l.attempts.iter().cloned());
    warn(run, l);
}

fn friction(run: &mut Run, dry: &Proved<DryLoadFactor>) {
    run.dry_solves += dry.solves;
    warn(run, dry);
}

fn tilted(run: &mut Run, tilt: &Tilt) {
    bound(run, &tilt.load_factor);
    tilt.dry.iter().for_each(|dry| friction(run, &dry.load_factor));
}

fn followed(run: &mut Run, p: &Followed) {
    let proofs = || p.proofs.iter().chain(&p.ends);
    proofs().for_each(|proof| refused(run, &proof.findings.fails));
    run.between += p.path.between;
    let claims: Vec<Option<Claim>> = p.ends.iter().map(|e| e.claim).collect();
    let whole = p.proofs.iter().all(|p| p.claim.is_some_and(|c| check::proof::path::is_good(&c)));
    run.why.path = match &p.path.end {
        End::Stuck(text) => Some(text.clone()),
        End::Falls(_) if claims != [Some(Claim::Stable), Some(Claim::Unstable)] => {
            Some("it falls, but that could not be proved".into())
        }
        End::Reached | End::Vanishes if !whole => {
            Some("a point of the path could not be proved".into())
        }
        _ => None,
    };
}

fn stage(run: &mut Run, s: &Staged) {
    let mut own = Run::default();
    dead(&mut own, &s.verdict);
    match &s.margin {
        Some(Answered::Limit(l)) => {
            bound(&mut own, &l.bound);
            l.dry.iter().for_each(|dry| friction(&mut own, dry));
        }
        Some(Answered::Tilt(t)) => t.directions.iter().for_each(|t| tilted(&mut own, t)),
        _ => {}
    }
    let name = &s.stage.name;
    own.warnings.iter_mut().for_each(|w| w.text = format!("{name}: {}", w.text));
    together(run, own);
    run.why.stages.extend(s.doubt.clone().map(|doubt| (name.clone(), doubt)));
}

/// What was done for one of several scenes that have parts in common: these were tried once.
fn together(run: &mut Run, own: Run) {
    let new: Vec<Attempt> = own.trace.into_iter().filter(|a| !run.trace.contains(a)).collect();
    run.trace.extend(new);
    run.timings.check += own.timings.check;
    run.dry_solves += own.dry_solves;
    for w in own.warnings {
        if !run.warnings.contains(&w) {
            run.warnings.push(w);
        }
    }
}
