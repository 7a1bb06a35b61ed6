//! Strings of a file that want to be more than strings: markup, terminal codes, paths, formulas.
//! They come out as text, everywhere.

use serde_json::{Value, json};
use std::{fs, path::Path, process::Command};

/// A formula, markup, a terminal code that clears the screen and one that sets the title, an end of
/// a comment, a path, a backspace, a terminal code of one byte, marks that reorder what follows,
/// ends of line and paragraph.
const HOSTILE: &str = "=cmd|'/C calc'!A0<script>alert(1)</script>\"'&\u{1b}[2J\u{1b}]0;x\u{7}-->]]>../../evil\u{8}\r\n$(touch evil)`touch evil`\u{9b}2J\u{202e}\u{2066}\u{200f}\u{61c}\u{2028}\u{2029}";

fn run(folder: &Path, args: &[&str]) -> (Option<i32>, String, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_voussoir"))
        .current_dir(folder)
        .args(args)
        .output()
        .unwrap();
    let text = |b: &[u8]| String::from_utf8_lossy(b).into_owned();
    (output.status.code(), text(&output.stdout), text(&output.stderr))
}

/// No control characters but line breaks, no marks of direction, no separators of lines.
fn plain(text: &str) -> bool {
    !text.contains(|c: char| {
        c.is_control() && c != '\n' || matches!(c, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
    })
}

/// No cell of a table that a spreadsheet would compute; numbers are no such thing.
fn inert(table: &str) -> bool {
    let mut reader = csv::ReaderBuilder::new().has_headers(false).from_reader(table.as_bytes());
    let computed = |cell: &str| {
        cell.trim_start().starts_with(['=', '+', '-', '@']) && cell.parse::<f64>().is_err()
    };
    plain(table) && reader.records().all(|row| !row.unwrap().iter().any(computed))
}

fn scene() -> Value {
    let id = |k: usize| format!("{HOSTILE}{k}");
    let block = |k: usize, z: f64| json!({ "id": id(k), "material": HOSTILE, "shape": { "box": { "size": [1, 1, 1] } }, "at": [0, 0, z], "support": k == 0 });
    json!({
        "format": "voussoir-scene/1", "name": HOSTILE, "source": HOSTILE,
        "materials": { HOSTILE: { "density": 2400 } }, "joints": { "default": { "friction": 0.6 }, "overrides": [{ "blocks": [id(0), id(1)], "friction": 0.5 }] },
        "blocks": [block(0, -0.5), block(1, 0.5), block(2, 1.500_05)],
        "loads": { "live": [{ "block": id(2), "force": [1, 0, 0] }] }
    })
}

#[test]
fn strings_of_a_file_stay_text_on_the_terminal_and_in_drawings() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    fs::write(at.join("scene.json"), scene().to_string()).unwrap();
    let plan = json!({ "format": "voussoir-sweep/1", "scene": "scene.json", "question": { "limit": { "law": "associative" } }, "seed": 1,
        "vary": [{ "pointer": "/joints/default/friction", "name": HOSTILE, "values": [0.4, 0.5, 0.6] }], "sampling": { "grid": {} } });
    fs::write(at.join("plan.json"), plan.to_string()).unwrap();
    for args in [
        &["assess", "scene.json", "--verbose", "--report", "page.html", "--svg", "assess.svg"][..],
        &["assess", "scene.json", "--simulate"],
        &[
            "limit",
            "scene.json",
            "--verbose",
            "--save",
            "result.json",
            "--vtk",
            "limit.vtp",
            "--csv",
            "joints.csv",
        ],
        &["limit", "scene.json", "--json"],
        &["check", "scene.json", "--json"],
        &["check", "result.json", "--json"],
        &["check", "result.json"],
        &["check", "scene.json"],
        &["tilt", "scene.json", "--all", "1"],
        &["repose", "scene.json", "--all", "1", "--fabric", "--csv", "contacts.csv"],
        &["thrust", "scene.json", "--direction", "1,0", "--svg", "thrust.svg"],
        &[
            "critical",
            "scene.json",
            "--vary",
            "/joints/default/friction",
            "--between",
            "0.1",
            "0.9",
            "--scan",
            "3",
        ],
        &["simulate", "scene.json", "--fast", "--csv", "way.csv"],
        &[
            "sweep",
            "plan.json",
            "-o",
            "rows.jsonl",
            "--csv",
            "table.csv",
            "--svg",
            "chart.svg",
            "--report",
            "rows.html",
        ],
        &["sweep", "merge", "rows.jsonl", "-o", "merged.jsonl", "--json"],
    ] {
        let (code, out, err) = run(at, args);
        assert!(matches!(code, Some(0 | 1)), "{args:?}: {code:?} {err}");
        assert!(
            plain(&out) && plain(&err),
            "{args:?} lets control characters through: {out:?} {err:?}"
        );
    }
    for page in ["page.html", "rows.html"] {
        let text = fs::read_to_string(at.join(page)).unwrap();
        // Neither as markup nor inside the page's own script, where `</script>` would end it.
        assert!(
            !text.contains("<script>alert") && !text.contains("alert(1)</script>"),
            "{page} lets markup through"
        );
        assert!(text.contains("alert(1)") && plain(&text), "{page}");
    }
    for table in ["contacts.csv", "joints.csv", "joints.blocks.csv", "table.csv", "way.csv"] {
        let text = fs::read_to_string(at.join(table)).unwrap();
        assert!(text.contains("cmd|") && inert(&text), "{table}: {text}");
    }
    for file in ["result.json", "rows.jsonl", "merged.jsonl"] {
        let text = fs::read_to_string(at.join(file)).unwrap();
        assert!(plain(&text) && text.contains("\\u202e") && text.contains("\\u009b"), "{file}");
    }
    // Strings stand there as the numbers of their bytes.
    let vtp = fs::read_to_string(at.join("limit.vtp")).unwrap();
    let names = vtp
        .split("Name=\"block_names\"")
        .nth(1)
        .unwrap()
        .split('>')
        .nth(1)
        .unwrap()
        .split('<')
        .next()
        .unwrap();
    let bytes: Vec<u8> = names.split_whitespace().map(|n| n.parse().unwrap()).collect();
    let names = String::from_utf8(bytes).unwrap();
    assert!(plain(&vtp) && names.contains("cmd|") && plain(&names.replace('\0', "")), "{names:?}");
    for drawing in ["assess.svg", "thrust.svg", "chart.svg"] {
        let text = fs::read_to_string(at.join(drawing)).unwrap();
        assert!(!text.contains("<script") && plain(&text), "{drawing}");
        // Every `&` begins an entity and every quote in a text is one.
        for (place, _) in text.match_indices('&') {
            assert!(
                ["&amp;", "&lt;", "&gt;", "&quot;", "&apos;", "&#"]
                    .iter()
                    .any(|e| text[place..].starts_with(e)),
                "{drawing}: {}",
                &text[place..place + 20]
            );
        }
    }
    // Nothing was written elsewhere, nothing was run.
    let mut names: Vec<String> = fs::read_dir(at)
        .unwrap()
        .map(|e| e.unwrap().file_name().to_string_lossy().into_owned())
        .collect();
    names.sort();
    let wanted = [
        "assess.svg",
        "chart.svg",
        "contacts.csv",
        "joints.blocks.csv",
        "joints.csv",
        "limit.vtp",
        "merged.jsonl",
        "page.html",
        "plan.json",
        "result.json",
        "rows.html",
        "rows.jsonl",
        "scene.json",
        "table.csv",
        "thrust.svg",
        "way.csv",
    ];
    assert_eq!(names, wanted);
    assert!(!at.parent().unwrap().join("evil").exists());
}

