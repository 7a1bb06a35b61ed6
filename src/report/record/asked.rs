//! What was asked, and what the number of the answer means.

use crate::tell::{required, telling};
use base::number::{bracketed, count, ends, fixed, short};
use check::{
    proof::{result::ResultFile, state::StateAnswer},
    terms::Law,
};

/// The question in words, its number with unit and meaning, and what is required of it.
pub(super) fn facts(file: &ResultFile) -> Vec<[String; 2]> {
    let [question, unit] = (telling(file).asked)(file);
    let mut list: Vec<[String; 2]> = vec![["question".into(), question.into()]];
    if let Some(value) = value(file) {
        list.push(["answer".into(), value]);
    }
    if !unit.is_empty() {
        list.push(["meaning".into(), unit.into()]);
    }
    if let Some(words) = required(file) {
        let least = words.trim_start_matches("required ");
        list.push(["requirement".into(), format!("at least {least}")]);
    }
    let s = &file.scene.counts;
    list.push([
        "model".into(),
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
    let words = telling(file).factor?;
    let (text, unit) = match words.tilt {
        true => {
            let [v, l, u] = [value, lower, upper].map(|t| t.atan().to_degrees());
            let [low, high] = ends(v, l, u);
            (format!("{} (between {low} and {high})", bracketed(v, l, u)), "°")
        }
        false => {
            let [low, high] = ends(value, lower, upper);
            (format!("{} (between {low} and {high})", bracketed(value, lower, upper)), "")
        }
    };
    let name = words.name;
    Some(match unit {
        "" => format!("{name} = {text}, dimensionless"),
        unit => format!("{name} = {text}, in {unit}"),
    })
}

/// How far the path of a state goes, or how far blocks move.
fn yields(state: &StateAnswer) -> Option<String> {
    let greatest = state.greatest.as_ref()?;
    let moved = format!(
        "displacement of up to {} m under the dead load, at {}",
        short(greatest.displacement),
        greatest.block
    );
    Some(match state.load_factor.and_then(|l| Some((l.value?, l.slides))) {
        None => moved,
        Some((value, true)) => {
            format!(
                "λ = {} along the path, the greatest at which equilibrium was found; {moved}",
                fixed(value, 6)
            )
        }
        Some((value, false)) => {
            format!("λ = {} along the path, the proved bound; {moved}", fixed(value, 6))
        }
    })
}

/// For which law of sliding the answer holds.
pub(super) fn law(file: &ResultFile) -> Option<&'static str> {
    let law = match (file.answer.load_factor(), file.answer.as_verdict()) {
        (Some(said), _) => said.law,
        (None, Some(said)) => said.law?,
        (None, None) => return None,
    };
    Some(match law {
        Law::Coulomb => "dry friction: joints slide without opening (Coulomb)",
        Law::Associative => {
            "joints that slide open as well, by μ × their slip (associative): with dry friction the \
             answer can be less favourable, never more"
        }
    })
}
