//! `--time-limit`: the last resort. Every stage watches the time itself and gives what it has; what
//! does not (a stage without programs on an enormous scene) is ended here, with a word.

use super::{exit::Exit, terminal};
use std::time::Duration;
use voussoir::deadline::Deadline;

/// Time that is left for packing and checking an answer, as a share of the limit and in seconds.
/// More: the limit means little. Less: answers with a bracket are cut off while they are written
/// down.
const SHARE: f64 = 0.5;
const SECONDS: f64 = 2.0;

/// The share of a limit that programs may take; with the iteration that is under way, the check and
/// the output the whole takes no more than a tenth beyond the limit. More: answers come late. Less:
/// answers that would still have been found are not.
const PROGRAMS: f64 = 0.9;

/// When programs have to end, where there is a limit: [`watch`].
pub fn of(limit: Option<f64>) -> Deadline {
    limit.map_or(Deadline::NEVER, watch)
}

/// When programs have to end within a limit that begins now; ends the process once the limit is
/// well past.
fn watch(limit: f64) -> Deadline {
    let deadline = Deadline::within(PROGRAMS * limit);
    let Ok(patience) = Duration::try_from_secs_f64(limit * (1.0 + SHARE) + SECONDS) else {
        return deadline;
    };
    // Without a thread there is no last resort, and the stages still watch the time.
    let _ = std::thread::Builder::new().name("time limit".into()).spawn(move || {
        std::thread::sleep(patience);
        terminal::say(&format!(
            "error: time limit of {limit} s reached without an answer\nhint: raise --time-limit, or ask about a smaller scene"
        ));
        std::process::exit(Exit::Undecided as i32);
    });
    deadline
}
