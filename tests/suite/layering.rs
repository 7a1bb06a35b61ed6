//! The rules that keep the house honest, held by reading the source.

use std::{
    collections::{BTreeMap, BTreeSet},
    path::{Path, PathBuf},
};

fn sources(folder: &str) -> Vec<(PathBuf, String)> {
    let mut list = Vec::new();
    let mut open = vec![Path::new(env!("CARGO_MANIFEST_DIR")).join(folder)];
    while let Some(path) = open.pop() {
        if path.is_dir() {
            open.extend(std::fs::read_dir(&path).unwrap().map(|e| e.unwrap().path()));
        } else if path.extension().is_some_and(|e| e == "rs") {
            let text = std::fs::read_to_string(&path).unwrap();
            list.push((
                path.strip_prefix(env!("CARGO_MANIFEST_DIR")).unwrap().to_path_buf(),
                code(&text),
            ));
        }
    }
    list.sort();
    assert!(!list.is_empty());
    list
}

/// The program text without comments and without the tests at its foot.
fn code(text: &str) -> String {
    let text = text.split("#[cfg(test)]").next().unwrap_or_default();
    text.lines()
        .map(|l| if l.trim_start().starts_with("//") { "" } else { l })
        .collect::<Vec<_>>()
        .join("\n")
}

fn is_test(path: &Path) -> bool {
    path.components().any(|c| c.as_os_str() == "tests")
        || path.file_stem().is_some_and(|s| s.to_string_lossy().contains("tests"))
}

/// The crates of the house, in the order in which they may use each other.
fn order() -> Vec<String> {
    let manifest = read("Cargo.toml");
    let listed = manifest.lines().filter_map(|l| l.split_once(" = { package = \"voussoir-"));
    listed.map(|(name, _)| name.to_string()).collect()
}

fn read(file: &str) -> String {
    std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(file)).unwrap()
}

/// What the manifest of a crate names after its heading `[dependencies]` and the like.
fn needs(name: &str) -> Vec<String> {
    let manifest = read(&format!("src/{name}/Cargo.toml"));
    let mut listed = Vec::new();
    let mut here = false;
    for line in manifest.lines() {
        if line.starts_with('[') {
            here = line.ends_with("dependencies]");
        } else if let Some((dependency, _)) = line.split_once(['.', ' ', '=']).filter(|_| here) {
            listed.push(dependency.to_string());
        }
    }
    listed
}

/// What is named after a prefix such as `crate::`, in paths and in grouped imports, with all that
/// follows in the path.
fn named_after(text: &str, prefix: &str) -> Vec<String> {
    let mut found = Vec::new();
    for (at, _) in text.match_indices(prefix) {
        let rest = &text[at + prefix.len()..];
        let group = if let Some(inner) = rest.strip_prefix('{') {
            let mut depth = 1;
            let end = inner.find(|c| {
                depth += i32::from(c == '{') - i32::from(c == '}');
                depth == 0
            });
            &inner[..end.unwrap_or(inner.len())]
        } else {
            rest.split(|c: char| !c.is_alphanumeric() && c != '_' && c != ':')
                .next()
                .unwrap_or_default()
        };
        let mut depth = 0;
        let mut names = vec![String::new()];
        for c in group.chars() {
            depth += i32::from(c == '{') - i32::from(c == '}');
            match c {
                ',' if depth == 0 => names.push(String::new()),
                _ => names.last_mut().unwrap().push(c),
            }
        }
        found.extend(names.iter().map(|name| name.trim().to_string()));
    }
    found
}

/// The first word of a path.
fn first(path: &str) -> &str {
    path.split(|c: char| !c.is_alphanumeric() && c != '_').next().unwrap_or_default()
}

#[test]
fn a_crate_uses_only_crates_above_it() {
    let order = order();
    assert_eq!(order.len(), 11, "{order:?}");
    for (rank, name) in order.iter().enumerate() {
        for other in needs(name) {
            let above = order.iter().position(|m| *m == other);
            assert!(above.is_none_or(|a| a < rank), "{name} uses {other}, which is below it");
        }
    }
}

