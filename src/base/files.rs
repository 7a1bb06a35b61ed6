//! Opening files that somebody else may have made: only regular ones, for a pipe never ends and a
//! device may do anything; and what was looked at is what is read, for a name may lead elsewhere a
//! moment later.

use std::{
    fs::{File, Metadata, OpenOptions},
    io,
    path::Path,
};

/// Opens a regular file for reading. Never waits: a pipe without a writer is refused like any
/// other.
///
/// # Errors
/// The file cannot be opened, or is a folder, a pipe, a device or the like.
pub fn open(path: &Path) -> io::Result<File> {
    // Looked at before it is opened, for opening alone may do something to a device; and once more
    // when it cannot change any longer.
    regular(&std::fs::metadata(path)?)?;
    opened(OpenOptions::new().read(true), path)
}

/// What the system says of itself and of this process: the text of a file of `/proc` or `/sys`,
/// nothing where there is none.
pub fn of_system(path: &str) -> Option<String> {
    std::fs::read_to_string(path).ok()
}

/// Opens a regular file for reading and writing, made where there is none; nothing of it is cut
/// off.
///
/// # Errors
/// As [`open`].
pub fn open_to_continue(path: &Path) -> io::Result<File> {
    match std::fs::metadata(path) {
        Ok(there) => regular(&there)?,
        Err(e) if e.kind() == io::ErrorKind::NotFound => {}
        Err(e) => return Err(e),
    }
    opened(OpenOptions::new().read(true).write(true).create(true).truncate(false), path)
}

fn opened(options: &mut OpenOptions, path: &Path) -> io::Result<File> {
    #[cfg(unix)]
    {
        use rustix::fs::OFlags;
        use std::os::unix::fs::OpenOptionsExt;
        // Bits of an int in every system's `open`.
        options.custom_flags((OFlags::NONBLOCK | OFlags::NOCTTY).bits() as i32);
    }
    let file = options.open(path)?;
    regular(&file.metadata()?)?;
    Ok(file)
}

/// The system's error about a file that was to be made under a name of chance, without that name:
/// nobody has given it, and it is gone.
pub fn unnamed(e: io::Error) -> io::Error {
    let cause = e
        .get_ref()
        .and_then(|e| std::error::Error::source(e))
        .and_then(|e| e.downcast_ref::<io::Error>());
    cause.and_then(io::Error::raw_os_error).map_or(e, io::Error::from_raw_os_error)
}

/// Refuses what is no regular file, with the remedy.
fn regular(there: &Metadata) -> io::Result<()> {
    match (there.is_file(), there.is_dir()) {
        (true, _) => Ok(()),
        (_, true) => {
            Err(io::Error::new(io::ErrorKind::IsADirectory, "this is a folder; name a file in it"))
        }
        _ => Err(io::Error::new(
            io::ErrorKind::InvalidInput,
            "this is not a regular file but a pipe, a device or the like; name a file",
        )),
    }
}

/// Opens a regular file below a folder. `path` has neither links nor steps up in it: where one of
/// its names is a link by now, the file is not opened, so that nothing outside the folder can take
/// its place between a look and this.
///
/// # Errors
/// As [`open`], or there is a link on the way.
#[cfg(unix)]
pub fn open_below(folder: &Path, path: &Path) -> io::Result<File> {
    use rustix::fs::{CWD, Mode, OFlags, openat};
    let way = OFlags::DIRECTORY | OFlags::CLOEXEC;
    let folder = openat(CWD, folder, OFlags::RDONLY | way, Mode::empty())?;
    let flags = OFlags::RDONLY | OFlags::NONBLOCK | OFlags::NOCTTY | OFlags::CLOEXEC;
    let file = File::from(
        at_once(&folder, path, flags).unwrap_or_else(|| step_by_step(folder, path, flags))?,
    );
    regular(&file.metadata()?)?;
    Ok(file)
}

/// Opens a regular file that is no link, wherever its folder lies: one that took its place since it
/// was last seen is not followed.
///
/// # Errors
/// As [`open`], or it is a link.
pub fn open_itself(path: &Path) -> io::Result<File> {
    let folder = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let opened = open_below(folder, Path::new(path.file_name().unwrap_or_default()));
    #[cfg(unix)]
    let opened = opened.map_err(|e| {
        match e.raw_os_error() == Some(rustix::io::Errno::LOOP.raw_os_error()) {
            true => io::Error::other("it was replaced by a link, which is not followed"),
            false => e,
        }
    });
    opened
}

/// By one call that follows no link; `None` where the system does not have it, or forbids it.
#[cfg(target_os = "linux")]
fn at_once(
    folder: &rustix::fd::OwnedFd,
    path: &Path,
    flags: rustix::fs::OFlags,
) -> Option<rustix::io::Result<rustix::fd::OwnedFd>> {
    use rustix::{
        fs::{Mode, ResolveFlags, openat2},
        io::Errno,
    };
    match openat2(
        folder,
        path,
        flags,
        Mode::empty(),
        ResolveFlags::BENEATH | ResolveFlags::NO_SYMLINKS | ResolveFlags::NO_MAGICLINKS,
    ) {
        Err(Errno::NOSYS | Errno::PERM | Errno::INVAL | Errno::TOOBIG) => None,
        opened => Some(opened),
    }
}

