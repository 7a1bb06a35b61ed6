//! Loads beside the weight, and members.

use super::{Part, Section, listed, quantity};
use crate::view::View;
use base::number::point;
use model::interface::Model;
use nalgebra::Vector3;

/// Loads that are listed, and members.
const MOST: usize = 16;

/// The sections about loads and members; `idle` where live loads take no part in the answer.
pub(super) fn sections(model: &Model, view: &View, idle: bool) -> Vec<Section> {
    let mut list = vec![Section::new("Loads", loads(model, view, idle))];
    if !view.members.is_empty() {
        list.push(Section::new("Members", vec![members(view)]));
    }
    list
}

fn loads(model: &Model, view: &View, idle: bool) -> Vec<Part> {
    let mut parts = vec![Part::Text(
        "The weight of every free block always acts at its centre of mass.".into(),
    )];
    for (live, title) in [(false, "Dead loads"), (true, "Live loads (× λ)")] {
        let there = || view.loads.iter().filter(move |l| l.live == live);
        let sum: Vector3<f64> = there().map(|l| l.force).sum();
        let row = |l: &crate::view::ViewLoad| {
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
        parts.push(Part::table(&columns, listed(rows, MOST), &note));
    }
    parts
}

fn members(view: &View) -> Part {
    let row = |m: &crate::view::ViewMember| {
        let ends: Vec<String> = m.points.iter().map(|p| point((*p).into())).collect();
        let force = match (m.force, m.slack) {
            (_, true) => "slack".into(),
            (Some(force), _) => quantity(force, "N"),
            (None, _) => "–".into(),
        };
        let used = m.force.filter(|_| m.strength.is_finite() && m.strength > 0.0);
        let used = used.map_or("–".into(), |f| super::percent(f.abs() / m.strength));
        let strength =
            if m.strength.is_finite() { quantity(m.strength, "N") } else { "no limit".into() };
        vec![m.id.clone(), m.kind.word().into(), ends.join(" – "), strength, force, used]
    };
    Part::table(
        &["member", "kind", "from – to, m", "#strength", "#force", "#used"],
        listed(view.members.iter().map(row).collect(), MOST),
        "Forces are those of the answer.",
    )
}
