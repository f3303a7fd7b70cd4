//! Rust: the `AimRig` implementation with its kernels, generic over the runtime's `Scalar`.
//!
//! Emitted code names `::core` and the facade's hidden re-export, uses nothing of the prelude, does not allocate,
//! panic or branch, and is the same for a derived struct and for a TOML file.

use aim_symbolic::Program;
use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::{format_ident, quote};

use super::Rig;
use super::body::{Body, counted, local};
use crate::{AngleRange, JointSpec, NaturalSpec, RigSpec, Role};

/// The names that emitted code stands among.
#[derive(Clone, Debug)]
pub struct Item {
    /// The struct.
    pub name: Ident,
    /// Its fields, from the effector inward.
    pub fields: Vec<Ident>,
    /// The facade's path, `::aim` unless overridden.
    pub krate: TokenStream,
}

impl Item {
    /// The names of a rig that was not declared as a struct.
    pub fn of(spec: &RigSpec, krate: TokenStream) -> Self {
        let ident = |name: &str| Ident::new(name, Span::call_site());
        Self { name: ident(&spec.name), fields: spec.joints.iter().map(|j| ident(&j.name)).collect(), krate }
    }
}

/// The struct that a derive would have found, and its implementation.
pub fn emit_with_struct(rig: &Rig<'_>, item: &Item) -> TokenStream {
    let Item { name, fields, krate } = item;
    let doc = format!("The rig `{}`: its joints, from the effector inward.", rig.spec.name);
    let field_docs = rig.spec.joints.iter().map(|joint| format!("Moves the bone {}.", quoted(&joint.bones, " or ")));
    let implementation = emit(rig, item);
    quote! {
        #[doc = #doc]
        pub struct #name {
            #( #[doc = #field_docs] pub #fields: #krate::Joint, )*
        }
        #implementation
    }
}

