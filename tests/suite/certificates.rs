//! Certificates: honest ones are accepted, corrupted and forged ones are not; problems built
//! backwards from a known answer.

use crate::ask::{cuboid, fixed, ground, model, push, scene, template};
use nalgebra::Vector3;
use proptest::prelude::*;
use serde_json::json;
use voussoir::{
    analysis::{Control, Law, Outcome, assess, limit},
    assembly::Wrench,
    interface::Model,
    program::{self, LiveLoad, Statics, StaticsOptions, Unknowns},
    scene::Scene,
    solve::{self, Settings},
    verdict::{
        Evidence, Forces, Rate, Verdict, certificate,
        claim::{Claim, verify},
        no_forces,
    },
};

type V = Vector3<f64>;

fn arch(thickness: f64) -> Scene {
    template(
        0.8,
        json!({ "arch": { "radius": 1.0, "thickness": thickness, "depth": 1.0, "voussoirs": 16 } }),
        push([1.0, 0.0, 0.0]),
    )
}

fn zeros(m: &Model) -> Forces {
    no_forces(&m.interfaces)
}

fn proved(m: &Model, claim: Claim, forces: &Forces, base: Option<&Forces>, rates: &[Rate]) -> bool {
    verify(m, &claim, Evidence { forces, base, rates }).proved()
}

fn scaled(rates: &[Rate], s: f64) -> Vec<Rate> {
    rates.iter().map(|r| Rate { velocity: r.velocity * s, spin: r.spin * s }).collect()
}

fn associative() -> Control {
    Control { law: Law::Associative, ..Control::default() }
}

/// The upper end that is claimed lies so far beyond the proved one that the last bits of another machine,
/// whose sines are others, do not refute it; no further.
#[test]
fn an_upper_end_holds_on_another_machine() {
    let m = model(&arch(0.2));
    let answer = limit(&m, &Control::default());
    let (lower, upper) = (answer.bracket.lower, answer.bracket.upper);
    let holds = |missed: f64| {
        let upper = upper * (1.0 - missed);
        let claim = Claim::LoadFactor { value: lower, lower: lower.min(upper), upper };
        proved(&m, claim, &answer.forces, answer.base.as_ref().map(|b| &b.1), &answer.rates)
    };
    assert!(holds(0.0) && holds(5e-14));
    assert!(!holds(2e-13));
}

#[test]
fn a_stable_claim_needs_forces_that_balance_inside_their_cones() {
    let m = model(&arch(0.15));
    let a = assess(&m, &associative());
    assert_eq!(a.verdict, Verdict::Stable);
    assert!(proved(&m, Claim::Stable, &a.forces, None, &a.rates));
    assert!(!proved(&m, Claim::Stable, &zeros(&m), None, &a.rates));
    for (k, change) in [
        (0, &(|v: V| v * (1.0 + 1e-6)) as &dyn Fn(V) -> V),
        (3, &|v: V| -v),
        (5, &|v: V| v + V::new(0.0, v.norm(), 0.0)),
        (7, &|_| V::new(f64::NAN, 0.0, 0.0)),
        (7, &|_| V::new(f64::INFINITY, 0.0, 0.0)),
    ] {
        let mut forces = a.forces.clone();
        let point = (0..4)
            .max_by(|&i, &j| forces[k][i].force.norm().total_cmp(&forces[k][j].force.norm()))
            .unwrap();
        forces[k][point].force = change(forces[k][point].force);
        assert!(!proved(&m, Claim::Stable, &forces, None, &a.rates), "force {k}");
    }
    // The forces of one arch do not hold another.
    let heavier = {
        let mut s = arch(0.15);
        s.loads.dead =
            serde_json::from_value(json!([{ "block": "v08", "force": [0, 0, -1e-3] }])).unwrap();
        model(&s)
    };
    assert!(!proved(&heavier, Claim::Stable, &a.forces, None, &a.rates));
    // What stands cannot be claimed to fall, whatever rates are brought.
    for rates in [a.rates.clone(), vec![Rate::zero(); a.rates.len()]] {
        assert!(!proved(&m, Claim::Unstable, &a.forces, None, &rates));
    }
    let falling: Vec<Rate> = m
        .assembly
        .blocks
        .iter()
        .map(|b| Rate { velocity: if b.support { V::zeros() } else { -V::z() }, spin: V::zeros() })
        .collect();
    assert!(!proved(&m, Claim::Unstable, &zeros(&m), None, &falling));
}

