//! Measurement of bone axes: which of each bone's local axes point up, forward and left of the character in its bind
//! pose.
//!
//! - `roles.rs` recognises parts of the body by VRM and by name.
//! - `bind.rs` places the bind pose in the world.
//! - `plan.rs` finds legs, trunk, neck and head from the tree of bones alone.
//! - `clues.rs` derives a facing direction from each part of the body, and `facing.rs` weighs these clues.
//! - `stance.rs` finds the limbs that the body stands on.
//! - `evidence.rs` puts the evidence into words.
//! - This file measures the bones against the facing that was found.

pub(crate) mod arms;
mod bind;
pub(crate) mod clues;
pub mod evidence;
pub(crate) mod facing;
pub(crate) mod frame;
pub(crate) mod limbs;
mod plan;
pub(crate) mod roles;
pub(crate) mod stance;

use core::fmt;
use core::str::FromStr;

use aim_model::BoneName;
use aim_runtime::glam::{DAffine3, DMat3, DVec3};

use crate::measure::arms::has_named_limbs;
use crate::measure::bind::{bind_world, signed_permutation};
use crate::measure::clues::Body;
use crate::measure::facing::{Evidence, Facing, Stated};
use crate::measure::frame::{nearest_axis, orthonormal};
use crate::measure::plan::BodyPlan;
use crate::measure::roles::{Role, Roles, bones};
use crate::measure::stance::{BodyKind, carry_legs, standing_limbs};
use crate::skin::{Palette, carriers};
use aim_gltf::Document;
use aim_gltf::Skeleton;

/// A signed coordinate axis of a bone's local space.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[expect(missing_docs, reason = "the names say it all")]
pub enum SignedAxis {
    PlusX,
    MinusX,
    PlusY,
    MinusY,
    PlusZ,
    MinusZ,
}

impl SignedAxis {
    /// All axes in the order of the variants, with name and unit vector.
    const ALL: [(Self, &str, DVec3); 6] = [
        (Self::PlusX, "+X", DVec3::X),
        (Self::MinusX, "-X", DVec3::NEG_X),
        (Self::PlusY, "+Y", DVec3::Y),
        (Self::MinusY, "-Y", DVec3::NEG_Y),
        (Self::PlusZ, "+Z", DVec3::Z),
        (Self::MinusZ, "-Z", DVec3::NEG_Z),
    ];

    /// Returns the name of the axis: `+X`, `-X`, `+Y`, `-Y`, `+Z` or `-Z`.
    #[must_use]
    pub fn as_str(self) -> &'static str {
        Self::ALL[self as usize].1
    }

    /// Returns the unit vector of the axis.
    #[must_use]
    pub fn vector(self) -> DVec3 {
        Self::ALL[self as usize].2
    }

    /// Returns the axis nearest to a direction.
    #[must_use]
    pub fn of(v: DVec3) -> Self {
        let axis = nearest_axis(v);
        Self::ALL.into_iter().find(|(.., vector)| *vector == axis).map_or(Self::PlusX, |(signed, ..)| signed)
    }
}

impl FromStr for SignedAxis {
    type Err = String;

    /// Reads `+X`, `-X`, `+Y`, `-Y`, `+Z` or `-Z`, in either case; a missing sign is `+`.
    fn from_str(text: &str) -> Result<Self, String> {
        let upper = text.to_ascii_uppercase();
        let name = if upper.starts_with(['+', '-']) { upper } else { format!("+{upper}") };
        let found = Self::ALL.into_iter().find(|(_, known, _)| *known == name);
        found.map(|(axis, ..)| axis).ok_or_else(|| "expected an axis: +X, -X, +Y, -Y, +Z or -Z".into())
    }
}

impl fmt::Display for SignedAxis {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.as_str())
    }
}

/// Handedness of a bone's local axes in the world.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Handedness {
    /// Right-handed: not mirrored.
    Right,
    /// Left-handed: mirrored by an odd number of negative scales on the bone and its ancestors.
    Left,
}

impl Handedness {
    /// Returns `right` or `left`.
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Right => "right",
            Self::Left => "left",
        }
    }
}

/// The character's up, forward and left as orthonormal vectors in one bone's local space.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct BoneFrame {
    /// The character's up in the bone's space, unit.
    pub up: DVec3,
    /// The character's forward in the bone's space, unit.
    pub forward: DVec3,
    /// The character's left in the bone's space, unit.
    pub left: DVec3,
}

