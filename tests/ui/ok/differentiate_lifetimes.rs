// Companions have the lifetimes of the function.
#![deny(warnings)]
#![allow(clippy::needless_lifetimes)]

use aim::differentiate;

#[differentiate(wrt(x))]
fn line<'a, 'b: 'a>(x: f32, slopes: &'a [f32], start: &'b f32) -> f32
where
    'b: 'b,
{
    slopes.iter().map(|slope| slope * x).sum::<f32>() + start
}

#[differentiate(wrt(x), hessian, lanes)]
fn plane<'a>(x: f32, by: &'a [f32; 2], at: &'a f32) -> f32 {
    x * x * by[0] * by[1] * at
}

fn main() {
    assert_eq!(line_gradient(2.0, &[1.0, 3.0], &0.5), (8.5, (4.0,)));
    assert_eq!(plane_hessian(2.0, &[1.0, 3.0], &0.5), (6.0, (6.0,), [[3.0]]));
    assert_eq!(plane_gradient_lanes(2.0f32, &[1.0, 3.0], &0.5), (6.0, (6.0,)));
    let _ = (line(1.0, &[], &1.0), plane(1.0, &[1.0; 2], &1.0));
}
