//! Geometry against known coordinates, and refusals.

use super::*;
use crate::scene::template::{
    Arch, Barrel, Buttresses, Dome, FlatArch, JointDirection, Opening, Profile, Stack, ThicknessAlong, Wall, WallBase, WallEnd,
};
use proptest::prelude::*;
use std::collections::{HashMap, HashSet};

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
        Shape::Cuboid { size: [a, _, c] } => {
            [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(|[i, k]| [x + i * a / 2.0, z + k * c / 2.0]).into()
        }
        other => panic!("{other:?} is no prism"),
    }
}

/// Twice the signed area of a polygon; positive counter-clockwise.
fn area2(p: &[[f64; 2]]) -> f64 {
    (0..p.len()).map(|i| (p[i], p[(i + 1) % p.len()])).map(|(a, b)| a[0] * b[1] - a[1] * b[0]).sum()
}

fn same_corners(block: &BlockSpec, expected: &[[f64; 2]]) -> bool {
    let outline = outline(block);
    let near = |a: &[f64; 2], b: &[f64; 2]| (a[0] - b[0]).abs().max((a[1] - b[1]).abs()) <= 1e-12 * (1.0 + b[0].abs().max(b[1].abs()));
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
fn circular_arch_has_the_known_corners() {
    // Critical semicircle of 16 voussoirs, thickness just above 0.10707620314306167 R.
    let blocks = build(Template::Arch(circular(1.0, 0.107_076_310_219_264_81, 16)));
    assert_eq!(blocks.len(), 18);
    assert_corners(
        &blocks,
        "v15",
        &[
            [0.946_461_844_890_367_6, 0.0],
            [1.053_538_155_109_632_3, 0.0],
            [1.033_294_714_874_703, 0.205_535_097_936_615_84],
            [0.928_275_845_931_757_9, 0.184_645_546_095_640_63],
        ],
    );
    assert_corners(
        &blocks,
        "v00",
        &[
            [-0.928_275_845_931_757_9, 0.184_645_546_095_640_96],
            [-1.033_294_714_874_703, 0.205_535_097_936_616_23],
            [-1.053_538_155_109_632_3, 0.0],
            [-0.946_461_844_890_367_6, 0.0],
        ],
    );
    assert_corners(
        &blocks,
        "springer_right",
        &[
            [0.928_275_845_931_757_9, -0.184_645_546_095_640_63],
            [1.033_294_714_874_703, -0.205_535_097_936_615_84],
            [1.053_538_155_109_632_3, 0.0],
            [0.946_461_844_890_367_6, 0.0],
        ],
    );
    assert!(find(&blocks, "springer_left").support && !find(&blocks, "v00").support);
    assert_mirrored(&blocks);
    // All four corners at the springing lie on z = 0 exactly.
    assert_eq!(outline(find(&blocks, "v15")).iter().filter(|p| p[1] == 0.0).count(), 2);
}

#[test]
fn segmental_arch_has_the_known_corners_and_may_be_given_by_span_and_rise() {
    // Oppenheim's arch: R 10, t 1.5, 7 voussoirs over 157.5°.
    let by_radius = build(Template::Arch(Arch { embrace_deg: Some(157.5), ..circular(10.0, 1.5, 7) }));
    assert_corners(
        &by_radius,
        "v06",
        &[
            [9.072_263_843_729_882, 1.804_585_478_649_186_4],
            [10.543_441_764_334_727, 2.097_220_961_673_379],
            [8.938_298_332_252_362, 5.972_380_004_960_724],
            [7.691_093_913_798_543, 5.139_024_655_431_32],
        ],
    );
    assert_corners(
        &by_radius,
        "springer_right",
        &[
            [9.072_263_843_729_882, -1.804_585_478_649_186_4],
            [10.543_441_764_334_727, -2.097_220_961_673_379],
            [10.543_441_764_334_727, 2.097_220_961_673_379],
            [9.072_263_843_729_882, 1.804_585_478_649_186_4],
        ],
    );
    assert_mirrored(&by_radius);
    let half = 78.75_f64.to_radians();
    let by_span = build(Template::Arch(Arch {
        radius: None,
        span: Some(20.0 * half.sin()),
        rise: Some(10.0 * (1.0 - half.cos())),
        ..circular(10.0, 1.5, 7)
    }));
    for (a, b) in by_radius.iter().zip(&by_span) {
        assert!(same_corners(a, &outline(b)), "{}", a.id);
    }
}

fn pointed(t: f64) -> Arch {
    Arch { profile: Profile::Pointed, eccentricity: Some(0.25), ..circular(1.0, t, 16) }
}

#[test]
fn pointed_arch_has_the_known_corners_and_may_be_given_by_span_and_rise() {
    let blocks = build(Template::Arch(pointed(0.15)));
    assert_corners(
        &blocks,
        "v15",
        &[
            [0.675, 0.0],
            [0.825, 0.0],
            [0.810_441_283_543_424_9, 0.176_321_536_281_797_75],
            [0.662_472_732_351_319_2, 0.151_718_531_219_221_35],
        ],
    );
    assert_corners(
        &blocks,
        "v08",
        &[
            [0.125_019_019_268_603_48, 0.845_568_291_261_453_8],
            [0.185_832_914_285_133_7, 0.982_687_473_628_176],
            [0.0, 1.045_526_183_316_324],
            [0.0, 0.890_575_656_527_843_9],
        ],
    );
    assert_mirrored(&blocks);
    // Springing joint of the support: [0.675, 0.825] at z = 0.
    let springer = outline(find(&blocks, "springer_right"));
    assert!(springer.iter().filter(|p| p[1] == 0.0).count() == 2 && springer.iter().all(|p| p[1] <= 0.0));
    let (span, rise) = (Some(1.5), Some((1.0_f64 - 0.25 * 0.25).sqrt()));
    let by_span = build(Template::Arch(Arch { radius: None, eccentricity: None, span, rise, ..pointed(0.15) }));
    for (a, b) in blocks.iter().zip(&by_span) {
        assert!(same_corners(a, &outline(b)), "{}", a.id);
    }
}

#[test]
fn elliptical_arch_has_the_known_corners() {
    let blocks = build(Template::Arch(Arch {
        profile: Profile::Elliptical,
        radius: None,
        span: Some(2.0),
        rise: Some(0.8),
        ..circular(1.0, 0.107_462_460_782_234_77, 16)
    }));
    assert_corners(
        &blocks,
        "v14",
        &[
            [0.928_641_692_602_700_4, 0.143_107_251_996_562],
            [1.032_928_868_203_760_5, 0.169_037_263_229_243_23],
            [0.971_594_321_862_893_6, 0.330_851_886_986_085_5],
            [0.876_164_743_159_679_8, 0.281_441_604_798_058_24],
        ],
    );
    assert_corners(
        &blocks,
        "v07",
        &[
            [0.0, 0.746_268_769_608_882_7],
            [0.0, 0.853_731_230_391_117_4],
            [-0.203_534_324_499_911_05, 0.837_691_808_270_497_4],
            [-0.186_646_319_532_345_34, 0.731_564_640_374_671_4],
        ],
    );
    assert_mirrored(&blocks);
}

#[test]
fn parabolic_arch_with_vertical_joints_has_the_known_corners() {
    let blocks = build(Template::Arch(Arch {
        profile: Profile::Parabolic,
        radius: None,
        span: Some(10.0),
        rise: Some(2.5),
        joints: JointDirection::Vertical,
        ..circular(1.0, 0.001, 20)
    }));
    assert_corners(&blocks, "v00", &[[-5.0, -0.0005], [-4.5, 0.4745], [-4.5, 0.4755], [-5.0, 0.0005]]);
    assert_corners(&blocks, "v02", &[[-4.0, 0.8995], [-3.5, 1.2745], [-3.5, 1.2755], [-4.0, 0.9005]]);
    assert_corners(&blocks, "v19", &[[4.5, 0.4745], [5.0, -0.0005], [5.0, 0.0005], [4.5, 0.4755]]);
    // The supports are vertical faces beside the springings.
    assert_corners(&blocks, "springer_left", &[[-5.5, -0.0005], [-5.0, -0.0005], [-5.0, 0.0005], [-5.5, 0.0005]]);
    assert_mirrored(&blocks);
}

#[test]
fn parabolic_arch_with_radial_joints_is_normal_to_its_mid_line() {
    let arch = Arch { profile: Profile::Parabolic, radius: None, span: Some(10.0), rise: Some(2.5), ..circular(1.0, 0.5, 10) };
    let blocks = build(Template::Arch(arch));
    // At the springing the slope is 2 × 2.5 / 5 = 1: the joint runs at 45° through (5, 0).
    let d = 0.25 / 2.0_f64.sqrt();
    assert!(outline(find(&blocks, "v09")).iter().any(|p| (p[0] - 5.0 - d).hypot(p[1] - d) < 1e-12));
    // The springer continues at right angles: its far corners lie below and beyond.
    assert!(outline(find(&blocks, "springer_right")).iter().any(|p| p[0] > 5.0 + d && p[1] < 0.0));
    assert_mirrored(&blocks);
}

#[test]
fn ring_cut_by_vertical_joints_has_the_known_corners() {
    let blocks = build(Template::Arch(Arch {
        joints: JointDirection::Vertical,
        thickness_along: Some(ThicknessAlong::Normal),
        ..circular(1.0, 0.108_944_962_152_459_41, 24)
    }));
    assert_eq!(blocks.len(), 26);
    assert_corners(
        &blocks,
        "v12",
        &[
            [0.0, 0.945_527_518_923_770_3],
            [0.123_416_106_684_392_5, 0.937_438_399_924_500_3],
            [0.123_416_106_684_392_5, 1.047_225_227_903_685_6],
            [0.092_562_080_013_294_37, 1.050_402_053_830_185_5],
            [0.061_708_053_342_196_25, 1.052_665_345_444_494],
            [0.030_854_026_671_098_128, 1.054_020_987_639_828],
            [0.0, 1.054_472_481_076_229_6],
        ],
    );
    assert_corners(
        &blocks,
        "v00",
        &[
            [-0.937_438_399_924_500_3, 0.482_826_531_679_910_96],
            [-0.964_470_173_126_490_9, 0.426_273_971_169_265_9],
            [-0.988_094_019_546_517_1, 0.368_215_184_210_899_05],
            [-1.008_226_465_023_168, 0.308_855_319_808_394_7],
            [-1.024_796_372_156_824_7, 0.248_404_124_283_938_57],
            [-1.037_745_191_671_553_9, 0.187_075_200_145_902_45],
            [-1.047_027_169_297_240_6, 0.125_085_251_330_709_25],
            [-1.052_609_507_440_946, 0.062_653_317_485_894_24],
            [-1.054_472_481_076_229_6, 0.0],
            [-0.945_527_518_923_770_3, 0.0],
            [-0.937_438_399_924_500_3, 0.123_416_106_684_392_97],
        ],
    );
    assert_mirrored(&blocks);
    // An odd number has a symmetric key.
    let odd = circular(1.0, 0.1, 7);
    assert_mirrored(&build(Template::Arch(Arch {
        joints: JointDirection::Vertical,
        thickness_along: Some(ThicknessAlong::Normal),
        embrace_deg: Some(120.0),
        ..odd
    })));
}

#[test]
fn buttresses_stand_flush_with_the_intrados_on_the_ground() {
    let blocks = build(Template::Arch(Arch { buttresses: Some(Buttresses { width: 1.6, height: 4.0 }), ..circular(2.0, 0.3, 16) }));
    assert_corners(&blocks, "buttress_right", &[[1.85, -4.0], [3.45, -4.0], [3.45, 0.0], [1.85, 0.0]]);
    assert_corners(&blocks, "buttress_left", &[[-3.45, -4.0], [-1.85, -4.0], [-1.85, 0.0], [-3.45, 0.0]]);
    assert_corners(
        &blocks,
        "v14",
        &[
            [1.814_452_768_745_976_4, 0.360_917_095_729_837_27],
            [2.108_688_352_866_945_3, 0.419_444_192_334_675_7],
            [1.986_340_994_899_266_3, 0.822_769_379_584_943],
            [1.709_177_135_145_880_7, 0.707_964_349_875_416_1],
        ],
    );
    let ground = find(&blocks, "ground");
    assert!(ground.support && outline(ground).iter().filter(|p| p[1] == -4.0 && p[0].abs() > 3.45).count() == 2);
    assert_eq!(blocks.iter().filter(|b| b.support).count(), 1);
    assert_mirrored(&blocks);
}

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
    let leaning = build(Template::Stack(Stack { blocks: 10, shift: Some(0.0999999), ..stack.clone() }));
    assert_corners(&leaning, "b01", &[[0.0999999, 0.2], [1.0999999, 0.2], [1.0999999, 0.4], [0.0999999, 0.4]]);
    assert_corners(&leaning, "b09", &[[0.899_999_1, 1.8], [1.899_999_1, 1.8], [1.899_999_1, 2.0], [0.899_999_1, 2.0]]);
    let harmonic = build(Template::Stack(Stack { blocks: 4, harmonic: Some(0.999999), ..stack }));
    assert_corners(&harmonic, "base", &[[-2.0, -0.2], [0.0, -0.2], [0.0, 0.0], [-2.0, 0.0]]);
    assert_corners(&harmonic, "b00", &[[-0.875_000_125, 0.0], [0.124_999_875, 0.0], [0.124_999_875, 0.2], [-0.875_000_125, 0.2]]);
    assert_corners(&harmonic, "b03", &[[0.041_665_625, 0.6], [1.041_665_625, 0.6], [1.041_665_625, 0.8], [0.041_665_625, 0.8]]);
}

