//! The references derived by hand: their counts match their documentation, their derivatives are right, and derived
//! programs are no larger.

use aim_codegen::objective::{AIM_GRADIENT, CHAIN_RESIDUAL_JACOBIAN, CHAIN_VALUE_GRADIENT, FirstLink, Objective};
use aim_codegen::{Frame, JointSpec, RigSpec};
use aim_symbolic::Number;
use aim_tests::by_hand::counted::{Counted, count};
use aim_tests::by_hand::general_forward::Direction;
use aim_tests::by_hand::general_frames::Joint;
use aim_tests::by_hand::{
    arap, chain, distance, general_forward, general_frames, one_joint, residual, roll, two_targets,
};
use aim_tests::kinematics::{self, Case, Link, V, add, central_difference, correct, dot, norm, scale, sub};
use aim_tests::oracle::{assert_close, cases, expected_chain};
use aim_tests::random::Random;
use aim_tests::rigs::{bare_joint, general_frame};
use aim_tests::scale::part_of;

/// The thug's axes: up = +X, forward = +Y, left = +Z.
const THUG: Frame = Frame { up: [1.0, 0.0, 0.0], forward: [0.0, 1.0, 0.0], left: [0.0, 0.0, 1.0] };

/// Returns a chain of joints with these frames; the effector has joint 0's.
fn rig(frames: &[Frame]) -> RigSpec {
    let joints: Vec<JointSpec> = (0..).zip(frames).map(|(i, &frame)| bare_joint(i, frame, true, true)).collect();
    let frame = joints[0].frame;
    RigSpec {
        name: "Rig".into(),
        joints,
        effector: aim_codegen::EffectorSpec { frame, origin: [0.0; 3] },
        natural: None,
        region: None,
        kernels: Vec::new(),
    }
}

/// The inputs of a chain of `N` joints in a number type.
struct Inputs<T, const N: usize> {
    links: [[T; 12]; N],
    target: [T; 3],
    sin_cos: [[T; 4]; N],
}

impl<T: Number, const N: usize> Inputs<T, N> {
    fn of(case: &Case) -> Self {
        let sin_cos = case.sin_cos();
        Self {
            links: core::array::from_fn(|i| case.links[i].numbers().map(T::constant)),
            target: case.target.map(T::constant),
            sin_cos: core::array::from_fn(|i| sin_cos[i].map(T::constant)),
        }
    }
}

/// Returns inputs for counting operations; the numbers do not matter.
fn counted<const N: usize>() -> Inputs<Counted, N> {
    let case = cases(&rig(&[THUG; N]), 7, 1).remove(0);
    Inputs::of(&case)
}

fn flat<const N: usize>(value: f64, gradient: [[f64; 2]; N]) -> Vec<f64> {
    [value].into_iter().chain(gradient.into_iter().flatten()).collect()
}

/// Flattens a result in the order of the derived programs: the residual, its left derivatives, its up derivatives.
fn flat_jacobian<const N: usize>((s, jacobian): ([f64; 2], [[[f64; 2]; 2]; N])) -> Vec<f64> {
    let row = |row: usize| jacobian.into_iter().flatten().map(move |column| column[row]);
    s.into_iter().chain(row(0)).chain(row(1)).collect()
}

#[test]
fn one_joint_counts() {
    let Inputs { links: [link], target, sin_cos: [angles] } = counted::<1>();
    let spec = rig(&[THUG]);
    let statement = AIM_GRADIENT.statement(&spec, &[0], FirstLink::Given);
    let derived = |output: usize| statement.program_of(output).count().total();

    let aim = count(|| one_joint::aim(&link, target, angles)).total();
    let by_pitch = count(|| one_joint::by_pitch(&link, target, angles)).total();
    let by_heading = count(|| one_joint::by_heading(&link, target, angles)).total();
    let all = count(|| one_joint::aim_gradient(&link, target, angles));
    assert_eq!((aim, by_pitch, by_heading, all.total()), (27, 37, 42, 46));
    assert_eq!((all.sqrt, all.div, all.select), (1, 1, 2));

    assert!(derived(0) <= aim);
    assert!(derived(1) <= by_pitch);
    assert!(derived(2) <= by_heading);
    assert!(statement.program().count().total() <= all.total());
}

