//! `aim generate`, `aim check` and `aim count` for every bundled rig: deterministic, and accepted by the target
//! toolchain.

use std::path::Path;
use std::process::{Command, Stdio};

use crate::common::{Place, bundled_rigs, different_rigs, installed};
use aim_codegen::objective::{CHAIN_RESIDUAL_JACOBIAN, FirstLink};

const LANGUAGES: [&str; 5] = ["rust", "c", "wgsl", "latex", "maxima"];

fn name(rig: &Path) -> &str {
    rig.file_stem().and_then(|stem| stem.to_str()).expect("a rig's file has a name")
}

/// Writes the rig's code in this language to `NAME.LANGUAGE`; returns the file's name.
#[track_caller]
fn generate(place: &Place, rig: &Path, language: &str) -> String {
    let file = format!("{}.{language}", name(rig));
    let ran = place.run([
        "generate".as_ref(),
        rig.as_os_str(),
        "--lang".as_ref(),
        language.as_ref(),
        "-o".as_ref(),
        file.as_ref(),
    ]);
    assert_eq!((ran.code, ran.stderr.as_str(), ran.stdout.as_str()), (0, "", ""), "{file}");
    file
}

#[test]
fn every_language_for_every_rig_twice_the_same() {
    let place = Place::new();
    for rig in different_rigs() {
        for language in LANGUAGES {
            let file = generate(&place, &rig, language);
            let printed = place.run(["generate".as_ref(), rig.as_os_str(), "--lang".as_ref(), language.as_ref()]);
            assert_eq!(printed.stdout.as_bytes(), place.read(&file), "{file}");
            assert!(!printed.stdout.contains(env!("CARGO_MANIFEST_DIR")), "{file} names a folder of this machine");
            assert!(printed.stdout.ends_with('\n') && !printed.stdout.contains('\r'), "{file}");
        }
    }
}

#[test]
fn a_check_tells_fresh_from_stale() {
    let place = Place::with_mannequin();
    for language in LANGUAGES {
        place.done(&format!("generate m.toml --lang {language} -o code"));
        let fresh = place.done(&format!("generate m.toml --lang {language} --check code"));
        assert_eq!(fresh.stdout, "");
        let text = String::from_utf8(place.read("code")).expect("text");
        // Line endings are left to git and ignored by `--check`.
        place.write("code", &text.replace('\n', "\r\n"));
        place.done(&format!("generate m.toml --lang {language} --check code"));
        place.write("code", &text.replacen('1', "2", 1));
        let stale = place.aim(&format!("generate m.toml --lang {language} --check code"));
        assert_eq!((stale.code, stale.stdout.as_str()), (1, ""), "{}", stale.stderr);
        let again = format!("aim generate m.toml --lang {language} -o code");
        assert!(stale.stderr.contains("stale") && stale.stderr.contains(&again), "{}", stale.stderr);
        place.write("code", "");
        assert_eq!(place.aim(&format!("generate m.toml --lang {language} --check code")).code, 1);
    }
    place.refused("generate m.toml --lang c --check gone.c", &["gone.c", "-o"]);
    assert_eq!(place.names(), ["code", "m.glb", "m.toml"]);
}

#[test]
fn c_compiles_without_a_warning() {
    let place = Place::new();
    let mut all = String::new();
    for rig in different_rigs() {
        let file = generate(&place, &rig, "c");
        all += &format!("#include \"{file}\"\n");
    }
    place.write("all.c", &all);
    for (standard, more) in [("-std=c99", "-pedantic"), ("-std=c17", "-Wconversion")] {
        let compiler = Command::new("cc")
            .current_dir(place.path("."))
            .args([standard, more, "-O2", "-Wall", "-Wextra", "-Werror", "-c", "all.c", "-o", "all.o"])
            .output()
            .expect("a C compiler called cc is installed");
        assert!(compiler.status.success(), "{standard}: {}", String::from_utf8_lossy(&compiler.stderr));
    }
}

