//! What the back ends with flat arrays of 32-bit floats share: the inputs' places, and how numbers are written.

use aim_symbolic::Function;

/// What a function is given, in the order of its program's inputs.
#[derive(Clone, Copy)]
pub(super) enum Inputs {
    /// A link, the target, and the sines and cosines one by one.
    Joint,
    /// Every link, the target, and all sines and cosines.
    Chain { joints: usize },
}

impl Inputs {
    /// The input with this index, where the target's array has this name.
    pub(super) fn name(self, index: usize, target: &str) -> String {
        match self {
            Self::Joint => match index {
                0..12 => format!("effector_to_joint[{index}]"),
                12..15 => format!("{target}[{}]", index - 12),
                15 => "sin_p".to_owned(),
                16 => "cos_p".to_owned(),
                17 => "sin_h".to_owned(),
                _ => "cos_h".to_owned(),
            },
            Self::Chain { joints } => {
                let links = 12 * joints;
                match index {
                    _ if index < links => format!("links[{index}]"),
                    _ if index < links + 3 => format!("{target}[{}]", index - links),
                    _ => format!("sin_cos[{}]", index - links - 3),
                }
            }
        }
    }
}

/// The smallest length that is divided by: the square root of the smallest normal number.
pub(super) const TINY: &str = "1.0842022e-19f";

/// The shortest decimal that reads back as the same float; with the suffix it is of that type in either language.
#[expect(clippy::cast_possible_truncation, reason = "the emitted functions compute in 32 bits")]
pub(super) fn literal(value: f64) -> String {
    format!("{:?}f", value as f32)
}

/// The name of a function where the natural logarithm is `log`.
pub(super) fn library_name(function: Function) -> &'static str {
    match function {
        Function::Ln => "log",
        other => other.name(),
    }
}
