//! A report as one page: a single HTML file without any connection to a network, for a browser of
//! 2020 or later.
//!
//! The page holds the answer in words as printed on a terminal, the [`View`] as packed arrays, and
//! charts. Its styles and scripts are in `assets/`. Without WebGL 2 the picture is drawn on a plain
//! canvas; without scripts the words are still there. Every string that comes from a scene is
//! escaped ([`markup`], `html::json`) or set by the script as text, never as markup.

mod facts;
mod html;
mod live;
mod pack;
mod record;
mod self_checking;
mod study;
mod sweep;

pub use live::{live, piece};
pub use self_checking::SelfChecking;
pub use study::{experiments, extreme, omissions, study};
pub use sweep::sweep;

use super::{
    chart::{Chart, drawn},
    record::Record,
    text::Page,
    view::View,
};
use base::plain::markup;
use serde_json::{Value, json};

const TEMPLATE: &str = include_str!("assets/page.html");
const STYLE: &str = include_str!("assets/page.css");
/// What every page needs.
const BASE: &str = include_str!("assets/base.js");
const CHARTS: &str = include_str!("assets/chart.js");
/// The picture: state, camera, drawing on both kinds of canvas, picking, controls, numbers.
const SCENE: [&str; 9] = [
    include_str!("assets/vector.js"),
    include_str!("assets/model.js"),
    include_str!("assets/layers.js"),
    include_str!("assets/camera.js"),
    include_str!("assets/shaders.js"),
    include_str!("assets/webgl.js"),
    include_str!("assets/canvas.js"),
    include_str!("assets/numbers.js"),
    include_str!("assets/scene.js"),
];
const TABLES: &str = include_str!("assets/table.js");
const PICTURE: &str = include_str!("assets/picture.html");

/// The page of one answer: its words, its picture, its charts.
///
/// # Errors
/// Only if memory runs out.
pub fn page(text: &Page, view: &View, charts: &[Chart]) -> Result<String, serde_json::Error> {
    filed(text, view, charts, &Record::default())
}

/// The page of one answer with its record: what was asked of what, for the file and the printer.
///
/// # Errors
/// Only if memory runs out.
pub fn filed(
    text: &Page,
    view: &View,
    charts: &[Chart],
    record: &Record,
) -> Result<String, serde_json::Error> {
    self_checking(text, view, charts, record, None)
}

/// The same with what it verifies itself by, where there is such.
///
/// # Errors
/// Only if memory runs out.
pub fn self_checking(
    text: &Page,
    view: &View,
    charts: &[Chart],
    record: &Record,
    checking: Option<&SelfChecking>,
) -> Result<String, serde_json::Error> {
    let data = json!({ "view": pack::view(view), "charts": packed(charts) });
    let own = if checking.is_some() { self_checking::SCRIPTS } else { &[] };
    let scripts: Vec<&str> =
        [BASE, CHARTS].into_iter().chain(SCENE).chain(own.iter().copied()).collect();
    Ok(html::fill(
        TEMPLATE,
        &[
            ("title", &markup(&facts::plain_title(text))),
            ("style", STYLE),
            ("wasm", if checking.is_some() { " 'wasm-unsafe-eval'" } else { "" }),
            ("head", &facts::head(text)),
            ("verified", if checking.is_some() { self_checking::PLACE } else { "" }),
            ("kind", "picture"),
            ("main", PICTURE),
            ("cover", &record::cover(record)),
            ("facts", &facts::body(text)),
            ("record", &record::html(record)),
            ("version", env!("CARGO_PKG_VERSION")),
            ("data", &html::json(&data)?),
            ("proof", &checking.map(SelfChecking::html).transpose()?.unwrap_or_default()),
            ("script", &scripts.join("\n")),
        ],
    ))
}

/// Charts for a page: the drawing, and what is said where one points.
fn packed(charts: &[Chart]) -> Value {
    let pack = |chart: &Chart| {
        let own = drawn(chart);
        let [low, high, from, to] = own.along;
        let keys = own.keys.into_iter().map(|(name, colour)| {
            let class = colour.ok().map(|k| format!("c{k}"));
            json!({ "name": name, "class": class, "rgb": colour.err() })
        });
        let film = chart.film.then(|| json!([low, high, from, to]));
        json!({
            "title": chart.title, "svg": own.svg, "note": chart.note, "film": film,
            "spots": own.spots.iter().map(|([x, y], hint)| json!([x, y, hint])).collect::<Vec<_>>(),
            "keys": keys.collect::<Vec<_>>(), "wide": chart.cells.is_some(),
        })
    };
    charts.iter().map(pack).collect()
}

/// A page of charts and tables.
fn tables(
    text: &Page,
    charts: &[Chart],
    tables: &[serde_json::Value],
) -> Result<String, serde_json::Error> {
    let data = json!({ "charts": packed(charts), "tables": tables });
    Ok(html::fill(
        TEMPLATE,
        &[
            ("title", &markup(&facts::plain_title(text))),
            ("style", STYLE),
            ("head", &facts::head(text)),
            ("kind", "tables"),
            ("main", "<div id=\"charts\" class=\"charts\"></div><div id=\"tables\"></div>"),
            ("facts", &facts::body(text)),
            ("version", env!("CARGO_PKG_VERSION")),
            ("data", &html::json(&data)?),
            ("script", &[BASE, CHARTS, TABLES].join("\n")),
        ],
    ))
}
