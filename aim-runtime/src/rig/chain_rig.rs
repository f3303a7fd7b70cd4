//! [`ChainRig`] and [`PerJoint`]: a rig of a bounded number of joints, as the solvers work with it.

use core::ops::{Deref, DerefMut};

use crate::{Description, Rig};

/// The largest number of joints of a rig.
pub(crate) const MOST_JOINTS: usize = 64;

/// A rig in one call: its description, read once, and its kernels. `C` joints are the most that there is room for.
#[derive(Clone, Copy)]
pub(crate) struct ChainRig<'a, const C: usize> {
    pub(crate) kernels: &'a dyn Rig,
    pub(crate) description: &'a Description<'a>,
}

impl<'a, const C: usize> ChainRig<'a, C> {
    /// `value` for every joint.
    #[inline(always)]
    pub(crate) fn array<T: Copy>(&self, value: T) -> PerJoint<T, C> {
        PerJoint { values: [value; C], count: self.joints.len() }
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
        &self.values[..self.count]
    }
}

impl<T, const C: usize> DerefMut for PerJoint<T, C> {
    #[inline(always)]
    fn deref_mut(&mut self) -> &mut [T] {
        &mut self.values[..self.count]
    }
}
