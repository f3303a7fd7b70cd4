use aim::glam::{Quat, Vec3};
use aim::{Rigid, differentiate};

#[differentiate]
fn without_variables(x: f32) -> f32 {
    x
}

#[differentiate(wrt(headin, pitch, pitch), bugdet = 46)]
fn names(heading: f32, pitch: f32) -> f32 {
    heading * pitch
}

#[differentiate(wrt(a, p))]
fn by_parts((a, _b): (f32, f32), &p: &f32) -> f32 {
    a * p
}

#[differentiate(wrt(v.x, tangent(q.w)))]
fn by_fields(v: Vec3, q: Quat) -> f32 {
    v.x * q.w
}

#[differentiate(wrt(x))]
#[differentiate(wrt(y))]
fn by_each(x: f32, y: f32) -> f32 {
    x * y
}

#[differentiate(wrt(m))]
fn by_a_transform(m: Rigid, v: Vec3) -> f32 {
    m.transform_point3(v).x
}

#[differentiate(wrt(tangent(x), tangent(v)))]
fn by_tangents_of_numbers(x: f32, v: Vec3) -> f32 {
    v.x * x
}

#[differentiate(wrt(q), perturbation = left)]
fn without_a_side(q: Quat) -> f32 {
    q.x
}

#[differentiate(wrt(tangent(q, p), q), perturbation = up)]
fn twice(q: Quat) -> f32 {
    q.x
}

#[differentiate(wrt(tangent(tangent(q)), tangents(q), tangent = q))]
fn nested(q: Quat) -> f32 {
    q.x
}

#[differentiate(wrt(tangent()))]
fn by_no_tangent(q: Quat) -> f32 {
    q.x
}

#[differentiate(wrt(), budget = "few", hessian = 2, hessian, check)]
fn forms(x: f32) -> f32 {
    x
}

#[differentiate(wrt(x), budget = 1)]
fn dear(x: f32, y: f32) -> f32 {
    x * y + 1.0
}

#[differentiate(wrt(x), budget(operations = 9, selects = 1, calls = 1, call = 0))]
fn chosen(x: f32) -> f32 {
    x.abs().sin()
}

#[differentiate(wrt(x), budget(selects = 1, calls = 1))]
fn chosen_dearly(x: f32) -> f32 {
    x.abs().sin()
}

#[differentiate(wrt(x), lengths(values = 3, x = 2, other = 1))]
fn sized(x: f32, values: &[f32], rest: &[f32]) -> f32 {
    x * values[3] + rest[0]
}

#[differentiate(wrt(x), lengths(values = -1))]
fn sized_by_nonsense(x: f32, values: &[f32]) -> f32 {
    x * values[0]
}

#[differentiate(wrt(x), lengths = 3)]
fn sized_by_nobody(x: f32, values: &[f32]) -> f32 {
    x * values[0]
}

#[differentiate(wrt(x), hessian, hvp)]
fn hessian_of_a_vector(x: f32, v: Vec3) -> Vec3 {
    v * x
}

#[differentiate(wrt(x))]
struct NoFunction {
    x: f32,
}

fn main() {}
