//! The inverse question: cracks that a known movement makes are traced back to it.

use crate::ask::{model, template};
use serde_json::json;
use voussoir::{
    analysis::follow::crack::{Crack, CrackSide, Cracks, Explanation, explain},
    scene::Scene,
};

fn arch() -> Scene {
    let arch = json!({ "radius": 1, "thickness": 0.15, "depth": 1, "voussoirs": 16 });
    template(f64::INFINITY, json!({ "arch": arch }), json!({}))
}

/// Hinges of a spreading arch: open at the extrados of the haunches and the intrados of the crown;
/// widths by the rotations of the three-hinge arch, which has its hinges at joints 3, 8 and 13.
fn spread(by: f64) -> Cracks {
    let joint = |k: f64, r: f64| {
        let angle = std::f64::consts::PI * (0.5 - k / 16.0);
        [-r * angle.sin(), r * angle.cos()]
    };
    let (haunch, crown) = (joint(3.0, 0.925), joint(8.0, 1.075));
    // The crown does not go sideways: the half turns by way / height, about the haunch.
    let turn = by / (crown[1] - haunch[1]);
    let crack = |a: &str, b: &str, side, width| Crack {
        between: [a.into(), b.into()],
        side,
        width: Some(width),
    };
    Cracks {
        cracks: vec![
            crack("v02", "v03", CrackSide::Extrados, 0.15 * turn),
            crack("v07", "v08", CrackSide::Intrados, 0.15 * 2.0 * turn),
            crack("v12", "v13", CrackSide::Near([0.9, 0.0, 0.6]), 0.15 * turn),
        ],
    }
}

fn whole(e: &Explanation, cracks: &Cracks) -> bool {
    e.explained == cracks.cracks.len() && e.unseen == 0
}

#[test]
fn cracks_of_a_spreading_arch_are_traced_to_a_springer_that_went_outwards() {
    let model = model(&arch());
    // Both springers by 0.004, as well as one of them by 0.008.
    let cracks = spread(0.004);
    let list = explain(&model, &cracks).expect("explanations");
    let good: Vec<&Explanation> = list.iter().filter(|e| whole(e, &cracks)).collect();
    for (e, (support, way)) in
        good.iter().zip([("springer_left", [-1.0, 0.0, 0.0]), ("springer_right", [1.0, 0.0, 0.0])])
    {
        assert_eq!((e.support.as_str(), e.way), (support, way), "{good:#?}");
        assert!((e.size.unwrap() - 0.008).abs() < 1e-6 && e.left.unwrap() < 1e-4, "{e:?}");
    }
    assert!(good.len() >= 2);
    // Inwards nothing of it opens there.
    let inwards = |e: &&Explanation| e.support == "springer_right" && e.way == [-1.0, 0.0, 0.0];
    assert_eq!(list.iter().find(inwards).expect("asked about").explained, 0);
}

/// Without widths the signs decide; a crack that the movement does not make is counted.
#[test]
fn signs_alone_decide_where_nothing_was_measured() {
    let model = model(&arch());
    let mut cracks = spread(0.004);
    cracks.cracks.iter_mut().for_each(|c| c.width = None);
    let best = explain(&model, &cracks).unwrap().remove(0);
    assert!(whole(&best, &cracks) && best.size.is_none() && best.left.is_none(), "{best:?}");
    cracks.cracks[1].side = CrackSide::Extrados;
    assert!(explain(&model, &cracks).unwrap().iter().all(|e| !whole(e, &cracks)));
}

#[test]
fn cracks_that_cannot_be_are_refused_with_their_place() {
    let model = model(&arch());
    let refused = |change: &dyn Fn(&mut Cracks)| {
        let mut cracks = spread(0.004);
        change(&mut cracks);
        explain(&model, &cracks).expect_err("refused").to_string()
    };
    assert!(refused(&|c| c.cracks.clear()).contains("no cracks"));
    assert!(refused(&|c| c.cracks[1].width = Some(-1.0)).contains("cracks[1].width"));
    let apart = refused(&|c| c.cracks[2].between[1] = "v02".into());
    assert!(apart.contains("cracks[2].between") && apart.contains("do not touch"), "{apart}");
}
