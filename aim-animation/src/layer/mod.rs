//! [`Layer`]: what changes a figure's pose in a frame. `limb.rs` brings a limb's tip to a point, `aim.rs` aims a rig, `poses.rs` blends
//! poses that aim, `recoil.rs` kicks what a hand holds.

#[cfg(feature = "std")]
mod aim;
mod limb;
mod poses;
mod recoil;

#[cfg(feature = "std")]
pub use aim::AimLayer;
pub use limb::{LimbLayer, Space, TipTarget};
pub use poses::{AimLine, AimPoseError, AimPoseSet, AimPosesLayer};
pub use recoil::Recoil;

use crate::figure::Figure;
use crate::pose::PoseError;

/// A step of a frame: reads the pose that the layers before it have left, and changes it. A closure is one, too.
///
/// The order that suits most characters: animation and blending, [aim poses](AimPosesLayer), aim (`AimLayer`, with the feature `std`), [feet](crate::Stance), hands, attachments.
/// Whatever moves the trunk comes before the limbs that are to hold on to something.
///
/// ```
/// use aim_animation::glam::Quat;
/// use aim_animation::{Bone, Figure, Layer, PoseError, Skeleton};
///
/// struct Nod {
///     head: usize,
///     angle_rad: f32,
/// }
///
/// impl Layer for Nod {
///     fn apply(&mut self, figure: &mut Figure, dt_s: f32) -> Result<(), PoseError> {
///         self.angle_rad += 0.5 * dt_s;
///         figure.turn(self.head, Quat::from_rotation_x(self.angle_rad));
///         Ok(())
///     }
/// }
///
/// let mut figure = Figure::new(Skeleton::new([Bone::new("head", None)])?);
/// let mut nod = Nod { head: 0, angle_rad: 0.0 };
/// figure.run(1.0, &mut [&mut nod])?;
/// assert!(figure.local()[0].rotation.angle_between(Quat::from_rotation_x(0.5)) < 1e-3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub trait Layer {
    /// Changes the pose of a frame that is `dt_s` seconds after the one before.
    ///
    /// # Errors
    /// What it was made for has another number of bones than the figure.
    fn apply(&mut self, figure: &mut Figure, dt_s: f32) -> Result<(), PoseError>;
}

impl<F: FnMut(&mut Figure, f32) -> Result<(), PoseError>> Layer for F {
    fn apply(&mut self, figure: &mut Figure, dt_s: f32) -> Result<(), PoseError> {
        self(figure, dt_s)
    }
}
