//! Random rigs, poses, animations and targets.

use aim_runtime::glam::{Affine3A, Mat3A, Quat, Vec3, Vec3A};
use aim_runtime::{Axes, JointInfo, LimitsFrom, Role};

use super::*;

impl Rng {
    /// Returns `true` in one of `times` cases.
    pub fn once_in(&mut self, times: usize) -> bool {
        self.below(times) == 0
    }

    /// Returns a number whose order of magnitude is uniformly distributed between these.
    pub fn of_any_size(&mut self, least: f32, most: f32) -> f32 {
        least * (most / least).powf(self.between(0.0, 1.0))
    }

    pub fn turn(&mut self, most_rad: f32) -> Quat {
        Quat::from_axis_angle(self.direction(), self.between(-most_rad, most_rad))
    }
}

/// Returns one of the 48 conventions or, in one of four cases, a general frame.
pub fn axes(rng: &mut Rng) -> Axes {
    let (axes, _) = triples()[rng.below(48)];
    if !rng.once_in(4) {
        return axes;
    }
    let turn = rng.turn(1.0);
    let [up, forward, left] = [axes.up, axes.forward, axes.left].map(|v| (turn * Vec3::from(v)).to_array());
    Axes { up, forward, left }
}

/// Returns a range around 0 with independent ends, sometimes 0 on one side.
pub fn range(rng: &mut Rng, most_deg: f32) -> [f32; 2] {
    let mut side =
        || if rng.once_in(8) { 0.0 } else { most_deg * DEG * rng.between(0.02, 1.0) * rng.between(0.2, 1.0) };
    [-side(), side()]
}

/// Returns a joint with random properties.
pub fn joint(rng: &mut Rng, index: usize) -> JointInfo {
    let mut info = JointInfo::new(axes(rng), rng.of_any_size(0.1, 15.0)).with_stiffness(rng.of_any_size(0.1, 10.0));
    let declared = 1 + rng.below(3);
    if declared & 1 != 0 {
        let [lo, hi] = if rng.once_in(10) { [f32::NEG_INFINITY, f32::INFINITY] } else { range(rng, 150.0) };
        info = info.with_heading(lo, hi);
    }
    if declared & 2 != 0 {
        let [lo, hi] = range(rng, 90.0);
        info = info.with_pitch(lo, hi);
    }
    if rng.once_in(3) {
        info = info.with_acceleration(rng.of_any_size(0.5, 50.0));
    }
    if rng.once_in(4) {
        info = info.with_pitch_taper(rng.between(0.0, 1.0));
    }
    if rng.once_in(4) {
        info = info.with_upright(rng.between(-0.2, 1.2));
    }
    if rng.once_in(4) {
        info.limits_from = LimitsFrom::BindPose;
    }
    let roles = [Role::None, Role::Eye, Role::Head, Role::Neck, Role::Chest];
    info.with_role(if index == 0 && !rng.once_in(3) { Role::Eye } else { roles[rng.below(5)] })
}

/// Returns a rig of one to seven joints, most often three.
pub fn rig(rng: &mut Rng) -> NumericRig {
    let count = if rng.once_in(2) { 3 } else { 1 + rng.below(7) };
    let mut rig = NumericRig::new((0..count).map(|index| joint(rng, index)).collect());
    if rng.once_in(3) {
        rig.effector.origin = (rng.direction() * rng.between(0.0, 0.1)).to_array();
    }
    if rng.once_in(4) {
        let Axes { up, forward, left } = *rig.infos[0].axes();
        let [up, forward, left] = [up, forward, left].map(Vec3::from);
        let aside = rng.direction();
        rig.effector.forward = match rng.below(6) {
            // Along the bone's own up.
            0 => up,
            1 => -up,
            _ => (forward + 0.5 * (up * aside.x + left * aside.y)).normalize(),
        }
        .to_array();
    }
    rig
}

