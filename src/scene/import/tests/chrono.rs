//! Brick files of Chrono's masonry simulator.

use super::*;

/// Corners of a box, in no order that would help.
fn corners(low: [f64; 3], high: [f64; 3]) -> String {
    let pick = |k: usize, bit: usize| if k >> bit & 1 == 1 { high[bit] } else { low[bit] };
    let all = [3, 0, 6, 5, 2, 7, 4, 1];
    let words = all.map(|k| format!("{},{},{}", pick(k, 0), pick(k, 1), pick(k, 2)));
    words.join(", ")
}

#[test]
fn rows_are_hulls_with_y_up() {
    let ground =
        format!("0,1,1,1, 2000, 0,0,0, 0,0,0, {}", corners([-1.0, -1.0, -1.0], [1.0, 0.0, 1.0]));
    let ell = format!(
        "1,0,1,1, 1800, 5,-7,0, 0,0,0, {}, 9999, {}",
        corners([0.0, 0.0, 0.0], [0.5, 0.5, 0.5]),
        corners([0.5, 0.0, 0.0], [1.0, 0.2, 0.5])
    );
    for name in ["wall.txt", "wall"] {
        let imported = good(name, format!("{ground}\n{ell}\n"));
        let scene = &imported.scene;
        assert_eq!(ids(&imported), ["b0", "b1"]);
        assert!(scene.blocks[0].support && !scene.blocks[1].support);
        assert_eq!(scene.blocks[1].density, Some(1800.0));
        let (vertices, faces) = mesh(&scene.blocks[1]);
        let top = vertices.iter().map(|v| v[2]).fold(f64::NEG_INFINITY, f64::max);
        assert!(
            (top - 0.5).abs() < 1e-6 && vertices.len() == 16 && faces.len() >= 12,
            "{vertices:?}"
        );
        // Down in the file is down in the scene.
        assert_eq!(scene.loads.dead[0].force, Some([5.0, 0.0, -7.0]));
        assert!(imported.findings.iter().any(|f| f.text.contains("several hulls")));
    }
}

#[test]
fn rows_without_a_density_are_told_and_faults_refused() {
    let old = format!("0,0,1,1, 0,0,0, 0,0,0, {}", corners([0.0; 3], [1.0; 3]));
    let imported = good("w.txt", &old);
    assert!(imported.findings.iter().any(|f| f.text.contains("without a density")));
    let row = |tail: &str| format!("{old}\n1,0,1,1, {tail}");
    for (text, why) in [
        (row("0,0,0, 0,0,0, 1,2,3,4"), "no corners"),
        (row(&format!("-5, 0,0,0, 0,0,0, {}", corners([0.0; 3], [1.0; 3]))), "must be > 0"),
        (row(&format!("5, 0,0,0, 0,0,0, {}", corners([0.0; 3], [1.0, 1.0, 0.0]))), "in a plane"),
        (row("5, 0,0,x"), "got \"x\""),
    ] {
        let error = import("w.txt", &text).expect_err(why);
        assert!(error.to_string().contains(why), "{why}: {error}");
        assert_eq!(error.position.map(|p| p.0), Some(2), "{error}");
    }
}
