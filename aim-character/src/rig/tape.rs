//! A program laid out for the interpreter: each value has a slot in a small array on the stack.
//!
//! Inputs occupy the first slots, constants the next ones. Results share the rest; a slot is reused after the last use
//! of its value. A product that is used only in one sum is computed by the sum's instruction, with the same rounding as
//! on its own.

use aim_symbolic::{Op, Program, Value};

/// A program ready to run in `f32`.
#[derive(Clone, Debug)]
pub(crate) struct Tape {
    inputs: usize,
    constants: Vec<f32>,
    instructions: Vec<Instruction>,
    outputs: Vec<u16>,
    slots: usize,
}

/// Writes the result of an operation on the values in slots `of` to slot `to`.
#[derive(Clone, Copy, Debug)]
struct Instruction {
    code: Code,
    to: u16,
    of: [u16; 4],
}

#[derive(Clone, Copy, Debug)]
enum Code {
    /// a + b
    Add,
    /// a − b
    Sub,
    /// a b
    Mul,
    /// a / b
    Div,
    /// −a
    Neg,
    /// √a
    Sqrt,
    /// c if a < b, otherwise d
    SelectLess,
    /// a b + c
    MulAdd,
    /// a b − c
    MulSub,
    /// c − a b
    SubMul,
    /// a b + c d
    MulAddMul,
    /// a b − c d
    MulSubMul,
}

/// Array sizes, in slots, for which code is generated. The smallest sufficient one is used. This is the smallest.
const FEW: usize = 128;
/// Middle array size, in slots.
const SOME: usize = 512;
/// Largest array size, in slots; more than a chain of 64 joints needs.
const MANY: usize = 4096;

impl Tape {
    /// Lays out a program.
    pub(crate) fn new(program: &Program) -> Self {
        Layout::new(program).tape()
    }

    /// Runs the program. The inputs are the concatenation of `inputs`. If a length is wrong, `out` is filled with
    /// zeros.
    pub(crate) fn run(&self, inputs: [&[f32]; 3], out: &mut [f32]) {
        let given: usize = inputs.iter().map(|part| part.len()).sum();
        if given != self.inputs || out.len() != self.outputs.len() {
            return out.fill(0.0);
        }
        match self.slots {
            slots if slots <= FEW => self.run_in::<FEW>(inputs, out),
            slots if slots <= SOME => self.run_in::<SOME>(inputs, out),
            slots if slots <= MANY => self.run_in::<MANY>(inputs, out),
            _ => out.fill(0.0),
        }
    }

    /// Runs the program in an array of `SLOTS` slots, a power of two, so that a masked index is always in bounds.
    fn run_in<const SLOTS: usize>(&self, inputs: [&[f32]; 3], out: &mut [f32]) {
        let place = |slot: u16| usize::from(slot) & (SLOTS - 1);
        let mut slots = [0.0f32; SLOTS];
        let mut next = 0;
        for part in inputs.into_iter().chain([&self.constants[..]]) {
            slots[next..next + part.len()].copy_from_slice(part);
            next += part.len();
        }
        for &Instruction { code, to, of } in &self.instructions {
            let at = |operand: usize| slots[place(of[operand])];
            let [a, b] = [at(0), at(1)];
            slots[place(to)] = match code {
                Code::Add => a + b,
                Code::Sub => a - b,
                Code::Mul => a * b,
                Code::Div => a / b,
                Code::Neg => -a,
                Code::Sqrt => a.sqrt(),
                Code::SelectLess => {
                    if a < b {
                        at(2)
                    } else {
                        at(3)
                    }
                }
                Code::MulAdd => a * b + at(2),
                Code::MulSub => a * b - at(2),
                Code::SubMul => at(2) - a * b,
                Code::MulAddMul => a * b + at(2) * at(3),
                Code::MulSubMul => a * b - at(2) * at(3),
            };
        }
        for (out, &slot) in out.iter_mut().zip(&self.outputs) {
            *out = slots[place(slot)];
        }
    }
}

/// A program being laid out.
struct Layout<'p> {
    program: &'p Program,
    /// Code and operands of each remaining operation; `None` for inputs, constants and products merged into another
    /// operation.
    planned: Vec<Option<(Code, Vec<Value>)>>,
    /// Slot of each value that has been assigned one.
    slots: Vec<u16>,
    /// Number of remaining uses of each value.
    uses: Vec<usize>,
    free: Vec<u16>,
    next: u16,
    constants: Vec<f32>,
}

