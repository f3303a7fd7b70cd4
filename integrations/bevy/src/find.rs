//! Finds the bones of characters as soon as they appear.

use aim::Rig;
use aim::animation::{AimChain, AimChainError, Bone, Skeleton};
use aim::glam::{Affine3A, Vec3};
use bevy_ecs::change_detection::{DetectChanges, DetectChangesMut, Ref};
use bevy_ecs::component::Component;
use bevy_ecs::entity::{Entity, EntityHashMap};
use bevy_ecs::hierarchy::Children;
use bevy_ecs::name::Name;
use bevy_ecs::query::Has;
use bevy_ecs::system::{Commands, Query};
use bevy_transform::components::Transform;

use crate::character::{OtherEye, Source};
use crate::names::{find, hangs_on, joints, wanted};
use crate::place::of_bevy;
use crate::{AimBinding, AimCharacter, AimOutcome, AimStatus, AimedBone, SharedRig, Unbound};

/// Frames without a match before a warning is logged.
const WARNS_AFTER: u32 = 120;
/// Least number of entities below a character from which its scene is taken to be loaded. No warning is logged below
/// it.
const LEAST_OF_SCENE: usize = 3;

/// Result of the last search below a character.
#[derive(Component, Clone, Debug, Default)]
pub(crate) struct Seen {
    /// Transform of each entity below the character when it first appeared.
    rest: EntityHashMap<Transform>,
    /// Number of entities below the character at the last failed search; 0 to search again in the next frame.
    in_vain: usize,
    /// Frames since the last failed search.
    waits: u32,
    /// `true` if an aimed bone has been removed since the last search.
    pub(crate) has_lost: bool,
}

/// The loaded rig of a character whose rig is an asset.
#[derive(Component, Clone)]
pub(crate) struct LoadedRig(pub(crate) Found);

/// A rig, with facts about the character that the rig itself does not hold.
#[derive(Clone)]
pub(crate) struct Found {
    pub(crate) rig: SharedRig,
    pub(crate) up: Option<Vec3>,
    pub(crate) trunk: Option<String>,
    /// Bind transforms of all bones, in the space of the entity; empty if the bind pose is the pose in which they
    /// appeared.
    pub(crate) bind: Vec<Affine3A>,
}

/// An entity below a character, in the depth-first list of the search.
pub(crate) struct Node<'a> {
    pub(crate) entity: Entity,
    pub(crate) parent: Option<usize>,
    pub(crate) name: &'a str,
    pub(crate) rest: Transform,
    now: Transform,
}

/// Finds the bones of characters that have none yet, or whose [`AimCharacter`] has changed. Runs before the animation,
/// in the frame in which bones appear, so that they are still in the pose in which they were loaded.
pub(crate) fn find_bones(
    mut commands: Commands<'_, '_>,
    mut characters: Query<
        '_,
        '_,
        (Entity, Ref<'_, AimCharacter>, Option<Ref<'_, LoadedRig>>, &mut Seen, &mut AimOutcome, Option<&AimBinding>),
    >,
    children: Query<'_, '_, &Children>,
    nodes: Query<'_, '_, (Option<&Transform>, Option<&Name>, Option<&AimedBone>, Has<AimCharacter>)>,
    #[cfg(feature = "measure")] skins: crate::skin::Skins<'_, '_>,
    #[cfg(feature = "measure")] mut measured: bevy_ecs::system::Local<'_, crate::measure::Measured>,
) {
    for (entity, character, loaded, mut seen, mut outcome, bound) in &mut characters {
        let is_new = character.is_changed() || loaded.as_ref().is_some_and(Ref::is_changed) || seen.has_lost;
        if bound.is_some() && !is_new {
            continue;
        }
        seen.has_lost = false;
        let below = below(entity, &children, &nodes, &mut seen);
        // The number of entities is unchanged, so another search would fail as well.
        if !is_new && below.len() == seen.in_vain {
            seen.waits = seen.waits.saturating_add(1);
            if let AimStatus::Unbound(why) = outcome.status
                && seen.waits == WARNS_AFTER
                && below.len() >= LEAST_OF_SCENE
            {
                let names = names_wanted(&character, loaded.as_deref(), why);
                log::warn!("the character {entity} is not aimed: {why}{names}");
            }
            continue;
        }
        (seen.in_vain, seen.waits) = (below.len(), 0);
        let found = match &character.source {
            _ if below.is_empty() => Err(Unbound::Bones),
            Source::Rig(rig) => Ok(Found { rig: rig.clone(), up: None, trunk: None, bind: Vec::new() }),
            #[cfg(feature = "measure")]
            Source::Measured => measured.rig(&below, &skins),
            #[cfg(feature = "assets")]
            Source::Asset(_) => loaded.map(|loaded| loaded.0.clone()).ok_or(Unbound::Rig),
        };
        if bound.is_some() {
            commands.entity(entity).try_remove::<AimBinding>();
        }
        match found.and_then(|found| bind(&character, found, &below)) {
            Ok(mut binding) => {
                if let Some(bound) = bound {
                    binding.go_on_from(bound);
                }
                for (bone, &bone_entity) in binding.entities.iter().enumerate() {
                    let now = below.iter().find(|node| node.entity == bone_entity).map(|node| node.now);
                    if let Some(now) = now.filter(|_| binding.is_written(bone)) {
                        let of_character = AimedBone { character: entity, bone, base: now, written: now };
                        commands.entity(bone_entity).try_insert(of_character);
                    }
                }
                commands.entity(entity).try_insert(binding);
            }
            Err(why) => {
                outcome.set_if_neq(AimOutcome::unbound(why));
            }
        }
    }
}

