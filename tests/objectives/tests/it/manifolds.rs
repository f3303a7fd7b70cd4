//! Rotations and transforms that vary on their manifold: derivatives by left and right tangents.
//!
//! The first argument of the compared functions is a step. It is 0, and perturbs the rotation for the differences and
//! dual numbers.

use aim::glam::{DMat3, DQuat, DVec3, Mat3, Quat, Vec3};
use aim::{DRigid, Rigid};
use aim_objectives::dual::{Dual64, Frame, Number, Quaternion, Vector};
use aim_objectives::{At, Random, by_rows};

macro_rules! objectives {
    ($module:ident: $real:ident, $vec2:ident, $vec3:ident, $quat:ident, $mat3:ident, $rigid:ident) => {
        #[aim::differentiate(check = true)]
        mod $module {
            use aim::glam::{$mat3, $quat, $vec2, $vec3};
            use aim::$rigid;

            /// As-rigid-as-possible deformation: an edge against its rest state, rotated with its vertex.
            #[differentiate(wrt(tangent(turn), from, to), budget = 79)]
            pub(super) fn arap_edge(turn: $quat, from: $vec3, to: $vec3, rest: $vec3, weight: $real) -> $real {
                weight * (to - from - turn * rest).length_squared()
            }

            /// As [`arap_edge`], with the rotation's step on the left.
            #[differentiate(wrt(tangent(turn), from, to), perturbation = left, budget = 55)]
            pub(super) fn arap_edge_left(turn: $quat, from: $vec3, to: $vec3, rest: $vec3, weight: $real) -> $real {
                arap_edge(turn, from, to, rest, weight)
            }

            /// The aim of an eye whose joint rotates freely.
            #[differentiate(wrt(tangent(turn)), hessian, budget = 65)]
            pub(super) fn aim(turn: $quat, eye: $rigid, target: $vec3) -> $real {
                let to_target = target - turn * <$vec3>::from(eye.translation);
                (turn * <$vec3>::from(eye.matrix3.y_axis)).dot(to_target.normalize())
            }

            #[derive(Clone, Copy, Debug)]
            pub(super) struct Pose {
                pub(super) rotation: $quat,
                pub(super) position: $vec3,
            }

            impl Pose {
                fn to_local(self, point: $vec3) -> $vec3 {
                    self.rotation.conjugate() * (point - self.position)
                }
            }

            /// The image of a point in a camera.
            #[differentiate(wrt(tangent(camera), point), jvp, vjp, gauss_newton, budget = 76)]
            pub(super) fn reprojection(camera: Pose, point: $vec3, focal: $real) -> [$real; 2] {
                let local = camera.to_local(point);
                let image = <$vec2>::new(local.x, local.y) * (focal / local.z);
                [image.x, image.y]
            }

            /// A pose graph's edge: the relative pose minus the measured one.
            #[differentiate(wrt(tangent(a), tangent(b)), perturbation = left)]
            pub(super) fn relative(a: Pose, b: Pose, measured: &Pose) -> ([$real; 3], $vec3) {
                let turned = measured.rotation.conjugate() * a.rotation.conjugate() * b.rotation;
                (<$vec3>::to_array(&turned.xyz()), a.to_local(b.position) - measured.position)
            }

            /// Registration: the distance of a point of one scan from a plane of the other.
            #[differentiate(wrt(tangent(pose)), gauss_newton, budget = 48)]
            pub(super) fn to_plane(pose: &$rigid, point: $vec3, normal: $vec3, offset: $real) -> $real {
                normal.dot(pose.transform_point3(point)) - offset
            }

            /// As [`to_plane`], with the step on the left.
            #[differentiate(wrt(tangent(pose)), perturbation = left, budget = 48)]
            pub(super) fn to_plane_left(pose: &$rigid, point: $vec3, normal: $vec3, offset: $real) -> $real {
                to_plane(pose, point, normal, offset)
            }

            /// Attitude: the error of measured directions, by the rotation's matrix.
            #[differentiate(wrt(tangent(m)), jvp, vjp)]
            pub(super) fn attitude(m: $mat3, body: [$vec3; 2], world: [$vec3; 2]) -> $vec3 {
                let mut off = <$vec3>::ZERO;
                for (body, world) in body.into_iter().zip(world) {
                    off += body.cross(m.transpose() * world);
                }
                off
            }

            /// The squared distance of the tip of an arm of ball joints from its goal.
            #[differentiate(wrt(tangent(joints)), budget = 119)]
            pub(super) fn arm(joints: [$quat; 2], bone: $vec3, goal: $vec3) -> $real {
                let mut tip = <$vec3>::ZERO;
                for joint in joints {
                    tip = joint * (tip + bone);
                }
                tip.distance_squared(goal)
            }
        }
    };
}

