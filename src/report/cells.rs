//! Tables for other programs (CSV, RFC 4180). All of them are written here, so that no cell of any
//! is more than text or a number.

use crate::plain;

/// A table that grows row by row.
pub(super) struct Table(csv::Writer<Vec<u8>>);

impl Table {
    /// An empty table.
    pub fn new() -> Self {
        Self(csv::Writer::from_writer(Vec::new()))
    }

    /// Adds a row.
    ///
    /// # Errors
    /// It has another number of cells than the first.
    pub fn write_record<S: AsRef<str>>(
        &mut self,
        row: impl IntoIterator<Item = S>,
    ) -> Result<(), csv::Error> {
        for text in row {
            self.0.write_field(plain::cell(text.as_ref()).as_bytes())?;
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
