//! Mesh vertices and the joints they hang on, as far as measuring needs them: positions and weights.

use std::collections::BTreeSet;

use glam::{Affine3A, DAffine3, DVec3, Mat3A, Vec3, Vec3A};

use crate::accessor::Data;
use crate::error::Error;
use crate::raw::Primitive;
use crate::skeleton::Skeleton;

/// A vertex: its position in mesh space, the node that shows it, and its joints.
#[derive(Debug, Clone)]
pub(crate) struct SkinnedPoint {
    // Kept as narrow as files have them: there are as many as the file is large.
    position: Vec3,
    node: u32,
    /// (index into the skin's joints, weight); empty when the mesh is not skinned.
    joints: [(u16, f32); 4],
}

impl SkinnedPoint {
    /// In mesh space.
    pub(crate) fn position(&self) -> Vec3 {
        self.position
    }

    /// The node whose mesh it belongs to.
    pub(crate) fn node(&self) -> usize {
        self.node as usize
    }
}

/// The vertices of every mesh, as the first node shows it that does (preferably skinned). Primitives without positions
/// are skipped, vertices that several primitives share are taken once.
pub(crate) fn read_points(data: &Data<'_>) -> Result<Vec<SkinnedPoint>, Error> {
    let mut points = Vec::new();
    for (mesh_index, mesh) in data.raw.meshes.iter().enumerate() {
        let mut shown = (0..data.raw.nodes.len()).filter(|i| data.raw.nodes[*i].mesh == Some(mesh_index));
        let Some(first) = shown.next() else { continue };
        let skinned = |i: &usize| data.raw.nodes[*i].skin.is_some();
        let index = core::iter::once(first).chain(shown).find(skinned).unwrap_or(first);
        let mut seen = BTreeSet::new();
        for primitive in &mesh.primitives {
            let at = primitive.attributes.get("POSITION");
            if at.is_some_and(|at| seen.insert(*at)) {
                points.extend(read_primitive(data, index, primitive)?);
            }
        }
    }
    Ok(points)
}

/// The vertices of one primitive as node `index` shows it, in the accessor's order; none without positions that can be
/// read.
pub(crate) fn read_primitive(data: &Data<'_>, index: usize, primitive: &Primitive) -> Result<Vec<SkinnedPoint>, Error> {
    let node = &data.raw.nodes[index];
    let attribute = |name: &str| primitive.attributes.get(name).copied();
    let Some(positions) = attribute("POSITION") else { return Ok(Vec::new()) };
    let place = format!("the mesh of nodes[{index}]");
    // Compressed geometry is no obstacle to aiming: only its shape stays unknown.
    let positions = match data.floats(positions, &["VEC3"], &place) {
        Err(Error::NoData { .. }) => return Ok(Vec::new()),
        other => other?,
    };
    let mut joints = Vec::new();
    let mut weights = Vec::new();
    if let (Some(skin), Some(j), Some(w)) = (node.skin, attribute("JOINTS_0"), attribute("WEIGHTS_0")) {
        joints = data.floats(j, &["VEC4"], &place)?;
        weights = data.floats(w, &["VEC4"], &place)?;
        let count = data.raw.skins.get(skin).map_or(0, |s| s.joints.len());
        if joints.len() != positions.len() / 3 * 4 || weights.len() != joints.len() {
            return Err(Error::invalid(place, "its joints, weights and positions differ in number"));
        }
        let beyond = |(j, w): (&f32, &f32)| *w != 0.0 && (*j < 0.0 || f64::from(*j) >= crate::num::count(count));
        if joints.iter().zip(&weights).any(beyond) {
            return Err(Error::invalid(place, format!("a vertex is bound to a joint beyond the skin's {count}")));
        }
    }
    let point = |(k, p): (usize, &[f32])| {
        let bound = |i: usize| match (joints.get(k * 4 + i), weights.get(k * 4 + i)) {
            (Some(j), Some(w)) if *w != 0.0 => (to_index(*j), *w),
            _ => (0, 0.0),
        };
        SkinnedPoint {
            position: Vec3::from_slice(p),
            node: u32::try_from(index).unwrap_or(u32::MAX),
            joints: [bound(0), bound(1), bound(2), bound(3)],
        }
    };
    Ok(positions.chunks_exact(3).enumerate().map(point).collect())
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "checked to be a joint index just before")]
fn to_index(joint: f32) -> u16 {
    joint as u16
}

/// The node that moves each vertex most: its heaviest joint, or the node that shows it.
pub(crate) fn carriers(skeleton: &Skeleton, points: &[SkinnedPoint]) -> Vec<usize> {
    points.iter().map(|point| carrier(skeleton, point)).collect()
}

/// The node that moves a vertex most.
pub(crate) fn carrier(skeleton: &Skeleton, point: &SkinnedPoint) -> usize {
    let (joint, weight) = point.joints.iter().fold((0, 0.0), |best, at| if at.1 > best.1 { *at } else { best });
    let joints = skeleton.nodes()[point.node()].skin.map(|skin| skeleton.skin(skin).0).filter(|_| weight > 0.0);
    joints.and_then(|joints| joints.get(usize::from(joint)).copied()).unwrap_or(point.node())
}

/// Transforms that move vertices: world transforms of all nodes, and of each skin's joints after their inverse binds.
pub(crate) struct Palette<'a> {
    skeleton: &'a Skeleton,
    world: &'a [DAffine3],
    skinned: Vec<Vec<DAffine3>>,
}

impl<'a> Palette<'a> {
    pub(crate) fn new(skeleton: &'a Skeleton, world: &'a [DAffine3]) -> Self {
        let of = |skin: usize| {
            let (joints, binds) = skeleton.skin(skin);
            joints.iter().zip(binds).map(|(joint, bind)| world[*joint] * bind.unwrap_or(DAffine3::IDENTITY)).collect()
        };
        Self { skeleton, world, skinned: (0..skeleton.skin_count()).map(of).collect() }
    }

