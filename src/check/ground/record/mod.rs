//! Records of acceleration: tables (CSV), PEER AT2, ESM and ITACA ASCII.
//!
//! Units come from the file or from whoever asks, never from a guess; the baseline is left as it
//! is.

mod at2;
mod csv;
mod esm;
mod format;
mod raw;
mod unit;

use super::{Motion, motion::lines};
use base::{
    error::{Finding, FindingCode, InputError, JsonPath},
    limits,
};
pub use format::Format;
use nalgebra::Vector3;
use raw::{Column, Raw, error};
use std::path::Path;
pub use unit::{STANDARD_GRAVITY, UNITS, Unit};

/// A record.
#[derive(Clone, Debug, PartialEq)]
pub struct Record {
    /// The files, as they were named.
    pub name: String,
    /// What they were read as.
    pub format: Format,
    /// Time between two samples, s.
    pub step: f64,
    /// Components that were given: along the direction asked about, to its left, up.
    pub components: usize,
    /// Samples, m/s².
    pub samples: Vec<Vector3<f64>>,
    /// What should be known about it.
    pub findings: Vec<Finding>,
    /// The greatest number in the files, its unit and its place.
    peak: Peak,
}

/// The greatest number in a file.
#[derive(Clone, Debug, PartialEq)]
struct Peak {
    value: f64,
    unit: Unit,
    place: String,
}

/// A peak above this, in g, is likely one of other units. Larger: m/s² read as g pass (the greatest
/// ever recorded is some 4 g). Smaller: the strongest records are doubted.
pub const STRONGEST: f64 = 2.0;
/// A peak below this, in g, is likely one of other units. Larger: weak records are doubted. Smaller:
/// g read as m/s² pass.
pub const WEAKEST: f64 = 0.1;
/// Steps outside of this, s, are likely in other units.
pub const STEPS: std::ops::RangeInclusive<f64> = 1e-4..=0.1;
/// A peak that differs from the announced one by more than this part is another one.
const ANNOUNCED: f64 = 0.01;
/// Least number of samples.
const LEAST: usize = 2;

impl Record {
    /// Reads one to three files: a table with one to three components, or a file each.
    ///
    /// # Errors
    /// A file that cannot be read or is no record; no units, or two that differ.
    pub fn read(paths: &[&Path], units: Option<Unit>) -> Result<Self, InputError> {
        let mut record: Option<Self> = None;
        for path in paths {
            let name = path.display().to_string();
            let bytes = limits::read_file(path, limits::PER_KEPT_BYTE)?;
            let next = Self::unjudged(&name, &bytes, units)?;
            record = Some(match record {
                None => next,
                Some(first) => first.beside(next)?,
            });
        }
        let record =
            record.ok_or_else(|| InputError::at(JsonPath::root(), "no record is given"))?;
        Ok(record.judged())
    }

    /// A record from the bytes of a file of this name.
    ///
    /// # Errors
    /// As [`read`](Self::read).
    pub fn parse(name: &str, bytes: &[u8], units: Option<Unit>) -> Result<Self, InputError> {
        Ok(Self::unjudged(name, bytes, units)?.judged())
    }

    fn unjudged(name: &str, bytes: &[u8], units: Option<Unit>) -> Result<Self, InputError> {
        let in_file = |e: InputError| InputError { file: Some(name.to_string()), ..e };
        raw_of(name, bytes).and_then(|raw| Self::of(name, raw, units)).map_err(in_file)
    }

    fn of(name: &str, raw: Raw, units: Option<Unit>) -> Result<Self, InputError> {
        let mut findings = raw.findings;
        let count = raw.columns.iter().map(|c| c.values.len()).max().unwrap_or(0);
        if count < LEAST {
            return Err(error(raw.unit_line, format!("{count} samples are too few for a record")));
        }
        let mut samples = vec![Vector3::zeros(); count];
        let mut peak: Option<Peak> = None;
        for (k, column) in raw.columns.iter().enumerate() {
            let unit = match (column.unit, units) {
                (Some(own), Some(given)) if own != given => {
                    return Err(error(
                        raw.unit_line,
                        format!("the file says {own}, --units says {given}"),
                    )
                    .hint("leave --units out, or correct the file"));
                }
                (own, given) => own.or(given).ok_or_else(|| {
                    error(raw.unit_line, "the file gives no unit for its accelerations")
                        .hint(format!("give it with --units ({UNITS}), or in the file"))
                })?,
            };
            for (sample, value) in samples.iter_mut().zip(&column.values) {
                sample[k] = value * unit.value();
            }
            let (most, line) = greatest(column);
            let own = Peak { value: most, unit, place: format!("{name}:{line}") };
            peak = Some(peak.map_or(own.clone(), |p| p.greater(own)));
            if let Some(announced) = column.announced
                && (most * unit.value() - announced).abs() > ANNOUNCED * announced
            {
                findings.push(Finding::new(
                    FindingCode::Units,
                    format!(
                        "{name}:{line}: the greatest acceleration is {} m/s², the header announces {} m/s²: the record may be incomplete or in another unit",
                        base::number::short(most * unit.value()),
                        base::number::short(announced)
                    ),
                ));
            }
        }
        if !STEPS.contains(&raw.step) {
            findings.push(Finding::new(
                FindingCode::Units,
                format!(
                    "{name}: {} s between two samples: are the times in another unit?",
                    base::number::short(raw.step)
                ),
            ));
        }
        Ok(Self {
            name: name.to_string(),
            format: raw.format,
            step: raw.step,
            components: raw.columns.len(),
            samples,
            findings,
            peak: peak.ok_or_else(|| error(raw.unit_line, "the record has no accelerations"))?,
        })
    }

