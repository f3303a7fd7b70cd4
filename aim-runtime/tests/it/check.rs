//! Setup checks: a small engine makes each mistake for random characters, and the check must name it. A correct setup
//! must never be reported.

use crate::common::random::{self, Animation};
use crate::common::*;
use aim_runtime::check::{Applied, Frame, Mistake, Previous};
use aim_runtime::glam::{Affine3A, Mat3A, Quat, Vec3};
use aim_runtime::{Behind, Call, Joint, JointInfo, Pose, Rig, Settings, Solver, State, Target};

/// Error of the applied gaze above which a mistake must be found, degrees.
const OFF_DEG: f32 = 1.0;

/// Bone of the engine: its local transform and its parent, which precedes it.
#[derive(Clone, Copy)]
struct Bone {
    translation: Vec3,
    rotation: Quat,
    scale: f32,
    parent: Option<usize>,
}

impl Bone {
    fn local(&self) -> Affine3A {
        Affine3A::from_scale_rotation_translation(Vec3::splat(self.scale), self.rotation, self.translation)
    }
}

/// Returns each bone's transform in the character's space.
fn globals(bones: &[Bone]) -> Vec<Affine3A> {
    let mut globals: Vec<Affine3A> = Vec::new();
    for bone in bones {
        globals.push(bone.parent.map_or(Affine3A::IDENTITY, |parent| globals[parent]) * bone.local());
    }
    globals
}

/// Character in an engine: hips, the joints' bones, and sometimes a bone between two of them.
struct Character {
    rig: NumericRig,
    bind: Vec<Bone>,
    /// Bone index of each joint, from the effector inward.
    chain: Vec<usize>,
    swings: Vec<(Vec3, f32)>,
    world: Affine3A,
}

impl Character {
    fn new(count: usize, rng: &mut Rng) -> Self {
        let mut info = || {
            // Bones that are only rotated have right-handed axes.
            let mut axes = random::axes(rng);
            while Vec3::from(axes.up).cross(axes.forward.into()).dot(axes.left.into()) < 0.0 {
                axes = random::axes(rng);
            }
            let info = JointInfo::new(axes, rng.between(2.0, 10.0)).with_stiffness(rng.of_any_size(0.3, 3.0));
            let info = if rng.once_in(3) { info.with_upright(rng.between(0.0, 1.0)) } else { info };
            info.with_heading(-rng.between(0.4, 1.0), rng.between(0.4, 1.0))
                .with_pitch(-rng.between(0.3, 0.8), rng.between(0.3, 0.8))
        };
        let rig = NumericRig::new((0..count).map(|_| info()).collect());
        let scale = [0.01, 1.0, 1.0, 100.0][rng.below(4)];
        let turn = rng.turn(3.0);
        let place = scale * rng.between(2.0, 30.0) * rng.direction();
        let hips = Bone { translation: Vec3::Y, rotation: rng.turn(0.3), scale: 1.0, parent: None };
        let (mut bind, mut chain) = (vec![hips], Vec::new());
        let mut height = 1.0;
        for info in rig.infos.iter().rev() {
            let mut add = |model: Affine3A| {
                let parent = globals(&bind)[bind.len() - 1];
                let (_, rotation, translation) = (parent.inverse() * model).to_scale_rotation_translation();
                bind.push(Bone { translation, rotation, scale: 1.0, parent: Some(bind.len() - 1) });
            };
            height += rng.between(0.05, 0.3);
            let aside = Vec3::new(rng.between(-0.05, 0.05), 0.0, rng.between(-0.1, 0.1));
            if rng.once_in(4) {
                add(Affine3A::from_rotation_translation(rng.turn(2.0), Vec3::Y * (height - 0.03) + aside * 0.5));
            }
            add(bone(info.axes(), rng.turn(0.2), Vec3::Y * height + aside));
            chain.insert(0, bind.len() - 1);
        }
        let swings = bind.iter().map(|_| (rng.direction(), rng.between(0.5, 4.0))).collect();
        let world = Affine3A::from_scale_rotation_translation(Vec3::splat(scale), turn, place);
        Self { rig, bind, chain, swings, world }
    }

