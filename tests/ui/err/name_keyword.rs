use aim::{AimRig, Joint};

#[derive(AimRig)]
#[aim(axes(up = +X, forward = +Y, left = +Z))]
struct Switch {
    #[joint(heading = -35deg..=35deg, rate = 450deg)]
    float: Joint,
    #[joint(heading = -35deg..=35deg, rate = 450deg)]
    r#fn: Joint,
}

fn main() {}
