//! Predictions held against tests of laboratories: a folder for each group of tests, with
//! `experiment.json` and the scenes that it names.

use crate::RowAnswer;
use analysis::{Answer, Control, Question, ask, follow::answer::PointProof};
use base::{
    error::{InputError, JsonPath},
    limits,
};
use cholesky::parallel;
use model::interface::prepare;
use scene::{Source, read_str};
use serde::{Deserialize, Serialize};
use serde_json::Value;
use serde_with::skip_serializing_none;
use solve::deadline::Deadline;
use std::{
    collections::BTreeMap,
    path::{Path, PathBuf},
    time::Instant,
};

/// The file of a group.
const FILE: &str = "experiment.json";
/// A prediction may take so long, s.
const PATIENCE: f64 = 60.0;

/// The version of the format.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum ExperimentFormat {
    /// Version 1.
    #[default]
    #[serde(rename = "voussoir-experiment/1")]
    V1,
}

/// A group of tests: `experiment.json`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Experiment {
    /// The format and its version.
    pub format: ExperimentFormat,
    /// What was tested.
    pub name: String,
    /// Who tested it, and where the numbers were read.
    pub source: String,
    /// The scene of tests that name none, beside this file.
    pub scene: PathBuf,
    /// What is asked: a load factor, or a curve.
    pub question: Question,
    /// What was measured. A load factor of 1 is one unit of it.
    pub quantity: String,
    /// Its unit; empty for a ratio.
    pub unit: String,
    /// What was assumed, as far as it is not published.
    #[serde(default)]
    pub assumed: Vec<Assumed>,
    /// What the model leaves out.
    pub left_out: String,
    /// Whether a number that governs is not published.
    #[serde(default)]
    pub unknown: bool,
    /// The tests.
    pub tests: Vec<Test>,
}

/// A number that was assumed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Assumed {
    /// What it is.
    pub what: String,
    /// Where it stands in the scenes (JSON pointer).
    pub pointer: String,
    /// Between which values it may lie.
    pub between: [f64; 2],
    /// Why.
    pub why: String,
}

/// A test.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Test {
    /// Its name in the source.
    pub name: String,
    /// Its scene, where it is another one.
    #[serde(default)]
    pub scene: Option<PathBuf>,
    /// What differs in it, by JSON pointer.
    #[serde(default)]
    pub set: BTreeMap<String, Value>,
    /// What was measured, once for each specimen.
    #[serde(default)]
    pub measured: Vec<f64>,
    /// A measured curve: pairs of the path's parameter and the value there.
    #[serde(default)]
    pub curve: Vec<[f64; 2]>,
    /// What the curve goes along.
    #[serde(default)]
    pub along: String,
}

/// A measurement and its prediction.
#[skip_serializing_none]
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Compared {
    /// The folder of the group.
    pub group: String,
    /// What was tested.
    pub tested: String,
    /// The test.
    pub test: String,
    /// Of a curve where on it.
    pub at: Option<f64>,
    /// Mean of what was measured.
    pub measured: f64,
    /// Least and greatest of the specimens.
    pub scatter: [f64; 2],
    /// The prediction with dry friction.
    pub predicted: Option<f64>,
    /// Its least and greatest value within what was assumed, one number at a time.
    pub band: Option<[f64; 2]>,
    /// Unit of all these.
    pub unit: String,
    /// Whether a number that governs is not published.
    pub unknown: bool,
    /// Why there is no prediction.
    pub why: Option<String>,
    /// Seconds that all predictions of this test took.
    pub seconds: f64,
}

impl Compared {
    /// Measured over predicted.
    pub fn ratio(&self) -> Option<f64> {
        self.predicted.filter(|p| *p > 0.0).map(|p| self.measured / p)
    }
}

/// A group with its folder.
#[derive(Clone, Debug)]
pub struct Group {
    /// Its name: that of the folder.
    pub name: String,
    folder: PathBuf,
    /// What is in its file.
    pub experiment: Experiment,
}

