//! Expected results of a call, computed in f64 from the definitions: the directions of the corrected bones, the ranges
//! of motion, and a check of everything that is promised of one call.

use aim_runtime::glam::{Affine3A, Quat, Vec3};
use aim_runtime::{Behind, JointInfo, LimitsFrom, Outcome, Settings, Status};

use super::*;

/// Returns effector `k`'s origin and direction after applying the corrections, including upright tilts.
pub fn seen64(rig: &NumericRig, pose: &[Affine3A], k: usize) -> ([f64; 3], [f64; 3]) {
    let (origin, forward) = declared_effector(rig, k);
    corrected_gaze64(rig, pose, k, origin, forward)
}

/// Returns effector `k`'s origin and direction in the animation, without corrections.
pub fn animated64(rig: &NumericRig, pose: &[Affine3A], k: usize) -> ([f64; 3], [f64; 3]) {
    let (origin, forward) = declared_effector(rig, k);
    to_pose_with(pose, k, origin, forward, |_, v| v)
}

/// Returns the other eye's origin and direction after applying its correction.
pub fn seen_pair64(rig: &NumericRig, pose: &[Affine3A], pair: &Affine3A) -> ([f64; 3], [f64; 3]) {
    let bone = Transform64::of(pair);
    let forward = Transform64::of(&pose[0]).vector(rig.infos[0].axes().forward.map(f64::from));
    let turned = turned64(rig.other_eye_correction().expect("the last pose had a pair"), bone.inverse_vector(forward));
    let (origin, direction) = (bone.point([0.0; 3]), bone.vector(turned));
    match pose.get(1) {
        Some(next) => {
            let next = Transform64::of(next);
            corrected_gaze64(rig, pose, 1, next.inverse_point(origin), next.inverse_vector(direction))
        }
        None => (origin, scale(direction, 1.0 / dot(direction, direction).sqrt())),
    }
}

fn declared_effector(rig: &NumericRig, k: usize) -> ([f64; 3], [f64; 3]) {
    let (origin, forward) =
        if k == 0 { (rig.effector.origin, rig.effector.forward) } else { ([0.0; 3], rig.infos[k].axes().forward) };
    (origin.map(f64::from), forward.map(f64::from))
}

fn corrected_gaze64(
    rig: &NumericRig,
    pose: &[Affine3A],
    k: usize,
    origin: [f64; 3],
    forward: [f64; 3],
) -> ([f64; 3], [f64; 3]) {
    let corrections: Vec<Quat> = rig.corrections().map(|(_, q)| q).collect();
    to_pose_with(pose, k, origin, forward, |joint, v| turned64(corrections[joint], v))
}

fn turned64(turn: Quat, v: [f64; 3]) -> [f64; 3] {
    let [x, y, z, w] = turn.to_array().map(f64::from);
    let axis = [x, y, z];
    let across = cross(axis, v);
    add(v, scale(add(scale(across, w), cross(axis, across)), 2.0))
}

/// Returns the heading and pitch by which the animation turns a joint out of its bind pose, and the cosine of its
/// pitch, which is small if it looks nearly straight up or down. For joints with similarity transforms only.
pub fn animated_angles64(info: &JointInfo, joints: &[Affine3A], bind: &[Affine3A], index: usize) -> ([f64; 2], f64) {
    let [forward, up, left] = [info.axes().forward, info.axes().up, info.axes().left].map(|v| v.map(f64::from));
    let local = |pose: &[Affine3A], v| {
        let v = Transform64::of(&pose[index]).vector(v);
        pose.get(index + 1).map_or(v, |next| Transform64::of(next).inverse_vector(v))
    };
    let back = |pose: &[Affine3A], v| {
        let v = pose.get(index + 1).map_or(v, |next| Transform64::of(next).vector(v));
        Transform64::of(&pose[index]).inverse_vector(v)
    };
    let v = back(bind, local(joints, forward));
    let v = scale(v, 1.0 / dot(v, v).sqrt());
    let [ahead, aside, above] = [forward, left, up].map(|axis| dot(axis, v));
    let level = ahead.hypot(aside);
    ([aside.atan2(ahead), above.atan2(level)], level)
}

