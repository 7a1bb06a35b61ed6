//! Exact motions, conserved quantities and invariances.

mod cells;
mod impacts;

use crate::{Cell, Grain, Law, Material, Wall, World, law::Friction, world::Setup};
use nalgebra::{Isometry3, Vector3};

/// Diameter, m, and density, kg/m³.
const D: f64 = 0.01;
const DENSITY: f64 = 2500.0;
const G: f64 = 9.81;

fn material(restitution: f64) -> Material {
    Material { young: 1e7, poisson: 0.3, restitution }
}

fn ball(at: [f64; 3], velocity: [f64; 3]) -> Grain {
    let radius = 0.5 * D;
    Grain {
        at: at.into(),
        radius,
        mass: DENSITY * 4.0 / 3.0 * std::f64::consts::PI * radius.powi(3),
        velocity: velocity.into(),
        spin: Vector3::zeros(),
    }
}

/// A floor whose top is z = 0.
fn floor(friction: f64, arm: f64) -> Wall {
    Wall {
        pose: Isometry3::translation(0.0, 0.0, -1.0),
        half: Vector3::new(10.0, 10.0, 1.0),
        velocity: Vector3::zeros(),
        friction: Friction { coefficient: friction, arm },
    }
}

fn setup(grains: Vec<Grain>, restitution: f64) -> Setup {
    Setup {
        grains,
        walls: Vec::new(),
        cell: Cell::new([1.0; 3], [false; 3]),
        law: Law::new(&material(restitution)),
        friction: Friction { coefficient: 0.0, arm: 0.0 },
        gravity: Vector3::zeros(),
        step: 2e-6,
        threads: 1,
    }
}

fn world(setup: Setup) -> World {
    World::new(setup).unwrap()
}

fn near(got: f64, want: f64, relative: f64) {
    assert!((got - want).abs() <= relative * want.abs(), "{got}, wanted {want}");
}
