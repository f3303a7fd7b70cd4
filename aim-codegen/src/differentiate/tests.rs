//! Expansions of the attribute, as tokens: the function unchanged, with companions or errors beside it.

use proc_macro2::TokenStream;
use syn::{Item, ItemFn};

use super::differentiate;
use super::file::Differentiated;

fn expand(attribute: &str, item: &str) -> String {
    let tokens = |text: &str| text.parse::<TokenStream>().expect("tests are made of tokens");
    differentiate(tokens(attribute), tokens(item), "aim").to_string()
}

/// Returns the functions of an expansion, without the errors.
fn functions(expansion: &str) -> Vec<ItemFn> {
    let file: syn::File = syn::parse_str(expansion).unwrap_or_else(|error| panic!("{error}: {expansion}"));
    file.items
        .into_iter()
        .filter_map(|item| match item {
            Item::Fn(function) => Some(function),
            _ => None,
        })
        .collect()
}

fn names(expansion: &str) -> Vec<String> {
    functions(expansion).iter().map(|function| function.sig.ident.to_string()).collect()
}

/// Counts the errors of an expansion.
fn errors(expansion: &str) -> usize {
    expansion.matches("compile_error").count()
}

/// Function bodies that are hard for programs, constant folding or literals.
const ODD: &[&str] = &[
    "1e300 * 1e300 * x",
    "x / 0.0 + 0.0 / 0.0",
    "(0.0 * x - 1.0).sqrt() + (-1.0f64).ln()",
    "x.powi(2147483647) + x.powi(-2147483647) + x.powi(0)",
    "0.0",
    "({ let x = x; ({ let x = x * x; x } + x) })",
    "if true { x } else { f64::MAX }",
    "if x != x { x } else if !(x < 1.0 && x > 0.0 || x == 2.0) { -x } else { 1.0 }",
    "(x, [x; 3], (x,)).1[2]",
    "(-(-x)).sin() + (x * -0.0).cos() + (x / 3.0 * -2.0).sin_cos().1",
    "DQuat::from_rotation_x(1e400).w",
    "DQuat::from_xyzw(0.0, 0.0, 0.0, 1.0).mul_vec3(DVec3::splat(x)).x",
    "DVec3::ZERO.normalize().x * x + DVec3::ZERO.length() + DVec3::X.angle_between(DVec3::X) * x",
    "DMat3::ZERO.inverse().determinant() + x",
    "DMat3::from_cols_array(&[x; 9]).inverse().x_axis.y",
    "DQuat::from_axis_angle(DVec3::new(0.6, x, 0.8).normalize(), core::f64::consts::FRAC_PI_2).y",
    "(if x < 1.0 { DQuat::from_rotation_x(x) } else { DQuat::IDENTITY } * DVec3::Y).z",
];

#[test]
fn unusual_functions_are_differentiated_or_reported() {
    for value in ODD {
        let item = format!("fn f(x: f64) -> f64 {{ {value} }}");
        let expansion = expand("wrt(x), hessian", &item);
        assert_eq!(names(&expansion), ["f", "f_gradient", "f_hessian"], "{value}");
        assert_eq!(errors(&expansion), usize::from(value.contains("1e400")), "{value}: {expansion}");
    }
}

#[test]
fn the_function_is_emitted_as_written() {
    let item = "# [doc = \"Words.\"] # [inline (never)] pub (crate) fn f (x : f32) -> f32 { x * 1.50_0e0 }";
    let tokens = |text: &str| text.parse::<TokenStream>().expect("tests are made of tokens").to_string();
    for attribute in ["wrt(x)", "wrt(y)", "", "wrt(x), budget = 0", "wrt(x), what = 1", "= ( ,, "] {
        let attribute = if attribute.contains('(') && !attribute.contains(')') { "= ,," } else { attribute };
        let expansion = expand(attribute, item);
        assert!(expansion.contains(&tokens(item)), "{expansion}");
        assert_eq!(errors(&expansion) == 0, attribute == "wrt(x)", "{attribute}: {expansion}");
        assert_eq!(names(&expansion), ["f", "f_gradient"], "with errors, a stub: {attribute}");
    }
}

#[test]
fn one_sine_and_cosine_of_one_angle() {
    let expansion = expand("wrt(x)", "fn f(x: f32, v: &Vec3) -> f32 { (Quat::from_rotation_x(x) * *v).dot(*v) }");
    assert_eq!(expansion.matches("sin_cos").count(), 1, "{expansion}");
    assert!(!expansion.contains(":: sin (") && !expansion.contains(":: cos ("), "{expansion}");
    assert!(!expansion.contains("glam"), "emitted code speaks the user's glam: {expansion}");
}

