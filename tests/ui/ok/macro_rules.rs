// Fragments of `macro_rules!` arrive in invisible groups.
mod reexport {
    pub use aim;
}

macro_rules! rig {
    ($name:ident, $eye:ident, $low:literal, $high:expr, $rate:literal, $facade:path, $side:tt, [$($x:literal),*]) => {
        #[derive(::aim::AimRig)]
        #[aim(axes(up = +X, forward = +Y), handedness = $side, effector(origin = ($($x),*)), crate = $facade)]
        struct $name {
            #[joint(heading = $low..=$high, rate = $rate, bone = "eye")]
            $eye: ::aim::Joint,
        }
    };
}

macro_rules! outer {
    ($low:literal, $rate:literal) => {
        rig!(Thug, left_eye, $low, 35deg, $rate, $crate::reexport::aim, left, [0.0, -0.1, 2]);
    };
}

outer!(-20deg, 450deg);

fn main() {
    let _ = <Thug as ::aim::AimRig>::RIG;
}
