//! Objectives of several fields as they are first written, for `compare.py`, which counts their operations against other
//! tools'.

use aim_rig::prelude::*;
use glam::{DMat2, DMat3, DQuat, DVec2, DVec3};

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
pub fn preintegrated(
    q: DQuat,
    v: DVec3,
    w: DVec3,
    shift: DVec3,
    pull: DVec3,
    time: f64,
    gain: DVec3,
    way: DVec3,
) -> f64 {
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
    let round = (-force * cosine - pole * length * speed * speed * cosine * sine - (cart + pole) * pull * sine)
        / (length * below);
    let (u, v) = (forth - wanted.x, round - wanted.y);
    u * u + v * v
}

/// The energy of a tetrahedron of neo-Hookean stuff.
#[differentiate(wrt(a, b, c, d))]
pub fn tetra(a: DVec3, b: DVec3, c: DVec3, d: DVec3, inverse: DMat3, mu: f64, lambda: f64) -> f64 {
    let shape = DMat3::from_cols(b - a, c - a, d - a);
    let f = shape * inverse;
    let j = f.determinant();
    let square = f.x_axis.length_squared() + f.y_axis.length_squared() + f.z_axis.length_squared();
    0.5 * mu * (square - 3.0 - 2.0 * j.ln()) + 0.5 * lambda * (j - 1.0) * (j - 1.0)
}

/// What a pose in the plane, seen from another, is off a measured one.
#[differentiate(wrt(x, y, heading, ox, oy, turned))]
pub fn odometry(x: f64, y: f64, heading: f64, ox: f64, oy: f64, turned: f64, seen: DVec3) -> f64 {
    let (s, c) = heading.sin_cos();
    let (dx, dy) = (ox - x, oy - y);
    let u = c * dx + s * dy - seen.x;
    let v = c * dy - s * dx - seen.y;
    let w = turned - heading - seen.z;
    u * u + v * v + w * w
}

/// Registration of three points by a quaternion.
#[differentiate(wrt(q, t))]
pub fn three_points(q: DQuat, t: DVec3, a: DVec3, b: DVec3, c: DVec3, x: DVec3, y: DVec3, z: DVec3) -> f64 {
    let u = q * a + t - x;
    let v = q * b + t - y;
    let w = q * c + t - z;
    u.dot(u) + v.dot(v) + w.dot(w)
}

/// Reprojection by a camera that a quaternion turns.
#[differentiate(wrt(q, t, p))]
pub fn camera(q: DQuat, t: DVec3, p: DVec3, focal: f64, seen: DVec2) -> f64 {
    let local = q * p + t;
    let u = focal * local.x / local.z - seen.x;
    let v = focal * local.y / local.z - seen.y;
    u * u + v * v
}

/// What a rotor that pushes along its own axis is off a wanted acceleration.
#[differentiate(wrt(q, v, thrust))]
pub fn rotor(q: DQuat, v: DVec3, thrust: f64, mass: f64, pull: DVec3, drag: f64, wanted: DVec3) -> f64 {
    let lift = q * DVec3::new(0.0, 0.0, thrust);
    let a = lift / mass + pull - drag * v.length() * v - wanted;
    a.dot(a)
}

/// The distance of a point from a cylinder without ends.
#[differentiate(wrt(p, a, b))]
pub fn capsule(p: DVec3, a: DVec3, b: DVec3, radius: f64) -> f64 {
    let (pa, ba) = (p - a, b - a);
    let h = pa.dot(ba) / ba.dot(ba);
    let off = pa - h * ba;
    off.length() - radius
}

/// What three probabilities are off the wanted ones.
#[differentiate(wrt(x, y, z))]
pub fn logits(x: f64, y: f64, z: f64, wanted: DVec3) -> f64 {
    let (ex, ey, ez) = (x.exp(), y.exp(), z.exp());
    let sum = ex + ey + ez;
    let (u, v, w) = (ex / sum - wanted.x, ey / sum - wanted.y, ez / sum - wanted.z);
    u * u + v * v + w * w
}

