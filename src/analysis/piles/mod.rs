//! Many small assemblies from numbers, without a file between two of them: does it stand, and how
//! much horizontal acceleration does it bear in every direction?
//!
//! Shapes are made ready once ([`Shelf`]); a pile names them and their places. Where contacts form
//! no closed chain, statics alone decides (`analysis::forest`), in microseconds; elsewhere
//! [`assess`](super::assess()) does. Verdicts are those of `assess` either way.
//!
//! Closed chains were also tried by a few Newton steps on compliant contacts, with the ladder of
//! `assess` only where these proved nothing: 819 piles of ten boxes a second against 859 of `assess`
//! alone, for what falls and what slides costs a program in any case. The interior-point method of this
//! crate in place of clarabel takes a sixth less of the time and says the same. The state first, with
//! the program only where it does not rest: what stands takes 0.77 ms in it and 2.4 ms in `assess`, but
//! its forces are too far from balance to prove anything, and what falls takes 2.7 ms there in vain.

mod margin;

use super::{
    Bracket, Control, assess,
    forest::{Fate, Forest},
};
use base::error::{Finding, InputError};
use check::verdict::Verdict;
use model::{
    assembly::{Put, Shelf},
    interface::{self, Model},
};
use scene::Scene;

pub use margin::{MOST_DIRECTIONS, WITHIN};

/// Shapes made ready, and what is asked of each pile of them.
#[derive(Clone, Debug)]
pub struct Piles {
    shelf: Shelf,
    /// How joints slide, and when to stop.
    pub control: Control,
    /// Ask for the margin.
    pub margin: bool,
}

/// The answer about one pile.
#[derive(Clone, Debug)]
pub struct Pile {
    /// Does it stand?
    pub verdict: Verdict,
    /// The greatest horizontal acceleration, in g, that it bears in every direction, where that was
    /// asked and it stands: admissible forces exist up to the lower end (as `limit` means it), and
    /// in some direction none do beyond the upper one.
    pub margin: Option<Bracket>,
    /// What decided.
    pub by: Decided,
    /// What was found about the contacts.
    pub findings: Vec<Finding>,
}

/// What decided about a pile.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Decided {
    /// Statics alone: contacts form no closed chain.
    Statics,
    /// A program, its answer checked on the scene.
    Program,
}

impl Decided {
    /// One word for it.
    pub fn word(self) -> &'static str {
        match self {
            Self::Statics => "statics",
            Self::Program => "program",
        }
    }
}

impl Piles {
    /// Takes the blocks of a scene as shapes, with its materials, joints, gravity and contact
    /// tolerances.
    ///
    /// # Errors
    /// The scene cannot be resolved, or says something about single blocks that are there (see
    /// [`Shelf::new`]).
    pub fn new(scene: &Scene) -> Result<Self, InputError> {
        let shelf = Shelf::new(model::assembly::resolve(scene)?)?;
        Ok(Self { shelf, control: Control::default(), margin: false })
    }

    /// The shapes.
    pub fn shelf(&self) -> &Shelf {
        &self.shelf
    }

    /// The model of a pile, for every other question.
    ///
    /// # Errors
    /// As [`Shelf::put`]; a joint of which nobody says how it resists.
    pub fn model(&self, list: &[Put]) -> Result<Model, InputError> {
        let assembly = self.shelf.put(list)?;
        let interfaces = interface::detect(&assembly)?;
        Ok(Model::new(assembly, interfaces))
    }

    /// Whether a pile stands, and its margin where that is asked.
    ///
    /// # Errors
    /// As [`Self::model`].
    pub fn ask(&self, list: &[Put]) -> Result<Pile, InputError> {
        let mut model = self.model(list)?;
        let findings = std::mem::take(&mut model.interfaces.findings);
        if let Some(forest) = Forest::of(&model) {
            let fate = forest.fate();
            if fate != Fate::TooClose {
                let stands = fate == Fate::Stands;
                return Ok(Pile {
                    verdict: if stands { Verdict::Stable } else { Verdict::Unstable },
                    margin: (self.margin && stands).then(|| forest.margin()),
                    by: Decided::Statics,
                    findings,
                });
            }
        }
        let verdict = assess(&model, &self.control).verdict;
        // Without gravity no acceleration is a multiple of it.
        let weighs = model.assembly.gravity.norm() > 0.0;
        let margin = (self.margin && weighs && verdict == Verdict::Stable)
            .then(|| margin::margin(&model, &self.control));
        Ok(Pile { verdict, margin, by: Decided::Program, findings })
    }
}
