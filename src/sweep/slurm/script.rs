//! The batch script.

use std::fmt;

/// What the script says.
#[derive(Clone, Debug)]
pub struct Script {
    /// Name of the plan, for people.
    pub name: String,
    /// Rows of the sweep.
    pub rows: usize,
    /// Shards of the sweep.
    pub tasks: usize,
    /// Which of them to run, from 1; in order.
    pub array: Vec<usize>,
    /// Processors a task.
    pub cpus: usize,
    /// The partition, where one is asked for.
    pub partition: Option<String>,
    /// The time limit of a task as Slurm takes it, where one is asked for.
    pub time: Option<String>,
    /// More options of sbatch, as given.
    pub more: Vec<String>,
    /// The program, as the nodes see it.
    pub program: String,
}

impl fmt::Display for Script {
    /// To be submitted in the folder of the sweep.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name: String =
            self.name.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
        let version = env!("CARGO_PKG_VERSION");
        writeln!(f, "#!/bin/bash")?;
        writeln!(
            f,
            "# {name}: {} rows in {} tasks. Written by voussoir {version}; `sbatch job.sh` in this folder submits it.",
            self.rows, self.tasks
        )?;
        writeln!(
            f,
            "# A restarted task resumes where it stopped: its finished rows are in rows/."
        )?;
        let mut option = |text: &str| writeln!(f, "#SBATCH {text}");
        option("--job-name=voussoir")?;
        option(&format!("--array={}", ranges(&self.array)))?;
        option("--ntasks=1")?;
        option(&format!("--cpus-per-task={}", self.cpus))?;
        option("--requeue")?;
        option("--open-mode=append")?;
        option("--output=log/task-%a.txt")?;
        for (key, value) in [("partition", &self.partition), ("time", &self.time)] {
            if let Some(value) = value {
                option(&format!("--{key}={value}"))?;
            }
        }
        for more in &self.more {
            option(more)?;
        }
        let program = format!("'{}'", self.program.replace('\'', "'\\''"));
        writeln!(
            f,
            "exec {program} sweep task . --shard \"$SLURM_ARRAY_TASK_ID/{}\" --threads {}",
            self.tasks, self.cpus
        )
    }
}

/// Numbers as Slurm writes them: 1-4,7.
fn ranges(numbers: &[usize]) -> String {
    let mut parts: Vec<(usize, usize)> = Vec::new();
    for &n in numbers {
        match parts.last_mut() {
            Some((_, last)) if last.checked_add(1) == Some(n) => *last = n,
            _ => parts.push((n, n)),
        }
    }
    parts
        .iter()
        .map(|&(a, b)| if a == b { a.to_string() } else { format!("{a}-{b}") })
        .collect::<Vec<_>>()
        .join(",")
}

#[cfg(test)]
mod tests {
    use super::{Script, ranges};

    #[test]
    fn the_script_says_what_was_asked() {
        let script = Script {
            name: "Two\nlines".into(),
            rows: 90,
            tasks: 9,
            array: vec![1, 2, 3, 7],
            cpus: 2,
            partition: Some("main".into()),
            time: Some("1:00:00".into()),
            more: vec!["--account=stone".into()],
            program: "/opt/o'clock/voussoir".into(),
        };
        let text = script.to_string();
        assert!(text.starts_with("#!/bin/bash\n# Two lines: 90 rows in 9 tasks."), "{text}");
        for option in [
            "array=1-3,7",
            "cpus-per-task=2",
            "partition=main",
            "time=1:00:00",
            "account=stone",
            "requeue",
        ] {
            assert!(text.lines().any(|l| l == format!("#SBATCH --{option}")), "{option}: {text}");
        }
        let last = r#"exec '/opt/o'\''clock/voussoir' sweep task . --shard "$SLURM_ARRAY_TASK_ID/9" --threads 2"#;
        assert_eq!(text.lines().last(), Some(last));
    }

    #[test]
    fn numbers_are_written_as_ranges() {
        assert_eq!(ranges(&[1, 2, 3, 5, 7, 8]), "1-3,5,7-8");
        assert_eq!(ranges(&[4]), "4");
        assert_eq!(ranges(&[]), "");
    }
}
