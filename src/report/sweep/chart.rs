//! Charts of sweeps as SVG: the value against one number, against two, and the fragility curve.

use super::group::{Cell, bands, cells};
use crate::{
    number::short,
    plain::document,
    sweep::{Fragility, Header, Plan, Row, Sampling, Summary, value_of},
};
use plotters::{
    coord::Shift,
    prelude::{
        ChartBuilder, Circle, DrawingArea, IntoDrawingArea, PathElement, Polygon, RGBColor,
        Rectangle, SVGBackend, Text, WHITE,
    },
    style::{Color, IntoFont},
};

/// What is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// The value against the number that matters most: mean, and the band from the least to the
    /// greatest.
    Line,
    /// The mean value against the two numbers that matter most, in colours.
    Heat,
    /// The share that fails, with its 95 % interval.
    Fragility,
}

impl Kind {
    /// What suits a sweep: a grid shows its values, a sample its fragility.
    pub fn suited(header: &Header, summary: &Summary) -> Self {
        let grid = matches!(header.plan.sampling, Sampling::Grid {});
        match (grid, header.plan.vary.len()) {
            (true, 1) => Self::Line,
            (true, _) => Self::Heat,
            (false, _) if summary.fragility.is_some() => Self::Fragility,
            (false, _) => Self::Line,
        }
    }

    /// Whether it can be drawn of the rows of a plan at all.
    ///
    /// # Errors
    /// It needs more numbers, or a sample.
    pub fn fits(self, plan: &Plan) -> Result<(), ChartError> {
        match self {
            Self::Heat if plan.vary.len() < 2 => {
                Err(ChartError("a heat map needs two numbers that vary".into()))
            }
            Self::Fragility if matches!(plan.sampling, Sampling::Grid {}) => {
                Err(ChartError("a fragility curve needs a sample, and the plan is a grid".into()))
            }
            _ => Ok(()),
        }
    }
}

/// A chart that cannot be drawn.
#[derive(Debug, thiserror::Error)]
#[error("no chart: {0}")]
pub struct ChartError(String);

const SIZE: (u32, u32) = (560, 360);
/// Fonts, the drawer's own of that kind.
const TITLE: (&str, u32) = ("sans-serif", 18);
const WORDS: (&str, u32) = ("sans-serif", 15);
const INK: RGBColor = RGBColor(31, 78, 121);
/// Colours of even steps in lightness, for values from the least to the greatest (viridis; Smith &
/// van der Walt 2015).
const SCALE: [(u8, u8, u8); 5] =
    [(68, 1, 84), (59, 82, 139), (33, 145, 140), (94, 201, 98), (253, 231, 37)];

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;

/// The chart.
///
/// # Errors
/// The plan does not fit this kind, or too few rows have a value.
pub fn chart(
    header: &Header,
    rows: &[Row],
    summary: &Summary,
    kind: Kind,
) -> Result<String, ChartError> {
    kind.fits(&header.plan)?;
    let order: Vec<usize> = {
        let known = summary.influence.iter().map(|i| i.index);
        let rest =
            (0..header.plan.vary.len()).filter(|k| summary.influence.iter().all(|i| i.index != *k));
        known.chain(rest).collect()
    };
    let label = |k: usize| header.plan.vary.get(k).map_or("", |v| v.label());
    let what = header.plan.question.quantity().unwrap_or("share that stands");
    let known: Vec<(&Row, f64)> =
        rows.iter().filter_map(|r| Some((r, value_of(header, r)?))).collect();
    let column = |k: usize| -> Vec<f64> {
        known.iter().map(|(r, _)| r.parameters.get(k).copied().unwrap_or(f64::NAN)).collect()
    };
    let values: Vec<f64> = known.iter().map(|k| k.1).collect();
    let mut text = String::new();
    {
        let area = SVGBackend::with_string(&mut text, SIZE).into_drawing_area();
        area.fill(&WHITE).map_err(refused)?;
        let name = &header.plan.name;
        match (kind, &order[..]) {
            (Kind::Fragility, _) => match &summary.fragility {
                Some(f) => fragility(&area, name, f),
                None => Err(ChartError("too few rows tell whether they fail".into())),
            },
            (Kind::Heat, [a, b, ..]) => {
                // The plan's first number runs along x.
                let (a, b) = (*a.min(b), *a.max(b));
                heat(&area, name, [label(a), label(b), what], &column(a), &column(b), &values)
            }
            (Kind::Heat, _) => Err(ChartError("a heat map needs two numbers that vary".into())),
            (Kind::Line, [a, ..]) => line(&area, name, [label(*a), what], &column(*a), &values),
            (Kind::Line, []) => Err(ChartError("nothing varies".into())),
        }?;
        area.present().map_err(refused)?;
    }
    // Markup in names is escaped where they are drawn.
    Ok(document(&text).into_owned())
}

fn refused(e: impl std::fmt::Display) -> ChartError {
    ChartError(e.to_string())
}

/// Both ends of a list, set apart where they are equal.
fn ends(values: impl Iterator<Item = f64>) -> Option<(f64, f64)> {
    let (low, high) = values
        .filter(|v| v.is_finite())
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)));
    if low > high {
        return None;
    }
    let apart = if low == high { (low.abs() * 0.05).max(f64::MIN_POSITIVE.sqrt()) } else { 0.0 };
    Some((low - apart, high + apart))
}

