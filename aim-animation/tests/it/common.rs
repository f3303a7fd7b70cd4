//! Shared test helpers: a small random number generator, random transforms, and their definitions in f64.

use aim_animation::Transform;
use aim_animation::glam::{Affine3A, DAffine3, DQuat, Quat, Vec3};

/// Small pseudorandom number generator.
#[derive(Clone, Debug)]
pub(crate) struct Rng(pub(crate) u64);

impl Rng {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let mixed = (self.0 ^ (self.0 >> 33)).wrapping_mul(0xff51_afd7_ed55_8ccd);
        mixed ^ (mixed >> 29)
    }

    pub(crate) fn below(&mut self, end: usize) -> usize {
        usize::try_from(self.next() % end as u64).unwrap()
    }

    #[expect(clippy::cast_precision_loss, clippy::cast_possible_truncation, reason = "random digits")]
    pub(crate) fn between(&mut self, low: f32, high: f32) -> f32 {
        low + (high - low) * ((self.next() >> 40) as f64 / (1_u64 << 24) as f64) as f32
    }

    pub(crate) fn vector(&mut self, most: f32) -> Vec3 {
        Vec3::from_array([0; 3].map(|_| self.between(-most, most)))
    }

    pub(crate) fn rotation(&mut self) -> Quat {
        loop {
            let [x, y, z, w] = [0; 4].map(|_| self.between(-1.0, 1.0));
            let q = Quat::from_xyzw(x, y, z, w);
            if (0.1..1.0).contains(&q.length()) {
                return q.normalize();
            }
        }
    }

    /// Returns a transform with uniform scale, mirrored in one of four cases.
    pub(crate) fn transform(&mut self) -> Transform {
        let mut scale = Vec3::splat(self.between(0.5, 2.0));
        if self.below(4) == 0 {
            scale.x = -scale.x;
        }
        Transform { scale, ..self.rigid() }
    }

    pub(crate) fn rigid(&mut self) -> Transform {
        Transform::new(self.vector(2.0), self.rotation())
    }
}

/// Returns the affine map T·R·S of a transform, in f64.
pub(crate) fn exact(transform: &Transform) -> DAffine3 {
    DAffine3::from_scale_rotation_translation(
        transform.scale.as_dvec3(),
        transform.rotation.as_dquat().normalize(),
        transform.translation.as_dvec3(),
    )
}

/// Returns the largest difference between two maps, component by component.
pub(crate) fn apart(a: &Affine3A, b: &DAffine3) -> f64 {
    let b = b.to_cols_array();
    a.to_cols_array().iter().zip(b).map(|(a, b)| (f64::from(*a) - b).abs()).fold(0.0, f64::max)
}

/// Returns the angle between two rotations, radians, from the chord between their quaternions.
pub(crate) fn angle_between(a: Quat, b: DQuat) -> f64 {
    let (a, b) = (a.as_dquat().normalize(), b.normalize());
    let chord = (a - b).length().min((a + b).length());
    4.0 * (0.5 * chord).min(1.0).asin()
}
