//! Orders in which a structure can be built block by block, with as few blocks held as can be.
//!
//! Sets of blocks are looked at backwards, from the whole structure on: a block may be the last one
//! that was placed where the others stand, by themselves or with some of them held. What has to be
//! held is a hitting set: a mechanism goes on as long as none of the blocks that move in it is held.
//! Parts that do not touch are asked for themselves, once each.
//!
//! That a set stands is proved afterwards, as a stage ([`super`]). That no order does with
//! fewer holds is the outcome of a search through all of them: computed, not proved.

use crate::{Control, part_cache::Known};
use base::{error::InputError, plane::Sets};
use check::{
    terms::Order,
    verdict::{Rate, Verdict},
};
use model::{
    assembly::{Placed, Stage},
    interface::{Model, at_stage},
};
use scene::Scene;
use std::collections::{BTreeMap, BTreeSet, HashMap, HashSet};

/// Sets looked at where nothing else is said. Fewer: of walls over an arch the least holds are not
/// found. More: minutes pass before what was found without a search is said.
pub const TRIES: usize = 5000;

type Blocks = BTreeSet<usize>;

/// What a set of blocks does with some of them held.
#[derive(Clone)]
enum WithHeld {
    Stands,
    /// It does not: one of these must be held.
    Moves(Vec<usize>),
    /// That is undecided; one of these may have to be held.
    Open(Vec<usize>),
}

/// What is known of the least holds of a part.
#[derive(Clone, Default)]
struct Least {
    /// No fewer do.
    from: usize,
    holds: Option<Blocks>,
    /// As far as is known: a verdict was undecided.
    open: bool,
}

/// A set on the way down, with what is held of it.
struct Level {
    set: Blocks,
    held: Blocks,
    /// Blocks that may have come last and were not looked at yet.
    left: std::vec::IntoIter<usize>,
    /// The one that is looked at.
    last: Option<usize>,
}

/// Why a search ends before its end.
enum Halt {
    /// Tries or time are up.
    Over,
    Error(InputError),
}

struct Search<'a> {
    scene: &'a Scene,
    whole: &'a Model,
    control: &'a Control,
    known: &'a Known,
    /// Free blocks that touch or that a member joins.
    neighbours: Vec<Blocks>,
    seen: HashMap<(Blocks, Blocks), WithHeld>,
    least: HashMap<Blocks, Least>,
    left: usize,
    /// Some verdict was undecided: what is not found may be there.
    open: bool,
}

/// An order in which every stage stands, with the least number of blocks held at a time; a given
/// one (indices of all free blocks, the first placed first) with the least holds at each stage.
/// Nothing is placed where time was up before an order was found.
///
/// Structures beside each other are asked one by one, each with tries of its own: none of them
/// changes what is found of another.
///
/// # Errors
/// A load of the scene does not resolve at a stage.
pub(super) fn order(
    (given, tries): (Option<&[usize]>, usize),
    scene: &Scene,
    model: &Model,
    known: &Known,
    control: &Control,
) -> Result<Order, InputError> {
    let mut search = Search::new(scene, model, known, control);
    let all: Blocks = model.assembly.free().collect();
    let (mut ways, mut of) = (Vec::new(), vec![0; model.assembly.blocks.len()]);
    for (k, part) in search.parts(&all).iter().enumerate() {
        part.iter().for_each(|&i| of[i] = k);
        search.left = tries;
        ways.push(match given {
            Some(list) => {
                let own: Vec<usize> = list.iter().copied().filter(|i| part.contains(i)).collect();
                search.given(&own)?
            }
            None => search.any(part)?,
        });
    }
    let list = match given {
        Some(list) => list.to_vec(),
        None => ways.iter().flat_map(|w| w.placed.iter().map(|p| p.0)).collect(),
    };
    let (placed, least_held) = together(&list, &ways, &of);
    let id = |i: usize| model.assembly.blocks[i].id.clone();
    let placed = placed
        .into_iter()
        .map(|(block, held)| Placed { block: id(block), held: held.into_iter().map(id).collect() });
    Ok(Order { given: given.is_some(), tries, least_held, placed: placed.collect() })
}

