//! [`Value`]: what an expression of the function stands for, and what such values are made of.

use std::rc::Rc;

use aim_symbolic::{Scalar, Vector};
use syn::{Expr, ExprMethodCall, Pat};

use super::algebra::Algebra;
use super::condition::Condition;
use super::map::{Affine, Map, Quaternion};

/// What an expression stands for.
#[derive(Clone, Debug)]
pub(crate) enum Value {
    Scalar(Scalar),
    /// A whole number; one that is known is a constant.
    Integer(Scalar),
    Truth(Condition),
    /// A vector of two: its third component is 0.
    Planar(Vector),
    Vector(Vector),
    /// A vector of four.
    Four([Scalar; 4]),
    Quaternion(Quaternion),
    Matrix(Map),
    /// A matrix of two or four columns.
    Square(Columns),
    /// A matrix of four columns that is an affine transform.
    Homogeneous(Affine),
    Affine(Affine),
    Tuple(Vec<Self>),
    /// An array, a slice, or a list whose length is known.
    Array(Vec<Self>),
    Struct(Rc<Struct>),
    Optional(Rc<Optional>),
    Ordering(Rc<Order>),
    Function(Rc<Callable>),
    /// `&mut` of a place.
    Reference(Rc<Place>),
    /// The type that a generic parameter stands for, by name.
    Type(String),
    /// A list whose length arguments decide.
    List(Vec<Element>),
    /// What an iterator goes over.
    Iterator(Vec<Element>),
    /// An argument of as many elements as there happen to be.
    Slice(Rc<Slice>),
    /// What a loop goes over whose rounds are not written out.
    Rounds(Rc<Rounds>),
    /// Of an expression that control does not come out of.
    Never,
    /// What an error was reported for: nothing more is said about it.
    Unknown,
}

/// An element that is there where a condition holds.
#[derive(Clone, Debug)]
pub(crate) struct Element {
    pub(crate) is_there: Condition,
    pub(crate) value: Value,
}

/// Makes a value of its numbers.
pub(crate) type Make = dyn Fn(&mut Algebra, Vec<Scalar>) -> Value;

/// An argument of as many elements as there happen to be, a field of one, or a part of those.
#[derive(Clone)]
pub(crate) struct Slice {
    /// Its place among the slices of all arguments.
    pub(crate) place: usize,
    /// How many numbers an element has.
    pub(crate) components: usize,
    /// An element of these numbers.
    pub(crate) make: Rc<Make>,
    /// The number of its first element among those of the argument.
    pub(crate) first: Scalar,
    pub(crate) len: Scalar,
}

impl core::fmt::Debug for Slice {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Slice").field("place", &self.place).finish_non_exhaustive()
    }
}

/// What a loop goes over that stays one.
#[derive(Clone)]
pub(crate) struct Rounds {
    /// How many rounds there are, also of elements that are left out.
    pub(crate) count: Scalar,
    pub(crate) items: Rc<Items>,
}

/// The elements of rounds, by number: they are made when the loop is run.
pub(crate) enum Items {
    /// None that is looked at.
    Nothing,
    Numbers,
    Elements(Rc<Slice>),
    /// Those of an array.
    Listed(Value),
    /// Of so many, from the first again after the last.
    Cycled {
        items: Rc<Self>,
        len: Scalar,
    },
    /// Parts of a slice, of so many elements each, each so many further on.
    Parts {
        slice: Rc<Slice>,
        size: usize,
        step: usize,
    },
    /// The same, each behind the other, the last one as long as there are elements left.
    Chunks {
        slice: Rc<Slice>,
        size: Scalar,
    },
    /// Those of the numbers first + step k.
    Stepped {
        items: Rc<Self>,
        first: Scalar,
        step: Scalar,
    },
    Numbered(Rc<Self>),
    /// What a method makes of each by a function.
    Made(Rc<Self>, ExprMethodCall, Rc<Callable>),
    /// Those of two, as a method pairs them.
    Paired([Rc<Self>; 2], ExprMethodCall),
}

impl Items {
    /// Whether none is left out.
    pub(crate) fn is_whole(&self) -> bool {
        self.are_all(&|name| name == "map" || name.ends_with("_while"))
    }

    /// Whether each is there by itself, whatever those before it are.
    pub(crate) fn is_indexed(&self) -> bool {
        self.are_all(&|name| name == "map")
    }

