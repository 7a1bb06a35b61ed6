//! Text of a drawing, and how it looks.

use std::fmt::{Arguments, Write};

/// Thickness of the edges in [`STYLE`].
pub const EDGE: f64 = 0.9;

/// Four shades a kind of block, the first the brightest. Programs that leave media queries out
/// (Inkscape, librsvg) draw the light page.
pub const STYLE: &str = "\
.page{fill:#ffffff}\
.block .f0{fill:#f4f0e8}.block .f1{fill:#eae4d8}.block .f2{fill:#dcd4c5}.block .f3{fill:#cac1b0}.block .edge{stroke:#6b6558}\
.moved .f0{fill:#fbe7d9}.moved .f1{fill:#f6d9c5}.moved .f2{fill:#eac7ae}.moved .f3{fill:#dbb296}.moved .edge{stroke:#8a4a1f}\
.support .f0{fill:#d3d6da}.support .f1{fill:#c6cacf}.support .f2{fill:#b7bcc2}.support .f3{fill:#a6acb4}.support .edge{stroke:#60656c}\
.edge{fill:none;stroke-width:.9;stroke-linejoin:round;stroke-linecap:round}circle.f1{stroke-width:.9}\
.block circle{stroke:#6b6558}.moved circle{stroke:#8a4a1f}.support circle{stroke:#60656c}\
.joint{fill:none;stroke:#3d3a33;stroke-width:1.4;stroke-linecap:round}.far{stroke-width:.5;stroke-opacity:.25}\
.ghost{fill:none;stroke:#55524b;stroke-width:.8;stroke-dasharray:3 3}\
.one{stroke:#0b62a8}.two{stroke:#b5430c}.line{fill:none;stroke-linecap:round;stroke-linejoin:round}\
.pin{fill:#ffffff;stroke-width:1.8}.act{stroke:#a3230b}.slide{fill:none;stroke-width:2.4;stroke-linecap:round}\
.load{stroke:#1d6b35;fill:#1d6b35;stroke-width:1.8}.down{stroke:#222222;fill:#222222;stroke-width:1.6}\
.scale{stroke:#222222;fill:none;stroke-width:1.4}\
text{font:14px Helvetica,Arial,sans-serif;fill:#222222}.caption{font-size:15px;text-anchor:middle}.end{text-anchor:end}\
@media (prefers-color-scheme:dark){.page{fill:#16181c}\
.block .f0{fill:#4a4741}.block .f1{fill:#403e38}.block .f2{fill:#373530}.block .f3{fill:#2e2c28}.block .edge,.block circle{stroke:#a8a294}\
.moved .f0{fill:#74482f}.moved .f1{fill:#673f29}.moved .f2{fill:#573523}.moved .f3{fill:#482c1d}.moved .edge,.moved circle{stroke:#f0a878}\
.support .f0{fill:#636870}.support .f1{fill:#565b62}.support .f2{fill:#4a4e55}.support .f3{fill:#3f4248}.support .edge,.support circle{stroke:#b4b9c0}\
.joint{stroke:#cfc8ba}.ghost{stroke:#b0aca3}.one{stroke:#6cb8ff}.two{stroke:#ff9a5c}.pin{fill:#16181c}.act{stroke:#ff7d5c}\
.load{stroke:#7ad092;fill:#7ad092}.down,.scale{stroke:#e6e6e6}.down{fill:#e6e6e6}text{fill:#e6e6e6}}";

/// The same of blocks that can be taken out, and of those of which that is not known.
pub const VALUES: &str = "\
.goes .f0{fill:#d9f0dc}.goes .f1{fill:#c8e6cd}.goes .f2{fill:#b3d6ba}.goes .f3{fill:#9bc4a5}.goes .edge,.goes circle{stroke:#2f6b3d}\
.open .f0{fill:#fbf0c9}.open .f1{fill:#f6e7b2}.open .f2{fill:#eadb9c}.open .f3{fill:#dbca84}.open .edge,.open circle{stroke:#7a6414}\
@media (prefers-color-scheme:dark){\
.goes .f0{fill:#2f5c3a}.goes .f1{fill:#285132}.goes .f2{fill:#21452a}.goes .f3{fill:#1b3922}.goes .edge,.goes circle{stroke:#8fd6a0}\
.open .f0{fill:#6b5c22}.open .f1{fill:#5e511d}.open .f2{fill:#504518}.open .f3{fill:#423914}.open .edge,.open circle{stroke:#e6d27a}}";

/// Supports that one looks through.
pub const GLASS: &str = "\
.glass .f0,.glass .f1,.glass .f2,.glass .f3{fill-opacity:.16}.glass .edge{stroke-opacity:.55}";

/// The rules of a style for what lies inside `place` alone, without those for dark pages.
pub fn scoped(style: &str, place: &str) -> String {
    let light = style.split("@media").next().unwrap_or_default();
    let mut out = String::new();
    for rule in light.split_inclusive('}') {
        let Some((names, body)) = rule.split_once('{') else { continue };
        let names: Vec<String> =
            names.split(',').map(|name| format!("{place} {}", name.trim())).collect();
        out.push_str(&names.join(","));
        out.push('{');
        out.push_str(body);
    }
    out
}

/// Text that grows.
#[derive(Default)]
pub struct Sheet {
    /// The text.
    pub text: String,
}

impl Sheet {
    /// Adds text.
    pub fn put(&mut self, text: Arguments) {
        // Writing to a string cannot fail.
        let _ = self.text.write_fmt(text);
    }

    /// Adds an arrow with its head at `to`.
    pub fn arrow(&mut self, class: &str, from: [f64; 2], to: [f64; 2]) {
        let [dx, dy] = [to[0] - from[0], to[1] - from[1]];
        let length = dx.hypot(dy);
        if length < 1.0 {
            return self.put(format_args!(
                "<circle class=\"{class}\" cx=\"{:.1}\" cy=\"{:.1}\" r=\"2.5\"/>\n",
                to[0], to[1]
            ));
        }
        let head = (0.45 * length).min(9.0);
        let (ux, uy) = (dx / length, dy / length);
        let neck = [to[0] - head * ux, to[1] - head * uy];
        let (sx, sy) = (-0.38 * head * uy, 0.38 * head * ux);
        self.put(format_args!(
            "<path class=\"{class}\" d=\"M{:.1} {:.1}L{:.1} {:.1}M{:.1} {:.1}L{:.1} {:.1}L{:.1} {:.1}Z\"/>\n",
            from[0],
            from[1],
            neck[0],
            neck[1],
            to[0],
            to[1],
            neck[0] + sx,
            neck[1] + sy,
            neck[0] - sx,
            neck[1] - sy
        ));
    }
}
