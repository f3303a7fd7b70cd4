//! Frames that need no search and are solved by specialised versions of the exact solver: compared with the general
//! solver from the same state, and judged in f64 from the definitions.

#![allow(clippy::cast_possible_truncation, reason = "rounding to f32 is meant")]
#![allow(clippy::cast_precision_loss, reason = "frames are counted")]

use crate::alone::as_a_chain;
use crate::common::random::{self, Animation};
use crate::common::truth::{self, Call};
use crate::common::*;
use aim_runtime::glam::{Affine3A, Mat3A, Vec3, Vec3A};
use aim_runtime::{Behind, Joint, JointInfo, Outcome, Pose, Role, Settings, Solver, Status};

/// Number of rigs for each number of joints. Each runs [`FRAMES`] frames.
const RIGS: usize = 60;
const FRAMES: usize = 40;

/// Largest difference of an angle between both solvers, radians: each may leave a different error of up to 4.5e-5.
const SAME_RAD: f32 = 2e-4;
/// Additional difference relative to the largest movement of an angle: corrections to the linear model differ as well.
const SAME_PART: f32 = 5e-3;
/// Largest difference after a large movement such as a jump, radians. Larger ones are accepted if the displacement's
/// cost is no more than [`SAME_COST`] above the general solver's.
const SAME_AFTER_A_LEAP_RAD: f32 = 5e-3;
/// Largest relative excess of a displacement's cost over that of the general solver.
const SAME_COST: f64 = 0.01;

/// Solver that a frame was solved by.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Path {
    General,
    Specialised,
}

/// Results of both solvers for one frame.
struct Frame {
    before: NumericRig,
    rig: NumericRig,
    outcome: Outcome,
    whole: NumericRig,
    by_whole: Outcome,
    path: Path,
}

impl Frame {
    /// Solves a frame with `rig`'s own choice of solver and with the general solver, which is used whenever ranges are
    /// relative to a bind pose.
    ///
    /// The general solver works in units of the rig's size, specialised ones in units of its bones. So a frame was solved by
    /// a specialised solver if no kernel call had the general solver's arguments.
    fn serve(rig: &NumericRig, pose: &Pose<Vec<Affine3A>>, target: Vec3, dt: f32, settings: &Settings) -> Self {
        let before = rig.clone();
        let [(rig, outcome), (whole, by_whole)] = [before.clone(), as_a_chain(&before)].map(|mut rig| {
            rig.kernel_targets = Some(Vec::new().into());
            let outcome = rig.aim_with(pose, target, dt, settings);
            (rig, outcome)
        });
        let [kernel_targets, kernel_targets_of_whole] =
            [&rig, &whole].map(|rig| rig.kernel_targets.clone().unwrap().into_inner());
        let is_general = kernel_targets_of_whole.first().is_none_or(|first| kernel_targets.contains(first));
        let path = if is_general { Path::General } else { Path::Specialised };
        Self { before, rig, outcome, whole, by_whole, path }
    }

    /// Checks a frame that was left to the general solver: the attempt to specialise must not change a single bit.
    fn check_general(&self) -> Result<(), String> {
        let require = |holds: bool, what: &str| if holds { Ok(()) } else { Err(what.to_owned()) };
        require(self.outcome == self.by_whole, "the outcome differs")?;
        require(self.rig.joints == self.whole.joints, "a joint differs in what it remembers")?;
        require(self.rig.memory == self.whole.memory, "the memory differs")?;
        require(self.rig.corrections().eq(self.whole.corrections()), "a correction differs")
    }

