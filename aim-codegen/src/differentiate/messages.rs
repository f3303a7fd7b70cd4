//! Every text a user of `#[differentiate]` may read: what was found, and what to write instead.

use aim_symbolic::Count;
use syn::BinOp;

use super::types;
use crate::declare::report::text::{Text, did_you_mean, list, text};

/// A text that is always the same: the message and the help.
type Fixed = (&'static str, &'static str);

// The attribute.

pub(super) fn stray_option(found: &str) -> Text {
    text(
        format!("expected an option's name, found `{found}`"),
        "write `#[differentiate(wrt(p, h), budget = 46, hessian, crate = ::aim)]`, of which `wrt` is needed",
    )
}

pub(super) fn option_twice(key: &str) -> Text {
    let help = if key == "wrt" { "write all variables into one `wrt(…)`" } else { "keep one of the two" };
    text(format!("`{key}` is set twice"), help)
}

pub(super) fn unknown_option(key: &str, known: &[&'static str]) -> Text {
    let known = known.iter().copied();
    text(format!("unknown option `{key}`"), did_you_mean(key, known.clone(), || format!("known here: {}", list(known))))
}

pub(super) fn flag_with_value(key: &str) -> Text {
    text(format!("`{key}` has no value"), format!("write `{key}` alone"))
}

pub(super) const CRATE_NOT_A_PATH: Fixed = ("`crate` needs a path", "write it as in `crate = ::aim`");

pub(super) const BUDGET_FORM: Fixed =
    ("`budget` needs a whole number", "write the most operations that are allowed, as in `budget = 46`");

pub(super) const NO_WRT: Fixed = (
    "it is not said by what this function is to be differentiated",
    "name the arguments: `#[differentiate(wrt(p, h))]`",
);

pub(super) const WRT_FORM: Fixed = ("`wrt` needs the names of arguments", "write it as in `wrt(p, h)`");

pub(super) const WRT_EMPTY: Fixed = ("`wrt` names no argument", "name at least one: `wrt(p)`");

pub(super) fn wrt_twice(name: &str) -> Text {
    text(format!("`{name}` is named twice"), "keep one of the two")
}

pub(super) fn unknown_variable(name: &str, known: &[String]) -> Text {
    let known = known.iter().map(String::as_str);
    let help = did_you_mean(name, known.clone(), || match known.len() {
        0 => "the function has no arguments".into(),
        _ => format!("its arguments are {}", list(known)),
    });
    text(format!("the function has no argument `{name}`"), help)
}

pub(super) fn rigid_variable(name: &str) -> Text {
    text(
        format!("`{name}` is a rigid transform: there are no derivatives by its numbers"),
        "its numbers depend on each other; differentiate by angles, a vector or a quaternion that it is made of",
    )
}

pub(super) fn over_budget(budget: usize, count: Count) -> Text {
    text(
        format!("the derived function needs more than {budget} operations"),
        format!("it needs {count}; allow `budget = {}` or look for what can be shared", count.total()),
    )
}

pub(super) const HESSIAN_OF_VECTOR: Fixed =
    ("`hessian` is for functions of one number", "second derivatives of a vector have no matrix: leave it out");

// The signature.

pub(super) const NOT_A_FUNCTION: Fixed =
    ("only a function can be differentiated", "write `#[differentiate(…)]` on a `fn` with a body");

pub(super) fn qualifier(what: &str) -> Text {
    text(format!("`{what}` functions cannot be differentiated"), "write an ordinary function and call it from there")
}

pub(super) const GENERIC: Fixed =
    ("a generic function cannot be differentiated", "write it for one number type, and references without a lifetime");

pub(super) const RECEIVER: Fixed =
    ("`self` cannot be differentiated through", "pass what the function needs of it as arguments");

pub(super) const ARGUMENT_PATTERN: Fixed = ("an argument needs a name", "take the argument apart inside the function");

pub(super) fn unknown_type(found: &str) -> Text {
    let found = found.replace(' ', "");
    let name = found.rsplit("::").next().unwrap_or_default();
    let help = did_you_mean(name, types::names(), || {
        format!("types are known by their names: {}, `[f32; N]`, and references to them", list(types::names()))
    });
    text(format!("`{found}` is no type that can be differentiated through"), help)
}

pub(super) const MUTABLE_REFERENCE: Fixed = ("an argument cannot be changed", "take it by value or by `&`");

pub(super) const NO_RESULT: Fixed = ("this function has no result", "return a number or a vector");

pub(super) const RESULT_TYPE: Fixed = (
    "the result must be a number or a vector",
    "return `f32`, `f64`, `Vec2`, `Vec3`, `Vec3A`, `DVec2` or `DVec3`, by value",
);

pub(super) fn mixed(first: &str, other: &str) -> Text {
    text(
        format!("this is {other}, but the function computes in {first}"),
        format!("use one number type throughout: take and return {first}"),
    )
}

// Statements.

pub(super) fn unsupported(what: &str, help: &str) -> Text {
    text(format!("{what} cannot be differentiated"), help)
}

pub(super) const MUTABLE: Fixed =
    ("variables that change cannot be differentiated", "bind each new value with a `let` of its own");

pub(super) const ASSIGNMENT: Fixed = ("an assignment cannot be differentiated", "bind the new value with `let`");

pub(super) const LET_ELSE: Fixed = ("`let … else` cannot be differentiated", "write it with `if` and `else`");

pub(super) const LET_WITHOUT_VALUE: Fixed =
    ("this name has no value yet", "give it one where it is declared: `let x = if … { … } else { … };`");

pub(super) const PATTERN: Fixed =
    ("this pattern is not understood", "bind a name or a tuple of names, as in `let (sin, cos) = x.sin_cos();`");

pub(super) fn pattern_of(found: &str) -> Text {
    text(format!("this pattern does not fit {found}"), "give every part a name")
}

pub(super) const INNER_ITEM: Fixed =
    ("items inside a function are not understood", "move it out, or write what it does into the function");

pub(super) const MACRO_CALL: Fixed = (
    "what a macro stands for cannot be seen",
    "write the expression itself; check arguments in a function that calls this one",
);

pub(super) const NO_EFFECT: Fixed =
    ("this statement has no effect on the result", "bind its value with `let`, or leave the semicolon out");

// Expressions.

pub(super) fn outside_name<'n>(name: &str, known: impl Iterator<Item = &'n str> + Clone) -> Text {
    let known = known.filter(|_| !name.starts_with(char::is_uppercase));
    let help = did_you_mean(name, known, || "pass it as an argument, or write the number".into());
    text(format!("the value of `{name}` cannot be seen from here"), help)
}

