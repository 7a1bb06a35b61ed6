//! Charts of lines on paper: area, axes and legend, which all of them share.

use base::number::short;
use plotters::{
    coord::types::RangedCoordf64,
    prelude::{
        Cartesian2d, ChartBuilder, ChartContext, IntoDrawingArea, PathElement, RGBColor,
        SVGBackend, SeriesLabelPosition, WHITE,
    },
    style::{Color, IntoFont},
};
use std::ops::Range;

/// Blue and vermilion: colours that stay apart for people who do not see all of them (Okabe & Ito
/// 2008).
pub(super) const BLUE: RGBColor = RGBColor(0, 114, 178);
/// The other one.
pub(super) const RED: RGBColor = RGBColor(213, 94, 0);
/// A third line.
pub(super) const GREEN: RGBColor = RGBColor(0, 158, 115);

/// A curve that cannot be written or drawn.
#[derive(Debug, thiserror::Error)]
#[error("no curve: {0}")]
pub struct CurveError(String);

impl CurveError {
    /// For this reason.
    pub(super) fn new(e: impl std::fmt::Display) -> Self {
        Self(e.to_string())
    }
}

const SIZE: (u32, u32) = (680, 420);

/// What is drawn into.
pub(super) type Drawn<'a, 'b> =
    ChartContext<'a, SVGBackend<'b>, Cartesian2d<RangedCoordf64, RangedCoordf64>>;

/// A chart without its lines.
pub(super) struct Plot<'a> {
    /// The name of the scene.
    pub name: &'a str,
    /// What stands along the axes.
    pub axes: [&'a str; 2],
    /// From where to where they go.
    pub ends: [Range<f64>; 2],
    /// Room for the numbers on the left, pixels.
    pub left: u32,
    /// Where the legend stands, where there is one.
    pub legend: Option<SeriesLabelPosition>,
}

impl Plot<'_> {
    /// The chart as SVG, with what `lines` draws into it.
    ///
    /// # Errors
    /// It cannot be drawn.
    pub fn svg(
        self,
        lines: impl FnOnce(&mut Drawn) -> Result<(), CurveError>,
    ) -> Result<String, CurveError> {
        let [across, up] = self.ends;
        let mut text = String::new();
        {
            let area = SVGBackend::with_string(&mut text, SIZE).into_drawing_area();
            area.fill(&WHITE).map_err(CurveError::new)?;
            let mut chart = ChartBuilder::on(&area)
                .margin(12)
                .caption(base::plain::cell(self.name), ("sans-serif", 18))
                .x_label_area_size(42)
                .y_label_area_size(self.left)
                .build_cartesian_2d(across, up)
                .map_err(CurveError::new)?;
            chart
                .configure_mesh()
                .label_style(("sans-serif", 14))
                .x_desc(self.axes[0])
                .y_desc(self.axes[1])
                .x_label_formatter(&|v| short(zero(*v)))
                .y_label_formatter(&|v| short(zero(*v)))
                .light_line_style(WHITE.mix(0.0))
                .draw()
                .map_err(CurveError::new)?;
            lines(&mut chart)?;
            if let Some(position) = self.legend {
                chart
                    .configure_series_labels()
                    .position(position)
                    .background_style(WHITE.mix(0.8))
                    .label_font(("sans-serif", 13).into_font())
                    .draw()
                    .map_err(CurveError::new)?;
            }
            area.present().map_err(CurveError::new)?;
        }
        Ok(text)
    }
}

/// The piece of line that stands for a colour in a legend.
pub(super) fn sample(colour: RGBColor) -> impl Fn((i32, i32)) -> PathElement<(i32, i32)> {
    move |(x, y)| PathElement::new(vec![(x, y), (x + 16, y)], colour.stroke_width(2))
}

/// What rounding leaves of zero on an axis is zero.
fn zero(v: f64) -> f64 {
    if v.abs() < 1e-12 { 0.0 } else { v }
}