/// How a structure that stands by itself is built.
#[derive(Default)]
struct Way {
    /// Block by block, with what is held then; none where time was up.
    placed: Vec<(usize, Blocks)>,
    /// At each of these stages no fewer holds do; of an order that was sought, at the last.
    least: Vec<usize>,
    /// Of an order that was sought: in no order fewer do.
    any: usize,
}

/// The ways of several structures, in the order of `list`: what is held at a stage of one stays
/// held while another goes on; `of` tells which structure a block belongs to. With the number of
/// holds below which there is nothing.
fn together(list: &[usize], ways: &[Way], of: &[usize]) -> (Vec<(usize, Blocks)>, usize) {
    if ways.iter().any(|w| w.placed.is_empty()) {
        // What was not built to its end cannot be sought again from the answer alone.
        return (Vec::new(), ways.iter().map(|w| w.any).max().unwrap_or(0));
    }
    let mut stage = vec![0; ways.len()];
    let mut least = ways.iter().map(|w| w.any).max().unwrap_or(0);
    let mut placed = Vec::new();
    for &block in list {
        stage[of[block]] += 1;
        let there = || ways.iter().zip(&stage).filter(|(_, at)| **at > 0);
        let held = there().flat_map(|(w, at)| w.placed[at - 1].1.iter().copied()).collect();
        let fewest = there().map(|(w, at)| w.least.get(at - 1).copied().unwrap_or(0)).sum();
        least = least.max(fewest);
        placed.push((block, held));
    }
    (placed, least)
}

impl<'a> Search<'a> {
    fn new(scene: &'a Scene, whole: &'a Model, known: &'a Known, control: &'a Control) -> Self {
        let of = &whole.assembly;
        let mut neighbours = vec![Blocks::new(); of.blocks.len()];
        let mut join = |a: usize, b: usize| {
            if a != b && !of.blocks[a].support && !of.blocks[b].support {
                neighbours[a].insert(b);
                neighbours[b].insert(a);
            }
        };
        for f in &whole.interfaces.list {
            join(f.a, f.b);
        }
        for m in &whole.interfaces.members {
            let ends: Vec<usize> = m.action.ends().into_iter().flatten().collect();
            for pair in ends.windows(2) {
                join(pair[0], pair[1]);
            }
        }
        Self {
            scene,
            whole,
            control,
            known,
            neighbours,
            seen: HashMap::new(),
            least: HashMap::new(),
            left: 0,
            open: false,
        }
    }

    /// Any order of a structure, with as few held at a time as tries allow. Where tries or time are
    /// up, the best of what can be had without a search.
    fn any(&mut self, all: &Blocks) -> Result<Way, InputError> {
        let (mut any, mut found) = (0, None);
        for most in 0..=all.len() {
            self.open = false;
            match self.build(all, most) {
                Ok(None) if any == most && !self.open => any = most + 1,
                Ok(None) => {}
                Ok(order) => {
                    found = order;
                    break;
                }
                Err(Halt::Over) => break,
                Err(Halt::Error(e)) => return Err(e),
            }
        }
        let placed = match found {
            Some(order) => order,
            None => {
                let mut set = all.clone();
                let mut down = Vec::new();
                while let Some(&block) = self.candidates(&set).first() {
                    set.remove(&block);
                    down.push(block);
                }
                down.reverse();
                self.unsearched(&down)?
            }
        };
        // Whole it stays as it is while other structures are built.
        let whole = self.least.get(all).filter(|l| !l.open).map_or(0, |l| l.from);
        let mut least = vec![0; placed.len()];
        if let Some(last) = least.last_mut() {
            *last = whole;
        }
        Ok(Way { placed, least, any })
    }

    /// The least holds of a structure at every stage of a given order, as far as tries go.
    fn given(&mut self, list: &[usize]) -> Result<Way, InputError> {
        let (mut set, mut way) = (Blocks::new(), Way::default());
        for &block in list {
            set.insert(block);
            self.open = false;
            match self.holds(&set, list.len()) {
                Ok(Some(held)) => {
                    way.least.push(if self.open { 0 } else { held.len() });
                    way.placed.push((block, held));
                }
                // So many always do.
                Ok(None) => return Ok(Way::default()),
                Err(Halt::Over) => return Ok(Way { placed: self.unsearched(list)?, ..way }),
                Err(Halt::Error(e)) => return Err(e),
            }
        }
        Ok(way)
    }

