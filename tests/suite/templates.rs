//! Templates of whole structures: how many blocks, how much stone, nothing that overlaps or leaks, and
//! answers that are known.

use crate::ask::{close, model, prove, verdict};
use serde_json::{Value, json};
use std::f64::consts::PI;
use voussoir::{
    analysis::{Control, Law, LimitOptions, Question, ask},
    interface::Model,
    proof::saved,
    scene::{Scene, read_str},
    verdict::Verdict,
};

const DENSITY: f64 = 2000.0;

fn read(template: &Value, more: &Value) -> Scene {
    let mut value = json!({
        "format": "voussoir-scene/1", "name": "test",
        "materials": { "stone": { "density": DENSITY } },
        "joints": { "default": { "friction": 0.7 } },
        "templates": [template]
    });
    if let (Some(value), Some(more)) = (value.as_object_mut(), more.as_object()) {
        value.extend(more.clone());
    }
    let kind = value["templates"][0].as_object().and_then(|t| t.keys().next().cloned());
    let kind = kind.expect("a template");
    if value["templates"][0][&kind].get("material").is_none() {
        value["templates"][0][&kind]["material"] = json!("stone");
    }
    read_str("test", value.to_string()).unwrap_or_else(|e| panic!("{e}\n{value}")).0
}

/// The scene made ready, with nothing found that is a mistake: shapes closed, nothing overlaps.
fn sound(scene: &Scene) -> Model {
    let m = model(scene);
    let told: Vec<&str> = m.findings().map(|f| f.text.as_str()).collect();
    let bad = told.iter().filter(|t| !t.contains("touch only along an edge"));
    assert_eq!(bad.count(), 0, "{told:?}");
    assert!(m.interfaces.left_out.is_none());
    m
}

/// Free blocks, and their volume, m³.
fn size(m: &Model) -> (usize, f64) {
    let free = m.assembly.blocks.iter().filter(|b| !b.support);
    (free.clone().count(), free.map(|b| b.mass / DENSITY).sum())
}

/// The area of a ring of n voussoirs between two circles, drawn with chords.
fn half_ring([inner, outer]: [f64; 2], n: usize) -> f64 {
    0.5 * n as f64 * (PI / n as f64).sin() * (outer * outer - inner * inner)
}

fn refused(template: &Value) -> String {
    match voussoir::interface::prepare(&read(template, &json!({}))) {
        Ok(_) => panic!("{template}"),
        Err(e) => format!("{}: {} ({})", e.path, e.message, e.hint.unwrap_or_default()),
    }
}

fn groin(voussoirs: usize) -> Value {
    json!({ "groin": { "clear_span": 4, "rise": 2, "thickness": 0.4, "side": 5, "voussoirs": voussoirs } })
}

#[test]
fn a_groin_vault_is_two_barrels_that_cross() {
    let scene = read(&groin(16), &json!({}));
    let m = sound(&scene);
    assert_eq!(size(&m).0, 64);
    // Half of a web is the ring's section from the diagonal y = x to the side: (half side − x) dA.
    let whole = 8.0 * (2.5 * PI / 4.0 * (2.4f64.powi(2) - 4.0) - (2.4f64.powi(3) - 8.0) / 3.0);
    let short = |n: usize| 1.0 - size(&sound(&read(&groin(n), &json!({})))).1 / whole;
    let (coarse, fine) = (short(16), short(32));
    // Chords lose a share that falls with the square of their number.
    assert!(coarse > 0.0 && coarse < 0.02, "{coarse}");
    assert!((coarse / fine - 4.0).abs() < 0.1, "{coarse} {fine}");
    // Neighbours along the diagonals, webs that do not touch.
    let touch = |a: &str, b: &str| {
        let find = |id: &str| m.assembly.find(id).unwrap_or_else(|| panic!("{id}"));
        let (a, b) = (find(a), find(b));
        m.interfaces.list.iter().any(|f| (f.a, f.b) == (a, b) || (f.b, f.a) == (a, b))
    };
    assert!(touch("n_v15", "e_v00") && touch("n_v00", "w_v15") && touch("s_v15", "w_v00"));
    assert!(touch("n_v12", "e_v03") && !touch("n_v12", "s_v03"));
    assert!(touch("n_v15", "springer_ne") && touch("n_v00", "springer_nw"));
    // Its edges are arches of 0.4 m on a radius of 2.2 m, thicker than a free arch needs.
    assert_eq!(verdict(&scene, Law::Associative), Verdict::Stable);
}

