//! Single precision: the derived kernel's error against f64 is no larger than that of careful hand-written code.

use aim_benches::pose::{JointPose, joints};
use aim_benches::{by_hand, derived};

const POSES: usize = 10_000;
/// Distances from across a room to so near that expanded formulas fail, metres.
const DISTANCES_M: [f64; 3] = [2.0, 0.3, 0.01];

/// Converts a pose to f64, so that the arithmetic is compared and not the rounding of the input. Sines and cosines are
/// recomputed.
fn widened(pose: &JointPose<f32>) -> JointPose<f64> {
    let angles = pose.angles.map(f64::from);
    let [(sin_p, cos_p), (sin_h, cos_h)] = angles.map(f64::sin_cos);
    JointPose {
        link: pose.link.map(f64::from),
        target: pose.target.map(f64::from),
        angles,
        sin_cos: [sin_p, cos_p, sin_h, cos_h],
    }
}

/// Returns the largest error of all three outputs, and each output's root mean square error.
fn errors(poses: &[JointPose<f32>], f: fn(&JointPose<f32>) -> [f32; 3]) -> (f64, [f64; 3]) {
    let (mut worst, mut squares) = (0.0_f64, [0.0; 3]);
    for pose in poses {
        let (found, exact) = (f(pose), by_hand::joint(&widened(pose)));
        for ((square, found), exact) in squares.iter_mut().zip(found).zip(exact) {
            let error = (f64::from(found) - exact).abs();
            assert!(error.is_finite());
            worst = worst.max(error);
            *square += error * error;
        }
    }
    (worst, squares.map(|square| (square / poses.len() as f64).sqrt()))
}

#[test]
fn derived_code_is_as_accurate_as_hand_written_code() {
    for (seed, distance_m) in (1..).zip(DISTANCES_M) {
        let poses = joints::<f32>(seed, POSES, distance_m);
        let (derived_worst, derived) = errors(&poses, derived::joint);
        let (worst, by_hand) = errors(&poses, by_hand::joint);
        println!("{distance_m} m: derived {derived_worst:.1e} {derived:?}, by hand {worst:.1e} {by_hand:?}");
        // The largest error of a single output is a matter of chance: reordering a sum changes it by a fifth.
        assert!(derived_worst <= 1.1 * worst, "{distance_m} m: {derived_worst:e}, by hand {worst:e}");
        for (output, (derived, by_hand)) in derived.into_iter().zip(by_hand).enumerate() {
            assert!(derived <= 1.1 * by_hand, "{distance_m} m, output {output}: {derived:e}, by hand {by_hand:e}");
        }
    }
}

#[test]
fn both_state_the_same_function() {
    for (seed, distance_m) in (1..).zip(DISTANCES_M) {
        for pose in joints::<f64>(seed, 1000, distance_m) {
            let pairs = derived::joint(&pose).into_iter().zip(by_hand::joint(&pose));
            for (derived, by_hand) in pairs {
                assert!((derived - by_hand).abs() < 1e-12 / distance_m.powi(2), "{derived} {by_hand}");
            }
        }
    }
}
