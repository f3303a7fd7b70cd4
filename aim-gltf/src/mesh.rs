//! Converts a document's surface to one mesh on one skin, with all influences and morph targets.

use std::collections::HashMap;
use std::ops::Range;

use aim_animation::glam::{Affine3A, Vec3};
use aim_animation::{Influence, Mesh, Morph, Skin};
use serde_json::Value;

use crate::accessor::Data;
use crate::morph_eyes::weights_at_rest;
use crate::raw::Primitive;
use crate::skeleton::Skeleton;
use crate::skin::to_index;
use crate::surface::Surface;

/// Maximum number of displacements of vertices by morph targets; further ones are dropped.
const MOST_MORPHS: usize = 8_000_000;
/// Maximum number of morph targets, counted once for each node that shows them; a node that would exceed it gets none.
const MOST_TARGETS: usize = 1 << 20;

/// Everything that moves the vertices of a surface apart from the first four joints of each.
#[derive(Debug, Clone, Default)]
pub(crate) struct VertexInfluences {
    /// (vertex, joint of its skin, weight), ordered by vertex.
    joints: Vec<(usize, u16, f32)>,
    morphs: Vec<Morph>,
    /// Each node that has morph targets, with the range of their numbers.
    targets: Vec<(usize, Range<usize>)>,
    /// Weight at rest of each target, used where no clip animates it.
    weights: Vec<f32>,
}

impl VertexInfluences {
    /// Numbers the morph targets of node `index` of the file, which is `bone` of the skeleton, and stores their weights
    /// at rest.
    pub(crate) fn add_targets(&mut self, data: &Data<'_>, index: usize, bone: usize) -> Range<usize> {
        let start = self.weights.len();
        let count = data.raw.nodes[index].mesh.map_or(0, |mesh| data.target_count(mesh));
        if count == 0 || count > MOST_TARGETS - start {
            return 0..0;
        }
        self.weights.extend(weights_at_rest(data, index));
        self.targets.push((bone, start..self.weights.len()));
        start..self.weights.len()
    }

    /// Adds the joints of a primitive's vertices after the first four. Data that cannot be read is skipped.
    pub(crate) fn add_joints(&mut self, data: &Data<'_>, primitive: &Primitive, vertices: Range<usize>) {
        let before = self.joints.len();
        for set in 1.. {
            let attribute = |name: &str| primitive.attributes.get(&format!("{name}_{set}")).copied();
            let (Some(joints), Some(weights)) = (attribute("JOINTS"), attribute("WEIGHTS")) else { break };
            let floats = |accessor: usize| data.floats(accessor, &["VEC4"], "joints").ok();
            let (Some(joints), Some(weights)) = (floats(joints), floats(weights)) else { continue };
            let of =
                |(at, (joint, weight)): (usize, (&f32, &f32))| (vertices.start + at / 4, to_index(*joint), *weight);
            let pairs = joints.iter().zip(&weights).enumerate().map(of);
            self.joints.extend(pairs.take(4 * vertices.len()).filter(|(_, _, weight)| *weight > 0.0));
        }
        // The sets were read one after the other: group the joints by vertex.
        self.joints[before..].sort_by_key(|(vertex, ..)| *vertex);
    }

    /// Adds the displacements of a primitive's vertices by the node's morph targets, whose numbers are `targets`.
    pub(crate) fn add_morphs(
        &mut self,
        data: &Data<'_>,
        primitive: &Primitive,
        targets: Range<usize>,
        vertices: Range<usize>,
    ) {
        for (number, target) in targets.zip(primitive.targets.as_array().into_iter().flatten()) {
            let read = |name: &str| {
                let accessor = target.get(name).and_then(Value::as_u64).and_then(|at| usize::try_from(at).ok())?;
                let floats = data.floats(accessor, &["VEC3"], "a morph target").ok()?;
                (floats.len() == 3 * vertices.len()).then_some(floats)
            };
            let (positions, normals) = (read("POSITION").unwrap_or_default(), read("NORMAL").unwrap_or_default());
            if positions.is_empty() && normals.is_empty() {
                continue;
            }
            let of =
                |floats: &[f32], at: usize| floats.as_chunks().0.get(at).copied().map_or(Vec3::ZERO, Vec3::from_array);
            for (at, vertex) in vertices.clone().enumerate() {
                let (position, normal) = (of(&positions, at), of(&normals, at));
                if (position != Vec3::ZERO || normal != Vec3::ZERO) && self.morphs.len() < MOST_MORPHS {
                    self.morphs.push(Morph { target: narrow(number), vertex: narrow(vertex), position, normal });
                }
            }
        }
    }
}

