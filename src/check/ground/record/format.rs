//! Formats of records.

/// What a file was read as.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// A table.
    Csv,
    /// PEER AT2.
    Peer,
    /// ESM or ITACA ASCII.
    Esm,
}
