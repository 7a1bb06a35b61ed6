//! Blocks in one place: a block drawn once more touches what the first touches, and a thousand of
//! them are looked at once.

use super::{
    body::{BoundedBlock, Form},
    meeting::Pair,
};
use crate::assembly::Block;
use base::error::{InputError, JsonPath};
use std::collections::{HashMap, HashSet, hash_map::Entry};

/// Most pairs in which two heaps touch each other. More: two heaps of 500 ask for a program of a
/// million contact points, and 24 GiB. Fewer: walls drawn a few times over are refused.
const TOUCHING: usize = 10_000;

/// For every block the blocks in its place, itself among them, ascending.
pub(super) struct Heaps {
    /// By its first block; where there is no second one, it is not here.
    of: HashMap<usize, Vec<usize>>,
    /// All blocks but the first of each heap.
    again: HashSet<usize>,
}

impl Heaps {
    /// Finds bodies that are the same to the last bit; `apart` are blocks of which the scene says
    /// more than where they are. Those that differ in rounding are compared as any two blocks are.
    pub fn find(bodies: &[BoundedBlock], apart: &HashSet<usize>) -> Self {
        let mut places: HashMap<Vec<[u64; 3]>, Vec<Vec<usize>>> = HashMap::new();
        for (i, body) in bodies.iter().enumerate().filter(|(i, _)| !apart.contains(i)) {
            let heaps = match places.entry(place(body)) {
                Entry::Vacant(new) => {
                    new.insert(vec![vec![i]]);
                    continue;
                }
                Entry::Occupied(old) => old.into_mut(),
            };
            match heaps.iter_mut().find(|heap| is_same(&bodies[heap[0]], body)) {
                Some(heap) => heap.push(i),
                None => heaps.push(vec![i]),
            }
        }
        let heaps = places.into_values().flatten().filter(|heap| heap.len() > 1);
        let of: HashMap<usize, Vec<usize>> = heaps.map(|heap| (heap[0], heap)).collect();
        let again = of.values().flat_map(|heap| &heap[1..]).copied().collect();
        Self { of, again }
    }

    /// Whether an earlier block lies in this one's place.
    pub fn is_again(&self, block: usize) -> bool {
        self.again.contains(&block)
    }

    /// The heaps, by their first blocks.
    pub fn all(&self) -> Vec<&[usize]> {
        let mut all: Vec<&[usize]> = self.of.values().map(Vec::as_slice).collect();
        all.sort_unstable();
        all
    }

    /// Gives the blocks of each heap what its first block has to do with others.
    ///
    /// # Errors
    /// Two heaps touch each other in more than [`TOUCHING`] pairs.
    pub fn spread(&self, pairs: &mut Vec<Pair>, blocks: &[Block]) -> Result<(), InputError> {
        if self.of.is_empty() {
            return Ok(());
        }
        let alone = std::mem::take(pairs);
        for pair in alone {
            let (of_a, of_b) = (self.of.get(&pair.a), self.of.get(&pair.b));
            let (a, b) = ([pair.a], [pair.b]);
            let (of_a, of_b) =
                (of_a.map_or(&a[..], Vec::as_slice), of_b.map_or(&b[..], Vec::as_slice));
            if of_a.len().min(of_b.len()) > 1 && of_a.len() * of_b.len() > TOUCHING {
                let [a, b] = [pair.a, pair.b].map(|i| &blocks[i].id);
                let text = format!(
                    "{} blocks lie in the place of {a:?} and touch {} in the place of {b:?}",
                    of_a.len(),
                    of_b.len()
                );
                return Err(InputError::at(JsonPath::root(), text).hint("keep one in each place"));
            }
            pairs.extend(
                of_a.iter().flat_map(|&x| of_b.iter().map(move |&y| (x, y))).map(|(a, b)| Pair {
                    a,
                    b,
                    limits: pair.limits,
                    meeting: pair.meeting.clone(),
                }),
            );
        }
        pairs.sort_by_key(|p| (p.a, p.b));
        Ok(())
    }
}

/// The numbers by which a body lies where it lies.
fn place(body: &BoundedBlock) -> Vec<[u64; 3]> {
    let bits = |v: &nalgebra::Vector3<f64>| [v.x, v.y, v.z].map(|c| (c + 0.0).to_bits());
    match &body.shape {
        Form::Polyhedron(p) => p.polyhedron.vertices.iter().map(bits).collect(),
        Form::Balls(balls) => {
            balls.iter().flat_map(|(c, r)| [bits(c), [r.to_bits(), 0, 0]]).collect()
        }
    }
}

/// Whether two bodies in one place have the same faces, too.
fn is_same(a: &BoundedBlock, b: &BoundedBlock) -> bool {
    match (&a.shape, &b.shape) {
        (Form::Polyhedron(p), Form::Polyhedron(q)) => {
            let faces = |p: &super::body::Solidity| -> Vec<Vec<Vec<u32>>> {
                p.polyhedron.facets.iter().map(|f| f.pieces.clone()).collect()
            };
            faces(p) == faces(q)
        }
        (Form::Balls(_), Form::Balls(_)) => true,
        _ => false,
    }
}