#[test]
fn maxima_computes_what_the_interpreter_does() {
    if !installed("maxima") {
        return;
    }
    let place = Place::new();
    let (mut batch, mut expected) = (String::from("display2d: false$ fpprintprec: 12$\n"), Vec::new());
    for rig in different_rigs() {
        let file = generate(&place, &rig, "maxima");
        let text = std::fs::read_to_string(&rig).expect("the rig is there");
        let spec = aim_codegen::declare::from_toml("rig.toml", &text).expect("a bundled rig is right");
        let program = CHAIN_RESIDUAL_JACOBIAN.kernels(&spec, FirstLink::Given).remove(0).program;
        // A slightly bent chain with a target in front of it.
        let (n, turn) = (spec.joints.len(), [0.8, 0.6, 0.0, -0.6, 0.8, 0.0, 0.0, 0.0, 1.0, 0.02, 0.1, 0.05]);
        let mut inputs: Vec<f64> = turn.repeat(n);
        inputs.extend([1.3, 2.1, -0.7]);
        inputs.extend([0.28, 0.96, -0.6, 0.8].repeat(n));
        let mut out = vec![0.0; program.outputs().len()];
        program.run(&inputs, &mut out);
        let function = format!("{}_chain_residual_jacobian", aim_codegen::snake_case(&spec.name));
        let arguments: Vec<String> = inputs.iter().map(f64::to_string).collect();
        batch += &format!(
            "batchload(\"{file}\")$\nfor x in {function}({}) do print(\"=\", float(x))$\n",
            arguments.join(",")
        );
        expected.extend(out);
    }
    place.write("all.mac", &batch);
    let maxima = Command::new("maxima")
        .current_dir(place.path("."))
        .args(["--very-quiet", "--batch=all.mac"])
        .stdin(Stdio::null())
        .output()
        .expect("maxima starts");
    let said = String::from_utf8_lossy(&maxima.stdout);
    let found: Vec<f64> = said.lines().filter_map(|line| line.trim().strip_prefix("= ")?.trim().parse().ok()).collect();
    assert_eq!(found.len(), expected.len(), "{said}");
    for (found, expected) in found.iter().zip(&expected) {
        assert!((found - expected).abs() < 1e-9 * expected.abs().max(1.0), "{found} instead of {expected}");
    }
}

#[test]
fn latex_compiles() {
    let Some(compiler) = ["tectonic", "pdflatex"].into_iter().find(|program| installed(program)) else { return };
    let place = Place::new();
    for rig in different_rigs() {
        let file = generate(&place, &rig, "latex");
        crate::common::latex::compile(&place, compiler, &file, name(&rig));
    }
}

#[test]
fn latex_is_balanced() {
    let place = Place::new();
    for rig in different_rigs() {
        let text = String::from_utf8(place.read(&generate(&place, &rig, "latex"))).expect("text");
        crate::common::latex::assert_balanced(&text, name(&rig));
    }
}

#[test]
fn derivatives_are_right_and_a_wrong_sign_is_found() {
    let place = Place::new();
    for rig in different_rigs() {
        let check = |more: &[&str]| {
            place.run(["check".as_ref(), rig.as_os_str()].into_iter().chain(more.iter().map(AsRef::as_ref)))
        };
        let right = check(&["--samples", "50"]);
        assert_eq!((right.code, right.stderr.as_str()), (0, ""), "{}", rig.display());
        for flip in ["0", "3", "11", "18446744073709551615"] {
            let wrong = check(&["--samples", "50", "--flip-sign", flip]);
            assert_eq!(wrong.code, 1, "{} with sign {flip} flipped: {}", rig.display(), wrong.stdout);
            assert!(wrong.stderr.contains(name(&rig)) && wrong.stdout.contains("FAILED"), "{}", wrong.stderr);
        }
    }
}

#[test]
fn a_trace_leads_from_the_statement_to_what_is_counted() {
    let place = Place::with_mannequin();
    let trace = place.done("generate m.toml --trace").stdout;
    let sections: Vec<&str> = trace.split("\n\n").skip(1).collect();
    assert!(sections.len() >= 3, "a joint, the chain's gradient and its Jacobian: {trace}");
    for section in sections {
        let counts: Vec<usize> = section
            .lines()
            .skip(1)
            .filter(|line| !line.starts_with("singular where "))
            .map(|line| {
                line.split_whitespace().next().and_then(|n| n.parse().ok()).expect("a line starts with a count")
            })
            .collect();
        assert!(section.lines().nth(1).is_some_and(|line| line.ends_with("as stated")), "{section}");
        assert!(counts.is_sorted_by(|a, b| a > b), "{section}");
    }
    assert!(trace.contains("\n    46  "), "one joint ends at 46: {trace}");
    // A trace is not code, so it takes no language and cannot be stale.
    assert_eq!(place.aim("generate m.toml --trace --lang c").code, 2);
    assert_eq!(place.aim("generate m.toml --trace --check m.toml").code, 2);
    assert_eq!(place.aim("generate m.toml").code, 2);
}

