//! Members that depend on contacts: the joints that a strip crosses, the joint of a dowel.

use super::{Interface, Interfaces};
use crate::assembly::{
    Action, Assembly, BlockFace, DowelPlan, Member, MemberKind, MemberPlan, StripPlan,
};
use base::{
    error::{Finding, FindingCode, InputError},
    tolerance,
};
use nalgebra::Vector3;
use std::collections::HashSet;

impl Interfaces {
    /// Takes over the members of an assembly, whose contacts these are; says what has no effect.
    ///
    /// # Errors
    /// A strip or a dowel crosses no joint.
    pub(super) fn join(&mut self, assembly: &Assembly) -> Result<Vec<Finding>, InputError> {
        let mut told = Vec::new();
        self.members.clear();
        for plan in &assembly.members {
            match plan {
                MemberPlan::Whole(member) => self.members.push(member.clone()),
                MemberPlan::Dowel(plan) => {
                    let dowel = dowel(plan, &self.list, assembly)?;
                    self.members.push(dowel);
                }
                MemberPlan::Strip(plan) => {
                    let (joints, bare) = strip(plan, &self.list, assembly)?;
                    if bare > 0 {
                        let text = format!(
                            "strip {:?} carries no force at {bare} joints nearer to a free end than its development length",
                            plan.id
                        );
                        told.push(Finding::new(FindingCode::WithoutEffect, text));
                    }
                    self.members.extend(joints);
                }
            }
        }
        let mut seen = HashSet::new();
        if let Some(twice) = self.members.iter().find(|m| !seen.insert(m.id.as_str())) {
            let text = format!("two members, or parts of members, have the id {:?}", twice.id);
            return Err(InputError::at(twice.path.clone(), text)
                .hint("joints of a strip and fingers of a grip are called \"id/1\", \"id/2\", …"));
        }
        Ok(told)
    }
}

/// The contacts of two blocks.
fn between(list: &[Interface], a: usize, b: usize) -> impl Iterator<Item = &Interface> {
    list.iter().filter(move |f| (f.a == a && f.b == b) || (f.a == b && f.b == a))
}

fn dowel(plan: &DowelPlan, list: &[Interface], assembly: &Assembly) -> Result<Member, InputError> {
    let [a, b] = plan.blocks;
    let distance = |f: &Interface| {
        let off = |p: &Vector3<f64>| (p - plan.at).norm();
        let plane = f.frame.n.dot(&(plan.at - f.points[0])).abs();
        (plane, f.points.iter().map(off).fold(f64::INFINITY, f64::min))
    };
    let nearest =
        between(list, a, b).map(|f| (distance(f), f)).reduce(|x, y| if y.0 < x.0 { y } else { x });
    let Some((_, face)) = nearest else {
        let [one, two] = plan.blocks.map(|i| &assembly.blocks[i].id);
        return Err(InputError::at(
            plan.path.key("blocks"),
            format!("blocks {one:?} and {two:?} do not touch: the dowel crosses no joint"),
        )
        .hint("name two blocks that touch, or give \"normal\": [x, y, z]"));
    };
    Ok(Member {
        id: plan.id.clone(),
        path: plan.path.clone(),
        kind: MemberKind::Dowel,
        action: Action::Shear { blocks: [a, b], at: plan.at, normal: face.frame.n },
        least: 0.0,
        greatest: plan.strength,
        prestress: 0.0,
        stiffness: None,
    })
}

