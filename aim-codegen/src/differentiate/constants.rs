//! [`Constant`], and [`Surroundings`]: what stands around the item that an attribute sees, known or assumed.

use std::cell::{Cell, OnceCell, RefCell};
use std::fs;
use std::path::PathBuf;
use std::rc::Rc;

use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::{format_ident, quote};
use syn::{Attribute, Expr, Item};

use super::lower::Scope;

/// A constant, or an immutable `static`.
pub(super) struct Constant {
    pub(super) scope: Rc<Scope>,
    pub(super) ty: Option<syn::Type>,
    pub(super) value: Expr,
}

/// An assumption about a path outside of the item that an attribute sees.
#[derive(PartialEq, Eq)]
pub(super) enum Assumption {
    /// It is a constant with this whole value, 0 or 1 for a boolean.
    Integer(Vec<Ident>, i64),
    /// It is the mathematical constant of its name.
    Number(Vec<String>),
    /// It is the item or module of its name in `core`, or in this module of it.
    Item(Ident, Option<String>),
}

/// The integers and booleans of the file around an attribute, and what is assumed of names outside of the item.
///
/// The file is read when a constant is looked up for the first time. Its text does not tell which item a name means where
/// the attribute stands, so each assumption is asserted in the companions, by the compiler.
#[derive(Default)]
pub(super) struct Surroundings {
    /// `None` if the file is unknown, as in editors, or is not to be read.
    file: Option<PathBuf>,
    constants: OnceCell<Vec<(String, Constant)>>,
    /// The number of constants that are being evaluated, one for the other.
    depth: Cell<usize>,
    assumed: RefCell<Vec<Assumption>>,
}

impl Surroundings {
    /// Creates the surroundings of `span`, without reading its file.
    pub(super) fn new(span: Span) -> Self {
        Self { file: span.local_file(), ..Self::default() }
    }

    /// Returns the constant of this name, if the file has exactly one.
    pub(super) fn constant(&self, name: &str) -> Option<&Constant> {
        let constants = self.constants.get_or_init(|| {
            let text = self.file.as_ref().and_then(|file| fs::read_to_string(file).ok());
            let file = text.and_then(|text| syn::parse_file(&text).ok());
            let mut found = Vec::new();
            add_constants(file.map(|file| file.items).unwrap_or_default(), &mut found);
            found
        });
        let mut several = constants.iter().filter(|(known, _)| known == name);
        let (_, first) = several.next()?;
        several.next().is_none().then_some(first)
    }

    /// Evaluates a constant of the file. The others that it is computed from need not be confirmed: its own value will be.
    pub(super) fn within<R>(&self, evaluate: impl FnOnce() -> R) -> R {
        self.depth.set(self.depth.get() + 1);
        let value = evaluate();
        self.depth.set(self.depth.get() - 1);
        value
    }

    /// Records an assumption, which the compiler has to confirm.
    pub(super) fn assume(&self, assumption: Assumption) {
        let mut assumed = self.assumed.borrow_mut();
        if self.depth.get() == 0 && !assumed.contains(&assumption) {
            assumed.push(assumption);
        }
    }

    /// Returns assertions of all assumptions since the last call. They are to stand in a function.
    pub(super) fn take_assertions(&self) -> TokenStream {
        let mut assertions = TokenStream::new();
        let mut imports = TokenStream::new();
        for assumption in self.assumed.take() {
            match assumption {
                Assumption::Integer(path, value) => {
                    let name = path.iter().map(ToString::to_string).collect::<Vec<_>>().join("::");
                    let value = Literal::i64_unsuffixed(value);
                    let text = format!("`{name}` is not the constant of this file that `#[differentiate]` took it for");
                    assertions.extend(quote!(
                        const _: () = ::core::assert!(#(#path)::* as ::core::primitive::i128 == #value, #text);
                    ));
                }
                Assumption::Number(path) => {
                    let name = path.last().map(|name| format_ident!("{name}"));
                    let text =
                        format!("`{}` is not the mathematical constant, which it was taken for", path.join("::"));
                    let path = path.iter().map(|segment| format_ident!("{segment}"));
                    let path = quote!(#(#path)::* as ::core::primitive::f64);
                    assertions.extend(quote!(
                        const _: () = ::core::assert!(
                            #path == ::core::f64::consts::#name
                                || #path == ::core::f32::consts::#name as ::core::primitive::f64,
                            #text
                        );
                    ));
                }
                Assumption::Item(name, module) => {
                    let module = module.map(|module| format_ident!("{module}")).into_iter();
                    imports.extend(quote!(
                        mod #name {
                            // If these are two items, the name is ambiguous.
                            use super::super::*;
                            use ::core::#(#module::)*
                            *;
                            use self::#name as _assumed;
                        }
                    ));
                }
            }
        }
        if !imports.is_empty() {
            assertions.extend(quote!(
                #[allow(unused_imports, reason = "they are there to be compared")]
                mod assumed { #imports }
            ));
        }
        assertions
    }
}

/// Appends the constants of a module and of the modules inside it. Those that depend on `cfg` have no known value.
fn add_constants(items: Vec<Item>, found: &mut Vec<(String, Constant)>) {
    for item in items {
        match item {
            Item::Const(item) if !has_cfg(&item.attrs) => {
                let constant = Constant { scope: Rc::default(), ty: Some(*item.ty), value: *item.expr };
                found.push((item.ident.to_string(), constant));
            }
            Item::Mod(syn::ItemMod { attrs, content: Some((_, items)), .. }) if !has_cfg(&attrs) => {
                add_constants(items, found);
            }
            _ => {}
        }
    }
}

/// Returns `true` if one of these attributes is `cfg`.
pub(super) fn has_cfg(attributes: &[Attribute]) -> bool {
    attributes.iter().any(|attribute| attribute.path().is_ident("cfg"))
}
