//! Drawings read back.

use super::{all, arch, assessed, ball_on_box, limited, numbers, parsed};
use crate::ask::{cuboid, ground, model, scene, template};
use roxmltree::Node;
use serde_json::json;
use std::path::Path;
use voussoir::{
    interface::Model,
    report::{
        drawing::{Aspect, svg},
        view::View,
    },
};

/// Names of the blocks of a drawing's panel in the order in which they are drawn.
fn drawn(text: &str, panel: usize) -> Vec<String> {
    let document = parsed(text);
    let panel = all(document.root_element(), "svg").nth(1 + panel).expect("a panel");
    let blocks = panel.children().filter(|n| n.has_tag_name("g"));
    blocks
        .map(|g| all(g, "title").next().and_then(|t| t.text()).unwrap_or_default().to_string())
        .collect()
}

fn with_class<'a>(node: Node<'a, 'a>, class: &'static str) -> impl Iterator<Item = Node<'a, 'a>> {
    node.descendants().filter(move |n| n.attribute("class") == Some(class))
}

/// Where something is drawn on the sheet.
fn center(circle: Node) -> [f64; 2] {
    ["cx", "cy"].map(|k| circle.attribute(k).unwrap().parse().unwrap())
}

const ASPECTS: [&str; 8] = ["auto", "front", "back", "left", "right", "top", "corner", "1,2,-0.5"];

#[test]
fn every_scene_is_drawn_whole_from_all_sides() {
    let mut count = 0;
    for entry in
        std::fs::read_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join("structures")).unwrap()
    {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|e| e != "json") || path.ends_with("expected.json") {
            continue;
        }
        let scene = crate::ask::open(&path);
        let view = View::bare(&model(&scene));
        // Tall towers take a while from some sides.
        let aspects = if view.bodies.len() < 100 { &ASPECTS[..] } else { &ASPECTS[..1] };
        for aspect in aspects {
            let text = svg(&view, aspect.parse().unwrap());
            assert_eq!(drawn(&text, 0).len(), view.bodies.len(), "{} {aspect}", path.display());
            assert!(!text.contains("NaN") && !text.contains("inf"), "{} {aspect}", path.display());
            let size = numbers(parsed(&text).root_element().attribute("viewBox").unwrap());
            assert!(
                size[2] == 800.0 && size[3] > 40.0 && size[3] < 2200.0,
                "{} {aspect}: {size:?}",
                path.display()
            );
        }
        count += 1;
    }
    assert!(count > 60, "{count}");
}

/// In the drawing of an arch that falls by hinges, each hinge lies at a corner of both blocks that
/// it joins, where they went.
#[test]
fn hinges_stay_closed() {
    let (_, view) = assessed(&arch(0.09, 1.0, json!({})));
    let text = svg(&view, Aspect::Auto);
    let document = parsed(&text);
    let hinges: Vec<[f64; 2]> = with_class(document.root_element(), "pin act")
        .filter(|c| c.attribute("r").is_some())
        .map(center)
        .collect();
    let moved: Vec<Vec<f64>> = with_class(document.root_element(), "moved")
        .map(|g| numbers(with_class(g, "edge").next().unwrap().attribute("d").unwrap()))
        .collect();
    // One of them stands in the legend.
    let closed = |[x, y]: &[f64; 2]| {
        let near = |d: &&Vec<f64>| d.chunks_exact(2).any(|p| (p[0] - x).hypot(p[1] - y) < 0.3);
        moved.iter().filter(near).count()
    };
    let joined = hinges.iter().filter(|h| closed(h) == 2).count();
    assert!(hinges.len() >= 6 && joined >= hinges.len() - 3, "{joined} of {hinges:?}");
}

/// Lengths and densities change the scale in the legend, and nothing else.
#[test]
fn drawings_do_not_depend_on_units() {
    let draw = |size: f64, density: f64| {
        let scene = arch(0.15, size, json!({ "materials": { "unit": { "density": density } } }));
        let (_, view) = limited(&scene);
        svg(&view, Aspect::Auto)
    };
    let (one, other) = (draw(1.0, 1.0), draw(1000.0, 2400.0));
    assert!(one.contains(">50 cm<") && other.contains(">500 m<"), "{}", &one[one.len() - 300..]);
    let coordinates = |text: &str| -> Vec<f64> {
        let document = parsed(text);
        // The scale is another, and forces at the edge between two thicknesses may change places.
        let places = document
            .descendants()
            .filter(|n| n.attribute("class") != Some("scale"))
            .filter_map(|n| n.attribute("d"));
        let mut list: Vec<f64> = places.flat_map(numbers).collect();
        list.sort_by(f64::total_cmp);
        list
    };
    let (a, b) = (coordinates(&one), coordinates(&other));
    assert_eq!(a.len(), b.len());
    assert!(
        a.iter().zip(&b).all(|(a, b)| (a - b).abs() < 0.05),
        "{:?}",
        a.iter().zip(&b).find(|(a, b)| (**a - **b).abs() >= 0.05)
    );
}

