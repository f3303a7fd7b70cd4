//! [`Sights`]: the points and directions from and along which joints look. They measure the error and the roll of a
//! gaze.

use core::f64::consts::TAU;

use aim_gltf::Skeleton;
use aim_runtime::glam::{DAffine3, DMat3, DVec3, Vec3};
use aim_runtime::{Effector, Rig, Role as Gaze};

use crate::bake::chain::ChainNodes;
use crate::measure::Measurement;
use crate::measure::frame::orthonormal;
use crate::measure::roles::Role;

/// Sine of the least angle (1°) between the gaze and an up direction for which a roll is defined.
const TELLS_ROLL: f64 = 0.017_452;

/// Sights of the nodes of a chain.
#[derive(Clone, Debug)]
pub(crate) struct Sights {
    /// Sight of each joint; that of joint 0 is the effector's.
    joints: Vec<Sight>,
    pub(crate) other_eye: Option<Sight>,
    /// For each joint, whether it is an eye, the head, the neck, or joint 0.
    looks: Vec<bool>,
}

/// Point, forward and up of a gaze, fixed to a node and in the node's space.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sight {
    node: usize,
    origin: DVec3,
    forward: DVec3,
    up: DVec3,
}

impl Sight {
    /// Returns the angle between the forward direction and the direction to `target`, degrees; 90 if either is
    /// undefined.
    pub(crate) fn error_deg(&self, world: &[DAffine3], target: DVec3) -> f64 {
        let forward = self.forward(world);
        let to_target = target - world[self.node].transform_point3(self.origin);
        let error = forward.cross(to_target).length().atan2(forward.dot(to_target));
        if error.is_finite() && to_target.length() > 0.0 { error.to_degrees() } else { 90.0 }
    }

    fn forward(&self, world: &[DAffine3]) -> DVec3 {
        world[self.node].transform_vector3(self.forward)
    }

    /// Returns the point and the unit direction of the gaze in world space.
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

    /// Returns `true` for a turned node that moves with the gaze while joint `effector` is aimed: that joint or one
    /// nearer the effector, an eye, the head or the neck. `None` if the node is not turned.
    pub(crate) fn looks(&self, node: usize, effector: usize) -> Option<bool> {
        let is_other = || self.other_eye.is_some_and(|eye| eye.node == node).then_some(true);
        let joint = self.joints.iter().position(|sight| sight.node == node);
        joint.map(|joint| joint <= effector || self.looks[joint]).or_else(is_other)
    }

    /// Returns the sight of joint `aimed`; past the last joint, that of the last, like
    /// [`Settings::effector`](aim_runtime::Settings::effector).
    pub(crate) fn sight(&self, aimed: usize) -> &Sight {
        &self.joints[aimed.min(self.joints.len() - 1)]
    }

    /// Returns the roll of joint `effector` when aimed, less that when animated, degrees, positive to the left of a
    /// character with this up; 0 if either roll is undefined.
    pub(crate) fn roll_deg(&self, effector: usize, up: DVec3, [animated, aimed]: [&[DAffine3]; 2]) -> f64 {
        let sight = self.sight(effector);
        let roll = |world: &[DAffine3]| roll(sight.forward(world), up, world[sight.node].transform_vector3(sight.up));
        let more = roll(aimed).zip(roll(animated)).map_or(0.0, |(aimed, animated)| aimed - animated);
        (more - TAU * (more / TAU).round()).to_degrees()
    }
}

/// Returns the bone that shows how the character as a whole is oriented: the hips if they are an ancestor of the chain,
/// otherwise the chain's root.
pub(crate) fn trunk(skeleton: &Skeleton, chain: &ChainNodes, measurement: &Measurement) -> usize {
    let eye = chain.joints[0];
    let hips = measurement.with_role(Role::Hips).map(|bone| bone.node);
    let hips = hips.filter(|hips| skeleton.ancestry(eye).any(|node| node == *hips));
    hips.or_else(|| skeleton.ancestry(eye).last()).unwrap_or(eye)
}

/// Returns the up of the standing character in the world: the coordinate axis nearest to the joints' declared ups in
/// the bind pose. It is not always +Y, because the character in a file may lie.
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
    // If two axes are equally near, +Y is preferred.
    let largest = if size.y == size.max_element() { 1 } else { size.max_position() };
    DVec3::AXES[largest] * up[largest].signum()
}

/// Returns the angle about `gaze` from `up` to `bone_up`, seen along the gaze, positive to the left of an observer who
/// looks along it. `None` if either of them lies along the gaze.
fn roll(gaze: DVec3, up: DVec3, bone_up: DVec3) -> Option<f64> {
    let gaze = gaze.normalize_or_zero();
    let [up, bone_up] = [up, bone_up].map(|v| {
        let across = v.normalize_or_zero();
        across - gaze * gaze.dot(across)
    });
    let known = gaze != DVec3::ZERO && up.length() > TELLS_ROLL && bone_up.length() > TELLS_ROLL;
    known.then(|| gaze.dot(bone_up.cross(up)).atan2(bone_up.dot(up)))
}

/// Returns the sight of the other eye: in the bind pose it looks in the same direction, from the mirrored point.
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
        // Looking up by 60° without a roll.
        let (sin, cos) = 60_f64.to_radians().sin_cos();
        let found = roll(forward * cos + up * sin, up, up * cos - forward * sin).expect("it is plain to see");
        assert!(found.abs() < 1e-12, "{found}");
        // Looking straight up, or without a gaze, the roll is undefined.
        assert_eq!((roll(up, up, forward), roll(DVec3::ZERO, up, forward)), (None, None));
        assert_eq!(roll(forward, up, forward), None);
    }
}
