//! Objectives with derivations by hand in `tests/src/by_hand/elsewhere.rs`. `aim-tests` reads this file, counts the
//! derived operations, and writes the table of `docs/operation-counts.md`.

#[aim::differentiate(check = true)]
pub(crate) mod problems {
    use aim::DRigid;
    use aim::glam::{DMat3, DQuat, DVec2, DVec3, Vec3Swizzles};

    /// Rodrigues' formula.
    fn rotated(axis_angle: DVec3, p: DVec3) -> DVec3 {
        let angle = axis_angle.length();
        let axis = axis_angle / angle;
        let (sin, cos) = angle.sin_cos();
        p * cos + axis.cross(p) * sin + axis * axis.dot(p) * (1.0 - cos)
    }

    /// Bundle adjustment: a camera of nine parameters and a point.
    #[differentiate(wrt(camera, point), budget = 194)]
    pub(crate) fn bundle_adjustment(camera: [f64; 9], point: DVec3, observed: DVec2) -> DVec2 {
        let [rx, ry, rz, tx, ty, tz, focal, k1, k2] = camera;
        let p = DQuat::from_scaled_axis(DVec3::new(rx, ry, rz)) * point + DVec3::new(tx, ty, tz);
        let image = -p.xy() / p.z;
        let r2 = image.length_squared();
        let distortion = 1.0 + r2 * (k1 + k2 * r2);
        focal * distortion * image - observed
    }

    /// Point-to-plane registration, by a rotation vector.
    #[differentiate(wrt(turn, shift), budget = 89)]
    pub(crate) fn point_to_plane(turn: DVec3, shift: DVec3, point: DVec3, normal: DVec3, offset: f64) -> f64 {
        normal.dot(rotated(turn, point) + shift) - offset
    }

    /// As-rigid-as-possible deformation: an edge, by a quaternion.
    #[differentiate(wrt(q, from, to), budget = 84)]
    pub(crate) fn rigid_edge(q: DQuat, from: DVec3, to: DVec3, rest: DVec3, weight: f64) -> f64 {
        weight * (to - from - q.normalize() * rest).length_squared()
    }

    /// The force of a damped spring, with its Jacobian by position and velocity.
    #[differentiate(wrt(a, va), budget = 68)]
    pub(crate) fn damped_spring(
        a: DVec3,
        va: DVec3,
        b: DVec3,
        vb: DVec3,
        stiffness: f64,
        damping: f64,
        rest: f64,
    ) -> DVec3 {
        let way = b - a;
        let length = way.length();
        let direction = way / length;
        let force = stiffness * (length - rest) + damping * (vb - va).dot(direction);
        direction * force
    }

    /// The torsion energy of a dihedral angle.
    #[differentiate(wrt(a, b, c, d), budget = 98)]
    pub(crate) fn torsion(a: DVec3, b: DVec3, c: DVec3, d: DVec3, k: f64, n: f64, phase: f64) -> f64 {
        let (first, middle, last) = (b - a, c - b, d - c);
        let (m, l) = (first.cross(middle), middle.cross(last));
        let phi = (middle.length() * first.dot(l)).atan2(m.dot(l));
        k * (1.0 + (n * phi - phase).cos())
    }

    /// A Gaussian's negative log-likelihood, by the point and the covariance.
    #[differentiate(wrt(x, covariance), budget = 110)]
    pub(crate) fn gaussian(x: DVec3, mean: DVec3, covariance: DMat3) -> f64 {
        let d = x - mean;
        0.5 * d.dot(covariance.inverse() * d) + 0.5 * covariance.determinant().ln()
    }

    /// The logarithmic barrier of a cone.
    #[differentiate(wrt(p, apex, axis, slope), budget = 51)]
    pub(crate) fn cone_barrier(p: DVec3, apex: DVec3, axis: DVec3, slope: f64, weight: f64) -> f64 {
        let axis = axis.normalize();
        let d = p - apex;
        let along = d.dot(axis);
        let aside = (d - along * axis).length();
        -weight * (slope * along - aside).ln()
    }

