//! [`Frame`]: the variables of a function that is being interpreted, and the ways that control takes through it.
//!
//! A branch is run with its condition on the path and its assignments in a journal; where branches meet again, each
//! variable that one of them assigned is a select. A way out (`return`, `break`, `continue`) keeps its condition and the
//! variables as they are there; what it leads to selects among the ways that end there, the first that was met first.

use std::rc::Rc;

use super::algebra::Algebra;
use super::condition::{Condition, DEEPEST};
use super::expected::Expected;
use super::value::{FrameId, Scope, Value};

/// Assigned variables, each once: its place and a value.
pub(super) type Assigned = Vec<(usize, Value)>;

/// What a way out leads to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Target {
    /// The end of the function.
    Function,
    /// The end of the loop, or of the block with a label, at this depth, from 0.
    Loop(usize),
    /// The end of its body.
    Round(usize),
}

impl Target {
    /// How far inside the function its end is.
    fn depth(self) -> usize {
        match self {
            Self::Function => 0,
            Self::Loop(depth) => 1 + 2 * depth,
            Self::Round(depth) => 2 + 2 * depth,
        }
    }
}

#[derive(Clone, Debug)]
pub(super) struct Exit {
    pub(super) target: Target,
    pub(super) condition: Condition,
    /// The variables that were assigned since the target began; of a function those that are lent.
    pub(super) assigned: Assigned,
    /// What a function returns, or a loop.
    pub(super) value: Value,
}

/// Something that control can be led to the end of, as it was when it began.
#[derive(Clone, Debug)]
struct Region {
    target: Target,
    label: Option<String>,
    /// True of a block, to whose end a `break` without a label does not lead.
    is_block: bool,
    /// How many variables, branches on the path, and journals there were.
    variables: usize,
    path: usize,
    journals: usize,
}

/// A function under interpretation.
#[derive(Clone, Debug, Default)]
pub(super) struct Frame {
    pub(super) id: FrameId,
    /// The names in scope, the innermost last.
    variables: Vec<(String, Value)>,
    captured: usize,
    /// Those that are declared `mut`, or have no name.
    changeable: Vec<usize>,
    /// Those that are constants of a block.
    constants: Vec<usize>,
    /// The values before they were assigned, of the variables assigned in each branch and region under way.
    journals: Vec<Assigned>,
    /// Where control has gone to other ends before the function was called.
    gone: Vec<Condition>,
    /// The conditions of the branches under way.
    path: Vec<Condition>,
    /// What else holds where control is: the branches and regions under way when that became known, and a condition.
    assumed: Vec<(usize, usize, Condition)>,
    regions: Vec<Region>,
    exits: Vec<Exit>,
    /// The parameters and the captured variables that the caller lends to be changed.
    lent: Vec<usize>,
    /// Those of them that have been assigned.
    returned: Vec<usize>,
    /// Where the function is written.
    pub(super) scope: Rc<Scope>,
    /// What the type of its result says.
    pub(super) result_type: Expected,
}

impl Frame {
    /// A frame whose first variables are of the place that it is called from.
    pub(super) fn new(variables: Vec<(String, Value)>, scope: Rc<Scope>) -> Self {
        let function =
            Region { target: Target::Function, label: None, is_block: false, variables: 0, path: 0, journals: 0 };
        Self { captured: variables.len(), variables, regions: vec![function], scope, ..Self::default() }
    }

    /// The same of a function that is called where control is in this one.
    pub(super) fn called(&self, variables: Vec<(String, Value)>, scope: Rc<Scope>) -> Self {
        let facts = self.facts().map(|condition| (0, 0, condition.clone())).collect();
        let gone = self.gone.iter().cloned().chain(self.exits.iter().map(|exit| exit.condition.clone())).collect();
        Self { assumed: facts, gone, ..Self::new(variables, scope) }
    }

    // Variables.

    pub(super) fn declare(&mut self, name: String, value: Value) {
        self.variables.push((name, value));
    }

    /// The variable that was declared last may be changed in part.
    pub(super) fn allow_changes(&mut self) {
        self.changeable.push(self.variables.len() - 1);
    }

    /// The variable that was declared last is a constant.
    pub(super) fn make_constant(&mut self) {
        self.constants.push(self.variables.len() - 1);
    }

    /// True of a constant of a block; of what comes from outside of a closure nothing else is known than its name.
    pub(super) fn is_constant(&self, place: usize) -> bool {
        self.constants.contains(&place) || place < self.captured
    }

    /// True of a variable of which parts may be changed. Of another one they are behind a reference that it was copied from.
    pub(super) fn is_changeable(&self, place: usize) -> bool {
        self.changeable.contains(&place) || self.is_lent(place)
    }