/// The Lagrangian of two pendulums, one on the other.
#[differentiate(wrt(one, two, rate_one, rate_two))]
pub fn double_pendulum(
    one: f64,
    two: f64,
    rate_one: f64,
    rate_two: f64,
    m: f64,
    n: f64,
    l: f64,
    k: f64,
    g: f64,
) -> f64 {
    let kinetic = 0.5 * (m + n) * l * l * rate_one * rate_one
        + 0.5 * n * k * k * rate_two * rate_two
        + n * l * k * rate_one * rate_two * (one - two).cos();
    let height = -(m + n) * g * l * one.cos() - n * g * k * two.cos();
    kinetic - height
}

/// A glossy reflection with its geometric term and Fresnel's.
#[differentiate(wrt(roughness, light, view))]
pub fn specular(roughness: f64, light: DVec3, view: DVec3, normal: DVec3, base: f64) -> f64 {
    let half = (light + view).normalize();
    let nh = normal.dot(half);
    let nl = normal.dot(light);
    let nv = normal.dot(view);
    let vh = view.dot(half);
    let a2 = roughness * roughness;
    let d = a2 / ((nh * nh * (a2 - 1.0) + 1.0) * (nh * nh * (a2 - 1.0) + 1.0));
    let f = base + (1.0 - base) * (1.0 - vh) * (1.0 - vh) * (1.0 - vh) * (1.0 - vh) * (1.0 - vh);
    let g = 1.0 / ((nl + (a2 + (1.0 - a2) * nl * nl).sqrt()) * (nv + (a2 + (1.0 - a2) * nv * nv).sqrt()));
    d * f * g
}

/// A triangle that keeps its area.
#[differentiate(wrt(a, b, c))]
pub fn area(a: DVec3, b: DVec3, c: DVec3, rest: f64) -> f64 {
    let n = (b - a).cross(c - a);
    let area = 0.5 * n.length();
    (area - rest) * (area - rest)
}

/// A tetrahedron that keeps its volume.
#[differentiate(wrt(a, b, c, d))]
pub fn volume(a: DVec3, b: DVec3, c: DVec3, d: DVec3, rest: f64) -> f64 {
    let volume = (b - a).cross(c - a).dot(d - a) / 6.0;
    (volume - rest) * (volume - rest)
}

/// Registration of two points to planes with a robust loss.
#[differentiate(wrt(turn, t))]
pub fn two_planes(turn: DVec3, t: DVec3, a: DVec3, n: DVec3, b: DVec3, m: DVec3) -> f64 {
    let q = DQuat::from_scaled_axis(turn);
    let u = n.dot(q * a + t);
    let v = m.dot(q * b + t);
    u * u / (1.0 + u * u) + v * v / (1.0 + v * v)
}

/// A normal distribution by its covariance.
#[differentiate(wrt(x, covariance))]
pub fn mahalanobis(x: DVec3, mean: DVec3, covariance: [f64; 6]) -> f64 {
    let [a, b, c, d, e, f] = covariance;
    let s = DMat3::from_cols(DVec3::new(a, d, e), DVec3::new(d, b, f), DVec3::new(e, f, c));
    let off = x - mean;
    0.5 * off.dot(s.inverse() * off) + 0.5 * s.determinant().ln()
}

/// Angular momentum in the world.
#[differentiate(wrt(q, w))]
pub fn spin_energy(q: DQuat, w: DVec3, inertia: DVec3, wanted: DVec3) -> f64 {
    let momentum = q * (inertia * w) - wanted;
    momentum.dot(momentum)
}

/// What one quaternion is off another as seen from a third.
#[differentiate(wrt(p, q))]
pub fn relative(p: DQuat, q: DQuat, seen: DQuat) -> f64 {
    let off = p.conjugate() * q - seen;
    off.dot(off)
}