    /// Range and bearing of a landmark, from a pose in the plane.
    #[differentiate(wrt(pose, landmark), budget = 13)]
    pub(crate) fn bearing_and_range(pose: [f64; 3], landmark: [f64; 2]) -> [f64; 2] {
        let (dx, dy) = (landmark[0] - pose[0], landmark[1] - pose[1]);
        [(dx * dx + dy * dy).sqrt(), dy.atan2(dx) - pose[2]]
    }

    /// Registration of two points with a robust loss, by a quaternion that is not normalised.
    #[differentiate(wrt(q, shift), budget = 90)]
    pub(crate) fn robust_registration(q: DQuat, shift: DVec3, from: DVec3, to: DVec3, width: f64) -> f64 {
        let square = (q * from + shift - to).length_squared();
        square / (square + width * width)
    }

    /// The squared error of a relative pose in the plane against a measured one.
    #[differentiate(wrt(pose, other), budget = 30)]
    pub(crate) fn odometry(pose: [f64; 3], other: [f64; 3], measured: DVec3) -> f64 {
        let (dx, dy) = (other[0] - pose[0], other[1] - pose[1]);
        let (sin, cos) = pose[2].sin_cos();
        let ahead = cos * dx + sin * dy - measured.x;
        let aside = cos * dy - sin * dx - measured.y;
        let turned = other[2] - pose[2] - measured.z;
        ahead * ahead + aside * aside + turned * turned
    }

    /// The distance of a point from the line through two others.
    #[differentiate(wrt(p, a, b), budget = 39)]
    pub(crate) fn line_distance(p: DVec3, a: DVec3, b: DVec3) -> f64 {
        let (off, way) = (p - a, b - a);
        (off - off.dot(way) / way.dot(way) * way).length()
    }

    /// The angular acceleration of a free rigid body, by its attitude and its angular velocity in the world.
    #[differentiate(wrt(tangent(q), w), budget = 207)]
    pub(crate) fn gyroscopic(q: DQuat, w: DVec3, moments: DVec3) -> DVec3 {
        let r = DMat3::from_quat(q);
        let inertia = r * DMat3::from_diagonal(moments) * r.transpose();
        -(inertia.inverse() * w.cross(inertia * w))
    }

    fn trace(m: DMat3) -> f64 {
        m.x_axis.x + m.y_axis.y + m.z_axis.z
    }

    /// The Saint Venant–Kirchhoff energy of a tetrahedron, by its vertices.
    #[differentiate(wrt(x), budget = 213)]
    pub(crate) fn tetrahedron(x: [DVec3; 4], rest_inverse: DMat3, mu: f64, lambda: f64) -> f64 {
        let f = DMat3::from_cols(x[1] - x[0], x[2] - x[0], x[3] - x[0]) * rest_inverse;
        let strain = 0.5 * (f.transpose() * f - DMat3::IDENTITY);
        mu * trace(strain * strain) + 0.5 * lambda * trace(strain).powi(2)
    }

    /// De Casteljau's algorithm.
    fn on_curve(mut points: [DVec2; 4], t: f64) -> DVec2 {
        for level in (1..4).rev() {
            for i in 0..level {
                points[i] = points[i].lerp(points[i + 1], t);
            }
        }
        points[0]
    }

    /// The length of a Bézier curve, as that of a polygon of eight sides.
    #[differentiate(wrt(control), budget = 281)]
    pub(crate) fn curve_length(control: [DVec2; 4]) -> f64 {
        let points: Vec<DVec2> = (0..=8).map(|i| on_curve(control, f64::from(i) / 8.0)).collect();
        points.windows(2).map(|ends| ends[0].distance(ends[1])).sum()
    }

