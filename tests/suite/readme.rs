//! The README and the guide are tested: every `console` block is run and its output compared, every
//! link leads somewhere.

use std::{
    path::{Path, PathBuf},
    process::Command,
};

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn readme() -> String {
    std::fs::read_to_string(root().join("README.md")).unwrap()
}

/// The README and the pages of the guide, whose commands are run in a folder of their own.
fn guide() -> Vec<(PathBuf, String)> {
    let mut pages: Vec<PathBuf> = std::fs::read_dir(root().join("docs/guide"))
        .unwrap()
        .map(|e| e.unwrap().path())
        .filter(|p| p.extension().is_some_and(|e| e == "md"))
        .collect();
    pages.sort();
    pages.insert(0, root().join("README.md"));
    pages.into_iter().map(|page| (page.clone(), std::fs::read_to_string(page).unwrap())).collect()
}

/// Whether some page of the guide shows this picture of the checkout.
fn is_shown(name: &Path) -> bool {
    let shown = format!("{})", name.display());
    guide().iter().any(|(_, text)| {
        text.contains(&format!("]({shown}")) || text.contains(&format!("](../../{shown}"))
    })
}

/// Commands of the console blocks with the output printed under each.
fn examples(text: &str) -> Vec<(String, String)> {
    let mut list: Vec<(String, String)> = Vec::new();
    let mut inside = false;
    for line in text.lines() {
        match line {
            "```console" => inside = true,
            "```" => inside = false,
            _ if !inside => {}
            _ => match (line.strip_prefix("$ "), list.last_mut()) {
                (Some(command), _) => list.push((command.to_string(), String::new())),
                (None, Some((_, output))) => {
                    output.push_str(line);
                    output.push('\n');
                }
                (None, None) => panic!("output before a command: {line}"),
            },
        }
    }
    list
}

/// Times change from run to run: the `time` line is dropped, its continuation with it. Digits of
/// rounding change with every change of the arithmetic: only that it is rounding is compared.
fn without_times(text: &str) -> Vec<String> {
    let mut lines = Vec::new();
    let mut skip = false;
    for line in text.lines().map(str::trim_end) {
        skip = line.trim_start().starts_with("time ") || (skip && line.starts_with("        "));
        if !skip && !line.is_empty() {
            lines.push(line.split(' ').map(without_rounding).collect::<Vec<_>>().join(" "));
        }
    }
    lines
}

fn without_rounding(word: &str) -> &str {
    let number = word.trim_end_matches(',').parse::<f64>();
    if number.is_ok_and(|x| x > 0.0 && x < 1e-12) { "rounding" } else { word }
}

fn run(command: &str, folder: &Path) -> String {
    let program = env!("CARGO_BIN_EXE_voussoir");
    let words = command.replace("cargo run --release -- ", "voussoir ");
    let line: Vec<&str> =
        words.split(' ').map(|w| if w == "voussoir" { program } else { w }).collect();
    let line = line.join(" ");
    let output = Command::new("bash")
        .args(["-c", &line])
        .current_dir(folder)
        .env("NO_COLOR", "1")
        .env_remove("COLUMNS")
        .output()
        .unwrap();
    assert!(output.status.code().is_some_and(|c| c != 127 && c != 101), "{command}: {output:?}");
    String::from_utf8(output.stdout).unwrap() + &String::from_utf8(output.stderr).unwrap()
}

/// Lines that only one side has, with what to do about them.
fn difference(command: &str, want: &[String], got: &[String]) -> String {
    let only = |sign: &str, these: &[String], those: &[String]| -> Vec<String> {
        these.iter().filter(|l| !those.contains(l)).map(|l| format!("{sign} {l}")).collect()
    };
    let mut lines = only("-", want, got);
    lines.extend(only("+", got, want));
    if lines.is_empty() {
        lines.push("the same lines in another order or number".into());
    }
    format!(
        "the page does not hold what `{command}` prints:\n{}\nIf the lines with + are right, run the command with NO_COLOR=1 and paste its output there.",
        lines.join("\n")
    )
}

