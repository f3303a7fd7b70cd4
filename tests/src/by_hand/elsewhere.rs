//! Objectives of other fields: value and first derivatives as derived by hand.
//!
//! Each function takes the numbers of its statement's arguments in order
//! (`tests/objectives/tests/it/by_hand/problems.rs`) and returns the value's numbers, then those of the derivative by
//! each component of each variable. The number at the end of a comment is the number of operations.

use aim_symbolic::{Function, Number};

use super::algebra::reciprocal;

type V<T> = [T; 3];

/// Costs 3 operations.
fn add<T: Number>(v: V<T>, w: V<T>) -> V<T> {
    [v[0] + w[0], v[1] + w[1], v[2] + w[2]]
}

/// Costs 3 operations.
fn sub<T: Number>(v: V<T>, w: V<T>) -> V<T> {
    [v[0] - w[0], v[1] - w[1], v[2] - w[2]]
}

/// Costs 3 operations.
fn times<T: Number>(k: T, v: V<T>) -> V<T> {
    v.map(|c| k * c)
}

fn neg<T: Number>(v: V<T>) -> V<T> {
    v.map(|c| -c)
}

/// Costs 5 operations.
fn dot<T: Number>(v: V<T>, w: V<T>) -> T {
    v[0] * w[0] + v[1] * w[1] + v[2] * w[2]
}

/// Costs 9 operations.
fn cross<T: Number>(v: V<T>, w: V<T>) -> V<T> {
    [v[1] * w[2] - v[2] * w[1], v[2] * w[0] - v[0] * w[2], v[0] * w[1] - v[1] * w[0]]
}

fn one<T: Number>() -> T {
    T::constant(1.0)
}

fn vector<T: Number>(x: &[T]) -> V<T> {
    [x[0], x[1], x[2]]
}

/// Returns cos r, sin r / r, (1 − cos r)/r² and (r − sin r)/r³ of a rotation vector of length r: 11.
fn turn_factors<T: Number>(turn: V<T>) -> [T; 4] {
    let square = dot(turn, turn);
    let r = square.sqrt();
    let cos = r.call(Function::Cos);
    let sine = r.call(Function::Sin) / r;
    [cos, sine, (one::<T>() - cos) / square, (one::<T>() - sine) / square]
}

/// Returns a v + b (u × v) + c (u · v) u: 30.
fn about<T: Number>(u: V<T>, [a, b, c]: [T; 3], v: V<T>) -> V<T> {
    let along = c * dot(u, v);
    add(add(times(a, v), times(b, cross(u, v))), times(along, u))
}

/// Returns the rows of the matrix of [`about`]: 24 in general, 21 if c u or b u is already computed.
fn matrix_about<T: Number>(u: V<T>, a: T, aside: V<T>, along: V<T>) -> [V<T>; 3] {
    let [xx, yy, zz] = [0, 1, 2].map(|k| along[k] * u[k] + a);
    let [xy, yz, zx] = [(0, 1), (1, 2), (2, 0)].map(|(i, k)| along[i] * u[k]);
    [[xx, xy - aside[2], zx + aside[1]], [xy + aside[2], yy, yz - aside[0]], [zx - aside[1], yz + aside[0], zz]]
}

/// Costs 15 operations.
fn apply<T: Number>(rows: [V<T>; 3], v: V<T>) -> V<T> {
    rows.map(|row| dot(row, v))
}

/// Costs 15 operations.
fn apply_transposed<T: Number>(rows: [V<T>; 3], v: V<T>) -> V<T> {
    let column = |k: usize| [rows[0][k], rows[1][k], rows[2][k]];
    [0, 1, 2].map(|k| dot(column(k), v))
}

