//! Bytes → the result reader → its verification. A changed result may be refused or, where nothing
//! that matters changed, proved; it must do so without a panic.
#![no_main]
use libfuzzer_sys::fuzz_target;
use voussoir::proof::{read, verify};

fuzz_target!(|bytes: &[u8]| {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    let _ = read::is_result(text);
    match read::read_str("fuzzed", text) {
        Err(e) => voussoir_fuzz::said(&e),
        Ok(file) => {
            if voussoir_fuzz::is_small(&file.scene) {
                let _ = verify(&file, &file.scene).map_err(|e| voussoir_fuzz::said(&e));
            }
        }
    }
});