/// A curve in a band.
fn curve(
    area: &Area,
    title: &str,
    labels: [&str; 2],
    y: (f64, f64),
    points: &[[f64; 4]],
) -> Result<(), ChartError> {
    let x =
        ends(points.iter().map(|p| p[0])).ok_or_else(|| ChartError("no row has a value".into()))?;
    let mut chart = ChartBuilder::on(area)
        .margin(12)
        .caption(title, TITLE)
        .x_label_area_size(42)
        .y_label_area_size(64)
        .build_cartesian_2d(x.0..x.1, y.0..y.1)
        .map_err(refused)?;
    let tick = |v: &f64| short(*v);
    chart
        .configure_mesh()
        .label_style(WORDS)
        .axis_desc_style(WORDS)
        .x_desc(labels[0])
        .y_desc(labels[1])
        .x_labels(6)
        .y_labels(6)
        .x_label_formatter(&tick)
        .y_label_formatter(&tick)
        .light_line_style(WHITE.mix(0.0))
        .draw()
        .map_err(refused)?;
    let there = points.iter().map(|p| (p[0], p[1]));
    let back = points.iter().rev().map(|p| (p[0], p[3]));
    chart
        .draw_series([Polygon::new(there.chain(back).collect::<Vec<_>>(), INK.mix(0.18).filled())])
        .map_err(refused)?;
    let middle: Vec<(f64, f64)> = points.iter().map(|p| (p[0], p[2])).collect();
    chart.draw_series([PathElement::new(middle.clone(), INK.stroke_width(2))]).map_err(refused)?;
    if middle.len() <= 40 {
        chart
            .draw_series(middle.into_iter().map(|p| Circle::new(p, 2, INK.filled())))
            .map_err(refused)?;
    }
    Ok(())
}

fn fragility(area: &Area, title: &str, f: &Fragility) -> Result<(), ChartError> {
    let points: Vec<[f64; 4]> =
        f.points.iter().map(|(at, p)| [*at, p.lower, p.share, p.upper]).collect();
    curve(area, title, [&f.along, "share that fails"], (0.0, 1.0), &points)
}

fn line(
    area: &Area,
    title: &str,
    labels: [&str; 2],
    xs: &[f64],
    values: &[f64],
) -> Result<(), ChartError> {
    let points = bands(xs, values);
    let y = ends(values.iter().copied()).ok_or_else(|| ChartError("no row has a value".into()))?;
    curve(area, title, labels, y, &points)
}

fn colour(share: f64) -> RGBColor {
    let place = share.clamp(0.0, 1.0) * (SCALE.len() - 1) as f64;
    let k = (place as usize).min(SCALE.len() - 2);
    let (a, b, t) = (SCALE[k], SCALE[k + 1], place - k as f64);
    let mix = |a: u8, b: u8| (f64::from(a) + t * (f64::from(b) - f64::from(a))).round() as u8;
    RGBColor(mix(a.0, b.0), mix(a.1, b.1), mix(a.2, b.2))
}

/// Room for the colour bar and its words.
const BAR: u32 = 122;
/// Steps of the colour bar.
const STEPS: i32 = 40;

fn heat(
    area: &Area,
    title: &str,
    labels: [&str; 3],
    xs: &[f64],
    ys: &[f64],
    values: &[f64],
) -> Result<(), ChartError> {
    let cells = cells(xs, ys, values);
    let (low, high) = ends(cells.iter().map(|c| c.mean))
        .ok_or_else(|| ChartError("no row has a value".into()))?;
    let hull = |of: fn(&Cell) -> [f64; 2]| {
        cells
            .iter()
            .map(of)
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], [a, b]| [l.min(a), h.max(b)])
    };
    let ([x0, x1], [y0, y1]) = (hull(|c| c.x), hull(|c| c.y));
    let area = area.titled(title, TITLE).map_err(refused)?;
    let (left, bar) = area.split_horizontally(SIZE.0 - BAR);
    let mut chart = ChartBuilder::on(&left)
        .margin(12)
        .x_label_area_size(42)
        .y_label_area_size(64)
        .build_cartesian_2d(x0..x1, y0..y1)
        .map_err(refused)?;
    let tick = |v: &f64| short(*v);
    chart
        .configure_mesh()
        .disable_mesh()
        .label_style(WORDS)
        .axis_desc_style(WORDS)
        .x_desc(labels[0])
        .y_desc(labels[1])
        .x_labels(6)
        .y_labels(6)
        .x_label_formatter(&tick)
        .y_label_formatter(&tick)
        .draw()
        .map_err(refused)?;
    let boxes = cells.iter().map(|c| {
        let shade = colour((c.mean - low) / (high - low));
        Rectangle::new([(c.x[0], c.y[0]), (c.x[1], c.y[1])], shade.filled())
    });
    chart.draw_series(boxes).map_err(refused)?;
    let (top, bottom) = (40, area.dim_in_pixel().1 as i32 - 60);
    for k in 0..STEPS {
        let y = |k: i32| bottom - (bottom - top) * k / STEPS;
        let shade = colour(f64::from(k) / f64::from(STEPS - 1));
        bar.draw(&Rectangle::new([(4, y(k + 1)), (20, y(k))], shade.filled())).map_err(refused)?;
    }
    let font = || WORDS.into_font();
    for (y, value) in [(top - 4, high), (bottom - 8, low)] {
        bar.draw(&Text::new(short(value), (24, y), font())).map_err(refused)?;
    }
    bar.draw(&Text::new(labels[2].to_string(), (0, 18), font())).map_err(refused)?;
    Ok(())
}
