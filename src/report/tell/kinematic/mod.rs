//! Mechanisms under earthquakes for people: a page that can be handed in, each number with its
//! clause.

mod table;

use super::{
    factor,
    path::event,
    telling::{FactorWords, PLAIN, Telling},
};
use crate::text::{
    options::{TextOptions, cut},
    page::{Page, Role},
};
use base::number::{ends, point, rounded_down, rounded_up, short};
use check::{
    kinematic::{Capacity, Elastic, LimitState, Participation, Unique},
    proof::{
        answer::{FactorStatus, LoadFactorAnswer},
        kinematic::KinematicAnswer,
        path::{PathEvent, PathEventKind, PathPoint, PathStatus},
        result::ResultFile,
        told::Direction,
    },
    question::{Question, Verification},
    terms::{Law, Outcome},
    verdict::claim::Claim,
};

pub(super) const TELLING: Telling = Telling {
    verb: "kinematic",
    asked: |_| {
        [
            "At what horizontal acceleration does a mechanism start to move?",
            "α0 is the horizontal push on every mass, as a multiple of its weight, at which the \
             governing mechanism starts.",
        ]
    },
    title,
    why: |page, file| {
        why(page, file);
        site(page, file);
        factor::dry(page, file, ALPHA);
        factor::dead_load(page, file, ALPHA);
    },
    rows,
    factor: Some(ALPHA),
    csv: Some(table::csv),
    charts: |file| table::chart(file).into_iter().collect(),
    ..PLAIN
};

/// What its load factor is called.
const ALPHA: FactorWords =
    FactorWords { name: "α0", without: "without an earthquake", tilt: false };

/// So many masses are shown, and so many points of the curve.
const MASSES: usize = 8;
const POINTS: usize = 12;

/// Seven digits, which is what such numbers are compared by.
fn seven(v: f64) -> String {
    // What is left of a search for zero.
    if v.abs() < 1e-12 {
        return "0".into();
    }
    let decimals = (6 - v.abs().max(1e-300).log10().floor() as i32).clamp(0, 12);
    base::number::fixed(v, decimals.unsigned_abs() as usize)
}

/// α0 with as many digits as are known.
fn alpha(l: &LoadFactorAnswer) -> Option<String> {
    let value = l.value?;
    Some(rounded_down(value))
}

/// α0 in words.
fn start(l: &LoadFactorAnswer) -> (String, Role) {
    let bound = l.associative.found().map(|(.., upper)| rounded_up(upper));
    match (l.status, alpha(l), bound) {
        (FactorStatus::Found, Some(value), Some(bound)) if l.value != l.associative.value => {
            (format!("α0 = {value} with dry friction (proved upper bound {bound})"), Role::Value)
        }
        (FactorStatus::Found, Some(value), _) => (format!("α0 = {value}"), Role::Value),
        (FactorStatus::Unbounded, ..) => {
            ("wedged: no horizontal acceleration moves it".into(), Role::Good)
        }
        (FactorStatus::Impossible, ..) => ("falls, whatever the earthquake".into(), Role::Bad),
        // That it falls without an earthquake is said beside it.
        (FactorStatus::NotAtRest, _, Some(bound))
            if l.associative.upper.is_some_and(|u| u < 0.0) =>
        {
            (format!("α0 at most {bound}"), Role::Bad)
        }
        (FactorStatus::NotAtRest, ..) => {
            ("no α0 with dry friction: the blocks move under the dead load alone".into(), Role::Bad)
        }
        (_, _, Some(bound)) => {
            (format!("α0 at most {bound}; with dry friction undecided"), Role::Unsure)
        }
        _ => ("undecided".into(), Role::Unsure),
    }
}