/// One `use` of a tree of names as whole paths.
fn flat(tree: &str) -> Vec<String> {
    let tree = tree.trim();
    let Some(open) = tree.find('{') else { return vec![tree.to_string()] };
    let inside = tree[open..].trim_end().trim_end_matches('}');
    let parts = named_after(&format!("@{inside}}}"), "@");
    let own = |part: &String| flat(part).into_iter().map(|p| format!("{}{p}", &tree[..open]));
    parts.iter().filter(|part| !part.is_empty()).flat_map(own).collect()
}

/// What a file hands on of others by its own name, what it takes of others for itself, and the
/// paths that stand in its text.
#[derive(Default)]
struct File {
    given: BTreeMap<String, String>,
    taken: BTreeMap<String, String>,
    named: Vec<String>,
}

impl File {
    fn of(text: &str) -> Self {
        let mut file = Self::default();
        let mut rest = String::new();
        let mut lines = text.lines();
        while let Some(line) = lines.next() {
            let start = line.trim_start();
            let from = start
                .find("use ")
                .filter(|&at| at == 0 || (start.starts_with("pub") && !start[..at].contains("fn")));
            let Some(at) = from else {
                // That a file has another below it is no use of it.
                if !(start.ends_with(';') && start.contains("mod ")) {
                    rest.push_str(line);
                    rest.push('\n');
                }
                continue;
            };
            let mut whole = start[at + 4..].to_string();
            while !whole.trim_end().ends_with(';') {
                whole.push_str(lines.next().unwrap_or(";"));
            }
            for path in flat(whole.trim_end().trim_end_matches(';')) {
                let (path, other) = path.split_once(" as ").unwrap_or((&path, ""));
                let path = path.trim_end_matches("::self");
                let last = path.rsplit("::").next().unwrap_or_default();
                let name = if other.is_empty() { last } else { other };
                if at > 0 {
                    file.given.insert(name.to_string(), path.to_string());
                } else {
                    file.taken.insert(name.to_string(), path.to_string());
                    file.named.push(path.to_string());
                }
            }
        }
        let word = |c: char| c.is_alphanumeric() || c == '_' || c == ':';
        let paths = rest.split(|c| !word(c)).filter(|p| p.trim_matches(':').contains("::"));
        file.named.extend(paths.map(|p| p.trim_matches(':').to_string()));
        file
    }
}

/// The files of one crate by their modules, `lib.rs` and `mod.rs` by their folder's.
fn files(name: &str) -> BTreeMap<String, File> {
    // A room of the facade is named by its own name under `crate`, and others are none of its files.
    let inside = |text: &str| match order().iter().any(|own| own == name) {
        true => text.to_string(),
        false => text
            .replace(&format!("crate::{name}::"), "\u{1}")
            .replace("crate::", "facade::")
            .replace('\u{1}', "crate::"),
    };
    let folder = &format!("src/{name}");
    let depth = Path::new(folder).components().count();
    let own = |(path, text): (PathBuf, String)| {
        let path = path.with_extension("");
        let mut parts: Vec<_> =
            path.components().skip(depth).map(|c| c.as_os_str().to_string_lossy()).collect();
        if ["mod", "lib"].contains(&&*parts[parts.len() - 1]) {
            parts.pop();
        }
        (parts.join("::"), File::of(&inside(&text)))
    };
    sources(folder).into_iter().filter(|(path, _)| !is_test(path)).map(own).collect()
}

