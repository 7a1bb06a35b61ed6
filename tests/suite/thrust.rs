//! Thrusts on supports: closed forms and linear programming, with proof.

use crate::ask::{model, template};
use serde_json::json;
use voussoir::{
    analysis::{Control, Law, Outcome, assess, thrust::{Geometric, first_support, geometric_factor, outwards, thrust}},
    scene::Scene,
    verdict::thrust::{Extreme, ThrustAt},
};

fn ends(scene: &Scene) -> [(Outcome, f64); 2] {
    let m = model(scene);
    let support = first_support(&m).unwrap();
    let at = ThrustAt { support, direction: outwards(&m, support).unwrap().into() };
    let control = Control { law: Law::Associative, ..Control::default() };
    let standing = assess(&m.assembly, &m.interfaces, &control);
    println!("{:?} at {at:?}", standing.verdict);
    let r = [Extreme::Least, Extreme::Greatest].map(|e| {
        let t = thrust(&m, &at, e, &standing.forces, &control);
        println!("{:?} {:?} {} {:?} {} attempts {:?}", e, t.outcome, t.value, t.bracket, t.attempts.len(), t.attempts.iter().map(|a| (a.engine_status, a.lower, a.upper)).collect::<Vec<_>>());
        (t.outcome, t.value)
    });
    match geometric_factor(&m, &control) {
        Geometric::Found(f) => println!("factor {} ({} to {}, linear {}, {} probes)", 1.0 / f.value, 1.0 / f.stands.value, 1.0 / f.falls.value, f.linear, f.probes),
        Geometric::Beyond(_) => println!("beyond"),
        Geometric::Open(why) => println!("open: {why}"),
    }
    r
}

#[test]
fn try_them() {
    let inf = f64::INFINITY;
    let arch = |more: serde_json::Value| {
        let mut arch = json!({ "radius": 1, "thickness": 0.15, "depth": 1, "voussoirs": 16 });
        for (k, v) in more.as_object().unwrap() { arch[k] = v.clone(); }
        json!({ "arch": arch })
    };
    println!("B28 0.08267111462200738 0.10680824496837434");
    ends(&template(inf, arch(json!({})), json!({})));
    println!("B32 0.04421605282336581 0.0750615919098961");
    ends(&template(inf, arch(json!({ "profile": "pointed", "eccentricity": 0.25 })), json!({})));
    for mu in [2.0, 0.6] {
        println!("A27/28");
        ends(&template(mu, json!({ "flat_arch": { "span": 3, "height": 1, "depth": 1, "voussoirs": 3 } }), json!({})));
    }
    println!("A29: 2.0");
    ends(&template(0.0, json!({ "flat_arch": { "span": 3, "height": 1, "depth": 1, "voussoirs": 3, "center_depth": 2 } }), json!({})));
    println!("A29: 0.75");
    ends(&template(0.5, json!({ "flat_arch": { "span": 3, "height": 1, "depth": 1, "voussoirs": 3, "center_depth": 2 } }), json!({})));
}
