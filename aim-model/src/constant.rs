//! Constants that the companions of differentiated functions read, because the macro cannot see them.

/// A constant of the number type `N` of the function that reads it.
#[diagnostic::on_unimplemented(
    message = "`#[differentiate]` reads constants of type `{N}` from outside, and this one is a `{Self}`",
    label = "of type `{Self}`",
    note = "write its `const` inside of the function, or beside it in a `#[differentiate] mod m {{ … }}`, where its value is seen"
)]
pub trait NumberConstant<N> {
    /// Its value.
    fn value(self) -> f64;
}

impl NumberConstant<Self> for f32 {
    #[inline]
    fn value(self) -> f64 {
        self.into()
    }
}

impl NumberConstant<Self> for f64 {
    #[inline]
    fn value(self) -> f64 {
        self
    }
}

/// The value of a constant of type `N`.
#[inline]
pub fn number_constant<N, C: NumberConstant<N>>(constant: C) -> f64 {
    constant.value()
}
