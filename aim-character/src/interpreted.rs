//! A rig that is known only at run time: its derived programs run through the interpreter.

use std::ops::{Add, Div, Mul, Neg, Sub};

use aim_codegen::{AngleRange, Frame, JointSpec, NaturalSpec, RigPrograms, RigSpec};
use aim_runtime::{AimRig, Axes, Effector, Joint, JointInfo, Natural, Role, Scalar};
use aim_symbolic::{Number, Program};

/// The rig with its joints' state.
#[derive(Clone, Debug)]
pub struct InterpretedRig {
    spec: RigSpec,
    programs: RigPrograms,
    infos: Vec<JointInfo>,
    effector: Effector,
    natural: Natural,
    joints: Vec<Joint>,
}

impl InterpretedRig {
    /// The rig at rest.
    pub fn new(spec: &RigSpec) -> Self {
        let mut rig = Self {
            spec: spec.clone(),
            programs: RigPrograms::derive(spec),
            infos: Vec::new(),
            effector: Effector { forward: single(spec.effector.frame.forward), origin: single(spec.effector.origin) },
            natural: Natural::default(),
            joints: vec![Joint::default(); spec.joints.len()],
        };
        rig.read(spec);
        rig
    }

    /// The rig as it is declared now.
    pub fn spec(&self) -> &RigSpec {
        &self.spec
    }

    /// Declares the rig anew, say with other ranges, rates or comfort. The joints stay where they are, and what the
    /// derivation depends on (axes, effector, which angles there are) is derived again only where it changed; another
    /// number of joints starts from rest.
    pub fn declare(&mut self, spec: &RigSpec) {
        if !same_derivation(&self.spec, spec) {
            let joints = core::mem::take(&mut self.joints);
            *self = Self::new(spec);
            if joints.len() == self.joints.len() {
                self.joints = joints;
            }
        } else if self.spec != *spec {
            self.spec = spec.clone();
            self.read(spec);
        }
    }

    /// What the solvers are told of the joints.
    fn read(&mut self, spec: &RigSpec) {
        self.infos = spec.joints.iter().map(joint_info).collect();
        self.natural = spec.natural.as_ref().map_or_else(Natural::default, natural);
    }
}

/// Whether the same programs serve both.
fn same_derivation(a: &RigSpec, b: &RigSpec) -> bool {
    let same = |a: &JointSpec, b: &JointSpec| {
        let angles = |joint: &JointSpec| [joint.pitch.is_some(), joint.heading.is_some()];
        (&a.name, a.frame, angles(a)) == (&b.name, b.frame, angles(b))
    };
    a.effector == b.effector
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
    let range = |range: AngleRange| match range {
        AngleRange::Between(lo, hi) => (lo as f32, hi as f32),
        AngleRange::Free => (f32::NEG_INFINITY, f32::INFINITY),
    };
    let mut info = JointInfo::new(axes, joint.rate as f32).with_comfort(joint.comfort as f32);
    if let Some((lo, hi)) = joint.heading.map(range) {
        info = info.with_heading(lo, hi);
    }
    if let Some((lo, hi)) = joint.pitch.map(range) {
        info = info.with_pitch(lo, hi);
    }
    if let Some(acceleration) = joint.acceleration {
        info = info.with_acceleration(acceleration as f32);
    }
    if let Some(level) = joint.level {
        info = info.with_level(level as f32);
    }
    if let Some(narrowing) = joint.narrowing {
        info = info.with_narrowing(narrowing as f32);
    }
    info = info.with_role(match joint.role() {
        aim_codegen::Role::Eye => Role::Eye,
        aim_codegen::Role::Head => Role::Head,
        aim_codegen::Role::Neck => Role::Neck,
        aim_codegen::Role::Spine => Role::Spine,
        aim_codegen::Role::Other => Role::Other,
    });
    if joint.absolute { info.with_absolute_range() } else { info }
}

