//! Words of the command line as values.

use clap::builder::{OsStringValueParser, TypedValueParser};
use std::{
    ffi::OsString,
    path::{Path, PathBuf},
};
use voussoir::{
    analysis::SupportMove,
    ground::Pulse,
    import::{LayerRule, Up},
    scene::Friction,
};

/// What is required of an answer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Requirement {
    /// At least this value.
    Value(f64),
    /// This share of the earthquake of the site.
    Site(f64),
}

/// `site`, `site:0.8` or a number: what is required.
pub fn requirement(text: &str) -> Result<Requirement, String> {
    match text.strip_prefix("site") {
        Some("") => Ok(Requirement::Site(1.0)),
        Some(share) => match share.strip_prefix(':').map(positive) {
            Some(Ok(share)) => Ok(Requirement::Site(share)),
            _ => Err("write `site`, or `site:0.8` for a share of it".into()),
        },
        None => finite(text).map(Requirement::Value),
    }
}

/// What an output option writes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Written {
    Svg,
    Html,
    Csv,
    Json,
    /// JSON, one value a line.
    Lines,
    /// VTK, one answer or a film.
    Vtk,
    /// glTF, as text or binary.
    Gltf,
    /// Meshes of blocks.
    Obj,
    /// Models of other programs.
    Model,
    /// Grains as a table, points or a dump.
    Grains,
    /// A folder of several files.
    Folder,
}

impl Written {
    /// What it is called.
    fn noun(self) -> &'static str {
        match self {
            Self::Svg => "a drawing (SVG)",
            Self::Html => "a page for a browser (HTML)",
            Self::Csv => "a table (CSV)",
            Self::Json => "JSON",
            Self::Lines => "JSON lines",
            Self::Vtk => "a file for ParaView (VTK XML)",
            Self::Gltf => "a 3D model (glTF)",
            Self::Obj => "a mesh (OBJ)",
            Self::Model => "a model of MuJoCo (MJCF) or 3DEC",
            Self::Grains => "grains as a table (CSV), points (VTK XML) or a dump of LIGGGHTS",
            Self::Folder => "several files into a folder",
        }
    }

    /// The endings that files of its kind have, the usual one first.
    fn endings(self) -> &'static [&'static str] {
        match self {
            Self::Svg => &["svg"],
            Self::Html => &["html", "htm", "xhtml"],
            Self::Csv => &["csv"],
            Self::Json => &["json"],
            Self::Lines => &["jsonl", "ndjson", "json"],
            Self::Vtk => &["vtp", "pvd"],
            Self::Gltf => &["gltf", "glb"],
            Self::Obj => &["obj"],
            Self::Model => &["xml", "mjcf", "3ddat", "3dec", "dat"],
            Self::Grains => &["csv", "vtp", "dump", "liggghts", "lammpstrj"],
            Self::Folder => &[],
        }
    }
}

/// Endings by which other programs know formats that none of the options writes.
const FOREIGN: [&str; 39] = [
    "pdf", "png", "jpg", "jpeg", "gif", "tif", "tiff", "bmp", "webp", "eps", "ps", "svgz", "mp4",
    "webm", "avi", "mov", "tex", "md", "doc", "docx", "odt", "xls", "xlsx", "ods", "tsv",
    "parquet", "xml", "yaml", "yml", "toml", "vtk", "vtu", "obj", "ply", "stl", "dxf", "dwg",
    "3dm", "gz",
];

/// A file to write, refused where its ending says that it is of another format: nobody could open
/// it. Endings that say nothing are left alone.
pub fn output(what: Written) -> impl TypedValueParser<Value = PathBuf> {
    OsStringValueParser::new().try_map(move |name| fits(name, what))
}

fn fits(name: OsString, what: Written) -> Result<PathBuf, String> {
    const ALL: [Written; 6] =
        [Written::Svg, Written::Html, Written::Csv, Written::Json, Written::Lines, Written::Vtk];
    let path = PathBuf::from(name);
    let ending = path.extension().map(|e| e.to_string_lossy().to_ascii_lowercase());
    let known = |e: &str| FOREIGN.contains(&e) || ALL.iter().any(|w| w.endings().contains(&e));
    match ending.filter(|e| known(e) && !what.endings().contains(&e.as_str())) {
        None => Ok(path),
        Some(ending) => Err(format!(
            "this option writes {}, but .{ending} is another format; {}",
            what.noun(),
            remedy(&path, &ending, what)
        )),
    }
}

