//! Pages that verify themselves: they say so, without a word on the console, and what was changed in
//! them turns red with the reason. Skipped, with a word, where `web/build` has made no checker.

use super::{Desk, structure};
use serde_json::{Value, json};
use std::{fs, path::PathBuf};

/// The checker for browsers, where there is one.
fn checker() -> Option<PathBuf> {
    let file = PathBuf::from(format!("{}/web/site/checker.wasm.gz", env!("CARGO_MANIFEST_DIR")));
    if !file.is_file() {
        crate::skipped("web/build has not made web/site/checker.wasm.gz");
        return None;
    }
    Some(file)
}

/// The result in a page.
const RESULT: [&str; 2] = ["<script type=\"application/json\" id=\"result\">", "</script>"];

/// The page with something in its result replaced.
fn edited(page: &str, pointer: &str, edit: impl Fn(&Value) -> Value) -> String {
    let (before, rest) = page.split_once(RESULT[0]).unwrap();
    let (result, after) = rest.split_once(RESULT[1]).unwrap();
    let mut result: Value = serde_json::from_str(result).unwrap();
    let place = result.pointer_mut(pointer).unwrap();
    *place = edit(place);
    format!("{before}{}{result}{}{after}", RESULT[0], RESULT[1])
}

#[test]
fn pages_verify_themselves() {
    let (Some(checker), Some(desk)) = (checker(), Desk::new(&[])) else { return };
    let browser = &desk.browser;
    let own = ["--self-checking", checker.to_str().unwrap()];
    let verdict = || {
        browser.until("return el('verified').className !== 'card verified' && !el('verified').querySelector('button').disabled");
        let said = browser.run("return [el('verified').className, el('verified').querySelector('strong').textContent, el('verified').querySelector('ul').textContent]");
        [0, 1, 2].map(|k| said[k].as_str().unwrap().to_string())
    };
    for (name, question, wanted) in [
        ("semicircular-arch-thin", "assess", "just now: falls; proved, to rounding"),
        ("oppenheim-arch", "limit", "carries 0.3736 × the live load"),
    ] {
        let scene = structure(name);
        desk.open(name, &[question, &scene, own[0], own[1]]);
        let [kind, said, _] = verdict();
        assert!(!kind.contains("bad") && said.contains(wanted), "{kind}: {said}");
        desk.quiet(name);
        browser.run("el('verified').querySelector('button').click()");
        assert_eq!(verdict()[1], said);
    }
    let page = fs::read_to_string(desk.folder.path().join("semicircular-arch-thin.html")).unwrap();
    let forged = [
        edited(&page, "/evidence/assess/standing/certificate/rates/0/velocity", |v| {
            json!([v[2].as_f64(), v[0].as_f64(), v[1].as_f64()])
        }),
        edited(&page, "/answer/verdict", |_| json!("stable")),
        edited(&page, "/scene/templates/0/arch/thickness", |_| json!(0.2)),
        page.replace(">Falls</h1>", ">Stands</h1>"),
        page.replace("\"format\":\"voussoir-result/3\"", "\"format\":\"voussoir-result/2\""),
    ];
    for (k, text) in forged.iter().enumerate() {
        assert_ne!(*text, page, "forgery {k}");
        let file = desk.folder.path().join(format!("forged-{k}.html"));
        fs::write(&file, text).unwrap();
        browser.open(&file);
        let [kind, said, why] = verdict();
        assert!(kind.contains("bad") && !why.is_empty(), "forgery {k}: {kind}: {said}: {why}");
    }
}