/// A step of a bicycle's motion.
#[differentiate(wrt(x, y, yaw, speed, steer))]
pub fn bicycle(x: f64, y: f64, yaw: f64, speed: f64, steer: f64, base: f64, dt: f64, wanted: DVec3) -> f64 {
    let nx = x + dt * speed * yaw.cos();
    let ny = y + dt * speed * yaw.sin();
    let nyaw = yaw + dt * speed / base * steer.tan();
    (nx - wanted.x) * (nx - wanted.x) + (ny - wanted.y) * (ny - wanted.y) + (nyaw - wanted.z) * (nyaw - wanted.z)
}

/// Morse's potential.
#[differentiate(wrt(a, b))]
pub fn morse(a: DVec3, b: DVec3, depth: f64, width: f64, rest: f64) -> f64 {
    let r = (a - b).length();
    let e = 1.0 - (-width * (r - rest)).exp();
    depth * e * e
}

/// The three-body term of Stillinger and Weber.
#[differentiate(wrt(a, b, c))]
pub fn stillinger(a: DVec3, b: DVec3, c: DVec3, strength: f64, gamma: f64, cut: f64) -> f64 {
    let (u, v) = (a - b, c - b);
    let (p, q) = (u.length(), v.length());
    let cosine = u.dot(v) / (p * q);
    strength * (gamma / (p - cut) + gamma / (q - cut)).exp() * (cosine + 1.0 / 3.0) * (cosine + 1.0 / 3.0)
}

/// A hinge's angle and its rest.
#[differentiate(wrt(a, b, c, d))]
pub fn bending(a: DVec3, b: DVec3, c: DVec3, d: DVec3, rest: f64) -> f64 {
    let e = b - a;
    let n = e.cross(c - a);
    let m = (d - a).cross(e);
    let angle = n.cross(m).dot(e.normalize()).atan2(n.dot(m));
    (angle - rest) * (angle - rest)
}

/// Registration of a point with a covariance.
#[differentiate(wrt(turn, shift))]
pub fn generalized_icp(turn: DVec3, shift: DVec3, a: DVec3, b: DVec3, weight: DMat3) -> f64 {
    let r = DQuat::from_scaled_axis(turn) * a + shift - b;
    r.dot(weight * r)
}

/// Corotated elasticity in the plane.
#[differentiate(wrt(f))]
pub fn corotated(f: DMat2, mu: f64, lambda: f64) -> f64 {
    let (a, b, c, d) = (f.x_axis.x, f.y_axis.x, f.x_axis.y, f.y_axis.y);
    let s = ((a + d) * (a + d) + (c - b) * (c - b)).sqrt();
    let j = a * d - b * c;
    mu * (a * a + b * b + c * c + d * d - 2.0 * s + 2.0) + 0.5 * lambda * (j - 1.0) * (j - 1.0)
}

/// A triangle of Saint Venant and Kirchhoff's stuff.
#[differentiate(wrt(a, b, c))]
pub fn stvk(a: DVec3, b: DVec3, c: DVec3, inverse: DMat2, mu: f64, lambda: f64) -> f64 {
    let (p, q) = (b - a, c - a);
    let u = inverse.x_axis.x * p + inverse.x_axis.y * q;
    let v = inverse.y_axis.x * p + inverse.y_axis.y * q;
    let (e, f, g) = (u.dot(u) - 1.0, v.dot(v) - 1.0, u.dot(v));
    0.25 * mu * (e * e + f * f + 2.0 * g * g) + 0.125 * lambda * (e + f) * (e + f)
}

/// The angle between two turns.
#[differentiate(wrt(q))]
pub fn angle_error(q: DQuat, wanted: DQuat) -> f64 {
    let off = wanted.conjugate() * q.normalize();
    2.0 * off.xyz().length().atan2(off.w)
}