    /// The aim of an eye whose joint is rotated by a quaternion.
    #[differentiate(wrt(q), budget = 96)]
    pub(crate) fn aim_by_quaternion(q: DQuat, eye: DRigid, target: DVec3) -> f64 {
        let turned = DRigid::from_quat(q.normalize()) * eye;
        let forward = turned.transform_vector3(DVec3::Y);
        forward.dot((target - turned.transform_point3(DVec3::ZERO)).normalize())
    }

    /// The aim of an eye whose joint is rotated by a rotation vector.
    #[differentiate(wrt(turn), budget = 106)]
    pub(crate) fn aim_by_rotation_vector(turn: DVec3, eye: DRigid, target: DVec3) -> f64 {
        let turned = DRigid::from_quat(DQuat::from_scaled_axis(turn)) * eye;
        let forward = turned.transform_vector3(DVec3::Y);
        forward.dot((target - turned.transform_point3(DVec3::ZERO)).normalize())
    }

    fn turned(p: f64, h: f64, eye: DRigid) -> DRigid {
        DRigid::from_quat(DQuat::from_rotation_x(h) * DQuat::from_rotation_z(p)) * eye
    }

    /// The aim of an eye that slides along its forward direction.
    #[differentiate(wrt(p, h, reach), budget = 58)]
    pub(crate) fn aim_with_telescope(p: f64, h: f64, reach: f64, eye: DRigid, target: DVec3) -> f64 {
        let turned = turned(p, h, eye);
        let forward = turned.transform_vector3(DVec3::Y);
        let origin = turned.transform_point3(DVec3::ZERO) + reach * forward;
        forward.dot((target - origin).normalize())
    }

    /// The squared chord between an eye's direction and the direction to its target.
    #[differentiate(wrt(p, h), budget = 49)]
    pub(crate) fn chord_of_aim(p: f64, h: f64, eye: DRigid, target: DVec3) -> f64 {
        let turned = turned(p, h, eye);
        let direction = (target - turned.transform_point3(DVec3::ZERO)).normalize();
        (turned.transform_vector3(DVec3::Y) - direction).length_squared()
    }

    /// The sine of the angle between an eye's direction and the direction to its target.
    #[differentiate(wrt(p, h), budget = 54)]
    pub(crate) fn sine_of_aim(p: f64, h: f64, eye: DRigid, target: DVec3) -> f64 {
        let turned = turned(p, h, eye);
        let direction = (target - turned.transform_point3(DVec3::ZERO)).normalize();
        turned.transform_vector3(DVec3::Y).cross(direction).length()
    }

    /// The aim, with both rotations written out in components.
    #[differentiate(wrt(p, h), budget = 46)]
    pub(crate) fn aim_in_components(p: f64, h: f64, eye: DRigid, target: DVec3) -> f64 {
        let ((sp, cp), (sh, ch)) = (p.sin_cos(), h.sin_cos());
        let turn = |v: DVec3| {
            let v = DVec3::new(cp * v.x - sp * v.y, sp * v.x + cp * v.y, v.z);
            DVec3::new(v.x, ch * v.y - sh * v.z, sh * v.y + ch * v.z)
        };
        let forward = turn(eye.matrix3.y_axis);
        forward.dot((target - turn(eye.translation)).normalize())
    }

    /// The aim, with both rotations as matrices of columns.
    #[differentiate(wrt(p, h), budget = 46)]
    pub(crate) fn aim_in_columns(p: f64, h: f64, eye: DRigid, target: DVec3) -> f64 {
        let ((sp, cp), (sh, ch)) = (p.sin_cos(), h.sin_cos());
        let pitch = DMat3::from_cols(DVec3::new(cp, sp, 0.0), DVec3::new(-sp, cp, 0.0), DVec3::Z);
        let heading = DMat3::from_cols(DVec3::X, DVec3::new(0.0, ch, sh), DVec3::new(0.0, -sh, ch));
        let turn = heading * pitch;
        let forward = turn * eye.matrix3.y_axis;
        forward.dot((target - turn * eye.translation).normalize())
    }
}
