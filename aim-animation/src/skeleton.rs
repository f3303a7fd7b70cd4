//! [`Skeleton`]: bones with names, parents and a rest pose, sorted so that parents precede their children.

use alloc::string::String;
use alloc::vec::Vec;
use core::fmt;
use core::ops::Range;

use crate::transform::Transform;

/// A bone as passed to [`Skeleton::new`].
#[derive(Clone, Debug, PartialEq)]
pub struct Bone {
    /// Name; need not be unique.
    pub name: String,
    /// Index of the parent among the bones passed; `None` for a root.
    pub parent: Option<usize>,
    /// Transform at rest, in the parent's space. It applies where no clip moves the bone.
    pub rest: Transform,
}

impl Bone {
    /// A bone whose rest transform is the identity.
    pub fn new(name: impl Into<String>, parent: Option<usize>) -> Self {
        Self { name: name.into(), parent, rest: Transform::IDENTITY }
    }

    /// Sets the rest transform.
    #[must_use]
    pub fn with_rest(mut self, rest: Transform) -> Self {
        self.rest = rest;
        self
    }
}

/// Reason why bones do not form a skeleton. Indices are those of the bones as passed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum SkeletonError {
    /// The parent of this bone does not exist.
    Parent {
        /// Index of the bone.
        bone: usize,
        /// Index of its parent.
        parent: usize,
    },
    /// This bone is its own ancestor.
    Cycle(usize),
    /// The rest transform of this bone is not finite, or its rotation is not a unit quaternion.
    Rest(usize),
}

impl fmt::Display for SkeletonError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Parent { bone, parent } => {
                write!(f, "the parent of bone {bone} is bone {parent}, which does not exist")
            }
            Self::Cycle(bone) => write!(f, "bone {bone} is its own ancestor; give one bone of the cycle no parent"),
            Self::Rest(bone) => {
                write!(f, "the rest transform of bone {bone} is not finite, or its rotation is no unit quaternion")
            }
        }
    }
}

impl core::error::Error for SkeletonError {}

/// A forest of bones. Immutable; all characters of a kind can share one.
///
/// Bones may be passed in any order. They are sorted depth first: parents precede their children, and a bone with its
/// descendants is a contiguous [range](Self::subtree). **Poses, masks and clips index bones in this order.**
/// [`bone_of`](Self::bone_of) and [`source_of`](Self::source_of) convert from the order passed to this order and back.
/// Bones that are passed in depth-first order keep their indices.
///
/// ```
/// use aim_animation::{Bone, Skeleton};
///
/// // A hand that stands before the arm that it hangs on.
/// let skeleton = Skeleton::new([Bone::new("hand", Some(1)), Bone::new("arm", None)])?;
/// assert_eq!((skeleton.find("arm"), skeleton.find("hand")), (Some(0), Some(1)));
/// assert_eq!(skeleton.bone_of(0), Some(1));
/// # Ok::<(), aim_animation::SkeletonError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Skeleton {
    names: Vec<String>,
    parents: Vec<Option<usize>>,
    /// End of each bone's subtree: one past its last bone.
    ends: Vec<usize>,
    rest: Vec<Transform>,
    sources: Vec<usize>,
    bones: Vec<usize>,
}

impl Skeleton {
    /// Sorts bones into a skeleton. Roots and siblings keep their order.
    ///
    /// # Errors
    /// The first of these that is found: a parent that does not exist, a cycle, a rest transform that is not finite or
    /// whose rotation is not a unit quaternion.
    pub fn new(bones: impl IntoIterator<Item = Bone>) -> Result<Self, SkeletonError> {
        let given: Vec<Bone> = bones.into_iter().collect();
        for (bone, Bone { parent, rest, .. }) in given.iter().enumerate() {
            if let Some(parent) = parent.filter(|&parent| parent >= given.len()) {
                return Err(SkeletonError::Parent { bone, parent });
            }
            if !rest.is_sound() {
                return Err(SkeletonError::Rest(bone));
            }
        }
        let sources = depth_first(&given)?;
        let mut bones = alloc::vec![0; given.len()];
        sources.iter().enumerate().for_each(|(bone, &source)| bones[source] = bone);
        let parents: Vec<Option<usize>> =
            sources.iter().map(|&source| given[source].parent.map(|parent| bones[parent])).collect();
        let mut ends: Vec<usize> = (1..=given.len()).collect();
        for bone in (0..given.len()).rev() {
            if let Some(parent) = parents[bone] {
                ends[parent] = ends[parent].max(ends[bone]);
            }
        }
        let rest = sources.iter().map(|&source| given[source].rest).collect();
        let names = sources.iter().map(|&source| given[source].name.clone()).collect();
        Ok(Self { names, parents, ends, rest, sources, bones })
    }

    /// The skeleton of some of the bones, whose indices must be ascending. A bone whose parent is not among them
    /// becomes a root.
    pub(crate) fn part(&self, bones: &[usize]) -> Self {
        let to = |bone: usize| bones.binary_search(&bone).ok();
        let bone = |&bone: &usize| Bone {
            name: self.names[bone].clone(),
            parent: self.parents[bone].and_then(to),
            rest: self.rest[bone],
        };
        // Cannot fail: parts of a valid skeleton are valid, and keep their order.
        Self::new(bones.iter().map(bone)).unwrap_or_else(|_| self.clone())
    }

