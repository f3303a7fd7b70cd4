//! LaTeX: the expression as a formula, the program as aligned steps.

use super::plain::common_name;
use super::source::{Dialect, steps};
use crate::{Function, Graph, Program, Rotation, RotationNode, Scalar, ScalarNode, Vector, VectorNode};

/// The program as the body of an `align*` environment.
pub fn program(program: &Program) -> String {
    let (steps, outputs) = steps(program, &Latex { inputs: program.inputs() });
    let mut lines: Vec<String> = steps.iter().map(|(name, right)| format!("{name} &= {right}")).collect();
    lines.push(format!(r"\text{{result}} &= \left({}\right)", outputs.join(", ")));
    lines.join(" \\\\\n") + "\n"
}

struct Latex<'a> {
    inputs: &'a [String],
}

impl Dialect for Latex<'_> {
    fn input(&self, index: usize) -> String {
        symbol(&self.inputs[index])
    }

    fn constant(&self, value: f64) -> String {
        format!("{value}")
    }

    fn tiny(&self) -> String {
        r"\varepsilon".to_owned()
    }

    fn sqrt(&self, a: &str) -> String {
        format!(r"\sqrt{{{a}}}")
    }

    fn select_less(&self, a: &str, b: &str, then: &str, otherwise: &str) -> String {
        format!(r"\begin{{cases}} {then} & {a} < {b} \\ {otherwise} & \text{{else}} \end{{cases}}")
    }

    fn call(&self, function: Function, a: &str) -> String {
        called(function, a)
    }

    fn atan2(&self, y: &str, x: &str) -> String {
        format!(r"\operatorname{{atan2}}\left({y}, {x}\right)")
    }

    fn mul(&self, a: &str, b: &str) -> String {
        format!(r"{a} \, {b}")
    }

    fn div(&self, a: &str, b: &str) -> String {
        format!(r"\frac{{{a}}}{{{b}}}")
    }

    fn neg(&self, a: &str) -> String {
        format!(r"\left(-{a}\right)")
    }

    fn group(&self, a: &str) -> String {
        format!(r"\left({a}\right)")
    }

    fn step(&self, number: usize) -> String {
        format!("v_{{{number}}}")
    }
}

fn called(function: Function, a: &str) -> String {
    let name = match function {
        Function::Asin => "arcsin",
        Function::Acos => "arccos",
        other => other.name(),
    };
    format!(r"\{name}\left({a}\right)")
}

/// An input's name as a symbol: `sin_p` is a sine, `m_01` has subscripts, greek letters stay words.
fn symbol(name: &str) -> String {
    for (prefix, function) in [("sin_", r"\sin "), ("cos_", r"\cos ")] {
        if let Some(angle) = name.strip_prefix(prefix) {
            return format!("{function}{}", symbol(angle));
        }
    }
    match name.split_once('_') {
        Some((stem, subscript)) => {
            format!("{}_{{{}}}", upright(stem), subscript.replace('_', r"\,"))
        }
        None => upright(name),
    }
}

fn upright(stem: &str) -> String {
    if stem.chars().count() == 1 { stem.to_owned() } else { format!(r"\mathrm{{{stem}}}") }
}

/// The expression as a formula.
pub fn scalar(g: &Graph, expression: Scalar) -> String {
    let s = |e| scalar(g, e);
    let v = |e| vector(g, e);
    match g.scalar_node(expression) {
        ScalarNode::Constant(c) => format!("{}", c.value()),
        ScalarNode::Input(i) => symbol(&g.inputs()[i as usize].0),
        ScalarNode::Tiny => r"\varepsilon".to_owned(),
        ScalarNode::Add(a, b) => format!(r"\left({} + {}\right)", s(a), s(b)),
        ScalarNode::Sub(a, b) => format!(r"\left({} - {}\right)", s(a), s(b)),
        ScalarNode::Mul(a, b) => format!(r"{} \, {}", s(a), s(b)),
        ScalarNode::Div(a, b) => format!(r"\frac{{{}}}{{{}}}", s(a), s(b)),
        ScalarNode::Neg(a) => format!("-{}", s(a)),
        ScalarNode::Sqrt(a) => format!(r"\sqrt{{{}}}", s(a)),
        ScalarNode::Reciprocal(a) => format!(r"\frac{{1}}{{{}}}", s(a)),
        ScalarNode::SelectLess(a, b, c, d) => {
            format!(r"\begin{{cases}} {} & {} < {} \\ {} & \text{{else}} \end{{cases}}", s(c), s(a), s(b), s(d))
        }
        ScalarNode::Call(function, a) => called(function, &s(a)),
        ScalarNode::Atan2(a, b) => format!(r"\operatorname{{atan2}}\left({}, {}\right)", s(a), s(b)),
        ScalarNode::Dot(a, b) => format!(r"{} \cdot {}", v(a), v(b)),
        ScalarNode::Norm(a) => format!(r"\left|{}\right|", v(a)),
        ScalarNode::Component(a, axis) => format!("{}_{{{}}}", v(a), ["x", "y", "z"][usize::from(axis)]),
    }
}

fn vector(g: &Graph, expression: Vector) -> String {
    let v = |e| vector(g, e);
    match g.vector_node(expression) {
        VectorNode::Components(c) => match common_name(g, c) {
            Some(name) => format!(r"\vec{{{}}}", symbol(&name)),
            None => format!(r"\begin{{pmatrix}} {} \end{{pmatrix}}", c.map(|c| scalar(g, c)).join(r" \\ ")),
        },
        VectorNode::Add(a, b) => format!(r"\left({} + {}\right)", v(a), v(b)),
        VectorNode::Sub(a, b) => format!(r"\left({} - {}\right)", v(a), v(b)),
        VectorNode::Neg(a) => format!("-{}", v(a)),
        VectorNode::Scale(k, a) => format!(r"{} \, {}", scalar(g, k), v(a)),
        VectorNode::Rotate(r, a) => format!("{} {}", rotation(g, r), v(a)),
        VectorNode::Normalize(a) => format!(r"\frac{{{0}}}{{\left|{0}\right|}}", v(a)),
        VectorNode::Perp(_, a) => format!(r"{}^{{\perp}}", v(a)),
        VectorNode::Cross(a, b) => format!(r"{} \times {}", v(a), v(b)),
        VectorNode::Across(a, u) => format!(r"\left(1 - {0} {0}^{{T}}\right) {1}", v(u.into()), v(a)),
    }
}

fn rotation(g: &Graph, expression: Rotation) -> String {
    match g.rotation_node(expression) {
        RotationNode::Matrix(entries) => {
            let first = match g.scalar_node(entries[0]) {
                ScalarNode::Input(i) => g.inputs()[i as usize].0.strip_suffix("_00").map(symbol),
                _ => None,
            };
            first.unwrap_or_else(|| "M".to_owned())
        }
        RotationNode::Basis(_) => "B".to_owned(),
        RotationNode::Turn(_, angle) => format!(r"R_{{{}}}", symbol(g.angle_name(angle))),
        RotationNode::About(axis, angle) => {
            format!(r"R_{{{}}}\left({}\right)", vector(g, axis), symbol(g.angle_name(angle)))
        }
        RotationNode::Quaternion(v, w) => format!(r"Q_{{{}, {}}}", vector(g, v), scalar(g, w)),
        RotationNode::Compose(a, b) => format!("{} {}", rotation(g, a), rotation(g, b)),
        RotationNode::Transpose(a) => format!("{}^{{T}}", rotation(g, a)),
    }
}