    /// Returns the bones as the animation writes them.
    fn animated(&self, seconds: f32) -> Vec<Bone> {
        let swing = |&(axis, speed): &(Vec3, f32)| Quat::from_axis_angle(axis, 0.1 * (speed * (seconds + 1.0)).sin());
        let bones = self.bind.iter().zip(&self.swings);
        bones.map(|(bone, by)| Bone { rotation: bone.rotation * swing(by), ..*bone }).collect()
    }

    /// Selects the joints from the transforms of all bones.
    fn joints(&self, transforms: &[Affine3A]) -> Vec<Affine3A> {
        self.chain.iter().map(|&bone| transforms[bone]).collect()
    }

    fn world_joints(&self, bones: &[Bone]) -> Vec<Affine3A> {
        self.joints(&globals(bones)).into_iter().map(|joint| self.world * joint).collect()
    }
}

/// Mistakes that users make, with the number of variants of each.
const WAYS: [(Mistake, usize); 13] = [
    (Mistake::LocalPose, 1),
    (Mistake::TargetSpace, 2),
    (Mistake::TargetUnit, 2),
    (Mistake::JointOrder, 2),
    (Mistake::Inverted, 1),
    (Mistake::Forgotten, 2),
    (Mistake::Premultiplied, 2),
    (Mistake::WrongJoints, 2),
    (Mistake::AppliedTwice, 1),
    (Mistake::Milliseconds, 1),
    (Mistake::OntoGlobal, 2),
    (Mistake::Feedback, 2),
    (Mistake::Late, 1),
];

/// Results of several runs.
#[derive(Debug, Default)]
struct Tally {
    /// Number of frames whose gaze was off by more than [`OFF_DEG`].
    off: usize,
    /// Number of frames in which the mistake was named.
    named: usize,
    /// Frames in which another mistake was named, or none although the gaze was off, each with its error in degrees.
    misnamed: Vec<(Option<Mistake>, f32)>,
}

impl Tally {
    fn judge(&mut self, mistake: Mistake, way: usize) {
        // With tiny corrections, a pose that contains the previous ones looks much like one applied a frame late.
        self.misnamed.retain(|&(_, off_deg)| mistake != Mistake::Feedback || off_deg > OFF_DEG);
        assert!(self.misnamed.is_empty(), "{mistake:?} {way}: {:?}", self.misnamed);
        // Unreset bones and time steps in milliseconds do not keep the gaze from reaching the target.
        let shows = self.off > 0 || matches!((mistake, way), (Mistake::Milliseconds, _) | (Mistake::Feedback, 1));
        assert!(self.named > 0 && shows, "{mistake:?} {way}: {self:?}");
    }
}