    /// How many variables there are; see [`leave`](Self::leave).
    pub(super) fn depth(&self) -> usize {
        self.variables.len()
    }

    /// Forgets the variables of a scope that was entered when there were so many.
    pub(super) fn leave(&mut self, depth: usize) {
        self.variables.truncate(depth);
        self.changeable.retain(|&place| place < depth);
        self.constants.retain(|&place| place < depth);
        if let Some(journal) = self.journals.last_mut() {
            journal.retain(|(place, _)| *place < depth);
        }
    }

    /// No name means the variables from this one on any more; their names.
    pub(super) fn hide(&mut self, depth: usize) -> Vec<String> {
        self.variables[depth..].iter_mut().map(|(name, _)| core::mem::take(name)).collect()
    }

    /// Gives the variables from this one on their names again.
    pub(super) fn show(&mut self, depth: usize, names: Vec<String>) {
        self.variables[depth..].iter_mut().zip(names).for_each(|((hidden, _), name)| *hidden = name);
    }

    /// Whether the variable of this place is one that a closure has captured and must not change here.
    pub(super) fn is_fixed(&self, place: usize) -> bool {
        place < self.captured && !self.is_lent(place)
    }

    /// The variable of this place is lent by the caller.
    pub(super) fn lend(&mut self, place: usize) {
        self.lent.push(place);
    }

    /// Whether the variable of this place, which is lent, has been assigned.
    pub(super) fn has_changed(&self, place: usize) -> bool {
        self.returned.contains(&place)
    }

    /// Whether it is that of a parameter, which is a `&mut` to whoever reads the function.
    pub(super) fn is_lent_parameter(&self, place: usize) -> bool {
        place >= self.captured && self.is_lent(place)
    }

    pub(super) fn is_lent(&self, place: usize) -> bool {
        self.lent.contains(&place)
    }

    pub(super) fn names(&self) -> Vec<&str> {
        // Hidden ones have none.
        self.variables.iter().map(|(name, _)| name.as_str()).filter(|name| !name.is_empty()).collect()
    }

    /// All variables, for a closure.
    pub(super) fn variables(&self) -> &[(String, Value)] {
        &self.variables
    }

    /// The place of the variable that this name means.
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

    /// The conditions that hold where control is, also those that the function is called under.
    pub(super) fn facts(&self) -> impl Iterator<Item = &Condition> + Clone {
        self.assumed.iter().map(|(_, _, condition)| condition)
    }

    /// Where control is: where all facts hold, and it has gone nowhere else.
    pub(super) fn reached(&self, a: &mut Algebra) -> Condition {
        let gone = self.gone.iter().chain(self.exits.iter().map(|exit| &exit.condition));
        let mut known = Vec::new();
        let conditions = self.facts().cloned().chain(gone.map(|condition| condition.clone().not()));
        conditions.fold(Condition::Known(true), |reached, condition| {
            let number = a.number_of(&condition);
            if known.contains(&number) {
                return reached;
            }
            known.push(number);
            reached.and(condition)
        })
    }

    /// From here on, as long as the branch and the region last, control is only where this holds.
    pub(super) fn assume(&mut self, condition: Condition) {
        for condition in condition.conjuncts(DEEPEST) {
            self.assumed.push((self.path.len(), self.regions.len(), condition));
        }
    }

    /// Begins a branch that is taken where the condition holds.
    pub(super) fn begin_branch(&mut self, condition: Condition) {
        self.path.push(condition.clone());
        self.assume(condition);
        self.journals.push(Vec::new());
    }

    /// Ends it: the variables are as before, and what the branch made of them is returned.
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

    /// Gives variables the values that the only branch that goes on has given them.
    pub(super) fn take(&mut self, assigned: Assigned) {
        for (place, value) in assigned {
            self.assign(place, value);
        }
    }

    /// Gives variables their values where two branches meet; the place of one that has two kinds of values.
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

    // Ways out.

    /// Begins a loop, or the round of one.
    pub(super) fn begin(&mut self, target: Target, label: Option<String>) {
        let Self { variables, path, journals, .. } = self;
        let (variables, path, journals) = (variables.len(), path.len(), journals.len());
        self.regions.push(Region { target, label, is_block: false, variables, path, journals });
        self.journals.push(Vec::new());
    }

    /// The same of a block with a label: its target.
    pub(super) fn begin_block(&mut self, label: String) -> Target {
        let whole = Target::Loop(self.loops());
        self.begin(whole, Some(label));
        if let Some(region) = self.regions.last_mut() {
            region.is_block = true;
        }
        whole
    }

