//! The rules that keep the house honest, held by reading the source.

use std::path::{Path, PathBuf};

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

fn order() -> Vec<String> {
    let lib = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/src/lib.rs")).unwrap();
    lib.lines()
        .filter_map(|l| l.strip_prefix("pub mod "))
        .map(|m| m.trim_end_matches(';').to_string())
        .collect()
}

/// The module of a file: `src/scene/read.rs` → `scene`.
fn module(path: &Path) -> String {
    let part = path.components().nth(1).unwrap().as_os_str().to_string_lossy().into_owned();
    part.trim_end_matches(".rs").to_string()
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

/// Modules named after `crate::`.
fn used(text: &str, order: &[String]) -> Vec<String> {
    named_after(text, "crate::")
        .iter()
        .map(|path| first(path).to_string())
        .filter(|name| order.contains(name))
        .collect()
}

#[test]
fn a_module_uses_only_modules_above_it() {
    let order = order();
    assert!(order.len() >= 12, "{order:?}");
    for (path, text) in sources("src") {
        let own = module(&path);
        let Some(rank) = order.iter().position(|m| *m == own) else { continue };
        for other in used(&text, &order) {
            let above = order.iter().position(|m| *m == other).unwrap();
            assert!(
                above <= rank || is_test(&path),
                "{}: {own} uses {other}, which is declared below it",
                path.display()
            );
        }
    }
}

/// A stage of a construction may ask any question, and a question may be one about stages.
const AGAIN: [&str; 2] = ["analysis::ask", "analysis::stages"];

/// The modules that every file names, itself as its path; files that only hold a folder together
/// (`mod.rs`) are left out.
fn names() -> std::collections::BTreeMap<String, Vec<String>> {
    let modules: Vec<(String, String)> = sources("src")
        .into_iter()
        .filter(|(path, _)| !is_test(path) && !path.ends_with("mod.rs"))
        .map(|(path, text)| {
            let path = path.with_extension("");
            let parts = path.components().skip(1).map(|c| c.as_os_str().to_string_lossy());
            (parts.collect::<Vec<_>>().join("::"), text)
        })
        .collect();
    let known = |path: &str| {
        let named = |m: &&String| path == m.as_str() || path.starts_with(&format!("{m}::"));
        modules.iter().map(|(m, _)| m).filter(named).max_by_key(|m| m.len()).cloned()
    };
    // Two and more steps up first: what is left of them is not one step.
    const UP: [(&str, &str); 3] =
        [("super::super::super::", "@3:"), ("super::super::", "@2:"), ("super::", "@1:")];
    let of = |(own, text): &(String, String)| {
        let marked = UP.iter().fold(text.clone(), |text, (up, mark)| text.replace(up, mark));
        let mut targets: Vec<String> = named_after(&marked, "crate::");
        for (steps, (_, mark)) in [3, 2, 1].into_iter().zip(UP) {
            let parts: Vec<&str> = own.split("::").collect();
            let base = parts[..parts.len().saturating_sub(steps)].join("::");
            targets.extend(named_after(&marked, mark).iter().map(|t| format!("{base}::{t}")));
        }
        let whole = |t: &String| t.split([' ', '{']).next().unwrap_or_default().to_string();
        // A file and those in the folder of its name are one module.
        let apart = |t: &String| {
            t != own && !t.starts_with(&format!("{own}::")) && !own.starts_with(&format!("{t}::"))
        };
        let mut targets: Vec<String> =
            targets.iter().map(whole).filter_map(|t| known(&t)).filter(apart).collect();
        targets.sort();
        targets.dedup();
        (own.clone(), targets)
    };
    modules.iter().map(of).collect()
}

#[test]
fn no_two_files_need_each_other() {
    let names = names();
    assert!(names.len() > 300, "only {} files", names.len());
    for (start, first) in &names {
        let mut open: Vec<Vec<&String>> = first.iter().map(|t| vec![t]).collect();
        let mut seen = std::collections::BTreeSet::new();
        while let Some(way) = open.pop() {
            let here = way[way.len() - 1];
            let again = [start, here].iter().all(|m| AGAIN.contains(&m.as_str()));
            assert!(again || here != start, "{start} names itself by way of {way:?}");
            if seen.insert(here) && !again {
                open.extend(names[here].iter().map(|t| [&way[..], &[t]].concat()));
            }
        }
    }
}

/// Modules that are there in a build without any feature.
fn checker() -> Vec<String> {
    let lib = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/src/lib.rs")).unwrap();
    let lines: Vec<&str> = lib.lines().collect();
    let plain = lines.windows(2).filter(|w| !w[0].starts_with("#[cfg("));
    plain
        .filter_map(|w| w[1].strip_prefix("pub mod "))
        .map(|m| m.trim_end_matches(';').to_string())
        .collect()
}

#[test]
fn the_checker_has_no_solver_no_threads_and_no_clock() {
    let checker = checker();
    assert!(checker.iter().any(|m| m == "proof") && !checker.iter().any(|m| m == "solve"));
    for (path, text) in sources("src") {
        if is_test(&path) || !checker.contains(&module(&path)) {
            continue;
        }
        // What stands behind a feature is not in the checker.
        let lines: Vec<&str> = text.lines().collect();
        let own = lines.windows(2).filter(|w| !w[0].trim_start().starts_with("#[cfg(feature"));
        for line in own.map(|w| w[1]) {
            for word in ["Instant", "SystemTime", "thread::", "rayon", "clarabel", "rapier3d"] {
                assert!(!line.contains(word), "{}: {line}", path.display());
            }
        }
    }
}

#[test]
fn certificates_never_see_the_program() {
    for (path, text) in sources("src/verdict") {
        for word in ["program", "solve::", "Statics::new", "clarabel"] {
            assert!(
                !text.contains(&format!("crate::{word}"))
                    && !text.contains(&format!("    {word},")),
                "{} names {word}",
                path.display()
            );
        }
    }
}

/// The numbers that forces are judged by are derived a second time (`verdict::joint`), not asked of
/// the room that the program has them from.
#[test]
fn certificates_derive_shares_and_uplift_themselves() {
    for (path, text) in sources("src/verdict") {
        for name in named_after(&text, "strength::") {
            assert!(
                ["crushing", "laws"].contains(&first(&name)),
                "{} names strength::{name}",
                path.display()
            );
        }
        let whole = named_after(&text, "crate::")
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
        let known = ["src/verdict/", "src/proof/", "src/analysis/proved.rs"]
            .iter()
            .any(|home| name.starts_with(home));
        // The ladder of verdicts goes on until the forces of one prove it.
        let known = known || name == "src/analysis/assess.rs";
        assert!(
            known || !text.contains("check::verify("),
            "{name} checks a claim by itself: answers come checked (Proved)"
        );
    }
    for (path, text) in sources("src/cli") {
        for stage in [
            "program",
            "solve",
            "verdict::check",
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
    for (path, text) in sources("src/dynamics") {
        for word in used(&text, &order()) {
            let known = [
                "error",
                "tolerance",
                "plane",
                "ground",
                "scene",
                "assembly",
                "interface",
                "strength",
                "terms",
                "dynamics",
            ]
            .contains(&word.as_str());
            assert!(known, "{} uses {word}", path.display());
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
            ("parry3d", "src/interface/detect"),
            ("rapier3d", "src/dynamics/rapier.rs"),
            ("clap", "src/cli/"),
        ] {
            // Hulls of random points are made by the same library that finds candidates.
            let home = if engine == "parry3d" && name == "src/generate/hull.rs" {
                "src/generate/hull.rs"
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
        ("File::open(", "src/files.rs"),
        ("fs::read(", "src/files.rs"),
        ("csv::Writer", "src/report/cells.rs"),
    ] {
        for (path, text) in sources("src") {
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
