//! Constants that the companions of differentiated functions read, because the macro cannot see them.

/// A constant of the number type `N` of the function that reads it.
#[diagnostic::on_unimplemented(
    message = "`#[differentiate]` can only read constants of type `{N}` from elsewhere, found `{Self}`",
    label = "has type `{Self}`",
    note = "define the `const` inside the function, or next to it in a `#[differentiate] mod m {{ … }}`"
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