/// Bundle adjustment. The rotation is applied to three vectors and its derivative to two, so both are expanded to
/// matrices, which share (1 − cos r)/r² u. The image (x, y) is scaled equally in both directions: the residuals'
/// derivative by it is the symmetric matrix f d 1 + m (x, y)(x, y)ᵀ with m = 2 f d′, and the derivative by depth is a
/// multiple of (x, y). 186.
pub fn bundle_adjustment<T: Number>(x: &[T]) -> Vec<T> {
    let (turn, shift, [focal, k1, k2]) = (vector(x), vector(&x[3..]), vector(&x[6..]));
    let (point, seen) = (vector(&x[9..]), [x[12], x[13]]);
    let [cos, sine, versine, rest] = turn_factors(turn);
    let (once, twice) = (times(sine, turn), times(versine, turn));
    let rotation = matrix_about(turn, cos, once, twice);
    let turned = apply(rotation, point);
    let p = add(turned, shift);
    let over = -(one::<T>() / p[2]);
    let image = [p[0] * over, p[1] * over];
    let square = image[0] * image[0] + image[1] * image[1];
    let k2_square = k2 * square;
    let slope = k1 + k2_square;
    let distortion = one::<T>() + square * slope;
    let scale = focal * distortion;
    let value = [scale * image[0] - seen[0], scale * image[1] - seen[1]];

    let by_focal = image.map(|c| distortion * c);
    let focal_square = focal * square;
    let by_k1 = image.map(|c| focal_square * c);
    let by_k2 = by_k1.map(|c| square * c);
    let steepness = slope + k2_square;
    let m = (focal + focal) * steepness;
    let scaled = image.map(|c| m * c);
    let mixed = over * (scaled[0] * image[1]);
    let [xx, yy] = [0, 1].map(|k| over * (scaled[k] * image[k] + scale));
    let radial = over * (m * square + scale);
    let by_place = [[xx, mixed, radial * image[0]], [mixed, yy, radial * image[1]]];
    let rate = matrix_about(turn, sine, neg(twice), times(rest, turn));
    let by_turn = by_place.map(|g| apply(rate, cross(turned, g)));
    let by_point = by_place.map(|g| apply_transposed(rotation, g));

    let mut all = value.to_vec();
    let vectors = |by: [V<T>; 2]| (0..3).flat_map(move |k| [by[0][k], by[1][k]]);
    all.extend(vectors(by_turn).chain(vectors(by_place)));
    all.extend([by_focal, by_k1, by_k2].into_iter().flatten().chain(vectors(by_point)));
    all
}

/// Point-to-plane registration. With y = R p: ∂(n · y)/∂r = Jᵀ (y × n). 89.
pub fn point_to_plane<T: Number>(x: &[T]) -> Vec<T> {
    let (turn, shift, point, normal, offset) = (vector(x), vector(&x[3..]), vector(&x[6..]), vector(&x[9..]), x[12]);
    let [cos, sine, versine, rest] = turn_factors(turn);
    let turned = about(turn, [cos, sine, versine], point);
    let value = dot(normal, add(turned, shift)) - offset;
    let by_turn = about(turn, [sine, -versine, rest], cross(turned, normal));
    [value].into_iter().chain(by_turn).chain(normal).collect()
}

/// Returns a quaternion's u, w and 2 u/|q|², and 2/|q|²: 11.
fn quaternion<T: Number>(q: &[T]) -> (V<T>, T, V<T>, T) {
    let (u, w) = (vector(q), q[3]);
    let twice = T::constant(2.0) * reciprocal(dot(u, u) + w * w);
    (u, w, times(twice, u), twice)
}

/// An edge compared with its rest state rotated by a quaternion of any length. With m = 2/|q|² y × ȳ in the world: ∂/∂u
/// = w m + m × u and ∂/∂w = −m · u, where the factor is already part of 2 u/|q|². 84.
pub fn rigid_edge<T: Number>(x: &[T]) -> Vec<T> {
    let (u, w, u2, twice) = quaternion(x);
    let (from, to, rest, weight) = (vector(&x[4..]), vector(&x[7..]), vector(&x[10..]), x[13]);
    let t = cross(u2, rest);
    let turned = add(add(rest, times(w, t)), cross(u, t));
    let off = sub(sub(to, from), turned);
    let value = weight * dot(off, off);
    let by_to = times(weight + weight, off);
    let moment = cross(by_to, turned);
    let by_u = add(times(w * twice, moment), cross(moment, u2));
    let by_w = -dot(moment, u2);
    [value].into_iter().chain(by_u).chain([by_w]).chain(neg(by_to)).chain(by_to).collect()
}