/// Animation of a rig's bones in a random world.
#[derive(Clone, Debug)]
pub struct Animation {
    /// Position, orientation and swing (axis, angle, speed) of each joint.
    joints: Vec<(Vec3, Quat, Vec3, f32, f32)>,
    world: Affine3A,
    /// Other eye's axes and its orientation relative to joint 0, if present.
    pair: Option<(Axes, Quat)>,
    /// `true` if the world transform preserves shapes.
    pub similar: bool,
    /// Characteristic length of the rig, in the pose's space.
    pub size: f32,
    /// Character's up in the pose's space.
    pub up: Vec3,
}

impl Animation {
    pub fn new(rig: &NumericRig, rng: &mut Rng) -> Self {
        let mut place = Vec3::new(0.0, 1.7, 0.0) + 0.1 * rng.direction();
        let (stands, swings) = ([0.0, 0.2, 3.0][rng.below(3)], [0.0, 0.2, 1.0][rng.below(3)]);
        let mut extent = Vec3::from(rig.effector.origin).length();
        let mut joints = Vec::new();
        for index in 0..rig.infos.len() {
            joints.push((
                place,
                rng.turn(stands),
                rng.direction(),
                swings * rng.between(0.0, 1.0),
                rng.between(0.5, 8.0),
            ));
            let link = Vec3::new(rng.between(-0.05, 0.05), -rng.between(0.02, 0.4), rng.between(-0.05, 0.1));
            if index + 1 < rig.infos.len() {
                extent += link.length();
            }
            place += link;
        }
        let parents = parents();
        let (_, parent, similar) = if rng.once_in(2) { parents[0] } else { parents[rng.below(parents.len())] };
        let scale = [0.01, 1.0, 1.0, 100.0][rng.below(4)];
        let world = Affine3A::from_scale(Vec3::splat(scale)) * parent;
        let longest =
            [Vec3::X, Vec3::Y, Vec3::Z].map(|v| world.transform_vector3(v).length()).into_iter().fold(0.0, f32::max);
        // A chain without length has that of a bone's axis.
        let size = longest * if extent > 0.0 { extent } else { 1.0 };
        let pair = rng.once_in(3).then(|| (axes(rng), rng.turn(0.1)));
        Self { joints, world, pair, similar, size, up: world.transform_vector3(Vec3::Y) }
    }

    /// Returns each joint's transform after this many seconds.
    pub fn at(&self, rig: &NumericRig, seconds: f32) -> Vec<Affine3A> {
        let mut pose = Vec::new();
        for (info, &(place, stands, axis, angle, speed)) in rig.infos.iter().zip(&self.joints) {
            let swing = Quat::from_axis_angle(axis, angle * (speed * seconds).sin());
            pose.push(self.world * bone(info.axes(), swing * stands, place));
        }
        pose
    }

    /// Returns the other eye's transform, 6 cm beside joint 0.
    pub fn pair_at(&self, rig: &NumericRig, seconds: f32) -> Option<Affine3A> {
        let (axes, turn) = self.pair.as_ref()?;
        let &(place, stands, axis, angle, speed) = &self.joints[0];
        let swing = Quat::from_axis_angle(axis, angle * (speed * seconds).sin()) * stands;
        let across = Mat3A::from_quat(swing) * bone(rig.infos[0].axes(), Quat::IDENTITY, Vec3::ZERO).matrix3;
        let aside = across * Vec3A::from(rig.infos[0].axes().left) * -0.06;
        Some(self.world * bone(axes, swing * *turn, place + Vec3::from(aside)))
    }

    /// Transforms a point from the world to the pose's space.
    pub fn point(&self, point: Vec3) -> Vec3 {
        self.world.transform_point3(point)
    }

    /// Returns joint 0's position in the world.
    pub fn eye(&self) -> Vec3 {
        self.joints[0].0
    }
}

/// Returns random angles within the declared ranges, including coupled ones.
pub fn state(rig: &NumericRig, rng: &mut Rng) -> Vec<Joint> {
    let mut pick = |[lo, hi]: [f64; 2]| rng.between(lo.max(-3.1) as f32, hi.min(3.1) as f32);
    let mut states = Vec::new();
    for info in &rig.infos {
        let heading = pick(truth::heading_range(info, None));
        states.push(Joint::from_angles(heading, pick(truth::pitch_range(info, None, heading.into()))));
    }
    states
}
