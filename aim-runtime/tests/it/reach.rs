//! Trajectories through waypoints.

use crate::common::Rng;
use crate::common::exact::{cross, dot, exact, length, minus};
use aim_runtime::glam::Vec3;
use aim_runtime::trajectory::{Descent, Ends, Node, Outcome, Place, Status, Trajectory, Waypoint};

/// Returns typical hand trajectories, in units of the limb's length.
fn clips() -> Vec<(&'static str, Vec<Vec3>)> {
    let made = |frames: u16, point: &dyn Fn(f32) -> Vec3| {
        (0..frames).map(|i| point(f32::from(i) / f32::from(frames - 1))).collect::<Vec<_>>()
    };
    let turn = core::f32::consts::TAU;
    let slap = made(61, &|t| {
        let s = (0.5 * turn * t).sin().powi(2);
        Vec3::new(0.7 * s, 0.1 * (turn * t).sin(), 0.1 * s * t)
    });
    let wave = made(111, &|t| {
        let up = (t * (1.0 - t) * 4.0).min(0.75) / 0.75;
        Vec3::new(0.3 * (2.5 * turn * t).sin() * up, 0.9 * up, 0.2 * up + 0.05 * (turn * t).cos())
    });
    let punch = made(51, &|t| {
        let s = (-((t - 0.45) / 0.13).powi(2)).exp();
        Vec3::new(0.1 * (turn * t).cos(), 0.15 * s, 0.9 * s + 0.05 * t)
    });
    let stride = made(113, &|t| Vec3::new(0.3 * (turn * 2.0 * t).sin(), 0.1 * (turn * 4.0 * t).cos(), 1.3 * t));
    vec![("slap", slap), ("wave", wave), ("punch", punch), ("stride", stride)]
}

fn deformed(trajectory: &Trajectory<'_>, waypoints: &[Waypoint]) -> (Vec<Vec3>, Outcome) {
    let (mut out, mut nodes) = workspace(trajectory.points.len());
    let outcome = trajectory.deform(waypoints, &mut out, &mut nodes);
    (out, outcome)
}

fn workspace(frames: usize) -> (Vec<Vec3>, Vec<Node>) {
    (vec![Vec3::ZERO; frames], vec![Node::default(); frames])
}

/// Returns root mean square and maximum of the change of second differences, including the still frames before and
/// after.
fn added_acceleration(points: &[Vec3], now: &[Vec3]) -> [f32; 2] {
    let offset = |i: Option<usize>| i.filter(|&i| i < now.len()).map_or(Vec3::ZERO, |i| now[i] - points[i]);
    let bend = |i: usize| (offset(i.checked_sub(1)) - 2.0 * offset(Some(i)) + offset(Some(i + 1))).length();
    let mean_square = (0..now.len()).map(|i| bend(i).powi(2)).sum::<f32>() / now.len() as f32;
    [mean_square.sqrt(), (0..now.len()).map(bend).fold(0.0, f32::max)]
}

/// Returns a waypoint at most a quarter of the limb's length away, in the middle half of the trajectory.
fn waypoint(rng: &mut Rng, points: &[Vec3]) -> Waypoint {
    let frame = points.len() / 4 + rng.below(points.len() / 2);
    Waypoint::new(frame, points[frame] + rng.direction() * rng.between(0.05, 0.25))
}

#[test]
fn through_the_waypoint_within_thirty_evaluations() {
    let mut rng = Rng(1);
    let mut most = 0;
    for (name, points) in clips() {
        for _ in 0..50 {
            let waypoint = waypoint(&mut rng, &points);
            let (out, outcome) = deformed(&Trajectory::new(&points), &[waypoint]);
            assert_eq!(outcome.status, Status::Met, "{name}: {outcome:?} {waypoint:?}");
            assert!(outcome.gradient <= 1e-6 && outcome.evaluations <= 30, "{name}: {outcome:?}");
            most = most.max(outcome.evaluations);
            assert_eq!(out[waypoint.frame], waypoint.point);
            assert_eq!((out[0], out.last()), (points[0], points.last()), "the ends stay");
        }
    }
    println!("at most {most} evaluations");
}

