//! [`Surface`]: the triangles of a document, ready to be posed and drawn. Parts that cannot be read are left out,
//! without an error.

use core::ops::Range;
use std::sync::Arc;

use aim_animation::glam::{DAffine3, Vec2, Vec3};
use serde_json::Value;

use crate::accessor::Data;
use crate::document::{Document, bytes_of};
use crate::material::{self, Material};
use crate::mesh::VertexInfluences;
use crate::normals::normals;
use crate::raw::{Primitive, Raw};
use crate::skeleton::Skeleton;
use crate::skin::{SkinnedPoint, carrier, read_primitive};

/// Maximum number of triangles; further ones are dropped.
const MOST_TRIANGLES: usize = 2_000_000;
/// Maximum number of vertices; a primitive that would exceed it is skipped.
const MOST_VERTICES: usize = 4_000_000;

/// A triangle of a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Triangle {
    /// Indices into the vertices, counter-clockwise seen from outside.
    pub vertices: [usize; 3],
    /// Index into [`Surface::materials`]; `None` if the file gives none.
    pub material: Option<usize>,
}

/// The meshes of a document as its nodes show them, skinned or not.
#[derive(Debug, Clone, Default)]
pub struct Surface {
    points: Vec<SkinnedPoint>,
    normals: Vec<Vec3>,
    texture_coordinates: Vec<Vec2>,
    tints: Vec<[f32; 4]>,
    triangles: Vec<Triangle>,
    materials: Vec<Material>,
    images: Vec<Arc<[u8]>>,
    pub(crate) influences: VertexInfluences,
}

impl Document {
    /// Returns the triangles of every mesh that a node shows, with their appearance. Points, lines, compressed or
    /// broken geometry and missing pictures are left out. Vertices have no morph targets applied; [`Surface::mesh`]
    /// includes those.
    #[must_use]
    pub fn surface(&self) -> Surface {
        let mut surface = Surface::default();
        let Ok((raw, _)) = Raw::parse(self.text()) else { return surface };
        let slices: Vec<_> = self.buffers.iter().map(|b| bytes_of(b, self.chunk.as_deref())).collect();
        let data = Data::new(&raw, &slices);
        (surface.materials, surface.images) = material::read(self, &data);
        let skeleton = self.skeleton();
        let world = skeleton.world_f64(&[]);
        let mirrors = |node: usize| {
            let skinned = skeleton.nodes()[node].skin.and_then(|skin| {
                let (joints, binds) = skeleton.skin(skin);
                Some(world[*joints.first()?] * binds.first()?.unwrap_or(DAffine3::IDENTITY))
            });
            skinned.unwrap_or(world[node]).matrix3.determinant() < 0.0
        };
        for (node, mesh) in raw.nodes.iter().enumerate().filter_map(|(i, node)| Some((i, node.mesh?))) {
            let is_mirrored = skeleton.bone_of(node).is_some_and(mirrors);
            let bone = skeleton.bone_of(node).unwrap_or_default();
            let targets = surface.influences.add_targets(&data, node, bone);
            for (index, primitive) in raw.meshes[mesh].primitives.iter().enumerate() {
                let json = &self.json()["meshes"][mesh]["primitives"][index];
                surface.add(
                    skeleton,
                    &ShownPrimitive { data: &data, node, primitive, json, is_mirrored, targets: targets.clone() },
                );
            }
        }
        surface
    }
}

/// A primitive as shown by a node.
struct ShownPrimitive<'a> {
    data: &'a Data<'a>,
    /// The file's index of the node.
    node: usize,
    primitive: &'a Primitive,
    json: &'a Value,
    /// `true` if the node's transform is mirrored (negative determinant), which reverses the winding.
    is_mirrored: bool,
    /// Numbers of the node's morph targets.
    targets: Range<usize>,
}

impl ShownPrimitive<'_> {
    /// Reads an attribute that has a value for each vertex; `None` if it is missing or broken.
    fn attribute<const N: usize>(&self, name: &str, shape: &str, vertices: usize) -> Option<Vec<[f32; N]>> {
        let accessor = *self.primitive.attributes.get(name)?;
        let floats = self.data.floats(accessor, &[shape], name).ok()?;
        (floats.len() == N * vertices).then(|| floats.as_chunks().0.to_vec())
    }

    /// Linear vertex colours, which multiply the material's.
    fn tints(&self, vertices: usize) -> Option<Vec<[f32; 4]>> {
        let tints = self.attribute("COLOR_0", "VEC4", vertices).or_else(|| {
            let opaque = |[r, g, b]: [f32; 3]| [r, g, b, 1.0];
            Some(self.attribute("COLOR_0", "VEC3", vertices)?.into_iter().map(opaque).collect())
        });
        tints.map(|tints| tints.into_iter().map(|tint| tint.map(|part| part.clamp(0.0, 1.0))).collect())
    }

    /// Returns the primitive's triangles among its `vertices` vertices, counter-clockwise seen from outside.
    fn triangles(&self, vertices: usize) -> Vec<[usize; 3]> {
        let corners = match self.json.get("indices").map(Value::as_u64) {
            None => (0..vertices).collect(),
            Some(accessor) => {
                let accessor = accessor.and_then(|at| usize::try_from(at).ok());
                let indices = accessor.map(|at| self.data.floats(at, &["SCALAR"], "indices"));
                let Some(Ok(indices)) = indices else { return Vec::new() };
                indices.iter().map(|i| whole(*i)).collect::<Vec<usize>>()
            }
        };
        let mut triangles = triangles(self.json.get("mode").map_or(Some(4), Value::as_u64), &corners);
        triangles.retain(|triangle| triangle.iter().all(|vertex| *vertex < vertices));
        if self.is_mirrored {
            triangles.iter_mut().for_each(|triangle| triangle.swap(1, 2));
        }
        triangles
    }
}

