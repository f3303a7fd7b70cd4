//! The node tree: a forest with parents before children in [`Skeleton::order`], every name looked up honestly.

use std::collections::BTreeMap;

use aim_animation::{Clip, Cursor, Transform};
use glam::{Affine3A, DAffine3, DMat4, DVec3, Quat, Vec3};

use crate::accessor::Data;
use crate::error::Error;
use crate::morph_eyes::MorphEye;
use crate::raw::{self, Raw};

/// One node of the file.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Node {
    /// Its name, or `node12` where the file gives none.
    pub name: String,
    /// Its parent; roots have none.
    pub parent: Option<usize>,
    /// Its children.
    pub children: Vec<usize>,
    /// Its local transform when no clip plays.
    pub rest: Transform,
    /// True when some skin lists it as a joint.
    pub is_joint: bool,
    /// Joint space ← mesh space, from the first skin that lists the joint with one.
    pub inverse_bind: Option<DAffine3>,
    /// The mesh it shows.
    pub mesh: Option<usize>,
    /// The skin its mesh is bound to.
    pub skin: Option<usize>,
    /// Its VRM bone name, such as `leftEye` (names used here are the same in VRM 0.x and 1.0).
    pub vrm_bone: Option<String>,
}

/// All nodes of a document, and behind them one for each eye that looks by morph targets.
#[derive(Debug, Clone)]
pub struct Skeleton {
    nodes: Vec<Node>,
    /// How many of them are the file's.
    in_file: usize,
    morph_eyes: Vec<MorphEye>,
    /// For the nodes that show those eyes, the weights of their meshes where no clip has any.
    morph_weights: BTreeMap<usize, Vec<f32>>,
    order: Vec<usize>,
    skins: Vec<Vec<usize>>,
    skin_binds: Vec<Vec<Option<DAffine3>>>,
}

impl Skeleton {
    /// `humanoid` are VRM bone names with the nodes they name.
    pub(crate) fn read(data: &Data<'_>, humanoid: Vec<(String, usize)>) -> Result<Self, Error> {
        let raw = data.raw;
        let parents = parents(raw)?;
        let mut nodes = Vec::with_capacity(raw.nodes.len());
        for (index, node) in raw.nodes.iter().enumerate() {
            nodes.push(Node {
                name: node.name.clone().unwrap_or_else(|| format!("node{index}")),
                parent: parents[index],
                children: node.children.clone(),
                rest: rest(node, &format!("nodes[{index}]"))?,
                is_joint: false,
                inverse_bind: None,
                mesh: node.mesh,
                skin: node.skin,
                vrm_bone: None,
            });
        }
        let (mut skins, mut skin_binds) = (Vec::new(), Vec::new());
        for (index, skin) in raw.skins.iter().enumerate() {
            let place = format!("skins[{index}]");
            let binds = inverse_binds(data, skin, &place)?;
            for (joint, bind) in skin.joints.iter().zip(&binds) {
                let node = nodes
                    .get_mut(*joint)
                    .ok_or_else(|| Error::invalid(&place, format!("its joint nodes[{joint}] does not exist")))?;
                node.is_joint = true;
                node.inverse_bind = node.inverse_bind.or(*bind);
            }
            skins.push(skin.joints.clone());
            skin_binds.push(binds);
        }
        for (bone, node) in humanoid {
            if let Some(node) = nodes.get_mut(node) {
                node.vrm_bone = Some(bone);
            }
        }
        let order = parents_first(&nodes)?;
        let in_file = nodes.len();
        let (morph_eyes, morph_weights) = (Vec::new(), BTreeMap::new());
        Ok(Self { nodes, in_file, morph_eyes, morph_weights, order, skins, skin_binds })
    }

    /// Adds a node that the file does not have, and returns its index.
    pub(crate) fn add(&mut self, name: &str, vrm_bone: &str, parent: usize, translation: Vec3) -> usize {
        let node = self.nodes.len();
        self.nodes[parent].children.push(node);
        self.order.push(node);
        self.nodes.push(Node {
            name: name.into(),
            parent: Some(parent),
            children: Vec::new(),
            rest: Transform { translation, rotation: Quat::IDENTITY, scale: Vec3::ONE },
            is_joint: false,
            inverse_bind: None,
            mesh: None,
            skin: None,
            vrm_bone: Some(vrm_bone.into()),
        });
        node
    }

