//! [`Model`]: a rig in a pose as the definitions have it, in double precision: what the solvers are judged by.

use aim::glam::{Affine3A, DAffine3, DVec3, Quat};
use aim::{Joint, Rig};

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
    plane: [DVec3; 2],
}

/// A rig in a pose.
#[derive(Clone, Debug)]
pub struct Model {
    /// The declared angles, joint by joint from the effector inward, pitch before heading.
    pub angles: Vec<Angle>,
    origin: DVec3,
    forward: DVec3,
    left: DVec3,
    /// Each joint in the next one's space, the last in the pose's.
    links: Vec<DAffine3>,
}

/// `v` turned in the plane of two unit vectors square to each other, from the first towards the second.
fn turn(v: DVec3, [from, towards]: [DVec3; 2], (sin, cos): (f64, f64)) -> DVec3 {
    let (x, y) = (v.dot(from), v.dot(towards));
    v + (x * (cos - 1.0) - y * sin) * from + (x * sin + y * (cos - 1.0)) * towards
}

/// The angle between two vectors, 0…π, however small it is.
pub(crate) fn angle(a: DVec3, b: DVec3) -> f64 {
    a.cross(b).length().atan2(a.dot(b))
}

/// Three numbers in double precision.
pub(crate) fn double(v: [f32; 3]) -> DVec3 {
    DVec3::from_array(v.map(f64::from))
}

impl Model {
    /// The rig in this pose, its joints from the effector inward.
    pub fn new(rig: &dyn Rig, pose: &[Affine3A]) -> Self {
        let description = rig.description();
        let infos = description.joints();
        let mut angles = Vec::new();
        for (joint, info) in infos.iter().enumerate() {
            let [forward, up, left] = [info.axes().forward, info.axes().up, info.axes().left].map(double);
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
        let frames: Vec<DAffine3> =
            pose.iter().map(|frame| DAffine3::from_cols_array(&frame.to_cols_array().map(f64::from))).collect();
        let link = |(i, frame): (usize, &DAffine3)| frames.get(i + 1).map_or(*frame, |next| next.inverse() * *frame);
        let links = frames.iter().enumerate().map(link).collect();
        let effector = description.effector();
        let forward = double(effector.forward).normalize();
        // Any direction square to forward does: only lengths of residuals and their zeros count.
        Self { angles, origin: double(effector.origin), forward, left: forward.any_orthonormal_vector(), links }
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
    fn effector(&self, values: &Angles) -> [DVec3; 3] {
        let [mut origin, mut forward, mut left] = [self.origin, self.forward, self.left];
        let mut angles = self.angles.iter().zip(values).peekable();
        for (joint, link) in self.links.iter().enumerate() {
            while let Some((angle, value)) = angles.next_if(|(angle, _)| angle.joint == joint) {
                [origin, forward, left] = [origin, forward, left].map(|v| turn(v, angle.plane, value.sin_cos()));
            }
            origin = link.transform_point3(origin);
            [forward, left] = [forward, left].map(|v| link.transform_vector3(v));
        }
        [origin, forward, left]
    }

    /// Where the effector looks with these angles, a unit vector.
    pub fn gaze(&self, values: &Angles) -> DVec3 {
        self.effector(values)[1].normalize()
    }

    /// Where the effector is, in the pose's space.
    pub fn origin(&self, values: &Angles) -> DVec3 {
        self.effector(values)[0]
    }

    /// The point at this distance straight ahead of the effector.
    pub fn ahead(&self, values: &Angles, distance: f64) -> DVec3 {
        let [origin, forward, _] = self.effector(values);
        origin + distance * forward.normalize()
    }

    /// The angle between the gaze and the target, radians.
    pub fn remaining(&self, values: &Angles, target: DVec3) -> f64 {
        let [origin, forward, _] = self.effector(values);
        angle(forward, target - origin)
    }

    /// How far the effector is from the target.
    pub fn distance(&self, values: &Angles, target: DVec3) -> f64 {
        target.distance(self.effector(values)[0])
    }

    /// The same angle as a vector: its length along the direction, seen from the effector, in which the target is.
    pub fn residual(&self, values: &Angles, target: DVec3) -> [f64; 2] {
        let [origin, forward, left] = self.effector(values);
        let to_target = target - origin;
        let (forward, left) = (forward.normalize(), left.normalize());
        let lateral = [to_target.dot(left), to_target.dot(forward.cross(left))];
        let length = lateral[0].hypot(lateral[1]);
        if length == 0.0 {
            return [0.0; 2];
        }
        let angle = length.atan2(to_target.dot(forward));
        lateral.map(|x| angle * x / length)
    }

    /// The residual's derivatives by each angle, by central differences.
    pub fn jacobian(&self, values: &Angles, target: DVec3) -> [[f64; 2]; MOST] {
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
    pub fn seen(&self, corrections: &[Quat]) -> [DVec3; 2] {
        let [mut origin, mut forward] = [self.origin, self.forward];
        for (correction, link) in corrections.iter().zip(&self.links) {
            let correction = correction.as_dquat().normalize();
            origin = link.transform_point3(correction * origin);
            forward = link.transform_vector3(correction * forward);
        }
        [origin, forward.normalize()]
    }

    /// The angle between that gaze and the target, radians.
    pub fn seen_remaining(&self, corrections: &[Quat], target: DVec3) -> f64 {
        let [origin, forward] = self.seen(corrections);
        angle(forward, target - origin)
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
        let seconds = |angle: &Angle| (angle.range[1] - angle.range[0]).min(std::f64::consts::TAU) / angle.rate;
        let of = |joint: usize| self.angles.iter().filter(move |angle| angle.joint == joint).map(seconds);
        (0..self.links.len()).map(|joint| of(joint).fold(0.0, f64::max)).sum()
    }
}
