//! The rigs that are compiled in.

use std::sync::Arc;

use aim::glam::{Vec3, Vec3A};
use aim::rigs::{Mixamo, Rigify, Rocketbox, Vrm};
use aim::{AimRig, Rig};

use crate::find::{Known, by_name};
use crate::{Bones, Found};

/// A bundled rig on bones of the names that it declares. With `both_eyes` the other eye is aimed itself, where there is one; else it
/// turns as the first does.
///
/// # Errors
/// Says in a sentence what was expected.
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

/// Whether the bones' declared ups are up in the rest pose, and their forwards agree, each within 60°.
fn stands(found: &Found) -> bool {
    let (skeleton, description) = (found.chain.skeleton(), found.rig.description());
    let mut model = vec![aim::glam::Affine3A::IDENTITY; skeleton.len()];
    // Of equal lengths.
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
