//! The exact solver: of all angles within reach that put the gaze on the target, those of least stiffness-weighted
//! displacement, over the whole chain at once.
//!
//! Each round evaluates the derived residual and Jacobian at the present angles, solves the linear model to its optimum
//! within the reach ([`dual`]), and measures the result by forward kinematics. The remaining error is corrected with
//! the same Jacobian (a simplified Newton step, called *refinement* here), which costs a fraction of a new one.

pub(crate) mod advance;
pub(crate) mod dual;
pub(crate) mod following;
mod gap;
pub(crate) mod settle;
pub(crate) mod single;
mod strain;

use core::f32::consts::PI;

use glam::Vec3A;

use self::dual::{Angle, NO_ANGLE, Solution};
use crate::kinematics::chain::{Chain, Ray, TOO_NEAR, rigid_effector};
use crate::kinematics::rotation::joint_turn;
use crate::kinematics::view::{Stretch, View};
use crate::limits::reach::Reach;
use crate::math::trig;
use crate::rig::{ChainRig, Memory, PerJoint};
use crate::target::goal::Goal;
use crate::{Joint, math};

/// Angle to the target below which no further correction is made, radians (6e-4°).
const FINE_RAD: f32 = 1e-5;
/// Angle to the target below which a new Jacobian is not worth its cost, radians (6e-3°).
pub(crate) const ENOUGH_RAD: f32 = 1e-4;
/// Largest number of corrections with the same Jacobian.
const REFINEMENTS: usize = 3;
/// Largest number of corrections with the same Jacobian for a pose that is not rigid. There the Jacobian is updated
/// after each step.
const NON_RIGID_REFINEMENTS: usize = 8;
/// Largest number of Jacobians in a frame.
const ROUNDS: usize = 4;
/// Angle from exactly behind, radians, below which the residual is unreliable.
const OPPOSITE_RAD: f32 = 0.03;
/// Part of the way to the optimum that joints move in a frame along directions that leave the gaze on the target.
const USUAL_PART: f32 = 0.5;
/// Joints stay where they are if every angle would change by less than this, radians.
pub(crate) const STILL_RAD: f32 = 1e-6;

/// The chain, its target, and the linear model of the gaze.
pub(crate) struct Solver<'a, const C: usize> {
    rig: &'a ChainRig<'a, C>,
    chain: &'a Chain<C>,
    goal: &'a Goal,
    /// The target in the innermost joint's upright space; used if the pose is rigid.
    target: Vec3A,
    links: PerJoint<[f32; 12], C>,
    /// The linear model: pitch and heading of each joint.
    model: PerJoint<[Angle; 2], C>,
    /// Derivative of each joint's pitch limit by its heading, for a pitch at a limit that depends on the heading; else
    /// 0.
    pitch_limit_slopes: PerJoint<f32, C>,
    /// Zero points and weights of the angles' displacements.
    displacement_costs: PerJoint<[DisplacementCost; 2], C>,
    /// Largest displacement cost for a radian of gap.
    gap_price: f32,
    /// The number of declared angles.
    declared: usize,
    /// Axes in effector space along which the residual is measured: forward, left, up.
    axes: [Vec3A; 3],
    /// The angles under trial.
    trial: PerJoint<Joint, C>,
    /// `true` if a gap remained and another round would hardly have reduced it.
    stalled: bool,
}

impl<'a, const C: usize> Solver<'a, C> {
    /// Creates a solver for a goal, with every joint's displacement measured from the animation.
    #[inline]
    pub(crate) fn new(rig: &'a ChainRig<'a, C>, chain: &'a Chain<C>, goal: &'a Goal) -> Self {
        let infos = rig.joints;
        let mut links = rig.array(IDENTITY_LINK);
        let mut least_ease = 1.0_f32;
        let mut displacement_costs = rig.array([DisplacementCost { rest: 0.0, ease: 1.0 }; 2]);
        for (index, info) in infos.iter().enumerate().skip(chain.first) {
            links[index] = chain.links[index].to_cols_array();
            // A NaN quotient gives the smallest ease.
            let ease = (rig.least_stiffness / info.stiffness).max(1e-6).min(1.0);
            least_ease = least_ease.min(ease);
            displacement_costs[index] = [DisplacementCost { rest: 0.0, ease }; 2];
        }
        Self {
            rig,
            chain,
            goal,
            target: chain.base.matrix3.transpose() * goal.aim_point,
            links,
            model: rig.array([NO_ANGLE; 2]),
            pitch_limit_slopes: rig.array(0.0),
            displacement_costs,
            gap_price: dual::gap_price(least_ease),
            declared: rig.angles,
            axes: rig.effector.axes(&infos[0].axes),
            trial: rig.array(Joint::REST),
            stalled: false,
        }
    }

