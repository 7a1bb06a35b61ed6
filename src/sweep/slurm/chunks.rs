//! How many tasks.

use base::tolerance::{SCHEDULING_SHARE, TASK_START};

/// Into how many tasks to cut `rows` rows of `seconds` each, on `cpus` processors a task, where
/// `slots` tasks run at a time (unknown: `None`) and an array may have `most`.
///
/// As many as keep what it takes to start a task below a twentieth of its work; and of those, whole
/// waves of tasks, so that no processor waits for the last ones.
pub fn tasks(rows: usize, seconds: f64, cpus: usize, slots: Option<usize>, most: usize) -> usize {
    let work = rows as f64 * seconds.max(0.0) / cpus.max(1) as f64;
    let least = TASK_START / SCHEDULING_SHARE;
    let affordable = if work.is_finite() { (work / least).floor() as usize } else { most };
    let bound = affordable.clamp(1, most.min(rows).max(1));
    match slots {
        Some(slots) if slots > 0 && bound >= slots => bound / slots * slots,
        _ => bound,
    }
}

#[cfg(test)]
mod tests {
    use super::tasks;

    #[test]
    fn starting_stays_below_a_twentieth_of_the_work() {
        // 10,000 rows of 20 ms are 200 s: ten tasks of 20 s, in whole waves of four.
        assert_eq!(tasks(10_000, 0.02, 1, None, 1000), 10);
        assert_eq!(tasks(10_000, 0.02, 1, Some(4), 1000), 8);
        assert_eq!(tasks(10_000, 0.02, 2, Some(2), 1000), 4);
        assert_eq!(tasks(10_000, 0.02, 1, Some(400), 1000), 10);
        // Little work is one task, much is as many as an array takes; never more than rows.
        assert_eq!(tasks(10, 0.001, 1, Some(4), 1000), 1);
        assert_eq!(tasks(2_000_000, 60.0, 1, Some(300), 1000), 900);
        assert_eq!(tasks(7, 3600.0, 1, Some(2), 1000), 6);
        assert_eq!(tasks(7, f64::INFINITY, 1, None, 1000), 7);
        assert_eq!(tasks(0, 1.0, 0, Some(0), 0), 1);
    }
}
