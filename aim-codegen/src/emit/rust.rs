//! Rust back end: the implementations of `Rig` and `AimRig`, the pose struct, and the kernels that were requested.
//!
//! Emitted code refers to items only through `::core` and the facade's hidden re-export. It does not rely on the
//! prelude, does not allocate, does not panic, and is the same for a derived struct and for a TOML file.

use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::{format_ident, quote};

use super::Rig;
use super::body::local;
use super::rust_kernels::{self, trait_kernels};
use crate::{AngleRange, Budget, Budgets, JointSpec, NaturalSpec, RigSpec};
use aim_model::{LimitsFrom, Role};

/// Names of the item that code is emitted for.
#[derive(Clone, Debug)]
pub struct Item {
    /// Name of the struct.
    pub name: Ident,
    /// Names of the fields, from the effector inward.
    pub fields: Vec<Ident>,
    /// Visibility of the struct.
    pub vis: TokenStream,
    /// Path of the facade crate, `::aim` unless overridden.
    pub krate: TokenStream,
}

impl Item {
    /// Returns the names for a rig that was not declared as a struct.
    #[must_use]
    pub fn of(spec: &RigSpec, krate: TokenStream) -> Self {
        let ident = |name: &str| Ident::new(name, Span::call_site());
        Self {
            name: ident(&spec.name),
            fields: spec.joints.iter().map(|j| ident(&j.name)).collect(),
            vis: quote!(pub),
            krate,
        }
    }

    /// Name of the struct with one value for each joint.
    fn pose(&self) -> Ident {
        format_ident!("{}Pose", self.name)
    }
}

/// Emits the struct that a derive would be attached to, and its implementations.
#[must_use]
pub fn emit_with_struct(rig: &Rig<'_>, item: &Item) -> TokenStream {
    let Item { name, fields, krate, .. } = item;
    let doc = format!("The rig `{}`: its joints, from the effector inward.", rig.spec.name);
    let field_docs = rig.spec.joints.iter().map(|joint| format!("Moves the bone {}.", quoted(&joint.bones, " or ")));
    let implementation = emit(rig, item);
    quote! {
        #[doc = #doc]
        #[derive(::core::clone::Clone, ::core::marker::Copy, ::core::fmt::Debug, ::core::default::Default)]
        pub struct #name {
            #( #[doc = #field_docs] pub #fields: #krate::Joint, )*
        }
        #implementation
    }
}

/// Emits the implementations, the pose struct, and `rig.kernels` as associated functions.
///
/// The kernels of the runtime's trait are always [`trait_kernels`], independent of `rig.kernels`.
#[must_use]
pub fn emit(rig: &Rig<'_>, item: &Item) -> TokenStream {
    let Item { name, krate, .. } = item;
    let private = quote!(#krate::__private);
    let spec = rig.spec;
    let pose = pose(item);
    let conversions = conversions(item);
    let description = description(spec, &private);
    let names = names(spec);
    let methods = rust_kernels::trait_methods(&trait_kernels(spec), spec, &private);
    let generic = rust_kernels::generic(rig.kernels, spec, name, krate);
    let joints = Literal::usize_unsuffixed(spec.joints.len());
    let fields = &item.fields;
    let value = local("value");
    let places: Vec<Ident> = (0..fields.len()).map(|i| local(&format!("joint_{i}"))).collect();
    // Needed only for code in files: clippy skips most lints in macro expansions.
    quote! {
        #pose

        #[allow(
            clippy::approx_constant,
            clippy::inline_always,
            clippy::manual_range_patterns,
            clippy::too_many_lines,
            clippy::unreadable_literal,
            reason = "derived code is for machines: its numbers and its length are those of the rig"
        )]
        const _: () = {
            #[automatically_derived]
            impl #private::Rig for #name {
                #[inline]
                fn description(&self) -> #private::Description<'_> {
                    *<Self as #private::AimRig>::DESCRIPTION
                }

                #names

                #methods
            }

            #[automatically_derived]
            impl #private::AimRig for #name {
                type Array<T: ::core::marker::Copy> = [T; #joints];

                const RIG: &'static Self = &Self { #( #fields: #private::Joint::REST ),* };

                #description

                #[inline]
                fn array<T: ::core::marker::Copy>(#value: T) -> [T; #joints] {
                    [#value; #joints]
                }

                #[inline]
                fn from_joints([#(#places),*]: [#private::Joint; #joints]) -> Self {
                    Self { #( #fields: #places ),* }
                }
            }

            #[automatically_derived]
            impl ::core::convert::From<#name> for [#private::Joint; #joints] {
                #[inline]
                fn from(#value: #name) -> Self {
                    [#( #value.#fields ),*]
                }
            }

            #conversions

            #generic
        };
    }
}