/// White noise as large as the change itself leads to the same curve from ten starts.
#[test]
fn one_curve_from_ten_starts() {
    let mut rng = Rng(2);
    for (name, points) in clips() {
        let waypoint = waypoint(&mut rng, &points);
        let trajectory = Trajectory::new(&points);
        let (curve, _) = deformed(&trajectory, &[waypoint]);
        for _ in 0..10 {
            let (mut out, mut nodes) = workspace(points.len());
            for (out, &point) in out.iter_mut().zip(&points) {
                *out = point + rng.direction() * rng.between(0.0, 0.2);
            }
            let outcome = trajectory.deform_from_here(&[waypoint], &mut out, &mut nodes);
            assert_eq!(outcome.status, Status::Met, "{name}: {outcome:?}");
            let apart = curve.iter().zip(&out).map(|(a, b)| a.distance(*b)).fold(0.0, f32::max);
            println!("{name}: {apart:.1e} apart after {} evaluations", outcome.evaluations);
            assert!(apart < 1e-3, "{name}: {apart}");
        }
    }
}

/// The smoothest bump minimises the mean square of the acceleration, so it is compared by that; the maximum is only
/// printed.
#[test]
fn no_more_distorted_than_by_descent_and_about_as_smooth_as_a_bump() {
    let mut rng = Rng(3);
    for (name, points) in clips() {
        let (mut acceleration, mut distortion) = ([0.0_f32; 2], 0.0_f64);
        let (mut faster, mut zigzag) = (0.0_f64, f32::INFINITY);
        for _ in 0..16 {
            let waypoint = waypoint(&mut rng, &points);
            let trajectory = Trajectory::new(&points);
            let (out, outcome) = deformed(&trajectory, &[waypoint]);
            let (mut other, mut nodes) = workspace(points.len());
            trajectory.smoothest(&[waypoint], &mut other, &mut nodes);
            let (ours, bump) = (added_acceleration(&points, &out), added_acceleration(&points, &other));
            acceleration = [0, 1].map(|k| acceleration[k].max(ours[k] / bump[k]));
            let descent = Descent { steps: 2000, rate: 0.01, gamma: 1.0 };
            let descended = trajectory.descend(&[waypoint], descent, &mut other, &mut nodes);
            distortion = distortion.max(outcome.distortion / descended.distortion);
            // A descent with five times the rate distorts less but is less smooth.
            let descended = trajectory.descend(&[waypoint], Descent { rate: 0.05, ..descent }, &mut other, &mut nodes);
            faster = faster.max(outcome.distortion / descended.distortion);
            zigzag = zigzag.min(added_acceleration(&points, &other)[0] / bump[0]);

            // Moving only that frame, as IK alone would, is a jump.
            let mut jump = points.clone();
            jump[waypoint.frame] = waypoint.point;
            assert!(added_acceleration(&points, &jump)[1] > 20.0 * ours[1]);
        }
        println!("{name}: acceleration {acceleration:.2?} of the bump's, distortion {distortion:.2} of descent's");
        println!("{name}: {faster:.2} of a faster descent's, which accelerates {zigzag:.1} times as much as the bump");
        assert!(zigzag > 2.0, "{name}: {zigzag}");
        assert!(acceleration[0] <= 2.0 && acceleration[1] <= 3.0, "{name}: {acceleration:?}");
        assert!(distortion <= 1.05, "{name}: {distortion}");
    }
}

