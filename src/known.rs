//! Scenes with known load factors, which come with the house.

use scene::read_str;
use sweep::study::Known;

macro_rules! structure {
    ($name:literal) => {
        include_str!(concat!("../structures/", $name, ".json"))
    };
}

/// Running-bond wall of 100 courses pushed out of its plane: it turns about the foot of its lowest
/// course.
const WALL_100: &str = r#"{ "format": "voussoir-scene/1", "name": "Wall of 100 courses pushed out of its plane",
    "joints": { "default": { "friction": 0.6 } },
    "templates": [ { "wall": { "size": [1, 0.5, 0.4], "courses": 100, "blocks": 3, "first": "half", "base": "course" } } ],
    "loads": { "live": [ { "weight": [0, 1, 0] } ] } }"#;

/// All of them.
pub fn known() -> Vec<Known> {
    let list: [(&str, &str, f64, Option<f64>, &str); 8] = [
        (
            "arch",
            structure!("oppenheim-arch"),
            0.37361169234365993,
            None,
            "Oppenheim (1992), linear programming",
        ),
        (
            "wall",
            structure!("running-bond-wall"),
            0.5799986113337297,
            None,
            "geometry of Ferris & Tin-Loi (2001), linear programming",
        ),
        (
            "openings",
            structure!("wall-with-openings"),
            0.4036941035441143,
            None,
            "geometry of Ferris & Tin-Loi (2001), linear programming",
        ),
        (
            "corner",
            structure!("wall-corner"),
            0.5077265540878951,
            None,
            "computed by conic programming and linear programming with cone cuts",
        ),
        (
            "groove",
            structure!("block-in-groove"),
            0.8164965809277261,
            Some(std::f64::consts::FRAC_1_SQRT_2),
            "derived; the conventional value is that of Hoek & Bray, Rock Slope Engineering; closed form",
        ),
        ("column", structure!("column-1000"), 0.002, Some(0.002), "closed form: width / height"),
        ("courses", WALL_100, 0.0125, Some(0.0125), "closed form: width / height"),
        ("tiny", structure!("tiny-on-huge"), 0.5, Some(0.5), "elementary statics; closed form"),
    ];
    list.into_iter()
        .filter_map(|(name, text, truth, dry, source)| {
            Some(Known { name, scene: read_str(name, text).ok()?.0, truth, dry, source })
        })
        .collect()
}

#[cfg(test)]
mod tests {
    #[test]
    fn every_known_scene_is_there() {
        assert_eq!(super::known().len(), 8);
    }
}
