//! [`Translation`]: the state of a function that is being run.

use std::rc::Rc;

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
use crate::emit::Precision;

/// The most rounds of all loops, and calls of functions inside of themselves, together.
pub(super) const MOST_ROUNDS: usize = 10_000;

/// The most rounds that are written out of which it is not known whether they are run: of what can be no loop in the code, and of
/// what can, which is smaller then, and ends where it is left.
pub(super) const MOST_OPEN_ROUNDS: usize = 200;
const MANY_OPEN_ROUNDS: usize = 16;

/// The interpretation of one function.
pub(in crate::differentiate) struct Translation<'a> {
    pub(super) algebra: &'a mut Algebra,
    pub(super) report: &'a mut Report,
    pub(super) items: &'a Items,
    /// What the function computes in, where that is known.
    pub(super) precision: Option<Precision>,
    /// The variables of the function that is being run.
    pub(super) frame: Frame,
    /// The functions that are being run, the innermost last.
    pub(super) calls: Vec<Rc<Callable>>,
    /// The constants that are being looked up.
    pub(super) constants: Vec<String>,
    /// Rounds of loops, and calls of functions inside of themselves, so far.
    pub(super) rounds_run: usize,
    /// Whether the iterator that is made next is gone through to its end at once.
    pub(super) is_drained: bool,
    /// The loops that stay loops and are being run, the innermost last.
    pub(super) kept: Vec<usize>,
    /// The most rounds that are written out of which it is not known whether they are run.
    pub(super) most_open: usize,
    /// Whether a loop has just been run of which it is not known how many rounds it has.
    pub(super) is_open: bool,
    /// Whether a loop has just been given up, as no end of it is in sight.
    pub(super) is_endless: bool,
    /// The loops that were given up before, by where they are.
    pub(super) endless: Vec<*const ()>,
    /// The number of the graph's nodes that are of what was given up, or were there before.
    pub(super) given_up: usize,
}

/// How much has been run before something that may be run anew.
#[derive(Clone, Copy)]
pub(super) struct Mark {
    rounds: usize,
    nodes: usize,
    loops: usize,
}

/// Counts of what was reported: errors, and functions that are at fault.
#[derive(Clone, Copy)]
pub(super) struct Said {
    pub(super) errors: usize,
    faults: usize,
}

impl<'a> Translation<'a> {
    /// A function beside these items, that computes in this number type.
    pub(in crate::differentiate) fn new(
        algebra: &'a mut Algebra,
        report: &'a mut Report,
        items: &'a Items,
        precision: Option<Precision>,
    ) -> Self {
        let frame = Frame::new(Vec::new(), Rc::default());
        // What another function has made is not held against this one.
        let given_up = algebra.g.len();
        Self {
            algebra,
            report,
            items,
            precision,
            frame,
            calls: Vec::new(),
            constants: Vec::new(),
            rounds_run: 0,
            is_drained: false,
            kept: Vec::new(),
            most_open: MOST_OPEN_ROUNDS,
            is_open: false,
            is_endless: false,
            endless: Vec::new(),
            given_up,
        }
    }

    /// With loops of many rounds, which may be left before, as loops.
    pub(in crate::differentiate) fn keeping_loops(self) -> Self {
        Self { most_open: MANY_OPEN_ROUNDS, ..self }
    }

    /// What is done in another scope, without the variables of the function that is being run.
    pub(super) fn within<R>(&mut self, scope: Rc<Scope>, act: impl FnOnce(&mut Self) -> R) -> R {
        let outer = core::mem::replace(&mut self.frame, Frame::new(Vec::new(), scope));
        let result = act(self);
        self.frame = outer;
        result
    }

    /// Counts what was reported so far.
    pub(super) fn said(&self) -> Said {
        Said { errors: self.report.count(), faults: self.items.faults() }
    }

    /// Forgets what was reported since, and that a function is at fault for it: where it is called again, it is run again.
    pub(super) fn unsay(&mut self, said: Said) {
        self.report.forget(said.errors);
        self.items.forget_faults(said.faults);
    }

    pub(super) fn mark(&self) -> Mark {
        let nodes = self.algebra.g.len() - self.given_up;
        Mark { rounds: self.rounds_run, nodes, loops: self.algebra.loops.len() }
    }

    /// Gives up what was run since.
    pub(super) fn take_back(&mut self, mark: Mark) {
        self.rounds_run = mark.rounds;
        self.given_up = self.algebra.g.len() - mark.nodes;
        self.algebra.loops.truncate(mark.loops);
    }

    /// Reports what has no value.
    pub(super) fn refuse(&mut self, place: &impl ToTokens, text: Text) -> Value {
        self.report.error_in(place, text);
        Value::Unknown
    }

    /// The same because of a value; of an unknown one all has been said.
    pub(super) fn refuse_known(&mut self, value: &Value, place: &impl ToTokens, text: Text) -> Value {
        if value.is_unknown() { Value::Unknown } else { self.refuse(place, text) }
    }

    pub(super) fn unsupported(&mut self, place: &impl ToTokens, what: &str, help: &str) -> Value {
        self.refuse(place, messages::unsupported(what, help))
    }

    /// The words about a name that stands for nothing that was read, where nothing better is known of it than these.
    pub(super) fn unseen(&self, name: &str, otherwise: Text) -> Text {
        match name {
            "Ok" | "Err" => messages::no_result_value(name),
            _ if self.items.is_conditional(name) => messages::conditional_item(name),
            _ => otherwise,
        }
    }
}

/// The length of an array that its type says.
pub(in crate::differentiate) fn length(expression: &Expr, items: &Items, scope: &Scope) -> Option<usize> {
    let (mut algebra, mut report) = (Algebra::new(), Report::new(Notation::Rust));
    let mut translation = Translation::new(&mut algebra, &mut report, items, None);
    let value = translation.within(Rc::new(scope.clone()), |this| this.expression(expression));
    algebra.known_index(&value)
}
