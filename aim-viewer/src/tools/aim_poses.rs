//! Poses that aim, and what lies between them.

use aim_animation::Transform;
use aim_character::{InterpretedRig, Live, Moment};
use aim_runtime::glam::{Affine3A, DVec3, Mat3A, Quat, Vec3};
use aim_runtime::ik::{AimPose, AimPoses, AimPosesStatus, grid};
use aim_runtime::{DynAim, Settings, Solver, Status};

use super::{Body, Tried, error_deg};
use crate::character::Character;

/// Directions that the rig is asked for, radians to the left and up: a grid, row by row.
const HEADINGS: [f32; 5] = [1.1, 0.55, 0.0, -0.55, -1.1];
const PITCHES: [f32; 3] = [0.45, 0.0, -0.45];
/// How far away, metres of a 1.7 m character.
const FAR: f32 = 50.0;

/// Poses of the chain's bones over the rest pose, made by the rig itself.
#[derive(Debug)]
pub(super) struct PoseSet {
    /// The chain's joints and the other eye.
    bones: Vec<usize>,
    /// What the chain stands on; directions are in its space.
    base: Option<usize>,
    innermost: usize,
    effector: [Vec3; 2],
    poses: Vec<(Vec3, Vec<Quat>)>,
    triangles: Vec<[usize; 3]>,
}

impl PoseSet {
    pub(super) fn new(character: &Character, rig: &InterpretedRig, live: &Live) -> Self {
        let chain = &character.chain;
        let innermost = chain.joints[chain.joints.len() - 1];
        let effector = &character.spec().effector;
        let mut set = Self {
            bones: chain.joints.iter().copied().chain(chain.other_eye).collect(),
            base: character.skeleton().parents()[innermost],
            innermost,
            effector: [effector.origin, effector.frame.forward].map(|at| DVec3::from_array(at).as_vec3()),
            poses: Vec::new(),
            triangles: Vec::new(),
        };
        for pitch in PITCHES {
            for heading in HEADINGS {
                let mut pose = character.skeleton().rest().to_vec();
                aim(character, (rig, live), [heading, pitch], &mut pose);
                let body = Body::new(character, &mut pose);
                let direction = set.gaze_in_base(&body.model);
                set.poses.push((direction, set.bones.iter().map(|&bone| body.local[bone].rotation).collect()));
            }
        }
        let mut triangles = [[0; 3]; 2 * (HEADINGS.len() - 1) * (PITCHES.len() - 1)];
        set.triangles = grid(HEADINGS.len(), PITCHES.len(), &mut triangles).unwrap_or_default().to_vec();
        set
    }

    /// Blends the poses so that the effector points at the target.
    pub(super) fn aim(&self, body: &mut Body<'_>, target: Vec3) -> Tried {
        let poses: Vec<AimPose<'_>> =
            self.poses.iter().map(|(direction, rotations)| AimPose { direction: *direction, rotations }).collect();
        let set = AimPoses::new(&poses, &self.triangles);
        let mut rotations = vec![Quat::IDENTITY; self.bones.len()];
        let mut status = Status::Degenerate;
        // Turning moves the eyes: again from where they are then.
        for _ in 0..3 {
            let [from, _] = self.gaze(&body.model);
            let wanted = self.to_base(&body.model, target - from);
            let outcome = set.solve(wanted, &mut rotations, |rotations| {
                self.put(body, rotations);
                self.gaze_in_base(&body.model)
            });
            status = match outcome.status {
                AimPosesStatus::Reached => Status::Reached,
                AimPosesStatus::Degenerate => {
                    return Tried { status: Status::Degenerate, error_deg: 90.0, gazes: Vec::new() };
                }
                _ => Status::AtLimit,
            };
            self.put(body, &rotations);
        }
        let gaze = self.gaze(&body.model);
        Tried { status, error_deg: error_deg(gaze, target), gazes: vec![gaze] }
    }

    fn put(&self, body: &mut Body<'_>, rotations: &[Quat]) {
        for (&bone, rotation) in self.bones.iter().zip(rotations) {
            body.local[bone].rotation = *rotation;
        }
        body.carry(self.innermost);
    }

    fn gaze(&self, model: &[Affine3A]) -> [Vec3; 2] {
        let bone = &model[self.bones[0]];
        let [origin, forward] = self.effector;
        [bone.transform_point3(origin), bone.transform_vector3(forward).normalize_or_zero()]
    }

    fn gaze_in_base(&self, model: &[Affine3A]) -> Vec3 {
        self.to_base(model, self.gaze(model)[1])
    }

    fn to_base(&self, model: &[Affine3A], direction: Vec3) -> Vec3 {
        let base = self.base.map_or(Mat3A::IDENTITY, |base| model[base].matrix3);
        base.inverse().mul_vec3(direction).normalize_or_zero()
    }
}

/// Aims the rig along a heading and a pitch.
fn aim(
    character: &Character,
    (rig, live): (&InterpretedRig, &Live),
    [heading, pitch]: [f32; 2],
    pose: &mut [Transform],
) {
    let [up, forward, left] = character.directions();
    let ((sh, ch), (sp, cp)) = (heading.sin_cos(), pitch.sin_cos());
    let direction = forward * (ch * cp) + left * (sh * cp) + up * sp;
    let target = character.effector() + direction * (FAR * character.metre());
    let world = character.skeleton().world_f64(pose);
    let joints = live.animated(pose, &world);
    let mut aimed = DynAim::new(rig.clone());
    let outcome = aimed.snap(&joints.pose(), target, &Settings::default().with_solver(Solver::Exact));
    let moment = Moment { t: 0.0, target: target.as_dvec3(), world: &world, joints: &joints, outcome, effector: 0 };
    let _ = live.aimed(&aimed, character.skeleton(), pose, &moment);
}
