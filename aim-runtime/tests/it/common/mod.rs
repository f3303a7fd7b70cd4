//! Shared test helpers: a rig with hand-written geometric kernels (not derived), independent forward kinematics in f64,
//! random poses, and a small random number generator.
#![allow(unreachable_pub, reason = "shared by the test modules through globs")]
#![allow(clippy::cast_possible_truncation, reason = "rounding to f32 is meant")]

use core::cell::RefCell;

use aim_runtime::glam::{Affine3A, Mat3A, Quat, Vec3};
use aim_runtime::{
    Axes, Budgets, Call, Description, Effector, Joint, JointInfo, Memory, Outcome, Pose, Rig, Scalar, Settings, State,
    Status, Target,
};

pub mod exact;
pub mod random;
pub mod truth;

pub const DEG: f32 = core::f32::consts::PI / 180.0;

/// Bone axes of the XNA thug: +X up, +Y forward, +Z left.
pub const THUG: Axes = Axes { up: [1.0, 0.0, 0.0], forward: [0.0, 1.0, 0.0], left: [0.0, 0.0, 1.0] };

/// Character with a rig known at run time and geometric kernels.
#[derive(Clone, Debug)]
pub struct NumericRig {
    pub infos: Vec<JointInfo>,
    pub effector: Effector,
    pub budgets: Budgets,
    pub joints: Vec<Joint>,
    pub memory: Memory,
    /// If present, records the targets that the residual is evaluated for.
    pub kernel_targets: Option<RefCell<Vec<[f32; 3]>>>,
    corrections: Vec<Quat>,
    other_eye_correction: Option<Quat>,
}

impl NumericRig {
    pub fn new(infos: Vec<JointInfo>) -> Self {
        let effector = Effector { forward: infos[0].axes().forward, origin: [0.0; 3] };
        let (joints, corrections) = (vec![Joint::default(); infos.len()], vec![Quat::IDENTITY; infos.len()]);
        let memory = Memory::NONE;
        let budgets = Budgets::HUMAN;
        Self { infos, effector, budgets, joints, memory, kernel_targets: None, corrections, other_eye_correction: None }
    }

    pub fn call<A: AsRef<[Affine3A]>>(&mut self, pose: &Pose<A>, call: &Call<'_>) -> Outcome {
        let mut state = State { joints: core::mem::take(&mut self.joints), memory: self.memory };
        let mut corrections = core::mem::take(&mut self.corrections);
        corrections.resize(self.infos.len(), Quat::IDENTITY);
        let outcome = (self as &dyn Rig).aim(&mut state, pose, call, &mut corrections);
        (self.joints, self.memory, self.corrections) = (state.joints, state.memory, corrections);
        // If the pose is unusable, the last correction is kept, as an engine would.
        if outcome.status != Status::Degenerate || outcome.other_eye_correction.is_some() {
            self.other_eye_correction = outcome.other_eye_correction;
        }
        outcome
    }

    pub fn aim<A: AsRef<[Affine3A]>>(&mut self, pose: &Pose<A>, target: Vec3, dt: f32) -> Outcome {
        self.aim_with(pose, target, dt, &Settings::default())
    }

    pub fn aim_with<A: AsRef<[Affine3A]>>(
        &mut self,
        pose: &Pose<A>,
        target: Vec3,
        dt: f32,
        settings: &Settings,
    ) -> Outcome {
        self.call(pose, &Call { targets: target.into(), dt: Some(dt), settings })
    }

    pub fn aim_at<A: AsRef<[Affine3A]>>(
        &mut self,
        pose: &Pose<A>,
        targets: &[Target],
        dt: f32,
        settings: &Settings,
    ) -> Outcome {
        self.call(pose, &Call { targets: targets.into(), dt: Some(dt), settings })
    }

    pub fn snap<A: AsRef<[Affine3A]>>(&mut self, pose: &Pose<A>, target: Vec3) -> Outcome {
        self.snap_with(pose, target, &Settings::default())
    }

    pub fn snap_with<A: AsRef<[Affine3A]>>(&mut self, pose: &Pose<A>, target: Vec3, settings: &Settings) -> Outcome {
        self.call(pose, &Call { targets: target.into(), dt: None, settings })
    }

