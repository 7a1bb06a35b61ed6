//! The members of a template, placed like its blocks.

use super::bridge;
use crate::{
    Member, Template,
    member::{End, Face},
};

/// The members of a template as a scene has them: names with the prefix, points in its coordinates.
pub fn members(template: &Template) -> Vec<Member> {
    let (prefix, at) = template.place();
    let made = match template {
        Template::Bridge(t) => bridge::soil(t),
        _ => Vec::new(),
    };
    template.members().iter().chain(&made).map(|m| m.placed(prefix, at)).collect()
}

impl Member {
    /// The same with a prefix before all names, moved.
    #[must_use]
    pub fn placed(&self, prefix: &str, by: [f64; 3]) -> Self {
        let name = |id: &mut String| id.insert_str(0, prefix);
        let mut this = self.clone();
        name(&mut this.id);
        this.each_point(|p| *p = std::array::from_fn(|k| p[k] + by[k]));
        this.each_height(|z| *z += by[2]);
        this.each_block(name);
        this
    }

    /// The names of the blocks that it joins.
    pub fn blocks(&self) -> Vec<String> {
        let mut list = Vec::new();
        self.clone().each_block(|id| list.push(id.clone()));
        list
    }

    fn each_end(&mut self) -> Vec<&mut End> {
        let lines = [&mut self.tie, &mut self.strut].into_iter().flatten();
        let mut ends: Vec<&mut End> = lines.flat_map(|l| &mut l.between).collect();
        ends.extend(self.bar.iter_mut().flat_map(|b| &mut b.between));
        ends.extend(self.tendon.iter_mut().flat_map(|t| &mut t.through));
        ends
    }

    fn each_point(&mut self, mut change: impl FnMut(&mut [f64; 3])) {
        for end in self.each_end() {
            end.at.iter_mut().chain(&mut end.ground).for_each(&mut change);
        }
        self.dowel.iter_mut().for_each(|d| change(&mut d.at));
        let grips = self.grip.iter_mut();
        grips
            .flat_map(|g| g.at.iter_mut().chain(g.fingers.iter_mut().map(|f| &mut f.at)))
            .for_each(&mut change);
        let faces = self.strip.iter_mut().map(|s| &mut s.face);
        for face in faces.chain(self.soil.iter_mut().map(|s| &mut s.face)) {
            if let Face::Near(near) = face {
                change(&mut near.near);
            }
        }
    }

    fn each_height(&mut self, mut change: impl FnMut(&mut f64)) {
        self.soil.iter_mut().for_each(|s| change(&mut s.surface));
        self.toothing.iter_mut().for_each(|t| change(&mut t.height));
    }

    fn each_block(&mut self, mut change: impl FnMut(&mut String)) {
        for end in self.each_end() {
            end.block.iter_mut().for_each(&mut change);
        }
        self.strip.iter_mut().flat_map(|s| &mut s.blocks).for_each(&mut change);
        self.dowel.iter_mut().flat_map(|d| &mut d.blocks).for_each(&mut change);
        self.soil.iter_mut().for_each(|s| change(&mut s.block));
        self.grip.iter_mut().for_each(|g| change(&mut g.block));
        self.toothing.iter_mut().for_each(|t| change(&mut t.block));
    }
}
