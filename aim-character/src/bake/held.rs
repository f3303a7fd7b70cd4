//! [`Held`]: what hangs on a joint that turns, but belongs to what carries it: the clavicles of many skeletons, which
//! hang on the neck.

use aim_runtime::{Description, Rig};
use glam::{DAffine3, DMat3, DQuat};

use crate::bake::chain::{ChainNodes, Hold};
use crate::measure::Measurement;
use crate::measure::frame::orthonormal;
use crate::measure::limbs::limbs_on;
use aim_animation::Transform;
use aim_gltf::Skeleton;

/// A node that keeps its place on the carrier of the joint that it hangs on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Held {
    pub(crate) node: usize,
    /// The [carrier](Description::carrier); `None` for what is not turned.
    carrier: Option<usize>,
}

impl Held {
    /// The nodes to hold while a rig turns those of the chain: those that the chain names, else the arms on head and neck.
    pub(crate) fn find(rig: &dyn Rig, skeleton: &Skeleton, measurement: &Measurement, chain: &ChainNodes) -> Vec<Self> {
        let description = rig.description();
        let holds = chain.holds.clone().unwrap_or_else(|| found(&description, skeleton, measurement, chain));
        let carrier = |joint: usize| description.carrier(joint).and_then(|carrier| chain.joints.get(carrier));
        holds.iter().map(|hold| Self { node: hold.node, carrier: carrier(hold.joint).copied() }).collect()
    }

    /// Moves it back to where its carrier has it. `animated` are the nodes in the world before anything was turned, and
    /// `turned` after it.
    pub(crate) fn hold(&self, skeleton: &Skeleton, pose: &mut [Transform], animated: &[DAffine3], turned: &[DAffine3]) {
        let node = self.node;
        let carried = self.carrier.map_or(DAffine3::IDENTITY, |by| turned[by] * animated[by].inverse());
        let Some(parent) = skeleton.parents()[node] else { return };
        let local = turned[parent].inverse() * carried * animated[node];
        let unscaled = DMat3::from_diagonal(pose[node].scale.as_dvec3().recip());
        let rotation = DQuat::from_mat3(&orthonormal(&(local.matrix3 * unscaled)).0);
        // Hidden by a scale of 0, it has no place to keep.
        if local.is_finite() && unscaled.is_finite() && rotation.is_finite() {
            pose[node].rotation = rotation.normalize().as_quat();
            pose[node].translation = local.translation.as_vec3();
        }
    }
}

/// The arms that hang on the innermost joint of head and neck.
fn found(
    description: &Description<'_>,
    skeleton: &Skeleton,
    measurement: &Measurement,
    chain: &ChainNodes,
) -> Vec<Hold> {
    let is_of_head = |joint: &usize| description.joints()[*joint].role.is_of_head();
    let Some(joint) = (0..chain.joints.len()).rfind(is_of_head) else { return Vec::new() };
    limbs_on(skeleton, measurement, chain.joints[joint]).into_iter().map(|node| Hold { joint, node }).collect()
}