#[test]
fn an_unstable_claim_needs_an_admissible_mechanism_that_gains_power() {
    let m = model(&arch(0.09));
    let a = assess(&m, &associative());
    assert_eq!(a.verdict, Verdict::Unstable);
    for s in [1.0, 1e-6, 1e6] {
        assert!(proved(&m, Claim::Unstable, &a.forces, None, &scaled(&a.rates, s)), "scale {s}");
    }
    assert!(!proved(&m, Claim::Unstable, &a.forces, None, &scaled(&a.rates, -1.0)));
    assert!(!proved(&m, Claim::Unstable, &a.forces, None, &scaled(&a.rates, 0.0)));
    assert!(!proved(&m, Claim::Unstable, &a.forces, None, &scaled(&a.rates, f64::NAN)));
    for block in [0, 4, 7] {
        let mut rates = a.rates.clone();
        rates[block].velocity *= 1.01;
        assert!(!proved(&m, Claim::Unstable, &a.forces, None, &rates), "block {block}");
    }
    assert!(!proved(&m, Claim::Stable, &a.forces, None, &a.rates));
}

/// With little friction a squeezed block needs large forces: falling straight down closes no joint
/// by much, and is no proof.
#[test]
fn large_forces_are_not_hidden_behind_a_small_inadmissibility() {
    for mu in [0.3, 0.01, 1e-4] {
        let posts = json!([
            fixed(cuboid("left", [0.2, 1.0, 2.4], [-1.0, 0.0, -1.0])),
            fixed(cuboid("right", [0.2, 1.0, 2.4], [1.0, 0.0, -1.0])),
            cuboid("bar", [1.8, 1.0, 0.8], [0.0, 0.0, 0.2]),
            // A block that slides freely, to make everything else look slow.
            fixed(cuboid("table", [9.0, 9.0, 1.0], [0.0, 20.0, -1.0])),
            cuboid("fast", [1.0, 1.0, 1.0], [0.0, 20.0, 0.0]),
        ]);
        let more = json!({ "joints": { "default": { "friction": mu }, "overrides": [{ "blocks": ["table", "fast"], "friction": 0.0 }] } });
        let m = model(&scene(mu, posts, more));
        let mut rates = vec![Rate::zero(); m.assembly.blocks.len()];
        rates[m.assembly.find("bar").unwrap()].velocity = -V::z();
        for speed in [0.0, 1e3, 1e6] {
            rates[m.assembly.find("fast").unwrap()].velocity = V::x() * speed;
            assert!(
                !proved(&m, Claim::Unstable, &zeros(&m), None, &rates),
                "μ {mu}, speed {speed}"
            );
        }
    }
}

#[test]
fn load_factors_need_both_sides() {
    let m = model(&arch(0.15));
    let l = limit(&m, &Control::default());
    assert_eq!(l.outcome, Outcome::Found);
    let claim = |value: f64, lower: f64, upper: f64| Claim::LoadFactor { value, lower, upper };
    let (v, b) = (l.found().unwrap(), l.bracket);
    assert!(proved(&m, claim(v, b.lower, b.upper), &l.forces, None, &l.rates));
    for wrong in [
        claim(v + 1e-5, b.lower + 1e-5, b.upper + 1e-5),
        claim(v - 1e-3, b.lower - 1e-3, b.upper - 1e-3),
        claim(v, b.upper + 1e-3, b.lower - 1e-3),
        claim(f64::NAN, b.lower, b.upper),
        claim(v, f64::NAN, f64::NAN),
        claim(f64::INFINITY, b.lower, f64::INFINITY),
    ] {
        assert!(!proved(&m, wrong, &l.forces, None, &l.rates), "{wrong:?}");
    }
    let good = claim(v, b.lower, b.upper);
    assert!(!proved(&m, good, &zeros(&m), None, &l.rates));
    assert!(!proved(&m, good, &l.forces, None, &scaled(&l.rates, 0.0)));
    assert!(!proved(&m, good, &l.forces, None, &scaled(&l.rates, -1.0)));
    assert!(!proved(&m, Claim::Unbounded { standing: 0.0 }, &l.forces, Some(&l.forces), &l.rates));
    assert!(!proved(&m, Claim::Impossible, &l.forces, None, &l.rates));
}