/// Returns the names that were searched for a joint without a bone, as a suffix for the log message.
fn names_wanted(character: &AimCharacter, loaded: Option<&LoadedRig>, why: Unbound) -> String {
    let declared = match &character.source {
        Source::Rig(rig) => Some(rig),
        #[cfg(any(feature = "assets", feature = "measure"))]
        _ => None,
    };
    // A measured rig takes its names from the file, so there is nothing to print.
    let rig = declared.or_else(|| loaded.map(|loaded| &loaded.0.rig));
    let (Some(rig), Unbound::Joint(joint)) = (rig, why) else { return String::new() };
    format!(" (looked for: {:?})", wanted(character, rig.as_ref(), joint).collect::<Vec<_>>())
}

impl Seen {
    /// Makes the next frame search for the bones even if their number has not changed.
    pub(crate) fn forget(&mut self) {
        self.in_vain = 0;
    }
}

impl AimBinding {
    /// Returns `true` if a bone is aimed or held, so that its transform is written.
    fn is_written(&self, bone: usize) -> bool {
        self.chain.joints().contains(&bone)
            || self.chain.held().any(|held| held == bone)
            || self.other_eye == Some(bone)
    }
}

/// Returns the entities below a character that have a `Transform`, depth first, without other characters and their
/// descendants.
fn below<'a>(
    root: Entity,
    children: &'a Query<'_, '_, &Children>,
    nodes: &'a Query<'_, '_, (Option<&Transform>, Option<&Name>, Option<&AimedBone>, Has<AimCharacter>)>,
    seen: &mut Seen,
) -> Vec<Node<'a>> {
    let mut below: Vec<Node<'_>> = Vec::new();
    let of = |entity| children.get(entity).into_iter().flat_map(|children| children.iter().rev().copied());
    let mut ahead: Vec<(Entity, Option<usize>)> = of(root).map(|child| (child, None)).collect();
    while let Some((entity, parent)) = ahead.pop() {
        let Ok((Some(transform), name, bone, false)) = nodes.get(entity) else { continue };
        let now = bone.map_or(*transform, |bone| bone.animated(transform));
        let rest = *seen.rest.entry(entity).or_insert(now);
        let at = below.len();
        below.push(Node { entity, parent, name: name.map_or("", Name::as_str), rest, now });
        ahead.extend(of(entity).map(|child| (child, Some(at))));
    }
    // Drops entities that no longer exist.
    seen.rest = below.iter().map(|node| (node.entity, node.rest)).collect();
    below
}

