//! The rules that rewrite a statement: each keeps the value, none is keyed to a particular objective.
//!
//! One exception is stated where it is: the length of a cross product with a direction, where that is 0.
//!
//! A rule looks at one node whose parts are already rewritten and offers a replacement. [`Graph::rewrite`] applies
//! them in the order of their set, bottom up, until none applies.

use core::fmt;

use crate::ir::node::Node;
use crate::rewrite::{bases, directions, frames, gathered, homogeneous, limits, rotations, scaling, sums};
use crate::{Graph, Scalar, Vector};

/// A rewriting of expressions that keeps their value. Rules are compared by name.
#[derive(Clone, Copy, Debug)]
pub struct Rule {
    /// The name that derivations list it by; its constant's in programs that are compiled to be small.
    pub name: &'static str,
    /// The reason why it holds and what it is good for, in a sentence or two; empty in programs that are compiled to be small.
    pub why: &'static str,
    rewriting: Rewriting,
}

/// The expressions that a rule rewrites.
#[derive(Clone, Copy, Debug)]
enum Rewriting {
    Vector(fn(&mut Graph, Vector) -> Option<Vector>),
    Scalar(fn(&mut Graph, Scalar) -> Option<Scalar>),
    /// Components: part of folding and arranging them, not applied node by node.
    Components,
}

impl PartialEq for Rule {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

impl Eq for Rule {}

impl fmt::Display for Rule {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name)
    }
}

impl Rule {
    /// The replacement of `node`, if the rule has one for it.
    pub(crate) fn apply(&self, g: &mut Graph, node: Node) -> Option<Node> {
        match (self.rewriting, node) {
            (Rewriting::Vector(rewrite), Node::Vector(v)) => rewrite(g, v).map(Node::Vector),
            (Rewriting::Scalar(rewrite), Node::Scalar(s)) => rewrite(g, s).map(Node::Scalar),
            _ => None,
        }
    }
}

/// Rules applied together, the first that fits first.
#[derive(Clone, Copy, Debug)]
pub struct RuleSet {
    /// The rules in order.
    pub rules: &'static [Rule],
    /// The terms that they see in a sum.
    pub sums: Sums,
}

/// The terms of a sum as the rules see them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sums {
    /// Also the terms of its partial sums.
    Open,
    /// A partial sum that is needed elsewhere too is one term, so that it stays shared.
    Shared,
}

/// The rules that apply: all of them but a few.
#[derive(Clone, Copy, Debug, Default)]
pub struct Rules<'a> {
    /// Those switched off.
    pub without: &'a [Rule],
    /// How often a rotation may go to the other side of a dot or norm without cancelling there; `None` for wherever it can.
    pub turned: Option<usize>,
}

impl Rules<'_> {
    /// Whether the rule applies.
    #[must_use]
    pub fn has(&self, rule: &Rule) -> bool {
        !self.without.contains(rule)
    }
}

/// The rules of all sets but [`LIMITS`], each once, in the order of the passes that they belong to.
pub(crate) fn of_sets() -> Vec<Rule> {
    let mut all: Vec<Rule> = Vec::new();
    for rule in
        [WORDING, RATIOS, ROTATIONS, BASES, DIRECTIONS, FRAMES, SCALES, PRODUCTS].iter().flat_map(|set| set.rules)
    {
        if !all.contains(rule) {
            all.push(*rule);
        }
    }
    all
}

/// All rules, those of arithmetic last.
#[must_use]
pub fn all() -> Vec<Rule> {
    LIMITS.rules.iter().copied().chain(of_sets()).chain(ARITHMETIC).collect()
}

/// Quotients that are 0 / 0 somewhere, stated by their limits. They come first and are never left out for the count: without
/// them derivatives are wrong there. A module for the web derives rigs alone, of which nothing cancels.
pub const LIMITS: RuleSet =
    RuleSet { rules: if cfg!(aim_small) { &[] } else { &[CANCELLED_DIVISION, CANCELLED_SCALE] }, sums: Sums::Open };

