//! States of elastic joints for people.

mod table;

use super::telling::{PLAIN, Telling};
use crate::text::{
    options::{TextOptions, cut},
    page::{Page, Role},
};
use base::number::{fixed, point, short};
use check::{
    elastic::{EventKind, Grip, PathEnd, PathFactor, Quadrature, Residuals, Touch},
    proof::{
        result::ResultFile,
        state::{Event, JointAnswer},
    },
    question::Question,
    verdict::Verdict,
};

pub(super) const TELLING: Telling = Telling {
    verb: "state",
    asked: |_| {
        [
            "Which forces and displacements follow from the stiffness of its joints?",
            "Computed from the stiffnesses listed, with friction followed along the load path. That \
             the forces are admissible is proved.",
        ]
    },
    title,
    why,
    rows,
    csv: Some(table::csv),
    charts: |file| table::chart(file).into_iter().collect(),
    ..PLAIN
};

/// Rotations (rad) of blocks of any size below this multiple of their displacement (m), and shear forces
/// below this share of the normal force, are rounding.
const ROUNDING: f64 = 1e-9;
/// Of paths that end above this share of the bound nobody can say that they do not reach it.
const NEAR: f64 = 1.0 - 1e-3;
/// So many joints, blocks and events are listed.
const LISTED: usize = 12;

/// The first line.
pub(super) fn title(file: &ResultFile) -> (String, Role) {
    let Some(a) = file.answer.state() else { return ("undecided".into(), Role::Unsure) };
    let Some(g) = &a.greatest else {
        return match a.verdict {
            Verdict::Unstable => ("falls: no equilibrium exists".into(), Role::Bad),
            Verdict::Conditional => (
                "stands only with self-stress: no equilibrium with elastic joints was found".into(),
                Role::Bad,
            ),
            _ => ("undecided: no equilibrium was found".into(), Role::Unsure),
        };
    };
    let rest = format!(
        "at rest, displaced by up to {} m ({})",
        short(g.displacement),
        base::plain::cell(&g.block)
    );
    match &a.load_factor {
        None => (rest, Role::Good),
        Some(l) => match (l.end, l.value) {
            (PathEnd::Unbounded, _) => (
                format!(
                    "{rest}; followed up to λ = {} without reaching a limit",
                    fixed(l.reached, 6)
                ),
                Role::Good,
            ),
            (_, Some(v)) => (format!("λ = {} along the path; {rest}", fixed(v, 6)), Role::Value),
            (_, None) => {
                let text = format!("{rest}; followed up to λ = {} only", fixed(l.reached, 6));
                (text, Role::Unsure)
            }
        },
    }
}

/// The sentences below it.
pub(super) fn why(page: &mut Page, file: &ResultFile) {
    let Some(a) = file.answer.state() else { return };
    if a.greatest.is_none() {
        page.paragraph(match a.verdict {
            Verdict::Undecided => "Forces that balance the dead load may exist, but no displacements were found at which the elastic joints develop them.",
            _ => "The joints cannot carry the dead load, however stiff they are.",
        });
        return;
    }
    page.paragraph(match a.quadrature {
        Quadrature::Area => "Joints are elastic and take no tension: only their compressed part acts. Where they stick they shear elastically, where they slide they follow Coulomb's law. Displacements are small: second-order effects are neglected.",
        Quadrature::Corners => "Joints are elastic at their corners only, as for dry friction in the other questions. Displacements are small: second-order effects are neglected.",
    });
    if let Question::State(asked) = &file.question
        && asked.quadrature != a.quadrature
    {
        page.paragraph("Joints elastic over their area were asked for, but no equilibrium was found, or the path did not end, because the compressed part shrinks to nothing. Joints elastic at their corners are up to three times as stiff in rotation.");
    }
    page.paragraph("The forces follow from the displacements and balance every block inside the friction cones, which proves that it stands. That the structure takes this state is computed from the stiffness of its joints and rests on the three conditions below.");
    let Some(l) = &a.load_factor else { return };
    page.paragraph(&path(l));
}

fn path(l: &PathFactor) -> String {
    let bound = match l.associative.value {
        Some(v) => format!("the bound by limit analysis is {}", fixed(v, 6)),
        None => "limit analysis gives no bound".into(),
    };
    match l.end {
        PathEnd::Bound if !l.slides => format!(
            "No joint slides along the path, and equilibrium was found up to a thousandth below the bound: the load factor of the path is the proved bound, {}.",
            l.associative.value.map_or(String::new(), |v| fixed(v, 6))
        ),
        PathEnd::Bound => format!(
            "Equilibrium was found up to λ = {} although joints slide; {bound}.",
            fixed(l.reached, 6)
        ),
        PathEnd::NoBalance if l.associative.value.is_some_and(|v| l.reached > NEAR * v) => format!(
            "Beyond λ = {} no displacements were found that balance the loads; {bound}.",
            fixed(l.reached, 6)
        ),
        PathEnd::NoBalance => format!(
            "Beyond λ = {} no displacements balance the loads (computed, not proved); {bound}, which is not reached because joints slide.",
            fixed(l.reached, 6)
        ),
        PathEnd::Unbounded => "The live load has no limit; the path was followed to ten times the load factor at which live and dead loads are equal.".into(),
        PathEnd::Open | PathEnd::None => format!("The path was not followed to its end; {bound}."),
    }
}