    /// Checks a frame that a specialised solver solved.
    fn check_specialised(&self, call: &Call<'_>, up: Option<Vec3>, same_rad: f32) -> Result<(), String> {
        let Self { before, rig, outcome, whole, by_whole, .. } = self;
        call.check(before, rig, outcome)?;
        // Out of reach, a single joint gets as near as possible, nearer than the general solver's linear steps.
        let nearest = rig.infos.len() == 1 && outcome.remaining > 1e-4;
        if nearest && outcome.remaining > by_whole.remaining + 1e-4 {
            return Err(format!("the general solver comes nearer: {by_whole:?}"));
        }
        let moved = angles(before).zip(angles(rig)).map(|(old, new)| (old - new).abs()).fold(0.0, f32::max);
        let [cost, other_cost] = [rig, whole].map(|rig| cost(before, rig));
        let costs_the_same = same_rad > SAME_RAD && cost <= (1.0 + SAME_COST) * other_cost;
        let (mut old, mut own, mut other) = (angles(before), angles(rig), angles(whole));
        for index in 0..rig.infos.len() {
            let info = &rig.infos[index];
            let step = info.rate.max(0.0) * call.dt.unwrap();
            for range in [info.heading, info.pitch] {
                let [old, own, other] = [&mut old, &mut own, &mut other].map(|angles| angles.next().unwrap());
                let [lo, hi] = range.unwrap_or([0.0; 2]);
                if !(lo <= own && own <= hi) {
                    return Err(format!("joint {index} at {own} in {lo}..{hi}"));
                }
                if !(old - step <= own && own <= old + step) {
                    return Err(format!("joint {index} from {old} to {own} by steps of {step}"));
                }
                if !((own - other).abs() <= same_rad + SAME_PART * moved || nearest || costs_the_same) {
                    return Err(format!("joint {index} from {old} to {own}, by the general solver to {other}"));
                }
            }
            let joint = &rig.joints[index];
            if *joint != Joint::from_angles(joint.heading(), joint.pitch()) {
                return Err(format!("joint {index} remembers more than angles"));
            }
        }
        // The tolerance may lie between the errors of both solvers.
        let tolerance = call.settings.tolerance;
        let (least, most) = (outcome.remaining.min(by_whole.remaining), outcome.remaining.max(by_whole.remaining));
        let is_between = least <= tolerance && tolerance <= most && (most < least + 1e-4 || nearest);
        // Below the resolution of single precision, the status may differ.
        let unclear = is_between || tolerance < 1e-5;
        if (outcome.status != by_whole.status && !unclear) || outcome.recovering != by_whole.recovering {
            return Err(format!("the general solver: {by_whole:?}"));
        }
        for index in 0..rig.infos.len() {
            let (at_limit, unclear) = at_limit(&rig.infos[index], &rig.joints[index], same_rad);
            let (reported, by_whole) = (outcome.at_limit.contains(index), by_whole.at_limit.contains(index));
            if reported != at_limit || (reported != by_whole && !unclear && !nearest && !costs_the_same) {
                return Err(format!(
                    "joint {index} at limit: {at_limit}, told {reported}, by the general solver {by_whole}"
                ));
            }
        }
        if !nearest && !unclear && !self.remembers_alike(call, up) {
            return Err(format!("the general solver remembers {:?}, this one {:?}", whole.memory, rig.memory));
        }
        if rig.memory.other_eye().is_some() {
            return Err("another eye is remembered".into());
        }
        self.check_corrections(call.joints, up)?;
        call.check_remaining(truth::seen64(rig, call.joints, 0), outcome.remaining)
    }

    /// Returns `true` if both solvers remember the same about the target: its side, and how long it has been out of
    /// reach.
    fn remembers_alike(&self, call: &Call<'_>, up: Option<Vec3>) -> bool {
        let [own, other] = [&self.rig, &self.whole].map(|rig| format!("{:?}", rig.memory));
        let is_alike = |name: &str| {
            let [own, other] = [&own, &other].map(|text| text.split_once(name).unwrap().1.split([',', '}']).next());
            own == other
        };
        // Here the side is that of the target as seen from the innermost joint; in the general solver, as seen from the
        // effector, where it is held while the target is behind.
        let last = self.rig.infos.len() - 1;
        let innermost = call.joints[last];
        let [left, forward] = [self.rig.infos[last].axes().left, self.rig.infos[last].axes().forward]
            .map(|axis| innermost.transform_vector3(axis.into()).normalize());
        let (effector, _) = truth::animated64(&self.rig, call.joints, 0);
        let effector = Vec3::from(effector.map(|x| x as f32));
        let [by_joint, by_effector] = [innermost.translation.into(), effector].map(|from: Vec3| {
            let seen = (call.target - from) / call.size;
            [left.dot(seen), forward.dot(seen)]
        });
        let is_clear = by_joint[0].abs().min(by_effector[0].abs()) > 1e-4
            && by_joint[0] * by_effector[0] > 0.0
            && by_effector[1] > 0.0;
        let is_tilted = truth::tilt64(&self.rig, call.joints, up, last).is_some();
        is_alike("blocked_s:") && is_alike("behind:") && (is_alike("side:") || !is_clear || is_tilted)
    }

