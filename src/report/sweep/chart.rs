//! Charts of sweeps as SVG: the value against one number, against two, and the fragility curve.

use super::group::{Group, bands, cells, mark, marks};
use base::{
    number::{count, short},
    plain::document,
};
use plotters::{
    coord::{Shift, cartesian::Cartesian2d, types::RangedCoordf64},
    prelude::{
        ChartBuilder, ChartContext, Circle, DrawingArea, IntoDrawingArea, PathElement, Polygon,
        RGBColor, Rectangle, SVGBackend, Text, WHITE,
    },
    style::{Color, IntoFont},
};
use sweep::{Fragility, Header, Plan, Row, Shown, Summary, Vary, is_sample};

/// What is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// The value against the number that matters most: mean, and the band from the least to the
    /// greatest; where a row has none, a mark at the foot.
    Line,
    /// The mean value against the two numbers that matter most, in colours; where a row has none,
    /// what it has instead.
    Heat,
    /// The share that fails, with its 95 % interval.
    Fragility,
}

impl Kind {
    /// What suits a sweep: a grid shows its values, a sample its fragility.
    pub fn suited(header: &Header, summary: &Summary) -> Self {
        let grid = !is_sample(&header.plan);
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
            Self::Fragility if !is_sample(plan) => {
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
type Plane<'a, 'b> = ChartContext<'a, SVGBackend<'b>, Cartesian2d<RangedCoordf64, RangedCoordf64>>;

/// The chart.
///
/// # Errors
/// The plan does not fit this kind, or there are no rows.
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
    let column = |k: usize| -> Vec<f64> { rows.iter().map(|r| header.coordinate(r, k)).collect() };
    let shown: Vec<Shown> = rows.iter().map(|r| Shown::of(header, r)).collect();
    let legend: Vec<Mark> = marks(&shown)
        .into_iter()
        .filter_map(|(kind, n)| {
            mark(&header.plan.question, kind).map(|(word, rgb)| Mark { kind, word, rgb, rows: n })
        })
        .collect();
    let axis = |k: usize| Along { label: label(k), vary: header.plan.vary.get(k) };
    let mut text = String::new();
    {
        let area = SVGBackend::with_string(&mut text, SIZE).into_drawing_area();
        area.fill(&WHITE).map_err(refused)?;
        let name = &header.plan.name;
        match (kind, &order[..]) {
            (Kind::Fragility, _) => match &summary.fragility {
                Some(f) => fragility(&area, name, f, &legend),
                None => Err(ChartError("too few rows tell whether they fail".into())),
            },
            (Kind::Heat, [a, b, ..]) => {
                // The plan's first number runs along x.
                let (a, b) = (*a.min(b), *a.max(b));
                let cells = cells(&column(a), &column(b), &shown);
                heat(&area, name, [axis(a), axis(b)], what, &cells, &legend)
            }
            (Kind::Heat, _) => Err(ChartError("a heat map needs two numbers that vary".into())),
            (Kind::Line, [a, ..]) => {
                let bands = bands(&column(*a), &shown, &header.plan.sampling);
                line(&area, name, axis(*a), what, &bands, &legend)
            }
            (Kind::Line, []) => Err(ChartError("nothing varies".into())),
        }?;
        area.present().map_err(refused)?;
    }
    // Markup in names is escaped where they are drawn.
    Ok(document(&text).into_owned())
}

/// What rows without a value are drawn as.
struct Mark {
    kind: Shown,
    word: &'static str,
    rgb: [u8; 3],
    rows: usize,
}

impl Mark {
    fn colour(&self) -> RGBColor {
        RGBColor(self.rgb[0], self.rgb[1], self.rgb[2])
    }

    fn text(&self) -> String {
        format!("{}: {}", self.word, count(self.rows, "row"))
    }
}

/// What runs along an axis.
#[derive(Clone, Copy)]
struct Along<'a> {
    label: &'a str,
    vary: Option<&'a Vary>,
}

impl Along<'_> {
    /// What stands at a place: a number, or the word there.
    fn tick(&self, at: f64) -> String {
        match self.vary.filter(|v| v.words().is_some()) {
            Some(_) if (at - at.round()).abs() > 1e-6 => String::new(),
            Some(vary) if vary.words().is_some_and(|w| at.round() >= w.len() as f64) => {
                String::new()
            }
            Some(vary) if at > -0.5 => vary.place(at),
            Some(_) => String::new(),
            None => short(at),
        }
    }

