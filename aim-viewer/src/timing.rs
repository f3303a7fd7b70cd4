//! [`Timing`]: how long solving takes.

/// Times of solving: means over about the last second.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Timing {
    /// One character's solver, seconds a frame.
    pub(crate) one: f64,
    /// All of the crowd's, seconds a frame.
    pub(crate) crowd: f64,
    /// Between frames, seconds.
    pub(crate) between: f64,
}

impl Timing {
    /// One part in so many of the mean is the newest frame.
    const MEMORY: f64 = 60.0;

    pub(crate) fn note(mean: &mut f64, seconds: f64) {
        *mean = if *mean == 0.0 { seconds } else { *mean + (seconds - *mean) / Self::MEMORY };
    }
}