/// A damped spring's force (k (l − l₀) + c ṙ) u. Its derivative by the position is u gᵀ + φ/l 1, by the velocity c u
/// uᵀ, which is symmetric. 63.
pub fn damped_spring<T: Number>(x: &[T]) -> Vec<T> {
    let [a, va, b, vb] = [0, 3, 6, 9].map(|i| vector(&x[i..]));
    let (stiffness, damping, rest) = (x[12], x[13], x[14]);
    let (way, speed) = (sub(b, a), sub(vb, va));
    let length = dot(way, way).sqrt();
    let r = reciprocal(length);
    let u = times(r, way);
    let rate = dot(speed, u);
    let force = stiffness * (length - rest) + damping * rate;
    let (over, damped) = (r * force, r * damping);
    let g = add(times(stiffness - over - damped * rate, u), times(damped, speed));
    let cu = times(damping, u);
    let mut all = times(force, u).to_vec();
    for (column, &g) in g.iter().enumerate() {
        all.extend((0..3).map(|row| if row == column { -(u[row] * g + over) } else { -(u[row] * g) }));
    }
    let mut by_speed = [[T::constant(0.0); 3]; 3];
    for row in 0..3 {
        for column in row..3 {
            by_speed[row][column] = -(cu[row] * u[column]);
            by_speed[column][row] = by_speed[row][column];
        }
    }
    all.extend(by_speed.into_iter().flatten());
    all
}

/// The energy k (1 + cos(n φ − φ₀)) of a dihedral angle (Blondel and Karplus, 1996). The outer forces are along the
/// normals m and l of the two planes, ∓|b₂| m/m² and |b₂| l/l²; the inner ones follow with the levers b₁ · b₂ and b₃ ·
/// b₂ over b₂². 97.
pub fn torsion<T: Number>(x: &[T]) -> Vec<T> {
    let [a, b, c, d] = [0, 3, 6, 9].map(|i| vector(&x[i..]));
    let (k, n, phase) = (x[12], x[13], x[14]);
    let [b1, b2, b3] = [sub(b, a), sub(c, b), sub(d, c)];
    let (m, l) = (cross(b1, b2), cross(b2, b3));
    let square = dot(b2, b2);
    let length = square.sqrt();
    let phi = (length * dot(b1, l)).atan2(dot(m, l));
    let angle = n * phi - phase;
    let value = k * (one::<T>() + angle.call(Function::Cos));
    let slope = length * (k * n * angle.call(Function::Sin));
    let by_a = times(slope / dot(m, m), m);
    let minus_by_d = times(slope / dot(l, l), l);
    let over = one::<T>() / square;
    let (first, last) = (over * dot(b1, b2), over * dot(b3, b2));
    let lever = add(times(first, by_a), times(last, minus_by_d));
    let by_b = neg(add(by_a, lever));
    let by_c = add(minus_by_d, lever);
    [value].into_iter().chain(by_a).chain(by_b).chain(by_c).chain(neg(minus_by_d)).collect()
}

/// ½ dᵀ S⁻¹ d + ½ ln |S| for any S. The cofactors n and ½/|S| give ½ S⁻¹ d and ½ S⁻ᵀ d, whose sum is the derivative by
/// d; the derivative by S is ½ S⁻ᵀ − ½ (S⁻ᵀ d)(S⁻¹ d)ᵀ. 112.
pub fn gaussian<T: Number>(x: &[T]) -> Vec<T> {
    let (at, mean, columns) = (vector(x), vector(&x[3..]), [6, 9, 12].map(|i| vector(&x[i..])));
    let d = sub(at, mean);
    let [c0, c1, c2] = columns;
    let normals = [cross(c1, c2), cross(c2, c0), cross(c0, c1)];
    let det = dot(c2, normals[2]);
    let half = T::constant(0.5) / det;
    let solved = times(half, apply(normals, d));
    let value = dot(d, solved) + T::constant(0.5) * det.call(Function::Ln);
    let across = times(half, apply_transposed(normals, d));
    let double = across.map(|c| c + c);
    let by_place = add(solved, across);
    let by_columns = (0..3).flat_map(|k| sub(times(half, normals[k]), times(solved[k], double)));
    [value].into_iter().chain(by_place).chain(by_columns).collect()
}

