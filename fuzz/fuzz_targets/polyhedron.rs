//! Corners and faces → weld, split, orient, weigh, join, test for overlap.
#![no_main]
use arbitrary::Arbitrary;
use libfuzzer_sys::fuzz_target;
use nalgebra::Vector3;
use voussoir::assembly::Polyhedron;

/// A coordinate: on a coarse grid mostly, so that corners coincide and faces are plane, with a
/// nudge of some power of ten.
#[derive(Arbitrary, Debug)]
struct Coordinate {
    place: i8,
    nudge: u8,
}

impl Coordinate {
    fn value(&self) -> f64 {
        let grid = f64::from(self.place % 5);
        match self.nudge {
            0..=199 => grid,
            n => grid + 10f64.powi(-i32::from(n - 198) / 3),
        }
    }
}

#[derive(Arbitrary, Debug)]
struct Input {
    corners: Vec<[Coordinate; 3]>,
    faces: Vec<Vec<u8>>,
    scale: i8,
}

fuzz_target!(|input: Input| {
    if input.corners.len() > 64 || input.faces.iter().map(Vec::len).sum::<usize>() > 256 {
        return;
    }
    let scale = 10f64.powi(i32::from(input.scale) / 8);
    let corners: Vec<Vector3<f64>> = input
        .corners
        .iter()
        .map(|c| Vector3::new(c[0].value(), c[1].value(), c[2].value()) * scale)
        .collect();
    let faces: Vec<Vec<usize>> =
        input.faces.iter().map(|f| f.iter().map(|&i| usize::from(i)).collect()).collect();
    match Polyhedron::from_faces(corners, &faces) {
        Err(e) => assert!(!e.to_string().is_empty() && !e.hint().is_empty()),
        Ok((solid, mends)) => {
            let mass = solid.mass_properties();
            assert!(mass.volume > 0.0 && mass.volume.is_finite(), "{mass:?}");
            assert!(mass.centroid.iter().chain(&mass.inertia).all(|x| x.is_finite()), "{mass:?}");
            let (mut low, mut high) = (solid.vertices[0], solid.vertices[0]);
            for v in &solid.vertices {
                (low, high) = (low.inf(v), high.sup(v));
            }
            let size = (high - low).norm();
            assert!(
                mass.volume <= (high - low).product() * (1.0 + 1e-6),
                "more volume than its box: {mass:?}"
            );
            assert!(
                (0..3).all(|k| mass.centroid[k] >= low[k] - 1e-6 * size
                    && mass.centroid[k] <= high[k] + 1e-6 * size),
                "{mass:?}"
            );
            for facet in &solid.facets {
                assert!(
                    (facet.normal.norm() - 1.0).abs() < 1e-9
                        && facet.area > 0.0
                        && facet.area.is_finite()
                );
                assert!(facet.pieces.iter().all(
                    |p| p.len() >= 3 && p.iter().all(|&i| (i as usize) < solid.vertices.len())
                ));
            }
            // An orientable closed surface has no area in sum.
            let sum: Vector3<f64> = solid.facets.iter().map(|f| f.normal * f.area).sum();
            let area: f64 = solid.facets.iter().map(|f| f.area).sum();
            assert!(sum.norm() <= 1e-3 * area, "the facets do not close: {} of {area}", sum.norm());
            mends.iter().for_each(|m| assert!(!m.finding("b").text.is_empty()));
        }
    }
});
