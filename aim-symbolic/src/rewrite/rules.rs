//! Rewriting rules. Each keeps the value, and none is specific to an objective.
//!
//! One rule, [`ACROSS_FOR_CROSS`], changes a degenerate value: the length of a cross product with a direction that is
//! 0.
//!
//! A rule looks at one node whose operands are already rewritten and offers a replacement. [`Graph::rewrite`] applies
//! the rules of a set in order, bottom up, until none applies.

use core::fmt;

use crate::ir::node::Node;
use crate::rewrite::{bases, directions, frames, gathered, homogeneous, limits, rotations, scaling, sums};
use crate::{Graph, Scalar, Vector};

/// A rewriting of expressions that keeps their value. Rules are compared by name.
#[derive(Clone, Copy, Debug)]
pub struct Rule {
    /// The name under which derivations list the rule. In builds with `aim_small` it is the name of the constant.
    pub name: &'static str,
    /// Why the rule holds and what it is good for, in a sentence or two. Empty in builds with `aim_small`.
    pub why: &'static str,
    rewriting: Rewriting,
}

/// The kind of expression that a rule rewrites, and its function.
#[derive(Clone, Copy, Debug)]
enum Rewriting {
    Vector(fn(&mut Graph, Vector) -> Option<Vector>),
    Scalar(fn(&mut Graph, Scalar) -> Option<Scalar>),
    /// Components: the rule is part of folding and arranging them, and is not applied node by node.
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
    /// Returns the replacement of `node`, or `None` if the rule does not apply.
    pub(crate) fn apply(&self, g: &mut Graph, node: Node) -> Option<Node> {
        match (self.rewriting, node) {
            (Rewriting::Vector(rewrite), Node::Vector(v)) => rewrite(g, v).map(Node::Vector),
            (Rewriting::Scalar(rewrite), Node::Scalar(s)) => rewrite(g, s).map(Node::Scalar),
            _ => None,
        }
    }
}

/// Rules that are applied together; the first that applies is used.
#[derive(Clone, Copy, Debug)]
pub struct RuleSet {
    /// The rules in order of preference.
    pub rules: &'static [Rule],
    /// Which terms of a sum the rules may take apart.
    pub sums: Sums,
}

/// Which terms of a sum the rules may take apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sums {
    /// All terms, including those of partial sums.
    Open,
    /// A partial sum that is used elsewhere is kept as one term, so that it stays shared.
    Shared,
}

/// A selection of rules: all except some.
#[derive(Clone, Copy, Debug, Default)]
pub struct Rules<'a> {
    /// The rules that are switched off.
    pub without: &'a [Rule],
    /// Limit on how often a rotation may move to the other side of a dot product or norm without cancelling there;
    /// `None` for no limit.
    pub max_other_side: Option<usize>,
}

impl Rules<'_> {
    /// Returns `true` if the rule is not switched off.
    #[must_use]
    pub fn has(&self, rule: &Rule) -> bool {
        !self.without.contains(rule)
    }
}

/// Returns the rules of all sets but [`LIMITS`], each once, in the order of the passes to which they belong.
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

/// Returns all rules, those of arithmetic last.
#[must_use]
pub fn all() -> Vec<Rule> {
    LIMITS.rules.iter().copied().chain(of_sets()).chain(ARITHMETIC).collect()
}

/// Quotients that are 0 / 0 somewhere, replaced by expressions with the right limit there. They apply first and are
/// never switched off to save operations: without them derivatives are wrong at these points. Builds with `aim_small`
/// derive only rigs, in which nothing cancels.
pub const LIMITS: RuleSet =
    RuleSet { rules: if cfg!(aim_small) { &[] } else { &[CANCELLED_DIVISION, CANCELLED_SCALE] }, sums: Sums::Open };

/// Restatements that make norms and directions explicit.
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

/// Angles and directions depend only on ratios: lengths that cancel are dropped. Builds with `aim_small` derive only
/// rigs, in which nothing is scaled.
pub const RATIOS: RuleSet =
    RuleSet { rules: if cfg!(aim_small) { &[] } else { &[ANGLE_OF_SCALED, DIRECTION_OF_SCALED] }, sums: Sums::Open };

