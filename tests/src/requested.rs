//! [`RequestedKernels`]: the generic kernels of a rig, which the derive emits as functions of its type, as a trait.

use aim::{AimRig, Scalar};

/// A rig with all generic kernels. The arguments are those of the emitted functions.
pub trait RequestedKernels: AimRig {
    /// Returns a joint's aim and its derivatives.
    fn joint_gradient<S: Scalar>(joint: usize, link: &[S; 12], target: &[S; 3], sin_cos: &[S; 4]) -> [S; 3];
    /// Computes the chain's aim and its derivatives.
    fn value_gradient<S: Scalar>(links: &[[S; 12]], target: &[S; 3], sin_cos: &[[S; 4]], out: &mut [S]);
    /// Computes the chain's residual and its Jacobian.
    fn residual_with_jacobian<S: Scalar>(links: &[[S; 12]], target: &[S; 3], sin_cos: &[[S; 4]], out: &mut [S]);
}

/// Implements [`RequestedKernels`] for rigs that declare all kernels.
#[macro_export]
macro_rules! requested_kernels {
    ($($rig:ty),* $(,)?) => {$(
        impl $crate::requested::RequestedKernels for $rig {
            fn joint_gradient<S: ::aim::Scalar>(
                joint: usize,
                link: &[S; 12],
                target: &[S; 3],
                sin_cos: &[S; 4],
            ) -> [S; 3] {
                <$rig>::aim_gradient(joint, link, target, sin_cos)
            }
            fn value_gradient<S: ::aim::Scalar>(
                links: &[[S; 12]],
                target: &[S; 3],
                sin_cos: &[[S; 4]],
                out: &mut [S],
            ) {
                <$rig>::chain_value_gradient(links, target, sin_cos, out);
            }
            fn residual_with_jacobian<S: ::aim::Scalar>(
                links: &[[S; 12]],
                target: &[S; 3],
                sin_cos: &[[S; 4]],
                out: &mut [S],
            ) {
                <$rig>::chain_residual_jacobian(links, target, sin_cos, out);
            }
        }
    )*};
}
