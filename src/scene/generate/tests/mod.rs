//! Geometry against known coordinates, and refusals.

mod arch;
mod dome;
mod refusals;
mod stacked;
mod structures;
mod wall;

use super::*;
use crate::template::{Arch, JointDirection, Opening, Profile, ThicknessAlong, Wall, WallEnd};
use proptest::prelude::*;
use std::collections::HashSet;

fn build(template: Template) -> Vec<BlockSpec> {
    expand(&template).expect("a valid template")
}

fn parse(json: serde_json::Value) -> Template {
    serde_json::from_value(json).expect("a template")
}

fn find<'a>(blocks: &'a [BlockSpec], id: &str) -> &'a BlockSpec {
    blocks.iter().find(|b| b.id == id).unwrap_or_else(|| panic!("no block {id}"))
}

/// The corners of a block in the x–z plane.
fn outline(block: &BlockSpec) -> Vec<[f64; 2]> {
    let [x, _, z] = block.at;
    match &block.shape {
        Shape::Prism { polygon, .. } => polygon.iter().map(|p| [p[0] + x, p[1] + z]).collect(),
        Shape::Cuboid { size: [a, _, c] } => [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]
            .map(|[i, k]| [x + i * a / 2.0, z + k * c / 2.0])
            .into(),
        other => panic!("{other:?} is no prism"),
    }
}

/// Twice the signed area of a polygon; positive counter-clockwise.
fn area2(p: &[[f64; 2]]) -> f64 {
    (0..p.len()).map(|i| (p[i], p[(i + 1) % p.len()])).map(|(a, b)| a[0] * b[1] - a[1] * b[0]).sum()
}

fn same_corners(block: &BlockSpec, expected: &[[f64; 2]]) -> bool {
    let outline = outline(block);
    let near = |a: &[f64; 2], b: &[f64; 2]| {
        (a[0] - b[0]).abs().max((a[1] - b[1]).abs()) <= 1e-12 * (1.0 + b[0].abs().max(b[1].abs()))
    };
    outline.len() == expected.len() && expected.iter().all(|e| outline.iter().any(|p| near(p, e)))
}

#[track_caller]
fn assert_corners(blocks: &[BlockSpec], id: &str, expected: &[[f64; 2]]) {
    let block = find(blocks, id);
    assert!(same_corners(block, expected), "{id}: {:?}\nexpected {expected:?}", outline(block));
}

/// Every block has its mirror image in x = 0, to the last bit.
#[track_caller]
fn assert_mirrored(blocks: &[BlockSpec]) {
    // Adding 0.0 makes -0.0 and 0.0 the same bits.
    let key = |p: &[f64; 2], sign: f64| ((sign * p[0] + 0.0).to_bits(), (p[1] + 0.0).to_bits());
    let set = |b: &BlockSpec, sign: f64| {
        let mut corners: Vec<_> = outline(b).iter().map(|p| key(p, sign)).collect();
        corners.sort_unstable();
        (corners, b.support)
    };
    let all: HashSet<_> = blocks.iter().map(|b| set(b, 1.0)).collect();
    for block in blocks {
        assert!(all.contains(&set(block, -1.0)), "{} has no mirror image", block.id);
    }
}

fn circular(radius: f64, t: f64, voussoirs: usize) -> Arch {
    Arch { radius: Some(radius), thickness: t, depth: 1.0, voussoirs, ..Arch::default() }
}

#[test]
fn prefix_place_and_material_reach_every_block() {
    let json = serde_json::json!({"column": {"blocks": 2, "size": [1, 1, 1], "prefix": "north_", "at": [1, 2, 3], "material": "brick"}});
    let blocks = build(parse(json));
    assert!(
        blocks.iter().all(|b| b.id.starts_with("north_") && b.material.as_deref() == Some("brick"))
    );
    assert_eq!(blocks[1].at, [1.0, 2.0, 3.5]);
}

#[test]
fn ids_are_unique_and_polygons_run_counter_clockwise() {
    for template in examples() {
        let blocks = build(template);
        assert_eq!(blocks.iter().map(|b| &b.id).collect::<HashSet<_>>().len(), blocks.len());
        assert!(blocks.iter().any(|b| b.support) && blocks.iter().any(|b| !b.support));
        for block in &blocks {
            if let Shape::Prism { polygon, .. } = &block.shape {
                assert!(area2(polygon) > 0.0, "{}", block.id);
            }
        }
    }
}