    /// Checks the corrections against the angles, in f64.
    fn check_corrections(&self, pose: &[Affine3A], up: Option<Vec3>) -> Result<(), String> {
        for (index, correction) in self.rig.corrections() {
            let off = truth::off_correction64(&self.rig, pose, up, index, correction);
            if off > 1e-6 {
                return Err(format!("the correction of joint {index} is off by {off}"));
            }
        }
        Ok(())
    }
}

/// Returns heading and pitch of each joint.
fn angles(rig: &NumericRig) -> impl Iterator<Item = f32> + '_ {
    rig.joints.iter().flat_map(|joint| [joint.heading(), joint.pitch()])
}

/// Returns the cost of a frame's angles: the sum of their squared displacements from half of the former angles,
/// weighted by stiffness.
fn cost(before: &NumericRig, after: &NumericRig) -> f64 {
    let stiffness = after.infos.iter().flat_map(|info| [info.stiffness; 2]);
    let displaced = angles(before).zip(angles(after)).map(|(old, new)| f64::from(new) - 0.5 * f64::from(old));
    displaced.zip(stiffness).map(|(displaced, stiffness)| f64::from(stiffness) * displaced * displaced).sum()
}

/// Returns whether a joint has an angle within 1e-6 of an end of its range, and whether another solver may decide that
/// differently.
fn at_limit(info: &JointInfo, joint: &Joint, same_rad: f32) -> (bool, bool) {
    let (mut at_limit, mut unclear) = (false, false);
    for (range, angle) in [(info.heading, joint.heading()), (info.pitch, joint.pitch())] {
        let Some([lo, hi]) = range else { continue };
        at_limit |= angle <= lo + 1e-6 || angle >= hi - 1e-6;
        let inside = (angle - lo).min(hi - angle);
        unclear |= inside < same_rad;
    }
    (at_limit, unclear)
}

/// Returns a rig with fixed ranges, for which specialised solvers exist.
fn rig(rng: &mut Rng, count: usize) -> NumericRig {
    let (all_alike, is_upright) = (rng.once_in(3), rng.once_in(3));
    let mut infos: Vec<JointInfo> = Vec::new();
    for index in 0..count {
        let mut info = JointInfo::new(random::axes(rng), rng.of_any_size(0.5, 20.0));
        // Eye and neck have both angles, so that there is something to aim with.
        let declared = if index < 2 { 15 } else { rng.below(16) };
        if declared % 4 != 0 {
            let [lo, hi] = random::range(rng, 150.0);
            info = info.with_heading(lo, hi);
        }
        if declared / 4 != 0 {
            let [lo, hi] = random::range(rng, 85.0);
            info = info.with_pitch(lo, hi);
        }
        info = info.with_stiffness(if all_alike { 2.0 } else { rng.of_any_size(0.1, 10.0) });
        if index > 0 {
            info.rate = match rng.below(8) {
                0 => rng.of_any_size(1e-4, 0.1),
                1 => 1e3,
                _ => info.rate,
            };
        }
        if is_upright {
            info = match rng.below(4) {
                0 => info.with_role(Role::Neck),
                1 => info.with_upright(rng.between(-0.2, 1.2)),
                _ => info.with_upright(0.0),
            };
        }
        if rng.once_in(3) {
            info = info.with_acceleration(rng.of_any_size(0.5, 50.0));
        }
        infos.push(info);
    }
    let mut rig = NumericRig::new(infos);
    if rng.once_in(3) {
        rig.effector.origin = (rng.direction() * rng.between(0.0, 0.1)).to_array();
    }
    if rng.once_in(4) {
        let turn = rng.turn(0.5);
        rig.effector.forward = (turn * Vec3::from(rig.effector.forward)).normalize().to_array();
    }
    rig
}