fn remedy(path: &Path, ending: &str, what: Written) -> String {
    let Some(usual) = what.endings().first() else {
        return "name a folder, which needs no ending".into();
    };
    let named = path.with_extension(usual);
    let named = format!("name it {}", named.display());
    match (what, ending) {
        (Written::Svg, "pdf" | "png" | "eps" | "ps") => {
            format!("{named}, and convert that, for example with rsvg-convert -f {ending}")
        }
        (Written::Html, "pdf") => format!("{named}, and print that from a browser"),
        (Written::Csv, "xlsx" | "xls" | "ods") => format!("{named}, and open that"),
        _ => named,
    }
}

/// Bytes, with a unit of 1024s: 500M, 8G, 8GiB.
pub fn bytes(text: &str) -> Result<u64, String> {
    let wrong = || "not a size such as 500M or 8G".to_string();
    let text = text.trim().to_ascii_uppercase();
    let text = text.strip_suffix('B').unwrap_or(&text);
    let text = text.strip_suffix('I').unwrap_or(text);
    let power = text.chars().last().and_then(|c| "KMGT".find(c)).map(|k| k + 1);
    let number = if power.is_some() { &text[..text.len() - 1] } else { text };
    let value: f64 = number.parse().map_err(|_| wrong())?;
    let bytes = value * 1024f64.powi(power.unwrap_or(0) as i32);
    if bytes >= 1.0 && bytes < 2f64.powi(63) { Ok(bytes as u64) } else { Err(wrong()) }
}

pub fn finite(text: &str) -> Result<f64, String> {
    text.trim()
        .parse()
        .ok()
        .filter(|v: &f64| v.is_finite())
        .ok_or_else(|| "not a finite number".into())
}

pub fn word(text: &str) -> Result<String, String> {
    let ok = !text.is_empty() && !text.chars().any(|c| c.is_whitespace() || c.is_control());
    ok.then(|| text.to_string()).ok_or_else(|| "not a single word without spaces".into())
}

pub fn one_line(text: &str) -> Result<String, String> {
    let ok = text.starts_with('-') && !text.chars().any(char::is_control);
    ok.then(|| text.to_string())
        .ok_or_else(|| "not an option on one line, such as --account=stone".into())
}

pub fn positive(text: &str) -> Result<f64, String> {
    finite(text).ok().filter(|v| *v > 0.0).ok_or_else(|| "not a number > 0".into())
}

pub fn at_least_one(text: &str) -> Result<f64, String> {
    finite(text).ok().filter(|v| *v >= 1.0).ok_or_else(|| "not a number >= 1".into())
}

pub fn not_negative(text: &str) -> Result<f64, String> {
    finite(text).ok().filter(|v| *v >= 0.0).ok_or_else(|| "not a number >= 0".into())
}

pub fn share(text: &str) -> Result<f64, String> {
    not_negative(text).ok().filter(|v| *v <= 1.0).ok_or_else(|| "not a share from 0 to 1".into())
}

pub fn friction(text: &str) -> Result<Friction, String> {
    match text {
        "infinite" => Ok(Friction::Infinite),
        _ => not_negative(text)
            .map(Friction::Coefficient)
            .map_err(|_| "not a coefficient >= 0 or `infinite`".into()),
    }
}

pub fn restitution(text: &str) -> Result<f64, String> {
    share(text).map_err(|_| "not a coefficient of restitution from 0 to 1".into())
}

pub fn pulse(text: &str) -> Result<(String, Pulse), String> {
    Ok((text.to_string(), text.parse()?))
}

pub fn scales(text: &str) -> Result<(f64, f64), String> {
    let wrong = || "not two scales > 0, the smaller one first, such as 0.5,3".to_string();
    let (from, to) = text.split_once(',').ok_or_else(wrong)?;
    match (positive(from), positive(to)) {
        (Ok(from), Ok(to)) if from < to => Ok((from, to)),
        _ => Err(wrong()),
    }
}