#[test]
fn column_blocks_touch_from_the_base_up() {
    let blocks = build(parse(serde_json::json!({"column": {"blocks": 8, "size": [1, 1, 0.5]}})));
    assert_eq!(blocks.len(), 9);
    assert!(blocks[0].support);
    assert_corners(&blocks, "base", &[[-1.0, -0.5], [1.0, -0.5], [1.0, 0.0], [-1.0, 0.0]]);
    assert_corners(&blocks, "b07", &[[-0.5, 3.5], [0.5, 3.5], [0.5, 4.0], [-0.5, 4.0]]);
}

/// The courses of a wall from the bottom up, each as the x-ranges of its blocks.
fn courses(blocks: &[BlockSpec], free: bool) -> Vec<Vec<(f64, f64)>> {
    let mut courses: Vec<(f64, Vec<(f64, f64)>)> = Vec::new();
    for block in blocks.iter().filter(|b| b.support != free) {
        let o = outline(block);
        if courses.last().is_none_or(|(z, _)| *z != o[0][1]) {
            courses.push((o[0][1], Vec::new()));
        }
        courses.last_mut().expect("just pushed").1.push((o[0][0], o[1][0]));
    }
    courses.into_iter().map(|(_, c)| c).collect()
}

fn bricks(blocks: usize, courses: usize, first: WallEnd) -> Wall {
    Wall { size: [4.0, 1.0, 1.75], blocks, courses, first, ..Wall::default() }
}

