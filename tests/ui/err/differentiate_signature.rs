use aim::differentiate;
use aim::glam::{DVec3, Vec3};

struct Rig {
    weight: f32,
}

#[differentiate(wrt(x))]
fn mixed(x: f32, v: DVec3) -> f32 {
    x + v.x as f32
}

#[differentiate(wrt(x))]
fn unknown(x: f32, rig: &Rig, out: &mut f32, vec: Vec4) -> Vec3 {
    *out = rig.weight * x;
    vec.truncate()
}

#[differentiate(wrt(x))]
fn of_a_slice(x: f32, rigs: &[Rig]) -> f32 {
    rigs.iter().map(|rig| rig.weight * x).sum()
}

#[differentiate(wrt(x))]
fn generic<T: Into<f32>>(x: f32, t: T) -> f32 {
    x * t.into()
}

#[differentiate(wrt(x))]
async fn later(x: f32) -> f32 {
    x
}

#[differentiate(wrt(x))]
fn nothing(x: f32) {
    let _ = x;
}

impl Rig {
    #[differentiate(wrt(x))]
    fn method(&self, x: f32) -> f32 {
        self.weight * x
    }
}

use aim::glam::Vec4;

fn main() {
    let _ = (mixed, unknown, generic::<f32>, later, nothing, Rig { weight: 1.0 }.method(1.0));
}