pub fn direction(text: &str) -> Result<[f64; 3], String> {
    let parts: Result<Vec<f64>, String> = text.split(',').map(finite).collect();
    match parts.map_err(|_| "not two or three numbers separated by commas, such as 1,0")?[..] {
        [x, y] => Ok([x, y, 0.0]),
        [x, y, z] => Ok([x, y, z]),
        _ => Err("not two or three numbers separated by commas, such as 1,0".into()),
    }
}

pub fn assignment(text: &str) -> Result<(String, String), String> {
    match text.split_once('=') {
        Some((key, value)) if !key.is_empty() => Ok((key.into(), value.into())),
        _ => Err("not of the form key=value".into()),
    }
}

/// `NAME=ROLE[,KEY=VALUE]…`: a layer of a drawing and what it stands for.
pub fn layer(text: &str) -> Result<(String, LayerRule), String> {
    // Names of layers hold no `=`.
    let (name, rule) = text.split_once('=').ok_or("not NAME=ROLE, like ground=support")?;
    Ok((name.into(), rule.parse()?))
}

pub fn up(text: &str) -> Result<Up, String> {
    match text.to_ascii_lowercase().trim_start_matches('+') {
        "x" => Ok(Up::X),
        "y" => Ok(Up::Y),
        "z" => Ok(Up::Z),
        "-x" => Ok(Up::MinusX),
        "-y" => Ok(Up::MinusY),
        "-z" => Ok(Up::MinusZ),
        _ => Err("not one of x, y, z, -x, -y, -z".into()),
    }
}

/// A block and so many numbers, `BLOCK=1,2,3`. The last equals sign counts: ids may have some.
fn block_and_numbers(text: &str) -> Option<(String, Vec<f64>)> {
    let (id, numbers) = text.rsplit_once('=')?;
    let numbers: Result<Vec<f64>, String> = numbers.split(',').map(finite).collect();
    (!id.is_empty()).then_some((id.to_string(), numbers.ok()?))
}

pub fn support_move(text: &str) -> Result<SupportMove, String> {
    let wrong = "not a support with three or six numbers or an outward displacement, such as right=0.1,0,0 or springer_*=out:0.05";
    if let Some((support, out)) = text.rsplit_once("=out:").filter(|(id, _)| !id.is_empty()) {
        return Ok(SupportMove::outwards(support, finite(out).map_err(|_| wrong)?));
    }
    let (support, numbers) = block_and_numbers(text).ok_or(wrong)?;
    match numbers[..] {
        [x, y, z] => Ok(SupportMove::along(support, [x, y, z])),
        [x, y, z, a, b, c] => {
            Ok(SupportMove { turn_deg: [a, b, c], ..SupportMove::along(support, [x, y, z]) })
        }
        _ => Err(wrong.into()),
    }
}

pub fn control(text: &str) -> Result<(String, [f64; 3]), String> {
    let wrong = "not a block with one of its points, such as v03=0.2,0,1.1";
    match block_and_numbers(text) {
        Some((id, numbers)) => match numbers[..] {
            [x, y, z] => Ok((id, [x, y, z])),
            _ => Err(wrong.into()),
        },
        None => Err(wrong.into()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn endings_of_other_formats_are_refused_with_the_right_name() {
        for (name, what, wanted) in [
            ("x.png", Written::Svg, "name it x.svg, and convert that"),
            ("X.PNG", Written::Svg, "name it X.svg"),
            ("a/r.pdf", Written::Html, "name it a/r.html, and print that"),
            ("r.json", Written::Html, "name it r.html"),
            ("t.xlsx", Written::Csv, "name it t.csv, and open that"),
            ("r.jsonl", Written::Json, "name it r.json"),
            ("r.svg", Written::Lines, "name it r.jsonl"),
            ("charts.svg", Written::Folder, "name a folder"),
        ] {
            let said = fits(name.into(), what).unwrap_err();
            assert!(said.contains(wanted), "{name}: {said}");
        }
        for (name, what) in [
            ("x.svg", Written::Svg),
            ("x.SVG", Written::Svg),
            ("x.htm", Written::Html),
            ("-", Written::Csv),
            ("/dev/null", Written::Svg),
            ("forces", Written::Csv),
            ("forces.txt", Written::Csv),
            ("case-1.2", Written::Json),
            ("rows.json", Written::Lines),
        ] {
            assert_eq!(fits(name.into(), what), Ok(name.into()));
        }
    }
}