#[test]
fn running_bond_alternates_and_cuts_half_blocks() {
    // Ferris & Tin-Loi wall 1.
    let wall = build(Template::Wall(bricks(5, 6, WallEnd::Half)));
    assert_eq!(wall.len(), 34);
    assert_corners(&wall, "base", &[[0.0, -1.75], [20.0, -1.75], [20.0, 0.0], [0.0, 0.0]]);
    let halves = vec![(0.0, 2.0), (2.0, 6.0), (6.0, 10.0), (10.0, 14.0), (14.0, 18.0), (18.0, 20.0)];
    let wholes = vec![(0.0, 4.0), (4.0, 8.0), (8.0, 12.0), (12.0, 16.0), (16.0, 20.0)];
    let rows = courses(&wall, true);
    assert_eq!(rows[0], halves);
    assert_eq!(rows[5], wholes);
    assert_corners(&wall, "c05_04", &[[16.0, 8.75], [20.0, 8.75], [20.0, 10.5], [16.0, 10.5]]);
}

#[test]
fn a_course_as_base_continues_the_bond() {
    let wall = build(Template::Wall(Wall { size: [1.0, 0.5, 0.4], base: WallBase::Course, ..bricks(100, 100, WallEnd::Half) }));
    let base = courses(&wall, false);
    assert_eq!((base.len(), base[0].len()), (1, 100));
    let free = courses(&wall, true);
    assert_eq!((free.len(), free[0].len(), free[1].len()), (100, 101, 100));
    assert_eq!(wall.iter().filter(|b| b.support).map(|b| b.id.as_str()).next(), Some("base_000"));
}

