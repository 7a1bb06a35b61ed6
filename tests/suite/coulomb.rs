//! Dry friction: which scenes stand by themselves, and which only with self-stress that nobody
//! applied.

use crate::ask::{self, cuboid, fixed, prism, sphere, verdict};
use proptest::prelude::*;
use serde_json::{Value, json};
use voussoir::{
    analysis::{Control, Law, Limited, Outcome, assess, coulomb, limit},
    import::{self, ImportOptions, Up},
    interface::prepare,
    proof::saved,
    scene::{Friction, Scene, read_str},
    tolerance,
    verdict::{
        Evidence, Verdict,
        claim::{Claim, verify},
    },
};

fn scene(mu: f64, blocks: Value) -> Scene {
    let text = json!({ "format": "voussoir-scene/1", "joints": { "default": { "friction": mu } }, "blocks": blocks });
    read_str("test", text.to_string()).unwrap().0
}

/// Case A22 (model H of Kao et al., Computer-Aided Design 146, 2022): a bar that just fills the gap
/// of two posts.
fn squeezed(mu: f64, density: f64) -> Scene {
    let mut bar = cuboid("bar", [1.8, 1.0, 0.8], [0.0, 0.0, 0.2]);
    bar["density"] = json!(density);
    let post = |id: &str, x: f64| fixed(cuboid(id, [0.2, 1.0, 2.4], [x, 0.0, -1.0]));
    scene(mu, json!([post("left", -1.0), post("right", 1.0), bar]))
}

#[test]
fn a_block_between_two_posts_needs_a_squeeze_at_every_density_and_friction() {
    for mu in [0.05, 0.5, 0.84, 1.4] {
        for density in [1e-3, 1.0, 1e6] {
            let scene = squeezed(mu, density);
            assert_eq!(
                verdict(&scene, Law::Coulomb),
                Verdict::Conditional,
                "μ {mu}, density {density}"
            );
            assert_eq!(
                verdict(&scene, Law::Associative),
                Verdict::Stable,
                "μ {mu}, density {density}"
            );
        }
    }
}

/// Case A23 (model A, same source): a trapezoid between posts that lean inwards by 30°: forces
/// exist from μ = tan 30° on.
#[test]
fn a_trapezoid_between_leaning_posts_needs_a_squeeze() {
    let s = 30f64.to_radians().tan();
    let at = |mu: f64| {
        let half = |z: f64| 1.0 - s * z;
        scene(
            mu,
            json!([
                fixed(prism(
                    "left",
                    &[[-3.0, -1.0], [-half(-1.0), -1.0], [-half(1.0), 1.0], [-3.0, 1.0]]
                )),
                fixed(prism(
                    "right",
                    &[[half(-1.0), -1.0], [3.0, -1.0], [3.0, 1.0], [half(1.0), 1.0]]
                )),
                prism(
                    "block",
                    &[[-half(-0.4), -0.4], [half(-0.4), -0.4], [half(0.4), 0.4], [-half(0.4), 0.4]]
                ),
            ]),
        )
    };
    for (mu, want) in [
        (0.5, Verdict::Unstable),
        (0.65, Verdict::Conditional),
        (0.84, Verdict::Conditional),
        (2.0, Verdict::Conditional),
    ] {
        assert_eq!(verdict(&at(mu), Law::Coulomb), want, "μ {mu}");
    }
}

/// Case A25: the mirror image, a keystone, wedges itself by its weight.
#[test]
fn a_keystone_stands_by_its_weight() {
    let s = 30f64.to_radians().tan();
    let half = |z: f64| 1.0 + s * z;
    for mu in [0.0, 0.3, 1e6] {
        let scene = scene(
            mu,
            json!([
                fixed(prism(
                    "left",
                    &[[-3.0, -1.0], [-half(-1.0), -1.0], [-half(1.0), 1.0], [-3.0, 1.0]]
                )),
                fixed(prism(
                    "right",
                    &[[half(-1.0), -1.0], [3.0, -1.0], [3.0, 1.0], [half(1.0), 1.0]]
                )),
                prism(
                    "block",
                    &[[-half(-0.4), -0.4], [half(-0.4), -0.4], [half(0.4), 0.4], [-half(0.4), 0.4]]
                ),
            ]),
        );
        assert_eq!(verdict(&scene, Law::Coulomb), Verdict::Stable, "μ {mu}");
    }
}

