//! Mechanisms under earthquakes: the load factor that proves one worst, and the curve by which its
//! resistance falls. The arithmetic on both is that of [`check::kinematic`].

use super::{
    Assessment, Control, KinematicOptions, LoadFactor, Outcome, Proved, PushOptions, assess,
    coulomb,
    coulomb::{DryLoadFactor, Found},
    follow::{
        End,
        answer::{Followed, push},
    },
    limit,
    question::{ControlPoint, directions},
};
use base::error::{InputError, JsonPath};
use check::{
    kinematic::{self, CONFIDENCE, Participation, Quake, quake, way_of},
    terms::Law,
    verdict::Rate,
};
use model::interface::Model;
use nalgebra::Vector3;
use scene::Scene;

/// The answer of `kinematic`.
#[derive(Clone, Debug)]
pub struct Kinematic {
    /// One a direction, the worst first; at least one.
    pub directions: Vec<Quaked>,
    /// Whether it stands under its dead load alone, where that was asked.
    pub dead: Option<Proved<Assessment>>,
    /// The factor of confidence.
    pub confidence: f64,
    /// The control point of the worst direction, where its mechanism has one.
    pub control: Option<(usize, Vector3<f64>)>,
    /// The curve of the worst direction, where it was asked for and could be followed at all.
    pub curve: Option<Followed>,
    /// The scene that the curve is of.
    pub curve_model: Model,
    /// The curve is that of the scene without its members: what lasts.
    pub without_members: bool,
    /// Why there is no curve.
    pub why: Option<String>,
    /// Where the scene has members: the curve with them, as long as they hold, or why there is none.
    pub with_members: Option<Result<Followed, String>>,
}

/// An earthquake towards one direction.
#[derive(Clone, Debug)]
pub struct Quaked {
    /// The scene under it.
    pub quake: Quake,
    /// α0 with joints that open as they slide: a bound.
    pub bound: Proved<LoadFactor>,
    /// With dry friction, where that was asked and the bound has a value or no limit.
    pub dry: Option<Proved<DryLoadFactor>>,
}

impl Quaked {
    /// α0: the one to use, where it is found.
    pub fn alpha0(&self) -> Option<f64> {
        let bound = self.bound.found();
        self.dry.as_ref().map_or(bound, |dry| dry.to_use(bound))
    }

    /// The mechanism that goes with it.
    pub fn rates(&self) -> &[Rate] {
        match &self.dry {
            Some(dry) if dry.found == Found::FixedPoint && dry.is_reached() => &dry.rates,
            _ => &self.bound.rates,
        }
    }

    /// What of the mass takes part, where there is a mechanism.
    pub fn participation(&self) -> Option<Participation> {
        (self.bound.outcome == Outcome::Found)
            .then(|| Participation::of(&self.quake, self.rates()))
            .flatten()
    }

    /// a0, m/s²; what has none governs.
    fn a0(&self, confidence: f64) -> f64 {
        let gravity = self.quake.model.assembly.gravity.norm();
        match self.bound.outcome {
            Outcome::Impossible => f64::NEG_INFINITY,
            // Nothing moves it at all.
            Outcome::Unbounded if self.dry.is_none() => f64::INFINITY,
            _ => self
                .alpha0()
                .zip(self.participation())
                .map_or(f64::NEG_INFINITY, |(a, p)| p.acceleration(a, gravity, confidence)),
        }
    }
}

/// Asks about earthquakes towards the directions of the question.
pub(super) fn kinematic(
    options: &KinematicOptions,
    scene: &Scene,
    model: &Model,
    control: &Control,
) -> Result<Kinematic, InputError> {
    let given = options.control.as_ref().map(|c| control_of(model, c)).transpose()?;
    let confidence = options.fc.unwrap_or(CONFIDENCE);
    let toward = directions(model.assembly.gravity, &options.toward, options.all);
    let quakes: Vec<Quake> =
        toward.into_iter().map(|d| quake(scene, model, d)).collect::<Result<_, _>>()?;
    // All bounds before the first answer with dry friction: where time is short they are worth
    // most.
    let bounds: Vec<_> = quakes.iter().map(|q| limit(&q.model, control)).collect();
    let dead = (!options.skip_dead).then(|| assess(model, control));
    let level = dead.as_ref().map(|d| d.verdict);
    let mut directions: Vec<Quaked> = quakes
        .into_iter()
        .zip(bounds)
        .map(|(quake, bound)| {
            let dry = coulomb::beside(&quake.model, &bound, level, control);
            Quaked { quake, bound, dry }
        })
        .collect();
    directions.sort_by(|a, b| a.a0(confidence).total_cmp(&b.a0(confidence)));
    let worst = &directions[0];
    let found = worst.bound.outcome == Outcome::Found;
    let point = given
        .or_else(|| kinematic::control_point(&worst.quake, worst.rates()))
        .filter(|_| found && worst.participation().is_some());
    let mut answer = Kinematic {
        confidence,
        control: point,
        curve: None,
        curve_model: worst.quake.model.clone(),
        without_members: false,
        why: None,
        with_members: None,
        dead,
        directions: Vec::new(),
    };
    if !options.linear {
        match curve(worst, point, options, control) {
            Ok((followed, model, without)) => {
                answer.curve = Some(followed);
                (answer.curve_model, answer.without_members) = (model, without);
            }
            Err(why) => answer.why = Some(why),
        }
        let has_members = !worst.quake.model.interfaces.members.is_empty();
        if let Some(point) = point.filter(|_| has_members) {
            // With points at the limit states of what lasts, to be held beside them.
            let states: Vec<f64> = answer.curve.iter().flat_map(limit_states).collect();
            let model = &worst.quake.model;
            answer.with_members = Some(
                ways(worst, point)
                    .and_then(|()| pushed(worst, model, point, options.at.clone(), control))
                    .and_then(|first| and_at(worst, model, point, (first, states), control)),
            );
        }
    }
    answer.directions = directions;
    Ok(answer)
}

