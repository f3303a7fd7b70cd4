//! References derived by hand with patience, pencil and paper, against which derived programs are judged. One problem
//! per file; the comments are the derivation.
//!
//! Every function is generic over [`Number`], so that the same code can be counted ([`counted::count`]), checked
//! against central differences, and timed.
//!
//! **What counts.** Sines and cosines are given. Additions, subtractions, multiplications, divisions and square roots
//! count one each; so does a multiplication by 2, or x + x. Negations and selects are free, and so is everything known
//! at compile time: constants are folded, in f64. Every divisor is a length, and the quotient is 0 if that length is
//! not above [`tiny`](Number::tiny). A length is divided by *once*: replacing a multiplication by a second division by
//! the same length lowers the count but not the time, so it is not done. The comments mention where it would be
//! possible.
//!
//! **Conventions.** The inputs are those of the emitted C: links are twelve numbers, rows m0, m1, m2, then the
//! translation, in the row-vector layout; targets are three numbers; angles are sin p, cos p, sin h, cos h. Cardinal
//! problems use the thug's axes: up = +X, forward = +Y, left = +Z. Components of vectors are renamed at once to the
//! directions that they belong to ([`Axes`]), which costs nothing and makes every convention read alike. Heading turns
//! forward towards left, pitch turns forward towards up, and pitch acts first.
//!
//! **What all derivations share.** Everything nearer to the effector than a joint is rotated by the joint's rotation
//! `R`. Rotating the other side back instead, `q = P Rᵀ`, leaves one point to rotate instead of two vectors. In a
//! plane, rotating a point back by an angle moves it perpendicular to itself: `∂(q₁, q₂) / ∂θ = (q₂, −q₁)`, so that a
//! covector `g` on `q` gives `∂ = g₁ q₂ − g₂ q₁`, its *moment*. A moment does not change when `g` and `q` are rotated
//! together, so it can be taken on either side of the rotation. Nor does it change when a multiple of `q` is added to
//! `g`.

pub mod algebra;
pub mod arap;
pub mod chain;
pub mod counted;
pub mod distance;
pub mod elsewhere;
pub mod general_forward;
pub mod general_frames;
pub mod one_joint;
pub mod residual;
pub mod roll;
pub mod two_targets;

pub use aim_symbolic::Number;
pub use algebra::Axes;
