//! [`ChainRig`] and [`PerJoint`]: a rig of a bounded number of joints, as the solvers work with it.

use core::ops::{Deref, DerefMut};

use crate::{Description, Rig};

/// The largest number of joints of a rig.
#[cfg(not(aim_small))]
pub(crate) const MOST_JOINTS: usize = 64;
/// The same where the program is to be small.
#[cfg(aim_small)]
pub(crate) const MOST_JOINTS: usize = 16;

/// The number of joints of most rigs (an eye, a head, a chest): there is just room for them, so that loops over them are known
/// to the compiler.
pub(crate) const EXACT_JOINTS: usize = 3;

/// A rig in one call: its description, read once, and its kernels. `C` joints are the most that there is room for, and as many
/// as there are where that is [`EXACT_JOINTS`].
#[derive(Clone, Copy)]
pub(crate) struct ChainRig<'a, const C: usize> {
    pub(crate) kernels: &'a dyn Rig,
    pub(crate) description: &'a Description<'a>,
}

impl<'a, const C: usize> ChainRig<'a, C> {
    /// The number of joints.
    #[inline(always)]
    pub(crate) fn count(&self) -> usize {
        if C == EXACT_JOINTS { C } else { self.joints.len() }
    }

    /// `value` for every joint.
    #[inline(always)]
    pub(crate) fn array<T: Copy>(&self, value: T) -> PerJoint<T, C> {
        PerJoint { values: [value; C], count: self.count() }
    }
}

impl<'a, const C: usize> Deref for ChainRig<'a, C> {
    type Target = Description<'a>;

    #[inline(always)]
    fn deref(&self) -> &Description<'a> {
        self.description
    }
}

/// One value a joint, without allocation.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PerJoint<T, const C: usize> {
    values: [T; C],
    count: usize,
}

impl<T, const C: usize> Deref for PerJoint<T, C> {
    type Target = [T];

    #[inline(always)]
    fn deref(&self) -> &[T] {
        if C == EXACT_JOINTS { &self.values } else { &self.values[..self.count] }
    }
}

impl<T, const C: usize> DerefMut for PerJoint<T, C> {
    #[inline(always)]
    fn deref_mut(&mut self) -> &mut [T] {
        if C == EXACT_JOINTS { &mut self.values } else { &mut self.values[..self.count] }
    }
}
