//! Orders in which a structure can be built block by block, with as few blocks held as can be.
//!
//! Sets of blocks are looked at backwards, from the whole structure on: a block may be the last one
//! that was placed where the others stand, by themselves or with some of them held. What has to be
//! held is a hitting set: a mechanism goes on as long as none of the blocks that move in it is held.
//! Parts that do not touch are asked for themselves, once each.
//!
//! That a set stands is proved afterwards, as a stage ([`super::stages`]). That no order does with
//! fewer holds is the outcome of a search through all of them: computed, not proved.

use super::{Control, known::Known};
use crate::{
    assembly::{Placed, Stage},
    error::InputError,
    interface::{Model, at_stage},
    plane::Sets,
    scene::Scene,
    terms::Order,
    verdict::{Rate, Verdict},
};
use std::collections::{BTreeMap, BTreeSet, HashMap, HashSet};

/// Sets looked at where nothing else is said. Fewer: of walls over an arch the least holds are not
/// found. More: minutes pass before what was found without a search is said.
pub const TRIES: usize = 5000;

type Blocks = BTreeSet<usize>;

/// What a set of blocks does with some of them held.
#[derive(Clone)]
enum Seen {
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
    seen: HashMap<(Blocks, Blocks), Seen>,
    least: HashMap<Blocks, Least>,
    left: usize,
    /// Some verdict was undecided: what is not found may be there.
    open: bool,
}

/// An order in which every stage stands, with the least number of blocks held at a time; a given
/// one (indices of all free blocks, the first placed first) with the least holds at each stage.
/// Nothing is placed where time was up before an order was found.
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
    let found = match given {
        Some(list) => search.given(list, tries),
        None => search.any(tries),
    };
    let (placed, least_held) = found?;
    let id = |i: usize| model.assembly.blocks[i].id.clone();
    let placed = placed
        .into_iter()
        .map(|(block, held)| Placed { block: id(block), held: held.into_iter().map(id).collect() });
    Ok(Order { given: given.is_some(), tries, least_held, placed: placed.collect() })
}

type Found = (Vec<(usize, Blocks)>, usize);

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

    /// Any order, with as few held at a time as tries allow, and the number below which none was
    /// missed. Where tries or time are up, the best of what can be had without a search.
    fn any(&mut self, tries: usize) -> Result<Found, InputError> {
        let all: Blocks = self.whole.assembly.free().collect();
        self.left = tries;
        let mut least = 0;
        for most in 0..=all.len() {
            self.open = false;
            let mut order = Vec::new();
            match self.build(&all, most, &mut HashSet::new(), &mut order) {
                Ok(true) => return Ok((order, least)),
                Ok(false) if least == most && !self.open => least = most + 1,
                Ok(false) => {}
                Err(Halt::Over) => break,
                Err(Halt::Error(e)) => return Err(e),
            }
        }
        let mut down = Vec::new();
        let mut set = all;
        while let Some(&block) = self.candidates(&set).first() {
            set.remove(&block);
            down.push(block);
        }
        down.reverse();
        Ok((self.unsearched(&down)?, least))
    }

    /// The least holds at every stage of a given order, as far as tries go.
    fn given(&mut self, list: &[usize], tries: usize) -> Result<Found, InputError> {
        self.left = tries;
        let (mut set, mut order, mut least) = (Blocks::new(), Vec::new(), 0);
        for &block in list {
            set.insert(block);
            self.open = false;
            match self.holds(&set, list.len()) {
                Ok(Some(held)) => {
                    least = least.max(if self.open { 0 } else { held.len() });
                    order.push((block, held));
                }
                Ok(None) => return Ok((Vec::new(), least)),
                Err(Halt::Over) => return Ok((self.unsearched(list)?, least)),
                Err(Halt::Error(e)) => return Err(e),
            }
        }
        Ok((order, least))
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
        while let Seen::Moves(list) | Seen::Open(list) = self.seen(part, &held)? {
            let Some(&first) = list.first() else { break };
            let stay = part.intersection(before).filter(|i| !held.contains(i)).copied();
            let more: Vec<usize> = stay.collect();
            held.extend(if more.is_empty() { vec![first] } else { more });
        }
        Ok(held)
    }

    /// Whether a set can be built with at most so many held at a time; then `order` is how.
    fn build(
        &mut self,
        set: &Blocks,
        most: usize,
        failed: &mut HashSet<Blocks>,
        order: &mut Vec<(usize, Blocks)>,
    ) -> Result<bool, Halt> {
        let Some(held) = self.holds(set, most)? else { return Ok(false) };
        if set.len() == 1 {
            order.extend(set.iter().map(|&only| (only, held.clone())));
            return Ok(true);
        }
        for block in self.candidates(set) {
            let mut rest = set.clone();
            rest.remove(&block);
            if failed.contains(&rest) {
                continue;
            }
            self.count()?;
            if self.build(&rest, most, failed, order)? {
                order.push((block, held));
                return Ok(true);
            }
            failed.insert(rest);
        }
        Ok(false)
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
            Seen::Stands => return Ok(Some(held.clone())),
            Seen::Moves(moves) => moves,
            Seen::Open(may) => {
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

    fn seen(&mut self, part: &Blocks, held: &Blocks) -> Result<Seen, Halt> {
        if part.len() == held.len() {
            return Ok(Seen::Stands);
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
            Verdict::Stable => Seen::Stands,
            Verdict::Unstable => {
                let moving = self.moving(&model, &verdict.rates);
                Seen::Moves(if moving.is_empty() { all() } else { moving })
            }
            Verdict::Conditional => Seen::Moves(all()),
            Verdict::Undecided => Seen::Open(all()),
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
