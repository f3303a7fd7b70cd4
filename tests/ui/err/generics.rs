use aim::AimRig;

#[derive(AimRig)]
#[aim(axes(up = +X, forward = +Y, left = +Z))]
struct Thug<T> {
    #[joint(heading = -35deg..=35deg, rate = 450deg)]
    left_eye: T,
}

fn main() {}