#[test]
fn openings_cut_the_blocks_they_cross() {
    // Ferris & Tin-Loi wall 3: 46 blocks, an opening of 4 × 8.75 m.
    let openings = vec![Opening { x: 6.0, z: 5.25, width: 4.0, height: 8.75 }];
    let wall = build(Template::Wall(Wall { openings, ..bricks(4, 11, WallEnd::Whole) }));
    assert_eq!(wall.len(), 47);
    let rows = courses(&wall, true);
    assert_eq!(rows[2], [(0.0, 4.0), (4.0, 8.0), (8.0, 12.0), (12.0, 16.0)]);
    assert_eq!(rows[3], [(0.0, 2.0), (2.0, 6.0), (10.0, 14.0), (14.0, 16.0)]);
    assert_eq!(rows[4], [(0.0, 4.0), (4.0, 6.0), (10.0, 12.0), (12.0, 16.0)]);
    assert_eq!(rows[8], [(0.0, 4.0), (4.0, 8.0), (8.0, 12.0), (12.0, 16.0)]);
    // Wall 5: 61 blocks, two openings.
    let opening = |z| Opening { x: 4.0, z, width: 4.0, height: 8.75 };
    let wall = build(Template::Wall(Wall { openings: vec![opening(5.25), opening(19.25)], ..bricks(3, 19, WallEnd::Half) }));
    assert_eq!(wall.len(), 62);
    assert_eq!(courses(&wall, true)[4], [(0.0, 2.0), (2.0, 4.0), (8.0, 10.0), (10.0, 12.0)]);
}

