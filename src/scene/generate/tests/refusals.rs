//! Parameters without meaning: refused with place, value and remedy.

use super::*;

#[test]
fn what_has_no_meaning_is_refused_at_its_place() {
    use serde_json::json;
    let cases = [
        (
            json!({"arch": {"radius": 1, "thickness": 2, "depth": 1, "voussoirs": 9}}),
            "arch.thickness",
            "2 × radius",
        ),
        (
            json!({"arch": {"radius": 1, "thickness": 0, "depth": 1, "voussoirs": 9}}),
            "arch.thickness",
            "> 0",
        ),
        (
            json!({"arch": {"radius": -1, "thickness": 0.1, "depth": 1, "voussoirs": 9}}),
            "arch.radius",
            "got -1",
        ),
        (
            json!({"arch": {"radius": 1, "thickness": 0.1, "depth": -2, "voussoirs": 9}}),
            "arch.depth",
            "> 0",
        ),
        (
            json!({"arch": {"radius": 1, "thickness": 0.1, "depth": 1, "voussoirs": 0}}),
            "arch.voussoirs",
            "at least 2",
        ),
        (
            json!({"arch": {"radius": 1, "thickness": 0.1, "depth": 1, "voussoirs": 1}}),
            "arch.voussoirs",
            "at least 2",
        ),
        (
            json!({"arch": {"radius": 1, "thickness": 0.1, "depth": 1, "voussoirs": 1_000_001}}),
            "arch.voussoirs",
            "more than",
        ),
        (
            json!({"arch": {"radius": 1, "thickness": 0.1, "depth": 1, "voussoirs": 9, "embrace_deg": 360}}),
            "arch.embrace_deg",
            "360",
        ),
        (
            json!({"arch": {"radius": 1, "thickness": 0.1, "depth": 1, "voussoirs": 9, "embrace_deg": 0}}),
            "arch.embrace_deg",
            "got 0",
        ),
        (json!({"arch": {"thickness": 0.1, "depth": 1, "voussoirs": 9}}), "arch.radius", "missing"),
        (
            json!({"arch": {"radius": 1, "span": 2, "rise": 1, "thickness": 0.1, "depth": 1, "voussoirs": 9}}),
            "arch.radius",
            "cannot be combined",
        ),
        (
            json!({"arch": {"span": 2, "thickness": 0.1, "depth": 1, "voussoirs": 9}}),
            "arch.rise",
            "missing",
        ),
        (
            json!({"arch": {"span": 2, "rise": 1, "embrace_deg": 90, "thickness": 0.1, "depth": 1, "voussoirs": 9}}),
            "arch.embrace_deg",
            "leave",
        ),
        (
            json!({"arch": {"radius": 1, "eccentricity": 0.1, "thickness": 0.1, "depth": 1, "voussoirs": 9}}),
            "arch.eccentricity",
            "radius and embrace_deg",
        ),
        (
            json!({"arch": {"profile": "parabolic", "radius": 1, "thickness": 0.1, "depth": 1, "voussoirs": 9}}),
            "arch.radius",
            "no radius",
        ),
        (
            json!({"arch": {"profile": "elliptical", "span": 2, "rise": 1, "embrace_deg": 90, "thickness": 0.1, "depth": 1, "voussoirs": 9}}),
            "arch.embrace_deg",
            "span and rise",
        ),
        (
            json!({"arch": {"profile": "elliptical", "span": 2, "rise": 0.2, "thickness": 0.3, "depth": 1, "voussoirs": 40}}),
            "arch.thickness",
            "centre of curvature",
        ),
        (
            json!({"arch": {"profile": "pointed", "radius": 1, "thickness": 0.1, "depth": 1, "voussoirs": 8}}),
            "arch.eccentricity",
            "missing",
        ),
        (
            json!({"arch": {"profile": "pointed", "radius": 1, "eccentricity": 1, "thickness": 0.1, "depth": 1, "voussoirs": 8}}),
            "arch.eccentricity",
            "between",
        ),
        (
            json!({"arch": {"profile": "pointed", "radius": 1, "eccentricity": 0.3, "thickness": 0.1, "depth": 1, "voussoirs": 9}}),
            "arch.voussoirs",
            "8 or 10",
        ),
        (
            json!({"arch": {"profile": "pointed", "span": 4, "rise": 1, "thickness": 0.1, "depth": 1, "voussoirs": 8}}),
            "arch.rise",
            "half its span",
        ),
        (
            json!({"arch": {"profile": "pointed", "radius": 1, "eccentricity": 0.9, "thickness": 0.3, "depth": 1, "voussoirs": 8}}),
            "arch.thickness",
            "overlap",
        ),
        (
            json!({"arch": {"radius": 1, "embrace_deg": 200, "joints": "vertical", "thickness": 0.1, "depth": 1, "voussoirs": 9}}),
            "arch.joints",
            "180",
        ),
        (
            json!({"arch": {"radius": 1, "thickness_along": "vertical", "thickness": 0.1, "depth": 1, "voussoirs": 9}}),
            "arch.thickness_along",
            "normal",
        ),
        (
            json!({"arch": {"profile": "parabolic", "span": 2, "rise": 1, "joints": "vertical", "thickness_along": "normal", "thickness": 0.1, "depth": 1, "voussoirs": 9}}),
            "arch.thickness_along",
            "circular",
        ),
        (
            json!({"arch": {"radius": 1, "embrace_deg": 120, "thickness": 0.1, "depth": 1, "voussoirs": 9, "buttresses": {"width": 1, "height": 1}}}),
            "arch.buttresses",
            "horizontal",
        ),
        (
            json!({"arch": {"radius": 1, "thickness": 0.1, "depth": 1, "voussoirs": 9, "buttresses": {"width": 0, "height": 1}}}),
            "arch.buttresses.width",
            "> 0",
        ),
        (
            json!({"barrel": {"radius": 1, "thickness": 0.1, "depth": 1, "voussoirs": 9, "courses": 0}}),
            "barrel.courses",
            "at least 1",
        ),
        (
            json!({"barrel": {"radius": 1, "thickness": 0.1, "depth": 1, "voussoirs": 9000, "courses": 9000}}),
            "barrel.voussoirs",
            "9000 × 9001",
        ),
        (json!({"column": {"blocks": 0, "size": [1, 1, 1]}}), "column.blocks", "at least 1"),
        (json!({"column": {"blocks": 1, "size": [1, 0, 1]}}), "column.size[1]", "> 0"),
        (json!({"column": {"blocks": 1, "size": [1, 1, 1], "at": [1e308, 0, 0]}}), "", ""),
        (json!({"column": {"blocks": 10, "size": [1, 1, 1e308]}}), "column", "range of numbers"),
        (json!({"stack": {"blocks": 3, "size": [1, 1, 1]}}), "stack.shift", "missing"),
        (
            json!({"stack": {"blocks": 3, "size": [1, 1, 1], "shift": 0.1, "harmonic": 1}}),
            "stack.harmonic",
            "exclude",
        ),
        (
            json!({"dome": {"radius": 1, "thickness": 2.5, "rings": 3, "segments": 8}}),
            "dome.thickness",
            "2 × radius",
        ),
        (
            json!({"dome": {"radius": 1, "thickness": 0.1, "rings": 3, "segments": 2}}),
            "dome.segments",
            "at least 3",
        ),
        (
            json!({"dome": {"radius": 1, "thickness": 0.1, "rings": 3, "segments": 8, "oculus_deg": 90}}),
            "dome.oculus_deg",
            "springing",
        ),
        (
            json!({"dome": {"radius": 1, "thickness": 0.1, "rings": 3, "segments": 8, "springing_deg": 180}}),
            "dome.springing_deg",
            "180",
        ),
        (
            json!({"dome": {"radius": 1, "thickness": 0.1, "rings": 1_000_000_000, "segments": 1_000_000_000}}),
            "dome.segments",
            "more than",
        ),
        (
            json!({"flat_arch": {"span": 3, "height": 1, "depth": 1, "voussoirs": 3, "center_depth": 0.5}}),
            "flat_arch.center_depth",
            "height / 2",
        ),
        (
            json!({"wall": {"size": [1, 1, 1], "courses": 4, "blocks": 3, "rake_right": -0.5}}),
            "wall.rake_right",
            "≥ 0",
        ),
        (
            json!({"wall": {"size": [1, 1, 1], "courses": 7, "blocks": 3, "rake_right": 0.5}}),
            "wall.courses",
            "meet",
        ),
        (
            json!({"wall": {"size": [1, 1, 1], "courses": 4, "blocks": 3, "openings": [{"x": 1, "z": 0.5, "width": 1, "height": 1}]}}),
            "wall.openings[0].z",
            "use 0 or 1",
        ),
        (
            json!({"wall": {"size": [1, 1, 1], "courses": 4, "blocks": 3, "openings": [{"x": 9, "z": 1, "width": 1, "height": 1}]}}),
            "wall.openings[0]",
            "outside",
        ),
        (
            json!({"wall": {"size": [1, 1, 1], "courses": 4, "blocks": 3, "openings": [{"x": 1, "z": -1, "width": 1, "height": 1}]}}),
            "wall.openings[0].z",
            "got -1",
        ),
    ];
    for (json, path, part) in cases {
        let result = expand(&parse(json.clone()));
        if path.is_empty() {
            assert!(result.is_ok(), "{json}: {result:?}");
            continue;
        }
        let error = result.expect_err(&json.to_string());
        assert_eq!(error.path.to_string(), path, "{json}: {error}");
        assert!(error.to_string().contains(part), "{json}: {error}");
        assert!(error.hint.is_some(), "{json}: {error}");
    }
}

#[test]
fn unknown_fields_are_refused() {
    let result: Result<Template, _> = serde_json::from_value(
        serde_json::json!({"column": {"blocks": 1, "size": [1, 1, 1], "blokcs": 2}}),
    );
    assert!(result.expect_err("a typo").to_string().contains("blokcs"));
}
