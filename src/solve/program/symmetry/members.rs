//! Where an isometry takes the members of a scene: among themselves, or nowhere.

use base::tolerance;
use model::{
    assembly::{Action, Anchor, Member},
    interface::Model,
};
use nalgebra::{Matrix3, Vector3};
use std::collections::HashMap;

/// The image of each member, given those of the free blocks and of places; `None` where one has
/// none, or acts by more than one amount. Members that can take no force are their own images.
pub fn images(
    model: &Model,
    blocks: &[usize],
    place: impl Fn(&Vector3<f64>) -> Vector3<f64>,
    turn: &Matrix3<f64>,
) -> Option<Vec<usize>> {
    let members = &model.interfaces.members;
    let free = |end: End| end.filter(|&i| !model.assembly.blocks[i].support);
    let ends = |member: &Member, image: &dyn Fn(usize) -> usize| {
        let ends = member.action.ends().into_iter();
        let mut list: Vec<End> = ends.map(|end| free(end).map(image)).collect();
        list.sort_unstable();
        list
    };
    let mut between: HashMap<Vec<End>, Vec<usize>> = HashMap::new();
    for (m, member) in members.iter().enumerate().filter(|(_, m)| !m.is_idle()) {
        between.entry(ends(member, &|i| i)).or_default().push(m);
    }
    let mut taken = vec![false; members.len()];
    let mut image = |m: usize| {
        let member = &members[m];
        let size = member.action.ends().into_iter().filter_map(free);
        let size = size.map(|i| model.assembly.blocks[i].size).fold(f64::INFINITY, f64::min);
        let block = |end: End| free(end).map(|i| blocks[i]);
        let same_block = |a: End, b: End| block(a) == free(b);
        let near = |a: &Vector3<f64>, b: &Vector3<f64>| {
            (place(a) - b).norm() <= tolerance::SYMMETRY * size
        };
        let acts_as = |other: &Action| match (&member.action, other) {
            (Action::Line(a), Action::Line(b)) => {
                let same =
                    |(a, b): (&Anchor, &Anchor)| same_block(a.block, b.block) && near(&a.at, &b.at);
                a.len() == b.len()
                    && (a.iter().zip(b).all(same) || a.iter().zip(b.iter().rev()).all(same))
            }
            (
                Action::Push { on, from, at, direction },
                Action::Push { on: other_on, from: other_from, at: other_at, direction: other },
            ) => {
                // A pair of opposite forces is the same whichever block is named first.
                let is = |a: End, b: End, sign: f64| {
                    same_block(Some(*on), a)
                        && same_block(*from, b)
                        && (turn * direction * sign - other).norm() <= tolerance::SYMMETRY
                };
                near(at, other_at)
                    && (is(Some(*other_on), *other_from, 1.0)
                        || is(*other_from, Some(*other_on), -1.0))
            }
            _ => false,
        };
        let candidates = between.get(&ends(member, &|i| blocks[i]))?;
        let is =
            |c: &usize| !taken[*c] && alike(member, &members[*c]) && acts_as(&members[*c].action);
        let found = candidates.iter().copied().find(is)?;
        taken[found] = true;
        Some(found)
    };
    (0..members.len()).map(|m| if members[m].is_idle() { Some(m) } else { image(m) }).collect()
}

/// A block, or the ground, which all supports are.
type End = Option<usize>;

/// Whether two members have the same bounds, prestress and stiffness.
fn alike(a: &Member, b: &Member) -> bool {
    let same =
        |a: f64, b: f64| a == b || (a - b).abs() <= tolerance::SYMMETRY * a.abs().max(b.abs());
    let stiffness = match (a.stiffness, b.stiffness) {
        (Some(a), Some(b)) => same(a, b),
        (a, b) => a.is_none() && b.is_none(),
    };
    a.kind == b.kind
        && same(a.least, b.least)
        && same(a.greatest, b.greatest)
        && same(a.prestress, b.prestress)
        && stiffness
}
