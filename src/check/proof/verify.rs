//! Verifying a saved result from the scene: every claim with its evidence, and every word and
//! number of the answer against the claim. Nothing that the file says about itself is believed.

pub(super) mod again;
mod left_out;

use super::{
    ResultFile,
    answer::{Answer, LimitAnswer, LoadFactorAnswer, TiltAnswer, VerdictAnswer},
    certificate::{Certificate, DryResult},
    critical, kinematic, member, moving, part, path,
    recompute::Recompute,
    result::{Direction, JointWords, MechanismWords, QuestionKind},
    rocking, shaken, stages, state, thrust,
};
use crate::{
    terms::{Bound, Found, Outcome, agree},
    verdict::tilted::tilted,
    verdict::{
        Evidence, Forces, Rate, Verdict, certificate,
        claim::{self, Claim, Findings},
        evidence::read_rates,
        exact::Grade,
        mechanism,
    },
};
use base::{
    error::{Finding, FindingCode, InputError},
    tolerance,
};
use model::interface::{self, Model, Part, prepare};
use nalgebra::Vector3;
use scene::Scene;
use std::collections::{BTreeMap, BTreeSet, HashMap};

/// What the verification of a result found.
#[derive(Clone, Debug, Default)]
pub struct Verification {
    /// A title and the findings for each part of the result.
    pub parts: Vec<(String, Findings)>,
    /// Whether the main answer claims anything; an undecided one does not.
    pub claimed: bool,
    /// What is to be known about the scene that all of it is about.
    pub scene: Vec<Finding>,
}

impl Verification {
    /// Whether any part fails.
    pub fn refuted(&self) -> bool {
        self.parts.iter().any(|(_, f)| !f.fails.is_empty())
    }

    /// The weakest grade of all that holds.
    pub fn grade(&self) -> Grade {
        self.parts.iter().fold(Grade::Exact, |all, (_, f)| all.and(f.grade))
    }

    /// Whether something that holds is computed, not proved.
    pub fn computed(&self) -> bool {
        !self.refuted() && self.parts.iter().any(|(_, f)| f.computed)
    }

    /// What only a solver could compute again, which this build has none of.
    pub fn unchecked(&self) -> impl Iterator<Item = &str> {
        self.parts.iter().flat_map(|(_, f)| &f.unchecked).map(String::as_str)
    }

    /// Whether the answer is proved: it claims something, every part holds, and nothing had to stay
    /// unchecked.
    pub fn proved(&self) -> bool {
        self.claimed && !self.refuted() && self.unchecked().next().is_none()
    }

    pub(super) fn part(&mut self, title: impl Into<String>, findings: Findings) {
        self.parts.push((title.into(), findings));
    }
}

/// Verifies a result against a scene: the one inside it, or one that the reader trusts more.
///
/// # Errors
/// The scene cannot be resolved.
pub fn verify(
    file: &ResultFile,
    scene: &Scene,
    again: &dyn Recompute,
) -> Result<Verification, InputError> {
    Ok(verify_model(file, scene, &prepare(scene)?, again))
}

