//! Supports that move slowly, by the rigid-body engine: it falls where the path that is proved ends.

use crate::ask::{asked, model, template};
use serde_json::json;
use std::ops::ControlFlow;
use voussoir::{
    analysis::{Question, SettleOptions, SupportMove},
    dynamics::{
        Carriage, CarriedAlong, Fidelity, Progress, SimulationSettings, Stop, SupportWay, carry,
    },
    interface::Model,
    path::{Carried, saved::read_poses},
    scene::Scene,
};

fn arch(voussoirs: usize, thickness: f64, embrace_deg: f64) -> Scene {
    let arch = json!({
        "radius": 1, "thickness": thickness, "depth": 1, "voussoirs": voussoirs,
        "embrace_deg": embrace_deg,
    });
    template(f64::INFINITY, json!({ "arch": arch }), json!({}))
}

/// Both springers of an arch go outwards by this.
fn apart(model: &Model, way: f64) -> [SupportWay; 2] {
    let to = |id: &str, x: f64| SupportWay {
        support: model.assembly.find(id).expect("a springer"),
        way: nalgebra::Vector3::x() * x,
        turn: nalgebra::Vector3::zeros(),
    };
    [to("springer_left", -way), to("springer_right", way)]
}

fn carried(model: &Model, ways: &[SupportWay], pace: f64, fidelity: Fidelity) -> CarriedAlong {
    let settings = SimulationSettings { fidelity: Some(fidelity), ..Default::default() };
    carry(model, Carriage { ways, pace }, &settings, &mut |_| ControlFlow::Continue(()))
        .expect("a simulation")
}

/// The proved value at which an arch on springers that spread falls, and the scene at a share of it.
fn proved(scene: &Scene, share: f64, falls: f64) -> (f64, Model) {
    let moves = vec![SupportMove::outwards("springer_*", 1.0)];
    let options = SettleOptions { moves, at: vec![share * falls], ..Default::default() };
    let file = asked(scene, &Question::Settle(options));
    let said = file.answer.path().expect("a path").falls_at.expect("it falls");
    let points = &file.path.as_ref().expect("a path").points;
    let at = points.iter().find(|p| p.value == share * falls).expect("asked for");
    let start = model(scene);
    let poses = read_poses(&start.assembly, &at.poses).expect("poses");
    (said, Carried::new(&start).displaced(&poses).model)
}

/// From a proved pose at nine tenths of the way: by then its hinges are open.
#[test]
fn an_arch_whose_supports_are_carried_apart_falls_where_that_is_proved() {
    let (from, way) = (0.9, 0.025258679449);
    let (falls, there) = proved(&arch(12, 0.12, 180.0), from, way);
    let found = carried(&there, &apart(&there, 0.2 * way), 2e-4, Fidelity::Fast);
    assert_eq!(found.stop, Stop::Fallen, "{found:?}");
    let at = from * way + 0.2 * way * found.falls_at.expect("it fell");
    assert!((at / falls - 1.0).abs() < 0.01, "{at} instead of {falls}");
    // Up to there it follows.
    let short = carried(&there, &apart(&there, 0.05 * way), 1e-3, Fidelity::Fast);
    assert_eq!((short.stop, short.falls_at, short.share), (Stop::Rest, None, 1.0), "{short:?}");
}

/// What does not move, or has no pace, is not carried.
#[test]
fn supports_that_stay_are_not_carried() {
    let there = model(&arch(4, 0.2, 180.0));
    let settings = SimulationSettings::default();
    for (way, pace, word) in [(0.0, 1e-3, "no support moves"), (0.1, 0.0, "the pace must be > 0")] {
        let ways = &apart(&there, way);
        let watch = &mut |_: &Progress| ControlFlow::Continue(());
        let said = carry(&there, Carriage { ways, pace }, &settings, watch).expect_err(word);
        assert!(said.to_string().contains(word), "{said}");
    }
}

/// The table of `docs/lab/path.md`, from the start: minutes.
#[test]
#[ignore = "prints a table; takes minutes"]
fn the_table() {
    for (n, thickness, embrace, falls) in [
        (12, 0.12, 180.0, 0.025258679449),
        (16, 0.12, 180.0, 0.01871430258),
        (12, 0.15, 180.0, 0.070524908919),
        (16, 0.15, 180.0, 0.058861058481),
        (12, 0.2, 180.0, 0.135125230862),
        (16, 0.15, 160.0, 0.107189188),
    ] {
        let there = model(&arch(n, thickness, embrace));
        let ratio = |pace: f64| {
            let found = carried(&there, &apart(&there, 1.2 * falls), pace, Fidelity::Fine);
            format!("{:.4}", 1.2 * found.falls_at.expect("it fell"))
        };
        let ratios = [1e-3, 2e-4, 1e-4].map(ratio).join(" | ");
        println!("| {n} voussoirs, {embrace}°, {thickness} | {falls} | {ratios} |");
    }
}
