//! Paths for people.

mod table;

use super::telling::{PLAIN, Telling};
use crate::text::{
    options::{TextOptions, cut},
    page::{Page, Role},
};
use base::number::{count, fixed, point, rounded_down, rounded_up, short};
use check::question::{Question, QuestionKind};
use check::{
    proof::{
        path::{DrivenBy, PathAnswer, PathEvent, PathEventKind, PathPoint, PathResult, PathStatus},
        result::ResultFile,
    },
    verdict::claim::Claim,
};
use table::{along, bound, happens};

pub(super) const SETTLE: Telling = Telling {
    verb: "settle",
    asked: |_| {
        [
            "How far can supports move before it falls?",
            "The answer is a share of the imposed movement, with its length in metres.",
        ]
    },
    title,
    why,
    rows,
    csv: Some(table::csv),
    charts: |file| table::chart(file).into_iter().collect(),
    ..PLAIN
};

pub(super) const PUSH: Telling = Telling {
    verb: "push",
    asked: |_| {
        [
            "How does the load factor change as the mechanism moves?",
            "λ multiplies the live loads; displacements are those of the control point, in metres.",
        ]
    },
    title,
    why,
    rows,
    csv: Some(table::csv),
    charts: |file| table::chart(file).into_iter().collect(),
    ..PLAIN
};

/// So many points are shown.
const POINTS: usize = 12;
/// So many supports are named.
const FEW: usize = 3;

/// The way of the support that goes farthest, m, where any goes straight.
fn farthest(path: &PathResult) -> Option<f64> {
    let DrivenBy::Supports(list) = &path.driven_by else { return None };
    let length = |w: &[f64; 3]| w.iter().map(|c| c * c).sum::<f64>().sqrt();
    Some(list.iter().map(|m| length(&m.way)).fold(0.0, f64::max)).filter(|l| *l > 0.0)
}

/// A value of the parameter, and what it is in metres.
fn at(path: &PathResult, value: f64, decimals: usize) -> String {
    let number = fixed(value, decimals);
    match farthest(path) {
        Some(way) => format!("{number} of the imposed movement ({} m)", short(way * value)),
        None if matches!(path.driven_by, DrivenBy::Supports(_)) => {
            format!("{number} of the imposed movement")
        }
        None => format!("{number} m"),
    }
}

/// The first line.
pub(super) fn title(file: &ResultFile) -> (String, Role) {
    let (Some(a), Some(path)) = (file.answer.path(), &file.path) else {
        return ("undecided".into(), Role::Unsure);
    };
    let (text, role) = followed(a, path);
    match (a.jumps_at, role) {
        (None, _) => (text, role),
        (Some(v), role) => (
            format!(
                "jumps at {}; after the jump, whose motion is not traced, {text}",
                at(path, v, 6)
            ),
            if role == Role::Good { Role::Unsure } else { role },
        ),
    }
}

fn followed(a: &PathAnswer, path: &PathResult) -> (String, Role) {
    let known = a.value.map(|v| at(path, v, 6));
    let up_to = known.clone().unwrap_or_else(|| "nowhere".into());
    match (a.status, a.value, a.falls_at) {
        (PathStatus::Falls, Some(lower), Some(_)) => {
            let number = rounded_down(lower);
            let way = farthest(path)
                .map_or(String::new(), |w| format!(" ({} m)", rounded_down(w * lower)));
            let unit = if matches!(path.driven_by, DrivenBy::Supports(_)) {
                "of the imposed movement"
            } else {
                "m"
            };
            (format!("stands up to {number} {unit}{way}, then falls"), Role::Bad)
        }
        (PathStatus::Reached, Some(_), _) => {
            ("stands through the whole imposed movement".into(), Role::Good)
        }
        (PathStatus::Vanishes, Some(_), _) => {
            (format!("the load factor vanishes at {up_to}"), Role::Value)
        }
        (PathStatus::Slides, Some(0.0), _) => {
            let push = a.least_reaction.filter(|_| farthest(path).is_some()).map(|l| {
                let value = rounded_down(l.value);
                format!("the thrust on the supports does at least {value} N·m of work as they begin to move; ")
            });
            let text =
                format!("{}a joint slides immediately, undecided beyond", push.unwrap_or_default());
            (text, Role::Unsure)
        }
        (PathStatus::Slides, Some(_), _) => (
            format!("followed up to {up_to}, where a joint slides; undecided beyond"),
            Role::Unsure,
        ),
        (_, Some(_), _) => (format!("followed up to {up_to}, undecided beyond"), Role::Unsure),
        _ => ("undecided".into(), Role::Unsure),
    }
}

