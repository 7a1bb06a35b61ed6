//! A real Slurm of two nodes with two cores each on this machine, where its packages are installed.

use std::{
    fs::{self, File},
    path::{Path, PathBuf},
    process::{Command, Stdio},
};
use tempfile::TempDir;

/// It stops when dropped.
pub struct Cluster {
    folder: TempDir,
    tool: PathBuf,
    /// The file that Slurm's commands read.
    pub config: PathBuf,
    /// Whether the authentication service was started for it.
    munge: bool,
    /// One cluster at a time: its ports are fixed.
    _lock: File,
}

impl Cluster {
    /// Starts one, or says why not.
    pub fn start() -> Result<Self, String> {
        let tool = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/tools/local-slurm");
        let path = std::env::var_os("PATH").unwrap_or_default();
        let folders: Vec<PathBuf> =
            std::env::split_paths(&path).chain([PathBuf::from("/usr/sbin")]).collect();
        for program in ["sbatch", "squeue", "scancel", "scontrol", "slurmctld", "slurmd", "munged"]
        {
            if !folders.iter().any(|f| f.join(program).is_file()) {
                return Err(format!("{program} is not installed (Debian: slurm-wlm and munge)"));
            }
        }
        let root = Command::new("id").arg("-u").output().is_ok_and(|o| o.stdout == b"0\n");
        if !root {
            return Err("starting a Slurm takes root".into());
        }
        let lock = File::create(std::env::temp_dir().join("voussoir-test-slurm.lock"))
            .map_err(|e| e.to_string())?;
        lock.try_lock().map_err(|_| "another test runs a Slurm on this machine".to_string())?;
        let munge = !quiet(Command::new("sh").args(["-c", "munge -n | unmunge"]));
        let folder = tempfile::tempdir().map_err(|e| e.to_string())?;
        let out = fs::File::create(folder.path().join("start.log")).map_err(|e| e.to_string())?;
        let config = folder.path().join("slurm.conf");
        let cluster = Self { folder, tool, config, munge, _lock: lock };
        let started = cluster
            .tool(&["start"], &[])
            .stdout(out.try_clone().map_err(|e| e.to_string())?)
            .stderr(out)
            .status();
        let log =
            || fs::read_to_string(cluster.folder.path().join("start.log")).unwrap_or_default();
        if started.is_ok_and(|s| s.success()) {
            Ok(cluster)
        } else {
            Err(format!("it does not start: {}", log()))
        }
    }

    /// `local-slurm VERB FOLDER …`
    fn tool(&self, verb: &[&str], more: &[&str]) -> Command {
        let mut command = Command::new("bash");
        command.arg(&self.tool).args(verb).arg(self.folder.path()).args(more).stdin(Stdio::null());
        command
    }

    /// Runs one of Slurm's commands; whether it succeeded.
    pub fn slurm(&self, program: &str, args: &[&str]) -> bool {
        quiet(Command::new(program).args(args).env("SLURM_CONF", &self.config))
    }

    /// What one of Slurm's commands prints.
    pub fn answer(&self, program: &str, args: &[&str]) -> String {
        let output = Command::new(program)
            .args(args)
            .env("SLURM_CONF", &self.config)
            .stdin(Stdio::null())
            .output()
            .unwrap();
        assert!(output.status.success(), "{program}: {}", String::from_utf8_lossy(&output.stderr));
        String::from_utf8_lossy(&output.stdout).into_owned()
    }

    /// The machine of node K goes down with all that runs on it. Returns how many tasks it took
    /// along.
    pub fn kill_node(&self, k: usize) -> usize {
        assert!(quiet(&mut self.tool(&["kill-node"], &[&k.to_string()])));
        let name = format!("SLURMD_NODENAME=n{k}");
        let configured = format!("SLURM_CONF={}", self.config.display());
        let mut killed = 0;
        for process in fs::read_dir("/proc").unwrap().filter_map(|e| Some(e.ok()?.path())) {
            let environment = fs::read(process.join("environ")).unwrap_or_default();
            let has = |wanted: &str| environment.split(|b| *b == 0).any(|v| v == wanted.as_bytes());
            if !(has(&name) && has(&configured)) {
                continue;
            }
            // Its keeper first, which would report the end of the task.
            let status = fs::read_to_string(process.join("status")).unwrap_or_default();
            let parent = status
                .lines()
                .find_map(|l| l.strip_prefix("PPid:"))
                .unwrap_or_default()
                .trim()
                .to_string();
            let keeper = fs::read_to_string(format!("/proc/{parent}/comm"))
                .unwrap_or_default()
                .starts_with("slurmstepd");
            let own = process.file_name().unwrap().to_string_lossy().into_owned();
            for victim in [Some(parent).filter(|_| keeper), Some(own)].into_iter().flatten() {
                quiet(Command::new("kill").args(["-KILL", &victim]));
            }
            killed += usize::from(keeper);
        }
        killed
    }

    /// Node K comes back.
    pub fn start_node(&self, k: usize) {
        assert!(quiet(&mut self.tool(&["start-node"], &[&k.to_string()])));
    }
}

fn quiet(command: &mut Command) -> bool {
    command
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .status()
        .is_ok_and(|s| s.success())
}

impl Drop for Cluster {
    fn drop(&mut self) {
        self.slurm("scancel", &["--user=root"]);
        quiet(&mut self.tool(&["stop"], &[]));
        if self.munge
            && let Ok(pid) = fs::read_to_string("/run/munge/munged.pid")
        {
            quiet(Command::new("kill").arg(pid.trim()));
        }
    }
}
