//! What came out, in words.

use super::{FAMILIES, Perturbation, SoakCount, Soaked, count};
use check::verdict::Verdict;
use report::text::{Layout, Page, Role};

/// The perturbations, in the order of the table.
const PERTURBATIONS: [Perturbation; 6] = [
    Perturbation::Gaps,
    Perturbation::Rotations,
    Perturbation::Missing,
    Perturbation::Pushed,
    Perturbation::Uneven,
    Perturbation::Moved,
];

/// How many scenes are named where not all are asked for.
const NAMED: usize = 8;

/// The soak as a page: sums by family and by perturbation, then what is not as it should be.
pub fn text(list: &[Soaked], seed: u64, verbose: bool, layout: Layout) -> Page {
    let mut page = Page::new(layout);
    let all = count(list, |_| true);
    let role = if all.wrong > 0 { Role::Bad } else { Role::Good };
    let share = 100.0 * all.undecided as f64 / all.scenes.max(1) as f64;
    let title = format!(
        "{} scenes, {} wrong, {} undecided ({share:.2} %)",
        all.scenes, all.wrong, all.undecided
    );
    page.title("Random scenes", title, role);
    page.blank();
    for family in FAMILIES {
        page.row(family, sums(&count(list, |s| s.family == family)));
    }
    for p in PERTURBATIONS {
        page.row(&word(p), sums(&count(list, |s| s.perturbations.contains(&p))));
    }
    page.row("all", sums(&all));
    let names = |of: &dyn Fn(&Soaked) -> bool| -> Vec<String> {
        let these: Vec<&Soaked> = list.iter().filter(|s| of(s)).collect();
        let shown = if verbose { these.len() } else { these.len().min(NAMED) };
        let more = (shown < these.len())
            .then(|| format!("… and {} more (--verbose for all)", these.len() - shown));
        these[..shown].iter().map(|s| line(s, seed)).chain(more).collect()
    };
    page.row("wrong", names(&Soaked::is_wrong));
    page.row("undecided", names(&|s| s.verdict == Some(Verdict::Undecided)));
    page.row("differ", names(&|s| s.agrees == Some(false)));
    page.row("refused", names(&|s| s.error.is_some()));
    page
}

fn sums(c: &SoakCount) -> Vec<String> {
    let verdicts = format!(
        "{} scenes: {} stand, {} with self-stress, {} fall, {} undecided ({} unproved), {} refused, {} wrong",
        c.scenes, c.stable, c.conditional, c.unstable, c.undecided, c.unproved, c.refused, c.wrong
    );
    if c.simulated == 0 {
        return vec![verdicts];
    }
    let simulated = format!(
        "{} simulated: {} agree, {} open; {} differ near a flip, {} where contacts were left out, {} elsewhere",
        c.simulated, c.agree, c.open, c.near, c.left_out, c.disagree
    );
    vec![verdicts, simulated]
}

fn line(s: &Soaked, seed: u64) -> String {
    let what: Vec<String> = s.perturbations.iter().map(|p| word(*p)).collect();
    let mut text = format!("{seed}/{}: {} of {} blocks", s.index, s.family, s.blocks);
    if !what.is_empty() {
        text.push_str(&format!(" ({})", what.join(", ")));
    }
    for (name, verdict) in
        [("", s.verdict), ("unproved: ", s.unproved), ("everything kept: ", s.kept)]
    {
        text.extend(verdict.map(|v| format!("; {name}{v:?}").to_lowercase()));
    }
    text.extend(s.fate.map(|f| format!("; simulation: {f:?}").to_lowercase()));
    text.extend(s.difference.map(|d| format!(" ({d:?})").to_lowercase()));
    text.extend(s.error.as_ref().map(|e| format!("; {e}")));
    text
}

fn word(p: Perturbation) -> String {
    format!("{p:?}").to_lowercase()
}
