//! Many grains: what is conserved, and what changes nothing.

use super::*;
use crate::Drive;
use std::f64::consts::PI;

/// Grains of two sizes on a loose lattice with velocities that follow no pattern.
fn gas(n: usize, speed: f64) -> (Vec<Grain>, Cell) {
    let side = (n as f64).cbrt().ceil() as usize;
    let grain = |k: usize| {
        let noise = |s: f64| ((k as f64 + 1.0) * s).sin();
        let at = [k % side, k / side % side, k / side / side].map(|c| (c as f64 + 0.5) * 1.2 * D);
        let radius = 0.5 * D * if k.is_multiple_of(3) { 0.8 } else { 1.1 };
        Grain {
            at: at.into(),
            radius,
            mass: DENSITY * 4.0 / 3.0 * PI * radius.powi(3),
            velocity: Vector3::new(noise(12.9898), noise(78.233), noise(37.719)) * speed,
            spin: Vector3::zeros(),
        }
    };
    ((0..n).map(grain).collect(), Cell::new([side as f64 * 1.2 * D; 3], [true; 3]))
}

fn gas_setup(n: usize, speed: f64, restitution: f64, friction: f64) -> Setup {
    let (grains, cell) = gas(n, speed);
    let friction = Friction { coefficient: friction, arm: 0.0 };
    Setup { cell, friction, step: 1e-5, ..setup(grains, restitution) }
}

/// Kinetic energy with spins, and the normal energy 2/5 f δ of all overlaps, found anew.
fn energy(world: &World, law: &Law) -> f64 {
    let (x, r) = (world.places(), world.radii());
    let mass = |i: usize| DENSITY * 4.0 / 3.0 * PI * r[i].powi(3);
    let moving: f64 = (0..x.len())
        .map(|i| {
            let spin = 0.4 * r[i] * r[i] * world.spins()[i].norm_squared();
            0.5 * mass(i) * (world.velocities()[i].norm_squared() + spin)
        })
        .sum();
    let lengths = Vector3::from(world.cell().lengths());
    let mut stored = 0.0;
    for i in 0..x.len() {
        for j in 0..i {
            let way = x[i] - x[j];
            let way = way - way.component_div(&lengths).map(f64::round).component_mul(&lengths);
            let overlap = r[i] + r[j] - way.norm();
            if overlap > 0.0 {
                let radius = r[i] * r[j] / (r[i] + r[j]);
                let stiffness = 2.0 / 3.0 * law.normal * radius.sqrt();
                stored += 0.4 * stiffness * overlap.powf(2.5);
            }
        }
    }
    moving + stored
}

fn momentum(world: &World) -> (Vector3<f64>, f64) {
    let mass = |i: usize| DENSITY * 4.0 / 3.0 * PI * world.radii()[i].powi(3);
    let parts = world.velocities().iter().enumerate().map(|(i, v)| v * mass(i));
    parts.fold((Vector3::zeros(), 0.0), |(sum, size), p| (sum + p, size + p.norm()))
}

#[test]
fn without_friction_and_damping_energy_is_kept_to_second_order() {
    let drift = |step: f64| {
        let start = gas_setup(64, 1.0, 1.0, 0.0);
        let law = start.law;
        let mut world = world(Setup { step, ..start });
        let before = energy(&world, &law);
        let mut worst = 0.0_f64;
        for _ in 0..40 {
            world.run((1e-3 / step).round() as usize).unwrap();
            worst = worst.max((energy(&world, &law) / before - 1.0).abs());
        }
        worst
    };
    let (coarse, fine) = (drift(2e-5), drift(5e-6));
    println!("energy drifts by {coarse:.1e}, in steps of a quarter {fine:.1e}");
    assert!(coarse < 1e-2 && fine < coarse / 8.0, "{coarse} {fine}");
}

#[test]
fn with_friction_and_damping_energy_never_grows_and_momentum_is_kept() {
    let start = gas_setup(216, 0.5, 0.7, 0.5);
    let law = start.law;
    let mut world = world(start);
    let (mut before, whole) = (energy(&world, &law), momentum(&world).0);
    for _ in 0..50 {
        world.run(200).unwrap();
        let now = energy(&world, &law);
        assert!(now <= before * (1.0 + 1e-3), "{now} after {before}");
        before = now.min(before);
        let (sum, size) = momentum(&world);
        assert!((sum - whole).norm() < 1e-12 * size.max(whole.norm()));
    }
    assert!(world.contacts().count() > 0);
}

/// A cell that is sheared and pressed.
fn driven(threads: usize, shift: Vector3<f64>, steps: usize) -> World {
    let mut start = gas_setup(1000, 0.2, 0.5, 0.5);
    start.grains.iter_mut().for_each(|g| g.at += shift);
    start.friction.arm = 0.02 * D;
    let mut world = world(Setup { threads, ..start });
    let impedance = (100.0 * DENSITY * 1e5_f64).sqrt();
    world.drive(Drive { pressure: [None, None, Some(1e3)], impedance, shear: 50.0 });
    world.run(steps).unwrap();
    world
}

#[test]
fn threads_change_no_bit() {
    let one = driven(1, Vector3::zeros(), 2000);
    for threads in [2, 3] {
        let more = driven(threads, Vector3::zeros(), 2000);
        assert!(one.places() == more.places() && one.spins() == more.spins());
        assert_eq!(one.stress(), more.stress());
    }
}

/// Where the seams of a cell lie is nobody's business: all grains moved by the same way do the same.
#[test]
fn seams_of_a_cell_change_nothing() {
    let here = driven(1, Vector3::zeros(), 1500);
    let there = driven(1, Vector3::new(0.031, -0.017, 0.044), 1500);
    assert!(here.contacts().count() > 100);
    // Chaos multiplies rounding; a seam that was wrong would show at once and everywhere.
    for (a, b) in here.velocities().iter().zip(there.velocities()) {
        assert!((a - b).norm() < 1e-6, "{a} {b}");
    }
    let (a, b) = (here.stress(), there.stress());
    assert!((a - b).norm() < 1e-6 * a.norm());
}

#[test]
fn a_cell_comes_under_its_pressure_and_one_that_is_too_narrow_is_refused() {
    let start = gas_setup(343, 0.1, 0.3, 0.3);
    let mut world = world(start.clone());
    let impedance = (DENSITY * 1e6_f64).sqrt();
    world.drive(Drive { pressure: [Some(2e3); 3], impedance, shear: 0.0 });
    world.run(40_000).unwrap();
    let stress = world.stress();
    for k in 0..3 {
        near(stress[(k, k)], 2e3, 1e-2);
    }
    let narrow = Setup {
        grains: start.grains[..4].to_vec(),
        cell: Cell::new([2.9 * D; 3], [true; 3]),
        ..start
    };
    assert!(super::world(narrow).run(1).is_err());
}
