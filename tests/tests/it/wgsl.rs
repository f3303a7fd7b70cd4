//! Emitted WGSL is a valid module on its own, and gives exactly the interpreter's numbers in `f32`: for every bundled
//! rig, every convention, general frames and hinges, at random poses and degenerate targets.

use std::path::Path;

use aim_codegen::emit::{self, Rig};
use aim_codegen::objective::functions;
use aim_codegen::{Differentiated, Kernel, RigSpec, declare, kernels};
use aim_symbolic::{Number, Program};
use aim_tests::kinematics::{Case, Link, V, correct};
use aim_tests::scale::{part_of, sampled};
use aim_tests::wgsl::Module;
use aim_tests::{oracle, rigs};

fn bundled() -> Vec<RigSpec> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../rigs");
    let files = std::fs::read_dir(folder).expect("the bundled rigs have a folder");
    let mut paths: Vec<_> = files.map(|entry| entry.expect("the folder can be listed").path()).collect();
    paths.retain(|path| path.extension().is_some_and(|extension| extension == "toml"));
    paths.sort();
    assert!(paths.len() >= 6, "{} bundled rigs were found", paths.len());
    let read = |path: &std::path::PathBuf| {
        let text = std::fs::read_to_string(path).expect("a rig is readable text");
        declare::from_toml(&path.to_string_lossy(), &text).unwrap_or_else(|errors| panic!("{}", errors.render()))
    };
    paths.iter().map(read).collect()
}

/// A rig's programs, and the module emitted for them.
struct Emitted {
    spec: RigSpec,
    kernels: Vec<Kernel>,
    source: String,
    module: Module,
}

impl Emitted {
    fn of(spec: &RigSpec) -> Self {
        let kernels = kernels(spec);
        let source = emit::wgsl::emit(&Rig { spec, kernels: &kernels });
        Self { spec: spec.clone(), kernels, module: Module::read(&source), source }
    }

    /// Returns every program with its function's name; joints first.
    fn functions(&self) -> impl Iterator<Item = (String, &Program)> {
        functions(&self.kernels).into_iter().map(|function| (function.name(&self.spec), &function.kernel.program))
    }

    /// Runs every function and its program on `case`, asserts that the outputs are equal, and passes them to `judge`.
    fn compare(&self, case: &Case, judge: impl Fn(&str, &[f32])) {
        for (i, (name, program)) in self.functions().enumerate() {
            let alone = |joint: usize| Case {
                links: vec![case.links[joint]],
                target: case.target,
                angles: vec![case.angles[joint]],
            };
            let inputs = if i < self.spec.joints.len() { oracle::flat(&alone(i)) } else { oracle::flat(case) };
            let inputs = oracle::single(&inputs);
            let mut expected = vec![0.0; program.outputs().len()];
            program.run(&inputs, &mut expected);
            let found = self.module.function(&name).run(&inputs);
            assert_eq!(bits(&found), bits(&expected), "{name} of {inputs:?}: {found:?} and {expected:?}");
            judge(&name, &found);
        }
    }
}

fn thug() -> Emitted {
    Emitted::of(bundled().iter().find(|spec| spec.name == "Thug").expect("the thug is bundled"))
}

/// Returns the bits of each number; `None` for NaN, whose bits are unspecified.
fn bits(numbers: &[f32]) -> Vec<Option<u32>> {
    numbers.iter().map(|x| (!x.is_nan()).then(|| x.to_bits())).collect()
}

/// Returns the effector's position in the last joint's space.
fn effector(spec: &RigSpec, case: &Case) -> V {
    let joints = spec.joints.iter().zip(&case.links).zip(&case.angles);
    joints.fold([0.0; 3], |point, ((joint, link), &[pitch, heading])| {
        correct(link.point(point), &joint.frame, pitch, heading)
    })
}

