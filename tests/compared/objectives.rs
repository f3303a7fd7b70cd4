//! Objectives of several fields as they are first written, for `compare.py`, which counts their operations against other
//! tools'.

use aim_rig::prelude::*;
use glam::{DMat3, DQuat, DVec2, DVec3};

/// Reprojection by an equidistant fisheye lens.
#[differentiate(wrt(p, focal, k))]
pub fn fisheye(p: DVec3, focal: f64, k: f64, seen: DVec2) -> f64 {
    let r = (p.x * p.x + p.y * p.y).sqrt();
    let theta = r.atan2(p.z);
    let scale = focal * theta * (1.0 + k * theta * theta) / r;
    let (u, v) = (scale * p.x - seen.x, scale * p.y - seen.y);
    u * u + v * v
}

/// Reprojection into both images of a stereo camera.
#[differentiate(wrt(p))]
pub fn stereo(p: DVec3, focal: f64, baseline: f64, seen: DVec3) -> f64 {
    let left = focal * p.x / p.z - seen.x;
    let right = focal * (p.x - baseline) / p.z - seen.y;
    let height = focal * p.y / p.z - seen.z;
    left * left + right * right + height * height
}

/// Sampson's distance of two seen points from the epipolar constraint.
#[differentiate(wrt(t))]
pub fn sampson(t: DVec3, r: DMat3, a: DVec3, b: DVec3) -> f64 {
    let ra = r * a;
    let line = t.cross(ra);
    let back = r.transpose() * b.cross(t);
    let e = b.dot(line);
    e * e / (line.x * line.x + line.y * line.y + back.x * back.x + back.y * back.y)
}

/// Saint Venant–Kirchhoff energy of a triangle of cloth.
#[differentiate(wrt(a, b, c))]
pub fn cloth(a: DVec3, b: DVec3, c: DVec3, rest: [f64; 4], mu: f64, lambda: f64) -> f64 {
    let (p, q) = (b - a, c - a);
    let u = rest[0] * p + rest[1] * q;
    let v = rest[2] * p + rest[3] * q;
    let exx = 0.5 * (u.dot(u) - 1.0);
    let eyy = 0.5 * (v.dot(v) - 1.0);
    let exy = 0.5 * u.dot(v);
    let trace = exx + eyy;
    mu * (exx * exx + eyy * eyy + 2.0 * exy * exy) + 0.5 * lambda * trace * trace
}

/// Bending of two triangles with a common edge: one less the cosine between their normals.
#[differentiate(wrt(a, b, c, d))]
pub fn hinge(a: DVec3, b: DVec3, c: DVec3, d: DVec3, stiffness: f64) -> f64 {
    let edge = b - a;
    let n = (c - a).cross(edge);
    let m = edge.cross(d - a);
    stiffness * (1.0 - n.dot(m) / (n.length() * m.length()))
}

/// Microfacets' share of the light that is reflected, by roughness and light.
#[differentiate(wrt(alpha, light))]
pub fn microfacets(alpha: f64, light: DVec3, view: DVec3, normal: DVec3) -> f64 {
    let half = (light + view).normalize();
    let c = normal.dot(half);
    let a2 = alpha * alpha;
    let d = c * c * (a2 - 1.0) + 1.0;
    a2 / (std::f64::consts::PI * d * d)
}

/// A sphere's and a plane's distance, joined smoothly.
#[differentiate(wrt(p))]
pub fn joined_distance(p: DVec3, center: DVec3, radius: f64, normal: DVec3, offset: f64, sharp: f64) -> f64 {
    let sphere = (p - center).length() - radius;
    let plane = normal.dot(p) - offset;
    -((-sharp * sphere).exp() + (-sharp * plane).exp()).ln() / sharp
}

/// A pendulum's cost after a step of Runge and Kutta's midpoint rule.
#[differentiate(wrt(angle, speed, torque))]
pub fn pendulum(angle: f64, speed: f64, torque: f64, step: f64, pull: f64, weight: f64) -> f64 {
    let acceleration = torque - pull * angle.sin();
    let half_angle = angle + 0.5 * step * speed;
    let half_speed = speed + 0.5 * step * acceleration;
    let angle = angle + step * half_speed;
    let speed = speed + step * (torque - pull * half_angle.sin());
    angle * angle + weight * speed * speed + 0.01 * torque * torque
}

/// The difference between a rigid body's angular acceleration and a wanted one, by Euler's equations.
#[differentiate(wrt(spin, torque))]
pub fn spinning(spin: DVec3, torque: DVec3, inertia: DVec3, wanted: DVec3) -> f64 {
    let gyroscopic = spin.cross(inertia * spin);
    let off = (torque - gyroscopic) / inertia - wanted;
    off.dot(off)
}