#[test]
fn one_joint_derivatives() {
    let spec = rig(&[THUG]);
    for case in cases(&spec, 1, part_of(3000)) {
        let Inputs { links: [link], target, sin_cos: [angles] } = Inputs::<f64, 1>::of(&case);
        let (expected, _) = expected_chain(&spec, &case);
        let apart = [
            one_joint::aim(&link, target, angles),
            one_joint::by_pitch(&link, target, angles),
            one_joint::by_heading(&link, target, angles),
        ];
        assert_close(&apart, &expected, 1e-11, "outputs one by one");
        assert_close(&one_joint::aim_gradient(&link, target, angles), &expected, 1e-11, "all outputs");
    }
}

/// Returns the number of operations derived for one of the chain's objectives.
fn derived_total(objective: &'static Objective, spec: &RigSpec) -> usize {
    objective.kernels(spec, FirstLink::Given)[0].program.count().total()
}

/// Asserts that the derived count exceeds the reference by at most 1/`part` of it.
fn assert_close_above(derived: usize, reference: usize, part: usize, what: &str) {
    assert!(part * derived <= (part + 1) * reference, "{what}: derived {derived}, by hand {reference}");
}

fn chain_of<const N: usize>() {
    let spec = rig(&[THUG; N]);
    let inputs = counted::<N>();
    let by_hand = count(|| chain::aim_gradient(&inputs.links, inputs.target, &inputs.sin_cos));
    assert_eq!(by_hand.total(), if N == 1 { 46 } else { 63 * N - 16 }, "{N} joints: {by_hand}");
    assert_eq!((by_hand.sqrt, by_hand.div), (1, 1));

    let by_hand_residual = count(|| residual::residual_jacobian(&inputs.links, inputs.target, &inputs.sin_cos));
    let total = if N == 1 { 82 } else { 96 * N - 16 };
    assert_eq!(by_hand_residual.total(), total, "{N} joints: {by_hand_residual}");
    assert_eq!((by_hand_residual.sqrt, by_hand_residual.div), (1, 2));

    assert!(derived_total(&CHAIN_VALUE_GRADIENT, &spec) <= by_hand.total(), "{N} joints");
    // The cheaper form for a single joint is not derived.
    if N > 1 {
        assert_close_above(derived_total(&CHAIN_RESIDUAL_JACOBIAN, &spec), total, 20, &format!("{N} joints"));
    }

    for case in cases(&spec, N as u64, part_of(1000)) {
        let Inputs { links, target, sin_cos } = Inputs::<f64, N>::of(&case);
        let (expected, expected_jacobian) = expected_chain(&spec, &case);
        let (aim, gradient) = chain::aim_gradient(&links, target, &sin_cos);
        assert_close(&flat(aim, gradient), &expected, 1e-10, &format!("aim of {N} joints"));
        let found = flat_jacobian(residual::residual_jacobian(&links, target, &sin_cos));
        assert_close(&found, &expected_jacobian, 1e-9, &format!("residual of {N} joints"));
    }
}

#[test]
fn chains_and_residuals() {
    chain_of::<1>();
    chain_of::<2>();
    chain_of::<3>();
    chain_of::<4>();
    chain_of::<7>();
}

fn general_frames_of<const N: usize>(random: &mut Random) {
    let (mut aims, mut all) = (0, 0);
    for seed in 0..part_of(150) as u64 {
        let frames: [Frame; N] = core::array::from_fn(|_| general_frame(random));
        let spec = rig(&frames);
        let joints = frames.each_ref().map(Joint::new);
        let forward = Direction::new(frames[0].forward);
        for case in cases(&spec, seed, 10) {
            let Inputs { links, target, sin_cos } = Inputs::<f64, N>::of(&case);
            let (expected, _) = expected_chain(&spec, &case);
            let (aim, gradient) = general_frames::aim_gradient(&joints, &forward, &links, target, &sin_cos);
            assert_close(&flat(aim, gradient), &expected, 1e-10, &format!("aim of {N} joints in general frames"));
            if N == 1 {
                let aim = general_frames::aim(&joints[0], &forward, &links[0], target, sin_cos[0]);
                assert_close(&[aim], &expected[..1], 1e-12, "aim alone");
            }
        }
        let Inputs { links, target, sin_cos } = counted::<N>();
        aims = count(|| general_frames::aim(&joints[0], &forward, &links[0], target, sin_cos[0])).total();
        all = count(|| general_frames::aim_gradient(&joints, &forward, &links, target, &sin_cos)).total();
    }
    assert_eq!(aims, 69);
    assert_eq!(all, if N == 1 { 99 } else { 113 * N - 13 }, "{N} joints");
    let spec = rig(&core::array::from_fn::<_, N, _>(|_| general_frame(random)));
    let derived = derived_total(&CHAIN_VALUE_GRADIENT, &spec);
    assert!(derived <= all, "{N} joints: derived {derived}, by hand {all}");
}

