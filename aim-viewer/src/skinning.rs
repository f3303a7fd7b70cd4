//! [`Skinning`]: what moves the vertices of a surface, once for each model; and the numbers of each figure and frame.

use std::collections::BTreeMap;

use aim_gltf::{Skeleton, Surface};
use aim_runtime::glam::{Affine3A, DAffine3, Vec3};

/// The joints of a surface and what each vertex has of them.
#[derive(Debug)]
pub(crate) struct Skinning {
    joints: Vec<Joint>,
    /// For each vertex the indices of its joints.
    pub(crate) influences: Vec<[u32; 4]>,
    /// Their weights, together 1.
    pub(crate) weights: Vec<[f32; 4]>,
}

/// A node that moves vertices.
#[derive(Debug)]
struct Joint {
    node: usize,
    /// Joint ← mesh.
    bind: DAffine3,
    /// The lowest and the highest coordinates of what it moves, in the space of the mesh.
    reach: [Vec3; 2],
}

impl Skinning {
    pub(crate) fn new(skeleton: &Skeleton, surface: &Surface) -> Self {
        let mut known = BTreeMap::new();
        let mut joints = Vec::new();
        let (mut influences, mut weights) = (Vec::new(), Vec::new());
        for point in surface.points() {
            let total: f32 = point.joints().iter().map(|(_, weight)| weight).sum();
            let skin = skeleton.nodes()[point.node()].skin.filter(|_| total > 0.0);
            let mut joint = |skin: Option<(usize, u16)>| {
                let (node, bind) = match skin {
                    Some((skin, joint)) => {
                        let (nodes, binds) = skeleton.skin(skin);
                        (nodes[usize::from(joint)], binds[usize::from(joint)])
                    }
                    None => (point.node(), None),
                };
                let at = *known.entry(skin.ok_or(node)).or_insert_with(|| {
                    let reach = [Vec3::INFINITY, Vec3::NEG_INFINITY];
                    joints.push(Joint { node, bind: bind.unwrap_or(DAffine3::IDENTITY), reach });
                    joints.len() - 1
                });
                let [low, high] = joints[at].reach;
                joints[at].reach = [low.min(point.position()), high.max(point.position())];
                u32::try_from(at).unwrap_or(0)
            };
            let (of_vertex, parts) = match skin {
                Some(skin) => {
                    let moved =
                        point.joints().map(|(at, weight)| if weight == 0.0 { 0 } else { joint(Some((skin, at))) });
                    (moved, point.joints().map(|(_, weight)| weight / total))
                }
                None => ([joint(None), 0, 0, 0], [1.0, 0.0, 0.0, 0.0]),
            };
            influences.push(of_vertex);
            weights.push(parts);
        }
        Self { joints, influences, weights }
    }

    /// World ← mesh for each joint, `shift` added.
    fn matrices<'a>(&'a self, world: &'a [DAffine3], shift: Vec3) -> impl Iterator<Item = Affine3A> + 'a {
        self.joints.iter().map(move |joint| {
            let mut matrix = (world[joint.node] * joint.bind).as_affine3a();
            matrix.translation += aim_runtime::glam::Vec3A::from(shift);
            matrix
        })
    }

    /// Three rows for each joint: what the vertex shader reads.
    pub(crate) fn rows(&self, world: &[DAffine3], shift: Vec3) -> Vec<[f32; 4]> {
        let rows = |matrix: Affine3A| {
            let [x, y, z] = matrix.matrix3.transpose().to_cols_array_2d();
            let [a, b, c] = matrix.translation.to_array();
            [(x, a), (y, b), (z, c)].map(|([x, y, z], w)| [x, y, z, w])
        };
        self.matrices(world, shift).flat_map(rows).collect()
    }

    /// The lowest and highest coordinates that no vertex leaves: of the boxes that each joint moves.
    pub(crate) fn bounds(&self, world: &[DAffine3], shift: Vec3) -> [Vec3; 2] {
        let mut bounds = [Vec3::INFINITY, Vec3::NEG_INFINITY];
        for (joint, matrix) in self.joints.iter().zip(self.matrices(world, shift)) {
            let [low, high] = joint.reach;
            for corner in 0..8_u8 {
                let pick = |axis: usize| if corner >> axis & 1 == 0 { low[axis] } else { high[axis] };
                let at = matrix.transform_point3(Vec3::new(pick(0), pick(1), pick(2)));
                bounds = [bounds[0].min(at), bounds[1].max(at)];
            }
        }
        bounds
    }
}
