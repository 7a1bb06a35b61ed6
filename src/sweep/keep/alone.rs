//! A file that only this run writes.

use super::bytes;
use base::{error::RowsError, files};
use std::{
    fs::{File, OpenOptions, TryLockError},
    io::{self, Seek, SeekFrom, Write},
    path::Path,
};

/// A file that no other run writes until this is dropped: because it is locked, or because it is
/// new and its name is nobody else's.
///
/// A lock belongs to the opened file, not to this handle of it: a process that another thread is
/// starting holds a copy of every handle until it becomes its program, and closing ours alone would
/// leave the file locked that long. So it is unlocked in so many words.
#[derive(Debug)]
pub(crate) struct Alone(File);

impl Alone {
    /// Opens a regular file, made where there is none, locks it, and reads all of it.
    ///
    /// # Errors
    /// It cannot be written or read, is no regular file, is too long, or another run writes it.
    pub(crate) fn open(path: &Path) -> Result<(Self, Vec<u8>), RowsError> {
        let name = path.display().to_string();
        let problem = |what, cause| RowsError::File { file: name.clone(), what, cause };
        let file = files::open_to_continue(path).map_err(|e| problem("written", e))?;
        match file.try_lock() {
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => return Err(RowsError::Busy { file: name }),
            Err(TryLockError::Error(e)) => return Err(problem("locked", e)),
        }
        let alone = Self(file);
        let bytes = bytes(&name, &alone.0)?;
        Ok((alone, bytes))
    }

    /// Makes a file that is not there yet. It needs no lock, which not every shared file system
    /// gives.
    ///
    /// # Errors
    /// There is one ([`io::ErrorKind::AlreadyExists`]), or it cannot be written.
    pub(crate) fn fresh(path: &Path) -> io::Result<Self> {
        OpenOptions::new().append(true).create_new(true).open(path).map(Self)
    }

    /// Cuts the file to its first bytes and goes on writing after them.
    pub(crate) fn cut(&mut self, bytes: usize) -> io::Result<()> {
        self.0.set_len(bytes as u64)?;
        self.0.seek(SeekFrom::Start(bytes as u64)).map(drop)
    }

    /// Writes all of it.
    pub(crate) fn write(&mut self, text: &str) -> io::Result<()> {
        self.0.write_all(text.as_bytes())
    }
}

impl Drop for Alone {
    fn drop(&mut self) {
        // Where this fails the file is closed next, which unlocks it as soon as nobody has a copy.
        let _ = self.0.unlock();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_copy_of_the_handle_does_not_keep_the_file() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("rows");
        let (held, _) = Alone::open(&path).unwrap();
        // What a process that is just being started has.
        let copy = held.0.try_clone().unwrap();
        assert!(matches!(Alone::open(&path), Err(RowsError::Busy { .. })));
        drop(held);
        assert!(Alone::open(&path).is_ok());
        drop(copy);
    }
}
