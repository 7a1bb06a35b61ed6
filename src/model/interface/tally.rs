//! What detection closed, left apart or ignored, counted, and said in sentences.

use super::{
    faces::{Closing, Gap},
    left_out::LeftOut,
    limits::{self, Limits},
};
use crate::assembly::Assembly;
use base::error::{Finding, FindingCode};

/// Running counts.
#[derive(Debug, Default)]
pub(super) struct Tally {
    closed: Extreme,
    pressed: Extreme,
    small: Extreme,
    near: Vec<(Apart, usize, usize)>,
    /// Round blocks near each other or near a wall: neighbours in a packing, not faces that fail to
    /// meet.
    neighbours: Vec<(f64, usize, usize)>,
    /// `(depth, what would close it, a, b)`
    overlaps: Vec<(f64, Option<Apart>, usize, usize)>,
    without_normal: Vec<(usize, usize)>,
    flattened: Vec<(usize, usize)>,
    held_apart: Vec<(usize, usize)>,
    twice: Vec<(usize, usize)>,
    /// Most blocks that are the same to the last bit.
    heap: Vec<usize>,
}

/// What keeps two blocks from touching.
#[derive(Clone, Copy, Debug)]
struct Apart {
    /// m
    gap: f64,
    /// `contact.gap` that closes it.
    relative: f64,
    /// `contact.angle_deg` that accepts it, where the one given does not.
    angle: Option<f64>,
}

impl Apart {
    fn new(closing: Closing, limits: &Limits) -> Self {
        let gap = closing.gap.max(0.0);
        let angle = (closing.lean > limits.chord).then(|| limits::degrees(closing.lean));
        Self { gap, relative: gap / limits.size, angle }
    }
}

/// A count and the greatest value.
#[derive(Debug, Default)]
struct Extreme {
    count: usize,
    greatest: f64,
}

impl Extreme {
    fn add(&mut self, value: f64) {
        self.count += 1;
        self.greatest = self.greatest.max(value);
    }
}

impl Tally {
    pub fn contact(&mut self, gap: Gap, limits: &Limits) {
        if gap.greatest > limits.noise {
            self.closed.add(gap.greatest);
        }
        if gap.least < -limits.noise {
            self.pressed.add(-gap.least);
        }
    }

    pub fn twice(&mut self, a: usize, b: usize) {
        self.twice.push((a, b));
    }

    /// Blocks that are the same to the last bit.
    pub fn in_one_place(&mut self, heap: &[usize]) {
        self.twice.extend(heap.iter().skip(1).map(|&again| (heap[0], again)));
        if heap.len() > self.heap.len() {
            self.heap = heap.to_vec();
        }
    }

    pub fn flattened(&mut self, a: usize, b: usize) {
        self.flattened.push((a, b));
    }

    pub fn small(&mut self, area: f64) {
        self.small.add(area);
    }

    pub fn near(&mut self, closing: Closing, limits: &Limits, a: usize, b: usize) {
        self.near.push((Apart::new(closing, limits), a, b));
    }

    pub fn overlap(
        &mut self,
        depth: f64,
        closing: Option<Closing>,
        limits: &Limits,
        a: usize,
        b: usize,
    ) {
        self.overlaps.push((depth, closing.map(|c| Apart::new(c, limits)), a, b));
    }

    pub fn neighbours(&mut self, closing: Closing, a: usize, b: usize) {
        self.neighbours.push((closing.gap.max(0.0), a, b));
    }

    pub fn without_normal(&mut self, a: usize, b: usize) {
        self.without_normal.push((a, b));
    }

    pub fn held_apart(&mut self, a: usize, b: usize) {
        self.held_apart.push((a, b));
    }

    /// Near misses and overlaps in numbers.
    pub fn left_out(&self, assembly: &Assembly) -> Option<LeftOut> {
        if self.near.is_empty() && self.overlaps.is_empty() {
            return None;
        }
        let closable =
            self.near.iter().map(|n| n.0).chain(self.overlaps.iter().filter_map(|o| o.1));
        let [closing_gap, closing_angle_deg] = closing(closable, assembly);
        Some(LeftOut {
            near_misses: self.near.len(),
            greatest_gap: self.near.iter().map(|n| n.0.gap).fold(0.0, f64::max),
            overlaps: self.overlaps.len(),
            deepest_overlap: self.overlaps.iter().map(|o| o.0).fold(0.0, f64::max),
            too_deep: self.overlaps.iter().filter(|o| o.1.is_none()).count(),
            closing_gap,
            closing_angle_deg,
        })
    }

