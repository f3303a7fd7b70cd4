//! The triangles that a file shows, ready to be posed and drawn. What cannot be read is left out, never an error.

use glam::{DAffine3, DVec3};
use serde_json::Value;

use crate::accessor::Data;
use crate::document::{Document, bytes_of};
use crate::raw::{Primitive, Raw};
use crate::skeleton::Skeleton;
use crate::skin::{SkinnedPoint, carrier, deform, read_primitive};

/// Triangles drawn at most; a file with more shows its first ones.
const MOST_TRIANGLES: usize = 2_000_000;

/// One triangle.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Triangle {
    /// Indices into the positions, counter-clockwise seen from outside.
    pub vertices: [usize; 3],
    /// The material's base colour, linear RGB in 0…1; `None` where a texture gives it or there is no material.
    pub colour: Option<[f64; 3]>,
}

/// The meshes of a document: what its nodes show, skinned or not.
#[derive(Debug, Clone)]
pub struct Surface {
    points: Vec<SkinnedPoint>,
    triangles: Vec<Triangle>,
}

impl Document {
    /// The triangles of every mesh that a node shows. Points, lines, and geometry that is compressed or broken are
    /// left out; shapes are at their defaults, without morph targets.
    #[must_use]
    pub fn surface(&self) -> Surface {
        let mut surface = Surface { points: Vec::new(), triangles: Vec::new() };
        let Ok((raw, _)) = Raw::parse(&self.text) else { return surface };
        let slices: Vec<_> = self.buffers.iter().map(|b| bytes_of(b, self.chunk.as_deref())).collect();
        let data = Data::new(&raw, &slices);
        for (node, mesh) in raw.nodes.iter().enumerate().filter_map(|(i, node)| Some((i, node.mesh?))) {
            for (index, primitive) in raw.meshes[mesh].primitives.iter().enumerate() {
                let json = &self.json()["meshes"][mesh]["primitives"][index];
                surface.add(&data, node, primitive, json, self.json());
            }
        }
        surface
    }
}

impl Surface {
    fn add(&mut self, data: &Data<'_>, node: usize, primitive: &Primitive, json: &Value, file: &Value) {
        let Ok(points) = read_primitive(data, node, primitive) else { return };
        let corners = match json.get("indices").map(Value::as_u64) {
            None => (0..points.len()).collect(),
            Some(accessor) => {
                let Some(accessor) = accessor.and_then(|at| usize::try_from(at).ok()) else { return };
                match data.floats(accessor, &["SCALAR"], "indices") {
                    Ok(indices) => indices.iter().map(|i| whole(*i)).collect::<Vec<usize>>(),
                    Err(_) => return,
                }
            }
        };
        let start = self.points.len();
        let colour = base_colour(json, file);
        for vertices in triangles(json.get("mode").map_or(Some(4), Value::as_u64), &corners) {
            if vertices.iter().all(|v| *v < points.len()) && self.triangles.len() < MOST_TRIANGLES {
                self.triangles.push(Triangle { vertices: vertices.map(|v| start + v), colour });
            }
        }
        self.points.extend(points);
    }

    /// The triangles.
    #[must_use]
    pub fn triangles(&self) -> &[Triangle] {
        &self.triangles
    }

    /// The vertices in the world, for `world` ← node of every node of the document: what
    /// [`Skeleton::world_f64`] gives.
    #[must_use]
    pub fn positions(&self, skeleton: &Skeleton, world: &[DAffine3]) -> Vec<DVec3> {
        deform(skeleton, &self.points, world)
    }

    /// The node that moves a vertex most: its heaviest joint, or the node that shows it; `None` past the last vertex.
    #[must_use]
    pub fn node_of(&self, skeleton: &Skeleton, vertex: usize) -> Option<usize> {
        self.points.get(vertex).map(|point| carrier(skeleton, point))
    }
}

/// The triples of corners by the primitive's mode: lists, strips and fans have triangles.
fn triangles(mode: Option<u64>, corners: &[usize]) -> Vec<[usize; 3]> {
    let strip = |(k, w): (usize, &[usize])| if k % 2 == 0 { [w[0], w[1], w[2]] } else { [w[1], w[0], w[2]] };
    match mode {
        Some(4) => corners.chunks_exact(3).map(|c| [c[0], c[1], c[2]]).collect(),
        Some(5) => corners.windows(3).enumerate().map(strip).collect(),
        Some(6) => corners.get(1..).unwrap_or_default().windows(2).map(|w| [corners[0], w[0], w[1]]).collect(),
        _ => Vec::new(),
    }
}

fn base_colour(primitive: &Value, file: &Value) -> Option<[f64; 3]> {
    let material = usize::try_from(primitive.get("material")?.as_u64()?).ok()?;
    let surface = file.get("materials")?.get(material)?.get("pbrMetallicRoughness")?;
    if surface.get("baseColorTexture").is_some() {
        return None;
    }
    let factor = surface.get("baseColorFactor")?.as_array()?;
    let part = |i: usize| Some(factor.get(i)?.as_f64()?.clamp(0.0, 1.0));
    Some([part(0)?, part(1)?, part(2)?])
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
    use crate::{Measurement, PAPER_AXES, Role, mannequin};

    fn the_mannequin() -> Document {
        let bytes = mannequin(|_| PAPER_AXES).expect("the mannequin is made of constants");
        Document::from_bytes(&bytes).expect("what we write we read")
    }

    #[test]
    fn the_mannequin_is_drawn_where_it_is_measured() {
        let document = the_mannequin();
        let (surface, measured) = (document.surface(), Measurement::of(&document));
        let positions = surface.positions(document.skeleton(), &measured.bind_world);
        let (low, high) = positions.iter().fold((f64::MAX, f64::MIN), |(lo, hi), p| (lo.min(p.y), hi.max(p.y)));
        assert!((high - low - measured.height).abs() < 1e-6, "{low} … {high} against {}", measured.height);
        assert!(surface.triangles().len() > 1000, "a whole figure");
        assert!(surface.triangles().iter().flat_map(|t| t.vertices).all(|v| v < positions.len()), "vertices exist");
        assert!(surface.triangles().iter().all(|t| t.colour.is_some()), "plain materials have colours");
        let eye = measured.with_role(Role::LeftEye).map(|bone| bone.node);
        let of_eye = (0..positions.len()).filter(|v| surface.node_of(document.skeleton(), *v) == eye);
        assert!(of_eye.count() > 100, "the eyeball hangs on the eye");
    }

    #[test]
    fn strips_and_fans_are_triangles_and_lines_are_none() {
        assert_eq!(triangles(Some(5), &[0, 1, 2, 3]), [[0, 1, 2], [2, 1, 3]]);
        assert_eq!(triangles(Some(6), &[0, 1, 2, 3]), [[0, 1, 2], [0, 2, 3]]);
        assert!(triangles(Some(1), &[0, 1, 2, 3]).is_empty(), "lines");
        assert!(triangles(Some(6), &[]).is_empty(), "nothing");
    }

    #[test]
    fn broken_indices_leave_the_triangle_out() {
        let json = r#"{"asset":{"version":"2.0"},"accessors":[{"componentType":5126,"count":3,"type":"VEC3"}],
            "nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}},
            {"attributes":{"POSITION":0},"indices":7},{"attributes":{"POSITION":0},"indices":"x"}]}]}"#;
        let document = Document::from_bytes(json.as_bytes()).expect("indices are not looked at when loading");
        assert_eq!(document.surface().triangles().len(), 1);
    }
}