/// The power of drag in an atmosphere.
#[differentiate(wrt(p, v))]
pub fn drag(p: DVec3, v: DVec3, wind: DVec3, scale: f64, density: f64, k: f64) -> f64 {
    let rho = density * (-p.z / scale).exp();
    let off = v - wind;
    k * rho * off.length() * off.dot(v)
}

/// A place by azimuth, elevation and range.
#[differentiate(wrt(azimuth, elevation, range))]
pub fn radar(azimuth: f64, elevation: f64, range: f64, at: DVec3, seen: DVec3) -> f64 {
    let p = DVec3::new(
        range * elevation.cos() * azimuth.cos(),
        range * elevation.cos() * azimuth.sin(),
        range * elevation.sin(),
    ) + at
        - seen;
    p.dot(p)
}

/// Where a ray meets a sphere.
#[differentiate(wrt(origin, direction, center, radius))]
pub fn ray_sphere(origin: DVec3, direction: DVec3, center: DVec3, radius: f64) -> f64 {
    let off = origin - center;
    let b = off.dot(direction);
    let disc = b * b - off.dot(off) + radius * radius;
    -b - disc.sqrt()
}

/// The tip of an arm of three joints.
#[differentiate(wrt(one, two, three))]
pub fn spatial_arm(one: f64, two: f64, three: f64, upper: f64, lower: f64, target: DVec3) -> f64 {
    let reach = upper * two.cos() + lower * (two + three).cos();
    let p = DVec3::new(reach * one.cos(), reach * one.sin(), upper * two.sin() + lower * (two + three).sin());
    (p - target).length_squared()
}

/// The energy of two dipoles.
#[differentiate(wrt(a, b))]
pub fn dipoles(a: DVec3, b: DVec3, place: DVec3) -> f64 {
    let r2 = place.dot(place);
    let r = r2.sqrt();
    (a.dot(b) - 3.0 * a.dot(place) * b.dot(place) / r2) / (r2 * r)
}

/// A step towards a point, and its effort.
#[differentiate(wrt(x, v, force))]
pub fn tracking(x: DVec2, v: DVec2, force: DVec2, mass: f64, dt: f64, wanted: DVec2, effort: f64) -> f64 {
    let a = force / mass;
    let next = x + dt * v + 0.5 * dt * dt * a - wanted;
    let speed = v + dt * a;
    next.dot(next) + 0.1 * speed.dot(speed) + effort * force.dot(force)
}

/// Reprojection by the double sphere camera.
#[differentiate(wrt(p, xi, alpha))]
pub fn double_sphere(p: DVec3, xi: f64, alpha: f64, focal: DVec2, center: DVec2, seen: DVec2) -> f64 {
    let d1 = p.length();
    let z = xi * d1 + p.z;
    let d2 = (p.x * p.x + p.y * p.y + z * z).sqrt();
    let depth = alpha * d2 + (1.0 - alpha) * z;
    let u = focal.x * p.x / depth + center.x - seen.x;
    let v = focal.y * p.y / depth + center.y - seen.y;
    u * u + v * v
}

/// Reprojection of a point by its bearing and inverse depth in the camera that saw it first.
#[differentiate(wrt(q, t, azimuth, elevation, rho))]
pub fn inverse_depth(q: DQuat, t: DVec3, azimuth: f64, elevation: f64, rho: f64, seen: DVec2) -> f64 {
    let (sa, ca) = azimuth.sin_cos();
    let (se, ce) = elevation.sin_cos();
    let bearing = DVec3::new(ce * sa, -se, ce * ca);
    let p = q * bearing + rho * t;
    let u = p.x / p.z - seen.x;
    let v = p.y / p.z - seen.y;
    u * u + v * v
}

/// Symmetric registration: both clouds turn half way, along the sum of the normals.
#[differentiate(wrt(turn, t))]
pub fn symmetric(turn: DVec3, t: DVec3, a: DVec3, b: DVec3, na: DVec3, nb: DVec3) -> f64 {
    let q = DQuat::from_scaled_axis(turn);
    let r = (q * a - q.inverse() * b + t).dot(na + nb);
    (1.0 + r * r).ln()
}