#[test]
fn every_console_block_prints_what_it_says() {
    let folder = tempfile::tempdir().unwrap();
    for part in ["", "sweeps", "meshes", "records", "records/suite"] {
        let part = format!("structures/{part}");
        std::fs::create_dir(folder.path().join(&part)).unwrap();
        for entry in std::fs::read_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join(&part)).unwrap() {
            let path = entry.unwrap().path();
            // Charts are made anew by the commands.
            if path.is_file() && path.extension().is_none_or(|e| e != "svg") {
                std::fs::copy(&path, folder.path().join(&part).join(path.file_name().unwrap()))
                    .unwrap();
            }
        }
    }
    std::fs::create_dir(folder.path().join("structures/drawings")).unwrap();
    let shown = guide().iter().map(|(_, text)| examples(text).len()).sum::<usize>();
    assert!(examples(&readme()).len() >= 6 && shown >= 40, "only {shown} commands are shown");
    for (page, text) in guide() {
        for (command, printed) in examples(&text) {
            let (want, got) =
                (without_times(&printed), without_times(&run(&command, folder.path())));
            assert!(want == got, "{}: {}", page.display(), difference(&command, &want, &got));
        }
    }
    charts_are_those_of_the_commands(folder.path());
    drawings_are_those_of_the_commands(folder.path());
}

fn drawings_are_those_of_the_commands(folder: &Path) {
    let mut drawings = 0;
    for entry in
        std::fs::read_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/structures/drawings")).unwrap()
    {
        let path = entry.unwrap().path();
        let name = Path::new("structures/drawings").join(path.file_name().unwrap());
        let [kept, made] = [&path, &folder.join(&name)]
            .map(|p| std::fs::read(p).unwrap_or_else(|e| panic!("{}: {e}", p.display())));
        assert!(kept == made, "{} is not what the command in the guide draws", name.display());
        assert!(is_shown(&name), "no page of the guide shows {}", name.display());
        assert!(kept.len() < 30_000, "{} is large", name.display());
        drawings += 1;
    }
    assert!(drawings > 0);
}

fn charts_are_those_of_the_commands(folder: &Path) {
    let mut plans = 0;
    for entry in
        std::fs::read_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/structures/sweeps")).unwrap()
    {
        let path = entry.unwrap().path();
        let is_plan = std::fs::read_to_string(&path).unwrap().contains("\"voussoir-sweep/1\"");
        if is_plan {
            plans += 1;
            let chart = path.with_extension("svg");
            let name = Path::new("structures/sweeps").join(chart.file_name().unwrap());
            let read = |path: &Path| {
                std::fs::read_to_string(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
            };
            assert!(
                read(&chart) == read(&folder.join(&name)),
                "{} is not what the command in the guide draws",
                name.display()
            );
            assert!(is_shown(&name), "no page of the guide shows {}", name.display());
        }
    }
    assert!(plans >= 3);
}

/// `cargo run` at the root, the README's first command, runs the only program that is built there.
#[test]
fn one_program_is_built_at_the_root() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let manifest = std::fs::read_to_string(root.join("Cargo.toml")).unwrap();
    let list = manifest.split("default-members = [").nth(1).unwrap().split(']').next().unwrap();
    let members: Vec<&str> = list.split('"').skip(1).step_by(2).filter(|m| *m != ".").collect();
    assert!(members.len() > 5);
    for member in members {
        let folder = root.join(member);
        let own = std::fs::read_to_string(folder.join("Cargo.toml")).unwrap();
        let programs = ["main.rs", "bin", "src/main.rs", "src/bin"];
        let other = programs.iter().any(|p| folder.join(p).exists()) || own.contains("[[bin]]");
        assert!(!other, "{member} builds a program: `cargo run` does not know which to run");
    }
}

/// Pages of `docs/` whose console blocks are run where they stand.
const PAGES: [&str; 5] =
    ["docs/bridges.md", "docs/ground.md", "docs/kinematic.md", "docs/stages.md", "docs/state.md"];

#[test]
fn pages_print_what_they_say() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    for page in PAGES {
        let examples = examples(&std::fs::read_to_string(root.join(page)).unwrap());
        assert!(!examples.is_empty(), "{page} shows no command");
        for (command, printed) in examples {
            let (want, got) = (without_times(&printed), without_times(&run(&command, root)));
            assert!(want == got, "{page}: {}", difference(&command, &want, &got));
        }
    }
}

#[test]
fn the_first_screen_holds_the_two_commands() {
    let text = readme();
    assert!(text.lines().count() < 150, "the README is a first page");
    let first: Vec<&str> = text.lines().take(60).collect();
    assert!(first.iter().any(|l| l.starts_with("$ cargo run --release -- assess structures/")));
    assert!(first.contains(&"cargo test"), "`.ci/run` takes its test command from here");
}

