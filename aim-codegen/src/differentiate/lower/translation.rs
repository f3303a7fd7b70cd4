//! [`Translation`]: the state of the interpretation of a function.

use std::rc::Rc;

use aim_symbolic::Node;
use quote::ToTokens;
use syn::Expr;

use super::algebra::Algebra;
use super::frame::Frame;
use super::value::{Callable, Scope, Value};
use crate::declare::report::Report;
use crate::declare::report::text::Text;
use crate::declare::tree::Notation;
use crate::differentiate::items::Items;
use crate::differentiate::messages;
use crate::differentiate::names::{self, segments};
use crate::emit::Precision;

/// Maximum number of loop iterations and recursive calls together.
pub(super) const MAX_ITERATIONS: usize = 10_000;

/// Maximum number of unrolled iterations that may or may not be run, for a loop that cannot be kept.
pub(super) const MAX_OPEN_ITERATIONS: usize = 200;
/// Maximum number of unrolled iterations that may or may not be run, for a loop that can be kept: the code is then
/// smaller, and ends where the loop is left.
const MAX_OPEN_ITERATIONS_IF_KEPT: usize = 16;

/// The interpretation of one function.
pub(in crate::differentiate) struct Translation<'a> {
    pub(super) algebra: &'a mut Algebra,
    pub(super) report: &'a mut Report,
    pub(super) items: &'a Items,
    /// Number type that the function computes in, if it is known.
    pub(super) precision: Option<Precision>,
    /// Variables of the function that is being run.
    pub(super) frame: Frame,
    /// Functions that are being run, innermost last.
    pub(super) calls: Vec<Rc<Callable>>,
    /// Constants that are being evaluated.
    pub(super) constants: Vec<String>,
    /// `true` if companions can read constants of the module that they are written into.
    pub(super) reads_constants: bool,
    /// Number of loop iterations and recursive calls so far.
    pub(super) iterations_run: usize,
    /// `true` if the next iterator is consumed at once.
    pub(super) is_drained: bool,
    /// Indices of the kept loops that are being run, innermost last.
    pub(super) open_kept_loops: Vec<usize>,
    /// Maximum number of unrolled iterations that may or may not be run.
    pub(super) max_open_iterations: usize,
    /// `true` if the last loop had an unknown number of iterations.
    pub(super) is_open: bool,
    /// `true` if unrolling a loop was just abandoned, because no end was found.
    pub(super) is_endless: bool,
    /// Loops whose unrolling was abandoned, by their address in the syntax tree.
    pub(super) endless: Vec<*const ()>,
    /// Number of graph nodes that are abandoned, or that existed before.
    pub(super) abandoned_nodes: usize,
}

/// State of progress before a part that may be run again.
#[derive(Clone, Copy)]
pub(super) struct Progress {
    iterations: usize,
    nodes: usize,
    loops: usize,
}

/// Numbers of reported errors and of functions at fault.
#[derive(Clone, Copy)]
pub(super) struct ReportCounts {
    pub(super) errors: usize,
    faults: usize,
}

impl<'a> Translation<'a> {
    /// Creates the interpretation of a function beside these items, in this number type.
    pub(in crate::differentiate) fn new(
        algebra: &'a mut Algebra,
        report: &'a mut Report,
        items: &'a Items,
        precision: Option<Precision>,
    ) -> Self {
        let frame = Frame::new(Vec::new(), Rc::default());
        // Do not count the nodes of other functions against this one.
        let abandoned_nodes = algebra.g.len();
        Self {
            algebra,
            report,
            items,
            precision,
            frame,
            calls: Vec::new(),
            constants: Vec::new(),
            reads_constants: false,
            iterations_run: 0,
            is_drained: false,
            open_kept_loops: Vec::new(),
            max_open_iterations: MAX_OPEN_ITERATIONS,
            is_open: false,
            is_endless: false,
            endless: Vec::new(),
            abandoned_nodes,
        }
    }

    /// Reads constants that stand beside the function, outside of the known items, when the companion runs.
    pub(in crate::differentiate) fn reading_constants(self) -> Self {
        Self { reads_constants: true, ..self }
    }