/// The joints of a strip, and how many lie too near a free end to carry anything.
fn strip(
    plan: &StripPlan,
    list: &[Interface],
    assembly: &Assembly,
) -> Result<(Vec<Member>, usize), InputError> {
    let edges: Vec<Edge> = plan
        .run
        .windows(2)
        .map(|pair| {
            let [(a, face), (b, other)] = pair else { return None };
            let known = face.as_ref().or(other.as_ref())?;
            let size = assembly.blocks[*a].size.min(assembly.blocks[*b].size);
            between(list, *a, *b).find_map(|f| Edge::of(f, *a, known, size))
        })
        .enumerate()
        .map(|(k, edge)| {
            edge.ok_or_else(|| {
                let [one, two] = [k, k + 1].map(|k| &assembly.blocks[plan.run[k].0].id);
                InputError::at(
                    plan.path.key("blocks").index(k + 1),
                    format!("blocks {one:?} and {two:?} share no edge on this face"),
                )
                .hint("list neighbours in order, with a face that they have in common")
            })
        })
        .collect::<Result<_, _>>()?;
    // From each end of the run, how far it is to each joint.
    let lengths = |forwards: bool| -> Vec<f64> {
        let n = edges.len();
        let at = |k: usize| if forwards { k } else { n - 1 - k };
        let (block, face) = &plan.run[if forwards { 0 } else { n }];
        // A support holds the end of the strip.
        let mut sum = match face {
            _ if assembly.blocks[*block].support => f64::INFINITY,
            Some(face) => face.reach(&edges[at(0)]),
            None => f64::INFINITY,
        };
        let mut list = vec![0.0; n];
        for k in 0..n {
            if k > 0 {
                sum += (edges[at(k)].at - edges[at(k - 1)].at).norm();
            }
            list[at(k)] = sum;
        }
        list
    };
    let (from, to) = (lengths(true), lengths(false));
    let carries = |k: usize| from[k].min(to[k]) >= plan.development;
    let joint = |k: usize| Member {
        id: format!("{}/{}", plan.id, k + 1),
        path: plan.path.clone(),
        kind: MemberKind::Strip,
        action: Action::Push {
            on: plan.run[k + 1].0,
            from: Some(plan.run[k].0),
            at: edges[k].at,
            direction: -edges[k].normal,
        },
        least: 0.0,
        greatest: plan.strength,
        prestress: 0.0,
        stiffness: None,
    };
    let moves = |k: usize| [k, k + 1].iter().any(|&k| !assembly.blocks[plan.run[k].0].support);
    let kept: Vec<usize> = (0..edges.len()).filter(|&k| moves(k)).collect();
    let bare = kept.iter().filter(|&&k| !carries(k)).count();
    Ok((kept.into_iter().filter(|&k| carries(k)).map(joint).collect(), bare))
}

/// The edge of a joint on the face that a strip is bonded to.
struct Edge {
    /// Its middle, m.
    at: Vector3<f64>,
    /// Normal of the joint, from the block before to the one after.
    normal: Vector3<f64>,
}

impl Edge {
    /// The edge of a contact on a face of one of its blocks; `None` where it has none there.
    fn of(contact: &Interface, before: usize, face: &BlockFace, size: f64) -> Option<Self> {
        // How far off the face's own corners a corner of the contact lies, across the face.
        let off = |p: &Vector3<f64>| {
            let across = |q: &Vector3<f64>| face.normal.dot(&(p - q)).abs();
            let near =
                face.corners.iter().min_by(|a, b| (*a - p).norm().total_cmp(&(*b - p).norm()))?;
            Some(across(near).min((near - p).norm()))
        };
        let on: Vec<&Vector3<f64>> = contact
            .points
            .iter()
            .filter(|p| off(p).is_some_and(|d| d <= tolerance::ON_FACE * size))
            .collect();
        if on.is_empty() || on.len() == contact.points.len() {
            return None;
        }
        let at = on.iter().copied().sum::<Vector3<f64>>() / on.len() as f64;
        let n = contact.frame.n;
        Some(Self { at, normal: if contact.a == before { n } else { -n } })
    }
}

impl BlockFace {
    /// How far a face reaches from an edge of it, m.
    fn reach(&self, edge: &Edge) -> f64 {
        self.corners.iter().map(|p| edge.normal.dot(&(p - edge.at)).abs()).fold(0.0, f64::max)
    }
}