/// The first line.
pub(super) fn title(file: &ResultFile) -> (String, Role) {
    let Some(a) = file.answer.kinematic() else { return ("undecided".into(), Role::Unsure) };
    let (mut text, mut role) = start(&a.alpha0);
    match (a.numbers.a0, a.numbers.a0_of_bodies) {
        (Some(a0), Some(least)) => {
            text += &format!(
                ", a0 = {} m/s² with blocks that move together as one body ({} block by block),",
                seven(least),
                seven(a0)
            );
        }
        (Some(a0), None) => text += &format!(", a0 = {} m/s²", seven(a0)),
        (None, _) => {}
    }
    text += &format!(" towards {}", point(a.toward));
    if let Some(d) = &a.numbers.demand {
        let meets = |share: f64| {
            let by = |r| format!(", displacement check {} × the demand", rounded_down(r * share));
            let displacement = d.displacement.map_or(String::new(), by);
            format!("linear check {} × the demand{displacement}", rounded_down(d.linear * share))
        };
        let share = a.numbers.participation.as_ref().and_then(|p| p.share_of_bodies());
        text += &format!("; {}", meets(share.unwrap_or(1.0)));
        if share.is_some() {
            text += &format!("; block by block: {}", meets(1.0));
        }
        role = if role == Role::Bad { Role::Bad } else { Role::Good };
    }
    (text, role)
}

/// What of the earthquake of the site is borne, in a sentence that names the verification.
fn site(page: &mut Page, file: &ResultFile) {
    let (Question::Kinematic(o), Some(a)) = (&file.question, file.answer.kinematic()) else {
        return;
    };
    let (Some(d), Some(site)) = (&a.numbers.demand, &file.scene.input.site) else { return };
    let Some(share) = d.governing(o.verify) else {
        page.paragraph("The verification by displacements was asked for, and there is no curve that it could be made on.");
        return;
    };
    let share = a.numbers.of_bodies(share);
    let by_displacement = d.displacement.is_some_and(|least| least < d.linear);
    let (by, chosen) = match o.verify {
        Some(Verification::Linear) => ("linear verification", "as chosen"),
        Some(Verification::Displacement) => ("verification by displacements", "as chosen"),
        None if by_displacement => {
            ("verification by displacements", "the lesser of both; --verify chooses one")
        }
        None => (
            "linear verification",
            if d.displacement.is_some() {
                "the lesser of both; --verify chooses one"
            } else {
                "the only one made"
            },
        ),
    };
    page.paragraph(&format!(
        "The {by} governs ({chosen}; Circolare 7/2019, C8.7.1.2.1): the mechanism bears ζ_E = {} of the earthquake of the site, a peak acceleration on rock of {} m/s² of a_g = {} m/s² (SLV).",
        rounded_down(share),
        rounded_down(share * site.slv.a_g),
        short(site.slv.a_g)
    ));
}

