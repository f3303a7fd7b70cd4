//! Tables in documentation pages that tests write.

use std::path::Path;

/// Compares the text between two marks of a page with `table`; with `AIM_BLESS=1` writes it there instead.
///
/// # Panics
/// Panics if the page differs, with the command that updates it.
pub fn hold_table(page: &str, marks: [&str; 2], table: &str, test: &str) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(page);
    let text = std::fs::read_to_string(&path).expect("the page is there");
    let [start, end] = marks.map(|mark| text.split_once(mark).unwrap_or_else(|| panic!("{page} has no {mark}")));
    let fresh = format!("{}{}{table}{}{}", start.0, marks[0], marks[1], end.1);
    if std::env::var_os("AIM_BLESS").is_some_and(|bless| bless == "1") {
        std::fs::write(path, fresh).expect("the page is writable");
    } else {
        assert!(text == fresh, "{page} is stale: AIM_BLESS=1 cargo test -p aim-tests --test it {test}");
    }
}