/// Lennard-Jones' and Coulomb's energy of two atoms.
#[differentiate(wrt(a, b))]
pub fn pair(a: DVec3, b: DVec3, depth: f64, sigma: f64, charge: f64) -> f64 {
    let d = a - b;
    let r2 = d.dot(d);
    let s2 = sigma * sigma / r2;
    let s6 = s2 * s2 * s2;
    4.0 * depth * (s6 * s6 - s6) + charge / r2.sqrt()
}

/// A bond's angle by its cosine.
#[differentiate(wrt(a, b, c))]
pub fn bond_angle(a: DVec3, b: DVec3, c: DVec3, stiffness: f64, rest: f64) -> f64 {
    let (u, v) = (a - b, c - b);
    let off = u.dot(v) / (u.length() * v.length()) - rest;
    0.5 * stiffness * off * off
}

/// Axilrod and Teller's energy of three atoms.
#[differentiate(wrt(a, b, c))]
pub fn three_atoms(a: DVec3, b: DVec3, c: DVec3, strength: f64) -> f64 {
    let (u, v, w) = (b - a, c - b, a - c);
    let (u2, v2, w2) = (u.dot(u), v.dot(v), w.dot(w));
    let product = u2 * v2 * w2;
    let cosines = -(u.dot(v) * v.dot(w) * w.dot(u));
    strength * (1.0 + 3.0 * cosines / product) / (product * product.sqrt())
}

/// The squared curvature of the circle through three points of a path.
#[differentiate(wrt(a, b, c))]
pub fn curvature(a: DVec3, b: DVec3, c: DVec3) -> f64 {
    let (u, v) = (b - a, c - b);
    let w = c - a;
    let n = u.cross(v);
    4.0 * n.dot(n) / (u.dot(u) * v.dot(v) * w.dot(w))
}

/// An attitude by the directions that an accelerometer and a compass see.
#[differentiate(wrt(q))]
pub fn attitude(q: DQuat, gravity: DVec3, north: DVec3, felt: DVec3, shown: DVec3) -> f64 {
    let turned = q.normalize();
    let down = turned * gravity - felt;
    let ahead = turned * north - shown;
    down.dot(down) + ahead.dot(ahead)
}

/// A seen point of a camera that turns by a rotation vector while its shutter is open.
#[differentiate(wrt(turn, shift, point))]
pub fn rolling_shutter(turn: DVec3, shift: DVec3, point: DVec3, row: f64, seen: DVec2) -> f64 {
    let p = DQuat::from_scaled_axis(row * turn) * point + row * shift;
    let (x, y) = (p.x / p.z - seen.x, p.y / p.z - seen.y);
    x * x + y * y
}

/// The distance by which a camera on a pan and a tilt joint looks past a point.
#[differentiate(wrt(pan, tilt))]
pub fn pan_and_tilt(pan: f64, tilt: f64, arm: DVec3, eye: DVec3, target: DVec3) -> f64 {
    let turn = DMat3::from_rotation_z(pan);
    let nod = DMat3::from_rotation_y(tilt);
    let at = turn * (arm + nod * eye);
    let ahead = turn * (nod * DVec3::X);
    1.0 - ahead.dot((target - at).normalize())
}

/// A point of a body at rest on a plane: the plane's distance by the body's rotation and place.
#[differentiate(wrt(turn, shift))]
pub fn contact(turn: DVec3, shift: DVec3, a: DVec3, b: DVec3, normal: DVec3, offset: f64) -> f64 {
    let rotation = DQuat::from_scaled_axis(turn);
    let first = normal.dot(rotation * a + shift) - offset;
    let second = normal.dot(rotation * b + shift) - offset;
    first * first + second * second
}

/// The error of a point's transfer from one image to another by a homography.
#[differentiate(wrt(x, y, z))]
pub fn transfer(x: DVec3, y: DVec3, z: DVec3, point: DVec2, seen: DVec2) -> f64 {
    let p = DVec3::new(point.x, point.y, 1.0);
    let depth = z.dot(p);
    let (u, v) = (x.dot(p) / depth - seen.x, y.dot(p) / depth - seen.y);
    u * u + v * v
}

/// Reprojection by a lens with radial and tangential distortion.
#[differentiate(wrt(p, k))]
pub fn lens(p: DVec3, k: [f64; 4], focal: f64, seen: DVec2) -> f64 {
    let (x, y) = (p.x / p.z, p.y / p.z);
    let r2 = x * x + y * y;
    let radial = 1.0 + k[0] * r2 + k[1] * r2 * r2;
    let u = x * radial + 2.0 * k[2] * x * y + k[3] * (r2 + 2.0 * x * x);
    let v = y * radial + 2.0 * k[3] * x * y + k[2] * (r2 + 2.0 * y * y);
    let (u, v) = (focal * u - seen.x, focal * v - seen.y);
    u * u + v * v
}

