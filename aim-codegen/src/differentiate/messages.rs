//! All messages about `#[differentiate]` that a user may read: what was found, and what to write instead.

use aim_symbolic::Count;
use syn::BinOp;

use crate::declare::report::text::{did_you_mean, list, messages};

// The attribute.

messages! {
    flag_with_value(key: &str) => "`{key}` takes no value", "write `{key}` alone";

    no_wrt() =>
        "missing `wrt`: which arguments to differentiate by",
        "name the arguments: `#[differentiate(wrt(p, h))]`";

    /// For functions in a file.
    no_such_function(name: &str, known: &[&str])
        where help = did_you_mean(name, known, || match known {
            [] => "no function in the file has the attribute `#[differentiate(wrt(…))]`".to_owned(),
            _ => format!("its differentiated functions are {}", list(known)),
        }) =>
        "the file has no differentiated function `{name}`",
        "{help}";

    no_rust(error: &str) => "{error}", "the file must be valid Rust";

    wrt_empty() => "`wrt` names no argument", "name at least one: `wrt(p)`";

    unknown_variable(name: &str, known: &[&str])
        where help = did_you_mean(name, known, || match known {
            [] => "the function has no arguments".to_owned(),
            _ => format!("its arguments are {}", list(known)),
        }) =>
        "the function has no argument `{name}`",
        "{help}";

    pattern_variable(name: &str) =>
        "`{name}` is a part of an argument that has no name",
        "name the whole argument, differentiate by it, and take it apart in the function, as in `let (a, b) = pair;`";

    repeated_attribute() =>
        "`#[differentiate]` is given twice for this function",
        "name all arguments and companions in one; for another choice of them, add a function that calls this one";

    rigid_variable(name: &str) =>
        "`{name}` is a rigid transform, whose components cannot vary independently",
        "differentiate by its rotation and its translation together: `wrt(tangent({name}))`";

    no_tangent(name: &str) =>
        "`{name}` contains no rotation: its tangent is the value itself",
        "write `{name}` without `tangent`";

    no_tangents() =>
        "`perturbation` sets the side of tangents, but `wrt` has none",
        "name rotations and transforms as in `wrt(tangent(q))`, or remove `perturbation`";

    over_budget(most: usize, words: &str, key: &str, needed: usize, count: Count)
        where allowed = format!("{} = {needed}", if key == "operations" { "budget" } else { key }) =>
        "the derived function has too many {words}: the limit is {most}",
        "it needs {count}; allow `{allowed}`, or look for expressions that can be shared";

    unchecked(ty: &str) =>
        "`check` cannot generate a value of `{ty}`: some of its fields are not numbers",
        "test this function with values of your own";

    no_lanes(ty: &str) =>
        "`lanes` does not support `{ty}`: it has a slice, or fields that are not numbers",
        "take the numbers that the function needs as separate arguments";

    no_lanes_by(ty: &str) =>
        "`lanes` does not support derivatives by `{ty}`: part of it does not vary",
        "differentiate by its varying numbers as separate arguments";

    no_lanes_of_nothing() =>
        "`lanes` does not support functions that return an option",
        "return a number next to the value that is 1 or 0, as in `(1.0, value)`";

    of_a_number(key: &str) =>
        "`{key}` requires a function that returns one number",
        "the second derivatives of a vector are not a matrix: remove `{key}`";
}

// The signature.

