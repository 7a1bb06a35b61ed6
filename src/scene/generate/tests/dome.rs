//! Domes: closed, plane, convex, fitting, and as large as the shell they stand for.

use super::*;
use crate::template::Dome;
use std::collections::HashMap;

/// Volume by the divergence theorem, and the largest distance of a corner from the plane of its
/// face.
fn solid(block: &BlockSpec) -> (f64, f64) {
    use nalgebra::Vector3;
    let Shape::Polyhedron { vertices, faces } = &block.shape else {
        panic!("{} is no polyhedron", block.id)
    };
    let v: Vec<_> = vertices.iter().map(|p| Vector3::from(*p)).collect();
    let mut edges: HashMap<(usize, usize), i32> = HashMap::new();
    let (mut volume, mut warp) = (0.0, 0.0_f64);
    for face in faces {
        let o = v[face[0]];
        let normal =
            face.windows(2).map(|e| (v[e[0]] - o).cross(&(v[e[1]] - o))).sum::<Vector3<f64>>();
        volume += o.dot(&normal) / 6.0;
        warp = face.iter().map(|&i| (v[i] - o).dot(&normal.normalize()).abs()).fold(warp, f64::max);
        for i in 0..face.len() {
            let (a, b) = (face[i], face[(i + 1) % face.len()]);
            *edges.entry((a.min(b), a.max(b))).or_default() += if a < b { 1 } else { -1 };
        }
        // Convex and turned outwards: every corner lies behind every face.
        assert!(
            v.iter().all(|p| (p - o).dot(&normal.normalize()) < 1e-12),
            "{} is not convex",
            block.id
        );
    }
    assert!(edges.values().all(|n| *n == 0), "{} is open", block.id);
    (volume, warp)
}

#[test]
fn dome_blocks_are_closed_plane_and_convex() {
    let dome = Dome { radius: 5.0, thickness: 0.5, rings: 8, segments: 24, ..Dome::default() };
    for dome in [
        dome.clone(),
        Dome { oculus_deg: Some(20.0), ..dome.clone() },
        Dome { springing_deg: Some(60.0), segments: 3, rings: 1, ..dome.clone() },
        Dome { springing_deg: Some(130.0), segments: 7, ..dome },
    ] {
        let blocks = build(Template::Dome(dome.clone()));
        assert_eq!(
            blocks.len(),
            (dome.rings + 1) * dome.segments + usize::from(dome.oculus_deg.is_none())
        );
        for block in &blocks {
            let (volume, warp) = solid(block);
            assert!(volume > 0.0 && warp < 1e-13, "{}: volume {volume}, warp {warp}", block.id);
        }
    }
}

#[test]
fn dome_volume_tends_to_that_of_the_shell() {
    let volume = |n: usize| -> f64 {
        let dome =
            Dome { radius: 1.0, thickness: 0.2, rings: n, segments: 4 * n, ..Dome::default() };
        build(Template::Dome(dome)).iter().filter(|b| !b.support).map(|b| solid(b).0).sum()
    };
    let shell = 2.0 / 3.0 * std::f64::consts::PI * (1.1_f64.powi(3) - 0.9_f64.powi(3));
    let (coarse, fine) = (shell - volume(16), shell - volume(32));
    assert!(coarse > 0.0 && fine < 0.01 * shell);
    // Inscribed polyhedra converge with the square of the mesh width.
    assert!((3.5..4.5).contains(&(coarse / fine)), "{}", coarse / fine);
}

#[test]
fn neighbouring_dome_blocks_share_their_corners_to_the_last_bit() {
    let blocks = build(Template::Dome(Dome {
        radius: 5.0,
        thickness: 0.5,
        rings: 3,
        segments: 12,
        ..Dome::default()
    }));
    let corners = |id: &str| -> HashSet<[u64; 3]> {
        let Shape::Polyhedron { vertices, .. } = &find(&blocks, id).shape else {
            panic!("domes are polyhedra")
        };
        vertices.iter().map(|p| p.map(|c| (c + 0.0).to_bits())).collect()
    };
    for (a, b, shared) in [
        ("r00_00", "r00_01", 4),
        ("r00_11", "r00_00", 4),
        ("r00_05", "r01_05", 4),
        ("r02_07", "keystone", 4),
        ("springer_03", "r00_03", 4),
    ] {
        assert_eq!(corners(a).intersection(&corners(b)).count(), shared, "{a} and {b}");
    }
}
