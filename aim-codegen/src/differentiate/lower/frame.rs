//! [`Frame`]: the variables of a function that is being interpreted, and its control flow.
//!
//! A branch is run with its condition on the path and its assignments in a journal. Where two branches meet, each
//! variable that one of them assigned becomes a select. An exit (`return`, `break`, `continue`) records its condition
//! and the variables' values at that point. Its target selects among all exits that lead to it; the earliest exit has
//! precedence.

use std::rc::Rc;

use super::algebra::Algebra;
use super::condition::{Condition, DEEPEST};
use super::expected::Expected;
use super::value::{FrameId, Scope, Value};

/// Assigned variables, each once: its index and a value.
pub(super) type Assigned = Vec<(usize, Value)>;

/// Target of an exit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Target {
    /// The end of the function.
    Function,
    /// The end of the loop, or of the labelled block, at this depth, from 0.
    Loop(usize),
    /// The end of the body of the loop at this depth.
    Iteration(usize),
}

impl Target {
    /// Returns the nesting depth of the target inside the function.
    fn depth(self) -> usize {
        match self {
            Self::Function => 0,
            Self::Loop(depth) => 1 + 2 * depth,
            Self::Iteration(depth) => 2 + 2 * depth,
        }
    }
}

#[derive(Clone, Debug)]
pub(super) struct Exit {
    pub(super) target: Target,
    pub(super) condition: Condition,
    /// Variables that were assigned since the target began; for a function, the lent ones.
    pub(super) assigned: Assigned,
    /// Value that a function returns, or that a loop breaks with.
    pub(super) value: Value,
}

/// A region of code that is the target of exits, with the frame's state at its beginning.
#[derive(Clone, Debug)]
struct Region {
    target: Target,
    label: Option<String>,
    /// `true` for a block: a `break` without a label does not lead to its end.
    is_block: bool,
    /// Numbers of variables, of branches on the path, and of journals.
    variables: usize,
    path: usize,
    journals: usize,
}

/// A function that is being interpreted.
#[derive(Clone, Debug, Default)]
pub(super) struct Frame {
    pub(super) id: FrameId,
    /// Variables in scope, innermost last.
    variables: Vec<(String, Value)>,
    captured: usize,
    /// Variables that are declared `mut`, or have no name.
    changeable: Vec<usize>,
    /// Variables that are constants of a block.
    constants: Vec<usize>,
    /// For each open branch and region, its assigned variables with their values before.
    journals: Vec<Assigned>,
    /// Conditions of the exits that were taken before the function was called.
    earlier_exits: Vec<Condition>,
    /// Conditions of the open branches.
    path: Vec<Condition>,
    /// Further conditions that hold here, each with the numbers of open branches and regions when it became known.
    assumed: Vec<(usize, usize, Condition)>,
    regions: Vec<Region>,
    exits: Vec<Exit>,
    /// Parameters and captured variables that the caller lends to be changed.
    lent: Vec<usize>,
    /// Lent variables that have been assigned.
    returned: Vec<usize>,
    /// Scope in which the function is written.
    pub(super) scope: Rc<Scope>,
    /// Expected type of the result.
    pub(super) result_type: Expected,
}

impl Frame {
    /// Creates a frame whose first variables are those captured from the caller.
    pub(super) fn new(variables: Vec<(String, Value)>, scope: Rc<Scope>) -> Self {
        let function =
            Region { target: Target::Function, label: None, is_block: false, variables: 0, path: 0, journals: 0 };
        Self { captured: variables.len(), variables, regions: vec![function], scope, ..Self::default() }
    }

    /// Creates the frame of a function that is called at this point.
    pub(super) fn frame_of_call(&self, variables: Vec<(String, Value)>, scope: Rc<Scope>) -> Self {
        let facts = self.facts().map(|condition| (0, 0, condition.clone())).collect();
        let earlier_exits =
            self.earlier_exits.iter().cloned().chain(self.exits.iter().map(|exit| exit.condition.clone())).collect();
        Self { assumed: facts, earlier_exits, ..Self::new(variables, scope) }
    }

    // Variables.

    pub(super) fn declare(&mut self, name: String, value: Value) {
        self.variables.push((name, value));
    }

    /// Allows parts of the last declared variable to be changed.
    pub(super) fn allow_changes(&mut self) {
        self.changeable.push(self.variables.len() - 1);
    }

    /// Marks the last declared variable as a constant.
    pub(super) fn make_constant(&mut self) {
        self.constants.push(self.variables.len() - 1);
    }

