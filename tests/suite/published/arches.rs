//! Arches under their own weight, pushed sideways, and under a point load. Templates make the
//! voussoirs (straight chords).

use crate::ask::*;
use serde_json::json;
use voussoir::{
    generate,
    scene::{Scene, Template},
};

const NO_SLIDING: f64 = f64::INFINITY;

fn circular(voussoirs: u32, embrace_deg: f64, thickness: f64, friction: f64) -> Scene {
    pushed_circular(voussoirs, embrace_deg, thickness, friction, json!({}))
}

fn pushed_circular(
    voussoirs: u32,
    embrace_deg: f64,
    thickness: f64,
    friction: f64,
    more: serde_json::Value,
) -> Scene {
    template(
        friction,
        json!({ "arch": { "radius": 1, "thickness": thickness, "depth": 1, "voussoirs": voussoirs, "embrace_deg": embrace_deg } }),
        more,
    )
}

/// The verdict flips within a relative `margin` of the critical value; greater stands.
#[track_caller]
fn critical(case: &str, make: impl Fn(f64) -> Scene, value: f64, margin: f64) {
    flips(case, make, value * (1.0 + margin), value * (1.0 - margin));
}

#[test]
fn least_thickness_of_circular_arches() {
    // Five-hinge closed form (even N) and linear programming (odd N) for straight chords;
    // Milankovitch, Zeitschrift für Mathematik und Physik 55 (1907): 0.10748 for a semicircle of
    // infinitely many voussoirs.
    for (case, voussoirs, embrace_deg, value) in [
        ("B01", 8, 180.0, 0.09997167404660162),
        ("B02", 16, 180.0, 0.10707620314306167),
        ("B03", 32, 180.0, 0.10719700209534225),
        ("B04", 64, 180.0, 0.10738320250302051),
        ("B06", 24, 180.0, 0.1070963827484465),
        ("B08", 7, 180.0, 0.09570345392150328),
        ("B09", 27, 180.0, 0.10672090355137132),
        ("B12", 14, 157.5, 0.06332773901334111),
    ] {
        critical(case, |t| circular(voussoirs, embrace_deg, t, NO_SLIDING), value, 1e-6);
    }
}

#[test]
fn the_verdict_resolves_a_millionth_and_a_hundred_millionth() {
    // G14: ± 1e-6 of B02's value with friction 0.8; G15: ± 1e-8.
    for (case, margin) in [("G14", 1e-6), ("G15", 1e-8)] {
        critical(case, |t| circular(16, 180.0, t, 0.8), 0.10707620314306167, margin);
    }
}

#[test]
fn least_friction_of_semicircles() {
    // Linear programming. For infinitely many voussoirs 0.395832 at the least thickness and
    // 0.309215 for thick rings (Cocchetti & Rizzi, Frattura ed Integrità Strutturale 51, 2020).
    for (case, voussoirs, thickness, value) in [
        ("B20", 16, 0.15, 0.35313179457625665),
        ("B21", 32, 0.25, 0.30918286138421536),
        ("B22", 16, 0.2, 0.30790408345637843),
    ] {
        flips(case, |mu| circular(voussoirs, 180.0, thickness, mu), value + 1e-7, value - 1e-7);
    }
}

#[test]
fn least_thickness_where_joints_slide() {
    // B26: configuration of Gilbert, Casapulla & Ahmed, Computers & Structures 84 (2006); linear
    // programming.
    critical("B26", |t| circular(27, 180.0, t, 0.36), 0.1408908492734099, 1e-6);
}

#[test]
fn load_factors_of_arches_pushed_sideways() {
    let push = push([1.0, 0.0, 0.0]);
    // B16: Oppenheim (1992); De Lorenzis, DeJong & Ochsendorf (2007): 0.37 g for curved voussoirs;
    // straight chords by linear programming.
    let oppenheim = json!({ "arch": { "radius": 10, "thickness": 1.5, "depth": 1, "voussoirs": 7, "embrace_deg": 157.5 } });
    exact("B16", &template(NO_SLIDING, oppenheim, push.clone()), 0.37361169234365993, 1e-7);
    // B19: linear programming, two solvers; sliding does not matter.
    for friction in [NO_SLIDING, 0.6] {
        exact(
            "B19",
            &pushed_circular(16, 180.0, 0.15, friction, push.clone()),
            0.1499692359095236,
            1e-7,
        );
    }
    // B32: pointed arch of t / R = 0.15 (class of Makris & Nikolic 2017); linear programming.
    let pointed = json!({ "arch": { "profile": "pointed", "radius": 1, "eccentricity": 0.25, "thickness": 0.15, "depth": 1, "voussoirs": 16 } });
    exact("B32", &template(NO_SLIDING, pointed, push.clone()), 0.2566828825812487, 1e-7);
    // B39: on buttresses of width 1.6; linear programming.
    exact("B39", &buttressed(1.6, 0.6, push), 0.14996923590952393, 1e-7);
}

#[test]
fn a_point_load_on_the_haunch() {
    // B30: in N for unit density and gravity; linear programming.
    let load = json!({ "loads": { "live": [{ "block": "v11", "force": [0, 0, -1], "at": [0.6944723578133825, 0, 0.846217016419001] }] } });
    exact("B30", &pushed_circular(16, 180.0, 0.2, NO_SLIDING, load), 0.583382759025224, 1e-7);
}

