//! Flat arches, stacks, columns, barrels.

use super::*;
use crate::template::{Barrel, FlatArch, Stack};

#[test]
fn flat_arch_joints_are_vertical_or_meet_in_the_centre() {
    let arch = FlatArch { span: 3.0, height: 1.0, depth: 1.0, voussoirs: 3, ..FlatArch::default() };
    let vertical = build(Template::FlatArch(arch.clone()));
    assert_corners(&vertical, "v00", &[[-1.5, 0.0], [-0.5, 0.0], [-0.5, 1.0], [-1.5, 1.0]]);
    assert_corners(&vertical, "abutment_right", &[[1.5, 0.0], [2.5, 0.0], [2.5, 1.0], [1.5, 1.0]]);
    // Centre 2 m below mid-height; the known coordinates have z = 0 at mid-height.
    let at = [0.0, 0.0, -0.5];
    let blocks = build(Template::FlatArch(FlatArch { center_depth: Some(2.0), at, ..arch }));
    assert_corners(&blocks, "v00", &[[-1.125, -0.5], [-0.375, -0.5], [-0.625, 0.5], [-1.875, 0.5]]);
    assert_corners(&blocks, "v01", &[[-0.375, -0.5], [0.375, -0.5], [0.625, 0.5], [-0.625, 0.5]]);
    assert_corners(&blocks, "v02", &[[0.375, -0.5], [1.125, -0.5], [1.875, 0.5], [0.625, 0.5]]);
    assert_mirrored(&blocks);
}

#[test]
fn stacks_lean_or_overhang_harmonically() {
    let stack = Stack { size: [1.0, 1.0, 0.2], ..Stack::default() };
    let leaning =
        build(Template::Stack(Stack { blocks: 10, shift: Some(0.0999999), ..stack.clone() }));
    assert_corners(
        &leaning,
        "b01",
        &[[0.0999999, 0.2], [1.0999999, 0.2], [1.0999999, 0.4], [0.0999999, 0.4]],
    );
    assert_corners(
        &leaning,
        "b09",
        &[[0.899_999_1, 1.8], [1.899_999_1, 1.8], [1.899_999_1, 2.0], [0.899_999_1, 2.0]],
    );
    let harmonic = build(Template::Stack(Stack { blocks: 4, harmonic: Some(0.999999), ..stack }));
    assert_corners(&harmonic, "base", &[[-2.0, -0.2], [0.0, -0.2], [0.0, 0.0], [-2.0, 0.0]]);
    assert_corners(
        &harmonic,
        "b00",
        &[[-0.875_000_125, 0.0], [0.124_999_875, 0.0], [0.124_999_875, 0.2], [-0.875_000_125, 0.2]],
    );
    assert_corners(
        &harmonic,
        "b03",
        &[[0.041_665_625, 0.6], [1.041_665_625, 0.6], [1.041_665_625, 0.8], [0.041_665_625, 0.8]],
    );
}

#[test]
fn barrel_strips_are_an_arch_moved_by_half_a_block() {
    let barrel = Barrel {
        radius: Some(3.0),
        thickness: 0.45,
        depth: 6.0,
        voussoirs: 15,
        courses: 6,
        ..Barrel::default()
    };
    let blocks = build(Template::Barrel(barrel));
    let arch = build(Template::Arch(circular(3.0, 0.45, 15)));
    assert_eq!(blocks.len(), 8 * 6 + 7 * 7 + 2);
    assert_eq!(outline(find(&blocks, "v03_02")), outline(find(&arch, "v03")));
    let ends = |id: &str| match &find(&blocks, id).shape {
        Shape::Prism { depth, .. } => {
            (find(&blocks, id).at[1] - depth / 2.0, find(&blocks, id).at[1] + depth / 2.0)
        }
        _ => panic!("a barrel is made of prisms"),
    };
    assert_eq!([ends("v00_00"), ends("v00_05")], [(-3.0, -2.0), (2.0, 3.0)]);
    assert_eq!(
        [ends("v01_00"), ends("v01_01"), ends("v01_06")],
        [(-3.0, -2.5), (-2.5, -1.5), (2.5, 3.0)]
    );
    assert_eq!(ends("springer_left"), (-3.0, 3.0));
}

#[test]
fn column_blocks_touch_from_the_base_up() {
    let blocks = build(parse(serde_json::json!({"column": {"blocks": 8, "size": [1, 1, 0.5]}})));
    assert_eq!(blocks.len(), 9);
    assert!(blocks[0].support);
    assert_corners(&blocks, "base", &[[-1.0, -0.5], [1.0, -0.5], [1.0, 0.0], [-1.0, 0.0]]);
    assert_corners(&blocks, "b07", &[[-0.5, 3.5], [0.5, 3.5], [0.5, 4.0], [-0.5, 4.0]]);
}
