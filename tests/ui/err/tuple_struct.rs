use aim::{AimRig, Joint};

#[derive(AimRig)]
#[aim(bones(up = +X, forward = +Y, left = +Z))]
struct Thug(Joint);

#[derive(AimRig)]
#[aim(bones(up = +X, forward = +Y, left = +Z))]
struct Guard;

fn main() {}
