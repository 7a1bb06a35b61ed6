//! What every model of rigid blocks leaves out, in the words of docs/guide/limits.md.

use check::{proof::result::ResultFile, question::QuestionKind as Kind};
use scene::Template;

/// What is left out, and what that does.
const FAILURE: [&str; 2] =
    ["block failure", "a slender stone bends or a pier splits before any joint opens"];
const ELASTIC: [&str; 2] = [
    "elastic joints, second order",
    "thin arches and tall piers lose load factor through displacements",
];
const LEAVES: [&str; 2] = [
    "rubble cores, separated leaves",
    "a wall of two leaves drawn as one block is too strong, sometimes by two",
];
const FILL: [&str; 2] = ["fill and soil", "Spandrel walls and skew are not modelled"];
const MOVEMENTS: [&str; 2] =
    ["past support movements", "hinges are already open; forces lie at one end of their range"];
const DYNAMICS: [&str; 2] =
    ["dynamics", "blocks rock and collide, and may survive accelerations above the static one"];
/// What no proof says.
const MODEL: &str = "A proof is a proof of the model.";

/// Those that hold for the question and the scene of a result.
pub(super) fn lines(file: &ResultFile) -> Vec<String> {
    let kind = file.question.kind();
    let spans = |t: &Template| matches!(t, Template::Bridge(_));
    let moves = matches!(kind, Kind::Simulate | Kind::Shake | Kind::Rock | Kind::Kinematic);
    let all = [
        (true, FAILURE),
        (kind != Kind::State, ELASTIC),
        (true, LEAVES),
        (file.scene.input.templates.iter().any(spans), FILL),
        (kind != Kind::Settle, MOVEMENTS),
        (!moves, DYNAMICS),
    ];
    let there = all.into_iter().filter_map(|(there, line)| there.then_some(line));
    there.map(|[what, effect]| format!("{what}: {effect}")).chain([MODEL.into()]).collect()
}
