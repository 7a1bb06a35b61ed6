//! The record of an assessment as HTML: without scripts, so that it prints as it stands.

use crate::record::{Cover, Part, Record, Section};
use base::plain::markup;

/// The first page: before everything else on paper, below the picture on a screen.
pub(super) fn cover(record: &Record) -> String {
    let Cover { heading, asked, drawing, assumptions, source, limits, signs } = &record.cover;
    if drawing.is_empty() {
        return String::new();
    }
    let list = |class: &str, facts: &[[String; 2]]| match facts {
        [] => String::new(),
        facts => format!("<dl class=\"rows{class}\">{}</dl>\n", pairs(facts)),
    };
    let titled = |title: &str, content: String| match content.is_empty() {
        true => String::new(),
        false => format!("<h3>{title}</h3>{content}"),
    };
    let words = |text: &String| format!("<p>{}</p>\n", markup(text));
    let source = if source.is_empty() { String::new() } else { words(source) };
    let limits = limits.iter().map(|line| format!("<li>{}</li>", markup(line))).collect::<String>();
    let limits = if limits.is_empty() { limits } else { format!("<ul>{limits}</ul>\n") };
    let sign = |[role, name]: &[String; 2]| {
        format!(
            "<tr><th scope=\"row\">{}</th><td>{}</td><td></td><td></td></tr>",
            markup(role),
            markup(name)
        )
    };
    format!(
        "<section class=\"cover\" aria-label=\"Summary\">\n{}{}<div class=\"drawn\">{drawing}</div>\n{}{}{}\
         <table class=\"signs\"><thead><tr><td></td><th scope=\"col\">name</th><th scope=\"col\">date</th>\
         <th scope=\"col\">signature</th></tr></thead><tbody>{}</tbody></table>\n</section>\n",
        list(" heading", heading),
        list(" asked", asked),
        titled("Assumptions", list("", assumptions)),
        titled("Source of geometry and values", source),
        titled("Not in the model", limits),
        signs.iter().map(sign).collect::<String>(),
    )
}

/// Results and appendices.
pub(super) fn html(record: &Record) -> String {
    let part = |title: &str, sections: &[Section]| match sections {
        [] => String::new(),
        list => {
            let sections: String = list.iter().map(section).collect();
            format!("<h2 class=\"title\">{title}</h2>\n{sections}")
        }
    };
    let all = part("Results", &record.results) + &part("Appendices", &record.appendices);
    match all.is_empty() {
        true => all,
        false => format!("<section class=\"record\" aria-label=\"Record\">{all}</section>\n"),
    }
}

fn section(section: &Section) -> String {
    let parts: String = section.parts.iter().map(part).collect();
    format!("<section><h3>{}</h3>{parts}</section>\n", markup(&section.title))
}

/// Width of the columns of a page together, in letters.
const WIDTH: usize = 54;

fn part(part: &Part) -> String {
    match part {
        Part::Text(text) => format!("<p>{}</p>", markup(text)),
        Part::Facts(facts) => format!("<dl class=\"rows\">{}</dl>", pairs(facts)),
        Part::Table { columns, rows, note, across } => {
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
            // As many columns as there is room for.
            let style = match across {
                0 | 1 => String::new(),
                n => format!(" style=\"columns:{}em {n}\"", WIDTH / n),
            };
            format!(
                "<div class=\"scroll\" tabindex=\"0\"{style}><table><thead><tr>{head}</tr></thead><tbody>{rows}</tbody></table></div>{note}"
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
            across: 2,
        };
        let pair = || vec![[bad.clone(), bad.clone()]];
        let parts = vec![Part::Text(bad.clone()), Part::Facts(pair()), table];
        let first = Cover {
            heading: pair(),
            asked: pair(),
            drawing: "<svg/>".into(),
            assumptions: pair(),
            source: bad.clone(),
            limits: vec![bad.clone()],
            signs: pair(),
        };
        let results = vec![Section { title: bad.clone(), parts }];
        let record = Record { cover: first, results: results.clone(), appendices: results };
        let text = cover(&record) + &html(&record);
        assert!(!text.contains("<img") && text.matches("&lt;img").count() == 24, "{text}");
    }
}
