//! Compares kernels in lanes with the same kernels in scalars, bit for bit, with poses of every kind side by side.

use aim::{Scalar, wide};
use aim_codegen::RigSpec;

use aim_tests::kinematics::{Case, Link};
use aim_tests::oracle;
use aim_tests::random::Random;
use aim_tests::requested::RequestedKernels;

/// A scalar type, with the conversions that the tests need.
pub(crate) trait Lane: Scalar + Into<f64> + std::fmt::Debug {
    /// Rounds `value` to this type.
    fn rounded(value: f64) -> Self;
    /// Creates a number from the lowest bits of `bits`.
    fn from_bits(bits: u64) -> Self;
    /// Returns the bits; one pattern for every NaN, since the bits of a NaN are unspecified.
    fn bits(self) -> u64;
}

macro_rules! lane {
    ($float:ident of $bits:ident) => {
        impl Lane for $float {
            #[allow(clippy::cast_possible_truncation, trivial_numeric_casts, reason = "rounding is the purpose")]
            fn rounded(value: f64) -> Self {
                value as Self
            }
            #[allow(clippy::cast_possible_truncation, trivial_numeric_casts, reason = "the lowest bits are meant")]
            fn from_bits(bits: u64) -> Self {
                Self::from_bits(bits as $bits)
            }
            fn bits(self) -> u64 {
                if self.is_nan() { u64::MAX } else { self.to_bits().into() }
            }
        }
    };
}

lane!(f32 of u32);
lane!(f64 of u64);

/// A SIMD vector of scalars.
pub(crate) trait Lanes: Scalar {
    /// The scalar type of a lane.
    type Lane: Lane;
    /// Number of lanes.
    const COUNT: usize;
    /// Creates a vector whose lane i is `lane(i)`.
    fn gather(lane: impl FnMut(usize) -> Self::Lane) -> Self;
    /// Returns lane `i`.
    fn lane(self, i: usize) -> Self::Lane;
}

macro_rules! lanes {
    ($($vector:ident: $float:ident * $count:literal),* $(,)?) => {$(
        impl Lanes for wide::$vector {
            type Lane = $float;
            const COUNT: usize = $count;
            fn gather(lane: impl FnMut(usize) -> $float) -> Self {
                Self::new(core::array::from_fn(lane))
            }
            fn lane(self, i: usize) -> $float {
                self.to_array()[i]
            }
        }
    )*};
}

lanes!(f32x4: f32 * 4, f32x8: f32 * 8, f32x16: f32 * 16, f64x2: f64 * 2, f64x4: f64 * 4, f64x8: f64 * 8);

/// Returns random poses of `spec`; about half of them divide by zero, overflow or contain NaN.
pub(crate) fn cases(spec: &RigSpec, seed: u64, count: usize) -> Vec<Case> {
    let mut random = Random::new(seed);
    let mut cases = oracle::cases(spec, seed, count);
    for case in &mut cases {
        match random.below(14) {
            // Targets on the effector, and on a line with it.
            0 => still(case, [0.0; 3]),
            1 => still(case, spec.effector.frame.forward.map(|c| 2.0 * c)),
            2 => still(case, spec.effector.frame.forward.map(|c| -2.0 * c)),
            // Targets so near or so far that their squares underflow or overflow.
            3 => still(case, [1e-42, -1e-40, 1e-41]),
            4 => case.target = case.target.map(|c| 1e30 * c),
            // Invalid numbers.
            5 => case.target[random.below(3)] = f64::NAN,
            6 => case.links[0].rows[random.below(3)][random.below(3)] = f64::INFINITY,
            _ => {}
        }
    }
    cases
}

/// Puts all joints in one place and at rest, so that `target` is not changed by rounding.
fn still(case: &mut Case, target: [f64; 3]) {
    for link in &mut case.links {
        *link = Link { rows: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], translation: [0.0; 3] };
    }
    case.angles.fill([0.0; 2]);
    case.target = target;
}

/// Inputs of the kernels.
struct Inputs<S> {
    links: Vec<[S; 12]>,
    target: [S; 3],
    sin_cos: Vec<[S; 4]>,
}

