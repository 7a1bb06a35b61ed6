//! Time per stage against the number of blocks, on running-bond walls, and the figures that the
//! README quotes.
//!
//! `cargo bench` prints them; one thread throughout. Nothing here asserts a time.

#![allow(clippy::expect_used, clippy::panic, clippy::unwrap_used)]

use criterion::{
    BenchmarkId, Criterion, SamplingMode, Throughput, criterion_group, criterion_main,
};
use std::{hint::black_box, ops::ControlFlow, process::Command, time::Duration};
use voussoir::{
    analysis::{
        self, CombinationsOptions, Control, Law, LimitOptions, Limited, Question,
        follow::machine::{MachineOptions, machine},
    },
    assembly,
    dynamics::{Fidelity, SimulationSettings, simulate},
    ground::Record,
    import, interface,
    program::{self, Statics, StaticsOptions, Unknowns},
    proof::saved,
    rocking::{self, RunSettings},
    scene::{Friction, Load, Scene, read_file, read_str},
    sweep,
    verdict::{Evidence, claim},
};

/// A wall of `courses` free courses of `length` blocks of 1 × 0.5 × 0.4 m on a fixed course, pushed
/// along x or y.
fn wall(courses: usize, length: usize, push: [f64; 3]) -> Scene {
    let text = format!(
        r#"{{ "format": "voussoir-scene/1", "joints": {{ "default": {{ "friction": 0.6 }} }},
        "templates": [ {{ "wall": {{ "size": [1, 0.5, 0.4], "courses": {courses}, "blocks": {length}, "first": "half", "base": "course" }} }} ],
        "loads": {{ "live": [ {{ "weight": {push:?} }} ] }} }}"#
    );
    read_str("bench", text).expect("the bench scene is well formed").0
}

/// Courses × blocks of the walls each stage is timed on.
const WALLS: [usize; 3] = [10, 20, 40];

fn stages(c: &mut Criterion) {
    let mut group = c.benchmark_group("stages");
    group
        .sample_size(10)
        .warm_up_time(Duration::from_millis(300))
        .measurement_time(Duration::from_secs(2));
    for n in WALLS {
        let scene = wall(n, n, [1.0, 0.0, 0.0]);
        let model = &interface::prepare(&scene).expect("the bench scene resolves");
        let assembly = &model.assembly;
        let blocks = assembly.blocks.len();
        group.bench_function(BenchmarkId::new("resolve", blocks), |b| {
            b.iter(|| assembly::resolve(black_box(&scene)))
        });
        group.bench_function(BenchmarkId::new("detect", blocks), |b| {
            b.iter(|| interface::detect(black_box(assembly)))
        });
        group.bench_function(BenchmarkId::new("build", blocks), |b| {
            b.iter(|| {
                program::load_factor(
                    &Statics::new(
                        model,
                        StaticsOptions { keep_all: false, live: true, ..StaticsOptions::default() },
                    ),
                    1.0,
                    Unknowns::Rates,
                )
            })
        });
        group.bench_function(BenchmarkId::new("assess", blocks), |b| {
            b.iter(|| analysis::assess(model, &Control::default()))
        });
        group.bench_function(BenchmarkId::new("limit in plane", blocks), |b| {
            b.iter(|| analysis::limit(model, &Control::default()))
        });
        let answer = analysis::limit(model, &Control::default());
        if let Some(claim) = answer.claim() {
            let evidence = Evidence::new(&answer.forces, &answer.rates);
            group.bench_function(BenchmarkId::new("check", blocks), |b| {
                b.iter(|| claim::verify(model, &claim, evidence))
            });
        }
        let limited = Limited { bound: answer, dry: None, dead: None };
        group.bench_function(BenchmarkId::new("result file", blocks), |b| {
            b.iter(|| saved::load_factor(&scene, model, &limited).unwrap())
        });
    }
    group.finish();
}