    /// An order with holds that need not be the least: what is held stays so until its part stands
    /// without, and of what moves besides one block after the other is held. Nothing where time is
    /// up.
    fn unsearched(&mut self, list: &[usize]) -> Result<Vec<(usize, Blocks)>, InputError> {
        let (mut set, mut order) = (Blocks::new(), Vec::new());
        let mut held = Blocks::new();
        for &block in list {
            set.insert(block);
            let before = std::mem::take(&mut held);
            for part in self.parts(&set) {
                self.left = usize::MAX;
                match self.enough(&part, &before) {
                    Ok(more) => held.extend(more),
                    Err(Halt::Over) => return Ok(Vec::new()),
                    Err(Halt::Error(e)) => return Err(e),
                }
            }
            order.push((block, held.clone()));
        }
        Ok(order)
    }

    fn enough(&mut self, part: &Blocks, before: &Blocks) -> Result<Blocks, Halt> {
        if let Some(known) = self.least.get(part).and_then(|l| l.holds.clone()) {
            return Ok(known);
        }
        let mut held = Blocks::new();
        while let WithHeld::Moves(list) | WithHeld::Open(list) = self.seen(part, &held)? {
            let Some(&first) = list.first() else { break };
            let stay = part.intersection(before).filter(|i| !held.contains(i)).copied();
            let more: Vec<usize> = stay.collect();
            held.extend(if more.is_empty() { vec![first] } else { more });
        }
        Ok(held)
    }

    /// How a set can be built with at most so many held at a time; nothing where it cannot.
    fn build(&mut self, all: &Blocks, most: usize) -> Result<Option<Vec<(usize, Blocks)>>, Halt> {
        let mut failed = HashSet::new();
        let mut down: Vec<Level> = Vec::new();
        let mut set = all.clone();
        loop {
            match self.holds(&set, most)? {
                Some(held) => {
                    let mut left = self.candidates(&set).into_iter();
                    if set.len() == 1 {
                        let first = left.next().map(|only| (only, held));
                        let later = down.into_iter().rev().filter_map(|l| Some((l.last?, l.held)));
                        return Ok(Some(first.into_iter().chain(later).collect()));
                    }
                    down.push(Level { set, held, left, last: None });
                }
                None => drop(failed.insert(set)),
            }
            set = loop {
                let Some(level) = down.last_mut() else { return Ok(None) };
                level.last = level.left.next();
                let Some(block) = level.last else {
                    failed.extend(down.pop().map(|l| l.set));
                    continue;
                };
                let mut rest = level.set.clone();
                rest.remove(&block);
                if !failed.contains(&rest) {
                    self.count()?;
                    break rest;
                }
            };
        }
    }

    /// Blocks that may have been placed last: those first that miss a neighbour already, so that
    /// one place is taken down after the other; of these the highest.
    fn candidates(&self, set: &Blocks) -> Vec<usize> {
        let of = &self.whole.assembly;
        let up = -of.gravity.normalize();
        let mut list: Vec<(bool, f64, usize)> = set
            .iter()
            .map(|&i| {
                let whole = self.neighbours[i].iter().all(|n| set.contains(n));
                (whole, -up.dot(&of.blocks[i].centroid), i)
            })
            .collect();
        list.sort_by(|a, b| (a.0.cmp(&b.0)).then(a.1.total_cmp(&b.1)).then(a.2.cmp(&b.2)));
        list.into_iter().map(|(.., i)| i).collect()
    }

    fn count(&mut self) -> Result<(), Halt> {
        if self.left == 0 || self.control.deadline.is_over() {
            return Err(Halt::Over);
        }
        self.left -= 1;
        Ok(())
    }

    /// The least holds with which a set stands, where so many do.
    fn holds(&mut self, set: &Blocks, most: usize) -> Result<Option<Blocks>, Halt> {
        let mut held = Blocks::new();
        for part in self.parts(set) {
            match self.least(&part, most - held.len())? {
                Some(more) => held.extend(more),
                None => return Ok(None),
            }
        }
        Ok(Some(held))
    }

