//! [`AimLayer`]: aims a rig at a point in world space.

use alloc::sync::Arc;

use aim_runtime::glam::Vec3;
use aim_runtime::{DynAim, Outcome, Rig, Settings};

use crate::aim_chain::{AimChain, AimFrame};
use crate::figure::{Figure, Layer};
use crate::pose::PoseError;

/// Layer that aims a rig of a [`Figure`], such as a gaze or the barrel of a gun. Joints turn at their rates and within
/// their ranges of motion.
///
/// ```
/// # mod turret { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/../aim-runtime/docs/turret.rs")); }
/// # use turret::Turret;
/// use aim_animation::glam::Vec3;
/// use aim_animation::{AimChain, AimLayer, Bone, Figure, Skeleton};
///
/// let skeleton = Skeleton::new([Bone::new("turret", None)])?;
/// let mut gun = AimLayer::new(AimChain::new(&skeleton, [0])?, Turret);
/// let mut figure = Figure::new(skeleton);
/// gun.target = Vec3::new(0.6, 0.0, 0.8);
/// for _ in 0..60 {
///     figure.run(1.0 / 60.0, &mut [&mut gun])?;
/// }
/// let forward = figure.model()[0].transform_vector3(Vec3::Z);
/// assert!(forward.distance(gun.target) < 2e-3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct AimLayer<R> {
    /// Target point, world space.
    pub target: Vec3,
    /// Settings of the aim. Changing the weight fades the layer in or out at the joints' rates.
    pub settings: Settings,
    /// The rig and its state.
    pub aim: DynAim<R>,
    chain: Arc<AimChain>,
    frame: AimFrame,
    outcome: Option<Outcome>,
}

impl<R: Rig> AimLayer<R> {
    /// Creates a layer for one character, at rest, with the world origin as the target. To share a chain between
    /// characters, pass an `Arc`.
    #[must_use]
    pub fn new(chain: impl Into<Arc<AimChain>>, rig: R) -> Self {
        let chain = chain.into();
        let frame = chain.frame();
        Self { target: Vec3::ZERO, settings: Settings::default(), aim: DynAim::new(rig), chain, frame, outcome: None }
    }

    /// Returns the outcome of the last frame; `None` before the first one.
    #[must_use]
    pub fn outcome(&self) -> Option<&Outcome> {
        self.outcome.as_ref()
    }
}

impl<R: Rig> Layer for AimLayer<R> {
    fn apply(&mut self, figure: &mut Figure, dt_s: f32) -> Result<(), PoseError> {
        self.frame.place = figure.place.to_affine();
        let (_, local, model) = figure.parts_mut();
        self.chain.gather(&mut self.frame, local, model)?;
        self.outcome = Some(self.aim.aim(&self.frame.pose(), self.target, dt_s, &self.settings));
        self.chain.apply(&self.frame, (&self.aim).into(), local, model)
    }
}
