//! Objectives of other fields, written as usual with loops, helpers, constants and structs.

use aim_objectives::dual::Dual64;
use aim_objectives::{Argument, At, Random, by_rows, singular};

macro_rules! objectives {
    ($module:ident: $real:ident, $vec2:ident, $vec3:ident, $vec4:ident, $quat:ident, $mat2:ident, $mat3:ident, $mat4:ident) => {
        #[aim::differentiate(check = true)]
        mod $module {
            use aim::glam::{Vec3Swizzles, $mat2, $mat3, $mat4, $quat, $vec2, $vec3, $vec4};

            /// Squared angle below which the rotation uses the first two terms of its series.
            const SMALL: $real = 1e-12;
            const PLANES: usize = 3;
            const LINKS: [[$real; 3]; 4] = [[0.0, 1.5, 0.3], [0.4, 0.0, 0.0], [0.4, -1.5, 0.05], [0.0, 1.5, 0.35]];

            fn rotated(axis_angle: $vec3, p: $vec3) -> $vec3 {
                let square = axis_angle.length_squared();
                if square < SMALL {
                    return p + axis_angle.cross(p);
                }
                let angle = square.sqrt();
                let axis = axis_angle / angle;
                let (sin, cos) = angle.sin_cos();
                p * cos + axis.cross(p) * sin + axis * axis.dot(p) * (1.0 - cos)
            }

            /// Bundle adjustment: the offset of a point's image from where it was observed.
            #[differentiate(wrt(camera, point))]
            pub(super) fn reprojection(camera: [$real; 9], point: $vec3, observed: $vec2) -> $vec2 {
                let [rx, ry, rz, tx, ty, tz, focal, k1, k2] = camera;
                let p = rotated(<$vec3>::new(rx, ry, rz), point) + <$vec3>::new(tx, ty, tz);
                let image = -p.xy() / p.z;
                let mut distortion = 1.0;
                let mut power = 1.0;
                for k in [k1, k2] {
                    power *= image.length_squared();
                    distortion += k * power;
                }
                focal * distortion * image - observed
            }

            /// Huber's loss.
            fn robust(r: $real, width: $real) -> $real {
                debug_assert!(width > 0.0, "of a width");
                let size = r.abs();
                if size <= width {
                    return 0.5 * r * r;
                }
                width * (size - 0.5 * width)
            }

            /// Registration: the distances of points from their planes.
            #[differentiate(wrt(turn, shift))]
            pub(super) fn registration(
                turn: $vec3,
                shift: $vec3,
                points: &[$vec3; PLANES],
                planes: &[($vec3, $real); PLANES],
                width: $real,
            ) -> $real {
                let mut sum = 0.0;
                for (point, (normal, offset)) in points.iter().zip(planes) {
                    sum += robust(normal.dot(rotated(turn, *point) + shift) - offset, width);
                }
                sum
            }

            #[derive(Clone, Copy, Debug)]
            pub(super) struct Material {
                pub(super) mu: $real,
                pub(super) lambda: $real,
            }

            impl Material {
                /// The Saint-Venant–Kirchhoff energy of a deformation gradient.
                fn energy(&self, deformation: $mat3) -> $real {
                    let strain = (deformation.transpose() * deformation - <$mat3>::IDENTITY) * 0.5;
                    let (mut square, mut trace) = (0.0, 0.0);
                    for i in 0..3 {
                        trace += strain.col(i)[i];
                        for j in 0..3 {
                            square += strain.col(i)[j].powi(2);
                        }
                    }
                    self.mu * square + 0.5 * self.lambda * trace * trace
                }
            }

            /// Elasticity: the energy of a tetrahedron.
            #[differentiate(wrt(corners))]
            pub(super) fn elastic(corners: [$vec3; 4], rest: $mat3, material: &Material) -> $real {
                let [origin, edges @ ..] = corners;
                let edges = edges.map(|corner| corner - origin);
                material.energy(<$mat3>::from_cols(edges[0], edges[1], edges[2]) * rest.inverse()) / 6.0
            }

            #[derive(Clone, Copy)]
            struct Light {
                direction: $vec3,
                strength: $real,
            }

            const LIGHTS: [Light; 2] = [
                Light { direction: <$vec3>::new(0.6, 0.0, 0.8), strength: 1.5 },
                Light { direction: <$vec3>::new(0.0, 0.6, 0.8), strength: 0.75 },
            ];

            /// Rendering: the light from a glossy surface towards the eye, and its specular part.
            #[differentiate(wrt(normal, shininess))]
            pub(super) fn shading(normal: $vec3, shininess: $real, eye: $vec3) -> ($real, $real) {
                let n = normal.normalize();
                let mut total = 0.05;
                let mut gloss = 0.0;
                for light in &LIGHTS {
                    let facing = n.dot(light.direction);
                    if facing <= 0.0 {
                        continue;
                    }
                    total += light.strength * facing;
                    let half = (light.direction + eye.normalize()).normalize();
                    gloss += light.strength * n.dot(half).max(1e-3).powf(shininess);
                }
                (total + gloss, gloss)
            }

            #[derive(Clone, Copy)]
            struct State {
                place: $real,
                speed: $real,
                angle: $real,
                rate: $real,
            }

            impl State {
                const REST: Self = Self { place: 0.0, speed: 0.0, angle: 0.1, rate: 0.0 };

                fn step(mut self, force: $real, dt: $real) -> Self {
                    let (sin, cos) = self.angle.sin_cos();
                    let pull = force + 0.2 * self.rate * self.rate * sin;
                    let turn = (9.8 * sin - cos * pull / 1.2) / (1.0 - cos * cos / 6.0);
                    self.rate += dt * turn;
                    self.speed += dt * (pull - 0.2 * turn * cos) / 1.2;
                    self.angle += dt * self.rate;
                    self.place += dt * self.speed;
                    self
                }
            }

            /// Control: the cost of driving a pole on a cart with a bounded force.
            #[differentiate(wrt(forces))]
            pub(super) fn cart_pole(forces: [$real; 4], most: $real) -> $real {
                let mut state = State::REST;
                let mut cost = 0.0;
                for force in forces {
                    state = state.step(most * (force / most).tanh(), 0.05);
                    cost += 0.01 * force * force + state.angle.powi(2) + 0.1 * state.place.powi(2);
                }
                cost + 10.0 * state.rate * state.rate
            }

            /// Molecular dynamics: the Lennard-Jones energy of pairs, smoothly cut off.
            #[differentiate(wrt(atoms))]
            pub(super) fn lennard_jones(atoms: [$vec3; 4], cutoff: $real) -> $real {
                let mut energy = 0.0;
                for i in 0..atoms.len() {
                    for j in (i + 1)..atoms.len() {
                        let r2 = atoms[i].distance_squared(atoms[j]);
                        if r2 >= cutoff * cutoff {
                            continue;
                        }
                        let s6 = r2.powi(-3);
                        let switch = 1.0 - r2 / (cutoff * cutoff);
                        energy += 4.0 * (s6 * s6 - s6) * switch * switch;
                    }
                }
                energy
            }

            /// Molecular mechanics: a dihedral's torsion, with a term for each multiplicity.
            #[differentiate(wrt(atoms))]
            pub(super) fn torsion(atoms: [$vec3; 4], barriers: [$real; 3], trans: bool) -> $real {
                let bonds: [$vec3; 3] = [atoms[1] - atoms[0], atoms[2] - atoms[1], atoms[3] - atoms[2]];
                let (m, n) = (bonds[0].cross(bonds[1]), bonds[1].cross(bonds[2]));
                let phi = (bonds[0].dot(n) * bonds[1].length()).atan2(m.dot(n));
                let mut energy = 0.0;
                for (i, barrier) in barriers.iter().enumerate() {
                    let multiplicity = (i + 1) as $real;
                    let sign = if trans && i % 2 == 0 { -1.0 } else { 1.0 };
                    energy += 0.5 * barrier * (1.0 + sign * (multiplicity * phi).cos());
                }
                energy
            }

            /// Robotics: the position and orientation of a tool.
            #[differentiate(wrt(angles))]
            pub(super) fn arm(angles: [$real; 4], tool: $vec3) -> ($vec3, $quat) {
                let mut turn = <$quat>::IDENTITY;
                let mut place = <$vec3>::ZERO;
                for (angle, [length, twist, offset]) in angles.into_iter().zip(LINKS) {
                    turn *= <$quat>::from_rotation_z(angle);
                    place += turn * <$vec3>::new(length, 0.0, offset);
                    turn *= <$quat>::from_rotation_x(twist);
                }
                (place + turn * tool, turn)
            }

            /// Learning: two layers of a perceptron.
            #[differentiate(wrt(weights, bias))]
            pub(super) fn perceptron(weights: [[$real; 2]; 3], bias: [$real; 3], input: [$real; 2]) -> [$real; 2] {
                let mut hidden = [0.0; 3];
                for i in 0..3 {
                    let mut sum = bias[i];
                    for j in 0..2 {
                        sum += weights[i][j] * input[j];
                    }
                    hidden[i] = sum.tanh();
                }
                [hidden.iter().sum(), hidden.iter().map(|h| h * h).fold(0.5, |a, b| a - b)]
            }

            /// Planning: a path that keeps clear of the nearest beacons; `kind` selects the distance measure.
            #[differentiate(wrt(way))]
            pub(super) fn clearance(way: [$vec2; 3], beacons: [($vec2, $real); 2], kind: u8) -> $real {
                let mut cost = 0.0;
                for leg in way.windows(2) {
                    cost += (leg[1] - leg[0]).length_squared();
                }
                for p in way {
                    let mut nearest = <$real>::INFINITY;
                    for (centre, radius) in beacons {
                        nearest = nearest.min(p.distance(centre) - radius);
                    }
                    cost += match kind {
                        0 => (-nearest).exp(),
                        1 if nearest > 1.0 => 0.0,
                        1 | 2 => (nearest - 1.0).powi(2),
                        _ => -nearest,
                    };
                }
                cost
            }

            /// Rendering: the projected point of a rotated and scaled object, shifted on the screen.
            #[differentiate(wrt(angle, shift, focal))]
            pub(super) fn pictured(angle: $real, shift: $vec3, focal: $real, roll: $real, p: $vec3) -> $vec2 {
                let model = <$mat4>::from_scale_rotation_translation(
                    <$vec3>::new(1.0, 0.5, 2.0),
                    <$quat>::from_rotation_y(angle),
                    shift,
                );
                let mut projection = <$mat4>::from_diagonal(<$vec4>::new(focal, focal, 1.0, 0.0));
                projection.z_axis.w = -1.0;
                let image = (projection * model).project_point3(p);
                <$mat2>::from_angle(roll).inverse() * <$vec2>::new(image.x, image.y)
            }

            /// Animation: an angle wrapped to one turn, and interpolated orientations.
            #[differentiate(wrt(from, to, s))]
            pub(super) fn between(from: $quat, to: $quat, s: $real, p: $vec3, turns: $real) -> $vec3 {
                let wound = (turns % 1.0 + turns.rem_euclid(1.0)) * s;
                from.normalize().slerp(to.normalize(), s) * p.clamp_length(0.5, 1.5) + <$vec3>::splat(wound).zyx()
            }
        }
    };
}