/// The same against a scene that is prepared already as `model`.
pub fn verify_model(
    file: &ResultFile,
    scene: &Scene,
    model: &Model,
    again: &dyn Recompute,
) -> Verification {
    let mut all = Verification {
        claimed: file.certificate.claim.is_some(),
        parts: vec![("scene".into(), counts(file, model))],
        scene: model.findings().cloned().collect(),
    };
    if file.left_out_contacts.is_some() || model.interfaces.left_out.is_some() {
        all.part("contacts left out", left_out::left_out(file, scene, model, again));
    }
    match file.question {
        QuestionKind::Assess | QuestionKind::Limit | QuestionKind::Simulate => {
            let (mut f, rates) =
                answer(again, model, file.question, &file.answer, &file.certificate, all.refuted());
            mechanism_words(&mut f, file, model, rates.as_deref());
            members(&mut f, file, model);
            follows(&mut f, &file.answer, file.dry.as_ref());
            all.part("answer", f);
            let stray = !file.directions.is_empty()
                || (file.question != QuestionKind::Limit && file.dead_load.is_some());
            if stray {
                all.part(
                    "form",
                    failure("the file holds answers to a question that was not asked"),
                );
            }
        }
        QuestionKind::Tilt => tilts(&mut all, file, model, again),
        QuestionKind::Critical => critical::verify(&mut all, file, scene, again),
        QuestionKind::Thrust => thrust::verify(&mut all, file, model, again),
        QuestionKind::Settle | QuestionKind::Push => path::verify(&mut all, file, model),
        QuestionKind::Kinematic => kinematic::verify(&mut all, file, scene, model, again),
        QuestionKind::Stages => stages::verify(&mut all, file, scene, model, again),
        QuestionKind::State => state::verify(&mut all, file, model, again),
        QuestionKind::Rock => rocking::verify(&mut all, file, scene, model, again),
        QuestionKind::Shake => shaken::verify(&mut all, file, scene, model, again),
        QuestionKind::Moving => moving::verify(&mut all, file, scene, model, again),
    }
    let strangers = [
        file.question != QuestionKind::Critical && file.critical.is_some(),
        file.question != QuestionKind::Thrust && file.thrust.is_some(),
        file.question != QuestionKind::Stages && file.stages.is_some(),
        file.question != QuestionKind::State && file.state.is_some(),
        file.question != QuestionKind::Rock && file.rocking.is_some(),
        file.question != QuestionKind::Shake && file.shaken.is_some(),
        !matches!(
            file.question,
            QuestionKind::Settle | QuestionKind::Push | QuestionKind::Kinematic
        ) && file.path.is_some(),
    ];
    if strangers.contains(&true) {
        all.part("form", failure("the file holds answers to a question that was not asked"));
    }
    if let Some(dead) = &file.dead_load {
        all.part(
            "dead load alone",
            answer(
                again,
                model,
                QuestionKind::Assess,
                &dead.answer,
                &dead.certificate,
                all.refuted(),
            )
            .0,
        );
    }
    let by_direction = matches!(
        file.question,
        QuestionKind::Tilt | QuestionKind::Kinematic | QuestionKind::Moving
    );
    if by_direction || file.question == QuestionKind::Limit {
        let (dead, mut f) =
            (file.dead_load.as_ref().and_then(|d| d.answer.verdict()), Findings::default());
        let said = file
            .directions
            .iter()
            .map(|d| &d.answer)
            .chain([&file.answer])
            .all(|a| a.verdict() == dead);
        require(&mut f, said, "the verdict beside it is that of the dead load alone");
        all.part("dead load alone", f);
    }
    if let Some(dry) = file.dry.as_ref().filter(|_| !by_direction) {
        let findings = match file.question {
            QuestionKind::Assess
            | QuestionKind::Simulate
            | QuestionKind::Critical
            | QuestionKind::Thrust
            | QuestionKind::Settle
            | QuestionKind::Stages
            | QuestionKind::State
            | QuestionKind::Rock
            | QuestionKind::Shake
            | QuestionKind::Push => failure("the file holds a load factor that was not asked for"),
            _ => again::dry_friction(
                again,
                &|_| Ok(model.clone()),
                (&file.answer, &file.certificate),
                dry,
                all.refuted(),
            ),
        };
        all.part("dry friction", findings);
        // A dead load that falls, as its own evidence says, is a claim where the bound makes none.
        all.claimed |= dry.found == Found::NotAtRest
            && file.dead_load.is_some()
            && file.answer.verdict() == Some(Verdict::Unstable);
    }
    if file.simulation.is_some() || file.question == QuestionKind::Simulate {
        all.part("simulation", simulation(file));
    }
    all
}

