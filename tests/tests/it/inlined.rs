//! `Aim::aim_inlined` equals `Aim::aim` bit for bit, in frames that its own code handles and in those that it passes
//! on.

use aim::glam::{Affine3A, Quat, Vec3};
use aim::rigs::{Mannequin, Mixamo, Rigify, Rocketbox, Thug, Turret, UnrealMannequin, Vrm};
use aim::{Aim, AimRig, Joint, Pose, Settings, Solver, Target};

/// A rig of the eye alone, which has its own specialisation.
#[derive(AimRig)]
#[aim(axes(up = +X, forward = +Y, left = +Z))]
struct Eye {
    #[joint(role = eye, heading = -35deg..=35deg, pitch = -25deg..=25deg, rate = 450deg)]
    eye: Joint,
}

/// Returns a pose of stacked bones that nod a little from frame to frame.
fn pose<R: AimRig>(frame: u16) -> Pose<R::Array<Affine3A>> {
    let mut joints = R::array(Affine3A::IDENTITY);
    let count = joints.as_ref().len();
    for (index, joint) in joints.as_mut().iter_mut().enumerate() {
        let height = Vec3::Y * (0.2 * (count - index) as f32);
        let nod = Quat::from_rotation_x(0.02 * (0.1 * f32::from(frame) + index as f32).sin());
        *joint = Affine3A::from_rotation_translation(nod, height);
    }
    Pose::new(joints)
}

fn compare<R: AimRig>() {
    const DT: f32 = 1.0 / 60.0;
    let first = R::RIG.description().joints()[0];
    let (forward, left) = (Vec3::from(first.axes().forward), Vec3::from(first.axes().left));
    for solver in [None, Some(Solver::Exact), Some(Solver::Natural), Some(Solver::Ascent)] {
        let mut settings = Settings::default();
        settings.solver = solver;
        let [mut called, mut inlined] = [Aim::<R>::new(); 2];
        for frame in 0..240 {
            let pose = pose::<R>(frame);
            // Targets ahead for two thirds of the time, then round to behind.
            let side = 0.4 * (0.05 * f32::from(frame)).sin() + if frame > 160 { 2.5 } else { 0.0 };
            let target = (forward * side.cos() + left * side.sin()) * 3.0 + Vec3::Y * 0.3;
            let weighted = [Target::new(target, 1.0), Target::new(target + left, 0.5)];
            let aimed = if frame % 50 == 49 {
                [called.aim(&pose, &weighted, DT, &settings), inlined.aim_inlined(&pose, &weighted, DT, &settings)]
            } else {
                [called.aim(&pose, target, DT, &settings), inlined.aim_inlined(&pose, target, DT, &settings)]
            };
            let [a, b] = aimed.map(|aimed| {
                let turns: Vec<_> =
                    aimed.corrections.as_ref().iter().map(|turn| turn.to_array().map(f32::to_bits)).collect();
                (aimed.outcome, turns)
            });
            assert!(a == b && called == inlined, "{:?}, frame {frame}, {solver:?}: {a:?}, {b:?}", R::RIG.joint_name(0));
        }
    }
}

#[test]
fn the_same_bits() {
    compare::<Eye>();
    compare::<Mannequin>();
    compare::<Mixamo>();
    compare::<Rigify>();
    compare::<Rocketbox>();
    compare::<Thug>();
    compare::<Turret>();
    compare::<UnrealMannequin>();
    compare::<Vrm>();
}
