//! A rig measured from a file: what `bake` aims without a declaration.

use std::path::Path;

use aim_codegen::{AngleRange, EffectorSpec, Frame, JointSpec, RigSpec};
use aim_gltf::{BoneAxes, BoneFrame, Document, Measurement, Role};

use crate::failure::{Failure, Result};

/// What a joint of each role does in people, degrees and degrees a second.
struct Habit {
    name: &'static str,
    heading: f64,
    pitch: [f64; 2],
    rate: f64,
    comfort: f64,
}

const EYE: Habit = Habit { name: "eye", heading: 35.0, pitch: [-25.0, 20.0], rate: 450.0, comfort: 0.5 };
const NECK: Habit = Habit { name: "neck", heading: 60.0, pitch: [-40.0, 35.0], rate: 170.0, comfort: 1.0 };
const SPINE: Habit = Habit { name: "spine", heading: 20.0, pitch: [-10.0, 10.0], rate: 70.0, comfort: 4.0 };

/// The chain eye, neck (or head), upper spine as far as the file has them.
///
/// # Errors
/// A file without an eye, a head or a neck by any known name.
pub(crate) fn rig(file: &Path, document: &Document, measurement: &Measurement) -> Result<RigSpec> {
    let skeleton = document.skeleton();
    let eye = measurement.with_role(Role::LeftEye).or_else(|| measurement.with_role(Role::RightEye));
    let head = measurement.with_role(Role::Head);
    let Some(outermost) = eye.or(head).or_else(|| measurement.with_role(Role::Neck)) else {
        return Err(Failure::in_file(
            file,
            "has no eye, head or neck that its name tells; declare the chain in a rig file and give it with --rig",
        ));
    };
    // From the outermost bone to the root: the first neck (else the head), then the first spine.
    let inward: Vec<&BoneAxes> =
        skeleton.ancestry(outermost.node).skip(1).filter_map(|node| measurement.bone(node)).collect();
    let role = |wanted: Role| inward.iter().copied().find(|bone| bone.role == Some(wanted));
    let supporting = if eye.is_some() { role(Role::Neck).or_else(|| role(Role::Head)) } else { role(Role::Neck) };
    let mut joints = Vec::new();
    if eye.is_some() {
        let pair = [Role::LeftEye, Role::RightEye]
            .into_iter()
            .filter_map(|role| measurement.with_role(role))
            .find(|bone| bone.node != outermost.node);
        joints.push(joint(&EYE, outermost, pair.map(|bone| bone.name.clone())));
    } else {
        joints.push(joint(&Habit { name: "head", ..NECK }, outermost, None));
    }
    joints.extend(supporting.map(|bone| joint(&NECK, bone, None)));
    joints.extend(role(Role::Spine).map(|bone| joint(&SPINE, bone, None)));
    let effector = EffectorSpec { frame: joints[0].frame, origin: [0.0; 3] };
    Ok(RigSpec { name: "Measured".into(), joints, effector, natural: None })
}

fn joint(habit: &Habit, bone: &BoneAxes, pair: Option<String>) -> JointSpec {
    let BoneFrame { up, forward, left, .. } = bone.frame;
    let range = |lo: f64, hi: f64| Some(AngleRange::Between(lo.to_radians(), hi.to_radians()));
    JointSpec {
        name: habit.name.into(),
        bones: vec![bone.name.clone()],
        frame: Frame { up: up.to_array(), forward: forward.to_array(), left: left.to_array() },
        pitch: range(habit.pitch[0], habit.pitch[1]),
        heading: range(-habit.heading, habit.heading),
        absolute: false,
        rate: habit.rate.to_radians(),
        acceleration: None,
        comfort: habit.comfort,
        level: None,
        narrowing: None,
        pair,
    }
}
