//! Emitted Rust, emitted C and the interpreter against central differences of independent forward kinematics, for
//! every convention, handedness, general frames and hinges.

use std::io::{Read, Write};
use std::process::{Command, Stdio};

use aim::AimRig;
use aim_codegen::{RigPrograms, RigSpec};
use aim_tests::kinematics::{Case, Link};
use aim_tests::random::Random;
use aim_tests::rigs;

#[allow(dead_code, reason = "each test uses the part of the emitted code that it is about")]
mod emitted {
    include!(concat!(env!("OUT_DIR"), "/rigs.rs"));

    /// Calls `f` with rig `number`.
    pub(crate) fn visit<F: super::Visitor>(number: usize, f: &mut F) {
        with_rig!(number, |rig| f.visit(rig));
    }
}

trait Visitor {
    fn visit<R: AimRig>(&mut self, rig: &R);
}

/// Random poses of `spec` whose target is neither at the effector nor behind it, where the residual is steep.
fn cases(spec: &RigSpec, seed: u64, count: usize) -> Vec<Case> {
    let mut random = Random::new(seed);
    let mut cases = Vec::new();
    while cases.len() < count {
        let links =
            spec.joints.iter().map(|_| Link { rows: random.rotation(), translation: random.vector(0.5) }).collect();
        let angles = spec.joints.iter().map(|joint| {
            [joint.pitch, joint.heading].map(|range| if range.is_some() { random.within(1.5) } else { 0.0 })
        });
        let angles = angles.collect();
        let case = Case { links, angles, target: random.vector(3.0) };
        let (distance, angle) = case.view(spec);
        if distance > 0.5 && angle < 2.0 {
            cases.push(case);
        }
    }
    cases
}

/// Which angles `spec` declares, pitch before heading, joint by joint: the joint and 0 or 1.
fn declared(spec: &RigSpec) -> Vec<(usize, usize)> {
    let joints = spec.joints.iter().enumerate();
    joints
        .flat_map(|(i, joint)| [(joint.pitch.is_some(), (i, 0)), (joint.heading.is_some(), (i, 1))])
        .filter_map(|(declared, angle)| declared.then_some(angle))
        .collect()
}

/// The chain's outputs, by central differences: aim and gradient, then residual and Jacobian.
fn expected_chain(spec: &RigSpec, case: &Case) -> (Vec<f64>, Vec<f64>) {
    let aim = |c: &Case| [c.aim(spec)];
    let residual = |c: &Case| c.residual(spec);
    let mut gradient = vec![case.aim(spec)];
    let mut jacobian = case.residual(spec).to_vec();
    let columns: Vec<[f64; 2]> =
        declared(spec).into_iter().map(|(joint, which)| case.difference(joint, which, residual)).collect();
    gradient.extend(declared(spec).into_iter().map(|(joint, which)| case.difference(joint, which, aim)[0]));
    for row in 0..2 {
        jacobian.extend(columns.iter().map(|column| column[row]));
    }
    (gradient, jacobian)
}

/// One joint alone: the rig cut down to that joint, its link as the effector's way to it.
fn joint_alone(spec: &RigSpec, case: &Case, joint: usize) -> (RigSpec, Case) {
    let mut alone = spec.clone();
    alone.joints = vec![spec.joints[joint].clone()];
    let case = Case { links: vec![case.links[joint]], target: case.target, angles: vec![case.angles[joint]] };
    (alone, case)
}

fn expected_joint(spec: &RigSpec, case: &Case, joint: usize) -> Option<[f64; 3]> {
    let (alone, case) = joint_alone(spec, case, joint);
    if case.view(&alone).0 < 0.5 {
        return None;
    }
    let mut expected = [case.aim(&alone), 0.0, 0.0];
    for (_, which) in declared(&alone) {
        expected[1 + which] = case.difference(0, which, |c| [c.aim(&alone)])[0];
    }
    Some(expected)
}