#[test]
fn several_waypoints_are_met_and_weights_count() {
    let (_, points) = clips().swap_remove(1);
    let at = |frame: usize, by: Vec3| Waypoint::new(frame, points[frame] + by);
    let three = [at(30, Vec3::X * 0.1), at(55, Vec3::Y * 0.15), at(80, Vec3::Z * -0.1)];
    let (out, outcome) = deformed(&Trajectory::new(&points), &three);
    assert_eq!(outcome.status, Status::Met);
    assert!(three.iter().all(|waypoint| out[waypoint.frame] == waypoint.point), "{outcome:?}");

    // A larger weight brings the curve nearer.
    let mut before = f64::INFINITY;
    for weight in [0.0, 0.01, 1.0, 100.0] {
        let (_, outcome) = deformed(&Trajectory::new(&points), &[at(55, Vec3::Y * 0.15).with_weight(weight)]);
        if weight == 0.0 {
            assert_eq!(outcome.status, Status::Met, "nothing is asked for");
        } else {
            assert_eq!(outcome.status, Status::Missed);
            assert!(outcome.missed < before, "{weight}: {outcome:?}");
            before = outcome.missed;
        }
    }
    // Two contradictory waypoints for the same frame.
    let (_, outcome) = deformed(&Trajectory::new(&points), &[at(55, Vec3::X * 0.1), at(55, Vec3::X * -0.1)]);
    assert_eq!(outcome.status, Status::Missed);
}

#[test]
fn without_waypoints_the_trajectory_is_unchanged() {
    for (_, points) in clips() {
        for waypoints in [&[][..], &[Waypoint::new(20, points[20])]] {
            let (out, outcome) = deformed(&Trajectory::new(&points), waypoints);
            assert_eq!((outcome.status, outcome.evaluations), (Status::Met, 1));
            assert!(outcome.distortion < 1e-20, "{outcome:?}");
            assert!(out.iter().zip(&points).all(|(a, b)| a.distance(*b) < 1e-6));
        }
    }
}

/// Straight lines define no side, repeated points no chord, and turning points a vanishing chord.
#[test]
fn degenerate_trajectories_are_deformed() {
    let made = |point: &dyn Fn(f32) -> Vec3| (0_u16..61).map(|i| point(f32::from(i) / 60.0)).collect::<Vec<_>>();
    let straight = made(&|t| Vec3::X * t);
    let still = made(&|_| Vec3::ONE);
    let held = made(&|t| Vec3::new((t - 0.3).clamp(0.0, 0.2), 0.0, (t - 0.6).max(0.0)));
    let turning = made(&|t| Vec3::X * (0.5 - t).abs());
    let leaping = made(&|t| Vec3::X * if t < 0.5 { 0.0 } else { 1.0 });
    let mut unsettled = 0;
    for points in [straight, still, held, turning, leaping] {
        for by in [Vec3::X * 0.05, Vec3::Y * 0.2, Vec3::new(0.1, -0.1, 0.1), Vec3::Z * 1e-3] {
            for frame in [10, 20, 30, 31, 50] {
                let waypoint = Waypoint::new(frame, points[frame] + by);
                let (out, outcome) = deformed(&Trajectory::new(&points), &[waypoint]);
                unsettled += usize::from(outcome.status == Status::Unsettled);
                assert!(matches!(outcome.status, Status::Met | Status::Unsettled), "{outcome:?}");
                assert_eq!(out[frame], waypoint.point);
                let furthest = out.iter().zip(&points).map(|(a, b)| a.distance(*b)).fold(0.0, f32::max);
                assert!(furthest < 3.0 * by.length() + 1e-6, "{furthest} for {by} at {frame}");
            }
        }
    }
    // If a line is folded back on itself and pushed together, there are many ways to bend.
    assert!(unsettled <= 2, "{unsettled} of 100");
}

