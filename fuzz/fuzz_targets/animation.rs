//! Skeletons, tracks, clips, blend trees and meshes from arbitrary numbers. Accepted ones can be edited, played,
//! blended and taken apart, and give poses with unit rotations.
#![no_main]

use aim_animation::glam::{Affine3A, Quat, Vec2, Vec3};
use aim_animation::{
    BezierKey, BlendLine, BlendPlane, Bone, BoneBoxes, Clip, Continuity, Control, HermiteKey, Influence, Looping, Mask,
    Mesh, MeshPose, Morph, Motion, Node, PackedClip, Parameter, Ray, Reduction, Root, RootPath, Skeleton, Skin, Track,
    TrackError, Transform, Tree, Value,
};
use libfuzzer_sys::arbitrary::{Result, Unstructured};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    // A short input ends early; the checks up to there have been made.
    let _ = animate(&mut Unstructured::new(bytes));
    let _ = store(&mut Unstructured::new(bytes));
    unpack(bytes);
    let _ = deform(&mut Unstructured::new(bytes));
});

fn animate(input: &mut Unstructured<'_>) -> Result<()> {
    let mut bones = Vec::new();
    for _ in 0..input.int_in_range(1..=6)? {
        let parent = input.arbitrary::<Option<u8>>()?.map(|parent| usize::from(parent % 8));
        let rest = if input.arbitrary()? { transform(input)? } else { Transform::IDENTITY };
        bones.push(Bone::new("bone", parent).with_rest(rest));
    }
    let Ok(skeleton) = Skeleton::new(bones) else { return Ok(()) };
    let clips = [clip(input)?, clip(input)?];
    let tree = Tree::new(&skeleton, node(input, &skeleton, 4)?);

    let mut controls = [Control::new(), Control::new()];
    for control in &mut controls {
        *control = control.clone().with_looping(*input.choose(&[Looping::Once, Looping::Repeat, Looping::PingPong])?);
    }
    let mut cursors = clips.each_ref().map(Clip::cursor);
    let root = if input.arbitrary()? { Root::Bone(0) } else { Root::Shadow { bone: 0, up: vector(input)? } };
    let motions = RootPath::new(&clips[0], &skeleton, root, 10.0)
        .map(|path| [Motion::linear(&path), Motion::composite(&path), Motion::variable(&path)]);
    let mut scratch = tree.as_ref().map(Tree::scratch);
    let mut pose = skeleton.rest().to_vec();
    for _ in 0..input.int_in_range(1..=4)? {
        let dt_s = number(input)?;
        let mut times = [0.0; 2];
        for ((control, clip), time_s) in controls.iter_mut().zip(&clips).zip(&mut times) {
            control.speed = number(input)?;
            let step = control.advance(dt_s, clip.length_s());
            assert!((0.0..=clip.length_s()).contains(&control.time_s()), "{control:?}");
            clip.events_passed(&step).take(20).for_each(drop);
            for motion in motions.iter().flatten() {
                for moved in [motion.delta(&step), motion.at(dt_s)] {
                    assert!(moved.is_sound(), "{moved:?} of {motion:?}");
                }
            }
            *time_s = control.time_s();
        }
        let (Ok(tree), Ok(scratch)) = (&tree, &mut scratch) else { continue };
        let inputs = [number(input)?, number(input)?];
        let sample = |source: usize, pose: &mut [Transform]| {
            clips[source % 2].sample(times[source % 2], &mut cursors[source % 2], pose);
        };
        tree.evaluate(&inputs, scratch, &mut pose, sample).expect("the scratch is this tree's");
        assert!(pose.iter().all(|bone| bone.rotation.is_normalized()), "{pose:?} by {tree:?}");
    }
    Ok(())
}