    /// Returns `true` for a constant of a block. Of a closure's captured variables only the names are known, so they
    /// are included.
    pub(super) fn is_constant(&self, place: usize) -> bool {
        self.constants.contains(&place) || place < self.captured
    }

    /// Returns `true` if parts of the variable may be changed. Otherwise they are behind a reference that it was copied
    /// from.
    pub(super) fn is_changeable(&self, place: usize) -> bool {
        self.changeable.contains(&place) || self.is_lent(place)
    }

    /// Returns the number of variables; see [`end_scope`](Self::end_scope).
    pub(super) fn depth(&self) -> usize {
        self.variables.len()
    }

    /// Forgets the variables of a scope; `depth` is the number of variables when it was entered.
    pub(super) fn end_scope(&mut self, depth: usize) {
        self.variables.truncate(depth);
        self.changeable.retain(|&place| place < depth);
        self.constants.retain(|&place| place < depth);
        if let Some(journal) = self.journals.last_mut() {
            journal.retain(|(place, _)| *place < depth);
        }
    }

    /// Hides the names of the variables from `depth` on, and returns them.
    pub(super) fn hide_names(&mut self, depth: usize) -> Vec<String> {
        self.variables[depth..].iter_mut().map(|(name, _)| core::mem::take(name)).collect()
    }

    /// Restores the names of the variables from `depth` on.
    pub(super) fn restore_names(&mut self, depth: usize, names: Vec<String>) {
        self.variables[depth..].iter_mut().zip(names).for_each(|((hidden, _), name)| *hidden = name);
    }

    /// Returns `true` for a variable that a closure has captured and must not change here.
    pub(super) fn is_fixed(&self, place: usize) -> bool {
        place < self.captured && !self.is_lent(place)
    }

    /// Marks a variable as lent by the caller.
    pub(super) fn lend(&mut self, place: usize) {
        self.lent.push(place);
    }

    /// Returns `true` if a lent variable has been assigned.
    pub(super) fn has_changed(&self, place: usize) -> bool {
        self.returned.contains(&place)
    }

    /// Returns `true` for a lent parameter, which is a `&mut` in the source.
    pub(super) fn is_lent_parameter(&self, place: usize) -> bool {
        place >= self.captured && self.is_lent(place)
    }

    pub(super) fn is_lent(&self, place: usize) -> bool {
        self.lent.contains(&place)
    }

    pub(super) fn names(&self) -> Vec<&str> {
        // Hidden variables have no name.
        self.variables.iter().map(|(name, _)| name.as_str()).filter(|name| !name.is_empty()).collect()
    }

    /// Returns all variables, for a closure to capture.
    pub(super) fn variables(&self) -> &[(String, Value)] {
        &self.variables
    }

    /// Returns the index of the variable with this name.
    pub(super) fn find(&self, name: &str) -> Option<usize> {
        self.variables.iter().rposition(|(known, _)| known == name)
    }

    pub(super) fn value(&self, place: usize) -> &Value {
        &self.variables[place].1
    }

    pub(super) fn assign(&mut self, place: usize, value: Value) {
        if self.is_lent(place) && !self.returned.contains(&place) {
            self.returned.push(place);
        }
        let before = core::mem::replace(&mut self.variables[place].1, value);
        if let Some(journal) = self.journals.last_mut() {
            if journal.iter().all(|(known, _)| *known != place) {
                journal.push((place, before));
            }
        }
    }

    // Branches.

    /// Iterates over the conditions that hold here, including those that the function is called under.
    pub(super) fn facts(&self) -> impl Iterator<Item = &Condition> + Clone {
        self.assumed.iter().map(|(_, _, condition)| condition)
    }

    /// Returns the condition under which control reaches this point: all facts hold, and no exit was taken.
    pub(super) fn reach_condition(&self, a: &mut Algebra) -> Condition {
        let exits = self.earlier_exits.iter().chain(self.exits.iter().map(|exit| &exit.condition));
        let mut known = Vec::new();
        let conditions = self.facts().cloned().chain(exits.map(|condition| condition.clone().not()));
        conditions.fold(Condition::Known(true), |reached, condition| {
            let number = a.number_of(&condition);
            if known.contains(&number) {
                return reached;
            }
            known.push(number);
            reached.and(condition)
        })
    }

    /// Assumes that the condition holds, until the current branch or region ends.
    pub(super) fn assume(&mut self, condition: Condition) {
        for condition in condition.conjuncts(DEEPEST) {
            self.assumed.push((self.path.len(), self.regions.len(), condition));
        }
    }