impl Surface {
    fn add(&mut self, skeleton: &Skeleton, part: &ShownPrimitive<'_>) {
        let count = part.primitive.attributes.get("POSITION").and_then(|at| part.data.accessor(*at, "POSITION").ok());
        if count.is_none_or(|accessor| self.points.len().saturating_add(accessor.count) > MOST_VERTICES) {
            return;
        }
        let Ok(points) = read_primitive(part.data, part.node, part.primitive) else { return };
        let (start, count) = (self.points.len(), points.len());
        let mut triangles = part.triangles(count);
        triangles.truncate(MOST_TRIANGLES - self.triangles.len());
        let material = part.json.get("material").and_then(Value::as_u64).and_then(|at| usize::try_from(at).ok());
        let material = material.filter(|at| *at < self.materials.len());
        let given = part.attribute("NORMAL", "VEC3", count);
        let given = given.map(|given| given.into_iter().map(Vec3::from).collect::<Vec<_>>());
        self.normals.extend(given.unwrap_or_else(|| {
            let positions: Vec<Vec3> = points.iter().map(SkinnedPoint::position).collect();
            // The winding of mirrored triangles has been swapped above, but normals are in the mesh's own space: undo
            // it.
            let inside_out = if part.is_mirrored { -1.0 } else { 1.0 };
            normals(&positions, &triangles).into_iter().map(|normal| normal * inside_out).collect()
        }));
        let texture = material.and_then(|at| self.materials[at].texture);
        let coordinates = texture.and_then(|texture| {
            let read = part.attribute(&format!("TEXCOORD_{}", texture.set), "VEC2", count)?;
            Some(read.into_iter().map(|at| texture.transform.transform_point2(at.into())).collect())
        });
        self.texture_coordinates.extend(coordinates.unwrap_or_else(|| vec![Vec2::ZERO; count]));
        self.tints.extend(part.tints(count).unwrap_or_else(|| vec![[1.0; 4]; count]));
        let placed = |triangle: [usize; 3]| Triangle { vertices: triangle.map(|vertex| start + vertex), material };
        self.triangles.extend(triangles.into_iter().map(placed));
        self.points.extend(points.into_iter().map(|point| point.counted(skeleton)));
        self.influences.add_joints(part.data, part.primitive, start..start + count);
        self.influences.add_morphs(part.data, part.primitive, part.targets.clone(), start..start + count);
    }

    /// The triangles.
    #[must_use]
    pub fn triangles(&self) -> &[Triangle] {
        &self.triangles
    }

    /// The materials, in the file's order.
    #[must_use]
    pub fn materials(&self) -> &[Material] {
        &self.materials
    }

    /// The pictures that materials use, encoded as in the file: PNG or JPEG, if it follows the specification.
    #[must_use]
    pub fn images(&self) -> &[Arc<[u8]>] {
        &self.images
    }

    /// Coordinates of each vertex in its material's picture: right and down from the upper left corner, the picture
    /// being 0…1. Zero if there is no picture.
    #[must_use]
    pub fn texture_coordinates(&self) -> &[Vec2] {
        &self.texture_coordinates
    }

    /// Colour factor of each vertex, which multiplies its material's colour: linear red, green, blue and opacity, in
    /// 0…1. All ones if the file gives none.
    #[must_use]
    pub fn tints(&self) -> &[[f32; 4]] {
        &self.tints
    }

    /// The vertices.
    #[must_use]
    pub fn points(&self) -> &[SkinnedPoint] {
        &self.points
    }

    /// The normals of the vertices, each in the space of its mesh, of length one or zero. Normals missing in the file
    /// are computed from the faces, smoothed across edges of less than 60°.
    #[must_use]
    pub fn normals(&self) -> &[Vec3] {
        &self.normals
    }

    /// Returns the node that moves a vertex most: its heaviest joint, or the node that shows it. `None` if there is no
    /// such vertex.
    #[must_use]
    pub fn node_of(&self, skeleton: &Skeleton, vertex: usize) -> Option<usize> {
        self.points.get(vertex).map(|point| carrier(skeleton, point))
    }
}

/// Splits corners into triangles by the primitive's `mode`: list (4), strip (5) or fan (6). Other modes have none.
fn triangles(mode: Option<u64>, corners: &[usize]) -> Vec<[usize; 3]> {
    let strip = |(k, w): (usize, &[usize])| if k % 2 == 0 { [w[0], w[1], w[2]] } else { [w[1], w[0], w[2]] };
    match mode {
        Some(4) => corners.chunks_exact(3).map(|c| [c[0], c[1], c[2]]).collect(),
        Some(5) => corners.windows(3).enumerate().map(strip).collect(),
        Some(6) => corners.get(1..).unwrap_or_default().windows(2).map(|w| [corners[0], w[0], w[1]]).collect(),
        _ => Vec::new(),
    }
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "indices are small and not negative; anything else saturates and is then found to be out of range"
)]
fn whole(index: f32) -> usize {
    index as usize
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn strips_and_fans_are_triangles_and_lines_are_none() {
        assert_eq!(triangles(Some(5), &[0, 1, 2, 3]), [[0, 1, 2], [2, 1, 3]]);
        assert_eq!(triangles(Some(6), &[0, 1, 2, 3]), [[0, 1, 2], [0, 2, 3]]);
        assert!(triangles(Some(1), &[0, 1, 2, 3]).is_empty(), "lines");
        assert!(triangles(Some(6), &[]).is_empty(), "nothing");
    }
}