    /// Sets the pitch and heading from which one joint's displacement is measured.
    pub(crate) fn prefer(&mut self, joint: usize, angles: [f32; 2]) {
        for (cost, rest) in self.displacement_costs[joint].iter_mut().zip(angles) {
            cost.rest = rest;
        }
    }

    /// Moves `joints` to the optimum within `reaches`, with the work limited to one frame's. Returns the remaining
    /// angle; if a gap remains, the one that joints would leave that are not slowed down. `None` if the aim is
    /// undefined.
    #[inline]
    pub(crate) fn advance(
        &mut self,
        joints: &mut [Joint],
        reaches: &[Reach],
        dt: f32,
        memory: &mut Memory,
    ) -> Option<f32> {
        self.hold(joints, reaches);
        if memory.strain > 0.0 {
            self.recover(memory, dt);
        }
        for _ in 0..ROUNDS {
            let offset = self.linearise(joints, reaches)?;
            self.shift_rest_angles(joints, USUAL_PART);
            let solution =
                dual::solve(&self.model, self.right_hand_side(joints, offset), memory.lambda, self.gap_price);
            let view = if solution.closed { self.try_closed(joints, reaches, &solution) } else { None };
            let Some(mut view) = view else {
                return self.advance_with_a_gap(joints, reaches, dt, memory);
            };
            memory.lambda = solution.lambda;
            self.refine(joints, offset, reaches, &mut memory.lambda, &mut view);
            if solution.strained {
                memory.strain = 1.0;
            }
            let is_slow =
                memory.strain > 0.0 && self.limit_strained_step(joints, offset, reaches, dt, memory, &mut view)?;
            self.accept(joints);
            if is_slow || view.is_within(ENOUGH_RAD) {
                return Some(view.angle());
            }
        }
        Some(self.view(joints)?.angle())
    }

    /// Returns `true` if [`advance`](Self::advance) came as near to the goal as its reaches allow.
    pub(crate) fn is_stalled(&self) -> bool {
        self.stalled
    }

    /// Shifts the zero point of each displacement to `part` of the way from the present angle to its rest angle. Where
    /// the target leaves the joints free, they then move this part of the way to the optimum in a frame. The whole way
    /// would be too far where the gaze is strongly curved, which the linear model ignores: joints would oscillate about
    /// the optimum.
    #[inline]
    fn shift_rest_angles(&mut self, joints: &[Joint], part: f32) {
        for (angles, joint) in self.model.iter_mut().zip(joints) {
            for (angle, now) in angles.iter_mut().zip([joint.pitch, joint.heading]) {
                angle.rest = now + part * (angle.rest - now);
                angle.ease *= part;
            }
        }
    }

    /// Puts a solution's angles under trial and returns the view from them.
    #[inline]
    fn try_closed(&mut self, joints: &[Joint], reaches: &[Reach], solution: &Solution) -> Option<View> {
        self.try_dual(joints, reaches, solution);
        self.view(&self.trial)
    }

    /// Returns the largest change of an angle from `joints` to the trial.
    fn step(&self, joints: &[Joint]) -> f32 {
        let pairs = self.trial.iter().zip(joints);
        pairs.fold(0.0, |step, (a, b)| step.max((a.pitch - b.pitch).abs()).max((a.heading - b.heading).abs()))
    }

    #[inline]
    fn hold(&self, joints: &mut [Joint], reaches: &[Reach]) {
        for index in self.chain.first..self.chain.count {
            joints[index] = reaches[index].hold(&joints[index]);
        }
    }

    /// Copies the trial to `joints`, unless its largest change is below [`STILL_RAD`].
    #[inline]
    fn accept(&self, joints: &mut [Joint]) {
        if self.step(joints) >= STILL_RAD {
            joints.copy_from_slice(&self.trial);
        }
    }

    /// Corrects the trial, which was computed from `joints` and their `offset`, with the same Jacobian until it is
    /// within [`FINE_RAD`].
    #[inline]
    fn refine(
        &mut self,
        joints: &[Joint],
        offset: [f32; 2],
        reaches: &[Reach],
        lambda: &mut [f32; 2],
        view: &mut View,
    ) {
        if !view.is_within(FINE_RAD) {
            self.refine_steps(joints, offset, reaches, lambda, view);
        }
    }