#[test]
fn matrix_types_come_from_the_module_of_the_users_vectors() {
    let of = |vector: &str| expand("wrt(v)", &format!("fn f(v: {vector}) -> {vector} {{ v * 2.0 }}")).replace(' ', "");
    assert!(of("glam::Vec3").contains("(glam::Mat3,)"));
    assert!(of("::bevy::math::DVec3").contains("(::bevy::math::DMat3,)"));
    assert!(of("Vec3A").contains("(::aim::glam::Mat3,)"));
}

#[test]
fn the_same_function_gives_the_same_code() {
    let item = "fn f(x: f32, v: Vec3) -> f32 { (Quat::from_rotation_y(x) * v).normalize().z * v.length() }";
    assert_eq!(expand("wrt(v, x), hessian", item), expand("wrt(v, x), hessian", item));
}

#[test]
fn sums_of_thousands_of_terms_are_differentiated() {
    let sum = vec!["x * k"; 2000].join(" + ");
    let expansion = expand("wrt(x)", &format!("fn f(x: f32, k: f32) -> f32 {{ {sum} }}"));
    assert_eq!(errors(&expansion), 0);
}

#[test]
fn unsupported_uses_of_kept_loops_are_reported() {
    for (options, body, what) in [
        ("wrt(x)", "let mut s = vec![]; for a in v { s.push(a * x); } s[0]", "different kinds"),
        (
            "wrt(x)",
            "let mut s = x; let mut f = || { for a in v { s += a; if a > &x { return *a; } } x }; f() * s",
            "`&mut` argument",
        ),
        ("wrt(v)", "v[0] * x", "the length of this slice"),
        ("wrt(x), hessian", "v.iter().map(|a| a * x).sum()", "known bounds"),
        ("wrt(x), lanes", "x * n as f32", "lanes"),
        ("wrt(x)", "x * v.iter().filter(|a| **a > x).rev().sum::<f32>()", "`rev` of an iterator of unknown length"),
        (
            "wrt(x)",
            "let mut s = 0.0; let t: f32 = v.iter().zip(v.iter().map(|a| { s += a; s })).map(|(a, b)| a * b).sum(); x * t",
            "whether and when",
        ),
        ("wrt(x)", "v.iter().take_while(|a| **a < x).zip([x; 4]).map(|(a, b)| a * b).sum()", "cannot be zipped"),
    ] {
        let expansion = expand(options, &format!("fn f(x: f32, v: &[f32], n: usize) -> f32 {{ {body} }}"));
        assert!(errors(&expansion) > 0, "{body}: {expansion}");
        assert!(expansion.contains(what), "{body}: {expansion}");
    }
    let source = "#[differentiate(wrt(x))] fn f(x: f32, v: &[f32]) -> f32 { v.iter().map(|a| a * x).sum() }";
    let errors = Differentiated::from_file("f.rs", source, "f").expect_err("C is straight lines");
    assert!(errors.to_string().contains("only Rust output"), "{errors}");
}

#[test]
fn code_with_an_uncertain_result_is_reported() {
    for (body, what) in [
        ("let mut t = 0.0; let mut s = x; while t < 1.0 { s += x * 0.1; t += 0.1; } s", "rounding"),
        ("if 0.1f32 + 0.2 > 0.3 { x } else { 2.0 * x }", "rounding"),
        ("let b = 1e30f32 * 1e20; if b < f32::INFINITY { x } else { 2.0 * x }", "rounding"),
        ("x * (0.7f32 / 0.1) as usize as f32", "rounding"),
        ("let mut s = 7u64; for _ in 0..3 { s = (s * 1103515245 + 12345) % 2147483648; } x * s as f32", "2⁵³"),
        ("x * ((0i32 - 1) as usize % 4) as f32", "2⁵³"),
        (
            "let mut n = 1.0; let mut inc = |a: f32, add: bool| { if add { n += a; } n * a }; let p = inc(x, true); \
             p + [x, 2.0].iter().map(|a| inc(*a, false)).sum::<f32>()",
            "closure",
        ),
        ("let mut n = x; let o: Result<f32, f32> = Some(x).ok_or({ n += 1.0; n }); n + o.unwrap_or(1.0)", "error"),
        ("let mut n = x; let o: Result<f32, f32> = Err({ n += 1.0; n }); n + o.unwrap_or(1.0)", "error"),
        (
            "let mut i = 0; let mut g = [[x, 1.0], [2.0, 3.0], [4.0, 5.0], [6.0, x]]; g[{ i += 1; i }].swap(0, 1); g[1][0]",
            "bind the index",
        ),
        ("let mut i = 0; let mut g = [x, 1.0, 2.0]; g[{ i += 1; i }] += { i += 1; x }; g[1]", "bind the index"),
        ("let mut v = vec![x]; if x > 1.0 { v.push(2.0); } v.swap(0, 0); v[0]", "of known length"),
        ("let mut s = x; let n = [x, 1.0].iter().map(|a| { s += a; s }).len(); s * n as f32", "whether and when"),
    ] {
        let expansion = expand("wrt(x)", &format!("fn f(x: f32) -> f32 {{ {body} }}"));
        assert_eq!(errors(&expansion), 1, "{body}: {expansion}");
        assert!(expansion.contains(what), "{body}: {expansion}");
    }
}