/// The groups of a corpus, by name; only those that are named, where any is.
///
/// # Errors
/// There is no corpus or no such group, or a file is none.
pub fn groups(corpus: &Path, only: &[String]) -> Result<Vec<Group>, InputError> {
    let refuse = |text: String| InputError::at(JsonPath::root(), text);
    let entries = std::fs::read_dir(corpus).map_err(|e| {
        refuse(format!("{}: no folder of experiments: {e}", corpus.display())).hint(
            "name the folder that holds one folder a group: --experiments structures/experiments",
        )
    })?;
    let mut list = Vec::new();
    for folder in entries.filter_map(|e| Some(e.ok()?.path())) {
        if !folder.join(FILE).is_file() {
            continue;
        }
        let name = folder.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let source = read(&folder.join(FILE))?;
        let experiment: Experiment =
            serde_json::from_str(&source.text).map_err(|e| InputError {
                file: Some(source.name.clone()),
                position: Some((e.line(), e.column())),
                ..refuse(e.to_string())
            })?;
        list.push(Group { name, folder, experiment });
    }
    list.sort_by(|a, b| a.name.cmp(&b.name));
    let names = || list.iter().map(|g| g.name.as_str()).collect::<Vec<_>>().join(", ");
    if list.is_empty() {
        return Err(refuse(format!("{}: no folder in it holds {FILE}", corpus.display())));
    }
    if let Some(none) = only.iter().find(|o| list.iter().all(|g| g.name != **o)) {
        return Err(refuse(format!("there is no group {none:?}"))
            .hint(format!("the groups are {}", names())));
    }
    list.retain(|g| only.is_empty() || only.contains(&g.name));
    Ok(list)
}

/// How many predictions these groups ask for at most.
pub fn count(groups: &[Group]) -> usize {
    groups.iter().map(|g| g.experiment.tests.len() * (1 + 2 * g.experiment.assumed.len())).sum()
}

/// Predicts every test of these groups; `done` hears of each.
///
/// # Errors
/// A scene cannot be read, or a pointer leads nowhere.
pub fn compare(groups: &[Group], done: impl Fn() + Sync) -> Result<Vec<Compared>, InputError> {
    // Specimens of one test share its prediction.
    let mut alike: Vec<(&Group, Vec<&Test>)> = Vec::new();
    for group in groups {
        for test in &group.experiment.tests {
            let known =
                alike.iter_mut().find(|(g, own)| g.name == group.name && own[0].is_like(test));
            match known {
                Some((_, own)) => own.push(test),
                None => alike.push((group, vec![test])),
            }
        }
    }
    // Each with the numbers as given, then with each end of what was assumed.
    let mut asked = Vec::new();
    for (k, (group, tests)) in alike.iter().enumerate() {
        for end in std::iter::once(None).chain(group.ends().map(Some)) {
            asked.push((k, *group, tests[0], end));
        }
    }
    let one = |&(_, group, test, end): &(usize, &Group, &Test, Option<(&str, f64)>)| {
        let begun = Instant::now();
        let values = group.predict(test, end)?;
        Ok((values, begun.elapsed().as_secs_f64()))
    };
    let one = |asked: &_| one(asked).inspect(|_| done());
    let found: Vec<(Vec<Predicted>, f64)> = parallel::try_map(0, &asked, one).map_err(|e| {
        InputError::at(JsonPath::root(), format!("threads cannot be started: {e}"))
    })??;
    let mut list = Vec::new();
    for (k, (group, tests)) in alike.iter().enumerate() {
        let own: Vec<&(Vec<Predicted>, f64)> =
            asked.iter().zip(&found).filter(|(a, _)| a.0 == k).map(|(_, f)| f).collect();
        tests.iter().for_each(|test| list.extend(group.compared(test, &own)));
    }
    Ok(list)
}

/// A value, or why there is none.
type Predicted = Result<f64, String>;

impl Test {
    /// Whether another test asks the same of the same scene.
    fn is_like(&self, other: &Self) -> bool {
        let asked = |t: &Self| (t.scene.clone(), t.set.clone(), t.curve.clone());
        asked(self) == asked(other)
    }
}

fn read(path: &Path) -> Result<Source, InputError> {
    scene::text(path.display().to_string(), limits::read_file(path, limits::PER_BYTE)?)
}

impl Group {
    /// The ends of what was assumed: pointers and values.
    fn ends(&self) -> impl Iterator<Item = (&str, f64)> {
        let all = self.experiment.assumed.iter();
        all.flat_map(|a| a.between.map(|end| (a.pointer.as_str(), end)))
    }

    /// What the scene of a test gives, with another number in it where one is given.
    fn predict(
        &self,
        test: &Test,
        other: Option<(&str, f64)>,
    ) -> Result<Vec<Predicted>, InputError> {
        let own = &self.experiment;
        let source = read(&self.folder.join(test.scene.as_ref().unwrap_or(&own.scene)))?;
        let named = |e: InputError| InputError { file: Some(source.name.clone()), ..e };
        let invalid = |e: serde_json::Error| named(InputError::at(JsonPath::root(), e.to_string()));
        let mut scene: Value = serde_json::from_str(&source.text).map_err(invalid)?;
        for (pointer, value) in &test.set {
            set(&mut scene, pointer, value.clone()).map_err(named)?;
        }
        if let Some((pointer, value)) = other {
            set(&mut scene, pointer, value.into()).map_err(named)?;
        }
        Ok(predict(&source.name, &scene, &own.question, test))
    }

