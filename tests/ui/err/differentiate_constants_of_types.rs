use aim::differentiate;

const COUNT: i32 = 3;
const LIMIT: i32 = 2;

#[differentiate(wrt(x))]
fn outside(x: f32) -> f32 {
    if COUNT < LIMIT { x } else { x * x }
}

fn main() {}