/// The file that a path leads to from another one, by way of what files hand on.
fn leads_to(
    files: &BTreeMap<String, File>,
    from: &str,
    path: &str,
    steps: usize,
) -> Option<String> {
    let join = |a: &str, b: &str| if a.is_empty() { b.to_string() } else { format!("{a}::{b}") };
    let up = |m: &str| m.rsplit_once("::").map_or(String::new(), |(up, _)| up.to_string());
    let mut parts: Vec<&str> = path.split("::").collect();
    let mut here = from.to_string();
    match parts[0] {
        "crate" => here = String::new(),
        "self" => {}
        "super" => {
            while parts.get(1) == Some(&"super") {
                here = up(&here);
                parts.remove(0);
            }
            here = up(&here);
        }
        own if files.contains_key(&join(from, own)) => here = join(from, own),
        own => {
            let taken = files[from].taken.get(own).filter(|p| first(p) != own && steps > 0)?;
            let whole = std::iter::once(taken.as_str()).chain(parts[1..].iter().copied());
            return leads_to(files, from, &whole.collect::<Vec<_>>().join("::"), steps - 1);
        }
    }
    for (k, part) in parts.iter().enumerate().skip(1) {
        let next = join(&here, part);
        if files.contains_key(&next) {
            here = next;
            continue;
        }
        let file = files.get(&here)?;
        if let Some(other) = file.given.get(*part).or(file.taken.get(*part)).filter(|_| steps > 0) {
            let whole = std::iter::once(other.as_str()).chain(parts[k + 1..].iter().copied());
            return leads_to(files, &here, &whole.collect::<Vec<_>>().join("::"), steps - 1);
        }
        break;
    }
    files.contains_key(&here).then_some(here)
}

/// Files that need each other today, `mod.rs` counted: of each crate how many stand in circles. They
/// may become fewer, and then this list does.
const CIRCLES: &[(&str, usize)] = &[("check", 21), ("analysis", 14), ("sweep", 2), ("report", 4)];

#[test]
fn files_need_each_other_nowhere_else() {
    let mut found = Vec::new();
    let order = order();
    for name in order.iter().map(String::as_str).chain(["cli", "live"]) {
        let files = files(name);
        let reach: BTreeMap<&String, BTreeSet<String>> = files
            .iter()
            .map(|(own, file)| {
                let led = file.named.iter().filter_map(|p| leads_to(&files, own, p, 8));
                (own, led.filter(|other| other != own).collect())
            })
            .collect();
        let returns = |own: &String| {
            let (mut seen, mut open) = (BTreeSet::new(), vec![own]);
            while let Some(here) = open.pop() {
                open.extend(reach[here].iter().filter(|next| seen.insert((*next).clone())));
            }
            seen.contains(own)
        };
        let circle: Vec<&String> = files.keys().filter(|own| returns(own)).collect();
        if !circle.is_empty() {
            println!("{name}: {circle:?}");
            found.push((name, circle.len()));
        }
    }
    assert_eq!(found, CIRCLES);
}

/// What the checker is made of.
const CHECKER: [&str; 5] = ["base", "scene", "model", "cholesky", "check"];

#[test]
fn the_checker_has_no_solver_no_threads_and_no_clock() {
    for name in CHECKER {
        for other in needs(name) {
            let known = !order().contains(&other) || CHECKER.contains(&other.as_str());
            assert!(
                known && !["clarabel", "rapier3d"].contains(&other.as_str()),
                "{name}: {other}"
            );
        }
        for (path, text) in sources(&format!("src/{name}")) {
            // Threads are a feature of the factors that the checker does not ask for.
            if is_test(&path) || (name == "cholesky" && path.ends_with("parallel.rs")) {
                continue;
            }
            let lines: Vec<&str> = text.lines().collect();
            let own = lines.windows(2).filter(|w| !w[0].trim_start().starts_with("#[cfg(feature"));
            for line in own.map(|w| w[1]) {
                for word in ["Instant", "SystemTime", "thread::", "rayon::prelude"] {
                    assert!(!line.contains(word), "{}: {line}", path.display());
                }
            }
        }
    }
    assert!(!read("src/check/Cargo.toml").contains("threads"));
}

/// The numbers that forces are judged by are derived a second time (`verdict::joint`), not asked of
/// the room that the program has them from.
#[test]
fn certificates_derive_shares_and_uplift_themselves() {
    for (path, text) in sources("src/check/verdict") {
        for name in named_after(&text, "strength::") {
            assert!(
                ["crushing", "laws"].contains(&first(&name)),
                "{} names strength::{name}",
                path.display()
            );
        }
        let whole = named_after(&text, "model::")
            .into_iter()
            .find(|name| first(name) == "strength" && !name.contains("::"));
        assert_eq!(whole, None, "{} uses the whole room", path.display());
    }
}

