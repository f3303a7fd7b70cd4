//! Data types: what is declared and derived for a rig ([`Rig`], [`Description`]), a character's state ([`State`],
//! [`Joint`], [`Memory`]), and the inputs and outputs of a call ([`Pose`], [`Settings`], [`Outcome`]).
//!
//! No solver is in this module; [`aim`](crate::aim) connects these types with the solvers.

mod body_part;
mod chain_rig;
mod description;
mod joint_info;
mod outcome;
mod pose;
mod settings;
mod state;

#[cfg(feature = "std")]
extern crate std;

pub(crate) use body_part::{BodyPart, EXACT_JOINTS, MOST_PARTS};
pub(crate) use chain_rig::{ChainRig, MOST_JOINTS, PerJoint};
pub(crate) use description::{AllLanes, LANE_JOINTS, Lanes};
pub use description::{Description, Effector};
pub use joint_info::JointInfo;
pub use outcome::{JointSet, Outcome, Status};
pub use pose::Pose;
pub(crate) use pose::PoseSlices;
pub use settings::{Ascent, Behind, Settings, Solver};
pub(crate) use state::{HeadGoal, Side, StateSlices, Support, Swings};
pub use state::{Joint, Memory, State};

/// An immutable rig: its description and the kernels derived for it. One rig can be shared by any number of characters.
///
/// Implemented by `#[derive(AimRig)]` and by rigs that are interpreted at run time; any type that can evaluate the two
/// kernels can implement it. Object-safe: [`Rig::aim`](trait.Rig.html#method.aim) drives a `&dyn Rig` through slices.
///
/// Kernels take links and targets in the layout of the generated C functions. A link is a rigid transform of twelve
/// numbers: the three rows of the rotation in the row-vector convention of the paper (`p' = p · M`), then the
/// translation. The rotation part need only be orthogonal: it may contain a mirror.
///
/// ```
/// # mod turret { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/docs/turret.rs")); }
/// # use turret::Turret;
/// use aim_runtime::Rig;
///
/// // A table of any rig, whatever its type.
/// fn table(rig: &dyn Rig) -> Vec<String> {
///     let joints = rig.description().joints().iter().enumerate();
///     joints.map(|(index, joint)| format!("{}: {} rad/s", rig.joint_name(index).unwrap_or("?"), joint.rate)).collect()
/// }
/// assert_eq!(table(&Turret), ["turret: 3 rad/s"]);
/// ```
pub trait Rig {
    /// Returns the declared data: joints from the effector inward, effector, and sharing of the gaze.
    fn description(&self) -> Description<'_>;

    /// Returns the name of a joint, such as `left_eye`; `None` past the last joint.
    fn joint_name(&self, joint: usize) -> Option<&str>;

    /// Returns one of the names that the joint's bone may have in a model; `None` past the last candidate.
    fn bone_name(&self, joint: usize, candidate: usize) -> Option<&str>;

    /// Returns the name of a bone that is a child of the joint's bone but is held on the joint's carrier. `None` past
    /// the last one, or if the rig declares none. See [`Description::held_correction`].
    fn held_bone(&self, joint: usize, place: usize) -> Option<&str> {
        let _ = (joint, place);
        None
    }

    /// Returns the name of the bone of the other eye, joint 0's partner; `None` if the rig declares none. See
    /// [`Pose::with_other_eye`].
    fn other_eye_bone(&self) -> Option<&str> {
        None
    }

    /// Writes the stereographic residual of the chain (left, up), then its Jacobian: the derivatives of the left
    /// component by the declared angles (pitch before heading, joint by joint), then those of the up component.
    ///
    /// `links[0]` leads from effector space (joint 0's axes, origin at the effector) to joint 0, and `links[i]` from
    /// joint i−1 to joint i. `target` is in the last joint's space. `sin_cos` holds sin p, cos p, sin h, cos h of each
    /// joint. For a rig whose effector starts at joint 0's origin and whose joint 0 has no upright heading, `links[0]`
    /// is the identity and may be ignored.
    ///
    /// The residual is `2 lateral / (distance + forward)` of the target as seen from the effector, a vector of length
    /// 2·tan(angle/2) along [the effector's left and up](Effector): joint 0's left and up, orthogonalised against the
    /// effector's forward. (If that points along joint 0's up, the effector's up is joint 0's backward direction; if it
    /// points down, joint 0's forward.) The result is zero where the residual is singular: for a target at the effector
    /// or exactly behind. Success is therefore judged by the angle, never by the residual. `out` must hold 2 + 2 × the
    /// number of declared angles; slices of other lengths give zeros.
    fn residual_jacobian(&self, links: &[[f32; 12]], target: &[f32; 3], sin_cos: &[[f32; 4]], out: &mut [f32]);

