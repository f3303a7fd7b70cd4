//! Objectives of several fields in their first, unoptimised form: bundle adjustment, registration, elasticity,
//! rendering, control, molecular models and others.

mod dual;

use aim_objectives::dual::Dual64;
use aim_objectives::{At, Random, by_rows, singular};

macro_rules! objectives {
    ($module:ident: $real:ident, $vec3:ident, $quat:ident, $mat3:ident) => {
        #[aim::differentiate(check = true)]
        mod $module {
            use aim::glam::{$mat3, $quat, $vec3};

            #[derive(Clone, Copy)]
            struct Lens {
                radial: [$real; 2],
                tangential: [$real; 2],
            }

            impl Lens {
                /// Brown's model of lens distortion.
                fn distort(&self, x: $real, y: $real) -> [$real; 2] {
                    let r2 = x * x + y * y;
                    let mut radial = 1.0;
                    let mut power = 1.0;
                    for k in self.radial {
                        power *= r2;
                        radial += k * power;
                    }
                    let [p1, p2] = self.tangential;
                    [
                        x * radial + 2.0 * p1 * x * y + p2 * (r2 + 2.0 * x * x),
                        y * radial + 2.0 * p2 * x * y + p1 * (r2 + 2.0 * y * y),
                    ]
                }
            }

            const EYES: [$vec3; 2] = [<$vec3>::new(-0.1, 0.0, 0.0), <$vec3>::new(0.1, 0.02, 0.0)];

            /// Bundle adjustment: a point in both images of a stereo camera.
            #[differentiate(wrt(turn, shift, lens))]
            pub(super) fn stereo(turn: $vec3, shift: $vec3, lens: [$real; 4], point: $vec3) -> [$real; 4] {
                let [k1, k2, p1, p2] = lens;
                let lens = Lens { radial: [k1, k2], tangential: [p1, p2] };
                let seen = <$quat>::from_scaled_axis(turn) * point + shift;
                let mut pixels = [0.0; 4];
                for (i, eye) in EYES.iter().enumerate() {
                    let p = seen - *eye;
                    let [u, v] = lens.distort(p.x / p.z, p.y / p.z);
                    pixels[2 * i] = 500.0 * u + 320.0;
                    pixels[2 * i + 1] = 500.0 * v + 240.0;
                }
                pixels
            }

            /// A robust loss that saturates for distant points.
            fn robust(square: $real, width: $real) -> $real {
                square / (square + width * width)
            }

            /// Registration: two point clouds with a robust loss.
            #[differentiate(wrt(turn, shift))]
            pub(super) fn clouds(
                turn: $vec3,
                shift: $vec3,
                scan: [$vec3; 3],
                model: [$vec3; 3],
                width: $real,
            ) -> $real {
                let rotation = <$mat3>::from_quat(<$quat>::from_scaled_axis(turn));
                let terms = scan.iter().zip(model);
                terms.map(|(p, q)| robust((rotation * *p + shift - q).length_squared(), width)).sum::<$real>() / 3.0
            }

            /// Registration: an edge of a pose graph, as a rotation and a shift in the first pose's frame.
            #[differentiate(wrt(from, at, to, there))]
            pub(super) fn pose_edge(
                from: $vec3,
                at: $vec3,
                to: $vec3,
                there: $vec3,
                turn: $vec3,
                shift: $vec3,
            ) -> ($vec3, $vec3) {
                let [from, to, turn] = [from, to, turn].map(<$quat>::from_scaled_axis);
                let back = from.inverse();
                ((turn.inverse() * back * to).to_scaled_axis(), back * (there - at) - shift)
            }

            /// Elasticity: a tetrahedron of rubber that resists inversion.
            #[differentiate(wrt(corners))]
            pub(super) fn neo_hookean(corners: [$vec3; 4], rest: $mat3, mu: $real, lambda: $real) -> $real {
                let [a, b, c, d] = corners;
                let deformation = <$mat3>::from_cols(b - a, c - a, d - a) * rest;
                let mut square = 0.0;
                for axis in 0..3 {
                    square += deformation.col(axis).length_squared();
                }
                let log = deformation.determinant().ln();
                0.5 * mu * (square - 3.0) - mu * log + 0.5 * lambda * log * log
            }

            fn normal_of(a: $vec3, b: $vec3, c: $vec3) -> $vec3 {
                (b - a).cross(c - a).normalize()
            }

            /// Elasticity: two triangles of a shell, bent about their common edge.
            #[differentiate(wrt(edge, wings))]
            pub(super) fn bending(edge: [$vec3; 2], wings: [$vec3; 2], rest: $real) -> $real {
                let axis = edge[1] - edge[0];
                let (m, n) = (normal_of(edge[0], edge[1], wings[0]), normal_of(edge[1], edge[0], wings[1]));
                let angle = m.cross(n).dot(axis.normalize()).atan2(m.dot(n));
                (angle - rest).powi(2) * axis.length()
            }

            /// A smooth minimum.
            fn joined(a: $real, b: $real, width: $real) -> $real {
                let h = (width - (a - b).abs()).max(0.0) / width;
                a.min(b) - 0.25 * h * h * width
            }

            /// Rendering: the distance from limbs made of capsules, smoothly joined.
            #[differentiate(wrt(p))]
            pub(super) fn limbs(p: $vec3, joints: [$vec3; 4], radius: $real, width: $real) -> $real {
                let mut distance = <$real>::MAX;
                for bone in joints.windows(2) {
                    let (way, from) = (bone[1] - bone[0], p - bone[0]);
                    let s = (from.dot(way) / way.length_squared()).clamp(0.0, 1.0);
                    let capsule = (from - s * way).length() - radius;
                    distance = if distance == <$real>::MAX { capsule } else { joined(distance, capsule, width) };
                }
                distance
            }

            /// Rendering: the reflection of a rough metal, after Cook and Torrance.
            #[differentiate(wrt(normal, roughness))]
            pub(super) fn metal(normal: $vec3, roughness: $real, light: $vec3, eye: $vec3) -> $real {
                let (n, l, v) = (normal.normalize(), light.normalize(), eye.normalize());
                let h = (l + v).normalize();
                let (nl, nv, nh) = (n.dot(l), n.dot(v), n.dot(h));
                if nl <= 0.0 || nv <= 0.0 {
                    return 0.0;
                }
                let a2 = roughness.powi(4);
                let spread = nh * nh * (a2 - 1.0) + 1.0;
                let shadow = |cos: $real| 2.0 * cos / (cos + (a2 + (1.0 - a2) * cos * cos).sqrt());
                let fresnel = 0.9 + 0.1 * (1.0 - v.dot(h)).powi(5);
                a2 / (3.0 * spread * spread) * shadow(nl) * shadow(nv) * fresnel / (4.0 * nv)
            }

            /// Rendering: the covariance of a Gaussian splat on the screen.
            #[differentiate(wrt(mean, scale, q))]
            pub(super) fn splat(mean: $vec3, scale: $vec3, q: $quat, focal: $real) -> [$real; 3] {
                let m = <$mat3>::from_quat(q.normalize()) * <$mat3>::from_diagonal(scale);
                let covariance = m * m.transpose();
                let over = focal / mean.z;
                let u = <$vec3>::new(over, 0.0, -over * mean.x / mean.z);
                let v = <$vec3>::new(0.0, over, -over * mean.y / mean.z);
                [u.dot(covariance * u) + 0.3, u.dot(covariance * v), v.dot(covariance * v) + 0.3]
            }

            #[derive(Clone, Copy)]
            struct Car {
                x: $real,
                y: $real,
                heading: $real,
                speed: $real,
            }

            impl Car {
                fn drive(&mut self, steering: $real, push: $real) {
                    const DT: $real = 0.2;
                    self.heading += DT * self.speed * steering.tan() / 2.5;
                    self.speed += DT * push;
                    self.x += DT * self.speed * self.heading.cos();
                    self.y += DT * self.speed * self.heading.sin();
                }

                fn clearance(&self, [x, y, radius]: [$real; 3]) -> $real {
                    (self.x - x).hypot(self.y - y) - radius
                }
            }

            /// Control: the cost of keeping a car in its lane while avoiding obstacles.
            #[differentiate(wrt(steering, push))]
            pub(super) fn lane(steering: [$real; 4], push: [$real; 4], obstacles: [[$real; 3]; 2]) -> $real {
                let mut car = Car { x: 0.0, y: 0.0, heading: 0.1, speed: 5.0 };
                let mut cost = 0.0;
                for (steering, push) in steering.into_iter().zip(push) {
                    car.drive(steering, push);
                    cost += car.y * car.y + steering * steering + 0.1 * push * push;
                    for obstacle in obstacles {
                        cost += (-car.clearance(obstacle)).exp();
                    }
                }
                cost
            }

            /// Rates of change of a double pendulum's state.
            fn rates([a, b, va, vb]: [$real; 4]) -> [$real; 4] {
                let (sin, cos) = (a - b).sin_cos();
                let below = 2.0 - cos * cos;
                [
                    va,
                    vb,
                    (-9.8 * (2.0 * a.sin() - b.sin() * cos) - sin * (vb * vb + va * va * cos)) / below,
                    (2.0 * 9.8 * (a.sin() * cos - b.sin()) + sin * (2.0 * va * va + vb * vb * cos)) / below,
                ]
            }

            fn along(state: [$real; 4], rates: [$real; 4], dt: $real) -> [$real; 4] {
                let mut moved = state;
                for i in 0..4 {
                    moved[i] += dt * rates[i];
                }
                moved
            }

            /// Control: a Runge–Kutta step of a double pendulum.
            #[differentiate(wrt(state))]
            pub(super) fn pendulum(state: [$real; 4], dt: $real) -> [$real; 4] {
                let k1 = rates(state);
                let k2 = rates(along(state, k1, 0.5 * dt));
                let k3 = rates(along(state, k2, 0.5 * dt));
                let k4 = rates(along(state, k3, dt));
                core::array::from_fn(|i| state[i] + dt / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]))
            }

            /// Molecular models: the energy of a water molecule, from its bonds and the angle between them.
            #[differentiate(wrt(atoms))]
            pub(super) fn water(atoms: [$vec3; 3], stiffness: [$real; 2]) -> $real {
                let [oxygen, hydrogens @ ..] = atoms;
                let bonds = hydrogens.map(|hydrogen| hydrogen - oxygen);
                let mut energy = 0.0;
                for bond in bonds {
                    energy += 0.5 * stiffness[0] * (bond.length() - 0.96).powi(2);
                }
                energy + 0.5 * stiffness[1] * (bonds[0].angle_between(bonds[1]) - 1.82).powi(2)
            }

            /// Molecular models: charges in salt water with Debye–Hückel screening.
            #[differentiate(wrt(ions, screening))]
            pub(super) fn charges(ions: [$vec3; 3], screening: $real, charges: [$real; 3]) -> $real {
                let mut energy = 0.0;
                for i in 0..3 {
                    for j in 0..i {
                        let r = ions[i].distance(ions[j]);
                        energy += charges[i] * charges[j] * (-screening * r).exp() / r;
                    }
                }
                energy
            }

            /// Mechanics: a position on an orbit, by five Newton steps for Kepler's equation.
            #[differentiate(wrt(anomaly, eccentricity))]
            pub(super) fn orbit(anomaly: $real, eccentricity: $real) -> [$real; 2] {
                let mut e = anomaly;
                for _ in 0..5 {
                    e -= (e - eccentricity * e.sin() - anomaly) / (1.0 - eccentricity * e.cos());
                }
                [e.cos() - eccentricity, (1.0 - eccentricity * eccentricity).sqrt() * e.sin()]
            }

            /// Drawing: a point of a Bézier curve, by de Casteljau's algorithm.
            #[differentiate(wrt(points, t))]
            pub(super) fn curve(points: [$vec3; 4], t: $real) -> $vec3 {
                let mut points = points;
                let mut left = 3;
                while left > 0 {
                    for i in 0..left {
                        points[i] = points[i].lerp(points[i + 1], t);
                    }
                    left -= 1;
                }
                points[0]
            }
        }
    };
}