objectives!(single: f32, Vec2, Vec3, Quat, Mat3, Rigid);
objectives!(double: f64, DVec2, DVec3, DQuat, DMat3, DRigid);

/// The same functions by other formulas, with dual numbers.
mod dual {
    use super::{Frame, Number, Quaternion, Vector};

    fn product<D: Number>(p: Quaternion<D>, q: Quaternion<D>) -> Quaternion<D> {
        let ([a, b, c, d], [x, y, z, w]) = (p.0, q.0);
        let v = Vector([a, b, c]).times(w) + Vector([x, y, z]).times(d) + Vector([a, b, c]).cross(Vector([x, y, z]));
        let [u, v, s] = v.0;
        Quaternion([u, v, s, d * w - a * x - b * y - c * z])
    }

    fn inverse<D: Number>(q: Quaternion<D>) -> Quaternion<D> {
        let [x, y, z, w] = q.0;
        Quaternion([-x, -y, -z, w])
    }

    fn unit<D: Number>(q: Quaternion<D>) -> Quaternion<D> {
        let square = q.0.into_iter().fold(D::from(0.0), |sum, c| sum + c * c);
        Quaternion(q.0.map(|c| c / square.sqrt()))
    }

    /// Returns q exp(δ) to first order.
    pub(super) fn right<D: Number>(q: Quaternion<D>, step: Vector<D>) -> Quaternion<D> {
        let [x, y, z] = step.times(D::from(0.5)).0;
        product(unit(q), Quaternion([x, y, z, D::from(1.0)]))
    }

    /// Returns exp(δ) q to first order.
    pub(super) fn left<D: Number>(q: Quaternion<D>, step: Vector<D>) -> Quaternion<D> {
        let [x, y, z] = step.times(D::from(0.5)).0;
        product(Quaternion([x, y, z, D::from(1.0)]), unit(q))
    }

    pub(super) fn arap_edge<D: Number>(turn: Quaternion<D>, edge: Vector<D>, rest: Vector<D>, weight: D) -> D {
        let turned = turn.turn(rest);
        (edge.dot(edge) + turned.dot(turned) - edge.dot(turned) * 2.0) * weight
    }

    pub(super) fn aim<D: Number>(turn: Quaternion<D>, eye: Frame<D>, target: Vector<D>) -> D {
        let way = target - turn.turn(eye.origin);
        turn.turn(eye.direction([0.0, 1.0, 0.0])).dot(way) / way.length()
    }

    pub(super) fn reprojection<D: Number>(
        turn: Quaternion<D>,
        position: Vector<D>,
        point: Vector<D>,
        focal: D,
    ) -> [D; 2] {
        let [x, y, z] = inverse(turn).turn(point - position).0;
        [x * focal / z, y * focal / z]
    }

    /// Takes rotations and positions of both poses, and of the measured one.
    pub(super) fn relative<D: Number>(
        [a, b, measured]: [Quaternion<D>; 3],
        [from, to, expected]: [Vector<D>; 3],
    ) -> [[D; 3]; 2] {
        let [x, y, z, _] = product(product(inverse(unit(measured)), inverse(a)), b).0;
        let off = inverse(a).turn(to - from) - expected;
        [[x, y, z], off.0]
    }

    pub(super) fn attitude<D: Number>(turn: Quaternion<D>, pairs: [Vector<D>; 4]) -> Vector<D> {
        let [a, b, x, y] = pairs;
        a.cross(inverse(turn).turn(x)) + b.cross(inverse(turn).turn(y))
    }

    pub(super) fn arm<D: Number>(joints: [Quaternion<D>; 2], bone: Vector<D>, goal: Vector<D>) -> D {
        let tip = product(joints[1], joints[0]).turn(bone) + joints[1].turn(bone);
        (tip - goal).dot(tip - goal)
    }
}

fn step(step: DVec3) -> DQuat {
    DQuat::from_scaled_axis(step)
}

