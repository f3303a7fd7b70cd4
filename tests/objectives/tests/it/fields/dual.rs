//! The same functions with dual numbers, by other formulas where some exist.

use aim_objectives::dual::{Number, Vector};

fn turned<D: Number>(turn: Vector<D>, p: Vector<D>) -> Vector<D> {
    p.about_axis(turn.unit(), turn.length())
}

pub(super) fn stereo<D: Number>(turn: Vector<D>, shift: Vector<D>, lens: [D; 4], point: Vector<D>) -> [D; 4] {
    let ([k1, k2, p1, p2], seen) = (lens, turned(turn, point) + shift);
    let pixels = [[-0.1, 0.0, 0.0], [0.1, 0.02, 0.0]].map(|eye| {
        let Vector([x, y, z]) = seen - Vector::constant(eye);
        let r2 = (x * x + y * y) / (z * z);
        let both = (p1 * y + p2 * x) * 2.0 / z + r2 * (k1 + k2 * r2) + 1.0;
        [x / z * both + p2 * r2, y / z * both + p1 * r2]
    });
    let [[a, b], [c, d]] = pixels;
    [a * 500.0 + 320.0, b * 500.0 + 240.0, c * 500.0 + 320.0, d * 500.0 + 240.0]
}

pub(super) fn clouds<D: Number>(
    turn: Vector<D>,
    shift: Vector<D>,
    scan: [Vector<D>; 3],
    model: [Vector<D>; 3],
    width: D,
) -> D {
    let terms = scan.into_iter().zip(model).map(|(p, q)| {
        let off = turned(turn, p) + shift - q;
        (width.powi(2) / off.dot(off) + 1.0).recip() / 3.0
    });
    terms.sum()
}

/// Returns u and w of the quaternion of a product of two rotations.
fn product<D: Number>((u, w): (Vector<D>, D), (v, x): (Vector<D>, D)) -> (Vector<D>, D) {
    (v.times(w) + u.times(x) + u.cross(v), w * x - u.dot(v))
}

pub(super) fn pose_edge<D: Number>(
    from: Vector<D>,
    at: Vector<D>,
    to: Vector<D>,
    there: Vector<D>,
    turn: Vector<D>,
    shift: Vector<D>,
) -> [Vector<D>; 2] {
    let half = |turn: Vector<D>| {
        let half = turn.length() / 2.0;
        (turn.unit().times(half.sin()), half.cos())
    };
    let (u, w) = product(product(half(-turn), half(-from)), half(to));
    let (u, w) = if w.re() < 0.0 { (-u, -w) } else { (u, w) };
    let angle = u.length().atan2(w) * 2.0;
    [u.unit().times(angle), turned(-from, there - at) - shift]
}

pub(super) fn neo_hookean<D: Number>(corners: [Vector<D>; 4], rest: [Vector<D>; 3], mu: D, lambda: D) -> D {
    let edges = [1, 2, 3].map(|i| corners[i] - corners[0]);
    let [x, y, z] = rest.map(|Vector([a, b, c])| edges[0].times(a) + edges[1].times(b) + edges[2].times(c));
    let log = x.dot(y.cross(z)).ln();
    let square = x.dot(x) + y.dot(y) + z.dot(z);
    (mu * (square - 3.0 - log * 2.0) + lambda * log.powi(2)) / 2.0
}

pub(super) fn bending<D: Number>(edge: [Vector<D>; 2], wings: [Vector<D>; 2], rest: D) -> D {
    let axis = edge[1] - edge[0];
    // The wings' components perpendicular to the edge.
    let across = |v: Vector<D>| v - axis.times(v.dot(axis) / axis.dot(axis));
    let [v, w] = [across(wings[0] - edge[0]), across(wings[1] - edge[0])];
    let angle = (v.cross(w).dot(axis) / axis.length()).atan2(v.dot(w));
    let pi = core::f64::consts::PI;
    let angle = if angle.re() < 0.0 { angle + pi } else { angle - pi };
    (angle - rest).powi(2) * axis.length()
}

pub(super) fn limbs<D: Number>(p: Vector<D>, joints: [Vector<D>; 4], radius: D, width: D) -> D {
    let capsules: [D; 3] = core::array::from_fn(|i| {
        let (way, from) = (joints[i + 1] - joints[i], p - joints[i]);
        let s = from.dot(way) / way.dot(way);
        let s = if s.re() < 0.0 {
            D::from(0.0)
        } else if s.re() > 1.0 {
            D::from(1.0)
        } else {
            s
        };
        (from - way.times(s)).length() - radius
    });
    let joined = |a: D, b: D| {
        let (less, apart) = if a.re() < b.re() { (a, b - a) } else { (b, a - b) };
        if apart.re() < width.re() { less - (width - apart).powi(2) / (width * 4.0) } else { less }
    };
    joined(joined(capsules[0], capsules[1]), capsules[2])
}