/// Returns the difference between a joint's correction and the rotation by its heading and pitch in its upright frame:
/// the largest distance between their rotated axes.
pub fn off_correction64(rig: &NumericRig, pose: &[Affine3A], up: Option<Vec3>, index: usize, correction: Quat) -> f64 {
    let info = &rig.infos[index];
    let [forward, above, left] = [info.axes().forward, info.axes().up, info.axes().left].map(|v| v.map(f64::from));
    let tilt = tilt64(rig, pose, up, index);
    let turned = |v: [f64; 3]| {
        let v = tilt.as_ref().map_or(v, |tilt| tilt.turn(v, -1.0));
        let v = plane_turn(v, forward, above, rig.joints[index].pitch().into());
        let v = plane_turn(v, forward, left, rig.joints[index].heading().into());
        tilt.as_ref().map_or(v, |tilt| tilt.turn(v, 1.0))
    };
    let off = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(|axis| {
        let off = sub(turned(axis), turned64(correction, axis));
        dot(off, off).sqrt()
    });
    off.into_iter().fold(0.0, f64::max)
}

/// Rotation that makes a bone's frame upright: from its own up towards the character's.
pub struct Tilt {
    from: [f64; 3],
    towards: [f64; 3],
    angle: f64,
}

impl Tilt {
    fn turn(&self, v: [f64; 3], sign: f64) -> [f64; 3] {
        plane_turn(v, self.from, self.towards, sign * self.angle)
    }
}

/// Returns the tilt of a joint's upright frame relative to its bone, `None` if its heading is about the bone's own up.
/// For joints with similarity transforms only.
pub fn tilt64(rig: &NumericRig, pose: &[Affine3A], up: Option<Vec3>, index: usize) -> Option<Tilt> {
    let unit = |v: [f64; 3]| scale(v, 1.0 / dot(v, v).sqrt());
    let info = &rig.infos[index];
    let leaning = matches!(info.role, aim_runtime::Role::Head | aim_runtime::Role::Neck);
    let share = info.upright.map_or(if leaning { 1.0 } else { 0.0 }, f64::from).clamp(0.0, 1.0);
    let last = rig.infos.len() - 1;
    let innermost = Transform64::of(&pose[last]).vector(rig.infos[last].axes().up.map(f64::from));
    let wanted = up.map_or(innermost, |up| up.to_array().map(f64::from));
    let wanted = unit(Transform64::of(&pose[index]).inverse_vector(wanted));
    let from = info.axes().up.map(f64::from);
    let lean = dot(from, wanted);
    let across = sub(wanted, scale(from, lean));
    let angle = dot(across, across).sqrt().atan2(lean);
    // Beyond a right angle the tilt is reduced, to none at 120°.
    let angle = angle * share * ((lean + 0.5) / 0.5).clamp(0.0, 1.0);
    (angle > 1e-7).then(|| Tilt { from, towards: unit(across), angle })
}

/// Returns the effective range for a declared one.
fn effective_range(range: Option<[f32; 2]>) -> [f64; 2] {
    let full = core::f64::consts::TAU;
    match range.map(|range| range.map(f64::from)) {
        Some([lo, hi]) if lo == f64::NEG_INFINITY && hi == f64::INFINITY => [lo, hi],
        Some([lo, hi]) if !lo.is_nan() && !hi.is_nan() => {
            let (lo, hi) = (lo.clamp(-full, full), hi.clamp(-full, full));
            if lo <= hi { [lo, hi] } else { [0.5 * (lo + hi); 2] }
        }
        _ => [0.0; 2],
    }
}

/// Returns the range that may be added if the animation is already at `animated`.
fn remaining_range([lo, hi]: [f64; 2], animated: Option<f64>) -> [f64; 2] {
    animated.map_or([lo, hi], |animated| [(lo - animated).min(0.0), (hi - animated).max(0.0)])
}

/// Returns a joint's range of added headings.
pub fn heading_range(info: &JointInfo, animated: Option<[f64; 2]>) -> [f64; 2] {
    match info.heading {
        Some(_) => remaining_range(effective_range(info.heading), animated.map(|[heading, _]| heading)),
        None => [0.0; 2],
    }
}

/// Returns a joint's range of added pitches at an added heading.
pub fn pitch_range(info: &JointInfo, animated: Option<[f64; 2]>, heading: f64) -> [f64; 2] {
    if info.pitch.is_none() {
        return [0.0; 2];
    }
    let [lo, hi] = effective_range(info.pitch);
    let [right, left] = effective_range(info.heading);
    let most = if info.pitch_taper.is_nan() { 0.0 } else { f64::from(info.pitch_taper).clamp(0.0, 1.0) };
    let heading = heading + animated.map_or(0.0, |[heading, _]| heading);
    let end = if heading < 0.0 { -right } else { left };
    let lost = if end > 0.0 && lo.is_finite() { (most * heading.abs() / end).min(most) } else { 0.0 };
    let kept = |x: f64| if lost > 0.0 { x * (1.0 - lost) } else { x };
    remaining_range([kept(lo), kept(hi)], animated.map(|[_, pitch]| pitch))
}