/// Statement in other words: norms and directions spelled out.
pub const WORDING: RuleSet = RuleSet {
    rules: &[
        RECOGNIZE_DIRECTION,
        ROOT_OF_SQUARE,
        SQUARE_OF_NORM,
        GUARD_DIVISION,
        ACROSS_FOR_CROSS,
        RECOGNIZE_ACROSS,
        LENGTH_OF_DIRECTION,
        RECOGNIZE_TURN,
        RECOGNIZE_PLANE_TURN,
    ],
    sums: Sums::Open,
};

/// Angles and directions, which depend on ratios alone, without the lengths that cancel. A module for the web derives rigs alone, of
/// which nothing is scaled.
pub const RATIOS: RuleSet =
    RuleSet { rules: if cfg!(aim_small) { &[] } else { &[ANGLE_OF_SCALED, DIRECTION_OF_SCALED] }, sums: Sums::Open };

/// Rotations to where they cancel, or to the side where they cost least.
pub const ROTATIONS: RuleSet = RuleSet {
    rules: &[
        FOLD_ZERO,
        SPLIT_COMPOSITION,
        UNDO_ROTATION,
        CANCEL_TERMS,
        COMMON_ROTATION,
        OPERATION_ON_ROTATED,
        NORM_OF_ROTATED,
        PULL_OUT_OF_NORM,
        PULL_OUT_OF_SQUARE,
        CANCEL_BESIDE_DIRECTION,
        CANCEL_ACROSS_DOT,
        OTHER_SIDE_OF_DOT,
    ],
    sums: Sums::Open,
};

/// Compositions into the rotations that they are made of, as both sweeps need them.
pub(crate) const COMPOSITIONS: RuleSet = RuleSet { rules: &[SPLIT_COMPOSITION], sums: Sums::Open };

/// Constant turns into the angles of turns that they stand beside.
pub const BASES: RuleSet = RuleSet { rules: &[TURN_INTO_ANGLE], sums: Sums::Open };

/// A calculation in the frame before a turn that many vectors were turned back by.
pub const FRAMES: RuleSet =
    RuleSet { rules: &[FOLD_ZERO, UNDO_ROTATION, SUM_IN_FRAME, OPERATION_IN_FRAME, NUMBER_IN_FRAME], sums: Sums::Open };

/// Parts along a direction or square to it, and what follows for sums and dots.
pub const DIRECTIONS: RuleSet = RuleSet {
    rules: &[
        FOLD_ZERO,
        MERGE_SCALES,
        SCALE_AFTER_OPERATION,
        ALL_ACROSS,
        ACROSS_OF_SUM,
        SCALE_AFTER_DOT,
        SIGN_AFTER_DOT,
        DROP_RADIAL,
        CROSS_OF_CROSS,
    ],
    sums: Sums::Open,
};

/// Scale factors out of the vector operations that they pass through unchanged.
pub const SCALES: RuleSet = RuleSet {
    rules: &[
        FOLD_ZERO,
        UNDO_ROTATION,
        EXPAND_NORMALIZE,
        MERGE_SCALES,
        MERGE_SHARED,
        SCALE_AFTER_OPERATION,
        EXPAND_ACROSS,
        SPREAD,
        CONSTANT_SCALE,
        SCALE_AFTER_DOT,
        SIGN_AFTER_DOT,
    ],
    sums: Sums::Shared,
};

/// Products with one vector out of the sums that they are in. A module for the web derives rigs alone, which have none.
pub const PRODUCTS: RuleSet = RuleSet {
    rules: if cfg!(aim_small) { &[] } else { &[LINEAR_MAP, CROSS_OF_DOTS, COMMON_CROSS, COMMON_DOT] },
    sums: Sums::Shared,
};

/// Rules of components: what any compiler of formulas does, all at once.
pub const ARITHMETIC: [Rule; 10] =
    [CONSTANTS, NEGATIONS, ORDER, SHARE, FACTOR, JOIN, MOVE_CONSTANTS, DIVIDE_ONCE, MATRIX, RESUBSTITUTE];

/// Rules that apply only where that is found to pay.
pub(crate) const OPTIONAL: &[Rule] = if cfg!(aim_small) {
    &[TURN_INTO_ANGLE, SPREAD, CONSTANT_SCALE, MATRIX]
} else {
    &[TURN_INTO_ANGLE, SPREAD, CONSTANT_SCALE, LINEAR_MAP, CROSS_OF_DOTS, COMMON_CROSS, COMMON_DOT, MATRIX]
};

