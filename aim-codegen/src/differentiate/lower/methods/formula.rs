//! Functions whose bodies are written in the language that is translated.

use crate::declare::report::Report;
use crate::declare::tree::Notation;
use crate::differentiate::lower::Translation;
use crate::differentiate::lower::algebra::Algebra;
use crate::differentiate::lower::value::Value;

/// The value of an expression of these names.
pub(super) fn evaluate(a: &mut Algebra, formula: &str, names: &[(&str, &Value)]) -> Value {
    let names = names.iter().map(|&(name, value)| (name.to_owned(), value.clone())).collect();
    let mut report = Report::new(Notation::Rust);
    let value =
        syn::parse_str(formula).map(|expression| Translation::new(a, &mut report, names).expression(&expression));
    value.unwrap_or(Value::Unknown)
}

/// `name(argument: Kind, …) = expression;` as entries of a table, as [`functions`](super::function::functions) makes them.
macro_rules! formulas {
    ($(#[$doc:meta])* $table:ident:
        $( $name:ident ( $($argument:ident : $kind:ident),* ) = $formula:expr; )*
    ) => {
        $(#[$doc])*
        pub(super) const $table: &[$crate::differentiate::lower::methods::function::Function] = &[$(
            $crate::differentiate::lower::methods::function::Function {
                name: stringify!($name),
                takes: &[$(stringify!($kind)),*],
                make: |a, arguments| match arguments {
                    [$($argument @ Value::$kind(_)),*] => {
                        let names = [$((stringify!($argument), $argument)),*];
                        Ok($crate::differentiate::lower::methods::formula::evaluate(a, stringify!($formula), &names))
                    }
                    _ => Err($crate::differentiate::lower::methods::function::Fault::Arguments),
                },
            },
        )*];
    };
}
pub(super) use formulas;