    /// Measurements of a test with what was predicted: as given, then at the ends of what was assumed.
    fn compared(&self, test: &Test, found: &[&(Vec<Predicted>, f64)]) -> Vec<Compared> {
        let own = &self.experiment;
        let Some(((given, _), others)) = found.split_first() else { return Vec::new() };
        let one = |(k, predicted): (usize, &Predicted)| {
            let at = test.curve.get(k);
            let values = at.map_or(&test.measured[..], |p| &p[1..]);
            let mean = values.iter().sum::<f64>() / values.len().max(1) as f64;
            let ends = |all: &mut dyn Iterator<Item = f64>, first: f64| {
                all.fold([first; 2], |[low, high], v| [low.min(v), high.max(v)])
            };
            let predicted_here = predicted.as_ref().ok().copied();
            let mut changed =
                others.iter().filter_map(|(values, _)| values.get(k)?.as_ref().ok().copied());
            Compared {
                group: self.name.clone(),
                tested: own.name.clone(),
                test: test.name.clone(),
                at: at.map(|p| p[0]),
                measured: mean,
                scatter: ends(&mut values.iter().copied(), mean),
                predicted: predicted_here,
                band: predicted_here
                    .filter(|_| !others.is_empty())
                    .map(|value| ends(&mut changed, value)),
                unit: own.unit.clone(),
                unknown: own.unknown,
                why: predicted.as_ref().err().cloned(),
                seconds: found.iter().map(|f| f.1).sum(),
            }
        };
        given.iter().enumerate().map(one).collect()
    }
}

/// The values that a scene gives: one, or one for each point of a curve.
fn predict(name: &str, scene: &Value, question: &Question, test: &Test) -> Vec<Predicted> {
    let all = |why: String| vec![Err(why); test.curve.len().max(1)];
    let mut question = question.clone();
    if let Question::Push(push) = &mut question {
        push.at = test.curve.iter().map(|p| p[0]).collect();
    }
    let asked = read_str(name, scene.to_string()).and_then(|(scene, _)| {
        let model = prepare(&scene)?;
        let control = Control { deadline: Deadline::within(PATIENCE), ..Control::default() };
        ask(&question, &scene, &model, &control)
    });
    match asked {
        Err(e) => all(e.to_string()),
        Ok(Answer::Path(path)) if !test.curve.is_empty() => {
            let at = |wanted: f64| {
                let near = |v: f64| (v - wanted).abs() <= 1e-9 * wanted.abs();
                let proved = |proof: &PointProof| proof.claim.is_some();
                let points = path.path.points.iter().zip(&path.proofs);
                let point = points.into_iter().find(|(p, proof)| near(p.value) && proved(proof));
                point.map(|(p, _)| p.load_factor).ok_or("the path does not reach it".to_string())
            };
            test.curve.iter().map(|p| at(p[0])).collect()
        }
        Ok(answer) => {
            let row = RowAnswer::of_answer(&answer);
            vec![row.value.ok_or(row.status.word().to_string())]
        }
    }
}

/// Puts a value into a scene where there is one.
fn set(scene: &mut Value, pointer: &str, value: Value) -> Result<(), InputError> {
    match scene.pointer_mut(pointer) {
        Some(old) => {
            *old = value;
            Ok(())
        }
        None => Err(InputError::at(JsonPath::root(), format!("{pointer:?} leads nowhere"))
            .hint(format!("mend it in {FILE}"))),
    }
}

/// Number, mean, coefficient of variation and range of measured over predicted.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Ratios {
    /// How many have a prediction.
    pub count: usize,
    /// Their mean.
    pub mean: f64,
    /// Their standard deviation (of a sample) over the mean; 0 of one.
    pub cov: f64,
    /// The least and the greatest.
    pub range: [f64; 2],
}

/// The ratios of measurements, where any has a prediction.
pub fn ratios<'a>(list: impl IntoIterator<Item = &'a Compared>) -> Option<Ratios> {
    let all: Vec<f64> = list.into_iter().filter_map(Compared::ratio).collect();
    let count = all.len();
    let mean = all.iter().sum::<f64>() / count as f64;
    let squares: f64 = all.iter().map(|r| (r - mean).powi(2)).sum();
    let deviation = if count > 1 { (squares / (count - 1) as f64).sqrt() } else { 0.0 };
    let range = [f64::min, f64::max].map(|of| all.iter().copied().fold(mean, of));
    (count > 0).then(|| Ratios { count, mean, cov: deviation / mean, range })
}
