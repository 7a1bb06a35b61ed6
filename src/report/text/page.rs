//! Lines of text whose parts say what they are. How they look (colour, weight) is decided where they are shown.

use std::fmt;

/// Sentences are broken to lines of this many characters.
const WIDTH: usize = 110;
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

/// A piece of text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Span {
    /// The text.
    pub text: String,
    /// What it is.
    pub role: Role,
}

/// A page of text.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Page {
    /// Its lines.
    pub lines: Vec<Vec<Span>>,
}

impl Page {
    pub(super) fn title(&mut self, name: &str, answer: impl Into<String>, role: Role) {
        let answer = span(answer, role);
        let line = if name.is_empty() { vec![answer] } else { vec![span(name, Role::Name), span(": ", Role::Plain), answer] };
        self.lines.push(line);
    }

    pub(super) fn blank(&mut self) {
        self.lines.push(Vec::new());
    }

    pub(super) fn paragraph(&mut self, text: &str) {
        for line in wrap(text, WIDTH - 2) {
            self.lines.push(vec![span(format!("  {line}"), Role::Plain)]);
        }
    }

    /// A labelled row; further items stand below the first.
    pub(super) fn row(&mut self, label: &str, items: impl IntoIterator<Item = String>) {
        let mut label = label;
        for item in items {
            for line in wrap(&item, WIDTH - COLUMN) {
                let room = COLUMN - 2;
                self.lines.push(vec![span(format!("  {label:<room$}"), Role::Label), span(line, Role::Plain)]);
                label = "";
            }
        }
    }

    /// Rows with something to type and what it is good for.
    pub(super) fn commands(&mut self, label: &str, commands: &[(String, &str)]) {
        let (room, width) = (COLUMN - 2, commands.iter().map(|(c, _)| c.chars().count()).max().unwrap_or(0));
        for (i, (command, purpose)) in commands.iter().enumerate() {
            let label = span(format!("  {:<room$}", if i == 0 { label } else { "" }), Role::Label);
            let gap = " ".repeat(width - command.chars().count() + 3);
            self.lines.push(vec![label, span(command, Role::Command), span(format!("{gap}{purpose}"), Role::Plain)]);
        }
    }
}

fn span(text: impl Into<String>, role: Role) -> Span {
    Span { text: text.into(), role }
}

/// Breaks a sentence at its spaces; a single word may be longer than the line. Spaces at the start of a line are kept as its indent.
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
