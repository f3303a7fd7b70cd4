//! [`Value`]: the symbolic value of an expression, and its parts.

use std::rc::Rc;

use aim_symbolic::{Scalar, Vector};
use syn::{Expr, ExprMethodCall, Pat};

use super::algebra::Algebra;
use super::condition::Condition;
use super::map::{Affine, Map, Quaternion};

/// The symbolic value of an expression.
#[derive(Clone, Debug)]
pub(crate) enum Value {
    Scalar(Scalar),
    /// A whole number; a known one is a constant.
    Integer(Scalar),
    Truth(Condition),
    /// A vector of two; its third component is 0.
    Planar(Vector),
    Vector(Vector),
    /// A vector of four.
    Four([Scalar; 4]),
    Quaternion(Quaternion),
    Matrix(Map),
    /// A 2×2 or 4×4 matrix.
    Square(Columns),
    /// A 4×4 matrix that is an affine transform.
    Homogeneous(Affine),
    Affine(Affine),
    Tuple(Vec<Self>),
    /// An array, a slice, or a list whose length is known.
    Array(Vec<Self>),
    Struct(Rc<Struct>),
    Optional(Rc<Optional>),
    Ordering(Rc<Order>),
    Function(Rc<Callable>),
    /// A `&mut` to a place.
    Reference(Rc<Place>),
    /// The type that a generic parameter stands for, by name.
    Type(String),
    /// A list whose length depends on arguments.
    List(Vec<Element>),
    /// The elements of an iterator.
    Iterator(Vec<Element>),
    /// A slice argument whose length is not known.
    Slice(Rc<Slice>),
    /// The sequence that a kept loop iterates over.
    LoopSequence(Rc<LoopSequence>),
    /// The value of an expression that diverges.
    Never,
    /// The value of an expression that an error was reported for; it causes no further errors.
    Unknown,
}

/// An element that is present where a condition holds.
#[derive(Clone, Debug)]
pub(crate) struct Element {
    pub(crate) is_there: Condition,
    pub(crate) value: Value,
}

/// Builds a value from its numbers.
pub(crate) type Make = dyn Fn(&mut Algebra, Vec<Scalar>) -> Value;

/// A slice argument whose length is not known, a slice field of an argument, or a part of either.
#[derive(Clone)]
pub(crate) struct Slice {
    /// Index among the slices of all arguments.
    pub(crate) place: usize,
    /// Number of numbers in an element.
    pub(crate) components: usize,
    /// Builds an element from its numbers.
    pub(crate) make: Rc<Make>,
    /// Index of the first element in the argument.
    pub(crate) first: Scalar,
    pub(crate) len: Scalar,
}

impl core::fmt::Debug for Slice {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Slice").field("place", &self.place).finish_non_exhaustive()
    }
}

/// The sequence that a kept loop iterates over.
#[derive(Clone)]
pub(crate) struct LoopSequence {
    /// Number of iterations, including those whose element is left out.
    pub(crate) count: Scalar,
    pub(crate) items: Rc<SequenceItems>,
}

/// The elements of a sequence by index, built when the loop is run.
pub(crate) enum SequenceItems {
    /// No element is used.
    Nothing,
    Numbers,
    Elements(Rc<Slice>),
    /// Elements of an array.
    Listed(Value),
    /// The first `len` elements, repeated.
    Cycled {
        items: Rc<Self>,
        len: Scalar,
    },
    /// Parts of a slice, of `size` elements each, `step` elements apart.
    Parts {
        slice: Rc<Slice>,
        size: usize,
        step: usize,
    },
    /// Consecutive parts of a slice, of `size` elements each; the last one may be shorter.
    Chunks {
        slice: Rc<Slice>,
        size: Scalar,
    },
    /// Elements with the indices first + step k.
    Stepped {
        items: Rc<Self>,
        first: Scalar,
        step: Scalar,
    },
    Numbered(Rc<Self>),
    /// Results of a method that calls a function for each element.
    Adapted(Rc<Self>, ExprMethodCall, Rc<Callable>),
    /// Pairs of the elements of two sequences, as a method makes them.
    Paired([Rc<Self>; 2], ExprMethodCall),
}

impl SequenceItems {
    /// Returns `true` if no element is left out.
    pub(crate) fn is_whole(&self) -> bool {
        self.are_all(&|name| name == "map" || name.ends_with("_while"))
    }