const STILL: [f64; 3] = [0.0; 3];

fn turn(r: &mut Random) -> Vec<f64> {
    r.quaternion(0.9..1.1)
}

#[test]
fn edge_of_a_surface() {
    let sample = |r: &mut Random| {
        [STILL.to_vec(), r.vector(0.0..1.0), r.vector(1.0..2.0), turn(r), r.vector(0.5..2.0), vec![r.within(0.5..2.0)]]
            .concat()
    };
    At(sample).check(
        |d, from, to, q: DQuat, rest, w| double::arap_edge(q.normalize() * step(d), from, to, rest, w),
        |_: DVec3, from, to, q: DQuat, rest, w| double::arap_edge_gradient(q.normalize(), from, to, rest, w),
        |_: Vec3, from, to, q: Quat, rest, w| single::arap_edge_gradient(q.normalize(), from, to, rest, w),
        |d, from, to: Vector<_>, q, rest, w: Dual64| dual::arap_edge(dual::right(q, d), to - from, rest, w),
    );
    At(sample).check(
        |d, from, to, q: DQuat, rest, w| double::arap_edge_left(step(d) * q.normalize(), from, to, rest, w),
        |_: DVec3, from, to, q: DQuat, rest, w| double::arap_edge_left_gradient(q.normalize(), from, to, rest, w),
        |_: Vec3, from, to, q: Quat, rest, w| single::arap_edge_left_gradient(q.normalize(), from, to, rest, w),
        |d, from, to: Vector<_>, q, rest, w: Dual64| dual::arap_edge(dual::left(q, d), to - from, rest, w),
    );
}

#[test]
fn freely_turned_joint() {
    let sample = |r: &mut Random| [STILL.to_vec(), turn(r), r.frame(1.0), r.vector(1.5..4.0)].concat();
    At(sample).check(
        |d, q: DQuat, eye, target| double::aim(q.normalize() * step(d), eye, target),
        |_: DVec3, q: DQuat, eye: DRigid, target| double::aim_gradient(q.normalize(), eye, target),
        |_: Vec3, q: Quat, eye: Rigid, target| single::aim_gradient(q.normalize(), eye, target),
        |d, q, eye: Frame<Dual64>, target| dual::aim(dual::right(q, d), eye, target),
    );
    // Compared with second differences along the exponential.
    let (eye, target) = (DRigid::from_rotation_translation(DQuat::IDENTITY, DVec3::new(0.1, 0.2, 0.3)), DVec3::ONE);
    let q = DQuat::from_xyzw(0.5, -0.1, 0.7, 0.5).normalize();
    let (_, (gradient,), hessian) = double::aim_hessian(q, eye, target);
    assert!(gradient.abs_diff_eq(double::aim_gradient(q, eye, target).1.0, 1e-12));
    let h = 1e-4;
    let moved = |i: usize, k: usize, [a, b]: [f64; 2]| {
        double::aim(q * step(DVec3::AXES[i] * (a * h) + DVec3::AXES[k] * (b * h)), eye, target)
    };
    for (i, row) in hessian.iter().enumerate() {
        for (k, &found) in row.iter().enumerate() {
            let corners = [[1.0, 1.0], [-1.0, -1.0], [1.0, -1.0], [-1.0, 1.0]].map(|signs| moved(i, k, signs));
            let expected = (corners[0] + corners[1] - corners[2] - corners[3]) / (4.0 * h * h);
            assert!((found - expected).abs() < 1e-6, "{i} {k}: {found} and {expected}");
        }
    }
}

#[test]
fn camera_with_a_pose() {
    let sample = |r: &mut Random| {
        let (q, position) = (DQuat::from_slice(&turn(r)).normalize(), DVec3::from_slice(&r.vector(0.0..2.0)));
        let local = DVec3::new(r.within(-1.0..1.0), r.within(-1.0..1.0), r.within(2.0..4.0));
        let point = q * local + position;
        let numbers = [&STILL[..], &position.to_array(), &point.to_array(), &q.to_array(), &[r.within(0.5..2.0)]];
        numbers.concat()
    };
    let pose = |q: DQuat, position| double::Pose { rotation: q.normalize(), position };
    At(sample).check(
        |d, x, point, q: DQuat, f| double::reprojection(pose(q.normalize() * step(d), x), point, f),
        |_: DVec3, x, p, q, f| by_rows(double::reprojection_jacobian(pose(q, x), p, f)),
        |_: Vec3, x, p, q: Quat, f| {
            by_rows(single::reprojection_jacobian(single::Pose { rotation: q.normalize(), position: x }, p, f))
        },
        |d, x, point, q, f: Dual64| dual::reprojection(dual::right(q, d), x, point, f),
    );
}

