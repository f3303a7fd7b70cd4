//! [`Names`]: resolves paths in a module and in the modules inside it.
//!
//! An item is known by its full name, its path from the module that is read: `shapes::sphere`.

use syn::UseTree;

use super::lower::names_at;

/// The modules, the items that they define, and their imports.
#[derive(Default)]
pub(super) struct Names {
    modules: Vec<String>,
    items: Vec<String>,
    imports: Vec<Import>,
}

/// An imported name of a module.
struct Import {
    module: String,
    /// `None` for a glob import.
    name: Option<String>,
    path: Vec<String>,
}

/// The item that a path resolves to.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Meaning {
    /// An item of these modules, by its full name.
    Own(String),
    /// Any other item, by its path where it was imported.
    External(Vec<String>),
}

impl Meaning {
    /// Returns the name of a type: its full name, or the last segment if it is outside.
    pub(super) fn into_type(self) -> String {
        match self {
            Self::Own(name) => name,
            Self::External(mut path) => path.pop().unwrap_or_default(),
        }
    }
}

/// Returns the full name of an item of a module.
pub(super) fn join(module: &str, name: &str) -> String {
    if module.is_empty() { name.to_owned() } else { format!("{module}::{name}") }
}

/// Returns the generic arguments of a path, without lifetimes.
pub(super) fn arguments(path: &syn::Path) -> Vec<&syn::GenericArgument> {
    match path.segments.last().map(|last| &last.arguments) {
        Some(syn::PathArguments::AngleBracketed(of)) => {
            of.args.iter().filter(|argument| !matches!(argument, syn::GenericArgument::Lifetime(_))).collect()
        }
        _ => Vec::new(),
    }
}

/// Returns the segments of a path.
pub(super) fn segments(path: &syn::Path) -> Vec<String> {
    path.segments.iter().map(|segment| segment.ident.to_string()).collect()
}

/// Returns `true` for a path into the standard library.
pub(super) fn is_of_std(path: &[String]) -> bool {
    path.first().is_some_and(|krate| ["std", "core", "alloc"].contains(&krate.as_str()))
}

/// Returns the imports of a `use`: the name, `None` for a glob, and the path.
pub(super) fn imports(tree: &UseTree) -> Vec<(Option<String>, Vec<String>)> {
    let mut found = Vec::new();
    collect(tree, &[], &mut found);
    found
}

fn collect(tree: &UseTree, before: &[String], found: &mut Vec<(Option<String>, Vec<String>)>) {
    let path = |word: &syn::Ident| {
        let mut path = before.to_vec();
        // `shapes::{self}` is `shapes`.
        if before.is_empty() || word != "self" {
            path.push(word.to_string());
        }
        path
    };
    match tree {
        UseTree::Path(part) => collect(&part.tree, &path(&part.ident), found),
        UseTree::Name(name) => found.push((path(&name.ident).last().cloned(), path(&name.ident))),
        UseTree::Rename(name) => found.push((Some(name.rename.to_string()), path(&name.ident))),
        UseTree::Glob(_) => found.push((None, before.to_vec())),
        UseTree::Group(group) => group.items.iter().for_each(|tree| collect(tree, before, found)),
    }
}

impl Names {
    pub(super) fn add_module(&mut self, name: String) {
        self.modules.push(name);
    }

    pub(super) fn add_item(&mut self, name: String) {
        self.items.push(name);
    }

    pub(super) fn add_use(&mut self, module: &str, tree: &UseTree) {
        for (name, path) in imports(tree) {
            self.imports.push(Import { module: module.to_owned(), name, path });
        }
    }

    /// Resolves a path in a module.
    pub(super) fn meaning(&self, module: &str, path: &[String]) -> Meaning {
        self.follow(module, path, &mut Vec::new()).unwrap_or_else(|| Meaning::External(path.to_vec()))
    }

    /// Iterates over the names of the items of a module and of the modules inside it.
    pub(super) fn names_in<'a>(&'a self, module: &'a str) -> impl Iterator<Item = &'a str> {
        self.items.iter().chain(&self.modules).filter_map(move |name| {
            let name = if module.is_empty() { name } else { name.strip_prefix(module)?.strip_prefix("::")? };
            (!name.contains("::")).then_some(name)
        })
    }