    #[inline(never)]
    fn refine_steps(
        &mut self,
        joints: &[Joint],
        offset: [f32; 2],
        reaches: &[Reach],
        lambda: &mut [f32; 2],
        view: &mut View,
    ) {
        let mut before = self.rig.array(Joint::REST);
        before.copy_from_slice(joints);
        let mut offset = offset;
        let refinements = if self.chain.is_rigid() { REFINEMENTS } else { NON_RIGID_REFINEMENTS };
        for _ in 0..refinements {
            if view.is_within(FINE_RAD) {
                return;
            }
            if !self.chain.is_rigid() {
                self.update_jacobian(&before, offset, view.offset());
            }
            before.copy_from_slice(&self.trial);
            offset = view.offset();
            let solution = dual::solve(&self.model, self.right_hand_side(&before, offset), *lambda, self.gap_price);
            self.try_dual(&before, reaches, &solution);
            match self.view(&self.trial) {
                Some(better) if solution.closed && better.angle() < view.angle() => {
                    *view = better;
                    *lambda = solution.lambda;
                }
                _ => {
                    self.trial.copy_from_slice(&before);
                    return;
                }
            }
        }
    }

    /// Updates the Jacobian by Broyden's method: the smallest change that reproduces the observed change of offset
    /// between `joints` and the trial. Under shear and non-uniform scale the kernels' Jacobian is not that of the pose.
    fn update_jacobian(&mut self, joints: &[Joint], before: [f32; 2], after: [f32; 2]) {
        let trial = &self.trial;
        let mut missed = [after[0] - before[0], after[1] - before[1]];
        let mut square = 0.0;
        let changes = |joint: usize| {
            let heading = trial[joint].heading - joints[joint].heading;
            [trial[joint].pitch - joints[joint].pitch - self.pitch_limit_slopes[joint] * heading, heading]
        };
        for (index, angles) in self.model.iter().enumerate() {
            for (angle, change) in angles.iter().zip(changes(index)) {
                missed = [missed[0] - angle.column[0] * change, missed[1] - angle.column[1] * change];
                square += change * change;
            }
        }
        if !(square > STILL_RAD * STILL_RAD) {
            return;
        }
        for (index, angles) in self.model.iter_mut().enumerate() {
            for (angle, change) in angles.iter_mut().zip(changes(index)) {
                let part = change / square;
                angle.column = [angle.column[0] + missed[0] * part, angle.column[1] + missed[1] * part];
            }
        }
    }

    /// Puts the model's angles in a solution under trial, within reach.
    #[inline]
    fn try_dual(&mut self, joints: &[Joint], reaches: &[Reach], solution: &Solution) {
        let (trial, model, pitch_limit_slopes) = (&mut self.trial, &self.model, &self.pitch_limit_slopes);
        for index in 0..joints.len() {
            let joint = joints[index];
            trial[index] = if index < self.chain.first {
                joint
            } else {
                let [pitch, heading] = &model[index];
                let (pitch, heading) = (solution.of(pitch), solution.of(heading));
                let pitch = pitch + pitch_limit_slopes[index] * (heading - joint.heading);
                reaches[index].hold(&Joint { pitch, heading, ..joint })
            };
        }
    }

    /// Puts `part` of the way from `joints` to `goal` under trial, within reach.
    fn try_part(&mut self, joints: &[Joint], goal: &[Joint], reaches: &[Reach], part: f32) {
        let trial = &mut self.trial;
        trial.copy_from_slice(goal);
        if part < 1.0 {
            for index in self.chain.first..self.chain.count {
                let (from, to) = (joints[index], goal[index]);
                trial[index] = reaches[index].hold(&Joint {
                    pitch: from.pitch + part * (to.pitch - from.pitch),
                    heading: from.heading + part * (to.heading - from.heading),
                    ..from
                });
            }
        }
    }

    /// Returns the right-hand side `J θ − offset` of the linear model at `joints`.
    #[inline]
    fn right_hand_side(&self, joints: &[Joint], offset: [f32; 2]) -> [f32; 2] {
        let mut wanted = [-offset[0], -offset[1]];
        for (angles, joint) in self.model.iter().zip(joints) {
            for (angle, now) in angles.iter().zip([joint.pitch, joint.heading]) {
                wanted = [wanted[0] + angle.column[0] * now, wanted[1] + angle.column[1] * now];
            }
        }
        wanted
    }

