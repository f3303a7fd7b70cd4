//! [`Skeleton`]: the nodes of a file as bones, plus the file's own data about them.

use core::ops::Deref;
use std::collections::BTreeMap;

use aim_animation::glam::{DAffine3, DMat4, DQuat, DVec3, Quat};
use aim_animation::{Bone, Clip, Cursor, SkeletonError, Transform};
use serde_json::Value;

use crate::accessor::Data;
use crate::error::Error;
use crate::humanoid::vrm_bones;
use crate::morph_eyes::{self, MorphEye};
use crate::raw::{self, Raw};

/// Data that a file states about a node.
#[derive(Debug, Clone, Default)]
#[non_exhaustive]
pub struct Node {
    /// Index among the file's nodes; `None` for an eye that looks by morph targets, which is not a node of the file.
    pub index: Option<usize>,
    /// `true` if a skin lists the node as a joint.
    pub is_joint: bool,
    /// Inverse bind matrix, joint space ← mesh space, from the first skin that gives one for this joint.
    pub inverse_bind: Option<DAffine3>,
    /// Index of the mesh that the node shows.
    pub mesh: Option<usize>,
    /// Index of the skin that its mesh is bound to.
    pub skin: Option<usize>,
    /// VRM bone name, such as `leftEye`. The names used in this project are the same in VRM 0.x and 1.0.
    pub vrm_bone: Option<String>,
}

/// The nodes of a document as an [`aim_animation::Skeleton`], plus one bone for each eye that looks by morph targets.
/// Dereferences to that skeleton, which has the parents, the names (`node12` if the file gives none) and the rest
/// transforms.
///
/// Node indices are bone indices, in depth-first order, here and in the document's clips. The index in the file is
/// [`Node::index`].
#[derive(Debug, Clone)]
pub struct Skeleton {
    bones: aim_animation::Skeleton,
    nodes: Vec<Node>,
    morph_eyes: Vec<MorphEye>,
    /// Morph target weights at rest of the meshes that show these eyes, by node.
    morph_weights: BTreeMap<usize, Vec<f32>>,
    skins: Vec<Skin>,
}

/// A skin: its joints and their inverse bind matrices, where given. The joints are the file's node indices until the
/// skeleton is built, bone indices afterwards.
#[derive(Debug, Clone)]
pub(crate) struct Skin {
    pub(crate) joints: Vec<usize>,
    pub(crate) binds: Vec<Option<DAffine3>>,
}

impl Deref for Skeleton {
    type Target = aim_animation::Skeleton;

    fn deref(&self) -> &aim_animation::Skeleton {
        &self.bones
    }
}

impl Skeleton {
    /// Builds the skeleton; `extensions` are the document's.
    pub(crate) fn read(data: &Data<'_>, extensions: &Value) -> Result<Self, Error> {
        let raw = data.raw;
        let parents = parents(raw)?;
        let mut skins = read_skins(data)?;
        let eyes = morph_eyes::find(data, &skins, extensions);
        let mut given = Vec::with_capacity(raw.nodes.len() + eyes.len());
        for (index, (node, parent)) in raw.nodes.iter().zip(parents).enumerate() {
            let beyond =
                || Error::invalid(format!("nodes[{index}]"), "its transform exceeds the range of single precision");
            let name = node.name.clone().unwrap_or_else(|| format!("node{index}"));
            given.push(Bone::new(name, parent).with_rest(rest(node).filter(Transform::is_sound).ok_or_else(beyond)?));
        }
        given.extend(
            eyes.iter().map(|eye| {
                Bone::new(eye.name, Some(eye.parent)).with_rest(Transform::from_translation(eye.translation))
            }),
        );
        let bones = aim_animation::Skeleton::new(given).map_err(|error| match error {
            SkeletonError::Cycle(node) => {
                Error::invalid(format!("nodes[{node}]"), "it is its own ancestor, expected a tree without cycles")
            }
            other => Error::invalid("nodes", other.to_string()),
        })?;
        let bone = |index: usize| bones.bone_of(index).unwrap_or_default();
        let mut nodes = vec![Node::default(); bones.len()];
        for (index, node) in raw.nodes.iter().enumerate() {
            nodes[bone(index)] = Node { index: Some(index), mesh: node.mesh, skin: node.skin, ..Node::default() };
        }
        for Skin { joints, binds } in &mut skins {
            for (joint, bind) in joints.iter_mut().zip(binds) {
                *joint = bone(*joint);
                nodes[*joint].is_joint = true;
                nodes[*joint].inverse_bind = nodes[*joint].inverse_bind.or(*bind);
            }
        }
        for (name, index) in vrm_bones(extensions).into_iter().filter(|(_, index)| *index < raw.nodes.len()) {
            nodes[bone(index)].vrm_bone = Some(name);
        }
        let (mut morph_eyes, mut morph_weights) = (Vec::new(), BTreeMap::new());
        for (at, mut eye) in eyes.into_iter().enumerate() {
            let node = bone(raw.nodes.len() + at);
            nodes[node].vrm_bone = Some(eye.vrm_bone.into());
            eye.ways.iter_mut().flat_map(|way| &mut way.binds).for_each(|bind| bind.node = bone(bind.node));
            for (shown, weights) in eye.at_rest {
                morph_weights.entry(bone(shown)).or_insert(weights);
            }
            morph_eyes.push(MorphEye { node, ways: eye.ways });
        }
        Ok(Self { bones, nodes, morph_eyes, morph_weights, skins })
    }

