//! [`Found`]: a rig fitted to the bones of a character.

use std::sync::Arc;

use aim::Rig;
use aim::animation::{AimChain, AimChainError, Skeleton};
use aim::glam::{Affine3A, Vec3};

use crate::Bones;

/// A rig whose bones have been found, with a chain on a skeleton reduced to the bones that are needed.
#[derive(Clone)]
pub struct Found {
    pub(crate) rig: Arc<dyn Rig>,
    pub(crate) chain: AimChain,
    /// For each bone of the chain's skeleton, its index in [`Bones`].
    pub(crate) bones: Vec<usize>,
}

/// Facts about a character that its rig does not hold.
#[derive(Default)]
pub(crate) struct Known {
    pub(crate) up: Option<Vec3>,
    /// Index in the skeleton of the bone whose lean determines the up direction.
    pub(crate) trunk: Option<usize>,
    /// Bind transform of every bone of the skeleton, in the space of the character; empty if it is the rest pose.
    pub(crate) bind: Vec<Affine3A>,
}

impl std::fmt::Debug for Found {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Found").field("chain", &self.chain).field("bones", &self.bones).finish_non_exhaustive()
    }
}

/// Fits a rig to the bones with the names that it declares.
pub(crate) fn by_name(
    bones: &Bones,
    skeleton: &Skeleton,
    rig: Arc<dyn Rig>,
    known: Known,
    both_eyes: bool,
) -> Result<Found, String> {
    let told = |error: AimChainError| said(&error, rig.as_ref(), skeleton);
    let mut chain = AimChain::named(skeleton, rig.as_ref()).map_err(told)?;
    let other_eye =
        rig.other_eye_bone().and_then(|name| skeleton.find(name).or_else(|| beside(skeleton, chain.joints()[0])));
    if let Some(eye) = other_eye {
        chain = if both_eyes { chain.with_other_eye(eye) } else { chain.with_following_eye(eye) }.map_err(told)?;
    }
    let up = known.up.unwrap_or(Vec3::Y);
    let trunk = bones.trunk.and_then(|bone| skeleton.bone_of(bone)).or(known.trunk);
    chain = match trunk {
        Some(trunk) => chain.with_standing_up(up, trunk).map_err(told)?,
        None => chain.with_up(up),
    };
    if !known.bind.is_empty() {
        chain = chain.with_bind(&known.bind).map_err(|error| error.to_string())?;
    }
    let (chain, kept) = chain.reduced();
    let bones = kept.into_iter().filter_map(|bone| skeleton.source_of(bone)).collect();
    Ok(Found { rig, chain, bones })
}

/// Greatest number of joints of a rig: the capacity of the solvers in small programs.
#[cfg(any(feature = "declare", feature = "measure"))]
pub(crate) const MOST_JOINTS: usize = 16;

/// Returns the bone of the right eye that corresponds to the bone of the left eye by name and parent. For rigs that
/// declare several names for the left eye but only one for the right.
fn beside(skeleton: &Skeleton, left: usize) -> Option<usize> {
    let name = skeleton.name(left)?;
    let sides = [("Left", "Right"), ("left", "right"), ("_L", "_R"), ("_l", "_r"), (".L", ".R"), (".l", ".r")];
    let right = sides.iter().find_map(|(left, right)| {
        let at = (0..name.len()).find(|&at| name.get(at..).is_some_and(|rest| rest.starts_with(left)))?;
        skeleton.find(&format!("{}{right}{}", name.get(..at)?, name.get(at + left.len()..)?))
    })?;
    (skeleton.parents()[right] == skeleton.parents()[left]).then_some(right)
}

/// Returns an error message for a reader who knows neither the rig nor the skeleton.
fn said(error: &AimChainError, rig: &dyn Rig, skeleton: &Skeleton) -> String {
    let joint_name = |joint: usize| rig.joint_name(joint).unwrap_or("?").to_owned();
    match error {
        AimChainError::Names { joint, names } => {
            let all = skeleton.names();
            let known = &all[..all.len().min(MOST_NAMES)];
            let more = if all.len() > MOST_NAMES { ", …" } else { "" };
            let wanted: Vec<String> = names.iter().map(|name| format!("\"{name}\"")).collect();
            format!(
                "no bone, or more than one, is called {} for the rig's joint \"{}\": choose the preset that fits, or rig: \
                 \"measure\", which also takes characters without eyes. The character's bones are {}{more}",
                wanted.join(" or "),
                joint_name(*joint),
                known.join(", ")
            )
        }
        AimChainError::Order(joint) => format!(
            "the bone of the rig's joint \"{}\" does not hang on that of \"{}\": choose the preset that fits the skeleton, or \
             rig: \"measure\"",
            joint_name(joint.saturating_sub(1)),
            joint_name(*joint)
        ),
        AimChainError::Held => {
            "a bone that the rig holds does not hang on its joint, or is a joint itself: mend `hold` in the rig"
                .to_owned()
        }
        AimChainError::OtherEye => {
            "the rig's other eye is one of its joints: name the eye beside it as `other_eye`".to_owned()
        }
        AimChainError::Trunk => "there is no bone of the trunk's number: give the index of one of the bones".to_owned(),
        _ => "the rig does not fit the skeleton: choose the preset that fits, or rig: \"measure\"".to_owned(),
    }
}

/// Greatest number of bone names in a message.
const MOST_NAMES: usize = 80;