/// A load factor that is too low, with honest forces and a mechanism that closes joints which those
/// forces leave unloaded.
#[test]
fn a_mechanism_may_not_close_unloaded_joints() {
    let m = model(&scene(
        0.5,
        json!([ground(), cuboid("block", [1.0, 1.0, 1.0], [0.0; 3])]),
        push([1.0, 0.0, 0.0]),
    ));
    let at = |x: f64| {
        let mut half = m.clone();
        half.assembly.dead[1].force.x += x * m.assembly.weight(1);
        assess(&half, &associative())
    };
    let a = at(0.2);
    assert_eq!(a.verdict, Verdict::Stable);
    // Turning about the middle line of the base: the lee edge sinks in. Its power ratio says λ =
    // 0.2 for this axis.
    let lever = 0.1;
    let mut rates = vec![Rate::zero(); 2];
    rates[1] = Rate { spin: V::y(), velocity: V::y().cross(&V::new(-lever, 0.0, 0.5)) };
    let mut forces = zeros(&m);
    for (f, p) in forces[0].iter_mut().zip(&m.interfaces.list[0].points) {
        // All on the windward and lee corners in the proportion that balances at λ = 0.2.
        let share = if p.x > 0.0 { 0.3 } else { 0.2 };
        f.force = m.interfaces.list[0].frame.n * (share * m.assembly.weight(1))
            - V::x() * (0.2 * share * m.assembly.weight(1));
    }
    let s = certificate::statics(&m, &forces, 0.2);
    assert!(s.balanced, "{}", s.equilibrium_error);
    assert!(!proved(
        &m,
        Claim::LoadFactor { value: 0.2, lower: 0.2, upper: 0.2 },
        &forces,
        None,
        &rates
    ));
}

#[test]
fn unbounded_and_impossible_are_proved_and_not_forged() {
    // A26: a block in a slot with a tight roof, pushed down on: the push wedges nothing away.
    let roof = |live: serde_json::Value| {
        scene(
            0.4,
            json!([
                ground(),
                cuboid("block", [1.0, 1.0, 1.0], [0.0; 3]),
                fixed(cuboid("roof", [4.0, 4.0, 1.0], [0.0, 0.0, 1.0]))
            ]),
            json!({ "loads": { "live": [live] } }),
        )
    };
    let m = model(&roof(json!({ "weight": [1, 0, 0] })));
    let l = limit(&m, &Control::default());
    assert_eq!(l.outcome, Outcome::Unbounded);
    let (standing, base) = l.base.clone().unwrap();
    assert!(proved(&m, Claim::Unbounded { standing }, &l.forces, Some(&base), &l.rates));
    assert!(!proved(&m, Claim::Unbounded { standing }, &zeros(&m), Some(&base), &l.rates));
    assert!(!proved(&m, Claim::Unbounded { standing }, &l.forces, None, &l.rates));
    assert!(!proved(
        &m,
        Claim::Unbounded { standing: standing + 1.0 },
        &l.forces,
        Some(&base),
        &l.rates
    ));
    assert!(!proved(&m, Claim::Impossible, &l.forces, None, &l.rates));

    // A block beside its ground, pushed along an axis that cannot hold it up.
    let m = model(&scene(
        0.4,
        json!([
            ground(),
            cuboid("block", [1.0, 1.0, 1.0], [20.4, 0.0, 0.0]),
            cuboid("other", [1.0, 1.0, 1.0], [0.0; 3])
        ]),
        push([0.0, 1.0, 0.0]),
    ));
    let l = limit(&m, &Control::default());
    assert_eq!(l.outcome, Outcome::Impossible);
    assert!(proved(&m, Claim::Impossible, &l.forces, None, &l.rates));
    assert!(!proved(&m, Claim::Impossible, &l.forces, None, &scaled(&l.rates, -1.0)));
    assert!(!proved(&m, Claim::Impossible, &l.forces, None, &scaled(&l.rates, 0.0)));
    // Without a live load nothing is unbounded and nothing impossible.
    let still = model(&scene(
        0.4,
        json!([ground(), cuboid("block", [1.0, 1.0, 1.0], [0.0; 3])]),
        json!({}),
    ));
    let a = assess(&still, &associative());
    assert!(!proved(
        &still,
        Claim::Unbounded { standing: 0.0 },
        &zeros(&still),
        Some(&a.forces),
        &a.rates
    ));
    assert!(!proved(&still, Claim::Impossible, &a.forces, None, &a.rates));
}