    /// This record with the next component from another file.
    fn beside(mut self, other: Self) -> Result<Self, InputError> {
        let refuse = |text: String| InputError {
            file: Some(other.name.clone()),
            ..InputError::at(JsonPath::root(), text)
        };
        if self.components + other.components > 3 {
            return Err(refuse("more than three components of one motion".into())
                .hint("give the components in the order: along the direction, to its left, up"));
        }
        if (self.step - other.step).abs() > 1e-6 * self.step {
            return Err(refuse(format!(
                "{} s between samples, {} has {} s",
                other.step, self.name, self.step
            ))
            .hint("all components of one motion need the same time step"));
        }
        if self.samples.len() != other.samples.len() {
            self.findings.push(Finding::new(
                FindingCode::LeftOut,
                format!(
                    "{} has {} samples, {} has {}: the shorter one is extended with zeros",
                    self.name,
                    self.samples.len(),
                    other.name,
                    other.samples.len()
                ),
            ));
        }
        let count = self.samples.len().max(other.samples.len());
        self.samples.resize(count, Vector3::zeros());
        for (sample, more) in self.samples.iter_mut().zip(&other.samples) {
            (0..other.components).for_each(|k| sample[self.components + k] = more[k]);
        }
        self.components += other.components;
        self.peak = self.peak.greater(other.peak);
        self.name = format!("{}, {}", self.name, other.name);
        self.findings.extend(other.findings);
        Ok(self)
    }

    /// With what its peak gives to think.
    fn judged(mut self) -> Self {
        self.findings.extend(self.peak.plausible());
        self
    }

    /// How long it is, s.
    pub fn duration(&self) -> f64 {
        self.step * self.samples.len().saturating_sub(1) as f64
    }

    /// The greatest acceleration of each component, m/s².
    pub fn peaks(&self) -> Vector3<f64> {
        self.samples.iter().fold(Vector3::zeros(), |a, s| a.zip_map(s, |a, s| a.max(s.abs())))
    }

    /// The motion of the ground, linear between samples.
    pub fn motion(&self) -> Motion {
        lines(self.step, &self.samples)
    }
}

/// What a file says, by what its first lines look like.
fn raw_of(name: &str, bytes: &[u8]) -> Result<Raw, InputError> {
    let lines = raw::lines(bytes)?;
    if lines.iter().all(|(_, l)| l.trim().is_empty()) {
        return Err(
            error(1, "the file is empty").hint("give a record: CSV, PEER AT2, ESM/ITACA ASCII")
        );
    }
    let ending = Path::new(name).extension().map(|e| e.to_ascii_lowercase());
    if esm::is_esm(&lines) {
        esm::read(&lines)
    } else if at2::is_at2(&lines) || ending.is_some_and(|e| e == "at2") {
        at2::read(&lines)
    } else {
        csv::read(&lines)
    }
}

/// The greatest value and its line.
fn greatest(column: &Column) -> (f64, usize) {
    let pairs = column.values.iter().map(|v| v.abs()).zip(column.lines.iter().copied());
    pairs.fold((0.0, 1), |a, b| if b.0 > a.0 { b } else { a })
}

impl Peak {
    fn greater(self, other: Self) -> Self {
        let size = |p: &Self| p.value * p.unit.value();
        if size(&other) > size(&self) { other } else { self }
    }

    fn plausible(&self) -> Option<Finding> {
        let Self { value, unit, place } = self;
        let peak = value * unit.value() / STANDARD_GRAVITY;
        let g = base::number::short(peak);
        let text = if *value == 0.0 {
            format!("{place}: all accelerations are zero")
        } else if peak > STRONGEST {
            format!(
                "{place}: a peak of {g} g exceeds any earthquake: are the accelerations really in {unit}?"
            )
        } else if peak < WEAKEST {
            let other = if *unit == Unit::Gravity { "m/s²" } else { "g" };
            format!(
                "{place}: a peak of {g} g is weak: are the accelerations really in {unit}, not in {other}?"
            )
        } else {
            return None;
        };
        Some(Finding::new(FindingCode::Units, text))
    }
}
