//! Whole derivations: a program's values and first and second derivatives agree with dual numbers, it is no larger than
//! without the rules, and the same statement always leads to the same program.

use std::cell::Cell;

use aim_symbolic::rules::{ARITHMETIC, Rule};
use aim_symbolic::{Bindings, Graph, InputKind, Program, ScalarNode, Variable, Want, print};
use fastrand::Rng;

use super::bounded::Bounded;
use super::counts::Comparison;
use super::dual::{Dual, Oracle};
use super::evaluate::Evaluation;
use super::field::Field;
use super::judge::{JudgedCount, Verdict, anywhere, for_each, regular, same, single_rules, times};
use super::material::moving;
use super::plain;
use super::recipe::{BuiltStatement, Recipe};

/// Returns random wanted outputs: values, their derivatives by one to three variables, or second derivatives.
pub(crate) fn wanted(stated: &BuiltStatement, random: &mut Rng) -> Vec<Want> {
    let mut variables = stated.pools.variables.clone();
    random.shuffle(&mut variables);
    let is_step = |v: &Variable| match v {
        Variable::Input(s) => matches!(stated.pools.g.scalar_node(*s), ScalarNode::Step(_)),
        _ => false,
    };
    // Most statements depend on angles or steps.
    match random.u8(..4) {
        0 => variables.sort_by_key(|v| !is_step(v)),
        1 | 2 => variables.sort_by_key(|v| matches!(v, Variable::Input(_))),
        _ => {}
    }
    let by_steps = is_step(&variables[0]);
    variables.truncate(random.usize(1..=3));
    let mut wanted: Vec<Want> = stated.outputs.iter().map(|&s| Want::Value(s)).collect();
    for &s in &stated.outputs {
        wanted.extend(variables.iter().map(|&x| Want::Derivative(s, x)));
    }
    if random.u8(..3) == 0 {
        wanted.extend(variables.iter().map(|&x| Want::Projected(x)));
        wanted.extend(variables.iter().map(|&y| Want::Normal(variables[0], y)));
    }
    // The order of two steps matters to second order.
    if by_steps || random.u8(..3) == 0 {
        let s = stated.outputs[0];
        wanted.extend(variables.iter().map(|&y| Want::Second(s, variables[0], y)));
    }
    wanted
}

/// Returns the result by dual numbers; `None` for second derivatives through something that is treated as constant but
/// is not.
fn expected<T: Oracle>(stated: &BuiltStatement, inputs: &[T], want: Want) -> Option<T> {
    let g = &stated.pools.g;
    match want {
        Want::Value(s) => Some(Evaluation::new(inputs.to_vec()).scalar(g, s)),
        Want::Derivative(s, x) => Some(Evaluation::new(moving(g, inputs, x)).scalar(g, s).slope),
        Want::Projected(_) | Want::Normal(..) => {
            let of = |s, x| Evaluation::new(moving(g, inputs, x)).scalar(g, s);
            let product = |s| match want {
                Want::Normal(x, y) => of(s, x).slope * of(s, y).slope,
                Want::Projected(x) => of(s, x).slope * Evaluation::new(inputs.to_vec()).scalar(g, s),
                _ => unreachable!("the others are of one value"),
            };
            let mut once = stated.outputs.clone();
            once.sort_unstable();
            once.dedup();
            Some(once.into_iter().map(product).fold(T::constant(0.0), |sum, product| sum + product))
        }
        Want::Second(s, x, y) => {
            let mut evaluation: Evaluation<Dual<Dual<T>>> = Evaluation::new(moving(g, &moving(g, inputs, x), y));
            let value = evaluation.scalar(g, s);
            (!evaluation.frozen).then_some(value.slope.slope)
        }
    }
}

/// Checks that the program agrees with dual numbers.
fn agree(stated: &BuiltStatement, inputs: &[Field], wanted: &[Want], program: &Program, what: &str) -> Verdict {
    let mut results = vec![Field::ZERO; wanted.len()];
    program.run(inputs, &mut results);
    for (&want, result) in wanted.iter().zip(results) {
        if let Some(value) = expected(stated, inputs, want) {
            same(value, result, &format!("{what}: {want:?}"))?;
        }
    }
    Ok(())
}

/// Number of statements that are compared with derivations without rules, times [`times`].
const COMPARED: u64 = 3_400;

