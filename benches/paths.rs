//! Motions that are followed: a spreading arch of 16 voussoirs to its fall, and 30 points of the
//! capacity curve of a wall of 32 × 32 blocks that is turned over about its toe.
//!
//! `cargo bench --bench paths` prints the times. Nothing here asserts one.

#![allow(clippy::expect_used)]

use criterion::{Criterion, SamplingMode, criterion_group, criterion_main};
use std::time::Duration;
use voussoir::{
    analysis::{self, Control, ControlPoint, PushOptions, Question, SettleOptions, SupportMove},
    interface,
    scene::{Scene, read_file, read_str},
};

/// How far the top of the wall goes until its load factor vanishes, m.
const WALL_FALLS: f64 = 31.638_197;

fn arch() -> (Scene, Question) {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/structures/spreading-arch.json");
    let scene = read_file(path.as_ref()).expect("the scene is there").0;
    let moves = vec![SupportMove::outwards("springer_*", 1.0)];
    (scene, Question::Settle(SettleOptions { moves, ..SettleOptions::default() }))
}

fn wall() -> (Scene, Question) {
    let text = r#"{ "format": "voussoir-scene/1", "joints": { "default": { "friction": "infinite" } },
        "templates": [ { "wall": { "size": [1, 0.5, 0.5], "courses": 32, "blocks": 32 } } ],
        "loads": { "live": [ { "weight": [1, 0, 0] } ] } }"#;
    let scene = read_str("bench", text).expect("the bench scene is well formed").0;
    let push = PushOptions {
        control: ControlPoint { block: "c31_00".into(), point: [0.25, 0.0, 15.75] },
        toward: [1.0, 0.0, 0.0],
        at: (0..30).map(|k| WALL_FALLS * f64::from(k) / 30.0).collect(),
        from: Vec::new(),
    };
    (scene, Question::Push(push))
}

fn paths(c: &mut Criterion) {
    let mut group = c.benchmark_group("paths");
    group
        .sample_size(10)
        .sampling_mode(SamplingMode::Flat)
        .warm_up_time(Duration::from_millis(1))
        .measurement_time(Duration::from_secs(2));
    let list = [("arch, 16 voussoirs, to its fall", arch()), ("wall, 32 × 32, 30 points", wall())];
    for (name, (scene, question)) in list {
        let model = interface::prepare(&scene).expect("the bench scene resolves");
        group.bench_function(name, |b| {
            b.iter(|| analysis::ask(&question, &scene, &model, &Control::default()))
        });
    }
    group.finish();
}

criterion_group!(benches, paths);
criterion_main!(benches);
