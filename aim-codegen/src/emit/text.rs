//! Text that C and WGSL share: names, comments, expressions.

use aim_symbolic::print::Dialect;
use aim_symbolic::{Function as Mathematical, Program};

use crate::RigSpec;
use crate::objective::{Function, Scope};

/// Floating-point precision of an emitted function.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Precision {
    /// 32-bit.
    Single,
    /// 64-bit.
    Double,
}

impl Precision {
    /// Returns the name of the number type in Rust.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Single => "f32",
            Self::Double => "f64",
        }
    }
}

/// A function of numbers, to be declared in C or WGSL.
#[derive(Debug)]
pub struct Procedure<'a> {
    /// Name of the function.
    pub name: String,
    /// Lines of the comment above the function.
    pub doc: Vec<String>,
    /// Name of each parameter and its number of elements, `None` for a single number; in the order of the program's
    /// inputs.
    pub parameters: Vec<(String, Option<usize>)>,
    /// Precision of all numbers.
    pub precision: Precision,
    /// Program that the function computes.
    pub program: &'a Program,
}

/// Points in which the languages differ.
pub(super) struct Language {
    /// Parameter name of a rig's target; `target` is a reserved word in WGSL.
    pub(super) target: &'static str,
    /// Suffixes of library function names, in single and in double precision.
    pub(super) suffixes: [&'static str; 2],
    /// Formats `then` if `a < b`, else `otherwise`.
    pub(super) select_less: fn(a: &str, b: &str, then: &str, otherwise: &str) -> String,
    /// Formats `a` to the power of `b`; the third argument is the suffix of library functions.
    pub(super) pow: fn(a: &str, b: &str, suffix: &str) -> String,
}

/// Returns the header lines of a file of rig kernels that hold in every language.
pub(super) fn header(spec: &RigSpec) -> Vec<String> {
    let mut lines = vec![
        written(&format!("Aim solver kernels of the rig {}", spec.name)),
        "Pitch turns a joint's forward towards its up, heading towards its left; pitch acts first.".to_owned(),
    ];
    lines.extend(spec.joints.iter().map(|joint| {
        let frame = joint.frame;
        format!("{}: up {:?}, forward {:?}, left {:?}", joint.name, frame.up, frame.forward, frame.left)
    }));
    lines
}

/// Returns the line that says which tool wrote the file.
pub(super) fn written(what: &str) -> String {
    format!("{what}, derived and written by aim {}. Do not edit: generate again.", env!("CARGO_PKG_VERSION"))
}

/// Returns a rig's kernel as a procedure.
pub(super) fn procedure<'a>(function: &Function<'a>, spec: &RigSpec, language: &Language) -> Procedure<'a> {
    let target = language.target;
    let program = &function.kernel.program;
    let (inputs, parameters) = match function.kernel.objective.scope {
        Scope::Joint => (
            [
                "effector_to_joint: rows m0, m1, m2 of the 3x3, then the translation (row vectors, rigid);".to_owned(),
                format!("{target} in the joint's space; zeros where it is on the effector."),
            ],
            vec![
                ("effector_to_joint", Some(12)),
                (target, Some(3)),
                ("sin_p", None),
                ("cos_p", None),
                ("sin_h", None),
                ("cos_h", None),
            ],
        ),
        Scope::Chain => (
            [
                format!("links: effector to joint 0, then joint i-1 to joint i; {target} in the last joint's space;"),
                "sin_cos: sin_p, cos_p, sin_h, cos_h per joint from the effector inward.".to_owned(),
            ],
            vec![("links", Some(12 * spec.joints.len())), (target, Some(3)), ("sin_cos", Some(4 * spec.joints.len()))],
        ),
    };
    let mut doc = vec![function.outputs(spec)];
    doc.extend(inputs);
    doc.push(format!("{}.", program.count()));
    Procedure {
        name: function.name(spec),
        doc,
        parameters: parameters.into_iter().map(|(name, elements)| (name.to_owned(), elements)).collect(),
        precision: Precision::Single,
        program,
    }
}

/// Formats the expressions of a function in one language.
pub(super) struct Expressions<'a> {
    pub(super) procedure: &'a Procedure<'a>,
    pub(super) language: &'a Language,
}

impl Expressions<'_> {
    fn suffix(&self) -> &'static str {
        self.language.suffixes[usize::from(self.procedure.precision == Precision::Double)]
    }
}

impl Dialect for Expressions<'_> {
    fn input(&self, index: usize) -> String {
        let mut place = index;
        for (name, elements) in &self.procedure.parameters {
            let size = elements.unwrap_or(1);
            if place < size {
                return if elements.is_some() { format!("{name}[{place}]") } else { name.clone() };
            }
            place -= size;
        }
        unreachable!("a function has no input {index}")
    }

    /// Formats the shortest decimal that parses back to the same number. The suffix gives it the right type in both
    /// languages. WGSL has no literals for non-finite numbers.
    #[expect(clippy::cast_possible_truncation, reason = "the emitted function may compute in 32 bits")]
    fn constant(&self, value: f64) -> String {
        match self.procedure.precision {
            _ if value.is_nan() => "NAN".to_owned(),
            Precision::Single if (value as f32).is_finite() => format!("{:?}f", value as f32),
            Precision::Double if value.is_finite() => format!("{value:?}"),
            _ if value > 0.0 => "INFINITY".to_owned(),
            _ => "-INFINITY".to_owned(),
        }
    }

    /// Square root of the smallest normal number.
    fn tiny(&self) -> String {
        match self.procedure.precision {
            Precision::Single => "1.0842022e-19f".to_owned(),
            Precision::Double => "1.4916681462400413e-154".to_owned(),
        }
    }

    fn sqrt(&self, a: &str) -> String {
        format!("sqrt{}({a})", self.suffix())
    }

    fn select_less(&self, a: &str, b: &str, then: &str, otherwise: &str) -> String {
        (self.language.select_less)(a, b, then, otherwise)
    }

    fn call(&self, function: Mathematical, a: &str) -> String {
        // The natural logarithm is called `log` in both languages.
        let name = if function == Mathematical::Ln { "log" } else { function.name() };
        format!("{name}{}({a})", self.suffix())
    }

    fn atan2(&self, y: &str, x: &str) -> String {
        format!("atan2{}({y}, {x})", self.suffix())
    }

    fn pow(&self, a: &str, b: &str) -> String {
        (self.language.pow)(a, b, self.suffix())
    }
}
