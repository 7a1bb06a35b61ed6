//! Watches a file. Times of change are polled: that works on every file system (notifications do
//! not cross networks, and end where an editor replaces the file), costs one `stat` a round, and is
//! as fast as a person sees.

use super::desk::Desk;
use crate::{
    error::InputError,
    import::{Reach, read_meshes},
    limits,
    scene::{Scene, Shape, read_bytes},
};
use std::{
    collections::BTreeSet,
    path::{Path, PathBuf},
    thread::sleep,
    time::{Duration, Instant, SystemTime},
};

/// A round. Longer: seen late. Shorter: work for nothing.
const ROUND: Duration = Duration::from_millis(15);
/// What cannot be read is believed when it stays so for this long: editors write a file in steps,
/// or take it away before the new one is there. Longer: mistakes are said late.
const SETTLED: Duration = Duration::from_millis(150);
/// Clocks of file systems tick coarsely: what was read is read again once after this time.
const AGAIN: Duration = Duration::from_millis(250);

/// A scene file that is followed.
#[derive(Clone)]
pub struct File {
    /// The scene, as it was named.
    pub path: PathBuf,
    /// Where it was when it was opened, without links: a link that takes its place shows nothing of
    /// where it leads.
    pub place: PathBuf,
    /// Where its meshes are found.
    pub folder: PathBuf,
    /// How far they may lie.
    pub reach: Reach,
}

impl File {
    /// Its name in messages.
    pub fn name(&self) -> String {
        self.path.display().to_string()
    }

    fn bytes(&self) -> Result<Vec<u8>, InputError> {
        limits::read_itself(&self.place, limits::PER_BYTE)
            .map_err(|e| InputError { file: Some(self.name()), ..e })
    }
}

/// When a file was changed, and its length.
type Stamp = Option<(SystemTime, u64)>;

fn stamp(path: &Path) -> Stamp {
    let meta = path.metadata().ok()?;
    Some((meta.modified().ok()?, meta.len()))
}

/// The meshes that a scene names.
fn meshes(scene: &Scene, folder: &Path) -> BTreeSet<PathBuf> {
    let of = scene.blocks.iter().filter_map(|b| match &b.shape {
        Shape::Mesh { path, .. } => Some(folder.join(path)),
        _ => None,
    });
    of.collect()
}

/// Whether contents can be used as they are, and the meshes they name.
fn look(file: &File, bytes: &Result<Vec<u8>, InputError>) -> (bool, BTreeSet<PathBuf>) {
    let Ok(bytes) = bytes else { return (false, BTreeSet::new()) };
    let Ok((mut scene, _)) = read_bytes(file.name(), bytes.clone()) else {
        return (false, BTreeSet::new());
    };
    let list = meshes(&scene, &file.folder);
    let whole = list.is_empty() || read_meshes(&mut scene, &file.folder, file.reach).is_ok();
    (whole, list)
}

/// What stood in the file, or why it cannot be read.
type Bytes = Result<Vec<u8>, InputError>;

/// Follows a file for good.
pub fn run(file: &File, desk: &Desk) {
    let mut meshes = BTreeSet::new();
    let mut shown: Option<(Vec<Stamp>, Bytes)> = None;
    let (mut checked, mut waiting) = (Instant::now(), None::<(Vec<Stamp>, Instant)>);
    loop {
        let now: Vec<Stamp> =
            std::iter::once(&file.place).chain(&meshes).map(|p| stamp(p)).collect();
        let same = shown.as_ref().is_some_and(|s| s.0 == now);
        let due = shown.is_none() || !same || (checked.elapsed() > AGAIN && is_young(&now));
        if due {
            let bytes = file.bytes();
            let (whole, named) = look(file, &bytes);
            let stamps: Vec<Stamp> =
                std::iter::once(&file.place).chain(&named).map(|p| stamp(p)).collect();
            let news = !same || shown.as_ref().is_none_or(|s| s.1 != bytes);
            // Patience begins anew with every change.
            let since = match waiting.take() {
                Some((before, since)) if before == stamps => since,
                _ => Instant::now(),
            };
            if news && (whole || since.elapsed() > SETTLED) {
                desk.file(bytes.clone());
                shown = Some((stamps, bytes));
                meshes = named;
            } else if news {
                waiting = Some((stamps, since));
            }
            checked = Instant::now();
        }
        sleep(ROUND);
    }
}

/// Whether a file was changed so lately that a second change may bear the same time.
fn is_young(stamps: &[Stamp]) -> bool {
    let young = |t: &SystemTime| t.elapsed().is_ok_and(|age| age < 4 * AGAIN);
    stamps.iter().flatten().any(|(t, _)| young(t))
}
