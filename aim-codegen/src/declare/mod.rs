//! What the user declared → a checked [`RigSpec`], or every error in it, each at its place.
//!
//! Three passes: `parse` turns a derive macro's tokens ([`from_derive_input`]) or a TOML file ([`from_toml`]) into one
//! neutral `tree`; `check` judges that; `report` says what is wrong, the same of both.

pub(crate) mod check;
pub(crate) mod parse;
mod place;
pub(crate) mod report;
pub(crate) mod tree;

#[cfg(test)]
mod tests;

use proc_macro2::TokenStream;
use quote::ToTokens;
use syn::{Data, DeriveInput};

use self::parse::item;
#[cfg(feature = "toml")]
use self::parse::toml_file;
pub use self::place::Place;
pub use self::report::diagnostics::{Diagnostic, Diagnostics};
use crate::RigSpec;

/// A checked declaration of a derive macro.
#[derive(Debug)]
#[non_exhaustive]
pub struct Declared {
    /// The rig.
    pub spec: RigSpec,
    /// The struct's name, with its span.
    pub ident: syn::Ident,
    /// The joints' fields, with their spans, `r#` and all; as many as the rig has joints.
    pub fields: Vec<syn::Ident>,
    /// The struct's visibility.
    pub vis: TokenStream,
    /// The path of `crate = …`, where it is not `::aim`.
    pub krate: Option<TokenStream>,
}

/// Reads and checks the item that carries `#[derive(AimRig)]`.
///
/// # Errors
///
/// Everything that is wrong with the declaration. [`fallback`](crate::emit::fallback) gives what to emit beside them.
pub fn from_derive_input(input: &DeriveInput) -> Result<Declared, Diagnostics> {
    let checked = check::check(&item::read(input)).map_err(|found| Diagnostics::new(found, None))?;
    let fields = match &input.data {
        Data::Struct(data) => data.fields.iter().filter_map(|field| field.ident.clone()).collect(),
        Data::Enum(_) | Data::Union(_) => Vec::new(),
    };
    let vis = input.vis.to_token_stream();
    Ok(Declared { spec: checked.spec, ident: input.ident.clone(), fields, vis, krate: checked.krate })
}

/// Reads and checks a rig's TOML file. `file_name` is what the errors call it.
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
/// Everything that is wrong with the declaration; [`Diagnostics::render`] shows it with line and column.
#[cfg(feature = "toml")]
pub fn from_toml(file_name: &str, text: &str) -> Result<RigSpec, Diagnostics> {
    let (rig, syntax) = toml_file::read(text);
    // What is missing from a file that does not parse is no mistake of its own.
    let checked = if syntax.is_empty() { check::check(&rig) } else { Err(syntax) };
    checked.map(|checked| checked.spec).map_err(|found| {
        let source = report::diagnostics::Source { name: file_name.to_owned(), text: text.to_owned() };
        Diagnostics::new(found, Some(source))
    })
}
