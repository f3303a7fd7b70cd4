//! Mistakes that only a Rust item can have.

use super::{errors_of, listed};

/// Wraps one joint's attribute in a rig.
fn joint(settings: &str) -> String {
    format!("#[aim(axes(up = +X, forward = +Y))] struct Thug {{ #[joint({settings})] eye: Joint }}")
}

fn assert_errors(item: &str, expected: &[(&str, &str)]) {
    let found = errors_of(item);
    let found = listed(item, &found);
    let found: Vec<(&str, &str)> = found.iter().map(|(message, at)| (message.as_str(), at.as_str())).collect();
    assert_eq!(found, expected, "{item}");
}

#[test]
fn shapes() {
    for (item, what, at) in [
        ("#[aim(axes(up = +X, forward = +Y))] struct Thug(Joint);", "a tuple struct", "Thug"),
        ("#[aim(axes(up = +X, forward = +Y))] struct Thug;", "a unit struct", "Thug"),
        ("#[aim(axes(up = +X, forward = +Y))] enum Thug { A }", "an enum", "enum"),
        ("#[aim(axes(up = +X, forward = +Y))] union Thug { a: u8 }", "a union", "union"),
    ] {
        assert_errors(item, &[(&format!("a rig is a struct with named fields, found {what}"), at)]);
    }
    assert_errors("#[aim(axes(up = +X, forward = +Y))] struct Thug {}", &[("the rig has no joints", "Thug")]);
    for (generics, at) in [("<T>", "T"), ("<'a, T: Copy>", "'a, T: Copy"), ("<const N: usize>", "const N: usize")] {
        let item = format!(
            "#[aim(axes(up = +X, forward = +Y))] struct Thug{generics} {{ #[joint(heading = free, rate = 1rad)] eye: Joint }}"
        );
        assert_errors(&item, &[("a rig cannot be generic", at)]);
    }
}

#[test]
fn attributes() {
    assert_errors(
        "struct Thug { #[joint(heading = free, rate = 1rad)] eye: Joint }",
        &[("the bones' axes are missing", "Thug")],
    );
    assert_errors(
        "#[aim(axes(up = +X, forward = +Y))] struct Thug { eye: Joint }",
        &[("the field `eye` has no `#[joint]`", "eye")],
    );
    assert_errors(
        "#[aim(axes(up = +X, forward = +Y))] struct Thug { #[joint] eye: Joint }",
        &[("`#[joint]` has no settings", "joint")],
    );
    assert_errors(
        "#[aim = 5] struct Thug { #[joint(heading = free, rate = 1rad)] eye: Joint }",
        &[("`#[aim]` has no settings", "aim")],
    );
    assert_errors(
        "#[aim(axes(up = +X, forward = +Y))] #[aim()] struct Thug { #[joint(heading = free)] #[joint(rate = 1rad)] eye: Joint }",
        &[("the struct has a second `#[aim]`", "aim"), ("the field has a second `#[joint]`", "joint")],
    );
    assert_errors(
        "#[aim(axes(up = +X, forward = +Y))] #[joint()] struct Thug { #[aim()] #[joint(heading = free, rate = 1rad)] eye: Joint }",
        &[("`#[aim]` is on a field", "aim"), ("`#[joint]` is on the struct", "joint")],
    );
}

#[test]
fn kernels() {
    let rig = |kernels: &str| {
        format!(
            "#[aim(axes(up = +X, forward = +Y), {kernels})] struct Thug {{ #[joint(heading = free, rate = 1rad)] eye: Joint }}"
        )
    };
    assert_errors(
        &rig("kernels(aim_gradiant, chain_value_gradient, residual, chain_value_gradient)"),
        &[
            ("`chain_value_gradient` is named twice", "chain_value_gradient"),
            ("unknown kernel `aim_gradiant`", "aim_gradiant"),
            ("unknown kernel `residual`", "residual"),
        ],
    );
    assert_errors(&rig("kernels = 5"), &[("`kernels` needs a list of kernels, found `5`", "5")]);
    let item = syn::parse_str(&rig("kernels(chain_value_gradient, aim_gradient)")).expect("it is a struct");
    let declared = crate::declare::from_derive_input(&item).expect("it is right");
    assert_eq!(declared.spec.kernels, ["chain_value_gradient", "aim_gradient"]);
}

#[test]
fn open_ranges() {
    for range in ["-35deg..35deg", "-35deg..", "..=35deg", "..", "..35deg"] {
        assert_errors(&joint(&format!("heading = {range}, rate = 1rad")), &[("the range of `heading` is open", range)]);
    }
}

