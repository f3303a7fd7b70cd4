//! Vectors and rotations of dual numbers, with which objectives are written a second time from their definitions,
//! without code of the library or glam.

use std::ops::{Add, Neg, Sub};

use num_dual::DualNum;
pub use num_dual::{Dual64, HyperDual64};

use crate::function::{Argument, Numbers, next};

/// A dual number over `f64`.
pub trait Number: DualNum<Primitive = f64> + Copy + Argument<Self> + Numbers<Self> {}

impl<D: DualNum<Primitive = f64> + Copy + Argument<D> + Numbers<D>> Number for D {}

/// A vector of dual numbers.
#[derive(Clone, Copy, Debug)]
pub struct Vector<D>(pub [D; 3]);

/// A quaternion x, y, z, w of dual numbers.
#[derive(Clone, Copy, Debug)]
pub struct Quaternion<D>(pub [D; 4]);

/// A rigid transform of dual numbers.
#[derive(Clone, Copy, Debug)]
pub struct Frame<D> {
    /// Rotation; the quaternion may have any length.
    pub rotation: Quaternion<D>,
    /// Position of the frame's origin.
    pub origin: Vector<D>,
}

impl<D: Number> Vector<D> {
    /// Returns a constant vector.
    pub fn constant(components: [f64; 3]) -> Self {
        Self(components.map(D::from))
    }

    /// Returns the dot product Σ vᵢ wᵢ.
    pub fn dot(self, other: Self) -> D {
        let ([a, b, c], [x, y, z]) = (self.0, other.0);
        a * x + b * y + c * z
    }

    /// Returns the cross product v × w.
    pub fn cross(self, other: Self) -> Self {
        let ([a, b, c], [x, y, z]) = (self.0, other.0);
        Self([b * z - c * y, c * x - a * z, a * y - b * x])
    }

    /// Returns k v.
    pub fn times(self, k: D) -> Self {
        Self(self.0.map(|c| c * k))
    }

    /// Returns the length |v|.
    pub fn length(self) -> D {
        self.dot(self).sqrt()
    }

    /// Returns the unit vector v / |v|.
    pub fn unit(self) -> Self {
        self.times(self.length().recip())
    }

    /// Returns the vector rotated about X, Y or Z (`axis` 0, 1, 2), right-handed.
    pub fn about(self, axis: usize, angle: D) -> Self {
        let (from, towards) = ((axis + 1) % 3, (axis + 2) % 3);
        let (sin, cos) = (angle.sin(), angle.cos());
        let mut turned = self;
        turned.0[from] = self.0[from] * cos - self.0[towards] * sin;
        turned.0[towards] = self.0[from] * sin + self.0[towards] * cos;
        turned
    }

    /// Returns the vector rotated about a unit axis: the part along the axis is unchanged.
    pub fn about_axis(self, axis: Self, angle: D) -> Self {
        let along = axis.times(axis.dot(self));
        let across = self - along;
        along + across.times(angle.cos()) + axis.cross(across).times(angle.sin())
    }
}

impl<D: Number> Quaternion<D> {
    /// Rotates a vector by the normalised quaternion.
    pub fn turn(self, v: Vector<D>) -> Vector<D> {
        let [x, y, z, w] = self.0;
        let square = x * x + y * y + z * z + w * w;
        let u = Vector([x, y, z]);
        let aside = u.cross(v);
        v + (aside.times(w) + u.cross(aside)).times(square.recip() * 2.0)
    }
}

impl<D: Number> Frame<D> {
    /// Maps a point out of the frame.
    pub fn point(self, point: Vector<D>) -> Vector<D> {
        self.rotation.turn(point) + self.origin
    }

    /// Maps a constant direction out of the frame.
    pub fn direction(self, direction: [f64; 3]) -> Vector<D> {
        self.rotation.turn(Vector::constant(direction))
    }
}

impl<D: Number> Add for Vector<D> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self(core::array::from_fn(|k| self.0[k] + other.0[k]))
    }
}

impl<D: Number> Sub for Vector<D> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self(core::array::from_fn(|k| self.0[k] - other.0[k]))
    }
}

impl<D: Number> Neg for Vector<D> {
    type Output = Self;
    fn neg(self) -> Self {
        Self(self.0.map(|c| -c))
    }
}

macro_rules! scalars {
    ($($number:ident)*) => {$(
        impl Argument<$number> for $number {
            fn read(numbers: &mut impl Iterator<Item = Self>) -> Self {
                next(numbers)
            }
        }

        impl Numbers<$number> for $number {
            fn write(self, numbers: &mut Vec<Self>) {
                numbers.push(self);
            }
        }
    )*};
}

scalars!(Dual64 HyperDual64);

impl<D: Number> Argument<D> for Vector<D> {
    fn read(numbers: &mut impl Iterator<Item = D>) -> Self {
        Self(<[D; 3]>::read(numbers))
    }
}

impl<D: Number> Numbers<D> for Vector<D> {
    fn write(self, numbers: &mut Vec<D>) {
        self.0.write(numbers);
    }
}

impl<D: Number> Argument<D> for Quaternion<D> {
    fn read(numbers: &mut impl Iterator<Item = D>) -> Self {
        Self(<[D; 4]>::read(numbers))
    }
}

impl<D: Number> Argument<D> for Frame<D> {
    fn read(numbers: &mut impl Iterator<Item = D>) -> Self {
        Self { rotation: Quaternion::read(numbers), origin: Vector::read(numbers) }
    }
}
