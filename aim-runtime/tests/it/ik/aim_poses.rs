use aim_runtime::glam::{Affine3A, Quat, Vec3};
use aim_runtime::ik::{AimPose, AimPoses, AimPosesStatus, grid, triangulated};
use aim_runtime::{Pose, Settings, Solver, Status};

use crate::common::exact::*;
use crate::common::{DEG, NumericRig, Rng, remaining64, upright};

/// Returns rotations of chest, neck and head as an animator would pose them: unevenly, and partly about other axes.
fn pose_at([heading, pitch]: [f32; 2]) -> [Quat; 3] {
    let part = |share: f32, lean: f32| {
        Quat::from_rotation_y(share * heading)
            * Quat::from_rotation_x(-share * pitch)
            * Quat::from_rotation_z(lean * heading * pitch)
    };
    [part(0.2, 0.3), part(0.35, -0.2), part(0.45, 0.1)]
}

/// Returns the gaze direction; the barrel is mounted at an angle to the head.
fn gaze(rotations: &[Quat]) -> Vec3 {
    rotations.iter().fold(Quat::IDENTITY, |turn, rotation| turn * *rotation) * Vec3::new(0.1, 0.05, 1.0).normalize()
}

struct Set {
    rotations: Vec<[Quat; 3]>,
}

impl Set {
    fn grid(columns: u8, rows: u8) -> Self {
        let at = |i: u8, of: u8, most: f32| most * (2.0 * f32::from(i) / f32::from(of - 1) - 1.0);
        let cells = (0..rows).flat_map(|row| (0..columns).map(move |column| (column, row)));
        Self { rotations: cells.map(|(c, r)| pose_at([at(c, columns, 1.3), at(r, rows, 0.8)])).collect() }
    }

    /// Returns a set with the irregular spacing of an animator's poses, not on a grid.
    fn scattered(count: u8) -> Self {
        let at = |i: u8, step: f32, most: f32| most * (2.0 * (f32::from(i) * step).fract() - 1.0);
        Self { rotations: (1..=count).map(|i| pose_at([at(i, 0.754_877_7, 1.3), at(i, 0.569_840_3, 0.8)])).collect() }
    }

    fn poses(&self) -> Vec<AimPose<'_>> {
        self.rotations.iter().map(|pose| AimPose { direction: gaze(pose) * 3.0, rotations: pose }).collect()
    }

    fn directions(&self) -> Vec<Vec3> {
        self.rotations.iter().map(|pose| gaze(pose)).collect()
    }
}

fn apart(a: &[Quat], b: &[Quat]) -> f64 {
    a.iter().zip(b).map(|(a, b)| angle_of(*a * b.conjugate())).fold(0.0, f64::max)
}

/// Checks everything that is promised of a set. Returns the fraction of directions inside its triangles that its blends
/// reach.
fn judge(set: &Set, triangles: &[[usize; 3]], rng: &mut Rng) -> f32 {
    let poses = set.poses();
    let solver = AimPoses::new(&poses, triangles);
    let mut blended = [Quat::IDENTITY; 3];
    for (pose, rotations) in poses.iter().zip(&set.rotations) {
        let outcome = solver.solve(pose.direction, &mut blended, gaze);
        assert_eq!((outcome.status, outcome.iterations), (AimPosesStatus::Reached, 0));
        assert!(apart(&blended, rotations) < 5e-6, "a pose's own direction: {:e}", apart(&blended, rotations));
    }
    // Between the poses: the direction is reached, and small steps of the direction are small steps of the pose.
    let (mut most, mut met, mut all) = (0, 0, 0);
    for _ in 0..200 {
        let [from, to] = [0, 1].map(|_| {
            let [a, b, c] = triangles[rng.below(triangles.len())].map(|pose| gaze(&set.rotations[pose]));
            (a * rng.between(0.1, 1.0) + b * rng.between(0.1, 1.0) + c * rng.between(0.1, 1.0)).normalize()
        });
        let mut before: Option<[Quat; 3]> = None;
        for step in 0_u8..=200 {
            let wanted = from.lerp(to, f32::from(step) / 200.0).normalize();
            let outcome = solver.with_tolerance(1e-5).with_iterations(20).solve(wanted, &mut blended, gaze);
            if solver.weights(wanted).unwrap().within && outcome.status != AimPosesStatus::Outside {
                met += u32::from(outcome.remaining_rad < 1e-3);
                all += 1;
                assert!((angle(exact(gaze(&blended)), exact(wanted)) - f64::from(outcome.remaining_rad)).abs() < 1e-6);
                most = most.max(outcome.iterations);
            }
            if let Some(before) = before {
                assert!(apart(&before, &blended) < 0.1, "step {step} of {from} to {to}: {}", apart(&before, &blended));
            }
            before = Some(blended);
        }
    }
    let met = met as f32 / all as f32;
    println!("{} poses, {} triangles: {met} met in {most} iterations at most", poses.len(), triangles.len());
    met
}