    /// The parts of a set that do not touch each other.
    fn parts(&self, set: &Blocks) -> Vec<Blocks> {
        let list: Vec<usize> = set.iter().copied().collect();
        let mut joined = Sets::new(list.len());
        for (k, &i) in list.iter().enumerate() {
            for n in self.neighbours[i].range(..i) {
                if let Ok(other) = list.binary_search(n) {
                    joined.join(k, other);
                }
            }
        }
        let mut parts: BTreeMap<usize, Blocks> = BTreeMap::new();
        for (k, &i) in list.iter().enumerate() {
            parts.entry(joined.find(k)).or_default().insert(i);
        }
        parts.into_values().collect()
    }

    fn least(&mut self, part: &Blocks, most: usize) -> Result<Option<Blocks>, Halt> {
        let mut known = self.least.get(part).cloned().unwrap_or_default();
        while known.holds.is_none() && known.from <= most {
            let before = std::mem::take(&mut self.open);
            let found = self.hold(part, &Blocks::new(), known.from);
            known.open |= std::mem::replace(&mut self.open, before);
            known.holds = found?;
            known.from += usize::from(known.holds.is_none());
            self.least.insert(part.clone(), known.clone());
        }
        self.open |= known.open;
        Ok(known.holds.filter(|h| h.len() <= most))
    }

    /// Holds with which a part stands: `held` and up to so many more.
    fn hold(&mut self, part: &Blocks, held: &Blocks, more: usize) -> Result<Option<Blocks>, Halt> {
        let moves = match self.seen(part, held)? {
            WithHeld::Stands => return Ok(Some(held.clone())),
            WithHeld::Moves(moves) => moves,
            WithHeld::Open(may) => {
                self.open = true;
                may
            }
        };
        if more > 0 {
            for block in moves {
                let mut with = held.clone();
                with.insert(block);
                if let Some(found) = self.hold(part, &with, more - 1)? {
                    return Ok(Some(found));
                }
            }
        }
        Ok(None)
    }

    fn seen(&mut self, part: &Blocks, held: &Blocks) -> Result<WithHeld, Halt> {
        if part.len() == held.len() {
            return Ok(WithHeld::Stands);
        }
        let key = (part.clone(), held.clone());
        if let Some(seen) = self.seen.get(&key) {
            return Ok(seen.clone());
        }
        self.count()?;
        let of = &self.whole.assembly;
        let mut stage = Stage::whole(of.blocks.len());
        for i in of.free() {
            stage.present[i] = part.contains(&i);
            stage.held[i] = held.contains(&i);
        }
        let model = at_stage(self.scene, self.whole, &stage).map_err(Halt::Error)?;
        let verdict = self.known.assess(&model, self.control);
        let all = || part.difference(held).copied().collect();
        let seen = match verdict.verdict {
            Verdict::Stable => WithHeld::Stands,
            Verdict::Unstable => {
                let moving = self.moving(&model, &verdict.rates);
                WithHeld::Moves(if moving.is_empty() { all() } else { moving })
            }
            Verdict::Conditional => WithHeld::Moves(all()),
            Verdict::Undecided => WithHeld::Open(all()),
        };
        self.seen.insert(key, seen.clone());
        Ok(seen)
    }

    /// Blocks that move in a mechanism, what moves most first.
    fn moving(&self, model: &Model, rates: &[Rate]) -> Vec<usize> {
        let speed = |i: usize| {
            let size = model.assembly.blocks[i].size;
            rates[i].velocity.norm().max(rates[i].spin.norm() * size)
        };
        let speeds: Vec<(usize, f64)> = model.assembly.free().map(|i| (i, speed(i))).collect();
        let most = speeds.iter().map(|s| s.1).fold(0.0, f64::max);
        let mut moving: Vec<_> = speeds.into_iter().filter(|s| s.1 > STILL * most).collect();
        moving.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
        let name = |i: usize| self.whole.assembly.find(&model.assembly.blocks[i].id);
        moving.into_iter().filter_map(|(i, _)| name(i)).collect()
    }
}

/// A block that moves less than this share of the fastest is still. Larger: holds of slow blocks
/// are missed. Smaller: blocks are tried that move by rounding alone.
const STILL: f64 = 1e-9;