/// The residual of velocity and place between two keyframes, by what an inertial sensor measured between them.
#[differentiate(wrt(q, v, w, shift))]
pub fn preintegrated(q: DQuat, v: DVec3, w: DVec3, shift: DVec3, pull: DVec3, time: f64, gain: DVec3, way: DVec3) -> f64 {
    let back = q.conjugate();
    let faster = back * (w - v - time * pull) - gain;
    let further = back * (shift - time * v - 0.5 * time * time * pull) - way;
    faster.dot(faster) + further.dot(further)
}

/// The squared error of a spring's force with damping along it.
#[differentiate(wrt(a, b, va, vb))]
pub fn damped(a: DVec3, b: DVec3, va: DVec3, vb: DVec3, stiffness: f64, damping: f64, rest: f64, wanted: f64) -> f64 {
    let way = b - a;
    let length = way.length();
    let force = stiffness * (length - rest) + damping * (vb - va).dot(way / length);
    (force - wanted) * (force - wanted)
}

/// A torus and a ball, blended by a smooth minimum.
#[differentiate(wrt(p))]
pub fn blended(p: DVec3, large: f64, small: f64, center: DVec3, radius: f64, width: f64) -> f64 {
    let ring = (p.x * p.x + p.y * p.y).sqrt() - large;
    let torus = (ring * ring + p.z * p.z).sqrt() - small;
    let ball = (p - center).length() - radius;
    let apart = torus - ball;
    0.5 * (torus + ball - (apart * apart + width * width).sqrt())
}

/// The squared distance of a planar arm's tip from a target, by its angles and lengths.
#[differentiate(wrt(shoulder, elbow, upper, lower))]
pub fn planar_arm(shoulder: f64, elbow: f64, upper: f64, lower: f64, target: DVec2) -> f64 {
    let both = shoulder + elbow;
    let x = upper * shoulder.cos() + lower * both.cos() - target.x;
    let y = upper * shoulder.sin() + lower * both.sin() - target.y;
    x * x + y * y
}

/// The negative logarithm of a mixture of two Gaussians.
#[differentiate(wrt(p, a, b))]
pub fn mixture(p: DVec3, a: DVec3, b: DVec3, wide: f64, narrow: f64, share: f64) -> f64 {
    let (u, v) = (p - a, p - b);
    let first = share / (wide * wide * wide) * (-0.5 * u.dot(u) / (wide * wide)).exp();
    let second = (1.0 - share) / (narrow * narrow * narrow) * (-0.5 * v.dot(v) / (narrow * narrow)).exp();
    -(first + second).ln()
}

/// The distance of a seen point from its epipolar line, by a rotation vector and the direction between the cameras.
#[differentiate(wrt(turn, t))]
pub fn epipolar(turn: DVec3, t: DVec3, a: DVec3, b: DVec3) -> f64 {
    let line = t.cross(DQuat::from_scaled_axis(turn) * a);
    let e = b.dot(line);
    e * e / (line.x * line.x + line.y * line.y)
}

/// The potential of a flattened planet.
#[differentiate(wrt(p))]
pub fn flattened(p: DVec3, mu: f64, flattening: f64, radius: f64) -> f64 {
    let r2 = p.dot(p);
    let sine2 = p.z * p.z / r2;
    -mu / r2.sqrt() * (1.0 - flattening * radius * radius / r2 * (1.5 * sine2 - 0.5))
}

/// A pair of points by a robust kernel, after a turn by a quaternion.
#[differentiate(wrt(q, shift))]
pub fn robust(q: DQuat, shift: DVec3, a: DVec3, b: DVec3, width: f64) -> f64 {
    let off = q * a + shift - b;
    let square = off.dot(off);
    square / (square + width * width)
}

/// The differences of a source's distances from three microphones.
#[differentiate(wrt(p))]
pub fn arrivals(p: DVec3, a: DVec3, b: DVec3, c: DVec3, ab: f64, ac: f64) -> f64 {
    let (da, db, dc) = ((p - a).length(), (p - b).length(), (p - c).length());
    let (u, v) = (da - db - ab, da - dc - ac);
    u * u + v * v
}

/// The squared acceleration that a cart and its pole lack.
#[differentiate(wrt(angle, speed, force))]
pub fn cart(angle: f64, speed: f64, force: f64, cart: f64, pole: f64, length: f64, pull: f64, wanted: DVec2) -> f64 {
    let (sine, cosine) = (angle.sin(), angle.cos());
    let below = cart + pole * sine * sine;
    let forth = (force + pole * sine * (length * speed * speed + pull * cosine)) / below;
    let round = (-force * cosine - pole * length * speed * speed * cosine * sine - (cart + pole) * pull * sine) / (length * below);
    let (u, v) = (forth - wanted.x, round - wanted.y);
    u * u + v * v
}
