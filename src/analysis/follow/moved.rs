//! The part of a scene that moves. What nothing that moves touches stays where it is, and none of
//! its quantities bears on how the rest is followed: not its weight, its size, nor its place.

use super::point::{End, Path, Point};
use crate::{Control, assess, limit};
use check::{
    path::{Carried, Drive, Move, Moves},
    terms::{Law, Outcome},
    verdict::{Forces, Rate, Verdict},
};
use model::{
    assembly::Pose,
    interface::{self, Model},
};
use nalgebra::Vector3;
use std::collections::HashSet;

/// The part that moves, and what the rest does meanwhile.
pub(super) struct Moved<'a> {
    whole: &'a Model,
    /// The part that moves with its supports.
    pub own: Model,
    /// Its blocks in the scene.
    blocks: Vec<usize>,
    /// Its contacts in the scene.
    faces: Vec<usize>,
    /// Its members in the scene.
    members: Vec<usize>,
    /// Forces that hold the rest, contact by contact and member by member of the scene; none in its
    /// own.
    still: Forces,
}

impl<'a> Moved<'a> {
    /// The part that is moved; nothing where that is the whole scene, or where the rest falls by
    /// itself or under less live load, so that it decides.
    pub fn of(whole: &'a Model, drive: &Drive, control: &Control) -> Option<Self> {
        let (blocks, list) = (&whole.assembly.blocks, &whole.interfaces.list);
        let joined = &whole.interfaces.members;
        let moves = |part: &interface::Members| match drive {
            Drive::Settle(Moves(moves)) => {
                let goes = |i: usize| {
                    moves.iter().any(|m| (m.way, m.turn) != Default::default() && i == m.support)
                };
                part.contacts.iter().any(|&k| goes(list[k].a) || goes(list[k].b))
                    || part
                        .members
                        .iter()
                        .any(|&m| joined[m].action.ends().into_iter().flatten().any(goes))
            }
            Drive::Push { block, .. } => part.free.contains(block),
        };
        let (moving, resting): (Vec<_>, Vec<_>) =
            interface::members(whole).into_iter().partition(moves);
        let free = |parts: &[interface::Members]| -> Vec<usize> {
            parts.iter().flat_map(|part| part.free.iter().copied()).collect()
        };
        let (moving, resting) = (free(&moving), free(&resting));
        if moving.is_empty() || resting.is_empty() {
            return None;
        }
        let (own, rest) = (whole.without(&resting), whole.without(&moving));
        let statics = Control { law: Law::Associative, ..*control };
        let held = assess(&rest, &statics);
        if held.verdict != Verdict::Stable || (drive.is_push() && !bears(&rest, &own, &statics)) {
            return None;
        }
        let mut is_own = vec![true; blocks.len()];
        resting.iter().for_each(|&i| is_own[i] = false);
        let (faces, others): (Vec<usize>, Vec<usize>) =
            (0..list.len()).partition(|&k| is_own[list[k].a] && is_own[list[k].b]);
        // As `without` has them: a member goes with any of its blocks.
        let untouched = |gone: &[usize]| -> Vec<usize> {
            let stays = |m: &usize| {
                !joined[*m].action.ends().into_iter().flatten().any(|i| gone.contains(&i))
            };
            (0..joined.len()).filter(stays).collect()
        };
        let (members, strangers) = (untouched(&resting), untouched(&moving));
        let mut still = vec![Vec::new(); list.len() + joined.len()];
        let places = others.into_iter().chain(strangers.into_iter().map(|m| list.len() + m));
        places.zip(&held.forces).for_each(|(k, f)| still[k].clone_from(f));
        // Behind the joints that there are stand those that may come to be, in the same order.
        let joints = Carried::new(whole).joints.into_iter().enumerate().skip(list.len());
        let faces = faces
            .into_iter()
            .chain(joints.filter(|(_, f)| is_own[f.a] && is_own[f.b]).map(|(k, _)| k))
            .collect();
        let blocks = (0..blocks.len()).filter(|&i| is_own[i]).collect();
        Some(Self { whole, own, blocks, faces, members, still })
    }

    /// The drive by the numbers of the part.
    pub fn drive(&self, drive: &Drive) -> Drive {
        let own = |i: usize| self.blocks.binary_search(&i).ok();
        match drive {
            Drive::Settle(Moves(moves)) => Drive::Settle(Moves(
                moves
                    .iter()
                    .filter_map(|m| Some(Move { support: own(m.support)?, ..*m }))
                    .collect(),
            )),
            Drive::Push { block, point, toward } => {
                Drive::Push { block: own(*block).unwrap_or(*block), point: *point, toward: *toward }
            }
        }
    }

    /// A path of the part as one of the scene.
    pub fn path(&self, own: Path) -> Path {
        let end = match own.end {
            End::Falls(ends) => End::Falls(Box::new(ends.map(|p| self.point(p)))),
            End::Slides(k) => End::Slides(self.faces[k]),
            other => other,
        };
        let first = own.first.map(|(forces, rates)| {
            let mut all = self.still.clone();
            let first = self.whole.interfaces.list.len();
            let own = self.faces.iter().copied().filter(|k| *k < first);
            let places = own.chain(self.members.iter().map(|m| first + m));
            places.zip(forces).for_each(|(k, f)| all[k] = f);
            (all, self.rates(&rates))
        });
        Path {
            points: own.points.into_iter().map(|p| self.point(p)).collect(),
            events: own.events,
            end,
            first,
            between: own.between,
        }
    }