#[test]
fn a_sphere_between_two_walls_needs_a_squeeze() {
    let wall = |id: &str, x: f64| fixed(cuboid(id, [1.0, 4.0, 4.0], [x, 0.0, -2.0]));
    let scene = scene(
        0.7,
        json!([wall("left", -1.5), wall("right", 1.5), sphere("sphere", 1.0, [0.0, 0.0, 0.0])]),
    );
    assert_eq!(verdict(&scene, Law::Coulomb), Verdict::Conditional);
}

/// Frame H, shelves, bridge, cubes, wedge blocks (public samples of compas_cra 0.8; friction as
/// there).
#[test]
fn samples_of_coupled_rigid_block_analysis() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/cases/compas/");
    let cases: [(&str, &[&str], f64, Up, Verdict); 7] = [
        ("cra-H", &["0", "1"], 0.84, Up::Z, Verdict::Conditional),
        ("cra-shelf", &["0"], 0.9, Up::Z, Verdict::Conditional),
        ("cra-shelf-stable", &["0"], 0.9, Up::Z, Verdict::Stable),
        ("cra-bridge", &["0", "1"], 0.9, Up::Z, Verdict::Stable),
        ("cra-cubes", &["0"], 0.84, Up::Z, Verdict::Stable),
        ("cra-type-b", &["0", "1"], 0.84, Up::Y, Verdict::Conditional),
        ("cra-type-b", &["0", "1"], 0.84, Up::MinusX, Verdict::Stable),
    ];
    for (name, supports, mu, up, want) in cases {
        for density in [1e-3, 1.0, 1e6] {
            let options = ImportOptions {
                supports: supports.iter().map(|s| s.to_string()).collect(),
                friction: Some(Friction::Coefficient(mu)),
                density: Some(density),
                up: Some(up),
                ..ImportOptions::default()
            };
            let scene = import::import_file(format!("{folder}{name}.json").as_ref(), &options)
                .unwrap()
                .scene;
            assert_eq!(verdict(&scene, Law::Coulomb), want, "{name} up {up:?} density {density}");
        }
    }
}

/// A conditional verdict is refused with the forces of another state, with other rates, or without
/// the base.
#[test]
fn conditional_certificates_reject_corruption() {
    let scene = squeezed(0.5, 2400.0);
    let model = prepare(&scene).unwrap();
    let answer = assess(&model, &Control::default());
    let state = answer.state.clone().unwrap();
    assert_eq!(state.motion, coulomb::StateMotion::Moves);
    let proved = |base: Option<&_>, forces: &_, rates: &[_]| {
        verify(&model, &Claim::Conditional, Evidence { forces, base, rates }).proved()
    };
    assert!(proved(Some(&state.forces), &answer.forces, &answer.rates));
    assert!(!proved(None, &answer.forces, &answer.rates));
    // Balanced forces leave no motion; half of them leave one that does not obey the law: the
    // joints would slip under their limit.
    assert!(!proved(Some(&answer.forces), &answer.forces, &answer.rates));
    let half = answer.forces.iter().map(|f| f.iter().map(|&v| v * 0.5).collect()).collect();
    assert!(!proved(Some(&half), &answer.forces, &answer.rates));
    let mut still = answer.rates.clone();
    still.iter_mut().for_each(|r| r.velocity = nalgebra::Vector3::x());
    assert!(!proved(Some(&state.forces), &answer.forces, &still));
    assert!(!proved(Some(&state.forces), &state.forces, &answer.rates));
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, ..ProptestConfig::default() })]

    /// More friction never lowers the verdict of an unconfined column.
    #[test]
    fn more_friction_never_harms_a_column(shift in -0.3..0.3f64, lean in 0.0..0.4f64, mu in 0.05..1.0f64, more in 0.0..1.0f64) {
        let block = |k: usize| {
            let mut b = cuboid(&format!("b{k}"), [1.0, 1.0, 0.5], [shift * k as f64, 0.0, 0.5 * k as f64]);
            b["support"] = json!(k == 0);
            b
        };
        let tilted = |mu: f64| {
            let mut s = scene(mu, json!([block(0), block(1), block(2)]));
            s.gravity = [lean, 0.0, -1.0];
            let model = prepare(&s).unwrap();
            assess(&model, &Control::default()).verdict
        };
        prop_assert!(!(tilted(mu) == Verdict::Stable && tilted(mu + more) != Verdict::Stable));
    }
}

