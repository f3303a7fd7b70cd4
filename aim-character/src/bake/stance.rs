//! [`Stance`]: how the character stands while it is aimed: what is up for it, its bind pose carried along, how much its
//! gaze is rolled, and where its other eye looks.

use core::f64::consts::{PI, TAU};

use aim_runtime::{Effector, LimitsFrom, Pose, Rig, Role as Gaze};
use glam::{Affine3A, DAffine3, DMat3, DQuat, DVec3, Quat, Vec3};

use crate::bake::chain::ChainNodes;
use crate::measure::Measurement;
use crate::measure::frame::{orthonormal, parent_frame};
use crate::measure::roles::Role;
use aim_animation::Transform;
use aim_gltf::Skeleton;

/// Up to this lean of the hips the world's up is the character's: it stands, walks, or bends forward.
const STANDS_RAD: f64 = 45.0 / 180.0 * PI;
/// From this lean on it lies or hangs, and its up is that of its hips.
const LIES_RAD: f64 = 75.0 / 180.0 * PI;
/// A direction nearer than this to the gaze does not tell a roll (sine of 1°).
const TELLS_ROLL: f64 = 0.017_452;

/// Facts that stay fixed while one chain of one character is aimed.
#[derive(Clone, Debug)]
pub(crate) struct Stance {
    pub(crate) chain: ChainNodes,
    /// Every node in the bind pose, in the world.
    bind_world: Vec<DAffine3>,
    /// The bone that the chain hangs on.
    carrier: Option<usize>,
    /// The bone that tells how the character as a whole is turned.
    trunk: Option<usize>,
    /// Sight of each joint; that of joint 0 is the effector's.
    sights: Vec<Sight>,
    /// Sight of the other eye.
    pub(crate) other_eye: Option<Sight>,
    /// Up in the world for a character that stands: the axis nearest to the joints' declared up, as a file may
    /// hold a character that lies.
    standing: DVec3,
    /// Whether each joint is of eyes, head or neck, or is joint 0; past the last is the other eye.
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

impl Stance {
    pub(crate) fn new(rig: &dyn Rig, skeleton: &Skeleton, chain: &ChainNodes, measurement: &Measurement) -> Self {
        let above = |node: &usize| skeleton.parents()[*node];
        let hips = measurement.with_role(Role::Hips).map(|bone| bone.node);
        let ancestry = || skeleton.ancestry(chain.joints[0]);
        let description = rig.description();
        let &Effector { forward, origin } = description.effector();
        let own = description.joints().iter().zip(&chain.joints).map(|(info, &node)| {
            let [forward, up] = [info.axes().forward, info.axes().up].map(|axis| Vec3::from(axis).as_dvec3());
            Sight { node, origin: DVec3::ZERO, forward, up }
        });
        let mut sights: Vec<Sight> = own.collect();
        let effector =
            Sight { origin: Vec3::from(origin).as_dvec3(), forward: Vec3::from(forward).as_dvec3(), ..sights[0] };
        sights[0] = effector;
        Self {
            chain: chain.clone(),
            bind_world: measurement.bind_world.clone(),
            carrier: chain.joints.last().and_then(above),
            trunk: hips.filter(|hips| ancestry().any(|node| node == *hips)).or_else(|| ancestry().last()),
            other_eye: chain.other_eye.map(|pair| other(&effector, pair, measurement)),
            sights,
            standing: standing(rig, chain, measurement),
            looks: (description.joints().iter().enumerate())
                .map(|(at, joint)| at == 0 || matches!(joint.role, Gaze::Eye | Gaze::Head | Gaze::Neck))
                .collect(),
        }
    }

    /// True of a turned node that looks while joint `effector` is aimed, or carries what does in the head: by its place among
    /// [`ChainNodes::turned`].
    pub(crate) fn looks(&self, turned: usize, effector: usize) -> bool {
        turned <= effector || self.looks.get(turned).copied().unwrap_or(true)
    }

    /// The character's up: that of the world as long as it stands, its own if it lies or hangs, and from the
    /// one to the other without a jump.
    pub(crate) fn up(&self, world: &[DAffine3]) -> DVec3 {
        let standing = self.standing;
        let Some(trunk) = self.trunk else { return standing };
        let [bind, now] = [&self.bind_world[trunk], &world[trunk]].map(|at| orthonormal(&at.matrix3).0);
        let own = now * bind.transpose() * standing;
        let lean = standing.cross(own).length().atan2(standing.dot(own));
        let share = ((lean - STANDS_RAD) / (LIES_RAD - STANDS_RAD)).clamp(0.0, 1.0);
        standing.lerp(own, share * share * (3.0 - 2.0 * share)).normalize_or(standing)
    }

