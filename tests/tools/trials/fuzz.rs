//! Every reader, given what was changed at random: an error with its place or a sound value, no panic,
//! and not for long. Without knowledge of the code, unlike `fuzz/`, but without its tools, too.

use crate::random::Random;
use analysis::{Question, ask, follow::crack::Cracks, saved};
use base::{
    error::{InputError, JsonPath},
    limits,
};
use check::{
    ground::Record,
    proof::{read, recompute::Nothing, verify::verify_model},
};
use model::interface::prepare_until;
use scene::{
    Protocol,
    import::{ImportOptions, import_bytes},
    read_bytes, read_str,
};
use serde::Serialize;
use serde_json::{Value, json};
use std::{
    fmt::Write,
    panic::{AssertUnwindSafe, catch_unwind},
    path::{Path, PathBuf},
    time::Instant,
};
use sweep::{Sweep, parse_rows, read_plan, summarize};

/// An input that takes longer hangs, s.
pub const HANGS: f64 = 5.0;
/// What a stage that looks at the time is given, s.
const GIVEN: f64 = 1.0;
/// Memory that inputs may ask for, bytes.
const MEMORY: u64 = 1 << 30;
/// Longest seed, bytes.
const SEED: u64 = 16 << 10;

/// A reader: what it does with a file of that name, and whether it took it.
type Reader = fn(&str, &[u8]) -> Result<(), InputError>;

const READERS: [(&str, Reader); 7] = [
    ("scene", scene),
    ("plan", plan),
    ("result", result),
    ("rows", rows),
    ("foreign file", foreign),
    ("ground record", record),
    ("cracks, protocol", lists),
];

/// What became of the inputs of one reader.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Fuzzed {
    /// Which one.
    pub reader: &'static str,
    /// Inputs.
    pub inputs: usize,
    /// Of them those that were taken.
    pub taken: usize,
    /// Those that it panicked at, or that took longer than [`HANGS`]: by their numbers.
    pub failed: Vec<usize>,
    /// The longest that one took, s.
    pub slowest: f64,
    /// Which one that was.
    pub slowest_input: usize,
}

impl Fuzzed {
    /// Whether it broke a promise.
    pub fn is_wrong(&self) -> bool {
        !self.failed.is_empty()
    }
}

/// Files to begin from, by the reader that takes them.
struct Seeds(Vec<Vec<(String, Vec<u8>)>>);

fn under(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../..").join(path)
}

fn files(folder: &str, wanted: impl Fn(&str) -> bool) -> anyhow::Result<Vec<(String, Vec<u8>)>> {
    let mut list = Vec::new();
    for entry in std::fs::read_dir(under(folder))? {
        let entry = entry?;
        let name = entry.file_name().to_string_lossy().into_owned();
        let there = entry.metadata()?;
        if there.is_file() && there.len() <= SEED && wanted(&name) {
            list.push((name, std::fs::read(entry.path())?));
        }
    }
    list.sort();
    Ok(list)
}

impl Seeds {
    fn find() -> anyhow::Result<Self> {
        let json = |name: &str| name.ends_with(".json") && name != "expected.json";
        let scenes = files("structures", json)?;
        let plans = files("structures/sweeps", json)?;
        let mut foreign = files("fuzz/import", |_| true)?;
        for format in ["", "mjcf", "urdf", "sdf", "gltf"] {
            let folder = format!("tests/formats/{format}");
            foreign.extend(files(&folder, |n| !n.ends_with(".py") && n != "expected.json")?);
        }
        let records = files("structures/records", |name| name.ends_with(".csv"))?;
        let (mut results, mut rows) = (Vec::new(), Vec::new());
        for name in ["wedge", "squeezed-block", "tied-arch", "three-cylinders"] {
            let text = std::fs::read_to_string(under(&format!("structures/{name}.json")))?;
            let (scene, _) = read_str(name, text)?;
            let model = prepare_until(&scene, &|| false)?;
            for question in
                [Question::Assess(Default::default()), Question::Limit(Default::default())]
            {
                let control = Default::default();
                let Ok(answer) = ask(&question, &scene, &model, &control) else { continue };
                let file = saved::of_question(&question, &scene, &model, &answer, &control)?;
                let bytes = serde_json::to_vec(&file.to_value()?)?;
                results.push((format!("{name}.json"), bytes));
            }
        }
        let sweep = Sweep::new(read_plan("plan", PLAN.into())?.0, ground())?;
        let folder = std::env::temp_dir().join(format!("voussoir-fuzz-{}", std::process::id()));
        let done = sweep::run(&sweep, &folder, &Default::default(), &|_| {});
        rows.push(("rows.jsonl".into(), std::fs::read(&folder)?));
        std::fs::remove_file(&folder)?;
        done?;
        let crack = json!({ "cracks": [{ "between": ["v03", "v04"], "side": "intrados", "width": 0.004 }] });
        let lists = vec![("cracks.json".into(), serde_json::to_vec(&crack)?)];
        Ok(Self(vec![scenes, plans, results, rows, foreign, records, lists]))
    }
}

