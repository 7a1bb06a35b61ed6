//! What was found for other loads or joints proves verdicts of this scene, and none that is false.

use crate::ask::{model, push, template};
use serde_json::{Value, json};
use voussoir::{
    analysis::{Control, Law, Outcome, assess, implied::Still, limit},
    interface::Model,
    verdict::Verdict,
};

const STATICS: fn() -> Control = || Control { law: Law::Associative, ..Control::default() };

/// An arch under its weight.
fn arch(friction: f64, more: Value) -> Model {
    let arch = json!({ "arch": { "radius": 10, "thickness": 1.5, "voussoirs": 15, "depth": 1 } });
    model(&template(friction, arch, more))
}

fn pushed(lambda: f64) -> Model {
    arch(0.7, push([1.0, 0.0, 0.0])).at_load_factor(lambda)
}

fn most() -> f64 {
    let factor = limit(&arch(0.7, push([1.0, 0.0, 0.0])), &Control::default());
    assert_eq!(factor.outcome, Outcome::Found);
    factor.value.unwrap()
}

#[test]
fn between_two_loads_under_which_it_stands_it_stands_without_a_program() {
    let most = most();
    let mut still = Still::default();
    assert!(still.verdict(&pushed(0.1 * most)).is_none());
    for share in [0.0, 0.95] {
        let model = pushed(share * most);
        let found = assess(&model, &STATICS());
        assert_eq!(found.verdict, Verdict::Stable);
        still.keep(&model, &found);
    }
    for share in [0.0, 0.1, 0.5, 0.9, 0.95] {
        let found = still.verdict(&pushed(share * most)).expect("a mixture");
        assert_eq!(found.verdict, Verdict::Stable, "{share}");
        assert!(found.attempts.is_empty() && found.claim().is_some());
    }
    // Beyond the limit no mixture holds, nor does one of other loads.
    assert!(still.verdict(&pushed(1.05 * most)).is_none());
    assert!(still.verdict(&pushed(-3.0 * most)).is_none());
    let sideways = arch(0.7, push([0.0, 0.0, -1.0])).at_load_factor(0.5);
    let found = still.verdict(&sideways);
    assert!(found.is_none_or(|a| a.verdict == assess(&sideways, &STATICS()).verdict));
}

#[test]
fn a_mechanism_is_one_as_long_as_it_gains_power() {
    let most = most();
    let mut still = Still::default();
    let model = pushed(1.5 * most);
    let found = assess(&model, &STATICS());
    assert_eq!(found.verdict, Verdict::Unstable);
    still.keep(&model, &found);
    for share in [1.2, 2.0, 10.0] {
        let found = still.verdict(&pushed(share * most)).expect("the mechanism");
        assert_eq!(found.verdict, Verdict::Unstable, "{share}");
        assert!(found.mechanism.is_some());
    }
    for share in [0.0, 0.5, 0.999] {
        assert!(still.verdict(&pushed(share * most)).is_none(), "{share}");
    }
}

/// Forces within a narrow cone lie within a wider one; not the other way round.
#[test]
fn greater_friction_holds_what_less_held() {
    let (rough, smooth) = (arch(0.7, json!({})), arch(0.05, json!({})));
    let mut still = Still::default();
    let found = assess(&rough, &STATICS());
    assert_eq!(found.verdict, Verdict::Stable);
    still.keep(&rough, &found);
    assert_eq!(still.verdict(&arch(0.8, json!({}))).unwrap().verdict, Verdict::Stable);
    assert_eq!(assess(&smooth, &STATICS()).verdict, Verdict::Unstable);
    assert!(still.verdict(&smooth).is_none());
    // Other blocks, or other contacts: nothing is tried.
    let other = json!({ "arch": { "radius": 10, "thickness": 1.5, "voussoirs": 16, "depth": 1 } });
    assert!(still.verdict(&model(&template(0.7, other, json!({})))).is_none());
}