#[test]
fn edge_of_a_pose_graph() {
    let sample = |r: &mut Random| {
        let (steps, measured) = ([r.vector(0.0..1.0), r.vector(0.0..1.0)], [turn(r), r.vector(0.0..1.0)].concat());
        [&STILL[..], &steps[0], &STILL, &steps[1], &turn(r), &turn(r), &measured].concat()
    };
    type Poses<Q, V> = ([Q; 2], (Q, V));
    fn double_poses((x, y): (DVec3, DVec3), ([a, b], (m, z)): Poses<DQuat, DVec3>) -> [double::Pose; 3] {
        [(a, x), (b, y), (m, z)].map(|(q, position)| double::Pose { rotation: q.normalize(), position })
    }
    fn single_poses((x, y): (Vec3, Vec3), ([a, b], (m, z)): Poses<Quat, Vec3>) -> [single::Pose; 3] {
        [(a, x), (b, y), (m, z)].map(|(q, position)| single::Pose { rotation: q.normalize(), position })
    }
    At(sample).check(
        |d, x, e, y, poses: Poses<DQuat, DVec3>| {
            let [mut a, mut b, measured] = double_poses((x, y), poses);
            (a.rotation, b.rotation) = (step(d) * a.rotation, step(e) * b.rotation);
            double::relative(a, b, &measured)
        },
        |_: DVec3, x, _: DVec3, y, poses| {
            let [a, b, measured] = double_poses((x, y), poses);
            by_rows(double::relative_jacobian(a, b, &measured))
        },
        |_: Vec3, x, _: Vec3, y, poses| {
            let [a, b, measured] = single_poses((x, y), poses);
            by_rows(single::relative_jacobian(a, b, &measured))
        },
        |d, x: Vector<Dual64>, e, y, ([a, b], (m, z)): Poses<Quaternion<_>, Vector<_>>| {
            dual::relative([dual::left(a, d), dual::left(b, e), m], [x, y, z])
        },
    );
}

#[test]
fn point_and_plane() {
    let sample = |r: &mut Random| {
        [vec![0.0; 6], r.frame(2.0), r.vector(0.0..2.0), r.vector(1.0..1.01), r.numbers(1, -1.0..1.0)].concat()
    };
    type Step = (DVec3, DVec3);
    let moved = |(turn, shift): Step| DRigid::from_rotation_translation(step(turn), shift);
    let gradient = |_: Step, pose: DRigid, p, n, o| double::to_plane_gradient(&pose, p, n, o);
    At(sample).check(
        |d, pose: DRigid, p, n, o| double::to_plane(&(pose * moved(d)), p, n, o),
        gradient,
        |_: (Vec3, Vec3), pose: Rigid, p, n, o| single::to_plane_gradient(&pose, p, n, o),
        |(d, e): (Vector<Dual64>, _), pose: Frame<_>, p, n: Vector<_>, o: Dual64| {
            n.dot(dual::right(pose.rotation, d).turn(p) + pose.rotation.turn(e) + pose.origin) - o
        },
    );
    At(sample).check(
        |d, pose: DRigid, p, n, o| double::to_plane_left(&(moved(d) * pose), p, n, o),
        |_: Step, pose: DRigid, p, n, o| double::to_plane_left_gradient(&pose, p, n, o),
        |_: (Vec3, Vec3), pose: Rigid, p, n, o| single::to_plane_left_gradient(&pose, p, n, o),
        |(d, e): (Vector<Dual64>, _), pose: Frame<_>, p, n: Vector<_>, o: Dual64| {
            let one = Quaternion([0.0, 0.0, 0.0, 1.0].map(Dual64::from));
            n.dot(dual::left(one, d).turn(pose.point(p)) + e) - o
        },
    );
}

