//! All messages about `#[differentiate]` that a user may read: what was found, and what to write instead.

use aim_symbolic::Count;
use syn::BinOp;

use crate::declare::report::text::{did_you_mean, list, messages};

// The attribute.

messages! {
    flag_with_value(key: &str) => "`{key}` has no value", "write `{key}` alone";

    no_wrt() =>
        "it is not said by what this function is to be differentiated",
        "name the arguments: `#[differentiate(wrt(p, h))]`";

    /// For functions in a file.
    no_such_function(name: &str, known: &[&str])
        where help = did_you_mean(name, known, || match known {
            [] => "no function in it has the attribute `#[differentiate(wrt(…))]`".to_owned(),
            _ => format!("it has {}", list(known)),
        }) =>
        "the file has no differentiated function `{name}`",
        "{help}";

    no_rust(error: &str) => "{error}", "the file has to be Rust that compiles";

    wrt_empty() => "`wrt` names no argument", "name at least one: `wrt(p)`";

    unknown_variable(name: &str, known: &[&str])
        where help = did_you_mean(name, known, || match known {
            [] => "the function has no arguments".to_owned(),
            _ => format!("its arguments are {}", list(known)),
        }) =>
        "the function has no argument `{name}`",
        "{help}";

    rigid_variable(name: &str) =>
        "`{name}` is a rigid transform: there are no derivatives by its numbers",
        "its numbers depend on each other; differentiate by its rotation and its translation together: `wrt(tangent({name}))`";

    no_tangent(name: &str) =>
        "there is no rotation in `{name}`: its numbers are its tangent",
        "write `{name}` alone";

    no_tangents() =>
        "`perturbation` is a side of tangents, and `wrt` has none",
        "name rotations and transforms as in `wrt(tangent(q))`, or leave it out";

    over_budget(most: usize, words: &str, key: &str, needed: usize, count: Count)
        where allowed = format!("{} = {needed}", if key == "operations" { "budget" } else { key }) =>
        "the derived function needs more than {most} {words}",
        "it needs {count}; allow `{allowed}` or look for what can be shared";

    unchecked(ty: &str) =>
        "`check` cannot make up a value of `{ty}`: it has fields that are no numbers",
        "test this function at values of your own";

    no_lanes(ty: &str) =>
        "there are no lanes of `{ty}`: it has fields that are no numbers",
        "take the numbers of it that the function needs as arguments";

    no_lanes_by(ty: &str) =>
        "there are no lanes of derivatives by `{ty}`: part of it does not vary",
        "differentiate by the numbers of it that do, as arguments of their own";

    no_lanes_of_nothing() =>
        "there are no lanes of results that may be nothing",
        "return a number beside the value that is 1 or 0, as in `(1.0, value)`";

    of_a_number(key: &str) =>
        "`{key}` is for functions of one number",
        "second derivatives of a vector have no matrix: leave it out";
}

// The signature.