#[test]
fn least_thickness_of_pointed_and_elliptical_arches() {
    // B32: two centres, e / R = 0.25 (class of Makris & Nikolic 2017). B34: b / a = 0.8 (class of
    // Alexakis & Makris 2013). Linear programming.
    let pointed = |t: f64, friction: f64| {
        template(
            friction,
            json!({ "arch": { "profile": "pointed", "radius": 1, "eccentricity": 0.25, "thickness": t, "depth": 1, "voussoirs": 16 } }),
            json!({}),
        )
    };
    critical("B32", |t| pointed(t, NO_SLIDING), 0.06343091660240589, 1e-6);
    critical("B32, least friction at 0.15", |mu| pointed(0.15, mu), 0.2463544710444694, 1e-6);
    let elliptical = |t: f64| {
        let arch = json!({ "arch": { "profile": "elliptical", "span": 2, "rise": 0.8, "thickness": t, "depth": 1, "voussoirs": 16 } });
        template(NO_SLIDING, arch, json!({}))
    };
    critical("B34", elliptical, 0.10746235331988147, 1e-6);
}

#[test]
fn a_funicular_arch_needs_friction_only() {
    // B36, B37: parabola of span 10 and rise 2.5 with vertical joints, thrust line = mid-line
    // (Gregory, Hooke): μ = 1 − 0.4 t exactly. At a thickness of 1e-6 m an interior-point method
    // without scaling calls it unstable.
    for (case, thickness, margin) in [("B36", 1e-3, 1e-6), ("B37", 1e-6, 1e-4)] {
        let arch = |mu: f64| {
            let arch = json!({ "arch": {
                "profile": "parabolic", "span": 10, "rise": 2.5, "joints": "vertical", "thickness": thickness, "depth": 1, "voussoirs": 20 } });
            template(mu, arch, json!({}))
        };
        let least = 1.0 - 0.4 * thickness;
        flips(case, arch, least + margin, least - margin);
        flips(case, arch, 1.01, 0.99);
    }
}

fn buttressed(width: f64, friction: f64, more: serde_json::Value) -> Scene {
    let arch = json!({ "arch": {
        "radius": 2, "thickness": 0.3, "depth": 1, "voussoirs": 16, "buttresses": { "width": width, "height": 4 } } });
    template(friction, arch, more)
}

#[test]
fn least_width_of_buttresses() {
    // B39: class of Ochsendorf (2002); linear programming; the same without sliding.
    for friction in [0.6, NO_SLIDING] {
        critical("B39", |width| buttressed(width, friction, json!({})), 0.6607716013125127, 1e-6);
    }
}

#[test]
fn least_thickness_of_a_ring_with_vertical_joints() {
    // B43: 12 slices a half, linear programming; Makris & Alexakis (2013): 0.1095 for infinitely
    // many.
    let ring = |t: f64| {
        let arch = json!({ "arch": {
            "radius": 1, "joints": "vertical", "thickness_along": "normal", "thickness": t, "depth": 1, "voussoirs": 24 } });
        template(NO_SLIDING, arch, json!({}))
    };
    critical("B43", ring, 0.10894485320760622, 1e-6);
}

/// C01: two opposite narrow lunes of a hemispherical dome of radius 1 as an arch of N voussoirs,
/// with the masses and centres of mass of lunes. Of a unit wedge angle, with r from 1 − t/2 to 1 +
/// t/2 and φ from the crown: mass ∫∫ r² sin φ, first moments ∫∫ r³ sin φ (sin φ, cos φ).
fn lune(voussoirs: usize, t: f64) -> Scene {
    let arch =
        json!({ "arch": { "radius": 1, "thickness": t, "depth": 1, "voussoirs": voussoirs } });
    let arch: Template = serde_json::from_value(arch).expect("a template");
    let mut blocks = generate::expand(&arch).expect("an arch");
    let power = |k: i32| ((1.0 + t / 2.0).powi(k) - (1.0 - t / 2.0).powi(k)) / f64::from(k);
    let step = std::f64::consts::PI / voussoirs as f64;
    for block in blocks.iter_mut().filter(|b| !b.support) {
        let index: usize = block.id[1..].parse().expect("v<index>");
        let (from, to) = (
            step * index as f64 - std::f64::consts::FRAC_PI_2,
            step * (index + 1) as f64 - std::f64::consts::FRAC_PI_2,
        );
        let sine = (from.cos() - to.cos()).abs();
        // ∫ sin² φ and ∫ sin φ cos φ; |sin φ| on the left half.
        let side = (from + to).signum();
        let across = side * ((to - from) / 2.0 - ((2.0 * to).sin() - (2.0 * from).sin()) / 4.0);
        let up = (to.sin().powi(2) - from.sin().powi(2)).abs() / 2.0;
        block.mass = Some(power(3) * sine);
        block.centroid =
            Some([power(4) / power(3) * across / sine, 0.0, power(4) / power(3) * up / sine]);
    }
    scene(NO_SLIDING, serde_json::to_value(blocks).expect("blocks"), json!({}))
}

#[test]
fn least_thickness_of_a_dome_cut_into_lunes() {
    // C01: linear programming; Heyman (1967): 0.042; 0.04284 for infinitely many voussoirs.
    critical("C01", |t| lune(32, t), 0.04274735164198319, 1e-6);
}
