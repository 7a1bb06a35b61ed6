//! A train on its way as a film: one frame a position, each with the mechanism that starts there.

use super::{BlockView, Course, View, ViewMotion, ViewPart};
use base::number::rounded_down;
use check::{
    proof::result::ResultFile,
    verdict::{claim::Claim, evidence::read_rates},
};
use dynamics::{Fidelity, Frame, Pose};
use model::{interface::Model, train::Way};
use nalgebra::Vector3;

/// The mechanisms are shown so far along that the farthest corner has come this share of the size of
/// the scene. More: blocks part that only turn about a hinge. Less: nothing is seen.
const SHOWN: f64 = 0.03;

impl Course {
    /// That of a train over the frames of its positions, with the load factor and the loads at each;
    /// it opens with the worst.
    pub(super) fn train(file: &ResultFile, way: &Way, film: &[Frame]) -> Self {
        let worst = file.answer.moving();
        let here = |f: &Frame| {
            let all = file.directions.iter().filter_map(|d| d.answer.moving());
            let own = all.filter(|a| worst.is_some_and(|w| w.travel == a.travel));
            own.into_iter().find(|a| a.x == f.time)
        };
        let label = |f: &Frame| {
            let value = here(f).and_then(|a| a.load_factor.value);
            value.map_or(String::new(), |v| format!("λ = {}", rounded_down(v)))
        };
        let loads = |f: &Frame| {
            let there = here(f).and_then(|a| way.at(a.position()).ok().flatten());
            there.map_or_else(Vec::new, |there| super::loads(&there.model))
        };
        Self {
            opens: film.iter().position(|f| worst.is_some_and(|w| w.x == f.time)),
            labels: film.iter().map(label).collect(),
            loads: film.iter().map(loads).collect(),
            name: "train, position by position".into(),
            quantity: "Position of the train",
            unit: "m",
            way: "displacement in the mechanism shown",
            ..Self::default()
        }
    }
}

/// The positions of a train in the direction of travel of the answer, where a mechanism is proved.
pub fn positions(model: &Model, file: &ResultFile) -> Vec<Frame> {
    let Some(worst) = file.answer.moving() else { return Vec::new() };
    let view = View::bare(model);
    let frame = |d: &check::proof::told::Direction| {
        let a = d.answer.moving().filter(|a| a.travel == worst.travel)?;
        matches!(d.certificate.claim, Some(Claim::LoadFactor { .. })).then_some(())?;
        let rates = read_rates(&model.assembly, &d.certificate.rates).ok()?;
        let motion = ViewMotion::new(model, ViewPart::Answer, "", rates, &view.bodies)?;
        let pose = |(k, body): (usize, &BlockView)| {
            let pose = motion.pose(k, SHOWN * view.size());
            Pose {
                center: body.center + pose.shift,
                turn: pose.turn,
                velocity: Vector3::zeros(),
                spin: Vector3::zeros(),
            }
        };
        Some(Frame {
            time: a.x,
            fidelity: Fidelity::Fine,
            relative: 0.0,
            energy: 0.0,
            blocks: view.bodies.iter().enumerate().map(pose).collect(),
        })
    };
    file.directions.iter().filter_map(frame).collect()
}
