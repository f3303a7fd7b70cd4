//! Bone axes measured: which way each bone's own axes point in the character, in its bind pose.
//!
//! `roles.rs` tells parts by VRM and by names, `bind.rs` places the bind pose in the world, `plan.rs` finds legs, trunk, neck and
//! head from the tree alone, `clues.rs` says what each part of the body tells about where it faces, `facing.rs` weighs that,
//! `stance.rs` finds what it stands on, and this file holds the bones against it; `evidence.rs` has the words for what told it.

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

/// A signed coordinate axis of a bone's own space.
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
    /// Each axis, in the order of the variants, with its name and its unit vector.
    const ALL: [(Self, &str, DVec3); 6] = [
        (Self::PlusX, "+X", DVec3::X),
        (Self::MinusX, "-X", DVec3::NEG_X),
        (Self::PlusY, "+Y", DVec3::Y),
        (Self::MinusY, "-Y", DVec3::NEG_Y),
        (Self::PlusZ, "+Z", DVec3::Z),
        (Self::MinusZ, "-Z", DVec3::NEG_Z),
    ];

    /// `+X`, `-X`, `+Y`, `-Y`, `+Z` or `-Z`.
    #[must_use]
    pub fn as_str(self) -> &'static str {
        Self::ALL[self as usize].1
    }

    /// The unit vector.
    #[must_use]
    pub fn vector(self) -> DVec3 {
        Self::ALL[self as usize].2
    }

    /// The axis nearest to a direction.
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

/// Handedness of a bone's own axes in the world.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Handedness {
    /// Not mirrored.
    Right,
    /// Mirrored: an odd number of negative scales above it.
    Left,
}

impl Handedness {
    /// `right` or `left`.
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Right => "right",
            Self::Left => "left",
        }
    }
}

/// The character's up, forward and left as unit vectors in one bone's own space, at right angles.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct BoneFrame {
    /// The character's up in the bone's space.
    pub up: DVec3,
    /// The character's forward in the bone's space.
    pub forward: DVec3,
    /// The character's left in the bone's space.
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
    /// Its role, if its name, the VRM extension or the body's plan tells one.
    pub role: Option<Role>,
    /// The local axis nearest to the character's up. The three nearest axes are distinct and fit together.
    pub up: SignedAxis,
    /// The local axis nearest to the character's forward.
    pub forward: SignedAxis,
    /// The local axis nearest to the character's left.
    pub left: SignedAxis,
    /// Deviations of up, forward and left from those axes, degrees.
    pub deviations_deg: [f64; 3],
    /// The largest of the three, degrees.
    pub deviation_deg: f64,
    /// Handedness of the bone's own axes.
    pub handedness: Handedness,
    /// The exact directions, of which the axes are the nearest cardinal ones.
    pub frame: BoneFrame,
    /// World ← bone in the bind pose.
    pub bind_world: DAffine3,
    /// By how much the bone is turned in the file's rest pose from where it is in the bind pose, degrees.
    pub rest_deg: f64,
    /// Whether a leg (or a foreleg) hangs on the bone, however deep, so that turning the bone moves feet.
    pub carries_legs: bool,
}

/// The pose in which axes are measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MeasuredPose {
    /// The one that the skin was fitted in, from the inverse bind matrices.
    Bind,
    /// The one that the nodes have when no clip plays: often a frame of some animation.
    Rest,
}

/// A whole character, measured.
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
    /// The pose that was measured: the bind pose, unless the file has no skin that tells one.
    pub pose: MeasuredPose,
    /// The character's up in the world: +Y, as glTF demands, unless its legs plainly stand along another axis.
    pub up: DVec3,
    /// The character's forward in the world, level.
    pub forward: DVec3,
    /// The character's left in the world, level.
    pub left: DVec3,
    /// Evidence for the facing, and against it.
    pub evidence: Vec<Evidence>,
    /// Confidence in the facing, 0…1: the share of the evidence that agrees on which way is front, less where no names tell the
    /// sides; 1 where the user states it. Below a half it is not reliable.
    pub confidence: f64,
    /// Height in the bind pose, in units of the file: of the skin, of rigid parts that hang on its bones, and of the bones
    /// that play a role; without a skin of all meshes, without any of the nodes. 0 where there is nothing.
    pub height: f64,
    /// Joints and their ancestors, and eyes that are plain nodes, in node order; every node of a file without skin.
    pub bones: Vec<BoneAxes>,
    /// World ← node in the bind pose, for every node of the file.
    pub bind_world: Vec<DAffine3>,
    /// The first bones of the arms by the body's plan, where no names tell them.
    pub(crate) nameless_arms: Option<[usize; 2]>,
    /// The kind of its body.
    pub(crate) kind: BodyKind,
}

impl Measurement {
    /// Measures a document in its bind pose.
    #[must_use]
    pub fn of(document: &Document) -> Self {
        Self::in_pose(document, MeasuredPose::Bind)
    }

    /// Measures a document in its bind pose, where the user says what is up or forward.
    #[must_use]
    pub fn stated(document: &Document, stated: Stated) -> Self {
        Self::measured(document, MeasuredPose::Bind, stated)
    }

    /// Measures a document. In the rest pose [`bind_world`](Self::bind_world) is that pose.
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
        // Where the way goes on to a tail, the legs are forelegs and the hips are a chest.
        let plan = plan.filter(|plan| !BoneName::new(&skeleton.names()[plan.head]).has("tail"));
        if let Some(plan) = &plan {
            // The plan is the same wherever the bind pose is placed, and where that is may depend on the hips.
            if roles.complete(skeleton, plan) {
                bind = placed(&roles);
            }
        }
        // What hangs beyond a head that names tell is a jaw or an ear.
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

    /// A metre of a character that is 1.7 m high, in units of the file; 1 if the height is not known.
    #[must_use]
    pub fn metre(&self) -> f64 {
        if self.height > 0.0 { self.height / 1.7 } else { 1.0 }
    }

    /// True if the character goes on all fours: two pairs of its limbs stand on the ground, one ahead of the other, or its head lies
    /// ahead of its hips rather than above them and it has no wings.
    #[must_use]
    pub fn goes_on_all_fours(&self) -> bool {
        self.kind == BodyKind::Quadruped
    }

    /// The measured bone of a node.
    #[must_use]
    pub fn bone(&self, node: usize) -> Option<&BoneAxes> {
        self.bones.iter().find(|bone| bone.node == node)
    }

    /// The first bone that plays a role.
    #[must_use]
    pub fn with_role(&self, role: Role) -> Option<&BoneAxes> {
        self.bones.iter().find(|bone| bone.role == Some(role))
    }
}

/// Degrees by which one frame is turned from another.
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
    // left, up, forward are right-handed in the world, as x, y, z are.
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

/// The extent along `up` of what the character shows and of the bones that play a role: of the skin, and of rigid meshes that
/// hang on joints or on bones with a role. Without a skin that of all meshes, or, where there are none, of all nodes.
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
