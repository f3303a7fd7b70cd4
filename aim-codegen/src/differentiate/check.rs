//! The generated test that compares a function's derivatives with central differences.

use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};

use super::companion::{Companion, Derived};
use super::emit::Companions;
use super::manifold::{Side, VaryingPart};
use super::types::{Precision, Shape, Type};

impl Companions<'_> {
    /// Emits the test, for a function whose companion returns derivatives; `None` without a result.
    pub(super) fn check(&self, derived: &Derived) -> Option<TokenStream> {
        let (krate, function) = (self.krate, &self.item.sig.ident);
        let result = self.arguments.result.as_ref()?;
        let suffix = self.arguments.suffix(Companion::First)?;
        let (name, test) =
            (format_ident!("{function}_{suffix}"), format_ident!("{function}_{suffix}_agrees_with_differences"));
        let precision = self.arguments.precision();
        let (mut points, mut made, mut variables) = (Points::new(precision, krate), Vec::new(), Vec::new());
        for (index, argument) in self.arguments.list.iter().enumerate() {
            let axes = derived.unit_axes.iter().filter(|(argument, _)| *argument == index);
            (points.component, points.unit_axes) = (0, axes.map(|(_, first)| *first).collect());
            let value = argument.ty.assemble(&mut |leaf| points.leaf_value(leaf, argument.varying_part));
            made.push(if argument.ty.borrowed { quote!(&#value) } else { value });
            variables.extend(argument.variable.map(|place| (place, core::mem::take(&mut points.variable_indices))));
        }
        let Points { draws, count, .. } = points;
        variables.sort_by_key(|(place, _)| *place);
        let places = variables.into_iter().flat_map(|(_, places)| places).map(Literal::usize_unsuffixed);
        let places: Vec<Literal> = places.collect();
        let single = precision.name() == "f32";
        let numbers = |ty: &Type, place: &TokenStream| {
            let mut numbers = Vec::new();
            ty.numbers(place, precision, &mut numbers);
            quote!([#(#numbers as ::core::primitive::f64),*])
        };
        let (value, size) = (numbers(result, &quote!(value)), result.components());
        let slopes = self.slopes(result);
        let count_of_slopes = slopes.len();
        let private = quote!(#krate::__private::differences);
        let (mut original, mut derived) = (quote!(#function(#(#made),*)), quote!(#name(#(#made),*)));
        if self.arguments.is_optional {
            // NaN marks a point without a value; it is not compared.
            original = quote!(match #original.into_iter().next() {
                ::core::option::Option::Some(value) => value,
                ::core::option::Option::None => return [::core::primitive::f64::NAN; #size],
            });
            derived = quote!(match #derived {
                ::core::option::Option::Some(derived) => derived,
                ::core::option::Option::None => return [[::core::primitive::f64::NAN; #size]; #count_of_slopes],
            });
        }
        Some(quote! {
            #[cfg(test)]
            #[test]
            #[allow(trivial_numeric_casts, clippy::all, clippy::pedantic, reason = "written by `check = true`")]
            fn #test() {
                extern crate std;
                #private::agree(
                    ::core::stringify!(#function),
                    (&[#(#private::Draw::#draws),*], &[#(#places),*], #single),
                    |at: &[::core::primitive::f64; #count]| {
                        // A panic means that the function rejects these arguments; the point is not compared.
                        let value = || {
                            let value = #original;
                            #value
                        };
                        std::panic::catch_unwind(value).unwrap_or([::core::primitive::f64::NAN; #size])
                    },
                    |at: &[::core::primitive::f64; #count]| {
                        let (_, slopes) = #derived;
                        [#(#slopes),*]
                    },
                );
            }
        })
    }

    /// Returns, for each number of the variables, the expressions of the derivatives of all numbers of the result.
    fn slopes(&self, result: &Type) -> Vec<TokenStream> {
        let size = result.components();
        let precision = self.arguments.precision();
        let numbers = |ty: &Type, place: &TokenStream| ty.varying(place, precision);
        let mut slopes = Vec::new();
        for (index, variable) in self.arguments.variables().into_iter().enumerate() {
            let index = Literal::usize_unsuffixed(index);
            let (of_it, ty) = (quote!(slopes.#index), &variable.slope);
            let columns: Vec<Vec<TokenStream>> = match (&result.shape, &ty.shape) {
                (Shape::Scalar, _) => numbers(ty, &of_it).into_iter().map(|number| vec![number]).collect(),
                (Shape::Planar | Shape::Vector | Shape::Four, Shape::Scalar) => vec![numbers(result, &of_it)],
                (Shape::Vector, Shape::Vector) => {
                    let columns =
                        (0..3).map(Literal::usize_unsuffixed).map(|k| numbers(result, &quote!(#of_it.col(#k))));
                    columns.collect()
                }
                (Shape::Planar | Shape::Vector | Shape::Four, _) => {
                    let columns = (0..ty.dimension()).map(Literal::usize_unsuffixed);
                    columns.map(|k| numbers(result, &quote!(#of_it[#k]))).collect()
                }
                _ => {
                    let rows = (0..size).map(Literal::usize_unsuffixed).map(|k| numbers(ty, &quote!(#of_it[#k])));
                    let rows: Vec<Vec<TokenStream>> = rows.collect();
                    (0..ty.dimension()).map(|k| rows.iter().map(|row| row[k].clone()).collect()).collect()
                }
            };
            let columns = columns.into_iter().map(|column| quote!([#(#column as ::core::primitive::f64),*]));
            slopes.extend(columns);
        }
        slopes
    }
}

/// The numbers of the points at which a function is tested: `at[0]` and so on.
struct Points<'a> {
    precision: Precision,
    krate: &'a TokenStream,
    /// Number of numbers so far.
    count: usize,
    /// Kind of random value for each draw.
    draws: Vec<TokenStream>,
    /// Indices of the numbers of the current argument that derivatives are taken with respect to.
    variable_indices: Vec<usize>,
    /// Number of numbers of the current argument so far, without steps.
    component: usize,
    /// Indices among them at which vectors of length 1 begin.
    unit_axes: Vec<usize>,
}

impl<'a> Points<'a> {
    fn new(precision: Precision, krate: &'a TokenStream) -> Self {
        let (draws, variable_indices, unit_axes) = (Vec::new(), Vec::new(), Vec::new());
        Self { precision, krate, count: 0, draws, variable_indices, component: 0, unit_axes }
    }

    /// Returns the expressions of the next `size` numbers, in the function's number type.
    fn next(&mut self, size: usize) -> Vec<TokenStream> {
        let (first, number) = (self.count, format_ident!("{}", self.precision.name()));
        self.count += size;
        let places = (first..self.count).map(Literal::usize_unsuffixed);
        places.map(|place| quote!((at[#place] as ::core::primitive::#number))).collect()
    }

    /// Builds a value of a type that is not composed of others.
    fn leaf_value(&mut self, leaf: &Type, varying_part: VaryingPart) -> TokenStream {
        let is_unit = self.unit_axes.contains(&self.component);
        self.component += leaf.components();
        if let VaryingPart::Tangent(side) = varying_part
            && leaf.has_rotation()
        {
            return self.perturbed_rotation(leaf, side);
        }
        let (first, size) = (self.count, leaf.components());
        let original = &leaf.tokens;
        let still = varying_part == VaryingPart::Nothing;
        let (draw, draws) = match leaf.shape {
            Shape::Truth => (quote!(Truth), 1),
            Shape::Integer => (quote!(Below(4)), 1),
            Shape::Choice(variants) => {
                let variants = Literal::usize_unsuffixed(variants);
                (quote!(Below(#variants)), 1)
            }
            Shape::Quaternion if still => (quote!(Quaternion), 1),
            Shape::Rigid => (quote!(Rigid), 1),
            Shape::Vector if still && is_unit => (quote!(Direction), 1),
            _ => (quote!(Number), size),
        };
        self.draws.extend(vec![draw; draws]);
        let numbers = self.next(size);
        if !still && !leaf.is_discrete() {
            self.variable_indices.extend(first..self.count);
        }
        let place = Literal::usize_unsuffixed(first);
        match leaf.shape {
            Shape::Truth => quote!((at[#place] > 0.0)),
            Shape::Integer | Shape::Choice(_) => quote!((at[#place] as #original)),
            _ => leaf.build(&numbers),
        }
    }

    /// Builds a rotation or transform, moved on its manifold by numbers that are 0.
    fn perturbed_rotation(&mut self, leaf: &Type, side: Side) -> TokenStream {
        let ty = &leaf.tokens;
        let double = self.precision == Precision::Double;
        let glam = |name: &str| leaf.neighbour(&if double { format!("D{name}") } else { name.to_owned() }, self.krate);
        let (quat, vec3) = (glam("Quat"), glam("Vec3"));
        let is_rigid = matches!(leaf.shape, Shape::Rigid);
        self.draws.push(if is_rigid { quote!(Rigid) } else { quote!(Quaternion) });
        let drawn = self.next(if is_rigid { 12 } else { 4 });
        let first = self.count;
        let steps = self.next(if is_rigid { 6 } else { 3 });
        self.draws.extend(vec![quote!(Zero); steps.len()]);
        self.variable_indices.extend(first..self.count);
        let (turn, shift) = steps.split_at(3);
        let turn = quote!(<#quat>::from_scaled_axis(<#vec3>::new(#(#turn),*)));
        let (still, step) = match leaf.shape {
            Shape::Rigid => {
                let shift = quote!(<#vec3>::new(#(#shift),*));
                (leaf.build(&drawn), quote!(<#ty>::from_rotation_translation(#turn, #shift)))
            }
            Shape::Matrix => {
                (quote!(<#ty>::from_quat(<#quat>::from_xyzw(#(#drawn),*))), quote!(<#ty>::from_quat(#turn)))
            }
            _ => (leaf.build(&drawn), turn),
        };
        if side == Side::Left { quote!((#step * #still)) } else { quote!((#still * #step)) }
    }
}