/// One bone, measured in the bind pose.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct BoneAxes {
    /// Node index.
    pub node: usize,
    /// Node name.
    pub name: String,
    /// Parent node index.
    pub parent: Option<usize>,
    /// Role of the bone, if its name, the VRM extension or the body plan reveals one.
    pub role: Option<Role>,
    /// Local axis nearest to the character's up. `up`, `forward` and `left` are always three different axes, with the
    /// bone's handedness.
    pub up: SignedAxis,
    /// Local axis nearest to the character's forward.
    pub forward: SignedAxis,
    /// Local axis nearest to the character's left.
    pub left: SignedAxis,
    /// Angles between the exact directions of up, forward and left and the nearest axes, degrees.
    pub deviations_deg: [f64; 3],
    /// Largest of [`deviations_deg`](Self::deviations_deg), degrees.
    pub deviation_deg: f64,
    /// Handedness of the bone's local axes.
    pub handedness: Handedness,
    /// Exact directions of up, forward and left, which the signed axes approximate.
    pub frame: BoneFrame,
    /// World ← bone in the bind pose.
    pub bind_world: DAffine3,
    /// Angle between the bone's orientation in the file's rest pose and that in the bind pose, degrees.
    pub rest_deg: f64,
    /// `true` if a leg (or a foreleg) is a descendant of the bone, so that turning the bone moves feet.
    pub carries_legs: bool,
}

/// Pose in which the axes are measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MeasuredPose {
    /// The pose in which the skin was fitted, from the inverse bind matrices.
    Bind,
    /// The pose of the nodes while no clip plays: often a frame of some animation.
    Rest,
}

/// The measurement of a whole character.
///
/// ```
/// use aim_character::{Measurement, PAPER_AXES, Role, SignedAxis, mannequin};
/// use aim_gltf::Document;
/// use aim_runtime::glam::DVec3;
///
/// let measured = Measurement::of(&Document::from_bytes(&mannequin(|_| PAPER_AXES)?)?);
/// assert!(measured.forward.abs_diff_eq(DVec3::Z, 1e-6) && measured.confidence > 0.5);
/// let head = measured.with_role(Role::Head).ok_or("no head")?;
/// assert_eq!([head.up, head.forward, head.left].map(SignedAxis::as_str), ["+X", "+Y", "+Z"]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Measurement {
    /// The pose that was measured: the requested one, or the rest pose if no skin of the file has inverse bind
    /// matrices.
    pub pose: MeasuredPose,
    /// The character's up in the world: stated, or +Y as in glTF unless the legs clearly stand along another axis.
    pub up: DVec3,
    /// The character's forward in the world, perpendicular to `up`.
    pub forward: DVec3,
    /// The character's left in the world, perpendicular to `up` and `forward`.
    pub left: DVec3,
    /// Evidence for and against the facing.
    pub evidence: Vec<Evidence>,
    /// Confidence in the facing, 0…1: the share of the evidence that agrees on which way is front, reduced if no names
    /// distinguish the sides; 1 if the user states the forward direction. Below [`evidence::RELIABLE`] the facing is a
    /// guess.
    pub confidence: f64,
    /// Height in the bind pose, in units of the file: the extent along `up` of the skin, of rigid meshes attached to
    /// its bones, and of bones with a role. In a file without skins it is the extent of all meshes, or of all nodes if
    /// there are no meshes. 0 if there is nothing to measure.
    pub height: f64,
    /// Measured bones in node order: the joints of skins, their ancestors, and eyes that are plain nodes; in a file
    /// without skins, every node.
    pub bones: Vec<BoneAxes>,
    /// World ← node in the bind pose, for every node of the file.
    pub bind_world: Vec<DAffine3>,
    /// First bones of the two arms by the body plan, if no names reveal the arms.
    pub(crate) nameless_arms: Option<[usize; 2]>,
    /// Kind of the body.
    pub(crate) kind: BodyKind,
}

impl Measurement {
    /// Measures a document in its bind pose.
    #[must_use]
    pub fn of(document: &Document) -> Self {
        Self::in_pose(document, MeasuredPose::Bind)
    }

