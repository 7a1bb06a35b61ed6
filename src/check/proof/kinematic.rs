//! Results of `kinematic`: what is claimed is a load factor and the points of a curve; all other
//! numbers are arithmetic on these, done once here, for who answers and for who checks.

use super::certificate::Proven;
use super::{
    answer::{Answer, LoadFactorAnswer},
    derive::{At, Derivation, failure},
    evidence::KinematicEvidence,
    path::{self, PathAnswer, PathResult, PathStatus},
    told::{Direction, Told},
};
use crate::{
    kinematic::{
        Capacity, Demand, Participation, Quake, STILL, Unique, capacity, demand, is_unique, quake,
        same_motion, way_of, without_members,
    },
    path::Drive,
    question::{CONFIDENCE, KinematicOptions, directions},
    terms::{Deciding, Found, Outcome},
    verdict::{Rate, Verdict, claim::Findings, evidence::read_rates, exact::Grade},
};
use model::interface::Model;
use nalgebra::Vector3;
use scene::Scene;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_with::skip_serializing_none;

/// The answer about an earthquake towards one direction.
#[skip_serializing_none]
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct KinematicAnswer {
    /// Unit direction across gravity towards which the masses are pushed.
    pub toward: [f64; 3],
    /// α0: the share of all weights that, pushing that way, sets the scene moving.
    pub alpha0: LoadFactorAnswer,
    /// Whether it stands without an earthquake, where that was asked.
    pub verdict: Option<Verdict>,
    /// The part of the scene that decides the bound on α0, where it has several.
    pub part: Option<Deciding>,
    /// How exactly that bound is proved; absent where it is undecided.
    pub proof: Option<Grade>,
    /// Factor of confidence FC.
    pub fc: f64,
    /// The control point of the curve, and by what the equivalent displacement is measured.
    pub control: Option<Control>,
    /// How far the curve was followed.
    pub curve: Option<PathAnswer>,
    /// The curve is that of the scene without its members: what lasts once these yield.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub without_members: bool,
    /// How far the curve with members was followed, where the scene has any: they hold up to their
    /// strength, however far it has moved. Limit states are those of `curve`.
    pub curve_with_members: Option<PathAnswer>,
    /// Why there is no curve with members; it stands under `run`.
    #[serde(skip)]
    pub no_curve_with_members: Option<String>,
    /// Why there is no curve, where one was asked for; it stands under `run`.
    #[serde(skip)]
    pub no_curve: Option<String>,
    /// What follows from the mechanism, the curve and the site.
    pub numbers: Numbers,
}

/// A control point.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Control {
    /// The block.
    pub block: String,
    /// The point of it at the start, m.
    pub point: [f64; 3],
}

/// What follows from a mechanism, its curve and the site.
#[skip_serializing_none]
#[derive(Clone, Debug, Default, PartialEq, Serialize, JsonSchema)]
pub struct Numbers {
    /// a0 = α0 g / (e* FC), m/s²; absent where α0 was not found.
    pub a0: Option<f64>,
    /// The same with blocks that move as one counted as one, where that is less.
    pub a0_of_bodies: Option<f64>,
    /// What of the mass takes part: e*, M* and δ of every mass that moves.
    pub participation: Option<Participation>,
    /// Whether the joints that the mechanism keeps closed allow another one.
    pub unique: Option<Unique>,
    /// δ of the control point, in the measure of the masses' δ.
    pub control_delta: Option<f64>,
    /// What the curve gives, where it vanishes.
    pub capacity: Option<Capacity>,
    /// What the site demands.
    pub demand: Option<Demand>,
}

impl Numbers {
    /// The least ratio of what the site demands that is met, with blocks that move as one counted as
    /// one.
    pub fn least_ratio(&self) -> Option<f64> {
        Some(self.of_bodies(self.demand.as_ref()?.ratio))
    }

    /// A ratio with blocks that move as one counted as one.
    pub fn of_bodies(&self, ratio: f64) -> f64 {
        let share = self.participation.as_ref().and_then(Participation::share_of_bodies);
        ratio * share.unwrap_or(1.0)
    }
}

