//! Random rigs: one to seven joints in any convention, any subset of angles, any ranges, rates and stiffnesses,
//! effectors away from their joint, some headings unlimited.

use aim::glam::{Affine3A, Quat, Vec3};
use aim::{Axes, DynAim, Joint, JointInfo, State};

use super::chain::{DEG, direction, random_state};
use super::model::Model;
use super::numeric::NumericRig;

/// Largest number of joints of a rig.
const MOST_JOINTS: usize = 7;

/// A rig in a pose with a target.
#[derive(Clone, Debug)]
pub struct Case {
    /// The rig.
    pub rig: NumericRig,
    /// State of the joints: at rest, or random angles in their ranges.
    pub joints: Vec<Joint>,
    /// Transforms of the joints, from the effector inward.
    pub pose: Vec<Affine3A>,
    /// Target in the pose's space.
    pub target: Vec3,
    /// Frame rate, frames a second.
    pub hz: f32,
    /// `true` if the target was placed straight ahead of random angles within the ranges, and is therefore known to be
    /// reachable.
    pub reachable: bool,
}

impl Case {
    /// Returns a character with the rig and the joints of this case.
    pub fn character(&self) -> DynAim<NumericRig> {
        let mut character = DynAim::new(self.rig.clone());
        character.state = State::new(self.joints.clone());
        character
    }
}

/// Returns the case with this number, the same on every run.
pub fn case(number: usize) -> Case {
    let mut random = fastrand::Rng::with_seed(0x5eed_0000 + number as u64);
    let joints = 1 + random.usize(..MOST_JOINTS);
    let infos: Vec<JointInfo> = (0..joints).map(|_| joint(&mut random)).collect();
    let mut rig = NumericRig::new(&infos);
    if random.bool() {
        rig.effector.origin = (direction(&mut random) * 0.1 * random.f32()).to_array();
    }
    if random.u8(..4) == 0 {
        // Rotate the effector by up to 0.5 rad (29°) off its joint's forward.
        let axis = Vec3::from(infos[0].axes().up).lerp(infos[0].axes().left.into(), random.f32()).normalize();
        let turn = Quat::from_axis_angle(axis, 0.5 * random.f32());
        rig.effector.forward = (turn * Vec3::from(infos[0].axes().forward)).normalize().to_array();
    }
    let pose = pose(&infos, &mut random);
    let model = Model::new(&rig, &pose);
    let reachable = random.bool();
    let distance = 0.3 + 4.7 * random.f64();
    let target = if reachable {
        let state = random_state(&rig, &mut random);
        model.ahead(&model.read(&state), distance).as_vec3()
    } else {
        #[expect(clippy::cast_possible_truncation, reason = "targets are in f32")]
        let distance = distance as f32;
        pose[0].transform_point3(Vec3::from(rig.effector.origin)) + distance * direction(&mut random)
    };
    let joints = if random.bool() { random_state(&rig, &mut random) } else { vec![Joint::REST; infos.len()] };
    let hz = [30.0, 60.0, 144.0][random.usize(..3)];
    Case { rig, joints, pose, target, hz, reachable }
}

fn joint(random: &mut fastrand::Rng) -> JointInfo {
    let rate = 2.0 * 5.0_f32.powf(random.f32());
    let mut info = JointInfo::new(axes(random), rate).with_stiffness(0.1 * 100.0_f32.powf(random.f32()));
    let declared = random.u8(1..4);
    if declared & 1 != 0 {
        let [lo, hi] = range(random, 150.0);
        info = info.with_heading(lo, hi);
        if random.u8(..10) == 0 {
            info = info.with_heading(f32::NEG_INFINITY, f32::INFINITY);
        }
    }
    if declared & 2 != 0 {
        let [lo, hi] = range(random, 90.0);
        info = info.with_pitch(lo, hi);
    }
    // Level headings have measurements of their own.
    info.with_upright(0.0)
}

/// Returns a random range around 0. The sides are independent, biased towards small values, and sometimes 0.
fn range(random: &mut fastrand::Rng, most_deg: f32) -> [f32; 2] {
    #[expect(clippy::cast_possible_truncation, reason = "angles are in f32")]
    let most = most_deg * DEG as f32;
    let mut side = || if random.u8(..8) == 0 { 0.0 } else { most * random.f32() * random.f32().sqrt() };
    [-side(), side()]
}

/// Returns one of the 48 conventions, or, one time in four, a rotated frame.
fn axes(random: &mut fastrand::Rng) -> Axes {
    let mut order = [0, 1, 2];
    random.shuffle(&mut order);
    let mut axis = |k: usize| {
        let mut axis = [0.0; 3];
        axis[k] = if random.bool() { 1.0 } else { -1.0 };
        Vec3::from(axis)
    };
    let [up, forward, left] = order.map(&mut axis);
    let turn =
        if random.u8(..4) == 0 { Quat::from_axis_angle(direction(random), random.f32()) } else { Quat::IDENTITY };
    let [up, forward, left] = [up, forward, left].map(|v| (turn * v).to_array());
    Axes { up, forward, left }
}

/// Returns a pose with the joints a bone's length apart, most facing nearly the same way, some rotated by up to 3 rad.
fn pose(infos: &[JointInfo], random: &mut fastrand::Rng) -> Vec<Affine3A> {
    let mut frame = Affine3A::from_translation(direction(random) * random.f32());
    let mut pose: Vec<Affine3A> = infos
        .iter()
        .rev()
        .map(|info| {
            let most: f32 = if random.u8(..4) == 0 { 3.0 } else { 0.3 };
            let turn = Quat::from_axis_angle(direction(random), most * random.f32());
            let by = direction(random) * 0.3 * random.f32();
            frame *= Affine3A::from_rotation_translation(turn, by);
            let Axes { up, forward, left } = *info.axes();
            // Maps the bone's own axes to the character's: up +Y, forward +Z, left +X.
            let own = aim::glam::Mat3A::from_cols(left.into(), up.into(), forward.into());
            frame * Affine3A { matrix3: own.transpose(), translation: Vec3::ZERO.into() }
        })
        .collect();
    pose.reverse();
    pose
}
