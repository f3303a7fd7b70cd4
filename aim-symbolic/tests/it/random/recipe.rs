//! Random statements as recipes that can shrink: steps become existing expressions, and parts become simpler ones.

use std::fmt;

use aim_symbolic::{Rotation, RotationNode, Scalar};
use fastrand::Rng;
use proptest::prelude::RngCore;
use proptest::strategy::{NewTree, Strategy, ValueTree};
use proptest::test_runner::TestRunner;

use super::material::Pools;
use super::plain;
use super::steps::{PARTS, PoolKind, Step, StepKind, WEIGHTS};

/// Recipe for building a statement.
#[derive(Clone, PartialEq, Eq)]
pub(crate) struct Recipe {
    steps: Vec<Step>,
    /// Indices into the pool of scalars.
    outputs: Vec<u16>,
    /// Seed for everything else: the points of evaluation, and the variables of derivatives.
    pub(crate) seed: u64,
}

/// Statement built from a recipe.
pub(crate) struct BuiltStatement {
    pub(crate) pools: Pools,
    pub(crate) outputs: Vec<Scalar>,
}

thread_local! {
    /// Initial pools of all recipes.
    static START: Pools = Pools::new();
}

/// Number of expressions in each pool.
#[derive(Clone, Copy)]
struct PoolSizes([u16; 5]);

impl PoolSizes {
    fn start() -> Self {
        START.with(|pools| {
            let sizes = [
                pools.scalars.len(),
                pools.vectors.len(),
                pools.units.len(),
                pools.rotations.len(),
                pools.angles.len(),
            ];
            Self(sizes.map(|size| size.try_into().expect("a few")))
        })
    }

    fn of(&mut self, pool: PoolKind) -> &mut u16 {
        &mut self.0[pool as usize]
    }
}

impl Recipe {
    fn random(seed: u64, most: usize) -> Self {
        let mut random = Rng::with_seed(seed);
        let mut sizes = PoolSizes::start();
        let total =
            |allowed: &dyn Fn(StepKind) -> bool| WEIGHTS.iter().filter(|(w, _)| allowed(*w)).map(|(_, n)| n).sum();
        let [all, numbers]: [u32; 2] = [total(&|_| true), total(&is_result)];
        let count = random.usize(1..=most);
        let steps = (0..count)
            .map(|i| {
                // The last step makes a scalar from what exists.
                let last = i + 1 == count;
                let mut left = random.u32(..if last { numbers } else { all });
                let mut kinds = WEIGHTS.iter().filter(|(kind, _)| !last || is_result(*kind));
                let kind = loop {
                    let &(kind, weight) = kinds.next().expect("the weights add up");
                    match left.checked_sub(weight) {
                        Some(rest) => left = rest,
                        None => break kind,
                    }
                };
                let mut parts = [0; PARTS];
                for (part, &pool) in parts.iter_mut().zip(kind.parts()) {
                    let size = *sizes.of(pool);
                    // Recent results are most likely used, but anything may be.
                    *part = if random.bool() { random.u16(..size) } else { size - 1 - random.u16(..size.min(3)) };
                }
                *sizes.of(kind.pool()) += 1;
                Step { kind, parts, number: random.u8(..) }
            })
            .collect();
        let last = *sizes.of(PoolKind::Scalar) - 1;
        let mut outputs = vec![last];
        if random.u8(..4) == 0 {
            outputs.push(last - random.u16(..last.min(4)));
        }
        Self { steps, outputs, seed }
    }

    /// Builds the statement.
    pub(crate) fn build(&self) -> BuiltStatement {
        let mut pools = START.with(Pools::clone);
        for &step in &self.steps {
            pools.apply(step);
        }
        let turns =
            |r: &Rotation| !matches!(pools.g.rotation_node(*r), RotationNode::Transpose(_) | RotationNode::Basis(_));
        let inner_frames: Vec<Rotation> = pools.rotations.iter().copied().filter(turns).collect();
        pools.g.set_inner_frames(&inner_frames);
        let outputs = self.outputs.iter().map(|&place| pools.scalars[usize::from(place)]).collect();
        BuiltStatement { pools, outputs }
    }

