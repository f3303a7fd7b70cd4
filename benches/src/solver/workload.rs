//! The workloads: seeded targets and poses, the same on every run.

use aim::glam::{Affine3A, Vec3};

use super::chain::{Animation, EYE_AT_REST, direction, random_pose};

/// A still pose with a still target.
#[derive(Clone, Copy, Debug)]
pub struct Still {
    /// Transforms of the joints, from the effector inward.
    pub pose: [Affine3A; 3],
    /// Target in the pose's space, metres.
    pub target: Vec3,
}

/// Region of a workload's targets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Where {
    /// Headings within ±70° and elevations within ±40°.
    Cone,
    /// Anywhere in the front half of the sphere.
    Front,
    /// Anywhere on the sphere.
    Any,
}

impl Where {
    /// Returns the name in the tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Cone => "cone",
            Self::Front => "front",
            Self::Any => "any",
        }
    }

    /// Returns `count` poses with targets at 0.5 to 5 m from the eye.
    pub fn cases(self, count: usize) -> Vec<Still> {
        let mut random = fastrand::Rng::with_seed(self as u64 + 1);
        (0..count)
            .map(|_| {
                let pose = random_pose(&mut random);
                let mut between = |lo: f32, hi: f32| lo + (hi - lo) * random.f32();
                let distance = between(0.5, 5.0);
                let towards = match self {
                    Self::Cone => bearing(between(-70.0, 70.0), between(-40.0, 40.0)),
                    Self::Front => {
                        let v = direction(&mut random);
                        Vec3::new(v.x, v.y, v.z.abs())
                    }
                    Self::Any => direction(&mut random),
                };
                Still { pose, target: EYE_AT_REST + distance * towards }
            })
            .collect()
    }
}

/// Returns the direction at this heading (positive to the left) and elevation, degrees.
pub fn bearing(heading: f32, elevation: f32) -> Vec3 {
    let ((sin_h, cos_h), (sin_e, cos_e)) = (heading.to_radians().sin_cos(), elevation.to_radians().sin_cos());
    Vec3::new(cos_e * sin_h, sin_e, cos_e * cos_h)
}

/// The animation of a workload.
#[derive(Clone, Copy, Debug)]
pub enum Body {
    /// Stays in one pose.
    Still([Affine3A; 3]),
    /// Swings about the rest pose.
    Moving(Animation),
}

impl Body {
    /// Returns the pose at time `t`, seconds.
    pub fn at(&self, t: f32) -> [Affine3A; 3] {
        match self {
            Self::Still(pose) => *pose,
            Self::Moving(animation) => animation.at(t),
        }
    }
}

/// A moving target on a still or moving body.
#[derive(Clone, Copy, Debug)]
pub struct Motion {
    /// Animation of the body.
    pub body: Body,
    /// Path of the target.
    pub path: Path,
}

/// Path of a target.
#[derive(Clone, Copy, Debug)]
pub enum Path {
    /// Swings to either side and a little up and down, at 2 m.
    Swing {
        /// Angular frequency of the sideways swing, rad/s.
        speed: f32,
        /// Phase at time 0, radians.
        phase: f32,
        /// Mean elevation, degrees.
        elevation: f32,
    },
    /// Circles the character at the eye's height, at 2 m.
    Orbit {
        /// Seconds for one turn; negative turns right.
        seconds: f32,
    },
    /// Alternates between two directions, at 2 m.
    Between {
        /// The two directions, each heading and elevation in degrees.
        ends: [[f32; 2]; 2],
        /// Time spent in each direction, seconds.
        stays: f32,
    },
}

impl Path {
    /// Returns the target at time `t`, seconds.
    pub fn at(&self, t: f32) -> Vec3 {
        let towards = match *self {
            Self::Swing { speed, phase, elevation } => {
                let swing = speed * t + phase;
                bearing(63.0 * swing.sin(), elevation + 5.0 * (0.7 * swing).sin())
            }
            Self::Orbit { seconds } => bearing(360.0 * t / seconds, 0.0),
            Self::Between { ends: [[heading, elevation], other], stays } => {
                if t.rem_euclid(2.0 * stays) < stays {
                    bearing(heading, elevation)
                } else {
                    bearing(other[0], other[1])
                }
            }
        };
        EYE_AT_REST + 2.0 * towards
    }
}

/// Returns `count` characters that follow a swinging target, on a moving animation or in still random poses.
pub fn track(count: usize, moving: bool) -> Vec<Motion> {
    let mut random = fastrand::Rng::with_seed(if moving { 12 } else { 11 });
    (0..count)
        .map(|_| {
            let pose = random_pose(&mut random);
            let animation = Animation::random(&mut random);
            let body = if moving { Body::Moving(animation) } else { Body::Still(pose) };
            let speed = std::f32::consts::TAU / (3.0 + 3.0 * random.f32());
            let phase = std::f32::consts::TAU * random.f32();
            Motion { body, path: Path::Swing { speed, phase, elevation: 20.0 * random.f32() - 10.0 } }
        })
        .collect()
}

/// Returns orbits of 4, 8 and 20 s a turn in both directions, `count` poses each.
pub fn orbits(count: usize, moving: bool) -> Vec<Motion> {
    let mut random = fastrand::Rng::with_seed(21);
    let mut motions = Vec::new();
    for seconds in [4.0, -4.0, 8.0, -8.0, 20.0, -20.0] {
        for _ in 0..count {
            let pose = random_pose(&mut random);
            let animation = Animation::random(&mut random);
            let body = if moving { Body::Moving(animation) } else { Body::Still(pose) };
            motions.push(Motion { body, path: Path::Orbit { seconds } });
        }
    }
    motions
}