pub(super) fn control_of(
    model: &Model,
    c: &ControlPoint,
) -> Result<(usize, Vector3<f64>), InputError> {
    let blocks = &model.assembly.blocks;
    let error = |text: String| InputError::at(JsonPath::root(), text);
    let Some(i) = model.assembly.find(&c.block).filter(|&i| !blocks[i].support) else {
        return Err(error(format!("{}: there is no such free block", c.block)));
    };
    let point = Vector3::from(c.point);
    if (point - blocks[i].centroid).norm() > blocks[i].size {
        let center: [f64; 3] = blocks[i].centroid.into();
        return Err(error(format!("the control point does not lie on {}", c.block))
            .hint(format!("its centre of mass is at {}", base::number::point(center))));
    }
    Ok((i, point))
}

/// Points of the curve between which the limit states lie, beside its own: even shares of d0.
const SHARES: [f64; 2] = [kinematic::SLV, kinematic::SLC];

/// Ways of the control point at which the limit states of a curve lie, where it vanishes.
fn limit_states(curve: &Followed) -> Vec<f64> {
    let end = curve.path.points.last().map(|p| p.value);
    let d0 = end.filter(|_| matches!(curve.path.end, End::Vanishes));
    d0.map_or_else(Vec::new, |d0| SHARES.iter().map(|s| s * d0).collect())
}

/// Requires that the control point goes towards the earthquake.
fn ways(worst: &Quaked, (block, point): (usize, Vector3<f64>)) -> Result<(), String> {
    let own = way_of(&worst.quake, worst.rates(), block, &point);
    match own.is_none_or(|d| d <= kinematic::STILL) {
        true => Err(
            "the control point does not move in the direction of the earthquake in this mechanism"
                .into(),
        ),
        false => Ok(()),
    }
}

/// The curve of a scene under the pushes of the earthquake, with points at these ways of the control
/// point.
fn pushed(
    worst: &Quaked,
    model: &Model,
    (block, point): (usize, Vector3<f64>),
    mut at: Vec<f64>,
    control: &Control,
) -> Result<Followed, String> {
    at.sort_by(f64::total_cmp);
    let options = PushOptions {
        control: ControlPoint {
            block: model.assembly.blocks[block].id.clone(),
            point: point.into(),
        },
        toward: worst.quake.toward.into(),
        at,
        from: Vec::new(),
    };
    let control = Control { law: Law::Associative, ..*control };
    push(model, &options, &control, None).map_err(|e| e.message)
}

/// The curve of a mechanism, with points at both limit states; `Err` says why there is none.
fn curve(
    worst: &Quaked,
    point: Option<(usize, Vector3<f64>)>,
    options: &KinematicOptions,
    control: &Control,
) -> Result<(Followed, Model, bool), String> {
    worst.alpha0().ok_or("α0 was not found")?;
    let point = point.ok_or("no block moves in the direction of the earthquake")?;
    ways(worst, point)?;
    let model = &worst.quake.model;
    let bare = kinematic::without_members(model);
    let has_members = bare.interfaces.members.len() < model.interfaces.members.len();
    if has_members {
        same_without(worst, &bare, control)?;
    }
    let first = pushed(worst, &bare, point, options.at.clone(), control)?;
    let states = limit_states(&first);
    Ok((and_at(worst, &bare, point, (first, states), control)?, bare, has_members))
}

/// A curve with points at these ways as well, where there are any.
fn and_at(
    worst: &Quaked,
    model: &Model,
    point: (usize, Vector3<f64>),
    (first, more): (Followed, Vec<f64>),
    control: &Control,
) -> Result<Followed, String> {
    if more.is_empty() {
        return Ok(first);
    }
    // The points where it bends, the asked ones among them, but not its events and its end.
    let happens = |v: f64| first.path.events.iter().any(|e| (e.value..=e.beyond).contains(&v));
    let last = first.path.points.len().saturating_sub(1);
    let bends = first.path.points[..last].iter().map(|p| p.value).filter(|&v| !happens(v));
    pushed(worst, model, point, more.into_iter().chain(bends).collect(), control)
}

/// Requires that the mechanism is the same without members: only then is the curve without them one
/// of it.
fn same_without(worst: &Quaked, bare: &Model, control: &Control) -> Result<(), String> {
    let l = limit(bare, &Control { law: Law::Associative, ..*control });
    let quake = Quake { model: bare.clone(), ..worst.quake.clone() };
    let other =
        (l.outcome == Outcome::Found).then(|| Participation::of(&quake, &l.rates)).flatten();
    match (worst.participation(), other) {
        (Some(with), Some(without))
            if with.is_same(&without) && kinematic::same_motion(bare, worst.rates(), &l.rates) =>
        {
            Ok(())
        }
        (_, Some(_)) => {
            Err("motions are followed without members, and without them another mechanism governs"
                .into())
        }
        (_, None) => {
            Err("motions are followed without members, and without them it does not stand".into())
        }
    }
}