    /// Measures a document in its bind pose, with the directions that the user states.
    #[must_use]
    pub fn stated(document: &Document, stated: Stated) -> Self {
        Self::measured(document, MeasuredPose::Bind, stated)
    }

    /// Measures a document in the given pose. For [`MeasuredPose::Rest`], [`bind_world`](Self::bind_world) holds the
    /// rest pose.
    #[must_use]
    pub fn in_pose(document: &Document, pose: MeasuredPose) -> Self {
        Self::measured(document, pose, Stated::default())
    }

    fn measured(document: &Document, pose: MeasuredPose, stated: Stated) -> Self {
        let skeleton = document.skeleton();
        let rest = skeleton.world_f64(&[]);
        let is_bone = bones(skeleton);
        let mut roles = Roles::find(skeleton);
        let has_bind = skeleton.nodes().iter().any(|node| node.inverse_bind.is_some());
        let pose = if has_bind { pose } else { MeasuredPose::Rest };
        let placed = |roles: &Roles| match pose {
            MeasuredPose::Bind => bind_world(skeleton, &rest, roles),
            MeasuredPose::Rest => rest.clone(),
        };
        let mut bind = placed(&roles);
        let carriers = carriers(skeleton, document.points());
        let mut vertices = vec![0_usize; bind.len()];
        carriers.iter().for_each(|node| vertices[*node] += 1);
        let plan = BodyPlan::find(skeleton, &bind, &is_bone, &|node| vertices[node]);
        // If the column ends in a tail, the plan has mistaken forelegs for legs and the chest for the hips: discard it.
        let plan = plan.filter(|plan| !BoneName::new(&skeleton.names()[plan.head]).has("tail"));
        if let Some(plan) = &plan {
            // The plan does not depend on the placement of the bind pose, but that placement may depend on the hips:
            // place it again.
            if roles.complete(skeleton, plan) {
                bind = placed(&roles);
            }
        }
        // Beyond a named head the column leads into a jaw or an ear. Trust the plan's arms only if its head has that
        // role.
        let of_head = plan.as_ref().filter(|plan| roles.of(plan.head) == Some(Role::Head));
        let nameless_arms = of_head.map(|plan| plan.arms).filter(|_| !has_named_limbs(skeleton));
        let skin = Palette::new(skeleton, &bind).deform(document.points());
        let body =
            Body { skeleton, bind: &bind, is_bone: &is_bone, skin: &skin, carriers: &carriers, roles: &roles, plan };
        let facing = Facing::find(&body, stated);
        let standing = standing_limbs(&body, &facing);
        let kind = BodyKind::find(&body, &facing, &standing);
        let carries_legs = carry_legs(&body, if kind == BodyKind::Quadruped { &standing } else { &[] });
        let listed = (0..bind.len()).filter(|node| is_bone[*node] || roles.of(*node).is_some());
        let bones = listed.map(|node| {
            let rest_deg = turn_deg(&bind[node], &rest[node]);
            let axes = axes_of(skeleton, &bind, &facing, node, roles.of(node));
            BoneAxes { rest_deg, carries_legs: carries_legs[node], ..axes }
        });
        Self {
            pose,
            up: facing.up,
            forward: facing.forward,
            left: facing.left,
            height: height(document, &bind, &skin, facing.up, &roles),
            bones: bones.collect(),
            confidence: facing.confidence(),
            evidence: facing.evidence,
            bind_world: bind,
            nameless_arms,
            kind,
        }
    }

    /// Returns the length, in units of the file, that corresponds to one metre of a character 1.7 m tall; 1 if the
    /// height is unknown.
    #[must_use]
    pub fn metre(&self) -> f64 {
        if self.height > 0.0 { self.height / 1.7 } else { 1.0 }
    }

    /// Returns `true` if the character goes on all fours: on each side, limbs stand on the ground well ahead of others;
    /// or its head lies ahead of its hips rather than above them and it is not a bird.
    #[must_use]
    pub fn goes_on_all_fours(&self) -> bool {
        self.kind == BodyKind::Quadruped
    }

    /// Returns the measured bone of a node.
    #[must_use]
    pub fn bone(&self, node: usize) -> Option<&BoneAxes> {
        self.bones.iter().find(|bone| bone.node == node)
    }

    /// Returns the first bone with a role.
    #[must_use]
    pub fn with_role(&self, role: Role) -> Option<&BoneAxes> {
        self.bones.iter().find(|bone| bone.role == Some(role))
    }
}