    /// The eyes that look by morph targets.
    #[must_use]
    pub fn morph_eyes(&self) -> &[MorphEye] {
        &self.morph_eyes
    }

    /// Returns the morph target weights of a node's mesh at rest, that is, without a clip. `None` for nodes that show
    /// none of the [`morph_eyes`](Self::morph_eyes).
    #[must_use]
    pub fn morph_weights(&self, node: usize) -> Option<&[f32]> {
        self.morph_weights.get(&node).map(Vec::as_slice)
    }

    /// Returns `true` for the file's own nodes, `false` for bones added for eyes that look by morph targets.
    #[must_use]
    pub fn is_in_file(&self, node: usize) -> bool {
        self.nodes.get(node).is_some_and(|node| node.index.is_some())
    }

    /// The file's data about each node.
    #[must_use]
    pub fn nodes(&self) -> &[Node] {
        &self.nodes
    }

    /// Returns `true` if any node is a joint of a skin.
    #[must_use]
    pub fn has_skin(&self) -> bool {
        self.skins.iter().any(|skin| !skin.joints.is_empty())
    }

    /// Returns the joints of a skin and their inverse bind matrices, where given.
    #[must_use]
    pub fn skin(&self, index: usize) -> (&[usize], &[Option<DAffine3>]) {
        let Skin { joints, binds } = &self.skins[index];
        (joints, binds)
    }

    /// The number of skins.
    #[must_use]
    pub fn skin_count(&self) -> usize {
        self.skins.len()
    }

    /// Returns the node with this name. If several share it, returns the one that is a joint, provided that it is the
    /// only joint among them.
    ///
    /// # Errors
    /// [`Error::UnknownNode`] with the most similar names, or [`Error::AmbiguousNode`].
    pub fn find(&self, name: &str) -> Result<usize, Error> {
        let all: Vec<usize> = self.bones.named(name).collect();
        let joints: Vec<usize> = all.iter().copied().filter(|i| self.nodes[*i].is_joint).collect();
        match (&all[..], &joints[..]) {
            ([only], _) | (_, [only]) => Ok(*only),
            ([], _) => Err(Error::UnknownNode { name: name.into(), nearest: self.nearest_names(name) }),
            _ => {
                let nodes = all.iter().filter_map(|node| self.nodes[*node].index).collect();
                Err(Error::AmbiguousNode { name: name.into(), nodes })
            }
        }
    }

    /// Returns up to five names similar to `name`, best first.
    fn nearest_names(&self, name: &str) -> Vec<String> {
        if cfg!(aim_small) {
            // Size-optimised builds leave the edit distance out: their callers ask for names that exist.
            return self.names().iter().take(5).cloned().collect();
        }
        let mut scored: Vec<(usize, &String)> =
            self.names().iter().map(|known| (distance(name, known), known)).collect();
        scored.sort_unstable();
        scored.dedup();
        scored.into_iter().take(5).map(|(_, name)| name.clone()).collect()
    }

    /// Returns the local transforms `seconds` into a clip; nodes without a track are at rest.
    #[must_use]
    pub fn pose(&self, clip: &Clip, seconds: f32) -> Vec<Transform> {
        let mut pose = self.rest().to_vec();
        clip.sample(seconds, &mut Cursor::default(), &mut pose);
        pose
    }

    /// Forward kinematics in double precision, the reference that results are checked against: the map world ← node of
    /// every node, computed from the local transforms of all nodes. Per frame, use the faster
    /// [`to_model`](aim_animation::Skeleton::to_model).
    ///
    /// Nodes beyond the end of `pose` take their rest transform.
    #[must_use]
    pub fn world_f64(&self, pose: &[Transform]) -> Vec<DAffine3> {
        let mut world: Vec<DAffine3> = Vec::with_capacity(self.len());
        for (node, (parent, rest)) in self.parents().iter().zip(self.rest()).enumerate() {
            let local = affine_f64(pose.get(node).unwrap_or(rest));
            world.push(parent.map_or(local, |parent| world[parent] * local));
        }
        world
    }
}