/// The implementation.
pub fn emit(rig: &Rig<'_>, item: &Item) -> TokenStream {
    let Item { name, fields, krate } = item;
    let private = quote!(#krate::__private);
    let spec = rig.spec;
    let joints = Literal::usize_unsuffixed(spec.joints.len());
    let value = local("value");
    let states = local("states");
    let index = local("index");
    let places: Vec<Literal> = (0..fields.len()).map(Literal::usize_unsuffixed).collect();
    let formatter = local("formatter");
    let infos = spec.joints.iter().map(|joint| joint_info(joint, &private));
    let natural = spec.natural.as_ref().map(|spec| natural(spec, &private));
    let effector_forward = vector(spec.effector.frame.forward);
    let effector_origin = vector(spec.effector.origin);
    let bones = spec.joints.iter().map(|joint| {
        let names = &joint.bones;
        quote!(&[#(#names),*])
    });
    let name_text = &spec.name;
    let field_texts: Vec<&str> = spec.joints.iter().map(|joint| joint.name.as_str()).collect();
    // By path, because a method of a trait for every type could be found before one that borrows.
    let debug = fields.iter().zip(field_texts).fold(
        quote!(&mut ::core::fmt::Formatter::debug_struct(#formatter, #name_text)),
        |debug, (field, text)| quote!(::core::fmt::DebugStruct::field(#debug, #text, &self.#field)),
    );
    let kernels = Kernels::new(rig, &private);
    let (functions, methods) = (kernels.functions(), kernels.methods());
    // For code in files: what a macro expands to is excused anyway.
    quote! {
        #[allow(
            clippy::approx_constant,
            clippy::manual_range_patterns,
            clippy::too_many_lines,
            clippy::unreadable_literal,
            reason = "derived code is for machines: its numbers and its length are those of the rig"
        )]
        const _: () = {
            impl #name {
                /// The names that each joint's bone may have in a model, from the effector inward.
                #[allow(dead_code, unreachable_pub, reason = "a rig need not be looked up by its bones' names")]
                pub const BONES: [&'static [&'static ::core::primitive::str]; #joints] = [#(#bones),*];
            }

            #[automatically_derived]
            impl ::core::default::Default for #name {
                /// At rest: every angle 0.
                fn default() -> Self {
                    Self { #( #fields: ::core::default::Default::default() ),* }
                }
            }

            #[automatically_derived]
            impl ::core::fmt::Debug for #name {
                fn fmt(&self, #formatter: &mut ::core::fmt::Formatter<'_>) -> ::core::fmt::Result {
                    ::core::fmt::DebugStruct::finish(#debug)
                }
            }

            #[automatically_derived]
            impl #private::AimRig for #name {
                type Array<T: ::core::marker::Copy> = [T; #joints];

                #[inline]
                fn array<T: ::core::marker::Copy>(&self, #value: T) -> [T; #joints] {
                    [#value; #joints]
                }

                #[inline]
                fn joint_infos(&self) -> &[#private::JointInfo] {
                    const INFOS: [#private::JointInfo; #joints] = [#(#infos),*];
                    &INFOS
                }

                #[inline]
                fn effector(&self) -> #private::Effector {
                    #private::Effector { forward: #effector_forward, origin: #effector_origin }
                }

                #natural

                #[inline]
                fn joints(&self) -> [#private::Joint; #joints] {
                    [#( self.#fields ),*]
                }

                #[inline]
                fn joint(&self, #index: ::core::primitive::usize) -> ::core::option::Option<&#private::Joint> {
                    match #index {
                        #( #places => ::core::option::Option::Some(&self.#fields), )*
                        _ => ::core::option::Option::None,
                    }
                }

                #[inline]
                fn joint_mut(&mut self, #index: ::core::primitive::usize) -> ::core::option::Option<&mut #private::Joint> {
                    match #index {
                        #( #places => ::core::option::Option::Some(&mut self.#fields), )*
                        _ => ::core::option::Option::None,
                    }
                }

                #[inline]
                fn set_joints(&mut self, #states: [#private::Joint; #joints]) {
                    [#( self.#fields ),*] = #states;
                }

                #methods
            }

            #functions
        };
    }
}

/// Names as documentation shows code.
fn quoted(names: &[impl std::fmt::Display], between: &str) -> String {
    names.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(between)
}

fn joint_info(joint: &JointSpec, private: &TokenStream) -> TokenStream {
    let [up, forward, left] = [joint.frame.up, joint.frame.forward, joint.frame.left].map(vector);
    let rate = float(joint.rate);
    let range = |range: Option<AngleRange>, with: &str| {
        let with = format_ident!("{with}");
        range.map(|range| {
            let (lo, hi) = match range {
                AngleRange::Between(lo, hi) => (float(lo), float(hi)),
                AngleRange::Free => {
                    (quote!(<::core::primitive::f32>::NEG_INFINITY), quote!(<::core::primitive::f32>::INFINITY))
                }
            };
            quote!(.#with(#lo, #hi))
        })
    };
    let heading = range(joint.heading, "with_heading");
    let pitch = range(joint.pitch, "with_pitch");
    let acceleration = joint.acceleration.map(float).map(|a| quote!(.with_acceleration(#a)));
    let comfort = float(joint.comfort);
    let level = joint.level.map(float).map(|l| quote!(.with_level(#l)));
    let narrowing = joint.narrowing.map(float).map(|n| quote!(.with_narrowing(#n)));
    let role = match joint.role() {
        Role::Other => None,
        role => {
            let role = format_ident!("{role:?}");
            Some(quote!(.with_role(#private::Role::#role)))
        }
    };
    let absolute = joint.absolute.then(|| quote!(.with_absolute_range()));
    quote! {
        #private::JointInfo::new(#private::Axes { up: #up, forward: #forward, left: #left }, #rate)
            #heading #pitch #acceleration .with_comfort(#comfort) #level #narrowing #role #absolute
    }
}

/// The method that hands a declared sharing on.
fn natural(natural: &NaturalSpec, private: &TokenStream) -> TokenStream {
    let [eyes_only, head_share, engage, release, delay] =
        [natural.eyes_only, natural.head_share, natural.engage, natural.release, natural.delay].map(float);
    quote! {
        fn natural(&self) -> #private::Natural {
            <#private::Natural as ::core::default::Default>::default()
                .with_eyes_only(#eyes_only)
                .with_head_share(#head_share)
                .with_engagement(#engage, #release)
                .with_delay(#delay)
        }
    }
}

fn vector(components: [f64; 3]) -> TokenStream {
    let components = components.map(float);
    quote!([#(#components),*])
}

/// A float literal, its sign a token of its own, as the parser of Rust wants it.
#[expect(clippy::cast_possible_truncation, reason = "declared numbers are stored in f32")]
fn float(value: f64) -> TokenStream {
    let magnitude = Literal::f32_unsuffixed((value as f32).abs());
    if value < 0.0 { quote!(-#magnitude) } else { quote!(#magnitude) }
}

/// The kernels of a rig, equal ones once.
struct Kernels<'a> {
    private: &'a TokenStream,
    spec: &'a RigSpec,
    /// Distinct joint programs with the joints that they serve.
    joints: Vec<(&'a Program, Vec<usize>)>,
    value_gradient: &'a Program,
    residual_jacobian: &'a Program,
}

impl<'a> Kernels<'a> {
    fn new(rig: &'a Rig<'_>, private: &'a TokenStream) -> Self {
        let mut joints: Vec<(&Program, Vec<usize>)> = Vec::new();
        for (joint, program) in rig.programs.joints.iter().enumerate() {
            match joints.iter_mut().find(|(known, _)| *known == program) {
                Some((_, served)) => served.push(joint),
                None => joints.push((program, vec![joint])),
            }
        }
        Self {
            private,
            spec: rig.spec,
            joints,
            value_gradient: &rig.programs.chain_value_gradient,
            residual_jacobian: &rig.programs.chain_residual_jacobian,
        }
    }

    fn joint_function(served: &[usize]) -> Ident {
        format_ident!("aim_gradient_{}", served[0])
    }

    fn methods(&self) -> TokenStream {
        let private = self.private;
        let [joint, link, target, sin_cos, links, out] =
            ["joint", "effector_to_joint", "target", "sin_cos", "links", "out"].map(local);
        let arms = self.joints.iter().map(|(_, served)| {
            let function = Self::joint_function(served);
            let served = served.iter().map(|&j| Literal::usize_unsuffixed(j));
            quote!(#(#served)|* => #function(#link, #target, #sin_cos),)
        });
        let joints = Literal::usize_unsuffixed(self.spec.joints.len());
        let chain = |method: &str, function: &str, outputs: usize| {
            let (method, function) = (format_ident!("{method}"), format_ident!("{function}"));
            let outputs = Literal::usize_unsuffixed(outputs);
            quote! {
                #[inline]
                fn #method<S: #private::Scalar>(
                    &self,
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
                        *#out = #function(#links, #target, #sin_cos);
                    } else {
                        <[S]>::fill(#out, <S as #private::Scalar>::ZERO);
                    }
                }
            }
        };
        let angles = self.spec.angles();
        let value_gradient = chain("chain_value_gradient", "value_gradient", 1 + angles);
        let residual_jacobian = chain("chain_residual_jacobian", "residual_jacobian", 2 + 2 * angles);
        quote! {
            #[inline]
            fn aim_gradient<S: #private::Scalar>(
                &self,
                #joint: ::core::primitive::usize,
                #link: &[S; 12],
                #target: &[S; 3],
                #sin_cos: &[S; 4],
            ) -> [S; 3] {
                match #joint {
                    #(#arms)*
                    _ => [<S as #private::Scalar>::ZERO; 3],
                }
            }
            #value_gradient
            #residual_jacobian
        }
    }

    fn functions(&self) -> TokenStream {
        let joints = self.joints.iter().map(|(program, served)| {
            let names: Vec<&str> = served.iter().map(|&j| self.spec.joints[j].name.as_str()).collect();
            let doc = format!("Aim, ∂aim/∂pitch, ∂aim/∂heading of {}.", quoted(&names, ", "));
            let [link, target, sin_cos] = ["effector_to_joint", "target", "sin_cos"].map(local);
            let input = |i: usize| match i {
                0..12 => index(&link, i),
                12..15 => index(&target, i - 12),
                _ => index(&sin_cos, i - 15),
            };
            let parameters = quote!(#link: &[S; 12], #target: &[S; 3], #sin_cos: &[S; 4]);
            self.function(&Self::joint_function(served), &doc, &parameters, program, &input)
        });
        let count = self.spec.joints.len();
        let chain = |name: &str, doc: &str, program: &Program| {
            let [links, target, sin_cos] = ["links", "target", "sin_cos"].map(local);
            let input = |i: usize| match i {
                _ if i < 12 * count => index_twice(&links, i / 12, i % 12),
                _ if i < 12 * count + 3 => index(&target, i - 12 * count),
                _ => index_twice(&sin_cos, (i - 12 * count - 3) / 4, (i - 12 * count - 3) % 4),
            };
            let joints = Literal::usize_unsuffixed(count);
            let parameters = quote!(#links: &[[S; 12]; #joints], #target: &[S; 3], #sin_cos: &[[S; 4]; #joints]);
            self.function(&format_ident!("{name}"), doc, &parameters, program, &input)
        };
        let value_gradient = chain("value_gradient", "The chain's aim, then its derivatives.", self.value_gradient);
        let residual_jacobian = chain(
            "residual_jacobian",
            "The chain's residual (left, up), then the derivatives of each.",
            self.residual_jacobian,
        );
        quote! { #(#joints)* #value_gradient #residual_jacobian }
    }

    fn function(
        &self,
        name: &Ident,
        doc: &str,
        parameters: &TokenStream,
        program: &Program,
        input: &dyn Fn(usize) -> TokenStream,
    ) -> TokenStream {
        let private = self.private;
        let outputs = Literal::usize_unsuffixed(program.outputs().len());
        let doc = format!("{doc} {}. Derived for the rig `{}`.", counted(program.count()), self.spec.name);
        let number = quote!(S);
        let body = Body { program, number: &number, private, input };
        let steps = body.steps();
        let results = program.outputs().iter().map(|&v| body.operand(v));
        quote! {
            #[doc = #doc]
            #[inline]
            fn #name<S: #private::Scalar>(#parameters) -> [S; #outputs] {
                #steps
                [#(#results),*]
            }
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