/// Who holds an answer holds its check: claims are checked where answers are made and where results
/// are read, and nowhere else.
#[test]
fn claims_are_checked_in_one_place() {
    for (path, text) in sources("src") {
        let name = path.to_string_lossy().replace('\\', "/");
        let known =
            ["src/check/", "src/analysis/proved.rs"].iter().any(|home| name.starts_with(home));
        // The ladder of verdicts goes on until the forces of one prove it.
        let known = known || name == "src/analysis/assess.rs";
        assert!(
            known || !text.contains("claim::verify("),
            "{name} checks a claim by itself: answers come checked (Proved)"
        );
    }
    for (path, text) in sources("src/cli") {
        for stage in [
            "program",
            "solve",
            "verdict::claim",
            "analysis::assess",
            "analysis::limit",
            "analysis::thrust",
        ] {
            assert!(
                !text.contains(&format!("{stage}::")),
                "{} composes stages: that is what `ask` is for",
                path.display()
            );
        }
    }
}

/// A second opinion that knew the first would be none.
#[test]
fn dynamics_never_sees_program_solver_or_verdict() {
    let needed = needs("dynamics");
    let of_ours: Vec<&String> = needed.iter().filter(|n| order().contains(n)).collect();
    assert_eq!(of_ours, ["base", "check", "model", "scene"]);
    for (path, text) in sources("src/dynamics") {
        for name in named_after(&text, "check::") {
            let word = first(&name);
            assert!(["ground", "terms"].contains(&word), "{} uses {word}", path.display());
        }
    }
}

#[test]
fn one_engine_one_adapter() {
    for (path, text) in sources("src") {
        let name = path.to_string_lossy().replace('\\', "/");
        for (engine, home) in [
            ("clarabel", "src/solve/"),
            ("faer", "src/cholesky/"),
            ("parry3d", "src/model/interface/detect"),
            ("rapier3d", "src/dynamics/rapier.rs"),
            ("clap", "src/cli/"),
        ] {
            // Hulls of random points are made by the same library that finds candidates.
            let home = if engine == "parry3d" && name == "src/scene/generate/hull.rs" {
                "src/scene/generate/hull.rs"
            } else {
                home
            };
            let home = if engine == "faer" && name.starts_with("src/solve/lu/") {
                "src/solve/lu/"
            } else {
                home
            };
            let named =
                text.contains(&format!("{engine}::")) || text.contains(&format!("use {engine}"));
            assert!(
                !named || name.starts_with(home) || (engine == "clap" && name == "src/main.rs"),
                "{name} names {engine}"
            );
        }
    }
}

#[test]
fn files_stay_small_and_main_smaller() {
    for (path, text) in sources("src") {
        let lines = text.lines().count();
        assert!(lines <= 600 || is_test(&path), "{}: {lines} lines", path.display());
        if path.ends_with("main.rs") {
            assert!(lines <= 60);
        }
    }
}

#[test]
fn files_are_opened_and_tables_written_in_one_place_each() {
    for (word, home) in [
        ("File::open(", "src/base/files.rs"),
        ("fs::read(", "src/base/files.rs"),
        ("fs::read_to_string(", "src/base/files.rs"),
        ("csv::Writer", "src/report/cells.rs"),
    ] {
        for (path, text) in sources("src") {
            let text = text.split("#[cfg(test)]").next().unwrap_or_default();
            let name = path.to_string_lossy().replace('\\', "/");
            // Not as the end of a longer name: `RowsFile::open`.
            let holds = text
                .match_indices(word)
                .any(|(at, _)| !text[..at].ends_with(char::is_alphanumeric));
            assert!(
                is_test(&path) || name == home || !holds,
                "{name} holds {word}, which belongs to {home}"
            );
        }
    }
}