    /// The joints' bind pose, carried along by what the chain hangs on.
    pub(crate) fn bind(&self, world: &[DAffine3]) -> Vec<Affine3A> {
        let bind = &self.bind_world;
        let carried = self.carrier.map(|node| world[node] * bind[node].inverse());
        let carried = carried.filter(DAffine3::is_finite).unwrap_or(DAffine3::IDENTITY);
        self.chain.joints.iter().map(|&node| (carried * bind[node]).as_affine3a()).collect()
    }

    /// The heading and pitch, radians, by which the animation turns a joint with an absolute range out of its bind pose,
    /// as seen from the next joint; `None` where ranges are relative.
    pub(crate) fn led(&self, rig: &dyn Rig, joint: usize, pose: &Pose<Vec<Affine3A>>) -> Option<[f64; 2]> {
        let description = rig.description();
        let info = description.joints().get(joint).filter(|info| info.limits_from == LimitsFrom::BindPose)?;
        let local = |joints: &[Affine3A]| -> Option<DMat3> {
            let frame = |at: &Affine3A| orthonormal(&at.matrix3.as_dmat3()).0;
            let own = frame(joints.get(joint)?);
            Some(joints.get(joint + 1).map_or(own, |next| frame(next).transpose() * own))
        };
        let turn = local(pose.bind.as_ref()?)?.transpose() * local(&pose.joints)?;
        let [up, ahead, left] =
            [info.axes().up, info.axes().forward, info.axes().left].map(|axis| Vec3::from(axis).as_dvec3());
        let forward = turn * ahead;
        let (up, ahead, left) = (forward.dot(up), forward.dot(ahead), forward.dot(left));
        Some([left.atan2(ahead), up.atan2(left.hypot(ahead))])
    }

    /// The other eye's local rotation with which it looks as joint 0 does, as both do in the bind pose. Animations that
    /// turn eyes by themselves seldom keep them parallel, and what a skin shows of an eye is what the bind pose says.
    pub(crate) fn parallel(&self, skeleton: &Skeleton, pose: &[Transform], world: &[DAffine3]) -> Option<Quat> {
        let (eye, pair) = (self.sights[0].node, self.other_eye.as_ref()?.node);
        let bind = &self.bind_world;
        let frame = |at: &DAffine3| orthonormal(&at.matrix3).0;
        let wanted = frame(&world[eye]) * frame(&bind[eye]).transpose() * frame(&bind[pair]);
        let parent = parent_frame(skeleton, world, pair);
        // Mirrors, the bone's own and those above it, are the same in both poses, or else there is no such rotation.
        let local = parent.transpose() * wanted * DMat3::from_diagonal(pose[pair].scale.signum().as_dvec3());
        (local.determinant() > 0.5).then(|| DQuat::from_mat3(&local).normalize().as_quat())
    }

    /// Sight of joint `aimed`, as the solvers read
    /// [`Settings::effector`](aim_runtime::Settings::effector): past the last joint is the last.
    pub(crate) fn sight(&self, aimed: usize) -> &Sight {
        &self.sights[aimed.min(self.sights.len() - 1)]
    }

    /// By how much joint `effector` is rolled more when aimed than when animated, degrees, positive to the character's
    /// left; 0 where either has no roll.
    pub(crate) fn roll_deg(&self, effector: usize, animated: &[DAffine3], aimed: &[DAffine3]) -> f64 {
        let (up, sight) = (self.up(animated), self.sight(effector));
        let roll = |world: &[DAffine3]| roll(sight.forward(world), up, world[sight.node].transform_vector3(sight.up));
        let more = roll(aimed).zip(roll(animated)).map_or(0.0, |(aimed, animated)| aimed - animated);
        (more - TAU * (more / TAU).round()).to_degrees()
    }
}

/// The axis of the world nearest to the joints' declared ups in the bind pose.
fn standing(rig: &dyn Rig, chain: &ChainNodes, measurement: &Measurement) -> DVec3 {
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