    fn point(&self, own: Point) -> Point {
        let list = &self.whole.interfaces.list;
        let poses = self.poses(&own.poses);
        let mut closed: Vec<Vec<usize>> =
            list.iter().map(|f| (0..f.points.len()).collect()).collect();
        let own_faces = || self.faces.iter().filter(|k| **k < list.len());
        own_faces().zip(own.closed.clone()).for_each(|(&k, c)| closed[k] = c);
        let rates = if own.rates.is_empty() { Vec::new() } else { self.rates(&own.rates) };
        if let Some(touch) = own.touch {
            return self.slid(poses, closed, rates, Point { touch: None, ..own }, touch);
        }
        // Forces stand at what touches: at joints without a closed corner there are none.
        let mut given = own.forces.into_iter();
        let mut is_own = vec![false; list.len()];
        own_faces().for_each(|&k| is_own[k] = true);
        let mut own_member = vec![false; self.whole.interfaces.members.len()];
        self.members.iter().for_each(|&m| own_member[m] = true);
        let places = (0..list.len()).filter(|&k| !closed[k].is_empty()).map(|k| (k, is_own[k]));
        let members = own_member.into_iter().enumerate().map(|(m, own)| (list.len() + m, own));
        let forces = places
            .chain(members)
            .map(
                |(k, own)| {
                    if own { given.next().unwrap_or_default() } else { self.still[k].clone() }
                },
            )
            .collect();
        Point { poses, closed, forces, rates, ..own }
    }

    /// A point of the part after sliding: its contacts among those of the scene.
    fn slid(
        &self,
        poses: Vec<Pose>,
        closed: Vec<Vec<usize>>,
        rates: Vec<Rate>,
        own: Point,
        touch: Vec<(usize, Vec<Vector3<f64>>)>,
    ) -> Point {
        let list = &self.whole.interfaces.list;
        let mut all = Vec::new();
        // Of every contact of the scene which of the part it is; none for what rests.
        let mut which = Vec::new();
        let last = self.faces.iter().max().map_or(list.len(), |k| list.len().max(k + 1));
        for k in 0..last {
            match self.faces.iter().position(|&f| f == k) {
                None => {
                    let Some(face) = list.get(k) else { continue };
                    all.push((k, face.points.clone()));
                    which.push(Err(k));
                }
                Some(part) => {
                    for (c, (_, at)) in touch.iter().enumerate().filter(|(_, t)| t.0 == part) {
                        all.push((k, at.clone()));
                        which.push(Ok(c));
                    }
                }
            }
        }
        let of = |own: &Forces| -> Forces {
            let here = which.iter().filter_map(|place| match place {
                Ok(c) => own.get(*c),
                Err(k) => Some(&self.still[*k]),
            });
            here.chain(self.still.iter().skip(list.len())).cloned().collect()
        };
        let (forces, proving) = (of(&own.forces), own.proving.as_ref().map(of));
        Point { poses, closed, rates, forces, proving, touch: Some(all), ..own }
    }

    /// Pairs of its blocks that touch or may come to.
    pub fn joined(&self) -> HashSet<(usize, usize)> {
        let joints = Carried::new(self.whole).joints;
        self.faces
            .iter()
            .filter_map(|&k| joints.get(k))
            .map(|f| (f.a.min(f.b), f.a.max(f.b)))
            .collect()
    }

    /// Poses of the part.
    pub fn own_poses(&self, whole: &[Pose]) -> Vec<Pose> {
        self.blocks.iter().map(|&i| whole[i]).collect()
    }

    /// Poses of all blocks.
    pub fn poses(&self, own: &[Pose]) -> Vec<Pose> {
        let mut poses = vec![Pose::start(); self.whole.assembly.blocks.len()];
        self.blocks.iter().zip(own).for_each(|(&i, pose)| poses[i] = *pose);
        poses
    }

    fn rates(&self, own: &[Rate]) -> Vec<Rate> {
        let mut all = vec![Rate::zero(); self.whole.assembly.blocks.len()];
        self.blocks.iter().zip(own).for_each(|(&i, q)| all[i] = *q);
        all
    }
}

/// Whether the rest bears as much live load as the part that is pushed.
fn bears(rest: &Model, own: &Model, control: &Control) -> bool {
    let factor = |model: &Model| {
        let l = limit(model, control);
        match l.outcome {
            Outcome::Found => l.value,
            Outcome::Unbounded => Some(f64::INFINITY),
            Outcome::Impossible | Outcome::Undecided => None,
        }
    };
    let loaded = rest.assembly.live.iter().any(|w| *w != model::assembly::Wrench::zero());
    !loaded || factor(rest).zip(factor(own)).is_some_and(|(rest, own)| own < rest)
}