impl<S: Lane> Inputs<S> {
    fn of(case: &Case) -> Self {
        Self {
            links: case.links.iter().map(|link| link.numbers().map(S::rounded)).collect(),
            target: case.target.map(S::rounded),
            sin_cos: case.sin_cos().into_iter().map(|numbers| numbers.map(S::rounded)).collect(),
        }
    }

    /// Gathers the inputs of several cases into lanes.
    fn gather<V: Lanes<Lane = S>>(lanes: &[Self]) -> Inputs<V> {
        let all = |of: &dyn Fn(&Self) -> S| V::gather(|lane| of(&lanes[lane]));
        let joints = 0..lanes[0].links.len();
        Inputs {
            links: joints.clone().map(|i| core::array::from_fn(|k| all(&|lane| lane.links[i][k]))).collect(),
            target: core::array::from_fn(|k| all(&|lane| lane.target[k])),
            sin_cos: joints.map(|i| core::array::from_fn(|k| all(&|lane| lane.sin_cos[i][k]))).collect(),
        }
    }
}

/// Returns every output of every kernel of `rig`, one after another.
fn outputs<R: RequestedKernels, S: Scalar>(rig: &R, inputs: &Inputs<S>) -> Vec<S> {
    let Inputs { links, target, sin_cos } = inputs;
    let description = rig.description();
    let infos = description.joints();
    let angles: usize = infos.iter().map(|i| usize::from(i.pitch.is_some()) + usize::from(i.heading.is_some())).sum();
    let mut gradient = vec![S::constant(7.0); 1 + angles];
    let mut jacobian = vec![S::constant(7.0); 2 + 2 * angles];
    R::value_gradient(links, target, sin_cos, &mut gradient);
    R::residual_with_jacobian(links, target, sin_cos, &mut jacobian);
    gradient.extend(jacobian);
    for (i, (link, sin_cos)) in links.iter().zip(sin_cos).enumerate() {
        gradient.extend(R::joint_gradient(i, link, target, sin_cos));
    }
    gradient
}

/// Numbers of compared lanes by kind.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Seen {
    /// Lanes in which a guard made everything zero.
    pub(crate) zero: usize,
    /// Lanes with NaN or infinity.
    pub(crate) wild: usize,
    /// All others.
    pub(crate) tame: usize,
    /// Vectors that held lanes of more than one kind.
    pub(crate) mixed: usize,
}

impl std::ops::AddAssign for Seen {
    fn add_assign(&mut self, other: Self) {
        self.zero += other.zero;
        self.wild += other.wild;
        self.tame += other.tame;
        self.mixed += other.mixed;
    }
}

/// Compares every lane of the outputs of `in_lanes` for `cases` with the outputs of `in_scalars` for that case alone.
///
/// # Panics
/// Panics if they differ.
pub(crate) fn compare<V: Lanes>(
    name: &str,
    in_lanes: &impl RequestedKernels,
    in_scalars: &impl RequestedKernels,
    cases: &[Case],
) -> Seen {
    let inputs: Vec<Inputs<V::Lane>> = cases.iter().map(Inputs::of).collect();
    let mut seen = Seen::default();
    for batch in inputs.chunks_exact(V::COUNT) {
        let found = outputs(in_lanes, &Inputs::gather::<V>(batch));
        let mut kinds = [0; 3];
        for (lane, inputs) in batch.iter().enumerate() {
            let expected = outputs(in_scalars, inputs);
            let found: Vec<V::Lane> = found.iter().map(|v| v.lane(lane)).collect();
            let same = found.iter().map(|s| s.bits()).eq(expected.iter().map(|s| s.bits()));
            let vector = std::any::type_name::<V>();
            assert!(same, "{name}, lane {lane} of {vector}: {found:?} instead of {expected:?}");
            let values: Vec<f64> = expected.iter().map(|&s| s.into()).collect();
            let kind = if values.iter().all(|&value| value == 0.0) {
                0
            } else if values.iter().any(|value| !value.is_finite()) {
                1
            } else {
                2
            };
            kinds[kind] += 1;
        }
        seen += Seen {
            zero: kinds[0],
            wild: kinds[1],
            tame: kinds[2],
            mixed: usize::from(kinds.iter().filter(|&&count| count > 0).count() > 1),
        };
    }
    seen
}
