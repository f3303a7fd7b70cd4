//! [`View`]: where the target stands as the effector sees it, and what the solvers make of that.

use crate::{math, trig};

/// The target in effector space: along forward, left and up.
#[derive(Clone, Copy, Debug)]
pub(crate) struct View {
    pub(crate) forward: f32,
    pub(crate) left: f32,
    pub(crate) up: f32,
}

impl View {
    /// The angle off forward, radians, 0…π.
    #[inline]
    pub(crate) fn angle(&self) -> f32 {
        trig::atan2(math::sqrt(self.left * self.left + self.up * self.up), self.forward)
    }

    /// The angle where it is small (below a hundredth), radians.
    #[inline]
    pub(crate) fn small_angle(&self) -> f32 {
        let tangent = math::sqrt(self.left * self.left + self.up * self.up) / self.forward;
        tangent - tangent * tangent * tangent * (1.0 / 3.0)
    }

    /// The square of the angle where it is small: without an arctangent.
    #[inline]
    pub(crate) fn is_within(&self, angle_rad: f32) -> bool {
        let lateral = self.left * self.left + self.up * self.up;
        self.forward > 0.0 && lateral <= angle_rad * angle_rad * self.forward * self.forward
    }

    /// The stereographic residual: left, up. Not for what is behind.
    #[inline]
    pub(crate) fn residual(&self) -> [f32; 2] {
        let Self { forward, left, up } = *self;
        let per = 2.0 / (math::sqrt(forward * forward + left * left + up * up) + forward);
        [left * per, up * per]
    }

    /// The angle as a vector: left, up.
    #[inline]
    pub(crate) fn offset(&self) -> [f32; 2] {
        let lateral = math::sqrt(self.left * self.left + self.up * self.up);
        // Nothing to divide by straight ahead, nor anything to say.
        let stretch = if lateral > 0.0 { trig::atan2(lateral, self.forward) / lateral } else { 0.0 };
        [stretch * self.left, stretch * self.up]
    }
}

/// The stereographic residual stretched to the angle itself, and how its derivatives are stretched with it.
///
/// The residual is 2·tan(angle / 2) in the target's direction: a linear step then falls far short of a target far
/// aside, as the tangent grows faster than the angle. Of the angle itself the derivative is the same everywhere.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stretch {
    /// The residual's direction; zero where nothing is stretched.
    direction: [f32; 2],
    across: f32,
    along_less_across: f32,
}

impl Stretch {
    /// Below this residual a step is right to a third of its cube: nothing is stretched.
    pub(crate) const SMALL: f32 = 0.05;

    /// The residual, stretched.
    #[inline]
    pub(crate) fn of(residual: [f32; 2]) -> ([f32; 2], Option<Self>) {
        let square = residual[0] * residual[0] + residual[1] * residual[1];
        if square < Self::SMALL * Self::SMALL {
            return (residual, None);
        }
        let length = math::sqrt(square);
        let across = 2.0 * trig::atan2(length, 2.0) / length;
        let along = 1.0 / (1.0 + 0.25 * square);
        let direction = residual.map(|x| x / length);
        (residual.map(|x| across * x), Some(Self { direction, across, along_less_across: along - across }))
    }

    /// A derivative of the residual as one of the stretched residual.
    pub(crate) fn derivative(&self, [x, y]: [f32; 2]) -> [f32; 2] {
        let [dx, dy] = self.direction;
        let along = self.along_less_across * (dx * x + dy * y);
        [self.across * x + along * dx, self.across * y + along * dy]
    }
}
