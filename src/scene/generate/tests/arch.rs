//! Corners of arches against coordinates computed elsewhere, to 1e-12.

use super::*;
use crate::template::Buttresses;

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
    let by_radius =
        build(Template::Arch(Arch { embrace_deg: Some(157.5), ..circular(10.0, 1.5, 7) }));
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
    assert!(
        springer.iter().filter(|p| p[1] == 0.0).count() == 2
            && springer.iter().all(|p| p[1] <= 0.0)
    );
    let (span, rise) = (Some(1.5), Some((1.0_f64 - 0.25 * 0.25).sqrt()));
    let by_span = build(Template::Arch(Arch {
        radius: None,
        eccentricity: None,
        span,
        rise,
        ..pointed(0.15)
    }));
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
    assert_corners(
        &blocks,
        "v00",
        &[[-5.0, -0.0005], [-4.5, 0.4745], [-4.5, 0.4755], [-5.0, 0.0005]],
    );
    assert_corners(
        &blocks,
        "v02",
        &[[-4.0, 0.8995], [-3.5, 1.2745], [-3.5, 1.2755], [-4.0, 0.9005]],
    );
    assert_corners(&blocks, "v19", &[[4.5, 0.4745], [5.0, -0.0005], [5.0, 0.0005], [4.5, 0.4755]]);
    // The supports are vertical faces beside the springings.
    assert_corners(
        &blocks,
        "springer_left",
        &[[-5.5, -0.0005], [-5.0, -0.0005], [-5.0, 0.0005], [-5.5, 0.0005]],
    );
    assert_mirrored(&blocks);
}

#[test]
fn parabolic_arch_with_radial_joints_is_normal_to_its_mid_line() {
    let arch = Arch {
        profile: Profile::Parabolic,
        radius: None,
        span: Some(10.0),
        rise: Some(2.5),
        ..circular(1.0, 0.5, 10)
    };
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
    let blocks = build(Template::Arch(Arch {
        buttresses: Some(Buttresses { width: 1.6, height: 4.0 }),
        ..circular(2.0, 0.3, 16)
    }));
    assert_corners(
        &blocks,
        "buttress_right",
        &[[1.85, -4.0], [3.45, -4.0], [3.45, 0.0], [1.85, 0.0]],
    );
    assert_corners(
        &blocks,
        "buttress_left",
        &[[-3.45, -4.0], [-1.85, -4.0], [-1.85, 0.0], [-3.45, 0.0]],
    );
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
    assert!(
        ground.support
            && outline(ground).iter().filter(|p| p[1] == -4.0 && p[0].abs() > 3.45).count() == 2
    );
    assert_eq!(blocks.iter().filter(|b| b.support).count(), 1);
    assert_mirrored(&blocks);
}

#[test]
fn a_clear_span_and_rise_are_those_between_the_intrados() {
    use crate::template::JointDirection;
    let intrados = |profile, joints, thickness: f64| {
        let arch = Arch {
            profile,
            joints,
            intrados_span: Some(4.0),
            intrados_rise: Some(2.5),
            thickness,
            depth: 1.0,
            voussoirs: 12,
            ..Arch::default()
        };
        let blocks = build(Template::Arch(arch));
        let corners = |i: usize| match &blocks[i].shape {
            Shape::Prism { polygon, .. } => polygon.clone(),
            _ => panic!("voussoirs are prisms"),
        };
        // The intrados comes first; the joint of the crown is that between v05 and v06.
        let (foot, crown) = (corners(0)[0], corners(5)[1]);
        [-2.0 * foot[0], crown[1] - foot[1]]
    };
    for thickness in [0.1, 0.5] {
        for (profile, joints) in [
            (Profile::Circular, JointDirection::Radial),
            (Profile::Pointed, JointDirection::Radial),
            (Profile::Elliptical, JointDirection::Radial),
            (Profile::Parabolic, JointDirection::Radial),
            (Profile::Parabolic, JointDirection::Vertical),
        ] {
            let [span, rise] = intrados(profile, joints, thickness);
            assert!(
                (span - 4.0).abs() < 1e-12 && (rise - 2.5).abs() < 1e-12,
                "{profile:?} {joints:?}: {span} {rise}"
            );
        }
    }
}
