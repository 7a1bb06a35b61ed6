//! The first page: who assessed what, what was asked, on which assumptions, what they leave out, and
//! room to sign. Every number on it stands in the result.

use super::{asked, laws, limits, pieces};
use crate::{
    drawing::{self, Aspect},
    text::bridge,
    view::View,
};
use check::proof::result::ResultFile;
use model::interface::Model;

/// The first page of a record.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Cover {
    /// Project, structure, revision, date, author, checker; empty where the scene does not say it.
    pub heading: Vec<[String; 2]>,
    /// What was asked, and what the number of the answer means.
    pub asked: Vec<[String; 2]>,
    /// The drawing of the answer (SVG).
    pub drawing: String,
    /// Strengths, densities, law of sliding, parts of a bridge.
    pub assumptions: Vec<[String; 2]>,
    /// Where geometry and values come from, as the scene says it.
    pub source: String,
    /// What the model leaves out.
    pub limits: Vec<String>,
    /// Who signs, with the name where the scene gives it.
    pub signs: Vec<[String; 2]>,
}

impl Cover {
    /// That of a result.
    pub(super) fn new(file: &ResultFile, model: &Model, view: &View, from: Aspect) -> Self {
        let scene = &file.scene.input;
        let mut assumptions = vec![["density".into(), pieces::densities(model)]];
        assumptions.extend(laws::said(view));
        assumptions.extend(asked::law(file).map(|law| ["sliding".into(), law.into()]));
        let parts = bridge::parts(file);
        assumptions.extend((!parts.is_empty()).then(|| ["bridge".into(), parts.join("; ")]));
        if let Some(name) = &scene.combination {
            let words = format!("{name}, with the partial factors that the scene gives");
            assumptions.push(["combination".into(), words]);
        }
        Self {
            asked: asked::facts(file),
            drawing: drawing::printed(view, from),
            assumptions,
            source: match scene.source.is_empty() {
                true => "not given in the scene".into(),
                false => scene.source.clone(),
            },
            limits: limits::lines(file),
            ..Self::signed(&file.scene.name, &scene.record)
        }
    }

    /// Names and blanks alone.
    pub(super) fn signed(structure: &str, record: &scene::Record) -> Self {
        let text = |value: &Option<String>| value.clone().unwrap_or_default();
        let [author, checker] = [&record.author, &record.checker].map(text);
        let heading = [
            ("project", text(&record.project)),
            ("revision", text(&record.revision)),
            ("structure", structure.into()),
            ("date", text(&record.date)),
            ("author", author.clone()),
            ("checker", checker.clone()),
        ];
        Self {
            heading: heading.map(|(name, text)| [name.into(), text]).into(),
            signs: vec![["author".into(), author], ["checker".into(), checker]],
            ..Self::default()
        }
    }
}
