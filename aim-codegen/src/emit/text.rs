//! The text that C and WGSL have in common: comments, the inputs' places, and expressions.

use aim_symbolic::Function as Mathematical;
use aim_symbolic::print::Dialect;

use crate::RigSpec;
use crate::objective::{Function, Scope};

/// The lines at the head of a file, but for what holds in one language only.
pub(super) fn header(spec: &RigSpec) -> Vec<String> {
    let mut lines = vec![
        format!(
            "Aim solver kernels of the rig {}, derived and written by aim {}. Do not edit: generate again.",
            spec.name,
            env!("CARGO_PKG_VERSION")
        ),
        "Pitch turns a joint's forward towards its up, heading towards its left; pitch acts first.".to_owned(),
    ];
    lines.extend(spec.joints.iter().map(|joint| {
        let frame = joint.frame;
        format!("{}: up {:?}, forward {:?}, left {:?}", joint.name, frame.up, frame.forward, frame.left)
    }));
    lines
}

/// What a language calls the target, and how it is spoken of again.
#[derive(Clone, Copy)]
pub(super) struct Target {
    pub(super) name: &'static str,
    pub(super) again: &'static str,
}

/// The lines above a function: its outputs, its inputs, its operations.
pub(super) fn doc(function: &Function<'_>, spec: &RigSpec, Target { name, again }: Target) -> Vec<String> {
    let inputs = match function.kernel.objective.scope {
        Scope::Joint => [
            "effector_to_joint: rows m0, m1, m2 of the 3x3, then the translation (row vectors, rigid);".to_owned(),
            format!("{name} in the joint's space; zeros where {again} is on the effector."),
        ],
        Scope::Chain => [
            format!("links: effector to joint 0, then joint i-1 to joint i; {name} in the last joint's space;"),
            "sin_cos: sin_p, cos_p, sin_h, cos_h per joint from the effector inward.".to_owned(),
        ],
    };
    let count = format!("{}.", function.kernel.program.count());
    [function.outputs(spec)].into_iter().chain(inputs).chain([count]).collect()
}

/// A function's parameters, in the order of its program's inputs.
#[derive(Clone, Copy)]
pub(super) enum Parameters {
    /// A link, the target, and the sines and cosines one by one.
    Joint,
    /// Every link, the target, and all sines and cosines.
    Chain { joints: usize },
}

impl Parameters {
    pub(super) fn of(scope: Scope, spec: &RigSpec) -> Self {
        match scope {
            Scope::Joint => Self::Joint,
            Scope::Chain => Self::Chain { joints: spec.joints.len() },
        }
    }

    /// Each parameter's name with the number of its elements, `None` for a single number.
    pub(super) fn list(self, target: &'static str) -> Vec<(&'static str, Option<usize>)> {
        match self {
            Self::Joint => {
                let angles = ["sin_p", "cos_p", "sin_h", "cos_h"].map(|name| (name, None));
                [("effector_to_joint", Some(12)), (target, Some(3))].into_iter().chain(angles).collect()
            }
            Self::Chain { joints } => {
                vec![("links", Some(12 * joints)), (target, Some(3)), ("sin_cos", Some(4 * joints))]
            }
        }
    }

    /// The input with this number.
    pub(super) fn input(self, number: usize, target: &'static str) -> String {
        let mut place = number;
        for (name, elements) in self.list(target) {
            match elements {
                None if place == 0 => return name.to_owned(),
                Some(elements) if place < elements => return format!("{name}[{place}]"),
                elements => place -= elements.unwrap_or(1),
            }
        }
        unreachable!("a kernel has no input {number}")
    }
}

/// The expressions of a function.
pub(super) struct Expressions {
    pub(super) parameters: Parameters,
    pub(super) target: Target,
    /// What follows the names of the library's functions.
    pub(super) suffix: &'static str,
    /// `then` where `a < b`, else `otherwise`.
    pub(super) select_less: fn(a: &str, b: &str, then: &str, otherwise: &str) -> String,
}

impl Dialect for Expressions {
    fn input(&self, index: usize) -> String {
        self.parameters.input(index, self.target.name)
    }

    /// The shortest decimal that reads back as the same float; with the suffix it is of that type in either language.
    #[expect(clippy::cast_possible_truncation, reason = "the emitted functions compute in 32 bits")]
    fn constant(&self, value: f64) -> String {
        format!("{:?}f", value as f32)
    }

    /// The square root of the smallest normal number.
    fn tiny(&self) -> String {
        "1.0842022e-19f".to_owned()
    }

    fn sqrt(&self, a: &str) -> String {
        format!("sqrt{}({a})", self.suffix)
    }

    fn select_less(&self, a: &str, b: &str, then: &str, otherwise: &str) -> String {
        (self.select_less)(a, b, then, otherwise)
    }

    fn call(&self, function: Mathematical, a: &str) -> String {
        // The natural logarithm is `log` in both languages.
        let name = if function == Mathematical::Ln { "log" } else { function.name() };
        format!("{name}{}({a})", self.suffix)
    }

    fn atan2(&self, y: &str, x: &str) -> String {
        format!("atan2{}({y}, {x})", self.suffix)
    }
}