/// Results scale with the trajectory, and do not depend on its position or on an offset or scale of time.
#[test]
fn results_scale_and_move_with_the_trajectory() {
    let (_, points) = clips().swap_remove(0);
    let waypoint = Waypoint::new(25, points[25] + Vec3::new(0.1, 0.1, -0.1));
    let (curve, _) = deformed(&Trajectory::new(&points), &[waypoint]);
    for (scale, away) in
        [(100.0, Vec3::ZERO), (1e-15, Vec3::ZERO), (1e15, Vec3::ZERO), (1.0, Vec3::new(8.0, -4.0, 2.0))]
    {
        let moved = |point: Vec3| point * scale + away;
        let moved_points: Vec<_> = points.iter().map(|&point| moved(point)).collect();
        let moved_waypoint = Waypoint::new(25, moved(waypoint.point));
        let (out, outcome) = deformed(&Trajectory::new(&moved_points), &[moved_waypoint]);
        assert_eq!(outcome.status, Status::Met, "{scale} {away}: {outcome:?}");
        let apart = out.iter().zip(&curve).map(|(a, b)| a.distance(moved(*b))).fold(0.0, f32::max);
        assert!(apart < 1e-5 * scale * (1.0 + away.length()), "{scale} {away}: {apart}");
    }
    let times: Vec<f32> = (0_u16..61).map(|i| 3.0 + f32::from(i) / 24.0).collect();
    let (out, _) = deformed(&Trajectory::new(&points).with_times(&times), &[waypoint]);
    assert!(out.iter().zip(&curve).all(|(a, b)| a.distance(*b) < 1e-5));
}

/// Moving a frame in time, together with its point, hardly changes the curve.
#[test]
fn uneven_key_times_hardly_change_the_curve() {
    let path = |t: f32| Vec3::new((2.0 * t).cos(), (2.0 * t).sin(), 0.3 * t);
    let even: Vec<f32> = (0_u16..61).map(|i| f32::from(i) / 60.0).collect();
    let mut uneven = even.clone();
    uneven[30] += 0.4 / 60.0;
    let [a, b] = [even, uneven].map(|times| {
        let points: Vec<Vec3> = times.iter().map(|&t| path(t)).collect();
        let (out, outcome) =
            deformed(&Trajectory::new(&points).with_times(&times), &[Waypoint::new(30, points[30] + Vec3::Z * 0.2)]);
        assert_eq!(outcome.status, Status::Met);
        out.iter().zip(&points).map(|(out, point)| *out - *point).collect::<Vec<_>>()
    });
    let apart = (0..61).map(|i| a[i].distance(b[i])).fold(0.0, f32::max);
    assert!(apart < 0.005, "{apart}");
}

#[test]
fn with_free_ends_the_whole_curve_moves() {
    let (_, points) = clips().swap_remove(3);
    let by = Vec3::new(0.1, 0.2, 0.0);
    let trajectory = Trajectory::new(&points).with_ends(Ends::Free);
    let (out, outcome) = deformed(&trajectory, &[Waypoint::new(50, points[50] + by)]);
    assert_eq!(outcome.status, Status::Met);
    // The whole curve moves along.
    assert!(outcome.distortion < 1e-9, "{outcome:?}");
    assert!(out.iter().zip(&points).all(|(a, b)| (*a - *b).distance(by) < 1e-3));
}

#[test]
fn random_bits_are_harmless() {
    let mut rng = Rng(9);
    for _ in 0..3_000 {
        let frames = rng.below(9);
        let number = |rng: &mut Rng| if rng.below(8) == 0 { rng.any() } else { rng.between(-1.0, 1.0) };
        let point = |rng: &mut Rng| Vec3::new(number(rng), number(rng), number(rng));
        let points: Vec<Vec3> = (0..frames).map(|_| point(&mut rng)).collect();
        let times: Vec<f32> = (0..rng.below(2) * frames).map(|i| i as f32 + 0.3 * number(&mut rng)).collect();
        let waypoints: Vec<Waypoint> = (0..rng.below(3))
            .map(|_| Waypoint::new(rng.below(9), point(&mut rng)).with_weight(number(&mut rng)))
            .collect();
        let trajectory = Trajectory::new(&points).with_times(&times).with_smoothing(number(&mut rng));
        let finite = points.iter().all(|point| point.is_finite());
        let (out, outcome) = deformed(&trajectory, &waypoints);
        assert!(!finite || out.iter().all(|point| point.is_finite()), "{points:?} {waypoints:?} {outcome:?}");
        assert!(finite || outcome.status == Status::Degenerate);
    }
    // Output slice too short.
    let (mut out, mut nodes) = workspace(4);
    let outcome = Trajectory::new(&[Vec3::ZERO; 5]).deform(&[], &mut out, &mut nodes);
    assert_eq!(outcome.status, Status::Degenerate);
}

