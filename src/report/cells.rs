//! Tables for other programs (CSV, RFC 4180). All of them are written here, so that no cell of any
//! is more than text or a number, and none can be taken for the other: text is quoted, numbers are
//! not. So a block named `007` or `1e5` is told from a number by every reader that looks.

use base::plain;

/// A cell.
pub(super) enum Cell {
    /// Text, which is quoted whatever it looks like.
    Text(String),
    /// A number.
    Number(String),
    /// Nothing to say.
    Nothing,
}

impl From<&str> for Cell {
    fn from(text: &str) -> Self {
        Self::from(text.to_string())
    }
}

impl From<String> for Cell {
    fn from(text: String) -> Self {
        if text.is_empty() { Self::Nothing } else { Self::Text(text) }
    }
}

impl From<f64> for Cell {
    fn from(value: f64) -> Self {
        Self::Number(value.to_string())
    }
}

impl From<Option<f64>> for Cell {
    fn from(value: Option<f64>) -> Self {
        value.map_or(Self::Nothing, Self::from)
    }
}

impl From<u64> for Cell {
    fn from(value: u64) -> Self {
        Self::Number(value.to_string())
    }
}

impl From<usize> for Cell {
    fn from(value: usize) -> Self {
        Self::Number(value.to_string())
    }
}

impl Cell {
    fn written(&self) -> String {
        match self {
            Self::Text(text) => format!("\"{}\"", plain::cell(text).replace('"', "\"\"")),
            Self::Number(text) => text.clone(),
            Self::Nothing => String::new(),
        }
    }
}

/// Cells of a row, of whatever can be one.
macro_rules! row {
    ($($cell:expr),* $(,)?) => { [$($crate::cells::Cell::from($cell)),*] };
}
pub(super) use row;

/// A table that grows row by row.
pub(super) struct Table(csv::Writer<Vec<u8>>);

impl Table {
    /// An empty table without a head.
    pub fn new() -> Self {
        // What needs quotes has them before it comes here.
        let never = csv::QuoteStyle::Never;
        Self(csv::WriterBuilder::new().quote_style(never).from_writer(Vec::new()))
    }

    /// An empty table with the names of its columns, quoted where they have to be.
    ///
    /// # Errors
    /// Only if memory runs out.
    pub fn with_head<S: Into<String>>(
        names: impl IntoIterator<Item = S>,
    ) -> Result<Self, csv::Error> {
        let mut table = Self::new();
        for name in names.into_iter().map(Into::into) {
            let plain = name.chars().all(|c| c.is_alphanumeric() || "_/:.".contains(c));
            let written = if plain { name } else { Cell::Text(name).written() };
            table.0.write_field(written.as_bytes())?;
        }
        table.0.write_record(None::<&[u8]>)?;
        Ok(table)
    }

    /// Adds a row.
    ///
    /// # Errors
    /// It has another number of cells than the first.
    pub fn write_record<C: Into<Cell>>(
        &mut self,
        row: impl IntoIterator<Item = C>,
    ) -> Result<(), csv::Error> {
        for cell in row {
            self.0.write_field(cell.into().written().as_bytes())?;
        }
        self.0.write_record(None::<&[u8]>)
    }

    /// The text of it.
    ///
    /// # Errors
    /// Only if memory runs out.
    pub fn end(self) -> Result<String, csv::Error> {
        let bytes = self.0.into_inner().map_err(|e| csv::Error::from(e.into_error()))?;
        // Made of text alone.
        Ok(String::from_utf8_lossy(&bytes).into_owned())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_is_quoted_and_numbers_are_not() {
        let mut table = Table::with_head(["a", "joints/\"b\""]).unwrap();
        for (text, number) in [("007", 7.0), ("1e5", -1e-7), ("+3", 0.0), ("a,\"b\"", 2.5)] {
            table.write_record([Cell::from(text), number.into()]).unwrap();
        }
        table.write_record([Cell::from("=A1"), None.into()]).unwrap();
        assert_eq!(
            table.end().unwrap(),
            "a,\"joints/\"\"b\"\"\"\n\"007\",7\n\"1e5\",-0.0000001\n\"+3\",0\n\"a,\"\"b\"\"\",2.5\n\"'=A1\",\n"
        );
    }
}
