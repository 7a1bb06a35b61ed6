//! What was asked, and what the number of the answer means.

use base::number::{bracketed, count, ends, fixed, short};
use check::question::QuestionKind as Kind;
use check::{
    proof::{result::ResultFile, state::StateAnswer},
    terms::Law,
};

/// The question in words, its number with unit and meaning, and the law of sliding.
pub(super) fn facts(file: &ResultFile) -> Vec<[String; 2]> {
    let (question, unit) = match file.stages.as_ref().and_then(|s| s.order.as_ref()) {
        Some(order) => ordered(order.given),
        None => words(file.question.kind()),
    };
    let mut list: Vec<[String; 2]> = vec![["question".into(), question.into()]];
    if let Some(value) = value(file) {
        list.push(["answer".into(), value]);
    }
    if !unit.is_empty() {
        list.push(["meaning".into(), unit.into()]);
    }
    if let Some(law) = law(file) {
        list.push(["sliding".into(), law.into()]);
    }
    let s = &file.scene.counts;
    list.push([
        "of".into(),
        format!(
            "{} ({}), {}{}",
            count(s.blocks, "block"),
            count(s.supports, "support"),
            count(s.interfaces, "joint"),
            if s.members > 0 { format!(", {}", count(s.members, "member")) } else { String::new() }
        ),
    ]);
    list
}

/// The number with its bracket, where there is one.
fn value(file: &ResultFile) -> Option<String> {
    if let Some(state) = file.answer.state() {
        return yields(state);
    }
    let said = file.answer.load_factor()?;
    let (value, lower, upper) = (said.value?, said.lower?, said.upper?);
    let (text, unit) = match file.question.kind() {
        Kind::Tilt => {
            let [v, l, u] = [value, lower, upper].map(|t| t.atan().to_degrees());
            let [low, high] = ends(v, l, u);
            (format!("{} (between {low} and {high})", bracketed(v, l, u)), "°")
        }
        _ => {
            let [low, high] = ends(value, lower, upper);
            (format!("{} (between {low} and {high})", bracketed(value, lower, upper)), "")
        }
    };
    let name = match file.question.kind() {
        Kind::Tilt => "tilt",
        Kind::Kinematic => "α0",
        _ => "λ",
    };
    Some(match unit {
        "" => format!("{name} = {text}, a number without a unit"),
        unit => format!("{name} = {text}, in {unit}"),
    })
}

/// How far the path of a state goes, or how far blocks move.
fn yields(state: &StateAnswer) -> Option<String> {
    let greatest = state.greatest.as_ref()?;
    let moved = format!(
        "displacement of up to {} m under the dead load, of {}",
        short(greatest.displacement),
        greatest.block
    );
    Some(match state.load_factor.and_then(|l| Some((l.value?, l.slides))) {
        None => moved,
        Some((value, true)) => {
            format!(
                "λ = {} along the path, the greatest at which a state was found; {moved}",
                fixed(value, 6)
            )
        }
        Some((value, false)) => {
            format!("λ = {} along the path, the proved bound; {moved}", fixed(value, 6))
        }
    })
}

/// Of an order in which blocks are placed.
fn ordered(given: bool) -> (&'static str, &'static str) {
    let question = match given {
        true => "How many blocks have to be held at a time to build it in the order given?",
        false => "In which order can it be built with as few blocks held at a time as can be?",
    };
    (
        question,
        "Every stage is a scene of its own, with its own verdict and proof. That fewer held do not do \
         is the outcome of a search, not of a proof.",
    )
}

/// The question, and what its number is.
fn words(kind: Kind) -> (&'static str, &'static str) {
    match kind {
        Kind::Assess => (
            "Does it stand under its weight and the dead loads listed below?",
            "It stands where contact forces that press, inside the friction cones and within the \
             strengths given, balance every block, and the loads produce such forces by themselves.",
        ),
        Kind::Limit => (
            "By how much may the live loads listed below be multiplied until it falls?",
            "λ multiplies all live loads together; weights and dead loads stay as they are. λ = 1 is \
             the live loads as listed; the scene falls where λ goes beyond the value above.",
        ),
        Kind::Moving => (
            "By how much may the axle loads be multiplied, wherever the train stands?",
            "λ multiplies the axle loads of the train at its worst position; weights, fill and dead \
             loads stay as they are.",
        ),
        Kind::Tilt | Kind::Repose => (
            "At what inclination of the ground does it fall?",
            "Gravity keeps its size and is turned by this angle towards the direction given; weights \
             and dead loads turn with it.",
        ),
        Kind::Critical => (
            "At what value of a number of the scene does the verdict flip?",
            "On either side of each value the verdict is proved for a scene with that number.",
        ),
        Kind::Thrust => (
            "How hard does it push a support (or pull a member), at least and at most?",
            "Newtons along the direction named. Statics alone leaves every value between the ends \
             possible; settlements and history decide which one acts.",
        ),
        Kind::Simulate => (
            "What happens in time?",
            "Computed by a rigid-body simulation, not proved; the verdict beside it is.",
        ),
        Kind::Settle => (
            "How far may supports move until it falls?",
            "A share of the movement given, and metres.",
        ),
        Kind::Push => (
            "How does the load factor change as it moves?",
            "λ multiplies the live loads; the way is that of the control point, in metres.",
        ),
        Kind::Kinematic => (
            "At what horizontal acceleration does a mechanism start to move?",
            "α0 is the horizontal push on every mass, as a multiple of its weight, at which the worst \
             mechanism begins.",
        ),
        Kind::Stages => (
            "Does every stage of the construction stand?",
            "Every stage is a scene of its own, with its own verdict and proof.",
        ),
        Kind::State => (
            "Which forces and displacements follow from the stiffness of its joints?",
            "Computed from the stiffnesses listed, with friction followed along the load; that the \
             forces are admissible is proved.",
        ),
        Kind::Rock => (
            "What does its mechanism do on ground that moves?",
            "Integrated as a machine of one degree of freedom from the mechanism that is proved.",
        ),
        Kind::Shake => (
            "What do all its blocks do on ground that moves?",
            "One history of a rigid-body simulation, not proved: ways of the centres of mass over the \
             thickness of their blocks.",
        ),
    }
}

/// For which law of sliding the answer holds.
fn law(file: &ResultFile) -> Option<&'static str> {
    let law = match (file.answer.load_factor(), file.answer.as_verdict()) {
        (Some(said), _) => said.law,
        (None, Some(said)) => said.law?,
        (None, None) => return None,
    };
    Some(match law {
        Law::Coulomb => "dry friction: joints slide without opening (Coulomb)",
        Law::Associative => {
            "joints open by μ times their slip as they slide (associative): with dry friction the \
             answer can be less favourable, never more"
        }
    })
}