    /// Returns `true` if the presence of an element does not depend on those before it.
    pub(crate) fn is_indexed(&self) -> bool {
        self.are_all(&|name| name == "map")
    }

    /// Returns `true` if the elements are of arrays and numbers, which exist in every language.
    pub(crate) fn is_listed(&self) -> bool {
        match self {
            Self::Numbers | Self::Listed(_) => true,
            Self::Stepped { items, .. }
            | Self::Cycled { items, .. }
            | Self::Numbered(items)
            | Self::Adapted(items, ..) => items.is_listed(),
            Self::Paired(both, _) => both.iter().all(|items| items.is_listed()),
            Self::Nothing | Self::Elements(_) | Self::Parts { .. } | Self::Chunks { .. } => false,
        }
    }

    /// Returns the method that calls a function for each element.
    pub(crate) fn adapting_call(&self) -> Option<&ExprMethodCall> {
        match self {
            Self::Stepped { items, .. } | Self::Cycled { items, .. } | Self::Numbered(items) => items.adapting_call(),
            Self::Adapted(_, call, _) => Some(call),
            _ => None,
        }
    }

    /// Returns `true` if all methods that call a function satisfy `such`.
    fn are_all(&self, such: &dyn Fn(&str) -> bool) -> bool {
        match self {
            Self::Nothing
            | Self::Numbers
            | Self::Elements(_)
            | Self::Listed(_)
            | Self::Parts { .. }
            | Self::Chunks { .. } => true,
            Self::Stepped { items, .. } | Self::Cycled { items, .. } | Self::Numbered(items) => items.are_all(such),
            Self::Adapted(items, call, _) => such(&call.method.to_string()) && items.are_all(such),
            Self::Paired(both, _) => both.iter().all(|items| items.are_all(such)),
        }
    }
}

impl core::fmt::Debug for LoopSequence {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("LoopSequence").field("count", &self.count).finish_non_exhaustive()
    }
}

/// Columns of a square matrix.
pub(crate) type Columns = Vec<Vec<Scalar>>;

/// An `Option`.
#[derive(Clone, Debug)]
pub(crate) struct Optional {
    pub(crate) is_some: Condition,
    /// Value inside; [`Value::Never`] if the option is always `None`.
    pub(crate) value: Value,
}

/// Result of comparing two numbers.
#[derive(Clone, Debug)]
pub(crate) struct Order {
    pub(crate) less: Condition,
    pub(crate) greater: Condition,
}

/// A value of a struct of the module.
#[derive(Clone, Debug)]
pub(crate) struct Struct {
    pub(crate) name: String,
    /// Fields of supported types, by name or by index.
    pub(crate) fields: Vec<(String, Value)>,
}

/// Name of the struct that stands for a mask, the result of comparing two vectors; no struct of a module has it.
pub(crate) const MASK: &str = "glam::BVec";

impl Struct {
    /// Returns `true` for a mask.
    pub(crate) fn is_mask(&self) -> bool {
        self.name == MASK
    }

    pub(crate) fn field(&self, name: &str) -> Option<&Value> {
        self.fields.iter().find(|(known, _)| known == name).map(|(_, value)| value)
    }
}

/// The scope in which code is written; paths are resolved in it.
#[derive(Clone, Default)]
pub(crate) struct Scope {
    /// Full name of the module.
    pub(crate) module: String,
    /// Name of the type that `Self` is.
    pub(crate) self_type: Option<String>,
    /// The type that `Self` is, as written, if it has generic arguments.
    pub(crate) self_written: Option<Rc<syn::Type>>,
    /// Generic parameters that are types.
    pub(crate) generics: Vec<String>,
    /// Generic parameters that are lengths.
    pub(crate) lengths: Vec<String>,
    /// Imports of enclosing blocks: names and paths.
    pub(crate) imports: Vec<(String, Vec<String>)>,
    /// `true` in a block with a glob import of a module that is not known, which may have any names.
    pub(crate) has_foreign_glob: bool,
}

impl Scope {
    /// Returns `true` if names from outside of the known items mean the same here as in the companions: not in another
    /// module, nor after a glob import in the function.
    pub(crate) fn means_the_same_in_companions(&self) -> bool {
        self.module.is_empty() && !self.has_foreign_glob
    }
}