messages! {
    not_a_function() =>
        "only functions and modules of functions can be differentiated",
        "write `#[differentiate(…)]` on a `fn` with a body, or on a `mod` in braces";

    nothing_to_differentiate() =>
        "no function in this module is marked with `#[differentiate(…)]`",
        "write `#[differentiate(wrt(x))]` on those to differentiate";

    of_a_method() =>
        "only functions directly in the module can be differentiated",
        "add a function next to the `impl` that calls the method, as in `fn area(r: f64, of: &Shape) -> f64 {{ of.area(r) }}`, \
         and put the attribute on it";

    qualifier(what: &str) =>
        "`{what}` functions cannot be differentiated",
        "write an ordinary function and call it from there";

    generic() =>
        "a generic function cannot be differentiated",
        "write it for one number type and for known lengths";

    receiver() =>
        "functions with `self` cannot be differentiated",
        "pass what the function needs from `self` as arguments";

    unknown_type(found: &str, known: &[&str])
        where found = found.replace(' ', ""), name = found.rsplit("::").next().unwrap_or_default(),
        help = did_you_mean(name, known, || {
            format!(
                "types are recognised by name: {}, `bool`, integers, arrays, tuples and options of these, and references to them; \
                 a struct must be defined next to the function in `#[differentiate] mod … {{ … }}`",
                list(known)
            )
        }) =>
        "`{found}` is not a supported type",
        "{help}";

    /// For types of glam.
    unsupported_type(name: &str)
        where help = match name {
            "Affine2" | "DAffine2" => "use a `Mat2` and a `Vec2` as its matrix and its translation",
            "Affine3" => "use `Affine3A`",
            "EulerRot" => "write the order where it is used, as in `Quat::from_euler(EulerRot::YXZ, yaw, pitch, roll)`",
            name if name.starts_with("BVec") => "compare where the result is used, as in `Vec3::select(a.cmplt(b), a, b)`",
            _ => "use arrays of integers, and convert them to numbers with `as`",
        } =>
        "`{name}` is not a supported type",
        "{help}";

    slice(element: &str) =>
        "the length of this slice is unknown",
        "give it next to `wrt`, as in `lengths(values = 4)`, or take a reference to an array: `&[{element}; 4]`; \
         a slice of any length, `values: &[{element}]`, must be an argument of its own that is not in `wrt`";

    slice_in_variable(name: &str) =>
        "cannot differentiate by `{name}`: it has a slice among its fields",
        "use an array, as in `[f32; 4]`, or pass the varying values as a separate argument";

    no_slice(name: &str) =>
        "`{name}` is not an argument with a slice type",
        "the type of an array gives its length: remove it from `lengths`";

    length_unknown() => "this length is unknown", "write the number, or {CONSTANT}";

    too_many_numbers(most: usize) =>
        "this type holds more than {most} numbers",
        "differentiate one term and sum its derivatives in a function around it";

    constant_variable(name: &str) =>
        "cannot differentiate by `{name}`: booleans, integers and enum variants do not vary continuously",
        "remove it from `wrt`";

    tangent_of_choice(name: &str) =>
        "`{name}` contains options or enums with numbers, which have no tangent",
        "pass its rotations as separate arguments and differentiate by those";

    partial_struct(name: &str) =>
        "cannot differentiate by `{name}`: some of its fields are not numbers",
        "differentiate by separate arguments, or by a struct of only the numbers that vary";

    mutable_reference() =>
        "`&mut` arguments cannot be differentiated",
        "take the argument by value, as in `mut x: f32`, and return the new value";

    no_result() => "this function returns no value", "return the value to differentiate";

    result_type() =>
        "the result must consist of numbers",
        "return, by value, a number, vector, quaternion or matrix, an array, tuple or struct of those, or an option of one";

    result_field(field: &str, of: &str) =>
        "the result must consist of numbers, but `{of}` has the field `{field}`",
        "return the numbers alone, as a tuple or a struct of their own";

    mixed(first: &str, other: &str) =>
        "this is `{other}`, but the function computes in `{first}`",
        "use one number type throughout: take and return `{first}`";
}

// Statements.