    /// Begins a branch that is taken if the condition holds.
    pub(super) fn begin_branch(&mut self, condition: Condition) {
        self.path.push(condition.clone());
        self.assume(condition);
        self.journals.push(Vec::new());
    }

    /// Ends the branch: restores the variables and returns the branch's assignments.
    pub(super) fn end_branch(&mut self) -> Assigned {
        self.path.pop();
        self.assumed.retain(|(path, ..)| *path <= self.path.len());
        let journal = self.journals.pop().unwrap_or_default();
        let restored = journal.into_iter().map(|(place, before)| {
            let after = core::mem::replace(&mut self.variables[place].1, before);
            (place, after)
        });
        restored.collect()
    }

    /// Assigns the variables as the only branch that continues has done.
    pub(super) fn assign_all(&mut self, assigned: Assigned) {
        for (place, value) in assigned {
            self.assign(place, value);
        }
    }

    /// Assigns the variables where two branches meet. Returns the index of a variable whose two values are of different
    /// kinds.
    pub(super) fn merge(
        &mut self,
        a: &mut Algebra,
        condition: &Condition,
        then: &Assigned,
        otherwise: &Assigned,
    ) -> Result<(), usize> {
        let places: Vec<usize> = then.iter().chain(otherwise).map(|(place, _)| *place).collect();
        for (index, &place) in places.iter().enumerate() {
            if places[..index].contains(&place) {
                continue;
            }
            let now = self.value(place);
            let [x, y] = [then, otherwise].map(|branch| assigned_to(branch, place).unwrap_or(now));
            let merged = x.select(a, condition, y).ok_or(place)?;
            self.assign(place, merged);
        }
        Ok(())
    }

    // Exits.

    /// Begins a loop, or one of its iterations.
    pub(super) fn begin_region(&mut self, target: Target, label: Option<String>) {
        let Self { variables, path, journals, .. } = self;
        let (variables, path, journals) = (variables.len(), path.len(), journals.len());
        self.regions.push(Region { target, label, is_block: false, variables, path, journals });
        self.journals.push(Vec::new());
    }

    /// Begins a labelled block and returns its target.
    pub(super) fn begin_block(&mut self, label: String) -> Target {
        let whole = Target::Loop(self.loop_depth());
        self.begin_region(whole, Some(label));
        if let Some(region) = self.regions.last_mut() {
            region.is_block = true;
        }
        whole
    }

    /// Returns the number of open loops and labelled blocks.
    pub(super) fn loop_depth(&self) -> usize {
        self.regions.iter().filter(|region| matches!(region.target, Target::Loop(_))).count()
    }

    /// Returns the depth of the innermost loop, or of the loop or block with this label.
    pub(super) fn find_loop(&self, label: Option<&str>) -> Option<usize> {
        self.regions.iter().rev().find_map(|region| match region.target {
            Target::Loop(_) if label.is_none() && region.is_block => None,
            Target::Loop(depth) if label.is_none() || label == region.label.as_deref() => Some(depth),
            _ => None,
        })
    }

    /// Records an exit to the target, with the returned value.
    pub(super) fn exit(&mut self, target: Target, value: Value) {
        let Some(region) = self.regions.iter().find(|region| region.target == target) else { return };
        let mut assigned = Assigned::new();
        if target == Target::Function {
            assigned.extend(self.lent.iter().map(|&place| (place, self.value(place).clone())));
        } else {
            for &(place, _) in self.journals[region.journals..].iter().flatten() {
                if place < region.variables && assigned_to(&assigned, place).is_none() {
                    assigned.push((place, self.value(place).clone()));
                }
            }
        }
        // An exit to an inner target has already led elsewhere.
        let left = self.exits.iter().filter(|exit| exit.target.depth() > target.depth());
        let left = left.map(|exit| exit.condition.clone().not());
        let condition =
            self.path[region.path..].iter().cloned().chain(left).fold(Condition::Known(true), Condition::and);
        if !matches!(condition, Condition::Known(false)) {
            self.exits.push(Exit { target, condition, assigned, value });
        }
    }

    /// Returns the number of exits so far.
    pub(super) fn exit_count(&self) -> usize {
        self.exits.len()
    }

    /// Returns the condition under which an exit to this target was taken.
    pub(super) fn exit_condition(&self, target: Target) -> Condition {
        let exits = self.exits.iter().filter(|exit| exit.target == target);
        exits.map(|exit| exit.condition.clone()).fold(Condition::Known(false), Condition::or)
    }

