//! The tower: four walls a course, each passing one corner, the other way round in the next course.

use super::{check::TemplatePath, digits, support};
use crate::{BlockSpec, Shape, template::Tower};
use base::error::InputError;

pub fn blocks(tower: &Tower) -> Result<Vec<BlockSpec>, InputError> {
    let place = TemplatePath::template("tower");
    let [a, b] = tower.size;
    place.size("size", [a, b, 1.0])?;
    place.length("thickness", tower.thickness)?;
    place.length("course", tower.course)?;
    place.count("courses", tower.courses, 1)?;
    place.count("blocks", tower.blocks, 1)?;
    place.total("courses", &[4, tower.courses, tower.blocks])?;
    let t = tower.thickness;
    if 2.0 * t >= a.min(b) {
        return Err(place.error(
            "thickness",
            format!("must be less than half of the smaller side = {}, got {t}", 0.5 * a.min(b)),
            "the tower is hollow; use the template column for a solid one",
        ));
    }
    let (courses, pieces) = (digits(tower.courses), digits(tower.blocks));
    let mut blocks = Vec::new();
    for c in 0..tower.courses {
        // Which end of a wall is the one at which it passes the corner.
        let turn = if c % 2 == 0 { 0.5 } else { -0.5 };
        let z = tower.course * (c as f64 + 0.5);
        // Along x at y = ±, along y at x = ±; `way` turns the walls of a course round one way.
        let walls = [("n", true, 1.0), ("e", false, 1.0), ("s", true, -1.0), ("w", false, -1.0)];
        for (side, along_x, sign) in walls {
            let (length, across) = if along_x { (a, b) } else { (b, a) };
            let whole = length - t;
            let way = if along_x { -sign } else { sign };
            let off = 0.5 * (across - t) * sign;
            for k in 0..tower.blocks {
                let own = whole / tower.blocks as f64;
                let middle = way * turn * t + own * (k as f64 + 0.5) - 0.5 * whole;
                let (size, at) = if along_x {
                    ([own, t, tower.course], [middle, off, z])
                } else {
                    ([t, own, tower.course], [off, middle, z])
                };
                let id = format!("c{c:0courses$}_{side}_{k:0pieces$}");
                blocks.push(BlockSpec { at, ..BlockSpec::new(id, Shape::Cuboid { size }) });
            }
        }
    }
    let at = [0.0, 0.0, -0.5 * tower.course];
    let slab = Shape::Cuboid { size: [2.0 * a, 2.0 * b, tower.course] };
    blocks.push(BlockSpec { at, ..support("base", slab) });
    Ok(blocks)
}