objectives!(single: f32, Vec2, Vec3, Vec4, Quat, Mat2, Mat3, Mat4);
objectives!(double: f64, DVec2, DVec3, DVec4, DQuat, DMat2, DMat3, DMat4);

/// Reads the two parameters of a material.
impl Argument<f64> for single::Material {
    fn read(numbers: &mut impl Iterator<Item = f64>) -> Self {
        Self { mu: f32::read(numbers), lambda: f32::read(numbers) }
    }
}

impl Argument<f64> for double::Material {
    fn read(numbers: &mut impl Iterator<Item = f64>) -> Self {
        Self { mu: f64::read(numbers), lambda: f64::read(numbers) }
    }
}

/// The same functions by other formulas, with dual numbers.
mod dual {
    use aim_objectives::dual::{Number, Quaternion, Vector};

    fn rotated<D: Number>(turn: Vector<D>, p: Vector<D>) -> Vector<D> {
        p.about_axis(turn.unit(), turn.length())
    }

    pub(super) fn reprojection<D: Number>(camera: [D; 9], point: Vector<D>, observed: [D; 2]) -> [D; 2] {
        let [rx, ry, rz, tx, ty, tz, focal, k1, k2] = camera;
        let Vector([x, y, z]) = rotated(Vector([rx, ry, rz]), point) + Vector([tx, ty, tz]);
        let r2 = (x * x + y * y) / (z * z);
        let scale = -focal * (r2 * (k2 * r2 + k1) + 1.0) / z;
        [scale * x - observed[0], scale * y - observed[1]]
    }

