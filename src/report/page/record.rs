//! The record of an assessment as HTML: without scripts, so that it prints as it stands.

use crate::record::{Part, Record, Section};
use base::plain::markup;

/// What was asked, above the answer in words.
pub(super) fn asked(record: &Record) -> String {
    if record.asked.is_empty() {
        return String::new();
    }
    format!("<dl class=\"rows asked\">{}</dl>", pairs(&record.asked))
}

/// Drawing and sections, below the picture.
pub(super) fn html(record: &Record) -> String {
    if record.sections.is_empty() && record.drawing.is_empty() {
        return String::new();
    }
    let sections: String = record.sections.iter().map(section).collect();
    format!(
        "<section class=\"record\" aria-label=\"Record\"><h2 class=\"title\">Record of the assessment</h2>\n<div class=\"drawn\">{}</div>\n{sections}</section>\n",
        record.drawing
    )
}

fn section(section: &Section) -> String {
    let parts: String = section.parts.iter().map(part).collect();
    format!("<section><h3>{}</h3>{parts}</section>\n", markup(&section.title))
}

fn part(part: &Part) -> String {
    match part {
        Part::Text(text) => format!("<p>{}</p>", markup(text)),
        Part::Facts(facts) => format!("<dl class=\"rows\">{}</dl>", pairs(facts)),
        Part::Table { columns, rows, note } => {
            let class = |word: bool| if word { " class=\"word\"" } else { "" };
            let head: String = columns
                .iter()
                .map(|(name, word)| {
                    format!("<th scope=\"col\"{}>{}</th>", class(*word), markup(name))
                })
                .collect();
            let row = |row: &Vec<String>| {
                let cells: String = row
                    .iter()
                    .zip(columns)
                    .map(|(text, (_, word))| format!("<td{}>{}</td>", class(*word), markup(text)))
                    .collect();
                format!("<tr>{cells}</tr>")
            };
            let rows: String = rows.iter().map(row).collect();
            let note = if note.is_empty() {
                String::new()
            } else {
                format!("<p class=\"note\">{}</p>", markup(note))
            };
            format!(
                "<div class=\"scroll\" tabindex=\"0\"><table><thead><tr>{head}</tr></thead><tbody>{rows}</tbody></table></div>{note}"
            )
        }
    }
}

fn pairs(facts: &[[String; 2]]) -> String {
    facts
        .iter()
        .map(|[name, text]| format!("<dt>{}</dt><dd>{}</dd>", markup(name), markup(text)))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Names come from scenes.
    #[test]
    fn nothing_in_a_record_becomes_markup() {
        let bad = "</section><img src=x onerror=\"1\">".to_string();
        let table = Part::Table {
            columns: vec![(bad.clone(), true)],
            rows: vec![vec![bad.clone()]],
            note: bad.clone(),
        };
        let parts =
            vec![Part::Text(bad.clone()), Part::Facts(vec![[bad.clone(), bad.clone()]]), table];
        let record = Record {
            asked: vec![[bad.clone(), bad.clone()]],
            drawing: String::new(),
            sections: vec![Section { title: bad, parts }],
        };
        let text = asked(&record) + &html(&record);
        assert!(!text.contains("<img") && text.matches("&lt;img").count() == 9, "{text}");
    }
}