    /// Returns the aim, ∂aim/∂pitch and ∂aim/∂heading of joint `joint`, with all joints nearer the effector held fixed.
    ///
    /// `effector_to_joint` leads from effector space to the joint's space before its added rotation; `target` is in
    /// that joint's space. All zero if the target is at the effector or if there is no such joint; finite for finite
    /// input.
    fn aim_gradient(
        &self,
        joint: usize,
        effector_to_joint: &[f32; 12],
        target: &[f32; 3],
        sin_cos: &[f32; 4],
    ) -> [f32; 3];
}

/// Implements [`Rig`] for a pointer to a rig.
macro_rules! rig_behind {
    ($pointer:ty) => {
        impl<R: Rig + ?Sized> Rig for $pointer {
            fn description(&self) -> Description<'_> {
                (**self).description()
            }

            fn joint_name(&self, joint: usize) -> Option<&str> {
                (**self).joint_name(joint)
            }

            fn bone_name(&self, joint: usize, candidate: usize) -> Option<&str> {
                (**self).bone_name(joint, candidate)
            }

            fn held_bone(&self, joint: usize, place: usize) -> Option<&str> {
                (**self).held_bone(joint, place)
            }

            fn other_eye_bone(&self) -> Option<&str> {
                (**self).other_eye_bone()
            }

            fn residual_jacobian(&self, links: &[[f32; 12]], target: &[f32; 3], sin_cos: &[[f32; 4]], out: &mut [f32]) {
                (**self).residual_jacobian(links, target, sin_cos, out);
            }

            fn aim_gradient(
                &self,
                joint: usize,
                effector_to_joint: &[f32; 12],
                target: &[f32; 3],
                sin_cos: &[f32; 4],
            ) -> [f32; 3] {
                (**self).aim_gradient(joint, effector_to_joint, target, sin_cos)
            }
        }
    };
}

rig_behind!(&R);
#[cfg(feature = "std")]
rig_behind!(std::sync::Arc<R>);
#[cfg(feature = "std")]
rig_behind!(std::boxed::Box<R>);

/// A rig known at compile time. `#[derive(AimRig)]` implements this trait and [`Rig`].
///
/// A value of the deriving struct holds one [`Joint`] per field: the angles of a character by name
/// ([`Aim::joints`](crate::Aim::joints)). The rig itself is [`RIG`](Self::RIG).
///
/// ```
/// # mod turret { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/docs/turret.rs")); }
/// # use turret::Turret;
/// use aim_runtime::glam::{Affine3A, Quat};
/// use aim_runtime::{Aim, AimRig, Pose, Settings, Targets};
///
/// /// Aims a character of any rig, of however many joints.
/// fn turn<R: AimRig>(hero: &mut Aim<R>, pose: R::Array<Affine3A>, bones: &mut R::Array<Quat>, target: Targets<'_>) {
///     let aimed = hero.aim(&Pose::new(pose), target, 1.0 / 60.0, &Settings::default());
///     for (bone, correction) in bones.as_mut().iter_mut().zip(aimed.corrections.as_ref()) {
///         *bone *= *correction;
///     }
/// }
///
/// let (mut turret, mut bones) = (Aim::<Turret>::new(), Turret::array(Quat::IDENTITY));
/// turn(&mut turret, Turret::array(Affine3A::IDENTITY), &mut bones, Targets::Point([1.0, 0.0, 1.0].into()));
/// assert!((bones[0].to_axis_angle().1 - 3.0 / 60.0).abs() < 1e-5);
/// ```
pub trait AimRig: Rig + Sized + 'static {
    /// Array with one value per joint: `[T; N]`.
    type Array<T: Copy>: Copy + AsRef<[T]> + AsMut<[T]>;

    /// The rig, shared by all characters.
    const RIG: &'static Self;

    /// The value of [`Rig::description`] as a constant.
    const DESCRIPTION: &'static Description<'static>;

    /// Returns `value` for every joint.
    fn array<T: Copy>(value: T) -> Self::Array<T>;

    /// Returns the joints by name.
    fn from_joints(joints: Self::Array<Joint>) -> Self;
}
