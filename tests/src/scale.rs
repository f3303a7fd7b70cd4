//! The share of their cases that the tests run.

/// Returns `true` if the tests run all of their cases, as in `.ci/run`; plain `cargo test` runs a part.
pub fn in_full() -> bool {
    std::env::var_os("AIM_TEST_SCALE").is_some_and(|scale| scale == "full")
}

/// Returns `cases` in full runs, otherwise an eighth of them.
pub fn part_of(cases: usize) -> usize {
    if in_full() { cases } else { cases.div_ceil(8) }
}

/// Returns all items in full runs, otherwise every fifth. Every fifth of the rigs under test includes every number of
/// joints.
pub fn sampled<T>(all: Vec<T>) -> impl Iterator<Item = T> {
    all.into_iter().step_by(if in_full() { 1 } else { 5 })
}