    pub fn snap_at<A: AsRef<[Affine3A]>>(
        &mut self,
        pose: &Pose<A>,
        targets: &[Target],
        settings: &Settings,
    ) -> Outcome {
        self.call(pose, &Call { targets: targets.into(), dt: None, settings })
    }

    pub fn reset(&mut self) {
        *self = Self { effector: self.effector, budgets: self.budgets, ..Self::new(core::mem::take(&mut self.infos)) };
    }

    /// Returns the corrections of the last call.
    pub fn corrections(&self) -> impl ExactSizeIterator<Item = (usize, Quat)> + '_ {
        self.corrections.iter().copied().enumerate()
    }

    /// Returns the other eye's correction of the last call.
    pub fn other_eye_correction(&self) -> Option<Quat> {
        self.other_eye_correction
    }

    /// Returns a rig of eye, neck and spine.
    pub fn thug() -> Self {
        Self::thug_with(THUG)
    }

    pub fn thug_with(axes: Axes) -> Self {
        Self::new(vec![
            JointInfo::new(axes, 450.0 * DEG)
                .with_heading(-35.0 * DEG, 35.0 * DEG)
                .with_pitch(-25.0 * DEG, 20.0 * DEG)
                .with_stiffness(0.5),
            JointInfo::new(axes, 170.0 * DEG).with_heading(-60.0 * DEG, 60.0 * DEG).with_pitch(-40.0 * DEG, 35.0 * DEG),
            JointInfo::new(axes, 70.0 * DEG)
                .with_heading(-20.0 * DEG, 20.0 * DEG)
                .with_pitch(-10.0 * DEG, 10.0 * DEG)
                .with_stiffness(4.0),
        ])
    }

    /// Returns a rig of one joint that reaches nearly everything.
    pub fn ball(axes: Axes) -> Self {
        Self::new(vec![
            JointInfo::new(axes, 900.0 * DEG)
                .with_heading(-180.0 * DEG, 180.0 * DEG)
                .with_pitch(-89.0 * DEG, 89.0 * DEG),
        ])
    }

    /// Returns a turret: a free yaw with an elevating barrel on it.
    pub fn turret() -> Self {
        Self::new(vec![
            JointInfo::new(THUG, 60.0 * DEG).with_pitch(-10.0 * DEG, 80.0 * DEG),
            JointInfo::new(THUG, 90.0 * DEG).with_heading(f32::NEG_INFINITY, f32::INFINITY),
        ])
    }
}

impl Rig for NumericRig {
    fn description(&self) -> Description<'_> {
        Description::new(&self.infos).with_effector(self.effector).with_budgets(self.budgets)
    }

    fn joint_name(&self, _: usize) -> Option<&str> {
        None
    }

    fn bone_name(&self, _: usize, _: usize) -> Option<&str> {
        None
    }

    fn residual_jacobian(&self, links: &[[f32; 12]], target: &[f32; 3], sin_cos: &[[f32; 4]], out: &mut [f32]) {
        if let Some(kernel_targets) = &self.kernel_targets {
            kernel_targets.borrow_mut().push(*target);
        }
        out.copy_from_slice(&self.chain_residual(links, target, sin_cos));
    }

    fn aim_gradient(
        &self,
        joint: usize,
        effector_to_joint: &[f32; 12],
        target: &[f32; 3],
        sin_cos: &[f32; 4],
    ) -> [f32; 3] {
        self.joint_gradient(joint, effector_to_joint, target, sin_cos)
    }
}

/// Kernels, generic over the precision.
impl NumericRig {
    pub fn joint_gradient<S: Scalar>(
        &self,
        joint: usize,
        effector_to_joint: &[S; 12],
        target: &[S; 3],
        sin_cos: &[S; 4],
    ) -> [S; 3] {
        let Some(info) = self.infos.get(joint) else {
            return [S::ZERO; 3];
        };
        let mut state = EffectorState::effector(self.infos[0].axes(), &self.effector);
        state.through(effector_to_joint);
        state.turn(info, sin_cos);
        let [aim, rest @ ..] = &state.aim(target)[..] else { unreachable!() };
        let mut out = [*aim, S::ZERO, S::ZERO];
        let mut rest = rest.iter();
        if info.pitch.is_some() {
            out[1] = *rest.next().unwrap();
        }
        if info.heading.is_some() {
            out[2] = *rest.next().unwrap();
        }
        out
    }

