//! What came out, in words.

use super::Forged;
use report::text::{Layout, Page, Role};
use std::collections::BTreeMap;

/// How many forgeries are named where not all are asked for.
const NAMED: usize = 12;

/// The forgeries as a page: sums by kind, then those that were accepted.
pub fn text(list: &[Forged], seed: u64, verbose: bool, layout: Layout) -> Page {
    let mut page = Page::new(layout);
    let made: usize = list.iter().map(Forged::count).sum();
    let accepted: usize = list.iter().map(|f| f.accepted.len()).sum();
    let role = if list.iter().any(Forged::is_wrong) { Role::Bad } else { Role::Good };
    page.title(
        "Forged results",
        format!("{made} of {} scenes, {accepted} accepted", list.len()),
        role,
    );
    page.blank();
    let mut kinds: BTreeMap<&str, [usize; 2]> = BTreeMap::new();
    for f in list {
        f.made.iter().for_each(|(kind, count)| kinds.entry(kind).or_default()[0] += count);
        f.accepted.iter().for_each(|a| kinds.entry(&a.kind).or_default()[1] += 1);
    }
    page.row(
        "kinds",
        kinds.into_iter().map(|(kind, [made, accepted])| {
            format!("{kind:<20} {made:>8} made {accepted:>6} accepted")
        }),
    );
    let mut results: BTreeMap<&str, usize> = BTreeMap::new();
    list.iter()
        .flat_map(|f| &f.results)
        .for_each(|(name, count)| *results.entry(name).or_default() += count);
    page.row(
        "results",
        [results
            .into_iter()
            .map(|(name, count)| format!("{count} of {name}"))
            .collect::<Vec<_>>()
            .join(", ")],
    );
    let (seconds, verifying): (f64, f64) =
        list.iter().fold((0.0, 0.0), |sum, f| (sum.0 + f.seconds, sum.1 + f.verifying));
    page.row(
        "time",
        [format!(
            "{seconds:.0} s, {verifying:.0} s of them to verify: {:.2} ms a forgery",
            1e3 * verifying / made.max(1) as f64
        )],
    );
    let lines: Vec<String> = list
        .iter()
        .flat_map(|f| {
            f.accepted.iter().map(move |a| {
                format!("{seed}/{}: {}, {}: {}: {}", f.index, f.family, a.question, a.kind, a.what)
            })
        })
        .collect();
    let shown = if verbose { lines.len() } else { lines.len().min(NAMED) };
    let more = (shown < lines.len())
        .then(|| format!("… and {} more (--verbose for all)", lines.len() - shown));
    page.row("accepted", lines[..shown].iter().cloned().chain(more));
    page.row(
        "refused",
        list.iter().filter_map(|f| {
            Some(format!("{seed}/{}: {}: {}", f.index, f.family, f.error.as_ref()?))
        }),
    );
    page
}
