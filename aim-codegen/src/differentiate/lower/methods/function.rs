//! [`Function`]: an entry of the tables of what can be called.

use crate::declare::report::Report;
use crate::declare::report::text::Text;
use crate::declare::tree::Notation;
use crate::differentiate::items::Items;
use crate::differentiate::lower::Translation;
use crate::differentiate::lower::algebra::Algebra;
use crate::differentiate::lower::value::Value;

/// Why a call came to nothing.
pub(in crate::differentiate::lower) enum Fault {
    /// The arguments are of other kinds.
    Arguments,
    /// They are wrong in another way.
    Text(Text),
    /// They are right for it, and its formula is refused for them.
    Refused(Text),
}

impl From<Text> for Fault {
    fn from(text: Text) -> Self {
        Self::Text(text)
    }
}

/// A function, and the kinds of values that it takes.
pub(in crate::differentiate::lower) struct Function {
    pub(in crate::differentiate::lower) name: &'static str,
    pub(super) takes: &'static [&'static str],
    pub(super) make: fn(&mut Algebra, &[Value]) -> Result<Value, Fault>,
}

impl Function {
    pub(super) fn call(&self, a: &mut Algebra, arguments: &[Value]) -> Result<Value, Fault> {
        (self.make)(a, arguments)
    }

    /// The number of its arguments.
    pub(in crate::differentiate::lower) fn count(&self) -> usize {
        self.takes.len()
    }

    /// Its arguments in words; those of a method stand without the receiver.
    pub(in crate::differentiate::lower) fn takes(&self, of_a_method: bool) -> String {
        let takes = &self.takes[usize::from(of_a_method)..];
        if takes.is_empty() {
            return "nothing".into();
        }
        takes.iter().map(|kind| words(kind)).collect::<Vec<_>>().join(", ")
    }
}

/// A variant of [`Value`] in words.
fn words(kind: &str) -> &'static str {
    match kind {
        "Scalar" => "a number",
        "Integer" => "a whole number",
        "Four" => "a vector of four",
        "Truth" => "a condition",
        "Planar" => "a vector of two",
        "Vector" => "a vector",
        "Quaternion" => "a quaternion",
        "Matrix" => "a matrix",
        "Affine" => "a transform",
        "Square" => "a matrix of two or four",
        "Homogeneous" => "a matrix of four",
        "Tuple" => "a tuple",
        _ => "an array",
    }
}

/// The value of an expression of the language that is translated, or why there is none: of whole numbers alone, which are rounded.
pub(super) fn evaluated(a: &mut Algebra, formula: &str, names: &[&str], values: &[Value]) -> Result<Value, Fault> {
    let names = names.iter().zip(values).map(|(&name, value)| (name.to_owned(), value.clone())).collect();
    let mut report = Report::new(Notation::Rust);
    let (expression, items) = (syn::parse_str(formula), Items::default());
    let value =
        expression.map_or(Value::Unknown, |it| Translation::new(a, &mut report, &items, None).formula(&it, names));
    match report.into_list().first() {
        Some(refused) => Err(Fault::Refused(Text::new(refused.message(), refused.help()))),
        None => Ok(value),
    }
}

/// The same of values that are no whole numbers.
pub(super) fn evaluate(a: &mut Algebra, formula: &str, names: &[&str], values: &[Value]) -> Value {
    let value = evaluated(a, formula, names, values).unwrap_or(Value::Unknown);
    debug_assert!(!value.is_unknown(), "`{formula}` has a value");
    value
}

/// Entries of a table, of arguments whose kinds are variants of [`Value`]: `name(argument: Kind, …) -> Kind { body }`, or
/// `name(argument: Kind, …) = expression;` in the language that is translated.
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
                        _ => Err($crate::differentiate::lower::methods::function::Fault::Arguments),
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