#[test]
fn forces_and_rates_forms_of_the_programs_agree() {
    let wall = template(
        0.6,
        json!({ "wall": { "size": [1, 0.5, 0.4], "courses": 5, "blocks": 5, "base": "course" } }),
        push([0.8, 0.6, 0.0]),
    );
    for (name, s) in [("arch", arch(0.15)), ("thin arch", arch(0.1)), ("wall", wall)] {
        let m = model(&s);
        let statics = Statics::new(
            &m,
            StaticsOptions { keep_all: false, live: true, ..StaticsOptions::default() },
        );
        let settings = Settings { tolerance: 1e-11, ..Settings::default() };
        let value = |p: &program::ConicProgram| {
            let solution = solve::solve(p, &settings);
            p.objective.iter().zip(&solution.x).map(|(c, x)| c * x).sum::<f64>()
        };
        let [f, r] = [Unknowns::Forces, Unknowns::Rates]
            .map(|u| value(&program::equilibrium_error(&statics, LiveLoad::Absent, u).0));
        assert!((f + r).abs() < 1e-9, "{name}: least equilibrium error {f} and {}", -r);
        if name != "thin arch" {
            let [f, r] = [Unknowns::Forces, Unknowns::Rates]
                .map(|u| value(&program::load_factor(&statics, 1.0, u).0));
            assert!((f + r).abs() < 1e-8, "{name}: load factor {} and {r}", -f);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 20, ..ProptestConfig::default() })]

    /// Any forces inside the cones, with the dead load that they balance, make a stable scene.
    #[test]
    fn forces_first_then_the_load(seed in proptest::collection::vec((0.0..3.0f64, -1.0..1.0f64, -1.0..1.0f64), 40)) {
        let mut m = model(&arch(0.2));
        let mut numbers = seed.iter().cycle();
        let mut forces = zeros(&m);
        for (face, forces) in m.interfaces.list.iter().zip(&mut forces) {
            for f in forces.iter_mut() {
                let (n, a, b) = *numbers.next().unwrap();
                let t = (face.frame.t1 * a + face.frame.t2 * b) * (0.7 * 0.8 * n);
                f.force = face.frame.n * n + t;
            }
        }
        m.assembly.dead.iter_mut().for_each(|w| *w = Wrench::zero());
        let left = certificate::statics(&m, &forces, 0.0).residuals;
        for (dead, left) in m.assembly.dead.iter_mut().zip(left) {
            *dead = Wrench { force: -left.force, moment: -left.moment };
        }
        prop_assert!(proved(&m, Claim::Stable, &forces, None, &[]));
        let a = assess(&m, &associative());
        prop_assert_eq!(a.verdict, Verdict::Stable);
        prop_assert!(proved(&m, Claim::Stable, &a.forces, None, &a.rates));
    }
}

/// Half of the load factor, with honest forces at half and the true mechanism: a true bracket, but
/// not the limit.
#[test]
fn a_load_factor_in_a_wide_bracket_is_not_found() {
    let m = model(&arch(0.15));
    let l = limit(&m, &Control::default());
    let half = 0.5 * l.found().unwrap();
    let mut at_half = m.clone();
    for i in 0..at_half.assembly.blocks.len() {
        let live = at_half.assembly.live[i];
        at_half.assembly.dead[i] += Wrench { force: live.force * half, moment: live.moment * half };
    }
    let a = assess(&at_half, &associative());
    assert_eq!(a.verdict, Verdict::Stable);
    for (lower, upper) in
        [(half, l.bracket.upper), (half, f64::INFINITY), (f64::NEG_INFINITY, f64::INFINITY)]
    {
        let got = verify(
            &m,
            &Claim::LoadFactor { value: half, lower, upper },
            Evidence::new(&a.forces, &l.rates),
        );
        println!("{lower} {upper}: {got:?}");
        assert!(!got.proved(), "[{lower}, {upper}] passes for {half}; the limit is {:?}", l.value);
    }
}

/// Ice on ice, squeezed between two posts, on ground that slopes by 1e-4 along the posts: it
/// slides, however it is squeezed.
#[test]
fn a_huge_squeeze_excuses_no_equilibrium_error() {
    let post = |id: &str, x: f64| fixed(cuboid(id, [1.0, 1.0, 1.0], [x, 0.0, 0.0]));
    let mut s = scene(
        0.0,
        json!([
            ground(),
            cuboid("block", [1.0, 1.0, 1.0], [0.0; 3]),
            post("left", -1.0),
            post("right", 1.0)
        ]),
        json!({}),
    );
    s.gravity = [0.0, 1e-4, -1.0];
    let m = model(&s);
    let a = assess(&m, &associative());
    println!("{:?} {:?} threshold {:.1e}", a.verdict, a.equilibrium_error, a.threshold);
    assert_eq!(a.verdict, Verdict::Unstable);
    let (block, w) = (m.assembly.find("block").unwrap(), m.assembly.weight(1));
    for squeeze in [1e6, 1e9, 1e10, 1e11, 1e12, 1e14] {
        let mut forces = zeros(&m);
        for (face, forces) in m.interfaces.list.iter().zip(&mut forces) {
            let share = if face.frame.n.x.abs() > 0.5 { squeeze } else { 1.0 } * w
                / face.points.len() as f64;
            forces.iter_mut().for_each(|f| f.force = face.frame.n * share);
            assert!(face.a == block || face.b == block);
        }
        let got = verify(&m, &Claim::Stable, Evidence::new(&forces, &a.rates));
        println!("squeeze {squeeze:.0e}: {got:?}");
        assert!(
            !got.proved(),
            "squeezed by {squeeze:.0e} weights an unstable block is proved stable"
        );
    }
}