#[test]
fn a_trace_lists_singular_points_where_there_are_conventions_and_none_where_there_are_limits() {
    let place = Place::new();
    let page = include_str!("../../../docs/singularities.md");
    let (limits, conventions) = page.split_once("## Conventions").expect("two tables");
    for (rows, is_singular) in [(limits, false), (conventions, true)] {
        let rows: Vec<&str> =
            rows.lines().filter_map(|line| line.strip_prefix("| `")?.split_once('`')).map(|(row, _)| row).collect();
        assert!(rows.len() > 9, "{rows:?}");
        for expression in rows {
            let file = format!("#[differentiate(wrt(x))]\nfn f(x: f32) -> f32 {{ {expression} }}");
            place.write("f.rs", &file);
            let trace = place.done("generate f.rs --function f --trace").stdout;
            // Singularities of x or 1 − |x| alone: the tangent has its poles elsewhere, and the arcsine's domain ends.
            let found =
                ["x", "0 = x", "|x|", "|[x", "floor"].iter().any(|at| trace.contains(&format!("singular where {at}")));
            assert_eq!(found, is_singular, "{expression}: {trace}");
        }
    }
    let function = "#[differentiate(wrt(v, m, s))]
        fn f(v: DVec3, m: DMat3, s: f64) -> f64 { (m.inverse() * v).x / (s - 1.0) + v.length() / v.length() + v.y / v.length() }";
    place.write("f.rs", function);
    let trace = place.done("generate f.rs --function f --trace").stdout;
    let singular: Vec<&str> = trace.lines().filter_map(|line| line.strip_prefix("singular where ")).collect();
    let expected = [
        "det[[m_0; m_1; m_2], [m_3; m_4; m_5], [m_6; m_7; m_8]] = 0: the inverse is not finite",
        "s − 1 = 0: the quotient is not finite",
        "|v| = 0: one over the length and the length's derivatives count as 0",
    ];
    assert_eq!(singular, expected);
}

#[test]
fn every_cardinal_rig_is_at_the_floor() {
    let is_cardinal = |axis: [f64; 3]| axis.iter().filter(|&&c| c == 0.0).count() == 2;
    let place = Place::new();
    let mut counted = 0;
    for rig in bundled_rigs() {
        let text = std::fs::read_to_string(&rig).expect("a bundled rig can be read");
        let spec = aim_codegen::declare::from_toml(name(&rig), &text).expect("a bundled rig is right");
        let frames = spec.joints.iter().map(|joint| joint.frame).chain([spec.effector.frame]);
        if frames.into_iter().any(|f| ![f.up, f.forward, f.left].into_iter().all(is_cardinal))
            || spec.angles() != 2 * spec.joints.len()
        {
            continue;
        }
        let ran = place.run(["count".as_ref(), rig.as_os_str(), "--json".as_ref()]);
        let counts: serde_json::Value = serde_json::from_str(&ran.stdout).expect("JSON");
        let total = |of: &str| counts[of]["total"].as_u64();
        let joints = spec.joints.len() as u64;
        let of_single = ["aim", "aim_pitch", "aim_heading", "aim_gradient"].map(total);
        assert_eq!(of_single, [27, 37, 42, 46].map(Some), "{}", rig.display());
        assert_eq!(
            total("chain_value_gradient"),
            Some(if joints == 1 { 46 } else { 63 * joints - 16 }),
            "{}",
            rig.display()
        );
        counted += 1;
    }
    assert!(counted >= 5, "{counted} rigs");
}

/// Two springs and a torsion, in single and double precision, one of them in a module.
const FUNCTIONS: &str = "
use aim_runtime::glam::{DVec3, Vec3};

mod single {
    use aim_runtime::glam::Vec3;

    #[aim::differentiate(wrt(tip, rest), hessian)]
    pub fn spring(tip: Vec3, float: Vec3, rest: f32) -> f32 {
        let stretch = (tip - float).length() - rest;
        0.5 * stretch * stretch
    }
}

#[differentiate(wrt(angle))]
fn torsion(angle: f64, r#fn: DVec3) -> DVec3 {
    r#fn * (angle.sin() * (-angle).exp() + angle.atan2(2.0))
}

fn plain(x: f32) -> f32 {
    x
}
";