#[test]
fn integers_and_floats_are_not_mixed() {
    for value in ["x.powi(x)", "x * 2", "x + n", "x + n as u8 as f32"] {
        let item = format!("fn f(x: f32, n: usize) -> f32 {{ {value} }}");
        assert_eq!(errors(&expand("wrt(x)", &item)), 1, "{value}");
    }
    for value in [
        "x.powi(n as i32)",
        "x.powi(7 / 2 * 2)",
        "f32::powi(x, -(2)) + x.powi(-2147483648)",
        "x * (n + 1) as f32",
        "[x; 3][n]",
        "x + (n / 2) as f32",
    ] {
        let item = format!("fn f(x: f32, n: usize) -> f32 {{ {value} }}");
        assert_eq!(errors(&expand("wrt(x)", &item)), 0, "{value}");
    }
}

/// Rejects code that would otherwise be misinterpreted.
#[test]
fn code_that_would_be_misinterpreted_is_reported() {
    for value in [
        "x + [x, 2.0].iter().map(|v| Default::default()).fold(x, |a, b| a + b)",
        "x + f32::from(Default::default())",
        "x + [x; 0].iter().copied().fold(None, |_, v| Some(v)).unwrap()",
        "{ let mut n = x; [x, 2.0].iter().map(|v| { n += v; n }).take(1).sum::<f32>() }",
        "{ let mut n = x; let late = [x, 2.0].iter().map(|v| { n += v; n }); late.sum::<f32>() }",
        "{ let mut n = x; let mut add = |v| n += v; let twice = || { add(x); add(x) }; twice(); n }",
        "{ let mut n = x; each(|v| n += v); n }",
        "[x, 2.0].iter().collect::<std::collections::BTreeSet<_>>().len() as f32",
        "{ let mut n = x; assert!({ n += 1.0; n > 0.0 }); n }",
        "{ let mut n = x; [x, 2.0].iter().for_each(move |v| n += v); n }",
        "x + [x; 0].iter().map(|v| v + 1.0).sum().abs()",
        "{ let one = [x, 2.0]; one.iter().filter(|v| **v > x).step_by(2).sum() }",
    ] {
        let item = format!("fn f(x: f32) -> f32 {{ {value} }}");
        assert_eq!(errors(&expand("wrt(x)", &item)), 1, "{value}");
    }
}

/// Evaluating such a pattern used to recurse without end.
#[test]
fn payloads_of_errors_are_not_matched() {
    for pattern in ["E::Neg(v)", "E::Far { at: v }", "(v, E::Neg(_))"] {
        let expansion = expand(
            "",
            &format!(
                "mod m {{ enum E {{ Neg(f64), Far {{ at: f64 }} }} fn g(x: f64) -> Result<f64, E> {{ Err(E::Neg(x)) }} \
                 #[differentiate(wrt(x))] fn f(x: f64) -> f64 {{ match g(x) {{ Ok(v) => v, Err({pattern}) => v * v }} }} }}"
            ),
        );
        assert_eq!(errors(&expansion), 1, "{pattern}: {expansion}");
        assert!(expansion.contains("an error is not tracked"), "{pattern}: {expansion}");
    }
}

