//! Movement and speed: trembling targets, and the declared rates through all kinds of jumps.

use aim::glam::{Affine3A, Vec3};
use aim::{AimRig, Behind, Settings};

use super::super::chain::{DEG, EYE_AT_REST, Gazer, direction, random_pose, random_state};
use super::super::model::Model;
use super::super::numeric::NumericRig;
use super::super::parallel;
use super::super::row::{Row, largest, quantile};
use super::super::sample::{FRAME_RATES, Sample, Scene, apart, frames};
use super::super::workload::bearing;

/// A still target with noise of 1 mm, anywhere on the sphere at 2 m, including the poles and behind: the largest
/// movement of an angle in a frame after everything has settled.
pub fn noise(sample: &Sample) -> Vec<Row> {
    let mut rows = Vec::new();
    for (behind, name) in [(Behind::Off, "off"), (Behind::Clip, "clip")] {
        let settings = sample.settings.with_behind(behind);
        let moved = parallel::map(sample.of(512), |i| {
            let mut random = fastrand::Rng::with_seed(0x0015_e000 + i as u64);
            let pose = random_pose(&mut random);
            let towards = match i % 4 {
                0 => Vec3::Y,
                1 => (direction(&mut random) * 0.05 + Vec3::Y).normalize(),
                2 => (direction(&mut random) * 0.05 - Vec3::Z).normalize(),
                _ => direction(&mut random),
            };
            trembling(&pose, EYE_AT_REST + 2.0 * towards, &settings, &mut random)
        });
        let (mut all, worst) = (moved.clone(), largest(moved));
        let what = format!("standing target ± 1 mm, behind {name}: any angle in a frame");
        rows.push(Row::at_most(what, 0.2, "°", worst).noting(&format!("p99 {:.3}°", quantile(&mut all, 0.99))));
    }
    rows
}

/// Returns the largest movement of an angle in a frame after settling, degrees.
fn trembling(pose: &[Affine3A], target: Vec3, settings: &Settings, random: &mut fastrand::Rng) -> f64 {
    let mut scene = Scene::new(Gazer::RIG, pose, target);
    let model = scene.model();
    let settle = frames(model.longest() + 2.0, 60.0);
    let mut worst: f64 = 0.0;
    for frame in 0..settle + 120 {
        let mut noise = || 1e-3 * (2.0 * random.f32() - 1.0);
        scene.target = target + Vec3::new(noise(), noise(), noise());
        let before = scene.angles(&model);
        scene.step(1.0 / 60.0, settings);
        if frame >= settle {
            worst = worst.max(apart(&model, &before, &scene.angles(&model)));
        }
    }
    worst / DEG
}

/// The quantity that jumps from one frame to the next.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Jump {
    Behind,
    Pole,
    Orbit,
    Teleport,
    Seam,
    Weight,
    Limits,
}

const JUMPS: [(Jump, &str); 7] = [
    (Jump::Behind, "behind-crossings"),
    (Jump::Pole, "pole crossings"),
    (Jump::Orbit, "orbits"),
    (Jump::Teleport, "teleports"),
    (Jump::Seam, "loop seams"),
    (Jump::Weight, "weight changes"),
    (Jump::Limits, "limit changes"),
];

/// The largest ratio of an angle's speed to its declared rate, through every kind of jump, at all frame rates and with
/// every policy for targets behind.
pub fn output_rate(sample: &Sample) -> Vec<Row> {
    JUMPS
        .into_iter()
        .map(|(jump, name)| {
            let speeds = parallel::map(sample.of(240), |i| {
                let behind = [Behind::Off, Behind::Clip, Behind::Hold, Behind::Release][i / 3 % 4];
                fastest(jump, i, FRAME_RATES[i % 3], &sample.settings.with_behind(behind))
            });
            // An f32 angle of about 1 rad has a rounding error of 6e-8, which is some 1e-5 of a step at 1.2 rad/s and
            // 144 Hz.
            let fastest = largest(speeds);
            Row::at_most(format!("output rate through {name}"), 1.0 + 2e-5, " × the declared", fastest)
                .noting(&format!("{:+.1e}", fastest - 1.0))
        })
        .collect()
}

/// Returns the largest ratio of an angle's speed to its declared rate within 300 frames.
fn fastest(jump: Jump, number: usize, hz: f32, settings: &Settings) -> f64 {
    let mut random = fastrand::Rng::with_seed(0xfa_0000 + number as u64);
    let mut scene = Scene::new(NumericRig::like(Gazer::RIG), &random_pose(&mut random), Vec3::ONE);
    if number.is_multiple_of(5) {
        let state = random_state(&scene.rig.rig, &mut random);
        scene.rig.state.joints = state;
    }
    let declared = scene.rig.rig.infos.clone();
    let mut settings = *settings;
    let (mut fastest, mut passing) = (0.0_f64, direction(&mut random));
    for frame in 0_u16..300 {
        let t = f32::from(frame) / hz;
        let swing = (3.0 * t).sin();
        let every = |frames: u16| frame.is_multiple_of(frames);
        let towards = match jump {
            Jump::Behind => bearing(180.0 + 15.0 * swing, 10.0 * (2.3 * t).sin()),
            Jump::Pole => (Vec3::new(0.02 * passing.x, 1.0, 0.0) + 0.8 * swing * Vec3::new(0.3, 0.0, 1.0)).normalize(),
            Jump::Orbit => bearing(if number.is_multiple_of(2) { 150.0 } else { -150.0 } * t, 10.0),
            Jump::Seam => bearing(70.0 * (t % 0.9), 10.0),
            Jump::Teleport | Jump::Weight | Jump::Limits => {
                if every(25) {
                    passing = direction(&mut random);
                }
                passing
            }
        };
        if jump == Jump::Seam && every(50) {
            scene.pose.copy_from_slice(&random_pose(&mut random));
        }
        if jump == Jump::Weight && every(10) {
            settings = settings.with_weight([0.0, 1.0, random.f32()][random.usize(..3)]);
        }
        if jump == Jump::Limits && every(20) {
            for (info, declared) in scene.rig.rig.infos.iter_mut().zip(&declared) {
                let share = random.f32();
                info.heading = declared.heading.map(|range| range.map(|x| share * x));
                info.pitch = declared.pitch.map(|range| range.map(|x| share * x));
            }
        }
        scene.target = EYE_AT_REST + 2.0 * towards;
        fastest = fastest.max(speed(&mut scene, hz, &settings));
    }
    fastest
}

fn speed(scene: &mut Scene<NumericRig>, hz: f32, settings: &Settings) -> f64 {
    let model: Model = scene.model();
    let before = scene.angles(&model);
    scene.step(1.0 / hz, settings);
    let after = scene.angles(&model);
    let speeds =
        model.angles.iter().enumerate().map(|(i, angle)| (after[i] - before[i]).abs() * f64::from(hz) / angle.rate);
    largest(speeds)
}