/// Returns an animation that preserves shapes.
fn animation(rig: &NumericRig, rng: &mut Rng) -> Animation {
    loop {
        let animation = Animation::new(rig, rng);
        if animation.similar {
            return animation;
        }
    }
}

/// Target that wanders within the ranges and sometimes jumps.
struct Wanderer {
    ends: [Vec<Joint>; 2],
    /// Largest rate of the interpolation parameter between the ends, per second.
    pace: f32,
    /// Largest sum of the speeds of all angles, radians per second.
    speed: f32,
    phase: f32,
    distance: f32,
}

impl Wanderer {
    fn new(rig: &NumericRig, rng: &mut Rng, size: f32) -> Self {
        let ends = [(); 2].map(|()| {
            let mut ends = random::state(rig, rng);
            for (joint, info) in ends.iter_mut().zip(&rig.infos) {
                // Some of them at an end of their range.
                let further = |angle: f32, range: Option<[f32; 2]>| {
                    let [lo, hi] = range.unwrap_or([0.0; 2]);
                    (1.3 * angle).max(lo).min(hi)
                };
                *joint = Joint::from_angles(further(joint.heading(), info.heading), further(joint.pitch(), info.pitch));
            }
            ends
        });
        let mut wanderer = Self {
            ends,
            pace: 0.0,
            speed: rng.of_any_size(0.01, 1.5),
            phase: rng.between(0.0, 6.0),
            distance: size * rng.of_any_size(0.5, 30.0),
        };
        let [a, b] = &wanderer.ends;
        let way: f32 =
            a.iter().zip(b).map(|(a, b)| (a.heading() - b.heading()).abs() + (a.pitch() - b.pitch()).abs()).sum();
        wanderer.pace = wanderer.speed / way;
        wanderer
    }

    /// Returns the target after this many seconds.
    fn at(&self, rig: &NumericRig, pose: &[Affine3A], seconds: f32) -> Vec3 {
        let part = 0.5 - 0.5 * (2.0 * self.pace * seconds + self.phase).cos();
        let mut probe = rig.clone();
        for (index, joint) in probe.joints.iter_mut().enumerate() {
            let between = |a: f32, b: f32| a + part * (b - a);
            let [a, b] = [&self.ends[0][index], &self.ends[1][index]];
            *joint = Joint::from_angles(between(a.heading(), b.heading()), between(a.pitch(), b.pitch()));
        }
        ahead(&probe, pose, 0, self.distance)
    }
}

/// A rig with its inputs over many frames.
struct Scene {
    rig: NumericRig,
    animation: Animation,
    wanderer: Wanderer,
    up: Option<Vec3>,
    settings: Settings,
    seconds: f32,
}

impl Scene {
    /// Returns a rig that is on its target. The target is in front of it, unless `anywhere` is set.
    fn new(rng: &mut Rng, count: usize, anywhere: bool) -> Self {
        loop {
            let rig = rig(rng, count);
            let animation = animation(&rig, rng);
            let wanderer = Wanderer::new(&rig, rng, animation.size);
            let up = rng.once_in(2).then_some(animation.up);
            let settings = Settings::default().with_solver(Solver::Exact).with_behind(Behind::Off);
            let mut scene = Self { rig, animation, wanderer, up, settings, seconds: 0.0 };
            let (joints, target) = (scene.joints(), scene.target());
            let snapped = scene.rig.snap_with(&scene.pose(), target, &settings);
            let innermost = joints.last().unwrap();
            let forward = innermost.transform_vector3(scene.rig.infos[count - 1].axes().forward.into());
            let is_in_front = forward.dot(target - Vec3::from(innermost.translation)) > 0.0;
            if snapped.status == Status::Reached && (is_in_front || anywhere) {
                return scene;
            }
        }
    }