/// Recursive types are read once.
#[test]
fn recursive_types_are_read_once() {
    for tree in ["enum Tree { Leaf(f64), Node(&'static Tree) }", "struct Tree { k: f64, next: Option<&'static Tree> }"]
    {
        let module = format!("mod m {{ {tree} #[differentiate(wrt(x))] fn f(t: &Tree, x: f64) -> f64 {{ x }} }}");
        assert_eq!(errors(&expand("", &module)), 0, "{tree}");
    }
    let module =
        "mod m { struct Tree { k: f64, next: Tree } #[differentiate(wrt(x))] fn f(t: Tree, x: f64) -> f64 { x } }";
    assert_eq!(errors(&expand("", module)), 0, "the compiler says so");
}

/// A generic parameter resolves to the argument's type, even if another struct has the parameter's name.
#[test]
fn the_default_of_a_generic_parameter_is_that_of_its_argument() {
    let module = |parameter: &str| {
        format!(
            "mod m {{ #[derive(Clone, Copy, Default)] struct P {{ a: f64 }} \
             #[derive(Clone, Copy, Default)] struct Q {{ b: f64 }} \
             fn made<{parameter}: Default>(p: {parameter}) -> {parameter} {{ {parameter}::default() }} \
             #[differentiate(wrt(x))] fn f(x: f64) -> f64 {{ x + made(Q {{ b: x }}).b }} }}"
        )
    };
    for parameter in ["P", "T"] {
        assert_eq!(errors(&expand("", &module(parameter))), 0, "{parameter}");
    }
}

#[test]
fn a_module_is_emitted_as_written_without_its_differentiate_attributes() {
    let module = "# [cfg (all ())] pub mod m { # ! [doc = \" Words.\"] use core :: fmt ; struct S (f32) ; \
                  # [differentiate (wrt (x))] # [inline] fn f (x : f32) -> f32 { x } fn g () { } }";
    let expansion = expand("", module);
    assert_eq!(errors(&expansion), 0, "{expansion}");
    let file: syn::File = syn::parse_str(&expansion).expect("inner attributes stand inside");
    let [Item::Mod(found)] = file.items.as_slice() else { panic!("one module: {expansion}") };
    let items = found.content.as_ref().map_or(&[][..], |(_, items)| items);
    assert_eq!(items.len(), 5, "and a companion");
    assert_eq!(found.attrs.len(), 2);
    assert!(!expansion.contains("# [differentiate"), "{expansion}");
}

#[test]
fn functions_of_a_file_see_their_module() {
    let text = "#[differentiate] mod m { const K: f64 = 2.0; fn twice(x: f64) -> f64 { K * x }
        #[differentiate(wrt(x))] fn f([a, b]: [f64; 2], x: f64) -> f64 { twice(x) * a + b } }
        #[differentiate(wrt(x))] fn g(x: f64) -> f64 { twice(x) }";
    let f = Differentiated::from_file("f.rs", text, "f").expect("it is told what `twice` and `K` are");
    assert_eq!(f.procedures()[0].parameters, [("in_0".to_owned(), Some(2)), ("in_x".to_owned(), None)]);
    assert!(Differentiated::from_file("f.rs", text, "g").is_err(), "it is outside of the module");
}

/// glam's own method comes before that of a trait, also if it is not supported.
#[test]
fn methods_of_traits_come_after_those_of_glam() {
    let body = |method: &str| {
        format!(
            "#[differentiate] mod m {{ trait Own {{ fn {method}(self, other: Self) -> Self; }}
            impl Own for DVec3 {{ fn {method}(self, other: Self) -> Self {{ self - other }} }}
            impl Own for Vec3 {{ fn {method}(self, other: Self) -> Self {{ self - other }} }}
            impl Own for Vec3A {{ fn {method}(self, other: Self) -> Self {{ self + other }} }}
            #[differentiate(wrt(v))] fn f(v: DVec3) -> DVec3 {{ v.{method}(DVec3::X) }}
            #[differentiate(wrt(v))] fn g(v: Vec3) -> Vec3 {{ v.{method}(Vec3::X) }} }}"
        )
    };
    let refused = |method: &str, function: &str| {
        Differentiated::from_file("f.rs", &body(method), function).map_err(|errors| errors.to_string()).err()
    };
    assert_eq!(refused("away_from", "f"), None);
    let error = refused("away_from", "g").expect("`Vec3` and `Vec3A` are not told apart");
    assert!(error.contains("`away_from` is ambiguous"), "{error}");
    for method in ["slerp", "rotate_towards", "dot_into_vec"] {
        let error = refused(method, "f").expect("it is glam's");
        assert!(error.contains(&format!("`{method}` of a vector cannot be differentiated")), "{error}");
    }
}

