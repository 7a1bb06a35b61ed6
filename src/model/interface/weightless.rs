//! Blocks almost without weight that horizontal loads act on: their joints press so little that no
//! friction holds them, and they slide before anything else.

use super::{Interfaces, tally::short};
use crate::assembly::Assembly;
use base::error::{Finding, FindingCode};

/// A block is almost without weight where all that presses it down is less than this share of what
/// presses the heaviest block that it touches. More: light stones under heavy ones are reported. Less:
/// a loading beam of 1 kg on a wall of 500 kg is not.
const LIGHT: f64 = 1e-4;

/// One finding for all such blocks.
pub(super) fn finding(assembly: &Assembly, interfaces: &Interfaces) -> Option<Finding> {
    let up = -assembly.gravity.try_normalize(0.0)?;
    let count = assembly.blocks.len();
    let presses = |i: usize| assembly.dead[i].force.norm();
    let (mut beside, mut loaded) = (vec![0.0_f64; count], vec![false; count]);
    let mut covered = vec![false; count];
    for face in &interfaces.list {
        for (i, other, out) in [(face.a, face.b, face.frame.n), (face.b, face.a, -face.frame.n)] {
            if !assembly.blocks[other].support {
                beside[i] = beside[i].max(presses(other));
            }
            // What lies on it presses it down.
            covered[i] |= out.dot(&up) > 0.5;
        }
    }
    let across = |f: &nalgebra::Vector3<f64>| (f - up * f.dot(&up)).norm() > 0.0;
    let loads = assembly.live_forces.iter().filter(|f| across(&f.force));
    loads.for_each(|f| loaded[f.block] = true);
    let ends = interfaces.members.iter().flat_map(|m| m.action.ends());
    ends.flatten().for_each(|i| loaded[i] = true);
    let light = |&i: &usize| {
        let block = &assembly.blocks[i];
        !block.support && loaded[i] && !covered[i] && presses(i) < LIGHT * beside[i]
    };
    let found: Vec<usize> = (0..count).filter(light).collect();
    let &first = found.first()?;
    let more = match found.len() {
        1 => String::new(),
        n => format!(" ({} more alike)", n - 1),
    };
    let text = format!(
        "block {:?} is pushed sideways but presses its joint with {} N only, {} N press the block beside it{more}: friction cannot hold it, and it slides before anything else moves. Give it its weight, or the vertical load that it carries",
        assembly.blocks[first].id,
        short(presses(first)),
        short(beside[first])
    );
    Some(Finding::new(FindingCode::Loads, text))
}
