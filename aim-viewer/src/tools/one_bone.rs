//! Bones that point at the target independently of each other.

use aim_runtime::Status;
use aim_runtime::glam::{DVec3, Vec3};
use aim_runtime::ik::{OneBone, OneBoneStatus};

use super::{Body, Tried, axes, error_deg};
use crate::character::Character;

/// A bone and the axis that points at the target, in the bone's space.
#[derive(Debug)]
pub(super) struct Pointer {
    bone: usize,
    axis: Vec3,
}

impl Pointer {
    /// Returns the chain's first joint and, if the rig names one, the other eye.
    pub(super) fn each(character: &Character) -> Vec<Self> {
        let forward = DVec3::from_array(character.spec().effector.frame.forward).as_vec3();
        let first = Self { bone: character.chain.joints[0], axis: forward };
        let other = |bone| Self { bone, axis: Vec3::from(axes(character, bone).forward) };
        std::iter::once(first).chain(character.chain.other_eye.map(other)).collect()
    }

    pub(super) fn point(pointers: &[Self], body: &mut Body<'_>, target: Vec3) -> Tried {
        let mut tried = Tried { status: Status::Reached, error_deg: 0.0, gazes: Vec::new() };
        for &Self { bone, axis } in pointers {
            let outcome = OneBone::new(axis).solve(&body.model[bone], target - body.origin(bone));
            body.turn(bone, outcome.turn);
            if outcome.status == OneBoneStatus::Degenerate {
                tried.status = Status::Degenerate;
            }
            let gaze = [body.origin(bone), body.direction(bone, axis)];
            tried.error_deg = tried.error_deg.max(error_deg(gaze, target));
            tried.gazes.push(gaze);
        }
        tried
    }
}