    /// True if they are of arrays and numbers, which are there in every language.
    pub(crate) fn is_listed(&self) -> bool {
        match self {
            Self::Numbers | Self::Listed(_) => true,
            Self::Stepped { items, .. }
            | Self::Cycled { items, .. }
            | Self::Numbered(items)
            | Self::Made(items, ..) => items.is_listed(),
            Self::Paired(both, _) => both.iter().all(|items| items.is_listed()),
            Self::Nothing | Self::Elements(_) | Self::Parts { .. } | Self::Chunks { .. } => false,
        }
    }

    /// The method that makes each by a function.
    pub(crate) fn made_by(&self) -> Option<&ExprMethodCall> {
        match self {
            Self::Stepped { items, .. } | Self::Cycled { items, .. } | Self::Numbered(items) => items.made_by(),
            Self::Made(_, call, _) => Some(call),
            _ => None,
        }
    }

    /// Whether all methods that make elements are such.
    fn are_all(&self, such: &dyn Fn(&str) -> bool) -> bool {
        match self {
            Self::Nothing
            | Self::Numbers
            | Self::Elements(_)
            | Self::Listed(_)
            | Self::Parts { .. }
            | Self::Chunks { .. } => true,
            Self::Stepped { items, .. } | Self::Cycled { items, .. } | Self::Numbered(items) => items.are_all(such),
            Self::Made(items, call, _) => such(&call.method.to_string()) && items.are_all(such),
            Self::Paired(both, _) => both.iter().all(|items| items.are_all(such)),
        }
    }
}

impl core::fmt::Debug for Rounds {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Rounds").field("count", &self.count).finish_non_exhaustive()
    }
}

/// Columns of as many numbers.
pub(crate) type Columns = Vec<Vec<Scalar>>;

/// An `Option`.
#[derive(Clone, Debug)]
pub(crate) struct Optional {
    pub(crate) is_some: Condition,
    /// What is inside, where there is something; [`Value::Never`] of `None`.
    pub(crate) value: Value,
}

/// How two numbers compare.
#[derive(Clone, Debug)]
pub(crate) struct Order {
    pub(crate) less: Condition,
    pub(crate) greater: Condition,
}

/// A value of a struct of the module.
#[derive(Clone, Debug)]
pub(crate) struct Struct {
    pub(crate) name: String,
    /// The fields that are understood, by name or by number.
    pub(crate) fields: Vec<(String, Value)>,
}

impl Struct {
    pub(crate) fn field(&self, name: &str) -> Option<&Value> {
        self.fields.iter().find(|(known, _)| known == name).map(|(_, value)| value)
    }
}

/// Where something is written: what the paths there mean.
#[derive(Clone, Default)]
pub(crate) struct Scope {
    /// The module, by its full name.
    pub(crate) module: String,
    /// What `Self` is.
    pub(crate) self_type: Option<String>,
    /// The same as written, where that has generic arguments.
    pub(crate) self_written: Option<Rc<syn::Type>>,
    /// Generic parameters that are types, and those that are lengths.
    pub(crate) generics: Vec<String>,
    pub(crate) lengths: Vec<String>,
    /// What blocks around it import: names and paths.
    pub(crate) imports: Vec<(String, Vec<String>)>,
}

impl core::fmt::Debug for Scope {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Scope").field("module", &self.module).finish_non_exhaustive()
    }
}

/// Which run of a function it is: the same one, or another.
#[derive(Clone, Debug, Default)]
pub(crate) struct FrameId(Rc<()>);

impl PartialEq for FrameId {
    fn eq(&self, other: &Self) -> bool {
        Rc::ptr_eq(&self.0, &other.0)
    }
}

/// Where a closure was made.
#[derive(Clone)]
pub(crate) struct Home {
    pub(super) frame: FrameId,
    /// The variables there that it names.
    pub(super) named: Vec<usize>,
    /// Whether it assigns to one of them.
    pub(super) changes: bool,
}

/// What can be called.
#[derive(Clone)]
pub(crate) struct Callable {
    /// Of a function, with its type in front.
    pub(crate) name: Option<String>,
    pub(crate) parameters: Vec<(Pat, Option<syn::Type>)>,
    /// Which of them are `&mut`.
    pub(crate) changed: Vec<bool>,
    pub(crate) body: Expr,
    /// The variables that it sees of where it is made.
    pub(crate) captured: Vec<(String, Value)>,
    /// The type of its result, where that is said.
    pub(crate) result: Option<syn::Type>,
    /// Where it is written.
    pub(crate) scope: Rc<Scope>,
    /// Where a closure was made, which may change the variables there.
    pub(crate) home: Option<Home>,
    /// The trait that it is a function of.
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
    /// A field by its name, also of an enum's variant.
    Field(String),
    /// The value inside of an option.
    Inside,
    Index(usize),
    /// An element that arguments choose.
    Chosen(Scalar),
    /// So many elements from this one on.
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
    /// A `&mut` to a part of it.
    pub(super) fn lent(&self, step: Step) -> Value {
        self.lent_along(&[step])
    }