/// The barrier −w ln(s a − |d⊥|) of a cone. d⊥ = d − a u is perpendicular to u, and so is its direction e: ∂/∂d = −k (s
/// u − e). Of the derivative by u, only the part −k (s + a/|d⊥|) d⊥ across u remains. 53.
pub fn cone_barrier<T: Number>(x: &[T]) -> Vec<T> {
    let (p, apex, axis, slope, weight) = (vector(x), vector(&x[3..]), vector(&x[6..]), x[9], x[10]);
    let r = reciprocal(dot(axis, axis).sqrt());
    let u = times(r, axis);
    let d = sub(p, apex);
    let along = dot(d, u);
    let aside = sub(d, times(along, u));
    let distance = dot(aside, aside).sqrt();
    let margin = slope * along - distance;
    let value = -(weight * margin.call(Function::Ln));
    let k = weight / margin;
    let over = reciprocal(distance);
    let by_p = sub(times(k * over, aside), times(k * slope, u));
    let by_axis = times(-(r * k * (slope + along * over)), aside);
    [value].into_iter().chain(by_p).chain(neg(by_p)).chain(by_axis).chain([-(k * along)]).collect()
}

/// Registration with a robust loss, by a quaternion of any length. With q a = (n, −s), n = w a + u × a and s = u · a,
/// the point maps to (q a) q* = s u + w n + u × n, and ∂(g · q a q*)/∂q = 2 (s g + n × g, n · g). 85.
pub fn robust_registration<T: Number>(x: &[T]) -> Vec<T> {
    let (u, w, shift) = (vector(x), x[3], vector(&x[4..]));
    let (from, to, width) = (vector(&x[7..]), vector(&x[10..]), x[13]);
    let (n, s) = (add(times(w, from), cross(u, from)), dot(u, from));
    let turned = add(add(times(s, u), times(w, n)), cross(u, n));
    let off = sub(add(turned, shift), to);
    let square = dot(off, off);
    let over = reciprocal(square + width * width);
    let value = square * over;
    let g = times((over + over) * (one::<T>() - value), off);
    let twice = add(g, g);
    let by_u = add(times(s, twice), cross(n, twice));
    [value].into_iter().chain(by_u).chain([dot(n, twice)]).chain(g).collect()
}

/// Odometry. By heading, the forward component's derivative is the lateral component, and the lateral one's is minus
/// the forward component. 30.
pub fn odometry<T: Number>(x: &[T]) -> Vec<T> {
    let (sin, cos) = (x[2].call(Function::Sin), x[2].call(Function::Cos));
    let [dx, dy] = [x[3] - x[0], x[4] - x[1]];
    let [ahead, aside] = [cos * dx + sin * dy, cos * dy - sin * dx];
    let off = [ahead - x[6], aside - x[7], x[5] - x[2] - x[8]];
    let value = dot(off, off);
    let g = off.map(|c| c + c);
    let [by_x, by_y] = [cos * g[0] - sin * g[1], sin * g[0] + cos * g[1]];
    let by_heading = g[0] * aside - g[1] * ahead - g[2];
    vec![value, -by_x, -by_y, by_heading, by_x, by_y, g[2]]
}

/// Distance from a line. The parameter of the nearest point has no derivative to contribute, since the offset is
/// perpendicular to the line. 39.
pub fn line_distance<T: Number>(x: &[T]) -> Vec<T> {
    let (p, a, b) = (vector(x), vector(&x[3..]), vector(&x[6..]));
    let (off, way) = (sub(p, a), sub(b, a));
    let part = dot(off, way) / dot(way, way);
    let aside = sub(off, times(part, way));
    let distance = dot(aside, aside).sqrt();
    let by_p = times(reciprocal(distance), aside);
    let by_b = times(part, by_p);
    [distance].into_iter().chain(by_p).chain(sub(by_b, by_p)).chain(neg(by_b)).collect()
}