#[test]
fn a_vault_without_springers_is_held_by_what_is_there() {
    let mut without = groin(8);
    without["groin"]["springers"] = json!(false);
    let m = model(&read(
        &without,
        &json!({ "blocks": [
        { "id": "ground", "support": true, "at": [0, 0, -0.5], "shape": { "box": { "size": [9, 9, 1] } } }
    ] }),
    ));
    assert_eq!(m.assembly.blocks.iter().filter(|b| b.support).count(), 1);
    let ground = m.assembly.find("ground").expect("the ground");
    let on = m.interfaces.list.iter().filter(|f| f.a == ground || f.b == ground);
    assert_eq!(on.count(), 8);
}

/// Whatever stands on supports of its own stands on others in their place.
#[test]
fn supports_may_be_left_out() {
    let dome = json!({ "radius": 3, "thickness": 0.5, "rings": 4, "segments": 8 });
    let span = json!([{ "clear_span": 4, "rise": 1, "thickness": 0.4, "voussoirs": 9 }]);
    let arch = json!({ "radius": 2, "thickness": 0.5, "depth": 1, "voussoirs": 9 });
    let barrel = json!({ "radius": 2, "thickness": 0.5, "depth": 2, "voussoirs": 8, "courses": 2 });
    let tower = json!({ "size": [3, 2], "thickness": 0.5, "course": 0.5, "courses": 4 });
    let leaves = json!({ "size": [0.6, 0.25, 0.3], "hollow": 0.2, "courses": 4, "blocks": 3 });
    for (name, key, own) in [
        ("arch", "springers", arch),
        ("barrel", "springers", barrel),
        ("bridge", "springers", json!({ "spans": span, "width": 3 })),
        ("dome", "springers", dome),
        ("groin", "springers", groin(8)["groin"].clone()),
        ("leaves", "base", leaves),
        ("portal", "base", portal(1.2)["portal"].clone()),
        ("tower", "base", tower),
    ] {
        let with = |there: bool| {
            let mut own = own.clone();
            own[key] = json!(there);
            let ground = json!({ "id": "ground", "support": true, "at": [0, 0, -90],
                "shape": { "box": { "size": [9, 9, 1] } } });
            model(&read(&json!({ name: own }), &json!({ "blocks": [ground] })))
        };
        let count = |m: &Model, support: bool| {
            m.assembly.blocks.iter().filter(|b| b.support == support).count()
        };
        let (own, other) = (with(true), with(false));
        assert!(count(&own, true) > 1, "{name}");
        assert_eq!((count(&other, true), count(&other, false)), (1, count(&own, false)), "{name}");
    }
}

fn portal(pier: f64) -> Value {
    json!({ "portal": { "clear_span": 3, "rise": 1.5, "thickness": 0.4, "depth": 1, "voussoirs": 15,
        "pier": { "width": pier, "height": 3, "courses": 6 } } })
}

