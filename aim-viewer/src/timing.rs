//! [`Timing`]: the time that solving takes.

/// Solving times, averaged over about the last second.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Timing {
    /// Time of the solver for one character, seconds per frame.
    pub(crate) one: f64,
    /// Time of the solvers for the whole crowd, seconds per frame.
    pub(crate) crowd: f64,
    /// Time between frames, seconds.
    pub(crate) between: f64,
}

impl Timing {
    /// Time constant of the exponential mean, in frames.
    const MEMORY: f64 = 60.0;

    pub(crate) fn note(mean: &mut f64, seconds: f64) {
        *mean = if *mean == 0.0 { seconds } else { *mean + (seconds - *mean) / Self::MEMORY };
    }
}
