//! Emitted WGSL, parsed and validated by naga, an independent implementation, and run in `f32` from naga's
//! representation.
//!
//! The parsed module is evaluated operation by operation. Only straight-line functions from numbers to an array of
//! numbers are supported.

use std::borrow::Cow;

use aim_symbolic::Count;
use naga::valid::{Capabilities, ValidationFlags, Validator};
use naga::{ArraySize, BinaryOperator, Expression, Handle, Literal, MathFunction, Statement, TypeInner, UnaryOperator};

/// A valid WGSL module.
#[derive(Debug)]
pub struct Module(naga::Module);

impl Module {
    /// Parses and validates a module.
    ///
    /// # Panics
    /// Panics with the compiler's message if `source` is not valid WGSL.
    pub fn read(source: &str) -> Self {
        let module = naga::front::wgsl::parse_str(source).unwrap_or_else(|error| {
            panic!("{}", error.emit_to_string(source));
        });
        // No capabilities: the module must not need anything that a device may lack.
        Validator::new(ValidationFlags::all(), Capabilities::default()).validate(&module).unwrap_or_else(|error| {
            panic!("{}", error.emit_to_string(source));
        });
        Self(module)
    }

    /// Returns the functions' names, in the order of the source.
    pub fn names(&self) -> Vec<&str> {
        self.0.functions.iter().filter_map(|(_, function)| function.name.as_deref()).collect()
    }

    /// Returns the function with this name.
    ///
    /// # Panics
    /// Panics if there is none.
    pub fn function(&self, name: &str) -> Function<'_> {
        let mut functions = self.0.functions.iter().map(|(_, function)| function);
        let function = functions.find(|function| function.name.as_deref() == Some(name));
        Function { module: &self.0, function: function.unwrap_or_else(|| panic!("there is no function {name}")) }
    }
}

/// A function of a [`Module`].
#[derive(Clone, Copy, Debug)]
pub struct Function<'m> {
    module: &'m naga::Module,
    function: &'m naga::Function,
}

/// Value of an expression.
#[derive(Clone, Debug)]
enum Value<'i> {
    Number(f32),
    Truth(bool),
    Numbers(Cow<'i, [f32]>),
}

impl Function<'_> {
    /// Counts the operations that the function performs.
    ///
    /// # Panics
    /// Panics if the function is not straight-line code.
    pub fn count(&self) -> Count {
        let mut count = Count::default();
        for expression in self.evaluated() {
            match self.function.expressions[expression] {
                Expression::Binary { op, .. } => match op {
                    BinaryOperator::Add | BinaryOperator::Subtract => count.add += 1,
                    BinaryOperator::Multiply => count.mul += 1,
                    BinaryOperator::Divide => count.div += 1,
                    BinaryOperator::Less => count.select += 1,
                    _ => panic!("no operation of a kernel: {op:?}"),
                },
                Expression::Select { .. } => count.select += 1,
                Expression::Math { fun: MathFunction::Sqrt, .. } => count.sqrt += 1,
                Expression::Unary { op: UnaryOperator::Negate, .. }
                | Expression::AccessIndex { .. }
                | Expression::Compose { .. } => {}
                ref other => panic!("a kernel is a straight line, without {other:?}"),
            }
        }
        count
    }

    /// Runs the function. Its parameters, numbers or arrays of numbers, are filled from `inputs` in order; the result
    /// is the array that it returns.
    ///
    /// # Panics
    /// Panics if the number of inputs differs, or if the function is not straight-line code.
    pub fn run(&self, inputs: &[f32]) -> Vec<f32> {
        let arguments = self.arguments(inputs);
        let mut values: Vec<Option<Value<'_>>> = vec![None; self.function.expressions.len()];
        for (handle, expression) in self.function.expressions.iter() {
            values[handle.index()] = match *expression {
                Expression::Literal(Literal::F32(number)) => Some(Value::Number(number)),
                Expression::FunctionArgument(i) => Some(arguments[i as usize].clone()),
                _ => None,
            };
        }
        for handle in self.evaluated() {
            values[handle.index()] = Some(evaluate(&self.function.expressions[handle], &values));
        }
        let Some(Value::Numbers(result)) = &values[self.returned().index()] else { panic!("the result is no array") };
        result.to_vec()
    }

    /// Returns the parameters' values.
    fn arguments<'i>(&self, inputs: &'i [f32]) -> Vec<Value<'i>> {
        let mut rest = inputs;
        let mut take = |n: usize| {
            let (taken, left) = rest.split_at_checked(n).unwrap_or_else(|| panic!("{} inputs are few", inputs.len()));
            rest = left;
            taken
        };
        let arguments = self.function.arguments.iter().map(|argument| match self.module.types[argument.ty].inner {
            TypeInner::Scalar(naga::Scalar::F32) => Value::Number(take(1)[0]),
            TypeInner::Array { size: ArraySize::Constant(n), .. } => {
                Value::Numbers(Cow::Borrowed(take(n.get() as usize)))
            }
            ref other => panic!("a kernel takes numbers and arrays, not {other:?}"),
        });
        let arguments = arguments.collect();
        assert!(rest.is_empty(), "{} inputs are left over", rest.len());
        arguments
    }

    /// Returns the expressions that are evaluated before the function returns, in order.
    fn evaluated(&self) -> impl Iterator<Item = Handle<Expression>> {
        self.function.body.iter().flat_map(|statement| match statement {
            Statement::Emit(range) => Some(range.clone()).into_iter().flatten(),
            Statement::Return { .. } => None.into_iter().flatten(),
            other => panic!("a kernel computes and returns, it does not {other:?}"),
        })
    }

    fn returned(&self) -> Handle<Expression> {
        match self.function.body.last() {
            Some(Statement::Return { value: Some(value) }) => *value,
            other => panic!("a kernel ends with its result, not with {other:?}"),
        }
    }
}