/// A value of a track that can be read from the input and checked.
trait Sampled: Value {
    fn read(input: &mut Unstructured<'_>) -> Result<Self>;
    fn is_sound(self) -> bool;
}

impl Sampled for f32 {
    fn read(input: &mut Unstructured<'_>) -> Result<Self> {
        number(input)
    }
    fn is_sound(self) -> bool {
        self.is_finite()
    }
}

impl Sampled for Vec3 {
    fn read(input: &mut Unstructured<'_>) -> Result<Self> {
        vector(input)
    }
    fn is_sound(self) -> bool {
        self.is_finite()
    }
}

impl Sampled for Quat {
    fn read(input: &mut Unstructured<'_>) -> Result<Self> {
        Ok(Quat::from_array(numbers(input)?))
    }
    fn is_sound(self) -> bool {
        self.is_normalized()
    }
}

fn number(input: &mut Unstructured<'_>) -> Result<f32> {
    // Mostly ordinary numbers, sometimes any bit pattern.
    Ok(if input.ratio(3, 4)? {
        f32::from(input.arbitrary::<i16>()?) / 1024.0
    } else {
        f32::from_bits(input.arbitrary()?)
    })
}

fn numbers<const N: usize>(input: &mut Unstructured<'_>) -> Result<[f32; N]> {
    let mut numbers = [0.0; N];
    for place in &mut numbers {
        *place = number(input)?;
    }
    Ok(numbers)
}

fn vector(input: &mut Unstructured<'_>) -> Result<Vec3> {
    Ok(Vec3::from_array(numbers(input)?))
}

fn transform(input: &mut Unstructured<'_>) -> Result<Transform> {
    let rotation = Quat::read(input)?.normalize();
    Ok(Transform { translation: vector(input)?, rotation, scale: vector(input)? })
}

fn clip(input: &mut Unstructured<'_>) -> Result<Clip> {
    let mut clip = Clip::new("clip");
    for bone in 0..input.int_in_range(0..=3)? {
        if let Some(track) = track(input)? {
            clip = clip.with_translation(bone, track);
        }
        if let Some(track) = track(input)? {
            clip = clip.with_rotation(bone, track);
        }
        if let Some(track) = track(input)? {
            clip = clip.with_scale(bone, track);
        }
    }
    if let Some(track) = track(input)? {
        clip = clip.with_scalar(0, track);
    }
    if let Ok(with_event) = clip.clone().with_event(number(input)?, "event") {
        clip = with_event;
    }
    Ok(match input.int_in_range(0..=5)? {
        0 => clip.cut(number(input)?, number(input)?),
        1 => clip.reversed(),
        2 => clip.mended(Continuity::Place, number(input)?),
        3 => clip.mended(Continuity::Speed, number(input)?),
        4 if clip.length_s() < 100.0 => clip.resampled(10.0),
        _ => clip,
    })
}

/// Reads a track; if it is accepted, every sample of it must be finite.
fn track<T: Sampled>(input: &mut Unstructured<'_>) -> Result<Option<Track<T>>> {
    let (mut times, mut values) = (Vec::new(), Vec::new());
    let (mut hermite, mut bezier) = (Vec::new(), Vec::new());
    for _ in 0..input.int_in_range(0..=4)? {
        let from = times.last().copied().unwrap_or(0.0);
        times.push(if input.ratio(7, 8)? { from + number(input)?.abs() } else { number(input)? });
        let around = [T::read(input)?, T::read(input)?, T::read(input)?];
        values.push(around[1]);
        hermite.push(HermiteKey { into: around[0], value: around[1], out: around[2] });
        bezier.push(BezierKey { before: around[0], value: around[1], after: around[2] });
    }
    let made: std::result::Result<_, TrackError> = match input.int_in_range(0..=4)? {
        0 => Track::step(times, values),
        1 => Track::linear(times, values),
        2 => Track::catmull_rom(times, values),
        3 => Track::hermite(times, &hermite),
        _ => Track::bezier(times, &bezier),
    };
    let Ok(track) = made else { return Ok(None) };
    for at in [number(input)?, 0.0, 0.5 * track.end_s(), track.end_s(), f32::NAN] {
        assert!(track.sample(at).is_sound(), "{track:?} at {at}");
    }
    Ok(Some(track))
}

fn node(input: &mut Unstructured<'_>, skeleton: &Skeleton, depth: usize) -> Result<Node> {
    if depth == 0 || input.ratio(1, 3)? {
        return Ok(Node::source(input.int_in_range(0..=3)?));
    }
    let mut inner = || node(input, skeleton, depth - 1);
    let (one, other, third) = (inner()?, inner()?, inner()?);
    let at = [0, 1].map(Parameter::Input);
    let made = match input.int_in_range(0..=5)? {
        0 => Node::sum([(one, at[0]), (other, at[1]), (third, number(input)?.into())]),
        1 => match BlendLine::new(numbers::<3>(input)?) {
            Ok(line) => Node::line(line, at[0], [one, other, third]),
            Err(_) => one,
        },
        2 => match BlendPlane::new(numbers::<6>(input)?.chunks(2).map(Vec2::from_slice).collect::<Vec<_>>()) {
            Ok(plane) => Node::plane(plane, at, [one, other, third]),
            Err(_) => one,
        },
        3 => one.add(other, at[0]),
        _ => one.blend(other, at[1]),
    };
    Ok(if input.arbitrary()? { made.with_mask(Mask::new(skeleton, number(input)?)) } else { made })
}

/// Reduces and packs a clip: the errors are within the tolerance, and the bytes read back as the same clip.
fn store(input: &mut Unstructured<'_>) -> Result<()> {
    let mut bones = Vec::new();
    for bone in 0..input.int_in_range(1..=4_usize)? {
        bones.push(Bone::new("bone", bone.checked_sub(1)).with_rest(transform(input)?));
    }
    let Ok(skeleton) = Skeleton::new(bones) else { return Ok(()) };
    let clip = clip(input)?;
    let tolerance = number(input)?;
    let reduction = Reduction::new(tolerance).with_pins([number(input)?]);
    let Ok(reduced) = reduction.reduce(&clip, &skeleton) else { return Ok(()) };
    assert!(reduced.error <= tolerance, "{reduced:?} at {tolerance}");
    let Ok(packed) = reduction.pack(&clip, &skeleton) else { return Ok(()) };
    assert!(packed.error <= tolerance, "{packed:?} at {tolerance}");
    assert_eq!(PackedClip::from_bytes(&packed.clip.to_bytes()).as_ref(), Ok(&packed.clip));
    unpack(&packed.clip.to_bytes());
    Ok(())
}

/// Reads arbitrary bytes as a packed clip: they are refused, or every sample is sound.
fn unpack(bytes: &[u8]) {
    let Ok(packed) = PackedClip::from_bytes(bytes) else { return };
    let mut pose = [Transform::IDENTITY; 4];
    for at in [f32::NAN, 0.0, 0.3 * packed.length_s(), packed.length_s()] {
        packed.sample(at, &mut packed.cursor(), &mut pose);
        assert!(pose.iter().all(Transform::is_sound), "{pose:?} at {at}");
    }
}
/// Deforms a mesh of arbitrary numbers in an arbitrary pose: every vertex lies in its boxes, and a ray hits the same
/// triangle as with the deformed mesh on a single bone.
fn deform(input: &mut Unstructured<'_>) -> Result<()> {
    let skeleton =
        Skeleton::new([Bone::new("a", None), Bone::new("b", None), Bone::new("c", None)]).expect("no parents");
    let affine =
        |input: &mut Unstructured<'_>| -> Result<Affine3A> { Ok(Affine3A::from_cols_array(&numbers::<12>(input)?)) };
    let rest = [affine(input)?, affine(input)?, affine(input)?];
    let Ok(skin) = Skin::with_inverse_rest(&skeleton, [0, 1, 2], rest) else { return Ok(()) };
    let (mut positions, mut influences, mut triangles, mut morphs) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    for vertex in 0..input.int_in_range(1..=6_u32)? {
        positions.push(vector(input)?);
        let mut joints = Vec::new();
        for _ in 0..input.int_in_range(1..=4)? {
            joints.push(Influence::new(input.int_in_range(0..=3)?, number(input)?));
        }
        influences.push(joints);
        triangles.push([0; 3].map(|_| input.int_in_range(0..=vertex).unwrap_or(0)));
        if input.arbitrary()? {
            morphs.push(Morph { target: 0, vertex, position: vector(input)?, normal: vector(input)? });
        }
    }
    let normals = positions.clone();
    let mesh =
        Mesh::new(positions, triangles, &influences).and_then(|mesh| mesh.with_normals(normals)?.with_morphs(morphs));
    let Ok(mesh) = mesh else { return Ok(()) };
    let Ok(boxes) = BoneBoxes::new(&mesh, &skin) else { return Ok(()) };
    let (matrices, weights) = ([affine(input)?, affine(input)?, affine(input)?], numbers::<1>(input)?);
    let pose = MeshPose::new(&matrices).with_morph_weights(&weights);
    let mut placed = vec![Vec3::ZERO; mesh.positions().len()];
    mesh.deform_normals(&pose, 2, &mut placed).expect("it has normals");
    assert!(placed.iter().all(|normal| *normal == Vec3::ZERO || normal.is_normalized()), "{placed:?}");
    mesh.deform(&pose, &mut placed).expect("the lengths are right");
    let whole = boxes.whole(&pose).expect("the lengths are right").expect("there are vertices");
    for vertex in placed.iter().filter(|vertex| vertex.is_finite()) {
        assert!(whole.contains(*vertex), "{vertex} of {mesh:?} is outside {whole:?}");
    }
    let ray = Ray { end: number(input)?, ..Ray::new(vector(input)?, vector(input)?) };
    let hit = boxes.hit(&mesh, &pose, &ray).expect("it is the boxes' mesh");
    // The deformed mesh, rigidly bound to one bone at rest.
    if placed.iter().all(|vertex| vertex.is_finite()) {
        let rigid = vec![[Influence::new(0, 1.0)]; placed.len()];
        let other = Mesh::new(placed, mesh.triangles(), &rigid).expect("it is a mesh");
        let boxes = BoneBoxes::new(&other, &skin).expect("there is such a joint");
        let again = boxes.hit(&other, &MeshPose::new(&[Affine3A::IDENTITY]), &ray).expect("it is the boxes' mesh");
        assert_eq!(
            hit.map(|hit| (hit.triangle, hit.part)),
            again.map(|hit| (hit.triangle, hit.part)),
            "{ray:?} at {mesh:?}"
        );
    }
    Ok(())
}
