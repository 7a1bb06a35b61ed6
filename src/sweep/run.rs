//! Rows → answers, on as many threads as wanted, each written as it ends.

use super::{Folder, Header, Opened, Row, RowAnswer, RowStatus, RowsFile, Shard, Sweep};
use analysis::{Control, Question, ask_among, model_cache::Reuse, saved};
use base::error::RowsError;
use cholesky::parallel;
use solve::deadline::Deadline;
use std::{
    collections::HashSet,
    panic::{AssertUnwindSafe, catch_unwind},
    path::Path,
    sync::{Mutex, PoisonError},
    time::Instant,
};

/// How a sweep is run. None of it changes a row.
#[derive(Clone, Copy, Debug, Default)]
pub struct RunOptions {
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
    /// Rows of this shard, rows that were there already, bytes of a half-written line that were cut
    /// off.
    Begin {
        /// Rows of this shard.
        rows: usize,
        /// Rows that were there already.
        there: usize,
        /// Bytes of a half-written row that were cut off.
        mended: usize,
        /// Rows that were there and have no check sum, as older versions wrote them.
        unchecked: usize,
    },
    /// A row has been written.
    Row(RowStatus),
}

/// A sweep that has ended.
#[derive(Debug)]
pub struct Done {
    /// What the rows are about.
    pub header: Header,
    /// Every row of the shard, by number.
    pub rows: Vec<Row>,
    /// How often blocks were resolved, contacts detected and machines made.
    pub computed: [usize; 3],
}

/// Answers the rows of a shard that are not in the file `path` yet, each appended as it ends.
///
/// Rows that share shapes are done one after the other, so that contacts are found once for all of
/// them.
///
/// # Errors
/// The file cannot be used. Rows that fail are rows with their error.
pub fn run(
    sweep: &Sweep,
    path: &Path,
    options: &RunOptions,
    watch: &(dyn Fn(Event) + Sync),
) -> Result<Done, RowsError> {
    run_until(sweep, path, options, watch, Deadline::NEVER)
}

/// The same; no row is begun any more once the deadline is over, and rows that it cuts short are
/// dropped. A later run does those that are missing.
///
/// # Errors
/// As [`run`].
pub fn run_until(
    sweep: &Sweep,
    path: &Path,
    options: &RunOptions,
    watch: &(dyn Fn(Event) + Sync),
    deadline: Deadline,
) -> Result<Done, RowsError> {
    let header = sweep.header(options.shard);
    let Opened { file, rows, mended, unchecked } = RowsFile::open(path, &header, options.restart)?;
    let there: HashSet<usize> = rows.iter().map(|r| r.row).collect();
    let open =
        options.shard.rows(sweep.rows()).filter(|row| !there.contains(row)).collect::<Vec<_>>();
    watch(Event::Begin { rows: there.len() + open.len(), there: there.len(), mended, unchecked });
    let (more, computed) = answers(sweep, &file, open, options.threads, watch, deadline)?;
    let mut rows = rows;
    rows.extend(more);
    rows.sort_by_key(|r| r.row);
    Ok(Done { header, rows, computed })
}

/// Answers the rows of a shard that no file of the folder holds yet, each appended to a file of its
/// own, `name` with an ending, as it ends. Returns how many there were.
///
/// # Errors
/// A file cannot be used.
pub fn run_in(
    sweep: &Sweep,
    folder: &Folder,
    name: &str,
    options: &RunOptions,
    watch: &(dyn Fn(Event) + Sync),
) -> Result<usize, RowsError> {
    let there = folder.read()?.rows;
    let mine: Vec<usize> = options.shard.rows(sweep.rows()).collect();
    let open: Vec<usize> = mine.iter().copied().filter(|row| !there.contains_key(row)).collect();
    watch(Event::Begin {
        rows: mine.len(),
        there: mine.len() - open.len(),
        mended: 0,
        unchecked: 0,
    });
    if open.is_empty() {
        return Ok(0);
    }
    let file = RowsFile::fresh(&folder.rows_folder(), name, &sweep.header(options.shard))?;
    Ok(answers(sweep, &file, open, options.threads, watch, Deadline::NEVER)?.0.len())
}

