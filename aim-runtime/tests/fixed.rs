//! A rig of fixed size, as the derive makes them: the contract's three lines, with arrays and nothing on the heap.

mod common;

use aim_runtime::glam::{Affine3A, Quat, Vec3};
use aim_runtime::{AimRig, Effector, Joint, JointInfo, Pose, Scalar, Settings, Status};
use common::*;

struct Thug {
    left_eye: Joint,
    neck: Joint,
    spine3: Joint,
    kernels: NumericRig,
}

impl AimRig for Thug {
    type Array<T: Copy> = [T; 3];
    fn array<T: Copy>(&self, value: T) -> [T; 3] {
        [value; 3]
    }
    fn joint_infos(&self) -> &[JointInfo] {
        &self.kernels.infos
    }
    fn effector(&self) -> Effector {
        self.kernels.effector
    }
    fn joints(&self) -> [Joint; 3] {
        [self.left_eye, self.neck, self.spine3]
    }
    fn set_joints(&mut self, joints: [Joint; 3]) {
        [self.left_eye, self.neck, self.spine3] = joints;
    }
    fn aim_gradient<S: Scalar>(&self, joint: usize, to_joint: &[S; 12], target: &[S; 3], sin_cos: &[S; 4]) -> [S; 3] {
        self.kernels.aim_gradient(joint, to_joint, target, sin_cos)
    }
    fn chain_value_gradient<S: Scalar>(&self, links: &[[S; 12]], target: &[S; 3], sin_cos: &[[S; 4]], out: &mut [S]) {
        self.kernels.chain_value_gradient(links, target, sin_cos, out);
    }
    fn chain_residual_jacobian<S: Scalar>(
        &self,
        links: &[[S; 12]],
        target: &[S; 3],
        sin_cos: &[[S; 4]],
        out: &mut [S],
    ) {
        self.kernels.chain_residual_jacobian(links, target, sin_cos, out);
    }
}

#[test]
fn the_contract() {
    let kernels = NumericRig::thug();
    let [eye, neck, spine]: [Affine3A; 3] = upright(&kernels).try_into().unwrap();
    let [left_eye, neck_joint, spine3] = [Joint::default(); 3];
    let mut thug = Thug { left_eye, neck: neck_joint, spine3, kernels };
    let target = Vec3::new(-1.0, 1.8, -2.0);

    let mut outcome = thug.aim(&Pose { joints: [eye, neck, spine] }, target, 1.0 / 60.0);
    for _ in 0..120 {
        outcome = thug.aim(&Pose { joints: [eye, neck, spine] }, target, 1.0 / 60.0);
    }
    assert_eq!(outcome.status, Status::Reached);
    assert_eq!(outcome.at_limit.iter().collect::<Vec<_>>(), []);

    // local' = local · correction, innermost first, puts the eye on the target.
    let mut locals = [neck.inverse() * eye, spine.inverse() * neck, spine];
    assert_eq!(thug.corrections().len(), 3);
    for (joint, q) in thug.corrections() {
        locals[joint] *= Affine3A::from_quat(q);
    }
    let eye_ws = locals[2] * locals[1] * locals[0];
    let gaze = eye_ws.transform_vector3(Vec3::from(THUG.forward));
    let wanted = target - Vec3::from(eye_ws.translation);
    assert!(gaze.angle_between(wanted) < 0.11 * DEG);

    thug.reset();
    assert!(thug.corrections().all(|(_, q)| q == Quat::IDENTITY));
    let outcome = thug.snap_with(&Pose { joints: [eye, neck, spine] }, target, &Settings::default());
    assert_eq!(outcome.status, Status::Reached);
    assert_eq!(thug.left_eye, thug.joints()[0]);
}