/// The sentences below it.
pub(super) fn why(page: &mut Page, file: &ResultFile) {
    let Some(a) = file.answer.kinematic() else { return };
    if let Some((value, lower, upper)) = a.alpha0.associative.found() {
        let [low, high] = ends(value, lower, upper);
        page.paragraph(&format!(
            "Contact forces inside the friction cones balance the dead load and α × the weight of all masses towards {} up to α0 = {}, between {low} and {high} (both proved). Beyond it the mechanism below moves. It is the governing mechanism among all possible ones; none was assumed.",
            point(a.toward),
            rounded_down(value)
        ));
        let law = match a.alpha0.law {
            Law::Associative => {
                "Joints that slide are taken to open as well (associative): where the mechanism slides, α0 is an upper bound for dry friction."
            }
            Law::Coulomb => {
                "For this bound, joints that slide are taken to open as well (associative); the result with dry friction follows."
            }
        };
        page.paragraph(law);
        let slides = file.mechanism.as_ref().is_some_and(|m| m.joints.iter().any(slides));
        if slides && a.alpha0.found != Some(check::terms::Found::NothingSlides) {
            let whose = if a.alpha0.found == Some(check::terms::Found::FixedPoint) {
                "δ, e* and M* are those of the mechanism with dry friction, not of the one shown."
            } else {
                "δ, e* and M* are those of the mechanism shown, in which joints that slide open as well."
            };
            page.paragraph(&format!("Joints slide in the mechanism of the bound. {whose}"));
        }
    }
    if a.numbers.unique == Some(Unique::OneOfSeveral) {
        page.paragraph("The mechanism is not unique: others that keep the same joints closed start at the same α0. δ, e*, M*, a0 and the curve are those of the mechanism shown; the others have other values.");
    }
    if a.without_members {
        page.paragraph("The curve, d0 and the displacements are those of the scene without its members: once members yield they are not relied on. The mechanism is the same without them.");
    }
    if let Some(curve) = &a.curve_with_members {
        let way = curve.value.map_or("no point".into(), |v| {
            format!("a displacement of the control point of {} m", short(v))
        });
        let end = match (curve.status, &curve.why) {
            (PathStatus::Vanishes, _) => "where it vanishes".to_string(),
            (_, Some(text)) => text.clone(),
            _ => "where it ends".into(),
        };
        page.paragraph(&format!(
            "With its members there is a separate curve, proved at every point, up to {way} ({end}). It assumes that members hold up to their strength at any elongation, so no limit state is read from it."
        ));
    }
    if let Some(text) = &a.no_curve_with_members {
        page.paragraph(&format!("There is no curve with members: {text}."));
    }
    if let Some(text) = &a.no_curve {
        page.paragraph(&format!(
            "There is no curve: {text}. No straight line is drawn in its place."
        ));
    } else if let (Some(curve), None) = (&a.curve, &a.numbers.capacity) {
        let up_to = curve.value.map_or("no point".into(), |v| {
            format!("a displacement of the control point of {} m", short(v))
        });
        let reason = match (curve.status, &curve.why) {
            (PathStatus::Vanishes, _) => {
                "it starts with another mechanism than the one above".to_string()
            }
            (_, Some(text)) => text.clone(),
            _ => "its load factor does not vanish".into(),
        };
        page.paragraph(&format!(
            "The curve is known up to {up_to}: {reason}. There is no d0, and no straight line is drawn in its place."
        ));
    }
    let jumps = |e: &&PathEvent| e.kind == PathEventKind::Jumps;
    if let Some(e) = file.path.as_ref().and_then(|p| p.events.iter().find(jumps)) {
        page.paragraph(&format!(
            "At a displacement of the control point of {} m the motion turns back and jumps to another configuration. What follows holds for slow motion; inertia may carry the structure farther.",
            short(e.value)
        ));
    }
    if let Some(c) = &a.numbers.capacity {
        page.paragraph(&format!(
            "The resistance vanishes at an equivalent displacement of d0 = {} m. Each point of the exact curve is a displaced scene with its own proof; the straight line from a0 to d0 is the simplification used in practice.",
            seven(c.d0)
        ));
    }
}

fn slides(j: &check::proof::told::JointWords) -> bool {
    use check::verdict::mechanism::JointMotion;
    matches!(j.motion, JointMotion::Slide | JointMotion::HingeAndSlide)
}

