//! The golden expansions compile, and do bit for bit what the derive on the same declaration does.

use aim::glam::{Affine3A, Quat, Vec3};
use aim::{AimRig, Pose, Scalar};
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

            pub(super) mod golden {
                pub(crate) struct $name { $($field: aim::Joint,)* }

                include!(concat!("../expected/", stringify!($module), ".rs"));
            }
        }

        #[test]
        fn $module() {
            let (mut derived, mut golden) = ($module::derived::$name::default(), $module::golden::$name::default());
            assert_eq!($module::derived::$name::BONES, $module::golden::$name::BONES);
            same_kernels::<f32>(&derived, &golden, |x| x.to_bits().into());
            same_kernels::<f64>(&derived, &golden, f64::to_bits);
            same_frames(&mut derived, &mut golden);
        }
    };
}

aim_tests::declarations!(beside_the_derive);

/// Every kernel on the same random input.
fn same_kernels<S: Scalar>(derived: &impl AimRig, golden: &impl AimRig, bits: fn(S) -> u64) {
    let joints = derived.joint_infos().len();
    let mut random = Random::new(7);
    let mut number = || S::constant(random.within(1.5));
    for _ in 0..50 {
        let links: Vec<[S; 12]> = (0..joints).map(|_| [0; 12].map(|_| number())).collect();
        let sin_cos: Vec<[S; 4]> = (0..joints).map(|_| [0; 4].map(|_| number())).collect();
        let target = [0; 3].map(|_| number());
        let outputs = |rig: &dyn Fn(&mut Vec<S>)| {
            let mut out = Vec::new();
            rig(&mut out);
            out.into_iter().map(bits).collect::<Vec<u64>>()
        };
        let of_derived = outputs(&|out| run(derived, &links, &target, &sin_cos, out));
        let of_golden = outputs(&|out| run(golden, &links, &target, &sin_cos, out));
        assert_eq!(of_derived, of_golden);
        assert!(of_derived.iter().any(|&bits| bits != 0), "the kernels compute something");
    }
}

fn run<S: Scalar>(rig: &impl AimRig, links: &[[S; 12]], target: &[S; 3], sin_cos: &[[S; 4]], out: &mut Vec<S>) {
    for joint in 0..links.len() {
        out.extend(rig.aim_gradient(joint, &links[joint], target, &sin_cos[joint]));
    }
    // Slices of every length up to more than enough: all but one are zeros.
    for length in 0..=2 + 4 * links.len() + 1 {
        let mut buffer = vec![S::ZERO; length];
        rig.chain_value_gradient(links, target, sin_cos, &mut buffer);
        out.extend_from_slice(&buffer);
        rig.chain_residual_jacobian(links, target, sin_cos, &mut buffer);
        out.extend_from_slice(&buffer);
    }
}

/// What the rigs say of themselves, before and after they have been aimed.
fn same_frames<D, G, const N: usize>(derived: &mut D, golden: &mut G)
where
    D: AimRig<Array<Affine3A> = [Affine3A; N]> + std::fmt::Debug,
    G: AimRig<Array<Affine3A> = [Affine3A; N]> + std::fmt::Debug,
{
    assert_eq!(derived.joint_infos(), golden.joint_infos());
    assert_eq!(derived.effector(), golden.effector());
    let pose = Pose {
        joints: std::array::from_fn(|i| {
            Affine3A::from_rotation_translation(Quat::from_rotation_y(0.1), Vec3::new(0.1, 1.7 - 0.2 * i as f32, 0.0))
        }),
    };
    for _ in 0..10 {
        let target = Vec3::new(1.0, 1.5, 2.0);
        assert_eq!(derived.aim(&pose, target, 0.016), golden.aim(&pose, target, 0.016));
        assert_eq!(format!("{derived:?}"), format!("{golden:?}"));
    }
    assert!(derived.corrections().any(|(_, correction)| correction != Quat::IDENTITY), "the rig moved");
}
