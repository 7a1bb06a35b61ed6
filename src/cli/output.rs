//! Files that are written whole or not at all.

use super::terminal;
use anyhow::{Context, bail};
use std::{
    fs::{self, OpenOptions},
    io::Write,
    path::{Path, PathBuf},
};

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
    /// A sink for `path`; `None` and `-` are standard output. Writing is tried out now, so that a long answer is not lost later:
    /// a file is created in the target's folder and removed again.
    pub fn open(path: Option<&Path>) -> anyhow::Result<Self> {
        let Some(path) = path.filter(|p| p.as_os_str() != "-") else { return Ok(Self::Stdout) };
        let context = || format!("{}: cannot be written", path.display());
        // Through a symbolic link to the file it names.
        let target = if path.exists() { path.canonicalize().with_context(context)? } else { path.to_path_buf() };
        match fs::metadata(&target) {
            Ok(m) if m.is_dir() => bail!("{}: cannot be written: it is a folder", path.display()),
            Ok(m) if !m.is_file() => return Ok(Self::Device(target)),
            Ok(_) => drop(OpenOptions::new().append(true).open(&target).with_context(context)?),
            Err(_) if target.file_name().is_none() => bail!("{}: cannot be written: it names no file", path.display()),
            Err(_) if !folder(&target).is_dir() => bail!("{}: cannot be written: there is no such folder", path.display()),
            Err(_) => {}
        }
        beside(&target).with_context(context)?;
        Ok(Self::File(target))
    }

    /// Writes the text.
    pub fn write(&self, text: &str) -> anyhow::Result<()> {
        match self {
            Self::Stdout => terminal::print(text),
            Self::File(target) => replace(target, text).with_context(|| format!("{}: cannot be written", target.display())),
            Self::Device(target) => match OpenOptions::new().write(true).open(target).and_then(|mut f| f.write_all(text.as_bytes())) {
                Err(e) if e.kind() == std::io::ErrorKind::BrokenPipe => Ok(()),
                other => other.with_context(|| format!("{}: cannot be written", target.display())),
            },
        }
    }
}

fn folder(target: &Path) -> &Path {
    target.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// An empty file beside the target, gone when dropped.
fn beside(target: &Path) -> std::io::Result<tempfile::NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".voussoir-").suffix(".tmp");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        // Less what the user's mask takes away, as for any new file.
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    builder.tempfile_in(folder(target))
}

fn replace(target: &Path, text: &str) -> std::io::Result<()> {
    let mut file = beside(target)?;
    file.write_all(text.as_bytes())?;
    if let Ok(old) = fs::metadata(target) {
        file.as_file().set_permissions(old.permissions())?;
    }
    file.as_file().sync_all()?;
    file.persist(target).map(drop).map_err(|e| e.error)
}
