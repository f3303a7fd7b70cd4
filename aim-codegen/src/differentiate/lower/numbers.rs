//! The mathematical constants of the standard library.

use core::f64::consts;

macro_rules! by_name {
    ($($name:ident)*) => { &[$((stringify!($name), consts::$name)),*] };
}

/// `core::f32::consts::PI` and its like.
const NUMBERS: &[(&str, f64)] = by_name! {
    E FRAC_1_PI FRAC_1_SQRT_2 FRAC_2_PI FRAC_2_SQRT_PI FRAC_PI_2 FRAC_PI_3 FRAC_PI_4 FRAC_PI_6 FRAC_PI_8 LN_10 LN_2
    LOG10_2 LOG10_E LOG2_10 LOG2_E PI SQRT_2 TAU
};

/// The mathematical constant of this name.
pub(super) fn mathematical(name: &str) -> Option<f64> {
    NUMBERS.iter().find(|(known, _)| *known == name).map(|&(_, value)| value)
}

/// The names of the mathematical constants.
pub(super) fn names() -> impl Iterator<Item = &'static str> {
    NUMBERS.iter().map(|(name, _)| *name)
}

/// True if there is a mathematical constant of this name.
pub(in crate::differentiate) fn is_mathematical(name: &str) -> bool {
    mathematical(name).is_some()
}
