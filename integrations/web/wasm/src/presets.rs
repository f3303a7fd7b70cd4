//! Bundled rigs.

use std::sync::Arc;

use aim::glam::{Vec3, Vec3A};
use aim::rigs::{Mixamo, Rigify, Rocketbox, Vrm};
use aim::{AimRig, Rig};

use crate::find::{Known, by_name};
use crate::{Bones, Found};

/// Fits a bundled rig to the bones with the names that it declares. With `both_eyes`, the other eye, if any, is aimed
/// at the target itself; otherwise it repeats the turn of the first.
///
/// # Errors
/// Returns a message that says what was expected.
pub fn preset(bones: &Bones, name: &str, both_eyes: bool) -> Result<Found, String> {
    fn of<R: AimRig>() -> Arc<dyn Rig> {
        Arc::new(R::RIG)
    }
    let rig = match name {
        "vrm" => of::<Vrm>(),
        "mixamo" => of::<Mixamo>(),
        "rocketbox" => of::<Rocketbox>(),
        "rigify" => of::<Rigify>(),
        _ => {
            return Err(format!(
                "there is no preset \"{name}\": give \"vrm\", \"mixamo\", \"rocketbox\", \"rigify\", or \"measure\""
            ));
        }
    };
    let found = by_name(bones, &bones.skeleton()?, rig, Known::default(), both_eyes)?;
    if stands(&found) {
        return Ok(found);
    }
    Err(format!(
        "the bones have the names of the preset \"{name}\", and other axes: at rest they do not face one way with their ups up. \
         Take rig: \"measure\""
    ))
}

/// Returns `true` if in the rest pose each joint's declared up direction is within 60° of +Y, and its forward direction
/// within 60° of joint 0's.
fn stands(found: &Found) -> bool {
    let (skeleton, description) = (found.chain.skeleton(), found.rig.description());
    let mut model = vec![aim::glam::Affine3A::IDENTITY; skeleton.len()];
    // Cannot fail: both slices have the skeleton's length.
    let _ = skeleton.to_model(skeleton.rest(), &mut model);
    let axes = |joint: usize| {
        let turn = model[found.chain.joints()[joint]].matrix3;
        let axes = description.joints()[joint].axes();
        [axes.up, axes.forward].map(|axis| (turn * Vec3A::from(Vec3::from(axis))).normalize_or_zero())
    };
    let ahead = axes(0)[1];
    (0..description.joints().len()).all(|joint| {
        let [up, forward] = axes(joint);
        up.y > 0.5 && forward.dot(ahead) > 0.5
    })
}
