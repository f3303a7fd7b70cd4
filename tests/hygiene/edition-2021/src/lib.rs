//! The derive in an older edition, wherever a struct can stand and whatever its fields are called.

use aim::{AimRig, Joint, Rig};

/// A rig made by a macro: its parts arrive in invisible groups.
macro_rules! eye {
    ($(#[$attribute:meta])* $visibility:vis $name:ident { $field:ident: $low:literal to $high:expr, $rate:literal }) => {
        $(#[$attribute])*
        #[derive(AimRig)]
        #[aim(axes(up = +X, forward = +Y))]
        $visibility struct $name {
            #[joint(heading = $low..=$high, rate = $rate)]
            $field: Joint,
        }
    };
}

eye! {
    /// Public, and called as the kernel's own variables are.
    pub Public { target: -20deg to 35deg, 450deg }
}
eye!(pub(crate) Restricted { formatter: -20deg to 35deg, 450deg });
eye!(Private { r#try: -20deg to 35deg, 450deg });

/// A keyword in Rust alone, which the declaration writes as `r#…`.
#[derive(AimRig)]
#[aim(axes(up = +X, forward = +Y))]
pub struct Raw {
    #[joint(heading = -20deg..=35deg, rate = 450deg)]
    pub r#dyn: Joint,
    #[joint(heading = -20deg..=35deg, rate = 450deg)]
    r#gen: Joint,
}

/// A function made by a macro: its parts arrive in invisible groups.
macro_rules! wave {
    ($name:ident($argument:ident: $ty:ty) -> $result:ty { $value:expr } $budget:literal) => {
        #[aim::differentiate(wrt($argument), budget = $budget)]
        pub fn $name($argument: $ty, factor: $ty) -> $result {
            factor * $value
        }
    };
}

wave!(wave(r#gen: f32) -> f32 { r#gen.sin() + 2.0 } 3);

/// A rig of a function's own.
pub fn local() -> usize {
    #[derive(AimRig)]
    #[aim(axes(up = +X, forward = +Y))]
    struct Local {
        #[joint(role = eye, heading = -20deg..=35deg, rate = 450deg)]
        eye: Joint,
    }

    let in_a_closure = || {
        #[derive(AimRig)]
        #[aim(axes(up = +X, forward = +Y))]
        struct Local {
            #[joint(role = eye, heading = -20deg..=35deg, rate = 450deg)]
            eye: Joint,
            #[joint(role = head, heading = -20deg..=35deg, rate = 450deg)]
            head: Joint,
        }
        Local::RIG.description().joints().len()
    };
    Local::RIG.description().joints().len() + in_a_closure()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_those_of_the_fields() {
        let first = |rig: &dyn Rig| rig.bone_name(0, 0).map(str::to_owned);
        assert_eq!(first(Public::RIG).as_deref(), Some("target"));
        assert_eq!(first(Restricted::RIG).as_deref(), Some("formatter"));
        assert_eq!(first(Private::RIG).as_deref(), Some("try"));
        assert_eq!([0, 1, 2].map(|joint| Raw::RIG.bone_name(joint, 0)), [Some("dyn"), Some("gen"), None]);
        assert_eq!((Raw::RIG.joint_name(1), Raw::RIG.bone_name(1, 1)), (Some("gen"), None));
        let raw = aim::Aim::<Raw>::new().joints();
        assert_eq!((raw.r#dyn, raw.r#gen), (Joint::default(), Joint::default()));
    }

    #[test]
    fn functions_of_macros_are_differentiated() {
        assert_eq!(wave_gradient(0.0, 3.0), (wave(0.0, 3.0), (3.0,)));
    }

    #[test]
    fn scopes_are_kept_apart() {
        assert_eq!(local(), 3);
    }
}