fn assert_close(found: &[f64], expected: &[f64], tolerance: f64, what: &str) {
    assert_eq!(found.len(), expected.len(), "{what}");
    for (i, (found, expected)) in found.iter().zip(expected).enumerate() {
        let scale = expected.abs().max(1.0);
        assert!((found - expected).abs() <= tolerance * scale, "{what}, output {i}: {found}, expected {expected}");
    }
}

#[expect(clippy::cast_possible_truncation, reason = "the kernels run in f32 too")]
fn single(numbers: &[f64]) -> Vec<f32> {
    numbers.iter().map(|&x| x as f32).collect()
}

fn doubled(numbers: &[f32]) -> Vec<f64> {
    numbers.iter().map(|&x| x.into()).collect()
}

/// The inputs of the chain's functions as the interpreter takes them.
fn flat(case: &Case) -> Vec<f64> {
    let mut flat: Vec<f64> = case.links.iter().flat_map(Link::numbers).collect();
    flat.extend(case.target);
    flat.extend(case.sin_cos().into_iter().flatten());
    flat
}

struct Compare<'a> {
    spec: &'a RigSpec,
    cases: &'a [Case],
}

impl Visitor for Compare<'_> {
    fn visit<R: AimRig>(&mut self, rig: &R) {
        let (spec, name) = (self.spec, &self.spec.name);
        let programs = RigPrograms::derive(spec);
        let angles = spec.angles();
        for case in self.cases {
            let (gradient, jacobian) = expected_chain(spec, case);
            let links: Vec<[f64; 12]> = case.links.iter().map(Link::numbers).collect();
            let sin_cos = case.sin_cos();
            let (mut found, mut found_jacobian) = (vec![0.0; 1 + angles], vec![0.0; 2 + 2 * angles]);
            rig.chain_value_gradient(&links, &case.target, &sin_cos, &mut found);
            rig.chain_residual_jacobian(&links, &case.target, &sin_cos, &mut found_jacobian);
            assert_close(&found, &gradient, 1e-9, &format!("{name}, f64 gradient"));
            assert_close(&found_jacobian, &jacobian, 1e-8, &format!("{name}, f64 Jacobian"));

            let flat = flat(case);
            let mut interpreted = vec![0.0; 1 + angles];
            programs.chain_value_gradient.run(&flat, &mut interpreted);
            assert_eq!(found.iter().map(|x| x.to_bits()).collect::<Vec<_>>(), bits(&interpreted), "{name}");
            let mut interpreted = vec![0.0; 2 + 2 * angles];
            programs.chain_residual_jacobian.run(&flat, &mut interpreted);
            assert_eq!(bits(&found_jacobian), bits(&interpreted), "{name}");

            self.compare_single(rig, case, &gradient, &programs);
            for joint in 0..spec.joints.len() {
                if let Some(expected) = expected_joint(spec, case, joint) {
                    let found = rig.aim_gradient(joint, &links[joint], &case.target, &sin_cos[joint]);
                    assert_close(&found, &expected, 1e-9, &format!("{name}, joint {joint}"));
                }
            }
        }
    }
}

fn bits(numbers: &[f64]) -> Vec<u64> {
    numbers.iter().map(|x| x.to_bits()).collect()
}

impl Compare<'_> {
    fn compare_single<R: AimRig>(&self, rig: &R, case: &Case, gradient: &[f64], programs: &RigPrograms) {
        let name = &self.spec.name;
        let links: Vec<[f32; 12]> =
            case.links.iter().map(|l| single(&l.numbers()).try_into().expect("twelve stay twelve")).collect();
        let target: [f32; 3] = single(&case.target).try_into().expect("three stay three");
        let sin_cos: Vec<[f32; 4]> =
            case.sin_cos().iter().map(|s| single(s).try_into().expect("four stay four")).collect();
        let mut found = vec![0.0_f32; gradient.len()];
        rig.chain_value_gradient(&links, &target, &sin_cos, &mut found);
        assert_close(&doubled(&found), gradient, 2e-5, &format!("{name}, f32 gradient"));
        let mut interpreted = vec![0.0_f32; gradient.len()];
        programs.chain_value_gradient.run(&single(&flat(case)), &mut interpreted);
        let bits = |numbers: &[f32]| numbers.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
        assert_eq!(bits(&found), bits(&interpreted), "{name}");
    }
}

