//! Programs and expressions as plain text, for failure messages.

use aim_symbolic::print::{self, Dialect, Notation, steps};
use aim_symbolic::{
    Attitude, Graph, Op, Program, Rotation, RotationNode, Scalar, ScalarNode, Stumpff, Vector, VectorNode,
};

const AXES: [&str; 3] = ["x", "y", "z"];

/// Formats a program with one operation per line.
pub(crate) fn program(program: &Program) -> String {
    let (steps, outputs) = steps(program, &Plain { inputs: program.inputs() });
    let steps: String = steps.iter().map(|(name, right)| format!("{name} = {right}\n")).collect();
    format!("{steps}result {}\n", outputs.join(", "))
}

struct Plain<'a> {
    inputs: &'a [String],
}

impl Dialect for Plain<'_> {
    fn input(&self, index: usize) -> String {
        self.inputs[index].clone()
    }

    fn constant(&self, value: f64) -> String {
        format!("{value}")
    }

    fn tiny(&self) -> String {
        "tiny".to_owned()
    }

    fn sqrt(&self, a: &str) -> String {
        format!("sqrt({a})")
    }

    fn select_less(&self, a: &str, b: &str, then: &str, otherwise: &str) -> String {
        format!("{a} < {b} ? {then} : {otherwise}")
    }

    fn neg(&self, a: &str) -> String {
        format!("(-{a})")
    }
}

/// Formats a scalar expression.
pub(crate) fn scalar(g: &Graph, expression: Scalar) -> String {
    let s = |e| scalar(g, e);
    let v = |e| vector(g, e);
    match g.scalar_node(expression) {
        ScalarNode::Op(Op::Constant(c)) => format!("{}", c.value()),
        ScalarNode::Op(Op::Input(i)) => g.inputs()[i as usize].0.clone(),
        ScalarNode::Op(Op::Tiny) => "tiny".to_owned(),
        ScalarNode::Op(Op::Add(a, b)) => format!("({} + {})", s(a), s(b)),
        ScalarNode::Op(Op::Sub(a, b)) => format!("({} - {})", s(a), s(b)),
        ScalarNode::Op(Op::Mul(a, b)) => format!("{}*{}", s(a), s(b)),
        ScalarNode::Op(Op::Div(a, b)) => format!("({} / {})", s(a), s(b)),
        ScalarNode::Op(Op::Neg(a)) => format!("-{}", s(a)),
        ScalarNode::Op(Op::Sqrt(a)) => format!("sqrt({})", s(a)),
        ScalarNode::Step(component) => format!("step{component}"),
        ScalarNode::Stumpff(Stumpff { hyperbolic, order }, a) => {
            format!("{}{order}({})", if hyperbolic { "h" } else { "c" }, s(a))
        }
        ScalarNode::Arc(order, a, w) => format!("a{order}({}, {})", s(a), s(w)),
        ScalarNode::Reciprocal(a) => format!("reciprocal({})", s(a)),
        ScalarNode::Op(Op::SelectLess(a, b, c, d)) => format!("({} < {} ? {} : {})", s(a), s(b), s(c), s(d)),
        ScalarNode::Op(Op::Call(function, a)) => format!("{}({})", function.name(), s(a)),
        ScalarNode::Op(Op::Pow(a, b)) => format!("pow({}, {})", s(a), s(b)),
        ScalarNode::Op(Op::Atan2(a, b)) => format!("atan2({}, {})", s(a), s(b)),
        ScalarNode::Dot(a, b) => format!("dot({}, {})", v(a), v(b)),
        ScalarNode::Norm(a) => format!("|{}|", v(a)),
        ScalarNode::Real(m, _, w) => format!("real({}, {})", v(m), s(w)),
        ScalarNode::Component(a, axis) => format!("{}.{}", v(a), AXES[usize::from(axis)]),
    }
}

fn vector(g: &Graph, expression: Vector) -> String {
    let v = |e| vector(g, e);
    match g.vector_node(expression) {
        VectorNode::Components(c) => format!("({})", c.map(|c| scalar(g, c)).join(", ")),
        VectorNode::Add(a, b) => format!("({} + {})", v(a), v(b)),
        VectorNode::Sub(a, b) => format!("({} - {})", v(a), v(b)),
        VectorNode::Neg(a) => format!("-{}", v(a)),
        VectorNode::Scale(k, a) => format!("{}*{}", scalar(g, k), v(a)),
        VectorNode::Rotate(r, a) => format!("{} {}", rotation(g, r), v(a)),
        VectorNode::Normalize(a) => format!("normalize({})", v(a)),
        VectorNode::Perp(plane, a) => {
            format!("perp_{}{}({})", AXES[usize::from(plane.from)], AXES[usize::from(plane.towards)], v(a))
        }
        VectorNode::Cross(a, b) => format!("cross({}, {})", v(a), v(b)),
        VectorNode::Motion(space, Attitude::Quaternion(u, w)) => format!("{space:?}({}, {})", v(u), scalar(g, w)),
        VectorNode::Motion(space, Attitude::Turn(a)) => format!("{space:?}({})", v(a)),
        VectorNode::Imaginary(m, u, _) => format!("imaginary({}, {})", v(m), v(u)),
        VectorNode::Solve(m, a) => format!("solve({:?} {}, {})", m.columns.map(v), m.transposed, v(a)),
        VectorNode::Across(a, u) => format!("across({}, {})", v(a), v(u.into())),
    }
}

fn rotation(g: &Graph, expression: Rotation) -> String {
    match g.rotation_node(expression) {
        RotationNode::Matrix(entries) => {
            let first = scalar(g, entries[0]);
            first.strip_suffix("_00").map_or_else(|| "M".to_owned(), str::to_owned)
        }
        RotationNode::Basis(_) => "B".to_owned(),
        RotationNode::Turn(plane, angle) => {
            format!("R_{}{}({})", AXES[usize::from(plane.from)], AXES[usize::from(plane.towards)], g.angle_name(angle))
        }
        RotationNode::About(axis, angle) => format!("R_{}({})", vector(g, axis), g.angle_name(angle)),
        RotationNode::Quaternion(v, w) => format!("Q({}, {})", vector(g, v), scalar(g, w)),
        RotationNode::Step(v) => format!("exp({})", vector(g, v)),
        RotationNode::Moving(motions) => match g.attitude_of(motions) {
            Attitude::Quaternion(v, w) => format!("Q({}, {})", vector(g, v), scalar(g, w)),
            Attitude::Turn(v) => format!("exp({})", vector(g, v)),
        },
        RotationNode::Compose(a, b) => format!("({} {})", rotation(g, a), rotation(g, b)),
        RotationNode::Transpose(a) => format!("{}'", rotation(g, a)),
    }
}

/// Formats a program's steps and outputs in LaTeX.
pub(crate) fn latex(program: &Program) -> String {
    let formulas = print::program_formulas(program, &Notation::default());
    let steps: String = formulas.steps.iter().map(|(_, name, right)| line(&[name, right])).collect();
    steps + &line(&formulas.outputs.iter().collect::<Vec<_>>())
}

fn line(formulas: &[&print::Formula]) -> String {
    formulas.iter().map(|formula| print::latex(formula)).collect::<Vec<_>>().join(" & ") + "\n"
}
