//! Bind transforms of bones, from the skins that they move.

use aim::glam::Affine3A;
use bevy_asset::Assets;
use bevy_ecs::entity::{Entity, EntityHashMap};
use bevy_ecs::system::{Query, Res, SystemParam};
use bevy_mesh::skinning::{SkinnedMesh, SkinnedMeshInverseBindposes};

use crate::find::Node;

/// Access to the skins of meshes and their inverse bind matrices.
#[derive(SystemParam)]
pub(crate) struct Skins<'w, 's> {
    meshes: Query<'w, 's, &'static SkinnedMesh>,
    inverse_binds: Option<Res<'w, Assets<SkinnedMeshInverseBindposes>>>,
}

impl Skins<'_, '_> {
    /// Returns the inverse bind transform of each node; `None` for nodes that no skin lists. All are expressed in the
    /// space of the mesh whose skin has the most joints. A skin without a joint in common with those before it cannot
    /// be converted to that space and is left out.
    pub(crate) fn inverse_binds(&self, below: &[Node<'_>]) -> Vec<Option<Affine3A>> {
        let mut known: Vec<Option<Affine3A>> = vec![None; below.len()];
        let places: EntityHashMap<usize> = below.iter().enumerate().map(|(at, node)| (node.entity, at)).collect();
        let mut skins: Vec<Vec<(usize, Affine3A)>> =
            below.iter().filter_map(|node| self.skin(node.entity, &places)).collect();
        skins.sort_by_key(|joints| std::cmp::Reverse(joints.len()));
        for (number, joints) in skins.into_iter().enumerate() {
            // For a shared joint, `own * first_to_own == known`, so `first_to_own = own⁻¹ * known`: first mesh → bone →
            // own mesh.
            let shared = || joints.iter().find_map(|(joint, own)| Some(own.inverse() * known[*joint]?));
            let Some(first_to_own) = (if number == 0 { Some(Affine3A::IDENTITY) } else { shared() }) else { continue };
            for (joint, own) in joints {
                known[joint].get_or_insert(own * first_to_own);
            }
        }
        known
    }

    fn skin(&self, mesh: Entity, places: &EntityHashMap<usize>) -> Option<Vec<(usize, Affine3A)>> {
        let skin = self.meshes.get(mesh).ok()?;
        let inverse_binds = self.inverse_binds.as_ref()?.get(&skin.inverse_bindposes)?;
        let joints = skin.joints.iter().zip(inverse_binds.iter());
        let is_regular = |bind: &Affine3A| bind.is_finite() && bind.inverse().is_finite();
        let joints = joints.filter_map(|(joint, bind)| Some((*places.get(joint)?, Affine3A::from_mat4(*bind))));
        Some(joints.filter(|(_, bind)| is_regular(bind)).collect())
    }
}
