//! A character walks over bumps, aims a rifle and its gaze at a moving target, and is shot: `rifle [OUT.glb]`.
use aim::glam::{Affine3A, Quat, Vec3};
use aim::{AimRig, Joint, animation::*};
use aim_character::{Mannequin, PAPER_AXES};
use aim_gltf::{Document, write_file};

#[derive(AimRig)]
#[aim(axes(up = +X, forward = +Y, left = +Z), effector(forward = +Y, origin = (0.01, 0.75, -0.1)))]
struct Barrel {
    #[joint(heading = -40deg..=40deg, pitch = -25deg..=25deg, rate = 180deg)]
    spine3: Joint,
}
#[derive(AimRig)]
#[aim(axes(up = +X, forward = +Y, left = +Z), effector(forward = +Y, origin = (0.06, 0.09, 0.0)))]
struct Gaze {
    #[joint(role = head, heading = -60deg..=60deg, pitch = -40deg..=40deg, rate = 200deg)]
    head: Joint,
}

fn bumps(at: Vec3) -> Ground {
    let wave = 2.5 * at.z + at.x;
    Ground::new(at.with_y(0.06 * wave.sin()), Vec3::new(-0.06 * wave.cos(), 1.0, -0.15 * wave.cos()))
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let document = Document::from_bytes(&Mannequin::new().with_moves().glb(|_| PAPER_AXES)?)?;
    let (skeleton, (mesh, skin)): (&Skeleton, _) = (document.skeleton(), document.surface().mesh(document.skeleton()));
    let bone = |name: &str| skeleton.find(name).expect("a bone of the mannequin");
    let limb = |side: &str, bones: [&str; 3]| bones.map(|name| bone(&format!("{side}_{name}")));
    let (hips, chest, hand) = (bone("hips"), bone("spine3"), bone("right_hand"));
    // Events mark when the ball of each foot lands and lifts. The clip's root motion moves the character's place.
    let walk = document.clip("walk_ahead")?.clone().with_event(0.121, "left down")?.with_event(0.682, "left up")?;
    let walk = walk.with_event(0.671, "right down")?.with_event(0.132, "right up")?;
    let way = RootPath::new(&walk, skeleton, Root::Shadow { bone: hips, up: Vec3::Y }, 60.0)?;
    let model = Model::new(skeleton.clone(), [walk]).with_motion(0, Motion::linear(&way));
    let (mut figure, mut hero) = (Figure::new(skeleton.clone()), Instance::new(&model));
    hero.play(ClipControl::new(0));
    let leg = |side| limb(side, ["upper_leg", "lower_leg", "foot"]);
    let left = Plant::new(skeleton, leg("left"), Vec3::new(0.1, 0.0, 0.09))?.with_events("left down", "left up");
    let right = Plant::new(skeleton, leg("right"), Vec3::new(-0.1, 0.0, 0.09))?.with_events("right down", "right up");
    let mut feet = Stance::new(skeleton, hips, [left, right])?;
    let arm = |side| LimbLayer::new(skeleton, limb(side, ["upper_arm", "lower_arm", "hand"]));
    let before_chest = TipTarget::bone(chest, Vec3::new(-0.05, 0.2, -0.1));
    let mut right = arm("right")?.with_target(before_chest.with_rotation(Quat::from_rotation_z(-90_f32.to_radians())));
    let mut left =
        arm("left")?.with_target(TipTarget::bone(hand, Vec3::new(-0.2, 0.0, 0.06)).with_rotation(Quat::IDENTITY));
    let mut barrel = AimLayer::new(AimChain::named(skeleton, Barrel::RIG)?, Barrel::RIG);
    let mut gaze = AimLayer::new(AimChain::named(skeleton, Gaze::RIG)?, Gaze::RIG);
    let (mut frames, times): (_, Vec<f32>) = (vec![], (0..=240_u16).map(|number| f32::from(number) / 60.0).collect());
    for time in &times {
        hero.advance(&model, 1.0 / 60.0);
        hero.place.translation = bumps(hero.place.translation).point;
        hero.events(&model).for_each(|(_, event)| feet.on_event(&event.name));
        barrel.target = hero.place.translation + Vec3::new(3.0 * time.sin(), 1.3 + 0.6 * time.cos(), 8.0);
        gaze.target = barrel.target;
        let walk = &mut hero.layer(&model);
        figure.run(1.0 / 60.0, &mut [walk, &mut feet.on(bumps), &mut barrel, &mut gaze, &mut right, &mut left])?;
        let held = figure.world(hand).ok_or("no hand")?;
        let to_target = barrel.target - held.transform_point3(Vec3::new(-0.55, 0.06, 0.0));
        let aside = to_target.reject_from(held.transform_vector3(Vec3::NEG_X)).length();
        assert!(*time < 0.5 || aside < 0.03, "the barrel's line passes the target by {aside} m at {time} s");
        assert!(right.error() < 1e-4 && left.error() < 1e-4, "a hand misses the rifle at {time} s");
        assert!(feet.feet().iter().all(|foot| foot.slip(&figure) < 1e-3), "a foot slips at {time} s");
        frames.push((hero.place, figure.local().to_vec()));
    }
    // A shot at the chest from its left, in model space.
    let mut matrices = vec![Affine3A::IDENTITY; skin.len()];
    skin.matrices(figure.model(), &mut matrices)?;
    let chest = Vec3::from(figure.model()[chest].translation);
    let shot = Ray::segment(chest + 3.0 * Vec3::X, chest);
    let hit = BoneBoxes::new(&mesh, &skin)?.hit(&mesh, &MeshPose::new(&matrices), &shot)?.ok_or("it misses")?;
    println!("hit on {}, {:.2} m from the middle of the chest", skeleton.names()[hit.bone], hit.point.distance(chest));
    let ways: Vec<Vec3> = frames.iter().map(|(place, local)| place.rigid_product(&local[hips]).translation).collect();
    let mut clip = Clip::new("rifle").with_translation(hips, Track::linear(&*times, ways)?);
    for bone in 0..skeleton.len() {
        let turns: Vec<Quat> = frames.iter().map(|(_, local)| local[bone].rotation).collect();
        clip = clip.with_rotation(bone, Track::linear(&*times, turns)?);
    }
    std::env::args().nth(1).map_or(Ok(()), |path| Ok(write_file(path, &document.with_clips(&[clip])?)?))
}