#[test]
fn functions_of_a_file_see_the_constants_beside_them() {
    let text = "use units::{self, KM}; const K: f64 = 2.0 * KM; mod units { pub const KM: f64 = 1e3; }
        #[differentiate(wrt(x))] fn f(x: f64) -> f64 { (K + units::KM) * x }
        mod inner { const N: usize = 2; #[differentiate(wrt(x))] fn g(x: [f64; N]) -> f64 { x[N - 1] } }
        fn h(x: f64) -> f64 { x }
        #[differentiate(wrt(x))] fn k(x: f64) -> f64 { h(x) }
        #[differentiate(wrt(x))] fn l(x: f64) -> f64 { LIMIT * x }";
    let f = Differentiated::from_file("f.rs", text, "f").expect("its constants are known");
    let c = crate::emit::c::emit_procedures("of f.rs", &f.procedures());
    assert!(c.contains("3000.0"), "{c}");
    Differentiated::from_file("f.rs", text, "g").expect("its length is known");
    let refused = Differentiated::from_file("f.rs", text, "k").expect_err("the attribute sees no other functions");
    assert!(refused.to_string().contains("the body of `h`"), "{refused}");
    let refused = Differentiated::from_file("f.rs", text, "l").expect_err("the constant is in another file");
    assert!(refused.to_string().contains("next to it: constants of other files"), "{refused}");
}

#[test]
fn each_companion_gets_a_lane_version() {
    let item = "fn f((v, flag): (Vec3, bool), &m: &Mat3, n: [u8; 2], q: Quat) -> f32 { v.x * m.x_axis.x * q.w }";
    let expansion = expand("wrt(q), hvp, lanes", item);
    assert_eq!(names(&expansion), ["f", "f_gradient", "f_gradient_lanes", "f_hvp", "f_hvp_lanes"], "{expansion}");
    let expansion = expansion.replace(' ', "");
    assert!(expansion.contains("fnf_hvp_lanes<S:::aim::__private::Real>("), "{expansion}");
    assert!(
        expansion.contains("([S;3],S,),__argument1:&[S;9],n:[S;2],q:[S;4],along_q:[S;4])->(S,([S;4],))"),
        "{expansion}"
    );
    // If there is an error, each companion is a stub.
    let wrong = expand("wrt(q), hvp, lanes", &item.replace("q.w", "q.v"));
    assert_eq!((names(&wrong).len(), errors(&wrong)), (5, 1), "{wrong}");
    assert_eq!(errors(&expand("wrt(q), lanes = 4", item)), 1);
}

/// For a chain of points, a Hessian-vector product costs a constant number of operations for each point; the Hessian
/// itself grows with the square of their number.
#[test]
fn operations_of_products_grow_linearly() {
    let of = |points: usize| {
        let item = format!(
            "#[differentiate(wrt(p), hessian, jvp, vjp, hvp)] fn f(p: [f64; {points}]) -> f64 {{
                let mut sum = 0.0;
                for [a, b] in p.windows(2).map(|w| [w[0], w[1]]) {{
                    sum += ((b - a).sin() - 0.3).powi(2) * b;
                }}
                sum
            }}"
        );
        let derived = Differentiated::from_file("f.rs", &item, "f").unwrap_or_else(|errors| panic!("{errors}"));
        derived.procedures().iter().map(|procedure| procedure.program.count().total()).collect::<Vec<_>>()
    };
    let (short, long) = (of(10), of(20));
    let links = |points: usize| points - 1;
    for (k, most) in [(0, 10), (2, 12), (3, 11), (4, 23)] {
        assert!(short[k] <= most * links(10), "{short:?}");
        assert!(long[k] - short[k] <= most * 10, "{short:?}, {long:?}");
    }
}

