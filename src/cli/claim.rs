//! Which files this run reads and which it writes: no output replaces another one, or what is read.
//! Every input and every output passes here, by whatever option it was named.

use anyhow::bail;
use std::{
    fs,
    path::{Path, PathBuf},
    sync::{Mutex, PoisonError},
};

/// A file, whatever name leads to it.
#[derive(PartialEq, Eq)]
struct Identity {
    /// Without links on the way.
    path: PathBuf,
    /// Device and number where it is there already: hard links have different paths.
    number: Option<(u64, u64)>,
}

struct Claim {
    place: Identity,
    /// As it was named first.
    name: PathBuf,
    is_written: bool,
}

static CLAIMS: Mutex<Vec<Claim>> = Mutex::new(Vec::new());

/// This file is read.
pub fn read(path: &Path) -> anyhow::Result<()> {
    claim(path, false)
}

/// This file is written.
pub fn written(path: &Path) -> anyhow::Result<()> {
    claim(path, true)
}

fn claim(path: &Path, is_written: bool) -> anyhow::Result<()> {
    let Some(place) = Identity::of(path) else { return Ok(()) };
    let mut claims = CLAIMS.lock().unwrap_or_else(PoisonError::into_inner);
    let other = claims.iter().find(|c| c.place.is(&place) && (c.is_written || is_written));
    if let Some(other) = other {
        let also = if other.name == path {
            String::new()
        } else {
            format!(" ({} is the same file)", other.name.display())
        };
        match other.is_written && is_written {
            true => bail!(
                "{}: two outputs would go to this file{also}; name a different file for each",
                path.display()
            ),
            false => bail!(
                "{}: an output would overwrite this input{also}; give the output another name",
                path.display()
            ),
        }
    }
    claims.push(Claim { place, name: path.to_path_buf(), is_written });
    Ok(())
}

impl Identity {
    /// None for what is no regular file: standard output and devices may take what they like, and
    /// what cannot be there is told when it is opened.
    fn of(path: &Path) -> Option<Self> {
        if path.as_os_str() == "-" {
            return None;
        }
        match fs::metadata(path) {
            Ok(there) => there
                .is_file()
                .then(|| Some(Self { path: path.canonicalize().ok()?, number: number(&there) }))?,
            Err(_) => {
                let folder =
                    path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
                Some(Self {
                    path: folder.canonicalize().ok()?.join(path.file_name()?),
                    number: None,
                })
            }
        }
    }

    fn is(&self, other: &Self) -> bool {
        self.path == other.path || self.number.is_some() && self.number == other.number
    }
}

#[cfg(unix)]
fn number(there: &fs::Metadata) -> Option<(u64, u64)> {
    use std::os::unix::fs::MetadataExt;
    Some((there.dev(), there.ino()))
}

#[cfg(not(unix))]
fn number(_: &fs::Metadata) -> Option<(u64, u64)> {
    None
}
