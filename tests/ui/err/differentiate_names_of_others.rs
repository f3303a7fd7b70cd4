use aim::differentiate;

mod consts {
    pub const E: f64 = 200.0;
}
mod material {
    pub const SCALE: f64 = 5.0;
}
mod mem {
    pub fn replace(place: &mut f64, value: f64) -> f64 {
        *place + value
    }
}
fn swap(a: &mut f64, b: &mut f64) {
    *a = *b;
}
const SCALE: f64 = 3.0;

#[differentiate(wrt(x))]
fn of_module(x: f64) -> f64 {
    consts::E * x
}

#[differentiate(wrt(x))]
fn of_function(x: f64) -> f64 {
    let (mut a, mut b) = (x, 2.0 * x);
    swap(&mut a, &mut b);
    a + b
}

#[differentiate(wrt(x))]
fn of_function_in_module(x: f64) -> f64 {
    let mut a = x;
    a * mem::replace(&mut a, 1.0)
}

#[differentiate(wrt(x))]
fn behind_a_glob_import(x: f64) -> f64 {
    use material::*;
    SCALE * x
}

fn main() {
    assert_eq!(of_module(1.0) + of_function(1.0) + behind_a_glob_import(SCALE) + of_function_in_module(1.0), 219.0);
}
