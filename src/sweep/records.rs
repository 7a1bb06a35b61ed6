//! Records of ground motion that a plan names: read once, when it is opened.

use super::{Parameter, Plan};
use analysis::Question;
use base::error::{InputError, JsonPath};
use check::ground::{Given, Record, Recorded, Series};
use std::{fs, path::Path};

/// Where questions name their record.
const RECORDS: [&str; 2] = ["/question/rock/ground/record", "/question/shake/ground/record"];

/// Whether a pointer is that of a record.
pub(super) fn is_record(pointer: &str) -> bool {
    RECORDS.contains(&pointer)
}

/// How the ground moves in a question, where it does.
fn ground(question: &mut Question) -> Option<&mut Given> {
    match question {
        Question::Rock(o) => Some(&mut o.ground),
        Question::Shake(o) => Some(&mut o.ground),
        _ => None,
    }
}

/// Puts every record of a folder among the values, then reads all records that are named.
///
/// # Errors
/// A folder or a record cannot be read; paths are relative to the plan.
pub(super) fn read(plan: &mut Plan, folder: &Path) -> Result<(), InputError> {
    let root = JsonPath::root();
    let mut wanted: Vec<(JsonPath, String)> = Vec::new();
    if let Some(Given { record: Some(Recorded::Named(name)), .. }) = ground(&mut plan.question) {
        wanted.push((root.key("question"), name.clone()));
    }
    for (k, vary) in plan.vary.iter_mut().enumerate() {
        let path = root.key("vary").index(k);
        if let Some(name) = &vary.folder {
            let at = path.key("folder");
            if !is_record(&vary.pointer) {
                return Err(InputError::at(
                    at,
                    "only ground-motion records can be read from a folder",
                )
                .hint(format!("the pointer of a record is {:?} or {:?}", RECORDS[0], RECORDS[1])));
            }
            if vary.values.is_some() {
                return Err(InputError::at(at, "\"folder\" and \"values\" cannot be combined"));
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
        if is_record(&vary.pointer) {
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
            InputError::at(path, format!("the record {name}{place}: {}", e.message)).hint(
                "a record of a plan must state its units, for example in a column \"a (m/s2)\"",
            )
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
    let word = question.word();
    if let Some(given) = ground(&mut question)
        && let Some(Recorded::Named(name)) = &given.record
    {
        let Some(series) = plan.records.iter().find(|r| r.name == *name) else {
            let text = format!("there is no record {name:?}");
            let path = JsonPath::root().key(word).key("ground").key("record");
            return Err(InputError::at(path, text));
        };
        given.record = Some(Recorded::Read(series.clone()));
    }
    Ok(question)
}
