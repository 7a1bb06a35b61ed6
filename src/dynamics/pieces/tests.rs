//! Pieces fill the block, no more and no less.

use super::*;

fn prism(polygon: &[[f64; 2]], depth: f64) -> Polyhedron {
    let n = polygon.len();
    let vertices = [0.0, depth]
        .iter()
        .flat_map(|z| polygon.iter().map(|p| Vector3::new(p[0], p[1], *z)))
        .collect();
    let mut faces: Vec<Vec<usize>> =
        (0..n).map(|i| vec![i, (i + 1) % n, n + (i + 1) % n, n + i]).collect();
    faces.push((0..n).rev().collect());
    faces.push((n..2 * n).collect());
    Polyhedron::from_faces(vertices, &faces).expect("a prism").0
}

fn volume(cell: &Cell) -> f64 {
    let middle = cell.middle();
    let cone = |f: &Face| {
        f.points[1..]
            .windows(2)
            .map(|p| {
                (p[0] - f.points[0]).cross(&(p[1] - f.points[0])).dot(&(f.points[0] - middle)) / 6.0
            })
            .sum::<f64>()
    };
    cell.faces.iter().map(cone).sum()
}

fn ring(corners: usize) -> Vec<[f64; 2]> {
    (0..corners)
        .map(|i| (std::f64::consts::TAU * i as f64 / corners as f64).sin_cos())
        .map(|(s, c)| [c, s])
        .collect()
}

#[track_caller]
fn filled(shape: &Polyhedron, most: usize) -> Vec<Cell> {
    let cells = pieces(shape, Vector3::new(0.3, -0.2, 0.1), 2.0).expect("pieces");
    let total: f64 = cells.iter().map(volume).sum();
    let want = shape.mass_properties().volume / 8.0;
    assert!((total - want).abs() < 1e-12 * want, "{total} for {want}");
    assert!(cells.len() <= most, "{} pieces", cells.len());
    assert!(cells.iter().all(|c| volume(c) > 0.0));
    assert!(cells.iter().flat_map(|c| &c.faces).all(|f| f.inner || f.points.len() <= CORNERS));
    cells
}

#[test]
fn a_box_is_one_piece_and_known_as_a_box() {
    let shape = prism(&[[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]], 0.5);
    let cells = filled(&shape, 1);
    let (half, turn, middle) = as_box(&cells[0]).expect("a box");
    let mut sides = [half.x, half.y, half.z];
    sides.sort_by(f64::total_cmp);
    for (side, want) in sides.into_iter().zip([0.125, 0.25, 0.5]) {
        assert!((side - want).abs() < 1e-14, "{side} {want}");
    }
    assert!((middle - Vector3::new(0.35, 0.35, 0.075)).norm() < 1e-14, "{middle}");
    assert!((turn * half).amax() <= 0.5 + 1e-14);
    assert!(
        as_box(&filled(&prism(&[[0.0, 0.0], [2.0, 0.0], [2.5, 1.0], [0.0, 1.0]], 0.5), 1)[0])
            .is_none()
    );
}

#[test]
fn a_drum_is_cut_into_four_cornered_pieces() {
    filled(&prism(&ring(12), 0.7), 5);
    filled(&prism(&ring(6), 0.7), 2);
    filled(&prism(&ring(60), 0.7), 120);
}

#[test]
fn blocks_that_are_not_convex_are_filled_exactly() {
    let l = [[0.0, 0.0], [3.0, 0.0], [3.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]];
    let u = [
        [0.0, 0.0],
        [3.0, 0.0],
        [3.0, 2.0],
        [2.0, 2.0],
        [2.0, 1.0],
        [1.0, 1.0],
        [1.0, 2.0],
        [0.0, 2.0],
    ];
    let star: Vec<[f64; 2]> = ring(10)
        .iter()
        .enumerate()
        .map(|(i, p)| if i % 2 == 0 { *p } else { [0.4 * p[0], 0.4 * p[1]] })
        .collect();
    for (polygon, most) in [(&l[..], 2), (&u[..], 3), (&star[..], 30)] {
        let cells = filled(&prism(polygon, 1.0), most);
        assert!(cells.iter().flat_map(|c| &c.faces).any(|f| f.inner));
    }
}

#[test]
fn erosion_moves_every_face_by_its_depth() {
    let cells = filled(&prism(&ring(5), 1.0), 2);
    for cell in cells {
        let (corners, loops) = cell.eroded(1e-3);
        for (face, corner_loop) in cell.faces.iter().zip(loops) {
            for c in corner_loop {
                let depth = face.normal.dot(&(face.points[0] - corners[c]));
                assert!((depth - 1e-3).abs() < 1e-12, "{depth}");
            }
        }
    }
}
