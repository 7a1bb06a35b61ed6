//! What the system lets this process have: free memory, the limits of its control group, its own
//! address space (Linux; elsewhere nothing is known).

use crate::files::of_system as file;
use std::path::Path;

/// Reads a file of the system as text.
type Read<'a> = &'a dyn Fn(&str) -> Option<String>;

/// Bytes that can still be taken: the least of what the machine, the control group and the limits
/// of the process leave.
pub(super) fn free() -> Option<u64> {
    [machine(&file), group(), process(&file)].into_iter().flatten().min()
}

/// Bytes that the control groups of this process leave it, where they set a limit. Beyond it the
/// system kills without a word.
pub fn group() -> Option<u64> {
    left_by_groups(&file)
}

fn machine(read: Read) -> Option<u64> {
    kilobytes(&read("/proc/meminfo")?, "MemAvailable:")
}

/// Address space and data (`ulimit -v`, `ulimit -d`).
fn process(read: Read) -> Option<u64> {
    let limits = read("/proc/self/limits")?;
    let status = read("/proc/self/status")?;
    let left = |limit: &str, used: &str| {
        let most: u64 = limits
            .lines()
            .find_map(|l| l.strip_prefix(limit))?
            .split_whitespace()
            .next()?
            .parse()
            .ok()?;
        Some(most.saturating_sub(kilobytes(&status, used)?))
    };
    [left("Max address space", "VmSize:"), left("Max data size", "VmData:")]
        .into_iter()
        .flatten()
        .min()
}

/// The least that any group from this one up to the root leaves, in the second version of control
/// groups or the first.
fn left_by_groups(read: Read) -> Option<u64> {
    let groups = read("/proc/self/cgroup")?;
    let second = groups.lines().find_map(|l| l.strip_prefix("0::"));
    let first = groups.lines().find_map(|l| l.split_once(":memory:").map(|(_, path)| path));
    let ways = [
        (second, "/sys/fs/cgroup", "memory.max", "memory.current"),
        (first, "/sys/fs/cgroup/memory", "memory.limit_in_bytes", "memory.usage_in_bytes"),
    ];
    let left =
        |folder: &str, most: &str, used: &str| -> Option<u64> {
            let number = |name: &str| read(&format!("{folder}/{name}"))?.trim().parse::<u64>().ok();
            // Without a limit the first version says the greatest number of pages.
            let most = number(most).filter(|most| *most < i64::MAX as u64 / 2)?;
            Some(most.saturating_sub(number(used)?.saturating_sub(cached(
                &read(&format!("{folder}/memory.stat")).unwrap_or_default(),
            ))))
        };
    ways.into_iter()
        .filter_map(|(path, root, most, used)| Some((path?, root, most, used)))
        .flat_map(|(path, root, most, used)| {
            // A container may see its own group as the root, or by a path that is not there.
            let up = Path::new(path.trim_start_matches('/'))
                .ancestors()
                .map(move |p| format!("{root}/{}", p.display()));
            up.filter_map(move |folder| left(folder.trim_end_matches('/'), most, used))
                .collect::<Vec<_>>()
        })
        .min()
}

/// Files kept in memory, which the system gives back when memory is asked for.
fn cached(stat: &str) -> u64 {
    let of = |name: &str| {
        stat.lines().find_map(|l| l.strip_prefix(name)?.trim().parse::<u64>().ok()).unwrap_or(0)
    };
    of("inactive_file ") + of("active_file ")
}

fn kilobytes(text: &str, name: &str) -> Option<u64> {
    let number = text
        .lines()
        .find_map(|l| l.strip_prefix(name)?.trim().strip_suffix("kB").map(str::trim))?;
    number.parse::<u64>().ok()?.checked_mul(1024)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_tightest_group_on_the_way_up_counts_without_its_cache() {
        let second = |path: &str| {
            let text = match path {
                "/proc/self/cgroup" => "0::/user/job\n",
                "/sys/fs/cgroup/user/job/memory.max" => "max\n",
                "/sys/fs/cgroup/user/memory.max" => "1000\n",
                "/sys/fs/cgroup/user/memory.current" => "900\n",
                "/sys/fs/cgroup/user/memory.stat" => {
                    "anon 100\ninactive_file 300\nactive_file 50\n"
                }
                _ => return None,
            };
            Some(text.to_string())
        };
        assert_eq!(left_by_groups(&second), Some(450));
        let first = |path: &str| {
            let text = match path {
                "/proc/self/cgroup" => "5:cpu:/a\n4:memory:/job\n",
                "/sys/fs/cgroup/memory/job/memory.limit_in_bytes" => "2000\n",
                "/sys/fs/cgroup/memory/job/memory.usage_in_bytes" => "500\n",
                "/sys/fs/cgroup/memory/memory.limit_in_bytes" => "9223372036854771712\n",
                "/sys/fs/cgroup/memory/memory.usage_in_bytes" => "700\n",
                _ => return None,
            };
            Some(text.to_string())
        };
        assert_eq!(left_by_groups(&first), Some(1500));
        assert_eq!(left_by_groups(&|_| None), None);
    }

    #[test]
    fn limits_of_the_process_count_what_it_has_taken() {
        let read = |path: &str| {
            Some(match path {
                "/proc/self/limits" => "Limit  Soft Limit  Hard Limit  Units\nMax data size  unlimited unlimited bytes\nMax address space  10240000 unlimited bytes\n".to_string(),
                _ => "VmSize:\t  4000 kB\nVmData:\t 100 kB\n".to_string(),
            })
        };
        assert_eq!(process(&read), Some(10_240_000 - 4_096_000));
    }
}
