//! [`Sights`]: where the joints and the other eye look from and along, by which results are judged, and how a gaze is rolled.

use core::f64::consts::TAU;

use aim_gltf::Skeleton;
use aim_runtime::glam::{DAffine3, DMat3, DVec3, Vec3};
use aim_runtime::{Effector, Rig, Role as Gaze};

use crate::bake::chain::ChainNodes;
use crate::measure::Measurement;
use crate::measure::frame::orthonormal;
use crate::measure::roles::Role;

/// A direction nearer than this to the gaze does not tell a roll (sine of 1°).
const TELLS_ROLL: f64 = 0.017_452;

/// Sights of the nodes of a chain.
#[derive(Clone, Debug)]
pub(crate) struct Sights {
    /// Of each joint; that of joint 0 is the effector's.
    joints: Vec<Sight>,
    pub(crate) other_eye: Option<Sight>,
    /// Each joint that is of eyes, head or neck, or is joint 0.
    looks: Vec<bool>,
}

/// A point, a direction and the up that tells its roll, of a node and in the node's space.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sight {
    node: usize,
    origin: DVec3,
    forward: DVec3,
    up: DVec3,
}

impl Sight {
    /// Degrees between the direction and that to `target`; 90 if either has no direction.
    pub(crate) fn error_deg(&self, world: &[DAffine3], target: DVec3) -> f64 {
        let forward = self.forward(world);
        let to_target = target - world[self.node].transform_point3(self.origin);
        let error = forward.cross(to_target).length().atan2(forward.dot(to_target));
        if error.is_finite() && to_target.length() > 0.0 { error.to_degrees() } else { 90.0 }
    }

    fn forward(&self, world: &[DAffine3]) -> DVec3 {
        world[self.node].transform_vector3(self.forward)
    }

    /// The point and the direction, of length one, in the world.
    pub(crate) fn gaze(&self, world: &[DAffine3]) -> [DVec3; 2] {
        [world[self.node].transform_point3(self.origin), self.forward(world).normalize_or_zero()]
    }
}

impl Sights {
    pub(crate) fn new(rig: &dyn Rig, chain: &ChainNodes, measurement: &Measurement) -> Self {
        let description = rig.description();
        let &Effector { forward, origin } = description.effector();
        let own = description.joints().iter().zip(&chain.joints).map(|(info, &node)| {
            let [forward, up] = [info.axes().forward, info.axes().up].map(|axis| Vec3::from(axis).as_dvec3());
            Sight { node, origin: DVec3::ZERO, forward, up }
        });
        let mut joints: Vec<Sight> = own.collect();
        let effector =
            Sight { origin: Vec3::from(origin).as_dvec3(), forward: Vec3::from(forward).as_dvec3(), ..joints[0] };
        joints[0] = effector;
        Self {
            other_eye: chain.other_eye.map(|pair| other(&effector, pair, measurement)),
            joints,
            looks: (description.joints().iter().enumerate())
                .map(|(at, joint)| at == 0 || matches!(joint.role, Gaze::Eye | Gaze::Head | Gaze::Neck))
                .collect(),
        }
    }

    /// True of a node that is turned and looks while joint `effector` is aimed, or carries what does in the head; `None` if it is not
    /// turned.
    pub(crate) fn looks(&self, node: usize, effector: usize) -> Option<bool> {
        let is_other = || self.other_eye.is_some_and(|eye| eye.node == node).then_some(true);
        let joint = self.joints.iter().position(|sight| sight.node == node);
        joint.map(|joint| joint <= effector || self.looks[joint]).or_else(is_other)
    }

    /// Sight of joint `aimed`, as the solvers read
    /// [`Settings::effector`](aim_runtime::Settings::effector): past the last joint is the last.
    pub(crate) fn sight(&self, aimed: usize) -> &Sight {
        &self.joints[aimed.min(self.joints.len() - 1)]
    }

    /// By how much joint `effector` is rolled more when aimed than when animated, degrees, positive to the left of a character with
    /// this up; 0 where either has no roll.
    pub(crate) fn roll_deg(&self, effector: usize, up: DVec3, [animated, aimed]: [&[DAffine3]; 2]) -> f64 {
        let sight = self.sight(effector);
        let roll = |world: &[DAffine3]| roll(sight.forward(world), up, world[sight.node].transform_vector3(sight.up));
        let more = roll(aimed).zip(roll(animated)).map_or(0.0, |(aimed, animated)| aimed - animated);
        (more - TAU * (more / TAU).round()).to_degrees()
    }
}

