//! Charts as SVG. Colours are attributes, so that every reader of SVG has them; a page has classes
//! for its own (`c0` to `c9`, `grid`, `axis`, `soft`).

use super::{
    Axis, Chart, Series,
    ticks::{range, ticks},
};
use base::{number::short, plain::markup};
use std::fmt::Write;

/// Width and height of a chart, pixels.
const SIZE: [f64; 2] = [560.0, 340.0];
/// Room left of the axes for numbers, above and below them.
const LEFT: f64 = 66.0;
const TOP: f64 = 10.0;
const BOTTOM: f64 = 46.0;
/// Room right of them, and where the colours of cells are told.
const RIGHT: f64 = 14.0;
const BAR: f64 = 74.0;
/// Height of a line of a legend, and of the title.
const LINE: f64 = 18.0;
/// Colours that stay apart for people who do not see all of them (Okabe & Ito 2008), and more.
const COLOURS: [[u8; 3]; 10] = [
    [0, 114, 178],
    [213, 94, 0],
    [0, 158, 115],
    [204, 121, 167],
    [230, 159, 0],
    [86, 180, 233],
    [140, 86, 75],
    [148, 103, 189],
    [127, 127, 127],
    [163, 148, 0],
];
/// Colours of even steps in lightness, for values from the least to the greatest (viridis; Smith &
/// van der Walt 2015).
const SCALE: [[u8; 3]; 5] =
    [[68, 1, 84], [59, 82, 139], [33, 145, 140], [94, 201, 98], [253, 231, 37]];
/// Steps of the bar that shows them.
const STEPS: usize = 40;
/// So many points of a line are drawn at most, and so many as dots.
const POINTS: usize = 4000;
const DOTS: usize = 45;

/// A chart that is drawn.
#[derive(Clone, Debug)]
pub struct Drawn {
    /// As an SVG document without title and legend.
    pub svg: String,
    /// Where points are, pixels, each with what is said there.
    pub spots: Vec<([f64; 2], String)>,
    /// Left and right end of the axis along, pixels, and the values there.
    pub along: [f64; 4],
    /// Names of what is drawn with the number of its colour, or the colour itself.
    pub keys: Vec<(String, Result<usize, [u8; 3]>)>,
}

/// Where values are on the drawing.
struct Frame {
    x: [f64; 2],
    y: [f64; 2],
    log: [bool; 2],
    right: f64,
}

impl Frame {
    fn of(chart: &Chart) -> Self {
        let points = || {
            chart.series.iter().flat_map(|s| {
                let band = |k: usize| s.band.get(k).copied();
                s.points.iter().enumerate().map(move |(k, p)| (*p, band(k)))
            })
        };
        let right = SIZE[0] - if chart.cells.is_some() { BAR } else { RIGHT };
        let log = [chart.x.log, chart.y.log];
        if chart.cells.is_some() {
            let hull = |c: usize| {
                points().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], (p, band)| {
                    let (at, half) = (p[c].unwrap_or(f64::NAN), band.unwrap_or_default()[c]);
                    [low.min(at - half), high.max(at + half)]
                })
            };
            return Self { x: hull(0), y: hull(1), log, right };
        }
        let along = points().filter_map(|(p, _)| p[0]).chain(chart.events.iter().copied());
        let up = points().flat_map(|(p, band)| {
            let ends = band.filter(|_| p[1].is_some()).into_iter().flatten();
            p[1].into_iter().chain(ends)
        });
        Self { x: range(along, log[0]), y: range(up, log[1]), log, right }
    }

    fn share(v: f64, [a, b]: [f64; 2], log: bool) -> f64 {
        if log { (v / a).ln() / (b / a).ln() } else { (v - a) / (b - a) }
    }

    fn px(&self, v: f64) -> f64 {
        LEFT + (self.right - LEFT) * Self::share(v, self.x, self.log[0])
    }

    fn py(&self, v: f64) -> f64 {
        let foot = SIZE[1] - BOTTOM;
        foot - (foot - TOP) * Self::share(v, self.y, self.log[1])
    }
}

