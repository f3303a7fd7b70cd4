//! Entity events, triggered on the entities of characters.
//!
//! ```
//! use bevy_aim::AimReached;
//! use bevy_ecs::prelude::*;
//!
//! fn nod(reached: On<AimReached>) {
//!     println!("{} sees it", reached.entity);
//! }
//! # let mut world = World::new();
//! world.add_observer(nod);
//! ```

use bevy_ecs::entity::Entity;
use bevy_ecs::event::EntityEvent;

/// A character has reached its target.
#[derive(EntityEvent, Clone, Copy, Debug, PartialEq)]
pub struct AimReached {
    /// The character.
    pub entity: Entity,
}

/// A character that had reached its target no longer does: the target moves too fast, is out of reach, or is gone.
#[derive(EntityEvent, Clone, Copy, Debug, PartialEq)]
pub struct AimLost {
    /// The character.
    pub entity: Entity,
}

/// A character's target has gone out of reach.
#[derive(EntityEvent, Clone, Copy, Debug, PartialEq)]
pub struct AimOutOfReach {
    /// The character.
    pub entity: Entity,
}

/// A character can reach its target only if its body turns. Triggered once, when that begins; afterwards
/// [`AimOutcome::body_turn`](crate::AimOutcome::body_turn) has the current angle.
#[derive(EntityEvent, Clone, Copy, Debug, PartialEq)]
pub struct AimTurnBody {
    /// The character.
    pub entity: Entity,
    /// Required turn of the body, radians about up, positive to the left.
    pub angle: f32,
}