/// Builds the binding of a character to the entities below it.
fn bind(character: &AimCharacter, found: Found, below: &[Node<'_>]) -> Result<AimBinding, Unbound> {
    let rig: &dyn Rig = &found.rig;
    let joints = joints(character, rig, below)?;
    let other_eye = match &character.other_eye {
        OtherEye::OfRig => rig.other_eye_bone().map(|name| (name, true)),
        OtherEye::Bone { name, is_aimed } => Some((&name[..], *is_aimed)),
        OtherEye::None => None,
    };
    let is_beside = |node: usize| joints.first().is_some_and(|&eye| below[eye].parent == below[node].parent);
    let other_eye = match other_eye {
        Some((name, is_aimed)) => Some((find(below, name, is_beside).ok_or(Unbound::OtherEye)?, is_aimed)),
        None => None,
    };
    let carries = |node: usize| joints.last().is_some_and(|&joint| joint == node || hangs_on(below, joint, node));
    let trunk = match character.trunk.as_ref().or(found.trunk.as_ref()) {
        Some(name) => Some(find(below, name, carries).ok_or(Unbound::Trunk)?),
        None => None,
    };
    // Held bones: those of the rig are optional, those that the user adds must exist.
    let description = rig.description();
    let mut held: Vec<(usize, usize)> = Vec::new();
    let on = |joint: usize| {
        let bone = joints.get(joint).copied();
        move |node: usize| bone.is_some_and(|bone| hangs_on(below, node, bone))
    };
    for joint in 0..joints.len() {
        let names = (0..).map_while(|place| rig.held_bone(joint, place));
        held.extend(names.filter_map(|name| Some((joint, find(below, name, on(joint))?))));
    }
    for (joint, name) in &character.held {
        held.push((*joint, find(below, name, on(*joint)).ok_or(Unbound::Held)?));
    }
    held.sort_unstable();
    held.dedup();

    // Keep only these bones and their ancestors, still in depth-first order.
    let mut is_needed = vec![false; below.len()];
    let wanted = joints.iter().copied().chain(other_eye.map(|(bone, _)| bone)).chain(trunk);
    for node in wanted.chain(held.iter().map(|(_, bone)| *bone)) {
        let mut at = Some(node);
        while let Some(node) = at {
            is_needed[node] = true;
            at = below[node].parent;
        }
    }
    let needed: Vec<usize> = (0..below.len()).filter(|&node| is_needed[node]).collect();
    let bone_of = |node: usize| needed.binary_search(&node).unwrap_or_default();
    let bones = needed.iter().map(|&node| {
        let Node { parent, name, rest, .. } = &below[node];
        Bone::new(*name, parent.map(bone_of)).with_rest(of_bevy(rest))
    });
    let skeleton = Skeleton::new(bones).map_err(|_| Unbound::RestPose)?;

    let told = |error: AimChainError| match error {
        AimChainError::Joint(joint) | AimChainError::Names { joint, .. } => Unbound::Joint(joint),
        AimChainError::Order(joint) => Unbound::Order(joint),
        AimChainError::OtherEye => Unbound::OtherEye,
        AimChainError::Trunk => Unbound::Trunk,
        AimChainError::Held => Unbound::Held,
        _ => Unbound::Rig,
    };
    let mut bind = vec![Affine3A::IDENTITY; skeleton.len()];
    // Cannot fail: both slices have the skeleton's length.
    let _ = skeleton.to_model(skeleton.rest(), &mut bind);
    for (bone, &node) in needed.iter().enumerate() {
        if let Some(place) = found.bind.get(node) {
            bind[bone] = *place;
        }
    }
    for (name, place) in &character.bind_pose {
        if let Some(node) = find(below, name, |node| is_needed[node]).filter(|&node| is_needed[node]) {
            bind[bone_of(node)] = *place;
        }
    }
    let joints: Vec<usize> = joints.into_iter().map(bone_of).collect();
    let mut chain = AimChain::new(&skeleton, joints).map_err(told)?;
    chain = chain.with_bind(&bind).map_err(|_| Unbound::RestPose)?;
    let other_eye = other_eye.map(|(node, is_aimed)| (bone_of(node), is_aimed));
    chain = match other_eye {
        Some((bone, true)) => chain.with_other_eye(bone).map_err(told)?,
        Some((bone, false)) => chain.with_following_eye(bone).map_err(told)?,
        None => chain,
    };
    for (joint, node) in held {
        chain = chain.with_held(bone_of(node), joint, description.carrier(joint)).map_err(told)?;
    }
    let up = character.up.or(found.up).unwrap_or(Vec3::Y);
    chain = match trunk {
        Some(node) => chain.with_standing_up(up, bone_of(node)).map_err(told)?,
        None => chain.with_up(up),
    };
    let entities = needed.iter().map(|&node| below[node].entity).collect();
    let mut binding = AimBinding::new(entities, skeleton, chain, found.rig);
    binding.other_eye = other_eye.map(|(bone, _)| bone);
    Ok(binding)
}
