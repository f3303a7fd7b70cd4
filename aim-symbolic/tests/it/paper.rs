//! The paper's own formulae with its own signs: equations (1) to (6) and the gradient of its appendix.

use std::f64::consts::FRAC_PI_2;

use aim_symbolic::{Bindings, Graph, Plane, Program, Rotation};

/// Rx4, equation (1): +Y towards +Z.
const ABOUT_X: Plane = Plane::YZ;
/// Ry4, equation (2): +Z towards +X.
const ABOUT_Y: Plane = Plane { from: 2, towards: 0 };
/// Rz4, equation (3): +X towards +Y.
const ABOUT_Z: Plane = Plane::XY;

fn rows_of(plane: Plane, radians: f64) -> [[f64; 3]; 3] {
    let mut g = Graph::new();
    let angle = g.angle("x");
    let turn = g.turn(plane, angle);
    g.evaluate_rotation(turn, &Bindings::new(&g, &[], &[(angle, radians)]))
}

#[test]
fn equations_1_to_3_the_row_matrices() {
    for x in [-2.0, -0.3, 0.0, 0.7, FRAC_PI_2, 3.0] {
        let (s, c) = f64::sin_cos(x);
        assert_eq!(rows_of(ABOUT_X, x), [[1.0, 0.0, 0.0], [0.0, c, s], [0.0, -s, c]]);
        assert_eq!(rows_of(ABOUT_Y, x), [[c, 0.0, -s], [0.0, 1.0, 0.0], [s, 0.0, c]]);
        assert_eq!(rows_of(ABOUT_Z, x), [[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]]);
    }
}

/// Reads the cases of `golden/paper.txt`: 15 given numbers, p, h, then aim, ∂aim/∂p, ∂aim/∂h.
fn golden() -> Vec<[f64; 20]> {
    let cases: Vec<[f64; 20]> = include_str!("../golden/paper.txt")
        .lines()
        .map(|line| {
            let numbers: Vec<f64> =
                line.split_whitespace().skip(1).map(|n| n.parse().expect("the golden file holds numbers")).collect();
            numbers.try_into().expect("a golden case has twenty numbers")
        })
        .collect();
    assert_eq!(cases.len(), 40);
    cases
}

/// Returns `Rz4(p) Rx4(h)` for row vectors, so that pitch acts first, with its angles.
fn paper_rotation(g: &mut Graph) -> (Rotation, [aim_symbolic::Angle; 2]) {
    let (p, h) = (g.angle("p"), g.angle("h"));
    let (pitch, heading) = (g.turn(ABOUT_Z, p), g.turn(ABOUT_X, h));
    (g.compose(heading, pitch), [p, h])
}

#[test]
fn equations_4_to_6_and_the_appendix_against_maxima() {
    let mut g = Graph::new();
    let effector_to_joint = g.rigid_input("m");
    let target = g.vector_input("target");
    let (rotation, angles) = paper_rotation(&mut g);
    let rotation = g.about_origin(rotation);
    let to_joint = g.compose_rigid(rotation, effector_to_joint);
    let (origin, tip) = (g.constant_vector([0.0; 3]), g.constant_vector([0.0, 1.0, 0.0]));
    let p0 = g.transform_point(to_joint, origin); // (4)
    let p1 = g.transform_point(to_joint, tip); // (5)
    let to_target = g.sub_vectors(target, p0);
    let direction = g.sub_vectors(p1, p0);
    let to_target = g.normalize(to_target);
    let aim = g.dot(to_target, direction); // (6)
    let program = Program::derive(&g, &[aim], &angles);
    assert_eq!(program.count().total(), 46, "{}", program.count());

    for case in golden() {
        let bindings = Bindings::new(&g, &case[..15], &[(angles[0], case[15]), (angles[1], case[16])]);
        let stated = g.evaluate(aim, &bindings);
        let mut derived = [0.0; 3];
        program.run(bindings.inputs(), &mut derived);
        assert!((stated - case[17]).abs() < 1e-14, "stated {stated}, Maxima {}", case[17]);
        for (derived, golden) in derived.iter().zip(&case[17..]) {
            assert!((derived - golden).abs() < 1e-14, "derived {derived}, Maxima {golden}");
        }
    }
}
