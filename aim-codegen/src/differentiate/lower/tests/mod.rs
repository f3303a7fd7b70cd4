//! Tests that a function is interpreted as the compiler runs it: the same text, compiled and interpreted.

mod control;
mod guide;
mod items;
mod parts;
mod patterns;
mod references;
mod sequences;

use aim_symbolic::Bindings;
use syn::Item;

use super::{Algebra, Translation, Value};
use crate::declare::report::Report;
use crate::declare::tree::Notation;
use crate::differentiate::items::Items;
use crate::differentiate::types::Precision;

/// Interprets the last function of a module with these numbers and returns its value.
fn interpreted(module: &str, arguments: [f64; 2]) -> f64 {
    let file: syn::File = syn::parse_str(module).expect("it has been compiled");
    let items = Items::of(&file.items);
    let Some(Item::Fn(function)) = file.items.last() else { panic!("a function stands last") };
    let (mut algebra, mut report) = (Algebra::new(), Report::new(Notation::Rust));
    let inputs = ["x", "y"].map(|name| algebra.g.input(name));
    let patterns = function.sig.inputs.iter().map(|input| match input {
        syn::FnArg::Typed(typed) => &*typed.pat,
        syn::FnArg::Receiver(_) => panic!("of functions"),
    });
    let values = inputs.map(Value::Scalar);
    let value = Translation::new(&mut algebra, &mut report, &items, Some(Precision::Double)).function(
        &function.block,
        &function.sig.output,
        patterns.zip(values),
        &[],
    );
    let errors: Vec<String> = report.into_list().into_iter().map(|error| error.message().to_owned()).collect();
    assert!(errors.is_empty(), "{errors:?} in {module}");
    let Value::Scalar(value) = value else { panic!("a number comes of it: {value:?} in {module}") };
    let bindings = Bindings::new(&algebra.g, &arguments, &[]);
    algebra.g.evaluate(value, &bindings)
}

/// Compiles a module whose last function is `f`, and compares it with the interpretation of its text, at points on both
/// sides of all its branches.
macro_rules! same {
    ($($name:ident { $($module:item)* })*) => {$(
        #[test]
        fn $name() {
            #[allow(clippy::all, clippy::pedantic, warnings, reason = "as users write it")]
            mod compiled {
                $($module)*
            }
            let text = concat!($(stringify!($module), "\n"),*);
            for x in [-2.5, -1.0, -0.25, 0.5, 1.0, 2.0, 3.75] {
                for y in [-3.0, -0.5, 0.0, 0.75, 2.5] {
                    let (found, expected) = ($crate::differentiate::lower::tests::interpreted(text, [x, y]), compiled::f(x, y));
                    let close = (found - expected).abs() <= 1e-12 * (1.0 + expected.abs());
                    assert!(close || found == expected, "f({x}, {y}): {found}, compiled {expected}");
                }
            }
        }
    )*};
}

use same;
