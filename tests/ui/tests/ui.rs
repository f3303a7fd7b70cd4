//! What users read when a declaration is wrong, word for word, and that nothing else is reported beside it.
//!
//! The texts around ours are rustc's and change with it: the errors are compared with the toolchain that wrote them
//! only. `TRYBUILD=overwrite cargo test -p aim-ui` rewrites them.

use std::process::Command;

/// The rustc whose words the `.stderr` files hold.
const WRITTEN_WITH: &str = "rustc 1.95.";

#[test]
fn errors() {
    let rustc = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let version = Command::new(rustc).arg("--version").output().expect("rustc tells its version");
    let version = String::from_utf8_lossy(&version.stdout);
    if !version.starts_with(WRITTEN_WITH) {
        eprintln!("skipped: the expected errors are those of {WRITTEN_WITH}x, this is {version}");
        return;
    }
    trybuild::TestCases::new().compile_fail("err/*.rs");
}

#[test]
fn accepted() {
    trybuild::TestCases::new().pass("ok/*.rs");
}