#[test]
fn modules_hold_a_function_a_joint_and_two_for_the_chain() {
    for spec in bundled() {
        let emitted = Emitted::of(&spec);
        let names: Vec<String> = emitted.functions().map(|(name, _)| name).collect();
        assert_eq!(emitted.module.names(), names);
    }
}

#[test]
fn functions_give_the_bits_of_the_interpreter() {
    for (spec, seed) in bundled().into_iter().chain(sampled(rigs::rigs())).zip(2000..) {
        let emitted = Emitted::of(&spec);
        for case in oracle::cases(&spec, seed, part_of(200)) {
            emitted.compare(&case, |name, found| {
                assert!(found.iter().all(|x| x.is_finite()), "{name}: {found:?}");
            });
        }
    }
}

#[test]
fn degenerate_targets_give_the_bits_of_the_interpreter() {
    for (spec, seed) in bundled().into_iter().chain(sampled(rigs::rigs())).zip(3000..) {
        let emitted = Emitted::of(&spec);
        for case in oracle::cases(&spec, seed, 4) {
            let at_origin = |link: &Link| Link { translation: [0.0; 3], ..*link };
            let folded = Case { links: case.links.iter().map(at_origin).collect(), target: [0.0; 3], ..case.clone() };
            emitted.compare(&folded, |name, found| {
                assert!(found.iter().all(|&x| x == 0.0), "{name}, the target on the effector: {found:?}");
            });
            let on_effector = Case { target: effector(&spec, &case), ..case.clone() };
            emitted.compare(&on_effector, |name, found| {
                assert!(found.iter().all(|x| x.is_finite()), "{name}, nearly on the effector: {found:?}");
            });
            // Subnormal, below and above the smallest length that is divided by, and too large to be squared.
            for size in [1e-42, 1e-30, 1e-20, 1e-18, 1e15, 1e30] {
                emitted.compare(&Case { target: case.target.map(|c| size * c), ..folded.clone() }, |_, _| ());
                emitted.compare(&Case { target: case.target.map(|c| size * c), ..case.clone() }, |_, _| ());
            }
            // Mirrored to behind, so that the residual's denominator vanishes.
            let behind = case.target.map(|c| -1e3 * c);
            emitted.compare(&Case { target: behind, ..folded }, |_, _| ());
        }
    }
}

#[test]
fn the_smallest_length_that_is_divided_by_is_that_of_the_interpreter() {
    let thug = thug();
    let program = &thug.kernels[0].program;
    // A neck at rest with an identity link and the target straight ahead: no rounding before the guard.
    let aim = |distance: f32| {
        let identity = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0];
        let inputs: Vec<f32> = identity.into_iter().chain([0.0, distance, 0.0]).chain([0.0, 1.0, 0.0, 1.0]).collect();
        let mut expected = [0.0; 3];
        program.run(&inputs, &mut expected);
        let found = thug.module.function("thug_neck_aim_gradient").run(&inputs);
        assert_eq!(bits(&found), bits(&expected), "at {distance}");
        found[0]
    };
    let tiny: f32 = Number::tiny();
    assert_eq!((aim(tiny), aim(tiny.next_up())), (0.0, 1.0));
}

#[test]
fn names_may_be_words_that_wgsl_reserves() {
    let mut spec = bundled().swap_remove(0);
    "Target".clone_into(&mut spec.name);
    for (joint, name) in spec.joints.iter_mut().zip(["filter", "_mod", "Self_", "ref"]) {
        name.clone_into(&mut joint.name);
    }
    let emitted = Emitted::of(&spec);
    assert_eq!(emitted.module.names()[0], "target_filter_aim_gradient");
}

#[test]
#[should_panic(expected = "reserved keyword")]
fn a_reserved_word_as_a_parameter_would_be_noticed() {
    Module::read("fn f(target: f32) -> f32 { return target; }");
}

#[test]
#[should_panic(expected = "Operation Add can't work")]
fn a_number_without_a_type_would_be_noticed() {
    Module::read("fn f(a: f32) -> f32 { let one = 1; return one + a; }");
}