#[test]
fn a_portal_stands_on_wide_piers_and_falls_from_narrow_ones() {
    let scene = read(&portal(1.2), &json!({}));
    let (count, volume) = size(&sound(&scene));
    assert_eq!(count, 15 + 12);
    close("volume", volume, half_ring([1.5, 1.9], 15) + 2.0 * 1.2 * 3.0, 1e-12);
    assert_eq!(verdict(&scene, Law::Coulomb), Verdict::Stable);
    // A pier as narrow as the arch: the least thrust of the ring tips both.
    assert_eq!(verdict(&read(&portal(0.4), &json!({})), Law::Coulomb), Verdict::Unstable);
    // One block for each pier is the arch on buttresses.
    let mut one = portal(0.8);
    one["portal"]["pier"]["courses"] = json!(1);
    let arch = json!({ "arch": { "intrados_span": 3, "intrados_rise": 1.5, "thickness": 0.4, "depth": 1,
        "voussoirs": 15, "buttresses": { "width": 0.8, "height": 3 } } });
    let live = json!({ "loads": { "live": [{ "block": "v03", "force": [0, 0, -1000] }] } });
    let want = crate::ask::load_factor(&read(&arch, &live));
    close("buttresses", crate::ask::load_factor(&read(&one, &live)), want, 1e-7);
}

#[test]
fn a_nave_needs_its_buttresses() {
    let mut nave = portal(0.5);
    assert_eq!(verdict(&read(&nave, &json!({})), Law::Coulomb), Verdict::Unstable);
    nave["portal"]["buttress"] = json!({ "width": 1.0, "height": 2.5, "courses": 5 });
    let scene = read(&nave, &json!({}));
    let (count, volume) = size(&sound(&scene));
    assert_eq!(count, 15 + 12 + 10);
    let piers = 2.0 * (0.5 * 3.0 + 1.0 * 2.5);
    close("volume", volume, half_ring([1.5, 1.9], 15) + piers, 1e-12);
    assert_eq!(verdict(&scene, Law::Coulomb), Verdict::Stable);
}

#[test]
fn a_tower_tips_no_later_than_in_one_piece() {
    let tower = |blocks: usize| json!({ "tower": { "size": [3, 2], "thickness": 0.5, "course": 0.5, "courses": 12, "blocks": blocks } });
    let scene = read(&tower(2), &json!({}));
    let (count, volume) = size(&sound(&scene));
    assert_eq!(count, 12 * 8);
    close("volume", volume, (3.0 * 2.0 - 2.0 * 1.0) * 6.0, 1e-12);
    assert_eq!(verdict(&scene, Law::Associative), Verdict::Stable);
    // Pushed along y by a share of its weight: in one piece it tips at width / height.
    let blocks = model(&scene).assembly.blocks;
    let live: Vec<Value> = blocks
        .iter()
        .filter(|b| !b.support)
        .map(|b| json!({ "block": b.id, "force": [0, b.mass * 9.81, 0] }))
        .collect();
    let scene = read(&tower(2), &json!({ "loads": { "live": live } }));
    let question =
        Question::Limit(LimitOptions { law: Law::Associative, ..LimitOptions::default() });
    let m = model(&scene);
    let answer = ask(&question, &scene, &m, &Control::default()).expect("an answer");
    let file = saved::of(&question, &scene, &m, &answer).expect("a result");
    prove(&scene, &file);
    let value = file.answer.load_factor().and_then(|l| l.value).expect("a load factor");
    assert!(value < 2.0 / 6.0 && value > 0.5 * 2.0 / 6.0, "{value}");
}

#[test]
fn a_wall_of_two_leaves_is_tied_by_its_through_stones() {
    let leaves = |through: Value| {
        json!({ "leaves": { "size": [0.6, 0.25, 0.3], "hollow": 0.2, "courses": 6, "blocks": 4,
            "through_every": through } })
    };
    let scene = read(&leaves(json!(3)), &json!({}));
    let (count, volume) = size(&sound(&scene));
    // Courses of 4 and of 5 blocks by turns; the third and the sixth go through.
    assert_eq!(count, 2 * (4 + 5) + 4 + 2 * (5 + 4) + 5);
    close("volume", volume, 2.4 * 0.3 * (4.0 * 0.5 + 2.0 * 0.7), 1e-12);
    assert_eq!(verdict(&scene, Law::Associative), Verdict::Stable);
    // A push at the head of each leaf's last course, from the back: what ties the leaves is the
    // first course of through stones; without it the front leaf stands alone.
    let push = |through: Value, letter: &str| {
        let live: Vec<Value> = (0..5)
            .map(|k| json!({ "block": format!("{letter}05_{k:02}"), "force": [0, -100, 0] }))
            .collect();
        crate::ask::load_factor(&read(&leaves(through), &json!({ "loads": { "live": live } })))
    };
    let alone = push(Value::Null, "f");
    // The leaf tips about the foot of its front: weight × half of its depth over the height of the
    // push, or slides off higher up.
    let weight = 2.4 * 0.25 * 1.8 * DENSITY * 9.81;
    assert!(alone <= weight * 0.125 / (1.65 * 500.0) * (1.0 + 1e-6), "{alone}");
    assert!(push(json!(6), "t") > 2.0 * alone);
}