const PLAN: &str = r#"{ "format": "voussoir-sweep/1", "scene": "s.json", "question": { "limit": { "law": "associative" } }, "seed": 1,
  "vary": [{ "pointer": "/joints/default/friction", "values": [0.1, 0.3, 0.6] }], "sampling": { "grid": {} } }"#;

/// A block on the ground under a load.
fn ground() -> Value {
    json!({
        "format": "voussoir-scene/1", "materials": { "m": { "density": 2400 } }, "joints": { "default": { "friction": 0.6 } },
        "blocks": [
            { "id": "t", "shape": { "box": { "size": [4, 4, 1] } }, "at": [0, 0, -0.5], "support": true },
            { "id": "b", "shape": { "box": { "size": [0.4, 1, 1] } }, "at": [0, 0, 0.5], "material": "m" }
        ],
        "loads": { "live": [{ "weight": [1, 0, 0] }] }
    })
}

/// Gives so many inputs to the readers in turn; `report` hears of each thousandth.
///
/// # Errors
/// The files to begin from cannot be read.
pub fn run(seed: u64, count: usize, report: impl Fn(usize)) -> anyhow::Result<Vec<Fuzzed>> {
    limits::set_memory(Some(MEMORY));
    let seeds = Seeds::find()?;
    let mut list: Vec<Fuzzed> =
        READERS.iter().map(|(reader, _)| Fuzzed { reader, ..Fuzzed::default() }).collect();
    for number in 0..count {
        let (k, name, bytes) = input(&seeds, seed, number);
        let begun = Instant::now();
        let done = catch_unwind(AssertUnwindSafe(|| (READERS[k].1)(&name, &bytes)));
        let seconds = begun.elapsed().as_secs_f64();
        let told = &mut list[k];
        told.inputs += 1;
        told.taken += usize::from(matches!(done, Ok(Ok(()))));
        let wordless =
            matches!(&done, Ok(Err(e)) if e.message.is_empty() || e.to_string().len() > 20_000);
        if done.is_err() || wordless || seconds > HANGS {
            told.failed.push(number);
        }
        if seconds > told.slowest {
            (told.slowest, told.slowest_input) = (seconds, number);
        }
        if number % 1000 == 999 {
            report(number + 1);
        }
    }
    Ok(list)
}

/// One input: the number of its reader, its name and its bytes.
///
/// # Errors
/// The files to begin from cannot be read.
pub fn one(seed: u64, number: usize) -> anyhow::Result<(String, Vec<u8>)> {
    let (_, name, bytes) = input(&Seeds::find()?, seed, number);
    Ok((name, bytes))
}

fn input(seeds: &Seeds, seed: u64, number: usize) -> (usize, String, Vec<u8>) {
    let mut random = Random::of(seed, number);
    let k = number % READERS.len();
    let (name, mut bytes) = pick(&seeds.0[k], &mut random).clone();
    for _ in 0..random.count(1, 3) {
        let value = serde_json::from_slice::<Value>(&bytes).ok();
        bytes = match value {
            Some(mut value) if random.chance(0.85) => {
                change(&mut value, &mut random);
                // What a writer of such numbers writes: JSON has none of these.
                let text = value.to_string();
                text.replace("\"NaN\"", "NaN").replace("\"1e999\"", "1e999").into_bytes()
            }
            _ => {
                let others = pick(&seeds.0[random.count(0, READERS.len() - 1)], &mut random);
                changed(bytes, &others.1, &mut random)
            }
        };
    }
    (k, name, bytes)
}

