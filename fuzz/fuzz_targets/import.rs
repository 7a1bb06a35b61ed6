//! Bytes → the importer of the format that they look like. What it makes is a scene: written and read again
//! it is the same.
#![no_main]
use libfuzzer_sys::fuzz_target;
use voussoir::import::{ImportOptions, import_bytes};

fuzz_target!(|bytes: &[u8]| {
    let options = ImportOptions { depth: Some(1.0), ..ImportOptions::default() };
    match import_bytes("fuzzed", bytes, &options) {
        Err(e) => voussoir_fuzz::said(&e),
        Ok(imported) => {
            let text = serde_json::to_string(&imported.scene).expect("a scene has a JSON form");
            assert!(
                serde_json::from_str::<voussoir::scene::Scene>(&text).expect("and is read")
                    == imported.scene
            );
        }
    }
});