/// The sampling rate hardly affects the curve.
#[test]
fn the_frame_rate_hardly_changes_the_curve() {
    let path = |t: f32| Vec3::new((2.0 * t).cos(), (3.0 * t).sin(), 0.3 * t);
    let curve = |frames: u16| {
        let points: Vec<Vec3> = (0..=frames).map(|i| path(f32::from(i) / f32::from(frames))).collect();
        let at = usize::from(frames) * 2 / 5;
        let (out, outcome) = deformed(&Trajectory::new(&points), &[Waypoint::new(at, points[at] + Vec3::Z * 0.2)]);
        assert_eq!(outcome.status, Status::Met);
        out.into_iter().step_by(usize::from(frames) / 60).collect::<Vec<_>>()
    };
    let coarse = curve(60);
    for frames in [240, 600, 6000] {
        let apart = curve(frames).iter().zip(&coarse).map(|(a, b)| a.distance(*b)).fold(0.0, f32::max);
        assert!(apart < 0.02, "{frames} frames: {apart}");
    }
}

/// α, β, A and B agree with their definitions and reproduce each point from its neighbours.
#[test]
fn places_agree_with_their_definitions() {
    let mut rng = Rng(9);
    for (name, points) in clips() {
        let trajectory = Trajectory::new(&points);
        assert_eq!(
            (trajectory.place(0), trajectory.place(points.len() - 1), trajectory.place(usize::MAX)),
            (None, None, None)
        );
        let bumpy: Vec<Vec3> = points.iter().map(|&point| point + rng.direction() * rng.between(0.0, 0.3)).collect();
        for points in [&points, &bumpy] {
            for frame in 1..points.len() - 1 {
                let place = Trajectory::new(points).place(frame).expect("an inner frame");
                let [before, point, after] = [frame - 1, frame, frame + 1].map(|frame| exact(points[frame]));
                let [step, chord] = [minus(point, before), minus(after, before)];
                let along = chord.map(|x| x / length(chord));
                let expected = [dot(step, along), length(cross(step, along))];
                let scale = length(step) + length(chord);
                assert!((place.alpha - expected[0]).abs() < 1e-12 * scale, "{name} {frame}: {place:?}");
                assert!((place.beta - expected[1]).abs() < 1e-12 * scale, "{name} {frame}: {place:?}");
                assert!(length(minus(place.along, along)) < 1e-12, "{name} {frame}: {place:?}");
                // B is a unit vector, perpendicular to A, and on the point's side.
                if place.beta > 1e-6 * scale {
                    let off = [length(place.beside) - 1.0, dot(place.beside, along)];
                    assert!(off.iter().all(|off| off.abs() < 1e-9), "{name} {frame}: {place:?}");
                }
                assert!(length(minus(place.point(before), point)) < 1e-12 * scale, "{name} {frame}");
            }
        }
    }
    // Degenerate points: on the line, all at one point, and beside coincident neighbours.
    let point = Vec3::new(0.5, 0.0, 0.0);
    let place = Place::new([Vec3::ZERO, point, Vec3::X]);
    assert_eq!((place.alpha, place.beta, place.beside), (0.5, 0.0, [0.0; 3]));
    let place = Place::new([Vec3::ZERO; 3]);
    assert_eq!((place.alpha, place.beta, place.along, place.beside), (0.0, 0.0, [0.0; 3], [0.0; 3]));
    let place = Place::new([Vec3::Y, Vec3::Y + point, Vec3::Y]);
    assert_eq!((place.alpha, place.beta, place.along, place.beside), (0.0, 0.5, [0.0; 3], [1.0, 0.0, 0.0]));
}
