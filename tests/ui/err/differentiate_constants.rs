use aim::differentiate;
use aim::glam::Vec3;

const UP: Vec3 = Vec3::Y;
const SHARES: [f32; 3] = [0.5, 0.3, 0.2];
const COUNT: usize = size_of::<f32>();
const DEBUG: bool = cfg!(debug_assertions);

#[differentiate(wrt(x))]
fn part(x: f32) -> f32 {
    (x * UP).y
}

#[differentiate(wrt(x))]
fn argument(x: f32, v: Vec3) -> f32 {
    x * v.dot(UP)
}

#[differentiate(wrt(x))]
fn element(x: f32) -> f32 {
    x * SHARES[0]
}

#[differentiate(wrt(x))]
fn elements(x: f32) -> f32 {
    let mut sum = x;
    for share in SHARES {
        sum += share;
    }
    sum * SHARES.iter().sum::<f32>()
}

#[differentiate(wrt(x))]
fn whole(x: f32) -> f32 {
    x * (COUNT - 1) as f32
}

#[differentiate(wrt(x))]
fn rounds(x: f32) -> f32 {
    let mut sum = x;
    for _ in 0..COUNT {
        sum *= if DEBUG { x } else { 1.0 };
    }
    sum
}

fn main() {}
