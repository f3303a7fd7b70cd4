//! Objectives of aiming: eyes, pairs of eyes, turrets.

use aim_objectives::{At, Function, Random, singular};

macro_rules! objectives {
    ($real:ident, $vec2:ident, $vec3:ident, $quat:ident, $rigid:ident) => {
        use aim::glam::{$quat, $vec2, $vec3};
        use aim::{differentiate, $rigid};

        /// The cosine of the angle to the target, minus the displacement cost.
        #[differentiate(wrt(p, h), budget = 57)]
        pub(super) fn displaced(p: $real, h: $real, eye: $rigid, target: $vec3, stiffness: $real) -> $real {
            let turned = $rigid::from_quat($quat::from_rotation_x(h) * $quat::from_rotation_z(p)) * eye;
            let forward = turned.transform_vector3($vec3::Y);
            let to_target = target - turned.transform_point3($vec3::ZERO);
            forward.dot(to_target.normalize_or_zero()) - 0.5 * stiffness * (p * p + h * h)
        }

        /// A weighted aim of one eye at two targets.
        #[differentiate(wrt(p, h), budget = 94)]
        pub(super) fn between(p: $real, h: $real, eye: $rigid, first: $vec3, second: $vec3, weight: $real) -> $real {
            let turned = $rigid::from_quat($quat::from_rotation_x(h) * $quat::from_rotation_z(p)) * eye;
            let origin = turned.transform_point3($vec3::ZERO);
            let forward = turned.transform_vector3($vec3::Y);
            let to_first = (first - origin).normalize();
            let to_second = (second - origin).normalize();
            weight * forward.dot(to_first) + (1.0 - weight) * forward.dot(to_second)
        }

        /// A camera that looks at the target and stays level.
        #[differentiate(wrt(p, h, r), budget = 111)]
        pub(super) fn rolled(p: $real, h: $real, r: $real, camera: $rigid, target: $vec3, up: $vec3) -> $real {
            let turn = $quat::from_rotation_x(h) * $quat::from_rotation_z(p) * $quat::from_rotation_y(r);
            let turned = $rigid::from_quat(turn) * camera;
            let to_target = target - turned.transform_point3($vec3::ZERO);
            let aim = turned.transform_vector3($vec3::Y).dot(to_target.normalize());
            aim + 0.25 * turned.transform_vector3($vec3::X).dot(up)
        }

        /// The distance by which a turret's bore line misses the target. The bore is offset from the trunnion, and the
        /// trunnion from the bearing.
        #[differentiate(wrt(bearing, elevation), budget = 77)]
        pub(super) fn missed(bearing: $real, elevation: $real, trunnion: $vec3, muzzle: $vec3, target: $vec3) -> $real {
            let base = $quat::from_rotation_y(bearing);
            let barrel = base * $quat::from_axis_angle($vec3::NEG_X, elevation);
            let bore = barrel * $vec3::Z;
            let at = base * trunnion + barrel * muzzle;
            bore.cross(target - at).length()
        }

        /// The target's direction in the eye's frame as a stereographic residual, which does not return to 0 behind.
        #[differentiate(wrt(p, h), budget = 94)]
        pub(super) fn stereographic(p: $real, h: $real, eye: $rigid, target: $vec3) -> $vec2 {
            let turned = $rigid::from_quat($quat::from_rotation_x(h) * $quat::from_rotation_z(p)) * eye;
            let v = turned.inverse().transform_point3(target);
            2.0 * $vec2::new(v.x, v.z) / (v.length() + v.y)
        }

        /// Two eyes that turn up and aside together and converge on one target.
        #[differentiate(wrt(up, aside, inward), budget = 58)]
        pub(super) fn squint(
            up: $real,
            aside: $real,
            inward: $real,
            left: $vec3,
            right: $vec3,
            target: $vec3,
        ) -> $real {
            let pitch = $quat::from_rotation_x(-up);
            let left_forward = $quat::from_rotation_y(aside - inward) * (pitch * $vec3::Z);
            let right_forward = $quat::from_rotation_y(aside + inward) * (pitch * $vec3::Z);
            left_forward.dot((target - left).normalize()) + right_forward.dot((target - right).normalize())
        }

        /// A free orientation that looks at the target with its eyes level.
        #[differentiate(wrt(q), budget = 147)]
        pub(super) fn level(q: $quat, target: $vec3, up: $vec3) -> $real {
            let turn = q.normalize();
            let off = turn * $vec3::Z - target.normalize();
            let tilt = (turn * $vec3::X).dot(up);
            off.length_squared() + 0.1 * tilt * tilt
        }
    };
}