fn rgb([r, g, b]: [u8; 3]) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// The colour of a share of the scale.
fn shade(share: f64) -> [u8; 3] {
    let place = share.clamp(0.0, 1.0) * (SCALE.len() - 1) as f64;
    let k = (place as usize).min(SCALE.len() - 2);
    std::array::from_fn(|c| {
        let (a, b) = (f64::from(SCALE[k][c]), f64::from(SCALE[k + 1][c]));
        (a + (place - k as f64) * (b - a)).round() as u8
    })
}

/// How a series is filled or stroked.
struct Ink {
    class: String,
    colour: String,
}

impl Ink {
    fn of(k: usize, s: &Series) -> Self {
        match s.colour {
            Some(own) => Self { class: String::new(), colour: rgb(own) },
            None => Self {
                class: format!("c{}", k % COLOURS.len()),
                colour: rgb(COLOURS[k % COLOURS.len()]),
            },
        }
    }

    fn fill(&self) -> String {
        format!("class=\"f {}\" fill=\"{}\"", self.class, self.colour)
    }

    fn stroke(&self) -> String {
        format!("class=\"s {}\" fill=\"none\" stroke=\"{}\"", self.class, self.colour)
    }
}

/// Draws a chart.
pub fn drawn(chart: &Chart) -> Drawn {
    let frame = Frame::of(chart);
    let (mut out, mut spots) = (String::new(), Vec::new());
    axes(&mut out, chart, &frame);
    for (k, s) in chart.series.iter().enumerate() {
        match chart.cells {
            Some(_) => cells(&mut out, s, &frame),
            None => curve(&mut out, s, &Ink::of(k, s), &frame),
        }
        let there = s.points.iter().zip(&s.hints);
        spots.extend(
            there.filter_map(|([x, y], hint)| {
                Some(([frame.px((*x)?), frame.py((*y)?)], hint.clone()))
            }),
        );
    }
    let foot = SIZE[1] - BOTTOM;
    let _ = write!(
        out,
        "<path class=\"axis\" fill=\"none\" stroke=\"#444\" d=\"M{LEFT} {TOP}V{foot}H{}\"/>",
        frame.right
    );
    let is_named = |s: &&Series| chart.cells.is_none() || s.colour.is_some();
    let numbered = chart.series.iter().enumerate().filter(|(_, s)| is_named(s));
    let key =
        |(k, s): (usize, &Series)| (s.name.clone(), s.colour.map_or(Ok(k % COLOURS.len()), Err));
    let keys: Vec<_> = numbered.map(key).collect();
    let tells = chart.cells.is_some()
        || keys.len() > 1
        || !chart.series[..].iter().all(|s| s.band.is_empty());
    Drawn {
        svg: document(
            SIZE,
            &format!("{}: {} against {}", chart.title, chart.y.label, chart.x.label),
            &out,
        ),
        spots,
        along: [LEFT, frame.right, frame.x[0], frame.x[1]],
        keys: if tells { keys } else { Vec::new() },
    }
}

fn document([width, height]: [f64; 2], label: &str, inner: &str) -> String {
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" font-family=\"sans-serif\" font-size=\"13\" role=\"img\" aria-label=\"{}\">{inner}</svg>",
        markup(label)
    )
}

