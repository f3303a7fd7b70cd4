//! Rigs that are measured from skeletons as they appear.

use std::sync::Arc;

use aim::animation::{Bone, Skeleton};
use aim_character::{InterpretedRig, Measurement, Role, propose};
use aim_gltf::Document;

use crate::Unbound;
use crate::find::{Found, Node};
use crate::place::of_bevy;

/// Skeletons that are remembered with their rigs.
const MOST_SKELETONS: usize = 64;

/// The rigs of the skeletons that were measured.
#[derive(Default)]
pub(crate) struct Measured {
    known: Vec<(Skeleton, Result<Found, Unbound>)>,
}

impl Measured {
    /// The rig of these bones.
    pub(crate) fn rig(&mut self, below: &[Node<'_>]) -> Result<Found, Unbound> {
        let bones = below.iter().map(|node| Bone::new(node.name, node.parent).with_rest(of_bevy(&node.rest)));
        let skeleton = Skeleton::new(bones).map_err(|_| Unbound::RestPose)?;
        if let Some((_, found)) = self.known.iter().find(|(known, _)| *known == skeleton) {
            return found.clone();
        }
        let found = measure(&skeleton);
        if self.known.len() == MOST_SKELETONS {
            drop(self.known.remove(0));
        }
        self.known.push((skeleton, found.clone()));
        found
    }
}

fn measure(skeleton: &Skeleton) -> Result<Found, Unbound> {
    let binds = vec![None; skeleton.len()];
    let document = Document::of_bones(skeleton, &binds).map_err(|_| Unbound::RestPose)?;
    let measurement = Measurement::of(&document);
    let proposal = propose(&document, &measurement, None).map_err(|_| Unbound::Measurement)?;
    let name = |node: usize| document.skeleton().names().get(node).cloned();
    Ok(Found {
        other_eye: proposal.spec.joints.first().and_then(|joint| joint.other_eye.clone()),
        rig: Arc::new(InterpretedRig::new(&proposal.spec)),
        up: Some(measurement.up.as_vec3()),
        trunk: measurement.with_role(Role::Hips).and_then(|bone| name(bone.node)),
    })
}
