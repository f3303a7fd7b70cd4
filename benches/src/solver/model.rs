//! [`Model`]: a rig in a pose as the definitions have it, in double precision: what the solvers are judged by.

use aim::glam::Quat;
use aim::glam::{Affine3A, Vec3A};
use aim::{Joint, Rig};

use super::vector::{V, add, angle, cross, dot, rotate, scale, sub, turn, unit};

/// The most angles that a rig under test has.
pub const MOST: usize = 14;

/// A value for each declared angle; those past the last are 0.
pub type Angles = [f64; MOST];

/// One declared angle.
#[derive(Clone, Copy, Debug)]
pub struct Angle {
    /// Its joint, from the effector inward.
    pub joint: usize,
    /// Whether it is the joint's heading.
    pub heading: bool,
    /// Its range of motion.
    pub range: [f64; 2],
    /// Its largest speed, rad/s.
    pub rate: f64,
    /// Its weight in the displacement cost.
    pub stiffness: f64,
    /// The plane it turns in, from the first direction towards the second, in the joint's space.
    plane: [V; 2],
}

/// A rig in a pose.
#[derive(Clone, Debug)]
pub struct Model {
    /// The declared angles, joint by joint from the effector inward, pitch before heading.
    pub angles: Vec<Angle>,
    origin: V,
    forward: V,
    left: V,
    /// Each joint in the next one's space, the last in the pose's: columns and translation.
    links: Vec<[V; 4]>,
}

fn double(v: Vec3A) -> V {
    v.to_array().map(f64::from)
}

fn columns(transform: &Affine3A) -> [V; 4] {
    let m = transform.matrix3;
    [m.x_axis, m.y_axis, m.z_axis, transform.translation].map(double)
}

fn vector(m: &[V; 4], v: V) -> V {
    add(add(scale(v[0], m[0]), scale(v[1], m[1])), scale(v[2], m[2]))
}

/// By Cramer's rule.
fn inverse_vector(m: &[V; 4], v: V) -> V {
    let [a, b, c, _] = *m;
    let volume = dot(a, cross(b, c));
    [cross(b, c), cross(c, a), cross(a, b)].map(|side| dot(v, side) / volume)
}

/// `a⁻¹ b`
fn within(a: &[V; 4], b: &[V; 4]) -> [V; 4] {
    let [x, y, z, origin] = *b;
    [inverse_vector(a, x), inverse_vector(a, y), inverse_vector(a, z), inverse_vector(a, sub(origin, a[3]))]
}

impl Model {
    /// The rig in this pose, its joints from the effector inward.
    pub fn new(rig: &dyn Rig, pose: &[Affine3A]) -> Self {
        let description = rig.description();
        let infos = description.joints();
        let mut angles = Vec::new();
        for (joint, info) in infos.iter().enumerate() {
            let [forward, up, left] = [info.axes().forward, info.axes().up, info.axes().left].map(|v| v.map(f64::from));
            for (range, towards, heading) in [(info.pitch, up, false), (info.heading, left, true)] {
                if let Some(range) = range {
                    angles.push(Angle {
                        joint,
                        heading,
                        range: range.map(f64::from),
                        rate: info.rate.into(),
                        stiffness: info.stiffness.into(),
                        plane: [forward, towards],
                    });
                }
            }
        }
        let frames: Vec<[V; 4]> = pose.iter().map(columns).collect();
        let links = (0..frames.len())
            .map(|i| match frames.get(i + 1) {
                Some(next) => within(next, &frames[i]),
                None => frames[i],
            })
            .collect();
        let effector = description.effector();
        let forward = unit(effector.forward.map(f64::from));
        // Any direction square to forward does: only lengths of residuals and their zeros count.
        let helper = if forward[0].abs() < 0.6 { [1.0, 0.0, 0.0] } else { [0.0, 1.0, 0.0] };
        let left = unit(cross(forward, helper));
        Self { angles, origin: effector.origin.map(f64::from), forward, left, links }
    }

    /// The number of declared angles.
    pub fn count(&self) -> usize {
        self.angles.len()
    }

    /// The joints' angles in the order of the declared ones.
    pub fn read(&self, joints: &[Joint]) -> Angles {
        let mut values = [0.0; MOST];
        for (value, angle) in values.iter_mut().zip(&self.angles) {
            let joint = &joints[angle.joint];
            *value = if angle.heading { joint.heading() } else { joint.pitch() }.into();
        }
        values
    }

    /// Where the effector is, where it looks, and a direction square to that, in the pose's space.
    fn effector(&self, values: &Angles) -> [V; 3] {
        let mut carried = [self.origin, self.forward, self.left];
        let mut next = 0;
        for (joint, link) in self.links.iter().enumerate() {
            while let Some(angle) = self.angles.get(next).filter(|angle| angle.joint == joint) {
                let sin_cos = values[next].sin_cos();
                carried = carried.map(|v| turn(v, angle.plane[0], angle.plane[1], sin_cos));
                next += 1;
            }
            carried = carried.map(|v| vector(link, v));
            carried[0] = add(carried[0], link[3]);
        }
        carried
    }