    /// The number of loops, and of blocks with a label, that are under way.
    pub(super) fn loops(&self) -> usize {
        self.regions.iter().filter(|region| matches!(region.target, Target::Loop(_))).count()
    }

    /// The depth of the innermost loop, or of the loop or block with this label.
    pub(super) fn find_loop(&self, label: Option<&str>) -> Option<usize> {
        self.regions.iter().rev().find_map(|region| match region.target {
            Target::Loop(_) if label.is_none() && region.is_block => None,
            Target::Loop(depth) if label.is_none() || label == region.label.as_deref() => Some(depth),
            _ => None,
        })
    }

    /// Control goes to the end of the target, with the value that is returned.
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
        // Where control has gone to an end further inside, it does not come here.
        let left = self.exits.iter().filter(|exit| exit.target.depth() > target.depth());
        let left = left.map(|exit| exit.condition.clone().not());
        let condition =
            self.path[region.path..].iter().cloned().chain(left).fold(Condition::Known(true), Condition::and);
        if !matches!(condition, Condition::Known(false)) {
            self.exits.push(Exit { target, condition, assigned, value });
        }
    }

    /// The number of ways out so far.
    pub(super) fn exits(&self) -> usize {
        self.exits.len()
    }

    /// Where control has been led to this end.
    pub(super) fn exit_condition(&self, target: Target) -> Condition {
        let exits = self.exits.iter().filter(|exit| exit.target == target);
        exits.map(|exit| exit.condition.clone()).fold(Condition::Known(false), Condition::or)
    }

    /// Takes the value that control brings to this end; `None` where there are two kinds.
    pub(super) fn take_brought(&mut self, a: &mut Algebra, target: Target) -> Option<Value> {
        let exits = self.exits.iter_mut().filter(|exit| exit.target == target);
        let brought = exits.map(|exit| (exit.condition.clone(), core::mem::replace(&mut exit.value, Value::nothing())));
        // The first that was met counts.
        let brought: Vec<(Condition, Value)> = brought.collect();
        let last = Value::Never;
        brought.into_iter().rev().try_fold(last, |other, (condition, value)| value.select(a, &condition, &other))
    }

    /// Takes the ways out that there are beyond so many; `None` where one may return, and variables are lent.
    pub(super) fn take_exits_beyond(&mut self, count: usize) -> Option<Vec<Exit>> {
        let exits = self.exits.split_off(count);
        let returns = exits.iter().any(|exit| exit.target == Target::Function);
        (!returns || self.lent.is_empty()).then_some(exits)
    }

    /// Takes the ways out back that there are beyond so many.
    pub(super) fn forget_exits(&mut self, count: usize) {
        self.exits.truncate(count);
    }

    /// Whether control may have been led to this end.
    pub(super) fn has_exits(&self, target: Target) -> bool {
        self.exits.iter().any(|exit| exit.target == target)
    }

    /// Whether it certainly was.
    pub(super) fn certainly_exits(&self, target: Target) -> bool {
        self.exits.iter().any(|exit| exit.target == target && matches!(exit.condition, Condition::Known(true)))
    }

    /// Ends a loop or a round: the variables are what they are at the ways out, and where there was none (`ends`), what
    /// they are now. The value that a `break` brings there; `None` where that or a variable has two kinds of values.
    pub(super) fn end(&mut self, a: &mut Algebra, ends: bool) -> Option<Value> {
        let Some(region) = self.regions.pop() else { return Some(Value::nothing()) };
        self.assumed.retain(|(_, regions, _)| *regions <= self.regions.len());
        let journal = self.journals.pop().unwrap_or_default();
        let exits = self.take_exits(region.target);
        let mut goes_on = ends;
        let mut brought = if ends { Value::nothing() } else { Value::Never };
        // Of what a branch has assigned that ends in a way out, the journal does not know.
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
                *value = if goes_on { there.select(a, &exit.condition, value)? } else { there.clone() };
            }
            brought = exit.value.select(a, &exit.condition, &brought)?;
            goes_on = true;
        }
        // The enclosing journal has to know the values before.
        for (place, before) in journal.into_iter().filter(|(place, _)| *place < region.variables) {
            self.variables[place].1 = before;
        }
        self.take(now);
        Some(brought)
    }

    fn take_exits(&mut self, target: Target) -> Vec<Exit> {
        let (taken, rest) = core::mem::take(&mut self.exits).into_iter().partition(|exit| exit.target == target);
        self.exits = rest;
        taken
    }

    /// The function's value, of those that were returned and the one at its end, and those of the variables that were lent;
    /// `None` where some are of two kinds.
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