fn structure(name: &str) -> Scene {
    let path = format!("{}/structures/{name}.json", env!("CARGO_MANIFEST_DIR"));
    voussoir::scene::read_file(path.as_ref()).unwrap().0
}

/// Without sliding a hinge's corner carries all the pressure and the other one may share the shear:
/// that is not lost.
#[test]
fn arches_that_cannot_slide_come_to_rest() {
    for (voussoirs, thickness) in [(27, 0.1359), (27, 0.14375), (19, 0.12), (21, 0.12), (23, 0.12)]
    {
        let arch = json!({ "arch": { "radius": 1.0, "thickness": thickness, "depth": 1.0, "voussoirs": voussoirs } });
        assert_eq!(
            verdict(&ask::template(f64::INFINITY, arch, json!({})), Law::Coulomb),
            Verdict::Stable,
            "{voussoirs} voussoirs, {thickness}"
        );
    }
}

/// Walls of Ferris & Tin-Loi (Int. J. Mech. Sci. 43, 2001): bands of known complementary solutions
/// (cases D02, D03, D05).
#[test]
fn walls_that_slide_without_opening() {
    for (name, low, high) in [
        ("running-bond-wall", 0.5490546221, 0.5685641772),
        ("wall-with-openings", 0.3504801178, 0.3629337261),
        ("wall-with-two-openings", 0.2089209914, 0.2163445799),
    ] {
        let (value, bound, solves) = ask::dry(&structure(name));
        println!("{name}: {value:.7} (associative {bound:.7?}), {solves} convex programs");
        assert!((low..=high).contains(&value), "{name}: {value}");
        assert!(solves <= 30, "{name}: {solves} convex programs");
    }
}

/// Case A26: a block in a slot with a tight roof slides at λ = μ, though dilatancy would wedge it
/// for ever.
#[test]
fn a_block_under_a_roof_slides_at_its_friction() {
    let (value, bound, _) = ask::dry(&structure("block-under-roof"));
    assert!(bound.is_none(), "associative: without limit");
    assert!((value - 0.4).abs() < 1e-5, "{value}");
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, ..ProptestConfig::default() })]

    /// Dry friction carries no more than associative friction; what comes out is proved.
    #[test]
    fn dry_friction_carries_no_more(
        mu in proptest::array::uniform3(0.1..1.2f64), width in 0.5..1.5f64, shift in -0.2..0.2f64, roof in any::<bool>(), push in proptest::array::uniform2(-1.0..1.0f64),
    ) {
        prop_assume!(push[0].hypot(push[1]) > 0.1);
        let mut blocks = vec![ask::ground()];
        for k in 0..3 {
            blocks.push(cuboid(&format!("b{k}"), [width, 1.0, 0.4], [shift * f64::from(k), 0.0, 0.4 * f64::from(k)]));
        }
        if roof {
            blocks.push(fixed(cuboid("wall", [1.0, 4.0, 0.6], [0.5 + 0.5 * width, 0.0, 0.0])));
        }
        let pair = |a: &str, b: &str, mu: f64| json!({ "blocks": [a, b], "friction": mu });
        let scene = ask::scene(0.5, json!(blocks), json!({
            "joints": { "default": { "friction": mu[0] }, "overrides": [pair("b0", "b1", mu[1]), pair("b1", "b2", mu[2])] },
            "loads": { "live": [{ "weight": [push[0], push[1], 0.0] }] },
        }));
        let model = prepare(&scene).unwrap();
        let l = limit(&model, &Control::default());
        prop_assume!(matches!(l.outcome, Outcome::Found | Outcome::Unbounded));
        let d = coulomb::load_factor(&model, &l, &Control::default());
        // About one in a hundred of these does not settle to 1e-6: then there is no number.
        prop_assert!(d.found != coulomb::Found::Undecided || d.value.is_none());
        ask::prove(&scene, &saved::load_factor(&scene, &model, &Limited { dry: Some(d.clone()), ..l.clone().into() }).unwrap());
        prop_assert!(d.value.is_none_or(|v| v <= l.bracket.upper + 1e-6 * l.bracket.upper.abs()), "{:?} above {}", d.value, l.bracket.upper);
    }
}

