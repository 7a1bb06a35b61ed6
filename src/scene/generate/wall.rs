//! The wall: running bond, cut by its ends and openings.
//!
//! Positions along the wall are counted in block lengths, so that the joints of the bond are exact
//! halves.

use super::{check::TemplatePath, digits, support};
use crate::{
    BlockSpec, Shape,
    template::{Opening, Wall, WallBase, WallEnd},
};
use base::{
    error::{InputError, JsonPath},
    tolerance::GRID_SNAP,
};
use std::ops::Range;

/// An opening on the grid: from where to where in block lengths, and which courses.
struct Hole {
    x: Range<f64>,
    courses: Range<usize>,
}

pub fn blocks(wall: &Wall) -> Result<Vec<BlockSpec>, InputError> {
    let place = TemplatePath::template("wall");
    let holes = check(&place, wall)?;
    let [length, depth, height] = wall.size;
    let cuboid = |x: &Range<f64>, z: f64| {
        (
            Shape::Cuboid { size: [(x.end - x.start) * length, depth, height] },
            [(x.start + x.end) / 2.0 * length, 0.0, z * height],
        )
    };
    let foot = 0.0..wall.blocks as f64;
    let mut blocks = Vec::new();
    match wall.base {
        WallBase::Slab => {
            let (shape, at) = cuboid(&foot, -0.5);
            blocks.push(BlockSpec { at, ..support("base", shape) });
        }
        WallBase::Course => {
            for (k, x) in cut(&foot, moved(wall, 1), &[]).iter().enumerate() {
                let (shape, at) = cuboid(x, -0.5);
                blocks.push(BlockSpec {
                    at,
                    ..support(format!("base_{k:0width$}", width = digits(wall.blocks + 1)), shape)
                });
            }
        }
        WallBase::None => {}
    }
    let (course_digits, block_digits) = (digits(wall.courses), digits(wall.blocks + 1));
    for course in 0..wall.courses {
        let holes: Vec<_> =
            holes.iter().filter(|h| h.courses.contains(&course)).map(|h| &h.x).collect();
        for (k, x) in cut(&ends(wall, course), moved(wall, course), &holes).iter().enumerate() {
            let (shape, at) = cuboid(x, course as f64 + 0.5);
            blocks.push(BlockSpec {
                at,
                ..BlockSpec::new(format!("c{course:0course_digits$}_{k:0block_digits$}"), shape)
            });
        }
    }
    Ok(blocks)
}

fn check(place: &TemplatePath, wall: &Wall) -> Result<Vec<Hole>, InputError> {
    place.size("size", wall.size)?;
    place.count("courses", wall.courses, 1)?;
    place.count("blocks", wall.blocks, 1)?;
    place.total("courses", &[wall.courses.saturating_add(1), wall.blocks.saturating_add(1)])?;
    place.total("openings", &[wall.courses, wall.openings.len()])?;
    for (field, rake) in [("rake_left", wall.rake_left), ("rake_right", wall.rake_right)] {
        if !(rake.is_finite() && rake >= 0.0) {
            return Err(place.error(
                field,
                format!("must be ≥ 0, got {rake}"),
                "in blocks per course; 0.5 moves the end in by half a block",
            ));
        }
    }
    let last = ends(wall, wall.courses - 1);
    if last.end - last.start <= GRID_SNAP {
        return Err(place.error(
            "courses",
            format!("the raked ends meet below course {}", wall.courses),
            "give fewer courses, more blocks or less rake",
        ));
    }
    wall.openings
        .iter()
        .enumerate()
        .map(|(i, opening)| hole(place.0.key("openings").index(i), wall, opening))
        .collect()
}

/// An opening in block lengths and courses.
fn hole(path: JsonPath, wall: &Wall, opening: &Opening) -> Result<Hole, InputError> {
    let place = TemplatePath(path);
    place.finite("x", opening.x)?;
    place.length("width", opening.width)?;
    place.length("height", opening.height)?;
    let [length, _, height] = wall.size;
    let course = |field: &str, z: f64| {
        let courses = (z / height).round();
        if courses >= 0.0 && (z / height - courses).abs() <= GRID_SNAP * courses.max(1.0) {
            return Ok(courses as usize);
        }
        let near = (z / height).max(0.0).floor() * height;
        Err(place.error(
            field,
            format!("must be a multiple of the course height {height}, got {z}"),
            format!("openings begin and end with a course; use {near} or {}", near + height),
        ))
    };
    let sill = course("z", opening.z)?;
    let head = sill.saturating_add(course("height", opening.height)?);
    let x = snap(opening.x / length)..snap((opening.x + opening.width) / length);
    if sill >= wall.courses || x.end <= 0.0 || x.start >= wall.blocks as f64 {
        return Err(InputError::at(place.0, "lies outside the wall").hint(format!(
            "x from 0 to {}, z from 0 to {}",
            wall.blocks as f64 * length,
            wall.courses as f64 * height
        )));
    }
    Ok(Hole { x, courses: sill..head })
}

/// Left and right end of a course.
fn ends(wall: &Wall, course: usize) -> Range<f64> {
    snap(wall.rake_left * course as f64)..snap(wall.blocks as f64 - wall.rake_right * course as f64)
}

/// Whether the joints of a course lie in the middle of the blocks of the grid.
fn moved(wall: &Wall, course: usize) -> bool {
    (course % 2 == 1) == (wall.first == WallEnd::Whole)
}

/// To the nearest half block, if it is that up to rounding.
fn snap(x: f64) -> f64 {
    let nearest = (2.0 * x).round() / 2.0;
    if (x - nearest).abs() <= GRID_SNAP * x.abs().max(1.0) { nearest } else { x }
}

/// The blocks of a course between its ends, in block lengths, without what lies in the holes; its
/// joints `moved` by half a block.
pub(super) fn cut(ends: &Range<f64>, moved: bool, holes: &[&Range<f64>]) -> Vec<Range<f64>> {
    let offset = if moved { 0.5 } else { 0.0 };
    let grid = ((ends.start - offset).floor() as i64..=(ends.end - offset).ceil() as i64)
        .map(|k| k as f64 + offset);
    let mut marks: Vec<f64> = grid
        .chain(holes.iter().flat_map(|h| [h.start, h.end]))
        .filter(|x| *x > ends.start && *x < ends.end)
        .collect();
    marks.extend([ends.start, ends.end]);
    marks.sort_by(f64::total_cmp);
    marks.dedup_by(|b, a| *b - *a <= GRID_SNAP);
    let in_hole = |x: f64| holes.iter().any(|h| h.contains(&x));
    marks.windows(2).map(|m| m[0]..m[1]).filter(|x| !in_hole((x.start + x.end) / 2.0)).collect()
}
