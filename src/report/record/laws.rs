//! How joints resist, and what tells that blocks touch.

use super::{Part, Section, quantity};
use crate::view::View;
use base::number::short;
use check::proof::result::ResultFile;
use model::{assembly::JointLaw, interface::Model};

/// Friction and strengths of the joints, in a few words.
pub(super) fn said(view: &View) -> Vec<[String; 2]> {
    if view.joints.is_empty() {
        return Vec::new();
    }
    let friction = values(
        view,
        |law| law.friction.mu(),
        |mu| match mu.is_finite() {
            true => format!("μ = {}", short(mu)),
            false => "no sliding".into(),
        },
    );
    let strength = |name: &str, of: fn(&JointLaw) -> f64| {
        let words = |v: f64| if v == 0.0 { "0".into() } else { quantity(v, "Pa") };
        format!("{name} {}", values(view, of, words))
    };
    let strengths = [
        strength("compression", |law| law.compression),
        strength("cohesion", |law| law.cohesion),
        strength("tension", |law| law.tension),
    ];
    vec![["friction".into(), friction], ["strength".into(), strengths.join("; ")]]
}

/// The values that joints have, or the least and the greatest of many.
fn values(view: &View, of: impl Fn(&JointLaw) -> f64, words: impl Fn(f64) -> String) -> String {
    const FEW: usize = 3;
    let mut list: Vec<f64> = view.joints.iter().map(|j| of(&j.law)).collect();
    list.sort_by(f64::total_cmp);
    list.dedup();
    match list[..] {
        [first, .., last] if list.len() > FEW => format!("{} to {}", words(first), words(last)),
        _ => list.into_iter().map(words).collect::<Vec<_>>().join(", "),
    }
}

/// One row for each law of resistance.
pub(super) fn section(model: &Model, view: &View) -> Option<Section> {
    let mut laws: Vec<(JointLaw, usize, f64)> = Vec::new();
    for joint in &view.joints {
        match laws.iter_mut().find(|(law, ..)| *law == joint.law) {
            Some((_, count, area)) => (*count, *area) = (*count + 1, *area + joint.area),
            None => laws.push((joint.law, 1, joint.area)),
        }
    }
    // Where every joint has a strength of its own, the list is as long as that of the joints.
    laws.sort_by_key(|l| std::cmp::Reverse(l.1));
    // Stiffness is looked at by `state` alone, and not given otherwise.
    let yields = laws.iter().any(|l| l.0.normal_stiffness.or(l.0.shear_stiffness).is_some());
    let row = |(law, count, area): &(JointLaw, usize, f64)| {
        let mu = law.friction.mu();
        let stress = |v: f64| if v == 0.0 { "0".into() } else { quantity(v, "Pa") };
        let friction = if mu.is_finite() {
            format!("{} ({}°)", short(mu), short(mu.atan().to_degrees()))
        } else {
            "no sliding".into()
        };
        let stiffness = |v: Option<f64>| v.map_or("–".into(), |v| quantity(v, "Pa/m"));
        let mut cells = vec![
            count.to_string(),
            short(*area),
            friction,
            stress(law.cohesion),
            stress(law.tension),
            if law.compression.is_finite() { stress(law.compression) } else { "no limit".into() },
            stress(law.pore_pressure),
            if law.rolling_arm == 0.0 {
                "0".into()
            } else {
                format!("{} m", short(law.rolling_arm))
            },
        ];
        if yields {
            cells.extend([law.normal_stiffness, law.shear_stiffness].map(stiffness));
        }
        cells
    };
    let mut columns = vec![
        "#joints",
        "#area, m²",
        "#friction μ (angle)",
        "#cohesion",
        "#tension",
        "#compression",
        "#pore pressure",
        "#rolling arm",
    ];
    if yields {
        columns.extend(["#normal stiffness", "#shear stiffness"]);
    }
    let note = "Strengths as given in the scene; 0 and “no limit” are the defaults.";
    (!model.interfaces.list.is_empty()).then(|| {
        let rows = super::listed(laws.iter().map(row).collect(), 12);
        Section::new("Joints", vec![Part::table(&columns, rows, note)])
    })
}

/// Tolerances of contacts, and what was found in the scene.
pub(super) fn tolerances(file: &ResultFile, model: &Model) -> Vec<Section> {
    let contact = &model.assembly.contact;
    let shown = |v: f64| if v < 1e-2 { format!("{v:e}") } else { v.to_string() };
    let mut facts = vec![
        [
            "gap".into(),
            format!("faces touch within {} × the size of the smaller block", shown(contact.gap)),
        ],
        [
            "angle".into(),
            format!("their normals are opposite within {}°", short(contact.angle_deg)),
        ],
        [
            "least area".into(),
            format!(
                "contacts smaller than {} × its size squared are ignored",
                shown(contact.min_area)
            ),
        ],
    ];
    if let Some(words) = contact.widened() {
        facts.push(["wider than the default".into(), words]);
    }
    let mut parts = vec![Part::Facts(facts)];
    let rows: Vec<Vec<String>> = file.warnings().map(|f| vec![f.text.clone()]).collect();
    parts.push(if rows.is_empty() {
        Part::Text("Warnings about the scene: none.".into())
    } else {
        Part::table(&["warnings about the scene"], super::listed(rows, 20), "")
    });
    vec![Section::new("Tolerances and warnings", parts)]
}