/// A live load on two spans of 20 voussoirs in one combination of actions, and in forty.
fn combinations(c: &mut Criterion) {
    let mut group = c.benchmark_group("combinations");
    group
        .sample_size(10)
        .warm_up_time(Duration::from_millis(300))
        .measurement_time(Duration::from_secs(3));
    for count in [1, 40] {
        let list: Vec<String> = (0..count)
            .map(|k| {
                let factor = 1.0 + 0.01 * f64::from(k);
                format!(r#"{{ "name": "c{k}", "factors": {{ "dead": {factor}, "live": 1.35 }} }}"#)
            })
            .collect();
        let span = r#"{ "clear_span": 6, "rise": 1.5, "thickness": 0.45, "voussoirs": 20 }"#;
        let text = format!(
            r#"{{ "format": "voussoir-scene/1", "joints": {{ "default": {{ "friction": 0.6 }} }},
            "materials": {{ "stone": {{ "density": 2200 }} }},
            "templates": [ {{ "bridge": {{ "material": "stone", "width": 1, "spans": [{span}, {span}],
                "piers": [ {{ "width": 1.5, "height": 3 }} ], "fill": {{ "cover": 0.3, "unit_weight": 18000 }} }} }} ],
            "loads": {{ "live": [ {{ "road": {{ "x": -4.5 }}, "force": [0, 0, -50000] }} ] }},
            "combinations": [ {} ] }}"#,
            list.join(", ")
        );
        let scene = read_str("bench", text).expect("the bench scene is well formed").0;
        let ask = Box::new(LimitOptions::default().into());
        let question = Question::from(CombinationsOptions { ask, only: Vec::new() });
        group.bench_function(BenchmarkId::new("bridge", count), |b| {
            b.iter(|| {
                let model = interface::prepare(&scene).expect("the bench scene resolves");
                analysis::ask(&question, &scene, &model, &Control::default()).unwrap()
            })
        });
    }
    group.finish();
}

fn figures(c: &mut Criterion) {
    let mut group = c.benchmark_group("figures");
    group
        .sample_size(10)
        .warm_up_time(Duration::from_millis(300))
        .measurement_time(Duration::from_secs(3));
    let scene = wall(199, 100, [1.0, 0.0, 0.0]);
    let large = assembly::resolve(&scene).expect("the bench scene resolves");
    group.bench_function(format!("interfaces of a wall of {} blocks", large.blocks.len()), |b| {
        b.iter(|| interface::detect(black_box(&large)))
    });
    let scene = wall(12, 12, [0.0, 1.0, 0.0]);
    let model = interface::prepare(&scene).expect("the bench scene resolves");
    group.bench_function(
        format!("limit out of plane, {} blocks", model.assembly.blocks.len()),
        |b| b.iter(|| analysis::limit(&model, &Control::default())),
    );
    let arch = concat!(env!("CARGO_MANIFEST_DIR"), "/structures/semicircular-arch-thick.json");
    group.bench_function("whole process: assess an arch of 27 voussoirs", |b| {
        b.iter(|| {
            Command::new(env!("CARGO_BIN_EXE_voussoir"))
                .args(["assess", arch, "--quiet"])
                .output()
                .expect("the program runs")
        })
    });
    let plan = concat!(env!("CARGO_MANIFEST_DIR"), "/structures/sweeps/arch-in-earthquake.json");
    let sweep = sweep::open(plan.as_ref()).expect("the plan opens");
    let folder = tempfile::tempdir().expect("a folder");
    for threads in [1, 2, 4] {
        let options = sweep::RunOptions {
            threads: Some(threads),
            restart: true,
            ..sweep::RunOptions::default()
        };
        group.bench_function(
            format!("sweep of {} arches of 27 voussoirs, {threads} threads", sweep.rows()),
            |b| {
                b.iter(|| {
                    sweep::run(&sweep, &folder.path().join("rows.jsonl"), &options, &|_| {})
                        .expect("the sweep runs")
                })
            },
        );
    }
    group.finish();
}

/// A real vault under dry friction, where its file is at hand, and a long chain.
fn large(c: &mut Criterion) {
    let mut group = c.benchmark_group("large");
    group
        .sample_size(10)
        .warm_up_time(Duration::from_millis(300))
        .measurement_time(Duration::from_secs(5));
    let path = std::path::Path::new(concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../shared/data/compas/cra-armadillo.json"
    ));
    if path.exists() {
        let options = import::ImportOptions {
            supports: (0..8)
                .chain(79..89)
                .chain(217..228)
                .chain(328..332)
                .map(|k| k.to_string())
                .collect(),
            friction: Some(Friction::Coefficient(0.84)),
            density: Some(1.0),
            ..import::ImportOptions::default()
        };
        let mut scene = import::import_file(path, &options).expect("the vault is read").scene;
        scene.loads.live = vec![Load { weight: Some([1.0, 0.0, 0.0]), ..Load::default() }];
        let model = &interface::prepare(&scene).expect("the vault resolves");
        let bound = Control { law: Law::Associative, ..Control::default() };
        group.bench_function("vault of 399 voussoirs: verdict", |b| {
            b.iter(|| analysis::assess(model, &bound))
        });
        group.bench_function("vault of 399 voussoirs: verdict and state", |b| {
            b.iter(|| analysis::assess(model, &Control::default()))
        });
        group.bench_function("vault of 399 voussoirs: load factor", |b| {
            b.iter(|| analysis::limit(model, &bound))
        });
    } else {
        println!("large: no ../shared/data/compas, the vault of 399 voussoirs is left out");
    }
    let text = r#"{ "format": "voussoir-scene/1", "joints": { "default": { "friction": 0.6 } },
        "templates": [ { "column": { "blocks": 100000, "size": [1, 1, 1] } } ] }"#;
    let scene = read_str("bench", text).expect("the bench scene is well formed").0;
    group.bench_function("column of 100,000 blocks: interfaces and verdict", |b| {
        b.iter(|| {
            let model = interface::prepare(black_box(&scene)).expect("the bench scene resolves");
            analysis::assess(&model, &Control::default())
        })
    });
    group.finish();
}

