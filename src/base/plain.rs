//! Text of files that strangers wrote, in what this program writes: it stays text, and what is read
//! is what is there. One function for each medium.
//!
//! Control characters move the cursor of a terminal, change its colours and its title, and end
//! lines and cells. Marks of direction reorder what stands around them, so that a name may read as
//! another one (Boucher & Anderson, Trojan Source, USENIX Security 2023). Both are shown by their
//! numbers, `\u{202e}`. Letters of every script, and the joiners that some need, are left alone.

use std::borrow::Cow;

/// Whether a character is not seen but does something: controls (C0, C1, delete), separators of
/// lines and paragraphs, marks of direction (Unicode Standard Annex 9), annotation marks, and the
/// byte order mark where it is none.
pub fn is_unseen(c: char) -> bool {
    c.is_control()
        || matches!(c, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2060}'..='\u{206f}' | '\u{feff}' | '\u{fff9}'..='\u{fffb}')
}

/// For a line of a terminal or of a page, of drawings and tables: what is not seen is shown by its
/// number.
pub fn printable(text: &str) -> Cow<'_, str> {
    shown(text, |_| false)
}

/// For a whole document whose markup, if it has any, is in place already; its line breaks and tabs
/// stay.
pub fn document(text: &str) -> Cow<'_, str> {
    shown(text, |c| matches!(c, '\n' | '\t'))
}

/// Longest that a line says of what stands in a file, characters. Longer: a string of a megabyte,
/// where a number should stand, is the message. Shorter: lists of names lose their ends.
const MOST: usize = 2000;

/// What a line says: of what is longer than anybody reads its beginning and its end.
pub fn readable(text: &str) -> Cow<'_, str> {
    let count = text.chars().count();
    if count <= MOST {
        return Cow::Borrowed(text);
    }
    let (head, tail) = (MOST / 2, MOST / 4);
    let begin: String = text.chars().take(head).collect();
    let end: String = text.chars().skip(count - tail).collect();
    Cow::Owned(format!("{begin} … ({} characters more) … {end}", count - head - tail))
}

fn shown(text: &str, stays: impl Fn(char) -> bool) -> Cow<'_, str> {
    let hidden = |c: char| is_unseen(c) && !stays(c);
    if !text.contains(hidden) {
        return Cow::Borrowed(text);
    }
    let escape = |c: char| if hidden(c) { c.escape_default().to_string() } else { c.to_string() };
    Cow::Owned(text.chars().map(escape).collect())
}

/// For JSON: the same value, written without what is not seen. `text` is JSON already, which has
/// such characters in strings only.
pub fn json(text: String) -> String {
    let hidden = |c: char| is_unseen(c) && !matches!(c, '\n' | '\r' | '\t');
    if !text.contains(hidden) {
        return text;
    }
    // All of them lie in the basic plane: four digits name them.
    text.chars()
        .map(|c| if hidden(c) { format!("\\u{:04x}", u32::from(c)) } else { c.to_string() })
        .collect()
}

/// For a cell of a table (CSV): what a spreadsheet would compute begins with an apostrophe, which
/// makes it text there (OWASP, CSV injection). Numbers stay numbers, negative ones too.
pub fn cell(text: &str) -> Cow<'_, str> {
    let computed = text.trim_start().starts_with(['=', '+', '-', '@', '＝', '＋', '－', '＠'])
        && text.parse::<f64>().is_err();
    // Told by the text as it is, for a tab shown by its number begins nothing.
    match (computed, printable(text)) {
        (true, shown) => Cow::Owned(format!("'{shown}")),
        (false, shown) => shown,
    }
}

/// For HTML, SVG and other XML, between tags and inside quoted attributes: markup as its entities,
/// what is not seen by its number but line breaks and tabs; what XML 1.0 cannot hold is left out.
pub fn markup(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in document(text).chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            '\u{fffe}' | '\u{ffff}' => {}
            c => out.push(c),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every one of them does something somewhere.
    const UNSEEN: &str = "\u{0}\u{7}\u{1b}\u{7f}\u{85}\u{9b}\u{61c}\u{200e}\u{200f}\u{2028}\u{2029}\u{202a}\u{202e}\u{2066}\u{2069}\u{feff}";

    #[test]
    fn what_nobody_reads_is_shown_by_its_ends() {
        let short = "ä".repeat(MOST);
        assert_eq!(readable(&short), short);
        let long = format!("begin{}end", "ä".repeat(100_000));
        let shown = readable(&long);
        assert!(shown.starts_with("begin") && shown.ends_with("end"), "{shown}");
        assert!(shown.contains("98508 characters more") && shown.chars().count() < MOST, "{shown}");
    }

    #[test]
    fn nothing_unseen_gets_through_in_any_medium() {
        for text in [
            printable(UNSEEN).into_owned(),
            document(UNSEEN).into_owned(),
            cell(UNSEEN).into_owned(),
            markup(UNSEEN),
        ] {
            assert!(!text.contains(is_unseen) && text.contains("\\u{202e}"), "{text}");
        }
        let written = json(serde_json::to_string(UNSEEN).unwrap());
        assert!(!written.contains(is_unseen) && written.contains("\\u202e"), "{written}");
        assert_eq!(serde_json::from_str::<String>(&written).unwrap(), UNSEEN);
    }

    #[test]
    fn letters_of_every_script_stay() {
        for text in ["λ = 1°", "клин", "حجر", "אבן", "石", "می\u{200c}خواهم", "−x"]
        {
            assert!(matches!(printable(text), Cow::Borrowed(same) if same == text));
            assert_eq!(
                (cell(text).as_ref(), markup(text).as_str(), json(text.into()).as_str()),
                (text, text, text)
            );
        }
    }

    #[test]
    fn cells_are_text_or_numbers_and_never_computed() {
        for (text, wanted) in [
            ("=1+1", "'=1+1"),
            ("+x", "'+x"),
            ("-x", "'-x"),
            ("@SUM(A1)", "'@SUM(A1)"),
            ("\t=1", "'\\t=1"),
            (" =1", "' =1"),
            ("＝1", "'＝1"),
            ("-1+cmd|' /C calc'!A0", "'-1+cmd|' /C calc'!A0"),
            ("-1.5e-3", "-1.5e-3"),
            ("-inf", "-inf"),
            ("+2", "+2"),
            ("v01", "v01"),
            ("", ""),
        ] {
            assert_eq!(cell(text), wanted);
        }
    }
}
