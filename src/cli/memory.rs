//! `--max-memory`: the process never takes more.
//!
//! Estimates refuse most of what is too large before it begins ([`voussoir::limits`]). What they miss meets this: every allocation is
//! counted, and the one that would go beyond ends the program with an error. Files that were being written are absent then, as after a kill.

use super::exit::Exit;
use std::{
    alloc::{GlobalAlloc, Layout, System},
    io::Write,
    sync::atomic::{AtomicBool, AtomicUsize, Ordering},
};

/// What the program itself, its stacks and the gaps between allocations take at most, bytes.
const OWN: usize = 24 << 20;
/// Bytes the system's allocator adds to each allocation.
const EACH: usize = 16;

static COUNTED: AtomicBool = AtomicBool::new(false);
static USED: AtomicUsize = AtomicUsize::new(0);
static MOST: AtomicUsize = AtomicUsize::new(usize::MAX);

/// The system's allocator, counted once there is a limit.
pub struct Counted;

/// Begins to count; called before anything large is there.
pub fn limit(bytes: u64) -> anyhow::Result<()> {
    let most = usize::try_from(bytes).unwrap_or(usize::MAX).saturating_sub(OWN);
    if most < OWN {
        anyhow::bail!(
            "--max-memory {}: the program itself takes up to {}",
            voussoir::limits::size(bytes),
            voussoir::limits::size(2 * OWN as u64)
        );
    }
    // Freed memory goes back to the system at once where pieces are large, so that what is counted is what is taken.
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
    let text = format!(
        "error: more memory would be needed than --max-memory {limit} allows (the last piece had {})\nhint: raise it, or ask about a smaller scene\n",
        voussoir::limits::size(bytes as u64)
    );
    let _ = std::io::stderr().write_all(text.as_bytes());
    std::process::exit(Exit::Usage as i32);
}

// SAFETY: every call is the system allocator's own, with the same arguments; counting touches atomics alone.
unsafe impl GlobalAlloc for Counted {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        if COUNTED.load(Ordering::Relaxed) {
            take(layout.size());
        }
        unsafe { System.alloc(layout) }
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        if COUNTED.load(Ordering::Relaxed) {
            take(layout.size());
        }
        unsafe { System.alloc_zeroed(layout) }
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
        unsafe { System.realloc(place, layout, size) }
    }
}