    pub(super) fn registration<D: Number>(
        turn: Vector<D>,
        shift: Vector<D>,
        points: [Vector<D>; 3],
        planes: [[D; 4]; 3],
        width: D,
    ) -> D {
        let term = |(point, [x, y, z, offset]): (Vector<D>, [D; 4])| {
            let r = Vector([x, y, z]).dot(rotated(turn, point) + shift) - offset;
            let inside = if r.re().abs() <= width.re() { r } else { width * r.re().signum() };
            inside * r - inside * inside / 2.0
        };
        points.into_iter().zip(planes).map(term).sum()
    }

    pub(super) fn elastic<D: Number>(corners: [Vector<D>; 4], rest: [Vector<D>; 3], mu: D, lambda: D) -> D {
        let [a, b, c] = rest;
        let volume = a.dot(b.cross(c));
        let rows = [b.cross(c), c.cross(a), a.cross(b)];
        // The images of the axes, and their pairwise products.
        let images: [Vector<D>; 3] = core::array::from_fn(|k| {
            (0..3).fold(Vector::constant([0.0; 3]), |sum, i| {
                sum + (corners[i + 1] - corners[0]).times(rows[i].0[k] / volume)
            })
        });
        let (mut trace, mut square) = (D::from(-3.0), D::from(3.0));
        for x in images {
            trace += x.dot(x);
            square -= x.dot(x) * 2.0;
            square += images.into_iter().map(|y| x.dot(y).powi(2)).sum::<D>();
        }
        (mu * square / 4.0 + lambda * trace.powi(2) / 8.0) / 6.0
    }