fn pick<'a, T>(list: &'a [T], random: &mut Random) -> &'a T {
    &list[random.count(0, list.len() - 1)]
}

/// A value where another was expected.
fn odd(random: &mut Random) -> Value {
    let deep = |n: usize| (0..n).fold(json!(0), |inside, _| json!([inside]));
    let all = [
        json!(null),
        json!(true),
        json!(0),
        json!(-1),
        json!(1),
        json!(0.5),
        json!(1e308),
        json!(-1e308),
        json!(1e-308),
        json!(1e-320),
        json!(u64::MAX),
        json!(i64::MIN),
        json!(1e15),
        json!("NaN"),
        json!("1e999"),
        json!(""),
        json!("base"),
        json!("infinite"),
        json!("\u{202e}\u{0}x"),
        json!("x".repeat(100_000)),
        json!([]),
        json!({}),
        json!([0, 0, 0]),
        json!([1, 0, 0]),
        json!([[0, 0, 0]]),
        json!(vec![0.1; 5000]),
        deep(120),
        json!(1_000_000_000),
        json!(7),
        json!("../../etc/passwd"),
    ];
    pick(&all, random).clone()
}

/// Changes something somewhere in a value.
fn change(value: &mut Value, random: &mut Random) {
    let inside = random.chance(0.85);
    match value {
        Value::Array(list) if inside && !list.is_empty() => {
            let k = random.count(0, list.len() - 1);
            match random.count(0, 9) {
                0 => drop(list.remove(k)),
                1 => {
                    let again = list[k].clone();
                    let times = if random.chance(0.1) { 2000 } else { 1 };
                    list.extend((0..times).map(|_| again.clone()));
                }
                2 => list.reverse(),
                _ => change(&mut list[k], random),
            }
        }
        Value::Object(map) if inside && !map.is_empty() => {
            let keys: Vec<String> = map.keys().cloned().collect();
            let key = pick(&keys, random);
            match random.count(0, 11) {
                0 => drop(map.remove(key)),
                1 => {
                    let old = map.remove(key).unwrap_or_default();
                    map.insert(pick(&keys, random).clone(), old);
                }
                2 => drop(map.insert("surprise".into(), odd(random))),
                _ => change(map.get_mut(key).unwrap_or(&mut Value::Null), random),
            }
        }
        Value::Number(n) if random.chance(0.5) => {
            let x = n.as_f64().unwrap_or(0.0);
            let factors = [0.0, -1.0, 2.0, 0.5, 1.0 + 1e-15, 1e6, 1e-6, 1e100, 0.999];
            *value = json!(x * pick(&factors, random));
        }
        _ => *value = odd(random),
    }
}

/// Bytes with something changed; `other` is another file.
fn changed(mut bytes: Vec<u8>, other: &[u8], random: &mut Random) -> Vec<u8> {
    let at = random.count(0, bytes.len());
    let to = random.count(at, bytes.len().min(at + 64));
    match random.count(0, 6) {
        0 => bytes.truncate(at),
        1 => drop(bytes.drain(at..to)),
        2 => {
            let again = bytes[at..to].to_vec();
            let times = if random.chance(0.1) { 500 } else { 1 };
            (0..times).for_each(|_| drop(bytes.splice(at..at, again.iter().copied())));
        }
        3 if at < bytes.len() => bytes[at] ^= 1 << random.count(0, 7),
        4 => {
            let from = random.count(0, other.len());
            let piece = &other[from..random.count(from, other.len().min(from + 200))];
            drop(bytes.splice(at..to, piece.iter().copied()));
        }
        5 => {
            let odd: [&[u8]; 9] = [
                b"-",
                b"1e999",
                b"nan",
                b"\0",
                b"\xff\xfe",
                b"\"",
                b"[[[[",
                b"\r\n\r\n",
                b"99999999999999999999",
            ];
            drop(bytes.splice(at..at, pick(&odd, random).iter().copied()));
        }
        _ => {
            let noise: Vec<u8> =
                (0..random.count(1, 16)).map(|_| random.count(0, 255) as u8).collect();
            drop(bytes.splice(at..to, noise));
        }
    }
    bytes
}

