use aim::differentiate;

const COUNT: i32 = 3_i32.count_ones() as i32;
const LIMIT: i32 = size_of::<f32>() as i32;

#[differentiate(wrt(x))]
fn outside(x: f32) -> f32 {
    if COUNT < LIMIT { x } else { x * x }
}

mod other {
    pub const TIMES: usize = 2;
}

macro_rules! constant {
    ($name:ident) => {
        const $name: usize = 3;
    };
}

constant!(TIMES);

#[differentiate(wrt(x))]
fn of_another(x: f32) -> f32 {
    x * TIMES as f32 + other::TIMES as f32
}

fn main() {}