    /// The number of bones.
    #[must_use]
    pub fn len(&self) -> usize {
        self.parents.len()
    }

    /// Returns `true` if there are no bones.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.parents.is_empty()
    }

    /// Parent of each bone; it precedes the bone. `None` for roots.
    #[must_use]
    pub fn parents(&self) -> &[Option<usize>] {
        &self.parents
    }

    /// Name of each bone; need not be unique.
    #[must_use]
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// Transform of each bone at rest, in its parent's space.
    #[must_use]
    pub fn rest(&self) -> &[Transform] {
        &self.rest
    }

    /// Returns the name of a bone; `None` if there is no such bone.
    #[must_use]
    pub fn name(&self, bone: usize) -> Option<&str> {
        self.names.get(bone).map(String::as_str)
    }

    /// Returns the only bone with this name; `None` if no bone or several have it.
    #[must_use]
    pub fn find(&self, name: &str) -> Option<usize> {
        let mut named = self.named(name);
        named.next().filter(|_| named.next().is_none())
    }

    /// Returns the bones with this name.
    pub fn named<'a>(&'a self, name: &'a str) -> impl Iterator<Item = usize> + 'a {
        self.names.iter().enumerate().filter(move |(_, of_bone)| *of_bone == name).map(|(bone, _)| bone)
    }

    /// Returns the bone that was passed at index `source`; `None` if there is no such index.
    #[must_use]
    pub fn bone_of(&self, source: usize) -> Option<usize> {
        self.bones.get(source).copied()
    }

    /// Returns the index at which a bone was passed; `None` if there is no such bone.
    #[must_use]
    pub fn source_of(&self, bone: usize) -> Option<usize> {
        self.sources.get(bone).copied()
    }

    /// Returns the range of a bone and all its descendants; empty if there is no such bone.
    ///
    /// ```
    /// use aim_animation::{Bone, Skeleton};
    ///
    /// let bones = [("hips", None), ("chest", Some(0)), ("hand", Some(1)), ("foot", Some(0))];
    /// let skeleton = Skeleton::new(bones.map(|(name, parent)| Bone::new(name, parent)))?;
    /// let chest = skeleton.find("chest").unwrap();
    /// assert_eq!(skeleton.subtree(chest), 1..3);
    /// assert!(skeleton.children(0).eq([1, 3]) && skeleton.ancestry(2).eq([2, 1, 0]));
    /// # Ok::<(), aim_animation::SkeletonError>(())
    /// ```
    #[must_use]
    pub fn subtree(&self, bone: usize) -> Range<usize> {
        self.ends.get(bone).map_or(0..0, |&end| bone..end)
    }

    /// Returns the children of a bone, in order; none if there is no such bone.
    pub fn children(&self, bone: usize) -> impl Iterator<Item = usize> + Clone + '_ {
        let Range { start, end } = self.subtree(bone);
        // The next sibling follows directly after a child's subtree.
        let within = move |bone: usize| Some(bone).filter(|bone| *bone < end);
        core::iter::successors(within(start + 1), move |&child| within(self.ends[child]))
    }

    /// Returns a bone and its ancestors, from the bone to its root; empty if there is no such bone.
    pub fn ancestry(&self, bone: usize) -> impl Iterator<Item = usize> + '_ {
        core::iter::successors((bone < self.len()).then_some(bone), |&bone| self.parents[bone])
    }
}

/// Order of the bones in a depth-first search from the roots, without recursion.
fn depth_first(given: &[Bone]) -> Result<Vec<usize>, SkeletonError> {
    // First child and next sibling of each bone.
    let mut first: Vec<Option<usize>> = alloc::vec![None; given.len()];
    let mut next: Vec<Option<usize>> = alloc::vec![None; given.len()];
    let mut first_root = None;
    for (bone, Bone { parent, .. }) in given.iter().enumerate().rev() {
        let head = parent.map_or(&mut first_root, |parent| &mut first[parent]);
        next[bone] = head.replace(bone);
    }
    let mut order = Vec::with_capacity(given.len());
    let mut at = first_root;
    let mut ways_back: Vec<usize> = Vec::new();
    while let Some(bone) = at {
        order.push(bone);
        at = first[bone].or(next[bone]);
        if first[bone].is_some() {
            ways_back.push(bone);
        }
        while at.is_none()
            && let Some(parent) = ways_back.pop()
        {
            at = next[parent];
        }
    }
    if order.len() == given.len() {
        return Ok(order);
    }
    // A bone that no root reaches descends from a cycle. Following parents as many times as there are bones ends in
    // that cycle.
    let mut is_reached = alloc::vec![false; given.len()];
    order.iter().for_each(|&bone| is_reached[bone] = true);
    let stray = is_reached.iter().position(|reached| !reached).unwrap_or(0);
    let in_cycle = (0..given.len()).fold(stray, |bone, _| given[bone].parent.unwrap_or(bone));
    Err(SkeletonError::Cycle(in_cycle))
}
