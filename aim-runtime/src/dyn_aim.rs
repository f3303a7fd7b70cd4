//! [`DynAim`]: one character of a rig known at run time.

extern crate std;

use std::vec::Vec;

use glam::{Affine3A, Quat};

use crate::{Call, Joint, Memory, Outcome, Pose, Rig, Settings, State, Targets};

/// One character of a rig known only at run time. State and corrections are on the heap, allocated once by
/// [`new`](Self::new).
///
/// `R` is a rig or a reference to a shared one: `&dyn Rig`, `Arc<dyn Rig>`, `Arc<InterpretedRig>`. Without a heap,
/// drive a [`dyn Rig`](Rig) through slices instead.
///
/// ```
/// # mod turret { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/docs/turret.rs")); }
/// # use turret::Turret;
/// use aim_runtime::glam::{Affine3A, Vec3};
/// use aim_runtime::{DynAim, Pose, Rig, Settings, Status};
/// use std::sync::Arc;
///
/// let shared: Arc<dyn Rig> = Arc::new(Turret);
/// let mut turrets = [DynAim::new(shared.clone()), DynAim::new(shared)];
/// for (turret, target) in turrets.iter_mut().zip([Vec3::new(0.6, 0.0, 0.8), Vec3::Z]) {
///     let frames = (0..60).map(|_| turret.aim(&Pose::new([Affine3A::IDENTITY]), target, 1.0 / 60.0, &Settings::default()));
///     assert_eq!(frames.last().unwrap().status, Status::Reached);
///     assert!((turret.corrections()[0] * Vec3::Z).abs_diff_eq(target, 2e-3));
/// }
/// ```
#[derive(Clone, Debug)]
pub struct DynAim<R> {
    /// The rig.
    pub rig: R,
    /// The joint angles, and the memory kept between frames.
    pub state: State<Vec<Joint>>,
    corrections: Vec<Quat>,
    other_eye_correction: Option<Quat>,
}

impl<R: Rig> DynAim<R> {
    /// Creates a character at rest. Allocates one state and one correction for each joint.
    pub fn new(rig: R) -> Self {
        let count = rig.description().joints().len();
        let (state, corrections) = (State::new(std::vec![Joint::REST; count]), std::vec![Quat::IDENTITY; count]);
        Self { rig, state, corrections, other_eye_correction: None }
    }

    /// Turns the character towards the target for one frame of `dt` seconds; see [`Aim::aim`](crate::Aim::aim).
    pub fn aim<'a, A: AsRef<[Affine3A]>>(
        &mut self,
        pose: &Pose<A>,
        target: impl Into<Targets<'a>>,
        dt: f32,
        settings: &Settings,
    ) -> Outcome {
        self.call(pose, &Call { targets: target.into(), dt: Some(dt), settings })
    }

    /// Puts the character on the target at once; see [`Aim::snap`](crate::Aim::snap).
    ///
    /// ```
    /// # mod turret { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/docs/turret.rs")); }
    /// # use turret::Turret;
    /// use aim_runtime::glam::{Affine3A, Quat, Vec3};
    /// use aim_runtime::{DynAim, Pose, Settings};
    ///
    /// let (mut turret, pose) = (DynAim::new(&Turret), Pose::new([Affine3A::IDENTITY]));
    /// turret.snap(&pose, Vec3::X, &Settings::default());
    /// assert!((turret.corrections()[0] * Vec3::Z).abs_diff_eq(Vec3::X, 2e-3));
    /// turret.reset();
    /// assert_eq!(turret.corrections(), [Quat::IDENTITY]);
    /// ```
    pub fn snap<'a, A: AsRef<[Affine3A]>>(
        &mut self,
        pose: &Pose<A>,
        target: impl Into<Targets<'a>>,
        settings: &Settings,
    ) -> Outcome {
        self.call(pose, &Call { targets: target.into(), dt: None, settings })
    }

    /// Returns each joint's correction from the last call; see [`Aimed::corrections`](crate::Aimed::corrections).
    #[must_use]
    pub fn corrections(&self) -> &[Quat] {
        &self.corrections
    }

    /// Returns the other eye's correction from the last call. If that call had no usable pose, the earlier value is
    /// kept. `None` if the pose had [no other eye](Pose::with_other_eye).
    #[must_use]
    pub fn other_eye_correction(&self) -> Option<Quat> {
        self.other_eye_correction
    }

    /// Returns every joint to rest at once and clears the memory.
    pub fn reset(&mut self) {
        self.state.joints.fill(Joint::REST);
        self.state.memory = Memory::NONE;
        self.corrections.fill(Quat::IDENTITY);
        self.other_eye_correction = None;
    }

    fn call<A: AsRef<[Affine3A]>>(&mut self, pose: &Pose<A>, call: &Call<'_>) -> Outcome {
        let outcome = (&self.rig as &dyn Rig).aim(&mut self.state, pose, call, &mut self.corrections);
        if pose.other_eye.is_none() || outcome.other_eye_correction.is_some() {
            self.other_eye_correction = outcome.other_eye_correction;
        }
        outcome
    }
}
