//! Maps and sets indexed by node ids. Ids are dense, so a vector serves as the map: it is fast even without
//! optimisation, and procedural macros are usually compiled without.

use std::marker::PhantomData;
use std::ops::Index;

use crate::ir::node::{Node, Rotation, Scalar, Vector};

/// An index into one of the graph's arenas.
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

/// A map from node ids to values.
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

    /// Inserts an entry. Returns `true` if there was none before.
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

    pub(crate) fn copied(&self, key: K) -> Option<V> {
        self.get(key).cloned()
    }
}

impl<K: Id, V: Clone> Index<K> for Table<K, V> {
    type Output = V;

    fn index(&self, key: K) -> &V {
        self.get(key).expect("the key has an entry")
    }
}

/// A map from scalars and vectors to values.
#[derive(Clone, Debug)]
pub(crate) struct NodeTable<V> {
    scalars: Table<Scalar, V>,
    vectors: Table<Vector, V>,
}

/// A set of scalars and vectors.
pub(crate) type NodeSet = NodeTable<()>;

impl<V> Default for NodeTable<V> {
    fn default() -> Self {
        Self { scalars: Table::default(), vectors: Table::default() }
    }
}

impl<V: Clone> NodeTable<V> {
    pub(crate) fn copied(&self, node: Node) -> Option<V> {
        match node {
            Node::Scalar(s) => self.scalars.copied(s),
            Node::Vector(v) => self.vectors.copied(v),
        }
    }

    pub(crate) fn contains(&self, node: Node) -> bool {
        self.copied(node).is_some()
    }

    /// Inserts an entry. Returns `true` if there was none before.
    pub(crate) fn insert(&mut self, node: Node, value: V) -> bool {
        match node {
            Node::Scalar(s) => self.scalars.insert(s, value),
            Node::Vector(v) => self.vectors.insert(v, value),
        }
    }
}
