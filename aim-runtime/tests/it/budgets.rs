//! For any character, pose, targets and time steps, head and chest keep to their budgets, and the status of a natural
//! gaze says whether heading and elevation fit them. Judged in f64 from poses and angles alone.
#![allow(clippy::cast_possible_truncation, clippy::cast_precision_loss, reason = "frames are counted")]

use core::ops::RangeInclusive;

use crate::common::*;
use aim_runtime::glam::{Affine3A, Quat, Vec3};
use aim_runtime::{Behind, Budget, Budgets, JointInfo, Pose, Role, Settings, Status};

/// Number of characters. Each runs [`FRAMES`] frames: 10⁵ frames in all, 10⁶ in full test runs.
const CHARACTERS: usize = 250;
const FRAMES: usize = 400;

/// Rounding error of sums of angles, radians.
const ROUNDING: f64 = 2e-5;

/// Character of chest and neck bones, with or without an eye, in a random pose.
struct Character {
    rig: NumericRig,
    pose: Vec<Affine3A>,
    /// Joint indices of head and chest, outermost first.
    parts: [RangeInclusive<usize>; 2],
    has_eye: bool,
}

impl Character {
    fn new(rng: &mut Rng) -> Self {
        let axes = triples()[rng.below(48)].0;
        let (necks, chests, has_eye) = (1 + rng.below(4), 1 + rng.below(3), !rng.once_in(3));
        let mut infos = Vec::new();
        if has_eye {
            let info = JointInfo::new(axes, 500.0 * DEG).with_role(Role::Eye);
            infos.push(info.with_heading(-35.0 * DEG, 35.0 * DEG).with_pitch(-25.0 * DEG, 25.0 * DEG));
        }
        let mut add = |count: usize, role: Role, most: f32| {
            for _ in 0..count {
                let range = rng.between(0.4, 1.6) * most * DEG / count as f32;
                let info = JointInfo::new(axes, rng.between(100.0, 400.0) * DEG).with_role(role);
                let info = info.with_heading(-range, range).with_pitch(-0.6 * range, 0.6 * range);
                infos.push(info.with_stiffness(rng.between(0.5, 2.0)));
            }
        };
        add(necks, Role::Neck, 70.0);
        add(chests, Role::Chest, 25.0);
        let mut rig = NumericRig::new(infos);
        rig.budgets = [Budgets::HUMAN, Budgets::QUADRUPED, Budgets::BIRD, Budgets::TOON][rng.below(4)];
        // A rotation of the whole body, and on top of it one for each bone.
        let turn = Quat::from_rotation_y(rng.between(-3.0, 3.0));
        let count = rig.infos.len();
        let height = |index: usize| 1.7 - 0.6 * index as f32 / count as f32;
        let mut own = turn;
        let mut pose: Vec<Affine3A> = (0..count)
            .rev()
            .map(|index| {
                own *= Quat::from_axis_angle(rng.direction(), rng.between(-8.0, 8.0) * DEG);
                bone(rig.infos[index].axes(), own, Vec3::Y * height(index))
            })
            .collect();
        pose.reverse();
        let first = usize::from(has_eye);
        Self { rig, pose, parts: [first..=first + necks - 1, first + necks..=count - 1], has_eye }
    }

    fn budget(&self, part: usize) -> Budget {
        [self.rig.budgets.head, self.rig.budgets.chest][part]
    }

    /// Returns heading and elevation of a joint's animated forward about +Y, relative to the innermost joint's front.
    fn bearing(&self, joint: usize) -> [f64; 2] {
        let mut still = NumericRig::new(self.rig.infos.clone());
        still.effector = self.rig.effector;
        let [_, front] = [joint, self.pose.len() - 1].map(|joint| gaze64(&still, &self.pose, joint).1);
        bearing_from(front, gaze64(&still, &self.pose, joint).1)
    }

    /// Returns the range of a part's total correction in this pose, from ranges and budget: heading, then pitch.
    fn room(&self, part: usize) -> [[f64; 2]; 2] {
        let joints = self.parts[part].clone();
        let inside = if part == 0 { self.bearing(*self.parts[1].start()) } else { self.bearing(*joints.start()) };
        let here = self.bearing(*joints.start());
        let budget = self.budget(part);
        [0, 1].map(|axis| {
            let declared = |info: &JointInfo| if axis == 0 { info.heading } else { info.pitch }.unwrap_or_default();
            let ranges = self.rig.infos[joints.clone()].iter().map(declared);
            let sum = ranges.fold([0.0; 2], |sum, range| [0, 1].map(|end| sum[end] + f64::from(range[end])));
            let turned = here[axis] - inside[axis];
            let [lo, hi] = [budget.heading, budget.pitch][axis].map(f64::from);
            [sum[0].max((lo - turned).min(0.0)), sum[1].min((hi - turned).max(0.0))]
        })
    }

    /// Returns the sums of a part's added headings and pitches.
    fn turned(&self, part: usize) -> [f64; 2] {
        let joints = &self.rig.joints[self.parts[part].clone()];
        [
            joints.iter().map(|joint| f64::from(joint.heading())).sum(),
            joints.iter().map(|joint| f64::from(joint.pitch())).sum(),
        ]
    }