    /// Takes the value that exits bring to this target; `None` if there are two kinds of values.
    pub(super) fn take_break_value(&mut self, a: &mut Algebra, target: Target) -> Option<Value> {
        let exits = self.exits.iter_mut().filter(|exit| exit.target == target);
        let break_value =
            exits.map(|exit| (exit.condition.clone(), core::mem::replace(&mut exit.value, Value::nothing())));
        // The earliest exit has precedence.
        let break_value: Vec<(Condition, Value)> = break_value.collect();
        let last = Value::Never;
        break_value.into_iter().rev().try_fold(last, |other, (condition, value)| value.select(a, &condition, &other))
    }

    /// Removes and returns the exits after the first `count`; `None` if one of them may return while variables are
    /// lent.
    pub(super) fn take_exits_beyond(&mut self, count: usize) -> Option<Vec<Exit>> {
        let exits = self.exits.split_off(count);
        let returns = exits.iter().any(|exit| exit.target == Target::Function);
        (!returns || self.lent.is_empty()).then_some(exits)
    }

    /// Forgets the exits after the first `count`.
    pub(super) fn forget_exits(&mut self, count: usize) {
        self.exits.truncate(count);
    }

    /// Returns `true` if an exit to this target may have been taken.
    pub(super) fn has_exits(&self, target: Target) -> bool {
        self.exits.iter().any(|exit| exit.target == target)
    }

    /// Returns `true` if an exit to this target was certainly taken.
    pub(super) fn certainly_exits(&self, target: Target) -> bool {
        self.exits.iter().any(|exit| exit.target == target && matches!(exit.condition, Condition::Known(true)))
    }

    /// Ends a loop or an iteration. Variables get their values at the exits, and their present values if no exit was
    /// taken (possible only if `ends`). Returns the value that a `break` brings; `None` if that or a variable has two
    /// kinds of values.
    pub(super) fn end_region(&mut self, a: &mut Algebra, ends: bool) -> Option<Value> {
        let Some(region) = self.regions.pop() else { return Some(Value::nothing()) };
        self.assumed.retain(|(_, regions, _)| *regions <= self.regions.len());
        let journal = self.journals.pop().unwrap_or_default();
        let exits = self.take_exits(region.target);
        let mut continues = ends;
        let mut break_value = if ends { Value::nothing() } else { Value::Never };
        // The journal does not contain the assignments of a branch that ends in an exit.
        let mut now = Assigned::new();
        for &(place, _) in journal.iter().chain(exits.iter().flat_map(|exit| &exit.assigned)) {
            if place < region.variables && assigned_to(&now, place).is_none() {
                now.push((place, self.value(place).clone()));
            }
        }
        for exit in exits.iter().rev() {
            for (place, value) in &mut now {
                let there = assigned_to(&exit.assigned, *place).or_else(|| assigned_to(&journal, *place));
                let there = there.unwrap_or_else(|| self.value(*place));
                *value = if continues { there.select(a, &exit.condition, value)? } else { there.clone() };
            }
            break_value = exit.value.select(a, &exit.condition, &break_value)?;
            continues = true;
        }
        // The enclosing journal needs the values before.
        for (place, before) in journal.into_iter().filter(|(place, _)| *place < region.variables) {
            self.variables[place].1 = before;
        }
        self.assign_all(now);
        Some(break_value)
    }

    fn take_exits(&mut self, target: Target) -> Vec<Exit> {
        let (taken, rest) = core::mem::take(&mut self.exits).into_iter().partition(|exit| exit.target == target);
        self.exits = rest;
        taken
    }

    /// Returns the function's value, selected among those returned and the one at its end, and the values of lent
    /// variables; `None` if some are of two kinds.
    pub(super) fn result(&mut self, a: &mut Algebra, end: Value) -> Option<(Value, Vec<Value>)> {
        let ends = !end.is_never();
        let lent = self.lent.iter().map(|&place| if ends { self.value(place).clone() } else { Value::Never }).collect();
        let exits = self.take_exits(Target::Function);
        exits.into_iter().rev().try_fold((end, lent), |(value, lent): (Value, Vec<Value>), exit| {
            let there = exit.assigned.iter().map(|(_, value)| value);
            let selected = there.zip(&lent).map(|(there, value)| there.select(a, &exit.condition, value));
            let lent = selected.collect::<Option<Vec<Value>>>()?;
            Some((exit.value.select(a, &exit.condition, &value)?, lent))
        })
    }
}

fn assigned_to(assigned: &Assigned, place: usize) -> Option<&Value> {
    assigned.iter().find(|(known, _)| *known == place).map(|(_, value)| value)
}
