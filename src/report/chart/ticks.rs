//! Round values inside a range.

/// So many are wanted.
const WANTED: f64 = 5.0;

/// Ticks on an axis from `low` to `high`.
pub(super) fn ticks([low, high]: [f64; 2], log: bool) -> Vec<f64> {
    if log { decades(low, high) } else { round(low, high) }
}

fn round(low: f64, high: f64) -> Vec<f64> {
    let raw = (high - low) / WANTED;
    let power = 10f64.powf(raw.log10().floor());
    let step = [1.0, 2.0, 5.0, 10.0].map(|m| m * power).into_iter().find(|s| *s >= raw);
    let step = step.unwrap_or(10.0 * power);
    let first = (low / step - 1e-9).ceil();
    let inside = |k: &f64| (first + k) * step <= high + 1e-9 * step;
    let counts = (0..).map(f64::from).take_while(inside);
    counts.map(|k| if first + k == 0.0 { 0.0 } else { (first + k) * step }).take(100).collect()
}

fn decades(low: f64, high: f64) -> Vec<f64> {
    let (from, to) = ((low.log10() - 1e-9).ceil() as i32, (high.log10() + 1e-9).floor() as i32);
    let every = ((to - from + 5) / 6).max(1) as usize;
    let list: Vec<f64> = (from..=to).step_by(every).map(|k| 10f64.powi(k)).collect();
    if list.len() > 1 {
        return list;
    }
    let near = (from - 1..=to + 1).flat_map(|k| [1.0, 2.0, 5.0].map(|m| m * 10f64.powi(k)));
    let inside: Vec<f64> = near.filter(|v| (low..=high).contains(v)).collect();
    if inside.is_empty() { vec![low, high] } else { inside }
}

/// From where to where an axis goes that shows these values.
pub(super) fn range(values: impl Iterator<Item = f64>, log: bool) -> [f64; 2] {
    let shown = values.filter(|v| v.is_finite() && (!log || *v > 0.0));
    let [low, high] =
        shown.fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], v| [l.min(v), h.max(v)]);
    match (low.total_cmp(&high), log) {
        (std::cmp::Ordering::Greater, true) => [0.1, 1.0],
        (std::cmp::Ordering::Greater, false) => [0.0, 1.0],
        (std::cmp::Ordering::Equal, true) => [low / 3.0, high * 3.0],
        (std::cmp::Ordering::Less, true) => [low / 1.3, high * 1.3],
        (order, false) => {
            let is_one = order == std::cmp::Ordering::Equal;
            let pad = if is_one { 0.05 * high.abs() } else { 0.03 * (high - low) };
            let pad = if pad > 0.0 { pad } else { 1.0 };
            [low - pad, high + pad]
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_inside() {
        assert_eq!(ticks([-0.02, 1.03], false), [0.0, 0.5, 1.0]);
        assert_eq!(ticks([0.9, 5.2], false), [1.0, 2.0, 3.0, 4.0, 5.0]);
        assert_eq!(ticks([1e-3, 1e2], true), [1e-3, 1e-2, 0.1, 1.0, 10.0, 100.0]);
        assert_eq!(ticks([1.5, 6.0], true), [2.0, 5.0]);
        assert!(ticks([-1e-300, 1e-300], false).len() < 101);
    }

    #[test]
    fn ranges_leave_room() {
        assert_eq!(range([1.0, 2.0].into_iter(), false), [0.97, 2.03]);
        assert_eq!(range([0.0, f64::NAN].into_iter(), false), [-1.0, 1.0]);
        assert_eq!(range(std::iter::empty(), true), [0.1, 1.0]);
        assert_eq!(range([-1.0, 3.0].into_iter(), true), [1.0, 9.0]);
    }
}
