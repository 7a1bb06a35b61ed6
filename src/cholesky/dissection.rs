//! Nested dissection (G. Karypis and V. Kumar, *A fast and high quality multilevel scheme for
//! partitioning irregular graphs*, SIAM J. Sci. Comput. 20, 1998), by `feral-metis`. In space it leaves
//! half of the operations of approximate minimum degree and less, the less the larger the scene; in a
//! plane about as many.

use super::Pattern;
use feral_metis::{CscPattern, metis_order};

/// The order by nested dissection, and its inverse; `None` where none is found. Neighbours with the
/// same entries, such as the rows of a block, are dissected as one.
pub fn dissected(pattern: &Pattern) -> Option<(Vec<usize>, Vec<usize>)> {
    // It takes its own time, by the clock of a system, and WebAssembly has none.
    if cfg!(target_arch = "wasm32") {
        return None;
    }
    let n = pattern.size();
    let column = |k: usize| &pattern.rows[pattern.starts[k]..pattern.starts[k + 1]];
    let mut group = vec![0; n];
    for k in 1..n {
        group[k] = group[k - 1] + usize::from(column(k - 1).get(1..) != Some(column(k)));
    }
    let groups = group[n - 1] + 1;
    let mut neighbours: Vec<Vec<i32>> = vec![Vec::new(); groups];
    for k in (0..n).filter(|&k| k == 0 || group[k] != group[k - 1]) {
        for other in column(k).iter().map(|&i| group[i]).filter(|&other| other != group[k]) {
            neighbours[group[k]].push(i32::try_from(other).ok()?);
            neighbours[other].push(i32::try_from(group[k]).ok()?);
        }
    }
    let (mut starts, mut rows) = (vec![0], Vec::new());
    for list in &mut neighbours {
        list.sort_unstable();
        list.dedup();
        rows.append(list);
        starts.push(i32::try_from(rows.len()).ok()?);
    }
    let graph = CscPattern::new(groups, &starts, &rows)?;
    let found = metis_order(&graph).ok()?;
    let mut first = vec![0; groups + 1];
    group.iter().for_each(|&g| first[g + 1] += 1);
    (0..groups).for_each(|g| first[g + 1] += first[g]);
    let mut order = Vec::with_capacity(n);
    for g in found {
        let g = usize::try_from(g).ok()?;
        order.extend(*first.get(g)?..*first.get(g + 1)?);
    }
    let mut inverse = vec![n; n];
    order.iter().enumerate().for_each(|(new, &old)| inverse[old] = new);
    (order.len() == n && !inverse.contains(&n)).then_some((order, inverse))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Blocks of three rows stay together, and every row has its place.
    #[test]
    fn rows_of_a_block_stay_together() {
        let (blocks, mut starts, mut rows) = (50, vec![0], Vec::new());
        for k in 0..3 * blocks {
            let block = k / 3;
            rows.extend(k..3 * (block + 1).min(blocks - 1) + 3);
            starts.push(rows.len());
        }
        let (order, inverse) = dissected(&Pattern { starts, rows }).unwrap();
        for (new, &old) in order.iter().enumerate() {
            assert_eq!(inverse[old], new);
        }
        for own in order.chunks(3) {
            assert!(own[0] % 3 == 0 && own[1] == own[0] + 1 && own[2] == own[0] + 2, "{own:?}");
        }
    }

    /// A matrix of one block, or without any entry beside its diagonal, has an order, too.
    #[test]
    fn what_has_nothing_to_dissect() {
        let whole = Pattern { starts: vec![0, 2, 3], rows: vec![0, 1, 1] };
        assert_eq!(dissected(&whole).unwrap().0, [0, 1]);
        let apart = Pattern { starts: vec![0, 1, 2], rows: vec![0, 1] };
        assert_eq!(dissected(&apart).unwrap().0.len(), 2);
    }
}