impl<'p> Layout<'p> {
    fn new(program: &'p Program) -> Self {
        let ops = program.ops();
        let mut uses = vec![0; ops.len()];
        let used = ops.iter().flat_map(|op| op.operands()).chain(program.outputs().iter().copied());
        used.for_each(|value| uses[value.index()] += 1);
        let product = |value: Value| match ops[value.index()] {
            Op::Mul(a, b) if uses[value.index()] == 1 => Some((a, b)),
            _ => None,
        };
        let mut planned: Vec<Option<(Code, Vec<Value>)>> = Vec::with_capacity(ops.len());
        for &op in ops {
            // Products used only here are merged into this instruction.
            let (code, operands, parts) = match op {
                Op::Add(a, b) => match (product(a), product(b)) {
                    (Some((p, q)), Some((r, s))) => (Code::MulAddMul, vec![p, q, r, s], vec![a, b]),
                    (Some((p, q)), None) => (Code::MulAdd, vec![p, q, b], vec![a]),
                    (None, Some((p, q))) => (Code::MulAdd, vec![p, q, a], vec![b]),
                    (None, None) => (Code::Add, vec![a, b], vec![]),
                },
                Op::Sub(a, b) => match (product(a), product(b)) {
                    (Some((p, q)), Some((r, s))) => (Code::MulSubMul, vec![p, q, r, s], vec![a, b]),
                    (Some((p, q)), None) => (Code::MulSub, vec![p, q, b], vec![a]),
                    (None, Some((p, q))) => (Code::SubMul, vec![p, q, a], vec![b]),
                    (None, None) => (Code::Sub, vec![a, b], vec![]),
                },
                Op::Mul(a, b) => (Code::Mul, vec![a, b], vec![]),
                Op::Div(a, b) => (Code::Div, vec![a, b], vec![]),
                Op::Neg(a) => (Code::Neg, vec![a], vec![]),
                Op::Sqrt(a) => (Code::Sqrt, vec![a], vec![]),
                Op::SelectLess(a, b, c, d) => (Code::SelectLess, vec![a, b, c, d], vec![]),
                Op::Input(_) | Op::Constant(_) | Op::Tiny => {
                    planned.push(None);
                    continue;
                }
                Op::Call(..) | Op::Atan2(..) | Op::Pow(..) => {
                    unreachable!("no objective of a rig needs powers or functions of users")
                }
            };
            parts.into_iter().for_each(|part| planned[part.index()] = None);
            planned.push(Some((code, operands)));
        }
        let inputs = u16::try_from(program.inputs().len()).unwrap_or(u16::MAX);
        Self {
            program,
            planned,
            slots: vec![0; ops.len()],
            uses,
            free: Vec::new(),
            next: inputs,
            constants: Vec::new(),
        }
    }

    fn tape(mut self) -> Tape {
        let ops = self.program.ops();
        for (value, op) in ops.iter().enumerate() {
            let constant = match *op {
                Op::Input(i) => {
                    self.slots[value] = u16::try_from(i).unwrap_or(u16::MAX);
                    continue;
                }
                #[expect(clippy::cast_possible_truncation, reason = "the kernels of the trait compute in f32")]
                Op::Constant(c) => c.value() as f32,
                Op::Tiny => aim_runtime::Scalar::TINY,
                _ => continue,
            };
            self.constants.push(constant);
            self.slots[value] = self.next;
            self.next += 1;
        }
        let mut instructions = Vec::new();
        for (value, planned) in core::mem::take(&mut self.planned).into_iter().enumerate() {
            let Some((code, operands)) = planned else { continue };
            let mut of = [0; 4];
            for (of, operand) in of.iter_mut().zip(&operands) {
                *of = self.slots[operand.index()];
            }
            operands.iter().for_each(|&operand| self.release(operand));
            let to = self.free.pop().unwrap_or_else(|| {
                self.next += 1;
                self.next - 1
            });
            self.slots[value] = to;
            instructions.push(Instruction { code, to, of });
        }
        Tape {
            inputs: self.program.inputs().len(),
            outputs: self.program.outputs().iter().map(|output| self.slots[output.index()]).collect(),
            slots: self.next.into(),
            constants: self.constants,
            instructions,
        }
    }

    /// Counts one use of a value. After the last one its slot is free, unless it is that of an input or a constant.
    fn release(&mut self, value: Value) {
        self.uses[value.index()] -= 1;
        let is_result = !matches!(self.program.ops()[value.index()], Op::Input(_) | Op::Constant(_) | Op::Tiny);
        if self.uses[value.index()] == 0 && is_result {
            self.free.push(self.slots[value.index()]);
        }
    }
}

#[cfg(test)]
mod tests {
    use aim_codegen::objective::{FirstLink, OBJECTIVES};

    use super::*;

    #[test]
    fn tapes_give_the_bits_of_the_program() {
        let spec = aim_codegen::declare::from_toml("mannequin.toml", crate::MANNEQUIN_RIG).expect("it is right");
        for kernel in OBJECTIVES.iter().flat_map(|objective| objective.kernels(&spec, FirstLink::Given)) {
            let tape = Tape::new(&kernel.program);
            assert!(tape.slots <= FEW, "{}: {} slots", kernel.objective.name, tape.slots);
            for seed in 1..200u16 {
                let inputs: Vec<f32> =
                    (0..tape.inputs).map(|i| (f32::from(seed) * 1.7 + i as f32 * 0.91).sin() * 2.0).collect();
                let mut expected = vec![0.0; tape.outputs.len()];
                kernel.program.run(&inputs, &mut expected);
                let mut found = vec![7.0; tape.outputs.len()];
                let (first, rest) = inputs.split_at(inputs.len() / 2);
                tape.run([first, rest, &[]], &mut found);
                let bits = |numbers: &[f32]| numbers.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
                assert_eq!(bits(&found), bits(&expected), "{}", kernel.objective.name);
            }
        }
    }
}
