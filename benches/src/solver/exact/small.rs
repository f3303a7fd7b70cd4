//! Holding a target, invariance to the scale of stiffnesses, and level heads.

use aim::glam::{Quat, Vec3};
use aim::{AimRig, Axes, DynAim, JointInfo, Pose, Rig, Role};

use super::super::chain::{DEG, Gazer, posed};
use super::super::numeric::NumericRig;
use super::super::parallel;
use super::super::row::{Row, largest};
use super::super::sample::{FRAME_RATES, Sample, Scene, apart, frames};
use super::super::workload::{Where, bearing, track};

/// The largest remaining angle after a still target was first reached.
pub fn holding(sample: &Sample) -> Vec<Row> {
    FRAME_RATES
        .into_iter()
        .map(|hz| {
            let cases = Where::Cone.cases(sample.of(2048));
            let lost = parallel::map(cases.len(), |i| {
                let mut scene = Scene::new(Gazer::RIG, &cases[i].pose, cases[i].target);
                let model = scene.model();
                let (mut arrived, mut lost) = (false, 0.0_f64);
                for _ in 0..frames(model.longest() + 0.5, hz) {
                    scene.step(1.0 / hz, &sample.plain());
                    let remaining = scene.remaining(&model) / DEG;
                    if arrived {
                        lost = lost.max(remaining);
                    }
                    // Arrived, but only within the tolerance: the solver gets one more frame to close the rest.
                    arrived |= remaining <= 0.1;
                }
                lost
            });
            Row::at_most(format!("still target after arrival, {hz} Hz: gaze"), 0.05, "°", largest(lost))
        })
        .collect()
}

/// All stiffnesses scaled by 1000 and by 1/1000: the angles must not change.
pub fn stiffnesses(sample: &Sample) -> Vec<Row> {
    [1e3, 1e-3]
        .into_iter()
        .map(|factor| {
            let scaled: Vec<JointInfo> = Gazer::RIG
                .description()
                .joints()
                .iter()
                .map(|info| info.with_stiffness(info.stiffness * factor))
                .collect();
            let motions = track(sample.of(64), true);
            let changes = parallel::map(motions.len(), |i| {
                let (pose, target) = (motions[i].body.at(0.0), motions[i].path.at(0.0));
                let mut plain = Scene::new(NumericRig::like(Gazer::RIG), &pose, target);
                let mut other = Scene::new(NumericRig::new(&scaled), &pose, target);
                let mut change = 0.0_f64;
                for frame in 0_u16..300 {
                    for scene in [&mut plain, &mut other] {
                        scene.follow(&motions[i], f32::from(frame) / 60.0);
                        scene.step(1.0 / 60.0, &sample.plain());
                    }
                    let model = plain.model();
                    change = change.max(apart(&model, &plain.angles(&model), &other.angles(&model)));
                }
                change / DEG
            });
            Row::at_most(format!("all stiffnesses × {factor:e}: change of any angle"), 1e-3, "°", largest(changes))
        })
        .collect()
}

/// A neck that leans forward by 30° and turns by 60°: the roll of the head with level and with plain headings.
pub fn roll(sample: &Sample) -> Vec<Row> {
    let axes = Axes { up: [1.0, 0.0, 0.0], forward: [0.0, 1.0, 0.0], left: [0.0, 0.0, 1.0] };
    [(1.0, Some(5.0)), (0.0, None)]
        .into_iter()
        .map(|(level, limit)| {
            #[expect(clippy::cast_possible_truncation, reason = "angles are in f32")]
            let range = (80.0 * DEG) as f32;
            let neck = JointInfo::new(axes, 3.0)
                .with_heading(-range, range)
                .with_pitch(-range, range)
                .with_upright(level)
                .with_role(Role::Neck);
            let mut rig = DynAim::new(NumericRig::new(&[neck]));
            let leaning = Quat::from_rotation_x(30_f32.to_radians());
            let bone = posed([Quat::IDENTITY, leaning, Quat::IDENTITY])[1];
            let pose = Pose::new([bone]).with_up(Vec3::Y);
            // The direction of a 60° heading: about the world's up if level, otherwise about the bone's own.
            let at: Vec3 = bone.translation.into();
            let towards = if level == 1.0 { bearing(60.0, -30.0) } else { leaning * bearing(60.0, 0.0) };
            for _ in 0..120 {
                rig.aim(&pose, at + 2.0 * towards, 1.0 / 60.0, &sample.plain());
            }
            let correction = rig.corrections()[0];
            let left = bone.transform_vector3(correction * Vec3::from(axes.left));
            let roll = left.as_dvec3().normalize().y.asin().abs() / DEG;
            let what = format!("neck leaning 30°, heading 60°, level {level}: roll of the head");
            match limit {
                Some(limit) => Row::at_most(what, limit, "°", roll),
                None => Row::shown(what, "°", roll),
            }
        })
        .collect()
}