/// Runs a character for some frames, with or without the mistake.
fn play(character: &Character, mistake: Option<(Mistake, usize)>, is_in_model: bool, rng: &mut Rng, tally: &mut Tally) {
    let Character { rig, chain, world, .. } = character;
    let count = chain.len();
    let settings = Settings::default();
    let is = |which| mistake.is_some_and(|(mistake, _)| mistake == which);
    let way = mistake.map_or(0, |(_, way)| way);
    let mut state = State::new(vec![Joint::REST; count]);
    let mut corrections = vec![Quat::IDENTITY; count];
    let mut shown: Option<(Vec<Bone>, Vec<Affine3A>, Vec<Quat>)> = None;
    // A reachable point in front of the animated effector.
    let aside = random::state(rig, rng);
    let mut probe = rig.clone();
    probe.joints = aside;
    let rest = character.world_joints(&character.animated(0.0));
    let target = ahead(&probe, &rest, 0, world.matrix3.x_axis.length() * rng.between(0.5, 5.0));
    for frame in 0..30_u16 {
        let mut bones = character.animated(f32::from(frame) / 60.0);
        if let (true, 1, Some((last, ..))) = (is(Mistake::Feedback), way, &shown) {
            // The joints' bones have no keys and keep what was written to them.
            chain.iter().for_each(|&bone| bones[bone] = last[bone]);
        }
        let locals: Vec<Affine3A> = bones.iter().map(Bone::local).collect();
        let animated = character.world_joints(&bones);
        let is_in_model = is_in_model || (is(Mistake::TargetSpace) && way == 1);
        let to_passed = if is_in_model { world.inverse() } else { Affine3A::IDENTITY };
        let mut passed: Vec<Affine3A> = animated.iter().map(|joint| to_passed * *joint).collect();
        let mut passed_target = to_passed.transform_point3(target);
        let mut dt = 1.0 / 60.0;
        match mistake {
            Some((Mistake::LocalPose, _)) => passed = character.joints(&locals),
            Some((Mistake::TargetSpace, 0)) => passed_target = world.inverse().transform_point3(target),
            Some((Mistake::TargetSpace, _)) => passed_target = target,
            Some((Mistake::TargetUnit, _)) => passed_target *= [100.0, 0.01][way],
            Some((Mistake::JointOrder, _)) => passed.reverse(),
            Some((Mistake::Milliseconds, _)) => dt *= 1e3,
            Some((Mistake::Feedback, 0)) => {
                if let Some((_, joints, _)) = &shown {
                    passed = joints.iter().map(|joint| to_passed * *joint).collect();
                }
            }
            _ => {}
        }
        let call = Call { targets: passed_target.into(), dt: Some(dt), settings: &settings };
        let earlier = corrections.clone();
        let pose = Pose::new(passed);
        let outcome = (rig as &dyn Rig).aim(&mut state, &pose, &call, &mut corrections);

        let parents = globals(&bones);
        for (joint, &at) in chain.iter().enumerate() {
            let q = corrections[joint];
            let rotation = bones[at].rotation;
            bones[at].rotation = match mistake {
                Some((Mistake::Inverted, _)) => rotation * q.inverse(),
                // All joints, or only the eye's bone.
                Some((Mistake::Forgotten, _)) if way == 0 || joint == 0 => rotation,
                Some((Mistake::Premultiplied, 0)) => q * rotation,
                // In world space.
                Some((Mistake::Premultiplied, _)) => {
                    let parent = *world * parents[bones[at].parent.expect("the hips are no joint")];
                    let (_, parent, _) = parent.to_scale_rotation_translation();
                    parent.inverse() * q * parent * rotation
                }
                Some((Mistake::WrongJoints, 0)) => rotation * corrections[(joint + 1) % count],
                Some((Mistake::WrongJoints, _) | (Mistake::JointOrder, 0)) => rotation * corrections[count - 1 - joint],
                Some((Mistake::AppliedTwice, _)) => rotation * q * q,
                Some((Mistake::OntoGlobal, _)) => rotation,
                Some((Mistake::Late, _)) => rotation * earlier[joint],
                _ => rotation * q,
            };
        }
        let mut applied = character.world_joints(&bones);
        if is(Mistake::OntoGlobal) {
            for (joint, q) in applied.iter_mut().zip(&corrections) {
                let turn = Mat3A::from_quat(*q);
                joint.matrix3 = if way == 0 { joint.matrix3 * turn } else { turn * joint.matrix3 };
            }
        }
        let eye = applied[0];
        let mut order = applied.clone();
        if is(Mistake::JointOrder) && way == 0 {
            order.reverse();
        }
        let previous = shown.as_ref().map(|(_, applied, _)| Previous { applied, corrections: &earlier, dt: Some(dt) });
        let check = Frame {
            rig: rig.description(),
            pose: &pose.joints,
            call,
            outcome,
            corrections: &corrections,
            applied: Applied { joints: &order, target: Some(target) },
            previous,
        };
        let forward = eye.transform_vector3(rig.effector.forward.into());
        let off = forward.angle_between(target - Vec3::from(eye.translation)) - outcome.remaining;
        let off_deg = off.abs().to_degrees();
        let expected = match mistake {
            // In the first frame there are no earlier corrections, so applying them is applying none.
            Some((Mistake::Late, _)) if frame == 0 => Some(Mistake::Forgotten),
            // A single joint's local transform is a pose in another space.
            Some((Mistake::LocalPose, _)) if count == 1 => Some(Mistake::TargetSpace),
            _ => mistake.map(|(mistake, _)| mistake),
        };
        let found = check.check();
        tally.off += usize::from(off_deg > OFF_DEG);
        match found {
            Err(finding) if Some(finding.mistake) == expected => {
                tally.named += 1;
                let to_target = target - Vec3::from(eye.translation);
                let is_true = |seen: f32| (seen - forward.angle_between(to_target)).abs() < 2e-3;
                assert!(finding.seen.map_or(is(Mistake::JointOrder), is_true), "{finding:?}");
                assert!(finding.to_string().len() > 80);
            }
            Err(finding) => tally.misnamed.push((Some(finding.mistake), off_deg)),
            Ok(()) if off_deg > OFF_DEG => tally.misnamed.push((None, off_deg)),
            Ok(()) => {}
        }
        shown = Some((bones, applied, corrections.clone()));
    }
}

