//! Kernels of a rig as Rust functions: those of [`Rig`](crate::emit::Rig)'s trait in plain `f32`, the others generic
//! over the runtime's `Scalar`.
//!
//! The trait's kernels also run in users' debug builds, where every operator of a generic type is a function call, as
//! is every `get` and `try_from`. They therefore use only `f32` operators, constant indices and slice patterns.

use aim_symbolic::Op;
use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};

use super::body::{Arithmetic, Body, counted, local};
use crate::RigSpec;
use crate::objective::{AIM_GRADIENT, CHAIN_RESIDUAL_JACOBIAN, FirstLink, Kernel, Objective, Scope};

/// Objectives that the runtime's trait needs.
pub const TRAIT_OBJECTIVES: [&Objective; 2] = [&CHAIN_RESIDUAL_JACOBIAN, &AIM_GRADIENT];

/// Derives the kernels that the runtime's trait needs, without the first link if it is always the identity.
#[must_use]
pub fn trait_kernels(spec: &RigSpec) -> Vec<Kernel> {
    let first_link = |objective: &Objective| match objective.scope {
        // A joint's link spans all joints between the effector and it, so it is not the identity in general.
        Scope::Joint => FirstLink::Given,
        Scope::Chain => FirstLink::of(spec),
    };
    TRAIT_OBJECTIVES.into_iter().flat_map(|objective| objective.kernels(spec, first_link(objective))).collect()
}

/// Identifiers of a kernel's parameters.
struct Parameters {
    joint: Ident,
    link: Ident,
    links: Ident,
    target: Ident,
    sin_cos: Ident,
    out: Ident,
}

impl Parameters {
    fn new() -> Self {
        let [joint, link, links, target, sin_cos, out] =
            ["joint", "effector_to_joint", "links", "target", "sin_cos", "out"].map(local);
        Self { joint, link, links, target, sin_cos, out }
    }

    /// Returns the expression of input `i` of a kernel over `joints` joints.
    fn input(&self, scope: Scope, joints: usize, i: usize) -> TokenStream {
        let Self { link, links, target, sin_cos, .. } = self;
        let numbers = if scope == Scope::Joint { 12 } else { 12 * joints };
        match scope {
            _ if (numbers..numbers + 3).contains(&i) => index(target, i - numbers),
            Scope::Joint if i < numbers => index(link, i),
            Scope::Joint => index(sin_cos, i - numbers - 3),
            Scope::Chain if i < numbers => index_twice(links, i / 12, i % 12),
            Scope::Chain => index_twice(sin_cos, (i - numbers - 3) / 4, (i - numbers - 3) % 4),
        }
    }
}

/// Returns the function name of a kernel.
#[must_use]
pub fn function_name(kernel: &Kernel) -> String {
    let Objective { name, scope, .. } = kernel.objective;
    match scope {
        Scope::Joint => format!("{name}_{}", kernel.joints[0]),
        Scope::Chain => (*name).to_owned(),
    }
}

/// Body of a kernel's function.
#[derive(Clone, Debug)]
pub struct Lines {
    steps: Vec<(usize, TokenStream)>,
    /// Array expression of the outputs.
    pub results: TokenStream,
}

impl Lines {
    /// Returns the statement that computes the step with this number.
    #[must_use]
    pub fn step(&self, number: usize) -> Option<&TokenStream> {
        self.steps.iter().find(|(known, _)| *known == number).map(|(_, line)| line)
    }

    fn statements(&self) -> impl Iterator<Item = &TokenStream> {
        self.steps.iter().map(|(_, statement)| statement)
    }
}

/// Emits the body of a kernel's generic function, step by step; `krate` is the facade's path.
#[must_use]
pub fn lines(kernel: &Kernel, spec: &RigSpec, krate: &TokenStream) -> Lines {
    let number = quote!(S);
    let parameters = Parameters::new();
    body(kernel, &quote!(#krate::__private), Arithmetic::Generic(&number), &|i| {
        parameters.input(kernel.objective.scope, spec.joints.len(), i)
    })
}