objectives!(single: f32, Vec3, Quat, Mat3);
objectives!(double: f64, DVec3, DQuat, DMat3);

macro_rules! check {
    ($name:ident $derived:ident: $sample:expr) => {
        At($sample).check(double::$name, double::$derived, single::$derived, dual::$name::<Dual64>);
    };
    ($name:ident by rows $derived:ident($($argument:ident),*): $sample:expr) => {
        At($sample).check(
            double::$name,
            |$($argument),*| by_rows(double::$derived($($argument),*)),
            |$($argument),*| by_rows(single::$derived($($argument),*)),
            dual::$name::<Dual64>,
        );
    };
}

fn vector(x: &[f64], place: usize) -> aim::glam::DVec3 {
    aim::glam::DVec3::from_slice(&x[place..])
}

#[test]
fn stereo_camera() {
    check!(stereo by rows stereo_jacobian(turn, shift, lens, point): |r: &mut Random| {
        let shift = [r.numbers(2, -0.5..0.5), r.numbers(1, 4.0..6.0)].concat();
        [r.vector(0.1..2.0), shift, r.numbers(4, -0.1..0.1), r.vector(0.1..1.0)].concat()
    });
}

#[test]
fn clouds_of_points() {
    check!(clouds clouds_gradient: |r: &mut Random| {
        [r.vector(0.1..2.0), r.numbers(3, -0.5..0.5), r.numbers(18, -1.0..1.0), r.numbers(1, 0.5..1.5)].concat()
    });
    // Unrotated, with each point 1 above its counterpart: ∂ρ/∂d = 2 w² d / (d² + w²)², and the derivative by the
    // rotation is the mean of p × ∂ρ/∂d.
    let scan = [[1.0, 0.0, 1.0], [0.0, 2.0, 1.0], [0.5, 0.25, 1.0]];
    let model = scan.map(|[x, y, _]| [x, y, 0.0]);
    let at = [vec![0.0; 6], scan.concat(), model.concat(), vec![1.0]].concat();
    let by_turn = |axis: usize| scan.iter().map(|p| [p[1], -p[0], 0.0][axis] * 0.5 / 3.0).sum::<f64>();
    let expected = [by_turn(0), by_turn(1), by_turn(2), 0.0, 0.0, 0.5];
    singular(&at, double::clouds, double::clouds_gradient, single::clouds_gradient, &expected);
}

