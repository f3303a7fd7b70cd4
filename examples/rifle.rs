//! A character walks over bumps with a rifle in both hands, aims it and its gaze at a target that moves, and is hit by a ray; written as
//! a clip if a file is named: `rifle OUT.glb`.
use aim::animation::*;
use aim::glam::{Affine3A, Quat, Vec3};
use aim::ik::TwoBone;
use aim::{AimRig, Joint, Status};
use aim_character::{Mannequin, PAPER_AXES};
use aim_gltf::{Document, write_file};

/// The barrel runs along the right hand's forward; its muzzle is 55 cm ahead of the wrist and 6 cm above it.
#[derive(AimRig)]
#[aim(axes(up = +X, forward = +Y, left = +Z), effector(forward = +Y, origin = (0.06, 0.55, 0.0)))]
struct Barrel {
    #[joint(heading = -20deg..=20deg, pitch = -20deg..=20deg, rate = 180deg, stiffness = 4.0)]
    right_hand: Joint,
    #[joint(heading = -40deg..=40deg, pitch = -25deg..=25deg, rate = 180deg)]
    spine3: Joint,
    #[joint(heading = -25deg..=25deg, pitch = -15deg..=15deg, rate = 120deg, stiffness = 2.0)]
    spine1: Joint,
}
#[derive(AimRig)]
#[aim(axes(up = +X, forward = +Y, left = +Z), effector(forward = +Y, origin = (0.06, 0.09, 0.0)))]
struct Gaze {
    #[joint(role = head, heading = -60deg..=60deg, pitch = -40deg..=40deg, rate = 200deg)]
    head: Joint,
    #[joint(role = neck, heading = -30deg..=30deg, pitch = -20deg..=20deg, rate = 120deg)]
    neck: Joint,
}
const FORE_GRIP: Vec3 = Vec3::new(0.0, 0.2, 0.06);

fn bumps(at: Vec3) -> Ground {
    let (x, z) = (4.0 * at.x + 1.3 * at.z, 2.5 * at.z);
    let slope = Vec3::new(-0.12 * x.cos(), 1.0, -0.039 * x.cos() - 0.125 * z.cos());
    Ground::new(at.with_y(0.05 * z.sin() + 0.03 * x.sin()), slope)
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let document = Document::from_bytes(&Mannequin::new().with_moves().glb(|_| PAPER_AXES)?)?;
    let skeleton: &Skeleton = document.skeleton();
    let [hips, chest, hand] = ["hips", "spine3", "right_hand"].map(|name| skeleton.find(name).expect("a bone"));
    let limb =
        |side: &str, bones: [&str; 3]| bones.map(|bone| skeleton.find(&format!("{side}_{bone}")).expect("a bone"));
    let (leg, arm) = (["upper_leg", "lower_leg", "foot"], ["upper_arm", "lower_arm", "hand"]);
    // The clip, with the times at which the balls of its feet come down and leave; what moves it is made the place's.
    let walk = document.clip("walk_ahead")?.clone().with_event(0.121, "left down")?.with_event(0.682, "left up")?;
    let walk = walk.with_event(0.671, "right down")?.with_event(0.132, "right up")?;
    let way = RootPath::new(&walk, skeleton, Root::Shadow { bone: hips, up: Vec3::Y }, 60.0)?;
    let model = Model::new(skeleton.clone(), [walk]).with_motion(0, Motion::linear(&way));
    // Of each character: its pose, what it plays, and its layers.
    let (mut figure, mut hero) = (Figure::new(skeleton.clone()), Instance::new(&model));
    hero.play(ClipControl::new(0));
    let foot = |side: &str, ball: Vec3| {
        Plant::new(skeleton, limb(side, leg), ball)
            .map(|foot| foot.with_events(format!("{side} down"), format!("{side} up")))
    };
    let feet = [foot("left", Vec3::new(0.1, 0.0, 0.09))?, foot("right", Vec3::new(-0.1, 0.0, 0.09))?];
    let mut stance = Stance::new(skeleton, hips, feet)?;
    let elbow = |x: f32| TwoBone::new().with_pole(Vec3::new(x, 0.4, -0.2));
    let mut right = LimbLayer::new(skeleton, limb("right", arm))?.with_two_bone(elbow(-0.7));
    right.set_target(TipTarget::bone(chest, Vec3::new(-0.05, 0.2, -0.1)).with_rotation(Quat::IDENTITY));
    let mut left = LimbLayer::new(skeleton, limb("left", arm))?.with_two_bone(elbow(0.6));
    left.set_target(TipTarget::bone(hand, FORE_GRIP));
    let mut barrel = AimLayer::new(AimChain::named(skeleton, Barrel::RIG)?, Barrel::RIG);
    let mut gaze = AimLayer::new(AimChain::named(skeleton, Gaze::RIG)?, Gaze::RIG);
    let mut recoil = Recoil::new(skeleton, limb("right", arm), Affine3A::IDENTITY)?;
    let (surface, dt, mut clip, mut times) = (document.surface(), 1.0 / 60.0, Clip::new("rifle"), vec![]);
    let mut keys = vec![Vec::<Transform>::new(); skeleton.len()];
    for number in 0..=240_u16 {
        let time = f32::from(number) * dt;
        hero.advance(&model, dt);
        hero.place.translation = bumps(hero.place.translation).point;
        hero.events(&model).for_each(|(_, event)| stance.on_event(&event.name));
        barrel.target =
            hero.place.translation + Vec3::new(3.0 * (0.7 * time).sin(), 1.3 + 0.6 * (0.9 * time).sin(), 8.0);
        gaze.target = barrel.target;
        if number % 60 == 50 {
            recoil.kick(Vec3::new(0.0, -1.5, 0.0), Vec3::new(0.0, 0.0, 3.0));
        }
        let (walk, feet) = (&mut hero.layer(&model), &mut stance.on(bumps));
        figure.run(dt, &mut [walk, feet, &mut right, &mut barrel, &mut gaze, &mut recoil, &mut left])?;
    }
    Ok(())
}
