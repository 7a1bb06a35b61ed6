//! Results of `meet`: values of a number at which what is required is met, beside values at which it is
//! not, each with its own proof.

use super::{
    answer::{Answer, Nested, Quantity},
    derive::{Derivation, require},
    evidence::NestedEvidence,
    told::Told,
};
use crate::{question::MeetOptions, verdict::claim::Findings};
use base::tolerance;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_with::skip_serializing_none;
use std::sync::Arc;

/// Of `meet`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MeetEvidence {
    /// The scan. Computed.
    pub scan: Vec<MeetPoint>,
    /// Both sides of every change, the lower value first; without one the ends of the range.
    pub sides: Vec<[MeetSide; 2]>,
}

/// A value of the scan. Computed.
#[skip_serializing_none]
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MeetPoint {
    /// The value.
    pub value: f64,
    /// Whether what is required is met; absent where that is open, or there is no scene.
    pub met: Option<bool>,
    /// What is obtained of it.
    pub obtained: Option<f64>,
}

/// Of the answer at a value.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MeetSide {
    /// The value.
    pub value: f64,
    /// Of its answer.
    pub own: NestedEvidence,
}

/// Where what is required is met.
#[skip_serializing_none]
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct MeetAnswer {
    /// JSON pointer of the number that varies.
    pub vary: String,
    /// The range.
    pub between: [f64; 2],
    /// What is required, of what.
    pub required: Option<(Quantity, f64)>,
    /// The changes, in the order of the scan.
    pub changes: Vec<MeetChange>,
    /// Without a change: whether it is met throughout; absent where that is open.
    pub throughout: Option<bool>,
    /// Whether the scan reached the other end.
    pub complete: bool,
    /// The scan: computed, not proved.
    pub scan: Vec<MeetPoint>,
}

/// A change between two values, each proved.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct MeetChange {
    /// The value at which what is required is met.
    pub met_at: f64,
    /// The answer there.
    pub met: Nested,
    /// The value beside it at which it is not.
    pub not_met_at: f64,
    /// The answer there.
    pub not_met: Nested,
}

/// Every side is made anew, and its answer derived there.
pub(super) fn derive(
    d: &mut Derivation,
    o: &MeetOptions,
    e: &MeetEvidence,
) -> Result<Told, String> {
    let range = o.range();
    let values = range.values(range.is_whole(d.scene));
    let near =
        |a: f64, b: f64| (a - b).abs() <= tolerance::SAVED * (o.between[1] - o.between[0]).abs();
    let fits =
        e.scan.len() <= values.len() && e.scan.iter().zip(&values).all(|(s, v)| near(s.value, *v));
    if !fits {
        return Err("the scan does not match the question".into());
    }
    let (mut changes, mut ends, mut required) = (Vec::new(), Vec::new(), None);
    let [low, high] = [o.between[0].min(o.between[1]), o.between[0].max(o.between[1])];
    let mut f = Findings::default();
    for sides in &e.sides {
        let [a, b] = [side(d, o, &sides[0])?, side(d, o, &sides[1])?];
        for r in [&a, &b].into_iter().filter_map(|n| n.required) {
            required = Some((r.quantity, r.least));
        }
        let inside = sides.iter().all(|s| low <= s.value && s.value <= high);
        require(
            &mut f,
            inside,
            format!("{} and {} lie in the range", sides[0].value, sides[1].value),
        );
        let [at, beside] = [sides[0].value, sides[1].value];
        match (a.holds(), b.holds()) {
            (Some(true), Some(false)) => {
                changes.push(MeetChange { met_at: at, met: a, not_met_at: beside, not_met: b });
            }
            (Some(false), Some(true)) => {
                changes.push(MeetChange { met_at: beside, met: b, not_met_at: at, not_met: a });
            }
            (a, b) => ends.push((a, b)),
        }
    }
    // What is scanned agrees with what is proved at the same value.
    let proved = |v: f64| {
        let of = |c: &MeetChange| [(c.met_at, true), (c.not_met_at, false)];
        changes.iter().flat_map(of).filter(move |(at, _)| *at == v).map(|(_, met)| met)
    };
    let agrees =
        e.scan.iter().all(|s| proved(s.value).all(|met| s.met.is_none_or(|said| said == met)));
    let text = format!("the scan agrees with the proofs ({} values, computed)", e.scan.len());
    require(&mut f, agrees, text);
    f.computed = true;
    let complete = e.scan.len() == values.len();
    let first = e.scan.first().and_then(|s| s.met);
    let same = complete && first.is_some() && e.scan.iter().all(|s| s.met == first);
    let throughout = match (&changes[..], &ends[..]) {
        ([], [(a, b)]) if same && *a == first && *b == first => first,
        _ => None,
    };
    d.part("answer", f);
    scan_again(d, o, e);
    d.check.claimed = !changes.is_empty() || throughout.is_some();
    let answer = MeetAnswer {
        vary: o.vary.clone(),
        between: o.between,
        required,
        changes,
        throughout,
        complete,
        scan: e.scan.clone(),
    };
    Ok(Told::new(d.model, Answer::Meet(Box::new(answer)), &Arc::default()))
}

/// The values of the scan that have no evidence are asked again.
fn scan_again(d: &mut Derivation, o: &MeetOptions, e: &MeetEvidence) {
    if !d.asks_again() {
        return;
    }
    let mut f = Findings { computed: true, ..Findings::default() };
    let has_proof = |s: &&MeetPoint| e.sides.iter().flatten().any(|side| side.value == s.value);
    let rest: Vec<&MeetPoint> = e.scan.iter().filter(|s| !has_proof(s)).collect();
    let mut otherwise = 0;
    for said in &rest {
        let here = match d.scene.with_field(&o.vary, said.value) {
            Ok(scene) => d.again.met(&o.ask, &scene),
            Err(e) => Some(Err(e)),
        };
        let is_so = match here {
            None => {
                f.unchecked.push(format!("the answers at {} values of the scan", rest.len()));
                return d.part("scan", f);
            }
            Some(Err(_)) => said.met.is_none(),
            Some(Ok((met, obtained))) => {
                let near = |(a, b): (f64, f64)| (a - b).abs() <= SCANNED * a.abs().max(b.abs());
                let open = said.met.is_none() || met.is_none();
                open || (met == said.met && obtained.zip(said.obtained).is_none_or(near))
            }
        };
        otherwise += usize::from(!is_so);
    }
    let count = rest.len();
    let text = format!("{count} values computed again (not proved), {otherwise} of them otherwise");
    require(&mut f, otherwise == 0, text);
    d.part("scan", f);
}

/// What is obtained at a value of the scan agrees on two machines to this × itself. Larger: changed
/// digits pass. Smaller: values with dry friction, known to 1e-5, differ.
const SCANNED: f64 = 1e-4;

/// The answer at a value.
fn side(d: &mut Derivation, o: &MeetOptions, e: &MeetSide) -> Result<Nested, String> {
    let title = format!("{} = {}", o.vary, e.value);
    let make = || {
        let scene = d.scene.with_field(&o.vary, e.value)?;
        let model = model::interface::prepare(&scene)?;
        Ok((scene, model))
    };
    let made: Result<_, base::error::InputError> = make();
    let (scene, model) = made.map_err(|e| format!("{title}: {e}"))?;
    d.nested(&title, &o.ask, (&scene, &model), &e.own)
}