/// What numbers are made of.
pub struct Given<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// Its masses under the earthquake.
    pub quake: &'a Quake,
    /// Rates of the mechanism, one a block; nothing where none was found.
    pub rates: Option<&'a [Rate]>,
    /// The load factor at which it moves.
    pub alpha0: Option<f64>,
    /// The confidence factor.
    pub fc: f64,
    /// The point whose displacement is told.
    pub control: Option<&'a Control>,
    /// The capacity curve, where it was followed.
    pub curve: Option<(&'a PathAnswer, &'a PathResult)>,
}

impl Given<'_> {
    /// The numbers.
    pub fn numbers(&self) -> Numbers {
        let mut numbers = Numbers::default();
        let Some(rates) = self.rates else { return numbers };
        let Some(p) = Participation::of(self.quake, rates) else { return numbers };
        let model = &self.quake.model;
        let gravity = model.assembly.gravity.norm();
        numbers.unique = Some(is_unique(model, rates));
        numbers.a0 = self.alpha0.map(|alpha| p.acceleration(alpha, gravity, self.fc));
        numbers.a0_of_bodies = numbers.a0.and_then(|a0| Some(a0 * p.share_of_bodies()?));
        numbers.control_delta = self.control.and_then(|c| {
            way_of(self.quake, rates, model.assembly.find(&c.block)?, &Vector3::from(c.point))
        });
        if let (Some(points), Some(delta)) = (self.points(&p, gravity), numbers.control_delta)
            && delta > STILL
        {
            numbers.capacity = capacity(&points, p.delta_star / delta);
        }
        if let (Some(site), Some(a0)) = (&self.scene.site, numbers.a0) {
            let capacity = numbers.capacity;
            let exact = capacity.and_then(|c| c.exact).map(|s| ("exact curve", s));
            let straight = capacity.map(|c| ("straight line", c.straight));
            let curves: Vec<_> = exact.into_iter().chain(straight).collect();
            numbers.demand = Some(demand(site, a0, &curves, gravity));
        }
        numbers.participation = Some(p);
        numbers
    }

    /// Ways of the control point with accelerations, where the curve is one of this mechanism and
    /// vanishes.
    fn points(&self, p: &Participation, gravity: f64) -> Option<Vec<(f64, f64)>> {
        let (said, path) = self.curve?;
        if said.status != PathStatus::Vanishes || !self.starts_alike(p, path) {
            return None;
        }
        let point = |(d, alpha): (f64, f64)| (d, p.acceleration(alpha, gravity, self.fc));
        path.points.iter().map(|p| Some(point((p.value, p.load_factor?)))).collect()
    }

    /// Whether the curve starts by the same mechanism.
    fn starts_alike(&self, p: &Participation, path: &PathResult) -> bool {
        let first = path.points.first().filter(|first| first.value == 0.0);
        let rates = first.and_then(|first| {
            read_rates(&self.quake.model.assembly, &first.certificate.rates).ok()
        });
        rates
            .and_then(|rates| Participation::of(self.quake, &rates))
            .is_some_and(|other| p.is_same(&other))
    }
}

/// What orders directions: a0, and before all what has none.
fn governing(direction: &Direction) -> f64 {
    let a0 = direction.answer.kinematic().and_then(|k| k.numbers.a0);
    let free = direction.dry.is_none()
        && direction.answer.bound().is_some_and(|b| b.status == Outcome::Unbounded);
    a0.unwrap_or(if free { f64::INFINITY } else { f64::NEG_INFINITY })
}

