//! A glTF character walks, then runs, driven by root motion, and looks at a lamp; the result is written as a clip:
//! `walk_to_run_of_a_file IN.glb WALK RUN OUT.glb`. The example `mannequin` of `aim-character` writes an IN.glb.
use aim::glam::Affine3A;
use aim::{DynAim, Settings, Status, animation::*};
use aim_character::{InterpretedRig, Measurement, Role, chain_nodes, propose};
use aim_gltf::{Document, write_file};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let [input, walk, run, output] = &words[..] else { return Err("give IN.glb WALK RUN OUT.glb".into()) };
    // Measure the character's up axis and hips, and propose a rig: an eye, head, neck and spine with axes and limits.
    let document = Document::load(input)?;
    let (measured, skeleton) = (Measurement::of(&document), document.skeleton());
    let spec = propose(&document, &measured, None)?.spec;
    let (nodes, rig) = (chain_nodes(&spec, skeleton)?, InterpretedRig::new(&spec));
    let chain = AimChain::new(skeleton, nodes.joints)?;
    let chain = if let Some(eye) = nodes.other_eye { chain.with_following_eye(eye)? } else { chain };
    // Each gait's root motion, at constant velocity. Marks: one foot at the start of the cycle, the other one half-way.
    let clips = [document.clip(walk)?, document.clip(run)?];
    let (bone, up) = (measured.with_role(Role::Hips).ok_or("no hips are found")?.node, measured.up.as_vec3());
    let motion = |clip| RootPath::new(clip, skeleton, Root::Shadow { bone, up }, 60.0).map(|way| Motion::linear(&way));
    let (motions, lengths) = ([motion(clips[0])?, motion(clips[1])?], clips.map(Clip::length_s));
    let marks = [Marks::new(lengths[0], [0.0, lengths[0] / 2.0])?, Marks::new(lengths[1], [0.0, lengths[1] / 2.0])?];
    let speeds = motions.each_ref().map(|motion| motion.screw().speed_s());
    let tree = Tree::new(skeleton, Node::line(BlendLine::new(speeds)?, Parameter::Input(0), [0, 1].map(Node::source)))?;
    // Per character: buffers, phase in the gait cycle, place in the world, and the state of the gaze.
    let (mut scratch, mut cursors, mut frame) = (tree.scratch(), clips.map(Clip::cursor), chain.frame());
    let (mut phase, mut place, mut gaze) = (Phase::new(), Transform::IDENTITY, DynAim::new(rig));
    let (mut local, mut model) = (skeleton.rest().to_vec(), vec![Affine3A::IDENTITY; skeleton.len()]);
    let (mut shares, mut times, mut clip, mut reached) = ([0.0; 2], vec![], Clip::new("walk_to_run"), 0);
    let mut keys = vec![Vec::<Transform>::new(); skeleton.len()];
    let lamp = ((measured.left * 1.5 + measured.up * 1.9 + measured.forward * 9.0) * measured.metre()).as_vec3();
    for number in 0..=300_u16 {
        let (dt, speed) = (1.0 / 60.0, speeds[0] + (speeds[1] - speeds[0]) * f32::from(number) / 300.0);
        tree.shares(0, &[speed], &mut scratch, &mut shares)?;
        phase.advance(dt, &[(&marks[0], shares[0]), (&marks[1], shares[1])]);
        let steps = marks.each_ref().map(|marks| phase.step(marks));
        place = place.rigid_product(&Motion::blend([0, 1].map(|of| (motions[of].delta(&steps[of]), shares[of]))));
        tree.evaluate(&[speed], &mut scratch, &mut local, |gait, pose| {
            clips[gait].sample(steps[gait].to_s(), &mut cursors[gait], pose);
            motions[gait].remove(steps[gait].to_s(), skeleton, pose).expect("as long as the skeleton");
        })?;
        skeleton.to_model(&local, &mut model)?;
        frame.place = place.to_affine();
        chain.gather(&mut frame, &mut local, &mut model)?;
        reached += u16::from(gaze.aim(&frame.pose(), lamp, dt, &Settings::default()).status == Status::Reached);
        chain.apply(&frame, (&gaze).into(), &mut local, &mut model)?;
        times.push(f32::from(number) * dt);
        for ((bone, parent), keys) in local.iter().zip(skeleton.parents()).zip(&mut keys) {
            keys.push(if parent.is_none() { place.rigid_product(bone) } else { *bone });
        }
    }
    for bone in skeleton.ancestry(bone).last().map_or(0..0, |root| skeleton.subtree(root)) {
        let places = Track::linear(&*times, keys[bone].iter().map(|key| key.translation).collect::<Vec<_>>())?;
        let turns = Track::linear(&*times, keys[bone].iter().map(|key| key.rotation).collect::<Vec<_>>())?;
        clip = clip.with_translation(bone, places).with_rotation(bone, turns);
    }
    println!("{:.2} on, the gaze on the lamp in {reached} of 301 frames", place.translation.length());
    Ok(write_file(output, &document.with_clips(&[clip])?)?)
}