#[test]
fn a_grid_of_poses_is_blended() {
    let set = Set::grid(5, 3);
    let mut triangles = [[0; 3]; 16];
    assert_eq!(judge(&set, grid(5, 3, &mut triangles).unwrap(), &mut Rng(1)), 1.0);
    assert_eq!(grid(5, 3, &mut triangles[..15]), None);
    assert_eq!(grid(0, 3, &mut triangles), None);
    assert_eq!(grid(usize::MAX, usize::MAX, &mut triangles), None);
}

#[test]
fn scattered_poses_are_blended() {
    let mut rng = Rng(2);
    for count in [5, 9, 14, 20] {
        let set = Set::scattered(count);
        let mut triangles = [[0; 3]; 40];
        let triangles = triangulated(&set.directions(), &mut triangles).unwrap();
        // In a long thin triangle at the edge, no blend may reach the direction.
        assert!(judge(&set, triangles, &mut rng) > 0.93);
    }
}

/// Triangles cover the hull of the directions exactly once, also if all are on circles or surround the origin.
#[test]
fn triangles_cover_the_hull_once() {
    let octahedron = [Vec3::X, Vec3::Y, Vec3::Z, Vec3::NEG_X, Vec3::NEG_Y, Vec3::NEG_Z];
    let cube: Vec<Vec3> =
        (0..8).map(|i| Vec3::from([1, 2, 4].map(|bit| if i & bit == 0 { 1.0 } else { -1.0 }))).collect();
    let mut rng = Rng(3);
    let everywhere: Vec<Vec3> = (0..30).map(|_| rng.direction()).collect();
    for directions in [&octahedron[..], &cube, &everywhere] {
        let mut triangles = [[0; 3]; 64];
        let triangles = triangulated(directions, &mut triangles).unwrap();
        assert_eq!(triangles.len(), 2 * directions.len() - 4, "all round");
        for _ in 0..2000 {
            let wanted = rng.direction();
            let inside = triangles.iter().filter(|triangle| {
                let [a, b, c] = triangle.map(|i| directions[i]);
                let volume = a.dot(b.cross(c));
                [b.cross(c), c.cross(a), a.cross(b)].iter().all(|n| wanted.dot(*n) / volume > 1e-5)
            });
            assert!(inside.count() <= 1);
            let poses: Vec<_> = directions.iter().map(|&direction| AimPose { direction, rotations: &[] }).collect();
            let blend = AimPoses::new(&poses, triangles).weights(wanted).unwrap();
            assert!(blend.within);
            let sum: Vec3 = (0..3).map(|i| directions[blend.poses[i]].normalize() * blend.weights[i]).sum();
            assert!(sum.normalize().distance(wanted) < 1e-5, "the weights make up the direction");
        }
    }
    assert_eq!(triangulated(&[Vec3::X, Vec3::X, Vec3::Y], &mut [[0; 3]; 4]), None);
    assert_eq!(triangulated(&[Vec3::X, Vec3::NAN, Vec3::Y], &mut [[0; 3]; 4]), None);
    assert_eq!(triangulated(&[Vec3::X, Vec3::Y], &mut [[0; 3]; 4]), None);
}

/// Outside the poses, the blend stays at their edge and remains continuous all the way round.
#[test]
fn outside_the_poses_the_blend_stays_on_the_edge() {
    let set = Set::grid(5, 3);
    let poses = set.poses();
    let mut triangles = [[0; 3]; 16];
    let solver = AimPoses::new(&poses, grid(5, 3, &mut triangles).unwrap());
    for polar in [0.3_f32, 0.9, 1.3, 1.6, 2.0, 2.4] {
        let mut before: Option<[Quat; 3]> = None;
        for step in 0_u16..=4000 {
            let (sin, cos) = (f32::from(step) * core::f32::consts::TAU / 4000.0).sin_cos();
            let wanted = Vec3::new(polar.sin() * cos, polar.sin() * sin, polar.cos());
            let mut blended = [Quat::IDENTITY; 3];
            let outcome = solver.with_iterations(0).solve(wanted, &mut blended, gaze);
            assert!(polar < 1.9 || outcome.status == AimPosesStatus::Outside);
            if let Some(before) = before {
                assert!(apart(&before, &blended) < 0.02, "{polar}, step {step}: {}", apart(&before, &blended));
            }
            before = Some(blended);
        }
    }
}

