//! Verifying results of `moving`: every position as a scene of its own, that no step of the way is
//! missing, and that the answer is the least.

use super::least;
use crate::{
    proof::{
        recompute::Recompute,
        result::{Direction, QuestionKind, ResultFile},
        verify::{
            Verification, again, answer, failure, follows, mechanism_words, members, require,
        },
    },
    verdict::claim::Findings,
};
use base::tolerance;
use model::{
    interface::Model,
    train::{self, Position, Standing, Way},
};
use scene::{Scene, Train};

/// Adds the parts of a result of `moving`.
pub(in crate::proof) fn verify(
    all: &mut Verification,
    file: &ResultFile,
    scene: &Scene,
    model: &Model,
    again: &dyn Recompute,
) {
    let (Some(train), Some(way)) = (&scene.train, Way::of(scene, model)) else {
        return all.part("answer", failure("the scene has no train to drive over it"));
    };
    let list = &file.directions;
    let Some(least) = least(list.iter().map(|d| &d.answer)) else {
        return all.part("answer", failure("the answer is not one to its question"));
    };
    let mut f = Findings::default();
    let main = Direction {
        answer: file.answer.clone(),
        certificate: file.certificate.clone(),
        dry: file.dry.clone(),
    };
    require(
        &mut f,
        main == list[least],
        format!("the answer is the least of {} positions, with its evidence", list.len()),
    );
    let bears = |d: &Direction| {
        d.answer.moving().zip(file.answer.moving()).is_some_and(|(a, least)| a.bears(least))
    };
    require(
        &mut f,
        list.iter().all(bears),
        "positions without a value of their own bear what the least one does",
    );
    let [from, to] = train.path;
    let travels = train::travels(train);
    let at = |d: &Direction| d.answer.moving().map(|a| a.position());
    let inside = |p: Position| travels.contains(&p.travel) && (from..=to).contains(&p.x);
    require(
        &mut f,
        list.iter().all(|d| at(d).is_some_and(inside)),
        "every position lies on the way of the train",
    );
    let is_there =
        |p: &Position| list.iter().any(|d| at(d).is_some_and(|q| near(q, *p, train.step)));
    let steps = train::positions(train);
    // A step that cannot be made ready counts as missing, too.
    let is_loaded = |p: &Position| !matches!(way.at(p.to_owned()), Ok(None));
    let missing: Vec<&Position> = steps.iter().filter(|p| !is_there(p) && is_loaded(p)).collect();
    require(
        &mut f,
        missing.is_empty(),
        match missing.first() {
            None => {
                format!("no step of {} is missing at which an axle stands on a span", steps.len())
            }
            Some(p) => format!(
                "{} steps are missing, the first at x = {} {}",
                missing.len(),
                p.x,
                p.travel.words()
            ),
        },
    );
    all.part("answer", f);
    for (index, direction) in list.iter().enumerate() {
        let index = (index == least).then_some(file);
        position(all, direction, index, (&way, train), again);
    }
    all.claimed = file.certificate.claim.is_some();
}

/// The same place, up to what is saved of numbers and what rounding makes of steps.
fn near(a: Position, b: Position, step: f64) -> bool {
    a.travel == b.travel && (a.x - b.x).abs() <= tolerance::SAVED * step
}

/// One position; `file` where it is the answer.
fn position(
    all: &mut Verification,
    direction: &Direction,
    file: Option<&ResultFile>,
    (way, train): (&Way, &Train),
    again: &dyn Recompute,
) {
    let Some(said) = direction.answer.moving() else { return };
    let title = format!("train at x = {} {}", said.x, said.travel.words());
    let under = match way.at(said.position()) {
        Ok(Some(under)) => under,
        Ok(None) => return all.part(title, failure("there no axle stands on a span")),
        Err(e) => return all.part(title, failure(e.to_string())),
    };
    let (mut f, rates) = answer(
        again,
        &under.model,
        QuestionKind::Moving,
        &direction.answer,
        &direction.certificate,
        all.refuted(),
    );
    let alike = |(a, b): (&Standing, &Standing)| {
        let close = |a: f64, b: f64| (a - b).abs() <= tolerance::SAVED * a.abs().max(b.abs());
        // Places are told apart by steps, not by how far off the origin lies.
        a.axle == b.axle
            && (a.x - b.x).abs() <= tolerance::SAVED * train.step
            && close(a.force, b.force)
            && (a.share - b.share).abs() <= tolerance::SAVED
    };
    require(
        &mut f,
        said.axles.len() == under.axles.len() && said.axles.iter().zip(&under.axles).all(alike),
        "the axles stand where the train puts them",
    );
    follows(&mut f, &direction.answer, direction.dry.as_ref());
    if let Some(file) = file {
        mechanism_words(&mut f, file, &under.model, rates.as_deref());
        members(&mut f, file, &under.model);
    }
    all.part(title.clone(), f);
    if let Some(dry) = &direction.dry {
        let findings = again::dry_friction(
            again,
            &|_| Ok(under.model.clone()),
            (&direction.answer, &direction.certificate),
            dry,
            all.refuted(),
        );
        all.part(format!("{title}, dry friction"), findings);
    }
}