impl core::fmt::Debug for Scope {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Scope").field("module", &self.module).finish_non_exhaustive()
    }
}

/// Identity of one run of a function.
#[derive(Clone, Debug, Default)]
pub(crate) struct FrameId(Rc<()>);

impl PartialEq for FrameId {
    fn eq(&self, other: &Self) -> bool {
        Rc::ptr_eq(&self.0, &other.0)
    }
}

/// The place where a closure was created.
#[derive(Clone)]
pub(crate) struct ClosureOrigin {
    pub(super) frame: FrameId,
    /// Variables of that frame that the closure names.
    pub(super) named: Vec<usize>,
    /// `true` if it assigns to one of them.
    pub(super) changes: bool,
}

/// A function or closure.
#[derive(Clone)]
pub(crate) struct Callable {
    /// Name of a function, preceded by its type's name.
    pub(crate) name: Option<String>,
    pub(crate) parameters: Vec<(Pat, Option<syn::Type>)>,
    /// For each parameter, `true` if it is `&mut`.
    pub(crate) changed: Vec<bool>,
    pub(crate) body: Expr,
    /// Variables that it captures.
    pub(crate) captured: Vec<(String, Value)>,
    /// Type of the result, if it is written.
    pub(crate) result: Option<syn::Type>,
    /// Scope in which it is written.
    pub(crate) scope: Rc<Scope>,
    /// Place where a closure was created, whose variables it may change.
    pub(crate) origin: Option<ClosureOrigin>,
    /// Trait that it is a function of.
    pub(crate) of_trait: Option<String>,
}

impl core::fmt::Debug for Callable {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Callable").field("name", &self.name).finish_non_exhaustive()
    }
}

/// A step from a value to a part of it.
#[derive(Clone)]
pub(super) enum Step {
    /// A field by its name, including fields of an enum's variants.
    Field(String),
    /// The value inside an option.
    Inside,
    Index(usize),
    /// An element at a computed index.
    Computed(Scalar),
    /// `len` elements from index `first` on.
    Part {
        first: usize,
        len: usize,
    },
}

/// A variable, or a part of one.
#[derive(Clone)]
pub(crate) struct Place {
    pub(super) variable: usize,
    pub(super) steps: Vec<Step>,
}

impl Place {
    /// Returns a `&mut` to a part of the place.
    pub(super) fn lent(&self, step: Step) -> Value {
        self.lent_along(&[step])
    }

    /// Returns a `&mut` to the part at the end of these steps.
    pub(super) fn lent_along(&self, steps: &[Step]) -> Value {
        let steps = self.steps.iter().chain(steps).cloned().collect();
        Value::Reference(Rc::new(Self { variable: self.variable, steps }))
    }

    /// Returns a `&mut` to `len` elements, from index `first` on.
    pub(super) fn lent_part(&self, first: usize, len: usize) -> Value {
        self.lent(Step::Part { first, len })
    }
}

impl core::fmt::Debug for Place {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Place").field("variable", &self.variable).finish_non_exhaustive()
    }
}

impl Value {
    /// Describes the kind of the value for a message.
    pub(crate) fn describe(&self) -> String {
        match self {
            Self::Scalar(_) => "a number".into(),
            Self::Integer(_) => "an integer".into(),
            Self::Truth(_) => "a boolean".into(),
            Self::Planar(_) => "a 2D vector".into(),
            Self::Vector(_) => "a vector".into(),
            Self::Four(_) => "a 4D vector".into(),
            Self::Quaternion(_) => "a quaternion".into(),
            Self::Matrix(_) => "a matrix".into(),
            Self::Square(columns) if columns.len() == 2 => "a 2×2 matrix".into(),
            Self::Square(_) | Self::Homogeneous(_) => "a 4×4 matrix".into(),
            Self::Affine(_) => "a transform".into(),
            Self::Tuple(values) if values.is_empty() => "`()`".into(),
            Self::Tuple(values) => format!("a tuple of length {}", values.len()),
            Self::Array(values) => format!("an array of length {}", values.len()),
            Self::Struct(of) if of.is_mask() => "a mask".into(),
            Self::Struct(of) => format!("a `{}`", of.name),
            Self::Optional(_) => "an option".into(),
            Self::Ordering(_) => "an ordering".into(),
            Self::Function(_) => "a function".into(),
            Self::Type(_) => "a type".into(),
            Self::Reference(_) => "a mutable reference".into(),
            Self::List(_) => "a list whose length depends on arguments".into(),
            Self::Iterator(_) | Self::LoopSequence(_) => "an iterator".into(),
            Self::Slice(_) => "a slice".into(),
            Self::Never | Self::Unknown => "an expression".into(),
        }
    }