    pub(super) fn shading<D: Number>(normal: Vector<D>, shininess: D, eye: Vector<D>) -> [D; 2] {
        let lights = [([0.6, 0.0, 0.8], 1.5), ([0.0, 0.6, 0.8], 0.75)];
        let (mut total, mut gloss) = (D::from(0.05), D::from(0.0));
        for (direction, strength) in lights {
            let direction = Vector::constant(direction);
            let facing = normal.dot(direction) / normal.length();
            if facing.re() > 0.0 {
                let half = direction.times(eye.length()) + eye;
                let cosine = normal.dot(half) / (normal.length() * half.length());
                let cosine = if cosine.re() > 1e-3 { cosine } else { D::from(1e-3) };
                total += facing * strength;
                gloss += (cosine.ln() * shininess).exp() * strength;
            }
        }
        [total + gloss, gloss]
    }

    pub(super) fn cart_pole<D: Number>(forces: [D; 4], most: D) -> D {
        let [mut place, mut speed, mut angle, mut rate] = [0.0, 0.0, 0.1, 0.0].map(D::from);
        let mut cost = D::from(0.0);
        for force in forces {
            let e = (force * 2.0 / most).exp();
            let bounded = most * (e - 1.0) / (e + 1.0);
            // Both accelerations, for the masses 1 and 0.2 and length 1.
            let (sin, cos) = (angle.sin(), angle.cos());
            let pull = bounded + rate * rate * sin * 0.2;
            let turn = (sin * 11.76 - cos * pull) / (-cos * cos * 0.2 + 1.2);
            let push = (pull - cos * turn * 0.2) / 1.2;
            rate += turn * 0.05;
            speed += push * 0.05;
            angle += rate * 0.05;
            place += speed * 0.05;
            cost += force.powi(2) * 0.01 + angle * angle + place * place * 0.1;
        }
        cost + rate.powi(2) * 10.0
    }

