//! [`ChainRig`] and [`PerJoint`]: a rig with a bounded number of joints, in the form that the solvers use.

use core::array;
use core::ops::{Deref, DerefMut};

use super::body_part::EXACT_JOINTS;
use crate::{Description, Rig};

/// Largest number of joints of a rig.
#[cfg(not(aim_small))]
pub(crate) const MOST_JOINTS: usize = 64;
/// Largest number of joints of a rig with `aim_small`.
#[cfg(aim_small)]
pub(crate) const MOST_JOINTS: usize = 16;

/// A rig in one call: its description, read once, and its kernels. `C` is the largest number of joints, and the exact
/// one if it is [`EXACT_JOINTS`].
#[derive(Clone, Copy)]
pub(crate) struct ChainRig<'a, const C: usize> {
    pub(crate) kernels: &'a dyn Rig,
    pub(crate) description: &'a Description<'a>,
}

impl<'a, const C: usize> ChainRig<'a, C> {
    /// Returns the number of joints.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(crate) fn count(&self) -> usize {
        if C == EXACT_JOINTS { C } else { self.joints.len() }
    }

    /// Returns `value` for every joint.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(crate) fn array<T: Copy>(&self, value: T) -> PerJoint<T, C> {
        PerJoint { values: [value; C], count: self.count() }
    }

    /// Returns the value of `of` for every joint's index. `filler` is for indices without a joint.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(crate) fn array_of<T: Copy>(&self, filler: T, of: impl Fn(usize) -> T) -> PerJoint<T, C> {
        let count = self.count();
        PerJoint { values: array::from_fn(|index| if index < count { of(index) } else { filler }), count }
    }

    /// Returns the values of a slice with one for every joint. `filler` is for indices without a joint.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(crate) fn array_from<T: Copy>(&self, values: &[T], filler: T) -> PerJoint<T, C> {
        // A copy of known length takes no call.
        if C == EXACT_JOINTS
            && let Some(values) = values.first_chunk::<C>()
        {
            return PerJoint { values: *values, count: C };
        }
        let mut array = self.array(filler);
        array.copy_from_slice(values);
        array
    }
}

impl<'a, const C: usize> Deref for ChainRig<'a, C> {
    type Target = Description<'a>;

    #[cfg_attr(not(aim_small), inline(always))]
    fn deref(&self) -> &Description<'a> {
        self.description
    }
}

/// One value per joint, without allocation.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PerJoint<T, const C: usize> {
    values: [T; C],
    count: usize,
}

impl<T: Copy, const C: usize> PerJoint<T, C> {
    /// Copies the values to a slice of the same length.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(crate) fn copy_to(&self, values: &mut [T]) {
        match values.first_chunk_mut::<C>() {
            Some(values) if C == EXACT_JOINTS => *values = self.values,
            _ => values.copy_from_slice(self),
        }
    }
}

impl<T, const C: usize> Deref for PerJoint<T, C> {
    type Target = [T];

    #[cfg_attr(not(aim_small), inline(always))]
    fn deref(&self) -> &[T] {
        if C == EXACT_JOINTS { &self.values } else { &self.values[..self.count] }
    }
}

impl<T, const C: usize> DerefMut for PerJoint<T, C> {
    #[cfg_attr(not(aim_small), inline(always))]
    fn deref_mut(&mut self) -> &mut [T] {
        if C == EXACT_JOINTS { &mut self.values } else { &mut self.values[..self.count] }
    }
}
