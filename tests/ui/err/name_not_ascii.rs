use aim::{AimRig, Joint};

#[derive(AimRig)]
#[aim(axes(up = +X, forward = +Y, left = +Z))]
struct Thüg {
    #[joint(heading = -35deg..=35deg, rate = 450deg)]
    œil: Joint,
}

fn main() {}
