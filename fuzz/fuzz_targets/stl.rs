//! `read_stl` on any bytes.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    tetflip_fuzz::check(bytes, tetflip::format::read_stl(bytes));
});
