//! A crate that knows the facade as `aim2`, and one module that knows it by a path of its own.

use aim2::glam::Vec3;
use aim2::{AimRig, Joint};

/// Named from the roots of the crates.
#[derive(AimRig)]
#[aim(axes(up = +X, forward = +Y), crate = ::aim2)]
pub struct Absolute {
    #[joint(role = eye, heading = -35deg..=35deg, pitch = -25deg..=20deg, rate = 450deg)]
    eye: Joint,
}

/// Named as a `use` would.
#[derive(AimRig)]
#[aim(axes(up = +X, forward = +Y), crate = aim2)]
pub struct Relative {
    #[joint(role = eye, heading = -35deg..=35deg, rate = 450deg)]
    eye: Joint,
}

mod engine {
    pub(crate) use aim2 as looking;
}

/// Named as a re-export of another library is.
#[derive(AimRig)]
#[aim(axes(up = +X, forward = +Y), crate = crate::engine::looking)]
pub struct Reexported {
    #[joint(role = eye, pitch = -25deg..=20deg, rate = 450deg)]
    eye: Joint,
}

/// A function that is told the facade's name.
#[aim2::differentiate(wrt(v), crate = crate::engine::looking)]
#[must_use]
pub fn squared(v: Vec3) -> Vec3 {
    v * v.length()
}

#[cfg(test)]
mod tests {
    use aim2::glam::{Affine3A, Vec3};
    use aim2::{Aim, AimRig, Pose, Settings};

    fn turns<R: for<'a> AimRig<Array<Affine3A> = [Affine3A; 1]>>(target: Vec3) {
        let pose = Pose::new([Affine3A::IDENTITY]);
        let outcome = Aim::<R>::new().snap(&pose, target, &Settings::default()).outcome;
        assert_eq!(outcome.status, aim2::Status::Reached, "{outcome:?}");
    }

    #[test]
    fn the_matrix_is_the_facades() {
        let jacobian: aim2::glam::Mat3 = super::squared_jacobian(Vec3::Y).1.0;
        assert_eq!(jacobian.y_axis, 2.0 * Vec3::Y);
    }

    #[test]
    fn every_path_leads_to_the_facade() {
        turns::<super::Absolute>(Vec3::new(0.1, 1.0, 0.1));
        turns::<super::Relative>(Vec3::new(0.0, 1.0, 0.1));
        turns::<super::Reexported>(Vec3::new(0.1, 1.0, 0.0));
    }
}
