//! Both eyes in one call: joint 0, and the pose's pair.
//!
//! An eye midway between them leads: it is what the chain is solved for, within what both eyes' ranges leave once they
//! converge. Then each eye turns to the target from its own origin in closed form, within its own range and rate.
//!
//! The other eye's bone may have any axes: in the animation its gaze counts as parallel to joint 0's, and its angles
//! are about axes parallel to joint 0's. So what is copied are directions in the pose's space, never angles of bones.

use core::f32::consts::PI;

use glam::{Affine3A, Mat3A, Quat, Vec3A};

use crate::kinematics::chain::{Ray, inverse};
use crate::kinematics::chain::{Upright, can_lead, leading_eye, tilts};
use crate::kinematics::rotation::correction;
use crate::limits::RangeOfMotion;
use crate::limits::motion::mirrored;
use crate::limits::reach::Reach;
use crate::math::trig;
use crate::rig::{ChainRig, PerJoint, PoseSlices};
use crate::solve::call::Call;
use crate::solve::judge::{Verdict, limits_met};
use crate::solve::solved::{Moved, Solved};
use crate::target::goal::Course;
use crate::{Axes, Joint, JointSet, Outcome, Status, math};

/// Nearer than this part of the eyes' distance from each other nothing is looked at: 10 cm for eyes 6 cm apart.
const NEAREST: f32 = 10.0 / 6.0;
/// A target further out of an eye's range than this is looked at in parallel, as the leading eye has it: overhead and
/// behind the directions from the two eyes have nothing to do with each other.
const FAR_OUT_RAD: f32 = 30.0 * PI / 180.0;
/// How often a snap is repeated, so that the ranges that convergence leaves are those where the head comes to be.
const SNAP_ROUNDS: usize = 4;
/// Headings that part by less than this do so by rounding.
const PARALLEL_RAD: f32 = 1e-3;

/// The two angles that turn a joint's forward to a direction, as near as its reach lets it come.
///
/// `view` is the direction along forward, left and up before the added rotation, of any length. Heading first, then the
/// best pitch at the heading there is: of angles bounded one by one that is the best there is. Straight up or down has
/// heading 0; where nothing is to be seen both are 0.
pub(crate) fn look(view: [f32; 3], reach: &Reach) -> [f32; 2] {
    let [ahead, left, _] = view;
    look_along(view, trig::atan2(left, ahead), reach)
}

/// The same with a wish for the heading.
fn look_along([ahead, left, up]: [f32; 3], heading: f32, reach: &Reach) -> [f32; 2] {
    let heading = reach.heading.hold(heading);
    let (sin, cos) = trig::sin_cos(heading);
    [heading, reach.pitch_at(heading).hold(trig::atan2(up, ahead * cos + left * sin))]
}

/// A direction of a joint's space along its forward, left and up.
pub(crate) fn view(axes: &Axes, direction: Vec3A) -> [f32; 3] {
    [axes.forward, axes.left, axes.up].map(|axis| direction.dot(axis.into()))
}

/// Joint 0 and the other eye, in this order wherever there are two of something. Points are seen from `middle`.
pub(crate) struct Eyes<'a, const C: usize> {
    rig: &'a ChainRig<'a, C>,
    pose: &'a PoseSlices<'a>,
    /// The declared ranges of motion, then both eyes' own: the other's are joint 0's mirrored.
    declared: &'a [RangeOfMotion],
    motions: [RangeOfMotion; 2],
    leads: bool,
    middle: Vec3A,
    /// The eyes' animated transforms.
    eyes: [Affine3A; 2],
    /// From directions of the pose to those that the angles count in.
    to_angles: [Mat3A; 2],
    /// Joint 0's space in the other eye's bone: what is a turn of one is one of the other through this.
    relation: Mat3A,
    /// How each joint's upright frame stands in its bone.
    tilts: PerJoint<Quat, C>,
    /// How far the eyes are apart.
    apart: f32,
    /// 1 where joint 0 is the left eye, −1 where it is the right one.
    side: f32,
}

