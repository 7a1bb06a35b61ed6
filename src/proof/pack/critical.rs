//! The flips of a verdict, each with a proof on both sides.

use super::{assessment, certificate};
use crate::{
    analysis::{
        Assessment, Critical, Proved,
        critical::{Change, Scanned},
        flip::Probe,
    },
    interface::Model,
    proof::{
        answer::Answer,
        certificate::Certificate,
        critical::{CriticalResult, FlipResult, ScanPoint, Side, is_narrow, middle},
        result::{QuestionKind, ResultFile},
    },
    scene::Scene,
    terms::Method,
};

impl Side {
    /// A probe with its proof.
    pub fn of(probe: &Probe<Proved<Assessment>>) -> Self {
        let answer = Answer::Verdict(assessment(&probe.assessment));
        let certificate = certificate(&probe.model, &probe.assessment);
        Self { value: probe.value, answer, certificate }
    }
}

impl FlipResult {
    /// A flip with its proofs.
    pub fn of(f: &Change) -> Self {
        // Ends that are far apart prove no more than that there is a flip between them.
        let known = f.method != Method::Scan && is_narrow(f.below.value, f.above.value);
        let (value, method) = if known {
            (f.value, f.method)
        } else {
            (middle(f.below.value, f.above.value), Method::Scan)
        };
        Self { value, method, below: Side::of(&f.below), above: Side::of(&f.above) }
    }
}

impl ResultFile {
    /// The result of `critical`; `model` is that of the scene as it was given.
    pub fn critical(scene: &Scene, model: &Model, c: &Critical) -> Self {
        let flips: Vec<FlipResult> = c.changes.iter().map(FlipResult::of).collect();
        let values = flips.iter().filter_map(FlipResult::proved).collect();
        let answer = Answer::Critical(values);
        let mut file = Self::new(QuestionKind::Critical, scene, model, answer, Certificate::none());
        file.critical = Some(CriticalResult {
            vary: c.range.pointer.clone(),
            between: [c.range.from, c.range.to],
            whole: c.whole,
            law: c.law,
            scan: c.scan.iter().map(scan_point).collect(),
            flips,
            ends: c.ends.iter().map(Side::of).collect(),
            notes: c.notes.clone(),
            scenes: c.probes,
        });
        for probe in c.changes.iter().flat_map(|f| [&f.below, &f.above]).chain(&c.ends) {
            file.warn(&probe.assessment);
        }
        file
    }
}

fn scan_point(s: &Scanned) -> ScanPoint {
    let (verdict, unbalance, error) = match &s.outcome {
        Ok((verdict, unbalance)) => (Some(*verdict), Some(*unbalance), None),
        Err(e) => (None, None, Some(e.to_string())),
    };
    ScanPoint { value: s.value, verdict, unbalance, error }
}
