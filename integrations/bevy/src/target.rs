//! [`AimTarget`]: the targets of a character.

use aim::glam::Vec3;
use bevy_ecs::component::Component;
use bevy_ecs::entity::{Entity, EntityMapper, MapEntities};
#[cfg(feature = "reflect")]
use bevy_ecs::reflect::ReflectComponent;
#[cfg(feature = "reflect")]
use bevy_reflect::std_traits::ReflectDefault;

/// The targets of a character: none, one, or several with weights. Each is a point or an entity.
///
/// Despawned entities are removed from the list; the character then returns to its animation, or turns to the remaining
/// targets. See [`Targets`](aim::Targets) for how several are blended.
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

/// A target of a character, with its weight.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "reflect", derive(bevy_reflect::Reflect))]
#[cfg_attr(feature = "reflect", reflect(Debug, PartialEq, Clone))]
pub struct WeightedTarget {
    /// Place of the target.
    pub at: AimAt,
    /// Weight relative to the other targets: see [`Target::weight`](aim::Target::weight).
    pub weight: f32,
}

/// The place of a target.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "reflect", derive(bevy_reflect::Reflect))]
#[cfg_attr(feature = "reflect", reflect(Debug, PartialEq, Clone))]
pub enum AimAt {
    /// A point in world space.
    Point(Vec3),
    /// A point in an entity's own space. Its world position is that of this frame, computed from the `Transform`s of
    /// the entity and its ancestors.
    ///
    /// An aimed bone on this path has this frame's animation and the previous frame's correction, because two
    /// characters that look at each other cannot both be solved first. While both turn, each lags by the other's change
    /// of correction in one frame.
    Entity(Entity, Vec3),
}

impl AimTarget {
    /// Creates an empty list: the character returns to its animation.
    #[must_use]
    pub const fn nothing() -> Self {
        Self { list: Vec::new() }
    }

    /// Creates a single target of weight 1 at a point in world space.
    #[must_use]
    pub fn point(point: Vec3) -> Self {
        Self::nothing().and_point(point, 1.0)
    }

    /// Creates a single target of weight 1 at an entity's origin.
    #[must_use]
    pub fn entity(entity: Entity) -> Self {
        Self::nothing().and_entity(entity, Vec3::ZERO, 1.0)
    }

    /// Creates a single target of weight 1 at a point in an entity's own space.
    #[must_use]
    pub fn on_entity(entity: Entity, point: Vec3) -> Self {
        Self::nothing().and_entity(entity, point, 1.0)
    }

    /// Adds a point in world space, with a weight.
    #[must_use]
    pub fn and_point(mut self, point: Vec3, weight: f32) -> Self {
        self.list.push(WeightedTarget { at: AimAt::Point(point), weight });
        self
    }

    /// Adds a point in an entity's own space, with a weight.
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
