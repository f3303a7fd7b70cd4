//! Objectives of other fields, as written in `tests/objectives/tests/it/by_hand.rs`: the derived programs compared with
//! derivations by hand. `AIM_BLESS=1 cargo test -p aim-tests --test it elsewhere` writes the table.

use aim_codegen::{Differentiated, emit};
use aim_symbolic::Number;
use aim_tests::by_hand::counted::{Counted, count};
use aim_tests::by_hand::elsewhere as by_hand;
use aim_tests::c;
use aim_tests::oracle::assert_close;
use aim_tests::page::hold_table;
use aim_tests::random::Random;

const FILE: &str = "../../../objectives/tests/it/by_hand.rs";
const STATED: &str = include_str!("../../objectives/tests/it/by_hand.rs");
const TABLE: [&str; 2] = ["<!-- derived -->\n", "<!-- /derived -->\n"];

/// A problem, its derivation by hand in two number types, and the indices of a rotation and of a quaternion of length 1
/// among its inputs.
struct Problem {
    name: &'static str,
    title: &'static str,
    run: fn(&[f64]) -> Vec<f64>,
    counted: fn(&[Counted]) -> Vec<Counted>,
    rotation: Option<usize>,
    quaternion: Option<usize>,
}

macro_rules! problems {
    ($($name:ident $title:literal by $by_hand:ident $(eye at $rotation:literal)? $(quaternion at $quaternion:literal)?;)*) => {
        [$(Problem {
            name: stringify!($name),
            title: $title,
            run: by_hand::$by_hand,
            counted: by_hand::$by_hand,
            rotation: [$($rotation)?].first().copied(),
            quaternion: [$($quaternion)?].first().copied(),
        },)*]
    };
}

fn problems() -> impl Iterator<Item = Problem> {
    problems! {
        bundle_adjustment "bundle adjustment (9 + 3 parameters)" by bundle_adjustment;
        point_to_plane "point-to-plane registration, rotation vector" by point_to_plane;
        rigid_edge "as-rigid-as-possible edge with a quaternion" by rigid_edge;
        damped_spring "damped spring force, Jacobian" by damped_spring;
        torsion "dihedral torsion energy" by torsion;
        gaussian "Gaussian negative log-likelihood, 3×3 inverse" by gaussian;
        cone_barrier "cone barrier" by cone_barrier;
        bearing_and_range "bearing and range" by bearing_and_range;
        robust_registration "robust registration, any quaternion" by robust_registration;
        odometry "odometry in the plane" by odometry;
        line_distance "distance from a line" by line_distance;
        gyroscopic "gyroscopic acceleration, Jacobian" by gyroscopic quaternion at 0;
        tetrahedron "Saint Venant–Kirchhoff energy of a tetrahedron" by tetrahedron;
        curve_length "length of a Bézier curve in eight steps" by curve_length;
        aim_by_quaternion "aim, joint turned by a quaternion" by aim_by_quaternion eye at 4;
        aim_by_rotation_vector "aim, joint turned by a rotation vector" by aim_by_rotation_vector eye at 3;
        aim_with_telescope "aim with a telescope" by aim_with_telescope eye at 3;
        chord_of_aim "chord of the aim, squared" by chord_of_aim eye at 2;
        sine_of_aim "sine of the aim" by sine_of_aim eye at 2;
        aim_in_components "aim, turns written in components" by aim_in_components eye at 2;
        aim_in_columns "aim, turns written as columns" by aim_in_components eye at 2;
    }
    .into_iter()
}

/// Compares the derived program with the derivation by hand at random inputs, and returns the operation counts of both:
/// of the emitted C, without series, and by hand.
fn compared(problem: &Problem, random: &mut Random) -> [usize; 2] {
    let Problem { name, rotation, quaternion, .. } = *problem;
    let derived = Differentiated::from_file(FILE, STATED, name).expect("the file is compiled, too");
    let procedures = derived.procedures();
    let [procedure] = procedures.as_slice() else { panic!("{name} has no companions but the first") };
    let program = procedure.program;
    let source = emit::c::emit_procedures(name, &procedures);
    let (_, body) = c::function(&source, &procedure.name);
    let count_of_text = c::count(body).total() - program.count().series;
    assert_eq!(count_of_text, program.count().total(), "{name}");

    let mut inputs = vec![0.0; program.inputs().len()];
    let mut judged = 0;
    while judged < 200 {
        inputs.iter_mut().for_each(|x| *x = random.within(2.0));
        if let Some(place) = rotation {
            inputs[place..place + 9].copy_from_slice(random.rotation().as_flattened());
        }
        if let Some(place) = quaternion {
            let length = inputs[place..place + 4].iter().map(|c| c * c).sum::<f64>().sqrt();
            inputs[place..place + 4].iter_mut().for_each(|c| *c /= length);
        }
        let by_hand = (problem.run)(&inputs);
        let mut found = vec![0.0; by_hand.len()];
        program.run(&inputs, &mut found);
        // Skip points outside a logarithm's domain, and large values, whose differences lose digits.
        if by_hand.iter().chain(&found).any(|x| !x.is_finite() || x.abs() > 1e3) {
            continue;
        }
        judged += 1;
        assert_close(&found, &by_hand, 1e-9, name);
    }
    let numbers: Vec<Counted> = inputs.iter().map(|&x| Counted::constant(x)).collect();
    [count_of_text, count(|| (problem.counted)(&numbers)).total()]
}

#[test]
fn derived_programs_are_nearly_as_small_as_those_by_hand() {
    let random = &mut Random::new(21);
    let mut table = String::from("| value and first derivatives | derived | by hand |\n|---|---|---|\n");
    for problem in problems() {
        let [derived, by_hand] = compared(&problem, random);
        table += &format!("| {} | {derived} | {by_hand} |\n", problem.title);
        println!("{}: {derived}, by hand {by_hand}", problem.title);
        assert!(20 * derived <= 23 * by_hand, "{}: {derived} against {by_hand}", problem.title);
    }
    hold_table("docs/operation-counts.md", TABLE, &table, "elsewhere");
}
