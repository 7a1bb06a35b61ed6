//! Members: where they end, and whether their strength says what somebody meant.

use super::{Told, Weights, bounds, loads::Off, short};
use crate::assembly::{Assembly, Block, MemberKind, MemberPlan};
use base::error::{Finding, FindingCode, InputError, JsonPath};
use nalgebra::Vector3;
use scene::Member as Spec;
use std::collections::HashMap;

/// Refuses a point of a member that lies far off its block, where no arm is said to carry the
/// force; `path` is that of the point.
///
/// # Errors
/// It does.
pub(in crate::assembly) fn point(
    block: &Block,
    at: Vector3<f64>,
    arm: bool,
    assembly: &Assembly,
    path: &JsonPath,
) -> Result<(), InputError> {
    match Off::at(at, arm, block) {
        Some(off) if off.distance > bounds::FAR_OFF * block.size => {
            let meant =
                off.meant(block, assembly).map_or(String::new(), |meant| format!("{meant}; "));
            let hint = format!("{meant}if an arm carries the force that far, set \"arm\": true");
            Err(InputError::at(path.clone(), off.words("the member", block)).hint(hint))
        }
        _ => Ok(()),
    }
}

/// What looks like a mistake in resolved members.
pub(in crate::assembly) fn members(
    plans: &[MemberPlan],
    specs: &[(Spec, JsonPath)],
    assembly: &Assembly,
) -> Vec<Finding> {
    let (mut off, mut units) = (Told::default(), Told::default());
    if plans.is_empty() {
        return Vec::new();
    }
    let index: HashMap<&str, usize> =
        assembly.blocks.iter().enumerate().map(|(i, b)| (b.id.as_str(), i)).collect();
    let find = |id: &str| index.get(id).map(|&i| &assembly.blocks[i]);
    let is_heavy = Weights::of(assembly).is_some();
    for (spec, path) in specs {
        let ends = [&spec.tie, &spec.strut]
            .into_iter()
            .flatten()
            .flat_map(|l| &l.between)
            .chain(spec.bar.iter().flat_map(|b| &b.between))
            .chain(spec.tendon.iter().flat_map(|t| &t.through))
            .filter_map(|e| Some((find(e.block.as_deref()?)?, e.at?, e.arm)))
            .chain(spec.grip.iter().flat_map(|g| {
                g.all().into_iter().filter_map(|f| Some((find(&g.block)?, f.at, g.arm)))
            }))
            .chain(
                spec.dowel
                    .iter()
                    .flat_map(|d| d.blocks.iter().filter_map(|id| Some((find(id)?, d.at, false)))),
            );
        for (block, at, arm) in ends {
            if let Some(o) = Off::at(at.into(), arm, block) {
                off.add("off", || o.told(("the member", "the force"), block, assembly, path));
            }
        }
        let soil = spec.soil.iter().map(|s| (path.key("soil"), s.unit_weight));
        let walls = spec.toothing.iter().map(|t| (path.key("toothing"), t.unit_weight));
        for (path, weight) in soil.chain(walls) {
            if bounds::UNIT_WEIGHT_IN_KILONEWTONS.contains(&weight) && is_heavy {
                units.add("unit_weight", || {
                    format!(
                        "{} is {} N/m³, lighter than any soil or masonry. It looks like kN/m³: write {:e}",
                        path.key("unit_weight"),
                        short(weight),
                        weight * 1e3
                    )
                });
            }
        }
    }
    for plan in plans {
        let MemberPlan::Whole(member) = plan else { continue };
        // What these can take follows from other numbers.
        if !is_heavy || matches!(member.kind, MemberKind::Soil | MemberKind::Toothing) {
            continue;
        }
        let weight = member
            .action
            .ends()
            .into_iter()
            .flatten()
            .filter(|&b| !assembly.blocks[b].support)
            .map(|b| assembly.weight(b))
            .fold(0.0, f64::max);
        let strength = member.greatest.max(-member.least);
        if bounds::FORCE_IN_KILONEWTONS.contains(&strength)
            && strength < bounds::LEAST_DEAD_FORCE * weight
        {
            units.add("strength", || {
                format!(
                    "{} has a strength of {} N on a block that weighs {} N: it has almost no effect. It looks like kN: forces are in N, write {:e}",
                    member.path,
                    short(strength),
                    short(weight),
                    strength * 1e3
                )
            });
        }
    }
    let units = units.texts("members").into_iter().map(|t| Finding::new(FindingCode::Units, t));
    let off = off.texts("members").into_iter().map(|t| Finding::new(FindingCode::Loads, t));
    units.chain(off).collect()
}
