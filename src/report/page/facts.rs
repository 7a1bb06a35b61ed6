//! The words of an answer, as printed on a terminal, as HTML: what is said there is said here.

use crate::text::{Page, Role, Span};
use base::plain::markup;

/// Rows about the solver and its work, which are folded together.
const INTERNALS: [&str; 5] = ["reduced", "left out", "time", "work", "attempts"];
/// Rows that a record repeats.
const RECORDED: [&str; 8] =
    ["proof", "scene", "weak joints", "yield", "go slack", "members", "positions", "bridge"];
/// The row of commands.
const NEXT: &str = "next";
/// Rows of more lines than this are folded.
const LINES: usize = 9;
/// So are rows of more characters than this.
const LONG: usize = 900;

/// The first line without markup.
pub(super) fn plain_title(page: &Page) -> String {
    page.lines.first().map(|l| l.iter().map(|s| s.text.as_str()).collect()).unwrap_or_default()
}

/// Name and answer.
pub(super) fn head(page: &Page) -> String {
    let spans = page.lines.first().map(Vec::as_slice).unwrap_or_default();
    let of = |want: &dyn Fn(Role) -> bool| spans.iter().find(|s| want(s.role));
    let name = of(&|r| r == Role::Name)
        .map(|s| format!("<p class=\"name\">{}</p>", markup(&s.text)))
        .unwrap_or_default();
    let answer = of(&|r| class(r).is_some()).map(|s| {
        let text = if s.text.contains('λ') { s.text.clone() } else { capital(&s.text) };
        format!("<h1 class=\"{}\">{}</h1>", class(s.role).unwrap_or_default(), markup(&text))
    });
    name + &answer.unwrap_or_default()
}

fn class(role: Role) -> Option<&'static str> {
    match role {
        Role::Good => Some("good"),
        Role::Bad => Some("bad"),
        Role::Unsure => Some("unsure"),
        Role::Value => Some("value"),
        Role::Plain | Role::Name | Role::Label | Role::Command => None,
    }
}

/// A sentence begins with a capital; a symbol (α0, λ) is another one with it.
fn capital(text: &str) -> String {
    if !text.chars().take(2).all(char::is_alphabetic) {
        return text.into();
    }
    let mut chars = text.chars();
    chars.next().map(|c| c.to_uppercase().chain(chars).collect()).unwrap_or_default()
}

/// A row with a label.
struct Row {
    label: String,
    lines: Vec<String>,
}

/// Everything below the first line.
pub(super) fn body(page: &Page) -> String {
    let (mut paragraphs, mut rows) = (Vec::new(), Vec::<Row>::new());
    for line in page.lines.iter().skip(1) {
        match line.as_slice() {
            [] => {}
            [label, rest @ ..] if label.role == Role::Label => {
                let label = label.text.trim();
                if !label.is_empty() || rows.is_empty() {
                    rows.push(Row { label: label.into(), lines: Vec::new() });
                }
                if let Some(row) = rows.last_mut() {
                    row.lines.push(rest.iter().map(inline).collect());
                }
            }
            spans => paragraphs
                .push(format!("<p>{}</p>", spans.iter().map(inline).collect::<String>().trim())),
        }
    }
    let (inner, rows): (Vec<Row>, Vec<Row>) =
        rows.into_iter().partition(|r| INTERNALS.contains(&r.label.as_str()));
    let list = |rows: &[Row]| rows.iter().map(Row::html).collect::<String>();
    let inner = if inner.is_empty() {
        String::new()
    } else {
        format!(
            "<details class=\"internals\"><summary>How it was computed</summary><dl class=\"rows\">{}</dl></details>",
            list(&inner)
        )
    };
    format!(
        "<div class=\"why\">{}</div><dl class=\"rows\">{}</dl>{inner}",
        paragraphs.concat(),
        list(&rows)
    )
}

fn inline(span: &Span) -> String {
    let text = markup(&span.text);
    match span.role {
        Role::Command => format!("<code>{text}</code>"),
        _ => text,
    }
}

impl Row {
    fn html(&self) -> String {
        // Columns are lined up by spaces, which a fixed pitch keeps.
        let table = self.lines.iter().any(|l| l.trim_start().contains("  "))
            && !self.lines.iter().any(|l| l.contains("<code>"));
        let lines: String =
            self.lines.iter().map(|l| format!("<div>{}</div>", l.trim_end())).collect();
        let body =
            format!("<div class=\"{}\">{lines}</div>", if table { "columns" } else { "lines" });
        let long =
            self.lines.len() > LINES || self.lines.iter().map(String::len).sum::<usize>() > LONG;
        let body = if long {
            let first: String = self.lines.first().map(|l| short(l)).unwrap_or_default();
            format!(
                "<details><summary>{first} <span class=\"more\">… {}</span></summary>{body}</details>",
                count(self.lines.len())
            )
        } else {
            body
        };
        // What to type next is of no use on paper, and a record says some of it in full.
        let class = match self.label.as_str() {
            NEXT => " class=\"typed\"",
            label if RECORDED.contains(&label) => " class=\"recorded\"",
            _ => "",
        };
        format!("<dt{class}>{}</dt><dd{class}>{body}</dd>", markup(&self.label))
    }
}

fn count(lines: usize) -> String {
    if lines > 1 { format!("{lines} lines") } else { "in full".into() }
}

/// The beginning of an escaped line, not cut inside an entity.
fn short(line: &str) -> String {
    const MOST: usize = 60;
    let cut: String = line.trim().chars().take(MOST).collect();
    match (line.trim().chars().count() > MOST, cut.rfind(' ')) {
        (true, Some(end)) => cut[..end].to_string(),
        (true, None) => String::new(),
        (false, _) => cut,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_begin_with_a_capital_and_symbols_stay() {
        for (text, wanted) in [
            ("stands", "Stands"),
            ("λ = 0.3", "λ = 0.3"),
            ("α0 = 0.1, a0 = 0.7 m/s²", "α0 = 0.1, a0 = 0.7 m/s²"),
            ("", ""),
        ] {
            assert_eq!(capital(text), wanted);
        }
    }
}