/// Steps of the dynamics: a step with fast settings stands for √(L/g) / 100 of time, 3.5 ms here.
fn steps(c: &mut Criterion) {
    const STEPS: usize = 100;
    let mut group = c.benchmark_group("dynamics");
    group
        .sample_size(10)
        .warm_up_time(Duration::from_millis(300))
        .measurement_time(Duration::from_secs(3));
    for (courses, length) in [(9, 10), (24, 40)] {
        let scene = wall(courses, length, [1.0, 0.0, 0.0]);
        let model = interface::prepare(&scene).expect("the bench scene resolves");
        let blocks = model.assembly.blocks.len();
        let unit = (model.assembly.blocks[0].size / model.assembly.gravity.norm()).sqrt();
        for threads in [1, 4] {
            let settings = SimulationSettings {
                fidelity: Some(Fidelity::Fast),
                seconds: Some(STEPS as f64 * unit / 100.0),
                to_the_end: true,
                threads,
                ..SimulationSettings::default()
            };
            group.throughput(Throughput::Elements(STEPS as u64));
            group.bench_function(
                BenchmarkId::new(format!("{STEPS} fast steps, {threads} threads"), blocks),
                |b| b.iter(|| simulate(&model, &settings, &mut |_| ControlFlow::Continue(()))),
            );
        }
    }
    group.finish();
}

/// Load factor and verdict of walls pushed in and out of their plane, by the engine of large
/// programs; the largest take minutes, and run only where `VOUSSOIR_LARGE_WALLS` is set.
fn walls(c: &mut Criterion) {
    let mut group = c.benchmark_group("walls");
    group
        .sample_size(10)
        .sampling_mode(SamplingMode::Flat)
        .warm_up_time(Duration::from_millis(1))
        .measurement_time(Duration::from_secs(2));
    let (inward, outward) = ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0]);
    let mut list = vec![(40, 40, inward), (30, 60, outward)];
    if std::env::var_os("VOUSSOIR_LARGE_WALLS").is_some() {
        list.extend([(100, 100, inward), (100, 200, outward), (200, 200, inward)]);
    }
    for (courses, length, push) in list {
        let model =
            &interface::prepare(&wall(courses, length, push)).expect("the bench scene resolves");
        let name =
            format!("{courses} x {length} {} plane", if push == inward { "in" } else { "out of" });
        group.bench_function(BenchmarkId::new("limit", &name), |b| {
            b.iter(|| analysis::limit(model, &Control::default()))
        });
        for law in [Law::Associative, Law::Coulomb] {
            let control = Control { law, ..Control::default() };
            group.bench_function(BenchmarkId::new(format!("assess, {law:?}"), &name), |b| {
                b.iter(|| analysis::assess(model, &control))
            });
        }
    }
    group.finish();
}

/// A record of 40 s, 8,001 samples, through the mechanism of one block that rocks and does not
/// overturn.
fn rocks(c: &mut Criterion) {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/structures/slender-block.json");
    let (scene, _) = read_file(path.as_ref()).expect("the bench scene reads");
    let model = interface::prepare(&scene).expect("the bench scene resolves");
    let options =
        MachineOptions { toward: nalgebra::Vector3::x(), control: None, restitution: None };
    let built = machine(&scene, &model, &options, &Control::default()).expect("it rocks");
    let mut record = String::from("t (s),a (m/s2)\n");
    for k in 0..=8000 {
        let t = 0.005 * f64::from(k);
        let a = 2.4 * (5.0 * t).sin() * (1.0 + 0.3 * (1.7 * t).sin());
        record += &format!("{t:.3},{a:.6}\n");
    }
    let record = Record::parse("bench.csv", record.as_bytes(), None).expect("a record");
    let motion = record.motion();
    c.bench_function("rocking, one block, a record of 40 s", |b| {
        b.iter(|| rocking::run(&built.machine, &motion, &RunSettings::default()))
    });
}

criterion_group!(benches, stages, combinations, figures, walls, large, steps, rocks);
criterion_main!(benches);