    /// Evaluates the linear model at `joints`. Returns the target's offset there: its angle, left and up.
    #[inline]
    fn linearise(&mut self, joints: &[Joint], reaches: &[Reach]) -> Option<[f32; 2]> {
        let mut sin_cos = self.rig.array([0.0, 1.0, 0.0, 1.0]);
        for (sin_cos, joint) in sin_cos.iter_mut().zip(joints).skip(self.chain.first) {
            *sin_cos = trig::doubled(trig::halves(joint.pitch, joint.heading)).to_array();
        }
        let mut out = self.rig.array([0.0; 6]);
        let out = &mut out.as_flattened_mut()[..2 + 2 * self.declared];
        let target = self.target_in_links(joints)?;
        let mut kernel = |target: Vec3A| {
            self.rig.kernels.residual_jacobian(&self.links, &target.to_array(), &sin_cos, out);
            [out[0], out[1]]
        };
        let mut residual = kernel(target);
        // A zero residual is either straight ahead or so nearly exactly behind that the kernel gives 0.
        let far = residual[0] * residual[0] + residual[1] * residual[1] > FAR_RESIDUAL;
        if far || residual == [0.0; 2] {
            if let Some(aside) = self.target_beside_opposite(joints) {
                residual = kernel(aside);
            }
        }
        let (offset, stretch) = Stretch::of(residual);
        let (left, up) = out[2..].split_at(self.declared);
        let mut row = 0;
        for (index, info) in self.rig.joints.iter().enumerate() {
            let Some(reach) = reaches.get(index) else { break };
            let joint = &joints[index];
            let ranges = [reach.pitch_at(joint.heading), reach.heading];
            let now = [joint.pitch, joint.heading];
            for (which, is_declared) in [info.pitch.is_some(), info.heading.is_some()].into_iter().enumerate() {
                if !is_declared {
                    continue;
                }
                let column = [left[row], up[row]];
                row += 1;
                if index < self.chain.first {
                    continue;
                }
                self.pitch_limit_slopes[index] = 0.0;
                let angle = &mut self.model[index][which];
                angle.column = match &stretch {
                    Some(stretch) => stretch.derivative(column),
                    None => column,
                };
                (angle.lo, angle.hi) = (ranges[which].lo(), ranges[which].hi());
                let cost = &self.displacement_costs[index][which];
                (angle.rest, angle.ease) = (cost.rest, cost.ease);
                if ranges[which].is_free() {
                    angle.rest = now[which];
                    (angle.lo, angle.hi) = (now[which] - PI, now[which] + PI);
                }
            }
        }
        // Derivatives are large for a target nearly on the effector, which the first step would leave. The negation
        // also catches NaN.
        let largest = out.iter().fold(0.0, |largest: f32, x| largest + x.abs());
        if !(largest < SUSPICIOUS) {
            self.view(joints)?;
        }
        largest.is_finite().then_some(offset)
    }

    /// Lets pitches at a limit that depends on the heading move with it. In an axis-aligned box, such a pitch would
    /// block the heading from widening its range. Returns `true` if there are any.
    #[cold]
    fn follow_pitch_limits(&mut self, joints: &[Joint], reaches: &[Reach]) -> bool {
        let mut any = false;
        for (index, (reach, joint)) in reaches.iter().zip(joints).enumerate().skip(self.chain.first) {
            let slope = reach.pitch_limit_slope(joint);
            self.pitch_limit_slopes[index] = slope;
            if slope == 0.0 {
                continue;
            }
            any = true;
            let [pitch, heading] = &mut self.model[index];
            heading.column = [0, 1].map(|k| heading.column[k] + slope * pitch.column[k]);
            // Combine the quadratic displacement costs of both angles as functions of the heading.
            let [own, along] = [1.0 / heading.ease, slope * slope / pitch.ease];
            let rest = joint.heading + (pitch.rest - joint.pitch) / slope;
            heading.rest = (own * heading.rest + along * rest) / (own + along);
            heading.ease = 1.0 / (own + along);
        }
        any
    }

    /// Returns the target as the rigid links have to see it, in the innermost joint's upright space.
    #[inline]
    fn target_in_links(&self, joints: &[Joint]) -> Option<Vec3A> {
        if self.chain.is_rigid() { Some(self.target) } else { self.target_in_links_non_rigid(joints) }
    }

