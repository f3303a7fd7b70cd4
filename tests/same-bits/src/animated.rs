//! An animated character: sampled, blended, driven by root motion, moved to another clip by inertialisation, and aimed.

use aim::animation::{
    AimChain, BlendLine, BlendPlane, Bone, Clip, Continuity, Control, Corrections, Inertia, Looping, Marks, Mask,
    Method, Motion, Node, Parameter, Phase, Root, RootPath, Skeleton, Track, Transform, Transition, Tree,
};
use aim::glam::{Affine3A, Quat, Vec2, Vec3};
use aim::rotation::product;
use aim::{DynAim, Settings};

use crate::{FRAMES, Fnv, Plain, World};

/// Rotations given as literals, the same on every machine.
const TURNS: [Quat; 4] = [
    Quat::from_xyzw(0.28, 0.0, 0.0, 0.96),
    Quat::from_xyzw(0.0, 0.28, 0.0, 0.96),
    Quat::from_xyzw(0.0, -0.12, 0.16, 0.979_795_9),
    Quat::from_xyzw(-0.1, 0.1, 0.1, 0.984_885_8),
];

fn skeleton() -> Skeleton {
    let bones = [("hips", None, 0), ("spine3", Some(0), 1), ("neck", Some(1), 2), ("left_eye", Some(2), 3)];
    let bone = |(name, parent, turn): (&str, _, usize)| {
        let rest =
            Transform { scale: Vec3::new(1.0, 1.1, 0.9), ..Transform::new(Vec3::new(0.2, 0.5, 0.1), TURNS[turn]) };
        Bone::new(name, parent).with_rest(rest)
    };
    Skeleton::new(bones.map(bone)).unwrap_or_else(|error| unreachable!("{error}"))
}

/// Returns a clip with several kinds of tracks that moves forward along a curve.
fn clip(length: f32, speed: f32, turns: [usize; 3]) -> Option<Clip> {
    let times = [0.0, 0.3, 0.5, 1.0].map(|part| part * length);
    let places = [0.0, 0.4, 0.5, 1.0].map(|part| Vec3::new(part * part, 1.0 + 0.1 * part, part) * speed);
    let [a, b, c] = turns.map(|turn| TURNS[turn]);
    let clip = Clip::new("clip")
        .with_translation(0, Track::linear(times, places).ok()?)
        .with_rotation(0, Track::linear(times, [a, product(b, a), product(c, a), product(b, product(b, a))]).ok()?)
        .with_rotation(2, Track::catmull_rom(times, [a, b, -c, product(a, c)]).ok()?)
        .with_scale(3, Track::catmull_rom(times, places.map(|place| Vec3::ONE + 0.1 * place)).ok()?);
    Some(clip)
}

fn tree(skeleton: &Skeleton, method: Method) -> Option<Tree> {
    let line = Node::line(BlendLine::new([0.0, 1.0]).ok()?, Parameter::Input(0), [Node::source(0), Node::source(1)]);
    let plane = BlendPlane::new([Vec2::ZERO, Vec2::X, Vec2::new(0.2, 1.1)]).ok()?;
    let sources = [0, 1, 0].map(Node::source);
    let plane = Node::plane(plane, [0, 1].map(Parameter::Input), sources);
    let node = line.blend(plane, Parameter::Input(1)).add(Node::source(1), 0.3).with_mask(Mask::subtree(skeleton, 2));
    Some(Tree::new(skeleton, node).ok()?.with_method(method))
}

pub(crate) fn run(world: World) -> u64 {
    // All construction here succeeds; a failure would show as a hash of 0.
    hashed(world).unwrap_or(0)
}

