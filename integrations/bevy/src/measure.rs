//! Measures rigs from skeletons when they appear.

use std::sync::Arc;

use aim::animation::{Bone, Skeleton};
use aim::glam::Affine3A;
use aim_character::{InterpretedRig, Measurement, Role, propose};
use aim_gltf::Document;

use crate::Unbound;
use crate::find::{Found, Node};
use crate::place::of_bevy;
use crate::skin::Skins;

/// Capacity of the cache of measured skeletons.
const MOST_SKELETONS: usize = 64;

/// Cache of measured rigs, oldest first.
#[derive(Default)]
pub(crate) struct Measured {
    known: Vec<(Key, Result<Found, Unbound>)>,
}

/// Key of the cache: the bones as they appeared, and their inverse bind transforms.
type Key = (Skeleton, Vec<Option<Affine3A>>);

impl Measured {
    /// Returns the rig of these bones, measured unless it is in the cache.
    pub(crate) fn rig(&mut self, below: &[Node<'_>], skins: &Skins<'_, '_>) -> Result<Found, Unbound> {
        let bones = below.iter().map(|node| Bone::new(node.name, node.parent).with_rest(of_bevy(&node.rest)));
        let skeleton = Skeleton::new(bones).map_err(|_| Unbound::RestPose)?;
        let key = (skeleton, skins.inverse_binds(below));
        if let Some((_, found)) = self.known.iter().find(|(known, _)| *known == key) {
            return found.clone();
        }
        let found = measure(&key.0, &key.1);
        if self.known.len() == MOST_SKELETONS {
            drop(self.known.remove(0));
        }
        self.known.push((key, found.clone()));
        found
    }
}

fn measure(skeleton: &Skeleton, inverse_binds: &[Option<Affine3A>]) -> Result<Found, Unbound> {
    let document = Document::of_bones(skeleton, inverse_binds).map_err(|_| Unbound::RestPose)?;
    let measurement = Measurement::of(&document);
    let proposal = propose(&document, &measurement, None).map_err(|error| match error {
        aim_character::Error::Model(_) => Unbound::Names,
        _ => Unbound::Measurement,
    })?;
    let name = |node: usize| document.skeleton().names().get(node).cloned();
    Ok(Found {
        rig: Arc::new(InterpretedRig::new(&proposal.spec)),
        up: Some(measurement.up.as_vec3()),
        bind: measurement.bind_world.iter().map(|place| place.as_affine3a()).collect(),
        trunk: measurement.with_role(Role::Hips).and_then(|bone| name(bone.node)),
    })
}
