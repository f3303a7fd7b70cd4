//! Aims characters: [`solve_aims`] reads transforms and solves, [`apply_aims`] writes the results.

use aim::{Settings, Target};
use bevy_ecs::batching::BatchingStrategy;
use bevy_ecs::change_detection::DetectChangesMut;
use bevy_ecs::entity::Entity;
use bevy_ecs::query::Has;
use bevy_ecs::system::{Query, Res};
use bevy_time::Time;
use bevy_transform::components::Transform;

use crate::outcome::{AimOutcome, Unbound};
use crate::place::{Nodes, in_world, of_bevy};
use crate::{AimAt, AimBinding, AimSettings, AimSnap, AimTarget, AimedBone};

/// Aims all characters whose bones are found, in parallel. Reads the animated transforms of bones and targets, and
/// writes only [`AimBinding`] and [`AimOutcome`].
pub(crate) fn solve_aims(
    time: Res<'_, Time>,
    mut characters: Query<'_, '_, (Entity, &mut AimBinding, &mut AimOutcome, &AimTarget, &AimSettings, Has<AimSnap>)>,
    nodes: Nodes<'_, '_>,
) {
    let dt = time.delta_secs();
    characters.par_iter_mut().batching_strategy(batches()).for_each(
        |(entity, mut binding, mut outcome, target, settings, snaps)| {
            let binding = &mut *binding;
            binding.is_solved = false;
            binding.is_broken = !gather(entity, binding, &nodes);
            if binding.is_broken {
                outcome.set_if_neq(AimOutcome::unbound(Unbound::Bones));
                return;
            }
            let Some(place) = in_world(entity, &nodes) else {
                outcome.set_if_neq(AimOutcome::unbound(Unbound::Place));
                return;
            };
            binding.targets.clear();
            for weighted in &target.list {
                let point = match weighted.at {
                    AimAt::Point(point) => Some(point),
                    AimAt::Entity(entity, point) => in_world(entity, &nodes).map(|at| at.transform_point3(point)),
                };
                binding.targets.extend(point.map(|point| Target::new(point, weighted.weight)));
            }
            let has_target = !binding.targets.is_empty();
            binding.has_snapped = snaps && has_target;
            let settings: Settings = settings.to_settings();
            let solved = binding.solve(place, (!binding.has_snapped).then_some(dt), &settings);
            outcome.set_if_neq(AimOutcome::of(solved, has_target));
        },
    );
}

/// Writes the solved transforms to the bones, in parallel. A `Transform` that already has the right value is left
/// alone, so that Bevy does not propagate it.
pub(crate) fn apply_aims(
    mut bones: Query<'_, '_, (Entity, &mut Transform, &mut AimedBone)>,
    characters: Query<'_, '_, &AimBinding>,
) {
    bones.par_iter_mut().batching_strategy(batches()).for_each(|(entity, mut transform, mut bone)| {
        let Ok(binding) = characters.get(bone.character) else { return };
        // A bone entity that was cloned still carries the `AimedBone` of the original.
        if binding.entities.get(bone.bone) != Some(&entity) {
            return;
        }
        let Some((animated, aimed)) = binding.animated.get(bone.bone).zip(binding.aimed.get(bone.bone)) else { return };
        if !binding.is_solved {
            return;
        }
        let mut written = *transform;
        (written.translation, written.rotation) = (aimed.translation, aimed.rotation);
        transform.set_if_neq(written);
        let mut now = *bone;
        now.written = written;
        now.base = Transform { translation: animated.translation, rotation: animated.rotation, scale: animated.scale };
        bone.set_if_neq(now);
    });
}

/// Uses several batches per thread, because the cost of characters differs: some follow their target, others search.
fn batches() -> BatchingStrategy {
    BatchingStrategy::new().batches_per_thread(8)
}

/// Reads the animated transforms of the bones. Returns `false` if a bone was despawned or reparented.
fn gather(character: Entity, binding: &mut AimBinding, nodes: &Nodes<'_, '_>) -> bool {
    let AimBinding { entities, skeleton, animated, .. } = binding;
    let parents = skeleton.parents().iter().map(|parent| parent.map_or(character, |parent| entities[parent]));
    for ((&entity, parent), animated) in entities.iter().zip(parents).zip(animated) {
        let Ok(node) = nodes.get(entity) else { return false };
        if node.parent.is_none_or(|hangs_on| hangs_on.parent() != parent) {
            return false;
        }
        let of_this = node.bone.filter(|bone| bone.character == character);
        *animated = of_bevy(&of_this.map_or(*node.transform, |bone| bone.animated(node.transform)));
    }
    true
}
