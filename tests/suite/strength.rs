//! Joints with cohesion, tension, crushing, water and a rolling arm, each against its formula.

use crate::ask::{
    cuboid, fixed, ground, load_factor, model, prism, prove, push, scene, sphere, tilt_deg, verdict,
};
use proptest::prelude::*;
use serde_json::{Value, json};
use voussoir::{
    analysis::{Control, Law, Outcome, Question, TiltOptions, ask, limit},
    proof::saved,
    scene::Scene,
    verdict::Verdict,
};

fn near(got: f64, want: f64, tolerance: f64) {
    assert!((got - want).abs() <= tolerance * want.abs(), "{got}, not {want}");
}

/// A block of `size` on the ground with this joint, pushed along x.
fn block(friction: f64, joint: Value, size: [f64; 3]) -> Scene {
    let mut law = json!({ "friction": friction });
    law.as_object_mut().unwrap().extend(joint.as_object().unwrap().clone());
    let mut more = push([1.0, 0.0, 0.0]);
    more["joints"] = json!({ "default": law });
    scene(friction, json!([ground(), cuboid("block", size, [0.0; 3])]), more)
}

/// Case A31: the middle of three joints is weak in friction; with cohesion there the next one gives
/// way.
#[test]
fn the_weakest_of_several_joints_slides() {
    let column = |middle: Value| {
        let blocks = json!([
            ground(),
            cuboid("b0", [1.0, 1.0, 0.3], [0.0, 0.0, 0.0]),
            cuboid("b1", [1.0, 1.0, 0.3], [0.0, 0.0, 0.3]),
            cuboid("b2", [1.0, 1.0, 0.3], [0.0, 0.0, 0.6])
        ]);
        let exception = |a: &str, b: &str, rest: Value| {
            let mut rule = json!({ "blocks": [a, b] });
            rule.as_object_mut().unwrap().extend(rest.as_object().unwrap().clone());
            rule
        };
        let mut more = push([1.0, 0.0, 0.0]);
        more["joints"] = json!({ "default": { "friction": 0.5 }, "overrides": [exception("b0", "b1", middle), exception("b1", "b2", json!({ "friction": 0.4 }))] });
        load_factor(&scene(0.5, blocks, more))
    };
    near(column(json!({ "friction": 0.25 })), 0.25, 1e-7);
    // Two blocks of weight 0.3 slide on the joint of area 1: 0.25 + 0.06 / 0.6.
    near(column(json!({ "friction": 0.25, "cohesion": 0.06 })), 0.35, 1e-7);
    near(column(json!({ "friction": 0.25, "cohesion": 0.12 })), 0.4, 1e-7);
}

#[test]
fn cohesion_adds_to_friction() {
    for (size, cohesion) in
        [([1.0, 1.0, 0.1], 0.02), ([2.0, 0.5, 0.2], 1e-3), ([1.0, 1.0, 0.1], 0.5)]
    {
        let weight = size[0] * size[1] * size[2];
        let lambda = load_factor(&block(0.3, json!({ "cohesion": cohesion }), size));
        // Without tension it may still turn over its edge.
        near(lambda, (0.3 + cohesion * size[0] * size[1] / weight).min(size[0] / size[2]), 1e-7);
    }
}

/// A block glued to a ceiling hangs until the tensile strength of its joint is used.
#[test]
fn a_block_hangs_on_its_tensile_strength() {
    let hanging = |tension: f64, cohesion: f64| {
        let ceiling = fixed(cuboid("ceiling", [4.0, 4.0, 1.0], [0.0, 0.0, 0.5]));
        scene(
            0.5,
            json!([ceiling, cuboid("block", [1.0, 2.0, 0.5], [0.0; 3])]),
            json!({ "joints": { "default": { "friction": 0.5, "tension": tension, "cohesion": cohesion } } }),
        )
    };
    for law in [Law::Associative, Law::Coulomb] {
        assert_eq!(verdict(&hanging(0.5 * 1.001, 1.0), law), Verdict::Stable);
        assert_eq!(verdict(&hanging(0.5 * 0.999, 1.0), law), Verdict::Unstable);
        // Beyond cohesion / friction tension has no effect.
        assert_eq!(verdict(&hanging(5.0, 0.25 * 1.001), law), Verdict::Stable);
        assert_eq!(verdict(&hanging(5.0, 0.25 * 0.999), law), Verdict::Unstable);
    }
}

