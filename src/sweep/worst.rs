//! The worst case within ranges, and why it is the worst.
//!
//! * **Friction**: the lowest. A force inside the cone of a small coefficient lies inside that of
//!   every larger one, so whatever balances at the lowest coefficient balances at all, and no load
//!   factor (associative) grows as friction falls.
//! * **Densities and dead loads**: the worst corner, found by asking at every one. Loads are linear
//!   in each of them, so the loads at any point of the box are a mixture of those at its corners (a
//!   multi-affine map takes a box into the convex hull of its corners' images), and the same
//!   mixture of the corners' forces is admissible, cones and strengths being convex, and balances
//!   them. What stands at every corner therefore stands between, and the associative load factor of
//!   live forces is a concave function, least at a corner.
//! * **Other numbers**, by JSON pointer: both ends are asked, and nothing is known between them.
//!
//! The argument is about the existence of forces. The state under dry friction is computed at the
//! corners alone.

use super::{RowAnswer, RowStatus, pointer::Pointer};
use analysis::{Control, Law, Question, ask};
use base::error::{InputError, JsonPath};
use model::interface::prepare;
use scene::{Friction, Load, Scene};
use std::{fmt, str::FromStr};

/// A number that lies between two ends.
#[derive(Clone, Debug, PartialEq)]
pub struct Between {
    /// `friction`, `density`, `density:NAME`, `load`, or a JSON pointer.
    pub name: String,
    /// Lower end.
    pub low: f64,
    /// Upper end.
    pub high: f64,
}

impl FromStr for Between {
    type Err = String;
    fn from_str(text: &str) -> Result<Self, String> {
        const FORM: &str = "not of the form NAME=LOW..HIGH, such as friction=0.5..0.7";
        let (name, ends) = text.rsplit_once('=').ok_or(FORM)?;
        let (low, high) = ends.split_once("..").ok_or(FORM)?;
        let number = |t: &str| t.trim().parse::<f64>().ok().filter(|v| v.is_finite()).ok_or(FORM);
        let range = Self { name: name.trim().to_string(), low: number(low)?, high: number(high)? };
        if range.low > range.high {
            return Err(format!("the range from {} to {} is empty", range.low, range.high));
        }
        Ok(range)
    }
}

impl fmt::Display for Between {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{}={}..{}", self.name, self.low, self.high)
    }
}

/// The worst case.
#[derive(Clone, Debug)]
pub struct Worst {
    /// The scene there.
    pub scene: Scene,
    /// Which values it has, and why no others are worse.
    pub argument: Vec<String>,
    /// Corners that were asked.
    pub corners: usize,
}

/// So many corners are asked at most: ten numbers with two ends each.
const MOST_NUMBERS: usize = 10;

/// A number with two ends.
struct Ends {
    label: String,
    what: What,
    low: f64,
    high: f64,
}

enum What {
    Material(String),
    Block(usize),
    Load,
    Pointer(Pointer),
}

