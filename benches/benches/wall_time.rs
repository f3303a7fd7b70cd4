//! Wall-clock times, measured with criterion. Each implementation is first checked against the expected values.
//!
//! With `-- --test`, only the checks run. One reported time covers a hundred poses.

#[expect(unreachable_pub, reason = "shared with the other benchmark")]
mod contenders;

use std::hint::black_box;

use aim_benches::pose::{JointPose, MEASURED, measured_chains, measured_joints};
use aim_benches::{Float, by_hand, chain_by_hand, derived, differences};
use contenders::dual::{self, Real};
use contenders::symbolic;
use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, Criterion, Throughput};

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    of_type::<f32>(&mut criterion, "f32", 2e-3, |joint| joint);
    of_type::<f64>(&mut criterion, "f64", 1e-8, |joint| joint.way("symdiff", symbolic::joint));
    criterion.final_summary();
}

type Joint<'c, 'p, S> = Problem<'c, 'p, JointPose<S>, [S; 3]>;

fn of_type<S: Real>(
    criterion: &mut Criterion,
    name: &str,
    tolerance: f64,
    more: for<'c, 'p> fn(Joint<'c, 'p, S>) -> Joint<'c, 'p, S>,
) {
    let joints = measured_joints::<S>();
    let chains = measured_chains::<S>();
    let joint = Problem::new(criterion, format!("joint/{name}"), &joints, by_hand::joint, tolerance)
        .way("derived", derived::joint)
        .way("by_hand", by_hand::joint)
        .way("dual_turned_back", dual::turned_back)
        .way("dual_paper", dual::paper)
        .way("differences", differences::joint);
    drop(more(joint));
    Problem::new(criterion, format!("joint_given/{name}"), &joints, by_hand::joint, tolerance)
        .way("derived", derived::joint_given)
        .way("by_hand", by_hand::joint_given);
    Problem::new(criterion, format!("gradient/{name}"), &chains, chain_by_hand::gradient, tolerance)
        .way("derived", derived::gradient)
        .way("by_hand", chain_by_hand::gradient)
        .way("differences", differences::gradient);
    Problem::new(criterion, format!("gradient_given/{name}"), &chains, chain_by_hand::gradient, tolerance)
        .way("derived", derived::gradient_given)
        .way("by_hand", chain_by_hand::gradient_given);
    Problem::new(criterion, format!("jacobian/{name}"), &chains, chain_by_hand::jacobian, tolerance)
        .way("derived", derived::jacobian)
        .way("by_hand", chain_by_hand::jacobian)
        .way("differences", differences::jacobian);
    Problem::new(criterion, format!("jacobian_given/{name}"), &chains, chain_by_hand::jacobian, tolerance)
        .way("derived", derived::jacobian_given)
        .way("by_hand", chain_by_hand::jacobian_given);
}

/// A benchmark group: the poses, the expected result for each, and the tolerance of the check.
struct Problem<'c, 'p, P, O> {
    group: BenchmarkGroup<'c, WallTime>,
    poses: &'p [P],
    expected: fn(&P) -> O,
    tolerance: f64,
}

impl<'c, 'p, P, S: Float, const N: usize> Problem<'c, 'p, P, [S; N]> {
    fn new(
        criterion: &'c mut Criterion,
        name: String,
        poses: &'p [P],
        expected: fn(&P) -> [S; N],
        tolerance: f64,
    ) -> Self {
        let mut group = criterion.benchmark_group(name);
        group.throughput(Throughput::Elements(MEASURED as u64));
        Self { group, poses, expected, tolerance }
    }

    /// Checks one implementation on every pose, then measures it.
    fn way(mut self, name: &str, f: impl Fn(&P) -> [S; N]) -> Self {
        let poses = self.poses;
        for pose in poses {
            for (found, expected) in f(pose).into_iter().zip((self.expected)(pose)) {
                let (found, expected): (f64, f64) = (found.into(), expected.into());
                let near = (found - expected).abs() <= self.tolerance * expected.abs().max(1.0);
                assert!(near, "{name}: {found} where {expected} is right");
            }
        }
        self.group.bench_function(name, |bencher| {
            bencher.iter(|| {
                for pose in poses {
                    black_box(f(black_box(pose)));
                }
            });
        });
        self
    }
}
