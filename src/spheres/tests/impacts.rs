//! One or two bodies, beside what mechanics says of them.

use super::*;

/// A speed of impact at which overlaps are some thousandths of the radius, m/s.
const SLOW: f64 = 0.02;

/// A ball that comes down on a floor with this velocity, after it has left again.
fn bounced(restitution: f64, friction: f64, velocity: [f64; 3]) -> World {
    let start = setup(vec![ball([0.0, 0.0, 0.51 * D], velocity)], restitution);
    let mut world = world(Setup { walls: vec![floor(friction, 0.0)], ..start });
    let mut steps = 0;
    while world.velocities()[0].z <= 0.0 || world.contacts().count() > 0 {
        world.run(10).unwrap();
        steps += 10;
        assert!(steps < 100_000);
    }
    world
}

#[test]
fn a_head_on_impact_has_the_restitution_that_was_asked_for() {
    for e in [0.2, 0.4, 0.6, 0.8, 0.95, 1.0] {
        for speed in [0.05, 0.5] {
            let after = bounced(e, 0.5, [0.0, 0.0, -speed]).velocities()[0].z;
            near(after, e * speed, 2e-3);
            let a = ball([-0.51 * D, 0.0, 0.0], [0.5 * speed, 0.0, 0.0]);
            let b = ball([0.51 * D, 0.0, 0.0], [-0.5 * speed, 0.0, 0.0]);
            let mut pair = world(setup(vec![a, b], e));
            pair.run(20_000).unwrap();
            assert_eq!(pair.contacts().count(), 0);
            near((pair.velocities()[1] - pair.velocities()[0]).x, e * speed, 2e-3);
        }
    }
}

#[test]
fn what_no_dashpot_brings_about_is_told() {
    let law = Law::new(&material(0.0));
    assert!(law.restitution > 0.0 && law.restitution < 0.2, "{}", law.restitution);
    near(bounced(0.0, 0.0, [0.0, 0.0, -0.3]).velocities()[0].z, 0.3 * law.restitution, 1e-2);
}

/// Above the angle at which it slides through the whole impact a ball loses μ (1 + e) v_n of its
/// speed, and gets 5/2 of that as the speed of its surface (Foerster, Louge, Chang & Allia 1994).
#[test]
fn a_ball_that_slides_through_an_impact_obeys_coulomb() {
    for (e, mu, across) in [(1.0, 0.1, 1.0), (0.8, 0.1, 0.8), (0.6, 0.3, 2.0)] {
        let after = bounced(e, mu, [across * SLOW, 0.0, -SLOW]);
        near(after.velocities()[0].x, (across - mu * (1.0 + e)) * SLOW, 2e-3);
        // The arm is shorter than the radius by the overlap.
        near(after.spins()[0].y * 0.5 * D, 2.5 * mu * (1.0 + e) * SLOW, 5e-3);
        near(after.velocities()[0].z, e * SLOW, 2e-3);
    }
}

/// Below it the spring of the contact throws the surface back: the tangential restitution of Maw,
/// Barber and Fawcett (1976) is positive for nearly normal impacts of solid spheres, and its velocity
/// is reversed at intermediate ones, with ψ = 2 (1 − ν) tan θ / (μ (2 − ν)).
#[test]
fn a_ball_that_sticks_in_an_impact_is_thrown_back() {
    let mu = 0.3;
    let surface = |psi: f64| {
        let across = psi * mu * (2.0 - 0.3) / (2.0 * (1.0 - 0.3));
        let after = bounced(1.0, mu, [across * SLOW, 0.0, -SLOW]);
        let energy = after.velocities()[0].norm_squared()
            + 0.4 * (0.5 * D * after.spins()[0].norm()).powi(2);
        assert!(energy <= (across * across + 1.0) * SLOW * SLOW * (1.0 + 1e-6));
        (after.velocities()[0].x - after.spins()[0].y * 0.5 * D) / (across * SLOW)
    };
    assert!(surface(2.0) < -0.2, "{}", surface(2.0));
    // Sliding through: ψ > 4 χ − 1 with χ = 7 (1 − ν) / (2 (2 − ν)) = 1.44.
    let sliding = |psi: f64| 1.0 - 4.0 * 1.4412 / psi;
    near(1.0 - surface(6.0), 1.0 - sliding(6.0), 5e-3);
    near(1.0 - surface(9.0), 1.0 - sliding(9.0), 5e-3);
}

/// A ball that is thrown along a floor without spin slides until it rolls at 5/7 of its speed.
#[test]
fn a_ball_that_slides_ends_up_rolling() {
    let (weight, v) = (ball([0.0; 3], [0.0; 3]).mass * G, 0.2);
    let law = Law::new(&material(0.5));
    // On a wall R* is twice that of two equal balls.
    let sunk = law.overlap(2.0 * D, weight);
    let start = setup(vec![ball([0.0, 0.0, 0.5 * D - sunk], [v, 0.0, 0.0])], 0.5);
    let gravity = Vector3::new(0.0, 0.0, -G);
    let mut ball = world(Setup { walls: vec![floor(0.3, 0.0)], gravity, ..start });
    ball.run(60_000).unwrap();
    near(ball.velocities()[0].x, 5.0 / 7.0 * v, 1e-3);
    near(ball.spins()[0].y * 0.5 * D, 5.0 / 7.0 * v, 1e-3);
    near(0.5 * D - ball.places()[0].z, sunk, 1e-3);
}

