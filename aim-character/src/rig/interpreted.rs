//! [`InterpretedRig`]: a rig that is known only at run time. An interpreter runs its derived programs.

use std::sync::Arc;

use aim_codegen::emit::rust_kernels::trait_kernels;
use aim_codegen::objective::{AIM_GRADIENT, FirstLink};
use aim_codegen::{AngleRange, Frame, JointSpec, NaturalSpec, RigSpec};
use aim_runtime::{Axes, Budget, Budgets, Description, Effector, GazeSharing, JointInfo, Rig};

use crate::rig::tape::Tape;

/// A rig declared at run time, without the state of a character. Clones share the derived programs.
#[derive(Clone, Debug)]
pub struct InterpretedRig {
    spec: RigSpec,
    kernels: Arc<Kernels>,
    infos: Vec<JointInfo>,
    effector: Effector,
    sharing: GazeSharing,
    budgets: Budgets,
}

/// The kernels that [`Rig`] requires.
#[derive(Debug)]
struct Kernels {
    residual_jacobian: Tape,
    /// Tapes for the distinct joints: joints with equal programs share one.
    aim_gradients: Vec<Tape>,
    /// For each joint, the index of its tape in `aim_gradients`.
    joints: Vec<usize>,
}

impl Kernels {
    fn derive(spec: &RigSpec) -> Self {
        let (aims, chains): (Vec<_>, Vec<_>) =
            trait_kernels(spec).into_iter().partition(|kernel| *kernel.objective == AIM_GRADIENT);
        let joint = |joint: usize| aims.iter().position(|kernel| kernel.joints.contains(&joint)).unwrap_or_default();
        Self {
            joints: (0..spec.joints.len()).map(joint).collect(),
            residual_jacobian: Tape::new(&chains[0].program),
            aim_gradients: aims.iter().map(|kernel| Tape::new(&kernel.program)).collect(),
        }
    }
}

impl InterpretedRig {
    /// Derives the rig of a declaration.
    #[must_use]
    pub fn new(spec: &RigSpec) -> Self {
        Self::with_kernels(spec, Arc::new(Kernels::derive(spec)))
    }

    fn with_kernels(spec: &RigSpec, kernels: Arc<Kernels>) -> Self {
        Self {
            spec: spec.clone(),
            kernels,
            infos: spec.joints.iter().map(joint_info).collect(),
            effector: Effector { forward: single(spec.effector.frame.forward), origin: single(spec.effector.origin) },
            sharing: spec.natural.as_ref().map_or(GazeSharing::HUMAN, sharing),
            budgets: spec.region.as_ref().map_or(Budgets::HUMAN, budgets),
        }
    }

    /// Returns the present declaration of the rig.
    #[must_use]
    pub fn spec(&self) -> &RigSpec {
        &self.spec
    }

    /// Replaces the declaration, for example to change ranges, rates or stiffness. The programs are derived again only
    /// if the new one differs in what they depend on: joint names, axes, the effector, the set of declared angles, or
    /// upright headings.
    pub fn declare(&mut self, spec: &RigSpec) {
        if !same_derivation(&self.spec, spec) {
            *self = Self::new(spec);
        } else if self.spec != *spec {
            *self = Self::with_kernels(spec, Arc::clone(&self.kernels));
        }
    }
}

/// Returns `true` if the same programs serve both declarations.
fn same_derivation(a: &RigSpec, b: &RigSpec) -> bool {
    let same = |a: &JointSpec, b: &JointSpec| {
        let angles = |joint: &JointSpec| [joint.pitch.is_some(), joint.heading.is_some()];
        (&a.name, a.frame, angles(a)) == (&b.name, b.frame, angles(b))
    };
    a.effector == b.effector
        && FirstLink::of(a) == FirstLink::of(b)
        && a.joints.len() == b.joints.len()
        && a.joints.iter().zip(&b.joints).all(|(a, b)| same(a, b))
}

#[expect(clippy::cast_possible_truncation, reason = "declared numbers are stored in f32")]
fn single(v: [f64; 3]) -> [f32; 3] {
    v.map(|c| c as f32)
}

#[expect(clippy::cast_possible_truncation, reason = "declared numbers are stored in f32")]
fn joint_info(joint: &JointSpec) -> JointInfo {
    let Frame { up, forward, left } = joint.frame;
    let axes = Axes { up: single(up), forward: single(forward), left: single(left) };
    let range = |range: AngleRange| range.ends().map(|end| end as f32);
    let mut info = JointInfo::new(axes, joint.rate as f32)
        .with_stiffness(joint.stiffness as f32)
        .with_role(joint.role)
        .with_limits_from(joint.limits_from);
    info.heading = joint.heading.map(range);
    info.pitch = joint.pitch.map(range);
    info.acceleration = joint.acceleration.map_or(f32::INFINITY, |acceleration| acceleration as f32);
    info.upright = joint.upright.map(|upright| upright as f32);
    info.pitch_taper = joint.pitch_taper.map_or(0.0, |taper| taper as f32);
    info
}

#[expect(clippy::cast_possible_truncation, reason = "declared numbers are stored in f32")]
fn sharing(spec: &NaturalSpec) -> GazeSharing {
    GazeSharing::HUMAN
        .with_eyes_only(spec.eyes_only as f32)
        .with_head_share(spec.head_share as f32)
        .with_engagement(spec.engage as f32, spec.release as f32)
        .with_delay(spec.delay as f32)
}

#[expect(clippy::cast_possible_truncation, reason = "declared numbers are stored in f32")]
fn budgets(spec: &aim_codegen::Budgets) -> Budgets {
    let budget = |budget: &aim_codegen::Budget| Budget {
        heading: budget.heading.map(|end| end as f32),
        pitch: budget.pitch.map(|end| end as f32),
        rate: budget.rate as f32,
        acceleration: budget.acceleration as f32,
    };
    Budgets { head: budget(&spec.head), chest: budget(&spec.chest) }
}

impl Rig for InterpretedRig {
    fn description(&self) -> Description<'_> {
        Description::new(&self.infos).with_effector(self.effector).with_sharing(self.sharing).with_budgets(self.budgets)
    }

    fn joint_name(&self, joint: usize) -> Option<&str> {
        self.spec.joints.get(joint).map(|joint| &joint.name[..])
    }

    fn bone_name(&self, joint: usize, candidate: usize) -> Option<&str> {
        self.spec.joints.get(joint)?.bones.get(candidate).map(|bone| &bone[..])
    }

    fn held_bone(&self, joint: usize, place: usize) -> Option<&str> {
        self.spec.joints.get(joint)?.hold.as_ref()?.get(place).map(|bone| &bone[..])
    }

    fn other_eye_bone(&self) -> Option<&str> {
        self.spec.joints.first()?.other_eye.as_deref()
    }

    fn residual_jacobian(&self, links: &[[f32; 12]], target: &[f32; 3], sin_cos: &[[f32; 4]], out: &mut [f32]) {
        self.kernels.residual_jacobian.run([links.as_flattened(), target, sin_cos.as_flattened()], out);
    }

    fn aim_gradient(
        &self,
        joint: usize,
        effector_to_joint: &[f32; 12],
        target: &[f32; 3],
        sin_cos: &[f32; 4],
    ) -> [f32; 3] {
        let mut out = [0.0; 3];
        if let Some(&tape) = self.kernels.joints.get(joint) {
            self.kernels.aim_gradients[tape].run([effector_to_joint, target, sin_cos], &mut out);
        }
        out
    }
}