/// The score of a point in a cell of a normal distributions transform in the plane.
#[differentiate(wrt(x, y, yaw))]
pub fn ndt(x: f64, y: f64, yaw: f64, point: DVec2, mean: DVec2, information: [f64; 3]) -> f64 {
    let (s, c) = yaw.sin_cos();
    let dx = c * point.x - s * point.y + x - mean.x;
    let dy = s * point.x + c * point.y + y - mean.y;
    let [xx, xy, yy] = information;
    let square = xx * dx * dx + 2.0 * xy * dx * dy + yy * dy * dy;
    -(-0.5 * square).exp()
}

/// A range to a beacon from an antenna that is mounted off the body's centre, by Cauchy's loss.
#[differentiate(wrt(p, q))]
pub fn range_lever(p: DVec3, q: DQuat, lever: DVec3, beacon: DVec3, range: f64, width: f64) -> f64 {
    let antenna = p + q * lever;
    let off = (antenna.distance(beacon) - range) / width;
    (1.0 + off * off).ln()
}

/// Wheels' radii and their distance, by a pose after an arc.
#[differentiate(wrt(left, right, base))]
pub fn wheel_arc(
    left: f64,
    right: f64,
    base: f64,
    turned_left: f64,
    turned_right: f64,
    pose: DVec3,
    seen: DVec3,
) -> f64 {
    let forward = 0.5 * (left * turned_left + right * turned_right);
    let turn = (right * turned_right - left * turned_left) / base;
    let radius = forward / turn;
    let x = pose.x + radius * ((pose.z + turn).sin() - pose.z.sin()) - seen.x;
    let y = pose.y - radius * ((pose.z + turn).cos() - pose.z.cos()) - seen.y;
    let heading = pose.z + turn - seen.z;
    x * x + y * y + heading * heading
}

/// What a gyroscope with a bias leaves between two attitudes.
#[differentiate(wrt(q, next, bias))]
pub fn gyro_step(q: DQuat, next: DQuat, bias: DVec3, rate: DVec3, dt: f64) -> f64 {
    let w = rate - bias;
    let slope = q * DQuat::from_xyzw(w.x, w.y, w.z, 0.0);
    let off = next - (q + slope * (0.5 * dt));
    off.dot(off)
}

/// Calibration of a magnetometer by the length of the field.
#[differentiate(wrt(hard, soft))]
pub fn magnetometer(hard: DVec3, soft: [f64; 6], raw: DVec3, field: f64) -> f64 {
    let [xx, yy, zz, xy, xz, yz] = soft;
    let d = raw - hard;
    let m = DVec3::new(
        xx * d.x + xy * d.y + xz * d.z,
        xy * d.x + yy * d.y + yz * d.z,
        xz * d.x + yz * d.y + zz * d.z,
    );
    (m.length() - field).powi(2)
}

/// Bending of a discrete elastic rod by its curvature binormal.
#[differentiate(wrt(a, b, c))]
pub fn rod(a: DVec3, b: DVec3, c: DVec3, rest: DVec3, stiffness: f64) -> f64 {
    let e = b - a;
    let f = c - b;
    let binormal = 2.0 * e.cross(f) / (e.length() * f.length() + e.dot(f));
    0.5 * stiffness * (binormal - rest).length_squared()
}