/// Grid, numbers and names of the axes, events.
fn axes(out: &mut String, chart: &Chart, frame: &Frame) {
    let foot = SIZE[1] - BOTTOM;
    let places = |axis: &Axis, ends: [f64; 2]| -> Vec<(f64, String)> {
        match axis.words.is_empty() {
            true => ticks(ends, axis.log).into_iter().map(|v| (v, number(v))).collect(),
            false => {
                let words = axis.words.iter().enumerate().map(|(k, w)| (k as f64, w.clone()));
                words.filter(|(v, _)| (ends[0]..=ends[1]).contains(v)).collect()
            }
        }
    };
    let grid = "class=\"grid\" stroke=\"#e4e4e4\"";
    let soft = "class=\"soft\" fill=\"#555\"";
    for (v, word) in places(&chart.x, frame.x) {
        let x = frame.px(v);
        let _ = write!(
            out,
            "<line {grid} x1=\"{x:.1}\" x2=\"{x:.1}\" y1=\"{TOP}\" y2=\"{foot}\"/><text {soft} x=\"{x:.1}\" y=\"{}\" text-anchor=\"middle\">{}</text>",
            foot + 17.0,
            markup(&word)
        );
    }
    for (v, word) in places(&chart.y, frame.y) {
        let y = frame.py(v);
        let _ = write!(
            out,
            "<line {grid} x1=\"{LEFT}\" x2=\"{}\" y1=\"{y:.1}\" y2=\"{y:.1}\"/><text {soft} x=\"{}\" y=\"{:.1}\" text-anchor=\"end\">{}</text>",
            frame.right,
            LEFT - 7.0,
            y + 4.0,
            markup(&word)
        );
    }
    for x in chart.events.iter().map(|v| frame.px(*v)) {
        let _ = write!(
            out,
            "<line class=\"event\" stroke=\"#888\" stroke-dasharray=\"3 3\" x1=\"{x:.1}\" x2=\"{x:.1}\" y1=\"{TOP}\" y2=\"{foot}\"/>"
        );
    }
    let middle = (TOP + foot) / 2.0;
    let _ = write!(
        out,
        "<text class=\"name\" x=\"{:.1}\" y=\"{}\" text-anchor=\"middle\">{}</text><text class=\"name\" x=\"13\" y=\"{middle}\" text-anchor=\"middle\" transform=\"rotate(-90 13 {middle})\">{}</text>",
        (LEFT + frame.right) / 2.0,
        SIZE[1] - 8.0,
        markup(&chart.x.label),
        markup(&chart.y.label)
    );
}

/// A number at an axis: what rounding leaves of zero is zero.
fn number(v: f64) -> String {
    let few: f64 = format!("{v:.2e}").parse().unwrap_or(v);
    if few == 0.0 || (1e-3..1e6).contains(&few.abs()) { short(few) } else { format!("{few:e}") }
}

/// The cells of one kind, and what their colours mean.
fn cells(out: &mut String, s: &Series, frame: &Frame) {
    let ends = s
        .values
        .iter()
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], v| [l.min(*v), h.max(*v)]);
    let wide = if ends[1] > ends[0] { ends[1] - ends[0] } else { 1.0 };
    for (k, (point, [dx, dy])) in s.points.iter().zip(&s.band).enumerate() {
        let [Some(x), Some(y)] = *point else { continue };
        let colour = s.colour.unwrap_or_else(|| {
            shade((s.values.get(k).copied().unwrap_or(ends[0]) - ends[0]) / wide)
        });
        let (left, top) = (frame.px(x - dx), frame.py(y + dy));
        let _ = write!(
            out,
            "<rect x=\"{left:.1}\" y=\"{top:.1}\" width=\"{:.1}\" height=\"{:.1}\" fill=\"{}\"/>",
            frame.px(x + dx) - left + 0.6,
            frame.py(y - dy) - top + 0.6,
            rgb(colour)
        );
    }
    if s.colour.is_some() || s.values.is_empty() {
        return;
    }
    let foot = SIZE[1] - BOTTOM;
    let step = (foot - TOP) / STEPS as f64;
    for k in 0..STEPS {
        let _ = write!(
            out,
            "<rect x=\"{}\" y=\"{:.1}\" width=\"12\" height=\"{:.1}\" fill=\"{}\"/>",
            frame.right + 12.0,
            foot - (k + 1) as f64 * step,
            step + 0.5,
            rgb(shade(k as f64 / (STEPS - 1) as f64))
        );
    }
    for (y, value) in [(TOP + 10.0, ends[1]), (foot, ends[0])] {
        let (x, word) = (frame.right + 28.0, number(value));
        let _ = write!(out, "<text class=\"soft\" fill=\"#555\" x=\"{x}\" y=\"{y}\">{word}</text>");
    }
}