#[test]
fn general_frames() {
    let random = &mut Random::new(5);
    general_frames_of::<1>(random);
    general_frames_of::<2>(random);
    general_frames_of::<3>(random);
    general_frames_of::<4>(random);
}

fn general_forward_of<const N: usize>(random: &mut Random) {
    for seed in 0..part_of(150) as u64 {
        let mut spec = rig(&[THUG; N]);
        spec.effector.frame = general_frame(random);
        let forward = Direction::new(spec.effector.frame.forward);
        for case in cases(&spec, seed, 10) {
            let Inputs { links, target, sin_cos } = Inputs::<f64, N>::of(&case);
            let (expected, _) = expected_chain(&spec, &case);
            let (aim, gradient) = general_forward::aim_gradient(&forward, &links, target, &sin_cos);
            assert_close(&flat(aim, gradient), &expected, 1e-10, &format!("aim of {N} joints with a general effector"));
            if N == 1 {
                let aim = general_forward::aim(&forward, &links[0], target, sin_cos[0]);
                assert_close(&[aim], &expected[..1], 1e-12, "aim alone");
            }
        }
    }
    let forward = Direction::new(general_frame(random).forward);
    let Inputs { links, target, sin_cos } = counted::<N>();
    assert_eq!(count(|| general_forward::aim(&forward, &links[0], target, sin_cos[0])).total(), 40);
    let all = count(|| general_forward::aim_gradient(&forward, &links, target, &sin_cos)).total();
    assert_eq!(all, if N == 1 { 59 } else { 63 * N - 3 }, "{N} joints");
    let mut spec = rig(&[THUG; N]);
    spec.effector.frame = general_frame(random);
    assert_close_above(derived_total(&CHAIN_VALUE_GRADIENT, &spec), all, 20, &format!("{N} joints"));
}

#[test]
fn general_effectors() {
    let random = &mut Random::new(6);
    general_forward_of::<1>(random);
    general_forward_of::<2>(random);
    general_forward_of::<3>(random);
    general_forward_of::<4>(random);
}

/// Returns the value of `f` and its sixth-order central differences by each argument.
fn value_and_differences<const K: usize>(at: [f64; K], f: impl Fn([f64; K]) -> f64) -> Vec<f64> {
    let by = |k: usize| {
        central_difference(|change| {
            let mut moved = at;
            moved[k] += change;
            [f(moved)]
        })[0]
    };
    [f(at)].into_iter().chain((0..K).map(by)).collect()
}

fn link(random: &mut Random) -> Link {
    Link { rows: random.rotation(), translation: random.vector(0.5) }
}

fn sin_cos<const K: usize, const R: usize>(angles: [f64; K]) -> [f64; R] {
    core::array::from_fn(|i| if i % 2 == 0 { angles[i / 2].sin() } else { angles[i / 2].cos() })
}

/// Applies roll, which turns left towards up, then pitch and heading.
fn rolled(v: V, [roll, pitch, heading]: [f64; 3]) -> V {
    correct(kinematics::turn(v, THUG.left, THUG.up, roll), &THUG, pitch, heading)
}

/// Returns the effector's position and forward direction after all links and rotations.
fn pushed<const N: usize>(links: &[Link; N], angles: [[f64; 3]; N]) -> (V, V) {
    let (mut origin, mut forward) = ([0.0; 3], THUG.forward);
    for (link, angles) in links.iter().zip(angles) {
        origin = rolled(link.point(origin), angles);
        forward = rolled(link.direction(forward), angles);
    }
    (origin, forward)
}

fn aim_at(target: V, (origin, forward): (V, V)) -> f64 {
    let v = sub(target, origin);
    dot(v, forward) / norm(v)
}