#[test]
fn an_opening_on_the_grid_leaves_no_sliver() {
    // 3 × 0.1 is not 0.3: the edge misses the joint by rounding.
    let opening = Opening { x: 0.1 * 3.0, z: 0.1 * 3.0, width: 0.3, height: 0.1 };
    let wall = Wall { size: [0.3, 0.1, 0.1], openings: vec![opening], ..bricks(3, 5, WallEnd::Half) };
    let rows = courses(&build(Template::Wall(wall)), true);
    assert_eq!(rows[3].len(), 2, "{:?}", rows[3]);
}

#[test]
fn raked_ends_step_in_by_half_a_block() {
    let wall = build(Template::Wall(Wall { rake_right: 0.5, ..bricks(6, 6, WallEnd::Half) }));
    assert_eq!(wall.len(), 34);
    let rows = courses(&wall, true);
    assert_eq!(rows[0].last(), Some(&(22.0, 24.0)));
    assert_eq!(rows[1].last(), Some(&(20.0, 22.0)));
    assert_eq!(rows[5], [(0.0, 4.0), (4.0, 8.0), (8.0, 12.0), (12.0, 14.0)]);
}

#[test]
fn barrel_strips_are_an_arch_moved_by_half_a_block() {
    let barrel = Barrel { radius: Some(3.0), thickness: 0.45, depth: 6.0, voussoirs: 15, courses: 6, ..Barrel::default() };
    let blocks = build(Template::Barrel(barrel));
    let arch = build(Template::Arch(circular(3.0, 0.45, 15)));
    assert_eq!(blocks.len(), 8 * 6 + 7 * 7 + 2);
    assert_eq!(outline(find(&blocks, "v03_02")), outline(find(&arch, "v03")));
    let ends = |id: &str| match &find(&blocks, id).shape {
        Shape::Prism { depth, .. } => (find(&blocks, id).at[1] - depth / 2.0, find(&blocks, id).at[1] + depth / 2.0),
        _ => unreachable!("a barrel is made of prisms"),
    };
    assert_eq!([ends("v00_00"), ends("v00_05")], [(-3.0, -2.0), (2.0, 3.0)]);
    assert_eq!([ends("v01_00"), ends("v01_01"), ends("v01_06")], [(-3.0, -2.5), (-2.5, -1.5), (2.5, 3.0)]);
    assert_eq!(ends("springer_left"), (-3.0, 3.0));
}

