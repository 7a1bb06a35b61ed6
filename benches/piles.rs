//! Random piles of ten boxes on a ground: piles a second on two threads, agreement with `assess`,
//! and beside it what the physics engine says that lets them go and looks.
//!
//! `cargo bench --bench piles` prints the table. Nothing here asserts a time.

#![allow(clippy::expect_used, clippy::unwrap_used)]

use nalgebra::{UnitQuaternion, Vector3};
use std::time::Instant;
use voussoir::{
    analysis::{
        self, Control,
        piles::{Decided, Pile, Piles},
    },
    assembly::Put,
    dynamics::{Fate, Fidelity, SimulationSettings, simulate},
    parallel,
    scene::read_str,
    verdict::Verdict,
};

/// Boxes of a pile, and shapes that they are taken from.
const BOXES: usize = 10;
const SHAPES: usize = 50;

/// A linear congruential generator (Knuth, MMIX).
struct Random(u64);

impl Random {
    fn within(&mut self, from: f64, to: f64) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        from + (to - from) * (self.0 >> 33) as f64 / (1u64 << 31) as f64
    }
}

/// The ground and boxes: the first half of any size, the others all alike.
fn shapes(random: &mut Random) -> (Piles, Vec<[f64; 3]>) {
    let sizes: Vec<[f64; 3]> = (0..SHAPES)
        .map(|k| match k < SHAPES / 2 {
            true => [random.within(0.4, 0.6), random.within(0.4, 0.6), random.within(0.1, 0.3)],
            false => [0.5, 0.4, 0.2],
        })
        .collect();
    let blocks: Vec<String> = sizes
        .iter()
        .enumerate()
        .map(|(k, size)| {
            format!(r#", {{ "id": "shape {k}", "shape": {{ "box": {{ "size": {size:?} }} }} }}"#)
        })
        .collect();
    let text = format!(
        r#"{{ "format": "voussoir-scene/1", "joints": {{ "default": {{ "friction": 0.6 }} }},
        "blocks": [ {{ "id": "ground", "support": true, "shape": {{ "box": {{ "size": [20, 20, 1] }} }} }}{} ] }}"#,
        blocks.concat()
    );
    let scene = read_str("shapes", &text).expect("the scene is well formed").0;
    (Piles::new(&scene).expect("shapes without loads"), sizes)
}

fn ground() -> Put {
    Put { shape: 0, at: Vector3::new(0.0, 0.0, -0.5), turn: UnitQuaternion::identity(), mass: None }
}

/// One box on the other, each turned and shifted as it comes.
fn stack(sizes: &[[f64; 3]], random: &mut Random) -> Vec<Put> {
    let mut put = vec![ground()];
    let (mut at, mut top) = (Vector3::zeros(), 0.0);
    for _ in 0..BOXES {
        let shape = random.within(0.0, (SHAPES / 2) as f64) as usize;
        let height = sizes[shape][2];
        at += Vector3::new(random.within(-0.12, 0.12), random.within(-0.12, 0.12), 0.0);
        let turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), random.within(0.0, 1.5));
        put.push(Put {
            shape: shape + 1,
            at: at + Vector3::z() * (top + 0.5 * height),
            turn,
            mass: None,
        });
        top += height;
    }
    put
}

/// Courses of three and two boxes with gaps.
fn courses(random: &mut Random) -> Vec<Put> {
    let mut put = vec![ground()];
    let spread = random.within(0.0, 0.2);
    for k in 0.. {
        let odd = k % 2 == 1;
        for i in 0..if odd { 2 } else { 3 } {
            let x = 0.55 * f64::from(i) + if odd { 0.27 } else { 0.0 };
            let at = Vector3::new(
                x + random.within(-spread, spread),
                random.within(-spread, spread),
                0.1 + 0.2 * f64::from(k),
            );
            let turn = UnitQuaternion::identity();
            put.push(Put { shape: SHAPES, at, turn, mass: None });
            if put.len() > BOXES {
                return put;
            }
        }
    }
    put
}

fn main() {
    let mut random = Random(7);
    let (mut piles, sizes) = shapes(&mut random);
    let stacks: Vec<Vec<Put>> = (0..20_000).map(|_| stack(&sizes, &mut random)).collect();
    let bonded: Vec<Vec<Put>> = (0..2_000).map(|_| courses(&mut random)).collect();
    for (name, list) in [("stacks", &stacks), ("courses", &bonded)] {
        println!("{name}: {} piles of {BOXES} boxes, two threads", list.len());
        for margin in [false, true] {
            piles.margin = margin;
            // A margin of a closed chain takes some ten programs.
            let list = if margin { &list[..list.len() / 10] } else { &list[..] };
            let start = Instant::now();
            let answers: Vec<Pile> =
                parallel::map(2, list, |p| piles.ask(p).expect("a pile")).expect("threads");
            let seconds = start.elapsed().as_secs_f64();
            let count = |f: &dyn Fn(&Pile) -> bool| answers.iter().filter(|a| f(a)).count();
            println!(
                "  {}: {:.0} piles a second; {} stand, {} fall, {} conditional, {} undecided; {} by statics alone",
                if margin { "verdict and margin" } else { "verdict" },
                list.len() as f64 / seconds,
                count(&|a| a.verdict == Verdict::Stable),
                count(&|a| a.verdict == Verdict::Unstable),
                count(&|a| a.verdict == Verdict::Conditional),
                count(&|a| a.verdict == Verdict::Undecided),
                count(&|a| a.by == Decided::Statics),
            );
            if margin {
                beside(&piles, list, &answers);
            }
        }
    }
}

/// `assess` and the engine about some of the same piles.
fn beside(piles: &Piles, list: &[Vec<Put>], answers: &[Pile]) {
    let some = 1_000.min(list.len());
    let models: Vec<_> = list[..some].iter().map(|p| piles.model(p).expect("a pile")).collect();
    let start = Instant::now();
    let same = parallel::map(2, &models, |m| analysis::assess(m, &Control::default()).verdict)
        .expect("threads")
        .iter()
        .zip(answers)
        .filter(|(one, other)| **one == other.verdict)
        .count();
    let rate = some as f64 / start.elapsed().as_secs_f64();
    println!("  assess: {rate:.0} piles a second; the same verdict on {same} of {some}");
    let few = 100;
    let settings = SimulationSettings { fidelity: Some(Fidelity::Fast), ..Default::default() };
    let start = Instant::now();
    let fates = parallel::map(2, &models[..few], |m| {
        simulate(m, &settings, &mut |_| std::ops::ControlFlow::Continue(())).map(|o| o.fate)
    })
    .expect("threads");
    let rate = few as f64 / start.elapsed().as_secs_f64();
    let of = |verdict: Verdict, fate: Fate| {
        fates
            .iter()
            .zip(answers)
            .filter(|(f, a)| f.as_ref().is_ok_and(|f| *f == fate) && a.verdict == verdict)
            .count()
    };
    println!(
        "  engine: {rate:.1} piles a second; of {few}: stands called falling {}, falls called standing {}, undecided {}",
        of(Verdict::Stable, Fate::Falls),
        of(Verdict::Unstable, Fate::Stands),
        fates.iter().filter(|f| f.as_ref().is_ok_and(|f| *f == Fate::Undecided)).count(),
    );
}
