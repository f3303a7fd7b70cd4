//! LaTeX: the expression as a formula, the program as aligned steps.

use crate::{Graph, Op, Program, Rotation, RotationNode, Scalar, ScalarNode, Value, Vector, VectorNode};

use super::plain::common_name;

/// The program as the body of an `align*` environment.
pub fn program(program: &Program) -> String {
    let name = |v: Value| operand(program, v);
    let mut lines = Vec::new();
    for (number, op) in program.steps() {
        let right = match op {
            Op::Input(_) | Op::Constant(_) | Op::Tiny | Op::Neg(_) => continue,
            Op::Add(a, b) => format!("{} + {}", name(a), name(b)),
            Op::Sub(a, b) => format!("{} - {}", name(a), name(b)),
            Op::Mul(a, b) => format!(r"{} \, {}", name(a), name(b)),
            Op::Div(a, b) => format!(r"\frac{{{}}}{{{}}}", name(a), name(b)),
            Op::Sqrt(a) => format!(r"\sqrt{{{}}}", name(a)),
            Op::SelectLess(a, b, c, d) => format!(
                r"\begin{{cases}} {} & {} < {} \\ {} & \text{{else}} \end{{cases}}",
                name(c),
                name(a),
                name(b),
                name(d)
            ),
        };
        lines.push(format!("v_{{{number}}} &= {right}"));
    }
    let outputs: Vec<String> = program.outputs().iter().map(|&v| name(v)).collect();
    lines.push(format!(r"\text{{result}} &= \left({}\right)", outputs.join(", ")));
    lines.join(" \\\\\n") + "\n"
}

fn operand(program: &Program, v: Value) -> String {
    match program.ops()[v.index()] {
        Op::Input(i) => symbol(&program.inputs()[i as usize]),
        Op::Constant(c) => format!("{}", c.value()),
        Op::Tiny => r"\varepsilon".to_owned(),
        Op::Neg(a) => format!(r"\left(-{}\right)", operand(program, a)),
        _ => format!("v_{{{}}}", program.step_number(v)),
    }
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
        RotationNode::Compose(a, b) => format!("{} {}", rotation(g, a), rotation(g, b)),
        RotationNode::Transpose(a) => format!("{}^{{T}}", rotation(g, a)),
    }
}
