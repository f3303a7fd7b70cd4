//! Forward kinematics in f64, written from the definitions alone: the independent oracle of the numeric tests.

use aim_codegen::{Frame, JointSpec, RigSpec};

/// A vector of three components.
///
/// The functions below are written component by component, without closures: the tests are not optimised, and call them
/// a hundred million times.
pub type V = [f64; 3];

/// Returns a + b.
pub fn add(a: V, b: V) -> V {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

/// Returns a − b.
pub fn sub(a: V, b: V) -> V {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// Returns a · b.
pub fn dot(a: V, b: V) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Returns a × b.
pub fn cross(a: V, b: V) -> V {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// Returns k a.
pub fn scale(k: f64, a: V) -> V {
    [k * a[0], k * a[1], k * a[2]]
}

/// Returns |a|.
pub fn norm(a: V) -> f64 {
    dot(a, a).sqrt()
}

/// Rotates `v` by `radians` in the plane of two orthogonal unit vectors, the first towards the second.
pub fn turn(v: V, from: V, towards: V, radians: f64) -> V {
    let (sin, cos) = radians.sin_cos();
    let (a, b) = (dot(v, from), dot(v, towards));
    let change = add(scale(a * (cos - 1.0) - b * sin, from), scale(a * sin + b * (cos - 1.0), towards));
    add(v, change)
}

/// Returns the sixth-order central difference of `f` at 0.
pub fn central_difference<const R: usize>(f: impl Fn(f64) -> [f64; R]) -> [f64; R] {
    const STEP: f64 = 2e-3;
    let weights = [(1.0, 45.0), (2.0, -9.0), (3.0, 1.0)];
    let mut sum = [0.0; R];
    for (steps, weight) in weights {
        let (ahead, behind) = (f(steps * STEP), f(-steps * STEP));
        for (sum, (ahead, behind)) in sum.iter_mut().zip(ahead.into_iter().zip(behind)) {
            *sum += weight * (ahead - behind);
        }
    }
    sum.map(|sum| sum / (60.0 * STEP))
}

/// Applies a joint's added rotation: pitch turns forward towards up, then heading turns forward towards left.
pub fn correct(v: V, frame: &Frame, pitch: f64, heading: f64) -> V {
    turn(turn(v, frame.forward, frame.up, pitch), frame.forward, frame.left, heading)
}

/// A link: rows of the rotation in the row-vector layout, and a translation.
#[derive(Clone, Copy, Debug)]
pub struct Link {
    /// Images of the three axes.
    pub rows: [V; 3],
    /// Image of the origin.
    pub translation: V,
}

impl Link {
    /// Returns the image of a direction.
    pub fn direction(&self, v: V) -> V {
        let [a, b, c] = self.rows;
        [
            v[0] * a[0] + v[1] * b[0] + v[2] * c[0],
            v[0] * a[1] + v[1] * b[1] + v[2] * c[1],
            v[0] * a[2] + v[1] * b[2] + v[2] * c[2],
        ]
    }

    /// Returns the image of a point.
    pub fn point(&self, p: V) -> V {
        add(self.direction(p), self.translation)
    }

    /// Returns the twelve numbers that the kernels take.
    pub fn numbers(&self) -> [f64; 12] {
        let [a, b, c] = self.rows;
        let t = self.translation;
        [a[0], a[1], a[2], b[0], b[1], b[2], c[0], c[1], c[2], t[0], t[1], t[2]]
    }
}

/// A pose of a chain and its target.
#[derive(Clone, Debug)]
pub struct Case {
    /// Links from the effector to joint 0, then from joint i−1 to joint i.
    pub links: Vec<Link>,
    /// Target in the last joint's space.
    pub target: V,
    /// Pitch and heading of each joint, radians; a hinge's missing angle is 0.
    pub angles: Vec<[f64; 2]>,
}

impl Case {
    /// Returns the effector's position and its image of `direction`, in the last joint's space.
    fn push(&self, joints: &[JointSpec], direction: V) -> (V, V) {
        let (mut origin, mut direction) = ([0.0; 3], direction);
        for ((joint, link), &[pitch, heading]) in joints.iter().zip(&self.links).zip(&self.angles) {
            origin = correct(link.point(origin), &joint.frame, pitch, heading);
            direction = correct(link.direction(direction), &joint.frame, pitch, heading);
        }
        (origin, direction)
    }

    /// Returns the paper's aim, equation (6).
    pub fn aim(&self, spec: &RigSpec) -> f64 {
        let (origin, forward) = self.push(&spec.joints, spec.effector.frame.forward);
        let to_target = sub(self.target, origin);
        dot(to_target, forward) / norm(to_target)
    }

    /// Returns the stereographic residual, left and up.
    pub fn residual(&self, spec: &RigSpec) -> [f64; 2] {
        let frame = spec.effector.frame;
        let (origin, forward) = self.push(&spec.joints, frame.forward);
        let to_target = sub(self.target, origin);
        let below = norm(to_target) + dot(to_target, forward);
        [frame.left, frame.up].map(|axis| 2.0 * dot(to_target, self.push(&spec.joints, axis).1) / below)
    }

    /// Returns the target's distance from the effector, and its angle off the forward direction.
    pub fn view(&self, spec: &RigSpec) -> (f64, f64) {
        let (origin, forward) = self.push(&spec.joints, spec.effector.frame.forward);
        let to_target = sub(self.target, origin);
        (norm(to_target), norm(cross(to_target, forward)).atan2(dot(to_target, forward)))
    }

    /// Returns the central difference of `f` by angle `which` of `joint`: 0 is pitch, 1 heading.
    pub fn difference<const R: usize>(&self, joint: usize, which: usize, f: impl Fn(&Self) -> [f64; R]) -> [f64; R] {
        central_difference(|change| {
            let mut moved = self.clone();
            moved.angles[joint][which] += change;
            f(&moved)
        })
    }

    /// Returns sin p, cos p, sin h, cos h of each joint.
    pub fn sin_cos(&self) -> Vec<[f64; 4]> {
        self.angles.iter().map(|[p, h]| [p.sin(), p.cos(), h.sin(), h.cos()]).collect()
    }
}
