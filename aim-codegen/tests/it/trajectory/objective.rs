//! Target constraint: the position of a trajectory's point relative to its neighbours, and the cost of leaving it.
//!
//! With `a = p₁ − p₀` and `A` the unit vector along `p₂ − p₀`:
//!
//! ```text
//! α = a · A                 along the neighbours' chord
//! β = |a × A|               beside it
//! term = (α₀ − α)² + (β₀ − β)²
//! ```
//!
//! The term is not smooth everywhere: it has a cone at β = 0, and the chord has no direction if the neighbours
//! coincide. Near these points second derivatives grow without bound and do not describe the function beyond. They are
//! therefore derived from a rounded form with `√(|v|² + δ²)` for both lengths and `β = |a − α A|`, which is slightly
//! different.

use aim_symbolic::{Graph, Program, Scalar, Variable, Vector, VectorNode, Want};

/// Programs of a trajectory's cost. The first inputs are p₀, p₁, p₂.
#[derive(Clone, Debug)]
pub(crate) struct TrajectoryPrograms {
    /// α and β.
    pub(crate) place: Program,
    /// Term and its nine derivatives. Further inputs: α₀ and β₀.
    pub(crate) term_gradient: Program,
    /// Rounded α and β. Further input: δ.
    pub(crate) rounded_place: Program,
    /// Rounded term, its nine derivatives, and the lower triangle of its second derivatives, row by row. Further
    /// inputs: δ, α₀ and β₀.
    pub(crate) rounded_term_hessian: Program,
}

impl TrajectoryPrograms {
    /// Derives all programs.
    pub(crate) fn derive() -> Self {
        let mut g = Graph::new();
        let (points, by) = points(&mut g);
        let place = place(&mut g, points);
        let place_program = Program::derive::<Variable>(&g, &place, &[]);
        let term = term(&mut g, place);
        let term_gradient = Program::derive(&g, &[term], &by);

        let mut g = Graph::new();
        let (points, by) = self::points(&mut g);
        let delta = g.input("delta");
        let rounded = rounded(&mut g, points, delta);
        let rounded_place = Program::derive::<Variable>(&g, &rounded, &[]);
        let term = self::term(&mut g, rounded);
        let second = (0..by.len()).flat_map(|i| (0..=i).map(move |k| (i, k)));
        let second = second.map(|(i, k)| Want::Second(term, by[i], by[k])).collect::<Vec<_>>();
        let wanted = [Want::all(&[term], &by), second].concat();
        let rounded_term_hessian = Program::derive_wanted(&g, &wanted);
        Self { place: place_program, term_gradient, rounded_place, rounded_term_hessian }
    }
}

/// Returns the three points and their nine components.
fn points(g: &mut Graph) -> ([Vector; 3], Vec<Variable>) {
    let points = ["p0", "p1", "p2"].map(|name| g.vector_input(name));
    (points, points.into_iter().flat_map(|point| components(g, point)).collect())
}

fn place(g: &mut Graph, [before, here, after]: [Vector; 3]) -> [Scalar; 2] {
    let step = g.sub_vectors(here, before);
    let chord = g.sub_vectors(after, before);
    let chord = g.normalize(chord);
    let aside = g.cross(step, chord.into());
    [g.dot(step, chord), g.norm(aside)]
}

/// Returns rounded α and β, whose lengths are nowhere 0.
fn rounded(g: &mut Graph, [before, here, after]: [Vector; 3], delta: Scalar) -> [Scalar; 2] {
    let least = g.mul(delta, delta);
    let length = |g: &mut Graph, v: Vector| {
        let square = g.dot(v, v);
        let sum = g.add(square, least);
        g.sqrt(sum)
    };
    let step = g.sub_vectors(here, before);
    let chord = g.sub_vectors(after, before);
    let long = length(g, chord);
    let per_length = g.reciprocal(long);
    let chord = g.scale(per_length, chord);
    let along = g.dot(step, chord);
    let part = g.scale(along, chord);
    let aside = g.sub_vectors(step, part);
    [along, length(g, aside)]
}

fn term(g: &mut Graph, place: [Scalar; 2]) -> Scalar {
    let rest = ["alpha0", "beta0"].map(|name| g.input(name));
    let [along, beside] = [0, 1].map(|k| {
        let change = g.sub(rest[k], place[k]);
        g.mul(change, change)
    });
    g.add(along, beside)
}

fn components(g: &Graph, vector: Vector) -> impl Iterator<Item = Variable> + use<> {
    let components = match g.vector_node(vector) {
        VectorNode::Components(components) => components.map(Variable::from).to_vec(),
        _ => Vec::new(),
    };
    components.into_iter()
}