mod single {
    objectives!(f32, Vec2, Vec3, Quat, Rigid);
}

mod double {
    objectives!(f64, DVec2, DVec3, DQuat, DRigid);
}

/// The same objectives in the inverse form: the target and the world are transformed into the effector's frame.
mod dual {
    use aim_objectives::dual::{Frame, Number, Quaternion, Vector};

    /// Rotates `v` back into the joint's space before its rotation.
    fn back<D: Number>(v: Vector<D>, p: D, h: D) -> Vector<D> {
        v.about(0, -h).about(2, -p)
    }

    fn aim<D: Number>(p: D, h: D, eye: Frame<D>, target: Vector<D>) -> D {
        (back(target, p, h) - eye.origin).unit().dot(eye.direction([0.0, 1.0, 0.0]))
    }

    pub(super) fn displaced<D: Number>(p: D, h: D, eye: Frame<D>, target: Vector<D>, stiffness: D) -> D {
        aim(p, h, eye, target) - stiffness * (p.powi(2) + h.powi(2)) / 2.0
    }

    pub(super) fn between<D: Number>(p: D, h: D, eye: Frame<D>, first: Vector<D>, second: Vector<D>, weight: D) -> D {
        let (first, second) = (aim(p, h, eye, first), aim(p, h, eye, second));
        second + weight * (first - second)
    }

    pub(super) fn rolled<D: Number>(p: D, h: D, r: D, camera: Frame<D>, target: Vector<D>, up: Vector<D>) -> D {
        let back = |v| back(v, p, h).about(1, -r);
        let aim = (back(target) - camera.origin).unit().dot(camera.direction([0.0, 1.0, 0.0]));
        aim + back(up).dot(camera.direction([1.0, 0.0, 0.0])) / 4.0
    }

    pub(super) fn missed<D: Number>(
        bearing: D,
        elevation: D,
        trunnion: Vector<D>,
        muzzle: Vector<D>,
        target: Vector<D>,
    ) -> D {
        let seen = (target.about(1, -bearing) - trunnion).about(0, elevation) - muzzle;
        (seen.0[0].powi(2) + seen.0[1].powi(2)).sqrt()
    }

    pub(super) fn stereographic<D: Number>(p: D, h: D, eye: Frame<D>, target: Vector<D>) -> [D; 2] {
        let v = (back(target, p, h) - eye.origin).unit();
        let along = |axis| v.dot(eye.direction(axis));
        let half = (along([0.0, 1.0, 0.0]) + 1.0).recip() * 2.0;
        [half * along([1.0, 0.0, 0.0]), half * along([0.0, 0.0, 1.0])]
    }

    pub(super) fn squint<D: Number>(
        up: D,
        aside: D,
        inward: D,
        left: Vector<D>,
        right: Vector<D>,
        target: Vector<D>,
    ) -> D {
        let forward = |angle: D| Vector([up.cos() * angle.sin(), up.sin(), up.cos() * angle.cos()]);
        (target - left).unit().dot(forward(aside - inward)) + (target - right).unit().dot(forward(aside + inward))
    }

    pub(super) fn level<D: Number>(q: Quaternion<D>, target: Vector<D>, up: Vector<D>) -> D {
        let axis = |v| q.turn(Vector::constant(v));
        let cosine = axis([0.0, 0.0, 1.0]).dot(target.unit());
        (-cosine + 1.0) * 2.0 + axis([1.0, 0.0, 0.0]).dot(up).powi(2) * 0.1
    }
}

