//! What every pair rubs like, said by its two bodies.

use super::*;
use base::tolerance::GRAIN_SKIN;
use model::{assembly, interface::Interfaces};
use scene::read_str;
use serde_json::{Value, json};

/// Whether two balls beside these supports are combined, and then as by a look at the pair.
fn combined(supports: &[Value], more: &Value) -> bool {
    let ball = |id: &str, x: f64| json!({ "id": id, "shape": { "sphere": { "radius": 0.5 } }, "at": [x, 0, 5], "material": "grain" });
    let mut blocks = vec![ball("a", 0.0), ball("b", 3.0), more.clone()];
    blocks.extend(supports.iter().cloned());
    let scene = json!({
        "format": "voussoir-scene/1",
        "materials": { "grain": { "density": 2500 }, "smooth": { "density": 2500 }, "sand": { "density": 2500 } },
        "joints": { "default": { "friction": 0.4 }, "overrides": [
            { "between": ["grain", "grain"], "friction": 0.5 },
            { "between": ["grain", "smooth"], "friction": 0.1 },
            { "between": ["grain", "sand"], "friction": 0.9 },
        ] },
        "blocks": blocks,
    });
    let assembly = assembly::resolve(&read_str("test", scene.to_string()).unwrap().0).unwrap();
    let model = Model::new(assembly, Interfaces::default());
    let units = Units::of(&model.assembly, &model.assembly.dead).unwrap();
    let bodies = bodies(&model, &units, GRAIN_SKIN).unwrap();
    let frictions = Frictions::new(&model, &units);
    let Some(list) = frictions.combined(&bodies) else { return false };
    for (i, one) in list.iter().enumerate() {
        let Combined::Own(own) = list[0] else { panic!("the first is free") };
        let met = match *one {
            Combined::Own(friction) => friction,
            Combined::AtMost(friction) => own.min(friction),
            Combined::AtLeast(friction) => own.max(friction),
        };
        assert_eq!(met, frictions.between(0, i).friction, "{i}");
    }
    true
}

#[test]
fn loose_spheres_of_one_kind_need_no_look_at_the_pair() {
    let slab = |id: &str, x: f64, material: &str| json!({ "id": id, "shape": { "box": { "size": [1, 1, 1] } }, "at": [x, 9, 0], "support": true, "material": material });
    let walls = [slab("p", 0.0, "grain"), slab("q", 2.0, "smooth"), slab("r", 4.0, "sand")];
    let more = |shape: Value, material: &str| json!({ "id": "c", "shape": shape, "at": [9, 0, 5], "material": material });
    let ball = || json!({ "sphere": { "radius": 0.5 } });
    assert!(combined(&walls, &more(ball(), "grain")));
    // Another kind, another shape, and a support in pieces, whose seams are looked at pair by pair.
    assert!(!combined(&walls, &more(ball(), "sand")));
    assert!(!combined(&walls, &more(json!({ "box": { "size": [1, 1, 1] } }), "grain")));
    let bent = json!({ "prism": { "polygon": [[0, 0], [2, 0], [2, 1], [1, 1], [1, 2], [0, 2]], "depth": 1 } });
    let corner =
        json!({ "id": "l", "shape": bent, "at": [-9, 0, 0], "support": true, "material": "grain" });
    assert!(!combined(&[corner], &more(ball(), "grain")));
}