/// A line with its band, dots with theirs.
fn curve(out: &mut String, s: &Series, ink: &Ink, frame: &Frame) {
    let pair = |(x, y): (f64, f64)| format!("{:.1} {:.1}", frame.px(x), frame.py(y));
    let path = |points: &[(f64, f64)]| -> String {
        let all: Vec<String> = points.iter().copied().map(pair).collect();
        format!("M{}", all.join("L"))
    };
    let every = s.points.len().div_ceil(POINTS).max(1);
    // A point without a value cuts the line.
    let runs = s.points.iter().enumerate().collect::<Vec<_>>();
    for run in runs.split(|(_, p)| p[1].is_none() || p[0].is_none()).filter(|run| !run.is_empty()) {
        let at = |p: &[Option<f64>; 2]| (p[0].unwrap_or(0.0), p[1].unwrap_or(0.0));
        let last = run.len() - 1;
        let thin = run.iter().enumerate().filter(|(k, _)| k % every == 0 || *k == last);
        let run: Vec<(usize, (f64, f64))> = thin.map(|(_, (k, p))| (*k, at(p))).collect();
        let band = run.iter().filter_map(|(k, p)| Some((p.0, *s.band.get(*k)?)));
        let band: Vec<(f64, [f64; 2])> = band.collect();
        if s.line && !band.is_empty() {
            let up = band.iter().map(|(x, b)| (*x, b[1]));
            let down = band.iter().rev().map(|(x, b)| (*x, b[0]));
            let hull = path(&up.chain(down).collect::<Vec<_>>());
            let _ = write!(out, "<path {} opacity=\"0.16\" d=\"{hull}Z\"/>", ink.fill());
        } else {
            for (x, [low, high]) in &band {
                let bar = path(&[(*x, *low), (*x, *high)]);
                let _ = write!(out, "<path {} opacity=\"0.6\" d=\"{bar}\"/>", ink.stroke());
            }
        }
        if s.line {
            let line = path(&run.iter().map(|r| r.1).collect::<Vec<_>>());
            let _ = write!(
                out,
                "<path {} stroke-width=\"2\" stroke-linejoin=\"round\" d=\"{line}\"/>",
                ink.stroke()
            );
        }
    }
    let many = s.points.len();
    let radius = match (s.colour, s.line) {
        (Some(_), _) => 4.5,
        (None, true) if many > DOTS => return,
        (None, true) => 3.2,
        (None, false) if many > 500 => 1.7,
        (None, false) => 2.6,
    };
    let opacity = if s.line { "1" } else { "0.7" };
    for (x, y) in s.points.iter().filter_map(|p| Some((p[0]?, p[1]?))) {
        let _ = write!(
            out,
            "<circle {} opacity=\"{opacity}\" cx=\"{:.1}\" cy=\"{:.1}\" r=\"{radius}\"/>",
            ink.fill(),
            frame.px(x),
            frame.py(y)
        );
    }
}

