//! Rows → answers, on as many threads as wanted, each written as it ends.

use super::{Answer, Header, Opened, Row, RowsFile, Shard, Status, Sweep, ask};
use crate::{analysis::reuse::Reuse, error::RowsError, parallel};
use std::{
    collections::HashSet,
    panic::{AssertUnwindSafe, catch_unwind},
    path::Path,
    sync::{Mutex, PoisonError},
    time::Instant,
};

/// How a sweep is run. None of it changes a row.
#[derive(Clone, Copy, Debug, Default)]
pub struct Options {
    /// Which rows.
    pub shard: Shard,
    /// Threads; as many as there are processors where `None`.
    pub threads: Option<usize>,
    /// Begin again where rows of another plan are in the way.
    pub restart: bool,
}

/// What a run sees.
#[derive(Clone, Copy, Debug)]
pub enum Event {
    /// Rows of this shard, rows that were there already, bytes of a half-written line that were cut off.
    Begin {
        /// Rows of this shard.
        rows: usize,
        /// Rows that were there already.
        there: usize,
        /// Bytes of a half-written row that were cut off.
        mended: usize,
    },
    /// A row has been written.
    Row(Status),
}

/// A sweep that has ended.
#[derive(Debug)]
pub struct Done {
    /// What the rows are about.
    pub header: Header,
    /// Every row of the shard, by number.
    pub rows: Vec<Row>,
    /// How often blocks were resolved and contacts detected.
    pub computed: [usize; 2],
}

/// Answers the rows of a shard that are not in the file `path` yet, each appended as it ends.
///
/// Rows that share shapes are done one after the other, so that contacts are found once for all of them.
///
/// # Errors
/// The file cannot be used. Rows that fail are rows with their error.
pub fn run(sweep: &Sweep, path: &Path, options: &Options, watch: &(dyn Fn(Event) + Sync)) -> Result<Done, RowsError> {
    let header = sweep.header(options.shard);
    let Opened { file, rows, mended } = RowsFile::open(path, &header, options.restart)?;
    let there: HashSet<usize> = rows.iter().map(|r| r.row).collect();
    let mine = (0..sweep.rows()).filter(|row| options.shard.holds(*row));
    let mut open: Vec<usize> = mine.filter(|row| !there.contains(row)).collect();
    watch(Event::Begin { rows: there.len() + open.len(), there: there.len(), mended });
    open.sort_by_cached_key(|row| (sweep.keys(&sweep.parameters(*row)), *row));

    let threads = options.threads.unwrap_or(0);
    let reuse = Reuse::default();
    let rows = Mutex::new(rows);
    parallel::for_each(threads, &open, |&number| {
        let row = answer(sweep, &reuse, number);
        file.append(&row)?;
        watch(Event::Row(row.answer.status));
        rows.lock().unwrap_or_else(PoisonError::into_inner).push(row);
        Ok(())
    })
    .map_err(|e| RowsError::Threads { threads, cause: e.to_string() })??;
    let mut rows = rows.into_inner().unwrap_or_else(PoisonError::into_inner);
    rows.sort_by_key(|r| r.row);
    Ok(Done { header, rows, computed: reuse.computed() })
}

/// One row.
pub(super) fn answer(sweep: &Sweep, reuse: &Reuse, number: usize) -> Row {
    let start = Instant::now();
    let parameters = sweep.parameters(number);
    let asked = || -> Result<Answer, crate::error::InputError> {
        let scene = sweep.scene_with(&parameters)?;
        ask(&sweep.plan.question, &scene, &reuse.prepare(&scene, &sweep.keys(&parameters))?)
    };
    // A mistake in the program costs one row, not the sweep.
    let (answer, error) = match catch_unwind(AssertUnwindSafe(asked)) {
        Ok(Ok(answer)) => (answer, None),
        Ok(Err(e)) => (Answer::of(Status::Error), Some(e.to_string())),
        Err(_) => (Answer::of(Status::Error), Some("the program failed on this scene (please report it)".into())),
    };
    Row { row: number, parameters, answer, error, seconds: start.elapsed().as_secs_f64() }
}
