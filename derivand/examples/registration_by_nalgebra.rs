//! A scan is laid onto the planes that it was taken of: Gauss's and Newton's method on the manifold of poses. `gauss_newton` gives the
//! normal equations, and nalgebra's Cholesky decomposition solves them.

use derivand::differentiate;
use derivand::glam::{DQuat, DVec3};
use nalgebra::{Matrix6, Vector6};

/// How far a point of the scan is off its plane.
#[differentiate(wrt(tangent(turn), shift), gauss_newton)]
fn off(turn: DQuat, shift: DVec3, point: DVec3, (normal, offset): (DVec3, f64)) -> f64 {
    normal.dot(turn * point + shift) - offset
}

fn main() {
    // The floor and two walls of a room, from where the scanner stands.
    let (heading, place) = (DQuat::from_rotation_y(0.5) * DQuat::from_rotation_x(0.2), DVec3::new(1.0, 1.5, -0.5));
    let planes = [(DVec3::Y, 0.0), (DVec3::X, -3.0), (DVec3::Z, -2.0)];
    let scan = (0..30_u8).map(|i| {
        let (plane, t) = (planes[usize::from(i % 3)], f64::from(i));
        let there = DVec3::new(0.1 * t, (0.7 * t).sin(), (1.3 * t).cos());
        let on_plane = there.reject_from(plane.0) + plane.0 * plane.1;
        (heading.inverse() * (on_plane - place), plane)
    });
    let scan: Vec<_> = scan.collect();

    let (mut turn, mut shift, mut rounds) = (DQuat::IDENTITY, DVec3::ZERO, 0);
    loop {
        let (mut slope, mut normal) = (Vector6::zeros(), Matrix6::zeros());
        for &(point, plane) in &scan {
            let (_, (by_turn, by_shift), square) = off_gauss_newton(turn, shift, point, plane);
            slope += Vector6::from_iterator([by_turn, by_shift].into_iter().flat_map(|v| v.to_array()));
            normal += Matrix6::from(square);
        }
        let step = normal.cholesky().expect("three walls hold a pose in all six directions").solve(&-slope);
        let [a, b, c, x, y, z] = step.into();
        turn = (turn * DQuat::from_scaled_axis(DVec3::new(a, b, c))).normalize();
        shift += DVec3::new(x, y, z);
        rounds += 1;
        if step.norm() < 1e-12 || rounds == 20 {
            break;
        }
    }

    println!("after {rounds} rounds: {turn} and {shift}");
    assert!(turn.dot(heading).abs() > 1.0 - 1e-12 && shift.distance(place) < 1e-9);
}
