//! Lines of text whose parts say what they are. How they look (colour, weight) is decided where
//! they are shown.

use base::plain::printable;
use std::{borrow::Cow, fmt};

/// Sentences are broken to lines of this many characters where nobody says how many there is room
/// for.
const WIDTH: usize = 110;
/// Narrower than this, more lines than words.
const NARROW: usize = 40;
/// Column in which the text of a labelled row starts.
const COLUMN: usize = 14;

/// What a piece of text is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// Text.
    Plain,
    /// Name of what the answer is about.
    Name,
    /// An answer of the wished kind.
    Good,
    /// An answer of the feared kind.
    Bad,
    /// No answer.
    Unsure,
    /// A number that is the answer.
    Value,
    /// Name of a row.
    Label,
    /// Something to type.
    Command,
}

/// What a page is fitted to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Layout<'a> {
    /// Stands in the title for a scene without a name.
    pub unnamed: &'a str,
    /// Characters on a line.
    pub width: usize,
}

impl Default for Layout<'_> {
    fn default() -> Self {
        Self { unnamed: "", width: WIDTH }
    }
}

/// A piece of text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Span {
    /// The text.
    pub text: String,
    /// What it is.
    pub role: Role,
}

/// A page of text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Page {
    /// Its lines.
    pub lines: Vec<Vec<Span>>,
    unnamed: String,
    width: usize,
}

impl Page {
    /// An empty one.
    pub fn new(layout: Layout) -> Self {
        Self {
            lines: Vec::new(),
            unnamed: layout.unnamed.to_string(),
            width: layout.width.max(NARROW),
        }
    }

    /// The first line: what it is about, and the answer.
    pub fn title(&mut self, name: &str, answer: impl Into<String>, role: Role) {
        let name = printable(if name.is_empty() { &self.unnamed } else { name }).into_owned();
        let answer = span(answer, role);
        let line = if name.is_empty() {
            vec![answer]
        } else {
            vec![span(name, Role::Name), span(": ", Role::Plain), answer]
        };
        self.lines.push(line);
    }

    /// The first line alone.
    #[must_use]
    pub fn first_line(mut self) -> Self {
        self.lines.truncate(1);
        self
    }

    /// Leaves out a labelled row, with the lines that go on from it.
    pub fn drop_row(&mut self, label: &str) {
        let mut inside = false;
        self.lines.retain(|line| {
            match line.first().filter(|s| s.role == Role::Label).map(|s| s.text.trim()) {
                Some("") => {}
                Some(other) => inside = other == label,
                None => inside = false,
            }
            !inside
        });
    }

    /// An empty line.
    pub fn blank(&mut self) {
        self.lines.push(Vec::new());
    }

    /// A sentence or more.
    pub fn paragraph(&mut self, text: &str) {
        for line in wrap(&printable(text), self.width - 2) {
            self.lines.push(vec![span(format!("  {line}"), Role::Plain)]);
        }
    }

    /// A labelled row; further items stand below the first.
    pub fn row(&mut self, label: &str, items: impl IntoIterator<Item = String>) {
        let mut label = label;
        for item in items {
            for line in wrap(&printable(&item), self.width - COLUMN) {
                let room = COLUMN - 2;
                // A name that fills its column still stands apart from what follows.
                let apart = if label.chars().count() >= room { "  " } else { "" };
                self.lines.push(vec![
                    span(format!("  {label:<room$}{apart}"), Role::Label),
                    span(line, Role::Plain),
                ]);
                label = "";
            }
        }
    }

    /// Rows with something to type and what it is good for.
    pub(crate) fn commands(&mut self, label: &str, commands: &[(String, &str)]) {
        let commands: Vec<(Cow<str>, &str)> =
            commands.iter().map(|(c, p)| (printable(c), *p)).collect();
        let (room, width) =
            (COLUMN - 2, commands.iter().map(|(c, _)| c.chars().count()).max().unwrap_or(0));
        let needed =
            commands.iter().map(|(_, p)| COLUMN + width + 3 + p.chars().count()).max().unwrap_or(0);
        // As long as paths fit the terminal as it is, or nobody said how wide it is, purposes stand
        // beside.
        let beside = self.width >= WIDTH.min(needed);
        for (i, (command, purpose)) in commands.into_iter().enumerate() {
            let label = span(format!("  {:<room$}", if i == 0 { label } else { "" }), Role::Label);
            if beside {
                let gap = " ".repeat(width - command.chars().count() + 3);
                self.lines.push(vec![
                    label,
                    span(command, Role::Command),
                    span(format!("{gap}{purpose}"), Role::Plain),
                ]);
            } else {
                // Commands are never broken, so that they can be copied.
                self.lines.push(vec![label, span(command, Role::Command)]);
                self.row("", [format!("  {purpose}")]);
            }
        }
    }
}

/// Whatever a page is made of comes through here: nothing of a file reaches a terminal as anything
/// but text.
fn span(text: impl Into<String>, role: Role) -> Span {
    let text = text.into();
    let text = match printable(&text) {
        Cow::Borrowed(_) => text,
        Cow::Owned(printable) => printable,
    };
    Span { text, role }
}

/// Breaks a sentence at its spaces; a single word may be longer than the line. Spaces at the start
/// of a line are kept as its indent.
fn wrap(text: &str, width: usize) -> Vec<String> {
    let indent = text.len() - text.trim_start_matches(' ').len();
    let (mut lines, mut line) = (Vec::new(), " ".repeat(indent));
    for word in text[indent..].split(' ') {
        if line.trim_start().is_empty() {
            line.push_str(word);
        } else if line.chars().count() + 1 + word.chars().count() <= width {
            line.push(' ');
            line.push_str(word);
        } else {
            lines.push(std::mem::replace(&mut line, format!("{}{word}", " ".repeat(indent))));
        }
    }
    lines.push(line);
    lines
}

impl fmt::Display for Page {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for line in &self.lines {
            let text: String = line.iter().map(|s| s.text.as_str()).collect();
            writeln!(f, "{}", text.trim_end())?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LONG: &str = "whatever they are, some block is left with at least a part of its weight";

    fn page(width: usize) -> String {
        let mut page = Page::new(Layout { unnamed: "file.json", width });
        page.title("", "falls", Role::Bad);
        page.paragraph(LONG);
        page.row("proof", [LONG.to_string()]);
        page.commands(
            "next",
            &[("voussoir check a.json".into(), "units in the scene, near misses, overlaps")],
        );
        page.to_string()
    }

    #[test]
    fn lines_fit_the_width() {
        for width in [44, 60, 80, 110] {
            let text = page(width);
            assert!(text.lines().all(|l| l.chars().count() <= width), "{width}:\n{text}");
        }
        assert!(page(80).contains("next        voussoir check a.json   units in"), "{}", page(80));
        assert!(page(60).contains("next        voussoir check a.json\n"), "{}", page(60));
        assert_eq!(page(0), page(NARROW));
    }

    #[test]
    fn a_scene_without_a_name_is_called_by_its_file() {
        assert!(page(110).starts_with("file.json: falls\n"));
    }

    #[test]
    fn nothing_in_a_scene_moves_the_cursor() {
        let mut page = Page::new(Layout::default());
        page.title("two\nlines \x1b[31m", "falls", Role::Bad);
        page.row("findings", ["tab\there".to_string()]);
        assert_eq!(page.to_string(), "two\\nlines \\u{1b}[31m: falls\n  findings    tab\\there\n");
        assert_eq!(printable("λ = 1°"), "λ = 1°");
    }
}