    /// Returns the margin by which heading and elevation of a target are within reach, radians; negative if they are
    /// not.
    fn fit(&self, target: Vec3) -> f64 {
        let eye = self.pose[0].translation;
        let to_target = [target.x - eye.x, target.y - eye.y, target.z - eye.z].map(f64::from);
        let front = gaze64(&NumericRig::new(self.rig.infos.clone()), &self.pose, self.pose.len() - 1).1;
        let (wanted, from) = (bearing_from(front, to_target), self.bearing(0));
        let rooms = [self.room(0), self.room(1)];
        let eye = if self.has_eye { [[-35.0, 35.0], [-25.0, 25.0]] } else { [[0.0; 2]; 2] };
        let spare = [0, 1].map(|axis| {
            let way = wanted[axis] - from[axis];
            let ends = [0, 1].map(|end| f64::from(eye[axis][end] * DEG) + rooms[0][axis][end] + rooms[1][axis][end]);
            (ends[1] - way).min(way - ends[0])
        });
        spare[0].min(spare[1])
    }
}

/// Returns heading about +Y, to the left of `front`, and elevation of a direction of any length, radians.
fn bearing_from(front: [f64; 3], direction: [f64; 3]) -> [f64; 2] {
    let heading = |[x, _, z]: [f64; 3]| x.atan2(z);
    let turn = heading(direction) - heading(front);
    let pi = core::f64::consts::PI;
    [(turn + 3.0 * pi).rem_euclid(2.0 * pi) - pi, direction[1].atan2(direction[0].hypot(direction[2]))]
}

/// Returns a target 5 m away at this heading and elevation from the innermost joint's front.
fn target(character: &Character, heading: f32, elevation: f32) -> Vec3 {
    let front = gaze64(&NumericRig::new(character.rig.infos.clone()), &character.pose, character.pose.len() - 1).1;
    let front = (front[0] as f32).atan2(front[2] as f32);
    let direction = Quat::from_rotation_y(front + heading) * Quat::from_rotation_x(-elevation) * Vec3::Z;
    Vec3::from(character.pose[0].translation) + 5.0 * direction
}

#[test]
fn parts_keep_to_their_budgets() {
    let (mut judged, mut odd) = ([0; 2], 0);
    for number in 0..if in_full() { 10 * CHARACTERS } else { CHARACTERS } {
        let mut rng = Rng(0xb0d6_0000 + number as u64);
        let mut character = Character::new(&mut rng);
        let rooms = [character.room(0), character.room(1)];
        let settings = Settings::default().with_behind(Behind::Off);
        let pose = Pose::new(character.pose.clone()).with_up(Vec3::Y);
        let dt = rng.between(1.0 / 144.0, 1.0 / 24.0);
        let (mut before, mut speeds) = ([[0.0; 2]; 2], [[0.0; 2]; 2]);
        let (mut aimed, mut stays, mut stood) = (Vec3::ZERO, 0.0, 0.0_f32);
        for frame in 0..FRAMES {
            let at = format!("character {number}, frame {frame}, {:.1} ms", 1e3 * dt);
            if stood >= stays {
                aimed = target(&character, rng.between(-2.6, 2.6), rng.between(-45.0, 45.0) * DEG);
                (stood, stays) = (0.0, if rng.once_in(2) { rng.between(0.1, 0.6) } else { 4.0 });
            }
            stood += dt;
            let joints = character.rig.joints.clone();
            let outcome = character.rig.aim_with(&pose, aimed, dt, &settings);
            for part in [0, 1] {
                let (now, budget) = (character.turned(part), character.budget(part));
                let rate = character.rig.infos[character.parts[part].clone()].iter().map(|info| info.rate).sum::<f32>();
                let rate = f64::from(rate.min(budget.rate));
                let speed = [0, 1].map(|axis| (now[axis] - before[part][axis]) / f64::from(dt));
                for axis in [0, 1] {
                    let [lo, hi] = rooms[part][axis];
                    assert!(
                        (lo - ROUNDING..=hi + ROUNDING).contains(&now[axis]),
                        "{at}: part {part}, {now:?} in {lo}..{hi}"
                    );
                }
                assert!(
                    speed[0].abs().max(speed[1].abs()) <= rate * 1.001 + 1e-3,
                    "{at}: part {part}, {speed:?} of {rate}"
                );
                let gain = [0, 1].map(|axis| speed[axis] - speeds[part][axis]);
                let most = f64::from(budget.acceleration * dt);
                let gain = gain[0].abs().max(gain[1].abs());
                // Ranges and rates take precedence: if a joint is at its limit, another may take over the turn at its
                // full rate.
                let hurries = character.parts[part].clone().any(|index| {
                    let (old, new) = (joints[index], character.rig.joints[index]);
                    let moved = (new.heading() - old.heading()).abs().max((new.pitch() - old.pitch()).abs());
                    moved > 0.999 * character.rig.infos[index].rate * dt
                });
                assert!(hurries || gain <= 1.01 * most + 1e-3, "{at}: part {part}, {gain} of {most}");
                (before[part], speeds[part]) = (now, speed);
            }
            // After enough time the status is right, up to the difference between added joint angles and headings and
            // elevations.
            if stood > 3.0 {
                const MARGIN: f64 = 15.0 * core::f64::consts::PI / 180.0;
                let fit = character.fit(aimed);
                if fit < -MARGIN {
                    judged[0] += 1;
                    assert_eq!(outcome.status, Status::AtLimit, "{at}: {fit}, {outcome:?}");
                } else if fit > MARGIN {
                    judged[1] += 1;
                    // In leaning bones, joint angles add up to different headings and elevations.
                    odd += usize::from(outcome.status != Status::Reached);
                }
            }
        }
    }
    assert!(100 * odd < judged[1], "{odd} of {judged:?}");
    assert!(judged[0].min(judged[1]) > CHARACTERS, "{judged:?}");
}
