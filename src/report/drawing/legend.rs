//! What the signs mean, and how long a metre is.

use super::{LINE, MARGIN, WIDTH, projection::Projection, sheet::Sheet};
use base::plain::markup;

/// Width of a sign.
const SIGN: f64 = 30.0;
/// Mean width of a letter.
const LETTER: f64 = 6.5;
/// Between two entries.
const GAP: f64 = 22.0;
/// The scale is about so long.
const SCALE: f64 = 110.0;

/// A sign.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Glyph {
    /// A thick line of a class.
    Line(&'static str),
    /// A ring of a class.
    Pin(&'static str),
    /// A cross of a class.
    Dot(&'static str),
    /// A filled box of a class.
    Swatch(&'static str),
    /// A wheel.
    Wheel,
    /// A dashed line.
    Ghost,
    /// An arrow of a class in a direction.
    Arrow(&'static str, [f64; 2]),
}

/// Signs with words.
#[derive(Default)]
pub struct Legend(Vec<(Glyph, String)>);

impl Legend {
    /// Adds an entry unless its words stand there already.
    pub fn add(&mut self, glyph: Glyph, words: &str) {
        if !self.0.iter().any(|(_, w)| w == words) {
            self.0.push((glyph, words.into()));
        }
    }

    /// Draws entries in rows from `top` downwards, the scale at the end of the last one; returns
    /// where it ends.
    pub fn draw(&self, sheet: &mut Sheet, top: f64, paper: &Projection) -> f64 {
        let (mut x, mut y) = (MARGIN, top + 0.5 * LINE);
        for (glyph, words) in &self.0 {
            let width = SIGN + 8.0 + LETTER * words.chars().count() as f64;
            if x > MARGIN && x + width > WIDTH - MARGIN {
                (x, y) = (MARGIN, y + LINE);
            }
            sign(sheet, *glyph, x, y);
            sheet.put(format_args!(
                "<text x=\"{:.1}\" y=\"{:.1}\">{}</text>\n",
                x + SIGN + 8.0,
                y + 5.0,
                markup(words)
            ));
            x += width + GAP;
        }
        let (length, words) = scale(paper.scale);
        if x > MARGIN && x + length + LETTER * 8.0 > WIDTH - MARGIN {
            y += LINE;
        }
        let right = WIDTH - MARGIN;
        let left = right - length;
        sheet.put(format_args!(
            "<path class=\"scale\" d=\"M{left:.1} {:.1}v6h{length:.1}v-6\"/>\n",
            y - 3.0
        ));
        sheet.put(format_args!(
            "<text class=\"end\" x=\"{:.1}\" y=\"{:.1}\">{words}</text>\n",
            left - 8.0,
            y + 5.0
        ));
        y + 0.5 * LINE
    }
}

fn sign(sheet: &mut Sheet, glyph: Glyph, x: f64, y: f64) {
    let middle = x + 0.5 * SIGN;
    match glyph {
        Glyph::Line(class) => sheet.put(format_args!("<path class=\"line {class}\" stroke-width=\"3\" d=\"M{x:.1} {y:.1}h{SIGN}\"/>")),
        Glyph::Pin(class) => sheet.put(format_args!("<circle class=\"pin {class}\" cx=\"{middle:.1}\" cy=\"{y:.1}\" r=\"4\"/>")),
        Glyph::Dot(class) => sheet.put(format_args!("<path class=\"slide {class}\" d=\"M{:.1} {:.1}l6 6m0 -6l-6 6\"/>", middle - 3.0, y - 3.0)),
        Glyph::Swatch(class) => sheet.put(format_args!(
            "<g class=\"{class}\"><rect class=\"f1\" x=\"{:.1}\" y=\"{:.1}\" width=\"{:.1}\" height=\"13\"/><path class=\"edge\" d=\"M{:.1} {:.1}h{:.1}v13h{:.1}z\"/></g>",
            x + 2.0,
            y - 6.5,
            SIGN - 4.0,
            x + 2.0,
            y - 6.5,
            SIGN - 4.0,
            4.0 - SIGN
        )),
        Glyph::Wheel => sheet.put(format_args!("<circle class=\"wheel\" cx=\"{middle:.1}\" cy=\"{y:.1}\" r=\"5\"/>")),
        Glyph::Ghost => sheet.put(format_args!("<path class=\"ghost\" d=\"M{x:.1} {y:.1}h{SIGN}\"/>")),
        Glyph::Arrow(class, [dx, dy]) => {
            let half = 0.45 * SIGN;
            sheet.arrow(class, [middle - half * dx, y - half * dy], [middle + half * dx, y + half * dy]);
        }
    }
}

/// A round length near [`SCALE`], in units of the sheet and in words.
fn scale(per_metre: f64) -> (f64, String) {
    let wanted = SCALE / per_metre;
    let ten = 10f64.powf(wanted.log10().floor());
    let round = [5.0, 2.0, 1.0].into_iter().map(|k| k * ten).find(|r| *r <= wanted).unwrap_or(ten);
    let words = match round {
        r if r >= 1e3 => format!("{:.0} km", r * 1e-3),
        r if r >= 1.0 => format!("{r:.0} m"),
        r if r >= 0.0099 => format!("{:.0} cm", r * 1e2),
        r if r >= 0.00099 => format!("{:.0} mm", r * 1e3),
        r => format!("{r:.0e} m"),
    };
    (round * per_metre, words)
}
