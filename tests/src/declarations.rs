//! The declarations whose expansions are golden: `tests/expected/NAME.rs` holds the expansion of each.

/// Passes every declaration to the macro `$with`: a name, then the struct with its attributes, without the derive.
///
/// This is a macro over macros because one test needs the text, another the struct with the derive, and a third the
/// struct without it, next to the golden expansion.
#[macro_export]
macro_rules! declarations {
    ($with:ident) => {
        // The declaration that the documentation shows.
        $with! {
            thug
            #[aim(axes(up = +X, forward = +Y, left = +Z))]
            pub struct Thug {
                #[joint(role = eye, heading = -35deg..=35deg, pitch = -25deg..=20deg, rate = 450deg, stiffness = 0.5)]
                left_eye: Joint,
                #[joint(role = neck, heading = -60deg..=60deg, pitch = -40deg..=35deg, rate = 170deg)]
                neck: Joint,
                #[joint(role = chest, heading = -20deg..=20deg, pitch = -10deg..=10deg, rate = 70deg, stiffness = 4.0)]
                spine3: Joint,
            }
        }

        // Two hinges, one without limit, and a muzzle away from the barrel's bone.
        $with! {
            turret
            #[aim(axes(up = +Y, forward = -Z), effector(origin = (0.0, 0.05, -0.8)))]
            pub struct Turret {
                #[joint(pitch = -10deg..=80deg, rate = 90deg)]
                barrel: Joint,
                #[joint(heading = free, rate = 2rad)]
                base: Joint,
            }
        }

        // A left-handed engine, the third axis left out.
        $with! {
            left_handed
            #[aim(axes(up = +X, forward = +Y), handedness = left)]
            pub struct LeftHanded {
                #[joint(role = eye, heading = -35deg..=35deg, pitch = -25deg..=20deg, rate = 450deg)]
                eye: Joint,
                #[joint(role = head, heading = -60deg..=60deg, pitch = -40deg..=35deg, rate = 170deg, axes(down = +Z, back = +X))]
                head: Joint,
            }
        }

        // Axes off every cardinal direction, a mirrored bone, and every setting that a joint may have.
        $with! {
            general
            #[aim(
                axes(up = (0.0, 0.96, 0.28), forward = (0.6, -0.224, 0.768)),
                effector(forward = +Z),
                natural(eyes_only = 10deg, head_share = 0.7, engage = 0.25rad, release = 5deg, delay = 0.05)
            )]
            pub struct General {
                #[joint(
                    role = eye,
                    heading = -0.6rad..=0.6rad,
                    pitch = -0.4rad..=0.35rad,
                    rate = 7.5rad,
                    acceleration = 200rad,
                    stiffness = 0.5,
                    bone = ["L_eye", "LeftEye"],
                    other_eye = "R_eye"
                )]
                left_eye: Joint,
                #[joint(
                    role = neck,
                    heading = -60deg..=60deg,
                    pitch = -40deg..=35deg,
                    rate = 170deg,
                    upright = 0.5,
                    pitch_taper = 0.25,
                    limits_from = bind_pose,
                    hold = ["L_clavicle", "R_clavicle"],
                    axes(up = -Z, forward = +X),
                    mirrored = true
                )]
                r#neck: Joint,
            }
        }
    };
}
