//! `voussoir settle --cracks`

use super::{exit::Exit, input, question::Session, terminal};
use std::path::Path;
use voussoir::{
    analysis::follow::crack::{Cracks, Explanation, explain},
    error::{InputError, JsonPath},
    number::short,
    report::json,
};

/// So many explanations are shown.
const SHOWN: usize = 6;

pub fn run(session: &Session, file: &Path, as_json: bool, quiet: bool) -> anyhow::Result<Exit> {
    let (name, text) = input::text(file)?;
    let cracks: Cracks = serde_json::from_str(&text).map_err(|e| InputError {
        file: Some(name),
        ..InputError::at(JsonPath::root(), e.to_string())
            .hint(r#"{ "cracks": [ { "between": ["v03", "v04"], "side": "intrados", "width": 0.004 } ] }"#)
    })?;
    let list = explain(&session.model, &cracks).map_err(|e| session.refuse(e))?;
    let count = cracks.cracks.len();
    let whole = |e: &&Explanation| e.explained == count && e.unseen == 0;
    let explains = list.iter().filter(whole).count();
    if as_json {
        terminal::print(&json::pretty(&list)?)?;
    } else {
        let mut lines = vec![match explains {
            0 => "No movement of a single support explains the cracks; the closest:".to_string(),
            1 => "One movement of a single support explains the cracks:".to_string(),
            n => format!("{n} movements of a single support explain the cracks equally well:"),
        }];
        let shown = if quiet { 0 } else { SHOWN.max(explains) };
        lines.extend(list.iter().take(shown).map(|e| line(e, count)));
        lines.push(
            "Computed to first order from the mechanism of each unit movement, not proved.".into(),
        );
        terminal::print(&(lines.join("\n") + "\n"))?;
    }
    Ok(if explains > 0 { Exit::Yes } else { Exit::Undecided })
}

fn line(e: &Explanation, count: usize) -> String {
    let words = |v: &[f64; 3]| v.map(short).join(", ");
    let turns = e.way == [0.0; 3];
    let what = if turns {
        format!("rotates about ({})", words(&e.axis))
    } else {
        format!("moves along ({})", words(&e.way))
    };
    let size = e.size.zip(e.left).map_or(String::new(), |(size, left)| {
        let unit = if turns { "rad" } else { "m" };
        format!("; by {} {unit}, {:.1} % of the widths unexplained", short(size), 100.0 * left)
    });
    format!(
        "  {} {what}: {} of {count} cracks explained, {} joints open without a listed crack{size}",
        e.support, e.explained, e.unseen
    )
}
