//! Each rewriting rule alone, and all of them together on random expressions: values stay, derivatives are right.

use fastrand::Rng;

use aim_symbolic::rules::{ROTATIONS, RuleSet, SCALES};
use aim_symbolic::{Angle, Bindings, Graph, Placement, Plane, Program, Rotation, Scalar, Vector};

fn number(random: &mut Rng) -> f64 {
    2.0 * random.f64() - 1.0
}

/// A graph with two points, two matrices and two angles to build expressions from.
struct Material {
    g: Graph,
    points: Vec<Vector>,
    rotations: Vec<Rotation>,
    angles: [Angle; 2],
    given: Vec<f64>,
}

fn material(random: &mut Rng) -> Material {
    let mut g = Graph::new();
    let mut given = Vec::new();
    let mut points = Vec::new();
    for name in ["a", "b", "c"] {
        points.push(g.vector_input(name));
        given.extend([0; 3].map(|_| 3.0 * number(random)));
    }
    let mut rotations = Vec::new();
    for name in ["m", "n"] {
        rotations.push(g.rotation_input(name));
        given.extend(rotation(random));
    }
    let angles = [g.angle("p"), g.angle("h")];
    rotations.push(g.turn(Plane::XZ, angles[0]));
    rotations.push(g.turn(Plane::XY, angles[1]));
    rotations.push(g.basis([[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]]));
    rotations.push(g.basis([[0.6, 0.8, 0.0], [-0.8, 0.6, 0.0], [0.0, 0.0, -1.0]]));
    points.push(g.constant_vector([0.0, 1.0, 0.0]));
    points.push(g.constant_vector([0.0, 0.0, 0.0]));
    Material { g, points, rotations, angles, given }
}

/// The rows of a rotation by a random quaternion.
fn rotation(random: &mut Rng) -> [f64; 9] {
    let [a, b, c, d] = [number(random) + 1.5, number(random), number(random), number(random)];
    let n = a * a + b * b + c * c + d * d;
    [
        (a * a + b * b - c * c - d * d) / n,
        2.0 * (b * c + a * d) / n,
        2.0 * (b * d - a * c) / n,
        2.0 * (b * c - a * d) / n,
        (a * a - b * b + c * c - d * d) / n,
        2.0 * (c * d + a * b) / n,
        2.0 * (b * d + a * c) / n,
        2.0 * (c * d - a * b) / n,
        (a * a - b * b - c * c + d * d) / n,
    ]
}

impl Material {
    fn vector(&mut self, random: &mut Rng, depth: u32) -> Vector {
        if depth == 0 {
            return self.points[random.usize(..self.points.len())];
        }
        match random.u32(..8) {
            0 | 1 => {
                let (v, w) = (self.vector(random, depth - 1), self.vector(random, depth - 1));
                self.g.add_vectors(v, w)
            }
            2 => {
                let (v, w) = (self.vector(random, depth - 1), self.vector(random, depth - 1));
                self.g.sub_vectors(v, w)
            }
            3 => {
                let v = self.vector(random, depth - 1);
                self.g.neg_vector(v)
            }
            4 => {
                let k = self.g.constant(number(random));
                let v = self.vector(random, depth - 1);
                self.g.scale(k, v)
            }
            _ => {
                let rotation = self.rotation(random);
                let v = self.vector(random, depth - 1);
                self.g.rotate(rotation, v)
            }
        }
    }

    fn rotation(&mut self, random: &mut Rng) -> Rotation {
        let pick = |random: &mut Rng| self.rotations[random.usize(..self.rotations.len())];
        let (a, b) = (pick(random), pick(random));
        match random.u32(..4) {
            0 => self.g.transpose(a),
            1 => self.g.compose(a, b),
            _ => a,
        }
    }

    fn scalar(&mut self, random: &mut Rng) -> Scalar {
        let depths = [0; 2].map(|_| random.u32(..5));
        let [v, w] = depths.map(|depth| self.vector(random, depth));
        match random.u32(..3) {
            0 => self.g.dot(v, w),
            1 => {
                let n = self.g.norm(v);
                let d = self.g.dot(v, w);
                self.g.add(n, d)
            }
            _ => {
                let unit = self.g.normalize(v);
                self.g.dot(unit, w)
            }
        }
    }

    fn bindings(&self, random: &mut Rng) -> Bindings {
        Bindings::new(&self.g, &self.given, &[(self.angles[0], number(random)), (self.angles[1], number(random))])
    }
}

fn assert_same(a: f64, b: f64, tolerance: f64, what: &str) {
    assert!((a - b).abs() <= tolerance * a.abs().max(1.0), "{what}: {a} and {b}");
}

/// `NaN` stands nowhere, and neither do the derivatives of a norm at 0.
fn is_regular(material: &Material, scalar: Scalar, bindings: &Bindings) -> bool {
    let at = |steps: f64| {
        let moved = bindings.moved(&material.g, material.angles[0], steps);
        let moved = moved.moved(&material.g, material.angles[1], steps);
        material.g.evaluate(scalar, &moved)
    };
    let (value, bend) = (at(0.0), at(0.05) - 2.0 * at(0.0) + at(-0.05));
    value.is_finite() && bend.abs() < 0.1
}

