//! How many of their cases the tests take.

/// Whether tests take all of their cases, as `.ci/run` has them, or the part that `cargo test` takes by itself.
pub fn in_full() -> bool {
    std::env::var_os("AIM_TEST_SCALE").is_some_and(|scale| scale == "full")
}

/// That many cases in full, otherwise an eighth of them.
pub fn part_of(cases: usize) -> usize {
    if in_full() { cases } else { cases.div_ceil(8) }
}
