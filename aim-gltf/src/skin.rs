//! [`SkinnedPoint`]: mesh vertices and their joints, as far as measuring needs them (positions and weights).

use std::collections::BTreeSet;

use aim_animation::glam::Vec3;

use crate::accessor::Data;
use crate::error::Error;
use crate::raw::Primitive;
use crate::skeleton::Skeleton;

/// A vertex: its position in mesh space, the node that shows it, and its joints.
#[derive(Debug, Clone)]
pub struct SkinnedPoint {
    // Types as narrow as in files, because there are many of these.
    position: Vec3,
    node: u32,
    /// (index into the skin's joints, weight); all weights are 0 if the mesh is not skinned.
    joints: [(u16, f32); 4],
}

impl SkinnedPoint {
    /// Position in mesh space.
    #[must_use]
    pub fn position(&self) -> Vec3 {
        self.position
    }

    /// The node that shows the vertex's mesh.
    #[must_use]
    pub fn node(&self) -> usize {
        self.node as usize
    }

    /// Replaces the file's node index by that of the skeleton.
    pub(crate) fn counted(self, skeleton: &Skeleton) -> Self {
        let node = skeleton.bone_of(self.node()).and_then(|node| u32::try_from(node).ok());
        Self { node: node.unwrap_or(u32::MAX), ..self }
    }

    /// Up to four (index into the joints of the node's skin, weight). Unused entries have weight 0; all of them if the
    /// mesh is not skinned.
    #[must_use]
    pub fn joints(&self) -> [(u16, f32); 4] {
        self.joints
    }

    /// Index of the joint with the largest weight; `None` if the mesh is not skinned.
    #[must_use]
    pub fn heaviest(&self) -> Option<usize> {
        let (joint, weight) = self.joints.iter().fold((0, 0.0), |best, at| if at.1 > best.1 { *at } else { best });
        (weight > 0.0).then_some(usize::from(joint))
    }
}

/// Reads the vertices of every mesh that a node shows. The node of a vertex is the first that shows its mesh,
/// preferably one with a skin. Primitives without positions are skipped, and positions shared by several primitives are
/// read once.
pub(crate) fn read_points(data: &Data<'_>, skeleton: &Skeleton) -> Result<Vec<SkinnedPoint>, Error> {
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
                points.extend(read_primitive(data, index, primitive)?.into_iter().map(|point| point.counted(skeleton)));
            }
        }
    }
    Ok(points)
}

/// Reads the vertices of one primitive, in the accessor's order, as shown by node `index` of the file. Their node is
/// that file index. Empty if there are no positions that can be read.
pub(crate) fn read_primitive(data: &Data<'_>, index: usize, primitive: &Primitive) -> Result<Vec<SkinnedPoint>, Error> {
    let node = &data.raw.nodes[index];
    let attribute = |name: &str| primitive.attributes.get(name).copied();
    let Some(positions) = attribute("POSITION") else { return Ok(Vec::new()) };
    let place = format!("the mesh of nodes[{index}]");
    // Compressed geometry does not prevent aiming: only its shape stays unknown.
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
        let beyond = |(j, w): (&f32, &f32)| *w != 0.0 && (*j < 0.0 || usize::from(to_index(*j)) >= count);
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

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "an index; others saturate and are found to be out of range"
)]
pub(crate) fn to_index(joint: f32) -> u16 {
    joint as u16
}

/// Returns the node that moves a vertex most: its heaviest joint, or the node that shows it if it has none.
#[must_use]
pub fn carrier(skeleton: &Skeleton, point: &SkinnedPoint) -> usize {
    let skin = skeleton.nodes()[point.node()].skin;
    let joint = skin.zip(point.heaviest()).and_then(|(skin, joint)| skeleton.skin(skin).0.get(joint));
    joint.copied().unwrap_or(point.node())
}
