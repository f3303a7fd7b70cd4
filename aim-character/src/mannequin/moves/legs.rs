//! Two-bone inverse kinematics of a leg: bends it so that its foot takes a given position.

use aim_runtime::glam::{DMat3, DQuat, DVec3};

use super::posture::Foot;
use crate::mannequin::joints::Joint;

/// Largest extension of a leg, as a share of its length: a straight knee has no direction of bending.
const STRETCH: f64 = 0.9995;
/// Pivot of a foot with raised toes, relative to the ankle: the heel, behind and below it.
const HEEL: DVec3 = DVec3::new(0.0, -0.085, -0.04);

/// Writes the rotations of a leg's joints. The rotation of the hips, `turns[0]`, must be set.
pub(super) fn bend(joints: &[Joint], turns: &mut [DQuat], hips_offset: DVec3, side: &str, foot: Foot) {
    let index = |name: &str| joints.iter().position(|joint| joint.name == format!("{side}_{name}")).unwrap_or(0);
    let [upper, lower, ankle, toes] = ["upper_leg", "lower_leg", "foot", "toes"].map(index);
    let at = |joint: usize| joints[joint].position;
    let hips = turns[0];
    let hip = at(0) + hips_offset + hips * (at(upper) - at(0));
    let goal = foot.ankle(at(ankle), at(toes));

    let [thigh, shank] = [at(lower) - at(upper), at(ankle) - at(lower)];
    let (a, b) = (thigh.length(), shank.length());
    let way = goal - hip;
    let reach = way.length().min(STRETCH * (a + b));
    let (down, ahead) = (way.normalize(), DQuat::from_rotation_y(foot.yaw) * DVec3::Z);
    let left = ahead.cross(down).normalize();
    // Law of cosines: cosine of the angle between the thigh and the line from hip to ankle. The knee points forward.
    let along = (a * a + reach * reach - b * b) / (2.0 * a * reach);
    let knee = down * along + down.cross(left) * (1.0 - along * along).max(0.0).sqrt();
    let upper_turn = turn([thigh, DVec3::X], [knee, left]);
    let lower_turn = turn([shank, DVec3::X], [down * reach - knee * a, left]);
    turns[upper] = hips.inverse() * upper_turn;
    turns[lower] = upper_turn.inverse() * lower_turn;
    turns[ankle] = lower_turn.inverse() * foot.turn();
    // The toes stay level while the heel is raised.
    turns[toes] = DQuat::from_rotation_x(-foot.roll.max(0.0));
}

impl Foot {
    fn turn(&self) -> DQuat {
        DQuat::from_rotation_y(self.yaw) * DQuat::from_rotation_x(self.roll)
    }

    /// Returns the position of the ankle. The foot rolls about its ball, or about its heel if the toes are raised.
    fn ankle(&self, ankle: DVec3, toes: DVec3) -> DVec3 {
        let pivot = if self.roll > 0.0 { toes - ankle } else { HEEL };
        let flat = self.at + DVec3::Y * (ankle.y + self.lift);
        flat + DQuat::from_rotation_y(self.yaw) * pivot - self.turn() * pivot
    }
}

/// Returns the rotation from one pair of vectors to another: the first is matched exactly, the second as closely as
/// that allows.
fn turn(from: [DVec3; 2], to: [DVec3; 2]) -> DQuat {
    let frame = |[first, second]: [DVec3; 2]| {
        let x = first.normalize();
        let z = x.cross(second).normalize();
        DMat3::from_cols(x, z.cross(x), z)
    };
    DQuat::from_mat3(&(frame(to) * frame(from).transpose())).normalize()
}
