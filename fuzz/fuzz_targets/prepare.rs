//! Bytes → scene → assembly → interfaces.
#![no_main]
libfuzzer_sys::fuzz_target!(|bytes: &[u8]| -> libfuzzer_sys::Corpus {
    voussoir_fuzz::scene(bytes, true)
});