/// The worst case for a verdict or a load factor of a scene whose numbers lie within `ranges`.
///
/// # Errors
/// A range names nothing in the scene, or a corner is no scene that can be asked about.
pub fn worst(
    scene: &Scene,
    ranges: &[Between],
    asked: &Question,
    control: &Control,
) -> Result<Worst, InputError> {
    let mut base = scene.clone();
    let mut argument = Vec::new();
    let mut ends = Vec::new();
    for (i, range) in ranges.iter().enumerate() {
        if ranges[..i].iter().any(|r| r.name == range.name) {
            return Err(refuse(range, "is given twice").hint("keep one of them"));
        }
        match range.name.as_str() {
            "friction" => argument.push(lowest_friction(&mut base, range, asked.law())?),
            _ => ends.extend(numbers(scene, range)?),
        }
    }
    if ends.len() > MOST_NUMBERS {
        let message = format!(
            "--worst: {} numbers have 2^{} corners, more than 2^{MOST_NUMBERS}",
            ends.len(),
            ends.len()
        );
        return Err(InputError::at(JsonPath::root(), message)
            .hint("name single materials: density:NAME=LOW..HIGH"));
    }
    let corners = 1_usize << ends.len();
    let mut worst: Option<(Scene, RowAnswer, usize)> = None;
    for corner in 0..corners {
        let scene = at_corner(&base, &ends, corner)?;
        if corners == 1 {
            return Ok(Worst { scene, argument, corners });
        }
        let model = prepare(&scene)?;
        let answer = RowAnswer::of_answer(&ask(&asked.for_one_number(), &scene, &model, control)?);
        if worst.as_ref().is_none_or(|(_, least, _)| height(&answer) < height(least)) {
            worst = Some((scene, answer, corner));
        }
    }
    let Some((worst, _, corner)) = worst else {
        return Ok(Worst { scene: base, argument, corners });
    };
    let values: Vec<String> =
        ends.iter().enumerate().map(|(k, e)| format!("{} {}", e.label, e.at(corner, k))).collect();
    argument.push(format!(
        "the worst of {corners} corners, all of them computed: {}",
        values.join(", ")
    ));
    argument.push(between(scene, &ends, asked));
    Ok(Worst { scene: worst, argument, corners })
}

fn refuse(range: &Between, message: &str) -> InputError {
    InputError::at(JsonPath::root(), format!("--worst {range}: {message}"))
}

fn lowest_friction(scene: &mut Scene, range: &Between, law: Law) -> Result<String, InputError> {
    if range.low < 0.0 {
        return Err(refuse(range, "a coefficient of friction must not be negative"));
    }
    scene.joints.default.friction = Some(Friction::Coefficient(range.low));
    scene.joints.default.friction_angle_deg = None;
    let own = scene
        .joints
        .overrides
        .iter()
        .filter(|o| o.friction.is_some() || o.friction_angle_deg.is_some())
        .count();
    let given = scene.interfaces.iter().filter(|i| i.friction.is_some()).count();
    let mut text = format!(
        "friction {}, the lowest, is the worst: every force that is admissible there is admissible at a higher value",
        range.low
    );
    if law == Law::Coulomb {
        text.push_str("; the state under dry friction is computed for this value only");
    }
    if own + given > 0 {
        text.push_str(&format!(" ({} with their own friction keep it)", own + given));
    }
    Ok(text)
}

/// The numbers of the scene that a range is about.
fn numbers(scene: &Scene, range: &Between) -> Result<Vec<Ends>, InputError> {
    let ends = |label: String, what: What| Ends { label, what, low: range.low, high: range.high };
    let name = range.name.as_str();
    if let Some(material) =
        name.strip_prefix("density:").filter(|m| !scene.materials.contains_key(*m))
    {
        let error = refuse(range, &format!("no material is called {material:?}"));
        return Err(InputError {
            hint: scene::suggest(material, scene.materials.keys().map(String::as_str)),
            ..error
        });
    }
    let list = match name {
        "load" if scene.loads.dead.is_empty() => {
            return Err(refuse(range, "the scene has no dead load besides the weights")
                .hint("`load` is a factor on \"loads\".\"dead\""));
        }
        "load" => vec![ends("factor on the dead loads".into(), What::Load)],
        _ if name == "density" || name.starts_with("density:") => {
            let wanted = |m: &str| name == "density" || name == format!("density:{m}");
            let materials = scene
                .materials
                .keys()
                .filter(|m| wanted(m))
                .map(|m| ends(format!("density of {m}"), What::Material(m.clone())));
            let blocks = scene
                .blocks
                .iter()
                .enumerate()
                .filter(|(_, b)| name == "density" && b.density.is_some());
            let list: Vec<Ends> = materials
                .chain(blocks.map(|(i, b)| ends(format!("density of {}", b.id), What::Block(i))))
                .collect();
            if list.is_empty() {
                return Err(refuse(
                    range,
                    "the scene gives no density: all blocks have the same one, whose value has no effect",
                )
                .hint("give blocks a material, \"materials\": { … }"));
            }
            list
        }
        _ if name.starts_with('/') => {
            let pointer = Pointer::find(name, &as_json(scene)?).map_err(|e| InputError {
                message: format!("--worst {range}: {}", e.message),
                ..e
            })?;
            vec![ends(name.to_string(), What::Pointer(pointer))]
        }
        _ => {
            return Err(
                refuse(range, "unknown name").hint("the names are friction, density, density:NAME, load, and JSON pointers (/loads/dead/0/force/2)")
            );
        }
    };
    if list.iter().any(|e| matches!(e.what, What::Material(_) | What::Block(_))) && range.low <= 0.0
    {
        return Err(refuse(range, "a density must be above 0"));
    }
    Ok(list)
}

