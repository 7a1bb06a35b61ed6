//! Which free blocks have a path of contacts and members to a support or the ground. The others need no program.

use super::Model;
use base::plane::Sets;

/// Whether contacts and members form no closed chain, all supports and the ground taken as one: then the resultant of
/// every contact follows from statics alone and there is nothing that could be wedged.
pub fn is_forest(model: &Model) -> bool {
    let Model { assembly, interfaces, .. } = model;
    let n = assembly.blocks.len();
    let ground = n;
    let mut sets = Sets::new(n + 1);
    let node = |i: usize| if assembly.blocks[i].support { ground } else { i };
    let end = |i: Option<usize>| i.map_or(ground, node);
    interfaces.list.iter().all(|face| sets.join(node(face.a), node(face.b)))
        && interfaces.members.iter().all(|m| {
            let ends = m.action.ends();
            ends.windows(2).all(|pair| sets.join(end(pair[0]), end(pair[1])))
        })
}

/// Groups of free blocks connected to each other but not to any support, each group sorted, in
/// block order.
pub fn floating(model: &Model) -> Vec<Vec<usize>> {
    let Model { assembly, interfaces, .. } = model;
    let n = assembly.blocks.len();
    let mut sets = Sets::new(n);
    for face in &interfaces.list {
        sets.join(face.a, face.b);
    }
    let mut held = vec![false; n];
    for member in &interfaces.members {
        let ends = member.action.ends();
        let blocks: Vec<usize> = ends.iter().copied().flatten().collect();
        blocks.windows(2).for_each(|pair| {
            sets.join(pair[0], pair[1]);
        });
    }
    for member in interfaces.members.iter().filter(|m| m.action.ends().contains(&None)) {
        member.action.ends().into_iter().flatten().for_each(|i| held[sets.find(i)] = true);
    }
    for i in 0..n {
        if assembly.blocks[i].support {
            held[sets.find(i)] = true;
        }
    }
    let mut groups: std::collections::BTreeMap<usize, Vec<usize>> = Default::default();
    for i in 0..n {
        let r = sets.find(i);
        if !held[r] {
            groups.entry(r).or_default().push(i);
        }
    }
    groups.into_values().collect()
}
