use aim::AimRig;

#[derive(AimRig)]
#[aim(bones(up = +X, forward = +Y, left = +Z))]
struct Thug {}

fn main() {}
