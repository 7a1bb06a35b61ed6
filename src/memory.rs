//! `--max-memory`, and the limits of the system: the process never takes more, and says so when it
//! would have to.
//!
//! Estimates refuse most of what is too large before it begins ([`voussoir::limits`]). What they
//! miss meets this: where there is a limit, the option's or that of a control group, every
//! allocation is counted, and the one that would go beyond ends the program with an error. So does
//! one that the system refuses (`ulimit -v`, a machine without more), where the language would
//! abort. Files that were being written are absent then, as after a kill.

// An allocator is unsafe by its trait, and the system's is asked directly where none is left.
#![allow(unsafe_code)]

use std::{
    alloc::{GlobalAlloc, Layout, System},
    fmt::Write as _,
    io::Write,
    sync::atomic::{AtomicBool, AtomicUsize, Ordering},
};
use voussoir::command::{Exit, Memory};

/// What the program itself, its stacks and the gaps between allocations take at most, bytes.
const OWN: usize = 24 << 20;
/// Bytes the system's allocator adds to each allocation.
const EACH: usize = 16;

static COUNTED: AtomicBool = AtomicBool::new(false);
static USED: AtomicUsize = AtomicUsize::new(0);
static MOST: AtomicUsize = AtomicUsize::new(usize::MAX);
/// Whether the limit is the control group's.
static OF_GROUP: AtomicBool = AtomicBool::new(false);
/// Whether a thread says already that the system gives no more.
static FAILED: AtomicBool = AtomicBool::new(false);

/// The system's allocator, counted once there is a limit.
pub struct Counted;

/// What the command does with a limit, here.
pub const LIMITS: Memory = Memory { limit, heed_group };

/// Begins to count; called before anything large is there.
fn limit(bytes: u64) -> Result<(), String> {
    let most = usize::try_from(bytes).unwrap_or(usize::MAX).saturating_sub(OWN);
    if most < OWN {
        return Err(format!(
            "--max-memory {}: the program itself takes up to {}",
            voussoir::limits::size(bytes),
            voussoir::limits::size(2 * OWN as u64)
        ));
    }
    // Freed memory goes back to the system at once where pieces are large, so that what is counted
    // is what is taken.
    #[cfg(all(target_os = "linux", target_env = "gnu"))]
    // SAFETY: sets numbers of the system's allocator; nothing is passed by reference.
    unsafe {
        libc::mallopt(libc::M_MMAP_THRESHOLD, 128 << 10);
        libc::mallopt(libc::M_TRIM_THRESHOLD, 128 << 10);
        libc::mallopt(libc::M_ARENA_MAX, 2);
    }
    voussoir::limits::set_memory(Some(bytes));
    MOST.store(most, Ordering::Relaxed);
    COUNTED.store(true, Ordering::Relaxed);
    Ok(())
}

/// Begins to count where a control group sets a limit that is lower than the one given: beyond it
/// the system kills without a word.
fn heed_group(given: Option<u64>) {
    let Some(left) = voussoir::limits::group().filter(|left| given.is_none_or(|g| *left < g))
    else {
        return;
    };
    // Pages are not filled to the last byte, and others in the group need some as well.
    let most = usize::try_from(left - left / 20).unwrap_or(usize::MAX);
    OF_GROUP.store(true, Ordering::Relaxed);
    MOST.store(most.saturating_sub(OWN).max(OWN), Ordering::Relaxed);
    COUNTED.store(true, Ordering::Relaxed);
}

fn take(bytes: usize) {
    let used = USED.fetch_add(bytes + EACH, Ordering::Relaxed).wrapping_add(bytes + EACH);
    // What was taken before counting began may be freed now: below zero there is nothing to refuse.
    if used > MOST.load(Ordering::Relaxed) && used < usize::MAX / 2 {
        refuse(bytes);
    }
}

fn give(bytes: usize) {
    USED.fetch_sub(bytes + EACH, Ordering::Relaxed);
}