#[test]
fn defaults_are_there_under_every_name_and_round_trip() {
    for name in template_names() {
        let json = default_template(name).expect("a default");
        let template = parse(json.clone());
        assert_eq!(template.name(), name);
        assert_eq!(serde_json::to_value(&template).expect("serialises"), json);
    }
    assert_eq!(default_template("pyramid"), None);
    // Setting a field to null takes it away.
    let mut json = default_template("arch").expect("a default");
    json["arch"]["radius"] = serde_json::Value::Null;
    assert_eq!(expand(&parse(json)).expect_err("no radius").path.to_string(), "arch.radius");
}

#[test]
fn the_documented_example_is_a_template() {
    let blocks = build(parse(
        serde_json::json!({ "arch": { "radius": 5, "thickness": 0.8, "depth": 1, "embrace_deg": 180, "voussoirs": 27 } }),
    ));
    assert_eq!(blocks.len(), 29);
}

proptest! {
    /// Whatever the numbers are, the answer is blocks with finite corners or an error, never a
    /// panic.
    #[test]
    fn any_numbers_give_blocks_or_an_error(
        radius in prop_oneof![-1.0..10.0, proptest::num::f64::ANY],
        thickness in prop_oneof![-1.0..3.0, proptest::num::f64::ANY],
        embrace in prop_oneof![Just(None), (-10.0..400.0).prop_map(Some), proptest::num::f64::ANY.prop_map(Some)],
        eccentricity in prop_oneof![Just(None), (-1.0..3.0).prop_map(Some)],
        rise in prop_oneof![Just(None), (-1.0..8.0).prop_map(Some), proptest::num::f64::ANY.prop_map(Some)],
        voussoirs in 0_usize..40,
        profile in prop_oneof![Just(Profile::Circular), Just(Profile::Pointed), Just(Profile::Elliptical), Just(Profile::Parabolic)],
        vertical: bool,
        along in prop_oneof![Just(None), Just(Some(ThicknessAlong::Normal)), Just(Some(ThicknessAlong::Vertical))],
    ) {
        let by_span = rise.is_some();
        let arch = Arch {
            profile,
            radius: (!by_span).then_some(radius),
            span: by_span.then_some(radius),
            rise,
            embrace_deg: embrace,
            eccentricity,
            thickness,
            depth: 1.0,
            voussoirs,
            joints: if vertical { JointDirection::Vertical } else { JointDirection::Radial },
            thickness_along: along,
            ..Arch::default()
        };
        match expand(&Template::Arch(arch)) {
            Ok(blocks) => {
                prop_assert_eq!(blocks.len(), voussoirs + 2);
                assert_mirrored(&blocks);
                for block in blocks {
                    prop_assert!(outline(&block).iter().flatten().all(|c| c.is_finite()));
                }
            }
            Err(error) => prop_assert!(error.path.to_string().starts_with("arch")),
        }
    }

    /// The courses of a wall cover it without gaps or overlaps, openings excepted.
    #[test]
    fn wall_blocks_cover_the_wall_outside_the_openings(
        blocks in 1_usize..8,
        courses in 1_usize..8,
        half: bool,
        x in 0.0..6.0_f64,
        width in 0.01..5.0_f64,
        sill in 0_usize..8,
        height in 1_usize..4,
    ) {
        let size = [0.7, 0.3, 0.2];
        let [l, d, h] = size;
        prop_assume!(sill < courses && x < blocks as f64);
        let opening = Opening { x: x * l, z: sill as f64 * h, width: width * l, height: height as f64 * h };
        let wall = Wall {
            size,
            blocks,
            courses,
            first: if half { WallEnd::Half } else { WallEnd::Whole },
            openings: vec![opening],
            ..Wall::default()
        };
        let volume: f64 = build(Template::Wall(wall)).iter().filter(|b| !b.support).map(|b| match b.shape {
            Shape::Cuboid { size } => size.iter().product(),
            _ => f64::NAN,
        }).sum();
        let open = (x + width).min(blocks as f64) - x;
        let expected = l * d * h * (blocks as f64 * courses as f64 - open * height.min(courses - sill) as f64);
        prop_assert!((volume - expected).abs() < 1e-9, "{} {}", volume, expected);
    }
}