/// Numbers, masses, curve, limit states, checks.
pub(super) fn rows(page: &mut Page, file: &ResultFile, options: TextOptions) {
    let Some(a) = file.answer.kinematic() else { return };
    linear(page, a);
    if let Some(p) = &a.numbers.participation {
        page.row("masses", cut(&masses(p), MASSES, options));
    }
    if let (Some(c), Some(delta)) = (&a.control, a.numbers.control_delta) {
        page.row("control", [format!("{} at {}, δ = {}", c.block, point(c.point), seven(delta))]);
    }
    if let Some(path) = &file.path {
        let events: Vec<String> = path.events.iter().map(|e: &PathEvent| event(path, e)).collect();
        page.row("events", cut(&events, POINTS, options));
        let lines: Vec<String> = thinned(&path.points, options)
            .into_iter()
            .map(|p| match (a.numbers.capacity, &a.numbers.participation, p.load_factor) {
                (Some(c), Some(m), Some(l)) => {
                    let gravity = gravity(file);
                    format!(
                        "d = {:<10} a = {} m/s²   (d_C = {} m, {})",
                        short(c.d_over_control * p.value),
                        seven(m.acceleration(l, gravity, a.fc)),
                        short(p.value),
                        factor(p)
                    )
                }
                _ => format!("d_C = {:<10} {}", short(p.value), factor(p)),
            })
            .collect();
        page.row("curve", lines);
    }
    if let Some(c) = &a.numbers.capacity {
        page.row("states", limit_states(c));
    }
    if let Some(d) = &a.numbers.demand {
        let floor = d.gamma_1.zip(d.a_z).map(|(gamma, a_z)| {
            format!(
                "γ1 = 3n/(2n+1) = {}, a_Z = S_e(T1, ξ1) γ1 ψ1 √(1 + 0.0004 ξ1²) = {} m/s², ξ1 in percent (Circolare 7/2019, C7.2.3)",
                seven(gamma),
                seven(a_z)
            )
        });
        let checks = d.checks.iter().map(|c| {
            format!(
                "{}: {} against {}, ratio {}",
                c.what,
                seven(c.capacity),
                seven(c.demand),
                seven(c.ratio)
            )
        });
        let left = d.left_out.iter().map(|t| format!("not checked: {t}"));
        page.row("spectra", spectra(file));
        let source = "spectra of NTC 2018, 3.2.3.2; ratios are those of accelerations, with the periods of the spectrum kept fixed".to_string();
        page.row("site", floor.into_iter().chain(checks).chain([source]).chain(left));
    }
    directions(page, &file.directions, options);
}

/// The load factor of a point.
fn factor(p: &PathPoint) -> String {
    match p.certificate.claim {
        Some(Claim::LoadFactor { value, .. }) => {
            format!("α = {}", rounded_down(value))
        }
        _ => "not proved".into(),
    }
}

fn gravity(file: &ResultFile) -> f64 {
    file.scene.input.gravity.iter().map(|c| c * c).sum::<f64>().sqrt()
}

fn linear(page: &mut Page, a: &KinematicAnswer) {
    let Some(p) = &a.numbers.participation else { return };
    let mut lines = vec![
        format!(
            "e* = (Σ(P+Q)δ)² / (Σ(P+Q) Σ(P+Q)δ²) = {} (Circolare 7/2019, C8.7.1.2.1)",
            seven(p.e_star)
        ),
        format!(
            "M* = e* Σ(P+Q) / g = {} kg, with a moving weight of Σ(P+Q) = {} N",
            seven(p.mass),
            seven(p.weight)
        ),
        format!("FC = {}", a.fc),
    ];
    if let (Some(a0), Some(alpha)) = (a.numbers.a0, a.alpha0.value) {
        lines.push(format!("a0 = α0 g / (e* FC) = {} m/s², α0 = {}", seven(a0), seven(alpha)));
    }
    if let Some((value, lower, upper)) = a.alpha0.associative.found()
        && let Some(a0) = a.numbers.a0
        && a.alpha0.value == Some(value)
        && value != 0.0
    {
        let [low, high] = [lower, upper].map(|v| a0 * v / value);
        let [low, high] = ends(a0, low, high);
        lines.push(format!("a0 lies between {low} and {high} m/s², from the bracket of α0"));
    }
    if let Some(least) = a.numbers.a0_of_bodies {
        lines.push(format!(
            "with blocks that move together as one body: e* = {}, a0 = {} m/s²; displacements and ratios of the site decrease by about the same factor",
            seven(p.e_star_of_bodies),
            seven(least)
        ));
    }
    page.row("linear", lines);
}

