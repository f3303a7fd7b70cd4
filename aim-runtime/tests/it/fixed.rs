//! Rigs of fixed size, as the derive macro makes them: three lines of user code, with arrays and without heap
//! allocation.

use crate::common::*;
use aim_runtime::glam::{Affine3A, Quat, Vec3};
use aim_runtime::{Aim, AimRig, Description, Joint, JointInfo, Pose, Rig, Settings, Status};

struct Thug {
    left_eye: Joint,
    #[expect(dead_code, reason = "read by name in real rigs")]
    neck: Joint,
    #[expect(dead_code, reason = "read by name in real rigs")]
    spine3: Joint,
}

const JOINTS: [JointInfo; 3] = [
    JointInfo::new(THUG, 450.0 * DEG).with_heading(-35.0 * DEG, 35.0 * DEG).with_pitch(-25.0 * DEG, 20.0 * DEG),
    JointInfo::new(THUG, 170.0 * DEG).with_heading(-60.0 * DEG, 60.0 * DEG).with_pitch(-40.0 * DEG, 35.0 * DEG),
    JointInfo::new(THUG, 70.0 * DEG).with_heading(-20.0 * DEG, 20.0 * DEG).with_pitch(-10.0 * DEG, 10.0 * DEG),
];

impl Rig for Thug {
    fn description(&self) -> Description<'_> {
        *Self::DESCRIPTION
    }
    fn joint_name(&self, joint: usize) -> Option<&str> {
        ["left_eye", "neck", "spine3"].get(joint).copied()
    }
    fn bone_name(&self, joint: usize, _: usize) -> Option<&str> {
        self.joint_name(joint)
    }
    fn residual_jacobian(&self, links: &[[f32; 12]], target: &[f32; 3], sin_cos: &[[f32; 4]], out: &mut [f32]) {
        NumericRig::thug().residual_jacobian(links, target, sin_cos, out);
    }
    fn aim_gradient(&self, joint: usize, to_joint: &[f32; 12], target: &[f32; 3], sin_cos: &[f32; 4]) -> [f32; 3] {
        NumericRig::thug().aim_gradient(joint, to_joint, target, sin_cos)
    }
}

impl AimRig for Thug {
    type Array<T: Copy> = [T; 3];
    const RIG: &'static Self = &Self { left_eye: Joint::REST, neck: Joint::REST, spine3: Joint::REST };
    const DESCRIPTION: &'static Description<'static> = &Description::new(&JOINTS);
    fn array<T: Copy>(value: T) -> [T; 3] {
        [value; 3]
    }
    fn from_joints([left_eye, neck, spine3]: [Joint; 3]) -> Self {
        Self { left_eye, neck, spine3 }
    }
}

#[test]
fn a_compiled_rig_aims_with_fixed_arrays() {
    let [eye, neck, spine]: [Affine3A; 3] = upright(&NumericRig::thug()).try_into().unwrap();
    let (mut thug, settings) = (Aim::<Thug>::new(), Settings::default());
    let target = Vec3::new(-1.0, 1.8, -2.0);

    let pose = Pose::new([eye, neck, spine]);
    let mut aimed = thug.aim(&pose, target, 1.0 / 60.0, &settings);
    for _ in 0..120 {
        aimed = thug.aim(&pose, target, 1.0 / 60.0, &settings);
    }
    let outcome = aimed.outcome;
    assert_eq!(outcome.status, Status::Reached);
    assert_eq!(outcome.at_limit.iter().collect::<Vec<_>>(), []);

    // local' = local · correction, innermost first, puts the eye on the target.
    let mut locals = [neck.inverse() * eye, spine.inverse() * neck, spine];
    for (local, q) in locals.iter_mut().zip(aimed.corrections) {
        *local *= Affine3A::from_quat(q);
    }
    let eye_ws = locals[2] * locals[1] * locals[0];
    let gaze = eye_ws.transform_vector3(Vec3::from(THUG.forward));
    let wanted = target - Vec3::from(eye_ws.translation);
    assert!(gaze.angle_between(wanted) < 0.11 * DEG);

    thug.reset();
    let held = thug.aim(&pose, target, 0.0, &settings);
    assert!(held.corrections.iter().all(|q| *q == Quat::IDENTITY));
    let outcome = thug.snap(&pose, target, &settings).outcome;
    assert_eq!(outcome.status, Status::Reached);
    assert_eq!(thug.joints().left_eye, thug.state.joints[0]);
    assert_eq!(size_of_val(&thug), 64 + 24 * 3);
}
