//! Vectors of `wide` in place of scalars: one character per lane, each exactly as if computed alone.

pub(crate) mod cases;
mod functions;

use aim::wide::{f32x4, f32x8, f32x16, f64x2, f64x4, f64x8};
use aim::{AimRig, Joint, Scalar};
use aim_codegen::RigSpec;
use aim_tests::random::Random;
use aim_tests::rigs;

use self::cases::{Lane, Lanes, Seen, cases, compare};
use crate::emitted;

/// The paper's rig, with all generic kernels.
#[derive(AimRig)]
#[aim(axes(up = +X, forward = +Y, left = +Z), kernels(aim_gradient, chain_value_gradient, chain_residual_jacobian))]
struct Thug {
    #[joint(role = eye, heading = -35deg..=35deg, pitch = -25deg..=20deg, rate = 450deg, stiffness = 0.5)]
    left_eye: Joint,
    #[joint(role = neck, heading = -60deg..=60deg, pitch = -40deg..=35deg, rate = 170deg)]
    neck: Joint,
    #[joint(role = chest, heading = -20deg..=20deg, pitch = -10deg..=10deg, rate = 70deg, stiffness = 4.0)]
    spine3: Joint,
}

aim_tests::requested_kernels!(Thug);

/// Asserts that guards were taken in some lanes of a vector and not in others.
fn assert_mixed(seen: Seen) {
    assert!(seen.zero > 20 && seen.wild > 20 && seen.tame > 100 && seen.mixed > 20, "{seen:?}");
}

/// Uses one vector type only, because compiling every rig for each type takes long.
#[test]
fn every_lane_of_every_rig_is_the_scalar_kernel() {
    let mut seen = Seen::default();
    for (number, spec) in rigs::rigs().iter().enumerate() {
        seen += emitted::compared(number, &spec.name, &cases(spec, number as u64, 48));
    }
    assert_mixed(seen);
}

fn thug() -> RigSpec {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../rigs/thug.toml");
    let text = std::fs::read_to_string(file).expect("the paper's rig is bundled");
    aim_codegen::declare::from_toml("thug.toml", &text).expect("a bundled rig is right")
}

#[test]
fn every_lane_is_the_scalar_kernel_in_every_vector() {
    fn check<V: Lanes>() {
        let rig = Thug::RIG;
        assert_mixed(compare::<V>("Thug", rig, rig, &cases(&thug(), 5, 1600)));
        // General frames, four joints.
        let rig = emitted::Rig63::RIG;
        assert_mixed(compare::<V>("Rig63", rig, rig, &cases(&rigs::rigs()[63], 5, 1600)));
    }
    check::<f32x4>();
    check::<f32x8>();
    check::<f32x16>();
    check::<f64x2>();
    check::<f64x4>();
    check::<f64x8>();
}

/// Returns numbers at the limits of a format's range, then numbers with random bits.
fn numbers<S: Lane>() -> Vec<S> {
    const EDGES: [f64; 9] = [0.0, 1e-320, 1e-42, 1.1e-19, 1.5e-154, 1.0, 1e30, f64::INFINITY, f64::NAN];
    let mut random = Random::new(3);
    let edges = EDGES.into_iter().flat_map(|edge| [edge, -edge]).map(S::rounded);
    let any = (0..200).map(|_| S::from_bits((0..8).fold(0, |bits, _| bits << 8 | random.below(256) as u64)));
    edges.chain(any).collect()
}

#[test]
fn every_operation_is_the_scalar_one_in_each_lane() {
    fn check<V: Lanes>() {
        let numbers: Vec<V::Lane> = numbers();
        let at = |i: usize| numbers[i % numbers.len()];
        let same = |what: &str, vector: V, scalar: &dyn Fn(usize) -> V::Lane| {
            for lane in 0..V::COUNT {
                let (found, expected) = (vector.lane(lane), scalar(lane));
                assert_eq!(found.bits(), expected.bits(), "{what}: {found:?} instead of {expected:?}");
            }
        };
        for start in 0..numbers.len() {
            // Each number is combined with each other in some lane.
            for step in 0..numbers.len() {
                let (x, y) = (|lane| at(start + lane), |lane| at(start + step + lane));
                let (a, b) = (V::gather(x), V::gather(y));
                same("a + b", a + b, &|lane| x(lane) + y(lane));
                same("a - b", a - b, &|lane| x(lane) - y(lane));
                same("a * b", a * b, &|lane| x(lane) * y(lane));
                same("a / b", a / b, &|lane| x(lane) / y(lane));
                let select = V::select_less(a, b, b, a);
                same("select_less", select, &|lane| V::Lane::select_less(x(lane), y(lane), y(lane), x(lane)));
            }
            let a = V::gather(|lane| at(start + lane));
            same("-a", -a, &|lane| -at(start + lane));
            same("sqrt", Scalar::sqrt(a), &|lane| Scalar::sqrt(at(start + lane)));
        }
        same("ZERO", V::ZERO, &|_| V::Lane::ZERO);
        same("TINY", V::TINY, &|_| V::Lane::TINY);
        same("constant", V::constant(0.1), &|_| V::Lane::constant(0.1));
    }
    check::<f32x4>();
    check::<f32x8>();
    check::<f32x16>();
    check::<f64x2>();
    check::<f64x4>();
    check::<f64x8>();
}

#[test]
fn a_target_on_the_effector_stays_in_its_lane() {
    let [zero, one] = [0.0, 1.0].map(f32x8::constant);
    let link = [one, zero, zero, zero, one, zero, zero, zero, one, zero, zero, zero];
    // +Y is forward; in lane 5 the target is on the effector.
    let ahead = f32x8::new([2.0, 2.0, 2.0, 2.0, 2.0, 0.0, 2.0, 2.0]);
    let [aim, ..] = Thug::aim_gradient(0, &link, &[zero, ahead, zero], &[zero, one, zero, one]);
    assert_eq!(aim.to_array(), [1.0, 1.0, 1.0, 1.0, 1.0, 0.0, 1.0, 1.0]);
}