#[test]
fn a_dome_may_have_openings_and_a_lantern() {
    let dome = |more: Value| {
        let mut value = json!({ "dome": { "radius": 5, "thickness": 0.6, "rings": 6, "segments": 16,
            "oculus_deg": 15 } });
        if let (Some(dome), Some(more)) = (value["dome"].as_object_mut(), more.as_object()) {
            dome.extend(more.clone());
        }
        value
    };
    let whole = size(&sound(&read(&dome(json!({})), &json!({}))));
    assert_eq!(whole.0, 96);
    let open = dome(json!({ "openings": [{ "rings": [1, 2], "segments": [15, 0] },
        { "rings": [1, 1], "segments": [4, 4] }] }));
    let m = sound(&read(&open, &json!({})));
    assert_eq!(size(&m).0, 96 - 5);
    assert!(m.assembly.find("r01_15").is_none() && m.assembly.find("r02_00").is_none());
    assert!(m.assembly.find("r02_04").is_some() && m.assembly.find("r01_04").is_none());
    let scene = read(&dome(json!({ "lantern": { "height": 1.5, "cap": 0.3 } })), &json!({}));
    let m = sound(&scene);
    assert_eq!(size(&m).0, 96 + 17);
    // The drum stands upright on the slope of the last bed, z = r cos 15° over a ring of polygons of
    // radius r sin 15°; the slab lies on it.
    let (n, edge) = (16.0, 15f64.to_radians());
    let polygon = |r: f64| 0.5 * n * (2.0 * PI / n).sin() * (r * edge.sin()).powi(2);
    let top = 5.3 * edge.cos() + 1.5;
    // The bed rises by cos/sin for every metre outwards, so that of the volume below it between
    // two similar polygons two thirds of the outer edge's height counts, as in a cone.
    let cone = |r: f64| polygon(r) * r * edge.cos() * 2.0 / 3.0;
    let drum = (polygon(5.3) - polygon(4.7)) * top - (cone(5.3) - cone(4.7));
    let slab = polygon(5.3) * 0.3;
    close("volume", size(&m).1 - whole.1, drum + slab, 1e-9);
    assert_eq!(verdict(&scene, Law::Associative), Verdict::Stable);
    for (more, wanted) in [
        (json!({ "openings": [{ "rings": [2, 1], "segments": [0, 0] }] }), "openings[0].rings"),
        (json!({ "openings": [{ "rings": [0, 1], "segments": [0, 16] }] }), "openings[0].segments"),
        (json!({ "lantern": { "height": 0, "cap": 1 } }), "lantern.height: must be > 0"),
        (
            json!({ "oculus_deg": null, "lantern": { "height": 1, "cap": 1 } }),
            "lantern.height: a lantern needs",
        ),
    ] {
        let text = refused(&dome(more));
        assert!(text.contains(wanted), "{text}: {wanted}");
    }
}

