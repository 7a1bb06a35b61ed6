//! What makes a program of contacts cheap: cone rows concern one contact point (or one block) at a
//! time, equality rows one block, and very few variables (the load factor, the least equilibrium error)
//! concern all of them.

use super::{
    columns::{Block, Columns},
    cones::{ConeAt, MOST_ROWS},
    panels::Panels,
};
use crate::program::{Cone, ConicProgram};
use base::plane::Sets;

/// A program taken apart.
#[derive(Clone, Debug)]
pub(super) struct Structure {
    /// Program column of each local variable, block by block.
    pub variables: Vec<usize>,
    /// Program columns of the variables that concern everything.
    pub border: Vec<usize>,
    /// The blocks.
    pub blocks: Vec<Block>,
    /// The cones on cone rows.
    pub cones: Vec<ConeAt>,
    /// Program row of each cone row.
    pub cone_rows: Vec<usize>,
    /// Program row of each equality.
    pub equalities: Vec<usize>,
    /// Equality rows of the local variables.
    pub e: Panels,
    /// Cone rows of the local variables.
    pub g: Columns,
    /// Equality rows of the border.
    pub e_border: Columns,
    /// Cone rows of the border.
    pub g_border: Columns,
    /// Quadratic part of the local variables; empty where there is none.
    pub quadratic: Vec<f64>,
}

/// A variable in more equalities or cones than this concerns everything. Fewer: contacts between
/// more than two blocks, which there are not. More: dense columns fill the reduced system.
const LOCAL: usize = 24;

/// Most variables that concern everything.
const MOST_BORDER: usize = 4;

/// Most variables of one block. A cut over a whole joint (crushing) ties its corners together.
const MOST_VARIABLES: usize = 8;

impl Structure {
    /// Takes a program apart; `None` where it is not made like that.
    pub fn new(program: &ConicProgram) -> Option<Self> {
        let m = &program.matrix;
        let (mut cones, mut cone_of, mut cone_rows, mut equalities) =
            (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        // Program row → (is an equality, index).
        let mut place = Vec::with_capacity(m.rows);
        for cone in &program.cones {
            let first = place.len();
            let rows = first..first + cone.rows();
            match *cone {
                Cone::Zero(n) => {
                    place.extend((0..n).map(|k| (true, equalities.len() + k)));
                    equalities.extend(rows);
                }
                Cone::NonNegative(_) => {
                    for row in rows {
                        place.push((false, cone_rows.len()));
                        cone_of.push(cones.len());
                        cones.push(ConeAt { first: cone_rows.len(), size: 1, round: false });
                        cone_rows.push(row);
                    }
                }
                Cone::SecondOrder(n) => {
                    if n > MOST_ROWS {
                        return None;
                    }
                    place.extend((0..n).map(|k| (false, cone_rows.len() + k)));
                    cone_of.extend(std::iter::repeat_n(cones.len(), n));
                    cones.push(ConeAt { first: cone_rows.len(), size: n, round: true });
                    cone_rows.extend(rows);
                }
            }
        }
        let mut count = vec![0; m.columns];
        m.j.iter().for_each(|&j| count[j] += 1);
        let border: Vec<usize> = (0..m.columns).filter(|&j| count[j] > LOCAL).collect();
        if border.len() > MOST_BORDER
            || border.iter().any(|&j| program.quadratic.get(j).is_some_and(|p| *p != 0.0))
        {
            return None;
        }
        let is_border = |j: usize| count[j] > LOCAL;
        // Variables of one cone belong together.
        let mut sets = Sets::new(m.columns);
        let mut seen = vec![None; cones.len()];
        for (&i, &j) in m.i.iter().zip(&m.j) {
            let (false, row) = place[i] else { continue };
            if is_border(j) {
                continue;
            }
            match seen[cone_of[row]] {
                None => seen[cone_of[row]] = Some(j),
                Some(other) => {
                    sets.join(j, other);
                }
            }
        }
        let mut members: Vec<Vec<usize>> = vec![Vec::new(); m.columns];
        for j in (0..m.columns).filter(|&j| !is_border(j)) {
            members[sets.find(j)].push(j);
        }
        let (mut blocks, mut variables, mut block_of) =
            (Vec::<Block>::new(), Vec::new(), vec![usize::MAX; m.columns]);
        let mut local = vec![usize::MAX; m.columns];
        for list in members.into_iter().filter(|l| !l.is_empty()) {
            if list.len() > MOST_VARIABLES {
                return None;
            }
            let first = variables.len();
            for j in list {
                block_of[j] = blocks.len();
                local[j] = variables.len();
                variables.push(j);
            }
            blocks.push(Block {
                variables: first..variables.len(),
                cones: Vec::new(),
                plain: false,
            });
        }
        for (cone, seen) in seen.iter().enumerate() {
            // A cone on no local variable would bound the border alone.
            blocks[block_of[(*seen)?]].cones.push(cone);
        }
        let mut parts = [const { Vec::new() }; 4];
        let at_border = |j: usize| border.iter().position(|&b| b == j).unwrap_or(0);
        for ((&i, &j), &v) in m.i.iter().zip(&m.j).zip(&m.v) {
            let (equality, row) = place[i];
            let part = usize::from(!equality) + 2 * usize::from(is_border(j));
            parts[part].push((if is_border(j) { at_border(j) } else { local[j] }, row, v));
        }
        let [e, g, e_border, g_border] = parts;
        let quadratic = if program.quadratic.is_empty() {
            Vec::new()
        } else {
            variables.iter().map(|&j| program.quadratic[j]).collect()
        };
        let n = variables.len();
        let mut this = Self {
            e: Panels::new(&blocks, &Columns::new(n, e)),
            g: Columns::new(n, g),
            e_border: Columns::new(border.len(), e_border),
            g_border: Columns::new(border.len(), g_border),
            variables,
            border,
            blocks,
            cones,
            cone_rows,
            equalities,
            quadratic,
        };
        let mut blocks = std::mem::take(&mut this.blocks);
        blocks.iter_mut().for_each(|b| b.plain = this.is_plain(b));
        this.blocks = blocks;
        Some(this)
    }

    fn is_plain(&self, block: &Block) -> bool {
        let [cone] = block.cones[..] else { return false };
        let cone = self.cones[cone];
        self.quadratic.is_empty()
            && self.g_border.row.is_empty()
            && block.variables.len() == cone.size
            && block
                .variables
                .clone()
                .enumerate()
                .all(|(k, j)| self.g.of(j).eq([(cone.first + k, -1.0)]))
    }
}