#[expect(clippy::cast_possible_truncation, reason = "declared numbers are stored in f32")]
fn natural(spec: &NaturalSpec) -> Natural {
    Natural::default()
        .with_eyes_only(spec.eyes_only as f32)
        .with_head_share(spec.head_share as f32)
        .with_engagement(spec.engage as f32, spec.release as f32)
        .with_delay(spec.delay as f32)
}

/// The runtime's number as the interpreter's.
#[derive(Clone, Copy)]
struct Through<S>(S);

macro_rules! operators {
    ($($operator:ident $method:ident),*) => {$(
        impl<S: Scalar> $operator for Through<S> {
            type Output = Self;
            fn $method(self, other: Self) -> Self {
                Self($operator::$method(self.0, other.0))
            }
        }
    )*};
}

operators!(Add add, Sub sub, Mul mul, Div div);

impl<S: Scalar> Neg for Through<S> {
    type Output = Self;
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl<S: Scalar> Number for Through<S> {
    fn constant(value: f64) -> Self {
        Self(S::constant(value))
    }
    fn tiny() -> Self {
        Self(S::TINY)
    }
    fn sqrt(self) -> Self {
        Self(self.0.sqrt())
    }
    fn select_less(a: Self, b: Self, then: Self, otherwise: Self) -> Self {
        Self(S::select_less(a.0, b.0, then.0, otherwise.0))
    }
}

fn run<S: Scalar>(program: &Program, inputs: impl Iterator<Item = S>, out: &mut [S]) {
    let inputs: Vec<Through<S>> = inputs.map(Through).collect();
    let mut results = vec![Through(S::ZERO); program.outputs().len()];
    if results.len() == out.len() {
        program.run(&inputs, &mut results);
    } else {
        results = vec![Through(S::ZERO); out.len()];
    }
    for (out, Through(result)) in out.iter_mut().zip(results) {
        *out = result;
    }
}

impl AimRig for InterpretedRig {
    type Array<T: Copy> = Vec<T>;

    fn array<T: Copy>(&self, value: T) -> Vec<T> {
        vec![value; self.infos.len()]
    }

    fn joint_infos(&self) -> &[JointInfo] {
        &self.infos
    }

    fn effector(&self) -> Effector {
        self.effector
    }

    fn natural(&self) -> Natural {
        self.natural
    }

    fn joints(&self) -> Vec<Joint> {
        self.joints.clone()
    }

    fn joint(&self, joint: usize) -> Option<&Joint> {
        self.joints.get(joint)
    }

    fn joint_mut(&mut self, joint: usize) -> Option<&mut Joint> {
        self.joints.get_mut(joint)
    }

    fn set_joints(&mut self, joints: Vec<Joint>) {
        self.joints = joints;
    }

    fn aim_gradient<S: Scalar>(
        &self,
        joint: usize,
        effector_to_joint: &[S; 12],
        target: &[S; 3],
        sin_cos: &[S; 4],
    ) -> [S; 3] {
        let mut out = [S::ZERO; 3];
        if let Some(program) = self.programs.joints.get(joint) {
            run(program, effector_to_joint.iter().chain(target).chain(sin_cos).copied(), &mut out);
        }
        out
    }

    fn chain_value_gradient<S: Scalar>(&self, links: &[[S; 12]], target: &[S; 3], sin_cos: &[[S; 4]], out: &mut [S]) {
        let inputs = links.iter().flatten().chain(target).chain(sin_cos.iter().flatten()).copied();
        run(&self.programs.chain_value_gradient, inputs, out);
    }

    fn chain_residual_jacobian<S: Scalar>(
        &self,
        links: &[[S; 12]],
        target: &[S; 3],
        sin_cos: &[[S; 4]],
        out: &mut [S],
    ) {
        let inputs = links.iter().flatten().chain(target).chain(sin_cos.iter().flatten()).copied();
        run(&self.programs.chain_residual_jacobian, inputs, out);
    }
}