#[test]
fn errors_quote_a_file_without_its_control_characters() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let mut texts = Vec::new();
    for pointer in
        ["/blocks/1/material", "/joints/overrides/0/blocks/0", "/loads/live/0/block", "/format"]
    {
        let mut broken = scene();
        *broken.pointer_mut(pointer).unwrap() = json!(format!("{HOSTILE}!"));
        texts.push(broken.to_string());
    }
    let mut unknown = scene();
    unknown[HOSTILE] = json!(1);
    texts.push(unknown.to_string());
    texts.push(format!("{HOSTILE}{{"));
    for text in texts {
        fs::write(at.join("scene.json"), text).unwrap();
        let (code, out, err) = run(at, &["assess", "scene.json"]);
        assert_eq!((code, out.as_str()), (Some(2), ""), "{err}");
        assert!(plain(&err) && err.lines().count() <= 3, "{err:?}");
    }
    fs::write(at.join("mesh.obj"), format!("o {HOSTILE}\nv 0 0 {HOSTILE}\n")).unwrap();
    let (code, _, err) = run(at, &["import", "mesh.obj"]);
    assert_eq!(code, Some(2));
    assert!(plain(&err), "{err:?}");
}

#[test]
fn paths_in_a_file_lead_nowhere_else() {
    // The path of a mesh stays in the folder of the scene (see `mesh_files`), and what it names is
    // quoted only where it is meant for a mesh.
    let folder = tempfile::tempdir().unwrap();
    let mut with_path = scene();
    with_path["blocks"][1]["shape"] = json!({ "mesh": { "path": "/etc/passwd" } });
    fs::write(folder.path().join("scene.json"), with_path.to_string()).unwrap();
    let (code, _, err) = run(folder.path(), &["assess", "scene.json"]);
    assert_eq!(code, Some(2));
    assert!(err.contains("leaves the folder of the scene") && !err.contains("root:"), "{err}");
    // The path of a plan's scene is read as a scene and quoted no further than its place.
    let plan = json!({ "format": "voussoir-sweep/1", "scene": "secret.txt", "question": { "assess": {} }, "seed": 1,
        "vary": [{ "pointer": "/joints/default/friction", "values": [0.4] }], "sampling": { "grid": {} } });
    fs::write(folder.path().join("plan.json"), plan.to_string()).unwrap();
    fs::write(folder.path().join("secret.txt"), "hunter2 is the password\n").unwrap();
    let (code, out, err) = run(folder.path(), &["sweep", "plan.json"]);
    assert_eq!((code, out.as_str()), (Some(2), ""));
    assert!(!err.contains("hunter2") && err.contains("secret.txt:1:1: not JSON"), "{err}");
}
