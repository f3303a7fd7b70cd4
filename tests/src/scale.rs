//! How many of their cases the tests take.

/// True where the tests take all of their cases, as in `.ci/run`; `cargo test` by itself takes a part.
pub fn in_full() -> bool {
    std::env::var_os("AIM_TEST_SCALE").is_some_and(|scale| scale == "full")
}

/// That many cases in full, otherwise an eighth of them.
pub fn part_of(cases: usize) -> usize {
    if in_full() { cases } else { cases.div_ceil(8) }
}

/// All of them in full, otherwise every fifth: of the rigs under test with every number of joints.
pub fn sampled<T>(all: Vec<T>) -> impl Iterator<Item = T> {
    all.into_iter().step_by(if in_full() { 1 } else { 5 })
}