/// Returns each node's parent, or the reason why the nodes are not a forest.
fn parents(raw: &Raw) -> Result<Vec<Option<usize>>, Error> {
    let mut parents = vec![None; raw.nodes.len()];
    for (index, node) in raw.nodes.iter().enumerate() {
        for (k, &child) in node.children.iter().enumerate() {
            let problem = match parents.get_mut(child) {
                None => format!("nodes[{child}] does not exist"),
                Some(Some(other)) => format!("nodes[{child}] is already a child of nodes[{other}]"),
                Some(slot) => {
                    *slot = Some(index);
                    continue;
                }
            };
            return Err(Error::invalid(format!("nodes[{index}].children[{k}]"), problem));
        }
        let check = |what: &str, index_of: Option<usize>, len: usize| match index_of {
            Some(at) if at >= len => {
                Err(Error::invalid(format!("nodes[{index}].{what}"), format!("{what} {at} does not exist")))
            }
            _ => Ok(()),
        };
        check("mesh", node.mesh, raw.meshes.len())?;
        check("skin", node.skin, raw.skins.len())?;
    }
    for (index, scene) in raw.scenes.iter().enumerate() {
        if let Some(node) = scene.nodes.iter().find(|node| **node >= raw.nodes.len()) {
            return Err(Error::invalid(format!("scenes[{index}]"), format!("nodes[{node}] does not exist")));
        }
    }
    Ok(parents)
}

/// Returns the local transform of a node; `None` if its matrix exceeds single precision.
fn rest(node: &raw::Node) -> Option<Transform> {
    if let Some(matrix) = &node.matrix {
        return Transform::from_affine(&affine_of(matrix).as_affine3a());
    }
    let rotation = DQuat::from_array(node.rotation.unwrap_or([0.0, 0.0, 0.0, 1.0]));
    // A zero quaternion is invalid, but clearly meant as no rotation.
    let unit = rotation.length() > 1e-9 && rotation.length().is_finite();
    Some(Transform {
        translation: DVec3::from_array(node.translation.unwrap_or_default()).as_vec3(),
        rotation: if unit { rotation.normalize().as_quat() } else { Quat::IDENTITY },
        scale: DVec3::from_array(node.scale.unwrap_or([1.0; 3])).as_vec3(),
    })
}

/// Reads the skins; their joints are the file's node indices.
fn read_skins(data: &Data<'_>) -> Result<Vec<Skin>, Error> {
    let read = |(index, skin): (usize, &raw::Skin)| {
        let place = format!("skins[{index}]");
        let binds = inverse_binds(data, skin, &place)?;
        match skin.joints.iter().find(|joint| **joint >= data.raw.nodes.len()) {
            Some(joint) => Err(Error::invalid(&place, format!("its joint nodes[{joint}] does not exist"))),
            None => Ok(Skin { joints: skin.joints.clone(), binds }),
        }
    };
    data.raw.skins.iter().enumerate().map(read).collect()
}

fn inverse_binds(data: &Data<'_>, skin: &raw::Skin, place: &str) -> Result<Vec<Option<DAffine3>>, Error> {
    let Some(accessor) = skin.inverse_bind_matrices else {
        return Ok(vec![None; skin.joints.len()]);
    };
    let place = format!("{place}.inverseBindMatrices");
    let floats = data.floats(accessor, &["MAT4"], &place)?;
    let (matrices, _) = floats.as_chunks::<16>();
    if matrices.len() < skin.joints.len() {
        return Err(Error::invalid(place, format!("{} matrices for {} joints", matrices.len(), skin.joints.len())));
    }
    // A singular matrix is used to hide a joint and tells nothing about its axes.
    let is_usable = |a: &DAffine3| a.matrix3.determinant().abs() > 1e-30 && a.inverse().is_finite();
    let usable = |m: &[f32; 16]| Some(affine_of(&m.map(f64::from))).filter(is_usable);
    Ok(matrices.iter().take(skin.joints.len()).map(usable).collect())
}

/// Case-insensitive edit distance of the first 64 characters, which bounds the cost.
fn distance(a: &str, b: &str) -> usize {
    let letters = |s: &str| s.chars().take(64).flat_map(char::to_lowercase).collect::<Vec<_>>();
    strsim::generic_levenshtein(&letters(a), &letters(b))
}

/// Converts a local transform to an affine map, parent ← node, with the rotation renormalised in double precision.
fn affine_f64(local: &Transform) -> DAffine3 {
    let rotation = local.rotation.as_dquat().normalize();
    DAffine3::from_scale_rotation_translation(local.scale.as_dvec3(), rotation, local.translation.as_dvec3())
}

/// Converts a column-major glTF matrix to an affine map; the last row is assumed to be (0, 0, 0, 1).
fn affine_of(columns: &[f64; 16]) -> DAffine3 {
    DAffine3::from_mat4(DMat4::from_cols_array(columns))
}