/// The words about a simulation agree with each other; that it went so is only known by repeating
/// it.
fn simulation(file: &ResultFile) -> Findings {
    let mut f = Findings::default();
    let Some(s) = &file.simulation else { return failure("the file holds no simulation") };
    let last = s.runs.last().map(|r| r.fate);
    require(
        &mut f,
        last.is_none_or(|fate| fate == s.fate)
            && file.answer.fate().is_none_or(|fate| fate == s.fate),
        "the outcome is that of the last run",
    );
    if let Some(a) = &s.agreement {
        let left_out = s.findings.iter().any(|f| f.code == FindingCode::LeftOut);
        require(
            &mut f,
            a.agrees == agree(a.verdict, a.fate, left_out),
            "whether they agree follows from the two",
        );
        require(
            &mut f,
            a.fate == s.fate && Some(a.verdict) == file.answer.verdict(),
            "it is compared with the verdict of this result",
        );
    }
    f.holds.push("observed, not proved: `voussoir simulate` on the scene repeats it".into());
    f
}

pub(super) fn failure(text: impl Into<String>) -> Findings {
    Findings { fails: vec![text.into()], ..Findings::default() }
}

pub(super) fn require(f: &mut Findings, ok: bool, text: impl Into<String>) {
    if ok { &mut f.holds } else { &mut f.fails }.push(text.into());
}

fn counts(file: &ResultFile, model: &Model) -> Findings {
    let mut f = Findings::default();
    let s = &file.scene;
    let supports = model.assembly.blocks.iter().filter(|b| b.support).count();
    let here = [
        model.assembly.blocks.len(),
        supports,
        model.interfaces.list.len(),
        model.contact_points(),
        model.interfaces.members.len(),
    ];
    let said = [s.blocks, s.supports, s.interfaces, s.contact_points, s.members];
    let words = |c: [usize; 5]| {
        let members = if c[4] > 0 { format!(", {} members", c[4]) } else { String::new() };
        format!(
            "{} blocks ({} supports), {} interfaces, {} contact points{members}",
            c[0], c[1], c[2], c[3]
        )
    };
    if here == said {
        f.holds.push(words(here));
    } else {
        f.fails.push(format!("the scene has {}; the result is about {}", words(here), words(said)));
    }
    if s.name != s.input.name {
        f.fails
            .push(format!("the scene is called {:?}, the result says {:?}", s.input.name, s.name));
    }
    f
}

/// The directions of a tilt, each with its turned loads, and the least of them as the answer.
fn tilts(all: &mut Verification, file: &ResultFile, model: &Model, again: &dyn Recompute) {
    let main = Direction {
        answer: file.answer.clone(),
        certificate: file.certificate.clone(),
        dry: file.dry.clone(),
    };
    let list =
        if file.directions.is_empty() { std::slice::from_ref(&main) } else { &file.directions };
    let least = (0..list.len())
        .min_by(|&i, &j| list[i].governing().total_cmp(&list[j].governing()))
        .unwrap_or(0);
    if !file.directions.is_empty() {
        let mut f = Findings::default();
        require(
            &mut f,
            main == list[least],
            format!("the answer is the least of {} directions, with its evidence", list.len()),
        );
        all.part("answer", f);
    }
    for (index, direction) in list.iter().enumerate() {
        let toward = direction.answer.toward().unwrap_or_default();
        let title = format!("tilt towards {}", base::number::point(toward));
        let load_factor = direction.answer.bound().and_then(|b| b.value);
        match tilted(model, Vector3::from(toward), load_factor) {
            Err(e) => all.part(title.clone(), failure(e.to_string())),
            Ok(turned) => {
                let (mut f, rates) = answer(
                    again,
                    &turned,
                    QuestionKind::Tilt,
                    &direction.answer,
                    &direction.certificate,
                    all.refuted(),
                );
                follows(&mut f, &direction.answer, direction.dry.as_ref());
                if index == least {
                    mechanism_words(&mut f, file, &turned, rates.as_deref());
                    members(&mut f, file, &turned);
                }
                all.part(title.clone(), f);
            }
        }
        if let Some(dry) = &direction.dry {
            let at = |tilt: f64| tilted(model, Vector3::from(toward), Some(tilt));
            let findings = again::dry_friction(
                again,
                &at,
                (&direction.answer, &direction.certificate),
                dry,
                all.refuted(),
            );
            all.part(format!("{title}, dry friction"), findings);
        }
    }
}

