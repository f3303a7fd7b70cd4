//! Places of entities in this frame: by their own `Transform` and those of all that they hang on, for `GlobalTransform` is that of the
//! last frame, with the corrections in it.

use aim::animation;
use aim::glam::{Affine3A, Quat};
use bevy_ecs::entity::Entity;
use bevy_ecs::hierarchy::ChildOf;
use bevy_ecs::query::QueryData;
use bevy_ecs::system::Query;
use bevy_transform::components::Transform;

use crate::AimedBone;

/// The components that are read of any entity.
#[derive(QueryData)]
pub(crate) struct Node {
    pub(crate) transform: &'static Transform,
    pub(crate) parent: Option<&'static ChildOf>,
    pub(crate) bone: Option<&'static AimedBone>,
}

/// Every entity that has a place.
pub(crate) type Nodes<'w, 's> = Query<'w, 's, Node>;

/// Ancestors of an entity at most: Bevy does not keep users from making a cycle.
const MOST_ANCESTORS: usize = 4096;

/// An entity's place in the world, aimed bones as their last corrections have them; `None` if it, or an ancestor, has no
/// `Transform`.
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

/// Bevy's transform as that of the animation.
pub(crate) fn of_bevy(transform: &Transform) -> animation::Transform {
    let Transform { translation, rotation, scale } = *transform;
    animation::Transform { translation, rotation, scale }
}

impl AimedBone {
    /// The transform without correction: parts that still are as they were written are those of the animation before.
    ///
    /// Bevy restores no bone that no clip writes, as eyes and paused characters have them: corrections would add up.
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

    /// The transform with the last correction, whether or not the animation has written the bone since.
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