messages! {
    unsupported(what: &str, help: &str) => "{what} cannot be differentiated", "{help}";

    mutable_borrow() =>
        "changes through this mutable reference cannot be tracked",
        "assign to the variable itself, or return the new value";

    assigned_through_reference() =>
        "changes through this reference cannot be tracked",
        "assign to the element itself, as in `a[i] = …`, or iterate over `a.iter_mut()`";

    not_assignable() => "this cannot be assigned to", "assign to a variable, a field or an element";

    captured() =>
        "a closure that changes a variable outside of it cannot be called here",
        "call it where it is defined, not in another function or closure, or return the new value from it";

    lazy_effect() =>
        "this closure changes a variable, but whether and when it runs depends on how the iterator is used",
        "collect, sum or fold the elements right after it, or write a loop";

    no_index_mut(ty: &str) =>
        "no `IndexMut` of `{ty}` for this index is visible to `#[differentiate]`",
        "assign to a field or an element of it";

    no_part_to_assign(kind: &str) => "this part of {kind} cannot be assigned to", "build a new value instead";

    variable_of_two_kinds() =>
        "a variable has different kinds of values where the branches meet",
        "give it values of one type, and lists of one length";

    returns_differ() =>
        "this function returns different kinds of values",
        "return values of one type, and lists of one length";

    pattern() =>
        "this pattern is not supported",
        "bind a name or a tuple of names, as in `let (sin, cos) = x.sin_cos();`";

    pattern_of(found: &str) => "this pattern does not match {found}", "name each of its parts";

    inner_item() =>
        "this item inside a function is not supported",
        "move it next to the function, into a module with `#[differentiate]` on it";

    macro_call() =>
        "`#[differentiate]` cannot expand this macro",
        "write the expression itself, or call a function instead; to check arguments, use `assert!`";

    printing(name: &str) =>
        "`{name}!` cannot be differentiated",
        "remove it, or print in a function around this one";

    no_effect() => "this statement has no effect on the result", "bind its value with `let`, or remove the semicolon";
}

// Expressions.