/// Mooney and Rivlin's energy of a deformation.
#[differentiate(wrt(f))]
pub fn mooney(f: DMat3, c1: f64, c2: f64, bulk: f64) -> f64 {
    let j = f.determinant();
    let xx = f.x_axis.dot(f.x_axis);
    let yy = f.y_axis.dot(f.y_axis);
    let zz = f.z_axis.dot(f.z_axis);
    let xy = f.x_axis.dot(f.y_axis);
    let yz = f.y_axis.dot(f.z_axis);
    let zx = f.z_axis.dot(f.x_axis);
    let first = xx + yy + zz;
    let second = 0.5 * (first * first - (xx * xx + yy * yy + zz * zz + 2.0 * (xy * xy + yz * yz + zx * zx)));
    c1 * (first - 3.0) + c2 * (second - 3.0) - 2.0 * (c1 + 2.0 * c2) * j.ln() + 0.5 * bulk * (j - 1.0) * (j - 1.0)
}

/// Two springs of a strand that resists bending.
#[differentiate(wrt(a, b, c))]
pub fn strand(a: DVec3, b: DVec3, c: DVec3, rest: f64, stretch: f64, bend: f64) -> f64 {
    let first = (b - a).length() - rest;
    let second = (c - b).length() - rest;
    let bent = a - 2.0 * b + c;
    0.5 * stretch * (first * first + second * second) + 0.5 * bend * bent.dot(bent)
}

/// A triangle of a balloon: tension of its skin, and the gas between it and the origin.
#[differentiate(wrt(a, b, c))]
pub fn balloon(a: DVec3, b: DVec3, c: DVec3, tension: f64, pressure: f64, rest: f64) -> f64 {
    let skin = 0.5 * (b - a).cross(c - a).length();
    let volume = a.dot(b.cross(c)) / 6.0;
    tension * skin - pressure * rest * (volume / rest).ln()
}

/// Anisotropic microfacets' distribution.
#[differentiate(wrt(light, ax, ay))]
pub fn anisotropic(light: DVec3, ax: f64, ay: f64, view: DVec3, x: DVec3, y: DVec3, normal: DVec3) -> f64 {
    let half = (light + view).normalize();
    let hx = x.dot(half) / ax;
    let hy = y.dot(half) / ay;
    let hn = normal.dot(half);
    let s = hx * hx + hy * hy + hn * hn;
    1.0 / (std::f64::consts::PI * ax * ay * s * s)
}

/// A ball carved out of an ellipsoid, with a smooth rim.
#[differentiate(wrt(p, radii))]
pub fn carved(p: DVec3, radii: DVec3, center: DVec3, radius: f64, width: f64) -> f64 {
    let k0 = (p / radii).length();
    let k1 = (p / (radii * radii)).length();
    let ellipsoid = k0 * (k0 - 1.0) / k1;
    let ball = radius - (p - center).length();
    let apart = ellipsoid - ball;
    0.5 * (ellipsoid + ball + (apart * apart + width * width).sqrt())
}

/// Irradiance by nine spherical harmonics.
#[differentiate(wrt(direction))]
pub fn harmonics(direction: DVec3, l: [f64; 9]) -> f64 {
    let n = direction.normalize();
    0.282095 * l[0]
        + 0.488603 * (l[1] * n.y + l[2] * n.z + l[3] * n.x)
        + 1.092548 * (l[4] * n.x * n.y + l[5] * n.y * n.z + l[7] * n.x * n.z)
        + 0.315392 * l[6] * (3.0 * n.z * n.z - 1.0)
        + 0.546274 * l[8] * (n.x * n.x - n.y * n.y)
}

/// How unsharp a thin lens shows two points.
#[differentiate(wrt(focal, focus, eye))]
pub fn blur(focal: f64, focus: f64, eye: DVec3, axis: DVec3, near: DVec3, far: DVec3, stop: f64) -> f64 {
    let aperture = focal / stop;
    let one = axis.dot(near - eye);
    let two = axis.dot(far - eye);
    let first = aperture * focal * (one - focus) / (one * (focus - focal));
    let second = aperture * focal * (two - focus) / (two * (focus - focal));
    first * first + second * second
}