/// An earthquake, direction by direction, the worst first, with its curve: what follows from the
/// mechanism, the curve and the site is arithmetic.
pub(super) fn derive(
    d: &mut Derivation,
    o: &KinematicOptions,
    e: &KinematicEvidence,
) -> Result<Told, String> {
    let model = d.model;
    let dead = d.dead(model, e.dead.as_ref());
    let level = dead.as_ref().and_then(|d| d.answer.verdict());
    let asked = directions(model.assembly.gravity, &o.toward, o.all);
    if e.directions.len() > asked.len() {
        return Err("the evidence has more directions than the question".into());
    }
    let mut all = towards(d, o, (e, &asked), level)?;
    all.sort_by(|a, b| governing(&a.direction).total_cmp(&governing(&b.direction)));
    let several = all.len() > 1;
    let mut rest = all.into_iter();
    let mut worst = rest.next().ok_or("no direction is given")?;
    let [curve, tied] = curves(d, o, e, &mut worst)?;
    if let Answer::Kinematic(answer) = &worst.direction.answer {
        d.part("numbers", told_numbers(&answer.numbers));
    }
    let Direction { answer, certificate, dry } = worst.direction.clone();
    let mut told = Told::new(&worst.quake.model, answer, &certificate);
    told.dry = dry;
    told.in_words(&worst.quake.model, worst.proven.as_ref());
    (told.path, told.path_with_members) = (curve, tied);
    if several {
        told.directions =
            std::iter::once(worst.direction).chain(rest.map(|a| a.direction)).collect();
    }
    told.dead_load = dead;
    d.check.claimed = told.answer.proof().is_some();
    Ok(told)
}

/// What every direction gives.
fn towards(
    d: &mut Derivation,
    o: &KinematicOptions,
    (e, asked): (&KinematicEvidence, &[Vector3<f64>]),
    level: Option<Verdict>,
) -> Result<Vec<Asked>, String> {
    let (scene, model, fc) = (d.scene, d.model, o.fc.unwrap_or(CONFIDENCE));
    let nothing = Default::default();
    let mut all = Vec::new();
    for (k, &toward) in asked.iter().enumerate() {
        let own = e.directions.get(k).unwrap_or(&nothing);
        let quake = quake(scene, model, toward).map_err(|e| e.to_string())?;
        let unit = quake.toward;
        let title = format!("earthquake towards {}", base::number::point(unit.into()));
        let at: At = &|_| Ok(quake.model.clone());
        let factor = d.factor(&title, &quake.model, at, (own, o.law), level);
        let proven =
            factor.proven.as_ref().filter(|_| factor.answer.associative.status == Outcome::Found);
        let dry = factor
            .dry
            .as_ref()
            .filter(|dry| dry.found == Found::FixedPoint && dry.is_reached())
            .and_then(|dry| read_rates(&quake.model.assembly, &dry.certificate.rates).ok());
        let rates = proven.map(|p| dry.unwrap_or_else(|| p.rates.clone()));
        let answer = KinematicAnswer {
            toward: unit.into(),
            alpha0: factor.answer,
            verdict: level,
            part: factor.part,
            proof: factor.proof,
            fc,
            control: None,
            curve: None,
            without_members: false,
            curve_with_members: None,
            no_curve_with_members: None,
            no_curve: None,
            numbers: given(scene, &quake, rates.as_deref(), factor.answer.value, fc).numbers(),
        };
        let direction = Direction {
            answer: Answer::Kinematic(Box::new(answer)),
            certificate: own.bound.clone(),
            dry: factor.dry,
        };
        all.push(Asked { direction, proven: factor.proven, rates, quake });
    }
    Ok(all)
}

