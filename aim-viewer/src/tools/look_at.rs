//! A head that turns relative to its neck.

use aim_character::Role;
use aim_runtime::Status;
use aim_runtime::glam::{Affine3A, Quat, Vec3};
use aim_runtime::ik::{LookAt, LookAtStatus};

use super::{Body, Tried, Try, axes, error_deg};
use crate::character::Character;

/// Largest heading to either side, radians.
const HEADING: f32 = 1.2;
/// Largest pitch up or down, radians.
const PITCH: f32 = 0.8;
/// Largest speed, radians per second.
const SPEED: f32 = 4.0;

/// The head, or the first joint of the chain if no head was found.
#[derive(Debug)]
pub(super) struct Head {
    bone: usize,
    /// Parent of the bone; `None` for a root.
    neck: Option<usize>,
    look: LookAt,
}

impl Head {
    pub(super) fn new(character: &Character) -> Self {
        let head = character.measurement.with_role(Role::Head).map(|bone| bone.node);
        let bone = head.unwrap_or(character.chain.joints[0]);
        let neck = character.skeleton().parents()[bone];
        let [up, forward, left] = character.directions().map(|direction| direction.to_array());
        let of_neck = neck.map_or(aim_runtime::Axes { up, forward, left }, |neck| axes(character, neck));
        let look = LookAt::new(of_neck, axes(character, bone))
            .with_heading(-HEADING, HEADING)
            .with_pitch(-PITCH, PITCH)
            .with_speed(SPEED);
        Self { bone, neck, look }
    }

    /// Turns the head from its rotation in the last frame, at first from the animated one.
    pub(super) fn look(&self, body: &mut Body<'_>, tried: Try, left: &mut Option<Quat>) -> Tried {
        if let Some(rotation) = *left {
            body.set(self.bone, rotation);
        }
        let neck = self.neck.map_or(Affine3A::IDENTITY, |neck| body.model[neck]);
        let outcome = self.look.solve(&neck, &body.model[self.bone], tried.target, tried.dt);
        body.turn(self.bone, outcome.turn);
        *left = Some(body.local[self.bone].rotation);
        let gaze = [body.origin(self.bone), body.direction(self.bone, Vec3::from(self.look.head.forward))];
        let status = match outcome.status {
            LookAtStatus::Reached => Status::Reached,
            LookAtStatus::Turning => Status::RateLimited,
            LookAtStatus::Degenerate => Status::Degenerate,
            _ => Status::AtLimit,
        };
        Tried { status, error_deg: error_deg(gaze, tried.target), gazes: vec![gaze] }
    }
}
