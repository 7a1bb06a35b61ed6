//! The same scene gives the same bits, again and from any thread.

use crate::ask::{model, push, template};
use serde_json::json;
use voussoir::analysis::{Control, assess, limit};

#[test]
fn answers_repeat_bit_by_bit_on_every_thread() {
    let scenes = [
        template(
            0.6,
            json!({ "wall": { "size": [1, 0.5, 0.4], "courses": 6, "blocks": 5, "base": "course" } }),
            push([1.0, 0.2, 0.0]),
        ),
        template(
            0.7,
            json!({ "arch": { "radius": 1.0, "thickness": 0.15, "depth": 1.0, "voussoirs": 15 } }),
            push([1.0, 0.0, 0.0]),
        ),
        template(
            0.7,
            json!({ "dome": { "radius": 2.0, "thickness": 0.3, "rings": 4, "segments": 8 } }),
            push([1.0, 0.0, 0.0]),
        ),
    ];
    for scene in &scenes {
        let answer = || {
            let m = model(scene);
            let (a, l) = (assess(&m, &Control::default()), limit(&m, &Control::default()));
            let numbers = |forces: &voussoir::verdict::Forces| {
                forces
                    .iter()
                    .flatten()
                    .flat_map(|w| w.force.iter().map(|x| x.to_bits()).collect::<Vec<_>>())
                    .collect::<Vec<_>>()
            };
            let rates = |q: &[voussoir::verdict::Rate]| {
                q.iter()
                    .flat_map(|r| {
                        r.velocity.iter().chain(&r.spin).map(|x| x.to_bits()).collect::<Vec<_>>()
                    })
                    .collect::<Vec<_>>()
            };
            (
                a.verdict,
                a.equilibrium_error.upper.to_bits(),
                numbers(&a.forces),
                l.value.map(f64::to_bits),
                l.bracket.lower.to_bits(),
                numbers(&l.forces),
                rates(&l.rates),
            )
        };
        let first = answer();
        assert_eq!(first, answer());
        let others: Vec<_> = std::thread::scope(|s| {
            (0..4)
                .map(|_| s.spawn(answer))
                .collect::<Vec<_>>()
                .into_iter()
                .map(|t| t.join().unwrap())
                .collect()
        });
        assert!(others.iter().all(|o| *o == first));
    }
}