#[test]
fn a_shader_calls_the_functions_with_what_its_buffers_hold() {
    let module = thug().source;
    Module::read(
        &(module
            + "
            struct Neck { effector_to_joint: array<f32, 12>, target_point: array<f32, 3>, pitch: f32, heading: f32 }
            @group(0) @binding(0) var<storage, read> necks: array<Neck>;
            @group(0) @binding(1) var<storage, read_write> gradients: array<array<f32, 3>>;

            @compute @workgroup_size(64)
            fn main(@builtin(global_invocation_id) id: vec3<u32>) {
                if id.x < arrayLength(&necks) {
                    let neck = necks[id.x];
                    gradients[id.x] = thug_neck_aim_gradient(
                        neck.effector_to_joint, neck.target_point,
                        sin(neck.pitch), cos(neck.pitch), sin(neck.heading), cos(neck.heading),
                    );
                }
            }"),
    );
}

/// A differentiated function in WGSL: a valid module whose results are those of the formulas.
#[test]
fn a_differentiated_function() {
    let source = "
        #[differentiate(wrt(p, target))]
        fn well(p: Vec2, target: Vec2, workgroup: f32) -> f32 {
            let r = (p - target).length();
            if r < workgroup { (-r * r).exp() } else { p.x.sin() * p.y.atan2(2.0) + r.ln() }
        }";
    let derived = Differentiated::from_file("well.rs", source, "well").unwrap_or_else(|errors| panic!("{errors}"));
    let module = Module::read(&emit::wgsl::emit_procedures("A well", &derived.procedures()));
    for [x, y, edge] in [[0.3, -0.4, 1.0], [1.3, 0.4, 0.5], [-2.0, 1.5, 0.25_f64]] {
        let (dx, dy) = (x - 0.1, y - 0.2);
        let r = f64::hypot(dx, dy);
        let (value, by_r, by_x, by_y) = if r < edge {
            ((-r * r).exp(), -2.0 * r * (-r * r).exp(), 0.0, 0.0)
        } else {
            let angle = y.atan2(2.0);
            (x.sin() * angle + r.ln(), 1.0 / r, x.cos() * angle, x.sin() * 2.0 / (4.0 + y * y))
        };
        let along = [by_r * dx / r, by_r * dy / r];
        let expected = [value, along[0] + by_x, along[1] + by_y, -along[0], -along[1]];
        let inputs = oracle::single(&[x, y, 0.1, 0.2, edge]);
        let found = module.function("well_gradient").run(&inputs);
        for (found, expected) in found.iter().zip(expected) {
            assert!((f64::from(*found) - expected).abs() < 1e-5, "{x}, {y}: {found} and {expected}");
        }
        assert_eq!(found.len(), expected.len());
    }
}

#[test]
fn powers_of_any_number() {
    let source = "#[differentiate(wrt(x))]
        fn power(x: f32, n: i32, y: f32) -> f32 { x.powi(n) + y.powf(2.3) }";
    let derived = Differentiated::from_file("power.rs", source, "power").unwrap_or_else(|errors| panic!("{errors}"));
    let module = Module::read(&emit::wgsl::emit_procedures("A power", &derived.procedures()));
    for x in [-2.0, -0.5, 0.0, 0.75, 3.0_f32] {
        for n in if x == 0.0 { 0..5 } else { -3..5 } {
            let found = module.function("power_gradient").run(&[x, n as f32, 1.5]);
            let slope = if n == 0 { 0.0 } else { n as f32 * x.powi(n - 1) };
            for (found, expected) in found.into_iter().zip([x.powi(n) + 1.5_f32.powf(2.3), slope]) {
                assert!((found - expected).abs() < 1e-5 * (1.0 + expected.abs()), "{x}, {n}: {found}, not {expected}");
            }
        }
    }
}
