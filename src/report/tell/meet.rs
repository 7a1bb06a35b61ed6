//! Where what is required is met, for people.

use super::{
    critical::name,
    telling::{PLAIN, Telling},
};
use crate::{
    ReportError,
    cells::{Cell, Table},
    text::{
        options::TextOptions,
        page::{Page, Role},
    },
};
use base::number::{count, rounded_down, rounded_up, short};
use check::proof::{
    Answer,
    answer::{Nested, Quantity},
    meet::{MeetAnswer, MeetChange},
    result::ResultFile,
};

pub(super) const TELLING: Telling = Telling {
    verb: "critical",
    asked: |_| {
        [
            "At what value of a number of the scene is what is required met?",
            "At the value that is named it is met, beside it not; both are proved.",
        ]
    },
    title: |file| said(file).map_or(("undecided".into(), Role::Unsure), title),
    why: |page, file| {
        let Some(a) = said(file) else { return };
        page.paragraph(&format!(
            "The range was scanned at {} (computed); at every change the answers on both sides have their own proof. Between two scanned values that both meet what is required, or both do not, changes stay unseen: --scan makes the scan finer.",
            count(a.scan.len(), "value")
        ));
    },
    rows,
    csv: Some(csv),
    ..PLAIN
};

fn said(file: &ResultFile) -> Option<&MeetAnswer> {
    match &file.answer {
        Answer::Meet(a) => Some(a),
        _ => None,
    }
}

/// What is required, in words.
fn required(a: &MeetAnswer) -> String {
    match a.required {
        Some((Quantity::LoadFactor, least)) => format!("λ ≥ {}", short(least)),
        Some((Quantity::TiltDeg, least)) => format!("a tilt of {}°", short(least)),
        Some((Quantity::Alpha0, least)) => format!("α0 ≥ {}", short(least)),
        Some((Quantity::GeometricFactor, least)) => {
            format!("a geometric safety factor of {}", short(least))
        }
        Some((Quantity::Site, least)) => format!("ζ_E ≥ {}", short(least)),
        None => "what is required".into(),
    }
}

/// The first line.
fn title(a: &MeetAnswer) -> (String, Role) {
    let what = required(a);
    let (from, to) = (short(a.between[0]), short(a.between[1]));
    match (&a.changes[..], a.throughout) {
        ([], Some(true)) => (format!("{what} is met throughout, from {from} to {to}"), Role::Good),
        ([], Some(false)) => (format!("{what} is met nowhere from {from} to {to}"), Role::Bad),
        ([], None) => (format!("undecided where {what} is met"), Role::Unsure),
        (list, _) => {
            let words: Vec<String> = list.iter().map(|c| change(name(&a.vary), c)).collect();
            let (cut, role) = match a.complete {
                true => ("", Role::Value),
                false => {
                    ("; the scan ended early, and the rest of the range is undecided", Role::Unsure)
                }
            };
            (format!("{what} is met {}{cut}", words.join("; ")), role)
        }
    }
}

/// From where on, or up to where, with four digits on the safe side.
fn change(name: &str, c: &MeetChange) -> String {
    match c.met_at > c.not_met_at {
        true => format!(
            "from {name} = {} on, not up to {}",
            rounded_up(c.met_at),
            rounded_down(c.not_met_at)
        ),
        false => format!(
            "up to {name} = {}, not from {} on",
            rounded_down(c.met_at),
            rounded_up(c.not_met_at)
        ),
    }
}

fn obtained(n: &Nested) -> String {
    n.required.and_then(|r| r.obtained).map_or_else(|| "no value".into(), short)
}

fn rows(page: &mut Page, file: &ResultFile, _: TextOptions) {
    let Some(a) = said(file) else { return };
    let lines = a.changes.iter().flat_map(|c| {
        [
            format!("met at {}: {}", c.met_at, obtained(&c.met)),
            format!("not met at {}: {}", c.not_met_at, obtained(&c.not_met)),
        ]
    });
    page.row("obtained", lines);
    let scan = a.scan.iter().map(|s| {
        let met = s.met.map_or("undecided", |met| if met { "met" } else { "not met" });
        let obtained = s.obtained.map_or_else(String::new, |v| format!("{}, ", short(v)));
        format!("{}: {obtained}{met}", short(s.value))
    });
    page.row("scan", scan);
    let none = file.run.why.no_scene.iter();
    page.row("no scene", none.map(|(v, why)| format!("{}: {why}", short(*v))));
}

/// The scan and both sides of every change.
fn csv(file: &ResultFile) -> Result<String, ReportError> {
    let a =
        said(file).ok_or_else(|| ReportError::new("this is not a result of `critical --ask`"))?;
    let mut table = Table::new();
    table.write_record(["value", "obtained", "met", "proved"])?;
    let met = |m: Option<bool>| m.map_or("undecided", |m| if m { "yes" } else { "no" });
    for s in &a.scan {
        let row: [Cell; 4] = [s.value.into(), s.obtained.into(), met(s.met).into(), "no".into()];
        table.write_record(row)?;
    }
    for c in &a.changes {
        for (value, own, said) in [(c.met_at, &c.met, true), (c.not_met_at, &c.not_met, false)] {
            let obtained = own.required.and_then(|r| r.obtained);
            let row: [Cell; 4] =
                [value.into(), obtained.into(), met(Some(said)).into(), "yes".into()];
            table.write_record(row)?;
        }
    }
    Ok(table.end()?)
}