/// One answer with its evidence; gives back the rates where they could be read. What is refuted
/// already is not computed again.
pub(super) fn answer(
    again: &dyn Recompute,
    model: &Model,
    question: QuestionKind,
    answer: &Answer,
    evidence: &Certificate,
    refuted: bool,
) -> (Findings, Option<Vec<Rate>>) {
    let mut f = Findings::default();
    says_what_is_claimed(&mut f, question, answer, evidence.claim.as_ref());
    let assembly = &model.assembly;
    let read = || -> Result<(Forces, Option<Forces>, Vec<Rate>), String> {
        let (forces, base) = evidence.read(model)?;
        Ok((forces, base, read_rates(assembly, &evidence.rates)?))
    };
    let (forces, base, rates) = match read() {
        Ok(evidence) => evidence,
        Err(e) => {
            f.fails.push(e);
            return (f, None);
        }
    };
    if let Some(said) = answer.proof().filter(|_| evidence.claim.is_none()) {
        f.fails.push(format!("nothing is claimed, but said to be proved ({said})"));
    }
    if let Some(claim) = &evidence.claim {
        let claimed = claim::verify(
            model,
            claim,
            Evidence { forces: &forces, base: base.as_ref(), rates: &rates },
        );
        let said = answer.proof().unwrap_or(Grade::ToRounding(f64::INFINITY));
        require(
            &mut f,
            is_no_better(said, claimed.grade),
            format!("the proof is {}, the answer says {said}", claimed.grade),
        );
        f.grade = claimed.grade;
        f.holds.extend(claimed.holds);
        f.fails.extend(claimed.fails);
        if matches!(claim, Claim::Stable | Claim::Conditional | Claim::Unstable) {
            unbalance(&mut f, model, answer, &forces, &rates);
        }
        part::verify(&mut f, model, answer.part(), &rates);
        if matches!(claim, Claim::Stable) && !refuted {
            again::stands(again, &mut f, model, answer.as_verdict().and_then(|a| a.law));
        }
    }
    (f, Some(rates))
}

/// Whether a grade that was said is no better than the one recomputed.
pub(super) fn is_no_better(said: Grade, here: Grade) -> bool {
    match (said, here) {
        (_, Grade::Exact) => true,
        (Grade::Exact, Grade::ToRounding(_)) => false,
        // Rounding of another machine's arithmetic is no matter.
        (Grade::ToRounding(a), Grade::ToRounding(b)) => b <= 2.0 * a,
    }
}

/// Whether the bound on a load factor is what is claimed.
pub(super) fn bound_says(bound: &Bound, claim: Option<&Claim>) -> bool {
    let Bound { status, value: said, lower: low, upper: high } = *bound;
    match (status, claim) {
        (Outcome::Undecided, None) => true,
        (Outcome::Found, Some(&Claim::LoadFactor { value, lower, upper })) => {
            (said, low, high) == (Some(value), Some(lower), Some(upper))
        }
        (Outcome::Unbounded, Some(Claim::Unbounded { .. }))
        | (Outcome::Impossible, Some(Claim::Impossible)) => (said, low, high) == (None, None, None),
        _ => false,
    }
}

