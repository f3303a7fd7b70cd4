//! Measures rigs when a character is loaded.

use std::collections::BTreeMap;
use std::sync::Arc;

use aim::Rig;
use aim::animation::Bone;
use aim::glam::Affine3A;
use aim_character::{Error, InterpretedRig, Measurement, Role, propose};
use aim_gltf::Document;

use crate::find::{Known, MOST_JOINTS, by_name};
use crate::{Bones, Found};

/// Measures a rig from the bones: their names, rest transforms and bind matrices.
///
/// # Errors
/// Returns a message that says what was expected.
pub fn measured(bones: &Bones, both_eyes: bool) -> Result<Found, String> {
    // A measured rig refers to its bones by name, so make duplicate names unique.
    let mut bones = bones.clone();
    let mut seen: BTreeMap<String, usize> = BTreeMap::new();
    for Bone { name, .. } in &mut bones.bones {
        let times = seen.entry(name.clone()).or_default();
        *times += 1;
        if *times > 1 {
            *name = format!("{name}#{times}");
        }
    }
    let skeleton = bones.skeleton()?;
    let inverse_binds: Vec<Option<Affine3A>> =
        (0..skeleton.len()).map(|bone| bones.inverse_binds[skeleton.source_of(bone).unwrap_or_default()]).collect();
    let document = Document::of_bones(&skeleton, &inverse_binds).map_err(|error| error.to_string())?;
    let (rig, known) = proposed(&document)?;
    by_name(&bones, &skeleton, rig, known, both_eyes)
}

/// Measures a rig from the bytes of the character's file, GLB or VRM. Bones are matched to the file's nodes by node
/// index, or by name if they have none.
///
/// # Errors
/// Returns a message that says what was expected.
pub fn of_file(bones: &Bones, bytes: &[u8], both_eyes: bool) -> Result<Found, String> {
    let document =
        Document::without_clips(bytes).map_err(|error| format!("the character's file cannot be read: {error}"))?;
    let (rig, mut known) = proposed(&document)?;
    let of_file = document.skeleton();
    // Give the bones the names of the file's nodes, because engines rename them.
    let by_node: BTreeMap<usize, usize> =
        (0..of_file.len()).filter_map(|at| Some((of_file.source_of(at)?, at))).collect();
    let node_of = |bone: usize| match bones.nodes[bone] {
        Some(node) => by_node.get(&node).copied(),
        None => of_file.find(&bones.bones[bone].name).ok(),
    };
    let mut bones = bones.clone();
    let nodes: Vec<Option<usize>> = (0..bones.bones.len()).map(node_of).collect();
    for (bone, node) in bones.bones.iter_mut().zip(&nodes) {
        if let Some(node) = *node {
            bone.name.clone_from(&of_file.names()[node]);
        }
    }
    let skeleton = bones.skeleton()?;
    let node = |bone: usize| skeleton.source_of(bone).and_then(|source| nodes[source]);
    known.trunk = known.trunk.and_then(|trunk| (0..skeleton.len()).find(|&bone| node(bone) == Some(trunk)));
    let mut bind = vec![Affine3A::IDENTITY; skeleton.len()];
    skeleton.to_model(skeleton.rest(), &mut bind).map_err(|error| error.to_string())?;
    for (bone, place) in bind.iter_mut().enumerate() {
        if let Some(node) = node(bone) {
            *place = known.bind[node];
        }
    }
    known.bind = bind;
    by_name(&bones, &skeleton, rig, known, both_eyes)
}

/// Proposes a rig for a character, and returns it with the other measured facts. Bones are numbered as in the
/// document's skeleton.
fn proposed(document: &Document) -> Result<(Arc<dyn Rig>, Known), String> {
    let measurement = Measurement::of(document);
    let told = |error| match error {
        Error::Model(error) => format!("several bones share a name that the measured rig needs: {error}"),
        Error::NoChain => "no bone has the name of an eye, a head or a neck, and no shape tells one: give a rig as \
                           { toml: \"…\" }, which names the bones"
            .to_owned(),
        other => other.to_string(),
    };
    let mut spec = propose(document, &measurement, None).map_err(told)?.spec;
    if spec.joints.len() > MOST_JOINTS {
        // With a long neck or spine, keep the joints nearest to the eyes.
        let names: Vec<String> =
            spec.joints.iter().take(MOST_JOINTS).filter_map(|joint| joint.bones.first().cloned()).collect();
        spec = propose(document, &measurement, Some(&names)).map_err(told)?.spec;
    }
    let known = Known {
        up: Some(measurement.up.as_vec3()),
        trunk: measurement.with_role(Role::Hips).map(|bone| bone.node),
        bind: measurement.bind_world.iter().map(|place| place.as_affine3a()).collect(),
    };
    Ok((Arc::new(InterpretedRig::new(&spec)), known))
}
