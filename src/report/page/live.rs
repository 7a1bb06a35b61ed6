//! The page that lives: the same picture, filled again and again with what a server says.

use super::{BASE, CHARTS, Chart, PICTURE, SCENE, STYLE, TEMPLATE, facts, html, pack, packed};
use crate::{
    text::Page,
    view::{Course, View},
};
use base::plain::markup;
use nalgebra::Vector3;
use serde_json::{Value, json};

const BAR: &str = include_str!("assets/live.html");
const SCRIPT: &str = include_str!("assets/live.js");

/// Sliders, and the words of the answer.
const WORDS: &str = "<section class=\"card\" id=\"knobs\" aria-label=\"Parameters of the scene\"></section><div id=\"words\"></div>";

/// The page before anything is said; `name` is that of the file.
///
/// # Errors
/// Only if memory runs out.
pub fn live(name: &str) -> Result<String, serde_json::Error> {
    let data = json!({ "view": pack::view(&nothing()), "charts": [] });
    let scripts: Vec<&str> = [BASE, CHARTS].into_iter().chain(SCENE).chain([SCRIPT]).collect();
    let name = markup(name);
    Ok(html::fill(
        TEMPLATE,
        &[
            ("title", &name),
            ("style", STYLE),
            ("connect", " connect-src 'self';"),
            ("head", &format!("<p class=\"name\">{name}</p><h1>…</h1>")),
            ("kind", "picture live"),
            ("main", &format!("{BAR}{PICTURE}")),
            ("facts", WORDS),
            ("version", env!("CARGO_PKG_VERSION")),
            ("data", &html::json(&data)?),
            ("script", &scripts.join("\n")),
        ],
    ))
}

/// An answer for such a page, with the members of the object `about` beside it.
///
/// # Errors
/// Only if memory runs out.
pub fn piece(
    mut about: Value,
    text: &Page,
    view: &View,
    charts: &[Chart],
) -> Result<String, serde_json::Error> {
    about["title"] = facts::plain_title(text).into();
    about["head"] = facts::head(text).into();
    about["facts"] = facts::body(text).into();
    about["view"] = pack::view(view);
    about["charts"] = packed(charts);
    html::json(&about)
}

/// A view of nothing.
fn nothing() -> View {
    View {
        name: String::new(),
        up: Vector3::z(),
        caption: String::new(),
        ground: Vector3::z(),
        gravity: 0.0,
        front: -Vector3::y(),
        low: Vector3::zeros(),
        high: Vector3::zeros(),
        bodies: Vec::new(),
        joints: Vec::new(),
        loads: Vec::new(),
        members: Vec::new(),
        states: Vec::new(),
        motions: Vec::new(),
        pressures: Vec::new(),
        film: Vec::new(),
        course: Course::default(),
        values: None,
        slope: None,
        roads: Vec::new(),
        hides_supports: false,
        is_measured: false,
    }
}
