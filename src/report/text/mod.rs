//! Answers as text for people: the answer first, then why, then what next.

pub(crate) mod bridge;
mod checked;
pub(crate) mod heaps;
pub(crate) mod left_out;
mod mechanism;
pub(crate) mod options;
mod packing;
pub(crate) mod page;
mod template;

pub use checked::{inspection, verification};
pub use heaps::heaps;
pub use left_out::left_out;
pub use options::TextOptions;
use options::{SHOWN, cut};
pub use packing::packing;
pub use page::{Layout, Page, Role, Span};
pub use template::template;

use crate::tell;
use analysis::Attempt;
use base::number::{count, seconds};
use check::{
    proof::{result::ResultFile, work::Work},
    verdict::{claim::Claim, exact::Grade},
};
use solve::Engine;

/// How a question was put, for the commands that may come next.
#[derive(Clone, Copy, Debug, Default)]
pub struct Asked<'a> {
    /// The scene, as one types it.
    pub scene: &'a str,
    /// The options that another answer would need to be the same, as one types them.
    pub options: &'a str,
    /// The joints that are used most, in words.
    pub weak: &'a [String],
}

/// So many findings are shown, which take several lines each.
const NOTES: usize = 3;

/// A result as a page.
pub fn render(file: &ResultFile, asked: Asked, options: TextOptions, layout: Layout) -> Page {
    let mut page = Page::new(layout);
    tell::title(&mut page, file);
    if options.brief {
        return page;
    }
    let telling = tell::telling(file);
    page.blank();
    (telling.why)(&mut page, file);
    page.blank();
    mechanism::rows(&mut page, file, options);
    mechanism::members(&mut page, file, options);
    page.row("weak joints", asked.weak.iter().cloned());
    (telling.rows)(&mut page, file, options);
    tell::sensitivity::rows(&mut page, file, options);
    tell::part(&mut page, file);
    tell::digits(&mut page, file, options);
    page.row("proof", proof(file, options));
    let s = &file.scene.counts;
    page.row(
        "scene",
        [format!(
            "{} ({}), {}, {}{}",
            count(s.blocks, "block"),
            count(s.supports, "support"),
            count(s.interfaces, "interface"),
            count(s.contact_points, "contact point"),
            with_members(s.members)
        )],
    );
    bridge::rows(&mut page, file);
    page.row("doubt", file.run.doubt.iter().map(|d| format!("{}; {}", d.evidence, d.next)));
    if options.verbose {
        page.row("reduced", file.run.left_out.iter().cloned());
    } else {
        page.row("reduced", reduced(file));
        let replaced = file.run.left_out.iter().filter(|line| line.contains("replaces them"));
        page.row("left out", replaced.cloned());
    }
    page.row(
        "note",
        cut(&file.warnings().map(|f| f.text.clone()).collect::<Vec<_>>(), NOTES, options),
    );
    page.row("time", [time(file)]);
    if options.verbose {
        let done = file.run.work.iter().filter(|w| w.attempts + w.fixed_points > 0);
        page.row("work", done.map(work));
        page.row("attempts", file.run.trace.iter().map(attempt));
    }
    page.blank();
    page.commands("next", &tell::next(file, asked.scene, &command(file, asked)));
    page
}

/// What proves the answer, in a line; what was computed to verify it for who asks for everything.
fn proof(file: &ResultFile, options: TextOptions) -> Vec<String> {
    let verified = file.certificate.verified();
    let Some(words) = file.certificate.claim.as_ref().map(evidence) else { return verified };
    let line = match file.answer.proof() {
        Some(Grade::ToRounding(by)) => format!("proved to rounding ({by:.0e}): {words}"),
        Some(Grade::Exact) => format!("proved exactly: {words}"),
        None => format!("proved: {words}"),
    };
    let all = verified.into_iter().filter(|_| options.verbose);
    std::iter::once(line).chain(all).collect()
}

/// The evidence of a claim.
fn evidence(claim: &Claim) -> &'static str {
    match claim {
        Claim::Stable => "balanced forces inside all friction cones",
        Claim::Conditional => {
            "balanced forces inside all friction cones, and a motion that obeys Coulomb's law without their self-stress"
        }
        Claim::Unstable => "a mechanism that gains power while no joint closes",
        Claim::LoadFactor { .. } => "balanced forces below the value, a mechanism above it",
        Claim::DryLoadFactor { .. } => "forces and a mechanism that together obey Coulomb's law",
        Claim::Unbounded { .. } => "forces that balance the live load alone",
        Claim::Impossible => "a mechanism that gains power, whatever the live load",
        Claim::Thrust { .. } | Claim::MemberForce { .. } => {
            "balanced forces up to each end, a mechanism beyond it"
        }
        Claim::EndlessMemberForce { .. } | Claim::EndlessThrust { .. } => {
            "forces that balance without any load"
        }
    }
}

/// What made the programs smaller, without its numbers.
fn reduced(file: &ResultFile) -> Option<String> {
    let by: Vec<&str> = file
        .run
        .left_out
        .iter()
        // What acts in the place of something else makes nothing smaller.
        .filter(|line| !line.contains("replaces them"))
        .filter_map(|line| line.split([':', '(']).next())
        .map(str::trim)
        .collect();
    (!by.is_empty()).then(|| format!("{}; nothing is neglected", by.join(", ")))
}

/// How many members there are beside the contacts.
fn with_members(members: usize) -> String {
    if members > 0 { format!(", {}", count(members, "member")) } else { String::new() }
}

fn time(file: &ResultFile) -> String {
    let t = &file.run.timings;
    let stages = [
        ("read", t.read),
        ("resolve", t.resolve),
        ("interfaces", t.detect),
        ("solve", t.solve),
        ("simulate", t.simulate),
        ("check", t.check),
    ];
    let list: Vec<String> = stages
        .iter()
        .filter(|s| s.1 > 0.0)
        .map(|(name, s)| format!("{name} {}", seconds(*s)))
        .collect();
    format!("{} ({})", seconds(stages.iter().map(|s| s.1).sum()), list.join(", "))
}

fn work(w: &Work) -> String {
    let memory = w
        .peak_memory
        .map_or(String::new(), |b| format!(", at most {:.0} MB of memory", b as f64 / 1e6));
    format!(
        "{} and {} of fixed points, {} iterations; the largest has {} unknowns and {} rows, of {} forces and {} equations before omissions{memory}",
        count(w.attempts, "program"),
        w.fixed_points,
        w.iterations,
        w.largest[0],
        w.largest[1],
        w.full[0],
        w.full[1]
    )
}

fn attempt(a: &Attempt) -> String {
    let status = format!("{:?}", a.engine_status);
    let how = match a.regularization {
        Some(regularization) if a.engine == Engine::Clarabel => {
            format!("regularisation {regularization:.0e}")
        }
        _ => "on the stiffness matrix of the blocks".to_string(),
    };
    format!(
        "{}: {} unknowns, {} rows, tolerance {:.0e}, {how}: {} iterations, {}, {status}, bracket {:.9e} to {:.9e}",
        a.program,
        a.size[0],
        a.size[1],
        a.tolerance,
        a.iterations,
        seconds(a.seconds),
        a.lower,
        a.upper
    )
}

/// The command that asks the same again.
pub fn command(file: &ResultFile, asked: Asked) -> String {
    let scene = asked.scene;
    let verb = tell::telling(file).verb;
    if asked.options.is_empty() {
        format!("voussoir {verb} {scene}")
    } else {
        format!("voussoir {verb} {scene} {}", asked.options)
    }
}
