//! What `voussoir check` says of a saved result.

use base::error::InputError;
use check::proof::{VerificationFile, read::read_str, verify};
use report::text::{Asked, Layout, TextOptions, render, verification};
use serde_json::{Value, json};

/// Name of the text in messages.
const NAME: &str = "result";

/// A browser breaks lines by itself.
const LAYOUT: Layout = Layout { unnamed: "", width: usize::MAX };

/// Verifies a saved result from the scene in it. `outcome` is `proved`, `refuted`, `open` (what it claims
/// is not refuted, and not all of it proved here) or `error`; `line` and `text` say so in the words of the
/// command, `answer` is the first line of the answer as it follows from the evidence, and `verification`
/// is what `voussoir check --json` prints.
pub fn check(text: &[u8]) -> Value {
    verified(text).unwrap_or_else(|e| json!({ "outcome": "error", "line": e.to_string() }))
}

fn verified(text: &[u8]) -> Result<Value, InputError> {
    let text = scene::text(NAME, text.to_vec())?.text;
    let saved = read_str(NAME, text)?;
    #[cfg(not(feature = "solver"))]
    let again = check::proof::recompute::Nothing;
    #[cfg(feature = "solver")]
    let again = analysis::recompute::Solvers::default();
    let found = verify(&saved, &saved.scene, &again)?;
    let name = &saved.scene.name;
    let page = verification(name, found.file.as_ref(), &found, LAYOUT);
    let answer = found.file.as_ref().map(|file| {
        let options = TextOptions { brief: true, ..TextOptions::default() };
        render(file, Asked::default(), options, LAYOUT).first_line().to_string()
    });
    let outcome = match (found.refuted(), found.proved()) {
        (true, _) => "refuted",
        (false, true) => "proved",
        (false, false) => "open",
    };
    Ok(json!({
        "outcome": outcome,
        "line": page.clone().first_line().to_string().trim_end(),
        "text": page.to_string(),
        "answer": answer.as_deref().map(str::trim_end),
        "verification": VerificationFile::new(name, &found),
    }))
}