    /// Where the effector looks with these angles, a unit vector.
    pub fn gaze(&self, values: &Angles) -> V {
        unit(self.effector(values)[1])
    }

    /// The point at this distance straight ahead of the effector.
    pub fn ahead(&self, values: &Angles, distance: f64) -> V {
        let [origin, forward, _] = self.effector(values);
        add(origin, scale(distance, unit(forward)))
    }

    /// The angle between the gaze and the target, radians.
    pub fn remaining(&self, values: &Angles, target: V) -> f64 {
        let [origin, forward, _] = self.effector(values);
        angle(forward, sub(target, origin))
    }

    /// How far the effector is from the target.
    pub fn distance(&self, values: &Angles, target: V) -> f64 {
        let to_target = sub(target, self.effector(values)[0]);
        dot(to_target, to_target).sqrt()
    }

    /// The same angle as a vector: its length along the direction, seen from the effector, in which the target is.
    pub fn residual(&self, values: &Angles, target: V) -> [f64; 2] {
        let [origin, forward, left] = self.effector(values);
        let to_target = sub(target, origin);
        let (forward, left) = (unit(forward), unit(left));
        let lateral = [dot(to_target, left), dot(to_target, cross(forward, left))];
        let length = lateral[0].hypot(lateral[1]);
        if length == 0.0 {
            return [0.0; 2];
        }
        let angle = length.atan2(dot(to_target, forward));
        lateral.map(|x| angle * x / length)
    }

    /// The residual's derivatives by each angle, by central differences.
    pub fn jacobian(&self, values: &Angles, target: V) -> [[f64; 2]; MOST] {
        const STEP: f64 = 1e-5;
        let mut jacobian = [[0.0; 2]; MOST];
        let mut moved = *values;
        for (i, row) in jacobian.iter_mut().enumerate().take(self.count()) {
            moved[i] = values[i] + STEP;
            let ahead = self.residual(&moved, target);
            moved[i] = values[i] - STEP;
            let behind = self.residual(&moved, target);
            moved[i] = values[i];
            *row = [0, 1].map(|k| (ahead[k] - behind[k]) / (2.0 * STEP));
        }
        jacobian
    }

    /// Σ stiffness θ², stiffnesses as declared.
    pub fn cost(&self, values: &Angles) -> f64 {
        self.angles.iter().zip(values).map(|(angle, value)| angle.stiffness * value * value).sum()
    }

    /// The effector's gaze as *corrections* turn it: what a user sees of the rig.
    pub fn seen(&self, corrections: &[Quat]) -> [V; 2] {
        let mut carried = [self.origin, self.forward];
        for (correction, link) in corrections.iter().zip(&self.links) {
            let correction = correction.to_array().map(f64::from);
            carried = carried.map(|v| vector(link, rotate(v, correction)));
            carried[0] = add(carried[0], link[3]);
        }
        [carried[0], unit(carried[1])]
    }

    /// The angle between that gaze and the target, radians.
    pub fn seen_remaining(&self, corrections: &[Quat], target: V) -> f64 {
        let [origin, forward] = self.seen(corrections);
        angle(forward, sub(target, origin))
    }

    /// The ranges of motion.
    pub fn ranges(&self) -> [Angles; 2] {
        self.bounds(|angle| angle.range)
    }

    /// What the ranges leave of a movement from `from` for `seconds` at the angles' rates.
    pub fn reach(&self, from: &Angles, seconds: f64) -> [Angles; 2] {
        let mut from = from.iter();
        self.bounds(|angle| {
            let (from, step) = (*from.next().unwrap_or(&0.0), angle.rate * seconds);
            let [lo, hi] = angle.range;
            // Outside its range an angle goes back.
            [lo.max(from - step).min(from + step), hi.min(from + step).max(from - step)]
        })
    }

    fn bounds(&self, mut of: impl FnMut(&Angle) -> [f64; 2]) -> [Angles; 2] {
        let mut bounds = [[0.0; MOST]; 2];
        for (i, angle) in self.angles.iter().enumerate() {
            [bounds[0][i], bounds[1][i]] = of(angle);
        }
        bounds
    }

    /// How long the joints may need from anywhere to anywhere, one after the other: the sum of range over rate, seconds.
    pub fn longest(&self) -> f64 {
        let joints = self.links.len();
        (0..joints).map(|joint| self.slowest(|angle| angle.joint == joint)).sum()
    }

    /// How long they may need side by side.
    pub fn longest_together(&self) -> f64 {
        self.slowest(|_| true)
    }

    fn slowest(&self, which: impl Fn(&Angle) -> bool) -> f64 {
        let width = |angle: &Angle| (angle.range[1] - angle.range[0]).min(std::f64::consts::TAU);
        self.angles.iter().filter(|angle| which(angle)).map(|angle| width(angle) / angle.rate).fold(0.0, f64::max)
    }
}
