//! Constants of the standard library that are known by name.

use core::f64::consts;

macro_rules! by_name {
    ($($name:ident)*) => { &[$((stringify!($name), consts::$name)),*] };
}

/// Constants of `core::f32::consts`, by name.
const NUMBERS: &[(&str, f64)] = by_name! {
    E FRAC_1_PI FRAC_1_SQRT_2 FRAC_2_PI FRAC_2_SQRT_PI FRAC_PI_2 FRAC_PI_3 FRAC_PI_4 FRAC_PI_6 FRAC_PI_8 LN_10 LN_2
    LOG10_2 LOG10_E LOG2_10 LOG2_E PI SQRT_2 TAU
};

/// Returns the mathematical constant with this name.
pub(super) fn mathematical(name: &str) -> Option<f64> {
    NUMBERS.iter().find(|(known, _)| *known == name).map(|&(_, value)| value)
}

/// Variants of `std::cmp::Ordering`.
pub(super) const ORDERINGS: [&str; 3] = ["Less", "Equal", "Greater"];

/// Returns `true` for the name of a constant or a variant of the standard library that is often imported.
pub(super) fn is_known(name: &str) -> bool {
    mathematical(name).is_some() || ORDERINGS.contains(&name)
}

/// Returns the names that a glob import of this path in the standard library brings into scope.
pub(in crate::differentiate) fn names_at(path: &[String]) -> impl Iterator<Item = &'static str> {
    let last = path.last().map_or("", String::as_str);
    let numbers = NUMBERS.iter().filter(move |_| last == "consts").map(|(name, _)| *name);
    numbers.chain(ORDERINGS.into_iter().filter(move |_| last == "Ordering"))
}
