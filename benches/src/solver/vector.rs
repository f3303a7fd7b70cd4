//! Three numbers in double precision, and what the reference does with them. Its own, so that nothing that judges the
//! solvers computes as they do.

/// A point or a direction.
pub type V = [f64; 3];

/// a + b
pub fn add(a: V, b: V) -> V {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

/// a − b
pub fn sub(a: V, b: V) -> V {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// k a
pub fn scale(k: f64, a: V) -> V {
    a.map(|x| k * x)
}

/// a · b
pub fn dot(a: V, b: V) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// a × b
pub fn cross(a: V, b: V) -> V {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// a / |a|
pub fn unit(a: V) -> V {
    scale(1.0 / dot(a, a).sqrt(), a)
}

/// The angle between two vectors, 0…π.
pub fn angle(a: V, b: V) -> f64 {
    let across = cross(a, b);
    dot(across, across).sqrt().atan2(dot(a, b))
}

/// `v` turned in the plane of two unit vectors square to each other, from the first towards the second.
pub fn turn(v: V, from: V, towards: V, (sin, cos): (f64, f64)) -> V {
    let (x, y) = (dot(v, from), dot(v, towards));
    add(v, add(scale(x * (cos - 1.0) - y * sin, from), scale(x * sin + y * (cos - 1.0), towards)))
}

/// `v` turned by a quaternion x, y, z, w.
pub fn rotate(v: V, [x, y, z, w]: [f64; 4]) -> V {
    let axis = [x, y, z];
    let once = scale(2.0, cross(axis, v));
    add(v, add(scale(w, once), cross(axis, once)))
}