    pub(super) fn lennard_jones<D: Number>(atoms: [Vector<D>; 4], cutoff: D) -> D {
        let mut energy = D::from(0.0);
        for (i, a) in atoms.into_iter().enumerate() {
            for b in atoms.into_iter().take(i) {
                let r = (a - b).length();
                if r.re() < cutoff.re() {
                    let switch = (cutoff - r) * (cutoff + r) / cutoff.powi(2);
                    energy += (r.powi(-12) - r.powi(-6)) * switch.powi(2) * 4.0;
                }
            }
        }
        energy
    }

    pub(super) fn torsion<D: Number>(atoms: [Vector<D>; 4], barriers: [D; 3], trans: D) -> D {
        let [a, b, c, d] = atoms;
        let (m, n) = ((a - b).cross(c - b), (b - c).cross(d - c));
        let cosine = m.dot(n) / (m.length() * n.length());
        let sign = if trans.re() > 0.0 { -1.0 } else { 1.0 };
        let [one, two, three] = barriers;
        let chebyshev = [cosine * sign, cosine.powi(2) * 2.0 - 1.0, (cosine.powi(3) * 4.0 - cosine * 3.0) * sign];
        let terms = [one, two, three].into_iter().zip(chebyshev);
        terms.map(|(barrier, cosine)| barrier * (cosine + 1.0) / 2.0).sum()
    }

    pub(super) fn arm<D: Number>(angles: [D; 4], tool: Vector<D>) -> [D; 7] {
        let links = [[0.0, 1.5, 0.3], [0.4, 0.0, 0.0], [0.4, -1.5, 0.05], [0.0, 1.5, 0.35]];
        let (mut point, mut turn) = (tool, [0.0, 0.0, 0.0, 1.0].map(D::from));
        // From the tool inward.
        for (angle, [length, twist, offset]) in angles.into_iter().zip(links).rev() {
            point = point.about(0, D::from(twist)) + Vector::constant([length, 0.0, offset]);
            point = point.about(2, angle);
            let (half, twist) = (angle / 2.0, D::from(twist) / 2.0);
            let [x, y, z, w] = turn;
            let (sin, cos) = (twist.sin(), twist.cos());
            let [x, y, z, w] = [cos * x + sin * w, cos * y - sin * z, cos * z + sin * y, cos * w - sin * x];
            let (sin, cos) = (half.sin(), half.cos());
            turn = [cos * x - sin * y, cos * y + sin * x, cos * z + sin * w, cos * w - sin * z];
        }
        let (Vector([px, py, pz]), [x, y, z, w]) = (point, turn);
        [px, py, pz, x, y, z, w]
    }

    pub(super) fn perceptron<D: Number>(weights: [[D; 2]; 3], bias: [D; 3], input: [D; 2]) -> [D; 2] {
        let (mut sum, mut rest) = (D::from(0.0), D::from(0.5));
        for ([a, b], bias) in weights.into_iter().zip(bias) {
            let hidden = (a * input[0] + b * input[1] + bias).tanh();
            sum += hidden;
            rest -= hidden.powi(2);
        }
        [sum, rest]
    }

    pub(super) fn clearance<D: Number>(way: [[D; 2]; 3], beacons: [[D; 3]; 2], kind: D) -> D {
        let square = |[x, y]: [D; 2]| x * x + y * y;
        let mut cost = square([way[1][0] - way[0][0], way[1][1] - way[0][1]]);
        cost += square([way[2][0] - way[1][0], way[2][1] - way[1][1]]);
        for [x, y] in way {
            let [a, b] = beacons.map(|[cx, cy, radius]| square([x - cx, y - cy]).sqrt() - radius);
            let nearest = if a.re() < b.re() { a } else { b };
            let kind = kind.re();
            cost += if kind < 1.0 {
                nearest.exp().recip()
            } else if kind < 3.0 {
                if kind < 2.0 && nearest.re() > 1.0 { D::from(0.0) } else { (nearest - 1.0).powi(2) }
            } else {
                -nearest
            };
        }
        cost
    }

