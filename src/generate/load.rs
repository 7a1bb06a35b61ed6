//! The dead loads that a template brings, placed like its blocks.

use super::bridge::{self, Spread};
use crate::scene::{At, Load, OnRoad, Template};

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

/// What a force on the road does to a template; nothing where it has no road, or none there.
pub fn on_road(template: &Template, on: OnRoad, force: [f64; 3]) -> Option<Spread> {
    let Template::Bridge(t) = template else { return None };
    let (prefix, at) = template.place();
    let spread = bridge::spread(t, OnRoad { x: on.x - at[0], ..on }, force);
    let loads: Vec<Load> = spread.loads.into_iter().map(|l| placed(l, prefix, at)).collect();
    (!loads.is_empty()).then_some(Spread { loads, ..spread })
}

/// The same load with a prefix before its block, moved.
fn placed(mut load: Load, prefix: &str, by: [f64; 3]) -> Load {
    load.block.iter_mut().for_each(|id| id.insert_str(0, prefix));
    if let Some(At::Point(p)) = &mut load.at {
        *p = std::array::from_fn(|k| p[k] + by[k]);
    }
    load
}