    fn joints(&self) -> Vec<Affine3A> {
        self.animation.at(&self.rig, 0.05 * self.seconds)
    }

    fn pose(&self) -> Pose<Vec<Affine3A>> {
        let mut pose = Pose::new(self.joints());
        pose.up = self.up;
        pose
    }

    fn target(&self) -> Vec3 {
        self.wanderer.at(&self.rig, &self.joints(), self.seconds)
    }

    /// Runs and judges a frame of `dt` seconds.
    fn frame(&mut self, dt: f32, same_rad: f32) -> Frame {
        self.seconds += dt;
        self.frame_at(self.target(), &self.pose(), dt, same_rad)
    }

    /// Runs and judges a frame with another target and pose.
    fn frame_at(&mut self, target: Vec3, pose: &Pose<Vec<Affine3A>>, dt: f32, same_rad: f32) -> Frame {
        let frame = Frame::serve(&self.rig, pose, target, dt, &self.settings);
        let (joints, settings, size) = (&pose.joints, &self.settings, self.animation.size);
        let (bind, pair) = (pose.bind.as_deref(), pose.other_eye.as_ref());
        let call = Call { joints, bind, pair, target, dt: Some(dt), settings, similar: true, size };
        let checked = match frame.path {
            Path::General => frame.check_general(),
            Path::Specialised => frame.check_specialised(&call, pose.up, same_rad),
        };
        if let Err(wrong) = checked {
            panic!("{:?}: {wrong}\n{:?}\n{call:#?}\n{:#?}", frame.path, frame.outcome, frame.before);
        }
        self.rig = frame.rig.clone();
        frame
    }

    /// Returns `true` if any heading is about another axis than its bone's own up.
    fn is_tilted(&self) -> bool {
        let joints = self.joints();
        (0..joints.len()).any(|index| truth::tilt64(&self.rig, &joints, self.up, index).is_some())
    }
}

/// Rigs of 1–8 joints of every kind follow their targets.
#[test]
fn followed_as_the_general_solver_does() {
    for count in 1..=8 {
        let [mut specialised, mut tilted, mut at_limit, mut offset, mut mirrored] = [0; 5];
        for number in 0..RIGS {
            let mut rng = Rng(0x6000_0000 + (count * 0x1_0000 + number) as u64);
            let mut scene = Scene::new(&mut rng, count, false);
            for _ in 0..FRAMES {
                let frame = scene.frame(1.0 / 60.0, SAME_RAD);
                if frame.path == Path::Specialised {
                    specialised += 1;
                    tilted += usize::from(scene.is_tilted());
                    at_limit += usize::from(!frame.outcome.at_limit.is_empty());
                    offset += usize::from(scene.rig.effector.origin != [0.0; 3]);
                    mirrored += usize::from(scene.joints()[0].matrix3.determinant() < 0.0);
                }
            }
        }
        let all = RIGS * FRAMES;
        let seen = format!("{specialised} of {all}: {tilted}, {at_limit}, {offset}, {mirrored}");
        // At a limit, a single joint gets no help from others.
        assert!(specialised > if count == 1 { all / 2 } else { all * 3 / 4 }, "{count} joints: {seen}");
        assert!(
            mirrored.min(all - mirrored) > all / 5 && (count == 1 || at_limit > all / 10),
            "{count} joints: {seen}"
        );
        // A single joint is upright already.
        assert!(offset > all / 20 && (count == 1 || tilted > all / 20), "{count} joints: {seen}");
    }
}

