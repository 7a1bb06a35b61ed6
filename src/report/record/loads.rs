//! Loads beside the weight, and members.

use super::{Part, Section, listed, percent, quantity};
use crate::view::{View, ViewLoad, ViewMember};
use base::number::{count, point};
use model::{assembly::MemberKind, interface::Model};
use nalgebra::Vector3;

/// Loads that are listed, and members.
const MOST: usize = 16;

/// The section about loads; `idle` where live loads take no part in the answer.
pub(super) fn section(model: &Model, view: &View, idle: bool) -> Section {
    let mut parts = vec![Part::Text(
        "The weight of every free block always acts at its centre of mass.".into(),
    )];
    for (live, title) in [(false, "Dead loads"), (true, "Live loads (× λ)")] {
        let there = || view.loads.iter().filter(move |l| l.live == live);
        let sum: Vector3<f64> = there().map(|l| l.force).sum();
        let row = |l: &ViewLoad| {
            vec![
                model.assembly.blocks.get(l.body).map_or(String::new(), |b| b.id.clone()),
                point(l.at.into()),
                quantity(l.force.norm(), "N"),
                point(l.force.try_normalize(0.0).unwrap_or_default().into()),
            ]
        };
        let rows: Vec<Vec<String>> = there().map(row).collect();
        if rows.is_empty() {
            parts.push(Part::Text(format!("{title}: none.")));
            continue;
        }
        let note = format!(
            "{title}{}; resultant {} along {}.",
            if live && idle { ", not used for this question" } else { "" },
            quantity(sum.norm(), "N"),
            point(sum.try_normalize(0.0).unwrap_or_default().into())
        );
        let columns =
            [if live { "live load on" } else { "dead load on" }, "at, m", "#force", "along"];
        parts.push(Part::table(&columns, listed(rows, MOST), &note).across(2));
    }
    Section::new("Loads", parts)
}

/// Members that are no soil, each with its force; and the soil in a line.
pub(super) fn members(view: &View) -> Option<Section> {
    let (soil, others): (Vec<&ViewMember>, Vec<&ViewMember>) =
        view.members.iter().partition(|m| m.kind == MemberKind::Soil);
    let row = |m: &&ViewMember| {
        let ends: Vec<String> = m.points.iter().map(|p| point((*p).into())).collect();
        let used = m.force.filter(|_| m.strength.is_finite() && m.strength > 0.0);
        let used = used.map_or("–".into(), |f| percent(f.abs() / m.strength));
        vec![m.id.clone(), m.kind.word().into(), ends.join(" – "), strength(m), force(m), used]
    };
    let mut parts = Vec::new();
    if !others.is_empty() {
        let columns = ["member", "kind", "from – to, m", "#strength", "#force", "#used"];
        let rows = listed(others.iter().map(row).collect(), MOST);
        parts.push(Part::table(&columns, rows, "Forces are those of the answer."));
    }
    parts.extend((!soil.is_empty()).then(|| Part::Text(in_a_line(&soil))));
    (!parts.is_empty()).then(|| Section::new("Members", parts))
}

/// What the soil does, all of it together.
fn in_a_line(soil: &[&ViewMember]) -> String {
    /// What is this near to its strength is at it.
    const AT: f64 = 1e-6;
    let all = count(soil.len(), "soil member");
    let known = soil.iter().filter_map(|m| Some((m, m.force.filter(|_| !m.slack)?)));
    let greatest = known.clone().max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()));
    let Some((most, f)) = greatest else { return format!("{all}: no force.") };
    let full = known.filter(|(m, f)| f.abs() >= (1.0 - AT) * m.strength).count();
    format!(
        "{all}: {full} at their strength, {} slack; the greatest force is {} of {} ({}).",
        soil.iter().filter(|m| m.slack).count(),
        quantity(f.abs(), "N"),
        strength(most),
        most.id
    )
}

/// Every member of soil, in few columns.
pub(super) fn soil(view: &View) -> Option<Section> {
    let row = |m: &ViewMember| vec![m.id.clone(), strength(m), force(m)];
    let soil = view.members.iter().filter(|m| m.kind == MemberKind::Soil);
    let rows: Vec<Vec<String>> = soil.map(row).collect();
    let columns = ["soil", "#strength", "#force"];
    let table = |rows| Part::table(&columns, rows, "Forces are those of the answer.").across(3);
    (!rows.is_empty()).then(|| Section::new("Soil", vec![table(rows)]))
}

fn strength(m: &ViewMember) -> String {
    if m.strength.is_finite() { quantity(m.strength, "N") } else { "no limit".into() }
}

fn force(m: &ViewMember) -> String {
    match (m.force, m.slack) {
        (_, true) => "slack".into(),
        (Some(force), _) => quantity(force, "N"),
        (None, _) => "–".into(),
    }
}