/// Rules that turn something else than before by as much: how far to go is a choice.
pub(crate) const OTHER_SIDES: [Rule; 3] = [OTHER_SIDE_OF_DOT, PULL_OUT_OF_NORM, PULL_OUT_OF_SQUARE];

/// Rules by which rotations vanish.
pub(crate) const CANCELLING: [Rule; 2] = [CANCEL_BESIDE_DIRECTION, CANCEL_ACROSS_DOT];

/// Defines rules; a rule's comment is its [`why`](Rule::why), for the readers of code and of derivations alike.
macro_rules! rules {
    ($( $(#[doc = $why:literal])+ $rule:ident = $name:literal: $kind:ident $(($rewrite:path))?; )+) => { $(
        $(#[doc = $why])+
        pub const $rule: Rule = Rule {
            name: if cfg!(aim_small) { stringify!($rule) } else { $name },
            why: if cfg!(aim_small) { "" } else { concat!($($why),+).trim_ascii_start() },
            rewriting: Rewriting::$kind $(($rewrite))?,
        };
    )+ };
}

rules! {
    /// What is multiplied and divided by the same cancels, also where that is 0: a length that is divided by itself is 1. Of
    /// sin r = r (1 − r²/6 + …) and its like the power of r cancels, and a series in r² is left where r is small.
    CANCELLED_DIVISION = "what is divided by itself is one": Scalar(limits::cancelled_division);
    /// A vector's direction times a multiple of its length is a multiple of the vector: |v| (v / |v|) = v, also where v is 0.
    CANCELLED_SCALE = "a length times a direction is a vector": Vector(limits::cancelled_scale);
    /// A vector times one over its own length is its direction: one thing, with one derivative.
    RECOGNIZE_DIRECTION = "a vector over its length is a direction": Vector(directions::recognize_direction);
    /// The square of a vector is the dot product with itself, so its root is the vector's length.
    ROOT_OF_SQUARE = "the root of a square is a norm": Scalar(directions::root_of_square);
    /// A length times itself is the dot product of the vector with itself: no root is needed, nor its derivative.
    SQUARE_OF_NORM = "the square of a norm is a dot": Scalar(directions::square_of_norm);
    /// A length can be 0. The division becomes a product with a reciprocal that is 0 there, so that every result is
    /// finite.
    GUARD_DIVISION = "a division by a norm is guarded": Scalar(directions::guard_division);
    /// Both have the length |v| sin of the angle between them. The part across has the simpler derivative.
    ACROSS_FOR_CROSS = "the part across is as long as the cross product": Scalar(directions::norm_of_cross);
    /// What is left of a vector without its part along a direction is the part across it: one thing, square to the direction.
    RECOGNIZE_ACROSS = "a difference is a part across": Vector(directions::recognize_across);
    /// The length of a direction is 1. So the square of the difference of two is 2 − 2 u · v: the cosine between them is all
    /// that is needed.
    LENGTH_OF_DIRECTION = "a direction has length 1": Scalar(directions::length_of_direction);
    /// An angle depends on the ratio of its sine and cosine: lengths that both are multiplied with, or divided by, do not matter.
    ANGLE_OF_SCALED = "an angle whatever the lengths": Scalar(homogeneous::angle_of_scaled);
    /// A direction is the same whatever length the vector is multiplied with, or divided by.
    DIRECTION_OF_SCALED = "a direction whatever the lengths": Vector(homogeneous::direction_of_scaled);
    /// Rodrigues' formula turns a point p about a vector u by its length r: p cos r + (u × p) sin r / r + u (u · p)(1 − cos r)/r².
    /// As a rotation it cancels with others, and its derivative is the perpendicular of the result.
    RECOGNIZE_TURN = "Rodrigues' formula is a rotation": Vector(rotations::recognize_turn);
    /// (x cos θ − y sin θ, x sin θ + y cos θ, z) is the vector (x, y, z) after a turn by θ: a rotation, however it is written.
    RECOGNIZE_PLANE_TURN = "a turn in components is a rotation": Vector(rotations::recognize_plane_turn);
    /// Adding 0 and multiplying by 1 change nothing, and 0 stays 0 when it is scaled or turned.
    FOLD_ZERO = "fold zero and one": Vector(sums::fold_zero);
    /// Turning by a product of rotations is turning by one after the other, the right one first. Apart, they can meet
    /// what they cancel with.
    SPLIT_COMPOSITION = "split composition": Vector(rotations::split_composition);
    /// A rotation is undone by its transpose: R Rᵀ = 1.
    UNDO_ROTATION = "undo rotation": Vector(rotations::undo_rotation);
    /// What is added and subtracted leaves the sum.
    CANCEL_TERMS = "cancel terms": Vector(sums::cancel_terms);
    /// A rotation is linear, so two vectors that are turned alike can be added first and turned once.
    COMMON_ROTATION = "common rotation": Vector(rotations::common_rotation);
    /// A rotation keeps lengths and angles, so it can come after the division by a length, a product with a number, and the
    /// part across a direction. Outermost, it can meet what it cancels with.
    OPERATION_ON_ROTATED = "an operation on what was rotated": Vector(rotations::operation_on_rotated);
    /// A rotation keeps lengths, so it does not matter for the length whether there is one.
    NORM_OF_ROTATED = "norm of what was rotated": Scalar(rotations::norm_rotated);
    /// Turning a whole sum back keeps its length. One term loses its rotation, which then acts on what does not
    /// depend on the joints within.
    PULL_OUT_OF_NORM = "pull a rotation out of a sum's norm": Scalar(rotations::norm_pulls);
    /// Turning a whole sum back keeps its square. One term loses its rotation.
    PULL_OUT_OF_SQUARE = "pull a rotation out of a sum's square": Scalar(rotations::square_pulls);
    /// A dot product does not change when both sides are turned back alike. The right side loses its rotation; on the
    /// left the effector comes to rest and the target is turned back into its frame instead. This is where aiming
    /// becomes cheap: one point is carried inward rather than two outward.
    CANCEL_BESIDE_DIRECTION = "same rotation in a direction and beside it": Scalar(rotations::dot_direction);
    /// A dot product does not change when both sides are turned back alike, and on the other side that rotation is
    /// already there to cancel.
    CANCEL_ACROSS_DOT = "rotation cancels on the other side of a dot": Scalar(rotations::dot_cancels);
    /// v · R w = Rᵀ v · w: a dot product does not change when both sides are turned back alike. The rotation goes to
    /// the side where it costs less.
    OTHER_SIDE_OF_DOT = "rotation to the other side of a dot": Scalar(rotations::dot_other_side);
    /// A constant rotation before or after a turn is another turn of the same plane and a rotation with fewer numbers. The two
    /// turns are one, by the sum of their angles.
    TURN_INTO_ANGLE = "a constant turn into the angle": Vector(bases::turn_into_angle);
    /// A number times a number times a vector: the numbers are multiplied first, once instead of three times.
    MERGE_SCALES = "merge scales": Vector(scaling::merge);
    /// Turning, taking the part across and multiplying by a number can change places. Last, the number meets fewer
    /// components.
    SCALE_AFTER_OPERATION = "scale after the operation": Vector(scaling::out_of_operation);
    /// What is square to a direction already is its own part across it.
    ALL_ACROSS = "all of what is across is across": Vector(directions::across_of_across);
    /// The part across of a sum is the sum of the parts across, of which those along the direction are 0 and those
    /// square to it stay.
    ACROSS_OF_SUM = "the parts across of a sum": Vector(directions::across_of_sum);
    /// A number in a dot product can be multiplied afterwards, once instead of three times.
    SCALE_AFTER_DOT = "dot, then scale": Scalar(scaling::out_of_dot);
    /// A sign in a dot product or a length can come afterwards, where it costs nothing.
    SIGN_AFTER_DOT = "dot, then sign": Scalar(scaling::sign_out_of_number);
    /// What is square to the other side of a dot product adds nothing to it. A turn moves a point square to its way
    /// from the pivot, so whatever points along that way drops out of the derivative.
    DROP_RADIAL = "drop the radial part": Scalar(directions::dot_along_across);
    /// A cross product with a cross product is a difference of multiples of its two vectors: (a × b) × c = (a · c) b − (b · c) a.
    /// Where c is square to one of them, it is a multiple of that one.
    CROSS_OF_CROSS = "a cross product of a cross product": Vector(directions::cross_of_cross);
    /// Two vectors that are turned back alike are added first and turned back once.
    SUM_IN_FRAME = "a sum in another frame": Vector(frames::sum_in_frame);
    /// What is done to a vector alike in every frame can be done before it is turned back.
    OPERATION_IN_FRAME = "an operation in another frame": Vector(frames::operation_in_frame);
    /// Lengths and dot products are the same in every frame; the calculation stays in the one in which fewer vectors
    /// have to be turned.
    NUMBER_IN_FRAME = "a number in another frame": Scalar(frames::number_in_frame);
    /// A direction is the vector times one over its length. That number is computed once, for the value and for its
    /// derivatives.
    EXPAND_NORMALIZE = "one reciprocal for a direction": Vector(scaling::expand_normalize);
    /// A number times a number times a vector: the numbers are multiplied first, even where the scaled vector is
    /// needed elsewhere, too.
    MERGE_SHARED = "merge scales of shared vectors": Vector(scaling::merge_shared);
    /// What is across a direction is what is left without the part along it: v − (v · u) u.
    EXPAND_ACROSS = "a part across is a difference": Vector(directions::expand_across);
    /// A scaled difference in a sum with the same vector is taken apart, so that this vector is multiplied once.
    SPREAD = "spread a scaled difference over its sum": Vector(scaling::spread);
    /// A constant vector is divided by its largest component, which is multiplied afterwards: a factor of 1 is free.
    CONSTANT_SCALE = "a constant direction by its largest component": Vector(scaling::constant_scale);
    /// A rotation, and its derivative, make k v + m u × v + n (u · v) u of a vector. For several vectors the matrix is made once, by which
    /// each is multiplied with half the operations.
    LINEAR_MAP = "a linear map as a matrix": Vector(gathered::linear_map);
    /// The difference of the multiples of two vectors by each other's products with a third is a cross product with their own:
    /// (u · c) a − (a · c) u = (u × a) × c.
    CROSS_OF_DOTS = "a difference of multiples is a cross product": Vector(gathered::cross_of_dots);
    /// Vectors that are all multiplied by one, by a cross product, are added first and multiplied once: a × c + b × c = (a + b) × c.
    COMMON_CROSS = "a cross product of a sum": Vector(gathered::crosses);
    /// The same of dot products, where the sum of the vectors serves something else, too: a · c + b · c = (a + b) · c.
    COMMON_DOT = "a dot product of a sum": Scalar(gathered::dots);
    /// In components: a product with 0 is 0 and leaves its sum, a product with 1 is its other factor. The axes of the
    /// bones are such zeros and ones.
    CONSTANTS = "fold constants": Components;
    /// In components: signs are moved outward through products and sums, where a sum becomes a difference and the
    /// sign is free.
    NEGATIONS = "negations outward": Components;
    /// In components: a + b and b + a, a b and b a are computed once, being the same.
    ORDER = "operands in order": Components;
    /// In components: a product of several factors is multiplied in the order in which parts of it serve other
    /// products, too.
    SHARE = "share products": Components;
    /// In components: a b + a c = a (b + c), one multiplication less.
    FACTOR = "common factor of products": Components;
    /// In components: a + b + a = 2 a + b, so that the 2 can meet a ½; constants of a product are one; and of k (a b + c d), where
    /// k a and k c are there already, one multiplication less is left, (k a) b + (k c) d.
    JOIN = "like terms and constants as one": Components;
    /// In components: of c a + d b a multiple, a + (d/c) b, is made, one multiplication less, where whatever needs the sum can make
    /// up for it in constants of its own.
    MOVE_CONSTANTS = "constants where they cost least": Components;
    /// In components: one over a length that is needed for a single product becomes that product's division.
    DIVIDE_ONCE = "a reciprocal used once is a division": Components;
    /// In components: a quaternion that turns several vectors is made a matrix once, by which each is turned with half the
    /// operations.
    MATRIX = "a quaternion as a matrix": Components;
    /// In components: a number that is the sum, the difference or the product of others that are there anyway is made
    /// of them, and what it was made of goes.
    RESUBSTITUTE = "numbers made of others": Components;
}