#[test]
fn edge_of_a_graph_of_poses() {
    let sample = |r: &mut Random| {
        let turns = [r.vector(0.1..1.0), r.numbers(3, -1.0..1.0), r.vector(0.1..1.0), r.numbers(3, -1.0..1.0)].concat();
        [turns, r.vector(0.1..1.0), r.numbers(3, -1.0..1.0)].concat()
    };
    check!(pose_edge by rows pose_edge_jacobian(a, b, c, d, e, f): sample);
    // With everything at the origin and unrotated, the residual is 0 and its derivatives are ±1.
    let mut expected = vec![0.0; 72];
    for (variable, sign) in [(0, -1.0), (3, -1.0), (6, 1.0), (9, 1.0)] {
        for k in 0..3 {
            let output = if variable % 6 == 0 { k } else { 3 + k };
            expected[6 * (variable + k) + output] = sign;
        }
    }
    let derived = |a, b, c, d, e, f| by_rows(double::pose_edge_jacobian(a, b, c, d, e, f));
    let alone = |a, b, c, d, e, f| by_rows(single::pose_edge_jacobian(a, b, c, d, e, f));
    singular(&[0.0; 18], double::pose_edge, derived, alone, &expected);
}

#[test]
fn rubber() {
    check!(neo_hookean neo_hookean_gradient: |r: &mut Random| {
        let edge = |r: &mut Random, k: usize| {
            let mut edge = r.numbers(3, -0.2..0.2);
            edge[k] += 1.0;
            edge
        };
        let corners = [vec![0.0; 3], edge(r, 0), edge(r, 1), edge(r, 2)].concat();
        [corners, vec![1.0, 0.1, 0.0, -0.1, 0.9, 0.2, 0.0, 0.2, 1.1], r.numbers(2, 0.5..2.0)].concat()
    });
}