    pub fn chain_gradient<S: Scalar>(&self, links: &[[S; 12]], target: &[S; 3], sin_cos: &[[S; 4]]) -> Vec<S> {
        self.chain(links, sin_cos).aim(target)
    }

    pub fn chain_residual<S: Scalar>(&self, links: &[[S; 12]], target: &[S; 3], sin_cos: &[[S; 4]]) -> Vec<S> {
        self.chain(links, sin_cos).residual(target)
    }

    fn chain<S: Scalar>(&self, links: &[[S; 12]], sin_cos: &[[S; 4]]) -> EffectorState<S> {
        let mut state = EffectorState::effector(self.infos[0].axes(), &self.effector);
        for ((info, link), sin_cos) in self.infos.iter().zip(links).zip(sin_cos) {
            state.through(link);
            state.turn(info, sin_cos);
        }
        state
    }
}

type V<S> = [S; 3];

/// Largest number of joints in these tests.
const MOST_JOINTS: usize = 8;

/// Effector's origin, forward, left and up, with their derivatives by the angles of all joints passed so far.
struct EffectorState<S> {
    value: [V<S>; 4],
    derivatives: [[V<S>; 4]; 2 * MOST_JOINTS],
    passed: usize,
}

impl<S: Scalar> EffectorState<S> {
    fn effector(axes: &Axes, effector: &Effector) -> Self {
        let forward = Vec3::from(effector.forward);
        let [up, ahead, left] = [axes.up, axes.forward, axes.left].map(Vec3::from);
        let handedness = up.cross(ahead).dot(left).signum();
        // If forward is along the bone's up, the back of the head becomes up.
        let up = if up.cross(forward).length() > 0.0087 { up } else { ahead * -up.dot(forward).signum() };
        let up = (up - forward * up.dot(forward)).normalize();
        let left = up.cross(forward) * handedness;
        let v = |v: Vec3| [S::constant(v.x.into()), S::constant(v.y.into()), S::constant(v.z.into())];
        let nothing = [[S::ZERO; 3]; 4];
        let value = [[S::ZERO; 3], v(forward), v(left), v(up)];
        Self { value, derivatives: [nothing; 2 * MOST_JOINTS], passed: 0 }
    }

    fn through(&mut self, link: &[S; 12]) {
        let rotate =
            |v: V<S>| -> V<S> { core::array::from_fn(|k| v[0] * link[k] + v[1] * link[3 + k] + v[2] * link[6 + k]) };
        for derivative in &mut self.derivatives[..self.passed] {
            *derivative = derivative.map(rotate);
        }
        self.value = self.value.map(rotate);
        self.value[0] = add(self.value[0], [link[9], link[10], link[11]]);
    }

    fn turn(&mut self, info: &JointInfo, &[sin_p, cos_p, sin_h, cos_h]: &[S; 4]) {
        let forward = Vec3::from(info.axes().forward);
        for (declared, to, sin, cos) in
            [(info.pitch, info.axes().up, sin_p, cos_p), (info.heading, info.axes().left, sin_h, cos_h)]
        {
            if declared.is_none() {
                continue;
            }
            let axis = forward.cross(to.into()).to_array().map(|x| S::constant(x.into()));
            let one = S::constant(1.0);
            let rotate = |v: V<S>| {
                let along = scale(axis, dot(axis, v) * (one - cos));
                add(add(scale(v, cos), scale(cross(axis, v), sin)), along)
            };
            for derivative in &mut self.derivatives[..self.passed] {
                *derivative = derivative.map(rotate);
            }
            self.value = self.value.map(rotate);
            self.derivatives[self.passed] = self.value.map(|v| cross(axis, v));
            self.passed += 1;
        }
    }

    fn aim(&self, target: &V<S>) -> Vec<S> {
        let one = S::constant(1.0);
        let [origin, forward, ..] = self.value;
        let v = sub(*target, origin);
        let length = dot(v, v).sqrt();
        let valid = S::select_less(S::TINY, length, one, S::ZERO);
        let inverse = valid / S::select_less(S::TINY, length, length, one);
        let unit = scale(v, inverse);
        let aim = dot(unit, forward);
        let mut out = vec![aim];
        for [d_origin, d_forward, ..] in &self.derivatives[..self.passed] {
            let radial = dot(unit, *d_origin) * aim - dot(forward, *d_origin);
            out.push(radial * inverse + dot(unit, *d_forward));
        }
        out
    }