fn as_json(scene: &Scene) -> Result<serde_json::Value, InputError> {
    scene.to_value().map_err(|e| InputError::at(JsonPath::root(), e.to_string()))
}

impl Ends {
    fn at(&self, corner: usize, k: usize) -> f64 {
        if corner >> k & 1 == 0 { self.low } else { self.high }
    }
}

fn at_corner(base: &Scene, ends: &[Ends], corner: usize) -> Result<Scene, InputError> {
    let mut scene = base.clone();
    for (k, end) in ends.iter().enumerate() {
        let value = end.at(corner, k);
        match &end.what {
            What::Material(name) => {
                if let Some(material) = scene.materials.get_mut(name) {
                    material.density = value;
                }
            }
            What::Block(i) => {
                if let Some(block) = scene.blocks.get_mut(*i) {
                    block.density = Some(value);
                }
            }
            What::Load => scene.loads.dead.iter_mut().for_each(|load| scale(load, value)),
            What::Pointer(pointer) => {
                let mut json = as_json(&scene)?;
                pointer.set(&mut json, &value.into());
                scene = Scene::from_value(json).map_err(|e| {
                    InputError::at(
                        JsonPath::root(),
                        format!("--worst: {} = {value} gives no valid scene: {e}", end.label),
                    )
                })?;
            }
        }
    }
    Ok(scene)
}

fn scale(load: &mut Load, by: f64) {
    for vector in [&mut load.force, &mut load.moment, &mut load.acceleration, &mut load.weight]
        .into_iter()
        .flatten()
    {
        vector.iter_mut().for_each(|c| *c *= by);
    }
}

/// The worse, the lower. A corner without an answer governs: it must not hide behind the others.
fn height(answer: &RowAnswer) -> f64 {
    match answer.status {
        RowStatus::Impossible | RowStatus::Error => f64::NEG_INFINITY,
        // Among what falls, what falls fastest.
        RowStatus::Unstable => -1e6 - answer.lower.unwrap_or(0.0),
        RowStatus::Undecided => -1e6,
        RowStatus::Conditional => 0.0,
        RowStatus::Stable => 1.0,
        RowStatus::Found => answer.value.unwrap_or(f64::NEG_INFINITY),
        RowStatus::Unbounded => f64::INFINITY,
    }
}

fn between(scene: &Scene, ends: &[Ends], asked: &Question) -> String {
    let body = |l: &Load| l.weight.is_some() || l.acceleration.is_some();
    let linear = ends.iter().all(|e| !matches!(e.what, What::Pointer(_)));
    let is_limit = matches!(asked, Question::Limit(_));
    let moving = is_limit && scene.loads.live.iter().any(body);
    if !linear || moving {
        return "found by search over the corners: values between them were not computed".into();
    }
    let what = if is_limit {
        "the bound is a concave function of densities and loads, least at a corner"
    } else {
        "mixtures of the forces at the corners balance every value between them"
    };
    let dry = if asked.law() == Law::Coulomb {
        "; dry friction was computed at the corners only"
    } else {
        ""
    };
    format!("found by search over the corners; no value between them is worse: {what}{dry}")
}