#[cfg(all(unix, not(target_os = "linux")))]
fn at_once(
    _: &rustix::fd::OwnedFd,
    _: &Path,
    _: rustix::fs::OFlags,
) -> Option<rustix::io::Result<rustix::fd::OwnedFd>> {
    None
}

/// Name by name, each opened in the folder before it and none of them a link.
#[cfg(unix)]
fn step_by_step(
    folder: rustix::fd::OwnedFd,
    path: &Path,
    flags: rustix::fs::OFlags,
) -> rustix::io::Result<rustix::fd::OwnedFd> {
    use rustix::{
        fs::{Mode, OFlags, openat},
        io::Errno,
    };
    use std::path::Component;
    let mut at = folder;
    let mut steps = path.components().peekable();
    while let Some(step) = steps.next() {
        let Component::Normal(name) = step else { return Err(Errno::XDEV) };
        let last = steps.peek().is_none();
        let kind = if last { flags } else { OFlags::RDONLY | OFlags::DIRECTORY | OFlags::CLOEXEC };
        at = openat(&at, name, kind | OFlags::NOFOLLOW, Mode::empty())?;
    }
    Ok(at)
}

/// As on other systems, where the folder can be held while its files are opened; here a name may
/// lead elsewhere between two looks.
///
/// # Errors
/// As [`open`].
#[cfg(not(unix))]
pub fn open_below(folder: &Path, path: &Path) -> io::Result<File> {
    open(&folder.join(path))
}

#[cfg(test)]
#[cfg(unix)]
mod tests {
    use super::*;
    use std::{
        fs,
        io::Read,
        os::unix::fs::symlink,
        sync::atomic::{AtomicBool, Ordering},
    };

    fn text(file: io::Result<File>) -> io::Result<String> {
        let mut text = String::new();
        file?.read_to_string(&mut text)?;
        Ok(text)
    }

    #[test]
    fn a_name_that_became_a_link_after_it_was_looked_at_is_not_followed() {
        let root = tempfile::tempdir().unwrap();
        let folder = root.path().join("work");
        fs::create_dir_all(folder.join("stones")).unwrap();
        fs::create_dir(root.path().join("elsewhere")).unwrap();
        fs::write(root.path().join("elsewhere/a"), "secret").unwrap();
        fs::write(folder.join("stones/a"), "inside").unwrap();
        symlink(root.path().join("elsewhere"), folder.join("way")).unwrap();
        symlink("../elsewhere/a", folder.join("last")).unwrap();
        symlink("stones/a", folder.join("within")).unwrap();
        let below = |path: &str| text(open_below(&folder, Path::new(path)));
        let steps = |path: &str| {
            use rustix::fs::{CWD, Mode, OFlags, openat};
            let held =
                openat(CWD, &folder, OFlags::RDONLY | OFlags::DIRECTORY, Mode::empty()).unwrap();
            text(
                step_by_step(held, Path::new(path), OFlags::RDONLY)
                    .map(File::from)
                    .map_err(Into::into),
            )
        };
        for open in [&below as &dyn Fn(&str) -> io::Result<String>, &steps] {
            assert_eq!(open("stones/a").unwrap(), "inside");
            for path in ["way/a", "last", "within", "../elsewhere/a", "/etc/passwd"] {
                assert!(open(path).is_err(), "{path}");
            }
        }
    }

    #[test]
    fn a_link_that_comes_and_goes_never_gets_through() {
        let root = tempfile::tempdir().unwrap();
        let folder = root.path().join("work");
        fs::create_dir(&folder).unwrap();
        fs::write(root.path().join("secret"), "secret").unwrap();
        fs::write(folder.join("a"), "inside").unwrap();
        let done = AtomicBool::new(false);
        std::thread::scope(|threads| {
            threads.spawn(|| {
                while !done.load(Ordering::Relaxed) {
                    symlink("../secret", folder.join("link")).unwrap();
                    fs::rename(folder.join("link"), folder.join("a")).unwrap();
                    fs::write(folder.join("file"), "inside").unwrap();
                    fs::rename(folder.join("file"), folder.join("a")).unwrap();
                }
            });
            // On a busy machine the link may stay for all of the tries that are meant to be enough.
            let (mut tries, mut read) = (0, Vec::new());
            while tries < 20_000 || read.is_empty() {
                read.extend(text(open_below(&folder, Path::new("a"))).ok());
                tries += 1;
            }
            done.store(true, Ordering::Relaxed);
            assert!(read.iter().all(|t| t == "inside"));
        });
    }

    #[test]
    fn only_regular_files_are_opened_and_nothing_waits() {
        use rustix::fs::{CWD, FileType, Mode, mknodat};
        let root = tempfile::tempdir().unwrap();
        let pipe = root.path().join("pipe");
        mknodat(CWD, &pipe, FileType::Fifo, Mode::RUSR | Mode::WUSR, 0).unwrap();
        for path in [pipe.as_path(), Path::new("/dev/zero"), Path::new("/dev/full"), root.path()] {
            for open in [open as fn(&Path) -> io::Result<File>, open_to_continue] {
                let said = open(path).unwrap_err().to_string();
                assert!(said.contains("name a file"), "{}: {said}", path.display());
            }
        }
        assert!(open(&root.path().join("none")).is_err());
        assert!(open_to_continue(&root.path().join("new")).is_ok());
    }
}