/// Tension at the windward edge: about the lee edge of a rigid joint, `λ W h = W b/2 + T A b/2`.
#[test]
fn tension_holds_a_block_down() {
    let (b, h, tension) = (0.5, 2.0, 0.3);
    let lambda =
        load_factor(&block(5.0, json!({ "cohesion": 100.0, "tension": tension }), [b, 1.0, h]));
    let weight = b * h;
    near(lambda, (weight * b / 2.0 + tension * b * b / 2.0) / (weight * h / 2.0), 1e-7);
}

/// A retaining block on a joint with water under it: friction sees the effective weight only.
#[test]
fn uplift_takes_its_part_off_the_friction() {
    let (b, h) = (2.0, 1.0);
    for pressure in [0.0, 0.2, 0.5, 0.9] {
        let lambda = load_factor(&block(0.4, json!({ "pore_pressure": pressure }), [b, 1.0, h]));
        near(lambda, 0.4 * (1.0 - pressure * b / (b * h)), 1e-7);
    }
    // Turning over: the water helps from below, `λ W h/2 = (W − p A) b/2`.
    let lambda = load_factor(&block(5.0, json!({ "pore_pressure": 0.5 }), [b, 1.0, h]));
    near(lambda, (b * h - 0.5 * b) * b / 2.0 / (b * h * h / 2.0), 1e-7);
    // It floats.
    assert_eq!(
        verdict(&block(0.4, json!({ "pore_pressure": 1.001 }), [b, 1.0, h]), Law::Coulomb),
        Verdict::Unstable
    );
}

/// `M = N t / 2 − N² / (2 σ b)`: a block turns about the middle of a strip that its weight fills at
/// full strength.
#[test]
fn a_hinge_crushes_by_the_hand_formula() {
    let (t, b, h) = (0.5, 1.5, 3.0);
    let weight = t * b * h;
    for strength in [1.05, 1.5, 4.0, 100.0, 1e6] {
        let sigma = strength * h;
        let lambda = load_factor(&block(5.0, json!({ "compression": sigma }), [t, b, h]));
        let moment = weight * t / 2.0 - weight * weight / (2.0 * sigma * b);
        near(lambda, moment / (weight * h / 2.0), 1e-6);
    }
    // Its own weight is too much.
    assert_eq!(
        verdict(&block(5.0, json!({ "compression": 0.999 * h }), [t, b, h]), Law::Coulomb),
        Verdict::Unstable
    );
    assert_eq!(
        verdict(&block(5.0, json!({ "compression": 1.001 * h }), [t, b, h]), Law::Coulomb),
        Verdict::Stable
    );
}

/// Pushed along its diagonal a square block crushes in a triangle at the corner: `N = σ 4.5 c²`
/// with the centroid at (c, c).
#[test]
fn a_corner_crushes_in_a_triangle() {
    let (t, h) = (1.0, 2.0);
    for strength in [20.0, 100.0] {
        let mut s = block(5.0, json!({ "compression": strength * h }), [t, t, h]);
        s.loads.live = serde_json::from_value(json!([{ "weight": [1.0, 1.0, 0.0] }])).unwrap();
        let c = (t * t / (4.5 * strength)).sqrt();
        near(load_factor(&s), (t / 2.0 - c) / (h / 2.0), 1e-6);
    }
}

fn disc_on_incline(arm: f64) -> Scene {
    let more = json!({ "joints": { "default": { "friction": 0.8, "rolling_arm": arm } } });
    scene(0.8, json!([ground(), sphere("disc", 1.0, [0.0, 0.0, 1.0])]), more)
}

/// Case R10: `atan(min(μ, c / R))`.
#[test]
fn a_ball_rolls_when_its_weight_leaves_the_rolling_arm() {
    near(tilt_deg(&disc_on_incline(0.1), [1.0, 0.0, 0.0]), 5.71059, 1e-6);
    near(tilt_deg(&disc_on_incline(0.1), [0.6, 0.8, 0.0]), 5.71059, 1e-6);
    near(tilt_deg(&disc_on_incline(5.0), [1.0, 0.0, 0.0]), 0.8f64.atan().to_degrees(), 1e-6);
    assert_eq!(verdict(&disc_on_incline(0.1), Law::Coulomb), Verdict::Stable);
}