    /// Like [`meaning`](Self::meaning), but returns `None` for an unknown path. `under_way` holds the names that are
    /// being looked up, because imports may be cyclic.
    fn follow(&self, module: &str, path: &[String], under_way: &mut Vec<(String, String)>) -> Option<Meaning> {
        let (first, rest) = path.split_first()?;
        let found = match first.as_str() {
            "self" => Meaning::Own(module.to_owned()),
            "super" if module.is_empty() => return None,
            "super" => Meaning::Own(module.rsplit_once("::").map_or("", |(parent, _)| parent).to_owned()),
            name => self.name(module, name, under_way)?,
        };
        match found {
            found if rest.is_empty() => Some(found),
            Meaning::Own(inner) if inner.is_empty() || self.modules.contains(&inner) => {
                self.follow(&inner, rest, under_way)
            }
            Meaning::Own(_) => None,
            Meaning::External(mut path) => {
                path.extend_from_slice(rest);
                Some(Meaning::External(path))
            }
        }
    }

    fn name(&self, module: &str, name: &str, under_way: &mut Vec<(String, String)>) -> Option<Meaning> {
        let full = join(module, name);
        if self.items.contains(&full) || self.modules.contains(&full) {
            return Some(Meaning::Own(full));
        }
        let query = (module.to_owned(), name.to_owned());
        if under_way.contains(&query) {
            return None;
        }
        under_way.push(query);
        let mine = || self.imports.iter().filter(|import| import.module == module);
        if let Some(import) = mine().find(|import| import.name.as_deref() == Some(name)) {
            // An external crate of the same name.
            let found = self.follow(module, &import.path, under_way);
            return Some(found.unwrap_or_else(|| Meaning::External(import.path.clone())));
        }
        mine().filter(|import| import.name.is_none()).find_map(|import| {
            let mut path = import.path.clone();
            match self.follow(module, &path, under_way) {
                Some(Meaning::Own(inner)) => self.name(&inner, name, under_way),
                _ if names_at(&path).any(|known| known == name) => {
                    path.push(name.to_owned());
                    Some(Meaning::External(path))
                }
                _ => None,
            }
        })
    }
}

/// Returns `true` for types of glam that are not supported.
pub(super) fn is_unsupported(name: &str) -> bool {
    let is_vector = || {
        let (kind, size) = name.split_once("Vec").unwrap_or_default();
        let kinds = ["B", "I", "U", "I8", "U8", "I16", "U16", "I64", "U64", "ISize", "USize"];
        kinds.contains(&kind) && ["2", "3", "3A", "4", "4A"].contains(&size)
    };
    matches!(name, "Affine2" | "DAffine2" | "Affine3" | "EulerRot") || is_vector()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_lead_through_imports() {
        let mut names = Names::default();
        names.add_module("shapes".into());
        names.add_module("shapes::round".into());
        names.add_module("shapes::round::small".into());
        for item in ["K", "shapes::K", "shapes::round::ball"] {
            names.add_item(item.into());
        }
        for (module, import) in [
            ("", "use shapes::round::{self, ball as sphere}; use std::f64::consts::*;"),
            ("shapes", "use super::*; use round::*; use glam::DVec3 as V;"),
            ("shapes::round", "use super::*;"),
        ] {
            let file: syn::File = syn::parse_str(import).expect("imports");
            for item in file.items {
                let syn::Item::Use(item) = item else { panic!("imports alone") };
                names.add_use(module, &item.tree);
            }
        }
        let outside = |path: &str| Meaning::External(path.split("::").map(str::to_owned).collect());
        for (module, path, expected) in [
            ("", "K", Meaning::Own("K".into())),
            ("shapes", "K", Meaning::Own("shapes::K".into())),
            ("shapes", "super::K", Meaning::Own("K".into())),
            ("shapes::round", "K", Meaning::Own("shapes::K".into())),
            ("", "sphere", Meaning::Own("shapes::round::ball".into())),
            ("", "round::ball", Meaning::Own("shapes::round::ball".into())),
            ("", "self::shapes::round::ball", Meaning::Own("shapes::round::ball".into())),
            ("shapes", "ball", Meaning::Own("shapes::round::ball".into())),
            ("shapes::round", "V", outside("glam::DVec3")),
            ("shapes::round::small", "super::super::K", Meaning::Own("shapes::K".into())),
            ("", "PI", outside("std::f64::consts::PI")),
            ("", "super::K", outside("super::K")),
            ("shapes", "crate::K", outside("crate::K")),
            ("", "K::unknown", outside("K::unknown")),
        ] {
            let segments: Vec<String> = path.split("::").map(str::to_owned).collect();
            assert_eq!(names.meaning(module, &segments), expected, "{path} in {module}");
        }
    }
}
