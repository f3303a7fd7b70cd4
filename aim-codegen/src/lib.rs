//! From what the user declared to the code that aims it.
mod spec;
pub use spec::{AngleRange, EffectorSpec, Frame, JointSpec, RigSpec};
