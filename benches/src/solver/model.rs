//! [`Model`]: forward kinematics of a rig in a pose, written from the definitions in double precision. The solvers are
//! judged by it.

use aim::glam::{Affine3A, DAffine3, DVec3, Quat};
use aim::{Joint, Rig};

/// Largest number of angles of a rig under test.
pub const MOST: usize = 14;

/// A value for each declared angle, radians; the rest of the array is 0.
pub type Angles = [f64; MOST];

/// One declared angle.
#[derive(Clone, Copy, Debug)]
pub struct Angle {
    /// Index of the joint, from the effector inward.
    pub joint: usize,
    /// `true` for the joint's heading, `false` for its pitch.
    pub heading: bool,
    /// Range of motion, radians.
    pub range: [f64; 2],
    /// Largest speed, rad/s.
    pub rate: f64,
    /// Weight in the displacement cost.
    pub stiffness: f64,
    /// Plane of rotation in the joint's space: the angle turns the first direction towards the second.
    plane: [DVec3; 2],
}

/// A rig in a pose, in double precision.
#[derive(Clone, Debug)]
pub struct Model {
    /// The declared angles, joint by joint from the effector inward, pitch before heading.
    pub angles: Vec<Angle>,
    origin: DVec3,
    forward: DVec3,
    left: DVec3,
    /// Transform of each joint to the next one's space; of the last one, to the pose's.
    links: Vec<DAffine3>,
}

/// Rotates `v` in the plane of two orthogonal unit vectors, from the first towards the second.
fn turn(v: DVec3, [from, towards]: [DVec3; 2], (sin, cos): (f64, f64)) -> DVec3 {
    let (x, y) = (v.dot(from), v.dot(towards));
    v + (x * (cos - 1.0) - y * sin) * from + (x * sin + y * (cos - 1.0)) * towards
}

/// Returns the angle between two vectors, 0…π; accurate for small angles.
pub(crate) fn angle(a: DVec3, b: DVec3) -> f64 {
    a.cross(b).length().atan2(a.dot(b))
}

/// Converts three numbers to double precision.
pub(crate) fn double(v: [f32; 3]) -> DVec3 {
    DVec3::from_array(v.map(f64::from))
}

impl Model {
    /// Creates the model of a rig in this pose, whose joints are ordered from the effector inward.
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
        // Any direction perpendicular to forward will do: only the residuals' lengths and zeros matter.
        Self { angles, origin: double(effector.origin), forward, left: forward.any_orthonormal_vector(), links }
    }

    /// Returns the number of declared angles.
    pub fn count(&self) -> usize {
        self.angles.len()
    }

    /// Returns the joints' angles in the order of [`Model::angles`].
    pub fn read(&self, joints: &[Joint]) -> Angles {
        let mut values = [0.0; MOST];
        for (value, angle) in values.iter_mut().zip(&self.angles) {
            let joint = &joints[angle.joint];
            *value = if angle.heading { joint.heading() } else { joint.pitch() }.into();
        }
        values
    }

    /// Returns the effector's position, forward direction and a direction perpendicular to it, in the pose's space.
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

    /// Returns the effector's direction at these angles, a unit vector in the pose's space.
    pub fn gaze(&self, values: &Angles) -> DVec3 {
        self.effector(values)[1].normalize()
    }

    /// Returns the effector's position at these angles, in the pose's space.
    pub fn origin(&self, values: &Angles) -> DVec3 {
        self.effector(values)[0]
    }

    /// Returns the point at this distance straight ahead of the effector.
    pub fn ahead(&self, values: &Angles, distance: f64) -> DVec3 {
        let [origin, forward, _] = self.effector(values);
        origin + distance * forward.normalize()
    }

    /// Returns the angle between the gaze and the target, radians.
    pub fn remaining(&self, values: &Angles, target: DVec3) -> f64 {
        let [origin, forward, _] = self.effector(values);
        angle(forward, target - origin)
    }

    /// Returns the distance of the effector from the target.
    pub fn distance(&self, values: &Angles, target: DVec3) -> f64 {
        target.distance(self.effector(values)[0])
    }

    /// Returns the angle between gaze and target as a vector: its length is the angle in radians, its direction that of
    /// the target as seen from the effector.
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

    /// Returns the residual's derivatives by each angle, by central differences.
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

    /// Returns the displacement cost Σ stiffness θ², with the declared stiffnesses.
    pub fn cost(&self, values: &Angles) -> f64 {
        self.angles.iter().zip(values).map(|(angle, value)| angle.stiffness * value * value).sum()
    }

    /// Returns the effector's position and direction after the *corrections* are applied, as a user of the rig sees
    /// them.
    pub fn seen(&self, corrections: &[Quat]) -> [DVec3; 2] {
        let [mut origin, mut forward] = [self.origin, self.forward];
        for (correction, link) in corrections.iter().zip(&self.links) {
            let correction = correction.as_dquat().normalize();
            origin = link.transform_point3(correction * origin);
            forward = link.transform_vector3(correction * forward);
        }
        [origin, forward.normalize()]
    }

    /// Returns the angle between the corrected gaze and the target, radians.
    pub fn seen_remaining(&self, corrections: &[Quat], target: DVec3) -> f64 {
        let [origin, forward] = self.seen(corrections);
        angle(forward, target - origin)
    }

    /// Returns the lower and upper ends of the ranges of motion.
    pub fn ranges(&self) -> [Angles; 2] {
        self.bounds(|angle| angle.range)
    }

    /// Returns the bounds of the angles that are reachable from `from` within `seconds` at the declared rates and
    /// within the ranges.
    pub fn reach(&self, from: &Angles, seconds: f64) -> [Angles; 2] {
        let mut from = from.iter();
        self.bounds(|angle| {
            let (from, step) = (*from.next().unwrap_or(&0.0), angle.rate * seconds);
            let [lo, hi] = angle.range;
            // An angle outside its range may only move back towards it.
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

    /// Returns an upper bound of the time to move from any angles to any others, seconds: the sum over the joints of
    /// range divided by rate.
    pub fn longest(&self) -> f64 {
        let seconds = |angle: &Angle| (angle.range[1] - angle.range[0]).min(std::f64::consts::TAU) / angle.rate;
        let of = |joint: usize| self.angles.iter().filter(move |angle| angle.joint == joint).map(seconds);
        (0..self.links.len()).map(|joint| of(joint).fold(0.0, f64::max)).sum()
    }
}
