use aim::{AimRig, Joint};

#[derive(AimRig)]
#[aim(axes(up = +X, forward = +Y, left = +Z))]
enum Thug {
    Eye(Joint),
}

#[derive(AimRig)]
#[aim(axes(up = +X, forward = +Y, left = +Z))]
union Guard {
    eye: Joint,
}

fn main() {}