fn masses(p: &Participation) -> Vec<String> {
    p.masses
        .iter()
        .map(|m| {
            let kind = match m.kind {
                check::kinematic::MassKind::Block => "P",
                check::kinematic::MassKind::Rests => "P on",
                check::kinematic::MassKind::Pushes => "Q on",
            };
            format!(
                "{kind} {}: {} N at {}, δ = {}",
                m.block,
                seven(m.weight),
                point(m.at),
                seven(m.delta)
            )
        })
        .collect()
}

fn limit_states(c: &Capacity) -> Vec<String> {
    let state = |word: &str, share: f64, factor: f64, s: LimitState| {
        format!(
            "{word}: d = {share} d0 = {} m, a = {} m/s², T = {factor} π √(d/a) = {} s",
            seven(s.d),
            seven(s.a),
            seven(s.period)
        )
    };
    let both = |name: &str, s: check::kinematic::States| {
        [
            format!("{name}, {}", state("SLV", 0.4, 1.68, s.slv)),
            format!("{name}, {}", state("SLC", 0.6, 1.56, s.slc)),
        ]
    };
    let exact = c.exact.map(|s| both("exact curve", s)).into_iter().flatten();
    exact.chain(both("straight line", c.straight)).collect()
}

/// The spectra that are demanded, with the periods that nobody gave.
fn spectra(file: &ResultFile) -> Vec<String> {
    let Some(site) = &file.scene.input.site else { return Vec::new() };
    let slc = site.slc.iter().map(|s| ("SLC", s));
    let mut lines: Vec<String> = [("SLV", &site.slv)]
        .into_iter()
        .chain(slc)
        .map(|(word, s)| {
            let e = Elastic::new(s, gravity(file));
            format!(
                "{word}: a_g = {} m/s², F0 = {}, S = {}, T_B = {} s, T_C = {} s, T_D = {} s",
                short(s.a_g),
                short(s.f_0),
                short(s.s),
                short(e.t_b),
                short(e.t_c),
                short(e.t_d)
            )
        })
        .collect();
    if let Some(b) = &site.building {
        lines.push(format!(
            "building: T1 = {} s, {} storeys, H = {} m, z = {} m, ξ1 = {} %",
            short(b.t_1),
            b.storeys,
            short(b.height),
            short(b.z),
            short(b.damping_percent.unwrap_or(check::kinematic::DAMPING))
        ));
    }
    lines
}

/// All points where there is room for them, else as many, evenly spread.
fn thinned(points: &[PathPoint], options: TextOptions) -> Vec<&PathPoint> {
    if options.verbose || points.len() <= POINTS {
        return points.iter().collect();
    }
    (0..POINTS).map(|k| &points[k * (points.len() - 1) / (POINTS - 1)]).collect()
}

fn directions(page: &mut Page, list: &[Direction], options: TextOptions) {
    // Eight directions are what is asked for by default: they are shown in full.
    let options = TextOptions { verbose: options.verbose || list.len() <= 8, ..options };
    let said = || list.iter().filter_map(|d| d.answer.kinematic());
    let width = said().map(|a| point(a.toward).chars().count()).max().unwrap_or(0);
    let lines: Vec<String> = said()
        .map(|a| {
            let a0 = a.numbers.a0.map_or(String::new(), |v| format!(", a0 = {} m/s²", seven(v)));
            let ratio = a
                .numbers
                .demand
                .as_ref()
                .map_or(String::new(), |d| format!(", {} × the demand", short(d.ratio)));
            let bound = match a.alpha0.associative.status {
                Outcome::Unbounded if a.alpha0.value.is_none() => "without a limit".to_string(),
                _ => start(&a.alpha0).0,
            };
            format!("{:<width$}  {bound}{a0}{ratio}", point(a.toward))
        })
        .collect();
    page.row("towards", cut(&lines, 6, options));
}
