//! Partial factors of codes, as data with their clauses. The mechanics knows none of them.

use super::suggest;
use base::error::{InputError, JsonPath};
use serde_json::{Value, json};

/// The factors of a clause. Pairs are unfavourable and favourable ones.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Preset {
    /// As combinations name it.
    pub word: &'static str,
    /// The clause.
    pub source: &'static str,
    /// On permanent actions.
    pub permanent: [f64; 2],
    /// On permanent actions that are superimposed: pavements, fill, what is not structural.
    pub superimposed: [f64; 2],
    /// On variable actions that act unfavourably, the leading and the accompanying ones; the latter
    /// before their ψ.
    pub variable: [f64; 2],
}

const fn row(
    word: &'static str,
    source: &'static str,
    permanent: [f64; 2],
    superimposed: [f64; 2],
    variable: [f64; 2],
) -> Preset {
    Preset { word, source, permanent, superimposed, variable }
}

/// All of them. Where a code does not tell superimposed actions from others both have the same factors.
#[rustfmt::skip]
pub const PRESETS: &[Preset] = &[
    row("en1990_building_equ", "EN 1990:2002+A1:2005, Table A1.2(A)", [1.1, 0.9], [1.1, 0.9], [1.5, 1.5]),
    row("en1990_building_str", "EN 1990:2002+A1:2005, Table A1.2(B), eq. 6.10", [1.35, 1.0], [1.35, 1.0], [1.5, 1.5]),
    row("en1990_building_geo", "EN 1990:2002+A1:2005, Table A1.2(C)", [1.0, 1.0], [1.0, 1.0], [1.3, 1.3]),
    row("en1990_road_equ", "EN 1990:2002+A1:2005, Table A2.4(A), road traffic leading", [1.05, 0.95], [1.05, 0.95], [1.35, 1.5]),
    row("en1990_road_str", "EN 1990:2002+A1:2005, Table A2.4(B), eq. 6.10, road traffic leading", [1.35, 1.0], [1.35, 1.0], [1.35, 1.5]),
    row("en1990_road_geo", "EN 1990:2002+A1:2005, Table A2.4(C), road traffic leading", [1.0, 1.0], [1.0, 1.0], [1.15, 1.3]),
    row("en1990_rail_equ", "EN 1990:2002+A1:2005, Table A2.4(A), rail traffic (LM71) leading", [1.05, 0.95], [1.05, 0.95], [1.45, 1.5]),
    row("en1990_rail_str", "EN 1990:2002+A1:2005, Table A2.4(B), eq. 6.10, rail traffic (LM71) leading", [1.35, 1.0], [1.35, 1.0], [1.45, 1.5]),
    row("en1990_rail_geo", "EN 1990:2002+A1:2005, Table A2.4(C), rail traffic (LM71) leading", [1.0, 1.0], [1.0, 1.0], [1.25, 1.3]),
    row("ntc2018_building_equ", "NTC 2018, Tab. 2.6.I, EQU", [1.1, 0.9], [1.5, 0.8], [1.5, 1.5]),
    row("ntc2018_building_str", "NTC 2018, Tab. 2.6.I, A1", [1.3, 1.0], [1.5, 0.8], [1.5, 1.5]),
    row("ntc2018_building_geo", "NTC 2018, Tab. 2.6.I, A2", [1.0, 1.0], [1.3, 0.8], [1.3, 1.3]),
    row("ntc2018_road_equ", "NTC 2018, Tab. 5.1.V, EQU, traffic leading", [1.1, 0.9], [1.5, 0.0], [1.35, 1.5]),
    row("ntc2018_road_str", "NTC 2018, Tab. 5.1.V, A1, traffic leading", [1.35, 1.0], [1.5, 0.0], [1.35, 1.5]),
    row("ntc2018_road_geo", "NTC 2018, Tab. 5.1.V, A2, traffic leading", [1.0, 1.0], [1.3, 0.0], [1.15, 1.3]),
    row("ntc2018_seismic", "NTC 2018, 2.5.3, eq. 2.5.5: give psi_2 as psi", [1.0, 1.0], [1.0, 1.0], [1.0, 1.0]),
    row("aashto_strength_1", "AASHTO LRFD, Tables 3.4.1-1 and 3.4.1-2, Strength I (DC, DW, LL)", [1.25, 0.9], [1.5, 0.65], [1.75, 1.75]),
];

/// The preset of a word.
pub(super) fn find(word: &str, path: &JsonPath) -> Result<&'static Preset, InputError> {
    PRESETS.iter().find(|p| p.word == word).ok_or_else(|| {
        let words: Vec<&str> = PRESETS.iter().map(|p| p.word).collect();
        let hint = suggest(word, words.iter().copied())
            .unwrap_or_else(|| format!("there are {}", words.join(", ")));
        InputError::at(path.clone(), format!("no preset is called {word:?}")).hint(hint)
    })
}

/// All of them with their factors and clauses, as JSON.
pub fn presets() -> Value {
    let one = |p: &Preset| {
        json!({
            "preset": p.word,
            "source": p.source,
            "permanent": { "unfavourable": p.permanent[0], "favourable": p.permanent[1] },
            "superimposed": { "unfavourable": p.superimposed[0], "favourable": p.superimposed[1] },
            "variable": { "leading": p.variable[0], "accompanying": p.variable[1] },
        })
    };
    PRESETS.iter().map(one).collect()
}
