use aim::{AimRig, Joint};

#[derive(AimRig)]
#[aim(
    axes(up = +X, forward = +Y, left = +Z),
    natural(eyes_only = 200deg, head_share = 80, engage = 8deg, release = 15deg, delay = 50ms, attention = 1)
)]
struct Thug {
    #[joint(heading = -35deg..=35deg, rate = 450deg)]
    left_eye: Joint,
}

fn main() {}
