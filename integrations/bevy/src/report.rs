//! Tells what has changed, and takes off what is done or gone.

use bevy_ecs::change_detection::{DetectChanges, Ref};
use bevy_ecs::component::Component;
use bevy_ecs::entity::{Entities, Entity};
use bevy_ecs::lifecycle::Remove;
use bevy_ecs::observer::On;
use bevy_ecs::query::{Has, With};
use bevy_ecs::system::{Commands, Query};
use bevy_transform::components::Transform;

use crate::find::Seen;
use crate::{AimAt, AimBinding, AimLost, AimOutOfReach, AimOutcome, AimReached, AimSnap, AimTarget, AimTurnBody};
use crate::{AimCharacter, AimStatus, AimedBone};

/// The last outcome that events told of a character.
#[derive(Component, Clone, Copy, Debug, Default)]
pub(crate) struct Reported {
    status: AimStatus,
    turns: bool,
}

/// Triggers the events of characters, takes despawned targets off their lists and [`AimSnap`] off those that have snapped, and lets
/// go of characters that have lost a bone.
pub(crate) fn report_aims(
    mut commands: Commands<'_, '_>,
    mut characters: Query<
        '_,
        '_,
        (Entity, Ref<'_, AimOutcome>, &mut Reported, &mut AimTarget, &mut Seen, Option<&AimBinding>, Has<AimSnap>),
        With<AimCharacter>,
    >,
    entities: &Entities,
) {
    for (entity, outcome, mut reported, mut target, mut seen, binding, snaps) in &mut characters {
        let is_there = |at: &AimAt| match at {
            AimAt::Entity(entity, _) => entities.contains_spawned(*entity),
            AimAt::Point(_) => true,
        };
        if !target.list.iter().all(|weighted| is_there(&weighted.at)) {
            target.list.retain(|weighted| is_there(&weighted.at));
        }
        if binding.is_some_and(|binding| binding.is_broken) {
            seen.forget();
            commands.entity(entity).try_remove::<AimBinding>();
        }
        if snaps && binding.is_some_and(|binding| binding.has_snapped) {
            commands.entity(entity).try_remove::<AimSnap>();
        }
        if outcome.is_changed() {
            let (was, now) = (reported.status, outcome.status);
            if was.is_reached() && !now.is_reached() {
                commands.trigger(AimLost { entity });
            }
            if now.is_reached() && !was.is_reached() {
                commands.trigger(AimReached { entity });
            }
            if now.is_out_of_reach() && !was.is_out_of_reach() {
                commands.trigger(AimOutOfReach { entity });
            }
            let angle = outcome.body_turn;
            let turns = angle != 0.0 && !matches!(now, AimStatus::NoTarget | AimStatus::Unbound(_));
            if turns && !reported.turns {
                commands.trigger(AimTurnBody { entity, angle });
            }
            *reported = Reported { status: now, turns };
        }
    }
}

/// Lets go of a character that is not aimed any more.
pub(crate) fn release(removed: On<'_, '_, Remove<AimCharacter>>, mut commands: Commands<'_, '_>) {
    commands.entity(removed.entity).try_remove::<(AimBinding, crate::find::LoadedRig)>();
}

/// Has the bones of a character looked for again when one of them goes: where its scene is loaded anew, in the same frame.
pub(crate) fn lose(
    removed: On<'_, '_, Remove<AimedBone>>,
    bones: Query<'_, '_, &AimedBone>,
    mut characters: Query<'_, '_, &mut Seen, With<AimBinding>>,
) {
    let Ok(bone) = bones.get(removed.entity) else { return };
    if let Ok(mut seen) = characters.get_mut(bone.character) {
        seen.has_lost = true;
    }
}

/// Gives the bones of a character back as they are animated.
pub(crate) fn restore(
    removed: On<'_, '_, Remove<AimBinding>>,
    characters: Query<'_, '_, &AimBinding>,
    mut bones: Query<'_, '_, (&mut Transform, &AimedBone)>,
    mut commands: Commands<'_, '_>,
) {
    let Ok(binding) = characters.get(removed.entity) else { return };
    for &entity in &binding.entities {
        let Ok((mut transform, bone)) = bones.get_mut(entity) else { continue };
        if bone.character == removed.entity {
            let animated = bone.animated(&transform);
            if *transform != animated {
                *transform = animated;
            }
            commands.entity(entity).try_remove::<AimedBone>();
        }
    }
}
