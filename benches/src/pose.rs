//! Seeded random poses of a person, in metres: the inputs of the benchmarks, the same on every machine.

use crate::Float;

/// One joint, the link to its effector, and its target.
#[derive(Clone, Copy, Debug)]
pub struct JointPose<S> {
    /// Transform from effector space to joint space: three rows and a translation.
    pub link: [S; 12],
    /// The target in joint space.
    pub target: [S; 3],
    /// Pitch and heading, radians.
    pub angles: [S; 2],
    /// Sines and cosines of the angles: sin p, cos p, sin h, cos h.
    pub sin_cos: [S; 4],
}

/// Three joints, from the effector inward, and their target.
#[derive(Clone, Copy, Debug)]
pub struct ChainPose<S> {
    /// Transforms between neighbouring spaces: `links[0]` leads from effector space to joint 0, `links[i]` from joint
    /// i−1 to joint i.
    pub links: [[S; 12]; 3],
    /// The target in the last joint's space.
    pub target: [S; 3],
    /// Pitch and heading of each joint, radians.
    pub angles: [[S; 2]; 3],
    /// Sines and cosines of each joint's angles: sin p, cos p, sin h, cos h.
    pub sin_cos: [[S; 4]; 3],
}

/// Number of poses in one run of a benchmark: enough to make the overhead of the call negligible.
pub const MEASURED: usize = 100;

/// Returns the poses on which one joint is measured: targets at 2 m.
pub fn measured_joints<S: Float>() -> Vec<JointPose<S>> {
    joints(1, MEASURED, 2.0)
}

/// Returns the poses on which a chain is measured: targets at 2 m.
pub fn measured_chains<S: Float>() -> Vec<ChainPose<S>> {
    chains(2, MEASURED, 2.0)
}

/// Returns `count` poses of one joint whose target is `distance_m` from the effector and at most 80° off its forward.
pub fn joints<S: Float>(seed: u64, count: usize, distance_m: f64) -> Vec<JointPose<S>> {
    let mut random = fastrand::Rng::with_seed(seed);
    (0..count)
        .map(|_| {
            let pose = chain(&mut random, 1, distance_m);
            let angles = pose.angles[0].map(S::constant);
            let sin_cos = crate::float::sin_cos(angles);
            JointPose { link: pose.links[0].map(S::constant), target: pose.target.map(S::constant), angles, sin_cos }
        })
        .collect()
}

/// Returns `count` poses of three joints whose target is `distance_m` from the effector and at most 80° off its
/// forward.
pub fn chains<S: Float>(seed: u64, count: usize, distance_m: f64) -> Vec<ChainPose<S>> {
    let mut random = fastrand::Rng::with_seed(seed);
    (0..count)
        .map(|_| {
            let pose = chain(&mut random, 3, distance_m);
            let angles: [[S; 2]; 3] = std::array::from_fn(|i| pose.angles[i].map(S::constant));
            ChainPose {
                links: std::array::from_fn(|i| pose.links[i].map(S::constant)),
                target: pose.target.map(S::constant),
                angles,
                sin_cos: angles.map(crate::float::sin_cos),
            }
        })
        .collect()
}

/// A pose in f64, before it is rounded to a number type.
struct Exact {
    links: Vec<[f64; 12]>,
    target: [f64; 3],
    angles: Vec<[f64; 2]>,
}

fn chain(random: &mut fastrand::Rng, joints: usize, distance_m: f64) -> Exact {
    let links: Vec<[f64; 12]> = (0..joints).map(|_| link(random)).collect();
    let angles: Vec<[f64; 2]> = (0..joints).map(|_| [within(random, 0.7), within(random, 1.0)]).collect();
    // Forward is +Y. Place the target in effector space, then transform it outward through every link and rotation.
    let (off, around) = (within(random, 1.4), within(random, std::f64::consts::PI));
    let mut target = [off.sin() * around.cos(), off.cos(), off.sin() * around.sin()].map(|x| distance_m * x);
    for (link, angles) in links.iter().zip(&angles) {
        target = turned(moved(target, link), *angles);
    }
    Exact { links, target, angles }
}

fn within(random: &mut fastrand::Rng, limit: f64) -> f64 {
    limit * (2.0 * random.f64() - 1.0)
}

/// Returns a random link: a short offset and any rotation, since the axes of neighbouring bones often differ in real
/// rigs.
fn link(random: &mut fastrand::Rng) -> [f64; 12] {
    let [a, b, c, d] = [0; 4].map(|_| within(random, 1.0));
    let n = a * a + b * b + c * c + d * d;
    if n < 0.01 {
        return link(random);
    }
    let [x, y, z] = [0; 3].map(|_| within(random, 0.15));
    let (k, u) = (2.0 / n, 1.0 / n);
    [
        u * (a * a + b * b - c * c - d * d),
        k * (b * c + a * d),
        k * (b * d - a * c),
        k * (b * c - a * d),
        u * (a * a - b * b + c * c - d * d),
        k * (c * d + a * b),
        k * (b * d + a * c),
        k * (c * d - a * b),
        u * (a * a - b * b - c * c + d * d),
        x,
        y,
        z,
    ]
}

fn moved([x, y, z]: [f64; 3], link: &[f64; 12]) -> [f64; 3] {
    std::array::from_fn(|k| x * link[k] + y * link[3 + k] + z * link[6 + k] + link[9 + k])
}

/// Rotates a vector: pitch turns +Y towards +X, then heading turns +Y towards +Z.
fn turned([x, y, z]: [f64; 3], [pitch, heading]: [f64; 2]) -> [f64; 3] {
    let (x, y) = (x * pitch.cos() + y * pitch.sin(), y * pitch.cos() - x * pitch.sin());
    [x, y * heading.cos() - z * heading.sin(), y * heading.sin() + z * heading.cos()]
}