/// Case R11: a ball between two others, `30° + atan(c / R)`.
#[test]
fn a_ball_in_a_groove_rolls_over_the_rolling_arm() {
    let s = scene(
        0.5,
        json!([
            fixed(sphere("left", 1.0, [-1.0, 0.0, 0.0])),
            fixed(sphere("right", 1.0, [1.0, 0.0, 0.0])),
            sphere("ball", 1.0, [0.0, 0.0, 3f64.sqrt()])
        ]),
        json!({ "joints": { "default": { "friction": 0.5, "rolling_arm": 0.1 } } }),
    );
    near(tilt_deg(&s, [1.0, 0.0, 0.0]), 35.71059, 1e-6);
}

/// A cohesive slope: `tan θ = μ + c A / (W cos θ)`; units and densities change nothing.
#[test]
fn strengths_do_not_tilt_with_the_ground() {
    let (mu, cohesion, h) = (0.3, 0.05, 0.2);
    let s = block(mu, json!({ "cohesion": cohesion }), [1.0, 1.0, h]);
    let theta = tilt_deg(&s, [1.0, 0.0, 0.0]).to_radians();
    near(theta.tan(), mu + cohesion / h / theta.cos(), 1e-6);
    // With water instead.
    let s = block(mu, json!({ "pore_pressure": cohesion }), [1.0, 1.0, h]);
    let theta = tilt_deg(&s, [1.0, 0.0, 0.0]).to_radians();
    near(theta.tan(), mu * (1.0 - cohesion / h / theta.cos()), 1e-6);
}

/// Joints with strength that topple slide nowhere: the tilt with dry friction is the bound itself,
/// to the last digit and with its evidence, or the check refuses it.
#[test]
fn a_tilt_at_which_strong_joints_hinge_is_proved_with_dry_friction() {
    for size in [[0.3, 1.0, 1.0], [0.25, 1.0, 0.7], [0.4, 1.0, 1.1]] {
        let mut s = block(0.9, json!({ "cohesion": 0.02, "tension": 0.01 }), size);
        s.loads.live.clear();
        let m = model(&s);
        let toward = TiltOptions { toward: vec![[1.0, 0.0, 0.0]], ..TiltOptions::default() };
        let question = Question::Tilt(toward);
        let answer = ask(&question, &s, &m, &Control::default()).unwrap();
        prove(&s, &saved::of(&question, &s, &m, &answer).unwrap());
    }
}

/// Nothing that has a limit wedges: the block under a roof has a load factor when the joints can
/// crush.
#[test]
fn crushing_ends_wedging() {
    let under_roof = |joint: Value| {
        let blocks = json!([
            ground(),
            cuboid("block", [1.0, 1.0, 0.5], [0.0; 3]),
            fixed(cuboid("roof", [4.0, 4.0, 1.0], [0.0, 0.0, 0.5]))
        ]);
        let mut more = push([1.0, 0.0, 0.0]);
        more["joints"] = json!({ "default": joint });
        scene(0.4, blocks, more)
    };
    let m = model(&under_roof(json!({ "friction": 0.4 })));
    assert_eq!(limit(&m, &Control::default()).outcome, Outcome::Unbounded);
    // Squeezed to σ on both faces: λ W = μ σ A (top) + μ σ A (bottom), the weight taken off the
    // top.
    let sigma = 50.0;
    let lambda = load_factor(&under_roof(json!({ "friction": 0.4, "compression": sigma })));
    near(lambda, 0.4 * (2.0 * sigma - 0.5) / 0.5, 1e-6);
    // Cohesion does not make it wedge.
    let m = model(&under_roof(json!({ "friction": 0.0, "cohesion": 0.1 })));
    let l = limit(&m, &Control::default());
    assert_eq!(l.outcome, Outcome::Found);
    near(l.value.unwrap(), 0.2 / 0.5, 1e-6);
}

