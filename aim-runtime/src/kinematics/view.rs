//! [`View`]: the target in effector space, and the residuals that the solvers compute from it.

use crate::math::trig;
use crate::{Scalar, math};

/// The target in effector space: components along forward, left and up.
#[derive(Clone, Copy, Debug)]
pub(crate) struct View {
    pub(crate) forward: f32,
    pub(crate) left: f32,
    pub(crate) up: f32,
}

impl View {
    /// Returns the angle off forward, radians, 0…π.
    #[inline]
    pub(crate) fn angle(&self) -> f32 {
        trig::atan2(math::sqrt(self.left * self.left + self.up * self.up), self.forward)
    }

    /// Returns the distance of the target.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(crate) fn distance(&self) -> f32 {
        <f32 as Scalar>::sqrt(self.forward * self.forward + self.left * self.left + self.up * self.up)
    }

    /// Returns the distance of the target from the forward axis.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(crate) fn lateral(&self) -> f32 {
        <f32 as Scalar>::sqrt(self.left * self.left + self.up * self.up)
    }

    /// Returns the tangent of the angle off forward, for a target in front.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(crate) fn tangent(&self) -> f32 {
        self.lateral() / self.forward
    }

    /// Returns `true` if the target is in front and within a small angle of forward. Compares tangents, without an
    /// arctangent.
    #[inline]
    pub(crate) fn is_within(&self, angle_rad: f32) -> bool {
        let lateral = self.left * self.left + self.up * self.up;
        self.forward > 0.0 && lateral <= angle_rad * angle_rad * self.forward * self.forward
    }

    /// Returns the stereographic residual (left, up), of length 2·tan(angle / 2). Undefined for a target exactly
    /// behind.
    #[inline]
    pub(crate) fn residual(&self) -> [f32; 2] {
        let Self { forward, left, up } = *self;
        let per = 2.0 / (math::sqrt(forward * forward + left * left + up * up) + forward);
        [left * per, up * per]
    }

    /// Returns the angle off forward as a vector (left, up), radians.
    #[inline]
    pub(crate) fn offset(&self) -> [f32; 2] {
        let lateral = math::sqrt(self.left * self.left + self.up * self.up);
        // Straight ahead the offset is 0.
        let stretch = if lateral > 0.0 { trig::atan2(lateral, self.forward) / lateral } else { 0.0 };
        [stretch * self.left, stretch * self.up]
    }
}

/// Stretch of the stereographic residual to the length of the angle itself, and the matching transformation of its
/// derivatives.
///
/// The residual is 2·tan(angle / 2) in the target's direction. It grows faster than the angle, so a linear step falls
/// far short of a target far to the side. The derivative of the angle itself is constant.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stretch {
    /// Unit direction of the residual.
    direction: [f32; 2],
    across: f32,
    along_less_across: f32,
}

impl Stretch {
    /// Residual below which nothing is stretched: the error of a step is then at most a third of its cube.
    pub(crate) const SMALL: f32 = 0.05;

    /// Returns the stretched residual, and the stretch if there is one.
    #[inline]
    pub(crate) fn of(residual: [f32; 2]) -> ([f32; 2], Option<Self>) {
        let square = residual[0] * residual[0] + residual[1] * residual[1];
        if square < Self::SMALL * Self::SMALL {
            return (residual, None);
        }
        let length = math::sqrt(square);
        // Across the direction, derivatives scale with angle / length; along it, with d(2·atan(r / 2))/dr = 1 / (1 + r²
        // / 4).
        let across = 2.0 * trig::atan2(length, 2.0) / length;
        let along = 1.0 / (1.0 + 0.25 * square);
        let direction = residual.map(|x| x / length);
        (residual.map(|x| across * x), Some(Self { direction, across, along_less_across: along - across }))
    }

    /// Converts a derivative of the residual to one of the stretched residual.
    pub(crate) fn derivative(&self, [x, y]: [f32; 2]) -> [f32; 2] {
        let [dx, dy] = self.direction;
        let along = self.along_less_across * (dx * x + dy * y);
        [self.across * x + along * dx, self.across * y + along * dy]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The stretched residual in f64: the direction times the angle whose half has the tangent length / 2.
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
        // Nearly straight ahead nothing is stretched; the error is below a third of the cube.
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
