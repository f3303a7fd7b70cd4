//! Paths of the function's body: what they name, and how they are written.

use syn::Ident;

use crate::differentiate::types;

/// The type's name and the last word of a path: `Vec3` and `new` of `glam::Vec3::new`, and of `<Vec3>::new` too.
pub(super) fn type_and_name(path: &syn::ExprPath) -> Option<(Option<String>, &Ident)> {
    let segments = &path.path.segments;
    let name = &segments.last()?.ident;
    let ty = match &path.qself {
        Some(qself) if qself.position == 0 => match &*qself.ty {
            syn::Type::Path(ty) => Some(ty.path.segments.last()?.ident.to_string()),
            syn::Type::Group(group) => match &*group.elem {
                syn::Type::Path(ty) => Some(ty.path.segments.last()?.ident.to_string()),
                _ => return None,
            },
            _ => return None,
        },
        Some(_) => return None,
        None => segments.len().checked_sub(2).map(|at| segments[at].ident.to_string()),
    };
    // `glam::vec3`: a module, not a type.
    let ty = ty.filter(|ty| types::named(ty).is_some() || ty.starts_with(|c: char| c.is_ascii_uppercase()));
    Some((ty, name))
}

/// A path as written.
pub(super) fn path_text(path: &syn::ExprPath) -> String {
    path.path.segments.iter().map(|segment| segment.ident.to_string()).collect::<Vec<_>>().join("::")
}
