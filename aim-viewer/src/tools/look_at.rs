//! A head on its neck.

use aim_character::Role;
use aim_runtime::Status;
use aim_runtime::glam::{Affine3A, Quat, Vec3};
use aim_runtime::ik::{LookAt, LookAtStatus};

use super::{Body, Tried, Try, axes, error_deg};
use crate::character::Character;

/// How far the head turns to either side, up and down, radians; and how fast, radians a second.
const HEADING: f32 = 1.2;
const PITCH: f32 = 0.8;
const SPEED: f32 = 4.0;

/// The head, or what is aimed first where there is none.
#[derive(Debug)]
pub(super) struct Head {
    bone: usize,
    /// What it sits on; roots sit on the model.
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

    /// From how the last frame left it; from the animation's at first.
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