/// The Lagrangian of a crane: a trolley, and a load on a rope that is hoisted.
#[differentiate(wrt(speed, rope, hoist, angle, rate))]
pub fn crane(speed: f64, rope: f64, hoist: f64, angle: f64, rate: f64, trolley: f64, load: f64, pull: f64) -> f64 {
    let (s, c) = angle.sin_cos();
    let vx = speed + hoist * s + rope * rate * c;
    let vy = hoist * c - rope * rate * s;
    let kinetic = 0.5 * trolley * speed * speed + 0.5 * load * (vx * vx + vy * vy);
    let potential = -load * pull * rope * c;
    kinetic - potential
}

/// What a quadrotor's acceleration is off a wanted one, by Euler's angles.
#[differentiate(wrt(roll, pitch, yaw, thrust))]
pub fn quadrotor(roll: f64, pitch: f64, yaw: f64, thrust: f64, mass: f64, pull: f64, wanted: DVec3) -> f64 {
    let (sr, cr) = roll.sin_cos();
    let (sp, cp) = pitch.sin_cos();
    let (sy, cy) = yaw.sin_cos();
    let ax = thrust / mass * (cr * sp * cy + sr * sy) - wanted.x;
    let ay = thrust / mass * (cr * sp * sy - sr * cy) - wanted.y;
    let az = thrust / mass * cr * cp - pull - wanted.z;
    ax * ax + ay * ay + az * az
}

/// The torques of an arm with two links, squared.
#[differentiate(wrt(elbow, rates, accelerations))]
pub fn two_link(
    elbow: f64,
    rates: DVec2,
    accelerations: DVec2,
    shoulder: f64,
    masses: DVec2,
    lengths: DVec2,
    pull: f64,
) -> f64 {
    let inertia = masses.y * lengths.y * lengths.y;
    let coupling = masses.y * lengths.x * lengths.y * elbow.cos();
    let h = masses.y * lengths.x * lengths.y * elbow.sin();
    let m11 = (masses.x + masses.y) * lengths.x * lengths.x + inertia + 2.0 * coupling;
    let m12 = inertia + coupling;
    let g2 = masses.y * lengths.y * pull * (shoulder + elbow).cos();
    let g1 = (masses.x + masses.y) * lengths.x * pull * shoulder.cos() + g2;
    let t1 = m11 * accelerations.x + m12 * accelerations.y - h * (2.0 * rates.x * rates.y + rates.y * rates.y) + g1;
    let t2 = m12 * accelerations.x + inertia * accelerations.y + h * rates.x * rates.x + g2;
    t1 * t1 + t2 * t2
}

/// Buckingham's energy of two ions, and Coulomb's with Thole's damping.
#[differentiate(wrt(a, b))]
pub fn ions(a: DVec3, b: DVec3, wall: f64, rho: f64, c6: f64, charge: f64, damping: f64) -> f64 {
    let r = a.distance(b);
    let buckingham = wall * (-r / rho).exp() - c6 / r.powi(6);
    let damped = 1.0 - (1.0 + 0.5 * damping * r) * (-damping * r).exp();
    buckingham + charge / r * damped
}

/// Ryckaert and Bellemans' torsion.
#[differentiate(wrt(a, b, c, d))]
pub fn rotamer(a: DVec3, b: DVec3, c: DVec3, d: DVec3, k: [f64; 4]) -> f64 {
    let n = (b - a).cross(c - b).normalize();
    let m = (c - b).cross(d - c).normalize();
    let x = n.dot(m);
    k[0] + k[1] * x + k[2] * x * x + k[3] * x * x * x
}

/// Stretching and bending of two bonds, coupled.
#[differentiate(wrt(a, b, c))]
pub fn stretch_bend(a: DVec3, b: DVec3, c: DVec3, k: DVec2, rest: DVec2, angle: f64) -> f64 {
    let u = a - b;
    let v = c - b;
    let (p, q) = (u.length(), v.length());
    let theta = (u.dot(v) / (p * q)).acos();
    (k.x * (p - rest.x) + k.y * (q - rest.y)) * (theta - angle)
}

