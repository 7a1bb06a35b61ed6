//! The flips of a verdict, each with a proof on both sides.

use super::{certificate, verdict_answer, warn};
use crate::{
    Assessment, Critical, Proved,
    critical::{Change, Scanned},
    critical_value::Probe,
};
use check::{
    proof::{
        answer::Answer,
        certificate::Certificate,
        critical::{CriticalResult, FlipResult, ScanPoint, Side, is_narrow, middle},
        result::{QuestionKind, ResultFile},
    },
    terms::Method,
};
use model::interface::Model;
use scene::Scene;

/// A probe with its proof.
pub fn side(probe: &Probe<Proved<Assessment>>) -> Side {
    let answer = Answer::Verdict(verdict_answer(&probe.assessment));
    let certificate = certificate(&probe.model, &probe.assessment);
    Side { value: probe.value, answer, certificate }
}

/// A flip with its proofs.
pub fn flip(f: &Change) -> FlipResult {
    // Ends that are far apart prove no more than that there is a flip between them.
    let known = f.method != Method::Scan && is_narrow(f.below.value, f.above.value);
    let (value, method) = if known {
        (f.value, f.method)
    } else {
        (middle(f.below.value, f.above.value), Method::Scan)
    };
    FlipResult { value, method, below: side(&f.below), above: side(&f.above) }
}

/// The result of `critical`; `model` is that of the scene as it was given.
pub fn critical(scene: &Scene, model: &Model, c: &Critical) -> ResultFile {
    let flips: Vec<FlipResult> = c.changes.iter().map(flip).collect();
    let values = flips.iter().filter_map(FlipResult::proved).collect();
    let answer = Answer::Critical(values);
    let mut file =
        ResultFile::new(QuestionKind::Critical, scene, model, answer, Certificate::none());
    file.critical = Some(CriticalResult {
        vary: c.range.pointer.clone(),
        between: [c.range.from, c.range.to],
        whole: c.whole,
        law: c.law,
        scan: c.scan.iter().map(scan_point).collect(),
        flips,
        ends: c.ends.iter().map(side).collect(),
        notes: c.notes.clone(),
        scenes: c.probes,
    });
    for probe in c.changes.iter().flat_map(|f| [&f.below, &f.above]).chain(&c.ends) {
        warn(&mut file, &probe.assessment);
    }
    file
}

fn scan_point(s: &Scanned) -> ScanPoint {
    let (verdict, unbalance, error) = match &s.outcome {
        Ok((verdict, unbalance)) => (Some(*verdict), Some(*unbalance), None),
        Err(e) => (None, None, Some(e.to_string())),
    };
    ScanPoint { value: s.value, verdict, unbalance, error }
}
