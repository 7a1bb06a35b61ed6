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
        self.surface.spans.iter().map(|s| s.map(|x| x + self.at[0]))
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