/// The aim solver completes blended poses, including limits and directions outside the poses.
#[test]
fn the_aim_solver_completes_blended_poses() {
    let rig = NumericRig::thug();
    let animated = upright(&rig);
    // Local rotations from the spine outward, posed by the exact solver.
    let exact_solver = Settings::default().with_solver(Solver::Exact);
    let at = |heading: f32, pitch: f32| {
        let mut rig = NumericRig::thug();
        let eye = Vec3::from(animated[0].translation);
        let turn = Quat::from_rotation_y(heading * DEG) * Quat::from_rotation_x(pitch * DEG);
        rig.snap_with(&Pose::new(animated.clone()), eye + turn * Vec3::NEG_Z * 2.0, &exact_solver);
        let mut turns = [Quat::IDENTITY; 3];
        rig.corrections().for_each(|(joint, turn)| turns[joint] = turn);
        turns
    };
    let posed = |turns: &[Quat]| -> Vec<Affine3A> {
        let bones = [2, 1, 0];
        let mut model = [Affine3A::IDENTITY; 3];
        for i in 0..3 {
            let parent = if i == 0 { [Affine3A::IDENTITY; 2] } else { [animated[bones[i - 1]], model[i - 1]] };
            let local = parent[0].inverse() * animated[bones[i]];
            model[i] = parent[1] * local * Affine3A::from_quat(turns[bones[i]]);
        }
        bones.map(|i| model[i]).to_vec()
    };
    let look = |turns: &[Quat]| posed(turns)[0].transform_vector3(rig.effector.forward.into());
    let rotations: Vec<[Quat; 3]> =
        [-20.0, 20.0].iter().flat_map(|&p| [-80.0, -40.0, 0.0, 40.0, 80.0].map(|h| at(h, p))).collect();
    let poses: Vec<_> = rotations.iter().map(|r| AimPose { direction: look(r), rotations: r }).collect();
    let mut triangles = [[0; 3]; 8];
    let solver = AimPoses::new(&poses, grid(5, 2, &mut triangles).unwrap());
    let mut rng = Rng(4);
    let mut left = 0.0_f32;
    for case in 0..200 {
        // Slightly outside the poses, too.
        let turn = Quat::from_rotation_y(rng.between(-85.0, 85.0) * DEG)
            * Quat::from_rotation_x(rng.between(-24.0, 24.0) * DEG);
        let wanted = turn * Vec3::NEG_Z;
        let mut blended = [Quat::IDENTITY; 3];
        let outcome = solver.solve(wanted, &mut blended, look);
        left = left.max(outcome.remaining_rad);
        let pose = posed(&blended);
        let target = Vec3::from(pose[0].translation) + wanted * 2.0;
        let mut rig = NumericRig::thug();
        let finished = rig.snap_with(&Pose::new(pose.clone()), target, &exact_solver);
        assert_eq!(finished.status, Status::Reached, "case {case}");
        assert!(remaining64(&rig, &pose, 0, target) < 0.1 * f64::from(DEG) + 1e-6, "case {case}");
        if outcome.status == AimPosesStatus::Reached {
            let largest =
                rig.joints.iter().flat_map(|j| [j.heading(), j.pitch()]).fold(0.0, |a: f32, b| a.max(b.abs()));
            assert!(largest < 2e-3, "little was left to do: {largest}");
        }
    }
    println!("left to the aim solver: up to {:.3}°", left / DEG);
}

#[test]
fn random_bits_are_harmless() {
    let mut rng = Rng(5);
    for _ in 0..20_000 {
        let n: [f32; 42] = numbers(&mut rng);
        let v = |at: usize| Vec3::from_slice(&n[at..]);
        let rotations: [[Quat; 1]; 5] = core::array::from_fn(|i| [Quat::from_slice(&n[4 * i..])]);
        let poses: [_; 5] = core::array::from_fn(|i| AimPose { direction: v(20 + 3 * i), rotations: &rotations[i] });
        let directions = poses.map(|pose| pose.direction);
        let mut filled = [[0; 3]; 6];
        let any = [[0, 1, 2], [1, 2, 3], [4, 4, 9], [3, 3, 0]];
        let triangles = triangulated(&directions, &mut filled).unwrap_or(&any);
        let solver = AimPoses::new(&poses, triangles).with_tolerance(n[41]);
        let mut blended = [Quat::IDENTITY];
        let outcome =
            solver.solve(v(35), &mut blended, |rotations| if n[40] > 0.9 { v(38) } else { rotations[0] * Vec3::Z });
        assert!(is_sound(blended[0]) && outcome.remaining_rad.is_finite(), "{outcome:?}");
        if let Some(blend) = solver.weights(v(35)) {
            assert!((blend.weights.iter().sum::<f32>() - 1.0).abs() < 1e-5 && blend.weights.iter().all(|w| *w >= 0.0));
        }
    }
    assert_eq!(AimPoses::new(&[], &[]).solve(Vec3::X, &mut [], |_| Vec3::X).status, AimPosesStatus::Degenerate);
}
