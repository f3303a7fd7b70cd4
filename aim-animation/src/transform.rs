//! [`Transform`]: a bone's transform in its parent's space, as translation, rotation and scale.

use aim_runtime::glam::{Affine3A, Mat3A, Quat, Vec3, Vec3A};
use aim_runtime::rotation::{cross, dot, length, nearest_orthogonal, product, turned, unit};

/// A bone's transform in its parent's space: scale is applied first, then rotation, then translation.
///
/// This is the local transform used throughout the project. Skew, which hardly any bone has, is kept separately in
/// [`SkewedTransform`](crate::SkewedTransform).
///
/// ```
/// use aim_animation::Transform;
/// use aim_animation::glam::{Quat, Vec3};
///
/// let mut hand = Transform::from_translation(Vec3::X);
/// hand.turn(Quat::from_rotation_z(core::f32::consts::FRAC_PI_2));
/// assert!(hand.to_affine().transform_point3(Vec3::X).abs_diff_eq(Vec3::new(1.0, 1.0, 0.0), 1e-6));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default))]
pub struct Transform {
    /// Position of the bone's origin, in units of the parent.
    pub translation: Vec3,
    /// Rotation, a unit quaternion.
    pub rotation: Quat,
    /// Factors along the bone's own axes; negative ones mirror the bone, 0 hides it.
    pub scale: Vec3,
}

impl Default for Transform {
    fn default() -> Self {
        Self::IDENTITY
    }
}

impl Transform {
    /// No translation, no rotation, scale 1.
    pub const IDENTITY: Self = Self { translation: Vec3::ZERO, rotation: Quat::IDENTITY, scale: Vec3::ONE };

    /// A transform with scale 1.
    #[must_use]
    pub const fn new(translation: Vec3, rotation: Quat) -> Self {
        Self { translation, rotation, scale: Vec3::ONE }
    }

    /// A transform with a translation only.
    #[must_use]
    pub const fn from_translation(translation: Vec3) -> Self {
        Self { translation, ..Self::IDENTITY }
    }

    /// A transform with a rotation only, given as a unit quaternion.
    #[must_use]
    pub const fn from_rotation(rotation: Quat) -> Self {
        Self { rotation, ..Self::IDENTITY }
    }

    /// Returns the affine map from the bone's space to its parent's.
    #[must_use]
    #[inline]
    pub fn to_affine(&self) -> Affine3A {
        let Mat3A { x_axis, y_axis, z_axis } = Mat3A::from_quat(self.rotation);
        let Vec3 { x, y, z } = self.scale;
        let matrix3 = Mat3A::from_cols(x_axis * x, y_axis * y, z_axis * z);
        Affine3A { matrix3, translation: self.translation.into() }
    }

    /// Decomposes an affine map; `None` if it is not finite.
    ///
    /// The scale has the lengths of the columns; the rotation is the [nearest](nearest_orthogonal) to their directions.
    /// Skew is lost ([`SkewedTransform`](crate::SkewedTransform) keeps it). A mirrored map gets a negative scale along
    /// x. If one column is zero, the rotation follows from the other two; if more are zero, or columns are parallel, it
    /// is the identity.
    #[must_use]
    pub fn from_affine(affine: &Affine3A) -> Option<Self> {
        if !affine.is_finite() {
            return None;
        }
        let (frame, mirrored, mut scale) = frame_and_scale(&affine.matrix3);
        if mirrored {
            scale.x = -scale.x;
        }
        let rotation = unit(Quat::from_mat3a(&frame)).unwrap_or(Quat::IDENTITY);
        scale.is_finite().then_some(Self { translation: affine.translation.into(), rotation, scale })
    }

    /// Returns `true` if translation, rotation and scale are finite and the rotation is a unit quaternion to 1e-4.
    #[must_use]
    pub fn is_sound(&self) -> bool {
        let off = dot(self.rotation, self.rotation) - 1.0;
        self.translation.is_finite() && self.scale.is_finite() && off.abs() < 2e-4
    }

    /// Returns the rigid transform `self · other`: `other` in the space of `self`. Scales are ignored; the result has
    /// scale 1.
    ///
    /// ```
    /// use aim_animation::Transform;
    /// use aim_animation::glam::{Quat, Vec3};
    ///
    /// // A step of 1 m ahead (+Z), by a character that faces +X.
    /// let place = Transform::new(Vec3::ZERO, Quat::from_rotation_y(core::f32::consts::FRAC_PI_2));
    /// let step = Transform::from_translation(Vec3::Z);
    /// assert!(place.rigid_product(&step).translation.abs_diff_eq(Vec3::X, 1e-6));
    /// assert!(step.rigid_product(&step.rigid_inverse()) == Transform::IDENTITY);
    /// ```
    #[must_use]
    pub fn rigid_product(&self, other: &Self) -> Self {
        Self::new(self.translation + self.turned(other.translation), made_unit(product(self.rotation, other.rotation)))
    }

    /// Returns the inverse of the rigid transform. The scale is ignored; the result has scale 1.
    #[must_use]
    pub fn rigid_inverse(&self) -> Self {
        let rotation = made_unit(self.rotation.conjugate());
        Self::new(-Self::from_rotation(rotation).turned(self.translation), rotation)
    }

    /// Rotates the bone in its own space, as when a joint is corrected: `local' = local · rotation`. The scale does not
    /// change; if it mirrors, the rotation is mirrored accordingly.
    pub fn turn(&mut self, rotation: Quat) {
        // With a mirror S, the rotation is S·R·S⁻¹: about the mirrored axis, and by the opposite angle if det S < 0.
        let sign = self.scale.signum();
        let axis = Vec3::new(rotation.x, rotation.y, rotation.z) * (sign * (sign.x * sign.y * sign.z));
        let turn = Quat::from_xyzw(axis.x, axis.y, axis.z, rotation.w);
        self.rotation = made_unit(product(self.rotation, turn));
    }

    /// Rotates a vector.
    fn turned(&self, v: Vec3) -> Vec3 {
        turned(self.rotation, v.into()).into()
    }
}

/// Returns the quaternion with length 1; the identity if it cannot be normalised.
pub(crate) fn made_unit(rotation: Quat) -> Quat {
    unit(rotation).unwrap_or(Quat::IDENTITY)
}

/// Returns a right-handed frame for the columns, whether its x axis had to be mirrored for that, and the lengths of the
/// columns.
fn frame_and_scale(m: &Mat3A) -> (Mat3A, bool, Vec3) {
    let columns = [m.x_axis, m.y_axis, m.z_axis];
    let scale = Vec3::from_array(columns.map(length));
    let Some(mut frame) = nearest_orthogonal(completed(columns)) else { return (Mat3A::IDENTITY, false, scale) };
    let mirrored = frame.determinant() < 0.0;
    if mirrored {
        frame.x_axis = -frame.x_axis;
    }
    (frame, mirrored, scale)
}

/// Normalises the columns. A single zero column becomes perpendicular to the others.
fn completed(columns: [Vec3A; 3]) -> Mat3A {
    let mut unit = columns.map(|column| {
        let length = length(column);
        if length > 0.0 { column / length } else { Vec3A::ZERO }
    });
    for i in 0..3 {
        if unit[i] == Vec3A::ZERO {
            unit[i] = cross(unit[(i + 1) % 3], unit[(i + 2) % 3]);
        }
    }
    Mat3A::from_cols(unit[0], unit[1], unit[2])
}