/// Numbers, the greatest first.
pub(super) fn rows(page: &mut Page, file: &ResultFile, options: TextOptions) {
    let Some(a) = file.answer.state() else { return };
    if let Some(r) = &a.residuals {
        page.row("conditions", conditions(r));
    }
    if let Some(g) = &a.greatest {
        let pair = g.between.clone().map(|id| base::plain::cell(&id).to_string()).join(" | ");
        page.row(
            "greatest",
            [
                format!(
                    "displacement {} m, of {}",
                    short(g.displacement),
                    base::plain::cell(&g.block)
                ),
                format!("pressure {} Pa, in {pair}", short(g.pressure)),
                format!("opening {} m, slip {} m", short(g.opening), short(g.slip)),
            ],
        );
    }
    let mut blocks: Vec<_> = a.displacements.iter().collect();
    let size = |v: [f64; 3]| v.iter().map(|c| c * c).sum::<f64>().sqrt();
    blocks.sort_by(|x, y| size(y.displacement).total_cmp(&size(x.displacement)));
    let blocks: Vec<String> = blocks
        .into_iter()
        .map(|d| {
            // Rounding says nothing.
            let least = ROUNDING * size(d.displacement);
            let turn = d.rotation.map(|r| if r.abs() > least { r * 1e3 } else { 0.0 });
            format!(
                "{}: {} m, rotated by {} mrad",
                base::plain::cell(&d.block),
                point(d.displacement),
                point(turn)
            )
        })
        .collect();
    page.row("displaced", cut(&blocks, LISTED, options));
    let joints: Vec<String> = a.joints.iter().map(joint).collect();
    page.row("joints", cut(&joints, LISTED, options));
    if !a.frequencies.is_empty() {
        let list: Vec<String> = a.frequencies.iter().map(|f| short(*f)).collect();
        page.row("frequencies", [format!("{} Hz", list.join(", "))]);
    } else if a.greatest.is_some() {
        page.row(
            "frequencies",
            ["not found: the structure is too large, or the computation did not converge"
                .to_string()],
        );
    }
    if let Some(c) = &a.control {
        page.row("control", [format!("{} at {}", base::plain::cell(&c.block), point(c.point))]);
    }
    let curve: Vec<String> = a
        .curve
        .iter()
        .map(|p| format!("λ = {}: {} m", fixed(p.load_factor, 6), point(p.displacement)))
        .collect();
    page.row("curve", cut(&curve, LISTED, options));
    let events: Vec<String> = a.events.iter().map(event).collect();
    page.row("events", cut(&events, LISTED, options));
}

fn conditions(r: &Residuals) -> Vec<String> {
    vec![
        format!("every block balances to {:.1e} of its load", r.balance),
        format!(
            "Signorini: gap >= 0 to {:.1e}, pressure >= 0 to {:.1e}, gap × pressure = 0 to {:.1e}",
            r.gap, r.pressure, r.complementarity
        ),
        format!(
            "Coulomb: within the cone to {:.1e}, slip only at the limit to {:.1e}, against the shear force to {:.1e}",
            r.cone, r.sticking, r.direction
        ),
    ]
}

/// A joint in a line.
fn joint(j: &JointAnswer) -> String {
    let pair = j.between.clone().map(|id| base::plain::cell(&id).to_string()).join(" | ");
    let touch = match (j.touch, j.pressed_share) {
        (Touch::Pressed, _) => "pressed".to_string(),
        (Touch::PartlyOpen, Some(share)) => format!("pressed over {:.1} %", 100.0 * share),
        (Touch::PartlyOpen, None) => "partly open".into(),
        (Touch::Open, _) => "open".into(),
    };
    let grip = match j.grip {
        Grip::Sticks => "",
        Grip::Slips => ", slides in part",
        Grip::Slides => ", slides",
    };
    format!(
        "{pair}: {touch}{grip}, {} N, shear {} N, up to {} Pa",
        short(j.normal_force),
        short(if j.shear_force > ROUNDING * j.normal_force { j.shear_force } else { 0.0 }),
        short(j.greatest_pressure)
    )
}

/// An event in a line.
pub(crate) fn event(e: &Event) -> String {
    let name = match (&e.between, &e.member) {
        (Some(pair), _) => pair.clone().map(|id| base::plain::cell(&id).to_string()).join(" | "),
        (None, member) => base::plain::cell(member.as_deref().unwrap_or_default()).to_string(),
    };
    let what = match e.kind {
        EventKind::Opens => "opens at an edge",
        EventKind::Closes => "closes",
        EventKind::Parts => "separates",
        EventKind::Touches => "touches again",
        EventKind::Slips => "slides in part",
        EventKind::Slides => "slides",
        EventKind::Sticks => "sticks",
        EventKind::Slackens => "goes slack",
        EventKind::Tightens => "goes taut",
        EventKind::Yields => "yields",
        EventKind::Holds => "unloads below its strength",
    };
    format!("λ = {}: {name} {what}", fixed(e.load_factor, 6))
}