/// Rows, spread evenly over those of `open`, one after the other until there are `most` or
/// `seconds` have passed: how long one takes. They are appended to `file`, where there is one.
///
/// # Errors
/// The file cannot be written.
pub fn measure(
    sweep: &Sweep,
    open: &[usize],
    most: usize,
    seconds: f64,
    file: Option<&RowsFile>,
) -> Result<Option<f64>, RowsError> {
    let start = Instant::now();
    let (reuse, mut done, mut sum) = (Reuse::default(), 0_usize, 0.0);
    for &number in open.iter().step_by(open.len().div_ceil(most.max(1)).max(1)) {
        let row = answer(sweep, &reuse, number, Deadline::NEVER);
        (done, sum) = (done + 1, sum + row.seconds);
        file.map_or(Ok(()), |file| file.append(&row))?;
        if start.elapsed().as_secs_f64() > seconds {
            break;
        }
    }
    Ok((done > 0).then(|| sum / done as f64))
}

/// Answers rows, each appended as it ends. Also how often blocks were resolved, contacts detected
/// and machines made.
fn answers(
    sweep: &Sweep,
    file: &RowsFile,
    mut open: Vec<usize>,
    threads: Option<usize>,
    watch: &(dyn Fn(Event) + Sync),
    deadline: Deadline,
) -> Result<(Vec<Row>, [usize; 3]), RowsError> {
    open.sort_by_cached_key(|row| (sweep.keys(&sweep.parameters(*row)), *row));
    let threads = threads.unwrap_or(0);
    let reuse = Reuse::default();
    let rows = Mutex::new(Vec::new());
    parallel::for_each(threads, &open, |&number| {
        if deadline.is_over() {
            return Ok(());
        }
        let row = answer(sweep, &reuse, number, deadline);
        // What was cut short is not the answer that the row has with all its time.
        if deadline.is_over() {
            return Ok(());
        }
        file.append(&row)?;
        watch(Event::Row(row.answer.status));
        rows.lock().unwrap_or_else(PoisonError::into_inner).push(row);
        Ok(())
    })
    .map_err(|e| RowsError::Threads { threads, cause: e.to_string() })??;
    Ok((rows.into_inner().unwrap_or_else(PoisonError::into_inner), reuse.computed()))
}

/// One row.
pub(super) fn answer(sweep: &Sweep, reuse: &Reuse, number: usize, deadline: Deadline) -> Row {
    let start = Instant::now();
    let parameters = sweep.parameters(number);
    let asked = || -> Result<RowAnswer, base::error::InputError> {
        let scene = sweep.scene_with(&parameters)?;
        let keys = sweep.keys(&parameters);
        let model = reuse.prepare(&scene, &keys, &|| deadline.is_over())?;
        let control = Control { deadline, ..Control::default() };
        let question = sweep.question_with(&parameters)?.for_one_number();
        let answer = ask_among(&question, &scene, &model, &control, (reuse, &keys))?;
        let quake = matches!(question, Question::Kinematic(_));
        let file = quake.then(|| saved::of(&question, &scene, &model, &answer)).transpose()?;
        Ok(RowAnswer::of_answer(&answer).with_site(file.as_ref()))
    };
    // A mistake in the program costs one row, not the sweep.
    let (answer, error) = match catch_unwind(AssertUnwindSafe(asked)) {
        Ok(Ok(answer)) => (answer, None),
        Ok(Err(e)) => (RowAnswer::of(RowStatus::Error), Some(e.to_string())),
        Err(_) => (
            RowAnswer::of(RowStatus::Error),
            Some("the program failed on this scene (please report it)".into()),
        ),
    };
    Row { row: number, parameters, answer, error, seconds: start.elapsed().as_secs_f64() }
}
