//! A character made in code walks, then runs, driven by root motion, and looks at a lamp as it passes.
use aim::glam::{Affine3A, Quat, Vec3};
use aim::{AimRig, DynAim, Joint, Settings, Status, animation::*};

#[derive(AimRig)]
#[aim(axes(up = +Y, forward = +Z, left = +X))]
struct Walker {
    #[joint(role = head, heading = -70deg..=70deg, pitch = -40deg..=40deg, rate = 200deg)]
    head: Joint,
    #[joint(role = chest, heading = -30deg..=30deg, pitch = -15deg..=15deg, rate = 70deg)]
    chest: Joint,
}

/// Makes a gait cycle of two steps: the hips bob and move forward at `speed` m/s, the chest swings.
fn gait(length_s: f32, speed: f32, swing_rad: f32) -> Result<Clip, TrackError> {
    let times: Vec<f32> = (0..=24_u8).map(|key| length_s * f32::from(key) / 24.0).collect();
    let phase = |time: &f32| std::f32::consts::TAU * time / length_s;
    let hips = times.iter().map(|time| Vec3::new(0.0, 0.9 + 0.03 * (2.0 * phase(time)).sin(), speed * time));
    let chest = times.iter().map(|time| Quat::from_rotation_y(swing_rad * phase(time).sin()));
    let hips = Track::linear(times.clone(), hips.collect::<Vec<_>>())?;
    let chest = Track::linear(&times[..], chest.collect::<Vec<_>>())?;
    Ok(Clip::new("gait").with_translation(0, hips).with_rotation(1, chest))
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let bone = |name, parent, y| Bone::new(name, parent).with_rest(Transform::from_translation(Vec3::Y * y));
    let skeleton = Skeleton::new([bone("hips", None, 0.9), bone("chest", Some(0), 0.4), bone("head", Some(1), 0.4)])?;
    let (clips, shadow) = ([gait(1.0, 1.4, 0.1)?, gait(0.7, 4.2, 0.2)?], Root::Shadow { bone: 0, up: Vec3::Y });
    let marks = [Marks::new(1.0, [0.0, 0.5])?, Marks::new(0.7, [0.0, 0.35])?];
    let motion = |clip| RootPath::new(clip, &skeleton, shadow, 60.0).map(|path| Motion::linear(&path));
    let motions = [motion(&clips[0])?, motion(&clips[1])?];
    let on_the_spot = [0, 1].map(|gait| motions[gait].removed_from(&clips[gait], &skeleton, 60.0));
    let gaits = Node::line(BlendLine::new([1.4, 4.2])?, Parameter::Input(0), [Node::source(0), Node::source(1)]);
    let (tree, chain) = (Tree::new(&skeleton, gaits)?, AimChain::named(&skeleton, Walker::RIG)?);
    // Per character: buffers, phase in the gait cycle, place in the world, and the state of the gaze.
    let (mut scratch, mut cursors, mut frame) = (tree.scratch(), clips.each_ref().map(Clip::cursor), chain.frame());
    let (mut phase, mut place, mut gaze) = (Phase::new(), Transform::IDENTITY, DynAim::new(Walker::RIG));
    let (mut local, mut model, mut shares) = (skeleton.rest().to_vec(), vec![Affine3A::IDENTITY; 3], [0.0; 2]);
    for number in 0..=300_u16 {
        let (speed, dt) = (1.4 + 2.8 * f32::from(number) / 300.0, 1.0 / 60.0);
        tree.shares(0, &[speed], &mut scratch, &mut shares)?;
        phase.advance(dt, &[(&marks[0], shares[0]), (&marks[1], shares[1])]);
        let steps = marks.each_ref().map(|marks| phase.step(marks));
        let delta = |gait: usize| (motions[gait].delta(&steps[gait]), shares[gait]);
        place = place.rigid_product(&Motion::blend([0, 1].map(delta)));
        tree.evaluate(&[speed], &mut scratch, &mut local, |gait, pose| {
            on_the_spot[gait].sample(steps[gait].to_s(), &mut cursors[gait], pose);
        })?;
        skeleton.to_model(&local, &mut model)?;
        frame.place = place.to_affine();
        chain.gather(&mut frame, &mut local, &mut model)?;
        let outcome = gaze.aim(&frame.pose(), Vec3::new(4.0, 2.5, 12.0), dt, &Settings::default());
        chain.apply(&frame, (&gaze).into(), &mut local, &mut model)?;
        if number % 60 == 0 {
            println!("{speed:.2} m/s, {:5.2} m on, gaze {:?}", place.translation.z, outcome.status);
        }
        assert!(number != 120 || outcome.status == Status::Reached, "it looks at the lamp: {outcome:?}");
    }
    Ok(())
}