    /// The pairs that these are.
    pub fn apart(&self) -> Vec<[usize; 2]> {
        let near = self.near.iter().map(|n| [n.1, n.2]);
        near.chain(self.overlaps.iter().map(|o| [o.2, o.3])).collect()
    }

    /// One finding per kind of thing.
    pub fn findings(mut self, assembly: &Assembly) -> Vec<Finding> {
        let all = [
            self.drawn_twice(assembly),
            self.closed_gaps(assembly),
            self.near_misses(assembly),
            self.neighbours_apart(assembly),
            self.overlapping(assembly),
            self.without_a_normal(assembly),
            self.on_flats(assembly),
            self.small_areas(assembly),
            self.kept_apart(assembly),
        ];
        all.into_iter().flatten().collect()
    }

    /// Blocks in the place of others.
    fn drawn_twice(&self, assembly: &Assembly) -> Option<Finding> {
        let &(a, b) = self.twice.first()?;
        let (one, other) = (&assembly.blocks[a].id, &assembly.blocks[b].id);
        if let [first, .., last] = self.heap[..]
            && self.heap.len() > 2
        {
            let [first, last] = [first, last].map(|i| &assembly.blocks[i].id);
            let n = self.heap.len();
            let more = match self.twice.len() + 1 - n {
                0 => String::new(),
                more => format!(" ({more} others are drawn more than once as well)"),
            };
            let text = format!(
                "{n} blocks coincide corner for corner, {first:?} to {last:?}{more}: all of them have weight, and they make no contact with each other; keep one of them"
            );
            return Some(Finding::new(FindingCode::Twice, text));
        }
        let more = match self.twice.len() {
            1 => String::new(),
            n => format!(" (and {} more alike)", n - 1),
        };
        let text = format!(
            "Block {other:?} coincides with block {one:?}, corner for corner{more}: both have weight, and they make no contact with each other; remove one"
        );
        Some(Finding::new(FindingCode::Twice, text))
    }

    /// Gaps and overlaps that were closed.
    fn closed_gaps(&self, assembly: &Assembly) -> Option<Finding> {
        if self.closed.count + self.pressed.count == 0 {
            return None;
        }
        let tolerance = short(assembly.contact.gap);
        let parts =
            [(&self.closed, "open gap", "open gaps"), (&self.pressed, "overlap", "overlaps")];
        let parts: Vec<String> = parts
            .iter()
            .filter(|(e, ..)| e.count > 0)
            .map(|(e, one, many)| {
                format!(
                    "{} {} (up to {} m)",
                    e.count,
                    if e.count == 1 { one } else { many },
                    short(e.greatest)
                )
            })
            .collect();
        let text = format!(
            "closed {}, all within contact.gap ({tolerance} × the smaller block's size) or the warp of the faces",
            parts.join(" and ")
        );
        Some(Finding::new(FindingCode::GapClosed, text))
    }

    /// Blocks that nearly touch.
    fn near_misses(&mut self, assembly: &Assembly) -> Option<Finding> {
        if self.near.is_empty() {
            return None;
        }
        self.near.sort_by(|x, y| x.0.gap.total_cmp(&y.0.gap).then((x.1, x.2).cmp(&(y.1, y.2))));
        let (least, greatest) = (self.near[0].0.gap, self.near[self.near.len() - 1].0.gap);
        let lean = |angle: Option<f64>| {
            angle.map(|a| format!(", {}° from parallel", short(a))).unwrap_or_default()
        };
        let worst: Vec<String> = self
            .near
            .iter()
            .take(3)
            .map(|&(x, a, b)| {
                format!("{} ({} m{})", pair(assembly, a, b), short(x.gap), lean(x.angle))
            })
            .collect();
        let text = format!(
            "{} of blocks nearly touch and were left apart: gaps from {} to {} m; nearest: {}. If they should touch, {}",
            pairs(self.near.len()),
            short(least),
            short(greatest),
            worst.join(", "),
            remedy(self.near.iter().map(|n| n.0), assembly),
        );
        Some(Finding::new(FindingCode::NearMiss, text))
    }

