//! At what value of a number in the scene what is required of a question is met.
//!
//! The range is scanned; between neighbours of which one meets what is required and the other does not,
//! the change is narrowed by what each obtains beyond it (regula falsi with halvings, so that both ends
//! close in). Every end is an answer with its own proof.

use super::{
    Control,
    answer::{Door, Met, Probe},
    saved::of,
};
use base::{
    error::{InputError, JsonPath},
    tolerance,
};
use check::{proof::meet::MeetPoint, question::MeetOptions};
use model::interface::prepare_until;
use scene::Scene;

/// Scenes asked to narrow a change. A well-behaved one takes some eight, halving some twenty.
const MOST: usize = 40;
/// Every so many steps the range is halved, whatever the values say. More: a kink holds one end fast.
/// Fewer: a straight line takes longer.
const HALVE: usize = 3;
/// A step lies this share of the width that is left beyond the zero of the straight line, by turns on
/// either side, so that both ends close in. More: the last steps stay wide. Less: rounding.
const BEYOND: f64 = 0.4;

/// Asks at a value.
type Ask<'a> = dyn FnMut(f64) -> Result<Probe, InputError> + 'a;

/// Scans the range and narrows every change.
///
/// # Errors
/// The pointer names no number, or no value of the scan makes a scene with an answer.
pub(super) fn meet(
    o: &MeetOptions,
    scene: &Scene,
    control: &Control,
    door: Door,
) -> Result<Met, InputError> {
    let range = o.range();
    let [from, to] = o.between;
    scene.with_field(&o.vary, from).or_else(|e| scene.with_field(&o.vary, to).map_err(|_| e))?;
    let whole = range.is_whole(scene);
    let mut probes = 0;
    let mut ask = |value: f64| -> Result<Probe, InputError> {
        if probes > 0 && control.deadline.is_over() {
            return Err(InputError::at(JsonPath::root(), "time limit reached"));
        }
        probes += 1;
        control.doing(|| format!("value {probes}: {value}"));
        let scene = scene.with_field(&o.vary, value)?;
        let model = prepare_until(&scene, &|| control.deadline.is_over())?;
        let answer = door(&o.ask, &scene, &model, control)?;
        let file = of(&o.ask, &scene, &model, &answer)?;
        Ok(Probe { value, model, answer, file })
    };
    let (mut scan, mut sides, mut no_scene) = (Vec::new(), Vec::new(), Vec::new());
    let (mut last, mut error): (Option<Probe>, Option<InputError>) = (None, None);
    let mut ends: Vec<Probe> = Vec::new();
    for value in range.values(whole) {
        if !scan.is_empty() && control.deadline.is_over() {
            break;
        }
        let here = match ask(value) {
            Ok(probe) => probe,
            Err(e) => {
                scan.push(MeetPoint { value, met: None, obtained: None });
                no_scene.push((value, e.to_string()));
                error.get_or_insert(e);
                last = None;
                continue;
            }
        };
        scan.push(here.point());
        let differs = |b: &Probe| b.met().zip(here.met()).is_some_and(|(a, b)| a != b);
        if let Some(before) = last.filter(differs) {
            sides.push(narrow(before, here.clone(), whole, &mut ask));
        }
        ends.truncate(1);
        ends.push(here.clone());
        last = Some(here);
    }
    match (ends.pop(), ends.pop(), error) {
        (None, _, Some(error)) => return Err(error),
        (Some(end), Some(first), _) if sides.is_empty() => sides.push([first, end]),
        _ => {}
    }
    for side in &mut sides {
        side.sort_by(|a, b| a.value.total_cmp(&b.value));
    }
    Ok(Met { scan, sides, no_scene, probes })
}

/// Both sides of a change, as near to each other as values are told apart.
fn narrow(mut a: Probe, mut b: Probe, whole: bool, ask: &mut Ask) -> [Probe; 2] {
    let least = tolerance::MEET_WIDTH * a.value.abs().max(b.value.abs());
    for step in 1..=MOST {
        let width = b.value - a.value;
        if width.abs() <= if whole { 1.0 } else { least } {
            break;
        }
        let over = BEYOND * least / width.abs();
        let share = match (a.beyond(), b.beyond()) {
            (Some(p), Some(q)) if p * q < 0.0 && step % HALVE != 0 => {
                let turn = if step % 2 == 0 { -over } else { over };
                (p / (p - q) + turn).clamp(over, 1.0 - over)
            }
            _ => 0.5,
        };
        let value = a.value + share * width;
        let inside = |v: f64| v.clamp(a.value.min(b.value) + 1.0, a.value.max(b.value) - 1.0);
        let value = if whole { inside(value.round()) } else { value };
        if value == a.value || value == b.value {
            break;
        }
        let Ok(probe) = ask(value) else { break };
        match probe.met() {
            None => break,
            met if met == a.met() => a = probe,
            _ => b = probe,
        }
    }
    [a, b]
}