    /// Adds an eye that looks by morph targets, with the weights at rest of the nodes that show it.
    pub(crate) fn add_morph_eye(&mut self, eye: MorphEye, at_rest: impl Iterator<Item = (usize, Vec<f32>)>) {
        for (node, weights) in at_rest {
            self.morph_weights.entry(node).or_insert(weights);
        }
        self.morph_eyes.push(eye);
    }

    /// The eyes that look by morph targets.
    #[must_use]
    pub fn morph_eyes(&self) -> &[MorphEye] {
        &self.morph_eyes
    }

    /// The weights of a node's mesh where no clip has any: of nodes that show such eyes.
    #[must_use]
    pub fn morph_weights(&self, node: usize) -> Option<&[f32]> {
        self.morph_weights.get(&node).map(Vec::as_slice)
    }

    /// True of the file's own nodes; false of those that stand for eyes which look by morph targets.
    #[must_use]
    pub fn is_in_file(&self, node: usize) -> bool {
        node < self.in_file
    }

    /// The number of the file's own nodes, which are the first.
    #[must_use]
    pub fn file_nodes(&self) -> usize {
        self.in_file
    }

    /// A point of the mesh of `node` in the space of a joint that it is bound to, or of the node itself.
    pub(crate) fn bound_place(&self, node: usize, joint: usize, point: DVec3) -> DVec3 {
        let skin = self.nodes[node].skin.filter(|_| joint != node).map(|skin| self.skin(skin));
        let bind = skin.and_then(|(joints, binds)| binds[joints.iter().position(|of_skin| *of_skin == joint)?]);
        bind.unwrap_or(DAffine3::IDENTITY).transform_point3(point)
    }

    /// The nodes, by glTF node index; past the file's those of eyes that look by morph targets.
    #[must_use]
    pub fn nodes(&self) -> &[Node] {
        &self.nodes
    }

    /// Node indices, parents before their children.
    #[must_use]
    pub fn order(&self) -> &[usize] {
        &self.order
    }

    /// True when any node is a joint of a skin.
    #[must_use]
    pub fn has_skin(&self) -> bool {
        self.skins.iter().any(|joints| !joints.is_empty())
    }

    /// The joints of a skin, and their inverse bind matrices where given.
    #[must_use]
    pub fn skin(&self, index: usize) -> (&[usize], &[Option<DAffine3>]) {
        (&self.skins[index], &self.skin_binds[index])
    }

    /// The number of skins.
    #[must_use]
    pub fn skin_count(&self) -> usize {
        self.skins.len()
    }

    /// The node of that name. Where several share it, the only joint among them is meant.
    ///
    /// # Errors
    /// [`Error::UnknownNode`] with the nearest names, or [`Error::AmbiguousNode`].
    pub fn find(&self, name: &str) -> Result<usize, Error> {
        let all: Vec<usize> = (0..self.nodes.len()).filter(|i| self.nodes[*i].name == name).collect();
        let joints: Vec<usize> = all.iter().copied().filter(|i| self.nodes[*i].is_joint).collect();
        match (&all[..], &joints[..]) {
            ([only], _) | (_, [only]) => Ok(*only),
            ([], _) => Err(Error::UnknownNode { name: name.into(), nearest: self.nearest_names(name) }),
            _ => Err(Error::AmbiguousNode { name: name.into(), nodes: all }),
        }
    }

    /// Up to five names like `name`, best first.
    fn nearest_names(&self, name: &str) -> Vec<String> {
        let mut scored: Vec<(usize, &str)> =
            self.nodes.iter().map(|node| (distance(name, &node.name), node.name.as_str())).collect();
        scored.sort_unstable();
        scored.dedup();
        scored.into_iter().take(5).map(|(_, name)| name.to_owned()).collect()
    }

    /// The local transforms when no clip plays.
    #[must_use]
    pub fn rest_pose(&self) -> Vec<Transform> {
        self.nodes.iter().map(|node| node.rest).collect()
    }

    /// The local transforms `seconds` into a clip; nodes without a channel are at rest.
    #[must_use]
    pub fn pose(&self, clip: &Clip, seconds: f32) -> Vec<Transform> {
        let mut pose = self.rest_pose();
        clip.sample(seconds, &mut Cursor::default(), &mut pose);
        pose
    }