/// The words and numbers of an answer are those of its claim.
fn says_what_is_claimed(
    f: &mut Findings,
    question: QuestionKind,
    answer: &Answer,
    claim: Option<&Claim>,
) {
    let agrees = match (question, answer, claim) {
        (QuestionKind::Assess, Answer::Verdict(a), claim)
        | (QuestionKind::Simulate, Answer::Simulation(_, Some(a)), claim) => {
            if a.law.is_some() && claim != Some(&Claim::Stable) {
                f.fails.push(
                    "a law of sliding is named beside an answer that does not depend on it".into(),
                );
            }
            Some(a.verdict).filter(|v| *v != Verdict::Undecided) == claim.and_then(Claim::verdict)
                && claim.is_none_or(|c| c.verdict().is_some())
        }
        (QuestionKind::Simulate, Answer::Simulation(_, None), None) => {
            return f.holds.push("no verdict was asked for: nothing is claimed".into());
        }
        (QuestionKind::Limit, Answer::Limit(LimitAnswer { load_factor: l, .. }), claim)
        | (QuestionKind::Tilt, Answer::Tilt(TiltAnswer { tan_tilt: l, .. }), claim) => {
            bound_says(&l.associative, claim)
        }
        (QuestionKind::Moving, Answer::Moving(a), claim) => {
            bound_says(&a.load_factor.associative, claim)
        }
        (QuestionKind::Kinematic, Answer::Kinematic(a), claim) => {
            bound_says(&a.alpha0.associative, claim)
        }
        _ => return f.fails.push("the answer is not one to its question".into()),
    };
    if claim.is_none() && agrees {
        return f.holds.push("undecided: nothing is claimed".into());
    }
    let claim_words = match claim {
        None => "nothing".into(),
        Some(Claim::Stable) => "that it stands".into(),
        Some(Claim::Conditional) => "that it stands only with a pre-stress".into(),
        Some(Claim::Unstable) => "that it falls".into(),
        Some(Claim::LoadFactor { value, .. }) => format!("the load factor {value}"),
        Some(Claim::DryLoadFactor { value }) => {
            format!("the load factor {value} with dry friction")
        }
        Some(Claim::Unbounded { .. }) => "that the live load has no limit".into(),
        Some(Claim::Thrust { value, .. }) => format!("a thrust of {value} N"),
        Some(Claim::EndlessThrust { .. }) => "a thrust without end".into(),
        Some(Claim::MemberForce { value, .. }) => format!("a force of {value} N in a member"),
        Some(Claim::EndlessMemberForce { .. }) => "a force without end in a member".into(),
        Some(Claim::Impossible) => "that it falls whatever the live load".into(),
    };
    if agrees {
        f.holds.push(format!("the answer says what the certificate claims: {claim_words}"));
    } else {
        f.fails.push(format!("the answer does not say what the certificate claims: {claim_words}"));
    }
}

/// The load factor to use follows from the bound and what is known with dry friction; a tilt in
/// degrees is its arc tangent.
pub(super) fn follows(f: &mut Findings, answer: &Answer, dry: Option<&DryResult>) {
    let Some(said) = answer.load_factor() else { return };
    require(
        f,
        *said == LoadFactorAnswer::new(said.associative, dry),
        "the load factor to use follows from the bound and from dry friction",
    );
    if let Answer::Tilt(TiltAnswer { tan_tilt, tilt_deg, .. }) = answer {
        let (angle, numbers) = (tan_tilt.degrees(), |l: &LoadFactorAnswer| {
            let b = l.associative;
            [l.value, l.lower, l.upper, b.value, b.lower, b.upper]
        });
        let near = |(a, b): (Option<f64>, Option<f64>)| {
            a == b || a.zip(b).is_some_and(|(a, b)| (a - b).abs() <= 1e-9)
        };
        let rest = |l: &LoadFactorAnswer| (l.status, l.law, l.found, l.associative.status);
        let same = numbers(&angle).into_iter().zip(numbers(tilt_deg)).all(near)
            && rest(&angle) == rest(tilt_deg);
        require(f, same, "the tilt is the arc tangent of the load factor");
    }
}

