//! Which free blocks have a contact path to a support. The others need no program.

use crate::{assembly::Assembly, interface::Interfaces};

/// Groups of free blocks connected to each other but not to any support, each group sorted, in block order.
pub fn floating(assembly: &Assembly, interfaces: &Interfaces) -> Vec<Vec<usize>> {
    let n = assembly.blocks.len();
    let mut root: Vec<usize> = (0..n).collect();
    fn find(root: &mut [usize], mut i: usize) -> usize {
        while root[i] != i {
            root[i] = root[root[i]];
            i = root[i];
        }
        i
    }
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