    /// Round blocks beside each other.
    fn neighbours_apart(&mut self, assembly: &Assembly) -> Option<Finding> {
        if self.neighbours.is_empty() {
            return None;
        }
        let tolerance = short(assembly.contact.gap);
        self.neighbours.sort_by(|x, y| x.0.total_cmp(&y.0).then((x.1, x.2).cmp(&(y.1, y.2))));
        let (nearest, farthest) = (self.neighbours[0], self.neighbours[self.neighbours.len() - 1]);
        let text = format!(
            "{} of round blocks, or of one and a wall, lie close without touching, as is usual for grains: gaps from {} to {} m, more than contact.gap ({tolerance} × the smaller block's size); nearest: {}",
            pairs(self.neighbours.len()),
            short(nearest.0),
            short(farthest.0),
            pair(assembly, nearest.1, nearest.2),
        );
        Some(Finding::new(FindingCode::NearMiss, text))
    }

    /// Blocks that overlap.
    fn overlapping(&mut self, assembly: &Assembly) -> Option<Finding> {
        if self.overlaps.is_empty() {
            return None;
        }
        let tolerance = short(assembly.contact.gap);
        self.overlaps.sort_by(|x, y| y.0.total_cmp(&x.0).then((x.2, x.3).cmp(&(y.2, y.3))));
        let worst: Vec<String> = self
            .overlaps
            .iter()
            .take(3)
            .map(|&(d, _, a, b)| format!("{} ({} m)", pair(assembly, a, b), short(d)))
            .collect();
        let closable: Vec<Apart> = self.overlaps.iter().filter_map(|o| o.1).collect();
        let close = match closable.len() {
            0 => String::new(),
            n if n == self.overlaps.len() => {
                format!(
                    ", or, to close {}, {}",
                    if n == 1 { "it" } else { "them" },
                    remedy(closable, assembly)
                )
            }
            n => format!(", or, to close {n} of them, {}", remedy(closable, assembly)),
        };
        let text = format!(
            "{} of blocks overlap by more than contact.gap ({tolerance} × size), by up to {} m; the overlapping faces make no contact. Deepest: {}. Correct the geometry{close}",
            pairs(self.overlaps.len()),
            short(self.overlaps[0].0),
            worst.join(", "),
        );
        Some(Finding::new(FindingCode::Overlap, text))
    }

    /// Blocks that touch along edges or at corners.
    fn without_a_normal(&self, assembly: &Assembly) -> Option<Finding> {
        let &(a, b) = self.without_normal.first()?;
        let text = format!(
            "{} of blocks touch only along an edge or at a corner, such as {}, with other blocks against the faces there; such a contact carries no force (usual between diagonal neighbours)",
            pairs(self.without_normal.len()),
            pair(assembly, a, b)
        );
        Some(Finding::new(FindingCode::ContactIgnored, text))
    }

    /// Edges and corners that meet edges and corners.
    fn on_flats(&self, assembly: &Assembly) -> Option<Finding> {
        let &(a, b) = self.flattened.first()?;
        let (touch, it) = match self.flattened.len() {
            1 => ("1 edge or corner meets another".to_string(), "it"),
            n => (format!("{n} edges or corners meet others"), "each"),
        };
        let text = format!(
            "{touch}, such as {}, with several possible normals: {it} may carry across a small flat between them, and nothing that needs another normal is proved. Where that matters, draw the flat that a real edge has, or give the normal in \"interfaces\"",
            pair(assembly, a, b)
        );
        Some(Finding::new(FindingCode::Flattened, text))
    }

    /// Areas that were too small.
    fn small_areas(&self, assembly: &Assembly) -> Option<Finding> {
        if self.small.count == 0 {
            return None;
        }
        let text = format!(
            "ignored {} contact area{} below contact.min_area ({} × size²), the largest of {} m²",
            self.small.count,
            if self.small.count == 1 { "" } else { "s" },
            short(assembly.contact.min_area),
            short(self.small.greatest)
        );
        Some(Finding::new(FindingCode::ContactIgnored, text))
    }