    fn residual(&self, target: &V<S>) -> Vec<S> {
        let (one, two) = (S::constant(1.0), S::constant(2.0));
        let [origin, forward, left, up] = self.value;
        let v = sub(*target, origin);
        let length = dot(v, v).sqrt();
        let sum = length + dot(v, forward);
        let least = S::constant(1e-6) * length + S::TINY;
        let inverse = S::select_less(least, sum, one, S::ZERO) / S::select_less(least, sum, sum, one);
        let lateral = [dot(v, left), dot(v, up)];
        let mut out: Vec<S> = lateral.iter().map(|&l| two * l * inverse).collect();
        for (which, axis) in [left, up].into_iter().enumerate() {
            for derivative in &self.derivatives[..self.passed] {
                let dv = scale(derivative[0], -one);
                let d_axis = derivative[2 + which];
                let d_lateral = dot(dv, axis) + dot(v, d_axis);
                let d_length = dot(v, dv) / S::select_less(S::TINY, length, length, one);
                let d_sum = d_length + dot(dv, forward) + dot(v, derivative[1]);
                out.push(two * inverse * (d_lateral - lateral[which] * inverse * d_sum));
            }
        }
        out
    }
}

fn dot<S: Scalar>(a: V<S>, b: V<S>) -> S {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
fn cross<S: Scalar>(a: V<S>, b: V<S>) -> V<S> {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
fn scale<S: Scalar>(a: V<S>, k: S) -> V<S> {
    a.map(|x| x * k)
}
fn add<S: Scalar>(a: V<S>, b: V<S>) -> V<S> {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}
fn sub<S: Scalar>(a: V<S>, b: V<S>) -> V<S> {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// Affine transform in f64: columns and translation.
#[derive(Clone, Copy)]
struct Transform64 {
    columns: [V<f64>; 3],
    translation: V<f64>,
}

impl Transform64 {
    fn of(a: &Affine3A) -> Self {
        let [x, y, z, translation] =
            [a.matrix3.x_axis, a.matrix3.y_axis, a.matrix3.z_axis, a.translation].map(|v| v.to_array().map(f64::from));
        Self { columns: [x, y, z], translation }
    }
    fn vector(&self, v: V<f64>) -> V<f64> {
        add(add(scale(self.columns[0], v[0]), scale(self.columns[1], v[1])), scale(self.columns[2], v[2]))
    }
    fn point(&self, v: V<f64>) -> V<f64> {
        add(self.vector(v), self.translation)
    }
    /// Solves by Cramer's rule.
    fn inverse_vector(&self, v: V<f64>) -> V<f64> {
        let [a, b, c] = self.columns;
        let determinant = dot(a, cross(b, c));
        [dot(v, cross(b, c)), dot(v, cross(c, a)), dot(v, cross(a, b))].map(|x| x / determinant)
    }
    fn inverse_point(&self, v: V<f64>) -> V<f64> {
        self.inverse_vector(sub(v, self.translation))
    }
}

/// Independent forward kinematics in f64: returns effector `k`'s origin and unit direction in the pose's space. Each
/// joint rotates its vectors plane by plane, without matrices or quaternions.
pub fn gaze64(rig: &NumericRig, pose: &[Affine3A], k: usize) -> ([f64; 3], [f64; 3]) {
    let (origin, forward) =
        if k == 0 { (rig.effector.origin, rig.effector.forward) } else { ([0.0; 3], rig.infos[k].axes().forward) };
    to_pose64(rig, pose, k, origin.map(f64::from), forward.map(f64::from))
}

/// Transforms a point and a direction from joint `k`'s bone space to the pose's space; normalises the direction.
fn to_pose64(
    rig: &NumericRig,
    pose: &[Affine3A],
    k: usize,
    origin: [f64; 3],
    forward: [f64; 3],
) -> ([f64; 3], [f64; 3]) {
    to_pose_with(pose, k, origin, forward, |i, v| {
        let axes = rig.infos[i].axes();
        let [f, u, l] = [axes.forward, axes.up, axes.left].map(|v| v.map(f64::from));
        let pitched = plane_turn(v, f, u, rig.joints[i].pitch().into());
        plane_turn(pitched, f, l, rig.joints[i].heading().into())
    })
}

/// Like [`to_pose64`], with `turn` rotating a vector by a joint's correction.
fn to_pose_with(
    pose: &[Affine3A],
    k: usize,
    mut origin: [f64; 3],
    mut forward: [f64; 3],
    turn: impl Fn(usize, V<f64>) -> V<f64>,
) -> ([f64; 3], [f64; 3]) {
    for i in k..pose.len() {
        let joint = Transform64::of(&pose[i]);
        origin = joint.point(turn(i, origin));
        forward = joint.vector(turn(i, forward));
        if let Some(next) = pose.get(i + 1) {
            let next = Transform64::of(next);
            origin = next.inverse_point(origin);
            forward = next.inverse_vector(forward);
        }
    }
    (origin, scale(forward, 1.0 / dot(forward, forward).sqrt()))
}

/// Returns the other eye's origin and unit direction in the pose's space. Its bone is rotated by its correction; its
/// forward is parallel to joint 0's in the animation.
pub fn pair_gaze64(rig: &NumericRig, pose: &[Affine3A], pair: &Affine3A) -> ([f64; 3], [f64; 3]) {
    let bone = Transform64::of(pair);
    let forward = Transform64::of(&pose[0]).vector(rig.infos[0].axes().forward.map(f64::from));
    let [x, y, z, w] = rig.other_eye_correction().expect("the last pose had a pair").to_array().map(f64::from);
    let (axis, v) = ([x, y, z], bone.inverse_vector(forward));
    let across = cross(axis, v);
    let turned = add(v, scale(add(scale(across, w), cross(axis, across)), 2.0));
    let (origin, direction) = (bone.point([0.0; 3]), bone.vector(turned));
    match pose.get(1) {
        Some(next) => {
            let next = Transform64::of(next);
            to_pose64(rig, pose, 1, next.inverse_point(origin), next.inverse_vector(direction))
        }
        None => (origin, scale(direction, 1.0 / dot(direction, direction).sqrt())),
    }
}

/// Returns the angle between a gaze and the direction to `target`, radians.
pub fn angle_to64((origin, direction): ([f64; 3], [f64; 3]), target: Vec3) -> f64 {
    let v = sub(target.to_array().map(f64::from), origin);
    let off = cross(direction, v);
    dot(off, off).sqrt().atan2(dot(direction, v))
}

/// Returns `v` rotated in the plane of the orthonormal vectors `a` and `b`, from `a` towards `b`, by an angle in
/// radians.
fn plane_turn(v: V<f64>, a: V<f64>, b: V<f64>, angle: f64) -> V<f64> {
    let (sin, cos) = angle.sin_cos();
    let (x, y) = (dot(v, a), dot(v, b));
    add(v, add(scale(a, x * (cos - 1.0) - y * sin), scale(b, x * sin + y * (cos - 1.0))))
}

/// Returns the remaining angle between effector `k` and `target`, radians, by the independent forward kinematics.
pub fn remaining64(rig: &NumericRig, pose: &[Affine3A], k: usize, target: Vec3) -> f64 {
    angle_to64(gaze64(rig, pose, k), target)
}

/// Returns the point at `distance` along effector `k`'s direction.
pub fn ahead(rig: &NumericRig, pose: &[Affine3A], k: usize, distance: f32) -> Vec3 {
    let (origin, direction) = gaze64(rig, pose, k);
    Vec3::from(add(origin, scale(direction, distance.into())).map(|x| x as f32))
}

/// Returns all triples of signed axes, each with `true` if it is right-handed (up × forward = left).
pub fn triples() -> Vec<(Axes, bool)> {
    let signed = [Vec3::X, Vec3::NEG_X, Vec3::Y, Vec3::NEG_Y, Vec3::Z, Vec3::NEG_Z];
    let mut triples = Vec::new();
    for up in signed {
        for forward in signed {
            for left in signed {
                let handedness = up.cross(forward).dot(left);
                if handedness != 0.0 {
                    let axes = Axes { up: up.into(), forward: forward.into(), left: left.into() };
                    triples.push((axes, handedness > 0.0));
                }
            }
        }
    }
    triples
}

/// World forward (−Z), up (+Y) and left (−X), as in XNA.
pub const WORLD: [Vec3; 3] = [Vec3::NEG_Z, Vec3::Y, Vec3::NEG_X];

/// Returns the transform of a bone with these axes at `at`, facing the character's front, then rotated by `turn` in
/// world space.
pub fn bone(axes: &Axes, turn: Quat, at: Vec3) -> Affine3A {
    let world = Mat3A::from_cols(WORLD[0].into(), WORLD[1].into(), WORLD[2].into());
    let own = Mat3A::from_cols(axes.forward.into(), axes.up.into(), axes.left.into());
    Affine3A { matrix3: Mat3A::from_quat(turn) * world * own.transpose(), translation: at.into() }
}

/// Returns the pose of the thug's eye, neck and spine standing upright, metres.
pub fn upright(rig: &NumericRig) -> Vec<Affine3A> {
    let places = [Vec3::new(-0.03, 1.68, -0.10), Vec3::new(0.0, 1.55, 0.02), Vec3::new(0.0, 1.30, 0.03)];
    rig.infos.iter().zip(places).map(|(info, at)| bone(info.axes(), Quat::IDENTITY, at)).collect()
}

/// Returns the upright pose with every joint randomly rotated, as in an animation.
pub fn animated(rig: &NumericRig, rng: &mut Rng, amount: f32) -> Vec<Affine3A> {
    let mut pose = upright(rig);
    for joint in &mut pose {
        let axis = rng.direction();
        let turn = Quat::from_axis_angle(axis, amount * rng.between(-1.0, 1.0));
        joint.matrix3 = Mat3A::from_quat(turn) * joint.matrix3;
    }
    pose
}

/// Returns the parents that tests run under: name, transform, and `true` if it is a similarity.
pub fn parents() -> Vec<(&'static str, Affine3A, bool)> {
    let scaled = |scale| Affine3A::from_scale(scale);
    vec![
        ("identity", Affine3A::IDENTITY, true),
        ("translated", Affine3A::from_translation(Vec3::new(3.0, 40.0, -7.0)), true),
        ("rotated", Affine3A::from_rotation_x(60.0 * DEG), true),
        ("uniformly scaled", scaled(Vec3::splat(2.0)), true),
        ("non-uniformly scaled", scaled(Vec3::new(1.0, 2.0, 1.0)), false),
        ("mirrored", scaled(Vec3::splat(-3.0)), true),
        ("mirrored in one plane", scaled(Vec3::new(-1.0, 1.0, 1.0)), true),
    ]
}

/// Returns `true` if random tests run all their cases. Plain `cargo test` runs a tenth.
pub fn in_full() -> bool {
    std::env::var_os("AIM_TEST_SCALE").is_some_and(|scale| scale == "full")
}

/// Small deterministic random number generator (splitmix64).
pub struct Rng(pub u64);

impl Rng {
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ z >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ z >> 31
    }
    pub fn between(&mut self, lo: f32, hi: f32) -> f32 {
        lo + (hi - lo) * ((self.bits() >> 40) as f32 / (1u64 << 24) as f32)
    }
    pub fn below(&mut self, n: usize) -> usize {
        usize::try_from(self.bits() >> 33).unwrap() % n
    }
    pub fn direction(&mut self) -> Vec3 {
        loop {
            let v = Vec3::new(self.between(-1.0, 1.0), self.between(-1.0, 1.0), self.between(-1.0, 1.0));
            if v.length() > 0.1 && v.length() < 1.0 {
                return v.normalize();
            }
        }
    }
    /// Returns any `f32`, often a special value.
    pub fn any(&mut self) -> f32 {
        const AWKWARD: [f32; 14] = [
            0.0,
            -0.0,
            1.0,
            -1.0,
            f32::NAN,
            f32::INFINITY,
            f32::NEG_INFINITY,
            1e20,
            -1e20,
            1e-20,
            1e-42,
            f32::MAX,
            f32::MIN_POSITIVE,
            1e-38,
        ];
        match self.below(3) {
            0 => AWKWARD[self.below(AWKWARD.len())],
            1 => f32::from_bits((self.bits() >> 32) as u32),
            _ => self.between(-2.0, 2.0),
        }
    }
}

/// Returns `true` if every correction is finite and unit to 1e-6.
pub fn sound(rig: &NumericRig) -> bool {
    rig.corrections().all(|(_, q)| {
        let [x, y, z, w] = q.to_array().map(f64::from);
        ((x * x + y * y + z * z + w * w).sqrt() - 1.0).abs() <= 1e-6
    })
}
