//! "Did you mean …?" for keys and names.

/// The remedy for a `word` that is none of `known`: the nearest of them if one is near, else all of
/// them, else none.
pub fn suggest<'a>(word: &str, known: impl IntoIterator<Item = &'a str>) -> Option<String> {
    const LIST_AT_MOST: usize = 12;
    let mut known: Vec<&str> = known.into_iter().collect();
    known.dedup();
    // Numbers are padded with zeros so that names sort: r1_6 is r01_06.
    let mut alike = known.iter().filter(|k| without_zeros(k) == without_zeros(word));
    if let (Some(name), None) = (alike.next(), alike.next()) {
        return Some(format!("did you mean {name:?}?"));
    }
    // One mistake in three letters is still the same word; more, and the guess is noise.
    let mistakes = (word.chars().count() / 3).max(1);
    let nearest = known
        .iter()
        .map(|k| (strsim::damerau_levenshtein(&word.to_lowercase(), &k.to_lowercase()), *k))
        .min();
    match nearest {
        Some((distance, name)) if distance <= mistakes => Some(format!("did you mean {name:?}?")),
        None => None,
        Some(_) => {
            let list: Vec<String> =
                known.iter().take(LIST_AT_MOST).map(|k| format!("{k:?}")).collect();
            let more = if known.len() > LIST_AT_MOST {
                format!(" and {} more", known.len() - LIST_AT_MOST)
            } else {
                String::new()
            };
            Some(if known.len() == 1 {
                format!("the only choice is {}", list[0])
            } else {
                format!("choose one of {}{more}", list.join(", "))
            })
        }
    }
}

/// A name in small letters, its numbers without the zeros before them.
fn without_zeros(name: &str) -> String {
    let mut short = String::with_capacity(name.len());
    let mut letters = name.chars().peekable();
    let mut before = None;
    while let Some(letter) = letters.next() {
        let leads = letter == '0'
            && !before.is_some_and(|b: char| b.is_ascii_digit())
            && letters.peek().is_some_and(char::is_ascii_digit);
        if !leads {
            short.extend(letter.to_lowercase());
            before = Some(letter);
        }
    }
    short
}

#[cfg(test)]
mod tests {
    use super::suggest;

    #[test]
    fn names_the_nearest_or_lists_all() {
        let known = ["density", "shape", "support"];
        assert_eq!(suggest("densty", known).unwrap(), "did you mean \"density\"?");
        assert_eq!(suggest("Shape", known).unwrap(), "did you mean \"shape\"?");
        assert_eq!(
            suggest("colour", known).unwrap(),
            "choose one of \"density\", \"shape\", \"support\""
        );
        assert_eq!(suggest("colour", ["a"]).unwrap(), "the only choice is \"a\"");
        assert_eq!(suggest("colour", []), None);
        assert_eq!(
            suggest("R1_6", ["r01_06", "r10_06", "r01_16"]).unwrap(),
            "did you mean \"r01_06\"?"
        );
        assert_eq!(suggest("v0", ["v000", "v010"]).unwrap(), "did you mean \"v000\"?");
        let many: Vec<String> = (0..100).map(|i| format!("block number {i}")).collect();
        assert!(suggest("x", many.iter().map(String::as_str)).unwrap().ends_with("and 88 more"));
    }
}