#[test]
fn expressions() {
    for (rate, found, at) in [
        ("RATE", "`RATE`", "RATE"),
        ("2.0 * 3deg", "an expression", "2.0 * 3deg"),
        ("rate()", "an expression", "rate()"),
        ("f32::MAX", "an expression", "f32::MAX"),
        ("{ 5deg }", "an expression", "{ 5deg }"),
        ("\"450deg\"", "the string `\"450deg\"`", "\"450deg\""),
        ("'a'", "a literal of another kind", "'a'"),
        ("--5deg", "an expression", "--5deg"),
    ] {
        let message = format!("`rate` needs an angle per second, found {found}");
        assert_errors(&joint(&format!("heading = free, rate = {rate}")), &[(&message, at)]);
    }
    assert_errors(&joint("heading = free, rate = \"35°\""), &[("`°` is not an angle unit", "\"35°\"")]);
    assert_errors(
        &joint("heading = -LIMIT..=LIMIT, rate = 1rad"),
        &[("`heading` needs an angle, found `-LIMIT`", "-LIMIT"), ("`heading` needs an angle, found `LIMIT`", "LIMIT")],
    );
}

#[test]
fn punctuation() {
    assert_errors(&joint("heading = free rate = 1rad"), &[("expected `,` before `rate`", "rate")]);
    assert_errors(
        &joint("heading = free rate = 1rad axes(up = +X, forward = +Y)"),
        &[("expected `,` before `rate`", "rate"), ("expected `,` before `axes`", "axes")],
    );
    assert_errors(
        &joint("heading = free,, rate = 1rad, mirrored"),
        &[("expected the name of a setting, found `,`", ","), ("`mirrored` needs a value", "mirrored")],
    );
    assert_errors(
        &joint("heading: free, rate = , 5 = 3"),
        &[
            ("`heading` needs a value", ": free"),
            ("`rate` needs a value", "="),
            ("expected the name of a setting, found `5 = 3`", "5 = 3"),
        ],
    );
    assert_errors(
        &joint("heading(free), rate = 1rad"),
        &[("`heading` needs a range of angles or `free`, found a group of settings", "(free)")],
    );
}

#[test]
fn names() {
    let rig = |rig: &str, first: &str, second: &str| {
        format!(
            "#[aim(axes(up = +X, forward = +Y))] struct {rig} {{ #[joint(heading = free, rate = 1rad)] {first}: Joint, #[joint(heading = free, rate = 1rad)] {second}: Joint }}"
        )
    };
    assert_errors(
        &rig("Thug", "leftEye", "left_eye"),
        &[("`leftEye` and `left_eye` are both `left_eye` in C and WGSL", "left_eye")],
    );
    assert_errors(&rig("Float", "eye", "neck"), &[("the name `Float` becomes `float`, a keyword of C", "Float")]);
    assert_errors(
        &rig("Thug", "r#fn", "var"),
        &[("the name `fn` is a keyword of WGSL", "r#fn"), ("the name `var` is a keyword of WGSL", "var")],
    );
    assert_errors(
        &rig("Thüg", "œil", "neck"),
        &[("the name `Thüg` is not ASCII", "Thüg"), ("the name `œil` is not ASCII", "œil")],
    );
    assert_errors(&rig("__Thug", "eye", "neck"), &[("the name `__Thug` starts with two underscores", "__Thug")]);
}

#[test]
fn pair_belongs_to_the_first_joint() {
    assert_errors(
        "#[aim(axes(up = +X, forward = +Y))] struct Thug { #[joint(heading = free, rate = 1rad)] eye: Joint, #[joint(heading = free, rate = 1rad, other_eye = \"R\")] neck: Joint }",
        &[("`other_eye` is not on the first joint", "\"R\"")],
    );
}

#[test]
fn the_facade_path_is_a_path() {
    assert_errors(
        "#[aim(axes(up = +X, forward = +Y), crate = 5)] struct Thug { #[joint(heading = free, rate = 1rad)] eye: Joint }",
        &[("`crate` needs a path, found `5`", "5")],
    );
}

#[test]
fn compile_errors_carry_the_help() {
    let tokens = errors_of(&joint("heading = free, rate = 1rad, rate = 2rad")).into_compile_error().to_string();
    assert!(tokens.contains("`rate` is set twice\\n\\n  = help: keep one of the two"), "{tokens}");
    assert!(tokens.contains("note: `rate` was first used here"), "{tokens}");
    assert_eq!(tokens.matches("compile_error").count(), 2, "{tokens}");
}
