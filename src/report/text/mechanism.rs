//! The mechanism in words.

use super::{SHOWN, TextOptions, cut, page::Page};
use crate::{
    number::{count, point},
    proof::result::{JointWords, ResultFile},
    verdict::mechanism::JointMotion,
};

const LABELS: [(&str, JointMotion); 5] = [
    ("hinges", JointMotion::Hinge),
    ("crushes", JointMotion::Crush),
    ("slides", JointMotion::Slide),
    ("slip hinges", JointMotion::HingeAndSlide),
    ("parts", JointMotion::Part),
];

/// So many joints of a kind are shown where there are several kinds.
const FEW: usize = 2;

/// Which blocks move, and which joints hinge, slide or part.
pub(super) fn rows(page: &mut Page, file: &ResultFile, options: TextOptions) {
    let Some(m) = &file.mechanism else { return };
    let free = file.scene.blocks - file.scene.supports.min(file.scene.blocks);
    let fastest: Vec<&str> = m
        .moving
        .iter()
        .take(if options.verbose { usize::MAX } else { 4 })
        .map(String::as_str)
        .collect();
    let verb = if m.moving.len() == 1 { "moves" } else { "move, the fastest first" };
    let text = format!(
        "{} of {} {verb}: {}",
        m.moving.len(),
        count(free, "free block"),
        fastest.join(", ")
    );
    page.row(
        "mechanism",
        [if fastest.len() < m.moving.len() { format!("{text}, …") } else { text }],
    );
    let of = |motion: JointMotion| m.joints.iter().filter(move |j| j.motion == motion);
    // Together they leave room on the screen for what follows.
    let kinds = LABELS.iter().filter(|(_, motion)| of(*motion).next().is_some()).count();
    let shown = if kinds > 2 { FEW } else { SHOWN };
    for (label, motion) in LABELS {
        let joints: Vec<&JointWords> = of(motion).collect();
        let width = joints.iter().map(|j| between(j).chars().count()).max().unwrap_or(0);
        let lines: Vec<String> =
            joints.iter().map(|j| format!("{:<width$}  at {}", between(j), point(j.at))).collect();
        page.row(label, cut(&lines, shown, options));
    }
}

fn between(j: &JointWords) -> String {
    format!("{} | {}", j.between[0], j.between[1])
}
