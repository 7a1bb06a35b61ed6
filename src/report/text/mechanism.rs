//! The mechanism in words.

use super::{SHOWN, TextOptions, cut, page::Page};
use base::number::{count, point, short};
use check::{
    proof::{
        member::{MemberLine, MemberState},
        result::ResultFile,
        told::JointWords,
    },
    verdict::mechanism::{JointMotion, MemberMotion},
};

const LABELS: [(&str, JointMotion); 5] = [
    ("hinges", JointMotion::Hinge),
    ("crushes", JointMotion::Crush),
    ("slides", JointMotion::Slide),
    ("slip hinges", JointMotion::HingeAndSlide),
    ("parts", JointMotion::Part),
];

const MEMBERS: [(&str, MemberMotion); 3] = [
    ("yield", MemberMotion::Yields),
    ("go slack", MemberMotion::Slackens),
    ("fingers slide", MemberMotion::Slides),
];

/// So many joints of a kind are shown where there are several kinds.
const FEW: usize = 2;

/// Which blocks move, and which joints hinge, slide or part.
pub(super) fn rows(page: &mut Page, file: &ResultFile, options: TextOptions) {
    let Some(m) = &file.mechanism else { return };
    let free = file.scene.counts.blocks - file.scene.counts.supports.min(file.scene.counts.blocks);
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
    for (label, motion) in MEMBERS {
        let own = m.members.iter().filter(|m| m.motion == motion);
        let names: Vec<String> = own.map(|m| m.member.clone()).collect();
        page.row(label, cut(&names, shown, options));
    }
}

/// The force in every member.
pub(super) fn members(page: &mut Page, file: &ResultFile, options: TextOptions) {
    let words = |l: &MemberLine| {
        let of = |greatest: Option<f64>| match greatest {
            Some(most) if most != 0.0 => format!(" of {} N", short(most.abs())),
            _ => String::new(),
        };
        let strength = of(if l.force < 0.0 { l.least } else { l.greatest });
        let state = match l.state {
            MemberState::Slack => " (slack)",
            MemberState::Carries => "",
            MemberState::AtStrength => " (at its strength)",
        };
        let friction =
            l.friction.map_or_else(String::new, |f| format!(", friction {} N", short(f)));
        let name = format!("{} ({})", l.member, l.kind.word());
        (name, format!("{} N{strength}{friction}{state}", short(l.force)))
    };
    let lines: Vec<(String, String)> = file.members.iter().map(words).collect();
    let width = lines.iter().map(|l| l.0.chars().count()).max().unwrap_or(0);
    let lines: Vec<String> = lines.iter().map(|(a, b)| format!("{a:<width$}  {b}")).collect();
    page.row("members", cut(&lines, SHOWN, options));
}

fn between(j: &JointWords) -> String {
    format!("{} | {}", j.between[0], j.between[1])
}
