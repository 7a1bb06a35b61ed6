//! Packing lists: a table (CSV) with a box a row, in the order in which they are placed, → blocks and stages
//! of construction.
//!
//! | columns | meaning |
//! |---|---|
//! | `length`, `width`, `height` (or `l`, `w`, `h`; `size_x` …; `dx` …) | sides along x, y, z before the box is turned |
//! | `x`, `y`, `z` | the lowest corner, of boxes that are not turned |
//! | `center_x`, `center_y`, `center_z` (or `cx` …) | the centre |
//! | `yaw_deg`, or `qw`, `qx`, `qy`, `qz` | how it is turned about its centre |
//! | `id` (or `name`), `mass` or `weight_kg` (kg), `density` (kg/m³), `support`, `step` | as they say |
//!
//! Without a support the boxes stand on a plane at the foot of the lowest.

use super::{
    ImportOptions,
    raw::{Ground, Heft, Raw, Solid, list, tally},
    rigid::cuboid,
    text::{self, error, shorten},
};
use crate::StageSpec;
use base::error::{FindingCode, InputError};
use csv::{ByteRecord, ReaderBuilder, StringRecord, Trim};
use nalgebra::{Isometry3, Point3, Quaternion, Translation3, UnitQuaternion, Vector3};
/// Names of the sides.
const SIZES: [[&str; 3]; 5] = [
    ["length", "width", "height"],
    ["l", "w", "h"],
    ["size_x", "size_y", "size_z"],
    ["sx", "sy", "sz"],
    ["dx", "dy", "dz"],
];
const CORNER: [[&str; 3]; 1] = [["x", "y", "z"]];
const CENTER: [[&str; 3]; 2] = [["center_x", "center_y", "center_z"], ["cx", "cy", "cz"]];
const TURN: [&str; 4] = ["qw", "qx", "qy", "qz"];
const OTHERS: [&str; 8] =
    ["id", "name", "mass", "weight_kg", "density", "support", "step", "yaw_deg"];

/// The plane on which boxes stand.
const FLOOR: &str = "floor";

/// Whether a table has the columns of boxes.
pub(super) fn looks_like(bytes: &[u8]) -> bool {
    let bytes = text::unmarked(bytes);
    let head = text::split(bytes).find(|l| !l.trim_ascii().is_empty()).unwrap_or_default();
    let titles = titles(&String::from_utf8_lossy(head).split(separator(head) as char).collect());
    found(&titles, &SIZES).is_some()
}

/// What stands between the columns: the first of the usual marks that the head has.
fn separator(head: &[u8]) -> u8 {
    [b';', b'\t', b','].into_iter().find(|c| head.contains(c)).unwrap_or(b',')
}

/// Titles in small letters, without units in brackets, words joined by an underscore.
fn titles(record: &StringRecord) -> Vec<String> {
    let plain = |t: &str| {
        let name = t.split(['(', '[']).next().unwrap_or_default();
        name.trim().trim_matches('"').to_ascii_lowercase().replace([' ', '-'], "_")
    };
    record.iter().map(plain).collect()
}

/// The first three columns of these names.
fn found(titles: &[String], names: &[[&str; 3]]) -> Option<[usize; 3]> {
    let column = |name: &str| titles.iter().position(|t| t == name);
    names.iter().find_map(|[x, y, z]| Some([column(x)?, column(y)?, column(z)?]))
}

/// A row and the columns.
struct Row<'a> {
    line: usize,
    titles: &'a [String],
    record: StringRecord,
}