/// The angular acceleration −I⁻¹ (w × I w) = R g of a free rigid body, where g = (k₀ b₁ b₂, k₁ b₂ b₀, k₂ b₀ b₁) by the
/// angular velocity b = Rᵀ w in the body and k₀ = (j₁ − j₂)/j₀. With G = ∂g/∂b, the derivative by w is R G Rᵀ, and by
/// the attitude it is R (G B − A), where B and A are the matrices of b × and g ×. 204.
pub fn gyroscopic<T: Number>(x: &[T]) -> Vec<T> {
    let (q, w, j) = (&x[..4], vector(&x[4..]), vector(&x[7..]));
    let twice = [q[0], q[1], q[2]].map(|c| c + c);
    let square = |i: usize| q[i] * twice[i];
    let (xx, yy, zz) = (square(0), square(1), square(2));
    let (xy, xz, yz) = (q[0] * twice[1], q[0] * twice[2], q[1] * twice[2]);
    let [wx, wy, wz] = twice.map(|c| q[3] * c);
    let turn = [
        [one::<T>() - (yy + zz), xy + wz, xz - wy],
        [xy - wz, one::<T>() - (xx + zz), yz + wx],
        [xz + wy, yz - wx, one::<T>() - (xx + yy)],
    ];
    let b = apply(turn, w);
    let k = [(1, 2, 0), (2, 0, 1), (0, 1, 2)].map(|(i, l, own)| (j[i] - j[l]) / j[own]);
    let by_next = [k[0] * b[2], k[1] * b[0], k[2] * b[1]];
    let by_last = [k[0] * b[1], k[1] * b[2], k[2] * b[0]];
    let g = [0, 1, 2].map(|i| by_next[i] * b[(i + 1) % 3]);
    let value = apply_transposed(turn, g);
    // Column i of R G, which row i − 1 of G has as the next and row i + 1 as the last.
    let moved = [0, 1, 2].map(|i| {
        let (next, last) = ((i + 1) % 3, (i + 2) % 3);
        add(times(by_next[last], turn[last]), times(by_last[next], turn[next]))
    });
    let by_attitude = [0, 1, 2].map(|i| {
        let (next, last) = ((i + 1) % 3, (i + 2) % 3);
        let forward = sub(times(b[last], moved[next]), times(b[next], moved[last]));
        add(forward, sub(times(g[next], turn[last]), times(g[last], turn[next])))
    });
    let by_velocity = [0, 1, 2].map(|i| apply_transposed(moved, [turn[0][i], turn[1][i], turn[2][i]]));
    value.into_iter().chain(by_attitude.into_iter().chain(by_velocity).flatten()).collect()
}

/// μ tr E² + ½ λ (tr E)² of a tetrahedron, where 2 E = Fᵀ F − 1, F = D B and D are the edges. With the stress S = 2 μ E
/// + λ tr E, the energy is ½ S : E and its derivative by F is F S, by D it is F S Bᵀ. 209.
pub fn tetrahedron<T: Number>(x: &[T]) -> Vec<T> {
    let [a, b, c, d] = [0, 3, 6, 9].map(|i| vector(&x[i..]));
    let rest = [12, 15, 18].map(|i| vector(&x[i..]));
    let (mu, lambda) = (x[21], x[22]);
    let edges = [b, c, d].map(|p| sub(p, a));
    let f = rest.map(|column| apply_transposed(edges, column));
    let diagonal = f.map(|column| dot(column, column) - one::<T>());
    let aside = [dot(f[1], f[2]), dot(f[2], f[0]), dot(f[0], f[1])];
    let trace = diagonal[0] + diagonal[1] + diagonal[2];
    let pressure = T::constant(0.5) * (lambda * trace);
    let (stretch, shear) = (times(mu, diagonal).map(|c| c + pressure), times(mu, aside));
    let both = dot(shear, aside);
    let value = T::constant(0.25) * (dot(stretch, diagonal) + (both + both));
    let stress = [[stretch[0], shear[2], shear[1]], [shear[2], stretch[1], shear[0]], [shear[1], shear[0], stretch[2]]];
    let by_f = stress.map(|column| apply_transposed(f, column));
    let row = |i: usize| [rest[0][i], rest[1][i], rest[2][i]];
    let by_edges = [0, 1, 2].map(|i| apply_transposed(by_f, row(i)));
    let by_a = neg(add(add(by_edges[0], by_edges[1]), by_edges[2]));
    [value].into_iter().chain(by_a).chain(by_edges.into_iter().flatten()).collect()
}