fn evaluate<'i>(expression: &Expression, values: &[Option<Value<'i>>]) -> Value<'i> {
    let value = |handle: Handle<Expression>| {
        values[handle.index()].as_ref().unwrap_or_else(|| panic!("{handle:?} is used before it is evaluated"))
    };
    let number = |handle: Handle<Expression>| match value(handle) {
        Value::Number(number) => *number,
        other => panic!("{other:?} is no number"),
    };
    match *expression {
        Expression::AccessIndex { base, index } => match value(base) {
            Value::Numbers(numbers) => Value::Number(numbers[index as usize]),
            other => panic!("{other:?} is no array"),
        },
        Expression::Unary { op: UnaryOperator::Negate, expr } => Value::Number(-number(expr)),
        Expression::Binary { op: BinaryOperator::And, left, right } => {
            Value::Truth(matches!((value(left), value(right)), (Value::Truth(true), Value::Truth(true))))
        }
        Expression::Binary { op, left, right } => {
            let (left, right) = (number(left), number(right));
            match op {
                BinaryOperator::Add => Value::Number(left + right),
                BinaryOperator::Subtract => Value::Number(left - right),
                BinaryOperator::Multiply => Value::Number(left * right),
                BinaryOperator::Divide => Value::Number(left / right),
                BinaryOperator::Modulo => Value::Number(left % right),
                BinaryOperator::Less => Value::Truth(left < right),
                BinaryOperator::Equal => Value::Truth(left == right),
                _ => panic!("no operation of a kernel: {op:?}"),
            }
        }
        Expression::Math { fun: MathFunction::Atan2, arg, arg1: Some(x), .. } => {
            Value::Number(number(arg).atan2(number(x)))
        }
        // WGSL defines `pow` by exp2 and log2: a negative base gives NaN.
        Expression::Math { fun: MathFunction::Pow, arg, arg1: Some(exponent), .. } => {
            Value::Number((number(exponent) * number(arg).log2()).exp2())
        }
        Expression::Math { fun, arg, .. } => Value::Number(match fun {
            MathFunction::Sqrt => number(arg).sqrt(),
            MathFunction::Sin => number(arg).sin(),
            MathFunction::Cos => number(arg).cos(),
            MathFunction::Exp => number(arg).exp(),
            MathFunction::Log => number(arg).ln(),
            MathFunction::Abs => number(arg).abs(),
            MathFunction::Floor => number(arg).floor(),
            _ => panic!("no function of a kernel: {fun:?}"),
        }),
        Expression::Select { condition, accept, reject } => match value(condition) {
            Value::Truth(true) => value(accept).clone(),
            Value::Truth(false) => value(reject).clone(),
            other => panic!("{other:?} is no condition"),
        },
        Expression::Compose { ref components, .. } => {
            Value::Numbers(components.iter().map(|&component| number(component)).collect())
        }
        ref other => panic!("a kernel is a straight line, without {other:?}"),
    }
}