#[test]
fn bent_shell() {
    let sample = |r: &mut Random| {
        let edge = [r.numbers(3, -0.2..0.2), vec![1.0, 0.1, 0.0]].concat();
        let up = |r: &mut Random, y: f64| [r.numbers(1, 0.2..0.8), vec![y], r.numbers(1, -0.6..0.6)].concat();
        [edge, up(r, 1.0), up(r, -1.0), r.numbers(1, -0.5..0.5)].concat()
    };
    check!(bending bending_gradient: sample);
}

#[test]
fn melted_limbs() {
    let sample = |r: &mut Random| {
        let joints = [r.numbers(3, -0.2..0.2), vec![1.0, 0.0, 0.2], vec![1.5, 1.0, 0.0], vec![1.0, 1.5, 1.0]].concat();
        [r.numbers(3, -2.0..2.0), joints, vec![0.2, 0.5]].concat()
    };
    let keep = |x: &[f64]| {
        let capsules = [0, 1, 2].map(|i| {
            let (a, b, p) = (vector(x, 3 + 3 * i), vector(x, 6 + 3 * i), vector(x, 0));
            let s = (p - a).dot(b - a) / (b - a).length_squared();
            ((p - a - (b - a) * s.clamp(0.0, 1.0)).length(), s)
        });
        let clear = |x: f64, y: f64| (x - y).abs() > 0.01 && ((x - y).abs() - 0.5).abs() > 0.01;
        let [(a, _), (b, _), (c, _)] = capsules;
        let h = (0.5 - (a - b).abs()).max(0.0) / 0.5;
        let both = a.min(b) - 0.125 * h * h;
        clear(a, b)
            && clear(both, c)
            && capsules.iter().all(|&(d, s)| d > 0.1 && s.abs() > 0.01 && (s - 1.0).abs() > 0.01)
    };
    check!(limbs limbs_gradient: |r: &mut Random| r.until(sample, keep));
    // On a bone no direction leads away fastest: the derivative is 0.
    let on = [vec![0.5, 0.0, 0.0], vec![0.0; 3], vec![1.0, 0.0, 0.0, 9.0, 9.0, 0.0, 9.0, 0.0, 9.0], vec![0.2, 0.25]];
    singular(&on.concat(), double::limbs, double::limbs_gradient, single::limbs_gradient, &[0.0; 3]);
}