    /// Keeps loops of many iterations that may end early.
    pub(in crate::differentiate) fn keeping_loops(self) -> Self {
        Self { max_open_iterations: MAX_OPEN_ITERATIONS_IF_KEPT, ..self }
    }

    /// Runs `act` in another scope, without the variables of the current function.
    pub(super) fn within<R>(&mut self, scope: Rc<Scope>, act: impl FnOnce(&mut Self) -> R) -> R {
        let outer = core::mem::replace(&mut self.frame, Frame::new(Vec::new(), scope));
        let result = act(self);
        self.frame = outer;
        result
    }

    /// Returns the present numbers of reports.
    pub(super) fn report_counts(&self) -> ReportCounts {
        ReportCounts { errors: self.report.count(), faults: self.items.faults() }
    }

    /// Forgets the reports since then, including functions at fault, so that they are run again when called again.
    pub(super) fn forget_reports_since(&mut self, counts: ReportCounts) {
        self.report.forget(counts.errors);
        self.items.forget_faults(counts.faults);
    }

    pub(super) fn progress(&self) -> Progress {
        let nodes = self.algebra.g.len() - self.abandoned_nodes;
        Progress { iterations: self.iterations_run, nodes, loops: self.algebra.loops.len() }
    }

    /// Abandons everything that was run since then.
    pub(super) fn roll_back(&mut self, progress: Progress) {
        self.iterations_run = progress.iterations;
        self.abandoned_nodes = self.algebra.g.len() - progress.nodes;
        self.algebra.loops.truncate(progress.loops);
    }

    /// Reports an error and returns an unknown value.
    pub(super) fn refuse(&mut self, place: &impl ToTokens, text: Text) -> Value {
        self.report.error_in(place, text);
        Value::Unknown
    }

    /// Reports an error about a value and returns an unknown value. If the value is unknown itself, an error was
    /// already reported.
    pub(super) fn refuse_known(&mut self, value: &Value, place: &impl ToTokens, text: Text) -> Value {
        if value.is_unknown() { Value::Unknown } else { self.refuse_any(&[value], place, text) }
    }

    /// Reports an error about these values and returns an unknown value. A constant that was taken for a number, and
    /// does not fit here as one, is reported in its place.
    pub(super) fn refuse_any(&mut self, values: &[&Value], place: &impl ToTokens, text: Text) -> Value {
        let constants: Vec<_> = self.algebra.constants().collect();
        let mistaken = constants.into_iter().find(|(_, input)| {
            values.iter().any(|value| match value {
                Value::Scalar(x) => self.algebra.g.depends_on(Node::Scalar(*x), &[(*input).into()]),
                _ => false,
            })
        });
        match mistaken {
            Some((path, _)) => {
                let name = segments(&path).pop().unwrap_or_default();
                self.refuse(&path, messages::outside_name(&name, &[]))
            }
            None => self.refuse(place, text),
        }
    }

    pub(super) fn unsupported(&mut self, place: &impl ToTokens, what: &str, help: &str) -> Value {
        self.refuse(place, messages::unsupported(what, help))
    }

    /// Returns the message about a name that was not found; `otherwise` unless there is a more specific one.
    pub(super) fn not_found_message(&self, name: &str, otherwise: Text) -> Text {
        if let Some(ty) = name.split("::").find(|ty| names::is_unsupported(ty)) {
            return messages::unsupported_type(ty);
        }
        match name {
            "Ok" | "Err" => messages::no_result_value(name),
            _ if self.items.is_conditional(name) => messages::conditional_item(name),
            _ if self.frame.scope.has_foreign_glob && !name.contains("::") => messages::behind_glob(name),
            _ => otherwise,
        }
    }
}

/// Evaluates the length in an array type.
pub(in crate::differentiate) fn length(expression: &Expr, items: &Items, scope: &Scope) -> Option<usize> {
    let (mut algebra, mut report) = (Algebra::new(), Report::new(Notation::Rust));
    let mut translation = Translation::new(&mut algebra, &mut report, items, None);
    let value = translation.within(Rc::new(scope.clone()), |this| this.expression(expression));
    algebra.known_index(&value)
}