fn body(kernel: &Kernel, private: &TokenStream, number: Arithmetic<'_>, input: &dyn Fn(usize) -> TokenStream) -> Lines {
    let body = Body { program: &kernel.program, number, private, input };
    let results = body.results();
    Lines { steps: body.statements(), results: quote!([#(#results),*]) }
}

/// Doc comment of a kernel's function.
fn doc(kernel: &Kernel, spec: &RigSpec) -> String {
    let names: Vec<String> = kernel.joints.iter().map(|&j| format!("`{}`", spec.joints[j].name)).collect();
    let outputs = (kernel.objective.outputs)(&names.join(", "), spec.angles());
    format!("{outputs} {}. Derived for the rig `{}`.", counted(kernel.program.count()), spec.name)
}

/// Emits the trait methods that compute `kernels`, which must be [`trait_kernels`].
pub(super) fn trait_methods(kernels: &[Kernel], spec: &RigSpec, private: &TokenStream) -> TokenStream {
    kernels
        .chunk_by(|a, b| a.objective == b.objective)
        .map(|kernels| match kernels[0].objective.scope {
            Scope::Joint => joint_method(kernels, spec, private),
            Scope::Chain => chain_method(&kernels[0], spec, private),
        })
        .collect()
}

fn joint_method(kernels: &[Kernel], spec: &RigSpec, private: &TokenStream) -> TokenStream {
    let parameters = Parameters::new();
    let Parameters { joint, link, target, sin_cos, .. } = &parameters;
    let arms = kernels.iter().map(|kernel| {
        let joints = kernel.joints.iter().map(|&j| Literal::usize_unsuffixed(j));
        let lines = body(kernel, private, Arithmetic::F32, &|i| parameters.input(Scope::Joint, 1, i));
        let (statements, results) = (lines.statements(), &lines.results);
        quote!(#(#joints)|* => { #(#statements)* #results })
    });
    let docs = kernels.iter().map(|kernel| doc(kernel, spec));
    quote! {
        #(#[doc = #docs])*
        fn aim_gradient(
            &self,
            #joint: ::core::primitive::usize,
            #link: &[::core::primitive::f32; 12],
            #target: &[::core::primitive::f32; 3],
            #sin_cos: &[::core::primitive::f32; 4],
        ) -> [::core::primitive::f32; 3] {
            match #joint {
                #(#arms)*
                _ => [0.0, 0.0, 0.0],
            }
        }
    }
}

fn chain_method(kernel: &Kernel, spec: &RigSpec, private: &TokenStream) -> TokenStream {
    let parameters = Parameters::new();
    let Parameters { links, target, sin_cos, out, .. } = &parameters;
    let joints = spec.joints.len();
    let element = |name: &str, i: usize| local(&format!("{name}_{i}"));
    // A slice pattern binds one array for each joint: it checks the length once, without a function call.
    let numbers = 12 * joints;
    let input = |i: usize| match i {
        _ if i < numbers => index(&element("link", i / 12), i % 12),
        _ if i < numbers + 3 => index(target, i - numbers),
        _ => index(&element("sin_cos", (i - numbers - 3) / 4), (i - numbers - 3) % 4),
    };
    let used = kernel.program.ops().iter().filter_map(|op| match op {
        Op::Input(i) => Some(*i as usize),
        _ => None,
    });
    let used: Vec<usize> = used.collect();
    let pattern = |name: &str, first: usize, length: usize| {
        let elements = (0..joints).map(|joint| {
            let from = first + length * joint;
            let is_used = used.iter().any(|input| (from..from + length).contains(input));
            if is_used {
                let name = element(name, joint);
                quote!(#name)
            } else {
                quote!(_)
            }
        });
        let elements: Vec<TokenStream> = elements.collect();
        quote!([#(#elements),*])
    };
    let (link_pattern, angle_pattern) = (pattern("link", 0, 12), pattern("sin_cos", numbers + 3, 4));
    let outputs: Vec<Ident> = (0..kernel.program.outputs().len()).map(|i| element("out", i)).collect();
    let body = Body { program: &kernel.program, number: Arithmetic::F32, private, input: &input };
    // Write each output as soon as it is known; a result that waits would occupy a register.
    let mut written = TokenStream::new();
    let mut results: Vec<_> = body.results().zip(outputs.iter().zip(kernel.program.outputs())).collect();
    for (number, statement) in body.statements().into_iter().chain([(usize::MAX, TokenStream::new())]) {
        results.retain(|(result, (output, value))| {
            let is_known = kernel.program.steps_until(**value) <= number;
            if is_known {
                written.extend(quote!(*#output = #result;));
            }
            !is_known
        });
        written.extend(statement);
    }
    let doc = doc(kernel, spec);
    quote! {
        #[doc = #doc]
        #[inline(always)]
        fn residual_jacobian(
            &self,
            #links: &[[::core::primitive::f32; 12]],
            #target: &[::core::primitive::f32; 3],
            #sin_cos: &[[::core::primitive::f32; 4]],
            #out: &mut [::core::primitive::f32],
        ) {
            let (#link_pattern, #angle_pattern, [#(#outputs),*]) = (#links, #sin_cos, &mut *#out) else {
                return <[::core::primitive::f32]>::fill(#out, 0.0);
            };
            #written
        }
    }
}

/// Emits the functions of `kernels`, generic over `Scalar`, and the rig's associated functions that call them.
pub(super) fn generic(kernels: &[Kernel], spec: &RigSpec, name: &Ident, krate: &TokenStream) -> Option<TokenStream> {
    let associated = kernels.chunk_by(|a, b| a.objective == b.objective);
    let associated: Vec<TokenStream> = associated
        .map(|kernels| match kernels[0].objective.scope {
            Scope::Joint => by_joint(kernels, spec, krate),
            Scope::Chain => by_slices(&kernels[0], spec, krate),
        })
        .collect();
    let functions = kernels.iter().map(|kernel| function(kernel, spec, krate));
    (!kernels.is_empty()).then(|| {
        quote! {
            #(#functions)*

            #[allow(dead_code, unreachable_pub, reason = "they were asked for, and may be called in one build only")]
            impl #name {
                #(#associated)*
            }
        }
    })
}

/// Emits the associated function that dispatches to a joint's kernel.
fn by_joint(kernels: &[Kernel], spec: &RigSpec, krate: &TokenStream) -> TokenStream {
    let Parameters { joint, link, target, sin_cos, .. } = Parameters::new();
    let arms = kernels.iter().map(|kernel| {
        let function = format_ident!("{}", function_name(kernel));
        let joints = kernel.joints.iter().map(|&j| Literal::usize_unsuffixed(j));
        quote!(#(#joints)|* => #function(#link, #target, #sin_cos),)
    });
    let name = format_ident!("{}", kernels[0].objective.name);
    let outputs = Literal::usize_unsuffixed(kernels[0].program.outputs().len());
    let docs = kernels.iter().map(|kernel| doc(kernel, spec));
    quote! {
        #(#[doc = #docs])*
        /// Zeros where there is no such joint.
        #[inline]
        pub fn #name<S: #krate::__private::Scalar>(
            #joint: ::core::primitive::usize,
            #link: &[S; 12],
            #target: &[S; 3],
            #sin_cos: &[S; 4],
        ) -> [S; #outputs] {
            match #joint {
                #(#arms)*
                _ => [<S as #krate::__private::Scalar>::ZERO; #outputs],
            }
        }
    }
}

/// Emits the associated function that takes slices; slices of the wrong length give zeros.
fn by_slices(kernel: &Kernel, spec: &RigSpec, krate: &TokenStream) -> TokenStream {
    let Parameters { links, target, sin_cos, out, .. } = Parameters::new();
    let name = format_ident!("{}", function_name(kernel));
    let joints = Literal::usize_unsuffixed(spec.joints.len());
    let outputs = Literal::usize_unsuffixed(kernel.program.outputs().len());
    let doc = doc(kernel, spec);
    quote! {
        #[doc = #doc]
        /// Slices of other lengths give zeros.
        #[inline]
        pub fn #name<S: #krate::__private::Scalar>(
            #links: &[[S; 12]],
            #target: &[S; 3],
            #sin_cos: &[[S; 4]],
            #out: &mut [S],
        ) {
            if let (
                ::core::result::Result::Ok(#links),
                ::core::result::Result::Ok(#sin_cos),
                ::core::result::Result::Ok(#out),
            ) = (
                <&[[S; 12]; #joints] as ::core::convert::TryFrom<&[[S; 12]]>>::try_from(#links),
                <&[[S; 4]; #joints] as ::core::convert::TryFrom<&[[S; 4]]>>::try_from(#sin_cos),
                <&mut [S; #outputs] as ::core::convert::TryFrom<&mut [S]>>::try_from(&mut *#out),
            ) {
                *#out = #name(#links, #target, #sin_cos);
            } else {
                <[S]>::fill(#out, <S as #krate::__private::Scalar>::ZERO);
            }
        }
    }
}

/// Emits a kernel as a function of arrays.
fn function(kernel: &Kernel, spec: &RigSpec, krate: &TokenStream) -> TokenStream {
    let Parameters { link, links, target, sin_cos, .. } = Parameters::new();
    let joints = Literal::usize_unsuffixed(spec.joints.len());
    let parameters = match kernel.objective.scope {
        Scope::Joint => quote!(#link: &[S; 12], #target: &[S; 3], #sin_cos: &[S; 4]),
        Scope::Chain => quote!(#links: &[[S; 12]; #joints], #target: &[S; 3], #sin_cos: &[[S; 4]; #joints]),
    };
    let outputs = Literal::usize_unsuffixed(kernel.program.outputs().len());
    let lines = lines(kernel, spec, krate);
    let (statements, results) = (lines.statements(), &lines.results);
    let (name, doc) = (format_ident!("{}", function_name(kernel)), doc(kernel, spec));
    quote! {
        #[doc = #doc]
        #[inline]
        fn #name<S: #krate::__private::Scalar>(#parameters) -> [S; #outputs] {
            #(#statements)*
            #results
        }
    }
}

fn index(array: &Ident, i: usize) -> TokenStream {
    let i = Literal::usize_unsuffixed(i);
    quote!(#array[#i])
}

fn index_twice(array: &Ident, i: usize, k: usize) -> TokenStream {
    let (i, k) = (Literal::usize_unsuffixed(i), Literal::usize_unsuffixed(k));
    quote!(#array[#i][#k])
}