#[test]
fn rough_metal() {
    let sample =
        |r: &mut Random| [r.vector(0.5..2.0), r.numbers(1, 0.4..1.0), r.vector(0.5..2.0), r.vector(0.5..2.0)].concat();
    let keep = |x: &[f64]| {
        let [n, l, v] = [0, 4, 7].map(|place| vector(x, place).normalize());
        n.dot(l).abs() > 0.1 && n.dot(v).abs() > 0.1 && (l + v).length() > 0.5
    };
    check!(metal metal_gradient: |r: &mut Random| r.until(sample, keep));
}

#[test]
fn gaussian_splat() {
    check!(splat by rows splat_jacobian(mean, scale, q, focal): |r: &mut Random| {
        let mean = [r.numbers(2, -1.0..1.0), r.numbers(1, 2.0..4.0)].concat();
        [mean, r.numbers(3, 0.2..1.0), r.quaternion(0.5..2.0), r.numbers(1, 0.5..2.0)].concat()
    });
}

#[test]
fn car_in_its_lane() {
    check!(lane lane_gradient: |r: &mut Random| {
        [r.numbers(4, -0.4..0.4), r.numbers(4, -1.0..1.0), vec![3.0, 2.0, 0.5, 5.0, -2.0, 0.8]].concat()
    });
}

#[test]
fn double_pendulum() {
    check!(pendulum by rows pendulum_jacobian(state, dt): |r: &mut Random| [r.numbers(4, -1.0..1.0), r.numbers(1, 0.01..0.1)].concat());
}

#[test]
fn molecule_of_water() {
    let sample = |r: &mut Random| {
        let hydrogens = [vec![0.9, 0.0, 0.0], vec![-0.3, 0.9, 0.0]].concat();
        let atoms = [vec![0.0; 3], hydrogens].concat();
        let moved: Vec<f64> = atoms.into_iter().map(|x| x + r.within(-0.2..0.2)).collect();
        [moved, r.numbers(2, 0.5..2.0)].concat()
    };
    check!(water water_gradient: sample);
    // Straight, with bonds at their rest lengths: the bending direction is undefined, and the derivative is 0.
    let straight = [0.0, 0.0, 0.0, 0.96, 0.0, 0.0, -0.96, 0.0, 0.0, 1.0, 1.0];
    singular(&straight, double::water, double::water_gradient, single::water_gradient, &[0.0; 9]);
}

#[test]
fn charges_in_salt_water() {
    let sample = |r: &mut Random| [r.numbers(9, -1.5..1.5), r.numbers(1, 0.2..2.0), r.numbers(3, -1.0..1.0)].concat();
    let keep = |x: &[f64]| (0..3).all(|i| vector(x, 3 * i).distance(vector(x, 3 * ((i + 1) % 3))) > 0.6);
    check!(charges charges_gradient: |r: &mut Random| r.until(sample, keep));
}

#[test]
fn place_on_an_orbit() {
    check!(orbit orbit_jacobian: |r: &mut Random| [r.numbers(1, -3.0..3.0), r.numbers(1, 0.05..0.6)].concat());
}

#[test]
fn point_of_a_curve() {
    check!(curve curve_jacobian: |r: &mut Random| [r.numbers(12, -1.0..1.0), r.numbers(1, 0.0..1.0)].concat());
}
