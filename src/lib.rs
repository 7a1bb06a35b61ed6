//! # voussoir
//!
//! Certified stability analysis of masonry and granular assemblies of rigid blocks (arches, walls,
//! vaults, domes, rock blocks, heaps of grains).
//!
//! Each stage is one module and hands the next a plain value; nothing reaches back:
//!
//! ```text
//! JSON ─▶ scene::Scene ─▶ assembly::Assembly ─▶ interface::Interfaces ─▶ verdict ─▶ program ─▶ solve ─▶ analysis ─▶ proof ─▶ sweep ─▶ report
//!              ▲
//!   generate, import                                └─▶ dynamics (a second opinion, in time) ─────────────────▲
//! ```
//!
//! ```
//! let (scene, _) = voussoir::scene::read_file("structures/oppenheim-arch.json".as_ref())?;
//! let model = voussoir::interface::prepare(&scene)?;
//! let answer = voussoir::analysis::limit(&model, &Default::default());
//! assert!(answer.found().is_some_and(|value| (value - 0.373_611_692).abs() < 1e-8));
//! # Ok::<(), voussoir::error::InputError>(())
//! ```
//!
//! A scene need not come from a file: here a pier pushed by a share of its weight, which topples
//! at its width over its height.
//!
//! ```
//! use voussoir::scene::{BlockSpec, Friction, Load, Scene, Shape};
//! let cuboid = |id: &str, size: [f64; 3], z: f64| BlockSpec {
//!     at: [0.0, 0.0, z],
//!     density: Some(2400.0),
//!     ..BlockSpec::new(id, Shape::Cuboid { size })
//! };
//! let mut scene = Scene::default();
//! scene.joints.default.friction = Some(Friction::Coefficient(0.6));
//! let slab = cuboid("slab", [2.0, 2.0, 0.2], -0.1);
//! scene.blocks = vec![BlockSpec { support: true, ..slab }, cuboid("pier", [0.5, 1.0, 2.0], 1.0)];
//! scene.loads.live = vec![Load { weight: Some([1.0, 0.0, 0.0]), ..Load::default() }];
//! let model = voussoir::interface::prepare(&scene)?;
//! let answer = voussoir::analysis::limit(&model, &Default::default());
//! assert!(answer.found().is_some_and(|value| (value - 0.25).abs() < 1e-8));
//! # Ok::<(), voussoir::error::InputError>(())
//! ```
//!
//! An answer comes with its check, on the scene and without the program that found it; anybody can
//! check its evidence again:
//!
//! ```
//! use voussoir::{analysis, interface, scene, verdict::{Evidence, Verdict, claim}};
//! let (scene, _) = scene::read_file("structures/semicircular-arch-thin.json".as_ref())?;
//! let model = interface::prepare(&scene)?;
//! let answer = analysis::assess(&model, &Default::default());
//! assert_eq!(answer.verdict, Verdict::Unstable);
//! let claim = answer.claim().expect("an answer that was proved");
//! assert!(claim::verify(&model, &claim, Evidence::new(&answer.forces, &answer.rates)).proved());
//! # Ok::<(), voussoir::error::InputError>(())
//! ```
//!
//! Every question goes through one door ([`analysis::ask`](analysis::ask())):
//!
//! ```
//! use voussoir::{analysis::{Answer, Question, ask}, interface, scene};
//! let (scene, _) = scene::read_file("structures/oppenheim-arch.json".as_ref())?;
//! let model = interface::prepare(&scene)?;
//! let question = Question::Limit(Default::default());
//! let Answer::Limit(answer) = ask(&question, &scene, &model, &Default::default())? else { return Ok(()) };
//! assert!(answer.bound.grade().is_some() && answer.dry.is_some());
//! # Ok::<(), voussoir::error::InputError>(())
//! ```
//!
//! Inverse questions vary a number of the scene until the verdict flips:
//!
//! ```
//! use voussoir::{analysis::{self, Control, Law, critical::Range}, scene};
//! let (scene, _) = scene::read_file("structures/semicircular-arch-thick.json".as_ref())?;
//! let range = Range { pointer: "/templates/0/arch/thickness".into(), from: 0.05, to: 0.3, scan: Some(5) };
//! let answer = analysis::critical(&scene, &range, &Control { law: Law::Associative, ..Default::default() })?;
//! assert!((answer.changes[0].value - 0.106_720_903_551).abs() < 1e-10);
//! # Ok::<(), voussoir::error::InputError>(())
//! ```
//!
//! The house is a workspace of crates, each by the name of what it holds, and a crate uses only those
//! before it: `base`, [`scene`], `model`, [`cholesky`], `check`, [`solve`], [`dynamics`], [`analysis`],
//! [`sweep`], [`report`]. This one is the facade over them, under which every module has its place, and
//! the command. `voussoir-check` is the *checker* by itself: scenes, templates, meshes, contacts,
//! verdicts and the verification of results that somebody saved, without a conic solver, threads or a
//! clock.
//!
//! A second opinion comes from running the same blocks in time:
//!
//! ```
//! use voussoir::{dynamics::{Fate, simulate}, interface, scene};
//! let (scene, _) = scene::read_file("structures/semicircular-arch-thin.json".as_ref())?;
//! let model = interface::prepare(&scene)?;
//! let outcome = simulate(&model, &Default::default(), &mut |_| std::ops::ControlFlow::Continue(()))?;
//! assert_eq!(outcome.fate, Fate::Falls);
//! # Ok::<(), voussoir::error::InputError>(())
//! ```
//!
//! A sweep asks one question of many scenes, row by row into a file:
//!
//! ```
//! use voussoir::sweep::{self, RunOptions};
//! # let folder = tempfile::tempdir().unwrap();
//! let sweep = sweep::open("structures/sweeps/arch-in-earthquake.json".as_ref())?;
//! let rows = folder.path().join("rows.jsonl");
//! # let few = sweep::Shard::new(1, 60).unwrap();
//! let done = sweep::run(&sweep, &rows, &RunOptions { shard: few, ..RunOptions::default() }, &|_| {})?;
//! let summary = sweep::summarize(&sweep.header(few), &done.rows);
//! assert_eq!(summary.rows, done.rows.len());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! | convention | |
//! |---|---|
//! | units | SI: m, kg, s, N; degrees only in scene files and reports, and then in the name |
//! | axes | z up; gravity 9.81 m/s² downward unless the scene says otherwise |
//! | interface | unit normal `n` from block `a` into block `b`; frame `(t1, t2, n)` right-handed |
//! | contact force | the force on `b`; compression `f_n ≥ 0`, `‖f_t‖ ≤ μ f_n` |
//! | wrench | (force; moment about the block's centre of mass) |
//! | rates | (velocity of the centre of mass; spin), power-conjugate to wrenches; contacts open at `v_n > 0` |
//! | gap | > 0 open, < 0 overlap |
//! | equilibrium | `A f + w + λ ℓ = 0`: contact forces, dead load, live load |
//! | equilibrium error | in multiples of each block's own load (g) |

