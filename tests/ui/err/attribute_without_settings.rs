use aim::{AimRig, Joint};

#[derive(AimRig)]
#[aim]
struct Thug {
    #[joint]
    left_eye: Joint,
}

fn main() {}