    /// True if it turns the mesh of `node` inside out.
    pub(crate) fn mirrors(&self, node: usize) -> bool {
        let joint = self.skeleton.nodes()[node].skin.and_then(|skin| self.skinned[skin].first());
        joint.unwrap_or(&self.world[node]).matrix3.determinant() < 0.0
    }

    /// World-space vertices; skinned ones by linear blending.
    pub(crate) fn deform(&self, points: &[SkinnedPoint]) -> Vec<DVec3> {
        let place = |point: &SkinnedPoint| {
            let position = point.position.as_dvec3();
            let total: f64 = point.joints.iter().map(|(_, w)| f64::from(*w)).sum();
            match self.skeleton.nodes()[point.node()].skin {
                Some(skin) if total > 0.0 => {
                    let part = |(joint, weight): &(u16, f32)| {
                        if *weight == 0.0 {
                            DVec3::ZERO
                        } else {
                            self.skinned[skin][usize::from(*joint)].transform_point3(position) * f64::from(*weight)
                        }
                    };
                    point.joints.iter().map(part).sum::<DVec3>() / total
                }
                _ => self.world[point.node()].transform_point3(position),
            }
        };
        points.iter().map(place).collect()
    }

    /// The same in single precision with normals, made to be fast: one blended matrix for both.
    pub(crate) fn pose(&self, points: &[SkinnedPoint], normals: &[Vec3], to: (&mut Vec<Vec3>, &mut Vec<Vec3>)) {
        let motion = |affine: &DAffine3| Motion::new(affine.as_affine3a());
        let skinned: Vec<Vec<Motion>> = self.skinned.iter().map(|joints| joints.iter().map(motion).collect()).collect();
        let (placed, turned) = to;
        placed.clear();
        turned.clear();
        placed.reserve(points.len());
        turned.reserve(points.len());
        let mut move_by = |motion: &Motion, point: &SkinnedPoint, normal: Vec3| {
            placed.push(motion.place.transform_point3(point.position));
            turned.push(motion.turn(normal));
        };
        // Points come node by node: what is the same for a node is looked up once.
        let mut normals = normals.iter();
        for of_node in points.chunk_by(|a, b| a.node == b.node) {
            let node = of_node[0].node();
            let rigid = motion(&self.world[node]);
            let joints = self.skeleton.nodes()[node].skin.map_or(&[][..], |skin| &skinned[skin]);
            for (point, normal) in of_node.iter().zip(normals.by_ref()) {
                let total: f32 = point.joints.iter().map(|(_, weight)| weight).sum();
                match point.joints {
                    _ if total <= 0.0 || joints.is_empty() => move_by(&rigid, point, *normal),
                    [(only, _), (_, 0.0), (_, 0.0), (_, 0.0)] => move_by(&joints[usize::from(only)], point, *normal),
                    several => move_by(&Motion::blended(joints, several, total), point, *normal),
                }
            }
        }
    }
}

/// A transform of points with its transform of normals.
struct Motion {
    place: Affine3A,
    /// The inverse's transpose times the determinant's size: right for scales that differ, and for mirrors.
    normals: Mat3A,
}

impl Motion {
    fn new(place: Affine3A) -> Self {
        let Mat3A { x_axis: x, y_axis: y, z_axis: z } = place.matrix3;
        let cofactors = Mat3A::from_cols(y.cross(z), z.cross(x), x.cross(y));
        let is_mirror = x.dot(cofactors.x_axis) < 0.0;
        Self { place, normals: if is_mirror { -cofactors } else { cofactors } }
    }

    /// The mean of joints' motions by their weights, which sum up to `total`.
    fn blended(joints: &[Self], weights: [(u16, f32); 4], total: f32) -> Self {
        let (mut matrix3, mut translation) = (Mat3A::ZERO, Vec3A::ZERO);
        let scale = total.recip();
        for (joint, weight) in weights {
            if weight != 0.0 {
                let (share, joint) = (weight * scale, &joints[usize::from(joint)].place);
                matrix3 += joint.matrix3 * share;
                translation += joint.translation * share;
            }
        }
        Self::new(Affine3A { matrix3, translation })
    }

    /// Of length one; up where nothing is left of it.
    fn turn(&self, normal: Vec3) -> Vec3 {
        let turned = self.normals * Vec3A::from(normal);
        // What is as small as this has lost its direction.
        let is_there = (1e-30..f32::MAX).contains(&turned.length_squared());
        if is_there { turned.normalize().into() } else { Vec3::Y }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normals_stay_square_to_what_they_stand_on() {
        let (tangent, normal) = (Vec3::new(1.0, 1.0, 0.0), Vec3::new(1.0, -1.0, 0.5).normalize());
        for scale in [Vec3::ONE, Vec3::new(1.0, 3.0, 0.2), Vec3::new(-1.0, 2.0, 1.0), Vec3::splat(1e-6)] {
            let matrix = Mat3A::from_rotation_z(0.3) * Mat3A::from_diagonal(scale);
            let (turned, along) = (Motion::new(Affine3A::from_mat3(matrix.into())).turn(normal), matrix * tangent);
            assert!((turned.length() - 1.0).abs() < 1e-5, "{scale}: {turned}");
            assert!(turned.dot(along.normalize()).abs() < 1e-5, "{scale}: {turned} on {along}");
            assert!(turned.dot(matrix * normal) > 0.0, "{scale}: it points to the same side");
        }
        assert_eq!(Motion::new(Affine3A::ZERO).turn(normal), Vec3::Y, "nothing is left of it");
    }
}