/// A wedge with cohesion that nothing presses: shear alone holds it.
#[test]
fn mortar_holds_a_block_between_posts() {
    let bar = |cohesion: f64| {
        let post = |id: &str, x: f64| {
            fixed(prism(id, &[[x - 0.1, -1.0], [x + 0.1, -1.0], [x + 0.1, 1.4], [x - 0.1, 1.4]]))
        };
        scene(
            0.5,
            json!([
                post("left", -1.0),
                post("right", 1.0),
                prism("bar", &[[-0.9, 0.0], [0.9, 0.0], [0.9, 0.5], [-0.9, 0.5]])
            ]),
            json!({ "joints": { "default": { "friction": 0.5, "cohesion": cohesion } } }),
        )
    };
    // Weight 0.9, two joints of area 0.5.
    assert_eq!(verdict(&bar(0.91), Law::Coulomb), Verdict::Stable);
    assert_eq!(verdict(&bar(0.0), Law::Coulomb), Verdict::Conditional);
    assert_eq!(verdict(&bar(0.85), Law::Coulomb), Verdict::Conditional);
}

/// A result about strong joints is proved from the scene, and refuted when the scene's joints are
/// weaker.
#[test]
fn weaker_joints_refute_the_result() {
    let arch = |sigma: f64| {
        block(
            5.0,
            json!({ "compression": sigma, "cohesion": 0.1, "tension": 0.01, "pore_pressure": 0.01 }),
            [0.5, 1.0, 2.0],
        )
    };
    let (scene, model) = (arch(8.0), model(&arch(8.0)));
    let file =
        saved::load_factor(&scene, &model, &limit(&model, &Control::default()).into()).unwrap();
    for other in [
        block(
            5.0,
            json!({ "compression": 7.9, "cohesion": 0.1, "tension": 0.01, "pore_pressure": 0.01 }),
            [0.5, 1.0, 2.0],
        ),
        block(
            5.0,
            json!({ "compression": 8.0, "cohesion": 0.1, "tension": 0.0, "pore_pressure": 0.01 }),
            [0.5, 1.0, 2.0],
        ),
        block(
            5.0,
            json!({ "compression": 8.0, "cohesion": 0.1, "tension": 0.01, "pore_pressure": 0.02 }),
            [0.5, 1.0, 2.0],
        ),
    ] {
        assert!(crate::ask::check(&other, &file).refuted());
    }
    assert!(crate::ask::check(&arch(8.0), &file).proved());
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 12, ..ProptestConfig::default() })]

    /// The load factor does not change when lengths are multiplied and strengths with weight and
    /// length.
    #[test]
    fn strengths_scale_with_weight_and_length(
        cohesion in 0.0..0.3f64, tension in 0.0..0.2f64, sigma in 3.0..30.0f64, water in 0.0..0.5f64, length in -3.0..3.0f64, density in -3.0..6.0f64,
    ) {
        let at = |l: f64, rho: f64| {
            let by = l * rho;
            let mut s = block(0.6, json!({ "cohesion": cohesion * by, "tension": tension * by, "compression": sigma * by, "pore_pressure": water * by }), [0.5 * l, 1.0 * l, 1.0 * l]);
            for block in &mut s.blocks {
                block.material = None;
                block.density = Some(rho);
            }
            s.blocks[0] = serde_json::from_value(fixed(cuboid("ground", [40.0 * l, 40.0 * l, l], [0.0, 0.0, -l]))).unwrap();
            load_factor(&s)
        };
        let (one, other) = (at(1.0, 1.0), at(10f64.powf(length), 10f64.powf(density)));
        prop_assert!((one - other).abs() <= 2e-6 * one, "{one} and {other}");
    }

    /// Stronger joints carry more.
    #[test]
    fn strength_never_harms(sigma in 2.0..20.0f64, more in 1.0..3.0f64, cohesion in 0.0..0.5f64) {
        let at = |by: f64| load_factor(&block(0.4, json!({ "cohesion": cohesion * by, "compression": sigma * by }), [0.5, 1.0, 1.0]));
        prop_assert!(at(more) >= at(1.0) * (1.0 - 1e-6));
    }
}
