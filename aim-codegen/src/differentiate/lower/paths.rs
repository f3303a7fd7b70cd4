//! Paths in the function's body: their type and name, and their text.

use syn::Ident;

use crate::differentiate::names::segments;
use crate::differentiate::types;

/// Splits a path into the path of a type and the last segment: `glam::Vec3` and `new` for `glam::Vec3::new`, also for
/// `<glam::Vec3>::new` and `<glam::Vec3 as Trait>::new`.
pub(super) fn type_and_name(path: &syn::ExprPath) -> Option<(Option<Vec<String>>, &Ident)> {
    let name = &path.path.segments.last()?.ident;
    if let Some(qself) = &path.qself {
        let mut ty = &*qself.ty;
        while let syn::Type::Group(group) = ty {
            ty = &group.elem;
        }
        let syn::Type::Path(ty) = ty else { return None };
        return Some((Some(segments(&ty.path)), name));
    }
    let mut before = segments(&path.path);
    before.pop();
    // `glam::vec3`: a module, not a type.
    let is_type = |ty: &String| {
        types::named(ty).is_some() || types::is_integer(ty) || ty.starts_with(|c: char| c.is_ascii_uppercase())
    };
    let ty = before.last().is_some_and(is_type).then_some(before);
    Some((ty, name))
}

/// Returns a path as written.
pub(super) fn path_text(path: &syn::ExprPath) -> String {
    segments(&path.path).join("::")
}