messages! {
    not_a_function() =>
        "only functions and modules of functions can be differentiated",
        "write `#[differentiate(…)]` on a `fn` with a body, or on a `mod` in braces";

    nothing_to_differentiate() =>
        "no function of this module is to be differentiated",
        "write `#[differentiate(wrt(x))]` on those that are";

    of_a_method() =>
        "only functions that stand in the module can be differentiated",
        "write a function beside the `impl` that calls the method, as in `fn area(r: f64, of: &Shape) -> f64 {{ of.area(r) }}`, and the attribute on that";

    qualifier(what: &str) =>
        "`{what}` functions cannot be differentiated",
        "write an ordinary function and call it from there";

    generic() =>
        "a generic function cannot be differentiated",
        "write it for one number type, and references without a lifetime";

    receiver() => "`self` cannot be differentiated through", "pass what the function needs of it as arguments";

    unknown_type(found: &str, known: &[&str])
        where found = found.replace(' ', ""), name = found.rsplit("::").next().unwrap_or_default(),
        help = did_you_mean(name, known, || {
            format!(
                "types are known by their names: {}, `bool`, integers, arrays, tuples and options of these, and references to them; \
                 a struct is known where it stands beside the function in `#[differentiate] mod … {{ … }}`",
                list(known)
            )
        }) =>
        "`{found}` is no type that can be differentiated through",
        "{help}";

    slice(element: &str) =>
        "how long this is is not known here",
        "say it beside `wrt`, as in `lengths(values = 4)`, or take a reference to an array: `&[{element}; 4]`; of any length it may be an argument by itself, `values: &[{element}]`, that derivatives are not taken by";

    slice_in_variable(name: &str) =>
        "`{name}` has a slice among its fields, by which nothing can be differentiated",
        "write its length, as in `[f32; 4]`; or pass what varies by itself";

    no_slice(name: &str) =>
        "`{name}` is no argument that is a slice",
        "arrays say how long they are; leave it out";

    length_unknown() =>
        "this length is not known here",
        "write the number, or {CONSTANT}";

    too_many_numbers(most: usize) =>
        "this holds more than {most} numbers",
        "differentiate one term and sum its derivatives in a function around it";

    constant_variable(name: &str) =>
        "`{name}` does not vary: there are no derivatives by truth values, whole numbers and names of variants",
        "leave it out of `wrt`";

    tangent_of_choice(name: &str) =>
        "`{name}` holds options or enums with numbers, which have no tangents",
        "differentiate by its rotations as arguments of their own";

    partial_struct(name: &str) =>
        "`{name}` has fields that are no numbers: there is no derivative by it",
        "differentiate by arguments of their own, or by a struct of the numbers that vary";

    mutable_reference() => "what an argument refers to cannot be changed", "take it by value, as in `mut x: f32`, and return what is new";

    no_result() => "this function has no result", "return what is to be differentiated";

    result_type() =>
        "the result must be made of numbers",
        "return a number, vector, quaternion or matrix, or an array, a tuple or a struct of those, or an option of one, by value";

    mixed(first: &str, other: &str) =>
        "this is {other}, but the function computes in {first}",
        "use one number type throughout: take and return {first}";
}

// Statements.

messages! {
    unsupported(what: &str, help: &str) => "{what} cannot be differentiated", "{help}";

    mutable_borrow() =>
        "what is changed through a reference is not followed",
        "assign to the variable itself, or return the new value";

    assigned_through_reference() =>
        "what is changed through a reference is not followed",
        "assign to the element itself, as in `a[i] = …`, or go over `a.iter_mut()`";

    not_assignable() => "this cannot be assigned to", "assign to a variable, a field or an element";

    captured() =>
        "a closure that changes what is outside of it cannot be called here",
        "call it where it is written, not in another function or closure; or return the new value from it";

    lazy_effect() =>
        "whether and when this closure changes what is outside of it depends on how the iterator is used",
        "collect, sum or fold the elements right after it, or write a loop";

    no_part_to_assign(kind: &str) =>
        "this part of {kind} cannot be assigned to",
        "build the whole value anew";

    variable_of_two_kinds() =>
        "a variable has two kinds of values where the branches meet",
        "give it values of one kind, and lists of one length";

    returns_differ() => "this function returns values of two kinds", "return values of one kind";

    pattern() =>
        "this pattern is not understood",
        "bind a name or a tuple of names, as in `let (sin, cos) = x.sin_cos();`";

    pattern_of(found: &str) => "this pattern does not fit {found}", "give every part a name";

    inner_item() =>
        "this item inside a function is not understood",
        "move it beside the function, into a module with `#[differentiate]` on it";

    macro_call() =>
        "what a macro stands for cannot be seen",
        "write the expression itself, or a function in its place; to check arguments, use `assert!`";

    no_effect() =>
        "this statement has no effect on the result",
        "bind its value with `let`, or leave the semicolon out";
}

// Expressions.