/// Samples two angles and an eye at most 0.5 from the joint.
fn eye(random: &mut Random) -> Vec<f64> {
    [random.numbers(2, -2.5..2.5), random.frame(0.5)].concat()
}

/// An unrotated eye that looks along Y, offset by 0.5 along X.
const STRAIGHT: [f64; 9] = [0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.5, 0.0, 0.0];

#[test]
fn aim_with_displacement_penalty() {
    At(|r: &mut Random| [eye(r), r.vector(1.0..4.0), r.numbers(1, 0.0..0.5)].concat()).check(
        double::displaced,
        double::displaced_gradient,
        single::displaced_gradient,
        dual::displaced,
    );
    // A target on the eye has no direction. Straight ahead and straight behind, turning has no first-order effect.
    for target in [[0.5, 0.0, 0.0], [0.5, 2.0, 0.0], [0.5, -2.0, 0.0]] {
        singular(
            &[&STRAIGHT[..], &target, &[0.1]].concat(),
            double::displaced,
            double::displaced_gradient,
            single::displaced_gradient,
            &[0.0, 0.0],
        );
    }
}

#[test]
fn aim_between_two_targets() {
    At(|r: &mut Random| [eye(r), r.vector(1.0..4.0), r.vector(1.0..4.0), r.numbers(1, 0.0..1.0)].concat()).check(
        double::between,
        double::between_gradient,
        single::between_gradient,
        dual::between,
    );
}

#[test]
fn aim_with_roll() {
    At(|r: &mut Random| [r.numbers(3, -2.5..2.5), r.frame(0.5), r.vector(1.0..4.0), r.vector(0.9..1.1)].concat())
        .check(double::rolled, double::rolled_gradient, single::rolled_gradient, dual::rolled);
}

#[test]
fn barrel_with_offset_muzzle() {
    let sample =
        |r: &mut Random| [r.numbers(2, -2.5..2.5), r.vector(0.0..0.3), r.vector(0.0..0.3), r.vector(1.0..4.0)].concat();
    // The distance has a kink where it is 0.
    At(|r: &mut Random| r.until(sample, |x| double::missed.feed(x)[0] > 0.1)).check(
        double::missed,
        double::missed_gradient,
        single::missed_gradient,
        dual::missed,
    );
    let hit = [0.0, 0.0, 0.25, 0.0, 0.0, 0.0, 0.5, 1.0, 0.25, 0.5, 3.0];
    singular(&hit, double::missed, double::missed_gradient, single::missed_gradient, &[0.0, 0.0]);
}

#[test]
fn stereographic_residual() {
    let sample = |r: &mut Random| [eye(r), r.vector(1.0..4.0)].concat();
    // Behind, the residual grows without bound.
    At(|r: &mut Random| r.until(sample, |x| double::stereographic.feed(x).iter().all(|s| s.abs() < 8.0))).check(
        double::stereographic,
        double::stereographic_jacobian,
        single::stereographic_jacobian,
        dual::stereographic,
    );
    // Straight ahead, its derivative is that of the angle.
    singular(
        &[&STRAIGHT[..], &[0.5, 2.0, 0.0]].concat(),
        double::stereographic,
        double::stereographic_jacobian,
        single::stereographic_jacobian,
        &[1.0, 0.0, 0.0, -1.0],
    );
}

#[test]
fn vergence_of_two_eyes() {
    At(|r: &mut Random| [r.numbers(3, -1.5..1.5), r.vector(0.0..0.3), r.vector(0.0..0.3), r.vector(1.0..4.0)].concat())
        .check(double::squint, double::squint_gradient, single::squint_gradient, dual::squint);
}

#[test]
fn look_at_with_level_eyes() {
    At(|r: &mut Random| [r.quaternion(0.5..2.0), r.vector(0.5..4.0), r.vector(0.9..1.1)].concat()).check(
        double::level,
        double::level_gradient,
        single::level_gradient,
        dual::level,
    );
    // On target and level the gradient vanishes.
    let there = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 2.0, 0.0, 1.0, 0.0];
    singular(&there, double::level, double::level_gradient, single::level_gradient, &[0.0; 4]);
}