#[test]
fn attitude_by_a_matrix() {
    let sample = |r: &mut Random| [STILL.to_vec(), turn(r), [0; 4].map(|_| r.vector(0.5..1.5)).concat()].concat();
    let matrix = |q: DQuat| DMat3::from_quat(q.normalize());
    At(sample).check(
        |d, q: DQuat, body, world| double::attitude(matrix(q) * DMat3::from_quat(step(d)), body, world),
        |_: DVec3, q, body, world| double::attitude_jacobian(matrix(q), body, world),
        |_: Vec3, q: Quat, body, world| single::attitude_jacobian(Mat3::from_quat(q.normalize()), body, world),
        |d, q: Quaternion<Dual64>, pairs| dual::attitude(dual::right(q, d), pairs),
    );
}

#[test]
fn arm_of_ball_joints() {
    let sample = |r: &mut Random| [vec![0.0; 6], turn(r), turn(r), r.vector(0.5..1.0), r.vector(0.5..3.0)].concat();
    let unit = |joints: [DQuat; 2]| joints.map(DQuat::normalize);
    At(sample).check(
        |d: [DVec3; 2], q, bone, goal| {
            let [a, b] = unit(q);
            double::arm([a * step(d[0]), b * step(d[1])], bone, goal)
        },
        |_: [DVec3; 2], q, bone, goal| double::arm_gradient(unit(q), bone, goal),
        |_: [Vec3; 2], q: [Quat; 2], bone, goal| single::arm_gradient(q.map(Quat::normalize), bone, goal),
        |[d, e]: [Vector<Dual64>; 2], [a, b]: [Quaternion<_>; 2], bone, goal| {
            dual::arm([dual::right(a, d), dual::right(b, e)], bone, goal)
        },
    );
}

fn close(found: f64, expected: f64) {
    assert!((found - expected).abs() <= 1e-12 * expected.abs().max(1.0), "{found} and {expected}");
}

#[test]
fn products_with_derivatives_by_tangents() {
    let mut random = Random::new(8);
    for _ in 0..200 {
        let n = random.numbers(16, -1.0..1.0);
        let vector = |k: usize| DVec3::from_slice(&n[k..]);
        let camera = double::Pose { rotation: DQuat::from_rotation_y(n[0]), position: vector(1) };
        let point = camera.rotation * DVec3::new(n[4], n[5], 3.0) + camera.position;
        let (value, ((by_turn, by_place), by_point)) = {
            let (value, (by_camera, by_point)) = double::reprojection_jacobian(camera, point, 1.5);
            (value, ((by_camera.map(|row| row.0), by_camera.map(|row| row.1)), by_point))
        };
        let rows = [0, 1].map(|i| [by_turn[i], by_place[i], by_point[i]].map(|v: DVec3| v.to_array()).concat());
        let along = [vector(6), vector(9), vector(12)];
        let flat = along.map(|v| v.to_array()).concat();
        let (same, tangent) = double::reprojection_jvp(camera, point, 1.5, (along[0], along[1]), along[2]);
        let (also, ((turned, placed), pointed)) = double::reprojection_vjp(camera, point, 1.5, [n[4], n[5]]);
        let pulled = [turned, placed, pointed].map(|v| v.to_array()).concat();
        let (residual, ((turned, placed), pointed), normal) = double::reprojection_gauss_newton(camera, point, 1.5);
        let projected = [turned, placed, pointed].map(|v| v.to_array()).concat();
        for i in 0..2 {
            [same[i], also[i], residual[i]].into_iter().for_each(|found| close(found, value[i]));
            close(tangent[i], rows[i].iter().zip(&flat).map(|(a, b)| a * b).sum());
        }
        for k in 0..9 {
            close(pulled[k], n[4] * rows[0][k] + n[5] * rows[1][k]);
            close(projected[k], value[0] * rows[0][k] + value[1] * rows[1][k]);
            (0..9).for_each(|j| close(normal[k][j], rows[0][k] * rows[0][j] + rows[1][k] * rows[1][j]));
        }
        let m = DMat3::from_quat(camera.rotation);
        let (body, world) = ([vector(2), vector(5)], [vector(8), vector(11)]);
        let (_, (jacobian,)) = double::attitude_jacobian(m, body, world);
        let (_, tangent) = double::attitude_jvp(m, body, world, along[0]);
        let (_, (pulled,)) = double::attitude_vjp(m, body, world, along[1]);
        (0..3).for_each(|k| close(tangent[k], (jacobian * along[0])[k]));
        (0..3).for_each(|k| close(pulled[k], (jacobian.transpose() * along[1])[k]));
    }
}
