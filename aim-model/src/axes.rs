//! [`Axes`]: the orientation of a bone relative to the character.

use crate::Float;

/// Orientation of a bone relative to the character: three mutually perpendicular unit vectors in the bone's own space.
///
/// `up × forward` is `left` for a right-handed triple and `−left` for a left-handed or mirrored one.
///
/// ```
/// use aim_model::Axes;
///
/// // glTF's: +Y up, +Z forward, and so +X to the left.
/// let gltf = Axes { up: [0.0, 1.0, 0.0], forward: [0.0, 0.0, 1.0], left: [1.0_f32, 0.0, 0.0] };
/// assert_eq!(gltf.handedness(), 1.0);
/// assert_eq!(Axes::<f32>::cardinal().filter(|axes| *axes == gltf).count(), 1);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axes<T = f32> {
    /// Bone-space direction that points up in the character.
    pub up: [T; 3],
    /// Bone-space direction that the character faces.
    pub forward: [T; 3],
    /// Bone-space direction that points to the character's left.
    pub left: [T; 3],
}

impl<T: Float> Axes<T> {
    /// Returns all 48 cardinal conventions: every assignment of signed coordinate axes to up, forward and left, in both
    /// handednesses.
    pub fn cardinal() -> impl Iterator<Item = Self> {
        let unit = |axis: usize, negative: bool| {
            let length = if negative { -T::ONE } else { T::ONE };
            core::array::from_fn(|k| if k == axis { length } else { T::ZERO })
        };
        let orders = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]];
        orders.into_iter().flat_map(move |[up, forward, left]| {
            (0..8).map(move |signs| Self {
                up: unit(up, signs & 1 != 0),
                forward: unit(forward, signs & 2 != 0),
                left: unit(left, signs & 4 != 0),
            })
        })
    }

    /// Returns +1 if `up × forward` is `left` and −1 if it is `−left`: the sign of the triple product
    /// `(up × forward) · left`.
    #[must_use]
    pub fn handedness(&self) -> T {
        let [u, f, l] = [self.up, self.forward, self.left];
        let cross = [u[1] * f[2] - u[2] * f[1], u[2] * f[0] - u[0] * f[2], u[0] * f[1] - u[1] * f[0]];
        (cross[0] * l[0] + cross[1] * l[1] + cross[2] * l[2]).signum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn there_are_48_conventions_half_of_each_handedness() {
        let right = Axes::<f64>::cardinal().filter(|axes| axes.handedness() == 1.0).count();
        assert_eq!((Axes::<f64>::cardinal().count(), right), (48, 24));
    }
}