fn hashed(mut world: World) -> Option<u64> {
    let (mut hash, skeleton) = (Fnv::default(), skeleton());
    let clips = [clip(1.0, 1.4, [0, 1, 2])?, clip(0.7, 3.0, [3, 2, 1])?.mended(Continuity::Speed, 0.2)];
    let marks = [Marks::new(1.0, [0.0, 0.5]).ok()?, Marks::new(0.7, [0.1, 0.4]).ok()?];
    let paths = [Root::Bone(0), Root::Shadow { bone: 0, up: Vec3::new(0.6, 0.8, 0.0) }]
        .map(|root| RootPath::new(&clips[0], &skeleton, root, 20.0).ok());
    let [bone, shadow] = [paths[0].as_ref()?, paths[1].as_ref()?];
    let motions = [Motion::linear(shadow), Motion::composite(bone), Motion::variable(shadow)];
    let seam = clips[0].seam();
    [seam.place.rotation_rad, seam.speed.rotation_rad, motions[1].screw().speed_s()]
        .into_iter()
        .for_each(|x| hash.float(x));
    let trees = [Method::Nlerp, Method::Slerp, Method::Log].map(|method| tree(&skeleton, method));
    let mut scratch = trees[0].as_ref()?.scratch();
    let chain = AimChain::named(&skeleton, <Plain as aim::AimRig>::RIG).ok()?;
    let (mut frame, mut aim) = (chain.frame(), DynAim::new(<Plain as aim::AimRig>::RIG));
    let (mut phase, mut control) = (Phase::new(), Control::new().with_looping(Looping::PingPong));
    let (mut place, mut inertia) = (Transform::IDENTITY, Inertia::new(&skeleton));
    let mut shown = [skeleton.rest().to_vec(), skeleton.rest().to_vec()];
    let (mut local, mut model) = (skeleton.rest().to_vec(), [Affine3A::IDENTITY; 4]);
    for number in 0..FRAMES {
        world.pass(number, false);
        let part = |x: f32| (x * 0.1 + 0.5).clamp(0.0, 1.0);
        let inputs = [part(world.target.x), part(world.target.y)];
        let tree = trees[number as usize / 100 % 3].as_ref()?;
        phase.advance(world.dt, &[(&marks[0], 1.0 - inputs[0]), (&marks[1], inputs[0])]);
        let steps = marks.each_ref().map(|marks| phase.step(marks));
        let step = control.advance(world.dt, clips[0].length_s());
        let sample = |source: usize, pose: &mut [Transform]| {
            clips[source].sample(steps[source].to_s(), &mut clips[source].cursor(), pose);
        };
        tree.evaluate(&inputs, &mut scratch, &mut local, sample).ok()?;
        let delta =
            Motion::blend(motions.iter().zip([steps[0], step, steps[0]]).map(|(of, step)| (of.delta(&step), 0.5)));
        place = place.rigid_product(&delta);
        motions[number as usize % 3].remove(steps[0].to_s(), &skeleton, &mut local).ok()?;
        if number % 50 == 0 {
            let [before, now] = [&shown[0][..], &shown[1][..]];
            let next = skeleton.rest();
            inertia.begin(&Transition { shown: [before, now], next: [next, next], dt_s: 0.02, length_s: 0.4 }).ok()?;
            // Return to the origin: far from it, rounding would hide other differences.
            place.translation = Vec3::ZERO;
        }
        inertia.advance(world.dt);
        inertia.apply(&mut local).ok()?;
        shown.swap(0, 1);
        shown[1].copy_from_slice(&local);
        skeleton.to_model(&local, &mut model).ok()?;
        chain.gather(&mut frame, &mut local, &mut model).ok()?;
        let outcome = aim.aim(&frame.pose(), world.target, world.dt, &Settings::default());
        hash.outcome(&outcome);
        chain.apply(&frame, Corrections::from(&aim), &mut local, &mut model).ok()?;
        hash.turns(&[place.rotation]);
        for bone in &local {
            hash.turns(&[bone.rotation]);
            bone.translation.to_array().into_iter().chain(bone.scale.to_array()).for_each(|x| hash.float(x));
        }
        place.translation.to_array().into_iter().for_each(|x| hash.float(x));
        model[3].to_cols_array().into_iter().for_each(|x| hash.float(x));
    }
    Some(hash.0)
}