pub(super) fn outside_constant(path: &str) -> Text {
    text(
        format!("the value of `{path}` cannot be seen from here"),
        "pass it as an argument or write the number; known are `core::f32::consts::PI` and its like, \
         `Vec3::X` and its like, `Quat::IDENTITY`",
    )
}

pub(super) fn unknown_function(path: &str) -> Text {
    text(
        format!("what `{path}` does cannot be seen from here"),
        "write its body in its place, or pass its result as an argument",
    )
}

pub(super) const CALL_OF_VALUE: Fixed = ("only functions with a name can be called", "write what it does in its place");

pub(super) const NO_GENERICS: Fixed = ("generic arguments are not understood", "leave them out");

/// What to write for functions that are known not to be supported.
const INSTEAD: &[(&str, &str)] = &[
    ("powf", "write `x.powi(2)` for a whole power, `x.sqrt()` for a root, else `(y * x.ln()).exp()`"),
    ("exp2", "write `(x * core::f32::consts::LN_2).exp()`"),
    ("log2", "write `x.ln() / core::f32::consts::LN_2`"),
    ("log10", "write `x.ln() / core::f32::consts::LN_10`"),
    ("log", "write `x.ln() / base.ln()`"),
    ("cbrt", "write `(x.ln() / 3.0).exp()` for positive x"),
    ("sinh", "write `0.5 * (x.exp() - (-x).exp())`"),
    ("cosh", "write `0.5 * (x.exp() + (-x).exp())`"),
    // Not by `exp` of what may be large: where that overflows, so does the derivative, long before the function does.
    ("tanh", "write `let e = (-2.0 * x.abs()).exp();`, then `x.signum() * (1.0 - e) / (1.0 + e)`"),
    ("rem_euclid", "a remainder jumps: bring the number into its range before the call"),
    ("floor", "rounding has no derivative: round before the call"),
    ("ceil", "rounding has no derivative: round before the call"),
    ("round", "rounding has no derivative: round before the call"),
    ("trunc", "rounding has no derivative: round before the call"),
    ("fract", "rounding has no derivative: take the fraction before the call"),
    ("copysign", "write it with `if` and `abs`"),
    ("try_normalize", "write `normalize_or_zero`"),
    ("normalize_or", "write it with `if` and the vector's length"),
    ("slerp", "turn by a fraction of the angle, as in `Quat::from_axis_angle(axis, s * angle)`"),
    ("from_scaled_axis", "write `Quat::from_axis_angle(axis, angle)`"),
    ("to_scaled_axis", "write `2.0 * q.w.acos()` for the angle and `q.xyz().normalize()` for the axis"),
    ("to_axis_angle", "write `2.0 * q.w.acos()` for the angle and `q.xyz().normalize()` for the axis"),
    ("from_rotation_arc", "write the turn about their cross product by `from_axis_angle`"),
    ("from_scale_rotation_translation", "scale the points and write `from_rotation_translation`"),
    ("from_scale", "multiply the vector by the scale"),
];