    pub(super) fn pictured<D: Number>(angle: D, shift: Vector<D>, focal: D, roll: D, p: Vector<D>) -> [D; 2] {
        let Vector([x, y, z]) = p;
        let Vector([x, y, z]) = Vector([x, y * 0.5, z * 2.0]).about(1, angle) + shift;
        let Vector([x, y, _]) = Vector([-focal * x / z, -focal * y / z, z]).about(2, -roll);
        [x, y]
    }

    pub(super) fn between<D: Number>(
        from: Quaternion<D>,
        to: Quaternion<D>,
        s: D,
        p: Vector<D>,
        turns: D,
    ) -> Vector<D> {
        let unit = |Quaternion([x, y, z, w]): Quaternion<D>| {
            let length = (x * x + y * y + z * z + w * w).sqrt();
            (Vector([x, y, z]).times(length.recip()), w / length)
        };
        let ((u, w), (v, c)) = (unit(from), unit(to));
        // The rotation from one to the other, the short way.
        let (axis, cosine) = (v.times(w) - u.times(c) - u.cross(v), w * c + u.dot(v));
        let (axis, cosine) = if cosine.re() < 0.0 { (-axis, -cosine) } else { (axis, cosine) };
        let angle = axis.length().atan2(cosine) * 2.0;
        let length = p.length();
        let p = if length.re() > 1.5 { p.unit().times(D::from(1.5)) } else { p };
        let p = if length.re() < 0.5 { p.unit().times(D::from(0.5)) } else { p };
        let turns = turns.re();
        let wound = s * ((turns - turns.trunc()) + (turns - turns.floor()));
        from.turn(p.about_axis(axis.unit(), angle * s)) + Vector([wound; 3])
    }
}

#[test]
fn bundle_adjustment() {
    let sample = |r: &mut Random| {
        let pose = [r.vector(0.1..2.0), r.numbers(2, -0.5..0.5), r.numbers(1, -6.0..-4.0)].concat();
        [pose, r.numbers(1, 0.5..2.0), r.numbers(2, -0.1..0.1), r.vector(0.1..1.0), r.numbers(2, -1.0..1.0)].concat()
    };
    At(sample).check(
        double::reprojection,
        double::reprojection_jacobian,
        single::reprojection_jacobian,
        dual::reprojection::<Dual64>,
    );
}

#[test]
fn point_to_plane_registration() {
    let sample = |r: &mut Random| {
        let mut point = [r.vector(0.1..2.0), r.numbers(3, -0.5..0.5), r.numbers(9, -1.0..1.0)].concat();
        for _ in 0..3 {
            point.extend([r.vector(1.0..1.001), r.numbers(1, -1.0..1.0)].concat());
        }
        [point, vec![0.5]].concat()
    };
    // Keep away from the kinks of the robust loss.
    let keep = |x: &[f64]| {
        let vector = |k: usize| aim::glam::DVec3::from_slice(&x[k..]);
        let turn = aim::glam::DQuat::from_scaled_axis(vector(0));
        (0..3).all(|i| {
            let r = vector(15 + 4 * i).dot(turn * vector(6 + 3 * i) + vector(3)) - x[18 + 4 * i];
            (r.abs() - 0.5).abs() > 0.02
        })
    };
    type Planes<V, S> = [(V, S); 3];
    let jacobian = |t, s, p: [_; 3], q: Planes<_, _>, w| double::registration_gradient(t, s, &p, &q, w);
    let single = |t, s, p: [_; 3], q: Planes<_, _>, w| single::registration_gradient(t, s, &p, &q, w);
    let function = |t, s, p: [_; 3], q: Planes<_, _>, w| double::registration(t, s, &p, &q, w);
    At(|r: &mut Random| r.until(sample, keep)).check(function, jacobian, single, dual::registration::<Dual64>);
    // Unrotated: the derivative by the rotation is point × normal, by the shift the normal, both times the distance.
    let [x, y, z, d] = [0.25, -0.5, 0.75, 0.125];
    let still = [[0.0; 6].to_vec(), vec![x, y, z], vec![0.0; 6], vec![0.0, 0.0, 1.0, z - d], vec![0.0; 8], vec![1.0]];
    singular(&still.concat(), function, jacobian, single, &[y * d, -x * d, 0.0, 0.0, 0.0, d]);
}

