//! Stiff and extreme scenes with closed forms: no answer is wrong, next to none is missing.

use voussoir::{
    report::study as report,
    study::{
        self, StudyMethod,
        extreme::{CellGrade, CellQuestion, count, grid, run},
        known,
    },
};

#[test]
fn the_extreme_grid() {
    let cells = grid();
    assert!(cells.len() >= 500, "{} cells", cells.len());
    let found = run(&cells, None, |_| {}).unwrap();
    for f in found.iter().filter(|f| f.grade != CellGrade::Right) {
        println!(
            "{:?}: {} {}: {:?}, value {:?}, bracket {:?}",
            f.grade, f.family, f.what, f.ask, f.value, f.bracket
        );
    }
    for family in [None, Some("column"), Some("wall"), Some("arch")] {
        println!("{}: {:?}", family.unwrap_or("all"), count(&found, family));
    }
    let all = count(&found, None);
    assert_eq!(all.wrong, 0);
    assert!(all.undecided * 50 < all.cells, "{} of {} undecided", all.undecided, all.cells);
    assert!(
        all.narrow * 100 >= 98 * all.load_factors,
        "{} of {} brackets within 1e-6",
        all.narrow,
        all.load_factors
    );
    assert!(cells.iter().any(|c| matches!(c.ask, CellQuestion::Stands(_, d) if d <= 1e-6)));
}

#[test]
fn naive_scaling_is_solved_and_wrong() {
    let scenes: Vec<_> =
        known().into_iter().filter(|k| ["groove", "tiny"].contains(&k.name)).collect();
    let points = study::run(&scenes, true, 1, |_| {}).unwrap();
    assert_eq!(points.len(), study::count(&scenes, true).unwrap());
    let best = |scene: &str, method: StudyMethod| {
        points
            .iter()
            .filter(|p| p.scene == scene && p.method == method)
            .filter_map(|p| p.error)
            .fold(f64::INFINITY, f64::min)
    };
    for scene in ["groove", "tiny"] {
        assert!(
            best(scene, StudyMethod::Ladder) < 1e-6 && best(scene, StudyMethod::Forces) < 1e-6,
            "{scene}"
        );
        assert!(
            best(scene, StudyMethod::Bisection) < 1e-2
                && best(scene, StudyMethod::DryFriction) < 1e-5,
            "{scene}"
        );
        assert!(
            points.iter().any(|p| p.scene == scene
                && p.method == StudyMethod::Unscaled
                && p.is_silently_wrong()),
            "{scene}"
        );
    }
    // Pyramids inside the cones give less, around them more, both better with more facets.
    let pyramid = |method: StudyMethod| -> Vec<f64> {
        points
            .iter()
            .filter(|p| p.scene == "groove" && p.method == method)
            .filter_map(|p| p.value)
            .collect()
    };
    let (inside, around) =
        (pyramid(StudyMethod::PyramidInside), pyramid(StudyMethod::PyramidAround));
    assert!(
        inside.iter().all(|v| *v <= scenes[0].truth)
            && around.iter().all(|v| *v >= scenes[0].truth),
        "{inside:?} {around:?}"
    );
    assert!(inside.is_sorted() && around.iter().rev().is_sorted(), "{inside:?} {around:?}");
    // The profile never falls, and the ladder answers every scene.
    for (method, shares) in study::profile(&points, 1e-6, &[1.0, 10.0, 1e9]) {
        assert!(shares.is_sorted(), "{method:?}: {shares:?}");
        assert!(method != StudyMethod::Ladder || shares[2] == 1.0);
    }
    let charts = [report::errors("groove", &points), report::profiles(&points)];
    let svg = voussoir::report::chart::file("groove", &charts).unwrap();
    assert!(svg.starts_with("<svg") && svg.ends_with("</svg>"));
    assert_eq!(report::csv(&points).unwrap().lines().count(), points.len() + 1);
}

#[test]
fn omissions_change_no_answer() {
    let scenes: Vec<_> = known()
        .into_iter()
        .filter(|k| ["arch", "wall", "openings", "groove", "tiny"].contains(&k.name))
        .collect();
    let list = study::omissions(&scenes, 1, || {}).unwrap();
    for o in &list {
        assert!(o.difference().is_some_and(|d| d <= 2e-6), "{o:?}");
        assert!(o.unknowns[0] <= o.unknowns[1], "{o:?}");
    }
    assert!(list.iter().any(|o| !o.left_out.is_empty() && o.unknowns[0] < o.unknowns[1]));
}
