//! The XML of VTK, numbers as text: exact to the last bit, and legible.

use base::plain::{markup, printable};
use nalgebra::Vector3;
use std::fmt::{Display, Write};

/// A document that grows.
pub struct Xml(String);

impl Xml {
    /// The head of a document of a kind.
    pub fn new(kind: &str) -> Self {
        Self(format!(
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"{kind}\" version=\"1.0\" byte_order=\"LittleEndian\">\n<{kind}>\n"
        ))
    }

    /// Opens an element.
    pub fn open(&mut self, name: &str, attributes: &str) {
        self.put(format_args!("<{name}{attributes}>\n"));
    }

    /// Closes it.
    pub fn close(&mut self, name: &str) {
        self.put(format_args!("</{name}>\n"));
    }

    /// Whole numbers.
    pub fn integers(&mut self, name: &str, values: impl Iterator<Item = i64>) {
        self.array("Int64", name, "", values);
    }

    /// Numbers.
    pub fn numbers(&mut self, name: &str, values: impl Iterator<Item = f64>) {
        self.array("Float64", name, "", values.map(plain));
    }

    /// A number of its own, among the field data.
    pub fn field(&mut self, name: &str, value: f64) {
        let one = std::iter::once(plain(value));
        self.array("Float64", name, " NumberOfTuples=\"1\"", one);
    }

    /// Vectors.
    pub fn vectors(&mut self, name: &str, values: impl Iterator<Item = Vector3<f64>>) {
        self.array(
            "Float64",
            name,
            " NumberOfComponents=\"3\"",
            values.flat_map(|v| [v.x, v.y, v.z].map(plain)),
        );
    }

    /// Strings: VTK wants their bytes as numbers, each ended by 0.
    pub fn strings<'a>(&mut self, name: &str, values: impl ExactSizeIterator<Item = &'a str>) {
        let count = format!(" NumberOfTuples=\"{}\"", values.len());
        self.array(
            "String",
            name,
            &count,
            values.flat_map(|s| printable(s).into_owned().into_bytes().into_iter().chain([0])),
        );
    }

    fn array<T: Display>(
        &mut self,
        kind: &str,
        name: &str,
        attributes: &str,
        values: impl Iterator<Item = T>,
    ) {
        /// Numbers on a line.
        const LINE: usize = 12;
        self.put(format_args!(
            "<DataArray type=\"{kind}\" Name=\"{}\"{attributes} format=\"ascii\">\n",
            markup(name)
        ));
        for (k, value) in values.enumerate() {
            let end = if (k + 1) % LINE == 0 { '\n' } else { ' ' };
            self.put(format_args!("{value}{end}"));
        }
        self.put(format_args!("\n</DataArray>\n"));
    }

    /// The whole text.
    pub fn end(mut self, kind: &str) -> String {
        self.close(kind);
        self.close("VTKFile");
        self.0
    }

    fn put(&mut self, text: std::fmt::Arguments) {
        // Writing to a string cannot fail.
        let _ = self.0.write_fmt(text);
    }
}

/// What is not a number or infinite has no place in these files: 0. Everything is written with an
/// exponent where it is shorter so.
fn plain(value: f64) -> Number {
    Number(if value.is_finite() { value + 0.0 } else { 0.0 })
}

struct Number(f64);

impl Display for Number {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let size = self.0.abs();
        if size == 0.0 || (1e-4..1e15).contains(&size) {
            write!(f, "{}", self.0)
        } else {
            write!(f, "{:e}", self.0)
        }
    }
}