impl<'a, const C: usize> Eyes<'a, C> {
    /// `None` where an eye's transform is not finite or does not span space.
    pub(crate) fn new(
        rig: &'a ChainRig<'a, C>,
        pose: &'a PoseSlices<'a>,
        other_eye: &Affine3A,
        declared: &'a [RangeOfMotion],
        about: Upright,
    ) -> Option<Self> {
        let (joint, info) = (*pose.joints.first()?, rig.joints.first()?);
        if !(joint.is_finite() && other_eye.is_finite()) {
            return None;
        }
        math::orthonormal(joint.matrix3)?;
        math::orthonormal(other_eye.matrix3)?;
        let axes = &info.axes;
        let axes = Mat3A::from_cols(axes.forward.into(), axes.up.into(), axes.left.into());
        let (from_pose, from_pose_to_other) = (inverse(&joint).matrix3, inverse(other_eye).matrix3);
        // Forward first: it is the column that stays exactly what it is, also where the pose is stretched.
        let relation =
            math::orthonormal(from_pose_to_other * joint.matrix3 * axes)? * math::orthonormal(axes)?.transpose();

        let middle = 0.5 * joint.translation + 0.5 * other_eye.translation;
        let from_middle = |eye: &Affine3A| Affine3A { matrix3: eye.matrix3, translation: eye.translation - middle };
        let apart = joint.translation - other_eye.translation;
        let leftward = joint.matrix3 * Vec3A::from(info.axes.left);
        let side = if math::direction(apart).is_some_and(|apart| apart.dot(leftward) < 0.0) { -1.0 } else { 1.0 };
        let eyes = Self {
            rig,
            pose,
            declared,
            motions: [*declared.first()?, mirrored(rig, pose)?],
            leads: can_lead(rig.description),
            middle,
            eyes: [from_middle(&joint), from_middle(other_eye)],
            to_angles: [from_pose, relation.transpose() * from_pose_to_other],
            relation,
            tilts: tilts(rig, pose.joints, about),
            apart: math::length(apart),
            side,
        };
        (middle.is_finite() && eyes.apart.is_finite() && eyes.to_angles.iter().all(Mat3A::is_finite)).then_some(eyes)
    }

    /// One call for both eyes and the chain that `solve` moves: it is given the pose and the ranges of the leading eye,
    /// and joint 0 as that eye. `None` where there is nothing to aim.
    pub(crate) fn aim(
        &self,
        call: &Call<'_>,
        Moved { joints, memory, corrections }: Moved<'_, C>,
        solve: impl Fn(&PoseSlices<'_>, &[RangeOfMotion], Moved<'_, C>) -> Option<Solved>,
    ) -> Option<Solved> {
        let own = *joints.first()?;
        let [other, leading] = memory.eyes().unwrap_or([[0.0; 2], own.angles()]);
        let start = [own, with_angles(&own, other)];
        if self.leads {
            joints[0] = with_angles(&own, leading);
        }
        let mut transforms = self.rig.array(Affine3A::IDENTITY);
        transforms.iter_mut().zip(self.pose.joints).for_each(|(to, joint)| *to = *joint);
        transforms[0] = leading_eye(self.rig.description, self.pose)?;
        let pose = PoseSlices { joints: &transforms, ..*self.pose };
        let mut motions = self.rig.array(RangeOfMotion::REST);
        motions.copy_from_slice(self.declared);
        let (mut found, mut remembered) = (self.rig.array(Joint::REST), *memory);
        // How much room convergence takes depends on where the head comes to be. A frame takes that from the last one,
        // and a snap from itself.
        let rounds = if call.dt.is_some() { 1 } else { SNAP_ROUNDS };
        if call.dt.is_some() {
            found.copy_from_slice(joints);
        }
        let mut solved = None;
        for _ in 0..rounds {
            if self.leads {
                motions[0] = self.leading_motion(call, &found);
            }
            found.copy_from_slice(joints);
            remembered = *memory;
            let moved = Moved { joints: &mut found, memory: &mut remembered, corrections };
            solved = Some(solve(&pose, &motions, moved)?);
        }
        let solved = solved?;
        joints.copy_from_slice(&found);
        *memory = remembered;

        let lead = joints[0];
        let reaches = self.reaches(call, &start);
        let resting = solved.course == Course::Rest || self.is_supported(call);
        let angles = if !self.leads {
            [lead.angles(), reaches[1].angles_nearest(&lead)]
        } else if resting {
            // Where the leading eye does not just rest, it keeps the gaze on the animation while the head returns.
            [0, 1].map(|eye| reaches[eye].angles_nearest(&lead))
        } else if solved.course == Course::Stay {
            [0, 1].map(|eye| reaches[eye].angles_nearest(&start[eye]))
        } else {
            self.looks(self.seen(joints, solved.aimed_ps)?, &lead, &reaches, &start).0
        };
        let angles = if call.dt == Some(0.0) { start.map(|eye| eye.angles()) } else { angles };
        if !angles.as_flattened().iter().all(|angle| angle.is_finite()) {
            return None;
        }
        joints[0] = with_angles(&lead, angles[0]);
        memory.set_eyes(Some([angles[1], lead.angles()]));
        corrections[0] = correction(&self.rig.joints[0], &joints[0], self.tilts[0]);
        let outcome = self.outcome(call, joints, &with_angles(&lead, angles[1]), &lead, &solved, corrections[0])?;
        Some(Solved { outcome, ..solved })
    }

