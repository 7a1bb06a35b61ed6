//! At what tilt does it fall? One load-factor program a direction.
//!
//! `tan θ` is the load factor of the own weight across gravity ([`check::verdict::tilted`]).
//!
//! Stresses do not turn. Where joints have strengths or water, all forces are divided by cos θ, and
//! with them the stresses: the load factor is asked for with joints `√(1 + tan² θ)` times as
//! strong, and θ is the first tilt that is its own answer, found from level upwards. Joints that
//! hold more than the weight at any tilt have none; that comes out undecided.

use super::{
    Bracket, Claims, Control, LoadFactor, Outcome, Proved,
    coulomb::{self, DryLoadFactor, Found},
    limit,
    parts::{self, limit::PartMethods},
    repair,
    warm_start::Near,
};
use base::{error::InputError, tolerance};
use check::verdict::{
    Forces, Verdict,
    tilted::{stressed, tilted, turned},
};
use model::{
    interface::{Model, Part},
    strength::laws::are_dry,
};
use nalgebra::Vector3;

/// The tilt limit in one direction.
#[derive(Clone, Debug)]
pub struct Tilt {
    /// Unit direction perpendicular to gravity towards which the ground tips.
    pub toward: Vector3<f64>,
    /// The model at the tilt of the bound ([`tilted`]).
    pub model: Model,
    /// `tan θ` as a load factor, with joints that open as they slide: a bound.
    pub load_factor: Proved<LoadFactor>,
    /// With dry friction, where that was asked and the bound has a value or no limit.
    pub dry: Option<DryTilt>,
}

/// The tilt limit with dry friction.
#[derive(Clone, Debug)]
pub struct DryTilt {
    /// The model at that tilt.
    pub model: Model,
    /// `tan θ` as a load factor.
    pub load_factor: Proved<DryLoadFactor>,
}

impl Tilt {
    /// The angle in degrees, where there is one; 90 where the scene is wedged and stands at every
    /// tilt below.
    pub fn angle_deg(&self) -> Option<f64> {
        match self.load_factor.outcome {
            Outcome::Found => self.load_factor.value.map(|v| v.atan().to_degrees()),
            Outcome::Unbounded => Some(90.0),
            Outcome::Impossible | Outcome::Undecided => None,
        }
    }
}

/// The tilt at which the scene falls.
///
/// # Errors
/// As [`turned`].
pub fn tilt(model: &Model, toward: Vector3<f64>, control: &Control) -> Result<Tilt, InputError> {
    tilt_near(model, toward, control, &Near::default())
}

/// The same, begun near what another direction passed.
pub(super) fn tilt_near(
    model: &Model,
    toward: Vector3<f64>,
    control: &Control,
    near: &Near,
) -> Result<Tilt, InputError> {
    let (assembly, toward) = turned(&model.assembly, toward)?;
    let turned = Model::new(assembly, model.interfaces.clone());
    let load_factor = if are_dry(&turned.interfaces) {
        parts::limit::limit(&turned, control, near)
    } else {
        parts::limit::limit_by(
            &turned,
            control,
            &PartMethods { solve: tilted_part, at: tilted_under },
        )
    };
    let (load_factor, model) = proved(model, toward, load_factor, |l| l.value)?;
    Ok(Tilt { toward, load_factor, model, dry: None })
}

/// An answer that is checked, and the model that it is about: where nothing is left of it after
/// the check, that of no tilt.
fn proved<T: Claims>(
    model: &Model,
    toward: Vector3<f64>,
    answer: T,
    value: impl Fn(&T) -> Option<f64>,
) -> Result<(Proved<T>, Model), InputError> {
    let at = tilted(model, toward, value(&answer))?;
    let proved = Proved::new(&at, answer);
    let left = if proved.refused().is_some() { tilted(model, toward, value(&proved))? } else { at };
    Ok((proved, left))
}

/// A part with its joints as they are at a tilt.
fn tilted_joints(part: &Part, tilt: f64) -> Model {
    part.model.with_interfaces(stressed(&part.model.interfaces, tilt))
}

/// Forces cut to what the joints of a part bear at a tilt.
fn cut_at(part: &Part, tilt: Option<f64>, forces: &mut Forces) {
    if let Some(tilt) = tilt {
        repair::cut(&tilted_joints(part, tilt).interfaces, forces);
    }
}

/// A part under its loads at a tilt.
fn tilted_under(part: &Part, tilt: f64) -> Model {
    let assembly = part.model.assembly.at_load_factor(part.units.own_load_factor(tilt));
    Model::new(assembly, stressed(&part.model.interfaces, tilt))
}