impl Surface {
    /// Returns the whole surface as one [`Mesh`] on one [`Skin`], to be deformed, drawn by a GPU or hit by rays. The
    /// indices of vertices, triangles and normals stay the same.
    ///
    /// The joints of the skin are the bones that move part of the surface: joints of the file's skins, with their
    /// inverse bind matrices, and nodes with rigid meshes. A bone with several inverse bind matrices becomes several
    /// joints. The joint matrices map to model space, as given by
    /// [`Skeleton::to_model`](aim_animation::Skeleton::to_model).
    ///
    /// ```no_run
    /// use aim_animation::MeshPose;
    /// use aim_animation::glam::{Affine3A, Vec3};
    /// use aim_gltf::Document;
    ///
    /// let document = Document::load("hero.glb")?;
    /// let (skeleton, surface) = (document.skeleton(), document.surface());
    /// let (mesh, skin) = surface.mesh(skeleton);
    /// let mut model = vec![Affine3A::IDENTITY; skeleton.len()];
    /// skeleton.to_model(skeleton.rest(), &mut model)?;
    /// let mut matrices = vec![Affine3A::IDENTITY; skin.len()];
    /// skin.matrices(&model, &mut matrices)?;
    /// let pose = MeshPose::new(&matrices).with_morph_weights(surface.morph_weights());
    /// let mut positions = vec![Vec3::ZERO; mesh.positions().len()];
    /// mesh.deform(&pose, &mut positions)?;
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn mesh(&self, skeleton: &Skeleton) -> (Mesh, Skin) {
        let mut joints = Joints::new(skeleton);
        let mut influences: Vec<Influence> = Vec::with_capacity(self.points().len());
        let mut ends = Vec::with_capacity(self.points().len());
        let mut more = self.influences.joints.iter().peekable();
        for (vertex, point) in self.points().iter().enumerate() {
            let start = influences.len();
            let skin = skeleton.nodes().get(point.node()).and_then(|node| node.skin);
            let mut add = |joint: u16, weight: f32| {
                if let Some(joint) = skin.filter(|_| weight > 0.0).and_then(|skin| joints.of_skin(skin, joint.into())) {
                    influences.push(Influence::new(joint, weight));
                }
            };
            point.joints().into_iter().for_each(|(joint, weight)| add(joint, weight));
            while let Some((_, joint, weight)) = more.next_if(|(of, ..)| *of == vertex) {
                add(*joint, *weight);
            }
            if influences.len() == start {
                influences.push(Influence::new(joints.of_node(point.node()), 1.0));
            }
            ends.push(start..influences.len());
        }
        let influences: Vec<&[Influence]> = ends.into_iter().map(|range| &influences[range]).collect();
        let positions: Vec<Vec3> = self.points().iter().map(|point| point.position()).collect();
        let triangles: Vec<[u32; 3]> = self.triangles().iter().map(|triangle| triangle.vertices.map(narrow)).collect();
        let mesh = Mesh::new(positions, triangles, &influences)
            .and_then(|mesh| mesh.with_normals(self.normals()))
            .and_then(|mesh| mesh.with_morphs(&*self.influences.morphs));
        let skin = Skin::with_inverse_rest(skeleton, joints.bones, joints.inverse_rest);
        // Cannot fail: everything was validated when it was read.
        mesh.ok().zip(skin.ok()).unwrap_or_default()
    }

    /// Weights at rest of the [mesh](Self::mesh)'s morph targets, used where no clip animates them. The targets of each
    /// node that has some are consecutive.
    #[must_use]
    pub fn morph_weights(&self) -> &[f32] {
        &self.influences.weights
    }

    /// Returns the range of a node's morph targets in [`morph_weights`](Self::morph_weights); empty if it has none.
    /// Their animated weights are the scalars of the pose given by
    /// [`Document::morph_scalars`](crate::Document::morph_scalars).
    #[must_use]
    pub fn morph_targets(&self, node: usize) -> Range<usize> {
        let found = self.influences.targets.iter().find(|(of, _)| *of == node);
        found.map_or(0..0, |(_, targets)| targets.clone())
    }
}

/// The joints of a mesh, numbered in order of first use.
struct Joints<'a> {
    skeleton: &'a Skeleton,
    bones: Vec<usize>,
    inverse_rest: Vec<Affine3A>,
    /// Joint number by bone and by the bits of its inverse bind matrix.
    known: HashMap<(usize, [u32; 12]), u32>,
    /// Joint number by skin and joint of the skin; `None` until it is used.
    of_skins: Vec<Vec<Option<u32>>>,
}

impl<'a> Joints<'a> {
    fn new(skeleton: &'a Skeleton) -> Self {
        let of_skins = (0..skeleton.skin_count()).map(|skin| vec![None; skeleton.skin(skin).0.len()]).collect();
        Self { skeleton, bones: Vec::new(), inverse_rest: Vec::new(), known: HashMap::new(), of_skins }
    }

    /// Returns the number of a skin's joint; `None` if there is no such joint.
    fn of_skin(&mut self, skin: usize, joint: usize) -> Option<u32> {
        let known = *self.of_skins.get(skin)?.get(joint)?;
        Some(known.unwrap_or_else(|| {
            let (bones, binds) = self.skeleton.skin(skin);
            let number =
                self.numbered(bones[joint], binds[joint].map_or(Affine3A::IDENTITY, |bind| bind.as_affine3a()));
            self.of_skins[skin][joint] = Some(number);
            number
        }))
    }

    /// Returns the joint number of a node that shows a rigid mesh.
    fn of_node(&mut self, node: usize) -> u32 {
        self.numbered(node, Affine3A::IDENTITY)
    }

    fn numbered(&mut self, bone: usize, inverse_rest: Affine3A) -> u32 {
        let key = (bone, inverse_rest.to_cols_array().map(f32::to_bits));
        *self.known.entry(key).or_insert_with(|| {
            self.bones.push(bone);
            self.inverse_rest.push(inverse_rest);
            narrow(self.bones.len() - 1)
        })
    }
}

/// Narrows a number of vertices, joints or targets, all of which are limited far below 2³².
fn narrow(number: usize) -> u32 {
    u32::try_from(number).unwrap_or(u32::MAX)
}