    /// Forward kinematics: world ← node for every node, from the local transforms of all nodes.
    /// Computed in double precision and then rounded.
    ///
    /// A `pose` shorter than the node list is completed by the rest pose.
    #[must_use]
    pub fn world(&self, pose: &[Transform]) -> Vec<Affine3A> {
        self.world_f64(pose).iter().map(|m| m.as_affine3a()).collect()
    }

    /// Forward kinematics in double precision; see [`Self::world`].
    #[must_use]
    pub fn world_f64(&self, pose: &[Transform]) -> Vec<DAffine3> {
        let mut world = vec![DAffine3::IDENTITY; self.nodes.len()];
        for &index in &self.order {
            let node = &self.nodes[index];
            let local = affine_f64(pose.get(index).unwrap_or(&node.rest));
            world[index] = node.parent.map_or(local, |parent| world[parent] * local);
        }
        world
    }

    /// The node and all its ancestors, the node first.
    pub fn ancestry(&self, node: usize) -> impl Iterator<Item = usize> + '_ {
        core::iter::successors(Some(node), |at| self.nodes.get(*at).and_then(|n| n.parent))
    }
}

/// Each node's parent, or why the nodes are no forest.
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

/// An order with parents first; nodes that no root reaches go round in a circle.
fn parents_first(nodes: &[Node]) -> Result<Vec<usize>, Error> {
    let mut order: Vec<usize> = (0..nodes.len()).filter(|i| nodes[*i].parent.is_none()).collect();
    let mut at = 0;
    while let Some(&index) = order.get(at) {
        order.extend_from_slice(&nodes[index].children);
        at += 1;
    }
    if order.len() == nodes.len() {
        return Ok(order);
    }
    let mut reached = vec![false; nodes.len()];
    order.iter().for_each(|i| reached[*i] = true);
    let stray = reached.iter().position(|r| !r).unwrap_or(0);
    Err(Error::invalid(format!("nodes[{stray}]"), "it is its own ancestor, expected a tree without cycles"))
}

fn rest(node: &raw::Node, place: &str) -> Result<Transform, Error> {
    let finite = |values: &[f32]| values.iter().all(|v| v.is_finite());
    let rest = if let Some(matrix) = &node.matrix {
        Transform::from_affine(&affine_of(matrix).as_affine3a())
            .ok_or_else(|| Error::invalid(place, "its transform is beyond the range of single precision"))?
    } else {
        let narrow = crate::num::narrow;
        let q = node.rotation.unwrap_or([0.0, 0.0, 0.0, 1.0]);
        let rotation = glam::DQuat::from_array(q);
        // A zero quaternion is invalid, but what its author meant is plain.
        let unit = rotation.length() > 1e-9 && rotation.length().is_finite();
        Transform {
            translation: Vec3::from_array(node.translation.unwrap_or_default().map(narrow)),
            rotation: if unit { rotation.normalize().as_quat() } else { Quat::IDENTITY },
            scale: Vec3::from_array(node.scale.unwrap_or([1.0; 3]).map(narrow)),
        }
    };
    if finite(&rest.translation.to_array()) && finite(&rest.scale.to_array()) && rest.rotation.is_finite() {
        Ok(rest)
    } else {
        Err(Error::invalid(place, "its transform is beyond the range of single precision"))
    }
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
    // A singular matrix hides a joint; it says nothing about its axes.
    let is_usable = |a: &DAffine3| a.matrix3.determinant().abs() > 1e-30 && a.inverse().is_finite();
    let usable = |m: &[f32; 16]| Some(affine_of(&m.map(f64::from))).filter(is_usable);
    Ok(matrices.iter().take(skin.joints.len()).map(usable).collect())
}

/// Edit distance, letters compared without case; of the first 64 letters, so that the work is bounded.
fn distance(a: &str, b: &str) -> usize {
    let letters = |s: &str| s.chars().take(64).flat_map(char::to_lowercase).collect::<Vec<_>>();
    strsim::generic_levenshtein(&letters(a), &letters(b))
}

/// A local transform as an affine map, parent ← node, with the rotation made unit to double precision.
fn affine_f64(local: &Transform) -> DAffine3 {
    let rotation = local.rotation.as_dquat().normalize();
    DAffine3::from_scale_rotation_translation(local.scale.as_dvec3(), rotation, local.translation.as_dvec3())
}

/// A column-major glTF matrix as an affine map; the last row is taken as (0, 0, 0, 1).
fn affine_of(columns: &[f64; 16]) -> DAffine3 {
    DAffine3::from_mat4(DMat4::from_cols_array(columns))
}
