//! Friction that files give to the blocks and not to pairs of them.

use super::raw::{Rule, Surface, tally};
use crate::{Friction, JointOverride, Joints, Scene};
use base::error::{Finding, FindingCode, InputError, JsonPath};
use std::collections::BTreeMap;

/// Most different surfaces of a scene. More: the exceptions for pairs of them, by the square, take more
/// memory than any file. Fewer: scenes with friction drawn by chance for groups of blocks are refused.
const MOST: usize = 64;

impl Surface {
    /// Coefficient of friction of a joint.
    fn with(&self, other: &Self) -> f64 {
        let own = |s: &Self| if s.is_smooth { 0.0 } else { s.friction };
        match (self.priority.cmp(&other.priority), self.rule, other.rule) {
            (std::cmp::Ordering::Greater, ..) => own(self),
            (std::cmp::Ordering::Less, ..) => own(other),
            (_, Rule::Greater, Rule::Greater) if self.is_smooth && other.is_smooth => 0.0,
            (_, Rule::Greater, Rule::Greater) => self.friction.max(other.friction),
            _ => own(self).min(own(other)),
        }
    }
}

/// Friction of the joints of a scene, from the surfaces of its materials; what the user asks for
/// goes before it.
pub(super) fn joints(
    scene: &mut Scene,
    surfaces: &BTreeMap<String, Surface>,
    asked: Option<Friction>,
    findings: &mut Vec<Finding>,
) -> Result<(), InputError> {
    if surfaces.is_empty() {
        return Ok(());
    }
    if asked.is_some() {
        findings.push(Finding::new(
            FindingCode::LeftOut,
            "friction of the file, left out as asked: the friction given is that of every joint",
        ));
        return Ok(());
    }
    if surfaces.len() > MOST {
        let message = format!("{} different surfaces, at most {MOST} are read", surfaces.len());
        return Err(InputError::at(JsonPath::root(), message)
            .hint("give `--friction MU` for every joint, or fewer different frictions"));
    }
    let names: Vec<&String> = surfaces.keys().collect();
    let mut pairs = Vec::new();
    for (i, a) in names.iter().enumerate() {
        pairs.extend(names[i..].iter().map(|b| (*a, *b, surfaces[*a].with(&surfaces[*b]))));
    }
    let usual = most_frequent(pairs.iter().map(|p| p.2));
    let overrides = pairs.iter().filter(|p| p.2 != usual).map(|(a, b, mu)| JointOverride {
        between: Some([a.to_string(), b.to_string()]),
        friction: Some(Friction::Coefficient(*mu)),
        ..JointOverride::default()
    });
    scene.joints = Joints { overrides: overrides.collect(), ..scene.joints.clone() };
    scene.joints.default.friction = Some(Friction::Coefficient(usual));
    if surfaces.len() > 1 {
        let told = |(name, s): (&String, &Surface)| {
            let priority = if s.priority == 0 { "" } else { " with a priority of its own" };
            format!("{name}: {}{priority}", s.friction)
        };
        let list: Vec<String> = surfaces.iter().map(told).collect();
        let rule = match surfaces.values().all(|s| s.rule == Rule::Greater) {
            true => "greater, or that of the higher priority",
            false => "lesser",
        };
        let text =
            format!("frictions of surfaces: {}; that of a joint is the {rule}", tally(&list));
        findings.push(Finding::new(FindingCode::Converted, text));
    }
    Ok(())
}

/// The value that occurs most often; of several the least.
fn most_frequent(values: impl Iterator<Item = f64>) -> f64 {
    let mut counts: BTreeMap<u64, usize> = BTreeMap::new();
    // Frictions are not negative, so that their bits are in their order.
    values.for_each(|v| *counts.entry((v + 0.0).to_bits()).or_default() += 1);
    let most = counts.values().copied().max().unwrap_or(0);
    counts.iter().find(|(_, n)| **n == most).map_or(0.0, |(bits, _)| f64::from_bits(*bits))
}