/// Frames that a specialised solver cannot solve are left to the general one, and taken up again afterwards: targets
/// that jump, are behind or not finite; stretched poses; other settings; changing ranges; a second eye.
#[test]
fn frames_for_the_general_solver_are_left_to_it() {
    let [mut specialised, mut general, mut remembering] = [0; 3];
    for number in 0..4 * RIGS {
        let mut rng = Rng(0x7000_0000 + number as u64);
        let anywhere = rng.once_in(3);
        let mut scene = Scene::new(&mut rng, 1 + number % 8, anywhere);
        scene.settings.behind = if anywhere { Behind::Clip } else { Behind::Off };
        let usual = scene.settings;
        let mut left = 0;
        for _ in 0..2 * FRAMES {
            let mut dt = 1.0 / 60.0;
            scene.seconds += dt;
            let joint = rng.below(scene.rig.infos.len());
            let (mut pose, mut target) = (scene.pose(), scene.target());
            left -= 1;
            if left == 0 {
                scene.settings = usual;
            }
            match rng.below(100) {
                0..3 => scene.wanderer = Wanderer::new(&scene.rig, &mut rng, scene.animation.size),
                3 | 4 => {
                    // Mirrored at the effector.
                    let (origin, _) = truth::animated64(&scene.rig, &pose.joints, 0);
                    target = 2.0 * Vec3::from(origin.map(|x| x as f32)) - target;
                    scene.settings.behind = [Behind::Off, Behind::Clip, Behind::Hold, Behind::Release][rng.below(4)];
                    left = 20;
                }
                5 => target = [Vec3::NAN, Vec3::INFINITY, pose.joints[joint].translation.into()][rng.below(3)],
                6 => {
                    // Along the line of sight.
                    let (origin, _) = truth::seen64(&scene.rig, &pose.joints, 0);
                    let origin = Vec3::from(origin.map(|x| x as f32));
                    target = origin + (target - origin) * rng.of_any_size(1e-8, 1e12);
                }
                7 => {
                    let (by, along) = (rng.between(0.5, 2.0), rng.direction());
                    let stretched = &mut pose.joints[joint].matrix3;
                    *stretched = Mat3A::from_diagonal(Vec3::ONE + along * (by - 1.0)) * *stretched;
                }
                8 => pose.joints[joint].matrix3 *= rng.between(0.5, 2.0),
                9 => dt = [0.0, -1.0, f32::NAN, 1e-9, 0.05, 1e9][rng.below(6)],
                10 => {
                    let range = Some([-rng.between(0.0, 1.0), rng.between(0.0, 1.0)]);
                    let info = &mut scene.rig.infos[joint];
                    *(if rng.once_in(2) { &mut info.heading } else { &mut info.pitch }) = range;
                }
                11 => {
                    let leading = pose.joints[0];
                    pose.other_eye = Some(Affine3A {
                        translation: leading.translation + leading.matrix3 * Vec3A::from(rng.direction() * 0.06),
                        ..leading
                    });
                }
                12 => {
                    scene.settings.weight = rng.between(0.0, 1.0);
                    left = 5;
                }
                13 => {
                    scene.settings.effector = rng.below(3);
                    left = 5;
                }
                14 => {
                    scene.settings.tolerance = rng.of_any_size(1e-7, 0.1);
                    left = 10;
                }
                15 => {
                    scene.settings.solver = Some(Solver::Natural);
                    left = 10;
                }
                16 => scene.rig.joints = random::state(&scene.rig, &mut rng),
                _ => {}
            }
            let frame = scene.frame_at(target, &pose, dt, SAME_AFTER_A_LEAP_RAD);
            specialised += usize::from(frame.path == Path::Specialised);
            general += usize::from(frame.path == Path::General);
            let remembers = |joint: &Joint| *joint != Joint::from_angles(joint.heading(), joint.pitch());
            remembering += usize::from(frame.before.joints.iter().any(remembers));
        }
    }
    let seen = format!("{specialised} specialised, {general} general, {remembering} that go on with something");
    assert!(specialised.min(general) > 80 * RIGS && remembering > 2 * RIGS, "{seen}");
}

