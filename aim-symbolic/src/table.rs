//! Maps and sets by the dense numbers of nodes, and a hash for nodes: fast also in builds without optimisation, which is how
//! macros run.

use std::hash::{BuildHasherDefault, Hash, Hasher};
use std::marker::PhantomData;

use crate::order::Node;
use crate::{Rotation, Scalar, Vector};

/// What has a dense number.
pub(crate) trait Id: Copy {
    fn number(self) -> usize;
}

macro_rules! id {
    ($($id:ident),*) => { $(
        impl Id for $id {
            fn number(self) -> usize {
                self.0 as usize
            }
        }
    )* };
}
id!(Scalar, Vector, Rotation);

/// A map by dense numbers.
#[derive(Clone, Debug)]
pub(crate) struct Table<K, V> {
    entries: Vec<Option<V>>,
    keys: PhantomData<K>,
}

impl<K, V> Default for Table<K, V> {
    fn default() -> Self {
        Self { entries: Vec::new(), keys: PhantomData }
    }
}

impl<K: Id, V: Clone> Table<K, V> {
    pub(crate) fn get(&self, key: K) -> Option<&V> {
        self.entries.get(key.number())?.as_ref()
    }

    /// Whether there was no entry before.
    pub(crate) fn insert(&mut self, key: K, value: V) -> bool {
        let number = key.number();
        if self.entries.len() <= number {
            self.entries.resize(number + 1 + number / 2, None);
        }
        self.entries[number].replace(value).is_none()
    }

    pub(crate) fn contains(&self, key: K) -> bool {
        self.get(key).is_some()
    }
}

/// A set of scalars and vectors.
#[derive(Clone, Debug, Default)]
pub(crate) struct NodeSet {
    scalars: Table<Scalar, ()>,
    vectors: Table<Vector, ()>,
}

impl NodeSet {
    pub(crate) fn contains(&self, node: Node) -> bool {
        match node {
            Node::Scalar(s) => self.scalars.contains(s),
            Node::Vector(v) => self.vectors.contains(v),
        }
    }

    /// Whether it is new.
    pub(crate) fn insert(&mut self, node: Node) -> bool {
        match node {
            Node::Scalar(s) => self.scalars.insert(s, ()),
            Node::Vector(v) => self.vectors.insert(v, ()),
        }
    }
}

/// The hash of nodes: they are a few small numbers, and nobody attacks them.
#[derive(Clone, Debug, Default)]
pub(crate) struct NodeHasher(u64);

pub(crate) type HashNodes = BuildHasherDefault<NodeHasher>;

/// A map by nodes.
pub(crate) type NodeMap<K, V> = std::collections::HashMap<K, V, HashNodes>;

impl NodeHasher {
    fn mix(&mut self, word: u64) {
        // An odd number with its bits well spread: 2^64 over the golden ratio.
        self.0 = (self.0.rotate_left(5) ^ word).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    }
}

impl Hasher for NodeHasher {
    fn finish(&self) -> u64 {
        // The best bits are the high ones, the table looks at the low ones too.
        self.0 ^ (self.0 >> 32)
    }

    fn write(&mut self, bytes: &[u8]) {
        for &byte in bytes {
            self.mix(byte.into());
        }
    }

    fn write_u8(&mut self, n: u8) {
        self.mix(n.into());
    }

    fn write_u32(&mut self, n: u32) {
        self.mix(n.into());
    }

    fn write_u64(&mut self, n: u64) {
        self.mix(n);
    }

    fn write_usize(&mut self, n: usize) {
        self.mix(n as u64);
    }

    fn write_isize(&mut self, n: isize) {
        // The discriminant of an enum, never negative.
        self.mix(n.unsigned_abs() as u64);
    }
}

impl<K, V> Table<K, V>
where
    K: Id + Hash,
    V: Copy,
{
    pub(crate) fn copied(&self, key: K) -> Option<V> {
        self.entries.get(key.number()).copied().flatten()
    }
}