    /// The same, so many steps inside of it.
    pub(super) fn lent_along(&self, steps: &[Step]) -> Value {
        let steps = self.steps.iter().chain(steps).cloned().collect();
        Value::Reference(Rc::new(Self { variable: self.variable, steps }))
    }

    /// The same to so many elements from one on.
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
    /// Its kind, for a message.
    pub(crate) fn describe(&self) -> String {
        match self {
            Self::Scalar(_) => "a number".into(),
            Self::Integer(_) => "a whole number".into(),
            Self::Truth(_) => "a condition".into(),
            Self::Planar(_) => "a vector of two".into(),
            Self::Vector(_) => "a vector".into(),
            Self::Four(_) => "a vector of four".into(),
            Self::Quaternion(_) => "a quaternion".into(),
            Self::Matrix(_) => "a matrix".into(),
            Self::Square(columns) if columns.len() == 2 => "a matrix of two".into(),
            Self::Square(_) | Self::Homogeneous(_) => "a matrix of four".into(),
            Self::Affine(_) => "a transform".into(),
            Self::Tuple(values) if values.is_empty() => "nothing".into(),
            Self::Tuple(values) => format!("a tuple of {}", values.len()),
            Self::Array(values) => format!("an array of {}", values.len()),
            Self::Struct(of) => format!("a `{}`", of.name),
            Self::Optional(_) => "an option".into(),
            Self::Ordering(_) => "an ordering".into(),
            Self::Function(_) => "a function".into(),
            Self::Type(_) => "a type".into(),
            Self::Reference(_) => "a reference that changes what it refers to".into(),
            Self::List(_) => "a list whose length arguments decide".into(),
            Self::Iterator(_) | Self::Rounds(_) => "an iterator".into(),
            Self::Slice(_) => "a slice".into(),
            Self::Never | Self::Unknown => "an expression".into(),
        }
    }

    /// The value of an expression that has none.
    pub(crate) fn nothing() -> Self {
        Self::Tuple(Vec::new())
    }

    /// The same with others in place of all references; `None` where one has none.
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

    /// Whether a variable can have this value in one branch and another one in another.
    pub(super) fn is_selectable(&self) -> bool {
        !matches!(self, Self::Function(_) | Self::Reference(_) | Self::Type(_) | Self::Slice(_) | Self::Rounds(_))
    }

    /// The value of what is made of these where one of them is not there; `None` where all are.
    pub(super) fn without(parts: &[Self]) -> Option<Self> {
        if parts.iter().any(Self::is_never) {
            return Some(Self::Never);
        }
        parts.iter().any(Self::is_unknown).then_some(Self::Unknown)
    }

    pub(crate) fn is_never(&self) -> bool {
        matches!(self, Self::Never)
    }

    /// Whether nothing more can be said about it.
    pub(crate) fn is_unknown(&self) -> bool {
        matches!(self, Self::Unknown | Self::Never)
    }
}

/// Whole numbers: they count and index.
impl Algebra {
    /// A whole number. Those beyond 2⁵³ are rounded.
    pub(crate) fn integer(&mut self, value: i64) -> Value {
        #[expect(clippy::cast_precision_loss, reason = "whole numbers count and index: they are small")]
        Value::Integer(self.number(value as f64))
    }

    pub(crate) fn whole(&mut self, value: usize) -> Value {
        Value::Integer(self.count(value))
    }

    /// A whole number that counts or indexes: it is small.
    #[expect(clippy::cast_precision_loss, reason = "it is small")]
    pub(crate) fn count(&mut self, value: usize) -> Scalar {
        self.number(value as f64)
    }

    /// 1 where a condition holds, else 0.
    pub(crate) fn number_of(&mut self, condition: &Condition) -> Scalar {
        let (one, zero) = (self.number(1.0), self.number(0.0));
        condition.select(self, one, zero)
    }

    /// A whole number that is known.
    pub(crate) fn known_integer(&self, value: &Value) -> Option<i64> {
        let Value::Integer(x) = value else { return None };
        #[expect(clippy::cast_possible_truncation, reason = "it was made of a whole number")]
        self.constant_of(*x).map(|x| x as i64)
    }

    /// An index that is known.
    pub(crate) fn known_index(&self, value: &Value) -> Option<usize> {
        self.known_integer(value).and_then(|x| usize::try_from(x).ok())
    }
}
