//! Triggers events for changed outcomes, and removes despawned targets and finished components.

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

/// Outcome of a character when its events were last checked.
#[derive(Component, Clone, Copy, Debug, Default)]
pub(crate) struct Reported {
    status: AimStatus,
    turns: bool,
}

/// Triggers the characters' events, removes despawned targets from their lists and [`AimSnap`] after a snap, and
/// unbinds characters that have lost a bone.
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

/// Unbinds a character whose [`AimCharacter`] is removed.
pub(crate) fn release(removed: On<'_, '_, Remove<AimCharacter>>, mut commands: Commands<'_, '_>) {
    commands.entity(removed.entity).try_remove::<(AimBinding, crate::find::LoadedRig)>();
}

/// Marks a character for a new search when one of its bones is removed. If its scene is reloaded, the search succeeds
/// in the same frame.
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

/// Resets the bones of a character to their animated transforms when its binding is removed.
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
