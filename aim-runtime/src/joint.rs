//! A joint: what is declared of it ([`JointInfo`]) and its state ([`Joint`]).

use crate::Axes;

/// What was declared of a joint. Angles in radians.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct JointInfo {
    /// The bone's axes, in its own space.
    pub axes: Axes,
    /// Range of the heading, `[lo, hi]` around 0; `None` for a joint that does not turn sideways. Infinite where it
    /// was declared `free`.
    pub heading: Option<[f32; 2]>,
    /// Range of the pitch, `[lo, hi]` around 0; `None` for a joint that does not nod.
    pub pitch: Option<[f32; 2]>,
    /// Largest speed of each angle, rad/s.
    pub rate: f32,
    /// Largest change of speed, rad/s²; infinite where none was declared.
    pub acceleration: f32,
    /// Reluctance: the joint's weight in the displacement cost. Only ratios matter.
    pub comfort: f32,
    /// How far heading turns about the character's up instead of the bone's own, 0…1; `None` leaves it to the solver.
    pub level: Option<f32>,
    /// Whether the ranges are counted from the bind pose instead of from the animation.
    pub absolute: bool,
}

impl JointInfo {
    /// A joint with these axes and this rate (rad/s) and no angle yet.
    pub const fn new(axes: Axes, rate: f32) -> Self {
        Self {
            axes,
            heading: None,
            pitch: None,
            rate,
            acceleration: f32::INFINITY,
            comfort: 1.0,
            level: None,
            absolute: false,
        }
    }

    /// With a heading in `lo..=hi`.
    pub const fn with_heading(mut self, lo: f32, hi: f32) -> Self {
        self.heading = Some([lo, hi]);
        self
    }

    /// With a pitch in `lo..=hi`.
    pub const fn with_pitch(mut self, lo: f32, hi: f32) -> Self {
        self.pitch = Some([lo, hi]);
        self
    }

    /// With this acceleration, rad/s².
    pub const fn with_acceleration(mut self, acceleration: f32) -> Self {
        self.acceleration = acceleration;
        self
    }

    /// With this comfort.
    pub const fn with_comfort(mut self, comfort: f32) -> Self {
        self.comfort = comfort;
        self
    }

    /// With this level.
    pub const fn with_level(mut self, level: f32) -> Self {
        self.level = Some(level);
        self
    }

    /// With ranges counted from the bind pose.
    pub const fn with_absolute_range(mut self) -> Self {
        self.absolute = true;
        self
    }
}

/// A joint's state: the two angles added to the animation, radians. The default is rest: both 0.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Joint {
    heading: f32,
    pitch: f32,
}

impl Joint {
    /// The added heading, radians: positive turns forward towards left.
    pub fn heading(&self) -> f32 {
        self.heading
    }

    /// The added pitch, radians: positive turns forward towards up.
    pub fn pitch(&self) -> f32 {
        self.pitch
    }
}
