//! [`Function`]: an entry in the tables of supported functions.

use crate::declare::report::Report;
use crate::declare::report::text::Text;
use crate::declare::tree::Notation;
use crate::differentiate::items::Items;
use crate::differentiate::lower::Translation;
use crate::differentiate::lower::algebra::Algebra;
use crate::differentiate::lower::value::Value;

/// Reason why a call has no value.
pub(in crate::differentiate::lower) enum CallError {
    /// The arguments are of kinds that the function does not take.
    Arguments,
    /// The arguments are invalid in another way.
    Message(Text),
    /// The arguments are valid, but the function's formula cannot be evaluated for them.
    Refused(Text),
}

impl From<Text> for CallError {
    fn from(text: Text) -> Self {
        Self::Message(text)
    }
}

/// A function, and the kinds of values that it takes.
pub(in crate::differentiate::lower) struct Function {
    pub(in crate::differentiate::lower) name: &'static str,
    pub(super) takes: &'static [&'static str],
    pub(super) make: fn(&mut Algebra, &[Value]) -> Result<Value, CallError>,
}

impl Function {
    pub(super) fn call(&self, a: &mut Algebra, arguments: &[Value]) -> Result<Value, CallError> {
        (self.make)(a, arguments)
    }

    /// Returns the number of its arguments.
    pub(in crate::differentiate::lower) fn count(&self) -> usize {
        self.takes.len()
    }

    /// Describes its arguments in words; for a method without the receiver.
    pub(in crate::differentiate::lower) fn takes(&self, of_a_method: bool) -> String {
        let takes = &self.takes[usize::from(of_a_method)..];
        if takes.is_empty() {
            return "no arguments".into();
        }
        takes.iter().map(|kind| words(kind)).collect::<Vec<_>>().join(", ")
    }
}

/// Describes a variant of [`Value`] in words.
fn words(kind: &str) -> &'static str {
    match kind {
        "Scalar" => "a number",
        "Integer" => "an integer",
        "Four" => "a 4D vector",
        "Truth" => "a boolean",
        "Planar" => "a 2D vector",
        "Vector" => "a vector",
        "Quaternion" => "a quaternion",
        "Matrix" => "a matrix",
        "Affine" => "a transform",
        "Square" => "a 2×2 or 4×4 matrix",
        "Homogeneous" => "a 4×4 matrix",
        "Tuple" => "a tuple",
        "Struct" => "a mask",
        _ => "an array",
    }
}

/// Evaluates a formula that is written in the interpreted language. Fails only for whole numbers, which may be rounded.
pub(super) fn evaluated(a: &mut Algebra, formula: &str, names: &[&str], values: &[Value]) -> Result<Value, CallError> {
    let names = names.iter().zip(values).map(|(&name, value)| (name.to_owned(), value.clone())).collect();
    let mut report = Report::new(Notation::Rust);
    let (expression, items) = (syn::parse_str(formula), Items::default());
    let value =
        expression.map_or(Value::Unknown, |it| Translation::new(a, &mut report, &items, None).formula(&it, names));
    match report.into_list().first() {
        Some(refused) => Err(CallError::Refused(Text::new(refused.message(), refused.help()))),
        None => Ok(value),
    }
}

/// Evaluates a formula like [`evaluated`], for values that are not whole numbers: it cannot fail.
pub(super) fn evaluate(a: &mut Algebra, formula: &str, names: &[&str], values: &[Value]) -> Value {
    let value = evaluated(a, formula, names, values).unwrap_or(Value::Unknown);
    debug_assert!(!value.is_unknown(), "`{formula}` has a value");
    value
}

/// Defines a table. Argument kinds are variants of [`Value`]: `name(argument: Kind, …) -> Kind { body }`, or
/// `name(argument: Kind, …) = expression;` in the interpreted language.
macro_rules! functions {
    ($(#[$doc:meta])* $table:ident($a:ident):
        $( $name:ident ($($argument:ident : $kind:ident),*) $(-> $result:ident $body:block)? $(= $formula:expr;)? )*
    ) => {
        $(#[$doc])*
        pub(super) const $table: &[$crate::differentiate::lower::methods::function::Function] = &[$(
            $crate::differentiate::lower::methods::function::Function {
                name: stringify!($name),
                takes: &[$(stringify!($kind)),*],
                make: |$a, arguments| {
                    let _ = &$a;
                    match arguments {
                        functions!(@pattern [$($argument: $kind),*] $($result)?) => {
                            Ok(functions!(@value $a arguments [$($argument),*] $($result $body)? $($formula)?))
                        }
                        _ => Err($crate::differentiate::lower::methods::function::CallError::Arguments),
                    }
                },
            },
        )*];
    };
    (@pattern [$($argument:ident: $kind:ident),*] $result:ident) => { [$(Value::$kind($argument)),*] };
    (@pattern [$($argument:ident: $kind:ident),*]) => { [$(Value::$kind(_)),*] };
    (@value $a:ident $arguments:ident [$($argument:ident),*] $result:ident $body:block) => {{
        $( let $argument = Clone::clone($argument); )*
        Value::$result($body)
    }};
    (@value $a:ident $arguments:ident [$($argument:ident),*] $formula:expr) => {{
        let names = &[$(stringify!($argument)),*];
        $crate::differentiate::lower::methods::function::evaluated($a, stringify!($formula), names, $arguments)?
    }};
}
pub(super) use functions;
