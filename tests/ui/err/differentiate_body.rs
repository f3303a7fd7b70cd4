use aim::differentiate;
use aim::glam::{EulerRot, Mat3, Quat, Vec3};

struct Outside;

impl Outside {
    const GAIN: f32 = 2.0;
}

fn helper(x: f32) -> f32 {
    x
}

#[differentiate(wrt(x))]
fn statements(x: f32, v: Vec3) -> f32 {
    println!("{x}");
    x.sin();
    let Some(z) = "3".parse().ok() else { return x };
    z
}

#[differentiate(wrt(x))]
fn captures(x: f32) -> f32 {
    let mut sum = x;
    let mut count = |y: f32| sum += y;
    let mut twice = || {
        count(x);
        count(x);
    };
    twice();
    sum
}

#[differentiate(wrt(x))]
fn endless(x: f32) -> f32 {
    let mut sum = x;
    loop {
        sum += x;
        if sum > 10.0 {
            break;
        }
    }
    sum
}

#[differentiate(wrt(x))]
fn loops(x: f32, points: [Vec3; 3], count: usize) -> f32 {
    let mut sum = 0.0;
    for i in 0..count {
        sum += points[i].x;
    }
    while sum < 1.0 {
        sum += x;
    }
    for _ in 0.. {
        sum += points[count].y;
    }
    for i in 0..4 {
        sum += points[i].z * x;
    }
    let _ = points.iter().map(|p| sum += p.x);
    points.iter().filter(|p| p.x > x).step_by(2).map(|p| p.y).sum::<f32>() + sum
}

#[differentiate(wrt(x), jvp)]
fn long(x: f32) -> f32 {
    let mut sum = x;
    for i in 0..9_000 {
        sum = (sum * x + i as f32).sin();
    }
    sum
}

#[differentiate(wrt(x))]
fn calls(x: f32, v: Vec3, m: Mat3, n: i32) -> f32 {
    let a = x.next_down() + helper(x) * Outside::GAIN;
    let b = v.any_orthonormal_vector().x + x.next_up();
    let c = Quat::from_axis_angle(Vec3::ONE, x) * v;
    let d = m.x_axis * DVec3::from(m).x;
    let e = (v % v).x + n.pow(n as u32) as f32;
    let f = (x as f64) as f32;
    a + b + c.x + d.y + e + f + [1.0, 2.0][n as u8 as usize]
}

#[differentiate(wrt(x))]
fn types_of_glam(x: f32, m: Affine3A, q: Quat, v: Vec2) -> f32 {
    let scaled = Affine2::from_scale(v * x).transform_point2(v);
    let (scale, ..) = m.to_scale_rotation_translation();
    let four = Vec4::from(m).x + Vec2::select(v.cmplt(Vec2::ONE), v, 1.0).x;
    scaled.x + scale.x + four + Affine2::IDENTITY.translation.x
}

#[differentiate(wrt(x))]
fn unsupported_type(x: f32, m: Affine2) -> f32 {
    x
}

// One error: what uses the derivatives finds them.
#[differentiate(wrt(x, v))]
fn used(x: f32, v: Vec3) -> f32 {
    x.to_degrees().next_down() * v.x
}

const WALKING: i32 = 1;

#[differentiate(wrt(x))]
fn gait(x: f32, gait: i32) -> f32 {
    match gait {
        WALKING => x,
        _ => x * x,
    }
}

#[differentiate(wrt(x))]
fn ring(x: f32, n: i32) -> f32 {
    [x, x * x][(n as usize + 1) % 2]
}

#[differentiate(wrt(x))]
fn steps(x: f32, n: i32, m: i32) -> f32 {
    let euclid = (n as usize + 1).rem_euclid(2);
    let back = n as usize - m as usize;
    let beyond = 9007199254740991i64.abs_diff(-2);
    x * (euclid + back + beyond as usize) as f32
}

#[differentiate(wrt(x))]
fn bits(x: f32, n: usize) -> f32 {
    let last = n & 1;
    let high = 200 << 1;
    let signed: i32 = -1;
    let before = n.saturating_sub(1) + signed.saturating_sub(3) as usize;
    let known = 1 / (3 - 3);
    x * (last + high + before + known) as f32
}

#[differentiate(wrt(x))]
fn error_told(x: f64) -> f64 {
    let known = if x > 0.0 { Ok(x) } else { Err(2.0) };
    match known {
        Ok(value) => value,
        Err(told) => told * told,
    }
}

#[differentiate(wrt(x))]
fn error_used(x: f64) -> f64 {
    let known = if x > 0.0 { Ok(x) } else { Err(2.0 * x) };
    known.unwrap_or_else(|told| told)
}

#[differentiate(wrt(x))]
fn printed(x: f64) -> f64 {
    println!("{x}");
    dbg!(x * x)
}

#[differentiate(wrt(v))]
fn of_arrays(v: Vec3) -> Vec3 {
    v.map(|c| c * c)
}

#[differentiate(wrt(q))]
fn yaw(q: Quat) -> f32 {
    q.to_euler(EulerRot::YXZ).0
}

fn main() {
    let (value, (by_x, by_v)): (f32, (f32, Vec3)) = used_gradient(1.0, Vec3::X);
    let _ = (value, by_x, by_v, statements_gradient(1.0, Vec3::X), calls_gradient(1.0, Vec3::X, Mat3::IDENTITY, 1));
}
