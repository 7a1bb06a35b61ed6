//! Files that are written whole or not at all.

use super::{claim, terminal};
use anyhow::{Context, bail};
use std::{
    fs::{self, OpenOptions},
    io::Write,
    path::{Path, PathBuf},
};
use voussoir::files;

/// Where a result goes.
#[derive(Debug)]
pub enum Sink {
    /// Standard output.
    Stdout,
    /// A file, replaced at once by a complete one.
    File(PathBuf),
    /// Something that is no regular file (`/dev/null`, a pipe), written as it is.
    Device(PathBuf),
}

impl Sink {
    /// A sink for `path`; `None` and `-` are standard output. Writing is tried out now, so that a
    /// long answer is not lost later: a file without a name is made in the target's folder. Nothing
    /// else of this run is read from there or written to it.
    pub fn open(path: Option<&Path>) -> anyhow::Result<Self> {
        path.map_or(Ok(()), claim::written)?;
        Self::again(path)
    }

    /// As [`Self::open`], for a file that this run has claimed before.
    pub fn again(path: Option<&Path>) -> anyhow::Result<Self> {
        let Some(path) = path.filter(|p| p.as_os_str() != "-") else { return Ok(Self::Stdout) };
        let context = || format!("{}: cannot be written", path.display());
        // Through a symbolic link to the file it names.
        let target = if path.exists() {
            path.canonicalize().with_context(context)?
        } else {
            path.to_path_buf()
        };
        match fs::metadata(&target) {
            Ok(m) if m.is_dir() => bail!("{}: cannot be written: it is a folder", path.display()),
            Ok(m) if !m.is_file() => return Ok(Self::Device(target)),
            Ok(_) => drop(OpenOptions::new().append(true).open(&target).with_context(context)?),
            Err(_) if target.file_name().is_none() => {
                bail!("{}: cannot be written: the path names no file", path.display())
            }
            Err(_) if !folder(&target).is_dir() => {
                bail!("{}: cannot be written: there is no such folder", path.display())
            }
            Err(_) => {}
        }
        tempfile::tempfile_in(folder(&target)).map_err(files::unnamed).with_context(context)?;
        Ok(Self::File(target))
    }

    /// Writes the text.
    pub fn write(&self, text: &str) -> anyhow::Result<()> {
        match self {
            Self::Stdout => terminal::print(text),
            Self::File(_) | Self::Device(_) => self.write_bytes(text.as_bytes()),
        }
    }

    /// Writes what is no text, to anything but standard output.
    pub fn write_bytes(&self, bytes: &[u8]) -> anyhow::Result<()> {
        match self {
            Self::Stdout => bail!("only text can go to standard output"),
            Self::File(target) => replace(target, bytes)
                .with_context(|| format!("{}: cannot be written", target.display())),
            Self::Device(target) => match OpenOptions::new()
                .write(true)
                .open(target)
                .and_then(|mut f| f.write_all(bytes))
            {
                Err(e) if e.kind() == std::io::ErrorKind::BrokenPipe => Ok(()),
                other => other.with_context(|| format!("{}: cannot be written", target.display())),
            },
        }
    }
}

/// A file that grows while work is done. Killed, it ends with what was written last; where it cannot
/// be written, it is taken away: a piece of a table is none.
pub struct Growing {
    path: PathBuf,
    file: fs::File,
}

impl Growing {
    /// Makes the file, empty. Nothing else of this run is read from there or written to it.
    pub fn open(path: &Path) -> anyhow::Result<Self> {
        claim::written(path)?;
        let file = fs::File::create(path)
            .with_context(|| format!("{}: cannot be written", path.display()))?;
        Ok(Self { path: path.to_path_buf(), file })
    }
}

impl Write for Growing {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        self.file.write(bytes)
    }

    fn flush(&mut self) -> std::io::Result<()> {
        self.file.flush()
    }

    fn write_all(&mut self, bytes: &[u8]) -> std::io::Result<()> {
        self.file.write_all(bytes).inspect_err(|_| {
            if self.file.metadata().is_ok_and(|m| m.is_file()) {
                let _ = fs::remove_file(&self.path);
            }
        })
    }
}

fn folder(target: &Path) -> &Path {
    target.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// Puts a file with these bytes in the place of the target, whole or not at all.
fn replace(target: &Path, bytes: &[u8]) -> std::io::Result<()> {
    #[cfg(target_os = "linux")]
    if let Some(done) = nameless(target, bytes) {
        return done;
    }
    let mut builder = tempfile::Builder::new();
    builder.prefix(".voussoir-").suffix(".tmp");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        // Less what the user's mask takes away, as for any new file.
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    let mut file = builder.tempfile_in(folder(target)).map_err(files::unnamed)?;
    fill(file.as_file_mut(), target, bytes)?;
    file.persist(target).map(drop).map_err(|e| e.error)
}

fn fill(file: &mut fs::File, target: &Path, bytes: &[u8]) -> std::io::Result<()> {
    file.write_all(bytes)?;
    if let Ok(old) = fs::metadata(target) {
        file.set_permissions(old.permissions())?;
    }
    file.sync_all()
}

/// Writes a file that has no name until it is whole, so that even a kill leaves nothing beside the
/// target. `None` where the system or the file system has no such files.
#[cfg(target_os = "linux")]
fn nameless(target: &Path, bytes: &[u8]) -> Option<std::io::Result<()>> {
    use rustix::fs::{AtFlags, CWD, Mode, OFlags, linkat, openat};
    use std::os::fd::AsRawFd;
    let fd = openat(
        CWD,
        folder(target),
        OFlags::TMPFILE | OFlags::WRONLY | OFlags::CLOEXEC,
        Mode::from_raw_mode(0o666),
    )
    .ok()?;
    let mut file = fs::File::from(fd);
    if let Err(e) = fill(&mut file, target, bytes) {
        return Some(Err(e));
    }
    let open = format!("/proc/self/fd/{}", file.as_raw_fd());
    let name_it = |name: &Path| linkat(CWD, open.as_str(), CWD, name, AtFlags::SYMLINK_FOLLOW);
    match name_it(target) {
        Ok(()) => return Some(Ok(())),
        Err(rustix::io::Errno::EXIST) => {}
        // No /proc, or a file system that gives no names afterwards.
        Err(_) => return None,
    }
    // A file is replaced by renaming, which takes a name for a moment.
    let passing = folder(target).join(format!(".voussoir-{}.tmp", std::process::id()));
    name_it(&passing).ok()?;
    Some(fs::rename(&passing, target).inspect_err(|_| drop(fs::remove_file(&passing))))
}