/// Emits the struct with one named value for each joint.
pub(super) fn pose(item: &Item) -> TokenStream {
    let Item { name, fields, vis, krate } = item;
    let pose = item.pose();
    let doc = format!(
        "A value for each joint of [`{name}`]: its pose, corrections, or anything else that is wanted by name."
    );
    let docs = fields.iter().map(|field| format!("Of the joint `{field}`."));
    quote! {
        #[doc = #doc]
        #[allow(dead_code, reason = "a rig may be used without it")]
        #[derive(::core::clone::Clone, ::core::marker::Copy, ::core::fmt::Debug)]
        #vis struct #pose<T = #krate::__private::Affine3A> {
            #( #[doc = #docs] #vis #fields: T, )*
        }
    }
}

/// Emits the conversions between the pose struct and an array, in both directions.
pub(super) fn conversions(item: &Item) -> TokenStream {
    let Item { fields, krate, .. } = item;
    let (pose, value) = (item.pose(), local("pose"));
    let joints = Literal::usize_unsuffixed(fields.len());
    let places: Vec<Ident> = (0..fields.len()).map(|i| local(&format!("joint_{i}"))).collect();
    quote! {
        #[automatically_derived]
        impl<T> ::core::convert::From<#pose<T>> for [T; #joints] {
            #[inline]
            fn from(#value: #pose<T>) -> Self {
                [#( #value.#fields ),*]
            }
        }

        #[automatically_derived]
        impl<T> ::core::convert::From<[T; #joints]> for #pose<T> {
            #[inline]
            fn from([#(#places),*]: [T; #joints]) -> Self {
                Self { #( #fields: #places ),* }
            }
        }

        #[automatically_derived]
        impl ::core::convert::From<#pose> for #krate::__private::Pose<[#krate::__private::Affine3A; #joints]> {
            #[inline]
            fn from(#value: #pose) -> Self {
                <Self>::new(::core::convert::Into::into(#value))
            }
        }
    }
}

/// Emits the description constant.
fn description(spec: &RigSpec, private: &TokenStream) -> TokenStream {
    let infos = spec.joints.iter().map(|joint| joint_info(joint, private));
    let natural = spec.natural.as_ref().map(|spec| natural(spec, private));
    let region = spec.region.as_ref().map(|budgets| region(budgets, private));
    let [forward, origin] = [spec.effector.frame.forward, spec.effector.origin].map(vector);
    quote! {
        const DESCRIPTION: &'static #private::Description<'static> = &#private::Description::new(&[#(#infos),*])
            .with_effector(#private::Effector { forward: #forward, origin: #origin })
            #natural
            #region;
    }
}

/// Emits the methods that return the names of joints, of their bones, of held bones and of the other eye's bone.
fn names(spec: &RigSpec) -> TokenStream {
    let [joint, candidate] = ["joint", "candidate"].map(local);
    let joints: Vec<Literal> = (0..spec.joints.len()).map(Literal::usize_unsuffixed).collect();
    let joint_names = spec.joints.iter().map(|joint| &joint.name);
    let bones = spec.joints.iter().zip(&joints).flat_map(|(joint, number)| {
        joint.bones.iter().enumerate().map(move |(candidate, bone)| {
            let candidate = Literal::usize_unsuffixed(candidate);
            quote!((#number, #candidate) => ::core::option::Option::Some(#bone),)
        })
    });
    let held: Vec<TokenStream> = spec
        .joints
        .iter()
        .zip(&joints)
        .flat_map(|(joint, number)| {
            joint.hold.iter().flatten().enumerate().map(move |(place, bone)| {
                let place = Literal::usize_unsuffixed(place);
                quote!((#number, #place) => ::core::option::Option::Some(#bone),)
            })
        })
        .collect();
    let usize = quote!(::core::primitive::usize);
    let name = quote!(::core::option::Option<&::core::primitive::str>);
    let held = (!held.is_empty()).then(|| {
        quote! {
            fn held_bone(&self, #joint: #usize, #candidate: #usize) -> #name {
                match (#joint, #candidate) {
                    #(#held)*
                    _ => ::core::option::Option::None,
                }
            }
        }
    });
    let other_eye = spec.joints.first().and_then(|joint| joint.other_eye.as_ref()).map(|bone| {
        quote! {
            fn other_eye_bone(&self) -> #name {
                ::core::option::Option::Some(#bone)
            }
        }
    });
    quote! {
        fn joint_name(&self, #joint: #usize) -> #name {
            match #joint {
                #( #joints => ::core::option::Option::Some(#joint_names), )*
                _ => ::core::option::Option::None,
            }
        }

        fn bone_name(&self, #joint: #usize, #candidate: #usize) -> #name {
            match (#joint, #candidate) {
                #(#bones)*
                _ => ::core::option::Option::None,
            }
        }

        #held

        #other_eye
    }
}

/// Formats names as code in a doc comment.
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
    let stiffness = float(joint.stiffness);
    let upright = joint.upright.map(float).map(|u| quote!(.with_upright(#u)));
    let pitch_taper = joint.pitch_taper.map(float).map(|n| quote!(.with_pitch_taper(#n)));
    let role = match joint.role {
        Role::None => None,
        role => {
            let role = format_ident!("{role:?}");
            Some(quote!(.with_role(#private::Role::#role)))
        }
    };
    let limits_from = match joint.limits_from {
        LimitsFrom::Animation => None,
        LimitsFrom::BindPose => Some(quote!(.with_limits_from(#private::LimitsFrom::BindPose))),
    };
    quote! {
        #private::JointInfo::new(#private::Axes { up: #up, forward: #forward, left: #left }, #rate)
            #heading #pitch #acceleration .with_stiffness(#stiffness) #upright #pitch_taper #role #limits_from
    }
}

/// Emits the builder call that sets the declared gaze sharing on a description.
fn natural(natural: &NaturalSpec, private: &TokenStream) -> TokenStream {
    let [eyes_only, head_share, engage, release, delay] =
        [natural.eyes_only, natural.head_share, natural.engage, natural.release, natural.delay].map(float);
    quote! {
        .with_sharing(
            #private::GazeSharing::HUMAN
                .with_eyes_only(#eyes_only)
                .with_head_share(#head_share)
                .with_engagement(#engage, #release)
                .with_delay(#delay)
        )
    }
}

/// Emits the builder call that sets the declared region budgets on a description.
fn region(budgets: &Budgets, private: &TokenStream) -> TokenStream {
    let budget = |budget: &Budget| {
        let [[right, left], [down, up]] = [budget.heading, budget.pitch].map(|ends| ends.map(float));
        let (rate, acceleration) = (float(budget.rate), float(budget.acceleration));
        quote! {
            #private::Budget {
                heading: [#right, #left], pitch: [#down, #up], rate: #rate, acceleration: #acceleration
            }
        }
    };
    let (head, chest) = (budget(&budgets.head), budget(&budgets.chest));
    quote!(.with_budgets(#private::Budgets { head: #head, chest: #chest }))
}

fn vector(components: [f64; 3]) -> TokenStream {
    let components = components.map(float);
    quote!([#(#components),*])
}

/// Emits a float literal. The sign is a token of its own, because a literal token cannot be negative in Rust's grammar.
#[expect(clippy::cast_possible_truncation, reason = "declared numbers are stored in f32")]
fn float(value: f64) -> TokenStream {
    let magnitude = Literal::f32_unsuffixed((value as f32).abs());
    if value < 0.0 { quote!(-#magnitude) } else { quote!(#magnitude) }
}