#[test]
fn elastic_tetrahedron() {
    let sample = |r: &mut Random| {
        let corners = [r.numbers(3, -0.2..0.2), r.vector(0.8..1.2), r.vector(0.8..1.2), r.vector(0.8..1.2)].concat();
        let rest = [1.0, 0.1, 0.0, -0.1, 0.9, 0.2, 0.0, 0.2, 1.1];
        [corners, rest.to_vec(), r.numbers(2, 0.5..2.0)].concat()
    };
    At(sample).check(
        |c, r, m: double::Material| double::elastic(c, r, &m),
        |c, r, m: double::Material| double::elastic_gradient(c, r, &m),
        |c, r, m: single::Material| single::elastic_gradient(c, r, &m),
        dual::elastic::<Dual64>,
    );
}

#[test]
fn glossy_shading() {
    let sample = |r: &mut Random| [r.vector(0.5..2.0), r.numbers(1, 1.0..8.0), r.vector(0.5..2.0)].concat();
    let keep = |x: &[f64]| {
        let unit = |v: &[f64]| aim::glam::DVec3::from_slice(v).normalize();
        let (n, eye) = (unit(x), unit(&x[4..]));
        [[0.6, 0.0, 0.8], [0.0, 0.6, 0.8]].into_iter().map(aim::glam::DVec3::from).all(|light| {
            let half = light + eye;
            n.dot(light).abs() > 0.05 && half.length() > 0.3 && n.dot(half.normalize()) > 0.05
        })
    };
    At(|r: &mut Random| r.until(sample, keep)).check(
        double::shading,
        |n, s, e| by_rows(double::shading_jacobian(n, s, e)),
        |n, s, e| by_rows(single::shading_jacobian(n, s, e)),
        dual::shading::<Dual64>,
    );
}

#[test]
fn pole_on_a_cart() {
    let sample = |r: &mut Random| [r.numbers(4, -2.0..2.0), r.numbers(1, 1.0..3.0)].concat();
    At(sample).check(
        double::cart_pole,
        double::cart_pole_gradient,
        single::cart_pole_gradient,
        dual::cart_pole::<Dual64>,
    );
}

#[test]
fn atoms_with_a_cutoff() {
    let sample = |r: &mut Random| [r.numbers(12, -1.5..1.5), vec![2.0]].concat();
    let keep = |x: &[f64]| {
        let distance = |i: usize, j: usize| (0..3).map(|k| (x[3 * i + k] - x[3 * j + k]).powi(2)).sum::<f64>().sqrt();
        (0..4).all(|i| (0..i).all(|j| distance(i, j) > 0.9 && (distance(i, j) - 2.0).abs() > 0.01))
    };
    At(|r: &mut Random| r.until(sample, keep)).check(
        double::lennard_jones,
        double::lennard_jones_gradient,
        single::lennard_jones_gradient,
        dual::lennard_jones::<Dual64>,
    );
}

#[test]
fn torsion_of_a_dihedral() {
    let sample = |r: &mut Random| [r.numbers(12, -1.0..1.0), r.numbers(3, 0.5..2.0), vec![r.sign()]].concat();
    let keep = |x: &[f64]| {
        let [a, b, c, d] = [0, 3, 6, 9].map(|k| aim::glam::DVec3::from_slice(&x[k..]));
        let (m, n) = ((a - b).cross(c - b), (b - c).cross(d - c));
        m.length() > 0.4 && n.length() > 0.4 && (c - b).length() > 0.3
    };
    At(|r: &mut Random| r.until(sample, keep)).check(
        double::torsion,
        double::torsion_gradient,
        single::torsion_gradient,
        dual::torsion::<Dual64>,
    );
}