/// A target exactly behind is turned to on the side where it was last followed.
#[test]
fn a_target_behind_is_turned_to_on_the_remembered_side() {
    for count in [1, 3] {
        for side in [-1.0, 1.0] {
            let mut rig = NumericRig::new(NumericRig::thug().infos[..count].to_vec());
            let pose = Pose::new(upright(&rig));
            let eye = Vec3::from(pose.joints[0].translation);
            let settings = Settings::default().with_solver(Solver::Exact);
            let [ahead, _, left] = WORLD;
            for step in 1_u8..10 {
                let target = eye + 2.0 * ahead + 0.01 * side * f32::from(step) * left;
                let frame = Frame::serve(&rig, &pose, target, 1.0 / 60.0, &settings);
                assert_eq!(frame.path, Path::Specialised, "{count} joints, step {step}");
                rig = frame.rig;
            }
            for _ in 0..20 {
                rig.aim_with(&pose, eye - 2.0 * ahead, 1.0 / 60.0, &settings);
            }
            assert!(side * rig.joints[0].heading() > 0.2, "{count} joints, side {side}: {:?}", rig.joints);
        }
    }
}

/// Targets so fast that the linear model has to be applied again to its remaining error.
#[test]
fn fast_targets_are_reached_by_refinement() {
    let mut specialised = 0;
    for number in 0..RIGS {
        let mut rng = Rng(0x9000_0000 + number as u64);
        let mut scene = Scene::new(&mut rng, 2 + number % 7, false);
        scene.wanderer.pace *= 2.4 / scene.wanderer.speed;
        for _ in 0..FRAMES {
            let frame = scene.frame(1.0 / 60.0, SAME_AFTER_A_LEAP_RAD);
            specialised += usize::from(frame.path == Path::Specialised);
        }
    }
    let all = RIGS * FRAMES;
    assert!(specialised > all * 5 / 6, "{specialised} of {all}");
}

/// Joints that follow a target come to rest, bit by bit equal, when it stops.
#[test]
fn joints_come_to_rest_on_a_static_target() {
    let mut still = 0;
    for number in 0..2 * RIGS {
        let mut rng = Rng(0x8000_0000 + number as u64);
        let mut scene = Scene::new(&mut rng, 2 + number % 7, false);
        // Some joints would take hours.
        scene.rig.infos.iter_mut().for_each(|info| info.rate = info.rate.max(0.5));
        let (target, pose) = (scene.target(), scene.pose());
        for _ in 0..300 {
            scene.rig.aim_with(&pose, target, 1.0 / 60.0, &scene.settings);
        }
        let before = scene.rig.joints.clone();
        let paths = [(); 5].map(|()| scene.frame_at(target, &pose, 1.0 / 60.0, SAME_RAD).path);
        if paths == [Path::Specialised; 5] {
            assert_eq!(scene.rig.joints, before, "rig {number}");
            still += 1;
        }
    }
    assert!(still > RIGS, "{still}");
}

/// A target on the effector has no direction, even if rounded coordinates give it one.
#[test]
fn a_target_on_the_effector_is_degenerate() {
    for count in [1, 2, 3] {
        let mut rig = NumericRig::new(NumericRig::thug().infos[..count].to_vec());
        let [ahead, ..] = WORLD;
        let mut joints = upright(&rig);
        let eye = joints[0].translation;
        joints.iter_mut().for_each(|joint| joint.translation -= eye);
        let pose = Pose::new(joints);
        let settings = Settings::default().with_solver(Solver::Exact);
        let steps = pose.joints.windows(2).map(|pair| pair[0].translation.distance(pair[1].translation));
        let size = if count == 1 { 1.0 } else { steps.sum::<f32>() };
        for distance in [0.0, 1e-9, 1e-7, 1e-6, 5e-6, 9e-6].map(|part| part * size) {
            let outcome = rig.aim_with(&pose, ahead * distance, 1.0 / 60.0, &settings);
            assert_eq!(outcome.status, Status::Degenerate, "{count} joints, {distance}");
            assert_eq!(rig.joints, vec![Joint::REST; count]);
        }
    }
}
