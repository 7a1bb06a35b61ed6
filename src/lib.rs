//! # voussoir
//!
//! Tells whether things made of rigid pieces that only touch (arches, walls, vaults, domes, rock
//! blocks, heaps of grains) stand or fall, and proves it.
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
//! use voussoir::{analysis, interface, scene, verdict::{Evidence, Verdict, check}};
//! let (scene, _) = scene::read_file("structures/semicircular-arch-thin.json".as_ref())?;
//! let model = interface::prepare(&scene)?;
//! let answer = analysis::assess(&model, &Default::default());
//! assert_eq!(answer.verdict, Verdict::Unstable);
//! let claim = answer.claim().expect("an answer that was proved");
//! assert!(check::verify(&model, &claim, Evidence::new(&answer.forces, &answer.rates)).proved());
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
//! The crate comes in steps, each a cargo feature that holds the one before it: without any feature
//! it is the *checker* (scenes, templates, meshes, contacts, verdicts, and [`proof::verify`](proof::verify()) for
//! results that somebody saved; no conic solver, no threads, no clock), then `solve` (questions and
//! their answers), `dynamics`, `sweep`, `report`, and `cli`, the command, which is the default.
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
//! | unbalance | in multiples of each block's own load (g) |

#![warn(missing_docs)]
// What only later steps use is not dead in this one; the whole is judged.
#![cfg_attr(not(feature = "cli"), allow(dead_code, unused_imports))]
#![forbid(unsafe_code)]

pub mod error;
pub mod tolerance;

#[cfg(feature = "solve")]
pub mod deadline;

pub mod plain;

pub mod number;

pub mod plane;

pub mod files;

pub mod limits;

pub mod ground;

pub mod rocking;

#[cfg(feature = "solve")]
pub mod parallel;

#[cfg(feature = "sweep")]
pub mod keep;

pub mod scene;

pub mod generate;

pub mod import;

pub mod assembly;

pub mod interface;

pub mod strength;

pub mod cholesky;

pub mod verdict;

pub mod terms;

pub mod path;

pub mod kinematic;

pub mod train;

pub mod yielding;

#[cfg(feature = "solve")]
pub mod program;

#[cfg(feature = "solve")]
pub mod solve;

#[cfg(feature = "dynamics")]
pub mod dynamics;

#[cfg(feature = "solve")]
pub mod analysis;

pub mod proof;

#[cfg(feature = "sweep")]
pub mod sweep;

#[cfg(feature = "sweep")]
pub mod study;

#[cfg(feature = "report")]
pub mod report;

#[cfg(feature = "cli")]
pub mod live;

#[cfg(feature = "cli")]
mod cli;

/// The command `voussoir`, for programs that carry it: its binary, the wheel for Python.
#[cfg(feature = "cli")]
pub mod command {
    pub use crate::cli::{
        exit::Exit,
        run::{Memory, run, run_as},
    };
}

// The command names the library as any other program does.
#[cfg(feature = "cli")]
extern crate self as voussoir;