/// The tilt at which a part falls whose joints have strengths, as a load factor in its own units.
fn tilted_part(part: &Part, control: &Control) -> LoadFactor {
    let at = |tilt: f64| limit::of_part(&tilted_joints(part, tilt), control);
    let found = |l: &LoadFactor| l.found().map(|v| part.units.load_factor(v));
    match own_answer(0.0, at, found) {
        // Joints at the tilt itself differ by what is left of the search from those that it was
        // found with.
        Ok(mut answer) => {
            answer.bracket.upper += 2.0 * OWN_ANSWER * answer.value.map_or(0.0, f64::abs);
            cut_at(part, found(&answer), &mut answer.forces);
            answer
        }
        // What has no limit at one tilt may have one at another, where the joints are weaker beside
        // the weight.
        Err(answer) if answer.outcome == Outcome::Impossible => answer,
        Err(answer) => LoadFactor {
            outcome: Outcome::Undecided,
            bracket: Bracket::UNKNOWN,
            value: None,
            mechanism: None,
            ..answer
        },
    }
}

impl Tilt {
    /// Adds dry friction to the answer of [`tilt`](tilt()) for the same model, where that is asked
    /// for and the bound leaves something to ask; `level` is the verdict at level, where it is
    /// known.
    ///
    /// # Errors
    /// As [`turned`].
    pub fn add_dry(
        &mut self,
        model: &Model,
        level: Option<Verdict>,
        control: &Control,
    ) -> Result<(), InputError> {
        if coulomb::is_asked(&self.load_factor, level, control) {
            if let Some(bound) = self.angle_deg() {
                control.known(|| format!("falls at {bound:.4}° at most"));
            }
            let load_factor = dry(model, self, level, control)?;
            let (load_factor, model) = proved(model, self.toward, load_factor, |l| l.value)?;
            self.dry = Some(DryTilt { load_factor, model });
        }
        Ok(())
    }
}

/// The load factor with dry friction.
fn dry(
    model: &Model,
    tilt: &Tilt,
    level: Option<Verdict>,
    control: &Control,
) -> Result<DryLoadFactor, InputError> {
    let (associative, turned) = (&tilt.load_factor, tilted(model, tilt.toward, None)?);
    if are_dry(&turned.interfaces) {
        return Ok(parts::dry::unproved(&turned, associative, level, control));
    }
    let dead = level.filter(|&v| v == Verdict::Stable);
    let solve = |part: &Part, bound: Option<&LoadFactor>, control: &Control| {
        let own = |tilt: f64| limit::of_part(&tilted_joints(part, tilt), control);
        let computed;
        let bound = match bound {
            Some(bound) => bound,
            None => {
                computed = own(associative.value.unwrap_or(0.0));
                &computed
            }
        };
        let start = part.units.load_factor(bound.value.unwrap_or(0.0));
        // At the bound's own tilt it is the bound that is asked about, not another solve of it that
        // differs in the last digits.
        let at = |tilt: f64| {
            let joints = tilted_joints(part, tilt);
            match tilt == start {
                true => coulomb::complementary(&joints, bound, control),
                false => coulomb::complementary(&joints, &own(tilt), control),
            }
        };
        let value = |d: &DryLoadFactor| d.value.map(|v| part.units.load_factor(v));
        let answer = || match own_answer(start, at, value) {
            Ok(mut answer) => {
                cut_at(part, value(&answer), &mut answer.forces);
                answer
            }
            Err(answer) => DryLoadFactor { found: Found::Undecided, value: None, ..answer },
        };
        let at = |lambda: f64| tilted_under(part, part.units.load_factor(lambda));
        coulomb::up_to_rest(answer, &part.model.assembly, bound, dead, &at, control)
    };
    Ok(parts::dry::load_factor_by(&turned, associative, control, (solve, tilted_under)))
}

/// A tilt is its own answer up to this × itself. Larger: a wider bracket. Smaller: the last digits
/// of the engine.
const OWN_ANSWER: f64 = 0.01 * tolerance::LOAD_FACTOR_WIDTH;

/// A load factor that is the tangent of its own tilt. `Err` is the last answer where there is none.
fn own_answer<T>(
    start: f64,
    at: impl Fn(f64) -> T,
    value: impl Fn(&T) -> Option<f64>,
) -> Result<T, T> {
    let mut tilt = start;
    let mut before: Option<(f64, f64)> = None;
    let mut answer = at(tilt);
    for _ in 0..MOST_TILTS {
        let Some(value) = value(&answer) else { return Err(answer) };
        let short = value - tilt;
        if short.abs() <= OWN_ANSWER * value.abs() {
            return Ok(answer);
        }
        // The secant where it goes on in the same direction, the answer itself otherwise.
        let secant = before
            .map(|(t, s)| tilt + short * (tilt - t) / (s - short))
            .filter(|t| (t - tilt) * short > 0.0 && t.is_finite());
        before = Some((tilt, short));
        tilt = secant.unwrap_or(value);
        answer = at(tilt);
    }
    Err(answer)
}

/// Tilts tried. The secant takes some six; more are needed only where joints hold almost everything
/// at any tilt.
const MOST_TILTS: usize = 30;
