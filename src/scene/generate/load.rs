//! The dead loads that a template brings, placed like its blocks.

use super::bridge::{self, Spread};
use crate::{At, Load, OnRoad, Template};

/// The dead loads of a template as a scene has them: names with the prefix, points in its
/// coordinates.
pub fn loads(template: &Template) -> Vec<Load> {
    let (prefix, at) = template.place();
    let own = match template {
        Template::Bridge(t) => bridge::loads(t),
        _ => Vec::new(),
    };
    own.into_iter().map(|l| placed(l, prefix, at)).collect()
}

/// What a template is computed with beside its blocks, in words: parts of its model that can be
/// switched.
pub fn said(template: &Template) -> Vec<String> {
    match template {
        Template::Bridge(t) => bridge::said(t),
        _ => Vec::new(),
    }
}

/// The road of a template, made ready for any number of loads.
pub struct Road {
    surface: bridge::Surface,
    prefix: String,
    at: [f64; 3],
}

impl Road {
    /// Nothing where the template has no road.
    pub fn of(template: &Template) -> Option<Self> {
        let Template::Bridge(t) = template else { return None };
        let (prefix, at) = template.place();
        Some(Self { surface: bridge::Surface::of(t)?, prefix: prefix.into(), at })
    }

    /// Both springings of the intrados of every span, x in the scene, m.
    pub fn spans(&self) -> impl Iterator<Item = [f64; 2]> + '_ {
        self.surface.openings.iter().map(|s| s.springings.map(|[x, _]| x + self.at[0]))
    }

    /// The upper surface of the structure and the road above it from left to right, points in the
    /// scene, m; without fill no road.
    pub fn outline(&self) -> [Vec<[f64; 3]>; 2] {
        let below: Vec<[f64; 3]> = self.surface.line().map(|[x, z]| self.placed(x, z)).collect();
        let ends = [below.first(), below.last()].into_iter().flatten();
        let road = ends.filter(|_| self.surface.is_filled()).map(|p| self.on(p[0])).collect();
        [below, road]
    }

    /// Of every span both springings and the crown of the intrados, and the extrados over it, m.
    pub fn openings(&self) -> impl Iterator<Item = [[f64; 3]; 4]> + '_ {
        self.surface.openings.iter().map(|o| {
            let ([left, right], [x, z]) = (o.springings, o.crown);
            [left, right, o.crown, [x, z + o.thickness]].map(|[x, z]| self.placed(x, z))
        })
    }

    /// Where a wheel stands, its x in the scene, m.
    pub fn on(&self, x: f64) -> [f64; 3] {
        let own = x - self.at[0];
        self.placed(own, self.surface.height(own))
    }

    fn placed(&self, x: f64, z: f64) -> [f64; 3] {
        [x + self.at[0], self.at[1], z + self.at[2]]
    }

    /// What a force on the road does to the template; nothing where it has no road there.
    pub fn under(&self, on: OnRoad, force: [f64; 3]) -> Option<Spread> {
        let spread = self.surface.spread(OnRoad { x: on.x - self.at[0], ..on }, force);
        let own = spread.loads.into_iter();
        let loads: Vec<Load> = own.map(|l| placed(l, &self.prefix, self.at)).collect();
        (!loads.is_empty()).then_some(Spread { loads, ..spread })
    }
}

/// What a force on the road does to a template; nothing where it has no road, or none there.
pub fn on_road(template: &Template, on: OnRoad, force: [f64; 3]) -> Option<Spread> {
    Road::of(template)?.under(on, force)
}

/// The same load with a prefix before its block, moved.
fn placed(mut load: Load, prefix: &str, by: [f64; 3]) -> Load {
    load.block.iter_mut().for_each(|id| id.insert_str(0, prefix));
    if let Some(At::Point(p)) = &mut load.at {
        *p = std::array::from_fn(|k| p[k] + by[k]);
    }
    load
}