/// Each variant of each mistake, for characters of two to five joints with poses in world or model space: whenever the
/// gaze is off by more than 1° or anything is reported, it is the mistake that was made.
#[test]
fn each_mistake_is_named() {
    let mut rng = Rng(77);
    for (mistake, ways) in WAYS {
        for way in 0..ways {
            let mut tally = Tally::default();
            for case in 0..60 {
                let character = Character::new(2 + rng.below(4), &mut rng);
                // In model space, rotations about world axes cannot be recognised.
                let is_in_world = matches!((mistake, way), (Mistake::OntoGlobal, 1) | (Mistake::TargetSpace, 0));
                play(&character, Some((mistake, way)), case % 3 == 0 && !is_in_world, &mut rng, &mut tally);
            }
            tally.judge(mistake, way);
        }
    }
}

/// With a single joint, the mistakes that it can show are named.
#[test]
fn mistakes_of_one_joint() {
    let mut rng = Rng(78);
    for (mistake, way) in WAYS.into_iter().flat_map(|(mistake, ways)| (0..ways).map(move |way| (mistake, way))) {
        // There is no other joint, and global and local transforms are the same, so these variants do not exist.
        let has_none = matches!(
            (mistake, way),
            (Mistake::JointOrder | Mistake::WrongJoints, _) | (Mistake::OntoGlobal, 0) | (Mistake::Premultiplied, 1)
        );
        if has_none {
            continue;
        }
        let mut tally = Tally::default();
        for case in 0..30 {
            let character = Character::new(1, &mut rng);
            let has_rule = matches!(mistake, Mistake::Inverted | Mistake::Forgotten | Mistake::AppliedTwice);
            play(&character, Some((mistake, way)), has_rule && case % 2 == 0, &mut rng, &mut tally);
        }
        tally.judge(mistake, way);
    }
}

/// A correct setup in the same engine is not reported.
#[test]
fn a_correct_setup_has_no_finding() {
    let mut rng = Rng(79);
    let mut tally = Tally::default();
    for case in 0..300 {
        let character = Character::new(1 + rng.below(6), &mut rng);
        play(&character, None, case % 2 == 0, &mut rng, &mut tally);
    }
    assert!(tally.off == 0 && tally.misnamed.is_empty(), "{tally:?}");
}