/// The bracket of the unbalance is the one that the evidence gives.
fn unbalance(f: &mut Findings, model: &Model, answer: &Answer, forces: &Forces, rates: &[Rate]) {
    let Some(VerdictAnswer { unbalance: said, .. }) = answer.as_verdict() else { return };
    // Part by part, in units in which nothing over- or underflows.
    let parts = interface::parts(model);
    let left =
        |part: &Part| certificate::statics(&part.model, &part.take_forces(forces), 0.0).unbalance;
    let upper = parts.iter().map(left).fold(0.0, f64::max);
    let rates = &certificate::at_unit_speed(&model.assembly, rates)[..];
    let k = match claim::moving(model, forces, rates) {
        Some((part, own, rates)) => certificate::kinematics(&part.model, &rates, &own),
        None => certificate::kinematics(model, rates, forces),
    };
    let (lower, slack) =
        if k.norm > 0.0 { (k.gain().max(0.0) / k.norm, k.slack / k.norm) } else { (0.0, 0.0) };
    // Rates that prove nothing because they part what is pressed together bound nothing: the lower
    // end is then 0.
    let near = |a: f64, b: f64, extra: f64| {
        (a - b).abs() <= tolerance::SAVED * a.abs() + tolerance::UNBALANCE + extra
    };
    let ok = near(upper, said.upper, 0.0) && (near(lower, said.lower, slack) || said.lower == 0.0);
    require(
        f,
        ok,
        format!(
            "least unbalance between {:.3e} and {:.3e} g, recomputed between {lower:.3e} and {upper:.3e} g",
            said.lower, said.upper
        ),
    );
}

/// Whether the joints of two mechanisms lie in the same places: every one of the first next to one
/// of the second that moves alike between the same blocks, and the other way round.
fn places_agree(model: &Model, said: &MechanismWords, here: &MechanismWords) -> bool {
    let sizes: HashMap<&str, f64> =
        model.assembly.blocks.iter().map(|b| (b.id.as_str(), b.size)).collect();
    let near = |a: &JointWords, b: &JointWords| {
        let size =
            a.between.iter().filter_map(|id| sizes.get(id.as_str())).copied().fold(0.0, f64::max);
        (Vector3::from(a.at) - Vector3::from(b.at)).norm() <= tolerance::SAVED * size
    };
    let by_joint = |w: &'_ MechanismWords| {
        let mut map: BTreeMap<_, Vec<JointWords>> = BTreeMap::new();
        w.joints
            .iter()
            .for_each(|j| map.entry((j.between.clone(), j.motion)).or_default().push(j.clone()));
        map
    };
    let (said, here) = (by_joint(said), by_joint(here));
    let all = |a: &[JointWords], b: &[JointWords]| a.iter().all(|j| b.iter().any(|k| near(j, k)));
    said.len() == here.len()
        && said
            .iter()
            .zip(&here)
            .all(|((s, a), (h, b))| s == h && a.len() == b.len() && all(a, b) && all(b, a))
}

/// The forces in the members are those of the evidence.
pub(super) fn members(f: &mut Findings, file: &ResultFile, model: &Model) {
    if model.interfaces.members.is_empty() && file.members.is_empty() {
        return;
    }
    let Ok((forces, _)) = file.certificate.read(model) else { return };
    let here = member::lines(model, &forces);
    require(
        f,
        member::agree(&here, &file.members),
        format!("the forces in {} members are those of the evidence", here.len()),
    );
}

/// The mechanism in words is the one of the rates.
pub(super) fn mechanism_words(
    f: &mut Findings,
    file: &ResultFile,
    model: &Model,
    rates: Option<&[Rate]>,
) {
    let (Some(said), Some(rates)) = (&file.mechanism, rates) else { return };
    let here = MechanismWords::new(model, &mechanism::read(model, rates));
    let moving = |w: &MechanismWords| w.moving.iter().cloned().collect::<BTreeSet<String>>();
    require(
        f,
        moving(said) == moving(&here)
            && places_agree(model, said, &here)
            && said.members.iter().collect::<BTreeSet<_>>() == here.members.iter().collect(),
        format!(
            "the mechanism in words is that of the rates: {} blocks move, {} joints",
            here.moving.len(),
            here.joints.len()
        ),
    );
}