/// Volume by the divergence theorem, and the largest distance of a corner from the plane of its face.
fn solid(block: &BlockSpec) -> (f64, f64) {
    use nalgebra::Vector3;
    let Shape::Polyhedron { vertices, faces } = &block.shape else { panic!("{} is no polyhedron", block.id) };
    let v: Vec<_> = vertices.iter().map(|p| Vector3::from(*p)).collect();
    let mut edges: HashMap<(usize, usize), i32> = HashMap::new();
    let (mut volume, mut warp) = (0.0, 0.0_f64);
    for face in faces {
        let o = v[face[0]];
        let normal = face.windows(2).map(|e| (v[e[0]] - o).cross(&(v[e[1]] - o))).sum::<Vector3<f64>>();
        volume += o.dot(&normal) / 6.0;
        warp = face.iter().map(|&i| (v[i] - o).dot(&normal.normalize()).abs()).fold(warp, f64::max);
        for i in 0..face.len() {
            let (a, b) = (face[i], face[(i + 1) % face.len()]);
            *edges.entry((a.min(b), a.max(b))).or_default() += if a < b { 1 } else { -1 };
        }
        // Convex and turned outwards: every corner lies behind every face.
        assert!(v.iter().all(|p| (p - o).dot(&normal.normalize()) < 1e-12), "{} is not convex", block.id);
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
        assert_eq!(blocks.len(), (dome.rings + 1) * dome.segments + usize::from(dome.oculus_deg.is_none()));
        for block in &blocks {
            let (volume, warp) = solid(block);
            assert!(volume > 0.0 && warp < 1e-13, "{}: volume {volume}, warp {warp}", block.id);
        }
    }
}