#[test]
fn emitted_rust_and_the_interpreter_agree_with_central_differences() {
    for (number, spec) in rigs::rigs().iter().enumerate() {
        let cases = cases(spec, number as u64, 60);
        emitted::visit(number, &mut Compare { spec, cases: &cases });
    }
}

#[test]
fn degenerate_targets_give_finite_zeros() {
    struct Degenerate;
    impl Visitor for Degenerate {
        fn visit<R: AimRig>(&mut self, rig: &R) {
            let mut link = [0.0_f32; 12];
            (link[0], link[4], link[8]) = (1.0, 1.0, 1.0);
            (link[9], link[10], link[11]) = (0.3, -0.2, 0.1);
            let rest = [0.0, 1.0, 0.0, 1.0];
            let on_effector = rig.aim_gradient(0, &link, &[0.3, -0.2, 0.1], &rest);
            assert_eq!(on_effector, [0.0; 3]);
            let far = rig.aim_gradient(0, &link, &[1e20, -1e20, 1e20], &rest);
            assert!(far.iter().all(|x| x.is_finite()), "{far:?}");
            (link[9], link[10], link[11]) = (0.0, 0.0, 0.0);
            for tiny in [0.0, 1e-45, -1e-40, 1e-20] {
                let near = rig.aim_gradient(0, &link, &[tiny, tiny, -tiny], &rest);
                assert!(near.iter().all(|x| x.is_finite() && x.abs() <= 2.0), "{tiny}: {near:?}");
            }
            assert_eq!(rig.aim_gradient(99, &link, &[1.0, 0.0, 0.0], &rest), [0.0; 3]);
            let mut wrong_length = [1.0_f32; 1];
            rig.chain_value_gradient(&[], &[1.0, 0.0, 0.0], &[], &mut wrong_length);
            assert_eq!(wrong_length, [0.0]);
        }
    }
    for number in 0..rigs::rigs().len() {
        emitted::visit(number, &mut Degenerate);
    }
}

/// A C program that reads the inputs of every rig's chain and joint functions and writes their outputs.
fn c_harness(specs: &[RigSpec]) -> String {
    let mut main = String::from(
        "#include <stdio.h>\nstatic float in[4096], out[4096];\n\
         static int get(int n) { return fread(in, 4, n, stdin) == (size_t)n; }\n\
         static void put(int n) { fwrite(out, 4, n, stdout); }\nint main(void) {\n",
    );
    for spec in specs {
        let (name, n, angles) = (aim_codegen::snake_case(&spec.name), spec.joints.len(), spec.angles());
        let (target, sin_cos, inputs) = (12 * n, 12 * n + 3, 16 * n + 3);
        main += &format!("  for (int i = 0; i < {C_CASES}; i++) {{ if (!get({inputs})) return 1;\n");
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

const C_CASES: usize = 40;

#[test]
fn emitted_c_compiles_without_warnings_and_agrees_with_central_differences() {
    let specs = rigs::rigs();
    let folder = tempfile::tempdir().expect("a temporary folder can be made");
    let (source, program) = (folder.path().join("rigs.c"), folder.path().join("rigs"));
    let code = include_str!(concat!(env!("OUT_DIR"), "/rigs.c")).to_owned() + &c_harness(&specs);
    std::fs::write(&source, code).expect("the temporary folder is writable");
    let compiler = Command::new("cc")
        .args(["-std=c99", "-O2", "-Wall", "-Wextra", "-Werror", "-o"])
        .args([&program, &source])
        .arg("-lm")
        .output()
        .expect("a C compiler named cc is installed");
    assert!(compiler.status.success(), "{}", String::from_utf8_lossy(&compiler.stderr));

    let all_cases: Vec<Vec<Case>> =
        specs.iter().enumerate().map(|(i, spec)| cases(spec, 1000 + i as u64, C_CASES)).collect();
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
    for (spec, cases) in specs.iter().zip(&all_cases) {
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
