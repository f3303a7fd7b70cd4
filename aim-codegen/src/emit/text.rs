//! The text that C and WGSL have in common: names, comments, expressions.

use aim_symbolic::print::Dialect;
use aim_symbolic::{Function as Mathematical, Program};

use crate::RigSpec;
use crate::objective::{Function, Scope};

/// The numbers that a function computes with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Precision {
    /// 32 bits.
    Single,
    /// 64 bits.
    Double,
}

impl Precision {
    /// The number type's name in Rust.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Single => "f32",
            Self::Double => "f64",
        }
    }
}

/// A function of numbers as other languages declare it.
#[derive(Debug)]
pub struct Procedure<'a> {
    /// Its name.
    pub name: String,
    /// What it computes, in lines.
    pub doc: Vec<String>,
    /// Each parameter's name with the number of its elements, `None` for a single number, in the order of the program's
    /// inputs.
    pub parameters: Vec<(String, Option<usize>)>,
    /// What it computes with.
    pub precision: Precision,
    /// What it computes.
    pub program: &'a Program,
}

/// The parts of a language that its functions differ in.
pub(super) struct Language {
    /// What it calls a rig's target: WGSL reserves the word alone.
    pub(super) target: &'static str,
    /// What follows the names of the library's functions in single and in double precision.
    pub(super) suffixes: [&'static str; 2],
    /// `then` where `a < b`, else `otherwise`.
    pub(super) select_less: fn(a: &str, b: &str, then: &str, otherwise: &str) -> String,
    /// The power of `a` by `b`; the suffix of functions.
    pub(super) pow: fn(a: &str, b: &str, suffix: &str) -> String,
}

/// The lines at the head of a file of a rig's kernels, but for what holds in one language only.
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

/// The line that says what wrote a file.
pub(super) fn written(what: &str) -> String {
    format!("{what}, derived and written by aim {}. Do not edit: generate again.", env!("CARGO_PKG_VERSION"))
}

/// A rig's kernel.
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

/// The expressions of a function in a language.
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

    /// The shortest decimal that reads back as the same number; with the suffix it is of that type in either language. WGSL has
    /// no number that is not finite.
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

    /// The square root of the smallest normal number.
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
        // The natural logarithm is `log` in both languages.
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