#![forbid(unsafe_code)]
#![warn(missing_docs)]

pub use analysis;
pub use base::{error, files, limits, number, plain, plane, tolerance};
pub use check::{elastic, ground, kinematic, path, question, rocking, terms, verdict};
pub use cholesky::{self, parallel};
pub use dynamics;
pub use model::{assembly, interface, strength, train};
pub use report;
pub use scene::{self, generate, import};
pub use solve::{self, deadline, program};
pub use sweep::{self, keep};

mod known;

/// Error against run time.
pub mod study {
    pub use crate::known::known;
    pub use sweep::study::*;
}

/// Results as files, and what proves them ([`verify`](proof::verify())).
pub mod proof {
    pub use analysis::{
        recompute::{Solvers, verify},
        saved,
    };
    pub use check::proof::verify::{self};
    pub use check::proof::{
        Answer, Derived, Evidence, PackingFile, ResultFile, Run, Saved, Simulation, Verification,
        VerificationFile, answer, certificate, combinations, compare, critical, derive, evidence,
        kinematic, meet, member, moving, packing, path, read, recompute, result, rocking, shaken,
        simulation, stages, state, thrust, told, verification, without, work,
    };
    pub use sweep::path as kept;
}

pub mod live;

mod cli;

/// The command `voussoir`, for programs that carry it: its binary, the wheel for Python.
pub mod command {
    pub use crate::cli::{
        exit::Exit,
        run::{Memory, run, run_as},
    };
}

// The command names the library as any other program does.
extern crate self as voussoir;