messages! {
    outside_name(name: &str, known: &[&str])
        where is_constant = name.starts_with(char::is_uppercase),
        known = if is_constant { &[] } else { known },
        remedy = if is_constant { CONSTANT } else { MODULE },
        help = did_you_mean(name, known, || format!("pass it as an argument, or {remedy}")) =>
        "the value of `{name}` cannot be seen from here",
        "{help}";

    outside_constant(path: &str) =>
        "the value of `{path}` cannot be seen from here",
        "pass it as an argument, or {MODULE}; known everywhere are `core::f32::consts::PI` and its like, \
         `Vec3::X` and its like, `Quat::IDENTITY`";

    unknown_function(path: &str)
        where help = match path.split("::").next() {
            Some("std" | "core" | "alloc" | "Vec" | "Box" | "Rc" | "Arc" | "String" | "HashMap" | "BTreeMap") => OF_STD.to_owned(),
            _ => format!("{MODULE}, or pass its result as an argument"),
        } =>
        "what `{path}` does cannot be seen from here",
        "{help}";

    from_fn_unknown() =>
        "the length of this array is not known here",
        "say it: `let a: [f64; 4] = …`, or `from_fn::<_, 4, _>(…)`";

    several_functions(name: &str) =>
        "which of several functions `{name}` is called here cannot be told",
        "give one of them another name, and call that";

    no_default() =>
        "which type's default this is cannot be seen from here",
        "write it with the type, as in `State::default()`; what a type has by default is known where `Default` is derived or \
         implemented beside the function in `#[differentiate] mod … {{ … }}`";

    recursion(name: &str) =>
        "`{name}` calls itself, and no end of that is in sight",
        "how deep it goes has to follow from numbers that are known, and must not be deeper than 16: write it as a loop with a bound";

    outside_struct(name: &str) =>
        "what `{name}` is made of cannot be seen from here",
        "{MODULE}";

    unknown_struct_field(name: &str, of: &str, known: &[&str])
        where help = did_you_mean(name, known, || match known {
            [] => "none of its fields is understood: fields are numbers, glam's types, and arrays, tuples and structs of them".to_owned(),
            _ => format!("those that are understood are {}", list(known)),
        }) =>
        "`{of}` has no field `{name}` that is understood",
        "{help}";

    not_a_function_value() => "this is no function", "write a closure, as in `|x| x * x`";

    not_iterable(found: &str) =>
        "a loop cannot go over {found}",
        "loops go over ranges of known whole numbers, arrays, and their iterators";

    range_without_end() => "a range needs both of its ends here", "write it as in `0..N`";

    rounds_unknown() =>
        "how often this loop runs is not known here",
        "loops are written out round by round: bound a count, as in `0..n.min(8)` or by `assert!(n <= 8)` before it, and what ends by its values, as in `while n < 20 && error > 1e-9`";

    exit_of_kept_loop() =>
        "a closure, or a function that changes what its caller lends it, cannot return from inside of a loop of which no end is known",
        "assign what it returns to a variable and `break`, or bound the loop, as in `0..n.min(8)`";

    state_of_kept_loop(kind: &str) =>
        "{kind} cannot be changed by a loop of which no end is known",
        "change numbers, vectors and structs of them, or bound the loop, as in `0..n.min(8)`";

    zip_of_kept_loop() =>
        "what goes over a slice cannot be paired with this",
        "pair it with another slice, or use `enumerate`";

    kept_loop_elsewhere(name: &str) =>
        "`{name}` has a loop of which no end is known, which is written in Rust alone",
        "bound it, as in `0..n.min(8)`, or say how long slices are by `lengths`";

    companion_of_kept_loop(key: &str) =>
        "`{key}` is for functions whose loops have known ends",
        "bound the loops, as in `0..n.min(8)`, or say how long slices are by `lengths`";

    too_large(nodes: usize, rounds: usize) =>
        "written out, this is more than {nodes} operations or {rounds} rounds of loops",
        "shorten the loop, or differentiate one term and sum its derivatives in a loop around it; a `for` over a range stays a loop \
         where the gradient or Jacobian alone is asked for";

    array_too_long(most: usize) => "arrays hold up to {most} elements", "make it shorter";

    integer_overflow() => "this whole number is too large", "whole numbers are those of `i64`";

    empty_sum(name: &str) =>
        "of no elements there is no {name} here",
        "say its type, as in `{name}::<f64>()`";

    not_an_ordering(kind: &str) =>
        "this comparison is {kind}",
        "compare two numbers by `partial_cmp` or `total_cmp`";

    unknown_pattern(name: &str) =>
        "whether `{name}` is a constant or a new name cannot be seen from here",
        "{MODULE}, or write its value; new names begin with a small letter";

    match_pattern() =>
        "this pattern is not understood",
        "match whole numbers, `true` and `false`, ranges, tuples of these, names and `_`";

    call_of_value() => "only functions with a name can be called", "write what it does in its place";

    no_generics() => "generic arguments are not understood", "leave them out";

    unknown_method(name: &str, kind: &str, known: &[&str])
        where help = match INSTEAD.iter().find(|(known, _)| *known == name) {
            Some((_, instead)) => (*instead).to_owned(),
            None if known.contains(&name) => {
                "it is known of an array or a list of a known length that a variable names: use a loop over the elements".to_owned()
            }
            None => did_you_mean(name, known, || {
                let known = if known.is_empty() { String::new() } else { format!("; known of {kind}: {}", list(known)) };
                format!("write what it does in its place{known}")
            }),
        } =>
        "`{name}` of {kind} cannot be differentiated",
        "{help}";

    wrong_arguments(name: &str, takes: &str, found: &str)
        where found = if found.is_empty() { "nothing" } else { found } =>
        "`{name}` is given {found}",
        "it takes {takes}";

    trait_method(name: &str) =>
        "`{name}` of an array is the method of a trait, which cannot be seen from here",
        "of an iterator write `iter().{name}`; else make it a function of the module";

    effect_of_assertion() =>
        "this assertion changes a variable",
        "companions do not check assertions: change it before";

    conditional() =>
        "a part of this function depends on `cfg`, which cannot be seen from here",
        "leave the condition out, or pass what depends on it as an argument";

    conditional_item(name: &str) =>
        "`{name}` depends on `cfg`, which cannot be seen from here",
        "leave the condition out, or pass it as an argument";

    no_result_value(name: &str) =>
        "`{name}`: results are not understood",
        "return an `Option` from a helper function, or leave the check to a function around this one";

    unwrapped_none() => "there is nothing in this option", "look at the condition by which it is made";

    not_an_option(kind: &str) =>
        "`?` is for options, found {kind}",
        "leave the `?` out, or return an `Option` from the helper function";

    sorted_too_long(most: usize) =>
        "this array is too long to be sorted here: at most {most}",
        "every two elements are compared; sort it before it is passed";

    rounded_constants() =>
        "rounding decides this, which is not known here: in single precision these constants are the same, or in another order",
        "count rounds by whole numbers, as in `for i in 0..10`, or compute in `f64`";

    large_whole_number() =>
        "this whole number is beyond 2⁵³, which is rounded here",
        "pass it as an argument; what is made of random bits is no function to differentiate";

    wrapped_whole_number() =>
        "this whole number may have been negative and wrap round, beyond 2⁵³, where it is rounded",
        "divide by `rem_euclid`, or subtract, before it is cast";

    effect_of_error() =>
        "an error that changes a variable is not followed",
        "change the variable before";

    receiver_effect() =>
        "which place this method changes depends on what is changed on the way to it",
        "bind the index with `let` before";

    error_value() =>
        "what an error says is not followed",
        "write `Err(_)`";

    rebound_reference() =>
        "a reference is given another place here",
        "give what it refers to another value, as in `*x = …`, or take turns by an index into an array of two";

    not_a_list() => "what is collected here is no `Vec`", "collect a `Vec`: `.collect::<Vec<_>>()`";

    power_unknown() =>
        "the exponent of this power of a whole number is not known here",
        "write the number, as in `n.pow(3)`, or take the power of a number that is none: `(n as f64).powi(m)`";

    index_unknown() =>
        "this number is not known here",
        "how many elements there are must not depend on arguments: use numbers, constants and the variables of loops";

    index_outside(kind: &str) => "there is no such part of {kind}", "count from 0";

    no_such_choice(kind: &str) =>
        "an argument cannot choose among the parts of {kind}",
        "index an array whose elements are of one kind";

    unknown_field(name: &str, kind: &str)
        where help = match kind {
            "a vector" => "its parts are `x`, `y`, `z`",
            "a vector of two" => "its parts are `x`, `y`",
            "a quaternion" => "its parts are `x`, `y`, `z`, `w`",
            "a matrix" => "its parts are `x_axis`, `y_axis`, `z_axis`",
            "a transform" => "its parts are `matrix3` and `translation`",
            _ => "pass it as an argument",
        } =>
        "{kind} has no part `{name}` that is understood",
        "{help}";

    quaternion_of_matrix() =>
        "the numbers of a quaternion that was made from a matrix are not derived",
        "build the quaternion from turns, or take it as an argument";

    matrix_not_rotation() =>
        "this matrix need not be a rotation",
        "take a `Quat` as an argument, or build the matrix from turns or from the matrix of a `Rigid`";

    numbers_expected(count: usize) => "this must be an array of {count} numbers", "write the numbers in brackets";

    axis_not_unit(length: f64) =>
        "the axis of a turn must have length 1, this one has {length:.3}",
        "normalise it: `axis.normalize()`";

    euler_order() =>
        "`from_euler` needs an order as written and three angles",
        "write it as in `Quat::from_euler(EulerRot::YXZ, yaw, pitch, roll)`";

    no_unary(kind: &str) =>
        "there is no such operation on {kind}",
        "`-` is for numbers, vectors and matrices, `!` for conditions";

    no_operation(operator: &BinOp, left: &str, right: &str)
        where operator = quote::quote!(#operator).to_string() =>
        "there is no `{operator}` between {left} and {right} that is understood",
        "numbers are compared; numbers, vectors, rotations and transforms are combined as in glam; whole numbers become \
         numbers by `as`";

    not_a_condition(found: &str) => "`if` needs a condition, found {found}", "compare two numbers";

    branches_differ(then: &str, otherwise: &str)
        where help = if then == otherwise { "use it in each branch" } else { "both must be of one kind" } =>
        "one branch is {then}, the other {otherwise}",
        "{help}";

    unknown_round() => "what a round of this loop does cannot be told", "the compiler's own errors may say why";

    unknown_result() => "the value of this function cannot be told", "the compiler's own errors may say why";

    wrong_result(found: &str, expected: &str) =>
        "the function's value is {found}, its type says {expected}",
        "make both the same";
}

/// Help for functions of the standard library that are not known by name.
const OF_STD: &str = "the standard library is not read: write what it does in its place";

/// Help for items that the attribute does not see: how to make them visible.
const MODULE: &str = "put both into one module with `#[differentiate]` on it, as in `#[differentiate] mod m { … }`";

/// Help for a constant that the attribute does not see.
const CONSTANT: &str = "write its `const` inside of the function, or beside it in the `#[differentiate] mod m { … }`: from outside of that, \
                        a function reads constants that are numbers of its own type, and nothing else";

/// Replacements for functions that are known but not supported.
const INSTEAD: &[(&str, &str)] = &[
    ("div_euclid", "write `((x - x.rem_euclid(y)) / y).round()`"),
    ("from_rotation_arc", "write the turn about their cross product by `from_axis_angle`"),
    ("from_scale_rotation_translation", "scale the points and write `from_rotation_translation`"),
    ("from_scale", "multiply the vector by the scale"),
    (
        "to_euler",
        "write its angles by `atan2` and `asin` of what it makes of the axes, as in `(q * Vec3::Z).x.atan2((q * Vec3::Z).z)`",
    ),
];