/// The length of a Bézier curve. A point of the curve is the sum of the control points with Bernstein's weights, and
/// its derivative the difference of the directions of its two sides, which has the same weights. 291.
pub fn curve_length<T: Number>(x: &[T]) -> Vec<T> {
    let control = [0, 2, 4, 6].map(|i| [x[i], x[i + 1]]);
    let weights = |i: u8| {
        let t = f64::from(i) / 8.0;
        let rest = 1.0 - t;
        [rest * rest * rest, 3.0 * t * rest * rest, 3.0 * t * t * rest, t * t * t].map(T::constant)
    };
    let sum = |terms: [T; 4]| terms[0] + terms[1] + terms[2] + terms[3];
    let inner = (1..8)
        .map(|i| [0, 1].map(|axis| sum([0, 1, 2, 3].map(|k| weights(i)[k] * control[k][axis]))))
        .collect::<Vec<_>>();
    let points: Vec<[T; 2]> = [control[0]].into_iter().chain(inner).chain([control[3]]).collect();
    let mut lengths = Vec::new();
    let mut directions = Vec::new();
    for ends in points.windows(2) {
        let side = [ends[1][0] - ends[0][0], ends[1][1] - ends[0][1]];
        let length = (side[0] * side[0] + side[1] * side[1]).sqrt();
        lengths.push(length);
        directions.push(side.map(|c| c / length));
    }
    let mut by_control = [directions[0].map(|c| -c), [T::constant(0.0); 2], [T::constant(0.0); 2], directions[7]];
    let bends: Vec<[T; 2]> = directions.windows(2).map(|sides| [0, 1].map(|k| sides[0][k] - sides[1][k])).collect();
    for (k, by) in by_control.iter_mut().enumerate() {
        for (axis, by) in by.iter_mut().enumerate() {
            let terms = (1..8).zip(&bends).map(|(i, bend)| weights(i)[k] * bend[axis]);
            *by = match (k, terms.reduce(|a, b| a + b)) {
                (0 | 3, Some(terms)) => *by + terms,
                (_, terms) => terms.unwrap_or(*by),
            };
        }
    }
    let length = lengths.into_iter().reduce(|a, b| a + b);
    length.into_iter().chain(by_control.into_iter().flatten()).collect()
}

/// Range and bearing of a landmark from a pose in the plane; r² is computed as r times r, and likewise its reciprocal.
/// 13.
pub fn bearing_and_range<T: Number>(x: &[T]) -> Vec<T> {
    let d = [x[3] - x[0], x[4] - x[1]];
    let square = d[0] * d[0] + d[1] * d[1];
    let range = square.sqrt();
    let r = reciprocal(range);
    let bearing = d[1].atan2(d[0]) - x[2];
    let [x1, y1] = d.map(|c| r * c);
    let [x2, y2] = [x1, y1].map(|c| r * c);
    let zero = T::constant(0.0);
    vec![range, bearing, -x1, y2, -y1, -x2, zero, -one::<T>(), x1, -y2, y1, x2]
}

/// Returns the cosine between the forward direction and the vector v to the target, r = 1/|v|, and f − c v/|v|, which
/// is the gradient of the cosine by v without its factor r: 20.
fn aimed<T: Number>(v: V<T>, forward: V<T>) -> (T, T, V<T>) {
    let r = reciprocal(dot(v, v).sqrt());
    let cosine = r * dot(forward, v);
    (cosine, r, sub(forward, times(r * cosine, v)))
}

/// The aim of a joint rotated by a quaternion of any length. The target is rotated back, y = Rᵀ t, and with m = 2/|q|²
/// y × ȳ in the body ∂/∂u = w m + u × m, ∂/∂w = −m · u. 94.
pub fn aim_by_quaternion<T: Number>(x: &[T]) -> Vec<T> {
    let (u, w, u2, twice) = quaternion(x);
    let (forward, origin, target) = (vector(&x[7..]), vector(&x[13..]), vector(&x[16..]));
    let t = cross(u2, target);
    let y = add(sub(target, times(w, t)), cross(u, t));
    let (cosine, r, g) = aimed(sub(y, origin), forward);
    let moment = times(r, cross(g, y));
    let by_u = add(times(w * twice, moment), cross(u2, moment));
    [cosine].into_iter().chain(by_u).chain([-dot(moment, u2)]).collect()
}

