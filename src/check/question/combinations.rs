//! What is asked in every combination of actions.

use super::{
    KinematicOptions, Question,
    asked::{Asked, Idle},
    directions,
};
use crate::terms::Law;
use base::error::{InputError, JsonPath};
use nalgebra::Vector3;
use scene::Scene;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Options of `combinations`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CombinationsOptions {
    /// What is asked in each: `assess`, `limit`, `moving`, `tilt` or `kinematic`, with its options. Of
    /// a load factor 1 is required where neither it nor the scene says more: loads and strengths have
    /// their factors.
    pub ask: Box<Question>,
    /// Names of the combinations; all where none is named.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub only: Vec<String>,
}

impl Asked for CombinationsOptions {
    fn check(&self, path: &JsonPath) -> Result<(), InputError> {
        check_nested(&self.ask, &path.key("ask"))
    }

    fn law(&self) -> Law {
        self.ask.law()
    }

    fn law_mut(&mut self) -> Option<&mut Law> {
        self.ask.law_mut()
    }

    fn quantity(&self) -> Option<&'static str> {
        self.ask.quantity()
    }

    fn idle_in_rows(&self) -> Option<Idle> {
        None
    }

    fn for_one_number(self) -> Self {
        Self { ask: Box::new(self.ask.for_one_number()), ..self }
    }
}

impl CombinationsOptions {
    /// What is asked in each, with what is required.
    pub fn question(&self, scene: &Scene) -> Question {
        let mut question = (*self.ask).clone();
        if scene.require.load_factor.is_none()
            && let Question::Limit(super::LimitOptions { require, .. })
            | Question::Moving(super::MovingOptions { require, .. }) = &mut question
        {
            require.get_or_insert(1.0);
        }
        question
    }
}

/// Refuses questions that are not asked of several scenes at once.
pub(super) fn check_nested(ask: &Question, path: &JsonPath) -> Result<(), InputError> {
    match ask {
        Question::Assess(_)
        | Question::Limit(_)
        | Question::Moving(_)
        | Question::Tilt(_)
        | Question::Kinematic(_) => ask.check().map_err(|e| e.under(path)),
        _ => {
            let text = format!("`{}` cannot be asked here", ask.word());
            Err(InputError::at(path.clone(), text)
                .hint("ask assess, limit, moving, tilt or kinematic"))
        }
    }
}

/// Whether a question with what was not said written out is the one that was asked: directions may
/// stand in another order.
pub(crate) fn is_the_same(asked: &Question, said: &Question, gravity: Vector3<f64>) -> bool {
    let plain = |q: &Question| {
        let mut q = q.clone();
        let toward = |toward: &mut Vec<[f64; 3]>, all: &mut Option<u16>| {
            let mut list: Vec<[f64; 3]> =
                directions(gravity, toward, all.take()).into_iter().map(Into::into).collect();
            list.sort_by(|a, b| a.partial_cmp(b).unwrap_or(std::cmp::Ordering::Equal));
            *toward = list;
        };
        match &mut q {
            Question::Tilt(o) => toward(&mut o.toward, &mut o.all),
            Question::Kinematic(KinematicOptions { toward: to, all, fc, .. }) => {
                toward(to, all);
                fc.get_or_insert(super::CONFIDENCE);
            }
            _ => {}
        }
        q
    };
    plain(asked) == plain(said)
}
