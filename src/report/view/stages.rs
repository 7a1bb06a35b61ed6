//! Stages of construction as a film, a frame a stage; blocks that can be taken out as colours.

use super::{Course, View};
use check::{
    proof::{Answer, result::ResultFile, stages::StageResult},
    verdict::Verdict,
};
use dynamics::{Fidelity, Frame, Pose};
use model::{assembly, interface::Model};
use nalgebra::{UnitQuaternion, Vector3};

/// A number for every block, which is shown by colour.
#[derive(Clone, Debug, PartialEq)]
pub struct ViewValues {
    /// What it says.
    pub name: String,
    /// Words for 0 and for 1.
    pub ends: [String; 2],
    /// From 0 to 1, where there is one; one a block.
    pub of: Vec<Option<f64>>,
}

/// What can be taken out: the class of such a block in a drawing, and of one of which that is not
/// known.
const CLASSES: [&str; 2] = ["goes", "open"];

impl View {
    /// Adds what there is to see of stages.
    pub(super) fn stage(&mut self, model: &Model, file: &ResultFile) {
        let Some(result) = &file.stages else { return };
        let scene = &file.scene.input;
        let Ok(list) = assembly::asked_stages(result.asked(), scene, &model.assembly) else {
            return;
        };
        if list.is_empty() || list.len() != result.list.len() {
            return;
        }
        self.film = (0..list.len()).map(|k| self.frame((k + 1) as f64)).collect();
        self.course = Course {
            name: "stage by stage".into(),
            quantity: "Stage",
            unit: "",
            way: "",
            opens: result.list.iter().position(|s| s.name == result.answer().worst),
            words: list
                .iter()
                .zip(&result.list)
                .enumerate()
                .map(|(k, (_, s))| words(k, s))
                .collect(),
            hidden: list.iter().map(|s| s.present.iter().map(|p| !p).collect()).collect(),
            ..Course::default()
        };
        let first = |i: usize| list.iter().position(|s| s.present[i]);
        let last = (list.len() - 1).max(1) as f64;
        let of = (0..self.bodies.len()).map(|i| first(i).map(|k| k as f64 / last)).collect();
        let ends = [1, list.len()].map(|k| format!("stage {k}"));
        self.values = Some(ViewValues { name: "Stage of placement".into(), ends, of });
    }

    /// Every block where it is.
    fn frame(&self, time: f64) -> Frame {
        let still = |b: &super::BlockView| Pose {
            center: b.center,
            turn: UnitQuaternion::identity(),
            velocity: Vector3::zeros(),
            spin: Vector3::zeros(),
        };
        Frame {
            time,
            fidelity: Fidelity::Fine,
            relative: 0.0,
            energy: 0.0,
            blocks: self.bodies.iter().map(still).collect(),
        }
    }

    /// Adds what can be taken out.
    pub(super) fn removals(&mut self, model: &Model, file: &ResultFile) {
        let Answer::Without(a) = &file.answer else { return };
        let mut of = vec![None; self.bodies.len()];
        for w in &a.each {
            let Some(i) = model.assembly.find(&w.block) else { return };
            of[i] = Some(match w.left.verdict {
                Verdict::Stable => 0.0,
                Verdict::Conditional | Verdict::Undecided => 0.5,
                Verdict::Unstable => 1.0,
            });
        }
        let ends = ["the rest stands", "the rest falls"].map(String::from);
        self.values = Some(ViewValues { name: "Taken out by itself".into(), ends, of });
    }

    /// The class of a block in a drawing, and what it means.
    pub fn class(&self, i: usize) -> (&'static str, &'static str) {
        let value = self.values.as_ref().filter(|_| self.film.is_empty()).and_then(|v| v.of[i]);
        match value {
            Some(0.0) => (CLASSES[0], "can be taken out"),
            Some(0.5) => (CLASSES[1], "self-stress, or undecided"),
            _ => ("block", ""),
        }
    }
}

fn words(k: usize, s: &StageResult) -> String {
    let verdict = match s.stands() {
        Verdict::Stable => "stands",
        Verdict::Conditional => "only with self-stress",
        Verdict::Unstable => "falls",
        Verdict::Undecided => "undecided",
    };
    format!("{}. {}: {verdict}", k + 1, s.name)
}
