//! What came out, in words.

use super::{CrossCount, Crossed, Differs, FAMILIES, count};
use report::text::{Layout, Page, Role};

/// How many scenes are named where not all are asked for.
const NAMED: usize = 8;

/// The scenes as a page: sums by family, then what is not as it should be.
pub fn text(list: &[Crossed], seed: u64, verbose: bool, layout: Layout) -> Page {
    let mut page = Page::new(layout);
    let all = count(list, |_| true);
    let role = if all.wrong > 0 { Role::Bad } else { Role::Good };
    let share = 100.0 * all.undecided as f64 / all.scenes.max(1) as f64;
    let title = format!(
        "{} scenes, {} with a contradiction, {} undecided ({share:.2} %)",
        all.scenes, all.wrong, all.undecided
    );
    page.title("One scene, several ways", title, role);
    page.blank();
    for family in FAMILIES {
        page.row(family, sums(&count(list, |c| c.family == family)));
    }
    page.row("all", sums(&all));
    let names = |of: &dyn Fn(&Crossed) -> &[Differs]| -> Vec<String> {
        let lines: Vec<String> =
            list.iter().flat_map(|c| of(c).iter().map(|d| line(c, d, seed))).collect();
        let shown = if verbose { lines.len() } else { lines.len().min(NAMED) };
        let more = (shown < lines.len())
            .then(|| format!("… and {} more (--verbose for all)", lines.len() - shown));
        lines[..shown].iter().cloned().chain(more).collect()
    };
    page.row("wrong", names(&|c| &c.wrong));
    page.row("lost", names(&|c| &c.lost));
    page.row("differ", names(&|c| &c.apart));
    page.row(
        "refused",
        list.iter().filter_map(|c| {
            Some(format!("{seed}/{}: {}: {}", c.index, c.family, c.error.as_ref()?))
        }),
    );
    page
}

fn sums(c: &CrossCount) -> Vec<String> {
    let mut lines = vec![
        format!(
            "{} scenes: {} stand, {} with self-stress, {} fall, {} undecided, {} refused; {} bounds on load factors, {} values with dry friction",
            c.scenes, c.stable, c.conditional, c.unstable, c.undecided, c.refused, c.bounds, c.dry
        ),
        format!(
            "{} other ways: {} with a contradiction, {} answers lost; {} of {} unions the same to the last bit",
            c.ways, c.wrong, c.lost, c.same, c.unions
        ),
    ];
    if c.simulated > 0 {
        let open = c.simulated - c.agree - c.apart;
        lines.push(format!(
            "{} simulated beside the load factor: {} agree, {open} open, {} differ",
            c.simulated, c.agree, c.apart
        ));
    }
    lines
}

fn line(c: &Crossed, d: &Differs, seed: u64) -> String {
    format!("{seed}/{}: {} of {} blocks, {}: {}", c.index, c.family, c.blocks, d.way.word(), d.what)
}