/// Rotations, moved to where they cancel or to the side where they cost least.
pub const ROTATIONS: RuleSet = RuleSet {
    rules: &[
        FOLD_ZERO,
        SPLIT_COMPOSITION,
        UNDO_ROTATION,
        UNDO_IN_SUM,
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

/// Compositions, split into the rotations that they consist of, as both sweeps require.
pub(crate) const COMPOSITIONS: RuleSet = RuleSet { rules: &[SPLIT_COMPOSITION], sums: Sums::Open };

/// The parts of quaternions, replaced by the formulas of their values.
pub(crate) const FORMULAS: RuleSet = RuleSet { rules: &[FORMULA_OF_VECTOR, FORMULA_OF_SCALAR], sums: Sums::Open };

/// Steps set to 0, the rotations about them removed, and the parts of quaternions replaced by their formulas.
pub(crate) const AT_REST: RuleSet =
    RuleSet { rules: &[STEP_AT_REST, TURN_AT_REST, FORMULA_OF_VECTOR, FORMULA_OF_SCALAR], sums: Sums::Open };

/// Constant rotations, merged into the angles of adjacent turns.
pub const BASES: RuleSet = RuleSet { rules: &[TURN_INTO_ANGLE], sums: Sums::Open };

/// A calculation moved to the frame before a turn, if many vectors were rotated back by it.
pub const FRAMES: RuleSet =
    RuleSet { rules: &[FOLD_ZERO, UNDO_ROTATION, SUM_IN_FRAME, OPERATION_IN_FRAME, NUMBER_IN_FRAME], sums: Sums::Open };

/// Parts along a direction or perpendicular to it, and the consequences for sums and dot products.
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

/// Scale factors, moved out of the vector operations that commute with them.
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

/// Products with a common vector, gathered out of sums. Builds with `aim_small` derive only rigs, which have none.
pub const PRODUCTS: RuleSet = RuleSet {
    rules: if cfg!(aim_small) { &[] } else { &[LINEAR_MAP, CROSS_OF_DOTS, COMMON_CROSS, COMMON_DOT] },
    sums: Sums::Shared,
};

/// Rules on components, common to all compilers of formulas, which are applied together.
pub const ARITHMETIC: [Rule; 10] =
    [CONSTANTS, NEGATIONS, ORDER, SHARE, FACTOR, JOIN, MOVE_CONSTANTS, DIVIDE_ONCE, MATRIX, RESUBSTITUTE];

/// Rules that apply only where they are found to save operations.
pub(crate) const OPTIONAL: &[Rule] = if cfg!(aim_small) {
    &[TURN_INTO_ANGLE, SPREAD, CONSTANT_SCALE, MATRIX]
} else {
    &[TURN_INTO_ANGLE, SPREAD, CONSTANT_SCALE, LINEAR_MAP, CROSS_OF_DOTS, COMMON_CROSS, COMMON_DOT, MATRIX]
};

/// Rules that replace one rotation by another at the same cost; how often to apply them is a choice.
pub(crate) const OTHER_SIDES: [Rule; 3] = [OTHER_SIDE_OF_DOT, PULL_OUT_OF_NORM, PULL_OUT_OF_SQUARE];

/// Rules that cancel rotations.
pub(crate) const CANCELLING: [Rule; 2] = [CANCEL_BESIDE_DIRECTION, CANCEL_ACROSS_DOT];

/// Defines rules. A rule's comment is also its [`why`](Rule::why), for readers of the code and of derivations alike.
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
    /// A factor in both numerator and denominator cancels, also where it is 0: a length divided by itself is 1. From
    /// sin r = r (1 − r²/6 + …) and similar functions the power of r cancels, which leaves a series in r² where r is
    /// small.
    CANCELLED_DIVISION = "what is divided by itself is one": Scalar(limits::cancelled_division);
    /// A vector's direction times a multiple of its length is a multiple of the vector: |v| (v / |v|) = v, also where v
    /// is 0.
    CANCELLED_SCALE = "a length times a direction is a vector": Vector(limits::cancelled_scale);
    /// A vector divided by its own length is its direction: a single expression with a single derivative.
    RECOGNIZE_DIRECTION = "a vector over its length is a direction": Vector(directions::recognize_direction);
    /// The square of a vector is the dot product with itself, so its root is the vector's length.
    ROOT_OF_SQUARE = "the root of a square is a norm": Scalar(directions::root_of_square);
    /// A length times itself is the dot product of the vector with itself: no root is needed, nor its derivative.
    SQUARE_OF_NORM = "the square of a norm is a dot": Scalar(directions::square_of_norm);
    /// A length can be 0. The division becomes a product with a reciprocal that is 0 there, so that every result is
    /// finite.
    GUARD_DIVISION = "a division by a norm is guarded": Scalar(directions::guard_division);
    /// The cross product of v with a direction and the part of v across that direction both have the length |v| sin φ,
    /// with φ the angle between the two. The part across has the simpler derivative.
    ACROSS_FOR_CROSS = "the part across is as long as the cross product": Scalar(directions::norm_of_cross);
    /// A vector minus its part along a direction is its part across the direction: a single expression, perpendicular
    /// to the direction.
    RECOGNIZE_ACROSS = "a difference is a part across": Vector(directions::recognize_across);
    /// The length of a direction is 1. So the square of the difference of two directions is 2 − 2 u · v, which needs
    /// only the cosine between them.
    LENGTH_OF_DIRECTION = "a direction has length 1": Scalar(directions::length_of_direction);
    /// An angle depends only on the ratio of its sine and cosine, so a length by which both are multiplied or divided
    /// can be dropped.
    ANGLE_OF_SCALED = "an angle whatever the lengths": Scalar(homogeneous::angle_of_scaled);
    /// The direction of a vector does not change when the vector is multiplied or divided by a length.
    DIRECTION_OF_SCALED = "a direction whatever the lengths": Vector(homogeneous::direction_of_scaled);
    /// Rodrigues' formula rotates a point p about a vector u by its length r:
    /// p cos r + (u × p) sin r / r + u (u · p)(1 − cos r)/r². As a rotation it can cancel with others, and its
    /// derivative is the perpendicular of the result.
    RECOGNIZE_TURN = "Rodrigues' formula is a rotation": Vector(rotations::recognize_turn);
    /// (x cos θ − y sin θ, x sin θ + y cos θ, z) is the vector (x, y, z) after a turn by θ: a rotation, however it is
    /// written.
    RECOGNIZE_PLANE_TURN = "a turn in components is a rotation": Vector(rotations::recognize_plane_turn);
    /// Adding 0 and multiplying by 1 change nothing, and 0 stays 0 when it is scaled or turned.
    FOLD_ZERO = "fold zero and one": Vector(sums::fold_zero);
    /// Rotating by a product of rotations is rotating by one after the other, the right one first. Split, each can meet
    /// what it cancels with.
    SPLIT_COMPOSITION = "split composition": Vector(rotations::split_composition);
    /// The value of a step is 0. Only derivatives depend on it, and they have been taken.
    STEP_AT_REST = "a step is zero": Scalar(rotations::step_at_rest);
    /// The rotation about a step, whose value is 0, turns nothing.
    TURN_AT_REST = "a turn by a step is none": Vector(rotations::turn_at_rest);
    /// The vector part of a quaternion has the value of its formula. Its derivative comes of the rotation's angular
    /// velocity.
    FORMULA_OF_VECTOR = "the vector part by its formula": Vector(rotations::formula_of_vector);
    /// The scalar part of a quaternion has the value of its formula. Its derivative comes of the rotation's angular
    /// velocity.
    FORMULA_OF_SCALAR = "the scalar part by its formula": Scalar(rotations::formula_of_scalar);
    /// A rotation is undone by its transpose: R Rᵀ = 1. It keeps cross products, so it is undone in them, too:
    /// Rᵀ (v × R w) = Rᵀ v × w.
    UNDO_ROTATION = "undo rotation": Vector(rotations::undo_rotation);
    /// Where one term of a sum is rotated, rotating the sum back undoes that: Rᵀ (a + k (R b + c)) = Rᵀ a + k b + k Rᵀ c.
    UNDO_IN_SUM = "undo the rotation of a term": Vector(rotations::undo_in_sum);
    /// A term that is both added and subtracted drops out of the sum.
    CANCEL_TERMS = "cancel terms": Vector(sums::cancel_terms);
    /// A rotation is linear, so two vectors with the same rotation can be added first and rotated once.
    COMMON_ROTATION = "common rotation": Vector(rotations::common_rotation);
    /// A rotation keeps lengths and angles, so it can be applied after a division by a length, a product with a number,
    /// and taking the part across a direction. Outermost, it can meet what it cancels with.
    OPERATION_ON_ROTATED = "an operation on what was rotated": Vector(rotations::operation_on_rotated);
    /// A rotation keeps lengths, so the length of a rotated vector is the length of the vector.
    NORM_OF_ROTATED = "norm of what was rotated": Scalar(rotations::norm_rotated);
    /// Rotating a whole sum back keeps its length. One term loses its rotation, whose inverse then acts on terms that
    /// do not depend on the joints within.
    PULL_OUT_OF_NORM = "pull a rotation out of a sum's norm": Scalar(rotations::norm_pulls);
    /// Rotating a whole sum back keeps its square. One term loses its rotation.
    PULL_OUT_OF_SQUARE = "pull a rotation out of a sum's square": Scalar(rotations::square_pulls);
    /// A dot product does not change when both sides are rotated back alike. The right side loses its rotation; on the
    /// left the effector comes to rest and the target is rotated back into its frame instead. This is where aiming
    /// becomes cheap: one point is carried inward rather than two outward.
    CANCEL_BESIDE_DIRECTION = "same rotation in a direction and beside it": Scalar(rotations::dot_direction);
    /// A dot product does not change when both sides are rotated back alike, and on the other side the same rotation is
    /// present and cancels.
    CANCEL_ACROSS_DOT = "rotation cancels on the other side of a dot": Scalar(rotations::dot_cancels);
    /// v · R w = Rᵀ v · w: a dot product does not change when both sides are rotated back alike. The rotation moves to
    /// the side where it costs less.
    OTHER_SIDE_OF_DOT = "rotation to the other side of a dot": Scalar(rotations::dot_other_side);
    /// A constant rotation before or after a turn is another turn in the same plane times a rotation whose matrix has
    /// more zeros. The two turns become one, by the sum of their angles.
    TURN_INTO_ANGLE = "a constant turn into the angle": Vector(bases::turn_into_angle);
    /// A number times a number times a vector: the numbers are multiplied first, once instead of three times.
    MERGE_SCALES = "merge scales": Vector(scaling::merge);
    /// Scaling can be exchanged with rotating and with taking the part across a direction. Done last, it can apply to
    /// fewer components.
    SCALE_AFTER_OPERATION = "scale after the operation": Vector(scaling::out_of_operation);
    /// A vector that is perpendicular to a direction is its own part across that direction.
    ALL_ACROSS = "all of what is across is across": Vector(directions::across_of_across);
    /// The part across of a sum is the sum of the parts across. Terms along the direction drop out, and terms
    /// perpendicular to it stay as they are.
    ACROSS_OF_SUM = "the parts across of a sum": Vector(directions::across_of_sum);
    /// A factor in a dot product can be multiplied afterwards, once instead of three times.
    SCALE_AFTER_DOT = "dot, then scale": Scalar(scaling::out_of_dot);
    /// A sign in a dot product or a length can be applied afterwards, where it costs nothing.
    SIGN_AFTER_DOT = "dot, then sign": Scalar(scaling::sign_out_of_number);
    /// A vector that is perpendicular to the other side of a dot product adds nothing to it. A turn moves a point
    /// perpendicularly to its offset from the pivot, so everything along that offset drops out of the derivative.
    DROP_RADIAL = "drop the radial part": Scalar(directions::dot_along_across);
    /// A cross product of a cross product is a difference of multiples of its two vectors:
    /// (a × b) × c = (a · c) b − (b · c) a. If c is perpendicular to one of them, the result is a multiple of that one.
    CROSS_OF_CROSS = "a cross product of a cross product": Vector(directions::cross_of_cross);
    /// Two vectors that are rotated back alike are added first and rotated back once.
    SUM_IN_FRAME = "a sum in another frame": Vector(frames::sum_in_frame);
    /// An operation that is the same in every frame can be applied before the vector is rotated back.
    OPERATION_IN_FRAME = "an operation in another frame": Vector(frames::operation_in_frame);
    /// Lengths and dot products are the same in every frame. They are computed in the frame in which fewer vectors have
    /// to be rotated.
    NUMBER_IN_FRAME = "a number in another frame": Scalar(frames::number_in_frame);
    /// A direction is the vector times one over its length. That number is computed once, for the value and for its
    /// derivatives.
    EXPAND_NORMALIZE = "one reciprocal for a direction": Vector(scaling::expand_normalize);
    /// A number times a number times a vector: the numbers are multiplied first, even where the scaled vector is
    /// needed elsewhere, too.
    MERGE_SHARED = "merge scales of shared vectors": Vector(scaling::merge_shared);
    /// The part of a vector across a direction is the vector minus its part along it: v − (v · u) u.
    EXPAND_ACROSS = "a part across is a difference": Vector(directions::expand_across);
    /// If a sum contains a scaled difference and another multiple of the subtracted vector, the difference is taken
    /// apart, so that this vector is multiplied once.
    SPREAD = "spread a scaled difference over its sum": Vector(scaling::spread);
    /// A constant vector is divided by its largest component, by which the product is multiplied afterwards: a factor
    /// of 1 is free.
    CONSTANT_SCALE = "a constant direction by its largest component": Vector(scaling::constant_scale);
    /// A rotation and its derivative map a vector v to k v + m u × v + n (u · v) u. For several vectors the matrix of
    /// this map is computed once, and multiplying by it takes half the operations.
    LINEAR_MAP = "a linear map as a matrix": Vector(gathered::linear_map);
    /// A difference of two vectors, each multiplied by the dot product of the other with a third vector, is a cross
    /// product with their cross product: (u · c) a − (a · c) u = (u × a) × c.
    CROSS_OF_DOTS = "a difference of multiples is a cross product": Vector(gathered::cross_of_dots);
    /// For cross products with a common vector, the other vectors are added first and multiplied once:
    /// a × c + b × c = (a + b) × c.
    COMMON_CROSS = "a cross product of a sum": Vector(gathered::crosses);
    /// For dot products with a common vector, the other vectors are added first if their sum is also used elsewhere:
    /// a · c + b · c = (a + b) · c.
    COMMON_DOT = "a dot product of a sum": Scalar(gathered::dots);
    /// In components: a product with 0 drops out of its sum, and a product with 1 is its other factor. The axes of the
    /// bones are such zeros and ones.
    CONSTANTS = "fold constants": Components;
    /// In components: signs are moved outward through products and sums. In a sum a sign turns addition into
    /// subtraction and is free.
    NEGATIONS = "negations outward": Components;
    /// In components: operands are put in order, so that a + b and b + a, or a b and b a, are computed once.
    ORDER = "operands in order": Components;
    /// In components: the factors of a product are multiplied in an order whose partial products serve other products,
    /// too.
    SHARE = "share products": Components;
    /// In components: a b + a c = a (b + c), one multiplication less.
    FACTOR = "common factor of products": Components;
    /// In components: a + b + a = 2 a + b, so that the 2 can meet a ½; the constants of a product become one; and
    /// k (a b + c d) becomes (k a) b + (k c) d, one multiplication less, if k a and k c are computed anyway.
    JOIN = "like terms and constants as one": Components;
    /// In components: instead of c a + d b its multiple a + (d/c) b is computed, one multiplication less, if every use
    /// of the sum can make up for it in constants of its own.
    MOVE_CONSTANTS = "constants where they cost least": Components;
    /// In components: one over a length that only a single product needs becomes a division in that product.
    DIVIDE_ONCE = "a reciprocal used once is a division": Components;
    /// In components: a quaternion that rotates several vectors is converted to a matrix once, which rotates each of
    /// them with half the operations.
    MATRIX = "a quaternion as a matrix": Components;
    /// In components: a number that is the sum, difference or product of others that are computed anyway is computed
    /// from these, and the operations that gave it before are dropped.
    RESUBSTITUTE = "numbers made of others": Components;
}