#[test]
fn every_rule_is_named_once() {
    for rules in [ROTATIONS, SCALES] {
        let mut names: Vec<&str> =
            rules.vectors.iter().map(|(n, _)| *n).chain(rules.scalars.iter().map(|(n, _)| *n)).collect();
        let count = names.len();
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), count, "{names:?}");
    }
}

#[test]
fn each_rule_alone_applies_and_keeps_the_value() {
    for (set, rules) in [("rotations", ROTATIONS), ("scales", SCALES)] {
        for index in 0..rules.vectors.len() + rules.scalars.len() {
            let (name, alone) = match index.checked_sub(rules.vectors.len()) {
                None => {
                    let rule = &rules.vectors[index..=index];
                    (rule[0].0, RuleSet { vectors: rule, scalars: &[], sums: rules.sums })
                }
                Some(index) => {
                    let rule = &rules.scalars[index..=index];
                    (rule[0].0, RuleSet { vectors: &[], scalars: rule, sums: rules.sums })
                }
            };
            let mut applied = 0;
            for seed in 0..600 {
                let mut random = Rng::with_seed(seed);
                let mut material = material(&mut random);
                let stated = material.scalar(&mut random);
                let bindings = material.bindings(&mut random);
                let rewritten = material.g.rewrite_by(&[stated], &alone)[0];
                let (before, after) =
                    (material.g.evaluate(stated, &bindings), material.g.evaluate(rewritten, &bindings));
                // A direction of nothing but rounding is anything; the rest stays to rounding.
                if is_regular(&material, stated, &bindings) {
                    assert_same(before, after, 1e-9, &format!("{set}: {name}, seed {seed}"));
                    applied += usize::from(rewritten != stated);
                }
            }
            assert!(applied > 0, "{set}: {name} never applied");
        }
    }
}

#[test]
fn rewriting_settles() {
    for seed in 0..600 {
        let mut random = Rng::with_seed(seed);
        let mut material = material(&mut random);
        let stated = material.scalar(&mut random);
        let once = material.g.rewrite(stated);
        let twice = material.g.rewrite(once);
        assert_eq!(once, twice, "seed {seed}");
    }
}

#[test]
fn derived_programs_agree_with_central_differences_on_random_expressions() {
    let mut compared = 0;
    for seed in 0..600 {
        let mut random = Rng::with_seed(seed);
        let mut material = material(&mut random);
        let stated = material.scalar(&mut random);
        let bindings = material.bindings(&mut random);
        if !is_regular(&material, stated, &bindings) {
            continue;
        }
        compared += 1;
        let angles = material.angles;
        let program = Program::derive(&mut material.g, &[stated], &angles);
        let mut out = [0.0; 3];
        program.run(bindings.inputs(), &mut out);
        assert_same(material.g.evaluate(stated, &bindings), out[0], 1e-9, &format!("seed {seed}, value"));
        for (angle, derived) in angles.into_iter().zip(&out[1..]) {
            let moved = |step: f64| material.g.evaluate(stated, &bindings.moved(&material.g, angle, step));
            let weighted = |n: f64, weight: f64| weight * (moved(n * 1e-3) - moved(-n * 1e-3));
            let difference = (weighted(1.0, 45.0) + weighted(2.0, -9.0) + weighted(3.0, 1.0)) / 60e-3;
            assert_same(difference, *derived, 1e-6, &format!("seed {seed}, derivative"));
        }
    }
    assert!(compared > 300, "{compared}");
}

#[test]
fn a_gradient_needs_no_rewriting_first() {
    let mut random = Rng::with_seed(1);
    let mut material = material(&mut random);
    let [p, h] = material.angles;
    let composed = material.g.compose(material.rotations[2], material.rotations[3]);
    let turned = material.g.rotate(composed, material.points[0]);
    let dot = material.g.dot(turned, material.points[1]);
    let bindings = material.bindings(&mut random);
    let gradient = material.g.gradient(dot, &[p.into(), h.into()], Placement::Late);
    for (angle, derivative) in [p, h].into_iter().zip(gradient) {
        let moved = |step: f64| material.g.evaluate(dot, &bindings.moved(&material.g, angle, step));
        let difference = (moved(1e-5) - moved(-1e-5)) / 2e-5;
        assert_same(difference, material.g.evaluate(derivative, &bindings), 1e-7, "composed turns");
    }
}

#[test]
fn derivation_is_deterministic() {
    let derive = |seed| {
        let mut random = Rng::with_seed(seed);
        let mut material = material(&mut random);
        let stated = material.scalar(&mut random);
        let angles = material.angles;
        Program::derive(&mut material.g, &[stated], &angles)
    };
    for seed in 0..50 {
        assert_eq!(derive(seed), derive(seed), "seed {seed}");
    }
}