/// Charts below each other with titles, legends and notes, as a document of their own.
pub fn svg(name: &str, charts: &[Chart]) -> String {
    let mut inner = String::new();
    let mut top = 0.0;
    let text = |inner: &mut String, y: f64, size: u32, words: &str| {
        let _ = write!(
            inner,
            "<text x=\"{LEFT}\" y=\"{y:.1}\" font-size=\"{size}\">{}</text>",
            markup(words)
        );
    };
    for (k, chart) in charts.iter().enumerate() {
        let title = match (k, name) {
            (0, "") => chart.title.clone(),
            (0, name) if charts.len() == 1 || chart.title == name => name.to_string(),
            (0, name) => format!("{name}: {}", chart.title),
            _ => chart.title.clone(),
        };
        text(&mut inner, top + 20.0, 15, &title);
        top += 28.0;
        let own = drawn(chart);
        let _ = write!(
            inner,
            "<svg y=\"{top:.1}\" width=\"{}\" height=\"{}\" {}",
            SIZE[0],
            SIZE[1],
            own.svg.trim_start_matches("<svg ")
        );
        top += SIZE[1];
        for (name, colour) in &own.keys {
            let colour = rgb(colour.map_or_else(|own| own, |k| COLOURS[k]));
            let _ = write!(
                inner,
                "<rect x=\"{LEFT}\" y=\"{:.1}\" width=\"12\" height=\"12\" fill=\"{colour}\"/>",
                top + 2.0
            );
            let _ = write!(
                inner,
                "<text x=\"{}\" y=\"{:.1}\">{}</text>",
                LEFT + 19.0,
                top + 13.0,
                markup(name)
            );
            top += LINE;
        }
        let colours = chart.cells.as_ref().map(|name| format!("Colours: {name}."));
        for line in colours.into_iter().chain(lines(&chart.note)) {
            text(&mut inner, top + 13.0, 12, &line);
            top += LINE;
        }
    }
    let ground = format!("<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>{inner}");
    document([SIZE[0], top + 8.0], name, &ground)
}

/// A sentence in lines that fit below a chart.
fn lines(text: &str) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut().filter(|line| line.chars().count() + word.chars().count() < 76) {
            Some(line) => *line += &format!(" {word}"),
            None => lines.push(word.into()),
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(points: &[[Option<f64>; 2]]) -> Chart {
        let hints = points.iter().map(|p| format!("{p:?}")).collect();
        let series = Series {
            name: "a <b>".into(),
            line: true,
            points: points.into(),
            hints,
            ..Series::default()
        };
        Chart { title: "\"t\" & <x>".into(), series: vec![series], ..Chart::default() }
    }

    #[test]
    fn names_are_text() {
        let svg = svg("<script>", &[line(&[[Some(0.0), Some(1.0)], [Some(1.0), Some(2.0)]])]);
        assert!(!svg.contains("<script>") && !svg.contains("<x>") && !svg.contains("<b>"), "{svg}");
    }

    #[test]
    fn a_point_without_a_value_cuts_the_line() {
        let whole = line(&[[Some(0.0), Some(1.0)], [Some(1.0), Some(2.0)], [Some(2.0), Some(1.0)]]);
        let cut = line(&[[Some(0.0), Some(1.0)], [Some(1.0), None], [Some(2.0), Some(1.0)]]);
        let count = |c: &Chart| drawn(c).svg.matches("stroke-linejoin").count();
        assert_eq!((count(&whole), count(&cut)), (1, 2));
        // What is said stands where the points are.
        let own = drawn(&cut);
        assert_eq!(own.spots.len(), 2);
        for ([x, y], _) in &own.spots {
            assert!(own.svg.contains(&format!("cx=\"{x:.1}\" cy=\"{y:.1}\"")));
        }
        let [left, right, from, to] = own.along;
        assert!(left < own.spots[0].0[0] && own.spots[1].0[0] < right && from < 0.0 && to > 2.0);
    }

    #[test]
    fn what_has_no_logarithm_is_not_drawn_into_nothing() {
        let mut chart = line(&[[Some(1e-3), Some(1e-9)], [Some(1.0), Some(1e-2)]]);
        (chart.x.log, chart.y.log) = (true, true);
        let svg = drawn(&chart).svg;
        assert!(svg.contains(">0.01<") && svg.contains(">1e-9<"), "{svg}");
        assert!(!svg.contains("NaN") && !svg.contains("inf"), "{svg}");
    }

    #[test]
    fn colours_are_those_of_the_scale() {
        assert_eq!((shade(0.0), shade(1.0), shade(-1.0)), (SCALE[0], SCALE[4], SCALE[0]));
        assert_eq!(rgb([0, 114, 178]), "#0072b2");
    }
}