#[test]
fn roll_of_one_joint_and_of_two() {
    let random = &mut Random::new(11);
    for _ in 0..part_of(3000) {
        let links = [link(random), link(random)];
        let target = scale(3.0, random.rotation()[0]);
        let angles: [f64; 6] = [0; 6].map(|_| random.within(1.5));
        let [a, b, c, d, e, f] = angles;

        let (aim, gradient) = roll::aim_gradient(&links[0].numbers(), target, sin_cos([a, b, c]));
        let expected = value_and_differences([a, b, c], |angles| aim_at(target, pushed(&[links[0]], [angles])));
        let found: Vec<f64> = [aim].into_iter().chain(gradient).collect();
        assert_close(&found, &expected, 1e-11, "one joint with roll");

        let both = links.map(|link| link.numbers());
        let (aim, gradient) = roll::chain_of_two(&both, target, &[sin_cos([a, b, c]), sin_cos([d, e, f])]);
        let expected =
            value_and_differences(angles, |[a, b, c, d, e, f]| aim_at(target, pushed(&links, [[a, b, c], [d, e, f]])));
        let found: Vec<f64> = [aim].into_iter().chain(gradient.into_iter().flatten()).collect();
        assert_close(&found, &expected, 1e-11, "two joints with roll");
    }
    let one = Counted(1.0);
    assert_eq!(count(|| roll::aim_gradient(&[one; 12], [one; 3], [one; 6])).total(), 62);
    assert_eq!(count(|| roll::chain_of_two(&[[one; 12]; 2], [one; 3], &[[one; 6]; 2])).total(), 140);
}

#[test]
fn squared_distance() {
    let random = &mut Random::new(12);
    for _ in 0..part_of(3000) {
        let (t, target) = (random.vector(1.0), random.vector(3.0));
        let angles = [random.within(3.0), random.within(3.0)];
        let expected = value_and_differences(angles, |[pitch, heading]| {
            let v = sub(target, correct(t, &THUG, pitch, heading));
            dot(v, v)
        });
        let found = distance::squared_distance_gradient(t, target, sin_cos(angles));
        assert_close(&found, &expected, 1e-11, "squared distance");
    }
    let one = Counted(1.0);
    let by_hand = count(|| distance::squared_distance_gradient([one; 3], [one; 3], [one; 4]));
    assert_eq!((by_hand.total(), by_hand.div, by_hand.sqrt, by_hand.select), (28, 0, 0, 0));
}

#[test]
fn two_targets_at_once() {
    let random = &mut Random::new(13);
    for _ in 0..part_of(3000) {
        let link = link(random);
        let targets = [scale(3.0, random.rotation()[0]), scale(2.0, random.rotation()[0])];
        let weights = [random.within(2.0), random.within(2.0)];
        let angles = [random.within(3.0), random.within(3.0)];
        let expected = value_and_differences(angles, |[pitch, heading]| {
            let seen = pushed(&[link], [[0.0, pitch, heading]]);
            weights[0] * aim_at(targets[0], seen) + weights[1] * aim_at(targets[1], seen)
        });
        let found = two_targets::aim_gradient(&link.numbers(), targets, weights, sin_cos(angles));
        assert_close(&found, &expected, 1e-11, "two targets");
    }
    let one = Counted(1.0);
    let by_hand = count(|| two_targets::aim_gradient(&[one; 12], [[one; 3]; 2], [one; 2], [one; 4]));
    assert_eq!((by_hand.total(), by_hand.sqrt, by_hand.div), (93, 2, 2));
}

/// Returns the term by its definition, with the cross product.
fn term(points: [V; 3], rest: [f64; 2]) -> f64 {
    let (a, c) = (sub(points[1], points[0]), sub(points[2], points[0]));
    let direction = scale(1.0 / norm(c), c);
    let (alpha, beta) = (dot(a, direction), norm(kinematics::cross(a, direction)));
    (rest[0] - alpha).powi(2) + (rest[1] - beta).powi(2)
}

#[test]
fn target_constraint() {
    let random = &mut Random::new(14);
    let mut compared = 0;
    while compared < part_of(3000) {
        let points: [V; 3] = [0; 3].map(|_| random.vector(2.0));
        let rest = [random.within(2.0), random.within(2.0)];
        let (a, c) = (sub(points[1], points[0]), sub(points[2], points[0]));
        if norm(c) < 1.0 || norm(kinematics::cross(a, c)) < 0.5 * norm(c) {
            continue;
        }
        compared += 1;
        let coordinates: [f64; 9] = core::array::from_fn(|i| points[i / 3][i % 3]);
        let expected = value_and_differences(coordinates, |x| {
            term(core::array::from_fn(|i| core::array::from_fn(|k| x[3 * i + k])), rest)
        });
        let (value, gradient) = arap::term_gradient(points, rest);
        let found: Vec<f64> = [value].into_iter().chain(gradient.into_iter().flatten()).collect();
        assert_close(&found, &expected, 1e-9, "the term");
    }
    let one = Counted(1.0);
    let by_hand = count(|| arap::term_gradient([[one; 3]; 3], [one; 2]));
    assert_eq!((by_hand.total(), by_hand.sqrt, by_hand.div), (58, 2, 2));
}