#[test]
fn reach_of_an_arm() {
    let sample = |r: &mut Random| [r.numbers(4, -2.0..2.0), r.vector(0.0..0.5)].concat();
    At(sample).check(
        double::arm,
        |a, t| by_rows(double::arm_jacobian(a, t)),
        |a, t| by_rows(single::arm_jacobian(a, t)),
        dual::arm::<Dual64>,
    );
}

#[test]
fn two_layers() {
    At(|r: &mut Random| r.numbers(11, -1.0..1.0)).check(
        double::perceptron,
        |w, b, i| by_rows(double::perceptron_jacobian(w, b, i)),
        |w, b, i| by_rows(single::perceptron_jacobian(w, b, i)),
        dual::perceptron::<Dual64>,
    );
}

#[test]
fn way_through_beacons() {
    let sample = |r: &mut Random| {
        let kind = r.within(0.0..4.0).floor();
        [r.numbers(6, -2.0..2.0), r.numbers(2, -2.0..2.0), vec![0.3], r.numbers(2, -2.0..2.0), vec![0.5, kind]].concat()
    };
    let keep = |x: &[f64]| {
        let from = |p: &[f64], c: &[f64]| (p[0] - c[0]).hypot(p[1] - c[1]) - c[2];
        x[..6].chunks(2).all(|p| {
            let [a, b] = [from(p, &x[6..]), from(p, &x[9..])];
            (a - b).abs() > 0.02 && (a.min(b) - 1.0).abs() > 0.02 && a > -0.1 && b > -0.3
        })
    };
    At(|r: &mut Random| r.until(sample, keep)).check(
        double::clearance,
        double::clearance_gradient,
        single::clearance_gradient,
        dual::clearance::<Dual64>,
    );
}

#[test]
fn picture_of_a_projection() {
    let sample = |r: &mut Random| {
        let shift = [r.numbers(2, -1.0..1.0), r.numbers(1, -6.0..-4.0)].concat();
        [r.numbers(1, -2.0..2.0), shift, r.numbers(1, 0.5..2.0), r.numbers(1, -2.0..2.0), r.vector(0.0..1.0)].concat()
    };
    At(sample).check(double::pictured, double::pictured_jacobian, single::pictured_jacobian, dual::pictured::<Dual64>);
}

#[test]
fn orientations_in_between() {
    let sample = |r: &mut Random| {
        let ends = [r.quaternion(0.5..1.5), r.quaternion(0.5..1.5), r.numbers(1, 0.1..0.9)].concat();
        [ends, r.vector(0.2..2.0), r.numbers(1, -3.0..3.0)].concat()
    };
    let keep = |x: &[f64]| {
        let [a, b] = [0, 4].map(|k| aim::glam::DQuat::from_slice(&x[k..]).normalize());
        (0.1..0.999).contains(&a.dot(b).abs())
    };
    At(|r: &mut Random| r.until(sample, keep)).check(
        double::between,
        double::between_jacobian,
        single::between_jacobian,
        dual::between::<Dual64>,
    );
    // The same orientation at both ends, half-way between them: a change e of an end's vector part moves p = X by e ×
    // X, and a change of its length does not move it.
    let same = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.5, 1.0, 0.0, 0.0, 0.0];
    let by_end = |x: f64, y: f64, z: f64| [0.0 * x, z, -y];
    let end = [by_end(1.0, 0.0, 0.0), by_end(0.0, 1.0, 0.0), by_end(0.0, 0.0, 1.0), [0.0; 3]].concat();
    let expected = [end.clone(), end, vec![0.0; 3]].concat();
    singular(&same, double::between, double::between_jacobian, single::between_jacobian, &expected);
}