pub(super) fn unknown_method<'n>(name: &str, kind: &str, known: impl Iterator<Item = &'n str> + Clone) -> Text {
    let help = match INSTEAD.iter().find(|(known, _)| *known == name) {
        Some((_, instead)) => (*instead).to_owned(),
        None => did_you_mean(name, known.clone(), || match known.clone().next() {
            Some(_) => format!("write what it does in its place; known of {kind}: {}", list(known)),
            None => "write what it does in its place".to_owned(),
        }),
    };
    text(format!("`{name}` of {kind} cannot be differentiated"), help)
}

pub(super) fn wrong_arguments(name: &str, takes: &str, found: &str) -> Text {
    let found = if found.is_empty() { "nothing" } else { found };
    text(format!("`{name}` is given {found}"), format!("it takes {takes}"))
}

pub(super) const POWER_NOT_LITERAL: Fixed = (
    "the exponent of `powi` must be a whole number as written",
    "write the number, as in `x.powi(3)`; for another power, `(y * x.ln()).exp()`",
);

pub(super) const INDEX_NOT_LITERAL: Fixed = ("an index must be a whole number as written", "write the number");

pub(super) fn index_outside(kind: &str) -> Text {
    text(format!("there is no such part of {kind}"), "count from 0")
}

pub(super) fn unknown_field(name: &str, kind: &str) -> Text {
    let help = match kind {
        "a vector" => "its parts are `x`, `y`, `z`",
        "a vector of two" => "its parts are `x`, `y`",
        "a quaternion" => "its parts are `x`, `y`, `z`, `w`",
        "a matrix" => "its parts are `x_axis`, `y_axis`, `z_axis`",
        "a transform" => "its parts are `matrix3` and `translation`",
        _ => "pass it as an argument",
    };
    text(format!("{kind} has no part `{name}` that is understood"), help)
}

pub(super) const QUATERNION_OF_MATRIX: Fixed = (
    "the numbers of a quaternion that was made from a matrix are not derived",
    "build the quaternion from turns, or take it as an argument",
);

pub(super) const MATRIX_NOT_ROTATION: Fixed = (
    "this matrix need not be a rotation",
    "take a `Quat` as an argument, or build the matrix from turns or from the matrix of a `Rigid`",
);

pub(super) fn numbers_expected(count: usize) -> Text {
    text(format!("this must be an array of {count} numbers"), "write the numbers in brackets")
}

pub(super) fn axis_not_unit(length: f64) -> Text {
    text(format!("the axis of a turn must have length 1, this one has {length:.3}"), "normalise it: `axis.normalize()`")
}

pub(super) const EULER_ORDER: Fixed = (
    "`from_euler` needs an order as written and three angles",
    "write it as in `Quat::from_euler(EulerRot::YXZ, yaw, pitch, roll)`",
);

pub(super) fn no_unary(kind: &str) -> Text {
    text(
        format!("there is no such operation on {kind}"),
        "`-` is for numbers, vectors and matrices, `!` for conditions",
    )
}

pub(super) fn no_operation(operator: &BinOp, left: &str, right: &str) -> Text {
    match operator {
        BinOp::Rem(_) => {
            text("a remainder jumps: it cannot be differentiated", "bring the number into its range before the call")
        }
        _ => text(
            format!("there is no such operation between {left} and {right}"),
            "numbers are compared; numbers, vectors, rotations and transforms are combined as in glam",
        ),
    }
}

pub(super) fn not_a_condition(found: &str) -> Text {
    text(format!("`if` needs a condition, found {found}"), "compare two numbers")
}

pub(super) const IF_WITHOUT_ELSE: Fixed = ("an `if` without `else` has no value", "write the `else` branch too");

pub(super) fn branches_differ(then: &str, otherwise: &str) -> Text {
    text(format!("one branch is {then}, the other {otherwise}"), "both must be of one kind")
}

pub(super) fn wrong_result(found: &str, expected: &str) -> Text {
    text(format!("the function's value is {found}, its type says {expected}"), "make both the same")
}
