//! Adapters that call functions of typed arguments with plain numbers.

use aim::glam::{DMat3, DQuat, DVec2, DVec3, Mat3, Quat, Vec2, Vec3};
use aim::{DRigid, Rigid};

/// A function that can be called with numbers of type `S`; `A` is the tuple of its argument types.
pub trait Function<S, A> {
    /// Calls the function and returns its result as numbers. For derivatives these are the value's numbers, then, for
    /// each component of each variable, those of the derivative.
    fn feed(&self, numbers: &[S]) -> Vec<S>;
}

/// An argument that is built from numbers of type `S`.
pub trait Argument<S>: Sized {
    /// Takes as many numbers as the argument needs.
    fn read(numbers: &mut impl Iterator<Item = S>) -> Self;
}

/// A result that can be written as numbers of type `S`.
pub trait Numbers<S> {
    /// Appends the numbers of this result.
    fn write(self, numbers: &mut Vec<S>);
}

macro_rules! functions {
    ($($argument:ident)*) => {
        impl<S: Copy, F, R, $($argument),*> Function<S, ($($argument,)*)> for F
        where
            F: Fn($($argument),*) -> R,
            R: Numbers<S>,
            $($argument: Argument<S>,)*
        {
            fn feed(&self, numbers: &[S]) -> Vec<S> {
                let mut from = numbers.iter().copied();
                let mut to = Vec::new();
                self($($argument::read(&mut from)),*).write(&mut to);
                assert!(from.next().is_none(), "more numbers than the function has arguments");
                to
            }
        }
    };
}

functions!(A);
functions!(A B);
functions!(A B C);
functions!(A B C D);
functions!(A B C D E);
functions!(A B C D E G);
functions!(A B C D E G H);

/// Returns the next number.
pub(crate) fn next<S>(numbers: &mut impl Iterator<Item = S>) -> S {
    numbers.next().expect("the sample has a number for every argument")
}

/// Rounds to single precision.
#[expect(clippy::cast_possible_truncation, reason = "what is rounded away is meant to be")]
pub(crate) fn single(x: f64) -> f32 {
    x as f32
}

impl Argument<Self> for f64 {
    fn read(numbers: &mut impl Iterator<Item = Self>) -> Self {
        next(numbers)
    }
}

impl Argument<f64> for f32 {
    fn read(numbers: &mut impl Iterator<Item = f64>) -> Self {
        single(next(numbers))
    }
}

impl Numbers<Self> for f64 {
    fn write(self, numbers: &mut Vec<Self>) {
        numbers.push(self);
    }
}

impl Numbers<f64> for f32 {
    fn write(self, numbers: &mut Vec<f64>) {
        numbers.push(self.into());
    }
}

impl<S, T: Argument<S>, const N: usize> Argument<S> for [T; N] {
    fn read(numbers: &mut impl Iterator<Item = S>) -> Self {
        core::array::from_fn(|_| T::read(numbers))
    }
}

impl<S, T: Numbers<S>, const N: usize> Numbers<S> for [T; N] {
    fn write(self, numbers: &mut Vec<S>) {
        for element in self {
            element.write(numbers);
        }
    }
}

macro_rules! glam {
    ($($type:ident: $numbers:ty, $from:ident, $to:ident;)*) => {$(
        impl Argument<f64> for $type {
            fn read(numbers: &mut impl Iterator<Item = f64>) -> Self {
                Self::$from(<$numbers>::read(numbers))
            }
        }

        impl Numbers<f64> for $type {
            fn write(self, numbers: &mut Vec<f64>) {
                self.$to().write(numbers);
            }
        }
    )*};
}

glam! {
    Vec2: [f32; 2], from_array, to_array;
    DVec2: [f64; 2], from_array, to_array;
    Vec3: [f32; 3], from_array, to_array;
    DVec3: [f64; 3], from_array, to_array;
    Quat: [f32; 4], from_array, to_array;
    DQuat: [f64; 4], from_array, to_array;
}

macro_rules! matrices {
    ($($type:ident: $number:ident;)*) => {$(
        impl Argument<f64> for $type {
            fn read(numbers: &mut impl Iterator<Item = f64>) -> Self {
                Self::from_cols_array(&<[$number; 9]>::read(numbers))
            }
        }

        impl Numbers<f64> for $type {
            fn write(self, numbers: &mut Vec<f64>) {
                self.to_cols_array().write(numbers);
            }
        }
    )*};
}

matrices! {
    Mat3: f32;
    DMat3: f64;
}

/// Reads a quaternion of any non-zero length, which is normalised, and a translation.
impl Argument<f64> for Rigid {
    fn read(numbers: &mut impl Iterator<Item = f64>) -> Self {
        let (rotation, translation) = (Quat::read(numbers), Vec3::read(numbers));
        Self::from_rotation_translation(rotation.normalize(), translation)
    }
}

/// Reads a quaternion of any non-zero length, which is normalised, and a translation.
impl Argument<f64> for DRigid {
    fn read(numbers: &mut impl Iterator<Item = f64>) -> Self {
        let (rotation, translation) = (DQuat::read(numbers), DVec3::read(numbers));
        Self::from_rotation_translation(rotation.normalize(), translation)
    }
}

/// Wraps a result of several numbers whose derivatives are stored with a row for each of them.
pub fn by_rows<V, D>((value, derivatives): (V, D)) -> ByRows<V, D> {
    ByRows(value, derivatives)
}

/// A value with derivatives by rows; made by [`by_rows`].
#[derive(Debug)]
pub struct ByRows<V, D>(V, D);

impl<V: Numbers<f64>, D: Rows> Numbers<f64> for ByRows<V, D> {
    fn write(self, numbers: &mut Vec<f64>) {
        self.0.write(numbers);
        self.1.write_columns(numbers);
    }
}

/// Rows of numbers that can be written column by column.
pub trait Rows {
    /// Appends the columns, one after another.
    fn write_columns(self, numbers: &mut Vec<f64>);
}

impl<T: Numbers<f64>, const N: usize> Rows for [T; N] {
    fn write_columns(self, numbers: &mut Vec<f64>) {
        let mut rows = Vec::new();
        self.write(&mut rows);
        let width = rows.len() / N;
        numbers.extend((0..width).flat_map(|k| rows.iter().skip(k).step_by(width)));
    }
}

impl<S, A: Argument<S>, B: Argument<S>> Argument<S> for (A, B) {
    fn read(numbers: &mut impl Iterator<Item = S>) -> Self {
        (A::read(numbers), B::read(numbers))
    }
}

/// `true` if the number is above 0.
impl Argument<f64> for bool {
    fn read(numbers: &mut impl Iterator<Item = f64>) -> Self {
        next(numbers) > 0.0
    }
}

impl Argument<f64> for u8 {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "samples are small whole numbers")]
    fn read(numbers: &mut impl Iterator<Item = f64>) -> Self {
        next(numbers) as Self
    }
}

macro_rules! tuples {
    ($($element:ident)*) => {
        impl<S, $($element: Numbers<S>),*> Numbers<S> for ($($element,)*) {
            #[expect(non_snake_case, reason = "named as their types")]
            fn write(self, numbers: &mut Vec<S>) {
                let ($($element,)*) = self;
                $($element.write(numbers);)*
            }
        }

        impl<$($element: Rows),*> Rows for ($($element,)*) {
            #[expect(non_snake_case, reason = "named as their types")]
            fn write_columns(self, numbers: &mut Vec<f64>) {
                let ($($element,)*) = self;
                $($element.write_columns(numbers);)*
            }
        }
    };
}

tuples!(A);
tuples!(A B);
tuples!(A B C);
tuples!(A B C D);