    /// Ticks that are wanted.
    fn ticks(&self) -> usize {
        self.vary.and_then(|v| v.words()).map_or(6, |w| w.len().clamp(2, 12))
    }
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

/// A point of a curve: where, and the lower end of its band, the curve, the upper end.
type BandPoint = (f64, [f64; 3]);

/// Height of the line that says what marks mean.
const LEGEND: u32 = 26;

/// A curve in a band, cut where a point has no value, and marks at the foot of the chart there.
fn curve(
    area: &Area,
    title: &str,
    [x, y]: [Along; 2],
    range: (f64, f64),
    runs: &[Vec<BandPoint>],
    at_foot: &[(f64, RGBColor)],
    legend: &[(String, Option<RGBColor>)],
) -> Result<(), ChartError> {
    let places = runs.iter().flatten().map(|p| p.0).chain(at_foot.iter().map(|m| m.0));
    let along = ends(places).ok_or_else(|| ChartError("there are no rows".into()))?;
    let (above, below) = match legend.is_empty() {
        true => (area.clone(), None),
        false => {
            let (above, below) = area.split_vertically(SIZE.1 - LEGEND);
            (above, Some(below))
        }
    };
    let mut chart = axes(&above, title, [x, y], along, range)?;
    let few = runs.iter().map(Vec::len).sum::<usize>() <= 40;
    for run in runs {
        band(&mut chart, run)?;
        let middle = run.iter().map(|p| (p.0, p.1[1]));
        if few || run.len() == 1 {
            let dots = middle.map(|p| Circle::new(p, 2, INK.filled()));
            chart.draw_series(dots).map_err(refused)?;
        }
    }
    let foot = at_foot.iter().map(|(x, c)| Circle::new((*x, range.0), 5, c.filled()));
    chart.draw_series(foot).map_err(refused)?;
    below.map_or(Ok(()), |below| words(&below, legend))
}

/// Axes of a chart of a curve.
fn axes<'a, 'b>(
    area: &'b Area<'a>,
    title: &str,
    [x, y]: [Along; 2],
    along: (f64, f64),
    range: (f64, f64),
) -> Result<Plane<'b, 'a>, ChartError> {
    let mut chart = ChartBuilder::on(area)
        .margin(12)
        .caption(title, TITLE)
        .x_label_area_size(42)
        .y_label_area_size(64)
        .build_cartesian_2d(along.0..along.1, range.0..range.1)
        .map_err(refused)?;
    chart
        .configure_mesh()
        .label_style(WORDS)
        .axis_desc_style(WORDS)
        .x_desc(x.label)
        .y_desc(y.label)
        .x_labels(x.ticks())
        .y_labels(6)
        .x_label_formatter(&|v| x.tick(*v))
        .y_label_formatter(&|v| y.tick(*v))
        .light_line_style(WHITE.mix(0.0))
        .draw()
        .map_err(refused)?;
    Ok(chart)
}

/// A band with the curve in it.
fn band(chart: &mut Plane, run: &[BandPoint]) -> Result<(), ChartError> {
    let there = run.iter().map(|p| (p.0, p.1[0]));
    let back = run.iter().rev().map(|p| (p.0, p.1[2]));
    let band = Polygon::new(there.chain(back).collect::<Vec<_>>(), INK.mix(0.18).filled());
    chart.draw_series([band]).map_err(refused)?;
    let middle: Vec<(f64, f64)> = run.iter().map(|p| (p.0, p.1[1])).collect();
    chart.draw_series([PathElement::new(middle, INK.stroke_width(2))]).map_err(refused)?;
    Ok(())
}

/// A line that says what marks mean.
fn words(below: &Area, legend: &[(String, Option<RGBColor>)]) -> Result<(), ChartError> {
    let mut left = 76;
    for (words, colour) in legend {
        if let Some(colour) = colour {
            below.draw(&Circle::new((left, 10), 5, colour.filled())).map_err(refused)?;
            left += 12;
        }
        let font = WORDS.into_font();
        below.draw(&Text::new(words.clone(), (left, 3), font)).map_err(refused)?;
        // Letters are some 7 wide.
        left += 7 * words.chars().count() as i32 + 24;
    }
    Ok(())
}

/// Shares as they were counted, beside a curve that was fitted.
const RAW: RGBColor = RGBColor(200, 90, 20);

/// A curve in a band with counted shares beside it.
fn beside(
    area: &Area,
    title: &str,
    [x, y]: [Along; 2],
    fitted: &[BandPoint],
    counted: &[BandPoint],
    legend: &[(String, Option<RGBColor>)],
) -> Result<(), ChartError> {
    let (above, below) = area.split_vertically(SIZE.1 - LEGEND);
    let along = ends(fitted.iter().chain(counted).map(|p| p.0))
        .ok_or_else(|| ChartError("there are no rows".into()))?;
    let mut chart = axes(&above, title, [x, y], along, (0.0, 1.0))?;
    band(&mut chart, fitted)?;
    let bars = counted.iter().map(|(x, [low, _, high])| {
        PathElement::new(vec![(*x, *low), (*x, *high)], RAW.mix(0.6).stroke_width(1))
    });
    chart.draw_series(bars).map_err(refused)?;
    let dots = counted.iter().map(|(x, p)| Circle::new((*x, p[1]), 3, RAW.filled()));
    chart.draw_series(dots).map_err(refused)?;
    words(&below, legend)
}

fn fragility(area: &Area, title: &str, f: &Fragility, legend: &[Mark]) -> Result<(), ChartError> {
    let points = f.points.iter().map(|(at, p)| (*at, [p.lower, p.share, p.upper])).collect();
    let axes = [
        Along { label: &f.along, vary: f.vary.as_ref() },
        Along { label: "share that fails", vary: None },
    ];
    // What neither fails nor stands is in no share.
    let left_out: Vec<_> = legend
        .iter()
        .filter(|m| matches!(m.kind, Shown::Error | Shown::Undecided))
        .map(|m| (format!("left out, {}", m.text()), None))
        .collect();
    let Some(fit) = &f.lognormal else {
        return curve(area, title, axes, (0.0, 1.0), &[points], &[], &left_out);
    };
    let words = vec![
        ("lognormal, with its 95 % band".to_string(), Some(INK)),
        ("shares, 95 % interval".to_string(), Some(RAW)),
    ];
    let words: Vec<_> = words.into_iter().chain(left_out).collect();
    let shares: Vec<BandPoint> = points;
    beside(area, title, axes, &fit.curve, &shares, &words)
}

fn line(
    area: &Area,
    title: &str,
    x: Along,
    what: &str,
    groups: &[Group],
    legend: &[Mark],
) -> Result<(), ChartError> {
    let mut runs: Vec<Vec<BandPoint>> = Vec::new();
    let mut foot = Vec::new();
    let mut goes_on = false;
    for group in groups {
        match group.shown.value() {
            Some(mean) => {
                let point = (group.at[0], [group.ends[0], mean, group.ends[1]]);
                match runs.last_mut().filter(|_| goes_on) {
                    Some(run) => run.push(point),
                    None => runs.push(vec![point]),
                }
            }
            None => foot.extend(
                legend.iter().find(|m| m.kind == group.shown).map(|m| (group.at[0], m.colour())),
            ),
        }
        goes_on = group.shown.value().is_some();
    }
    let values = runs.iter().flatten().flat_map(|p| p.1);
    let (low, high) = ends(values).unwrap_or((0.0, 1.0));
    // Marks stand below every value.
    let low = if foot.is_empty() { low } else { low - 0.06 * (high - low) };
    let words: Vec<_> = legend.iter().map(|m| (m.text(), Some(m.colour()))).collect();
    let axes = [x, Along { label: what, vary: None }];
    curve(area, title, axes, (low, high), &runs, &foot, &words)
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
/// Height of a line that says what a mark means.
const KEY: i32 = 18;
/// Steps of the colour bar.
const STEPS: i32 = 40;

fn heat(
    area: &Area,
    title: &str,
    [along_x, along_y]: [Along; 2],
    what: &str,
    cells: &[Group],
    legend: &[Mark],
) -> Result<(), ChartError> {
    let values = ends(cells.iter().filter_map(|c| c.shown.value()));
    let hull = |axis: usize| {
        cells.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], c| {
            [l.min(c.at[axis] - c.half[axis]), h.max(c.at[axis] + c.half[axis])]
        })
    };
    let ([x0, x1], [y0, y1]) = (hull(0), hull(1));
    if x0 >= x1 || y0 >= y1 {
        return Err(ChartError("there are no rows".into()));
    }
    let area = area.titled(title, TITLE).map_err(refused)?;
    let (left, bar) = area.split_horizontally(SIZE.0 - BAR);
    let mut chart = ChartBuilder::on(&left)
        .margin(12)
        .x_label_area_size(42)
        .y_label_area_size(64)
        .build_cartesian_2d(x0..x1, y0..y1)
        .map_err(refused)?;
    chart
        .configure_mesh()
        .disable_mesh()
        .label_style(WORDS)
        .axis_desc_style(WORDS)
        .x_desc(along_x.label)
        .y_desc(along_y.label)
        .x_labels(along_x.ticks())
        .y_labels(along_y.ticks())
        .x_label_formatter(&|v| along_x.tick(*v))
        .y_label_formatter(&|v| along_y.tick(*v))
        .draw()
        .map_err(refused)?;
    let boxes = cells.iter().map(|c| {
        let shade = match (c.shown, values) {
            (Shown::Value(v), Some((low, high))) => colour((v - low) / (high - low)),
            (shown, _) => legend.iter().find(|m| m.kind == shown).map_or(WHITE, Mark::colour),
        };
        let corner = |sign: f64| (c.at[0] + sign * c.half[0], c.at[1] + sign * c.half[1]);
        Rectangle::new([corner(-1.0), corner(1.0)], shade.filled())
    });
    chart.draw_series(boxes).map_err(refused)?;
    let foot = area.dim_in_pixel().1 as i32 - 40;
    let (top, bottom) = (40, foot - 20 - KEY * legend.len() as i32);
    let font = || WORDS.into_font();
    if let Some((low, high)) = values {
        for k in 0..STEPS {
            let y = |k: i32| bottom - (bottom - top) * k / STEPS;
            let shade = colour(f64::from(k) / f64::from(STEPS - 1));
            bar.draw(&Rectangle::new([(4, y(k + 1)), (20, y(k))], shade.filled()))
                .map_err(refused)?;
        }
        for (y, value) in [(top - 4, high), (bottom - 8, low)] {
            bar.draw(&Text::new(short(value), (24, y), font())).map_err(refused)?;
        }
        bar.draw(&Text::new(what.to_string(), (0, 18), font())).map_err(refused)?;
    }
    for (k, mark) in legend.iter().enumerate() {
        let y = foot - KEY * (legend.len() - k) as i32;
        bar.draw(&Circle::new((9, y + 7), 5, mark.colour().filled())).map_err(refused)?;
        bar.draw(&Text::new(mark.text(), (20, y), font())).map_err(refused)?;
    }
    Ok(())
}