#[test]
fn dome_volume_tends_to_that_of_the_shell() {
    let volume = |n: usize| -> f64 {
        let dome = Dome { radius: 1.0, thickness: 0.2, rings: n, segments: 4 * n, ..Dome::default() };
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
    let blocks = build(Template::Dome(Dome { radius: 5.0, thickness: 0.5, rings: 3, segments: 12, ..Dome::default() }));
    let corners = |id: &str| -> HashSet<[u64; 3]> {
        let Shape::Polyhedron { vertices, .. } = &find(&blocks, id).shape else { unreachable!("domes are polyhedra") };
        vertices.iter().map(|p| p.map(|c| (c + 0.0).to_bits())).collect()
    };
    for (a, b, shared) in
        [("r00_00", "r00_01", 4), ("r00_11", "r00_00", 4), ("r00_05", "r01_05", 4), ("r02_07", "keystone", 4), ("springer_03", "r00_03", 4)]
    {
        assert_eq!(corners(a).intersection(&corners(b)).count(), shared, "{a} and {b}");
    }
}

#[test]
fn prefix_place_and_material_reach_every_block() {
    let json = serde_json::json!({"column": {"blocks": 2, "size": [1, 1, 1], "prefix": "north_", "at": [1, 2, 3], "material": "brick"}});
    let blocks = build(parse(json));
    assert!(blocks.iter().all(|b| b.id.starts_with("north_") && b.material.as_deref() == Some("brick")));
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
    let blocks =
        build(parse(serde_json::json!({ "arch": { "radius": 5, "thickness": 0.8, "depth": 1, "embrace_deg": 180, "voussoirs": 27 } })));
    assert_eq!(blocks.len(), 29);
}

#[test]
fn what_has_no_meaning_is_refused_at_its_place() {
    use serde_json::json;
    let cases = [
        (json!({"arch": {"radius": 1, "thickness": 2, "depth": 1, "voussoirs": 9}}), "arch.thickness", "2 × radius"),
        (json!({"arch": {"radius": 1, "thickness": 0, "depth": 1, "voussoirs": 9}}), "arch.thickness", "> 0"),
        (json!({"arch": {"radius": -1, "thickness": 0.1, "depth": 1, "voussoirs": 9}}), "arch.radius", "got -1"),
        (json!({"arch": {"radius": 1, "thickness": 0.1, "depth": -2, "voussoirs": 9}}), "arch.depth", "> 0"),
        (json!({"arch": {"radius": 1, "thickness": 0.1, "depth": 1, "voussoirs": 0}}), "arch.voussoirs", "at least 2"),
        (json!({"arch": {"radius": 1, "thickness": 0.1, "depth": 1, "voussoirs": 1}}), "arch.voussoirs", "at least 2"),
        (json!({"arch": {"radius": 1, "thickness": 0.1, "depth": 1, "voussoirs": 1_000_001}}), "arch.voussoirs", "more than"),
        (json!({"arch": {"radius": 1, "thickness": 0.1, "depth": 1, "voussoirs": 9, "embrace_deg": 360}}), "arch.embrace_deg", "360"),
        (json!({"arch": {"radius": 1, "thickness": 0.1, "depth": 1, "voussoirs": 9, "embrace_deg": 0}}), "arch.embrace_deg", "got 0"),
        (json!({"arch": {"thickness": 0.1, "depth": 1, "voussoirs": 9}}), "arch.radius", "missing"),
        (json!({"arch": {"radius": 1, "span": 2, "rise": 1, "thickness": 0.1, "depth": 1, "voussoirs": 9}}), "arch.radius", "excludes"),
        (json!({"arch": {"span": 2, "thickness": 0.1, "depth": 1, "voussoirs": 9}}), "arch.rise", "missing"),
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
        (json!({"arch": {"profile": "parabolic", "radius": 1, "thickness": 0.1, "depth": 1, "voussoirs": 9}}), "arch.radius", "no radius"),
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
        (json!({"barrel": {"radius": 1, "thickness": 0.1, "depth": 1, "voussoirs": 9, "courses": 0}}), "barrel.courses", "at least 1"),
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
        (json!({"stack": {"blocks": 3, "size": [1, 1, 1], "shift": 0.1, "harmonic": 1}}), "stack.harmonic", "exclude"),
        (json!({"dome": {"radius": 1, "thickness": 2.5, "rings": 3, "segments": 8}}), "dome.thickness", "2 × radius"),
        (json!({"dome": {"radius": 1, "thickness": 0.1, "rings": 3, "segments": 2}}), "dome.segments", "at least 3"),
        (json!({"dome": {"radius": 1, "thickness": 0.1, "rings": 3, "segments": 8, "oculus_deg": 90}}), "dome.oculus_deg", "springing"),
        (json!({"dome": {"radius": 1, "thickness": 0.1, "rings": 3, "segments": 8, "springing_deg": 180}}), "dome.springing_deg", "180"),
        (json!({"dome": {"radius": 1, "thickness": 0.1, "rings": 1_000_000_000, "segments": 1_000_000_000}}), "dome.segments", "more than"),
        (
            json!({"flat_arch": {"span": 3, "height": 1, "depth": 1, "voussoirs": 3, "center_depth": 0.5}}),
            "flat_arch.center_depth",
            "height / 2",
        ),
        (json!({"wall": {"size": [1, 1, 1], "courses": 4, "blocks": 3, "rake_right": -0.5}}), "wall.rake_right", "≥ 0"),
        (json!({"wall": {"size": [1, 1, 1], "courses": 7, "blocks": 3, "rake_right": 0.5}}), "wall.courses", "meet"),
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
    let result: Result<Template, _> = serde_json::from_value(serde_json::json!({"column": {"blocks": 1, "size": [1, 1, 1], "blokcs": 2}}));
    assert!(result.expect_err("a typo").to_string().contains("blokcs"));
}

proptest! {
    /// Whatever the numbers are, the answer is blocks with finite corners or an error, never a panic.
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