/// The line of thrust ends where the certificate's forces press, on the sheet as in space.
#[test]
fn the_line_of_thrust_passes_the_centres_of_pressure() {
    let (_, view) = limited(&arch(0.15, 1.0, json!({})));
    let text = svg(&view, Aspect::Front);
    let document = parsed(&text);
    let ends: Vec<f64> = with_class(document.root_element(), "line one")
        .flat_map(|n| numbers(n.attribute("d").unwrap()))
        .collect();
    // Scale and origin from two blocks that are drawn: the outermost corners of the panel's first
    // one would do, but the pressed points themselves are enough: distances between them have one
    // common factor.
    let pressed: Vec<[f64; 2]> =
        view.states[0].resultants.iter().flatten().map(|r| [r.at.x, r.at.z]).collect();
    let extent = |list: &mut dyn Iterator<Item = f64>| {
        list.fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], v| [l.min(v), h.max(v)])
    };
    let [l, h] = extent(&mut pressed.iter().map(|p| p[0]));
    let points: Vec<[f64; 2]> =
        ends.chunks(2).filter(|p| p.len() == 2).map(|p| [p[0], p[1]]).collect();
    let [sl, sh] = extent(&mut points.iter().take(points.len() - 1).map(|p| p[0]));
    let scale = (sh - sl) / (h - l);
    let top = points.iter().take(points.len() - 1).map(|p| p[1]).fold(f64::INFINITY, f64::min);
    let high = extent(&mut pressed.iter().map(|p| p[1]))[1];
    for [x, z] in &pressed {
        let at = [sl + (x - l) * scale, top + (high - z) * scale];
        assert!(
            points.iter().any(|p| (p[0] - at[0]).hypot(p[1] - at[1]) < 0.1),
            "nothing at {at:?}"
        );
    }
    assert_eq!(pressed.len(), 17);
}

/// Of two blocks that touch on a face which is not seen from its edge, the one on the eye's side is
/// drawn later.
fn nothing_hides_what_is_in_front(name: &str, m: &Model, view: &View, eye: [f64; 3]) {
    let order = drawn(&svg(view, Aspect::From(eye.into())), 0);
    let place = |i: usize| order.iter().position(|id| *id == m.assembly.blocks[i].id).unwrap();
    let eye = nalgebra::Vector3::from(eye).normalize();
    let mut count = 0;
    for face in m.interfaces.list.iter().filter(|f| f.points.len() > 2) {
        let towards = face.frame.n.dot(&eye);
        if towards.abs() > 1e-3 {
            let (far, near) = if towards > 0.0 { (face.a, face.b) } else { (face.b, face.a) };
            assert!(
                place(far) < place(near),
                "{name} from {eye:?}: {} hides {}",
                order[place(far)],
                order[place(near)]
            );
            count += 1;
        }
    }
    assert!(count > 0, "{name}");
}

#[test]
fn blocks_in_front_are_drawn_last() {
    let dome = template(
        0.7,
        json!({ "dome": { "radius": 2.0, "thickness": 0.3, "rings": 4, "segments": 12 } }),
        json!({}),
    );
    let vault = template(
        0.7,
        json!({ "barrel": { "radius": 1.0, "thickness": 0.2, "depth": 2.0, "voussoirs": 9, "courses": 4 } }),
        json!({}),
    );
    // The centre of the slab is nearer to the eye than the block at its far end.
    let slab = scene(
        0.7,
        json!([
            ground(),
            cuboid("far", [0.5, 0.5, 0.5], [0.0, 19.0, 0.0]),
            cuboid("top", [0.2, 0.2, 0.2], [0.0, 19.0, 0.5])
        ]),
        json!({}),
    );
    for (name, scene) in [("dome", dome), ("vault", vault), ("slab", slab)] {
        let m = model(&scene);
        for eye in [[0.5, -0.75, 0.45], [1.0, 1.0, 1.0], [-1.0, 0.2, 0.1], [0.3, 0.1, -1.0]] {
            nothing_hides_what_is_in_front(name, &m, &View::bare(&m), eye);
        }
    }
}

#[test]
fn plane_scenes_are_seen_along_their_normal() {
    let (_, view) = assessed(&arch(0.15, 1.0, json!({})));
    assert_eq!(svg(&view, Aspect::Auto), svg(&view, Aspect::Front));
    let (_, view) = assessed(&ball_on_box());
    assert_ne!(svg(&view, Aspect::Auto), svg(&view, Aspect::Corner), "ball and box have one plane");
    let dome = template(
        0.7,
        json!({ "dome": { "radius": 2.0, "thickness": 0.3, "rings": 4, "segments": 12 } }),
        json!({}),
    );
    let view = View::bare(&model(&dome));
    assert_eq!(svg(&view, Aspect::Auto), svg(&view, Aspect::Corner));
}

#[test]
fn names_in_a_scene_stay_names() {
    let hostile = "</title><script>alert(\"1\")</script>&amp;\u{1}\u{ffff}";
    let scene = scene(
        0.6,
        json!([ground(), cuboid(hostile, [1.0, 1.0, 1.0], [0.0, 0.0, 0.0])]),
        json!({ "name": hostile }),
    );
    let text = svg(&View::bare(&model(&scene)), Aspect::Auto);
    assert!(
        drawn(&text, 0).contains(&"</title><script>alert(\"1\")</script>&amp;\\u{1}".to_string()),
        "{text}"
    );
    assert!(all(parsed(&text).root_element(), "script").next().is_none());
}

#[test]
fn aspects_are_words_or_directions() {
    for bad in ["", "fron", "0,0,0", "1,2", "1,2,3,4", "nan,0,1", "1,inf,0"] {
        assert!(bad.parse::<Aspect>().is_err(), "{bad}");
    }
    assert_eq!("0,-1,0".parse(), Ok(Aspect::From(-nalgebra::Vector3::y())));
}