impl Row<'_> {
    fn word(&self, name: &str) -> Option<&str> {
        let k = self.titles.iter().position(|t| t == name)?;
        self.record.get(k).filter(|w| !w.is_empty())
    }

    fn number_at(&self, k: usize) -> Result<f64, InputError> {
        let word = self.record.get(k).unwrap_or_default();
        word.parse().ok().filter(|v: &f64| v.is_finite()).ok_or_else(|| {
            let message =
                format!("{}: expected a finite number, got {:?}", self.titles[k], shorten(word));
            error(self.line, message).hint("numbers have a decimal point and no unit")
        })
    }

    fn number(&self, name: &str) -> Result<Option<f64>, InputError> {
        match (self.word(name), self.titles.iter().position(|t| t == name)) {
            (Some(_), Some(k)) => self.number_at(k).map(Some),
            _ => Ok(None),
        }
    }

    /// A number above zero.
    fn positive(&self, name: &str) -> Result<Option<f64>, InputError> {
        match self.number(name)? {
            Some(v) if v <= 0.0 => {
                Err(error(self.line, format!("{name}: must be > 0, got {v}")).hint("kg, kg/m³"))
            }
            other => Ok(other),
        }
    }

    fn turn(&self) -> Result<UnitQuaternion<f64>, InputError> {
        let mut q = [0.0; 4];
        for (part, name) in q.iter_mut().zip(TURN) {
            *part = self.number(name)?.unwrap_or(0.0);
        }
        if q != [0.0; 4] {
            let turn = Quaternion::new(q[0], q[1], q[2], q[3]);
            return Ok(UnitQuaternion::from_quaternion(turn));
        }
        let yaw = self.number("yaw_deg")?.unwrap_or(0.0);
        Ok(UnitQuaternion::from_axis_angle(&Vector3::z_axis(), yaw.to_radians()))
    }
}

/// The boxes of a list.
pub(super) fn read(bytes: &[u8], options: &ImportOptions) -> Result<Raw, InputError> {
    let bytes = text::unmarked(bytes);
    let head = text::split(bytes).find(|l| !l.trim_ascii().is_empty()).unwrap_or_default();
    let mut reader = ReaderBuilder::new()
        .delimiter(separator(head))
        .trim(Trim::All)
        .flexible(true)
        .comment(Some(b'#'))
        .from_reader(bytes);
    let unread = |e: csv::Error| {
        let line = e.position().map_or(1, |p| p.line() as usize);
        error(line, format!("no table: {e}")).hint("save it as CSV in UTF-8")
    };
    let titles = titles(reader.headers().map_err(unread)?);
    let lacks = |what: &str| {
        error(1, format!("no columns {what} among {:?}", shorten(&titles.join(", "))))
            .hint("packing lists have length, width, height and x, y, z of the lowest corner, or center_x, center_y, center_z")
    };
    let sides = found(&titles, &SIZES).ok_or_else(|| lacks("length, width, height"))?;
    let center = found(&titles, &CENTER);
    let place = match center {
        Some(place) => place,
        None => found(&titles, &CORNER).ok_or_else(|| lacks("x, y, z"))?,
    };
    let known = |k: usize| {
        sides.contains(&k)
            || place.contains(&k)
            || TURN.contains(&titles[k].as_str())
            || OTHERS.contains(&titles[k].as_str())
    };
    let others: Vec<String> =
        (0..titles.len()).filter(|k| !known(*k)).map(|k| titles[k].clone()).collect();
    let mut raw = Raw::default();
    let mut steps: Vec<Option<f64>> = Vec::new();
    let mut bare = Vec::new();
    let mut record = ByteRecord::new();
    while reader.read_byte_record(&mut record).map_err(unread)? {
        let row = Row {
            line: record.position().map_or(1, |p| p.line() as usize),
            titles: &titles,
            record: StringRecord::from_byte_record_lossy(record.clone()),
        };
        let mut size = [0.0; 3];
        let mut at = [0.0; 3];
        for k in 0..3 {
            (size[k], at[k]) = (row.number_at(sides[k])?, row.number_at(place[k])?);
            if size[k] <= 0.0 {
                let message = format!("{}: must be > 0, got {}", titles[sides[k]], size[k]);
                return Err(error(row.line, message).hint("the sides of the box"));
            }
        }
        let turn = row.turn()?;
        let half = size.map(|s| 0.5 * s);
        let middle = match center {
            Some(_) => at,
            None if turn.angle() == 0.0 => std::array::from_fn(|k| at[k] + half[k]),
            None => {
                return Err(error(row.line, "a box that is turned, placed by its corner")
                    .hint("place it by center_x, center_y, center_z"));
            }
        };
        let pose = Isometry3::from_parts(Translation3::from(Vector3::from(middle)), turn);
        let mut mesh = cuboid(half);
        for v in &mut mesh.vertices {
            *v = match center {
                // Corners of boxes that touch are the same numbers.
                None => std::array::from_fn(|k| if v[k] < 0.0 { at[k] } else { at[k] + size[k] }),
                Some(_) => (pose * Point3::from(*v)).coords.into(),
            };
        }
        let mass =
            row.positive("mass")?.map_or_else(|| row.positive("weight_kg"), |m| Ok(Some(m)))?;
        let held = |w: &str| !["0", "false", "no"].contains(&w.to_ascii_lowercase().as_str());
        let block = Solid {
            id: row.word("id").or(row.word("name")).unwrap_or_default().to_string(),
            vertices: mesh.vertices,
            faces: mesh.faces,
            support: row.word("support").is_some_and(held),
            heft: Heft { mass, density: row.positive("density")?, centroid: None },
            line: Some(row.line),
            ..Solid::default()
        };
        if mass.is_none() && block.heft.density.is_none() && !block.support {
            bare.push(format!("line {}", row.line));
        }
        steps.push(row.number("step")?);
        raw.blocks.push(block);
    }
    raw.name_apart("box");
    stages(&mut raw, &steps);
    floor(&mut raw, options);
    if !others.is_empty() {
        raw.say(FindingCode::LeftOut, format!("columns left out: {}", list(&others)));
    }
    if !bare.is_empty() {
        let text = format!(
            "boxes without a mass, for which the density of the scene's default is assumed: {}; add a column `mass`, or import with `--density`",
            tally(&bare)
        );
        raw.say(FindingCode::Missing, text);
    }
    if center.is_none() && !raw.blocks.is_empty() {
        raw.say(FindingCode::Converted, "x, y, z are read as the lowest corner of each box");
    }
    Ok(raw)
}