#[test]
fn the_scene_and_the_library_example_work() {
    let pages: String = guide().into_iter().map(|(_, text)| text).collect();
    let scenes = std::fs::read_to_string(root().join("docs/guide/scenes.md")).unwrap();
    let block = |text: &str, kind: &str| {
        text.split(&format!("```{kind}\n"))
            .nth(1)
            .and_then(|t| t.split("```").next())
            .unwrap()
            .to_string()
    };
    let (scene, _) =
        voussoir::scene::read_str("docs/guide/scenes.md", block(&scenes, "json")).unwrap();
    let model = voussoir::interface::prepare(&scene).unwrap();
    assert_eq!(model.assembly.blocks.len(), 30);
    let tour = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/src/lib.rs")).unwrap();
    for line in block(&pages, "rust").lines() {
        assert!(tour.contains(line), "the crate tour in src/lib.rs does not hold: {line}");
    }
}

/// Markdown files of the checkout.
fn pages(folder: &Path, list: &mut Vec<PathBuf>) {
    const BUILT: [&str; 4] = ["target", "node_modules", ".git", ".venv"];
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        if path.is_dir() && !BUILT.contains(&name.as_str()) {
            pages(&path, list);
        } else if name.ends_with(".md") {
            list.push(path);
        }
    }
}

/// Targets of the links of a page, code left out.
fn targets(text: &str) -> Vec<String> {
    let mut inside = false;
    let prose = text.lines().filter(|line| {
        let fence = line.trim_start().starts_with("```");
        inside ^= fence;
        !inside && !fence
    });
    prose
        .flat_map(|line| line.split('`').step_by(2).map(str::to_string).collect::<Vec<_>>())
        .flat_map(|words| {
            let links = words.split("](").skip(1);
            links.filter_map(|l| l.split(')').next().map(str::to_string)).collect::<Vec<_>>()
        })
        .collect()
}

#[test]
fn links_inside_the_repository_lead_somewhere() {
    let mut list = Vec::new();
    pages(root(), &mut list);
    let mut links = 0;
    for page in list {
        let text = std::fs::read_to_string(&page).unwrap();
        for target in targets(&text) {
            if target.contains("://") || target.starts_with("mailto:") || target.starts_with('#') {
                continue;
            }
            let file = target.split('#').next().unwrap();
            let there = page.parent().unwrap().join(file);
            assert!(there.exists(), "{}: the link to {target} leads nowhere", page.display());
            links += 1;
        }
    }
    assert!(links > 100, "only {links} links found");
}

#[test]
fn the_keys_are_those_of_the_schema() {
    let page = std::fs::read_to_string(root().join("docs/guide/keys.md")).unwrap();
    let printed = run("voussoir schema scene --markdown", root());
    assert!(
        printed.lines().count() > 500 && printed.contains("| `thickness` | number | required |")
    );
    assert!(
        page.ends_with(&printed),
        "docs/guide/keys.md does not end with what `voussoir schema scene --markdown` prints"
    );
    let anchors: Vec<String> = printed
        .lines()
        .filter_map(|l| l.strip_prefix("## ").or(l.strip_prefix("### ")))
        .map(|t| t.trim_matches('`').to_lowercase())
        .collect();
    for target in targets(&page).iter().filter_map(|t| t.strip_prefix('#')) {
        assert!(anchors.iter().any(|a| a == target), "no section {target}");
    }
}

#[test]
fn the_book_holds_every_page() {
    let docs = root().join("docs");
    let summary = std::fs::read_to_string(docs.join("SUMMARY.md")).unwrap();
    let held: Vec<PathBuf> = targets(&summary).iter().map(|t| docs.join(t)).collect();
    let mut list = Vec::new();
    pages(&docs, &mut list);
    for page in
        list.iter().filter(|p| !p.ends_with("SUMMARY.md") && !p.starts_with(docs.join("peers")))
    {
        assert_eq!(held.iter().filter(|h| *h == page).count(), 1, "{}", page.display());
    }
}

#[test]
fn what_is_cited_is_this_version() {
    let text = std::fs::read_to_string(root().join("CITATION.cff")).unwrap();
    let value = |key: &str| {
        text.lines().find_map(|line| line.strip_prefix(key)?.strip_prefix(": ")).unwrap()
    };
    assert_eq!(value("version"), env!("CARGO_PKG_VERSION"));
    assert_eq!(value("title"), env!("CARGO_PKG_NAME"));
    let changes = std::fs::read_to_string(root().join("CHANGELOG.md")).unwrap();
    let version = format!("## {}", env!("CARGO_PKG_VERSION"));
    assert!(changes.lines().any(|line| line.starts_with(&version)), "no changes of {version}");
}