messages! {
    outside_name(name: &str, known: &[&str])
        where is_constant = name.starts_with(char::is_uppercase),
        known = if is_constant { &[] } else { known },
        remedy = if is_constant { CONSTANT } else { MODULE },
        help = did_you_mean(name, known, || format!("pass it as an argument, or {remedy}")) =>
        "the value of `{name}` is not visible to `#[differentiate]`",
        "{help}";

    /// For functions in a file, which are emitted in another language.
    constant_elsewhere(name: &str) =>
        "the value of `{name}` is not visible to `aim generate`",
        "define the `const` inside the function or next to it: constants of other files are only read in Rust, by the attribute";

    generic_unknown(name: &str) =>
        "the generic parameter `{name}` does not follow from the arguments of this function",
        "write it where the function is called, as in `pool::<4, 2>(x)`, or give the result a type, as in `let y: [f64; 2] = pool(x)`";

    behind_glob(name: &str) =>
        "`{name}` may come from a glob import in this function, which `#[differentiate]` cannot look into",
        "import it by its name, or move the glob import out of the function";

    outside_constant(path: &str) =>
        "the value of `{path}` is not visible to `#[differentiate]`",
        "pass it as an argument, or {MODULE}; always visible are `core::f32::consts::PI` and the like, \
         `Vec3::X` and the like, and `Quat::IDENTITY`";

    unknown_function(path: &str)
        where help = match path.split("::").next() {
            Some("std" | "core" | "alloc" | "Vec" | "Box" | "Rc" | "Arc" | "String" | "HashMap" | "BTreeMap") => OF_STD.to_owned(),
            _ => format!("{MODULE}, or pass its result as an argument"),
        } =>
        "the body of `{path}` is not visible to `#[differentiate]`",
        "{help}";

    from_fn_unknown() =>
        "the length of this array is unknown",
        "specify it: `let a: [f64; 4] = …`, or `from_fn::<_, 4, _>(…)`";

    several_functions(name: &str) =>
        "`{name}` is ambiguous: several functions have this name",
        "rename one of them, and call it by its new name";

    no_default() =>
        "the type of this default value is unknown",
        "write the type, as in `State::default()`; it must derive or implement `Default` next to the function \
         in `#[differentiate] mod … {{ … }}`";

    recursion(name: &str) =>
        "`{name}` calls itself without a known bound",
        "the depth must follow from known numbers and be at most 16; otherwise write a bounded loop";

    outside_struct(name: &str) => "the definition of `{name}` is not visible to `#[differentiate]`", "{MODULE}";

    unknown_struct_field(name: &str, of: &str, known: &[&str])
        where help = did_you_mean(name, known, || match known {
            [] => "none of its fields is supported: fields must be numbers, glam types, or arrays, tuples and structs of them".to_owned(),
            _ => format!("the supported fields are {}", list(known)),
        }) =>
        "`{of}` has no supported field `{name}`",
        "{help}";

    not_a_function_value() => "this is not a function", "write a closure, as in `|x| x * x`";

    not_iterable(found: &str) =>
        "cannot iterate over {found}",
        "loops run over ranges with known integer bounds, over arrays, and over their iterators";

    range_without_end() => "this range needs both bounds", "write it as in `0..N`";

    unknown_iteration_count() =>
        "the number of iterations of this loop is unknown",
        "loops are unrolled: bound a counter, as in `0..n.min(8)` or by `assert!(n <= 8)` before the loop, \
         and a loop that ends on a condition, as in `while n < 20 && error > 1e-9`";

    exit_of_kept_loop() =>
        "a closure, or a function with a `&mut` argument, cannot return from inside a loop without a known bound",
        "assign the result to a variable and `break`, or bound the loop, as in `0..n.min(8)`";

    state_of_kept_loop(kind: &str) =>
        "{kind} cannot be changed in a loop without a known bound",
        "change numbers, vectors and structs of them, or bound the loop, as in `0..n.min(8)`";

    zip_of_kept_loop() =>
        "this cannot be zipped with an iterator over a slice",
        "zip with another slice, or use `enumerate`";

    kept_loop_elsewhere(name: &str) =>
        "`{name}` has a loop without a known bound, which only Rust output supports",
        "bound the loop, as in `0..n.min(8)`, or give the lengths of slices with `lengths`";

    companion_of_kept_loop(key: &str) =>
        "`{key}` requires loops with known bounds",
        "bound the loops, as in `0..n.min(8)`, or give the lengths of slices with `lengths`";

    too_large(nodes: usize, rounds: usize) =>
        "unrolled, this is more than {nodes} operations or {rounds} loop iterations",
        "shorten the loop, or differentiate one term and sum its derivatives in a loop around it; a `for` over a range is not unrolled \
         if only the gradient or Jacobian is requested";

    array_too_long(most: usize) => "an array can have at most {most} elements", "shorten the array";

    integer_overflow() => "this integer is too large", "integers must fit in an `i64`";

    empty_sum(name: &str) =>
        "the type of this {name} is unknown if there are no elements",
        "specify it, as in `{name}::<f64>()`";

    no_key(kind: &str) => "expected an integer as a key, found {kind}", "compare with `min_by` or `max_by`";

    not_an_ordering(kind: &str) =>
        "expected an ordering, found {kind}",
        "compare two numbers with `partial_cmp` or `total_cmp`";

    unknown_pattern(name: &str) =>
        "`{name}` may be a constant or a new variable: no definition is visible to `#[differentiate]`",
        "{MODULE}, or write its value; start the name of a variable with a lower-case letter";

    match_pattern() =>
        "this pattern is not supported",
        "match on integers, `true` and `false`, ranges, tuples of these, names and `_`";

    call_of_value() => "only functions with a name can be called", "write out what it does instead";

    no_generics() => "generic arguments are not supported", "remove them";

    /// `similar` are names that may have been meant.
    unknown_method(name: &str, kind: &str, known: &[&str], similar: &[&str])
        where help = match INSTEAD.iter().find(|(known, _)| *known == name) {
            Some((_, instead)) => (*instead).to_owned(),
            None if known.contains(&name) => {
                "it is supported for an array, or a list of known length, that is stored in a variable: loop over the elements instead"
                    .to_owned()
            }
            None => did_you_mean(name, similar, || {
                let known = if known.is_empty() { String::new() } else { format!("; supported for {kind}: {}", list(known)) };
                format!("write out what it does instead{known}")
            }),
        } =>
        "`{name}` of {kind} cannot be differentiated",
        "{help}";

    wrong_arguments(name: &str, takes: &str, found: &str)
        where found = if found.is_empty() { "no arguments" } else { found } =>
        "wrong arguments for `{name}`: found {found}",
        "expected {takes}";

    trait_method(name: &str) =>
        "`{name}` of an array is a trait method, whose body is not visible to `#[differentiate]`",
        "for the method of iterators, write `iter().{name}`; otherwise make it a function of the module";

    effect_of_assertion() =>
        "this assertion changes a variable",
        "generated functions do not check assertions: change the variable before it";

    conditional() =>
        "part of this function depends on `cfg`, which `#[differentiate]` cannot evaluate",
        "remove the condition, or pass what depends on it as an argument";

    conditional_item(name: &str) =>
        "`{name}` depends on `cfg`, which `#[differentiate]` cannot evaluate",
        "remove the condition, or pass `{name}` as an argument";

    no_result_value(name: &str) =>
        "`{name}` is not supported here",
        "return an `Option` from a helper function, or move the check to a function around this one";

    unwrapped_none() => "this option is always `None`", "check the condition under which it is `Some`";

    not_an_option(kind: &str) => "expected an option, found {kind}", "make it an `Option`, or remove the `?`";

    sorted_too_long(most: usize) =>
        "this array is too long to sort: the limit is {most} elements",
        "sorting compares every pair of elements: sort the array before passing it";

    rounded_constants() =>
        "rounding decides this comparison or cast: in single precision, these constants may be equal, out of range or in another order",
        "count iterations with integers, as in `for i in 0..10`, or compute in `f64`";

    large_whole_number() =>
        "this integer exceeds 2⁵³, where `#[differentiate]` rounds integers",
        "pass it as an argument; arithmetic on random bits cannot be differentiated";

    wrapped_whole_number() =>
        "this integer may have been negative and wrapped around, beyond 2⁵³, where it is rounded",
        "apply `rem_euclid` or the subtraction before the cast";

    effect_of_error() => "an error value that changes a variable is not supported", "change the variable before";

    receiver_effect() =>
        "the expression for the place to change has a side effect of its own",
        "bind the index with `let` first";

    error_value() => "the value of an error is not tracked", "write `Err(_)` in a pattern, or `|_|` in a closure";

    rebound_reference() =>
        "making a reference point to another place is not supported",
        "assign through the reference, as in `*x = …`, or alternate between two places by an index into an array";

    not_a_list() => "this does not collect into a `Vec`", "collect a `Vec`: `.collect::<Vec<_>>()`";

    power_unknown() =>
        "the exponent of this integer power is unknown",
        "write the number, as in `n.pow(3)`, or convert the base first: `(n as f64).powi(m)`";

    index_unknown() =>
        "this number must be known at compile time",
        "numbers of elements must not depend on arguments: use literals, constants and loop variables";

    index_outside(kind: &str) => "this is out of range for {kind}", "indices start at 0; step and chunk sizes at 1";

    no_such_choice(kind: &str) =>
        "{kind} cannot be indexed by a value that depends on arguments",
        "index an array whose elements have one type";

    unknown_field(name: &str, kind: &str)
        where help = match kind {
            "a vector" => "its fields are `x`, `y`, `z`",
            "a 2D vector" => "its fields are `x`, `y`",
            "a quaternion" => "its fields are `x`, `y`, `z`, `w`",
            "a matrix" => "its fields are `x_axis`, `y_axis`, `z_axis`",
            "a transform" => "its fields are `matrix3` and `translation`",
            _ => "pass it as an argument",
        } =>
        "{kind} has no supported field `{name}`",
        "{help}";

    numbers_expected(count: usize) => "expected an array of {count} numbers", "write the numbers in brackets";

    axis_not_unit(length: f64) =>
        "the axis of a rotation must have length 1, found length {length:.3}",
        "normalise it: `axis.normalize()`";

    euler_order() =>
        "`from_euler` needs a literal order and three angles",
        "write it as in `Quat::from_euler(EulerRot::YXZ, yaw, pitch, roll)`";

    no_unary(kind: &str) =>
        "this operator is not supported for {kind}",
        "`-` takes numbers, vectors and matrices; `!` takes booleans";

    no_operation(operator: &BinOp, left: &str, right: &str)
        where operator = quote::quote!(#operator).to_string() =>
        "`{operator}` between {left} and {right} is not supported",
        "comparisons take numbers; arithmetic takes numbers, vectors, rotations and transforms as in glam; \
         convert integers to numbers with `as`";

    division_by_zero() => "this integer is divided by zero", "check the divisor first, as in `if n != 0 {{ m / n }} else {{ 0 }}`";

    bits_unknown(operator: &BinOp)
        where operator = quote::quote!(#operator).to_string() =>
        "`{operator}` needs integers that are known at compile time",
        "use literals, constants and loop variables; for arguments, `n % 2` is the last bit, and `n / 2` the others";

    lost_bits(operator: &BinOp)
        where operator = quote::quote!(#operator).to_string() =>
        "the bits that `{operator}` loses here depend on the type of the integer",
        "multiply by a power of two, as in `n * 8` or `n * 2_i32.pow(k)`";

    integer_unknown(name: &str) =>
        "`{name}` needs an integer that is known at compile time",
        "use literals, constants and loop variables";

    not_a_condition(found: &str) => "expected a boolean, found {found}", "compare two numbers";

    branches_differ(then: &str, otherwise: &str)
        where help = if then == otherwise { "use the value inside each branch" } else { "give both the same type" } =>
        "the branches cannot be merged: one is {then}, the other {otherwise}",
        "{help}";

    unknown_iteration() =>
        "the effect of one iteration of this loop cannot be determined",
        "the compiler's own errors may explain why";

    unknown_result() => "the value of this function cannot be determined", "the compiler's own errors may explain why";

    wrong_result(found: &str, expected: &str) =>
        "the function returns {found}, but its return type is {expected}",
        "make both the same";
}

/// Help for functions of the standard library that are not known by name.
const OF_STD: &str = "the source of the standard library is not available: write out what it does instead";

/// Help for items that the attribute does not see: how to make them visible.
const MODULE: &str = "put its definition and this function into one `#[differentiate] mod m { … }`";

/// Help for a constant that the attribute does not see.
const CONSTANT: &str = "define the `const` inside the function, or next to it in a `#[differentiate] mod m { … }`: from elsewhere, \
                        a function can only read constants of its own number type, and integers and booleans of the same file";

/// Replacements for functions that are known but not supported.
const INSTEAD: &[(&str, &str)] = &[
    ("checked_add", "write `Some(n + m)`: sums of integers are assumed not to overflow"),
    ("checked_sub", "write `(n >= m).then(|| n - m)` for unsigned integers, `Some(n - m)` for signed ones"),
    ("into", "give the result a type, as in `let r: Radians = x.into();`, or call `Radians::from(x)`"),
    ("saturating_add", "write `n + m`: sums of integers are assumed not to overflow"),
    (
        "saturating_sub",
        "the type of this integer is not known: write `n.max(m) - m` if it is unsigned, `n - m` if it is signed",
    ),
    ("wrapping_add", "write `n + m`: sums of integers are assumed not to overflow"),
    ("wrapping_mul", "write `n * m`: products of integers are assumed not to overflow"),
    ("wrapping_sub", "write `n - m`; for an index that wraps around, `(n + len - m) % len`"),
    ("div_euclid", "write `((x - x.rem_euclid(y)) / y).round()`"),
    ("from_scale_rotation_translation", "scale the points and use `from_rotation_translation`"),
    ("from_scale", "multiply the vector by the scale"),
    (
        "to_scale_rotation_translation",
        "a transform is assumed to be rigid, with scale 1: use its `translation`, and `Quat::from_affine3a(&t)` or `DQuat::from_affine3(&t)`",
    ),
    (
        "to_euler",
        "compute the angles with `atan2` and `asin` from the rotated axes, as in `(q * Vec3::Z).x.atan2((q * Vec3::Z).z)`",
    ),
];