fn in_time() -> impl Fn() -> bool {
    let begun = Instant::now();
    move || begun.elapsed().as_secs_f64() > GIVEN
}

fn scene(name: &str, bytes: &[u8]) -> Result<(), InputError> {
    let (scene, source) = read_bytes(name, bytes.to_vec())?;
    let is_over = in_time();
    let model = prepare_until(&scene, &is_over).map_err(|e| source.located(e))?;
    let sound =
        model.assembly.blocks.iter().all(|b| b.mass > 0.0 && b.mass.is_finite() && b.size > 0.0);
    assert!(sound, "a block without a sound mass or size");
    Ok(())
}

fn plan(name: &str, bytes: &[u8]) -> Result<(), InputError> {
    let (plan, source) = read_plan(name, bytes.to_vec())?;
    let sweep = Sweep::new(plan, ground()).map_err(|e| source.located(e))?;
    for row in [0, sweep.rows().saturating_sub(1)] {
        sweep.scene_with(&sweep.parameters(row))?;
    }
    Ok(())
}

fn result(name: &str, bytes: &[u8]) -> Result<(), InputError> {
    let text = String::from_utf8_lossy(bytes).into_owned();
    let saved = read::read_str(name, text)?;
    let is_over = in_time();
    let model = prepare_until(&saved.scene, &is_over)?;
    drop(verify_model(&saved, &saved.scene, &model, &Nothing));
    Ok(())
}

fn rows(name: &str, bytes: &[u8]) -> Result<(), InputError> {
    let wrong = |e: base::error::RowsError| InputError::at(JsonPath::root(), e.to_string());
    let (header, rows) = parse_rows(name, bytes).map_err(wrong)?;
    drop(summarize(&header, &rows));
    Ok(())
}

fn foreign(name: &str, bytes: &[u8]) -> Result<(), InputError> {
    let options = ImportOptions { depth: Some(1.0), ..ImportOptions::default() };
    let imported = import_bytes(name, bytes, &options)?;
    let is_over = in_time();
    drop(report::imported::examine(&imported, &options, &is_over));
    Ok(())
}

fn record(name: &str, bytes: &[u8]) -> Result<(), InputError> {
    Record::parse(name, bytes, None).map(drop)
}

fn lists(_: &str, bytes: &[u8]) -> Result<(), InputError> {
    let wrong = |e: serde_json::Error| InputError::at(JsonPath::root(), e.to_string());
    let protocol = serde_json::from_slice::<Protocol>(bytes).map(drop);
    serde_json::from_slice::<Cracks>(bytes).map(drop).or(protocol).map_err(wrong)
}

/// What was found, in words.
pub fn text(list: &[Fuzzed], seed: u64) -> String {
    let mut text = format!("seed {seed}\n");
    for f in list {
        let _ = writeln!(
            text,
            "{:18} {:7} inputs, {:6} taken, {} failed, slowest {:.2} s (number {}){}",
            f.reader,
            f.inputs,
            f.taken,
            f.failed.len(),
            f.slowest,
            f.slowest_input,
            if f.failed.is_empty() { String::new() } else { format!(": {:?}", f.failed) }
        );
    }
    let all: usize = list.iter().map(|f| f.inputs).sum();
    let failed: usize = list.iter().map(|f| f.failed.len()).sum();
    let _ = write!(text, "{all} inputs, {failed} failed");
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn some_inputs_are_taken_most_refused_and_none_fails() {
        let list = run(1, 2100, |_| {}).unwrap();
        assert!(list.iter().all(|f| f.inputs == 300 && !f.is_wrong()), "{}", text(&list, 1));
        let taken: usize = list.iter().map(|f| f.taken).sum();
        assert!(taken > 100 && taken < 1900, "{}", text(&list, 1));
    }
}