#[test]
fn a_pointed_barrel_and_a_three_centred_arch() {
    let barrel = json!({ "barrel": { "profile": "pointed", "intrados_span": 4, "intrados_rise": 2.6,
        "thickness": 0.5, "depth": 4, "voussoirs": 12, "courses": 4 } });
    let scene = read(&barrel, &json!({}));
    let (count, volume) = size(&sound(&scene));
    assert_eq!(count, 6 * 4 + 6 * 5);
    // Two sectors of circles about (∓e, 0) between R and R + t, cut off by the axis: R − e = 2 and
    // R² − e² = 2.6².
    let (r, e) = (0.5 * (2.6 * 1.3 + 2.0), 0.5 * (2.6 * 1.3 - 2.0));
    let half = |r: f64| {
        let angle = (e / r).acos();
        0.5 * r * r * angle - 0.5 * e * (r * r - e * e).sqrt()
    };
    let whole = 2.0 * 4.0 * (half(r + 0.5) - half(r));
    assert!(volume < whole && volume > 0.97 * whole, "{volume} {whole}");
    assert_eq!(verdict(&scene, Law::Associative), Verdict::Stable);
    // Three arcs of 60°: 8 m wide, 3 m high; radii by hand: (4 − 3) / (sin 30° + cos 30° − 1) apart.
    let arch = |n: usize| {
        json!({ "arch": { "profile": "three_centred", "intrados_span": 8, "intrados_rise": 3,
            "thickness": 0.6, "depth": 1, "voussoirs": n } })
    };
    let apart = 1.0 / (0.5 + 0.75f64.sqrt() - 1.0);
    let (side, crown) = (4.0 - 0.5 * apart, 4.0 + 0.5 * apart);
    let sector = |r: f64| PI / 6.0 * ((r + 0.6).powi(2) - r * r);
    let whole = 2.0 * sector(side) + sector(crown);
    let lost = |n: usize| whole - size(&sound(&read(&arch(n), &json!({})))).1;
    assert!(lost(40) > 0.0 && lost(40) < 2e-3 * whole, "{}", lost(40));
    assert!(lost(200) < 0.05 * lost(40));
    let m = model(&read(&arch(41), &json!({})));
    let corners = |id: &str| m.assembly.blocks[m.assembly.find(id).expect("it")].clone();
    assert!(!corners("v20").support);
    let mut low = arch(40);
    low["arch"]["intrados_rise"] = json!(1.0);
    assert!(refused(&low).contains("arch.rise: with three arcs of 60° it lies between 1.07"));
}

#[test]
fn mistakes_are_named() {
    let with = |mut template: Value, pointer: &str, value: Value| {
        *template.pointer_mut(pointer).expect("a place") = value;
        refused(&template)
    };
    let tower =
        json!({ "tower": { "size": [3, 2], "thickness": 0.5, "course": 0.5, "courses": 4 } });
    let leaves =
        json!({ "leaves": { "size": [1, 1, 1], "hollow": 0.2, "courses": 4, "blocks": 4 } });
    let mut nave = portal(1.0);
    nave["portal"]["buttress"] = json!({ "width": 1, "height": 2 });
    for (text, wanted) in [
        (with(groin(16), "/groin/voussoirs", json!(15)), "groin.voussoirs: must be even"),
        (with(groin(16), "/groin/rise", json!(1)), "groin.rise: a groin vault needs level"),
        (with(groin(16), "/groin/side", json!(4.2)), "groin.side: must be at least"),
        (with(groin(16), "/groin/thickness", json!(-1)), "groin.thickness: must be > 0"),
        (with(portal(1.0), "/portal/rise", json!(1)), "portal.rise: an arch on upright piers"),
        (with(portal(1.0), "/portal/pier/width", json!(0.2)), "portal.pier.width: must be at"),
        (with(portal(1.0), "/portal/pier/courses", json!(0)), "portal.pier.courses: must be"),
        (
            with(nave, "/portal/buttress/height", json!(4)),
            "portal.buttress.height: must be at most",
        ),
        (with(tower.clone(), "/tower/thickness", json!(1)), "tower.thickness: must be less"),
        (with(tower, "/tower/courses", json!(0)), "tower.courses: must be at least 1"),
        (with(leaves, "/leaves/hollow", json!(0)), "leaves.hollow: must be > 0"),
    ] {
        assert!(text.contains(wanted), "{text}: {wanted}");
    }
}
