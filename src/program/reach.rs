//! Which free blocks have a contact path to a support. The others need no program.

use crate::{assembly::Assembly, interface::Interfaces};

/// Follows a union–find chain to its root.
fn find(root: &mut [usize], mut i: usize) -> usize {
    while root[i] != i {
        root[i] = root[root[i]];
        i = root[i];
    }
    i
}

/// Whether the contacts form no closed chain, all supports taken as one: then the resultant of every contact follows from
/// statics alone and there is nothing that could be wedged.
pub fn is_forest(assembly: &Assembly, interfaces: &Interfaces) -> bool {
    let n = assembly.blocks.len();
    let ground = n;
    let mut root: Vec<usize> = (0..=n).collect();
    let node = |i: usize| if assembly.blocks[i].support { ground } else { i };
    interfaces.list.iter().all(|face| {
        let (a, b) = (find(&mut root, node(face.a)), find(&mut root, node(face.b)));
        root[a] = b;
        a != b
    })
}

/// Groups of free blocks connected to each other but not to any support, each group sorted, in block order.
pub fn floating(assembly: &Assembly, interfaces: &Interfaces) -> Vec<Vec<usize>> {
    let n = assembly.blocks.len();
    let mut root: Vec<usize> = (0..n).collect();
    for face in &interfaces.list {
        let (a, b) = (find(&mut root, face.a), find(&mut root, face.b));
        root[a.max(b)] = a.min(b);
    }
    let mut held = vec![false; n];
    for i in 0..n {
        if assembly.blocks[i].support {
            held[find(&mut root, i)] = true;
        }
    }
    let mut groups: std::collections::BTreeMap<usize, Vec<usize>> = Default::default();
    for i in 0..n {
        let r = find(&mut root, i);
        if !held[r] {
            groups.entry(r).or_default().push(i);
        }
    }
    groups.into_values().collect()
}
