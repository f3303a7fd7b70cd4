//! [`Companion`]: the kinds of functions that are derived from a user's function, and their outputs.

use std::rc::Rc;

use aim_symbolic::{Count, Graph, Program, Scalar, Variable, Want};

use super::loop_programs::KeptLoops;
use super::pruned_graph::ValueAndVariables;

/// A kind of function that is emitted beside the user's.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Companion {
    /// The value and its first derivatives.
    First,
    /// The value, its first and its second derivatives.
    Hessian,
    /// The value and its derivative along a direction, Jv.
    Jvp,
    /// The value and the derivatives of its weighted sum, wᵀJ.
    Vjp,
    /// The derivative along a direction, and its derivatives, Hv.
    Hvp,
    /// The value r, `Jᵀr` and `JᵀJ`.
    GaussNewton,
}

/// Parameters of a companion in addition to the function's own arguments.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum ExtraParameters {
    Nothing,
    /// `along_x` for each variable `x`, of the variable's type.
    Direction,
    /// `weights`, of the result's type.
    Weights,
}

impl Companion {
    /// Companions that are emitted only if an option requests them.
    pub(super) const OPTIONAL: [Self; 5] = [Self::Hessian, Self::Jvp, Self::Vjp, Self::Hvp, Self::GaussNewton];

    /// Returns the option's name, which is also the suffix of the companion's name.
    pub(super) fn key(self) -> &'static str {
        match self {
            Self::First => "gradient",
            Self::Hessian => "hessian",
            Self::Jvp => "jvp",
            Self::Vjp => "vjp",
            Self::Hvp => "hvp",
            Self::GaussNewton => "gauss_newton",
        }
    }

    pub(super) fn extra_parameters(self) -> ExtraParameters {
        match self {
            Self::First | Self::Hessian | Self::GaussNewton => ExtraParameters::Nothing,
            Self::Jvp | Self::Hvp => ExtraParameters::Direction,
            Self::Vjp => ExtraParameters::Weights,
        }
    }

    /// Returns `true` if it applies only to functions that return one number.
    pub(super) fn is_of_a_number(self) -> bool {
        matches!(self, Self::Hessian | Self::Hvp)
    }

    /// Returns the outputs of the companion's program, in order. `extra` are the numbers of the parameters that it
    /// [takes in addition](Self::extra_parameters).
    pub(super) fn wanted(self, g: &mut Graph, stated: &ValueAndVariables, extra: &[Scalar]) -> Vec<Want> {
        let ValueAndVariables { values, vector, variables } = stated;
        let value = values.iter().map(|&value| Want::Value(value));
        let by = |x: Scalar| values.iter().map(move |&value| Want::Derivative(value, x.into()));
        let triangle = |entry: &dyn Fn(Variable, Variable) -> Want| -> Vec<Want> {
            let rows = variables.iter().enumerate();
            rows.flat_map(|(i, &x)| variables[i..].iter().map(move |&y| entry(x.into(), y.into()))).collect()
        };
        let along = |g: &mut Graph| -> Variable {
            let components: Vec<_> = variables.iter().zip(extra).map(|(&x, &along)| (x.into(), along)).collect();
            g.direction(&components).into()
        };
        match self {
            Self::First => value.chain(variables.iter().flat_map(|&x| by(x))).collect(),
            Self::Hessian => {
                let second = triangle(&|x, y| Want::Second(values[0], x, y));
                value.chain(variables.iter().flat_map(|&x| by(x))).chain(second).collect()
            }
            Self::Jvp => {
                let along = along(g);
                value.chain(values.iter().map(|&v| Want::Derivative(v, along))).collect()
            }
            Self::Vjp => {
                let weighted = match (*vector, extra) {
                    (Some(v), &[x, y, z]) => {
                        let weights = g.components([x, y, z]);
                        g.dot(v, weights)
                    }
                    _ => {
                        let products: Vec<Scalar> = values.iter().zip(extra).map(|(&v, &w)| g.mul(v, w)).collect();
                        products.into_iter().reduce(|a, b| g.add(a, b)).unwrap_or_else(|| g.constant(0.0))
                    }
                };
                value.chain(variables.iter().map(|&x| Want::Derivative(weighted, x.into()))).collect()
            }
            Self::Hvp => {
                let along = along(g);
                let second = variables.iter().map(|&x| Want::Second(values[0], along, x.into()));
                [Want::Derivative(values[0], along)].into_iter().chain(second).collect()
            }
            Self::GaussNewton => {
                let projected = variables.iter().map(|&x| Want::Projected(x.into()));
                value.chain(projected).chain(triangle(&Want::Normal)).collect()
            }
        }
    }
}

impl Derived {
    /// Returns the number of operations of all programs; a kept loop's iteration counts once.
    pub(super) fn count(&self) -> Count {
        self.program.count() + self.kept_loops.count()
    }
}

/// A derived companion.
pub(super) struct Derived {
    pub(super) companion: Companion,
    /// Graph of its statement.
    pub(super) graph: Graph,
    pub(super) wanted: Vec<Want>,
    pub(super) program: Program,
    pub(super) kept_loops: Rc<KeptLoops>,
    /// Vectors among the arguments that are taken to have length 1: index of the argument, and of the vector's first
    /// number in it.
    pub(super) unit_axes: Rc<[(usize, usize)]>,
}
