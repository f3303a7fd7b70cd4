use aim::{AimRig, Joint};

#[derive(AimRig)]
#[aim(axes(up = +X, forward = +Y, left = +Z))]
struct Thug(Joint);

#[derive(AimRig)]
#[aim(axes(up = +X, forward = +Y, left = +Z))]
struct Guard;

fn main() {}
