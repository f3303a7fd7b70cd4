//! Products of matrices: multiplied out or applied one after the other, transposed, inverted and symmetric.

#[aim::differentiate(check = true)]
mod products {
    use aim::glam::{DMat3, DQuat, DVec3};

    fn square(m: DMat3) -> f64 {
        m.x_axis.length_squared() + m.y_axis.dot(m.x_axis) + m.z_axis.length_squared() + m.z_axis.x * m.x_axis.y
    }

    /// Columns of a product, and its transpose applied to a vector.
    #[differentiate(wrt(a, b))]
    fn transposed(a: DMat3, b: DMat3, v: DVec3) -> f64 {
        let product = a * b;
        let back = product.transpose();
        square(back * product) + v.dot(back * v) + back.row(1).dot(v) + back.col(2).length_squared()
    }

    #[differentiate(wrt(a, b))]
    fn inverted(a: DMat3, b: DMat3, v: DVec3) -> f64 {
        let (a, b) = (DMat3::IDENTITY + 0.2 * a, DMat3::IDENTITY + 0.2 * b);
        let back = (a * b).transpose().inverse();
        v.dot(back * v) + square(back)
    }

    /// A symmetric product, and one that only looks like it.
    #[differentiate(wrt(a, p))]
    fn propagated(a: DMat3, p: [f64; 6], q: DMat3) -> f64 {
        let [xx, xy, xz, yy, yz, zz] = p;
        let p = DMat3::from_cols(DVec3::new(xx, xy, xz), DVec3::new(xy, yy, yz), DVec3::new(xz, yz, zz));
        square(a * p * a.transpose())
            + square(a * q * a.transpose())
            + square(a * q * p * q.transpose() * a.transpose())
    }

    /// A symmetric product with an inverse, between rotations.
    #[differentiate(wrt(tangent(turn), a, d))]
    fn turned(turn: DQuat, a: DMat3, d: DVec3) -> f64 {
        let (r, a) = (DMat3::from_quat(turn), DMat3::IDENTITY + 0.2 * a);
        let middle = (a.transpose() * a).inverse();
        square(r * a * DMat3::from_diagonal(d) * a.transpose() * r.transpose()) + square(a * middle * a.transpose())
    }

    /// A rotation is undone through a cross product.
    #[differentiate(wrt(tangent(turn), v))]
    fn crossed(turn: DQuat, v: DVec3, w: DVec3) -> DVec3 {
        turn.inverse() * v.cross(turn * w) + turn.inverse() * (turn * v).cross(w + turn * v)
    }
}