    /// Whether a joint further in is aimed, so that the eyes rest.
    fn is_supported(&self, call: &Call<'_>) -> bool {
        call.settings.effector.min(self.declared.len().saturating_sub(1)) > 0
    }

    /// What the leading eye may do so that either eye can look where it looks.
    fn leading_motion(&self, call: &Call<'_>, joints: &[Joint]) -> RangeOfMotion {
        let distance = self.seen(joints, call.target_ps.into()).map_or(f32::INFINITY, math::length);
        // NaN where there is no distance to speak of.
        let half = (0.5 * self.apart * call.settings.effective_weight() / distance).max(0.0).min(0.5);
        let inward = self.side * trig::atan2(half, math::sqrt(1.0 - half * half));
        let [own, other] = self.motions;
        let (own_heading, other_heading) = (own.heading.moved(inward), other.heading.moved(-inward));
        // The nearer eye sees the target further up or down than the leading one does; by how much more the further up it
        // is, and this is enough up to 37°.
        own.shrunk(own_heading.common(other_heading), 1.0 - 1.25 * half)
    }

    /// How far each eye gets in this call. Neither may turn outward further than the other inward: so they never part.
    fn reaches(&self, call: &Call<'_>, start: &[Joint; 2]) -> [Reach; 2] {
        let [own, other] = self.motions;
        let [left, right] = if self.side > 0.0 { [own, other] } else { [other, own] };
        let left_heading = left.heading.no_further_up_than(right.heading);
        let right_heading = right.heading.no_further_down_than(left.heading);
        let headings = if self.side > 0.0 { [left_heading, right_heading] } else { [right_heading, left_heading] };
        let rate = self.rig.joints.first().map_or(0.0, |info| info.rate);
        [0, 1].map(|eye| {
            let motion = RangeOfMotion { heading: headings[eye], ..self.motions[eye] };
            match call.dt {
                Some(dt) => Reach::frame(&motion, rate, &start[eye], dt),
                None => Reach::range(&motion),
            }
        })
    }

    /// The target as it stands to the animated eyes: what the supporting joints add is taken back. No nearer than the
    /// eyes look.
    fn seen(&self, joints: &[Joint], target_ps: Vec3A) -> Option<Vec3A> {
        let mut target = target_ps - self.middle;
        for index in (1..joints.len()).rev() {
            let (frame, turn) = self.support(joints, index)?;
            let local = inverse(&frame).transform_point3a(target);
            target = frame.transform_point3a(math::turned(turn.conjugate(), local));
        }
        let near = NEAREST * self.apart;
        let distance = math::length(target);
        if distance < near { Some(math::direction(target)? * near) } else { Some(target) }
    }

    /// A supporting joint's animated frame and what it adds.
    fn support(&self, joints: &[Joint], index: usize) -> Option<(Affine3A, Quat)> {
        let joint = self.pose.joints.get(index)?;
        let frame = Affine3A { matrix3: joint.matrix3, translation: joint.translation - self.middle };
        Some((frame, correction(self.rig.joints.get(index)?, joints.get(index)?, *self.tilts.get(index)?)))
    }

    /// Both eyes' headings and pitches towards a target, and whether their ranges alone let them look there: each from
    /// its own origin, or in parallel with `lead` where that makes no sense.
    fn looks(&self, target: Vec3A, lead: &Joint, reaches: &[Reach; 2], start: &[Joint; 2]) -> ([[f32; 2]; 2], bool) {
        let parallel = || ([0, 1].map(|eye| reaches[eye].angles_nearest(lead)), false);
        let mut views = [[0.0; 3]; 2];
        let mut headings = [0.0; 2];
        let mut within = true;
        for eye in [0, 1] {
            let Some(direction) = math::direction(self.to_angles[eye] * (target - self.eyes[eye].translation)) else {
                return parallel();
            };
            let [ahead, left, up] = view(&self.rig.joints[0].axes, direction);
            views[eye] = [ahead, left, up];
            headings[eye] = trig::atan2(left, ahead);
            let range = Reach::range(&self.motions[eye]);
            let [heading, pitch] = look(views[eye], &range);
            let (sin, cos) = trig::sin_cos(heading);
            let beside = (headings[eye] - heading).abs();
            let above = (trig::atan2(up, ahead * cos + left * sin) - pitch).abs();
            if !(beside.max(above) < FAR_OUT_RAD) {
                return parallel();
            }
            within &= beside.max(above) < 1e-5;
        }
        let parted = self.side * (headings[0] - headings[1]);
        if parted > PARALLEL_RAD {
            return parallel();
        }
        if parted > 0.0 {
            headings = [0.5 * (headings[0] + headings[1]); 2];
        }
        let angles = [0, 1].map(|eye| {
            let mut heading = headings[eye];
            if self.motions[eye].heading.is_free() {
                heading = start[eye].heading + math::wrap_pi(heading - start[eye].heading);
            }
            let [heading, pitch] = look_along(views[eye], heading, &reaches[eye]);
            [if self.motions[eye].heading.is_free() { math::wrap_pi(heading) } else { heading }, pitch]
        });
        (angles, within)
    }