/// Returns the angle of the rotation between the orientations of two frames, degrees.
pub(crate) fn turn_deg(a: &DAffine3, b: &DAffine3) -> f64 {
    let turn = orthonormal(&a.matrix3).0.transpose() * orthonormal(&b.matrix3).0;
    let trace = turn.x_axis.x + turn.y_axis.y + turn.z_axis.z;
    let axis = DVec3::new(turn.y_axis.z - turn.z_axis.y, turn.z_axis.x - turn.x_axis.z, turn.x_axis.y - turn.y_axis.x);
    axis.length().atan2(trace - 1.0).to_degrees()
}

fn axes_of(skeleton: &Skeleton, bind: &[DAffine3], facing: &Facing, node: usize, role: Option<Role>) -> BoneAxes {
    let bind = &bind[node];
    let (world_of_bone, _) = orthonormal(&bind.matrix3);
    let bone_of_world: DMat3 = world_of_bone.transpose();
    let [up, forward, left] = [facing.up, facing.forward, facing.left].map(|v| (bone_of_world * v).normalize());
    let mirrored = world_of_bone.determinant() < 0.0;
    // (left, up, forward) is right-handed in the world, like (x, y, z).
    let [left_axis, up_axis, forward_axis] = signed_permutation(&[left, up, forward], mirrored);
    let degrees = |a: DVec3, b: DVec3| a.cross(b).length().atan2(a.dot(b)).to_degrees();
    let deviations_deg = [degrees(up, up_axis), degrees(forward, forward_axis), degrees(left, left_axis)];
    BoneAxes {
        node,
        name: skeleton.names()[node].clone(),
        parent: skeleton.parents()[node],
        role,
        up: SignedAxis::of(up_axis),
        forward: SignedAxis::of(forward_axis),
        left: SignedAxis::of(left_axis),
        deviations_deg,
        deviation_deg: deviations_deg.into_iter().fold(0.0, f64::max),
        handedness: if mirrored { Handedness::Left } else { Handedness::Right },
        frame: BoneFrame { up, forward, left },
        bind_world: *bind,
        rest_deg: 0.0,
        carries_legs: false,
    }
}

/// Returns the extent along `up`, in the bind pose, of the skin, of rigid meshes attached to joints or to bones with a
/// role, and of the bones with a role. If no mesh is shown, the extent of the joints. Without a skin, the extent of all
/// meshes, or of all nodes if there are no meshes.
fn height(document: &Document, bind: &[DAffine3], skin: &[DVec3], up: DVec3, roles: &Roles) -> f64 {
    let skeleton = document.skeleton();
    let nodes = skeleton.nodes();
    let extent = |places: &mut dyn Iterator<Item = DVec3>| {
        let heights = places.map(|p| p.dot(up)).filter(|height| height.is_finite());
        let (low, high) = heights.fold((f64::MAX, f64::MIN), |(lo, hi), y| (lo.min(y), hi.max(y)));
        (high - low).max(0.0)
    };
    let place = |(_, bind): (usize, &DAffine3)| bind.translation;
    let joints = || bind.iter().enumerate();
    if skeleton.has_skin() {
        let mut of_body: Vec<bool> =
            (0..nodes.len()).map(|node| nodes[node].is_joint || roles.of(node).is_some()).collect();
        for node in 0..skeleton.len() {
            of_body[node] |= skeleton.parents()[node].is_some_and(|parent| of_body[parent]);
        }
        let is_shown = |node: usize| nodes[node].skin.is_some() || of_body[node];
        let shown = document.points().iter().zip(skin).filter(|(point, _)| is_shown(point.node())).map(|(_, p)| *p);
        let with_role = joints().filter(|(node, _)| roles.of(*node).is_some()).map(place);
        let shown: Vec<DVec3> = shown.collect();
        let height = if shown.is_empty() { 0.0 } else { extent(&mut shown.into_iter().chain(with_role)) };
        if height > 0.0 { height } else { extent(&mut joints().filter(|(node, _)| nodes[*node].is_joint).map(place)) }
    } else {
        let meshes = extent(&mut skin.iter().copied());
        if meshes > 0.0 { meshes } else { extent(&mut joints().map(place)) }
    }
}