/// A stage a box in the order of the rows, or a stage a step.
fn stages(raw: &mut Raw, steps: &[Option<f64>]) {
    let placed: Vec<(Option<f64>, String)> = raw
        .blocks
        .iter()
        .zip(steps)
        .filter(|(b, _)| !b.support)
        .map(|(b, step)| (*step, b.id.clone()))
        .collect();
    if placed.iter().all(|(step, _)| step.is_none()) {
        raw.stages = placed.into_iter().map(|(_, id)| stage(id.clone(), vec![id])).collect();
        return;
    }
    let (mut of_steps, late): (Vec<_>, Vec<_>) = placed.into_iter().partition(|p| p.0.is_some());
    of_steps.sort_by(|a, b| f64::total_cmp(&a.0.unwrap_or(0.0), &b.0.unwrap_or(0.0)));
    for same in of_steps.chunk_by(|a, b| a.0 == b.0) {
        let name = format!("step {}", same[0].0.unwrap_or(0.0));
        raw.stages.push(stage(name, same.iter().map(|p| p.1.clone()).collect()));
    }
    let late: Vec<String> = late.into_iter().map(|p| p.1).collect();
    if !late.is_empty() {
        let text = format!("boxes without a step, placed last: {}", tally(&late));
        raw.say(FindingCode::Converted, text);
        raw.stages.push(stage("without a step".into(), late));
    }
}

fn stage(name: String, add: Vec<String>) -> StageSpec {
    StageSpec { name, add, ..StageSpec::default() }
}

/// A plane under the lowest box, where nothing is held.
fn floor(raw: &mut Raw, options: &ImportOptions) {
    if raw.blocks.is_empty() || raw.blocks.iter().any(|b| b.support) {
        return;
    }
    let up = raw.up(options);
    let height = |v: &[f64; 3]| up.rotate(*v)[2];
    let corners = raw.blocks.iter().flat_map(|b| &b.vertices);
    let low = corners.copied().min_by(|a, b| height(a).total_cmp(&height(b)));
    let axes = [[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]];
    let axes = axes.into_iter().flat_map(|a| [a, a.map(|c| 0.0 - c)]);
    let (Some(at), Some(normal)) = (low, axes.into_iter().find(|a| height(a) == 1.0)) else {
        return;
    };
    let text = format!("no box is a support: they stand on a plane at the height {}", height(&at));
    raw.say(FindingCode::Converted, text);
    let mut id = FLOOR.to_string();
    while raw.blocks.iter().any(|b| b.id == id) {
        id.push('_');
    }
    raw.planes.push(Ground { id, at, normal, material: None, line: 1 });
}