/// Returns a link without rotation.
fn straight<T: Number>(translation: [f64; 3]) -> [T; 12] {
    let rows = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
    core::array::from_fn(|i| T::constant(if i < 9 { rows[i] } else { translation[i - 9] }))
}

fn degenerate<T: Number>(finite: impl Fn(T) -> bool, near: &[f64]) {
    let number = |x: f64| T::constant(x);
    let rest = [0.0, 1.0, 0.0, 1.0].map(number);
    let rolled = [0.0, 1.0, 0.0, 1.0, 0.0, 1.0].map(number);
    let random = &mut Random::new(15);
    let joint = Joint::new(&general_frame(random));
    let forward = Direction::new(general_frame(random).forward);
    // Targets on the effector, exactly behind it, and so near that lengths, or only their squares, vanish.
    let behind = [0.0, -1.0, 0.0];
    for target in [[0.0; 3], behind].into_iter().chain(near.iter().map(|&x| [x, -x, x])) {
        let target = target.map(number);
        let links = [straight::<T>([0.0; 3]); 2];
        let (aim, gradient) = chain::aim_gradient(&links, target, &[rest; 2]);
        let (s, jacobian) = residual::residual_jacobian(&links, target, &[rest; 2]);
        let (single, [by_single]) = residual::residual_jacobian(&[links[0]], target, &[rest]);
        let (general, by_general) = general_frames::aim_gradient(&[joint; 2], &forward, &links, target, &[rest; 2]);
        let (effector, by_effector) = general_forward::aim_gradient(&forward, &links, target, &[rest; 2]);
        let (roll, by_roll) = roll::chain_of_two(&links, target, &[rolled; 2]);
        let one = one_joint::aim_gradient(&links[0], target, rest);
        let two = two_targets::aim_gradient(&links[0], [target; 2], [number(1.0); 2], rest);
        let squared = distance::squared_distance_gradient([number(0.0); 3], target, rest);
        let points = [[number(0.0); 3], target, target];
        let (straight, by_straight) = arap::term_gradient(points, [number(0.1); 2]);
        let (folded, by_folded) = arap::term_gradient([target, points[0], target], [number(0.1); 2]);

        let all = [aim, general, effector, roll, straight, folded].into_iter();
        let all = all.chain(s).chain(single).chain(one).chain(two).chain(squared);
        let all = all.chain([gradient, by_general, by_effector].into_iter().flatten().flatten());
        let all = all.chain(by_roll.into_iter().flatten()).chain(by_single.into_iter().flatten());
        let all = all.chain(jacobian.into_iter().flatten().flatten());
        let all = all.chain([by_straight, by_folded].into_iter().flatten().flatten());
        for (i, x) in all.enumerate() {
            assert!(finite(x), "output {i}");
        }
    }
}

#[test]
fn degenerate_inputs_give_finite_numbers() {
    degenerate::<f64>(f64::is_finite, &[1e-300, 1e-160, 1e-150, 1e-20, 1e20, 1e150]);
    degenerate::<f32>(f32::is_finite, &[1e-45, 1e-38, 1e-21, 1e-18, 1e15]);
}

#[test]
fn a_target_on_the_effector_gives_zeros() {
    let rest = [0.0, 1.0, 0.0, 1.0];
    let link = straight::<f64>([0.3, -0.2, 0.1]);
    let target = [0.3, -0.2, 0.1];
    assert_eq!(one_joint::aim_gradient(&link, target, rest), [0.0; 3]);
    assert_eq!(residual::residual_jacobian(&[link], target, &[rest]), ([0.0; 2], [[[0.0; 2]; 2]]));
    let behind = add(target, scale(-2.0, THUG.forward));
    assert_eq!(residual::residual_jacobian(&[link], behind, &[rest]), ([0.0; 2], [[[0.0; 2]; 2]]), "exactly behind");
}
