//! Sweeps as text, table and chart.

mod chart;
mod table;
mod text;

pub use chart::{ChartError, Kind, chart};
pub use table::csv;
pub use text::summary;