    #[cold]
    #[inline(never)]
    fn target_in_links_non_rigid(&self, joints: &[Joint]) -> Option<Vec3A> {
        let gaze = self.chain.gaze_of(self.rig, joints);
        gaze.angle_to(self.goal.aim_point)?;
        let rigid = self.rigid_gaze(joints);
        let seen = self.chain.rigid_target(self.goal.aim_point, gaze, rigid);
        Some(self.chain.base.matrix3.transpose() * seen)
    }

    /// Returns the effector's ray by the rigid links' kinematics, in solver space.
    fn rigid_gaze(&self, joints: &[Joint]) -> Ray {
        let (infos, links) = (self.rig.joints, &self.chain.links);
        let mut ray = rigid_effector(&self.rig.effector, &links[self.chain.first]);
        for index in self.chain.first..self.chain.count {
            ray = ray.turned(joint_turn(&infos[index], &joints[index]));
            ray = match links.get(index + 1) {
                Some(link) => ray.through(link),
                None => ray.through(&self.chain.base),
            };
        }
        ray
    }

    /// Returns the target as seen from the effector; `None` if it has no direction.
    #[inline]
    pub(crate) fn view(&self, joints: &[Joint]) -> Option<View> {
        let mut target = self.target_in_links(joints)?;
        let (infos, links) = (self.rig.joints, &self.chain.links);
        for index in (self.chain.first..self.chain.count).rev() {
            let turn = joint_turn(&infos[index], &joints[index]);
            target = math::turned(turn.conjugate(), target);
            let link = &links[index];
            target = link.matrix3.transpose() * (target - link.translation);
        }
        let distance = target.dot(target);
        if !(distance > TOO_NEAR * TOO_NEAR && distance.is_finite()) {
            return None;
        }
        let [forward, left, up] = self.axes.map(|axis| target.dot(axis));
        Some(View { forward, left, up })
    }

    /// Returns a substitute target slightly off exactly behind, where neither residual nor Jacobian has a direction. It
    /// is moved towards the remembered side. `None` if the target is not nearly behind.
    #[cold]
    #[inline(never)]
    fn target_beside_opposite(&self, joints: &[Joint]) -> Option<Vec3A> {
        let view = self.view(joints)?;
        let angle = view.angle();
        if angle < PI - OPPOSITE_RAD {
            return None;
        }
        let gaze = self.rigid_gaze(joints);
        let seen = self.chain.base.matrix3 * self.target_in_links(joints)?;
        let to_target = seen - gaze.origin;
        let forward = math::direction(gaze.direction)?;
        let lateral = to_target - forward * forward.dot(to_target);
        let distance = to_target.length();
        let front = self.chain.base.matrix3 * Vec3A::from(self.rig.joints[self.chain.count - 1].axes.left);
        let side = front - forward * forward.dot(front);
        // Nearly opposite, the lateral part is dominated by rounding, so the remembered side outweighs it.
        let lateral = math::direction(lateral * 1e-3 + side * (self.goal.side.sign() * distance))
            .or_else(|| math::direction(forward.any_orthonormal_vector()))?;
        let (sin, cos) = trig::sin_cos(PI - OPPOSITE_RAD);
        let aside = gaze.origin + (forward * cos + lateral * sin) * distance;
        Some(self.chain.base.matrix3.transpose() * aside)
    }
}

/// The zero point and weight of an angle's displacement.
#[derive(Clone, Copy, Debug)]
struct DisplacementCost {
    /// The angle at which the displacement is 0.
    rest: f32,
    /// The reciprocal of the weight.
    ease: f32,
}

/// Sum of absolute derivatives beyond which the target is nearly on the effector, or behind it.
const SUSPICIOUS: f32 = 1e3;

/// Square of the residual of a target at [`OPPOSITE_RAD`] from exactly behind.
const FAR_RESIDUAL: f32 = 17_000.0;

/// Placeholder link of joints outward of the aimed one.
const IDENTITY_LINK: [f32; 12] = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0];

/// Returns the reaches of joints without rate limits: their whole ranges.
pub(crate) fn full_reaches<const C: usize>(
    rig: &ChainRig<'_, C>,
    motions: &[crate::limits::RangeOfMotion],
) -> PerJoint<Reach, C> {
    let mut reaches = rig.array(Reach::REST);
    for (reach, motion) in reaches.iter_mut().zip(motions) {
        *reach = Reach::range(motion);
    }
    reaches
}
