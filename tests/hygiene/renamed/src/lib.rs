//! A crate that knows the facade as `aim2`, and one module that knows it by a path of its own.

use aim2::{AimRig, Joint};

/// Named from the roots of the crates.
#[derive(AimRig)]
#[aim(bones(up = +X, forward = +Y), crate = ::aim2)]
pub struct Absolute {
    #[joint(heading = -35deg..=35deg, pitch = -25deg..=20deg, rate = 450deg)]
    eye: Joint,
}

/// Named as a `use` would.
#[derive(AimRig)]
#[aim(bones(up = +X, forward = +Y), crate = aim2)]
pub struct Relative {
    #[joint(heading = -35deg..=35deg, rate = 450deg)]
    eye: Joint,
}

mod engine {
    pub(crate) use aim2 as looking;
}

/// Named as a re-export of another library is.
#[derive(AimRig)]
#[aim(bones(up = +X, forward = +Y), crate = crate::engine::looking)]
pub struct Reexported {
    #[joint(pitch = -25deg..=20deg, rate = 450deg)]
    eye: Joint,
}

#[cfg(test)]
mod tests {
    use aim2::glam::{Affine3A, Vec3};
    use aim2::{AimRig, Pose};

    fn turns<R: for<'a> AimRig<Array<Affine3A> = [Affine3A; 1]>>(mut rig: R, target: Vec3) {
        let outcome = rig.snap(&Pose { joints: [Affine3A::IDENTITY] }, target);
        assert_eq!(outcome.status, aim2::Status::Reached, "{outcome:?}");
    }

    #[test]
    fn every_path_leads_to_the_facade() {
        turns(super::Absolute::default(), Vec3::new(0.1, 1.0, 0.1));
        turns(super::Relative::default(), Vec3::new(0.0, 1.0, 0.1));
        turns(super::Reexported::default(), Vec3::new(0.1, 1.0, 0.0));
    }
}
