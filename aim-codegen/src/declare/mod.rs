//! Reads and checks declarations: returns a [`RigSpec`], or all errors with their places.
//!
//! Three passes: `parse` turns a derive macro's tokens ([`from_derive_input`]) or a TOML file ([`from_toml`]) into one
//! neutral `tree`; `check` validates the tree; `report` words the errors, identically for both front ends.

pub(crate) mod check;
pub(crate) mod parse;
pub(crate) mod report;
mod source_place;
pub(crate) mod tree;

#[cfg(test)]
mod tests;

use proc_macro2::TokenStream;
use quote::ToTokens;
use syn::{Data, DeriveInput};

use self::parse::item;
#[cfg(feature = "toml")]
use self::parse::toml_file;
pub use self::report::diagnostics::{Diagnostic, Diagnostics};
pub use self::source_place::SourcePlace;
use crate::RigSpec;

/// A checked declaration of a derive macro.
#[derive(Debug)]
#[non_exhaustive]
pub struct Declared {
    /// The checked rig.
    pub spec: RigSpec,
    /// Name of the struct, with its span.
    pub ident: syn::Ident,
    /// The joints' fields, with their spans and including any `r#`; one for each joint of the rig.
    pub fields: Vec<syn::Ident>,
    /// Visibility of the struct.
    pub vis: TokenStream,
    /// Path given by `crate = …`; `None` for `::aim`.
    pub krate: Option<TokenStream>,
}

/// Reads and checks the item that carries `#[derive(AimRig)]`.
///
/// # Errors
///
/// Returns all errors of the declaration. [`fallback`](crate::emit::fallback) returns the stub items to emit beside
/// them.
pub fn from_derive_input(input: &DeriveInput) -> Result<Declared, Diagnostics> {
    let checked = check::check(&item::read(input)).map_err(|found| Diagnostics::new(found, None))?;
    let fields = match &input.data {
        Data::Struct(data) => data.fields.iter().filter_map(|field| field.ident.clone()).collect(),
        Data::Enum(_) | Data::Union(_) => Vec::new(),
    };
    let vis = input.vis.to_token_stream();
    Ok(Declared { spec: checked.spec, ident: input.ident.clone(), fields, vis, krate: checked.krate })
}

/// Reads and checks a rig's TOML file. `file_name` is the name shown in errors.
///
/// ```
/// let rig = "name = 'Lamp'\naxes = { up = '+Y', forward = '+Z' }\n[[joint]]\nname = 'base'\nheading = 'free'\nrate = '90deg'\n";
/// let spec = aim_codegen::declare::from_toml("lamp.toml", rig)?;
/// assert_eq!(spec.joints[0].name, "base");
///
/// let errors = aim_codegen::declare::from_toml("lamp.toml", &rig.replace("90deg", "fast")).unwrap_err();
/// assert!(errors.render().contains("lamp.toml:6:8"));
/// # Ok::<(), aim_codegen::declare::Diagnostics>(())
/// ```
///
/// # Errors
///
/// Returns all errors of the declaration; [`Diagnostics::render`] formats them with line and column.
#[cfg(feature = "toml")]
pub fn from_toml(file_name: &str, text: &str) -> Result<RigSpec, Diagnostics> {
    let (rig, syntax) = toml_file::read(text);
    // After a syntax error, missing settings are not errors of their own.
    let checked = if syntax.is_empty() { check::check(&rig) } else { Err(syntax) };
    checked.map(|checked| checked.spec).map_err(|found| {
        let source = report::diagnostics::Source { name: file_name.to_owned(), text: text.to_owned() };
        Diagnostics::new(found, Some(source))
    })
}
