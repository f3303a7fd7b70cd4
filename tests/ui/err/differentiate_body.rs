use aim::differentiate;
use aim::glam::{Mat3, Quat, Vec3};

const GAIN: f32 = 2.0;

fn helper(x: f32) -> f32 {
    x
}

#[differentiate(wrt(x))]
fn statements(x: f32, v: Vec3) -> f32 {
    let mut sum = x;
    for _ in 0..3 {
        sum += x;
    }
    debug_assert!(x > 0.0);
    if x > 1.0 {
        return sum;
    }
    let twice = |y: f32| 2.0 * y;
    let z = match x > 0.5 {
        true => 1.0,
        false => v.z,
    };
    twice(z)
}

#[differentiate(wrt(x))]
fn calls(x: f32, v: Vec3, m: Mat3) -> f32 {
    let a = x.powf(1.5) + helper(x) * GAIN + f32::INFINITY;
    let b = v.any_orthonormal_vector().x + x.floor();
    let c = Quat::from_axis_angle(Vec3::ONE, x) * v;
    let d = Quat::from_mat3(&m) * v;
    let e = x % 2.0 + x.powi(2 + 1);
    let f = (x as f64) as f32;
    a + b + c.x + d.y + e + f + Vec3 { x, y: x, z: x }.y
}

// One error: what uses the derivatives finds them.
#[differentiate(wrt(x, v))]
fn used(x: f32, v: Vec3) -> f32 {
    x.sinh() * v.x
}

fn main() {
    let (value, (by_x, by_v)): (f32, (f32, Vec3)) = used_gradient(1.0, Vec3::X);
    let _ = (value, by_x, by_v, statements_gradient(1.0, Vec3::X), calls_gradient(1.0, Vec3::X, Mat3::IDENTITY));
}
