//! A document's surface as one mesh on one skin, with all of its influences and morph targets.

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

/// Ways of vertices to morph targets at most; a file with more shows its first ones.
const MOST_MORPHS: usize = 8_000_000;
/// Morph targets at most, counted for each node; nodes past that have none.
const MOST_TARGETS: usize = 1 << 20;

/// What moves the vertices of a surface beside the first four joints of each.
#[derive(Debug, Clone, Default)]
pub(crate) struct Movers {
    /// The vertex, the joint of its skin, and the weight; in the order of the vertices.
    joints: Vec<(usize, u16, f32)>,
    morphs: Vec<Morph>,
    /// The targets of each node that has some, in the order of the targets.
    targets: Vec<(usize, Range<usize>)>,
    /// The weight of each target where no clip has any.
    weights: Vec<f32>,
}

impl Movers {
    /// Numbers the morph targets of node `index` of the file, which is this bone, with their weights at rest.
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

    /// Adds the joints of a primitive's vertices past the first four. What cannot be read is left out.
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
        // Sets stand one after the other.
        self.joints[before..].sort_by_key(|(vertex, ..)| *vertex);
    }

    /// Adds the ways of a primitive's vertices to the node's morph targets, which have these numbers.
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
    /// The whole surface as one [`Mesh`] on one [`Skin`], to be deformed, drawn by a GPU, and hit by rays. Vertices,
    /// triangles and normals keep their numbers.
    ///
    /// The skin's joints are the bones that move something: those of the file's skins with their inverse binds, and nodes
    /// whose meshes are rigid. A bone with several inverse binds is several joints. The matrices lead to the space of the
    /// model, in which [`Skeleton::to_model`](aim_animation::Skeleton::to_model) has the bones.
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
        let mut more = self.movers.joints.iter().peekable();
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
            .and_then(|mesh| mesh.with_morphs(&*self.movers.morphs));
        let skin = Skin::with_inverse_rest(skeleton, joints.bones, joints.inverse_rest);
        // Never refused: all has been checked where it was read.
        mesh.ok().zip(skin.ok()).unwrap_or_default()
    }

    /// The weights of the [mesh](Self::mesh)'s morph targets where no clip has any: those of each node that shows some, one
    /// after the other.
    #[must_use]
    pub fn morph_weights(&self) -> &[f32] {
        &self.movers.weights
    }

    /// The numbers of a node's morph targets among [those](Self::morph_weights); empty if it has none. Where a clip moves
    /// them, they are the scalars of the pose in [`Document::morph_scalars`](crate::Document::morph_scalars).
    #[must_use]
    pub fn morph_targets(&self, node: usize) -> Range<usize> {
        let found = self.movers.targets.iter().find(|(of, _)| *of == node);
        found.map_or(0..0, |(_, targets)| targets.clone())
    }
}

/// The joints of a mesh, numbered as they are first met.
struct Joints<'a> {
    skeleton: &'a Skeleton,
    bones: Vec<usize>,
    inverse_rest: Vec<Affine3A>,
    /// By bone and the bits of the inverse bind.
    known: HashMap<(usize, [u32; 12]), u32>,
    /// The same of each skin's joints.
    of_skins: Vec<Vec<Option<u32>>>,
}

impl<'a> Joints<'a> {
    fn new(skeleton: &'a Skeleton) -> Self {
        let of_skins = (0..skeleton.skin_count()).map(|skin| vec![None; skeleton.skin(skin).0.len()]).collect();
        Self { skeleton, bones: Vec::new(), inverse_rest: Vec::new(), known: HashMap::new(), of_skins }
    }

    /// A skin's joint; `None` if there is no such joint.
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

    /// A node that shows a rigid mesh.
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

/// A number of vertices, joints or targets: far fewer than 32 bits count.
fn narrow(number: usize) -> u32 {
    u32::try_from(number).unwrap_or(u32::MAX)
}
