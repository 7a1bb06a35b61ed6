//! The geometric safety factor: how far the line of thrust stays inside.
//!
//! It is the greatest factor by which all sections can be shrunk about their centroids, loads and
//! weights unchanged, and still contain a line of thrust: for an arch the ratio of its thickness to
//! that of the thinnest arch inside it that carries the same loads (Heyman 1969, Int. J. Mech. Sci.
//! 11; 1982, The Masonry Arch). Friction limits the lines of thrust as it does in the scene. The
//! share of the sections that is left is a critical value like any other ([`critical_value`](super::critical_value)).

use super::{
    Assessment, Control, Law, Proved, assess,
    critical_value::{Flip, Probe, refine},
    parts,
};
use base::tolerance;
use check::verdict::{Verdict, section::shrunk_model};
use model::{interface::Model, strength::laws::are_dry};

/// What is known of the geometric safety factor.
#[derive(Clone, Debug)]
pub enum Geometric<A = Assessment> {
    /// Its reciprocal, with the verdicts on both sides.
    Found(Box<Flip<A>>),
    /// Greater than 1 / [`tolerance::LEAST_SHRINK`]: it stands with sections shrunk that far.
    Beyond(Box<Probe<A>>),
    /// Why there is none.
    Open(String),
}

/// The geometric safety factor of a scene that stands, the least of those of its parts.
pub fn geometric_factor(model: &Model, control: &Control) -> Geometric<Proved<Assessment>> {
    match parts::thrust::geometric_factor(model, control) {
        Geometric::Found(flip) => {
            let Flip { value, falls, stands, linear, probes } = *flip;
            Geometric::Found(Box::new(Flip {
                value,
                falls: falls.proved(),
                stands: stands.proved(),
                linear,
                probes,
            }))
        }
        Geometric::Beyond(probe) => Geometric::Beyond(Box::new(probe.proved())),
        Geometric::Open(why) => Geometric::Open(why),
    }
}

/// The flip that one part gave, with the verdicts on the whole scene; none of them has one where
/// there is no flip.
pub(super) fn on_scene(scene: &Model, flip: Option<Flip>, control: &Control) -> Geometric {
    let control = Control { law: Law::Associative, ..*control };
    let Some(flip) = flip else {
        let least = shrunk(scene, tolerance::LEAST_SHRINK, &control);
        return match least.assessment.verdict {
            Verdict::Stable => Geometric::Beyond(Box::new(least)),
            _ => Geometric::Open("the verdict on shrunk sections is undecided".into()),
        };
    };
    let [falls, stands] =
        [&flip.falls, &flip.stands].map(|probe| shrunk(scene, probe.value, &control));
    Geometric::Found(Box::new(Flip { falls, stands, ..flip }))
}

/// The same for one part.
pub(super) fn of_part(model: &Model, control: &Control) -> Geometric {
    if !are_dry(&model.interfaces) {
        return Geometric::Open(
            "joints have strength or pore pressure, which shrinking the sections would change"
                .into(),
        );
    }
    let ask = |by: f64| shrunk(model, by, &Control { law: Law::Associative, ..*control });
    let (least, whole) = (ask(tolerance::LEAST_SHRINK), ask(1.0));
    match (least.assessment.verdict, whole.assessment.verdict) {
        (Verdict::Stable, _) => Geometric::Beyond(Box::new(least)),
        (Verdict::Unstable, Verdict::Stable) => {
            match refine(&mut |by| Ok(ask(by)), least, whole, tolerance::LEAST_SHRINK) {
                Ok(flip) => Geometric::Found(Box::new(flip)),
                Err(e) => Geometric::Open(e.to_string()),
            }
        }
        _ => Geometric::Open("the verdict on shrunk sections is undecided".into()),
    }
}

fn shrunk(model: &Model, by: f64, control: &Control) -> Probe {
    let model = shrunk_model(model, by);
    let assessment = assess::unproved(&model, control);
    Probe { value: by, model, assessment }
}