    /// Returns the recipe's size. Simpler recipes have a smaller one.
    fn size(&self) -> (usize, usize, usize) {
        let steps = self.steps.iter().filter(|step| !matches!(step.kind, StepKind::Same(_))).count();
        let parts = self.steps.iter().flat_map(|s| s.parts.iter().map(|&p| usize::from(p)).chain([s.number.into()]));
        (self.outputs.len(), steps, parts.sum())
    }

    /// Returns recipes that are one change simpler.
    fn simpler(&self) -> Vec<Self> {
        let mut found = Vec::new();
        for (place, _) in self.outputs.iter().enumerate().filter(|_| self.outputs.len() > 1) {
            let mut fewer = self.clone();
            fewer.outputs.remove(place);
            found.push(fewer);
        }
        let mut sizes = PoolSizes::start();
        let starts = sizes;
        for (i, step) in self.steps.iter().enumerate() {
            let mut with = |step| {
                let mut changed = self.clone();
                changed.steps[i] = step;
                found.push(changed);
            };
            let pool = step.kind.pool();
            let same = |place| Step { kind: StepKind::Same(pool), parts: [place, 0, 0, 0, 0], number: 0 };
            let operands = step.kind.parts().iter().zip(step.parts).filter(|(part, _)| **part == pool);
            if !matches!(step.kind, StepKind::Same(_)) {
                operands.for_each(|(_, place)| with(same(place)));
            }
            (0..*starts.clone().of(pool)).for_each(|place| with(same(place)));
            for (part, &pool) in step.kind.parts().iter().enumerate() {
                for place in (0..step.parts[part]).filter(|&place| place < *starts.clone().of(pool)) {
                    let mut parts = step.parts;
                    parts[part] = place;
                    with(Step { parts, ..*step });
                }
            }
            (0..step.number.min(12)).for_each(|number| with(Step { number, ..*step }));
            *sizes.of(pool) += 1;
        }
        found.retain(|simpler| simpler.size() < self.size());
        found
    }
}

fn is_result(kind: StepKind) -> bool {
    kind.pool() == PoolKind::Scalar && !kind.parts().is_empty()
}

impl fmt::Debug for Recipe {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let stated = self.build();
        let texts: Vec<String> = stated.outputs.iter().map(|&s| plain::scalar(&stated.pools.g, s)).collect();
        write!(f, "{}", texts.join(" ; "))
    }
}

/// Strategy for recipes of at most `most` steps.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Recipes {
    pub(crate) most: usize,
}

/// A recipe and its candidates for shrinking.
pub(crate) struct RecipeTree {
    best: Recipe,
    current: Recipe,
    candidates: std::vec::IntoIter<Recipe>,
}

impl Strategy for Recipes {
    type Tree = RecipeTree;
    type Value = Recipe;

    fn new_tree(&self, runner: &mut TestRunner) -> NewTree<Self> {
        let recipe = Recipe::random(runner.rng().next_u64(), self.most);
        Ok(RecipeTree { best: recipe.clone(), current: recipe, candidates: Vec::new().into_iter() })
    }
}

impl ValueTree for RecipeTree {
    type Value = Recipe;

    fn current(&self) -> Recipe {
        self.current.clone()
    }

    /// The current recipe fails: try simpler ones.
    fn simplify(&mut self) -> bool {
        self.best = self.current.clone();
        self.candidates = self.best.simpler().into_iter();
        self.complicate()
    }

    /// The current recipe passes: try another one that is simpler than the best failing one.
    fn complicate(&mut self) -> bool {
        let next = self.candidates.next();
        let found = next.is_some();
        self.current = next.unwrap_or_else(|| self.best.clone());
        found
    }
}