    /// Returns the unit value.
    pub(crate) fn nothing() -> Self {
        Self::Tuple(Vec::new())
    }

    /// Replaces all references by `other`; `None` if it returns `None` for one of them.
    pub(super) fn with_references(&self, other: &dyn Fn(&Rc<Place>) -> Option<Self>) -> Option<Self> {
        let all = |values: &[Self]| values.iter().map(|value| value.with_references(other)).collect::<Option<Vec<_>>>();
        let elements = |items: &[Element]| {
            let items = items.iter().map(|item| {
                Some(Element { is_there: item.is_there.clone(), value: item.value.with_references(other)? })
            });
            items.collect::<Option<Vec<_>>>()
        };
        Some(match self {
            Self::Reference(place) => other(place)?,
            Self::Tuple(values) => Self::Tuple(all(values)?),
            Self::Array(values) => Self::Array(all(values)?),
            Self::List(items) => Self::List(elements(items)?),
            Self::Iterator(items) => Self::Iterator(elements(items)?),
            Self::Optional(of) => {
                let value = of.value.with_references(other)?;
                Self::Optional(Rc::new(Optional { is_some: of.is_some.clone(), value }))
            }
            Self::Struct(of) => {
                let fields = of.fields.iter().map(|(name, value)| Some((name.clone(), value.with_references(other)?)));
                Self::Struct(Rc::new(Struct { name: of.name.clone(), fields: fields.collect::<Option<_>>()? }))
            }
            value => value.clone(),
        })
    }

    /// Returns `true` if a variable may have this value in one branch and another value in another.
    pub(super) fn is_selectable(&self) -> bool {
        !matches!(self, Self::Function(_) | Self::Reference(_) | Self::Type(_) | Self::Slice(_) | Self::LoopSequence(_))
    }

    /// Returns the result of an operation on these parts if one of them is unknown or diverges; `None` if all have
    /// values.
    pub(super) fn without(parts: &[Self]) -> Option<Self> {
        if parts.iter().any(Self::is_never) {
            return Some(Self::Never);
        }
        parts.iter().any(Self::is_unknown).then_some(Self::Unknown)
    }

    pub(crate) fn is_never(&self) -> bool {
        matches!(self, Self::Never)
    }

    /// Returns `true` if the value causes no further errors.
    pub(crate) fn is_unknown(&self) -> bool {
        matches!(self, Self::Unknown | Self::Never)
    }
}

/// Whole numbers, which count and index.
impl Algebra {
    /// Returns a whole number; rounded beyond 2⁵³.
    pub(crate) fn integer(&mut self, value: i64) -> Value {
        #[expect(clippy::cast_precision_loss, reason = "whole numbers count and index: they are small")]
        Value::Integer(self.number(value as f64))
    }

    pub(crate) fn count_value(&mut self, value: usize) -> Value {
        Value::Integer(self.count(value))
    }

    /// Returns a small whole number that counts or indexes.
    #[expect(clippy::cast_precision_loss, reason = "it is small")]
    pub(crate) fn count(&mut self, value: usize) -> Scalar {
        self.number(value as f64)
    }

    /// Returns 1 where a condition holds, else 0.
    pub(crate) fn number_of(&mut self, condition: &Condition) -> Scalar {
        let (one, zero) = (self.number(1.0), self.number(0.0));
        condition.select(self, one, zero)
    }

    /// Returns the value of a known whole number.
    pub(crate) fn known_integer(&self, value: &Value) -> Option<i64> {
        let Value::Integer(x) = value else { return None };
        #[expect(clippy::cast_possible_truncation, reason = "it was made of a whole number")]
        self.constant_of(*x).map(|x| x as i64)
    }

    /// Returns the value of a known index.
    pub(crate) fn known_index(&self, value: &Value) -> Option<usize> {
        self.known_integer(value).and_then(|x| usize::try_from(x).ok())
    }
}