pub(super) fn metal<D: Number>(normal: Vector<D>, roughness: D, light: Vector<D>, eye: Vector<D>) -> D {
    let half = light.unit() + eye.unit();
    let cosine = |v: Vector<D>, w: Vector<D>| v.dot(w) / (v.length() * w.length());
    let (nl, nv, nh) = (cosine(normal, light), cosine(normal, eye), cosine(normal, half));
    if nl.re() <= 0.0 || nv.re() <= 0.0 {
        return D::from(0.0);
    }
    let a = roughness.powi(2);
    let spread = nh * nh * (a * a) + (-nh * nh + 1.0);
    let shadow = |cos: D| (cos + ((cos * cos) + (a * a) * (-cos * cos + 1.0)).sqrt()).recip() * 2.0;
    let fresnel = (-cosine(eye, half) + 1.0).powi(5) * 0.1 + 0.9;
    (a / spread).powi(2) / 12.0 * nl * shadow(nl) * shadow(nv) * fresnel
}

pub(super) fn splat<D: Number>(
    mean: Vector<D>,
    scale: Vector<D>,
    q: aim_objectives::dual::Quaternion<D>,
    focal: D,
) -> [D; 3] {
    let Vector([x, y, z]) = mean;
    let mut sums = [D::from(0.3), D::from(0.0), D::from(0.3)];
    for k in 0..3 {
        let mut axis = [0.0; 3];
        axis[k] = 1.0;
        let Vector([a, b, c]) = q.turn(Vector::constant(axis)).times(scale.0[k] * focal / z);
        let (u, v) = (a - c * x / z, b - c * y / z);
        sums = [sums[0] + u * u, sums[1] + u * v, sums[2] + v * v];
    }
    sums
}

pub(super) fn lane<D: Number>(steering: [D; 4], push: [D; 4], obstacles: [[D; 3]; 2]) -> D {
    let [mut x, mut y, mut heading, mut speed] = [0.0, 0.0, 0.1, 5.0].map(D::from);
    let mut cost = D::from(0.0);
    for (steering, push) in steering.into_iter().zip(push) {
        heading += speed * steering.tan() * 0.08;
        speed += push * 0.2;
        x += speed * heading.cos() * 0.2;
        y += speed * heading.sin() * 0.2;
        cost += y.powi(2) + steering.powi(2) + push.powi(2) / 10.0;
        cost +=
            obstacles.map(|[a, b, r]| (r - ((x - a).powi(2) + (y - b).powi(2)).sqrt()).exp()).into_iter().sum::<D>();
    }
    cost
}

/// Solves for the accelerations by Cramer's rule: 2 a″ + b″ cos = …, a″ cos + b″ = ….
fn rates<D: Number>([a, b, va, vb]: [D; 4]) -> [D; 4] {
    let (sin, cos) = ((a - b).sin(), (a - b).cos());
    let (first, second) = (-sin * vb * vb - a.sin() * 19.6, sin * va * va - b.sin() * 9.8);
    let determinant = -cos * cos + 2.0;
    [va, vb, (first - second * cos) / determinant, (second * 2.0 - first * cos) / determinant]
}

pub(super) fn pendulum<D: Number>(state: [D; 4], dt: D) -> [D; 4] {
    let along = |rates: [D; 4], dt: D| core::array::from_fn(|i| state[i] + rates[i] * dt);
    let k1 = rates(state);
    let k2 = rates(along(k1, dt / 2.0));
    let k3 = rates(along(k2, dt / 2.0));
    let k4 = rates(along(k3, dt));
    core::array::from_fn(|i| state[i] + dt * (k1[i] / 6.0 + k2[i] / 3.0 + k3[i] / 3.0 + k4[i] / 6.0))
}

pub(super) fn water<D: Number>(atoms: [Vector<D>; 3], stiffness: [D; 2]) -> D {
    let (a, b) = (atoms[1] - atoms[0], atoms[2] - atoms[0]);
    let stretch = (a.length() - 0.96).powi(2) + (b.length() - 0.96).powi(2);
    let bend = (a.dot(b) / (a.length() * b.length())).acos() - 1.82;
    (stiffness[0] * stretch + stiffness[1] * bend.powi(2)) / 2.0
}

pub(super) fn charges<D: Number>(ions: [Vector<D>; 3], screening: D, charges: [D; 3]) -> D {
    let pairs = [(0, 1), (1, 2), (2, 0)].map(|(i, j)| {
        let r = (ions[i] - ions[j]).length();
        charges[i] * charges[j] / (r * (screening * r).exp())
    });
    pairs.into_iter().sum()
}

pub(super) fn orbit<D: Number>(anomaly: D, eccentricity: D) -> [D; 2] {
    let mut e = anomaly;
    for _ in 0..5 {
        let (sin, cos) = (e.sin(), e.cos());
        e = (anomaly + eccentricity * (sin - e * cos)) / (-eccentricity * cos + 1.0);
    }
    [e.cos() - eccentricity, (-eccentricity * eccentricity + 1.0).sqrt() * e.sin()]
}

pub(super) fn curve<D: Number>(points: [Vector<D>; 4], t: D) -> Vector<D> {
    let s = -t + 1.0;
    let weights = [s.powi(3), s * s * t * 3.0, s * t * t * 3.0, t.powi(3)];
    points.into_iter().zip(weights).fold(Vector::constant([0.0; 3]), |sum, (p, weight)| sum + p.times(weight))
}