/// Student's distribution, by place and scales.
#[differentiate(wrt(mean, scales, freedom))]
pub fn student(x: DVec3, mean: DVec3, scales: DVec3, freedom: f64) -> f64 {
    let z = (x - mean) / scales;
    0.5 * (freedom + 3.0) * (1.0 + z.dot(z) / freedom).ln() + scales.x.ln() + scales.y.ln() + scales.z.ln()
}

/// Logistic regression with two examples and a ridge.
#[differentiate(wrt(w, bias))]
pub fn logistic(w: DVec3, bias: f64, a: DVec3, b: DVec3, la: f64, lb: f64, ridge: f64) -> f64 {
    let ma = la * (w.dot(a) + bias);
    let mb = lb * (w.dot(b) + bias);
    (1.0 + (-ma).exp()).ln() + (1.0 + (-mb).exp()).ln() + 0.5 * ridge * w.dot(w)
}

/// The solid angle of a triangle.
#[differentiate(wrt(a, b, c))]
pub fn solid_angle(a: DVec3, b: DVec3, c: DVec3) -> f64 {
    let (la, lb, lc) = (a.length(), b.length(), c.length());
    let above = a.dot(b.cross(c));
    let below = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
    2.0 * above.atan2(below)
}

/// A triangle's quality: the radius of the inner circle by that of the outer one.
#[differentiate(wrt(a, b, c))]
pub fn radius_ratio(a: DVec3, b: DVec3, c: DVec3) -> f64 {
    let (u, v, w) = (b - a, c - b, a - c);
    let (lu, lv, lw) = (u.length(), v.length(), w.length());
    let area = 0.5 * u.cross(v).length();
    let inner = 2.0 * area / (lu + lv + lw);
    let outer = lu * lv * lw / (4.0 * area);
    inner / outer
}

/// The cotangent energy of a triangle that carries a number at each corner.
#[differentiate(wrt(a, b, c))]
pub fn cotangents(a: DVec3, b: DVec3, c: DVec3, values: DVec3) -> f64 {
    let (u, v, w) = (c - b, a - c, b - a);
    let double = w.cross(v).length();
    let at_a = -w.dot(v) / double;
    let at_b = -u.dot(w) / double;
    let at_c = -v.dot(u) / double;
    let (x, y, z) = (values.y - values.z, values.z - values.x, values.x - values.y);
    0.25 * (at_a * x * x + at_b * y * y + at_c * z * z)
}

/// A cubic of Bézier: its place and speed at a time.
#[differentiate(wrt(b, c, t))]
pub fn bezier(a: DVec3, b: DVec3, c: DVec3, d: DVec3, t: f64, target: DVec3, speed: f64) -> f64 {
    let s = 1.0 - t;
    let place = s * s * s * a + 3.0 * s * s * t * b + 3.0 * s * t * t * c + t * t * t * d;
    let velocity = 3.0 * s * s * (b - a) + 6.0 * s * t * (c - b) + 3.0 * t * t * (d - c);
    let off = place - target;
    let fast = velocity.length() - speed;
    off.dot(off) + fast * fast
}

/// A point turned by a blend of two quaternions.
#[differentiate(wrt(p, q, t))]
pub fn blend_turn(p: DQuat, q: DQuat, t: f64, v: DVec3, wanted: DVec3) -> f64 {
    let r = (p * (1.0 - t) + q * t).normalize();
    (r * v - wanted).length_squared()
}

/// A point of a conic as a rational curve.
#[differentiate(wrt(a, b, c, weight, t))]
pub fn conic(a: DVec2, b: DVec2, c: DVec2, weight: f64, t: f64, target: DVec2) -> f64 {
    let s = 1.0 - t;
    let (i, j, k) = (s * s, 2.0 * weight * s * t, t * t);
    let point = (i * a + j * b + k * c) / (i + j + k);
    (point - target).length_squared()
}
