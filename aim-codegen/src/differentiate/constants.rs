//! [`Constant`], and [`FileConstants`]: integers and booleans of the file around an attribute, outside of the item that it
//! sees.

use std::cell::{Cell, OnceCell, RefCell};
use std::fs;
use std::path::PathBuf;
use std::rc::Rc;

use proc_macro2::{Literal, Span, TokenStream};
use quote::quote;
use syn::{Attribute, Expr, Item};

use super::lower::Scope;
use super::names::segments;

/// A constant, or an immutable `static`.
pub(super) struct Constant {
    pub(super) scope: Rc<Scope>,
    pub(super) ty: Option<syn::Type>,
    pub(super) value: Expr,
}

/// The constants of a file. It is read when one is looked up for the first time.
///
/// The text does not tell which constant a name means where the attribute stands. So the value of each one that is used
/// is asserted there, by the compiler.
#[derive(Default)]
pub(super) struct FileConstants {
    /// `None` if the file is unknown, as in editors, or is not to be read.
    file: Option<PathBuf>,
    constants: OnceCell<Vec<(String, Constant)>>,
    /// The number of constants that are being evaluated, one for the other.
    depth: Cell<usize>,
    /// Paths of constants, with the values that they are assumed to have.
    assumed: RefCell<Vec<(syn::Path, i64)>>,
}

impl FileConstants {
    /// Creates the constants of the file that `span` is in, without reading it.
    pub(super) fn new(span: Span) -> Self {
        Self { file: span.local_file(), ..Self::default() }
    }

    /// Returns the constant of this name, if the file has exactly one.
    pub(super) fn get(&self, name: &str) -> Option<&Constant> {
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

    /// Records a value that the compiler has to confirm.
    pub(super) fn assume(&self, path: &syn::Path, value: i64) {
        let mut assumed = self.assumed.borrow_mut();
        if self.depth.get() == 0 && !assumed.iter().any(|(known, _)| segments(known) == segments(path)) {
            assumed.push((path.clone(), value));
        }
    }

    /// Returns assertions of all assumed values.
    pub(super) fn assertions(&self) -> TokenStream {
        let assumed = self.assumed.borrow();
        let assertions = assumed.iter().map(|(path, value)| {
            let name = segments(path).join("::");
            let (value, text) = (
                Literal::i64_unsuffixed(*value),
                format!("`{name}` is not the constant of this file that `#[differentiate]` took it for"),
            );
            quote!(
                const _: () = ::core::assert!(#path as ::core::primitive::i128 == #value, #text);
            )
        });
        assertions.collect()
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
