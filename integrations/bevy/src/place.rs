//! World transforms of entities in this frame, computed from the `Transform`s of an entity and its ancestors.
//! `GlobalTransform` cannot be used: until propagation it is the previous frame's, corrections included.

use aim::animation;
use aim::glam::{Affine3A, Quat};
use bevy_ecs::entity::Entity;
use bevy_ecs::hierarchy::ChildOf;
use bevy_ecs::query::QueryData;
use bevy_ecs::system::Query;
use bevy_transform::components::Transform;

use crate::AimedBone;

/// Components read to compute an entity's world transform.
#[derive(QueryData)]
pub(crate) struct Node {
    pub(crate) transform: &'static Transform,
    pub(crate) parent: Option<&'static ChildOf>,
    pub(crate) bone: Option<&'static AimedBone>,
}

/// Query for all entities with a `Transform`.
pub(crate) type Nodes<'w, 's> = Query<'w, 's, Node>;

/// Greatest number of ancestors that are followed, as Bevy does not prevent cycles in the hierarchy.
const MOST_ANCESTORS: usize = 4096;

/// Returns an entity's world transform. Aimed bones among it and its ancestors have their last corrections applied.
/// `None` if the entity or an ancestor has no `Transform`.
pub(crate) fn in_world(entity: Entity, nodes: &Nodes<'_, '_>) -> Option<Affine3A> {
    let mut place = Affine3A::IDENTITY;
    let mut at = entity;
    for _ in 0..MOST_ANCESTORS {
        let node = nodes.get(at).ok()?;
        let local = node.bone.map_or(*node.transform, |bone| bone.corrected(node.transform));
        place = local.compute_affine() * place;
        match node.parent {
            Some(parent) => at = parent.parent(),
            None => return Some(place),
        }
    }
    None
}

/// Converts Bevy's transform to that of `aim::animation`.
pub(crate) fn of_bevy(transform: &Transform) -> animation::Transform {
    let Transform { translation, rotation, scale } = *transform;
    animation::Transform { translation, rotation, scale }
}

impl AimedBone {
    /// Returns the transform without the correction. A rotation or translation that still has the value last written by
    /// the plugin has not been animated since, so the stored animated value is used.
    ///
    /// Bevy does not reset bones that no clip writes, such as eyes or the bones of a paused character. Without this
    /// step, corrections would accumulate.
    pub(crate) fn animated(&self, now: &Transform) -> Transform {
        let mut animated = *now;
        if now.rotation == self.written.rotation {
            animated.rotation = self.base.rotation;
        }
        if now.translation == self.written.translation {
            animated.translation = self.base.translation;
        }
        animated
    }

    /// Returns the transform with the last correction, whether or not the animation has written the bone since.
    fn corrected(&self, now: &Transform) -> Transform {
        let mut corrected = *now;
        if now.rotation != self.written.rotation {
            let turn: Quat = self.base.rotation.inverse() * self.written.rotation;
            corrected.rotation = (now.rotation * turn).normalize();
        }
        if now.translation != self.written.translation {
            corrected.translation = now.translation + (self.written.translation - self.base.translation);
        }
        corrected
    }
}
