//! Counts the objectives that are checked, from the source text of the tests.

use std::collections::BTreeSet;
use std::path::Path;

/// Returns the names that follow `before` in the text.
fn names<'t>(text: &'t str, before: &str) -> BTreeSet<&'t str> {
    let starts = text.match_indices(before).map(|(at, _)| &text[at + before.len()..]);
    starts.map(|rest| rest.split(|c: char| !c.is_alphanumeric() && c != '_').next().unwrap_or_default()).collect()
}

/// Counts the functions of a file that both central differences and dual numbers check.
fn judged(file: &str) -> usize {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/it").join(file);
    let text = std::fs::read_to_string(path).expect("the tests are there");
    // Called by name, or through the macro of `fields`.
    (&names(&text, "dual::") | &names(&text, "check!("))
        .iter()
        .filter(|name| name.starts_with(char::is_lowercase))
        .count()
}

#[test]
fn fifty_objectives_are_judged_of_which_half_are_natural() {
    let natural = judged("natural.rs") + judged("fields/mod.rs");
    let others: usize = ["aiming.rs", "branches.rs", "distances.rs", "energies.rs", "limits.rs", "rotations.rs"]
        .map(judged)
        .iter()
        .sum();
    println!("{natural} with loops, helpers and structs, {others} others");
    assert!(natural >= 25 && natural + others >= 50, "{natural} and {others}");
}