/// Nothing is reported for random rigs, poses, targets, settings and frame times, in any space of the engine.
#[test]
fn random_correct_rigs_have_no_finding() {
    let mut rng = Rng(80);
    for case in 0..600 {
        let rig = random::rig(&mut rng);
        let animation = Animation::new(&rig, &mut rng);
        let (count, rig_dyn): (usize, &dyn Rig) = (rig.infos.len(), &rig);
        let mut settings = Settings::default()
            .with_weight(if rng.once_in(3) { rng.between(0.0, 1.0) } else { 1.0 })
            .with_effector(if rng.once_in(3) { rng.below(count) } else { 0 })
            .with_behind([Behind::Off, Behind::Clip, Behind::Hold, Behind::Release][rng.below(4)]);
        settings.solver = [None, Some(Solver::Exact), Some(Solver::Ascent)][rng.below(3)];
        let shows = Affine3A::from_scale_rotation_translation(
            Vec3::splat([0.01, 1.0, 100.0][rng.below(3)]),
            rng.turn(3.0),
            rng.direction() * rng.of_any_size(0.1, 50.0) * animation.size,
        );
        let shows = if rng.once_in(2) { shows } else { Affine3A::IDENTITY };
        let mut state = State::new(vec![Joint::REST; count]);
        let mut corrections = vec![Quat::IDENTITY; count];
        let mut shown: Option<(Vec<Affine3A>, f32)> = None;
        let aside = rng.direction() * rng.of_any_size(0.1, 1e4);
        for frame in 0..12_u16 {
            let dt = if rng.once_in(10) { [0.0, 3.0][usize::from(frame % 2)] } else { rng.between(0.004, 0.1) };
            let seconds = f32::from(frame) * if rng.once_in(2) { 1.0 / 60.0 } else { 0.0 };
            let joints = animation.at(&rig, seconds);
            let pose = Pose::new(joints);
            let pose = if rng.once_in(2) { pose.with_up(animation.up) } else { pose };
            let target = animation.point(animation.eye() + aside);
            let both = [Target::new(target, 1.0), Target::new(target + Vec3::splat(animation.size), 0.5)];
            let targets = if rng.once_in(4) { (&both).into() } else { target.into() };
            let call = Call { targets, dt: (!rng.once_in(20)).then_some(dt), settings: &settings };
            let earlier = corrections.clone();
            let outcome = rig_dyn.aim(&mut state, &pose, &call, &mut corrections);
            // Each joint's correction moves all joints further out.
            let mut applied = pose.joints.clone();
            for joint in (0..count).rev() {
                let unturned = match joint + 1 {
                    next if next < count => applied[next] * pose.joints[next].inverse() * pose.joints[joint],
                    _ => shows * pose.joints[joint],
                };
                applied[joint] = unturned * Affine3A::from_quat(corrections[joint]);
            }
            let previous =
                shown.as_ref().map(|(applied, dt)| Previous { applied, corrections: &earlier, dt: Some(*dt) });
            let meant = shows.transform_point3(target);
            let check = Frame {
                rig: rig_dyn.description(),
                pose: &pose.joints,
                call,
                outcome,
                corrections: &corrections,
                applied: Applied { joints: &applied, target: (!rng.once_in(4)).then_some(meant) },
                previous,
            };
            if let Err(finding) = check.check() {
                panic!("case {case}, frame {frame}: {finding} {:?}", finding.mistake);
            }
            shown = Some((applied, dt));
        }
    }
}

/// Frames that cannot be compared are not reported, and nothing panics.
#[test]
fn unusable_frames_have_no_finding() {
    let mut rng = Rng(81);
    for _ in 0..20_000 {
        let rig = random::rig(&mut rng);
        let count = rig.infos.len();
        let any = |rng: &mut Rng| {
            let most = if rng.once_in(2) { 20 } else { 2 };
            let mut x = || if rng.once_in(most) { rng.any() } else { rng.between(-1.0, 1.0) };
            Affine3A::from_cols_array(&core::array::from_fn(|_| x()))
        };
        let some = |rng: &mut Rng| -> Vec<Affine3A> {
            let count = if rng.once_in(10) { rng.below(9) } else { count };
            (0..count).map(|_| any(rng)).collect()
        };
        let (pose, applied, before) = (some(&mut rng), some(&mut rng), some(&mut rng));
        let corrections: Vec<Quat> = (0..count).map(|_| rng.turn(3.0)).collect();
        let point = |rng: &mut Rng| Vec3::new(rng.any(), rng.any(), rng.any());
        let settings = Settings::default().with_effector(rng.below(9));
        let call = Call { targets: point(&mut rng).into(), dt: Some(rng.any()), settings: &settings };
        let outcome = (&rig as &dyn Rig).aim(
            &mut State::new(vec![Joint::REST; count]),
            &Pose::new(pose.clone()),
            &call,
            &mut corrections.clone(),
        );
        let frame = Frame {
            rig: rig.description(),
            pose: &pose,
            call,
            outcome,
            corrections: &corrections,
            applied: Applied { joints: &applied, target: Some(point(&mut rng)) },
            previous: Some(Previous { applied: &before, corrections: &corrections, dt: Some(rng.any()) }),
        };
        if let Err(finding) = frame.check() {
            assert!(pose.len() == count && applied.len() == count && finding.seen.is_none_or(f32::is_finite));
            assert!(pose.iter().chain(&applied).all(Affine3A::is_finite));
        }
    }
}
