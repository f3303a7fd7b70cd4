//! [`AimTarget`]: what a character looks at.

use aim::glam::Vec3;
use bevy_ecs::component::Component;
use bevy_ecs::entity::{Entity, EntityMapper, MapEntities};
#[cfg(feature = "reflect")]
use bevy_ecs::reflect::ReflectComponent;
#[cfg(feature = "reflect")]
use bevy_reflect::std_traits::ReflectDefault;

/// The targets of a character: none, one, or several by their weights. Each is a point or an entity.
///
/// Entities that are despawned are taken off the list; the character then returns to its animation, or turns to what is
/// left. See [`Targets`](aim::Targets) for how several are blended.
///
/// ```
/// use bevy_aim::AimTarget;
/// use bevy_math::Vec3;
///
/// let mostly_ahead = AimTarget::point(Vec3::Z).and_point(Vec3::X, 0.25);
/// assert_eq!(mostly_ahead.list.len(), 2);
/// ```
#[derive(Component, Clone, Debug, Default, PartialEq)]
#[component(map_entities)]
#[cfg_attr(feature = "reflect", derive(bevy_reflect::Reflect))]
#[cfg_attr(feature = "reflect", reflect(Component, Default, Debug, PartialEq, Clone))]
pub struct AimTarget {
    /// The targets; their order does not matter.
    pub list: Vec<WeightedTarget>,
}

/// One of the things that a character looks at.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "reflect", derive(bevy_reflect::Reflect))]
#[cfg_attr(feature = "reflect", reflect(Debug, PartialEq, Clone))]
pub struct WeightedTarget {
    /// Its place.
    pub at: AimAt,
    /// Its share: see [`Target::weight`](aim::Target::weight).
    pub weight: f32,
}

/// The place of a target.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "reflect", derive(bevy_reflect::Reflect))]
#[cfg_attr(feature = "reflect", reflect(Debug, PartialEq, Clone))]
pub enum AimAt {
    /// A point in the world.
    Point(Vec3),
    /// An entity, in this frame and with all that it hangs on, at a point in its own space.
    ///
    /// An entity that is or hangs on an aimed bone is where the last frame's correction has it in this frame's animation:
    /// two characters that look at each other could not both be first. While both turn, each lags by what the other one's
    /// correction changes in a frame.
    Entity(Entity, Vec3),
}

impl AimTarget {
    /// Nothing: the character returns to its animation.
    #[must_use]
    pub const fn nothing() -> Self {
        Self { list: Vec::new() }
    }

    /// A point in the world.
    #[must_use]
    pub fn point(point: Vec3) -> Self {
        Self::nothing().and_point(point, 1.0)
    }

    /// An entity's origin.
    #[must_use]
    pub fn entity(entity: Entity) -> Self {
        Self::nothing().and_entity(entity, Vec3::ZERO, 1.0)
    }

    /// A point in an entity's own space.
    #[must_use]
    pub fn on_entity(entity: Entity, point: Vec3) -> Self {
        Self::nothing().and_entity(entity, point, 1.0)
    }

    /// And a point in the world.
    #[must_use]
    pub fn and_point(mut self, point: Vec3, weight: f32) -> Self {
        self.list.push(WeightedTarget { at: AimAt::Point(point), weight });
        self
    }

    /// And a point in an entity's own space.
    #[must_use]
    pub fn and_entity(mut self, entity: Entity, point: Vec3, weight: f32) -> Self {
        self.list.push(WeightedTarget { at: AimAt::Entity(entity, point), weight });
        self
    }
}

impl MapEntities for AimTarget {
    fn map_entities<M: EntityMapper>(&mut self, mapper: &mut M) {
        for target in &mut self.list {
            if let AimAt::Entity(entity, _) = &mut target.at {
                *entity = mapper.get_mapped(*entity);
            }
        }
    }
}