/// The load factor with dry friction and its associative bound, by forces and a mechanism that obey
/// the law.
fn dry_load_factor(scene: &Scene) -> (f64, f64) {
    let model = prepare(scene).unwrap();
    let control = Control::default();
    let bound = limit(&model, &control);
    assert_eq!(bound.outcome, Outcome::Found, "{}", scene.name);
    let dry = coulomb::load_factor(&model, &bound, &control);
    assert_eq!(
        dry.found,
        coulomb::Found::FixedPoint,
        "{}: natural map {:.1e}",
        scene.name,
        dry.natural_map
    );
    assert!(dry.natural_map <= tolerance::DRY_LAW, "{}: {:.1e}", scene.name, dry.natural_map);
    (dry.value.unwrap(), bound.bracket.upper)
}

/// Arches that slide at their springers as they overturn: held friction limits go round in circles
/// there.
#[test]
fn arches_that_slide_have_a_dry_load_factor() {
    let at = |mu: f64| {
        let text = json!({ "format": "voussoir-scene/1", "name": format!("arch at {mu}"), "joints": { "default": { "friction": mu } },
            "templates": [{ "arch": { "radius": 5.0, "thickness": 0.8, "depth": 1.0, "voussoirs": 100 } }], "loads": { "live": [{ "weight": [1, 0, 0] }] } });
        dry_load_factor(&read_str("test", text.to_string()).unwrap().0)
    };
    let values = [0.5, 0.502, 0.504, 0.506, 0.508, 0.51].map(at);
    for (dry, bound) in values {
        assert!(dry <= bound * (1.0 + 1e-7), "{dry} {bound}");
    }
    assert!(values.windows(2).all(|v| v[0].0 < v[1].0), "more friction bears more: {values:?}");
}

/// Two posts under a lintel, pushed askew: slips turn a little with every iteration on held limits,
/// and it never settled.
#[test]
fn posts_and_a_lintel_pushed_askew_have_a_dry_load_factor() {
    let at = |mirror: f64, length: f64, density: f64| {
        let size = |s: [f64; 3]| s.map(|v| v * length);
        let mut blocks = [
            fixed(cuboid("base", size([6.0, 6.0, 1.0]), size([0.0, 0.0, -1.0]))),
            cuboid("left", size([0.33, 0.764, 0.814]), size([-1.0, 0.0, 0.0])),
            cuboid("right", size([0.658, 0.737, 0.814]), size([1.0, 0.0, 0.0])),
            cuboid("lintel", size([2.4, 0.6, 0.4]), size([0.0, mirror * 0.068, 0.814])),
        ];
        blocks.iter_mut().for_each(|b| b["density"] = json!(density));
        let text = json!({ "format": "voussoir-scene/1", "name": format!("askew {mirror} {length} {density}"), "joints": { "default": { "friction": 0.746 } },
            "blocks": blocks, "loads": { "live": [{ "weight": [0.541, mirror * 0.841, 0.3] }] } });
        dry_load_factor(&read_str("test", text.to_string()).unwrap().0)
    };
    let (dry, bound) = at(1.0, 1.0, 2400.0);
    assert!(dry < bound - 1e-6, "it slides, which dilatancy would have resisted: {dry} {bound}");
    for (other, _) in [at(-1.0, 1.0, 2400.0), at(1.0, 1e3, 1.0), at(1.0, 1e-3, 2400.0)] {
        assert!((other - dry).abs() < 1e-6, "{other} {dry}");
    }
}
