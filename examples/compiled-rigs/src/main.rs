//! Two rigs of one character look at several points in turn. The program does not depend on the axes of the bones.

/// One of the rigs, written by `aim generate rigs/extra.toml --lang rust -o src/checked_in.rs`.
#[rustfmt::skip]
mod checked_in;

/// The rigs compiled by `build.rs`.
mod built {
    aim::include_rigs!("rigs");
}

use std::error::Error;

use aim::animation::AimChain;
use aim::glam::{Affine3A, Vec3};
use aim::{AimRig, DynAim, Rig, Settings, Status};
use aim_character::{PAPER_AXES, mannequin};
use aim_gltf::Document;

/// Targets in metres. The character walks at the origin and faces +Z; its left is +X.
const TARGETS: [Vec3; 3] = [Vec3::new(0.0, 1.6, 2.0), Vec3::new(1.5, 1.2, 1.5), Vec3::new(-1.0, 2.1, 1.8)];

fn main() -> Result<(), Box<dyn Error>> {
    let model = match std::env::args_os().nth(1) {
        Some(file) => Document::load(file)?,
        None => Document::from_bytes(&mannequin(|_| PAPER_AXES)?)?,
    };
    for target in TARGETS {
        println!("target {}", shown(target));
        let hero = look("Hero", built::Hero::RIG, &model, target)?;
        let extra = look("Extra", built::Extra::RIG, &model, target)?;
        println!("{hero}{extra}");
        if extra != look("Extra", checked_in::Extra::RIG, &model, target)? {
            return Err("the checked-in rig aims otherwise: is it out of date?".into());
        }
    }
    Ok(())
}

/// Lets the rig follow the target for one second of the model's first clip, and describes where it looks then.
fn look(name: &str, rig: &dyn Rig, model: &Document, target: Vec3) -> Result<String, Box<dyn Error>> {
    const STEP: f32 = 1.0 / 60.0;
    let skeleton = model.skeleton();
    let chain = AimChain::named(skeleton, rig)?;
    let mut gathered = chain.frame();

    let mut character = DynAim::new(rig);
    let mut world = vec![Affine3A::IDENTITY; skeleton.len()];
    let mut status = Status::Degenerate;
    for frame in 0..60_u8 {
        let time = STEP * f32::from(frame);
        let mut pose = model.clips().first().map_or_else(|| skeleton.rest().to_vec(), |clip| skeleton.pose(clip, time));
        skeleton.to_model(&pose, &mut world)?;
        chain.gather(&mut gathered, &mut pose, &mut world)?;
        status = character.aim(&gathered.pose(), target, STEP, &Settings::default()).status;
        chain.apply(&gathered, (&character).into(), &mut pose, &mut world)?;
    }

    let eye = world[chain.joints()[0]];
    let gaze = eye.transform_vector3(rig.description().effector().forward.into()).normalize();
    let from = eye.transform_point3(rig.description().effector().origin.into());
    let mut text = format!(
        "  {name:<6} {status:?}: from {} along {}, {:.2}° off\n",
        shown(from),
        shown(gaze),
        gaze.angle_between(target - from).to_degrees()
    );
    for (index, joint) in character.state.joints.iter().enumerate() {
        let (heading, pitch) = (joint.heading().to_degrees(), joint.pitch().to_degrees());
        // Angles that print as 0.0 get the positive side, whatever their sign.
        let side = if heading < -0.05 { "right" } else { "left" };
        let height = if pitch < -0.05 { "down" } else { "up" };
        text += &format!(
            "    {:<9} {:4.1}° {side}, {:4.1}° {height}\n",
            rig.bone_name(index, 0).unwrap_or_default(),
            heading.abs(),
            pitch.abs()
        );
    }
    Ok(text)
}

fn shown(v: Vec3) -> String {
    format!("({:.4}, {:.4}, {:.4})", v.x, v.y, v.z)
}
