//! What a record is made of: headings with what stands under them.

/// A heading with what stands under it.
#[derive(Clone, Debug, PartialEq)]
pub struct Section {
    /// Its heading.
    pub title: String,
    /// What it says.
    pub parts: Vec<Part>,
}

impl Section {
    pub(super) fn new(title: &str, parts: Vec<Part>) -> Self {
        Self { title: title.into(), parts }
    }
}

/// A piece of a section.
#[derive(Clone, Debug, PartialEq)]
pub enum Part {
    /// A paragraph.
    Text(String),
    /// Names with their values.
    Facts(Vec<[String; 2]>),
    /// A table; of a column of numbers the flag is false.
    Table {
        /// Names of the columns, and whether they hold words.
        columns: Vec<(String, bool)>,
        /// Rows.
        rows: Vec<Vec<String>>,
        /// What the columns mean.
        note: String,
        /// The table runs over so many columns of the page.
        across: usize,
    },
}

impl Part {
    /// A table; a column whose name begins with `#` holds numbers.
    pub(super) fn table(columns: &[&str], rows: Vec<Vec<String>>, note: &str) -> Self {
        let column = |c: &&str| match c.strip_prefix('#') {
            Some(name) => (name.into(), false),
            None => (c.to_string(), true),
        };
        Self::Table {
            columns: columns.iter().map(column).collect(),
            rows,
            note: note.into(),
            across: 1,
        }
    }

    /// A table of narrow rows, over so many columns of the page.
    pub(super) fn across(mut self, columns: usize) -> Self {
        if let Self::Table { across, .. } = &mut self {
            *across = columns;
        }
        self
    }
}

/// Rows of a list in full; of longer ones the first, and a row that says how many are not shown.
pub(super) fn listed(rows: Vec<Vec<String>>, most: usize) -> Vec<Vec<String>> {
    let count = rows.len();
    if count <= most + 1 {
        return rows;
    }
    let mut list: Vec<Vec<String>> = rows.into_iter().take(most).collect();
    list.push(vec![format!("… and {} more", count - most)]);
    list
}

/// A number with its unit and a prefix that leaves it readable: `12.3 kN`.
pub(super) fn quantity(value: f64, unit: &str) -> String {
    let size = value.abs();
    let (by, prefix) = match size {
        s if s.is_infinite() => return "no limit".into(),
        s if s >= 1e12 => (1.0, ""),
        s if s >= 1e9 => (1e9, "G"),
        s if s >= 1e6 => (1e6, "M"),
        s if s >= 1e3 => (1e3, "k"),
        _ => (1.0, ""),
    };
    format!("{} {prefix}{unit}", base::number::short(value / by))
}

/// A share in per cent, with as many digits as it takes to tell it from all.
pub(super) fn percent(share: f64) -> String {
    if share.is_nan() {
        "–".into()
    } else if share.is_infinite() {
        "no resistance".into()
    } else {
        format!("{:.1} %", 100.0 * share)
    }
}
