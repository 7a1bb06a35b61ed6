//! The question that is asked of several scenes, from its word and its options.

use super::{
    args::{Ask, By, Nested, Requirement},
    question::Session,
};
use anyhow::bail;
use voussoir::{
    analysis::{
        AssessOptions, KinematicOptions, LimitOptions, MovingOptions, Question, TiltOptions,
    },
    question::Verification,
};

impl From<By> for Verification {
    fn from(by: By) -> Self {
        match by {
            By::Linear => Self::Linear,
            By::Displacement => Self::Displacement,
        }
    }
}

impl Nested {
    /// The first option that is given.
    pub fn idle(&self) -> Option<&'static str> {
        let given = [
            (self.require.is_some(), "--require"),
            (!self.toward.is_empty(), "--toward"),
            (self.verify.is_some(), "--verify"),
        ];
        given.into_iter().find_map(|(given, name)| given.then_some(name))
    }

    /// The question, `ask` or the one that the scene suggests.
    pub fn question(&self, ask: Option<Ask>, session: &Session) -> anyhow::Result<Question> {
        let scene = &session.scene;
        let ask = ask.unwrap_or(match (&scene.train, scene.loads.live.is_empty()) {
            (Some(_), _) => Ask::Moving,
            (None, false) => Ask::Limit,
            (None, true) => Ask::Assess,
        });
        let law = session.law();
        if !self.toward.is_empty() && !matches!(ask, Ask::Tilt | Ask::Kinematic) {
            bail!("--toward requires --ask tilt or --ask kinematic");
        }
        if self.verify.is_some() && ask != Ask::Kinematic {
            bail!("--verify requires --ask kinematic");
        }
        let (require, site) = match self.require {
            None => (None, None),
            Some(Requirement::Value(v)) => (Some(v), None),
            Some(Requirement::Site(share)) => (None, Some(share)),
        };
        if site.is_some() && ask != Ask::Kinematic {
            bail!("--require site requires --ask kinematic");
        }
        if site.is_some() && scene.site.is_none() {
            bail!("--require site: the scene has no \"site\"");
        }
        if require.is_some() && ask == Ask::Assess {
            bail!("--require needs a value: give --ask limit, moving, tilt or kinematic");
        }
        let toward = self.toward.clone();
        Ok(match ask {
            Ask::Assess => AssessOptions { law }.into(),
            Ask::Limit => LimitOptions { law, require, ..LimitOptions::default() }.into(),
            Ask::Moving => MovingOptions { law, require, ..MovingOptions::default() }.into(),
            Ask::Tilt => TiltOptions { law, require, toward, ..TiltOptions::default() }.into(),
            Ask::Kinematic => {
                let verify = self.verify.map(Into::into);
                // No curve where nothing is asked of it.
                let linear = verify == Some(Verification::Linear) || scene.site.is_none();
                KinematicOptions {
                    law,
                    require,
                    site,
                    verify,
                    linear,
                    toward,
                    ..KinematicOptions::default()
                }
                .into()
            }
        })
    }
}
