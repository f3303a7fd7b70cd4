//! Why each rule holds and what it is good for, in words, for those who read a derivation.

/// Rules by name, in the order of [`rules::names`](crate::rules::names).
const REASONS: [(&str, &str); 40] = [
    // WORDING
    (
        "a vector over its length is a direction",
        "A vector times one over its own length is its direction: one thing, with one derivative.",
    ),
    (
        "the root of a square is a norm",
        "The square of a vector is the dot product with itself, so its root is the vector's length.",
    ),
    (
        "the square of a norm is a dot",
        "A length times itself is the dot product of the vector with itself: no root is needed, nor its derivative.",
    ),
    (
        "a division by a norm is guarded",
        "A length can be 0. The division becomes a product with a reciprocal that is 0 there, so that every result is finite.",
    ),
    (
        "the part across is as long as the cross product",
        "Both have the length |v| sin of the angle between them. The part across has the simpler derivative.",
    ),
    // ROTATIONS
    ("fold zero and one", "Adding 0 and multiplying by 1 change nothing, and 0 stays 0 when it is scaled or turned."),
    (
        "split composition",
        "Turning by a product of rotations is turning by one after the other, the right one first. Apart, they can meet what they cancel with.",
    ),
    ("undo rotation", "A rotation is undone by its transpose: R Rᵀ = 1."),
    ("cancel terms", "What is added and subtracted leaves the sum."),
    (
        "common rotation",
        "A rotation is linear, so two vectors that are turned alike can be added first and turned once.",
    ),
    ("normalize what was rotated", "A rotation keeps lengths, so it can come after the division by the length."),
    (
        "norm of what was rotated",
        "A rotation keeps lengths, so it does not matter for the length whether there is one.",
    ),
    (
        "pull a rotation out of a sum's norm",
        "Turning a whole sum back keeps its length. One term loses its rotation, which then acts on what does not depend on the joints within.",
    ),
    (
        "pull a rotation out of a sum's square",
        "Turning a whole sum back keeps its square. One term loses its rotation.",
    ),
    (
        "same rotation in a direction and beside it",
        "A dot product does not change when both sides are turned back alike. The right side loses its rotation; on the left the effector comes to rest and the target is turned back into its frame instead. This is where aiming becomes cheap: one point is carried inward rather than two outward.",
    ),
    (
        "rotation cancels on the other side of a dot",
        "A dot product does not change when both sides are turned back alike, and on the other side that rotation is already there to cancel.",
    ),
    (
        "rotation to the other side of a dot",
        "v · R w = Rᵀ v · w: a dot product does not change when both sides are turned back alike. The rotation goes to the side where it costs less.",
    ),
    // DIRECTIONS
    (
        "merge scales",
        "A number times a number times a vector: the numbers are multiplied first, once instead of three times.",
    ),
    (
        "scale after the operation",
        "Turning, taking the part across and multiplying by a number can change places. Last, the number meets fewer components.",
    ),
    ("nothing of a direction is across it", "A multiple of a direction has no part across that direction."),
    ("all of what is across is across", "What is square to a direction already is its own part across it."),
    (
        "the parts across of a sum",
        "The part across of a sum is the sum of the parts across, of which those along the direction are 0 and those square to it stay.",
    ),
    ("dot, then scale", "A number in a dot product can be multiplied afterwards, once instead of three times."),
    ("dot, then sign", "A sign in a dot product or a length can come afterwards, where it costs nothing."),
    (
        "drop the radial part",
        "What is square to the other side of a dot product adds nothing to it. A turn moves a point square to its way from the pivot, so whatever points along that way drops out of the derivative.",
    ),
    // FRAMES
    ("a sum in another frame", "Two vectors that are turned back alike are added first and turned back once."),
    (
        "an operation in another frame",
        "What is done to a vector alike in every frame can be done before it is turned back.",
    ),
    (
        "a number in another frame",
        "Lengths and dot products are the same in every frame; the calculation stays in the one in which fewer vectors have to be turned.",
    ),
    // SCALES
    (
        "one reciprocal for a direction",
        "A direction is the vector times one over its length. That number is computed once, for the value and for its derivatives.",
    ),
    (
        "merge scales of shared vectors",
        "A number times a number times a vector: the numbers are multiplied first, even where the scaled vector is needed elsewhere, too.",
    ),
    (
        "a part across is a difference",
        "What is across a direction is what is left without the part along it: v − (v · u) u.",
    ),
    (
        "spread a scaled difference over its sum",
        "A scaled difference in a sum with the same vector is taken apart, so that this vector is multiplied once.",
    ),
    (
        "common vector of a sum",
        "Two multiples of one vector are one multiple of it: the numbers are added, not the vectors.",
    ),
    (
        "a constant direction by its largest component",
        "A constant vector is divided by its largest component, which is multiplied afterwards: a factor of 1 is free.",
    ),
    // Of components
    (
        "fold constants",
        "In components: a product with 0 is 0 and leaves its sum, a product with 1 is its other factor. The axes of the bones are such zeros and ones.",
    ),
    (
        "negations outward",
        "In components: signs are moved outward through products and sums, where a sum becomes a difference and the sign is free.",
    ),
    ("operands in order", "In components: a + b and b + a, a b and b a are computed once, being the same."),
    (
        "share products",
        "In components: a product of several factors is multiplied in the order in which parts of it serve other products, too.",
    ),
    ("common factor of products", "In components: a b + a c = a (b + c), one multiplication less."),
    (
        "a reciprocal used once is a division",
        "In components: one over a length that is needed for a single product becomes that product's division.",
    ),
];

/// Why the rule of this name holds and what it is good for, in a sentence or two; `None` for a name that no rule has.
pub fn reason(rule: &str) -> Option<&'static str> {
    REASONS.iter().find(|(name, _)| *name == rule).map(|(_, reason)| *reason)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rules;

    #[test]
    fn every_rule_has_its_reason_and_no_other_has() {
        assert_eq!(REASONS.map(|(name, _)| name).to_vec(), rules::names());
        for (name, reason) in REASONS {
            assert!(reason.ends_with('.') && reason.len() > 40, "{name}: {reason}");
        }
    }
}
