//! voussoir as WebAssembly: texts in, texts out. A page puts UTF-8 where [`place`] says, calls
//! [`check_result`] or [`ask_question`], reads the reply where the number that it gets points, and gives
//! both back by [`give_back`]; `module.js` of the report pages does that. There are no generated bindings:
//! nothing but memory, a clock and the words of a failure goes across.

#![warn(missing_docs)]

#[cfg(feature = "solver")]
mod ask;
mod check_text;

#[cfg(feature = "solver")]
pub use ask::{ask, import};
pub use check_text::check;

use std::alloc::Layout;

/// So many bytes with alignment 1; nothing where there are none.
fn layout(length: usize) -> Option<Layout> {
    Layout::array::<u8>(length).ok().filter(|layout| layout.size() > 0)
}

/// Room for a text of so many bytes; 0 where there is none.
#[unsafe(no_mangle)]
pub extern "C" fn place(length: usize) -> *mut u8 {
    // SAFETY: the layout is not empty.
    layout(length).map_or(std::ptr::null_mut(), |l| unsafe { std::alloc::alloc(l) })
}

/// Ends the use of a text.
///
/// # Safety
/// The room is that of [`place`] or of a reply, with that length, and is not used again.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn give_back(at: *mut u8, length: usize) {
    if let Some(layout) = layout(length).filter(|_| !at.is_null()) {
        // SAFETY: what the caller promises.
        unsafe { std::alloc::dealloc(at, layout) }
    }
}

#[link(wasm_import_module = "page")]
unsafe extern "C" {
    /// Hears why a call ends without a reply.
    fn failed(at: *const u8, length: usize);
}

/// The reply to a text: its place, and its length in the upper 32 bits.
///
/// # Safety
/// So many bytes at that place are there to be read.
unsafe fn reply(at: *const u8, length: usize, to: impl Fn(&[u8]) -> String) -> u64 {
    let text = match at.is_null() || length == 0 {
        true => &[][..],
        // SAFETY: what the caller promises.
        false => unsafe { std::slice::from_raw_parts(at, length) },
    };
    std::panic::set_hook(Box::new(|why| {
        let words = why.to_string();
        // SAFETY: the words are there until the page has heard them.
        unsafe { failed(words.as_ptr(), words.len()) }
    }));
    let reply = Box::leak(to(text).into_bytes().into_boxed_slice());
    (reply.len() as u64) << 32 | reply.as_ptr() as u64
}

/// [`check`] of a saved result.
///
/// # Safety
/// So many bytes at that place are there to be read.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn check_result(at: *const u8, length: usize) -> u64 {
    // SAFETY: what the caller promises.
    unsafe { reply(at, length, |text| check(text).to_string()) }
}

/// [`ask`] of a request.
///
/// # Safety
/// So many bytes at that place are there to be read.
#[cfg(feature = "solver")]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ask_question(at: *const u8, length: usize) -> u64 {
    // SAFETY: what the caller promises.
    unsafe { reply(at, length, |text| ask(text).to_string()) }
}

/// [`import`] of a file.
///
/// # Safety
/// So many bytes at that place are there to be read.
#[cfg(feature = "solver")]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn import_file(at: *const u8, length: usize) -> u64 {
    // SAFETY: what the caller promises.
    unsafe { reply(at, length, |text| import(text).to_string()) }
}
