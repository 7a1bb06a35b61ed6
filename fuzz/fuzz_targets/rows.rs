//! Bytes → the reader of a sweep's rows.
#![no_main]
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    if let Ok((header, rows)) = voussoir::sweep::parse_rows("fuzzed", bytes) {
        assert!(rows.iter().all(|r| r.row < header.rows));
        let _ = voussoir::sweep::summarize(&header, &rows);
    }
});
