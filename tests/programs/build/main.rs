//! Writes random functions twice: for `#[differentiate]`, and for dual numbers.

mod writer;

use std::path::PathBuf;
use std::{env, fs};

fn main() {
    println!("cargo::rerun-if-changed=build");
    println!("cargo::rerun-if-env-changed=AIM_PROGRAMS");
    // The range of program numbers, end excluded.
    let range = env::var("AIM_PROGRAMS").unwrap_or_else(|_| "0..20".to_owned());
    let (first, end) = range.split_once("..").expect("AIM_PROGRAMS is a range like 0..20");
    let [first, end] = [first, end].map(|number| number.parse::<u64>().expect("AIM_PROGRAMS is a range of numbers"));
    let (mut rust, mut rows) = (String::new(), String::new());
    for start in (first..end).step_by(10) {
        let numbers = start..end.min(start + 10);
        rust += &writer::modules(numbers.clone());
        for n in numbers {
            rows += &format!("({n}, programs_{start}::program_{n}_gradient, twins_{start}::program_{n}),\n");
        }
    }
    rust += &format!("const PROGRAMS: &[(u64, Companion, Twin)] = &[\n{rows}];\n");
    let out = PathBuf::from(env::var_os("OUT_DIR").expect("cargo sets it"));
    fs::write(out.join("programs.rs"), rust).expect("the output folder is writable");
}
