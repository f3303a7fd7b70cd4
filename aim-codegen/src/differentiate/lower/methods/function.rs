//! [`Function`]: an entry of the tables of what can be called.

use crate::declare::report::text::Text;
use crate::differentiate::lower::algebra::Algebra;
use crate::differentiate::lower::value::Value;

/// Why a call came to nothing.
pub(in crate::differentiate::lower) enum Fault {
    /// The arguments are of other kinds.
    Arguments,
    /// They are wrong in another way.
    Text(Text),
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
        "Truth" => "a condition",
        "Planar" => "a vector of two",
        "Vector" => "a vector",
        "Quaternion" => "a quaternion",
        "Matrix" => "a matrix",
        "Affine" => "a transform",
        "Tuple" => "a tuple",
        _ => "an array",
    }
}

/// `name(argument: Kind, …) -> Kind { body }` as entries of a table; the kinds are the variants of [`Value`].
macro_rules! functions {
    ($(#[$doc:meta])* $table:ident($a:ident):
        $( $name:ident ( $($argument:ident : $kind:ident),* ) -> $result:ident $body:block )*
    ) => {
        $(#[$doc])*
        pub(super) const $table: &[$crate::differentiate::lower::methods::function::Function] = &[$(
            $crate::differentiate::lower::methods::function::Function {
                name: stringify!($name),
                takes: &[$(stringify!($kind)),*],
                make: |$a, arguments| {
                    let _ = &$a;
                    match arguments {
                        [$(Value::$kind($argument)),*] => {
                            $( let $argument = Clone::clone($argument); )*
                            let result = $body;
                            Ok(Value::$result(result))
                        }
                        _ => Err($crate::differentiate::lower::methods::function::Fault::Arguments),
                    }
                },
            },
        )*];
    };
}
pub(super) use functions;
