//! A rough estimate of the load each block carries, for scaling only.
//!
//! Loads are handed down in equal shares to the neighbours that are fewer contacts away from a
//! support. Where it is wrong (a small keystone between large halves) the scaling is poor and a
//! later rung of the ladder goes without it; answers never depend on it.

use model::interface::Model;
use std::collections::VecDeque;

/// Load carried by each block, N, in the measure of `own`; infinite for supports.
pub fn carried(model: &Model, own: impl Fn(usize) -> f64) -> Vec<f64> {
    let Model { assembly, interfaces, .. } = model;
    let n = assembly.blocks.len();
    let mut neighbours = vec![Vec::new(); n];
    for face in &interfaces.list {
        neighbours[face.a].push(face.b);
        neighbours[face.b].push(face.a);
    }
    let mut depth = vec![usize::MAX; n];
    let mut queue: VecDeque<usize> = (0..n).filter(|&i| assembly.blocks[i].support).collect();
    queue.iter().for_each(|&i| depth[i] = 0);
    let mut order = Vec::with_capacity(n);
    while let Some(i) = queue.pop_front() {
        order.push(i);
        for &j in &neighbours[i] {
            if depth[j] == usize::MAX {
                depth[j] = depth[i] + 1;
                queue.push_back(j);
            }
        }
    }
    let mut load: Vec<f64> =
        (0..n).map(|i| if assembly.blocks[i].support { f64::INFINITY } else { own(i) }).collect();
    for &i in order.iter().rev().filter(|&&i| depth[i] > 0) {
        let below: Vec<usize> =
            neighbours[i].iter().copied().filter(|&j| depth[j] < depth[i]).collect();
        for &j in &below {
            load[j] += load[i] / below.len() as f64;
        }
    }
    load
}