/// With a rolling arm c a ball rests on a slope whose tangent is less than c / R, and rolls down a
/// steeper one at 5/7 g (sin θ − c/R cos θ).
#[test]
fn rolling_resistance_holds_a_ball_up_to_its_arm() {
    let arm = 0.1 * 0.5 * D;
    let speed = |slope: f64| {
        let (sin, cos) = slope.atan().sin_cos();
        let law = Law::new(&material(0.3));
        let sunk = law.overlap(2.0 * D, ball([0.0; 3], [0.0; 3]).mass * G * cos);
        let start = setup(vec![ball([0.0, 0.0, 0.5 * D - sunk], [0.0; 3])], 0.3);
        let gravity = Vector3::new(sin, 0.0, -cos) * G;
        let mut ball = world(Setup { walls: vec![floor(0.6, arm)], gravity, ..start });
        ball.run(200_000).unwrap();
        ball.velocities()[0].x
    };
    assert!(speed(0.08).abs() < 1e-6, "{}", speed(0.08));
    let (sin, cos) = 0.2_f64.atan().sin_cos();
    near(speed(0.2), 5.0 / 7.0 * G * (sin - 0.1 * cos) * 0.4, 5e-3);
}

/// Two balls one on the other: the slow mode of two springs k = 3/2 f / δ (Hertz, linearised).
#[test]
fn a_stack_oscillates_as_its_linearised_springs() {
    let one = ball([0.0; 3], [0.0; 3]);
    let (law, weight) = (Law::new(&material(1.0)), one.mass * G);
    let sunk = [law.overlap(2.0 * D, 2.0 * weight), law.overlap(D, weight)];
    let k = [1.5 * 2.0 * weight / sunk[0], 1.5 * weight / sunk[1]];
    let (a, b, c) = (k[0] + k[1], -k[1], k[1]);
    let square = 0.5 * (a + c) - (0.25 * (a - c).powi(2) + b * b).sqrt();
    let omega = (square / one.mass).sqrt();
    // The mode: (a − m ω²) u + b w = 0.
    let (u, w) = (-b, a - square);
    let low = 0.5 * D - sunk[0];
    let high = low + D - sunk[1];
    let push = 1e-3 * sunk[1] / w;
    let grains = vec![
        ball([0.0, 0.0, low + push * u], [0.0; 3]),
        ball([0.0, 0.0, high + push * w], [0.0; 3]),
    ];
    let gravity = Vector3::new(0.0, 0.0, -G);
    let start = setup(grains, 1.0);
    let mut stack = world(Setup { walls: vec![floor(0.0, 0.0)], gravity, ..start });
    let (mut crossings, mut before, mut steps) = (Vec::new(), push * w, 0);
    while crossings.len() < 21 {
        stack.run(1).unwrap();
        steps += 1;
        let now = stack.places()[1].z - high;
        if before > 0.0 && now <= 0.0 {
            crossings.push(f64::from(steps) - now / (now - before));
        }
        before = now;
        assert!(steps < 1_000_000);
    }
    let period = (crossings[20] - crossings[0]) / 20.0 * 2e-6;
    near(std::f64::consts::TAU / period, omega, 2e-4);
}

/// No closed path of a contact gains energy, whatever its overlap does meanwhile.
#[test]
fn no_cycle_of_a_contact_gains_energy() {
    use crate::law::{Memory, Pair};
    let law = Law::new(&material(1.0));
    let friction = Friction { coefficient: 0.4, arm: 0.0 };
    for seed in 0..20 {
        let phase = f64::from(seed);
        let mut memory = Memory::default();
        let (mut work, mut most) = (0.0, 0.0_f64);
        let steps = 20_000;
        let path = |k: i32| {
            let t = f64::from(k) / f64::from(steps) * std::f64::consts::TAU;
            let overlap = D * (2e-3 + 1e-3 * (3.0 * t + phase).sin());
            let slide = D * 2e-3 * (2.0 * t + 1.7 * phase).sin();
            (overlap, slide)
        };
        // The second round begins as it ends.
        for k in 0..2 * steps {
            let ((overlap, slide), (next, on)) = (path(k), path(k + 1));
            let pair = Pair {
                normal: Vector3::x(),
                overlap: 0.5 * (overlap + next),
                radius: 0.25 * D,
                mass: 1e-3,
                velocity: Vector3::new(overlap - next, on - slide, 0.0),
                rolling: Vector3::zeros(),
                turning: Vector3::zeros(),
                inertia: 1.0,
            };
            let effort = law.step(&pair, &friction, 1.0, &mut memory);
            if k >= steps {
                work += effort.force.dot(&pair.velocity);
                most = most.max(work.abs());
            }
        }
        assert!(work < 1e-4 * most, "{seed}: {work} {most}");
    }
}
