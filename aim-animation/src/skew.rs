//! [`Skew`] and [`SkewedTransform`]: the part of an affine map beyond translation, rotation and scale.

use aim_runtime::glam::{Affine3A, Mat3A, Quat, Vec3, Vec3A};
use aim_runtime::rotation::{gram_schmidt, length, unit};

use crate::transform::Transform;

/// Shear of a bone's axes: tangents of the angles by which they lean towards each other. Any finite values are valid.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Skew {
    /// Lean of y towards x.
    pub xy: f32,
    /// Lean of z towards x.
    pub xz: f32,
    /// Lean of z towards y.
    pub yz: f32,
}

impl Skew {
    /// No skew: perpendicular axes.
    pub const NONE: Self = Self { xy: 0.0, xz: 0.0, yz: 0.0 };

    /// Matrix whose columns are the leaning axes, as unit vectors: x, then y leaning towards x, then z leaning towards
    /// both.
    #[must_use]
    pub fn to_mat3(self) -> Mat3A {
        let made_unit = |column: Vec3A| column / length(column);
        let [y, z] = [Vec3A::new(self.xy, 1.0, 0.0), Vec3A::new(self.xz, self.yz, 1.0)].map(made_unit);
        Mat3A::from_cols(Vec3A::X, y, z)
    }

    /// Linear interpolation; gives `other` at `weight` 1.
    #[must_use]
    pub fn lerp(self, other: Self, weight: f32) -> Self {
        let lerp = |a: f32, b: f32| a * (1.0 - weight) + b * weight;
        Self { xy: lerp(self.xy, other.xy), xz: lerp(self.xz, other.xz), yz: lerp(self.yz, other.yz) }
    }
}

/// A transform with skew: scale is applied first, then skew, rotation and translation. Can represent any invertible
/// affine map.
///
/// ```
/// use aim_animation::SkewedTransform;
/// use aim_animation::glam::{Affine3A, Mat3A, Quat, Vec3};
///
/// // A bone under a parent of uneven scale is skewed in the space of the model.
/// let parent = Affine3A::from_scale(Vec3::new(1.0, 3.0, 1.0));
/// let bone = parent * Affine3A::from_quat(Quat::from_rotation_z(0.5));
/// let parts = SkewedTransform::from_affine(&bone).unwrap();
/// assert!(parts.skew.xy != 0.0 && parts.to_affine().abs_diff_eq(bone, 1e-5));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SkewedTransform {
    /// Translation, rotation and scale.
    pub transform: Transform,
    /// Skew, applied between scale and rotation.
    pub skew: Skew,
}

impl SkewedTransform {
    /// Returns the affine map from the bone's space to its parent's.
    #[must_use]
    pub fn to_affine(&self) -> Affine3A {
        let Transform { translation, rotation, scale } = self.transform;
        let Mat3A { x_axis, y_axis, z_axis } = Mat3A::from_quat(rotation) * self.skew.to_mat3();
        let matrix3 = Mat3A::from_cols(x_axis * scale.x, y_axis * scale.y, z_axis * scale.z);
        Affine3A { matrix3, translation: translation.into() }
    }

    /// Decomposes an affine map, exactly up to rounding; `None` if its columns are linearly dependent to 1e-5, or if it
    /// is not finite.
    ///
    /// The scale has the lengths of the columns, as in [`Transform::from_affine`]. The rotation keeps the x axis of the
    /// map, and the plane of its x and y axes. A mirrored map gets a negative scale along x.
    #[must_use]
    pub fn from_affine(affine: &Affine3A) -> Option<Self> {
        let m = affine.matrix3;
        let mut frame = gram_schmidt(m)?;
        let columns = [m.x_axis, m.y_axis, m.z_axis];
        let mut scale = Vec3::from_array(columns.map(length));
        if frame.determinant() < 0.0 {
            // Move the mirror to the scale first; y and z then lean towards the mirrored x.
            (frame.x_axis, scale.x) = (-frame.x_axis, -scale.x);
        }
        let along = |axis: Vec3A, column: usize| axis.dot(columns[column] / scale[column]);
        let (y_y, z_z) = (along(frame.y_axis, 1), along(frame.z_axis, 2));
        let skew = Skew {
            xy: along(frame.x_axis, 1) / y_y,
            xz: along(frame.x_axis, 2) / z_z,
            yz: along(frame.y_axis, 2) / z_z,
        };
        let rotation = unit(Quat::from_mat3a(&frame))?;
        let transform = Transform { translation: affine.translation.into(), rotation, scale };
        (transform.is_sound() && [skew.xy, skew.xz, skew.yz].iter().all(|skew| skew.is_finite()))
            .then_some(Self { transform, skew })
    }
}