/// Counts the operations of the companion in an expansion, where a select counts as two; also returns the companion's
/// length when formatted.
fn size(item: &str, attribute: &str) -> (usize, usize) {
    let expansion = expand(attribute, item);
    assert_eq!(errors(&expansion), 0, "{expansion}");
    let companion = functions(&expansion).pop().expect("a companion beside the function");
    let tokens = quote::ToTokens::to_token_stream(&companion.block);
    let length = prettyplease::unparse(&syn::parse_quote!(#companion)).len();
    (operations(tokens), length)
}

fn operations(tokens: TokenStream) -> usize {
    use proc_macro2::TokenTree;
    let mut count = 0;
    // A sign is a binary operator only if an operand precedes it.
    let mut after_operand = false;
    for token in tokens {
        match &token {
            TokenTree::Group(group) => count += operations(group.stream()),
            TokenTree::Punct(sign) if after_operand && "+-*/".contains(sign.as_char()) => count += 1,
            TokenTree::Ident(name) if name == "select_less" => count += 2,
            TokenTree::Ident(name) if ["sqrt", "sin_cos", "sin", "cos"].iter().any(|call| name == call) => count += 1,
            _ => {}
        }
        after_operand = !matches!(token, TokenTree::Punct(_));
    }
    count
}

/// Builds a function body: `first`, then `step` repeated `count` times with `#` replaced by the index, then `last`.
fn repeated(count: usize, [first, step, last]: [&str; 3]) -> String {
    let steps: String = (0..count).map(|i| step.replace('#', &i.to_string())).collect();
    format!("{{ {first} {steps} {last} }}")
}

#[test]
fn eighty_layers_take_less_than_sixty_kilobytes() {
    let of = |count: usize, wrt: &str| {
        let body = repeated(count, ["", "let x = (w[#] * x + b[#]).max(0.0);", "x"]);
        let item = format!("fn f(x: f64, w: [f64; {count}], b: [f64; {count}]) -> f64 {body}");
        size(&item, wrt)
    };
    let (by_x, length) = of(80, "wrt(x)");
    assert!(by_x <= 12 * 80 && length < 60_000, "{by_x} operations and selects, {length} bytes");
    let (by_all, _) = of(80, "wrt(x, w, b)");
    assert!(by_all <= 12 * 80, "{by_all} operations and selects");
}

#[test]
fn reused_conditions_and_branches_are_emitted_once() {
    for (what, arguments, body) in [
        ("conditions", "x: f64", ["let c = x > 1.0;", "let c = c && (c || x > 2.0);", "if c { x * x } else { x }"]),
        (
            "conditions in branches",
            "x: f64",
            ["let c = x > 1.0;", "let c = if x > #.0 { c || x < 0.5 } else { !c };", "if c { x * x } else { x }"],
        ),
        (
            "quaternions",
            "x: f64, v: DVec3",
            [
                "let q = DQuat::from_rotation_x(x);",
                "let q = if x > #.0 { q * DQuat::from_rotation_y(x) } else { q * DQuat::from_rotation_z(x) };",
                "(q * v).z",
            ],
        ),
        (
            "matrices",
            "x: f64, v: DVec3",
            [
                "let m = DMat3::from_rotation_x(x);",
                "let m = if x > #.0 { m * DMat3::from_rotation_y(x) } else { m * DMat3::from_rotation_z(x) };",
                "(m * v).z",
            ],
        ),
        (
            "transforms",
            "x: f64, v: DVec3",
            [
                "let m = DAffine3::from_rotation_x(x);",
                "let m = if x > #.0 { m * DAffine3::from_rotation_y(x) } else { DAffine3::from_rotation_z(x) * m };",
                "m.transform_point3(v).z",
            ],
        ),
    ] {
        let sizes =
            [8, 16, 24].map(|count| size(&format!("fn f({arguments}) -> f64 {}", repeated(count, body)), "wrt(x)").0);
        let [first, second] = [sizes[1] - sizes[0], sizes[2] - sizes[1]];
        assert!(5 * second <= 6 * first && sizes[2] <= 100 * 24, "{what}: {sizes:?}");
    }
}

/// Unknown values are not taken from an item of the same name, nor from another implementation.
#[test]
fn unknown_generic_parameters_do_not_resolve_to_other_items() {
    for module in [
        "const N: usize = 10; struct P<const N: usize>([f64; N]); impl<const N: usize> P<N> { const LAST: usize = N - 1; \
         fn last(&self) -> f64 { self.0[Self::LAST - 7] } } \
         #[differentiate(wrt(x))] fn f(x: f64) -> f64 { P([x, x, 2.0]).last() }",
        "struct P<const N: usize>([f64; N]); trait W { const W: f64; } impl W for P<2> { const W: f64 = 1.0; } \
         impl W for P<3> { const W: f64 = 2.0; } \
         #[differentiate(wrt(x))] fn f(x: f64) -> f64 { x * <P<3> as W>::W }",
    ] {
        assert_eq!(errors(&expand("", &format!("mod m {{ {module} }}"))), 1, "{module}");
    }
}
