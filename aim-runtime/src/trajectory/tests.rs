//! The gradient of a whole trajectory against central differences of an independent implementation of the cost.

use glam::Vec3;

use super::cost::{At, Problem};
use super::derived::term_gradient;
use super::{Node, Trajectory, Waypoint};

/// Number of frames, at uneven times.
const FRAMES: usize = 6;
const TIMES: [f32; FRAMES] = [0.0, 0.1, 0.25, 0.3, 0.42, 0.5];

/// Returns a pseudo-random number within ±1.
fn number(seed: &mut u64) -> f64 {
    *seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    f64::from(u32::try_from(*seed >> 33).expect("31 bits are left")) / f64::from(1_u32 << 30) - 1.0
}

fn sub(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    core::array::from_fn(|i| a[i] - b[i])
}

fn norm(a: [f64; 3]) -> f64 {
    <f64 as crate::Scalar>::sqrt(a.iter().map(|x| x * x).sum())
}

/// Returns α and β, computed by the cross product, with lengths rounded by `delta`.
fn place(p: &[[f64; 3]], delta: f64) -> [f64; 2] {
    let (a, c) = (sub(p[1], p[0]), sub(p[2], p[0]));
    let cross = [a[1] * c[2] - a[2] * c[1], a[2] * c[0] - a[0] * c[2], a[0] * c[1] - a[1] * c[0]];
    let dot: f64 = a.iter().zip(c).map(|(a, c)| a * c).sum();
    let long = norm([norm(c), delta, 0.0]);
    // The component along the chord that rounding leaves in β, besides the component orthogonal to it.
    let left = dot / norm(c) * (1.0 - (norm(c) / long) * (norm(c) / long));
    [dot / long, norm([norm(cross) / norm(c), left, delta])]
}

/// Returns the sum of the squared changes of places, `epsilon` times the squared changes of acceleration, computed from
/// the slopes on either side, and the energy of the spring.
fn cost(rest: &[[f64; 3]], p: &[[f64; 3]], [epsilon, delta]: [f64; 2], spring: (usize, [f64; 3], f64)) -> f64 {
    let mut sum = 0.0;
    for (now, before) in p.windows(3).zip(rest.windows(3)) {
        let (now, before) = (place(now, delta), place(before, delta));
        sum += (now[0] - before[0]) * (now[0] - before[0]) + (now[1] - before[1]) * (now[1] - before[1]);
    }
    let mean = f64::from(TIMES[FRAMES - 1]) / 5.0;
    let gap = |i: usize| (f64::from(TIMES[i + 1]) - f64::from(TIMES[i])) / mean;
    for i in 0..FRAMES {
        let offset = |i: Option<usize>| i.filter(|&i| i < FRAMES).map_or([0.0; 3], |i| sub(p[i], rest[i]));
        let (before, after) = (gap(i.max(1) - 1), gap(i.min(FRAMES - 2)));
        let (from, here, to) = (offset(i.checked_sub(1)), offset(Some(i)), offset(Some(i + 1)));
        let bend: [f64; 3] = core::array::from_fn(|k| {
            ((to[k] - here[k]) / after - (here[k] - from[k]) / before) / (0.5 * (before + after))
        });
        sum += epsilon * 0.5 * (before + after) * norm(bend) * norm(bend);
    }
    let off = norm(sub(p[spring.0], spring.1));
    sum + spring.2 * off * off
}

#[test]
fn gradient_by_central_differences() {
    let mut seed = 7;
    for _ in 0..200 {
        let points: [Vec3; FRAMES] = core::array::from_fn(|i| {
            #[expect(clippy::cast_possible_truncation, reason = "points are single")]
            let [x, y, z] = core::array::from_fn(|_| number(&mut seed) as f32);
            Vec3::new(x, y, z) * 0.3 + Vec3::X * [0.0, 1.0, 2.0, 3.0, 4.0, 5.0][i]
        });
        let goal = Vec3::new(3.0, 0.5, 0.2);
        let trajectory = Trajectory::new(&points).with_times(&TIMES).with_smoothing(0.2);
        let mut nodes = [Node::default(); FRAMES];
        let waypoints = [Waypoint::new(3, goal).with_weight(0.7)];
        let mut problem = Problem::new(&trajectory, &waypoints, &mut nodes).expect("it is well-formed");
        for node in problem.nodes[1..FRAMES - 1].iter_mut() {
            node.point = node.point.map(|x| x + 0.3 * number(&mut seed));
        }
        problem.assemble(true);
        let weights = [problem.epsilon, problem.delta];
        let [rest, point, gradient] = [0, 1, 2].map(|which| {
            core::array::from_fn::<_, FRAMES, _>(|i| {
                let node = &problem.nodes[i];
                [node.rest, node.point, node.gradient][which]
            })
        });
        let spring = (3, goal.to_array().map(f64::from), f64::from(0.7_f32));
        let by_hand = |p: &[[f64; 3]]| cost(&rest, p, weights, spring);
        assert!((by_hand(&point) - problem.cost(At::Point)).abs() < 1e-12 * (1.0 + by_hand(&point)));
        let scale = gradient.iter().flatten().fold(0.0_f64, |most, x| most.max(x.abs()));
        const STEP: f64 = 1e-4;
        for i in 1..FRAMES - 1 {
            for axis in 0..3 {
                let moved = |by: f64| {
                    let mut p = point;
                    p[i][axis] += by * STEP;
                    p
                };
                let differences = [(1.0, 45.0), (2.0, -9.0), (3.0, 1.0)]
                    .map(|(by, weight)| weight * (by_hand(&moved(by)) - by_hand(&moved(-by))));
                let differences = differences.iter().sum::<f64>() / (60.0 * STEP);
                assert!((differences - gradient[i][axis]).abs() <= 1e-6 * scale, "{differences} {:?}", gradient[i]);
            }
        }
    }
}

/// The published term's kernel against central differences.
#[test]
fn published_gradient_by_central_differences() {
    const STEP: f64 = 1e-4;
    let mut seed = 3;
    for _ in 0..2000 {
        let points: [[f64; 3]; 3] = core::array::from_fn(|i| {
            core::array::from_fn(|k| 0.3 * number(&mut seed) + if k == 0 { [0.0, 1.0, 2.0][i] } else { 0.2 })
        });
        let rest = [1.0 + 0.3 * number(&mut seed), 0.3 + 0.2 * number(&mut seed)];
        let term = |points: &[[f64; 3]; 3]| {
            let now = place(points, 0.0);
            (now[0] - rest[0]) * (now[0] - rest[0]) + (now[1] - rest[1]) * (now[1] - rest[1])
        };
        if place(&points, 0.0)[1] < 0.02 {
            continue;
        }
        let found = term_gradient(&points, &rest);
        assert!((found[0] - term(&points)).abs() < 1e-14);
        for k in 0..9 {
            let moved = |by: f64| {
                let mut points = points;
                points[k / 3][k % 3] += by * STEP;
                term(&points)
            };
            let differences =
                [(1.0, 45.0), (2.0, -9.0), (3.0, 1.0)].map(|(by, weight)| weight * (moved(by) - moved(-by)));
            let differences = differences.iter().sum::<f64>() / (60.0 * STEP);
            assert!((differences - found[1 + k]).abs() < 1e-6, "{differences} {found:?}");
        }
    }
}
