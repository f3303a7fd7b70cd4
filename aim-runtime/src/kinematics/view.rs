//! [`View`]: where the target stands as the effector sees it, and what the solvers make of that.

use crate::math::trig;
use crate::{Scalar, math};

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

    /// How far away the target is.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(crate) fn distance(&self) -> f32 {
        <f32 as Scalar>::sqrt(self.forward * self.forward + self.left * self.left + self.up * self.up)
    }

    /// How far off forward the target is.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(crate) fn lateral(&self) -> f32 {
        <f32 as Scalar>::sqrt(self.left * self.left + self.up * self.up)
    }

    /// The tangent of the angle off forward, for a target in front.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(crate) fn tangent(&self) -> f32 {
        self.lateral() / self.forward
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

#[cfg(test)]
mod tests {
    use super::*;

    /// The stretched residual in f64: the direction times the angle that the residual is twice the half tangent of.
    fn stretched([x, y]: [f64; 2]) -> [f64; 2] {
        let length = x.hypot(y);
        let angle = 2.0 * (0.5 * length).atan();
        [x / length * angle, y / length * angle]
    }

    #[test]
    fn a_stretch_is_the_angle_and_its_derivative() {
        for step in 0..64_u8 {
            let (sin, cos) = (f64::from(step) * 0.1).sin_cos();
            for length in [0.051, 0.1, 0.5, 1.0, 2.0, 5.0, 30.0, 120.0] {
                let residual = [length * cos, length * sin];
                #[expect(clippy::cast_possible_truncation, reason = "rounding to f32 is meant")]
                let (offset, stretch) = Stretch::of(residual.map(|x| x as f32));
                let stretch = stretch.expect("large enough to be stretched");
                let exact = stretched(residual);
                for (a, b) in offset.into_iter().zip(exact) {
                    assert!((f64::from(a) - b).abs() < 2e-6, "{residual:?}: {offset:?} for {exact:?}");
                }
                for direction in [[1.0_f32, 0.0], [0.0, 1.0], [0.6, -0.8]] {
                    let h = 1e-5 * length;
                    let by = |sign: f64| {
                        let [x, y] = direction.map(f64::from);
                        stretched([residual[0] + sign * h * x, residual[1] + sign * h * y])
                    };
                    let (more, less) = (by(1.0), by(-1.0));
                    for (a, (b, c)) in stretch.derivative(direction).into_iter().zip(more.into_iter().zip(less)) {
                        let exact = (b - c) / (2.0 * h);
                        assert!((f64::from(a) - exact).abs() < 2e-5, "{residual:?} along {direction:?}: {a}, {exact}");
                    }
                }
            }
        }
        // Nearly straight ahead there is nothing to stretch, by less than a third of a cube.
        let small = [0.03, 0.02];
        let (offset, stretch) = Stretch::of(small);
        assert!(offset == small && stretch.is_none());
    }

    #[test]
    fn an_offset_is_the_angle() {
        for (forward, left, up) in
            [(1.0_f32, 0.0, 0.0), (1.0, 1.0, 0.0), (-1.0, 0.0, 1e-3), (0.0, -3.0, 4.0), (-2.0, 0.0, 0.0)]
        {
            let view = View { forward, left, up };
            let exact = f64::from(left).hypot(up.into()).atan2(forward.into());
            assert!((f64::from(view.angle()) - exact).abs() < 1e-6, "{view:?}");
            let [a, b] = view.offset();
            if left != 0.0 || up != 0.0 {
                assert!((f64::from(a).hypot(b.into()) - exact).abs() < 1e-6 && a * up == b * left, "{view:?}");
                assert!(a * left >= 0.0 && b * up >= 0.0);
            }
            assert_eq!(view.is_within(0.01), exact < 0.01);
        }
        let view = View { forward: 2.0, left: 1e-3, up: 0.0 };
        assert!(view.is_within(5.1e-4) && !view.is_within(4.9e-4));
        assert!(!View { forward: f32::NAN, ..view }.is_within(1.0) && !View { left: f32::NAN, ..view }.is_within(1.0));
    }
}
