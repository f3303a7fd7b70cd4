//! Functions of users, differentiated beside themselves: against central differences, and at what cost.

use aim::glam::{DAffine3, DMat3, DQuat, DVec2, DVec3, Quat, Vec3};
use aim::{DRigid, Rigid, differentiate};
use aim_tests::random::Random;

/// The paper's aim in six statements. What is found must not depend on how it was written down.
mod paper {
    use super::*;

    /// As the paper has it: the effector is pushed forward.
    #[differentiate(wrt(p, h), budget = 46)]
    pub(super) fn pushed(p: f64, h: f64, m: DRigid, target: DVec3) -> f64 {
        let turned = DAffine3::from_rotation_x(h) * DAffine3::from_rotation_z(p) * m;
        let origin = turned.transform_point3(DVec3::ZERO);
        let tip = turned.transform_point3(DVec3::Y);
        (target - origin).normalize().dot(tip - origin)
    }

    /// The target is pulled back into the effector's frame.
    #[differentiate(wrt(p, h), budget = 46)]
    pub(super) fn pulled(p: f64, h: f64, m: DRigid, target: DVec3) -> f64 {
        let back = DQuat::from_rotation_z(-p) * DQuat::from_rotation_x(-h);
        let d = back * target - m.translation;
        m.transform_vector3(DVec3::Y).dot(d) / d.length()
    }

    /// By quaternions about named axes.
    #[differentiate(wrt(p, h), budget = 46)]
    pub(super) fn quaternions(p: f64, h: f64, m: DRigid, target: DVec3) -> f64 {
        let added = DQuat::from_axis_angle(DVec3::X, h) * DQuat::from_axis_angle(DVec3::Z, p);
        let forward = added * m.matrix3.y_axis;
        let to_target = target - added * m.translation;
        forward.dot(to_target / to_target.length())
    }

    /// By matrices, and a link whose matrix need not be a rotation.
    #[differentiate(wrt(p, h), budget = 46)]
    pub(super) fn matrices(p: f64, h: f64, m: DMat3, t: DVec3, target: DVec3) -> f64 {
        let added = DMat3::from_rotation_x(h) * DMat3::from_rotation_z(p);
        let effector = added * m;
        let to_target = target - added * t;
        let forward = effector * DVec3::Y;
        forward.dot(to_target.normalize())
    }

    /// Heading first: the angles by other names, in the other order.
    #[differentiate(wrt(heading, pitch), budget = 46)]
    pub(super) fn heading_first(heading: f64, pitch: f64, m: DRigid, target: DVec3) -> f64 {
        let by_pitch = DQuat::from_rotation_z(pitch);
        let by_heading = DQuat::from_rotation_x(heading);
        let origin = by_heading * (by_pitch * m.translation);
        let forward = by_heading * (by_pitch * (m.matrix3 * DVec3::Y));
        forward.dot((target - origin).normalize())
    }

    /// Other names, other order of terms, lengths written out.
    #[differentiate(wrt(a, b), budget = 46)]
    pub(super) fn renamed(at: &DVec3, link: &DRigid, b: f64, a: f64) -> f64 {
        let q = DQuat::from_rotation_x(b).mul_quat(DQuat::from_rotation_z(a));
        let w = -(q * link.translation) + *at;
        let u = q.mul_vec3(link.matrix3.y_axis);
        w.dot(u) * w.dot(w).sqrt().recip()
    }
}

#[test]
fn scratch() {
    let _ = (Quat::IDENTITY, Vec3::X, DVec2::X, Rigid::IDENTITY, Random::new(1));
}