    /// The other eye's correction in its own bone's space, at this heading and pitch. A mirror between the bones turns it
    /// round.
    pub(crate) fn correction(&self, angles: &[f32; 2]) -> Quat {
        let turn = correction(&self.rig.joints[0], &with_angles(&Joint::REST, *angles), self.tilts[0]);
        let Mat3A { x_axis, y_axis, z_axis } = self.relation;
        let sense = if math::cross(x_axis, y_axis).dot(z_axis) < 0.0 { -1.0 } else { 1.0 };
        let axis = self.relation * Vec3A::new(turn.x, turn.y, turn.z) * sense;
        Quat::from_xyzw(axis.x, axis.y, axis.z, turn.w)
    }

    /// The angle that is left between an eye that turns like this and a point, by the true forward kinematics.
    fn remaining(&self, joints: &[Joint], eye: usize, forward: Vec3A, turn: Quat, point_ps: Vec3A) -> Option<f32> {
        let frame = &self.eyes[eye];
        let mut ray =
            Ray { origin: frame.translation, direction: frame.transform_vector3a(math::turned(turn, forward)) };
        for index in 1..joints.len() {
            let (frame, turn) = self.support(joints, index)?;
            ray = ray.through(&inverse(&frame)).turned(turn).through(&frame);
        }
        let to_point = point_ps - self.middle - ray.origin;
        if !(math::length(to_point) > 1e-4 * self.apart) {
            return None;
        }
        let angle = math::angle_between(math::direction(ray.direction)?, math::direction(to_point)?);
        angle.is_finite().then_some(angle)
    }

    /// The outcome of both eyes: each judged from its own origin by forward kinematics.
    fn outcome(
        &self,
        call: &Call<'_>,
        joints: &[Joint],
        other: &Joint,
        lead: &Joint,
        solved: &Solved,
        own_turn: Quat,
    ) -> Option<Outcome> {
        let infos = self.rig.joints;
        let forward = Vec3A::from(infos[0].axes.forward);
        let (mut at_limit, mut recovering) = limits_met(infos, self.declared, joints);
        // Joint 0 stands for both eyes.
        let (other_at_limit, other_recovering) =
            limits_met(&infos[..1], &self.motions[1..], core::slice::from_ref(other));
        for (set, other) in [(&mut at_limit, other_at_limit), (&mut recovering, other_recovering)] {
            if other != JointSet::EMPTY {
                set.insert(0);
            }
        }
        let turn = self.correction(&other.angles());
        let other_eye_remaining = self.remaining(joints, 1, self.relation * forward, turn, solved.wanted_ps);
        let outcome =
            Outcome { at_limit, recovering, other_eye_remaining, other_eye_correction: Some(turn), ..solved.outcome };
        if !self.leads || self.is_supported(call) {
            return Some(outcome);
        }
        let remaining = self.remaining(joints, 0, forward, own_turn, solved.wanted_ps)?;
        let other_eye_remaining = other_eye_remaining?;
        let within_reach = || match solved.outcome.status {
            Status::RateLimited => true,
            // The leading eye has arrived: what keeps the others?
            Status::Reached => self.seen(joints, solved.wanted_ps).is_some_and(|seen| {
                let near = NEAREST * self.apart * 1.000_01;
                let start = [joints[0], *other];
                self.looks(seen, lead, &self.reaches(call, &start), &start).1 && math::length(seen) > near
            }),
            _ => false,
        };
        let verdict = Verdict {
            remaining: remaining.max(other_eye_remaining),
            tolerance: call.settings.effective_tolerance(),
            behind: solved.behind,
            within_reach: call.dt.is_some() && within_reach(),
        };
        let status = verdict.status();
        let own = Verdict { remaining, ..verdict }.outcome_at(at_limit, recovering);
        Some(Outcome { aim: own.aim, remaining, status, ..outcome })
    }
}

/// The joint at other angles.
fn with_angles(joint: &Joint, [heading, pitch]: [f32; 2]) -> Joint {
    Joint { heading, pitch, ..*joint }
}

impl Reach {
    /// The angles within reach that are nearest to the joint's, heading first.
    fn angles_nearest(&self, joint: &Joint) -> [f32; 2] {
        let held = self.hold(joint);
        [held.heading, held.pitch]
    }
}
