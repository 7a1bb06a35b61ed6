//! Results of `kinematic`: what is claimed is a load factor and the points of a curve; all other
//! numbers are arithmetic on these, done once here, for who answers and for who checks.

mod verify;

pub(super) use verify::{differs, verify};

use super::{
    answer::LoadFactorAnswer,
    path::{PathAnswer, PathResult, PathStatus},
};
use crate::{
    kinematic::{
        Capacity, Demand, Participation, Quake, STILL, Unique, capacity, demand, is_unique, way_of,
    },
    terms::Deciding,
    verdict::{Rate, Verdict, evidence::read_rates, exact::Grade},
};
use nalgebra::Vector3;
use scene::Scene;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The answer about an earthquake towards one direction.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct KinematicAnswer {
    /// Unit direction across gravity towards which the masses are pushed.
    pub toward: [f64; 3],
    /// α0: the share of all weights that, pushing that way, sets the scene moving.
    pub alpha0: LoadFactorAnswer,
    /// Whether it stands without an earthquake, where that was asked.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub verdict: Option<Verdict>,
    /// The part of the scene that decides the bound on α0, where it has several.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub part: Option<Deciding>,
    /// How exactly that bound is proved; absent where it is undecided.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub proof: Option<Grade>,
    /// Factor of confidence FC.
    pub fc: f64,
    /// The control point of the curve, and by what the equivalent displacement is measured.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub control: Option<Control>,
    /// How far the curve was followed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub curve: Option<PathAnswer>,
    /// The curve is that of the scene without its members: what lasts once these yield.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub without_members: bool,
    /// How far the curve with members was followed, where the scene has any: they hold up to their
    /// strength, however far it has moved. Limit states are those of `curve`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub curve_with_members: Option<PathAnswer>,
    /// Why there is no curve with members.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub no_curve_with_members: Option<String>,
    /// Why there is no curve, where one was asked for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
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
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Numbers {
    /// a0 = α0 g / (e* FC), m/s²; absent where α0 was not found.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub a0: Option<f64>,
    /// The same with blocks that move as one counted as one, where that is less.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub a0_of_bodies: Option<f64>,
    /// What of the mass takes part: e*, M* and δ of every mass that moves.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub participation: Option<Participation>,
    /// Whether the joints that the mechanism keeps closed allow another one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub unique: Option<Unique>,
    /// δ of the control point, in the measure of the masses' δ.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub control_delta: Option<f64>,
    /// What the curve gives, where it vanishes.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub capacity: Option<Capacity>,
    /// What the site demands.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub demand: Option<Demand>,
}

impl Numbers {
    /// The least ratio of what the site demands that is met, with blocks that move as one counted as
    /// one.
    pub fn least_ratio(&self) -> Option<f64> {
        let share = self.participation.as_ref().and_then(Participation::share_of_bodies);
        Some(self.demand.as_ref()?.ratio * share.unwrap_or(1.0))
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
