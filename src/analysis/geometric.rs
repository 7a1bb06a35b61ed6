//! The geometric safety factor: how far the line of thrust stays inside.
//!
//! It is the greatest factor by which all sections can be shrunk about their centroids, loads and weights unchanged, and still contain a
//! line of thrust: for an arch the ratio of its thickness to that of the thinnest arch inside it that carries the same loads (Heyman
//! 1969, Int. J. Mech. Sci. 11; 1982, The Masonry Arch). Friction limits the lines of thrust as it does in the scene. The share of the
//! sections that is left is a critical value like any other ([`flip`](super::flip)).

use super::{
    Control, Law, Model, assess,
    flip::{Flip, Probe, refine},
};
use crate::{
    tolerance,
    verdict::{Verdict, section::centroid},
};
use std::time::Instant;

/// What is known of the geometric safety factor.
#[derive(Clone, Debug)]
pub enum Geometric {
    /// Its reciprocal, with the verdicts on both sides.
    Found(Box<Flip>),
    /// Greater than 1 / [`tolerance::LEAST_SHRINK`]: it stands with sections shrunk that far.
    Beyond(Box<Probe>),
    /// Why there is none.
    Open(String),
}

/// The geometric safety factor of a scene that stands.
pub fn geometric_factor(model: &Model, control: &Control) -> Geometric {
    if !model.interfaces.are_dry() {
        return Geometric::Open("joints have strengths or water, which shrinking sections would change".into());
    }
    let start = Instant::now();
    let ask = |by: f64| {
        let seconds = (control.seconds - start.elapsed().as_secs_f64()).max(0.0);
        shrunk(model, by, &Control { law: Law::Associative, seconds, ..*control })
    };
    let (least, whole) = (ask(tolerance::LEAST_SHRINK), ask(1.0));
    match (least.assessment.verdict, whole.assessment.verdict) {
        (Verdict::Stable, _) => Geometric::Beyond(Box::new(least)),
        (Verdict::Unstable, Verdict::Stable) => match refine(&mut |by| Ok(ask(by)), least, whole, tolerance::LEAST_SHRINK) {
            Ok(flip) => Geometric::Found(Box::new(flip)),
            Err(e) => Geometric::Open(e.to_string()),
        },
        _ => Geometric::Open("the verdict on shrunk sections came out undecided".into()),
    }
}

/// The model with its sections shrunk about their centroids.
pub fn shrunk_model(model: &Model, by: f64) -> Model {
    Model { assembly: model.assembly.clone(), interfaces: model.interfaces.shrunk(by, centroid), timings: model.timings }
}

fn shrunk(model: &Model, by: f64, control: &Control) -> Probe {
    let model = shrunk_model(model, by);
    let assessment = assess(&model.assembly, &model.interfaces, control);
    Probe { value: by, model, assessment }
}