/// Call with all its inputs.
#[derive(Debug)]
pub struct Call<'a> {
    pub joints: &'a [Affine3A],
    pub bind: Option<&'a [Affine3A]>,
    pub pair: Option<&'a Affine3A>,
    pub target: Vec3,
    /// `None` for a snap.
    pub dt: Option<f32>,
    pub settings: &'a Settings,
    /// `true` if every joint's transform is a similarity.
    pub similar: bool,
    /// Characteristic length of the rig, in the pose's space.
    pub size: f32,
}

impl Call<'_> {
    /// Checks everything that is promised of a call. `before` is the rig before the call.
    pub fn check(&self, before: &NumericRig, rig: &NumericRig, outcome: &Outcome) -> Result<(), String> {
        let ok = |holds: bool, what: &dyn Fn() -> String| if holds { Ok(()) } else { Err(what()) };
        ok(sound(rig), &|| "a correction is not unit".into())?;
        if let Some(q) = rig.other_eye_correction() {
            let length = q.to_array().map(f64::from).iter().map(|x| x * x).sum::<f64>().sqrt();
            ok((length - 1.0).abs() <= 1e-6, &|| format!("the pair's correction is not unit: {q}"))?;
        }
        ok(rig.joints.iter().all(|j| j.heading().is_finite() && j.pitch().is_finite()), &|| "not finite".into())?;
        ok((outcome.aim.abs() <= 1.0) && (0.0..=3.141_594).contains(&outcome.remaining), &|| "no angle".into())?;
        if outcome.status == Status::Degenerate {
            ok(rig.joints == before.joints, &|| format!("degenerate, yet it moved from {:?}", before.joints))?;
            ok(outcome.aim == 0.0, &|| "degenerate, yet an aim".into())?;
            return ok(self.may_be_degenerate(rig), &|| "nothing is degenerate here".into());
        }
        ok((outcome.aim - outcome.remaining.cos()).abs() < 2e-6, &|| "aim is not the angle's cosine".into())?;
        let dt = self.dt.map(|dt| if dt > 0.0 { dt.min(0.1) } else { 0.0 });
        if dt == Some(0.0) {
            ok(rig.joints == before.joints, &|| format!("no time has passed, yet it moved from {:?}", before.joints))?;
        }
        if dt != Some(0.0) {
            self.check_angles(before, rig, outcome, dt)?;
        }
        self.check_status(rig, outcome)
    }

    /// Checks what is promised for arbitrary poses.
    pub fn check_any(&self, rig: &NumericRig, outcome: &Outcome) -> Result<(), String> {
        let ok = |holds: bool, what: &str| if holds { Ok(()) } else { Err(what.to_owned()) };
        ok(sound(rig), "a correction is not unit")?;
        ok(rig.joints.iter().all(|j| j.heading().is_finite() && j.pitch().is_finite()), "not finite")?;
        ok((outcome.aim.abs() <= 1.0) && (0.0..=3.141_594).contains(&outcome.remaining), "no angle")?;
        let is_plain = self.joints.iter().chain(self.pair).all(|joint| {
            let [x, y, z] = Transform64::of(joint).columns;
            let lengths = [x, y, z].map(|v| dot(v, v).sqrt());
            let is_full = dot(x, cross(y, z)).abs() > 0.1 * lengths.iter().product::<f64>();
            is_full && lengths.iter().all(|length| (1e-4..1e4).contains(length))
        });
        if outcome.status == Status::Degenerate || !is_plain {
            return Ok(());
        }
        self.check_gazes(rig, outcome)
    }

    /// Checks ranges and rates, and which joints are reported at a limit or recovering.
    fn check_angles(
        &self,
        before: &NumericRig,
        rig: &NumericRig,
        outcome: &Outcome,
        dt: Option<f32>,
    ) -> Result<(), String> {
        let own = |rig: &NumericRig, index: usize| [rig.joints[index].heading(), rig.joints[index].pitch()];
        let mut moves: Vec<(usize, JointInfo, [f32; 2], [f32; 2])> =
            (0..rig.infos.len()).map(|i| (i, rig.infos[i], own(before, i), own(rig, i))).collect();
        if let Some(new) = rig.memory.other_eye() {
            let mut mirrored = rig.infos[0];
            mirrored.heading = mirrored.heading.map(|[lo, hi]| [-hi, -lo]);
            moves.push((0, mirrored, before.memory.other_eye().unwrap_or_default(), new));
        }
        let (mut at_limit, mut off_limit) = (vec![false; rig.infos.len()], vec![true; rig.infos.len()]);
        let (mut outside, mut inside) = (at_limit.clone(), off_limit.clone());
        let mut moves_text = String::new();
        for (index, info, old, new) in moves {
            let mut slack = 2e-6;
            let mut animated = None;
            if let (true, Some(bind)) = (info.limits_from == LimitsFrom::BindPose, self.bind) {
                let (angles, level) = animated_angles64(&info, self.joints, bind, index);
                // Near vertical, a bone's heading is ill-conditioned. Stretched poses are not handled here.
                slack = if self.similar && level > 0.05 { 4e-6 / level } else { f64::INFINITY };
                animated = Some(angles);
            }
            let [old, new] = [old, new].map(|angles| angles.map(f64::from));
            let step = dt.map_or(f64::INFINITY, |dt| f64::from(info.rate.max(0.0)) * f64::from(dt));
            let ranges = [heading_range(&info, animated), pitch_range(&info, animated, new[0])];
            for ((([lo, hi], old), new), declared) in
                ranges.into_iter().zip(old).zip(new).zip([info.heading, info.pitch])
            {
                let free = lo == f64::NEG_INFINITY;
                let moved = (new - old).abs();
                let moved = if free { moved.min((moved - core::f64::consts::TAU).abs()) } else { moved };
                if moved > step + 2e-6 {
                    return Err(format!("joint {index} moved {moved} of {step}, from {old} to {new}"));
                }
                let out = |angle: f64| (lo - angle).max(angle - hi).max(0.0);
                if out(new) > (out(old) - step).max(0.0) + slack {
                    return Err(format!("joint {index} is out by {} in {lo}..{hi}: {old} to {new}", out(new)));
                }
                if declared.is_some() && !free {
                    at_limit[index] |= new < lo + 1e-6 - slack || new > hi - 1e-6 + slack;
                    off_limit[index] &= new > lo + 1e-5 + slack && new < hi - 1e-5 - slack;
                }
                moves_text += &format!("{index}: {old} to {new} in {lo}..{hi} ± {slack}; ");
                outside[index] |= out(new) > slack + 1e-6;
                inside[index] &= declared.is_none() || (new >= lo + slack + 1e-6 && new <= hi - slack - 1e-6);
            }
        }
        for index in 0..rig.infos.len() {
            if at_limit[index] && !outcome.at_limit.contains(index) && self.similar {
                return Err(format!("joint {index} is at a limit and that is not said: {moves_text}"));
            }
            if off_limit[index] && outcome.at_limit.contains(index) {
                return Err(format!("joint {index} is said to be at a limit: {moves_text}"));
            }
            if outside[index] && !outcome.recovering.contains(index) {
                return Err(format!("joint {index} is outside its range and that is not said: {moves_text}"));
            }
            if inside[index] && outcome.recovering.contains(index) {
                return Err(format!("joint {index} is said to be outside its range: {moves_text}"));
            }
        }
        Ok(())
    }

    /// Returns the factor by which a direction loses precision on the way through the bones' spaces: 1 in the
    /// animations of characters, but an awkward number may make one axis of a bone a thousand times as long as another.
    fn precision_loss(&self) -> f64 {
        let stretch = |joint: &Affine3A| {
            let lengths = Transform64::of(joint).columns.map(|v| dot(v, v).sqrt());
            lengths.into_iter().fold(0.0, f64::max) / lengths.into_iter().fold(f64::INFINITY, f64::min)
        };
        let longest = self.joints.iter().chain(self.pair).map(stretch).fold(1.0, f64::max);
        if longest > 10.0 { longest } else { 1.0 }
    }

    /// Checks the remaining angles by forward kinematics.
    fn check_gazes(&self, rig: &NumericRig, outcome: &Outcome) -> Result<(), String> {
        // At a lower weight the gaze aims at another point than the target.
        if self.settings.weight.is_nan() || self.settings.weight < 1.0 {
            return Ok(());
        }
        let aimed = self.settings.effector.min(rig.infos.len() - 1);
        let gazes = [Some(seen64(rig, self.joints, aimed)), self.other_eye_gaze(rig, aimed)];
        for (gaze, reported) in gazes.into_iter().zip([Some(outcome.remaining), outcome.other_eye_remaining]) {
            let (Some(gaze), Some(reported)) = (gaze, reported) else { continue };
            self.check_remaining(gaze, reported)?;
            let truth = angle_to64(gaze, self.target);
            let blur = self.blur(gaze.0);
            if (truth - f64::from(reported)).abs() > blur {
                return Err(format!("forward kinematics is off by {truth}, told are {reported}, within {blur}"));
            }
        }
        Ok(())
    }

    /// Checks that the status agrees with the remaining angle.
    fn check_status(&self, rig: &NumericRig, outcome: &Outcome) -> Result<(), String> {
        self.check_gazes(rig, outcome)?;
        let aimed = self.settings.effector.min(rig.infos.len() - 1);
        let tolerance = if self.settings.tolerance.is_nan() { 0.0 } else { self.settings.tolerance.max(0.0) };
        // An eye that only follows does not affect the status.
        let pair = outcome.other_eye_remaining.filter(|_| aimed == 0 && self.pair_leads(rig));
        let worst = outcome.remaining.max(pair.unwrap_or(0.0));
        if (outcome.status == Status::Reached) != (worst <= tolerance) {
            return Err(format!("{worst} is left of {tolerance}"));
        }
        if outcome.status == Status::Behind && self.settings.behind == Behind::Off {
            return Err("behind, without a policy".into());
        }
        if outcome.status == Status::RateLimited && self.dt.is_none() {
            return Err("a snap has no rates".into());
        }
        Ok(())
    }

    /// Checks a reported angle by forward kinematics, to 1e-5 rad plus four rounding errors of the largest coordinate,
    /// as seen from the target's distance. For targets nearer than a thirtieth of that coordinate, nine: there a
    /// chain's rounding errors accumulate.
    pub fn check_remaining(&self, (origin, direction): ([f64; 3], [f64; 3]), reported: f32) -> Result<(), String> {
        let points = self.joints.iter().chain(self.pair).map(|joint| Vec3::from(joint.translation));
        let points = points.chain([self.target]);
        let largest = points.map(|point| point.abs().max_element()).fold(0.0, f32::max);
        let v = sub(self.target.to_array().map(f64::from), origin);
        let nearness = f64::from(largest) / dot(v, v).sqrt();
        let roundings = if nearness > 30.0 { 9.0 } else { 4.0 };
        let blur = self.precision_loss() * 1e-5 + roundings * f64::from(f32::EPSILON) * nearness;
        let truth = angle_to64((origin, direction), self.target);
        let reported = f64::from(reported);
        if (truth - reported).abs() <= blur {
            return Ok(());
        }
        Err(format!(
            "{reported} remain, by forward kinematics {truth}: {} times {blur} apart",
            (truth - reported).abs() / blur
        ))
    }

    fn other_eye_gaze(&self, rig: &NumericRig, aimed: usize) -> Option<([f64; 3], [f64; 3])> {
        rig.other_eye_correction()?;
        (aimed == 0).then_some(seen_pair64(rig, self.joints, self.pair?))
    }

    /// Returns `true` if the other eye is aimed itself instead of following joint 0.
    fn pair_leads(&self, rig: &NumericRig) -> bool {
        let info = &rig.infos[0];
        let leaning = matches!(info.role, aim_runtime::Role::Head | aim_runtime::Role::Neck);
        let level = info.upright.unwrap_or(if leaning { 1.0 } else { 0.0 });
        rig.effector.origin == [0.0; 3]
            && rig.effector.forward == info.axes().forward
            && (level <= 0.0 || level.is_nan())
    }

    /// Returns the precision of an angle to the target in f32, radians.
    fn blur(&self, origin: [f64; 3]) -> f64 {
        let v = sub(self.target.to_array().map(f64::from), origin);
        let near = f64::from(self.size) / dot(v, v).sqrt();
        let bent = if self.similar { 1.0 } else { 10.0 };
        self.precision_loss().max(bent) * (3e-5 + 4e-6 * near)
    }

    /// Returns `true` if the call may be degenerate: nothing to aim, or nearly so.
    fn may_be_degenerate(&self, rig: &NumericRig) -> bool {
        let aimed = self.settings.effector.min(rig.infos.len() - 1);
        let near = |(origin, _): ([f64; 3], [f64; 3])| {
            let v = sub(self.target.to_array().map(f64::from), origin);
            dot(v, v).sqrt() <= 2e-4 * f64::from(self.size)
        };
        let somewhere = self.joints.iter().chain(self.pair).all(Affine3A::is_finite) && self.target.is_finite();
        let weight = if self.settings.weight.is_nan() { 0.0 } else { self.settings.weight.clamp(0.0, 1.0) };
        // With a pair, the point between the eyes is aimed; if the target is there, it need not be near either eye.
        !somewhere
            || self.pair.is_some()
            || (weight > 0.0 && (near(seen64(rig, self.joints, aimed)) || near(animated64(rig, self.joints, aimed))))
    }
}