/// The bone that tells how the character as a whole is turned: the hips, if the chain hangs on them, else its root.
pub(crate) fn trunk(skeleton: &Skeleton, chain: &ChainNodes, measurement: &Measurement) -> usize {
    let eye = chain.joints[0];
    let hips = measurement.with_role(Role::Hips).map(|bone| bone.node);
    let hips = hips.filter(|hips| skeleton.ancestry(eye).any(|node| node == *hips));
    hips.or_else(|| skeleton.ancestry(eye).last()).unwrap_or(eye)
}

/// Up in the world for a character that stands: the axis nearest to the joints' declared ups in the bind pose, as a file may hold a
/// character that lies.
pub(crate) fn standing_up(rig: &dyn Rig, chain: &ChainNodes, measurement: &Measurement) -> DVec3 {
    let description = rig.description();
    let ups = description.joints().iter().zip(&chain.joints).map(|(info, &node)| {
        let up = Vec3::from(info.axes().up).as_dvec3();
        measurement.bind_world[node].transform_vector3(up).normalize_or_zero()
    });
    let up: DVec3 = ups.sum();
    let size = up.abs();
    if up == DVec3::ZERO || !up.is_finite() {
        return measurement.up;
    }
    // Of equals the measured up.
    let largest = if size.y == size.max_element() { 1 } else { size.max_position() };
    DVec3::AXES[largest] * up[largest].signum()
}

/// The angle about `gaze` from `up` to `bone_up`, each as seen along the gaze, positive to the left of who looks along
/// it. `None` where one of them lies along the gaze.
fn roll(gaze: DVec3, up: DVec3, bone_up: DVec3) -> Option<f64> {
    let gaze = gaze.normalize_or_zero();
    let [up, bone_up] = [up, bone_up].map(|v| {
        let across = v.normalize_or_zero();
        across - gaze * gaze.dot(across)
    });
    let known = gaze != DVec3::ZERO && up.length() > TELLS_ROLL && bone_up.length() > TELLS_ROLL;
    known.then(|| gaze.dot(bone_up.cross(up)).atan2(bone_up.dot(up)))
}

/// Sight of the other eye: in the bind pose it looks the same way, from the mirrored point.
fn other(effector: &Sight, pair: usize, measurement: &Measurement) -> Sight {
    let Measurement { bind_world: bind, left, .. } = measurement;
    let frame = |node: usize| -> DMat3 { orthonormal(&bind[node].matrix3).0 };
    let out = bind[effector.node].transform_vector3(effector.origin);
    let mirrored = out - *left * (2.0 * out.dot(*left));
    let origin = bind[pair].inverse().transform_vector3(mirrored);
    let carried = frame(pair).transpose() * frame(effector.node);
    Sight {
        node: pair,
        origin: if origin.is_finite() { origin } else { DVec3::ZERO },
        forward: carried * effector.forward,
        up: carried * effector.up,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_head_tilted_to_its_left_has_a_positive_roll() {
        let (left, up, forward) = (DVec3::X, DVec3::Y, DVec3::Z);
        let tilted = |degrees: f64| up * degrees.to_radians().cos() + left * degrees.to_radians().sin();
        for degrees in [0.0, 20.0, -20.0, 170.0] {
            let found = roll(forward, up, tilted(degrees)).expect("it is plain to see").to_degrees();
            assert!((found - degrees).abs() < 1e-9, "{found}° for {degrees}°");
        }
        // Looking up by 60° as nobody rolls.
        let (sin, cos) = 60_f64.to_radians().sin_cos();
        let found = roll(forward * cos + up * sin, up, up * cos - forward * sin).expect("it is plain to see");
        assert!(found.abs() < 1e-12, "{found}");
        // Nothing tells straight up, nor without a gaze.
        assert_eq!((roll(up, up, forward), roll(DVec3::ZERO, up, forward)), (None, None));
        assert_eq!(roll(forward, up, forward), None);
    }
}
