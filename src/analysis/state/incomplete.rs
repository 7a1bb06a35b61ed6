//! Equations of heaps by incomplete factors, and where those do not serve by complete ones of single
//! precision, which are kept as long as they do.

use super::equations::Equations;
use check::elastic::{JointKind, System};
use nalgebra::Vector6;
use solve::{Blocks, Fronts, Pattern};
use std::collections::BTreeMap;

/// So many blocks that all touch as spheres do are a heap. Fewer: complete factors are faster.
const HEAP: usize = 200;
/// What a solution of the equations leaves of their right side near balance. More: more steps. Less:
/// more time for each.
pub const CLOSELY: f64 = 1e-4;
/// Most products of a solution: where it takes more, it takes thousands.
const PRODUCTS: usize = 240;
/// Most products where complete factors are at hand else. More: time that a factorisation takes.
const SOME: usize = 50;
/// Most products with factors of a step before.
const FEW: usize = 15;
/// What a solution with those leaves of the right side.
const BY_OLD: f64 = 0.03;

/// Whether there is a heap, whatever else stands beside it, and they are tried.
pub fn serve(system: &System) -> bool {
    let parts = system.parts();
    let row: BTreeMap<usize, usize> =
        system.free.iter().enumerate().map(|(row, &block)| (block, row)).collect();
    let mut blocks: BTreeMap<usize, usize> = BTreeMap::new();
    parts.iter().for_each(|&part| *blocks.entry(part).or_default() += 1);
    // What touches otherwise anywhere is no heap.
    for joint in system.joints.list.iter().filter(|j| !matches!(j.kind, JointKind::Grain(_))) {
        for row in joint.free.iter().filter_map(|i| row.get(i)) {
            blocks.remove(&parts[*row]);
        }
    }
    blocks.values().any(|&count| count >= HEAP)
}

/// The solution to this share of the right side; nothing where incomplete factors do not get there.
pub fn solved(
    pattern: &Pattern,
    lower: &[f64],
    upper: &[f64],
    right: &[f64],
    share: f64,
) -> Option<Vec<f64>> {
    let matrix = Blocks::new(pattern, lower, upper);
    let factors = matrix.incomplete()?;
    matrix.solve(&factors, &six(right), share, PRODUCTS).map(flat)
}

/// The same; by complete factors where incomplete ones do not serve soon, and by those of before as long
/// as they do.
pub fn completed(
    pattern: &Pattern,
    fronts: &mut Option<Fronts>,
    equations: &Equations,
    share: f64,
) -> Option<Vec<f64>> {
    let matrix = Blocks::new(pattern, &equations.lower, &equations.upper);
    let right = six(&equations.right);
    let x = match fronts.as_ref().filter(|f| f.ready) {
        Some(old) => matrix.solve(old, &right, share.max(BY_OLD), FEW),
        None => matrix.incomplete().and_then(|factors| matrix.solve(&factors, &right, share, SOME)),
    };
    if let Some(x) = x {
        return Some(flat(x));
    }
    if fronts.is_none() {
        *fronts = Fronts::new(pattern, &matrix);
    }
    let fronts = fronts.as_mut()?;
    if !fronts.factor(&matrix) {
        return None;
    }
    // Single precision may not serve for more than a rough solution: better that than none.
    let close = matrix.solve(fronts, &right, share, SOME);
    close.or_else(|| matrix.solve(fronts, &right, share.max(BY_OLD), PRODUCTS)).map(flat)
}

fn six(list: &[f64]) -> Vec<Vector6<f64>> {
    list.chunks_exact(6).map(Vector6::from_column_slice).collect()
}

fn flat(list: Vec<Vector6<f64>>) -> Vec<f64> {
    list.iter().flat_map(|v| v.iter().copied()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use check::elastic::{Joints, Quadrature};
    use model::interface::prepare;
    use scene::read_str;
    use serde_json::json;

    /// A heap is one whatever stands beside it.
    #[test]
    fn what_stands_beside_a_heap_changes_nothing() {
        let serves = |spheres: usize, beside: bool| {
            let ball = |k: usize| json!({ "id": k.to_string(), "shape": { "sphere": { "radius": 0.5 } }, "at": [k, 0, 0.5], "support": k == 0, "material": "glass" });
            let cube = |id: &str, z: f64| json!({ "id": id, "shape": { "box": { "size": [1, 1, 1] } }, "at": [-30, 0, z], "support": id == "floor" });
            let mut scene = json!({
                "format": "voussoir-scene/1",
                "materials": { "glass": { "density": 2500, "young": 7e10, "poisson": 0.22 } },
                "joints": { "default": { "friction": 0.5 } },
                "blocks": (0..=spheres).map(ball).collect::<Vec<_>>(),
            });
            if beside {
                let blocks = scene["blocks"].as_array_mut().unwrap();
                blocks.extend([cube("floor", -0.5), cube("cube", 0.5)]);
                scene["joints"]["overrides"] = json!([{ "blocks": ["floor", "cube"], "normal_stiffness": 1e9, "shear_stiffness": 1e9 }]);
            }
            let model = prepare(&read_str("test", scene.to_string()).unwrap().0).unwrap();
            let joints = Joints::new(&model, Quadrature::Area).unwrap();
            serve(&System::new(&model, &joints))
        };
        assert!(serves(HEAP, false) && serves(HEAP, true));
        assert!(!serves(HEAP - 1, false) && !serves(HEAP - 1, true));
    }
}