/// Derives each statement once and runs all checks on that program; the derivation dominates the cost.
#[test]
fn derived_programs_are_correct_small_and_deterministic() {
    let (exact, rounded, comparison) = (JudgedCount::default(), JudgedCount::default(), Comparison::default());
    let compared = Cell::new(0);
    for_each(10_000, 8, |recipe| {
        let stated = recipe.build();
        let wanted = wanted(&stated, &mut Rng::with_seed(recipe.seed));
        let program = Program::derive_wanted(&stated.pools.g, &wanted);
        match regular(&stated, recipe.seed) {
            Some(regular) => {
                exact.judge();
                let inputs = regular.evaluation.inputs();
                match regular.without() {
                    [] => agree(&stated, inputs, &wanted, &program, "derived")?,
                    off => {
                        let program = Program::derive_without(&stated.pools.g, &wanted, off);
                        agree(&stated, inputs, &wanted, &program, "derived without rules of lengths")?;
                    }
                }
            }
            None => exact.discard()?,
        }
        if !recipe.seed.is_multiple_of(3) {
            agree_within_rounding(recipe, &stated, &wanted, &program, &rounded)?;
        }
        if compared.get() < COMPARED * times() {
            compared.set(compared.get() + 1);
            comparison.is_no_larger(&stated, &wanted, &program)?;
        }
        if recipe.seed.is_multiple_of(6) { derives_again(recipe, &wanted, &program) } else { Ok(()) }
    });
    exact.assert_few_discards();
    rounded.assert_few_discards();
    comparison.print();
}

#[test]
fn programs_derived_without_some_rules_are_correct() {
    let all: Vec<Rule> = single_rules().iter().map(|(_, rule, _)| *rule).chain(ARITHMETIC).collect();
    let (tally, turn) = (JudgedCount::default(), Cell::new(0));
    for_each(4_000, 8, |recipe| {
        let stated = recipe.build();
        let Some(regular) = regular(&stated, recipe.seed) else { return tally.discard() };
        tally.judge();
        let mut random = Rng::with_seed(recipe.seed);
        let wanted = wanted(&stated, &mut random);
        // Omit every rule in turn, and sometimes others with it.
        let mut without = vec![all[turn.replace(turn.get() + 1) % all.len()]];
        if random.u8(..4) == 0 {
            without.extend((0..4).map(|_| all[random.usize(..all.len())]));
        }
        without.extend(regular.without());
        let program = Program::derive_without(&stated.pools.g, &wanted, &without);
        agree(&stated, regular.evaluation.inputs(), &wanted, &program, &format!("without {without:?}"))
    });
    tally.assert_few_discards();
}

/// Returns the point in the form that the library's evaluation takes.
fn bindings(g: &Graph, inputs: &[Bounded]) -> Bindings {
    let given = g.inputs().iter().zip(inputs).filter(|((_, kind), _)| *kind == InputKind::Given);
    let given: Vec<f64> = given.map(|(_, x)| x.value).collect();
    let mut inputs = g.inputs().iter().zip(inputs);
    let mut angles = Vec::new();
    while let Some(((_, kind), sin)) = inputs.next() {
        if let (InputKind::Sin(angle), Some((_, cos))) = (*kind, inputs.clone().next()) {
            angles.push((angle, sin.value.atan2(cos.value)));
        }
    }
    Bindings::new(g, &given, &angles)
}

fn agree_within_rounding(
    recipe: &Recipe,
    stated: &BuiltStatement,
    wanted: &[Want],
    program: &Program,
    tally: &JudgedCount,
) -> Verdict {
    let mut evaluation: Evaluation<Bounded> = anywhere(recipe.seed);
    let known = stated.outputs.iter().all(|&s| evaluation.scalar(&stated.pools.g, s).is_known());
    if !known || evaluation.singular {
        return tally.discard();
    }
    // The library's own evaluation, from angles.
    let bindings = bindings(&stated.pools.g, evaluation.inputs());
    for &s in &stated.outputs {
        let (value, found) = (evaluation.scalar(&stated.pools.g, s), stated.pools.g.evaluate(s, &bindings));
        if !value.meets(Bounded { value: found, error: value.error }) {
            return Err(format!("evaluated to {found} instead of {value:?}"));
        }
    }
    let mut results = vec![Bounded::exact(0.0); wanted.len()];
    program.run(evaluation.inputs(), &mut results);
    for (&want, result) in wanted.iter().zip(results) {
        let Some(value) = expected(stated, evaluation.inputs(), want) else { continue };
        if !value.meets(result) {
            return Err(format!("{want:?}: {result:?} instead of {value:?}"));
        }
        tally.judge();
    }
    Ok(())
}

/// Checks that building and deriving the same statement again gives the same program and the same text.
fn derives_again(recipe: &Recipe, wanted: &[Want], program: &Program) -> Verdict {
    let again = Program::derive_wanted(&recipe.build().pools.g, wanted);
    let prints: [fn(&Program) -> String; 3] = [plain::program, plain::latex, |p| print::maxima("f", p)];
    if *program != again || prints.iter().any(|print| print(program) != print(&again)) {
        return Err(format!("{}\nand\n{}", plain::program(program), plain::program(&again)));
    }
    Ok(())
}
