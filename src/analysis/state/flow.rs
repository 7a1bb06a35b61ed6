//! Many contacts in space: the state by pseudo-transient continuation (Kelley & Keyes 1998).
//!
//! Blocks flow from where glued joints would let them go towards balance, held back by a share of
//! their joints' stiffness that falls with what is left of the loads: each step is one of Newton's
//! with that share on the diagonal, so that no merit has to fall. Direct factors of contacts in
//! space fill up; steps are solved by iteration, as exactly as they need to be.

use super::newton::Newton;
use crate::{
    analysis::Control,
    assembly::Wrench,
    solve::Blocks,
    verdict::Rate,
    yielding::{State, System, law::Friction},
};
use nalgebra::Vector6;

/// From so many free blocks on. Fewer: small scenes are found another way than before. More: minutes.
const BLOCKS: usize = 300;
/// And so many neighbours of each that can move, on average: heaps have six pairs a block, walls three.
/// Fewer: long chains, on which iterations crawl. More: loose heaps are factored.
const NEIGHBOURS: f64 = 3.5;
/// Share of the stiffness that holds blocks back at first. More: more steps. Less: steps too long.
const HELD: f64 = 1e-2;
/// The least, so that what rolls freely stays where it is. More: more steps. Less: rounding of the
/// factors decides.
const LEAST: f64 = 1e-9;
/// Change of that share from step to step, at least and at most, and where a step is not taken.
const CHANGE: [f64; 2] = [0.2, 1.5];
const AGAIN: f64 = 4.0;
/// A step that leaves more than this × what was left is not taken.
const WORSE: f64 = 1.5;
/// Steps at most. Fewer: rough heaps are lost. More: minutes on such as flow on.
const STEPS: usize = 60;
/// How exactly a step is solved, far from balance and near it.
const EXACT: [f64; 2] = [1e-2, 1e-4];
const NEAR: f64 = 1e-3;
/// Iterations of a step at most.
const ITERATIONS: usize = 300;

/// Whether a scene has so many contacts that this is the way.
pub fn is_dense(system: &System) -> bool {
    let blocks = system.free.len();
    blocks >= BLOCKS && system.pair_count() as f64 >= NEIGHBOURS * blocks as f64
}

/// Displacements at which the loads are balanced, by joints that remember `state`; nothing where it
/// flows on.
pub fn flow(
    newton: &mut Newton,
    state: &State,
    loads: &[Wrench],
    control: &Control,
) -> Option<Vec<Rate>> {
    let system = newton.system;
    let blocks = Blocks::new(&system.rows())?;
    let unit: Vec<f64> = system.diagonal.iter().map(|d| d.sqrt()).collect();
    let way = |displaced: &[Rate], left: &[f64], glue: f64, held: f64, exact: f64| {
        let tangent = system.tangent(state, displaced, glue, Friction::Follows);
        let values = system.entries(&tangent, &unit, held);
        let scaled: Vec<f64> = left.iter().zip(&unit).map(|(l, u)| l / u).collect();
        let right: Vec<Vector6<f64>> =
            scaled.chunks_exact(6).map(Vector6::from_column_slice).collect();
        let (x, _) = blocks.solve(&values, &right, exact, ITERATIONS)?;
        let x = x.iter().flat_map(|v| v.iter().copied().collect::<Vec<_>>());
        let x: Vec<f64> = x.zip(&unit).map(|(x, u)| x / u).collect();
        x.iter().all(|v| v.is_finite()).then_some(x)
    };
    let still = vec![Rate::zero(); state.displaced.len()];
    let (left, _) = newton.residual(state, loads, &still, 1.0);
    let mut displaced = newton.moved(&still, &way(&still, &left, 1.0, LEAST, EXACT[1])?, 1.0);
    let (mut left, mut size) = newton.residual(state, loads, &displaced, 0.0);
    let mut held = HELD;
    for _ in 0..STEPS {
        if size <= super::newton::BALANCED {
            return Some(displaced);
        }
        if control.deadline.is_over() {
            return None;
        }
        newton.steps += 1;
        let exact = if size > NEAR { EXACT[0] } else { EXACT[1] };
        let step = way(&displaced, &left, 0.0, held, exact)?;
        let next = newton.moved(&displaced, &step, 1.0);
        let (r, new) = newton.residual(state, loads, &next, 0.0);
        if new >= size && size <= super::newton::GOOD {
            // Rounding.
            return Some(displaced);
        }
        if new < WORSE * size {
            held = (held * (new / size).clamp(CHANGE[0], CHANGE[1])).max(LEAST);
            (displaced, left, size) = (next, r, new);
        } else {
            held *= AGAIN;
        }
    }
    (size <= super::newton::GOOD).then_some(displaced)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        interface::prepare,
        scene::read_str,
        yielding::{Joints, Quadrature},
    };
    use serde_json::json;

    /// A pyramid of rough spheres, by direct factors and by iteration.
    #[test]
    fn a_pyramid_flows_to_where_newtons_method_finds_it() {
        let (r, wide) = (0.01, 7);
        let mut blocks = Vec::new();
        for level in 0..wide {
            let side = wide - level;
            for (i, j) in (0..side).flat_map(|i| (0..side).map(move |j| (i, j))) {
                let at = |k: i32| r * f64::from(2 * k + level);
                blocks.push(json!({
                    "id": format!("{level}-{i}-{j}"), "shape": { "sphere": { "radius": r } },
                    "at": [at(i), at(j), 2f64.sqrt() * r * f64::from(level)],
                    "support": level == 0, "material": "glass"
                }));
            }
        }
        let text = json!({
            "format": "voussoir-scene/1",
            "materials": { "glass": { "density": 2500, "young": 70e9, "poisson": 0.22 } },
            "joints": { "default": { "friction": 1.0 } },
            "blocks": blocks
        });
        let (scene, _) = read_str("scene.json".into(), text.to_string()).unwrap();
        let model = prepare(&scene).unwrap();
        let joints = Joints::new(&model, Quadrature::Area).unwrap();
        let (start, dead) = (State::start(&model, &joints), &model.assembly.dead);
        let system = System::new(&model, &joints);
        let control = Control::default();
        let mut newton = Newton::new(&system);
        let guess = newton.guess(&start, dead, &control);
        let one = newton.balance(&start, dead, &guess, &control).unwrap();
        let other = flow(&mut newton, &start, dead, &control).unwrap();
        let most = one.iter().map(|q| q.velocity.norm()).fold(0.0, f64::max);
        for (a, b) in one.iter().zip(&other) {
            assert!((a.velocity - b.velocity).norm() < 1e-8 * most);
        }
    }
}