/// Compares values and derivatives from the compiled C with closed formulas.
#[test]
fn a_function_of_a_file_in_c() {
    let place = Place::new();
    place.write("f.rs", FUNCTIONS);
    place.done("generate f.rs --function spring --lang c -o spring.c");
    place.done("generate f.rs --function spring --lang c --check spring.c");
    place.done("generate f.rs --function torsion --lang c -o torsion.c");
    place.write(
        "main.c",
        "#include <stdio.h>
#include \"spring.c\"
#include \"torsion.c\"
int main(void) {
    const float tip[3] = {1.0f, 2.0f, 3.0f}, anchor[3] = {-1.0f, 2.5f, 1.0f};
    const double axis[3] = {1.0, -2.0, 0.5};
    float first[5], second[15];
    double turned[6];
    spring_gradient(tip, anchor, 2.0f, first);
    spring_hessian(tip, anchor, 2.0f, second);
    torsion_jacobian(0.7, axis, turned);
    for (int i = 0; i < 5; i++) printf(\"%.17g \", first[i]);
    for (int i = 5; i < 15; i++) printf(\"%.17g \", second[i]);
    for (int i = 0; i < 6; i++) printf(\"%.17g \", turned[i]);
    return 0;
}
",
    );
    let compiler = Command::new("cc")
        .current_dir(place.path("."))
        .args(["-std=c99", "-pedantic", "-O2", "-Wall", "-Wextra", "-Werror", "main.c", "-o", "main", "-lm"])
        .output()
        .expect("a C compiler called cc is installed");
    assert!(compiler.status.success(), "{}", String::from_utf8_lossy(&compiler.stderr));
    let ran = Command::new(place.path("main")).output().expect("the program runs");
    let found: Vec<f64> =
        String::from_utf8_lossy(&ran.stdout).split_whitespace().map(|x| x.parse().expect("a number")).collect();

    // With d = tip − anchor, l = |d|, s = l − rest: the gradient is s·d/l and −s. The second derivatives are (s/l)(δ −
    // dᵢdₖ/l²) + dᵢdₖ/l², −d/l and 1.
    let (d, rest) = ([2.0, -0.5, 2.0], 2.0);
    let l = f64::sqrt(d.iter().map(|x| x * x).sum());
    let s = l - rest;
    let mut expected = vec![0.5 * s * s];
    expected.extend(d.map(|x| s * x / l));
    expected.push(-s);
    for i in 0..3 {
        for k in i..3 {
            let square = d[i] * d[k] / (l * l);
            expected.push(s / l * (f64::from(u8::from(i == k)) - square) + square);
        }
        expected.push(-d[i] / l);
    }
    expected.push(1.0);
    let angle = 0.7_f64;
    let value = angle.sin() * (-angle).exp() + angle.atan2(2.0);
    let slope = (angle.cos() - angle.sin()) * (-angle).exp() + 2.0 / (4.0 + angle * angle);
    let axis = [1.0, -2.0, 0.5];
    expected.extend(axis.map(|x| x * value).into_iter().chain(axis.map(|x| x * slope)));
    assert_eq!(found.len(), expected.len());
    for (i, (found, expected)) in found.iter().zip(&expected).enumerate() {
        let most = if i < 15 { 1e-6 } else { 1e-15 };
        assert!((found - expected).abs() <= most * expected.abs().max(1.0), "{i}: {found} and {expected}");
    }
}

/// Two minus signs would be a decrement in C.
#[test]
fn a_negated_constant_is_written_as_one_number() {
    let place = Place::new();
    let f = "(k * v.length()).cos().acos().powi(2).exp_m1().exp()";
    place.write("f.rs", &format!("#[differentiate(wrt(v), hessian)]\nfn f(v: DVec3, k: f64) -> f64 {{\n    {f}\n}}\n"));
    place.done("generate f.rs --function f --lang c -o f.c");
    let written = String::from_utf8(place.read("f.c")).expect("C is text");
    assert!(written.contains("< 1.0 ? -1.0 : 0.0") && !written.contains("--"), "{written}");
}

#[test]
fn functions_that_cannot_be_written() {
    let place = Place::with_mannequin();
    place.write("f.rs", FUNCTIONS);
    place.write("bad.rs", "#[differentiate(wrt(x))]\nfn f(x: f32) -> f32 {\n    x.sine()\n}\n");
    place.write("broken.rs", "fn f( {}");
    for (arguments, words) in [
        ("f.rs --function sprung --lang c", &["f.rs:1:1", "did you mean `spring`?"][..]),
        ("f.rs --function plain --lang c", &["differentiated", "`spring`, `torsion`"]),
        ("f.rs --function torsion --lang wgsl", &["f64", "f32"]),
        ("f.rs --function spring --lang rust", &["#[differentiate]", "--lang c"]),
        ("f.rs --function spring --lang latex", &["--lang c"]),
        ("f.rs --lang c", &["--function"]),
        ("f.rs --trace", &["--function"]),
        ("f.rs --function spring --lang c -o f.rs", &["f.rs", "it is the input"]),
        ("bad.rs --function f --lang c", &["bad.rs:3:7", "`sin`"]),
        ("broken.rs --function f --lang c", &["broken.rs:1:", "valid Rust"]),
        ("gone.rs --function f --lang c", &["gone.rs", "Rust file"]),
    ] {
        place.refused(&format!("generate {arguments}"), words);
    }
    for command in ["explain f.rs -o f.html", "count f.rs", "check f.rs"] {
        place.refused(command, &["f.rs: a Rust file, not a rig", "--function NAME", "--trace"]);
    }
    place.write("out.c", "");
    let stale = place.aim("generate f.rs --function spring --lang c --check out.c");
    let again = "aim generate f.rs --function spring --lang c -o out.c";
    assert!(stale.code == 1 && stale.stderr.contains(again), "{}", stale.stderr);
}
