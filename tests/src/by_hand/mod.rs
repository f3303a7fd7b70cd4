//! References derived by hand: what a patient person reaches with pencil and paper, against which derived programs are
//! judged. One problem a file; the comments are the derivation.
//!
//! Every function is generic over [`Number`], so that the same text is counted
//! ([`counted::count`]), checked against central differences, and timed.
//!
//! **What counts.** Sines and cosines are given. Additions, subtractions, multiplications, divisions and square roots
//! count one each; so does a multiplication by 2, or x + x. Negations and selects are free, and so is all that is known
//! when compiling: constants are folded, in f64. What is divided by is a length, and the quotient is 0 where that
//! length is not above [`tiny`](Number::tiny). A length is divided by *once*: buying off a multiplication with a second
//! division by the same length lowers the count and not the time, so it is not done; where it would be possible, the
//! comments say so.
//!
//! **Conventions.** The inputs are those of the emitted C: links are twelve numbers, rows m0, m1, m2, then the
//! translation, in the row-vector layout; targets three; angles are sin p, cos p, sin h, cos h. Cardinal problems are
//! those of the thug: up = +X, forward = +Y, left = +Z. Vectors are at once renamed by the direction that a component
//! belongs to ([`Axes`]), which costs nothing and makes every convention read alike. Heading turns forward towards left,
//! pitch turns forward towards up, and pitch acts first.
//!
//! **What all derivations share.** Everything that lies nearer the effector than a joint is turned by its rotation `R`.
//! Turning back what lies on the other side instead, `q = P Rᵀ`, leaves one point to turn where there were two vectors.
//! In a plane, turning a point back by an angle moves it across itself: `∂(q₁, q₂) / ∂θ = (q₂, −q₁)`, so that a covector
//! `g` on `q` gives `∂ = g₁ q₂ − g₂ q₁`, its *moment*. A moment does not change when `g` and `q` are turned together: it
//! may be taken on either side of the turn. And it does not change when a multiple of `q` is added to `g`.

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
