//! Emitted C: compiled without warnings, run in a separate process, and its operations counted.

use std::io::{Read, Write};
use std::process::{Command, Stdio};

use aim_codegen::emit::{self, Rig};
use aim_codegen::{RigSpec, kernels};
use aim_symbolic::Count;

use crate::kinematics::Case;
use crate::oracle::{assert_close, expected_chain, expected_joint, flat, single};

/// Returns a C program that reads the inputs of every rig's chain and joint functions and writes their outputs.
fn harness(specs: &[RigSpec], cases: usize) -> String {
    let mut main = String::from(
        "#include <stdio.h>\nstatic float in[4096], out[4096];\n\
         static int get(int n) { return fread(in, 4, n, stdin) == (size_t)n; }\n\
         static void put(int n) { fwrite(out, 4, n, stdout); }\nint main(void) {\n",
    );
    for spec in specs {
        let (name, n, angles) = (aim_codegen::snake_case(&spec.name), spec.joints.len(), spec.angles());
        let (target, sin_cos, inputs) = (12 * n, 12 * n + 3, 16 * n + 3);
        main += &format!("  for (int i = 0; i < {cases}; i++) {{ if (!get({inputs})) return 1;\n");
        main +=
            &format!("    {name}_chain_value_gradient(in, in + {target}, in + {sin_cos}, out); put({});\n", 1 + angles);
        main += &format!(
            "    {name}_chain_residual_jacobian(in, in + {target}, in + {sin_cos}, out); put({});\n",
            2 + 2 * angles
        );
        for (i, joint) in spec.joints.iter().enumerate() {
            let s = sin_cos + 4 * i;
            main += &format!(
                "    {name}_{}_aim_gradient(in + {}, in + {target}, in[{s}], in[{}], in[{}], in[{}], out); put(3);\n",
                joint.name,
                12 * i,
                s + 1,
                s + 2,
                s + 3
            );
        }
        main += "  }\n";
    }
    main + "  return 0;\n}\n"
}

/// Compares the emitted C of `specs` with the oracle; every rig has the same number of cases.
///
/// # Panics
/// Panics if the C does not compile without warnings, or differs by more than 2e-4.
pub fn compare(specs: &[RigSpec], all_cases: &[Vec<Case>]) {
    let folder = tempfile::tempdir().expect("a temporary folder can be made");
    let (source, program) = (folder.path().join("rigs.c"), folder.path().join("rigs"));
    let code: String = specs
        .iter()
        .map(|spec| emit::c::emit(&Rig { spec, kernels: &kernels(spec) }))
        .chain([harness(specs, all_cases[0].len())])
        .collect();
    std::fs::write(&source, code).expect("the temporary folder is writable");
    let compiler = Command::new("cc")
        .args(["-std=c99", "-O2", "-Wall", "-Wextra", "-Werror", "-o"])
        .args([&program, &source])
        .arg("-lm")
        .output()
        .expect("a C compiler named cc is installed");
    assert!(compiler.status.success(), "{}", String::from_utf8_lossy(&compiler.stderr));

    let input: Vec<u8> =
        all_cases.iter().flatten().flat_map(|case| single(&flat(case))).flat_map(f32::to_le_bytes).collect();
    let mut child = Command::new(&program)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .expect("the compiled program starts");
    let mut stdin = child.stdin.take().expect("stdin is piped");
    let writer = std::thread::spawn(move || stdin.write_all(&input));
    let mut output = Vec::new();
    child.stdout.take().expect("stdout is piped").read_to_end(&mut output).expect("its output can be read");
    writer.join().expect("the writer does not panic").expect("its input can be written");
    assert!(child.wait().expect("it ends").success(), "the compiled program failed");

    let mut numbers = output.chunks_exact(4).map(|b| f64::from(f32::from_le_bytes([b[0], b[1], b[2], b[3]])));
    let mut take = |n: usize| numbers.by_ref().take(n).collect::<Vec<f64>>();
    for (spec, cases) in specs.iter().zip(all_cases) {
        for case in cases {
            let (gradient, jacobian) = expected_chain(spec, case);
            assert_close(&take(gradient.len()), &gradient, 2e-4, &format!("{}, C gradient", spec.name));
            assert_close(&take(jacobian.len()), &jacobian, 2e-4, &format!("{}, C Jacobian", spec.name));
            for joint in 0..spec.joints.len() {
                let found = take(3);
                if let Some(expected) = expected_joint(spec, case, joint) {
                    assert_close(&found, &expected, 2e-4, &format!("{}, C joint {joint}", spec.name));
                }
            }
        }
    }
    assert_eq!(numbers.next(), None, "the compiled program wrote more than expected");
}

/// Returns a function of emitted C: the comment before it, and its body.
///
/// # Panics
/// Panics if there is no such function.
pub fn function<'c>(source: &'c str, name: &str) -> (&'c str, &'c str) {
    let start = source.find(&format!("void {name}(")).unwrap_or_else(|| panic!("there is no function {name}"));
    let comment = source[..start].rfind("/*").unwrap_or_else(|| panic!("{name} has no header"));
    let body = start + source[start..].find("\n{\n").unwrap_or_else(|| panic!("{name} has no body"));
    let end = body + source[body..].find("\n}\n").unwrap_or_else(|| panic!("{name} has no end"));
    (&source[comment..start], &source[body + 3..end])
}

/// Splits a line into tokens: words, numbers with their exponents, and single characters.
fn tokens(line: &str) -> Vec<&str> {
    let mut tokens = Vec::new();
    let mut rest = line.trim_start();
    while let Some(first) = rest.chars().next() {
        let word = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '.';
        let mut length = rest.find(|c| !word(c)).unwrap_or(rest.len()).max(first.len_utf8());
        // `1.5e-3f`: the sign belongs to the number.
        if first.is_ascii_digit() && rest[..length].ends_with('e') {
            length += 1;
            length += rest[length..].find(|c| !word(c)).unwrap_or(rest.len() - length);
        }
        tokens.push(&rest[..length]);
        rest = rest[length..].trim_start();
    }
    tokens
}

/// Counts the operations of a function body of emitted C, from its text.
///
/// # Panics
/// Panics if the body is not straight-line code.
pub fn count(body: &str) -> Count {
    let mut count = Count::default();
    for line in body.lines().map(tokens) {
        for (i, &token) in line.iter().enumerate() {
            // An operator after a name, a number or a closing bracket is infix; otherwise it is a sign.
            let infix = i > 0 && line[i - 1].ends_with(|c: char| c.is_ascii_alphanumeric() || "_.)]".contains(c));
            match token {
                "+" | "-" if infix => count.add += 1,
                "*" if infix => count.mul += 1,
                "/" if infix => count.div += 1,
                "sqrtf" | "sqrt" => count.sqrt += 1,
                "<" | "?" => count.select += 1,
                "-" | ":" | "=" | ";" | "," | "(" | ")" | "[" | "]" => {}
                _ if ["if", "for", "while", "switch", "goto", "do"].contains(&token) || token.contains("pow") => {
                    panic!("a kernel is a straight line, without {token}")
                }
                _ if token.starts_with(|c: char| c.is_ascii_alphanumeric()) => {
                    count.call += usize::from(line.get(i + 1) == Some(&"("));
                }
                _ => panic!("no token of a kernel: {token}"),
            }
        }
    }
    count
}