/// The sentences below it.
pub(super) fn why(page: &mut Page, file: &ResultFile) {
    let Some(a) = file.answer.path() else { return };
    match a.status {
        PathStatus::Falls => page.paragraph(
            "The motion is followed with finite rotations. At the last value, contact forces inside the friction cones balance the loads of the displaced scene. At the next value no forces do, and no other equilibrium was found where the mechanism leads.",
        ),
        PathStatus::Slides => page.paragraph(
            "In limit analysis a joint that slides also opens; a dry joint does not, so that motion is wrong beyond the first instant. No motion with dry friction was found that continues the path.",
        ),
        PathStatus::Reached | PathStatus::Vanishes | PathStatus::Open => {}
    }
    if let Some(text) = &a.why {
        page.paragraph(&format!("Not followed further: {text}."));
    }
    let asked = match &file.question {
        Question::Settle(o) => &o.at[..],
        Question::Push(o) => &o.at[..],
        _ => &[],
    };
    let missed = asked.iter().filter(|v| a.value.is_none_or(|last| **v > last));
    let missed: Vec<String> = missed.map(|v| short(*v)).collect();
    if !missed.is_empty() {
        page.paragraph(&format!("Asked for with --at but not reached: {}.", missed.join(", ")));
    }
    let events = file.path.iter().flat_map(|p| &p.events);
    if events.into_iter().any(|e| e.kind == PathEventKind::Slides) {
        page.paragraph("Where joints slide, the motion follows dry friction: they slide without opening, against μ × the normal force. Other states may also be admissible.");
    }
    if file.question.kind() == QuestionKind::Push {
        page.paragraph("At each point the load factor is that of the displaced scene: forces prove its lower end, a mechanism its upper end. The control point moves with the mechanism. Where joints slide with dry friction, forces and a mechanism that obey Coulomb's law together give the load factor, and it is at most the bound listed.");
    }
    page.paragraph("Every point is a displaced scene with its own proof. That the structure passes through these poses is computed, not proved.");
}

/// The curve, its events and its ends.
pub(super) fn rows(page: &mut Page, file: &ResultFile, options: TextOptions) {
    let (Some(a), Some(path)) = (file.answer.path(), &file.path) else { return };
    if let Some(l) = a.least_reaction {
        let unit =
            if farthest(path).is_some() { "N·m for the whole imposed movement" } else { "J" };
        let text = format!(
            "{} {unit}, as the supports begin to move (between {} and {})",
            short(l.value),
            short(l.lower),
            short(l.upper)
        );
        page.row("reaction", [text]);
    }
    let events: Vec<String> = path.events.iter().map(|e| event(path, e)).collect();
    page.row("events", cut(&events, POINTS, options));
    let points: Vec<String> =
        thinned(&path.points, options).into_iter().map(|p| line(path, p)).collect();
    page.row("curve", points);
    if let Some(last) = path.points.last() {
        let hinges: Vec<String> = last
            .hinges
            .iter()
            .map(|h| {
                let [a, b] = &h.between;
                format!("{a} | {b}, open by {} m, touching at {}", short(h.width), point(h.at))
            })
            .collect();
        page.row("hinges", cut(&hinges, POINTS, options));
        let slips: Vec<String> = last
            .slips
            .iter()
            .map(|s| {
                let [a, b] = &s.between;
                format!("{a} | {b}, by {} m, touching at {}", short(s.way), point(s.at))
            })
            .collect();
        page.row("slips", cut(&slips, POINTS, options));
    }
    for (label, p) in ["stands at", "falls at"].iter().zip(&path.ends) {
        let head = format!("{}, proved:", p.value);
        let proof = p.certificate.verified().into_iter().map(|v| format!("  {v}"));
        page.row(label, std::iter::once(head).chain(proof));
    }
    let proved = path.points.iter().filter(|p| p.certificate.claim.is_some()).count();
    page.row(
        "proof",
        [format!(
            "{} of {} proved, each from its own poses",
            proved,
            count(path.points.len(), "point")
        )],
    );
    if file.run.between > 0 {
        let text = "between the points: closed joints stayed closed, no blocks overlapped and forces inside the friction cones were found (computed; no load factor is proved there)";
        page.row("in between", [format!("{} {text}", count(file.run.between, "pose"))]);
    }
}

/// All points where there is room for them, else as many, evenly spread.
fn thinned(points: &[PathPoint], options: TextOptions) -> Vec<&PathPoint> {
    if options.verbose || points.len() <= POINTS {
        return points.iter().collect();
    }
    (0..POINTS).map(|k| &points[k * (points.len() - 1) / (POINTS - 1)]).collect()
}

fn line(path: &PathResult, p: &PathPoint) -> String {
    let head = format!("{:<10}", short(p.value));
    match p.certificate.claim {
        Some(Claim::LoadFactor { upper, .. }) if p.load_factor.is_none() => {
            format!("{head} λ at most {}, the bound", rounded_up(upper))
        }
        Some(Claim::LoadFactor { value, .. }) => {
            format!("{head} λ = {}", rounded_down(value))
        }
        Some(Claim::DryLoadFactor { value }) => {
            let most = bound(p).map_or(String::new(), |b| format!(", at most {}", rounded_up(b)));
            format!("{head} λ = {} with dry friction{most}", fixed(value, 6))
        }
        Some(Claim::Stable) => {
            let all = along(path, p);
            if all.is_empty() {
                return format!("{head} stands");
            }
            if all.len() > FEW {
                let least = all.iter().map(|f| f.1).fold(f64::INFINITY, f64::min);
                let greatest = all.iter().map(|f| f.1).fold(f64::NEG_INFINITY, f64::max);
                return format!(
                    "{head} stands; reactions along the movements of {} supports from {} N to {} N",
                    all.len(),
                    short(least),
                    short(greatest)
                );
            }
            let forces: Vec<String> =
                all.into_iter().map(|(id, f)| format!("{id} {} N", short(f))).collect();
            format!("{head} stands; reaction along the movement: {}", forces.join(", "))
        }
        _ => format!("{head} not proved"),
    }
}

pub(super) fn event(path: &PathResult, e: &PathEvent) -> String {
    format!("{}: {}", at(path, e.value, 6), happens(e))
}
