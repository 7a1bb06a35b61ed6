//! What a bridge is computed with beside its blocks, in words.

use super::fill::{dispersal, resistance};
use crate::template::{Backing, Bridge, Distribution};
use base::number::short;

/// One line for each part of the model that can be switched, whether it is on or off.
pub fn said(bridge: &Bridge) -> Vec<String> {
    let Some(fill) = &bridge.fill else {
        return vec![
            "no fill: no weight on the rings, no spreading of loads, no passive pressure".into(),
        ];
    };
    let mut lines = vec![format!(
        "fill of {} N/m³, {} m over the crown, a bridge {} m wide",
        short(fill.unit_weight),
        short(fill.cover),
        short(bridge.width)
    )];
    let over = match fill.distribution {
        Distribution::Even => "evenly",
        Distribution::Boussinesq => "as in an elastic half-space (Boussinesq), truncated there",
    };
    lines.push(match (dispersal(fill), fill.dispersal_deg) {
        (0.0, _) => "loads do not spread in the fill (dispersal 0)".into(),
        (share, angle) => {
            let angle = angle.map_or_else(String::new, |a| format!(" ({}°)", short(a)));
            let share = short(share);
            format!("loads spread by {share} m per metre of depth{angle} to either side, {over}")
        }
    });
    lines.push(match resistance(fill) {
        k if k > 0.0 => {
            format!("passive pressure up to {} × unit weight × depth", short(k))
        }
        _ => "no passive pressure (neither passive nor friction_deg)".into(),
    });
    lines.push(match &fill.backing {
        Some(Backing { masonry: Some(material), height, behind, .. }) => format!(
            "backing of {material:?} up to {} m over the springings, as masonry in courses {}",
            short(*height),
            match behind {
                Some(behind) => format!(
                    "over the piers and, {} m wide, behind the springings of the ends",
                    short(*behind)
                ),
                None => "over the piers; none at the ends of the bridge".into(),
            }
        ),
        Some(b) => format!(
            "backing of {} N/m³ up to {} m over the springings, as fill (not masonry), with passive pressure up to {} × unit weight × depth",
            short(b.unit_weight.unwrap_or(fill.unit_weight)),
            short(b.height),
            short(b.passive.unwrap_or_else(|| resistance(fill)))
        ),
        None => "no backing".into(),
    });
    lines
}