#[cold]
fn refuse(bytes: usize) {
    // Only the first thread speaks, and may allocate to do so; others wait for the end.
    let most = MOST.swap(usize::MAX, Ordering::Relaxed);
    if most == usize::MAX {
        loop {
            std::thread::park();
        }
    }
    let limit = voussoir::limits::size((most + OWN) as u64);
    let (whose, remedy) = match OF_GROUP.load(Ordering::Relaxed) {
        true => {
            (format!("the control group of this process leaves it ({limit})"), "let it have more")
        }
        false => (format!("--max-memory {limit} allows"), "raise it"),
    };
    let text = format!(
        "error: more memory would be needed than {whose} (the last piece had {})\nhint: {remedy}, or ask about a smaller scene\n",
        voussoir::limits::size(bytes as u64)
    );
    let _ = std::io::stderr().write_all(text.as_bytes());
    std::process::exit(Exit::Usage as i32);
}

/// A thread that finds no memory for its own alternative stack while it starts panics inside the
/// standard library, before anything of ours can see it, and aborts all. It is ended here instead,
/// as where an allocation fails.
pub fn heed_threads() {
    let others = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |panic| {
        if panic.location().is_some_and(|at| at.file().ends_with("stack_overflow.rs")) {
            failed(None);
        }
        others(panic);
    }));
}

/// Ends the program where the system gave nothing: for that many bytes, or for the stack of a
/// thread. Nothing here may ask for memory, unwind or wait for a lock that this thread holds.
#[cold]
fn failed(bytes: Option<usize>) -> ! {
    if FAILED.swap(true, Ordering::Relaxed) {
        // Another thread speaks, and ends all of them.
        loop {
            std::thread::sleep(std::time::Duration::from_secs(1));
        }
    }
    let mut line = Line { text: [0; 256], length: 0 };
    let _ = line.write_str("error: the system gives no more memory (");
    let _ = match bytes {
        Some(bytes) => write!(line, "the last piece had {bytes} bytes"),
        None => line.write_str("a thread could not start"),
    };
    let _ = line.write_str(
        ")\nhint: raise the limit of this process (`ulimit -v`), give --max-memory, or ask about a smaller scene\n",
    );
    end(line.text.get(..line.length).unwrap_or_default())
}

/// Says it and ends at once, without what is done at a proper end: some of that needs memory.
#[cfg(unix)]
fn end(text: &[u8]) -> ! {
    // SAFETY: the bytes are there for the whole call, and the handle is a number; a failure is an
    // answer that nobody can be told.
    unsafe { libc::write(libc::STDERR_FILENO, text.as_ptr().cast(), text.len()) };
    // SAFETY: ends the process; no code of it runs after that.
    unsafe { libc::_exit(Exit::Usage as i32) }
}

#[cfg(not(unix))]
fn end(text: &[u8]) -> ! {
    let _ = std::io::stderr().write_all(text);
    std::process::exit(Exit::Usage as i32)
}

/// A line without memory of its own. What does not fit is left out.
struct Line {
    text: [u8; 256],
    length: usize,
}

impl std::fmt::Write for Line {
    fn write_str(&mut self, more: &str) -> std::fmt::Result {
        for byte in more.bytes() {
            let Some(place) = self.text.get_mut(self.length) else { break };
            *place = byte;
            self.length += 1;
        }
        Ok(())
    }
}

/// What the system gave; the end where it gave nothing.
fn given(place: *mut u8, bytes: usize) -> *mut u8 {
    if place.is_null() {
        failed(Some(bytes));
    }
    place
}

// SAFETY: every call is the system allocator's own, with the same arguments, and what it gives is
// handed on as it is; counting touches atomics alone, and no path unwinds: where the system gives
// nothing the process ends inside the call.
unsafe impl GlobalAlloc for Counted {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        if COUNTED.load(Ordering::Relaxed) {
            take(layout.size());
        }
        given(unsafe { System.alloc(layout) }, layout.size())
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        if COUNTED.load(Ordering::Relaxed) {
            take(layout.size());
        }
        given(unsafe { System.alloc_zeroed(layout) }, layout.size())
    }

    unsafe fn dealloc(&self, place: *mut u8, layout: Layout) {
        if COUNTED.load(Ordering::Relaxed) {
            give(layout.size());
        }
        unsafe { System.dealloc(place, layout) }
    }

    unsafe fn realloc(&self, place: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        if COUNTED.load(Ordering::Relaxed) {
            // Both exist for a moment where the piece moves.
            take(size);
            give(layout.size());
        }
        given(unsafe { System.realloc(place, layout, size) }, size)
    }
}
