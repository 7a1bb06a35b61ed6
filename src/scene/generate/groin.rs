//! The groin vault: strips of two barrels, cut off upright below the diagonals of the bay.
//!
//! Of the barrel along y the vault keeps what lies over |y| > |x|. A strip between two joints at x is
//! a prism along y from the diagonal plane to the side of the bay; it has eight corners, and six
//! plane faces because bed joints, intrados and extrados all contain the direction of y. The strip
//! of the next web is its mirror image in the diagonal plane, so that both share their joint there
//! to the last bit.

use super::{
    arch::radial_section,
    check::TemplatePath,
    midline::{Fields, Xz},
    numbered, support,
};
use crate::{BlockSpec, Shape, template::Groin};
use base::{error::InputError, tolerance::GRID_SNAP};

/// The webs: the side that they open to, and how a web along +y is turned there.
const WEBS: [(&str, [[f64; 2]; 2]); 4] = [
    ("n", [[1.0, 0.0], [0.0, 1.0]]),
    ("e", [[0.0, 1.0], [-1.0, 0.0]]),
    ("s", [[-1.0, 0.0], [0.0, -1.0]]),
    ("w", [[0.0, -1.0], [1.0, 0.0]]),
];

pub fn blocks(groin: &Groin) -> Result<Vec<BlockSpec>, InputError> {
    let place = TemplatePath::template("groin");
    place.length("thickness", groin.thickness)?;
    place.length("side", groin.side)?;
    place.total("voussoirs", &[4, groin.voussoirs])?;
    let fields =
        Fields::of_intrados_alone(groin.profile, [groin.clear_span, groin.rise], groin.thickness);
    let section = radial_section(&place, &fields, groin.voussoirs)?;
    if !groin.voussoirs.is_multiple_of(2) {
        return Err(place.error(
            "voussoirs",
            format!(
                "must be even, for the diagonals meet in a joint at the crown, got {}",
                groin.voussoirs
            ),
            format!("{} or {}", groin.voussoirs - 1, groin.voussoirs + 1),
        ));
    }
    let [inner, outer] = section.springing;
    if (inner[1] - outer[1]).abs() > GRID_SNAP * groin.thickness {
        return Err(place.error(
            "rise",
            "a groin vault needs level springing joints",
            "a circular one rises half its span; lower ones are elliptical or three_centred",
        ));
    }
    let half = 0.5 * groin.side;
    if half < outer[0] {
        return Err(place.error(
            "side",
            format!(
                "must be at least the clear span and twice the thickness = {}, got {}",
                2.0 * outer[0],
                groin.side
            ),
            "the side of the bay, outer face to outer face, in m",
        ));
    }
    let n = groin.voussoirs;
    let mut blocks = Vec::new();
    for (web, turn) in WEBS {
        for (i, polygon) in section.voussoirs.iter().enumerate() {
            let shape = strip(polygon, half, turn);
            blocks.push(BlockSpec::new(format!("{web}_{}", numbered("v", i, n)), shape));
        }
    }
    let (size, height) = (half - inner[0], groin.thickness);
    let middle = 0.5 * (half + inner[0]);
    let corners =
        [("ne", [1.0, 1.0]), ("nw", [-1.0, 1.0]), ("se", [1.0, -1.0]), ("sw", [-1.0, -1.0])];
    for (corner, [x, y]) in corners {
        let shape = Shape::Cuboid { size: [size, size, height] };
        let at = [x * middle, y * middle, inner[1] - 0.5 * height];
        blocks.push(BlockSpec { at, ..support(format!("springer_{corner}"), shape) });
    }
    Ok(blocks)
}

/// A strip with the section a, b (intrados), c, d (extrados) from the diagonals to y = `end`, turned.
fn strip(polygon: &[Xz], end: f64, turn: [[f64; 2]; 2]) -> Shape {
    let corner = |p: &Xz, y: f64| {
        let [[a, b], [c, d]] = turn;
        [a * p[0] + b * y + 0.0, c * p[0] + d * y + 0.0, p[1]]
    };
    let near = polygon.iter().map(|p| corner(p, p[0].abs()));
    let vertices = near.chain(polygon.iter().map(|p| corner(p, end))).collect();
    // Seen from −y the section runs counter-clockwise: x to the right, z up.
    let faces = vec![
        vec![0, 1, 2, 3],
        vec![7, 6, 5, 4],
        vec![0, 4, 5, 1],
        vec![1, 5, 6, 2],
        vec![2, 6, 7, 3],
        vec![3, 7, 4, 0],
    ];
    Shape::Polyhedron { vertices, faces }
}