/// The aim of a joint rotated by a rotation vector. 106.
pub fn aim_by_rotation_vector<T: Number>(x: &[T]) -> Vec<T> {
    let (turn, forward, origin, target) = (vector(x), vector(&x[6..]), vector(&x[12..]), vector(&x[15..]));
    let [cos, sine, versine, rest] = turn_factors(turn);
    let y = about(turn, [cos, -sine, versine], target);
    let (cosine, r, g) = aimed(sub(y, origin), forward);
    let by_turn = about(turn, [sine, versine, rest], times(r, cross(g, y)));
    [cosine].into_iter().chain(by_turn).collect()
}

/// Rotates a target back by heading about X, then pitch about Z. Returns sine and cosine of the pitch, the target
/// between the rotations, and after both: 12.
fn seen<T: Number>(pitch: T, heading: T, target: V<T>) -> ([T; 2], V<T>, V<T>) {
    let [sin_p, cos_p, sin_h, cos_h] =
        [(pitch, Function::Sin), (pitch, Function::Cos), (heading, Function::Sin), (heading, Function::Cos)]
            .map(|(angle, function)| angle.call(function));
    let between = [target[0], cos_h * target[1] + sin_h * target[2], cos_h * target[2] - sin_h * target[1]];
    let after = [cos_p * between[0] + sin_p * between[1], cos_p * between[1] - sin_p * between[0], between[2]];
    ([sin_p, cos_p], between, after)
}

/// Returns the moments of a covector on the target rotated back: 9.
fn moments<T: Number>([sin_p, cos_p]: [T; 2], between: V<T>, after: V<T>, g: V<T>) -> [T; 2] {
    let by_pitch = g[0] * after[1] - g[1] * after[0];
    let ahead = sin_p * g[0] + cos_p * g[1];
    [by_pitch, ahead * between[2] - g[2] * between[1]]
}

/// The aim of a joint with a telescope: the effector slides along its forward direction, by which the derivative is −r
/// (1 − c²). 55.
pub fn aim_with_telescope<T: Number>(x: &[T]) -> Vec<T> {
    let (reach, forward, origin, target) = (x[2], vector(&x[6..]), vector(&x[12..]), vector(&x[15..]));
    let (turn, between, after) = seen(x[0], x[1], target);
    let (cosine, r, g) = aimed(sub(sub(after, origin), times(reach, forward)), forward);
    let by_angles = moments(turn, between, after, g).map(|m| r * m);
    [cosine].into_iter().chain(by_angles).chain([r * (cosine * cosine - one::<T>())]).collect()
}

/// The squared chord of the aim, (f − v/|v|)² = 2 − 2 c. 49.
pub fn chord_of_aim<T: Number>(x: &[T]) -> Vec<T> {
    let (forward, origin, target) = (vector(&x[5..]), vector(&x[11..]), vector(&x[14..]));
    let (turn, between, after) = seen(x[0], x[1], target);
    let (cosine, r, g) = aimed(sub(after, origin), forward);
    let k = r + r;
    let by_angles = moments(turn, between, after, g).map(|m| -(k * m));
    [T::constant(2.0) - (cosine + cosine)].into_iter().chain(by_angles).collect()
}

/// The sine of the aim, |f × v/|v||, computed as the length of f − c v/|v|, which is available anyway. √(1 − c²) would
/// cost 3 less but has no accurate digits near 0. 54.
pub fn sine_of_aim<T: Number>(x: &[T]) -> Vec<T> {
    let (forward, origin, target) = (vector(&x[5..]), vector(&x[11..]), vector(&x[14..]));
    let (turn, between, after) = seen(x[0], x[1], target);
    let (cosine, r, g) = aimed(sub(after, origin), forward);
    let sine = dot(g, g).sqrt();
    let k = r * cosine * reciprocal(sine);
    let by_angles = moments(turn, between, after, g).map(|m| -(k * m));
    [sine].into_iter().chain(by_angles).collect()
}

/// The paper's joint, for a rotation written in components. 46.
pub fn aim_in_components<T: Number>(x: &[T]) -> Vec<T> {
    let (forward, origin, target) = (vector(&x[5..]), vector(&x[11..]), vector(&x[14..]));
    let (turn, between, after) = seen(x[0], x[1], target);
    let (cosine, r, g) = aimed(sub(after, origin), forward);
    [cosine].into_iter().chain(moments(turn, between, after, g).map(|m| r * m)).collect()
}