    /// Blocks that a thin one keeps apart.
    fn kept_apart(&self, assembly: &Assembly) -> Option<Finding> {
        let &(a, b) = self.held_apart.first()?;
        let tolerance = short(assembly.contact.gap);
        let text = format!(
            "{} of blocks, such as {}, are closer than contact.gap ({tolerance} × size) but held apart by a thin block between them: not joined",
            pairs(self.held_apart.len()),
            pair(assembly, a, b)
        );
        Some(Finding::new(FindingCode::ContactIgnored, text))
    }
}

/// The least `contact.gap` and `contact.angle_deg` to two digits that join all of these; those of
/// the scene where they do.
fn closing(apart: impl IntoIterator<Item = Apart>, assembly: &Assembly) -> [f64; 2] {
    let spec = &assembly.contact;
    let (gap, angle) = apart.into_iter().fold((0.0, 0.0), |(g, a): (f64, f64), x| {
        (g.max(x.relative), a.max(x.angle.unwrap_or(0.0)))
    });
    let raised = |from: f64, to: f64| if to > from { round_up(to) } else { from };
    [raised(spec.gap, gap), raised(spec.angle_deg, angle)]
}

/// The tolerances that join all of these.
fn remedy(apart: impl IntoIterator<Item = Apart>, assembly: &Assembly) -> String {
    let [gap, angle] = closing(apart, assembly);
    let raise = |name: &str, from: f64, to: f64| {
        format!("contact.{name} from {} to {}", short(from), short(to))
    };
    let spec = &assembly.contact;
    match (gap > spec.gap, angle > spec.angle_deg) {
        (true, true) => format!(
            "raise {} and {}",
            raise("gap", spec.gap, gap),
            raise("angle_deg", spec.angle_deg, angle)
        ),
        (false, true) => format!("raise {}", raise("angle_deg", spec.angle_deg, angle)),
        _ => format!("raise {}", raise("gap", spec.gap, gap)),
    }
}

fn pairs(count: usize) -> String {
    if count == 1 { "1 pair".into() } else { format!("{count} pairs") }
}

/// Three significant digits.
pub(super) fn short(x: f64) -> String {
    if x == 0.0 || (1e-3..1e4).contains(&x.abs()) {
        let digits =
            if x == 0.0 { 0 } else { (2 - x.abs().log10().floor() as i32).max(0) as usize };
        let text = format!("{x:.digits$}");
        if text.contains('.') {
            text.trim_end_matches('0').trim_end_matches('.').to_string()
        } else {
            text
        }
    } else {
        let text = format!("{x:.2e}");
        text.replace(".00e", "e").replacen(
            "0e",
            "e",
            usize::from(text.contains('.') && !text.contains(".00e")),
        )
    }
}

/// A little above `x`, to two digits: a tolerance that includes it.
pub(super) fn round_up(x: f64) -> f64 {
    let unit = 10f64.powf(x.log10().floor() - 1.0);
    let up = (x / unit * 1.000001).ceil() * unit;
    // As it is read where somebody takes it over.
    short(up).parse().unwrap_or(up)
}

fn pair(assembly: &Assembly, a: usize, b: usize) -> String {
    format!("{} and {}", assembly.blocks[a].id, assembly.blocks[b].id)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_rounded_up_values_include_what_they_came_from() {
        let cases = [
            (0.0, "0"),
            (0.05, "0.05"),
            (1.0, "1"),
            (123.456, "123"),
            (1e-6, "1e-6"),
            (2.5e-7, "2.5e-7"),
            (1.234e-5, "1.23e-5"),
            (1e-4, "1e-4"),
            (10.0, "10"),
            (1e10, "1e10"),
        ];
        for (x, text) in cases {
            assert_eq!(short(x), text);
        }
        for x in [1e-4, 2.8867e-3, 9.99e-3, 0.01] {
            assert!(round_up(x) > x && short(round_up(x)).parse::<f64>().unwrap() == round_up(x));
        }
    }
}
