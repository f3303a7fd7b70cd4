//! The golden expansions compile and behave, bit for bit, like the derive on the same declaration.

use aim::glam::{Affine3A, Quat, Vec3};
use aim::{Aim, AimRig, Pose, Rig, Settings};
use aim_tests::random::Random;

macro_rules! beside_the_derive {
    ($module:ident #[aim $aim:tt] pub struct $name:ident { $(#[joint $joint:tt] $field:ident: Joint,)* }) => {
        mod $module {
            pub(super) mod derived {
                use aim::Joint;

                #[derive(aim::AimRig)]
                #[aim $aim]
                pub(crate) struct $name { $(#[joint $joint] $field: Joint,)* }
            }

            #[allow(unnameable_types, reason = "emitted from a file, the pose is public")]
            pub(super) mod golden {
                pub(crate) struct $name { $($field: aim::Joint,)* }

                include!(concat!("../../expected/", stringify!($module), ".rs"));
            }
        }

        #[test]
        fn $module() {
            same_kernels($module::derived::$name::RIG, $module::golden::$name::RIG);
            same_frames::<$module::derived::$name, $module::golden::$name>();
        }
    };
}

aim_tests::declarations!(beside_the_derive);

/// Compares both kernels on the same random input, and the names.
#[expect(clippy::cast_possible_truncation, reason = "kernels take single precision")]
fn same_kernels(derived: &dyn Rig, golden: &dyn Rig) {
    let joints = derived.description().joints().len();
    for joint in 0..=joints {
        assert_eq!(derived.joint_name(joint), golden.joint_name(joint));
        assert_eq!([0, 1, 2].map(|k| derived.bone_name(joint, k)), [0, 1, 2].map(|k| golden.bone_name(joint, k)));
    }
    let mut random = Random::new(7);
    let mut number = || random.within(1.5) as f32;
    for _ in 0..50 {
        let links: Vec<[f32; 12]> = (0..joints).map(|_| [0; 12].map(|_| number())).collect();
        let sin_cos: Vec<[f32; 4]> = (0..joints).map(|_| [0; 4].map(|_| number())).collect();
        let target = [0; 3].map(|_| number());
        let [of_derived, of_golden] = [derived, golden].map(|rig| outputs(rig, &links, &target, &sin_cos));
        assert_eq!(of_derived, of_golden);
        assert!(of_derived.iter().any(|&bits| bits != 0), "the kernels compute something");
    }
}

fn outputs(rig: &dyn Rig, links: &[[f32; 12]], target: &[f32; 3], sin_cos: &[[f32; 4]]) -> Vec<u32> {
    let mut out = Vec::new();
    for joint in 0..links.len() {
        out.extend(rig.aim_gradient(joint, &links[joint], target, &sin_cos[joint]));
    }
    // Slices of every length up to more than enough: all but the right length give zeros.
    for length in 0..=2 + 4 * links.len() + 1 {
        let mut buffer = vec![0.0; length];
        rig.residual_jacobian(links, target, sin_cos, &mut buffer);
        out.extend_from_slice(&buffer);
    }
    out.into_iter().map(f32::to_bits).collect()
}

/// Compares the rigs' descriptions and their results over frames.
fn same_frames<D: AimRig, G: AimRig>() {
    let (derived, golden) = (D::RIG.description(), G::RIG.description());
    assert_eq!(derived.joints(), golden.joints());
    assert_eq!((derived.effector(), derived.sharing()), (golden.effector(), golden.sharing()));
    fn aim<R: AimRig>(aim: &mut Aim<R>) -> (aim::Outcome, Vec<Quat>, Vec<[f32; 2]>) {
        let mut joints = R::array(Affine3A::IDENTITY);
        for (i, joint) in joints.as_mut().iter_mut().enumerate() {
            let at = Vec3::new(0.1, 1.7 - 0.2 * i as f32, 0.0);
            *joint = Affine3A::from_rotation_translation(Quat::from_rotation_y(0.1), at);
        }
        let aimed = aim.aim(&Pose::new(joints), Vec3::new(1.0, 1.5, 2.0), 0.016, &Settings::default());
        let angles = aim.state.joints.as_ref().iter().map(|joint| [joint.heading(), joint.pitch()]).collect();
        (aimed.outcome, aimed.corrections.as_ref().to_vec(), angles)
    }
    let (mut derived, mut golden) = (Aim::<D>::new(), Aim::<G>::new());
    let mut moved = false;
    for _ in 0..10 {
        let of_derived = aim(&mut derived);
        assert_eq!(of_derived, aim(&mut golden));
        moved |= of_derived.1.iter().any(|correction| *correction != Quat::IDENTITY);
    }
    assert!(moved, "the rig moved");
}
