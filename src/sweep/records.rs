//! Records of ground motion that a plan names: read once, when it is opened.

use super::{Parameter, Plan};
use crate::{
    analysis::Question,
    error::{InputError, JsonPath},
    ground::{Record, Recorded, Series},
};
use std::{fs, path::Path};

/// Where a question names its record.
pub(super) const RECORD: &str = "/question/rock/ground/record";

/// Puts every record of a folder among the values, then reads all records that are named.
///
/// # Errors
/// A folder or a record cannot be read; paths are relative to the plan.
pub(super) fn read(plan: &mut Plan, folder: &Path) -> Result<(), InputError> {
    let root = JsonPath::root();
    let mut wanted: Vec<(JsonPath, String)> = Vec::new();
    if let Question::Rock(o) = &plan.question
        && let Some(Recorded::Named(name)) = &o.ground.record
    {
        wanted.push((root.key("question"), name.clone()));
    }
    for (k, vary) in plan.vary.iter_mut().enumerate() {
        let path = root.key("vary").index(k);
        if let Some(name) = &vary.folder {
            let at = path.key("folder");
            if vary.pointer != RECORD {
                return Err(InputError::at(at, "only records are taken from a folder")
                    .hint(format!("its pointer is {RECORD:?}")));
            }
            if vary.values.is_some() {
                return Err(InputError::at(at, "a folder and values are both given"));
            }
            let names = files(&folder.join(name))
                .map_err(|e| InputError::at(at.clone(), format!("the folder {name}: {e}")))?;
            if names.is_empty() {
                let error = InputError::at(at, format!("the folder {name} holds no record"));
                return Err(error.hint("records end in .csv, .at2 or .asc"));
            }
            let named = names.iter().map(|n| Parameter::Word(format!("{name}/{n}")));
            vary.values = Some(named.collect());
            vary.folder = None;
        }
        if vary.pointer == RECORD {
            let words = vary.values.iter().flatten().filter_map(|v| match v {
                Parameter::Word(word) => Some(word.clone()),
                Parameter::Number(_) => None,
            });
            wanted.extend(words.map(|word| (path.key("values"), word)));
        }
    }
    for (path, name) in wanted {
        if plan.records.iter().any(|r| r.name == name) {
            continue;
        }
        let file = folder.join(&name);
        let record = Record::read(&[file.as_path()], None).map_err(|e| {
            // A plan has no option that says units.
            let place = e.position.map_or(String::new(), |(line, _)| format!(":{line}"));
            InputError::at(path, format!("the record {name}{place}: {}", e.message))
                .hint("a record of a plan says its units itself: a column \"a (m/s2)\"")
        })?;
        plan.records.push(Series { name, ..Series::of(&record) });
    }
    Ok(())
}

/// Names of the records in a folder, in order.
fn files(folder: &Path) -> std::io::Result<Vec<String>> {
    let mut names = Vec::new();
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        let ending = path.extension().map(|e| e.to_ascii_lowercase());
        let known = ending.is_some_and(|e| ["csv", "at2", "asc"].iter().any(|k| e == *k));
        if let (true, Some(name)) = (known, path.file_name()) {
            names.push(name.to_string_lossy().into_owned());
        }
    }
    names.sort();
    Ok(names)
}

/// The question with the record it names.
///
/// # Errors
/// The plan has no such record.
pub(super) fn with_record(plan: &Plan, mut question: Question) -> Result<Question, InputError> {
    if let Question::Rock(o) = &mut question
        && let Some(Recorded::Named(name)) = &o.ground.record
    {
        let Some(series) = plan.records.iter().find(|r| r.name == *name) else {
            let text = format!("there is no record {name:?}");
            let path = JsonPath::root().key("rock").key("ground").key("record");
            return Err(InputError::at(path, text));
        };
        o.ground.record = Some(Recorded::Read(series.clone()));
    }
    Ok(question)
}