/// The curves of the worst direction, and the numbers that follow from them.
fn curves(
    d: &mut Derivation,
    o: &KinematicOptions,
    e: &KinematicEvidence,
    worst: &mut Asked,
) -> Result<[Option<PathResult>; 2], String> {
    let (scene, fc) = (d.scene, o.fc.unwrap_or(CONFIDENCE));
    let (mut curve, mut tied) = (None, None);
    if let Answer::Kinematic(answer) = &mut worst.direction.answer {
        let drive = e.control.as_ref().map(|c| drive(&worst.quake, c)).transpose()?;
        let asked = o.control.as_ref().map(|c| (&c.block, c.point));
        let here = e.control.as_ref().map(|c| (&c.block, c.point));
        if asked.is_some() && here.is_some() && asked != here {
            return Err("the control point is not the one that was asked for".into());
        }
        answer.control.clone_from(&e.control);
        let bare = without_members(&worst.quake.model);
        let under = &worst.quake.model;
        answer.without_members =
            e.curve.is_some() && bare.interfaces.members.len() < under.interfaces.members.len();
        let follow = |d: &mut Derivation, model: &Model, own: &Option<_>| {
            let (Some(own), Some(drive)) = (own, &drive) else { return Ok(None) };
            path::curve(d, model, drive, own).map(Some)
        };
        let held = follow(d, under, &e.curve_with_members)?;
        if held.is_some() && under.interfaces.members.is_empty() {
            d.part("curve with members", failure("the scene has no members"));
        }
        if let Some((said, path)) = follow(d, &bare, &e.curve)? {
            if answer.without_members {
                let first = path.points.first().map(|p| p.certificate.rates.as_slice());
                let begins = read_rates(&bare.assembly, first.unwrap_or_default())?;
                let own = worst.rates.as_deref().unwrap_or_default();
                let mut f = Findings::default();
                match same_motion(&bare, &begins, own) {
                    true => {
                        f.holds.push("the curve without members begins with the mechanism".into())
                    }
                    false => f.fails.push(
                        "the curve without members begins with another mechanism than that of α0"
                            .into(),
                    ),
                }
                d.part("curve without members", f);
            }
            (answer.curve, curve) = (Some(said), Some(path));
        }
        if let Some((said, path)) = held {
            (answer.curve_with_members, tied) = (Some(said), Some(path));
        }
        let value = answer.alpha0.value;
        answer.numbers = Given {
            control: answer.control.as_ref(),
            curve: answer.curve.as_ref().zip(curve.as_ref()),
            ..given(scene, &worst.quake, worst.rates.as_deref(), value, fc)
        }
        .numbers();
    }
    Ok([curve, tied])
}

/// The greatest of what follows by arithmetic, for who reads the check.
fn told_numbers(n: &Numbers) -> Findings {
    let mut f = Findings::default();
    f.holds.push(match (&n.participation, n.a0) {
        (Some(p), Some(a0)) => format!(
            "recomputed from the mechanism: e* = {:.9}, M* = {:.6e} kg, a0 = {a0:.9} m/s²",
            p.e_star, p.mass
        ),
        _ => "recomputed: without a mechanism there is no participating mass".into(),
    });
    f.holds.extend(n.capacity.map(|c| format!("recomputed from the curve: d0 = {:.9} m", c.d0)));
    let ratio = |d: &Demand| format!("recomputed from the site: {:.6} of the demand", d.ratio);
    f.holds.extend(n.demand.as_ref().map(ratio));
    f
}

/// A direction with what its numbers are made of.
struct Asked {
    direction: Direction,
    proven: Option<Proven>,
    rates: Option<Vec<Rate>>,
    quake: Quake,
}

fn given<'a>(
    scene: &'a Scene,
    quake: &'a Quake,
    rates: Option<&'a [Rate]>,
    alpha0: Option<f64>,
    fc: f64,
) -> Given<'a> {
    Given { scene, quake, rates, alpha0, fc, control: None, curve: None }
}

/// What moves the curve: the control point, towards the earthquake.
fn drive(quake: &Quake, c: &Control) -> Result<Drive, String> {
    let assembly = &quake.model.assembly;
    let block = assembly.find(&c.block).filter(|&i| !assembly.blocks[i].support);
    let block = block.ok_or(format!("the scene has no free block {}", c.block))?;
    Ok(Drive::Push { block, point: c.point.into(), toward: quake.toward })
}

impl Answer {
    /// What it says of an earthquake.
    pub fn kinematic(&self) -> Option<&KinematicAnswer> {
        match self {
            Self::Kinematic(a) => Some(a),
            _ => None,
        }
    }
}
