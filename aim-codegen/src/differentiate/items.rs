//! [`Items`]: the items of a module that its functions may use.

use std::cell::RefCell;
use std::rc::Rc;

use proc_macro2::{Span, TokenStream, TokenTree};
use quote::ToTokens;
use syn::{Attribute, Expr, Fields, FnArg, GenericParam, ImplItem, Item, Member, Pat, Signature, TraitItem};

use super::constants::{Constant, Surroundings, has_cfg};
use super::lower::{Callable, Scope};
use super::names::{Meaning, Names, join, segments};

/// Key of an item: `None` and the item's full name, or the full name of a type and the name of its associated item.
type Name = (Option<String>, String);

/// The items of a module, and of the modules inside it.
#[derive(Default)]
pub(super) struct Items {
    names: Names,
    constants: Vec<(Name, Constant)>,
    /// Several have the same name if a type implements a trait, such as `From`, more than once.
    functions: Vec<(Name, Rc<Callable>)>,
    structs: Vec<(String, Structure)>,
    enums: Vec<(String, Enumeration)>,
    traits: Vec<(String, Rc<Scope>, syn::ItemTrait)>,
    /// Implementations of traits: the trait's full name, the name that the type is known by, and the type that `Self`
    /// is.
    implementations: Vec<(String, String, String)>,
    aliases: Vec<(String, Alias)>,
    /// Names of items that depend on `cfg`; these items are not read.
    conditional: Vec<String>,
    /// Constants of the file around the module.
    pub(super) surroundings: Surroundings,
    /// Functions with reported errors; further calls of them report nothing.
    faulty: RefCell<Vec<Rc<Callable>>>,
    /// Structs and enums whose fields are being read, to detect recursive types.
    under_way: RefCell<Vec<String>>,
}

/// A generic parameter other than a lifetime.
pub(super) struct Parameter {
    pub(super) name: String,
    /// `true` for a length, `false` for a type.
    pub(super) is_length: bool,
}

/// A struct; the types of its fields are as written in its module.
pub(super) struct Structure {
    pub(super) scope: Rc<Scope>,
    pub(super) parameters: Vec<Parameter>,
    pub(super) fields: Vec<(Member, syn::Type)>,
    /// `true` if `Default` is derived.
    pub(super) has_default: bool,
}

/// An enum; the types of its variants' fields are as written in its module.
pub(super) struct Enumeration {
    pub(super) scope: Rc<Scope>,
    pub(super) parameters: Vec<Parameter>,
    pub(super) variants: Vec<Variant>,
    /// Index of the default variant, if `Default` is derived.
    pub(super) default: Option<usize>,
}

/// A variant of an enum.
pub(super) struct Variant {
    pub(super) name: String,
    /// Explicit discriminant.
    pub(super) discriminant: Option<Expr>,
    pub(super) fields: Vec<(Member, syn::Type)>,
}

/// A type alias; its type is as written in its module.
pub(super) struct Alias {
    pub(super) scope: Rc<Scope>,
    pub(super) parameters: Vec<Parameter>,
    pub(super) ty: syn::Type,
}

impl Items {
    /// Reads the items of a module. Items that its functions cannot use are left out.
    pub(super) fn of(module: &[Item]) -> Self {
        let mut items = Self::default();
        items.add_names("", module);
        items.add_module(&Rc::new(Scope::default()), module);
        items.add_provided();
        items
    }

    /// Adds the provided methods and constants of the module's traits to implementing types that do not define them.
    fn add_provided(&mut self) {
        for (of_trait, known_as, ty) in core::mem::take(&mut self.implementations) {
            let Some((_, scope, definition)) = self.traits.iter().find(|(known, ..)| *known == of_trait) else {
                continue;
            };
            let scope = Rc::new(Scope { self_type: Some(ty), ..(**scope).clone() });
            for part in &definition.items {
                let (name, function, constant) = match part {
                    TraitItem::Fn(syn::TraitItemFn { sig, default: Some(block), .. }) => {
                        let of_trait = Some(definition.ident.to_string());
                        (&sig.ident, Some(Rc::new(callable(sig, block, scope.clone(), of_trait))), None)
                    }
                    TraitItem::Const(syn::TraitItemConst { ident, ty, default: Some((_, value)), .. }) => {
                        let ty = Some(ty.clone());
                        (ident, None, Some(Constant { scope: scope.clone(), ty, value: value.clone() }))
                    }
                    _ => continue,
                };
                let name = (Some(known_as.clone()), name.to_string());
                let is_there = self.functions.iter().any(|(known, _)| *known == name)
                    || self.constants.iter().any(|(known, _)| *known == name);
                if !is_there {
                    self.functions.extend(function.map(|function| (name.clone(), function)));
                    self.constants.extend(constant.map(|constant| (name, constant)));
                }
            }
        }
    }

    /// The same items in the file that `span` is in.
    pub(super) fn in_file_of(self, span: Span) -> Self {
        Self { surroundings: Surroundings::new(span), ..self }
    }

    /// Records the names of all items, so that paths can be resolved.
    fn add_names(&mut self, module: &str, parts: &[Item]) {
        for item in parts {
            if depends_on_cfg(item.to_token_stream()).is_some() && !matches!(item, Item::Mod(_)) {
                continue;
            }
            match item {
                Item::Use(item) => self.names.add_use(module, &item.tree),
                Item::Mod(syn::ItemMod { attrs, ident, content: Some((_, parts)), .. }) if !has_cfg(attrs) => {
                    let name = join(module, &ident.to_string());
                    self.names.add_module(name.clone());
                    self.add_names(&name, parts);
                }
                item => {
                    if let Some(name) = name_of_item(item) {
                        self.names.add_item(join(module, &name));
                    }
                    // Variants are looked up, and imported, like the items of a module.
                    if let Item::Enum(item) = item {
                        let name = join(module, &item.ident.to_string());
                        for variant in &item.variants {
                            self.names.add_item(join(&name, &variant.ident.to_string()));
                        }
                        self.names.add_module(name);
                    }
                }
            }
        }
    }

    fn add_module(&mut self, scope: &Rc<Scope>, parts: &[Item]) {
        let full = |name: &syn::Ident| join(&scope.module, &name.to_string());
        for item in parts {
            if let Item::Mod(syn::ItemMod { attrs, ident, content: Some((_, parts)), .. }) = item
                && !has_cfg(attrs)
            {
                self.add_module(&Rc::new(Scope { module: full(ident), ..Scope::default() }), parts);
                continue;
            }
            if depends_on_cfg(item.to_token_stream()).is_some() {
                self.conditional.extend(name_of_item(item));
                continue;
            }
            let constant = |ty: &syn::Type, value: &Expr| Constant {
                scope: scope.clone(),
                ty: Some(ty.clone()),
                value: value.clone(),
            };
            match item {
                Item::Const(item) => {
                    self.constants.push(((None, full(&item.ident)), constant(&item.ty, &item.expr)));
                }
                Item::Static(item) if matches!(item.mutability, syn::StaticMutability::None) => {
                    self.constants.push(((None, full(&item.ident)), constant(&item.ty, &item.expr)));
                }
                Item::Fn(item) => {
                    let function = Rc::new(callable(&item.sig, &item.block, scope.clone(), None));
                    self.functions.push(((None, full(&item.sig.ident)), function));
                }
                Item::Type(item) => {
                    let (scope, parameters) = (inside(scope, &item.generics), parameters(&item.generics));
                    let alias = Alias { scope, parameters, ty: (*item.ty).clone() };
                    self.aliases.push((full(&item.ident), alias));
                }
                Item::Struct(item) => {
                    let (scope, parameters) = (inside(scope, &item.generics), parameters(&item.generics));
                    let has_default = derives_default(&item.attrs);
                    let structure = Structure { scope, parameters, fields: fields(&item.fields), has_default };
                    self.structs.push((full(&item.ident), structure));
                }
                Item::Enum(item) => {
                    let (scope, parameters) = (inside(scope, &item.generics), parameters(&item.generics));
                    let variants = item.variants.iter();
                    let is_default =
                        |variant: &syn::Variant| variant.attrs.iter().any(|of| of.path().is_ident("default"));
                    let default = variants.clone().position(is_default).filter(|_| derives_default(&item.attrs));
                    let variants = variants
                        .map(|variant| Variant {
                            name: variant.ident.to_string(),
                            discriminant: variant.discriminant.as_ref().map(|(_, number)| number.clone()),
                            fields: fields(&variant.fields),
                        })
                        .collect();
                    self.enums.push((full(&item.ident), Enumeration { scope, parameters, variants, default }));
                }
                Item::Impl(item) => self.add_impl(scope, item),
                Item::Trait(item) if item.generics.params.is_empty() => {
                    self.traits.push((full(&item.ident), scope.clone(), item.clone()));
                }
                _ => {}
            }
        }
    }

    fn add_impl(&mut self, scope: &Rc<Scope>, item: &syn::ItemImpl) {
        // An implementation for references serves the type itself if the type has none.
        let (by_reference, ty) = match &*item.self_ty {
            syn::Type::Reference(reference) => (true, &*reference.elem),
            ty => (false, ty),
        };
        let syn::Type::Path(path) = ty else { return };
        if path.qself.is_some() {
            return;
        }
        let ty = self.resolved(scope, &segments(&path.path));
        let is_generic = path.path.segments.iter().any(|segment| !segment.arguments.is_none());
        let self_written = is_generic.then(|| Rc::new(syn::Type::Path(path.clone())));
        let scope =
            Scope { module: scope.module.clone(), self_type: Some(ty.clone()), self_written, ..Scope::default() };
        let scope = inside(&Rc::new(scope), &item.generics);
        let known_as = if by_reference { format!("&{ty}") } else { ty };
        let of_trait = item.trait_.as_ref().and_then(|(path, _)| path.segments.last());
        if let Some((path, _)) = &item.trait_ {
            let of_trait = self.resolved(&scope, &segments(path));
            self.implementations.push((of_trait, known_as.clone(), scope.self_type.clone().unwrap_or_default()));
        }
        for part in &item.items {
            match part {
                ImplItem::Const(part) => {
                    let (ty_of_it, value) = (Some(part.ty.clone()), part.expr.clone());
                    let constant = Constant { scope: scope.clone(), ty: ty_of_it, value };
                    self.constants.push(((Some(known_as.clone()), part.ident.to_string()), constant));
                }
                ImplItem::Fn(part) => {
                    let of_trait = of_trait.map(|of| of.ident.to_string());
                    let function = Rc::new(callable(&part.sig, &part.block, scope.clone(), of_trait));
                    self.functions.push(((Some(known_as.clone()), part.sig.ident.to_string()), function));
                }
                _ => {}
            }
        }
    }

    /// Resolves a path that is written in `scope`.
    pub(super) fn meaning(&self, scope: &Scope, path: &[String]) -> Meaning {
        let import = path.split_first().and_then(|(first, rest)| {
            let (_, imported) = scope.imports.iter().rev().find(|(name, _)| name == first)?;
            Some([imported.as_slice(), rest].concat())
        });
        self.names.meaning(&scope.module, import.as_deref().unwrap_or(path))
    }

    /// Iterates over the names of the items of a module.
    pub(super) fn names_in<'a>(&'a self, module: &'a str) -> impl Iterator<Item = &'a str> {
        self.names.names_in(module)
    }

    /// Returns a constant of the module or of one of its types; `None` if there is none, or several.
    pub(super) fn constant(&self, of: Option<&str>, name: &str) -> Option<&Constant> {
        let is_it = |(ty, known): &Name| ty.as_deref() == of && known == name;
        let mut several = self.constants.iter().filter(|(known, _)| is_it(known));
        let (_, first) = several.next()?;
        // The type's arguments would decide among several.
        several.next().is_none().then_some(first)
    }

    /// Returns all functions of this name; the call decides which one is meant.
    pub(super) fn functions<'a>(
        &'a self,
        of: Option<&'a str>,
        name: &'a str,
    ) -> impl Iterator<Item = &'a Rc<Callable>> {
        let is_it = move |(ty, known): &Name| ty.as_deref() == of && known == name;
        self.functions.iter().filter(move |(known, _)| is_it(known)).map(|(_, function)| function)
    }

    /// Returns the names of the functions of a type.
    pub(super) fn functions_of(&self, of: &str) -> Vec<&str> {
        let of_it = self.functions.iter().filter(|((known, _), _)| known.as_deref() == Some(of));
        of_it.map(|((_, name), _)| name.as_str()).collect()
    }

    /// Returns the struct with this full name.
    pub(super) fn structure(&self, name: &str) -> Option<&Structure> {
        self.structs.iter().find(|(known, _)| known == name).map(|(_, structure)| structure)
    }

    /// Returns the enum with this full name.
    pub(super) fn enumeration(&self, name: &str) -> Option<&Enumeration> {
        self.enums.iter().find(|(known, _)| known == name).map(|(_, enumeration)| enumeration)
    }

    /// Returns `true` if a struct or an enum has this full name.
    pub(super) fn defines(&self, name: &str) -> bool {
        self.structure(name).is_some() || self.enumeration(name).is_some()
    }

    /// Returns the type alias with this full name.
    pub(super) fn alias(&self, name: &str) -> Option<&Alias> {
        self.aliases.iter().find(|(known, _)| known == name).map(|(_, alias)| alias)
    }

    /// Resolves a path to the name of a type: the full name, or the last segment for a type outside the module.
    pub(super) fn resolved(&self, scope: &Scope, path: &[String]) -> String {
        let mut name = self.meaning(scope, path).into_type();
        // The compiler rejects cyclic aliases.
        for _ in 0..=self.aliases.len() {
            match self.alias(&name) {
                Some(Alias { scope, ty: syn::Type::Path(path), .. }) => {
                    name = self.meaning(scope, &segments(&path.path)).into_type();
                }
                Some(_) => return String::new(),
                None => break,
            }
        }
        name
    }

    pub(super) fn is_conditional(&self, name: &str) -> bool {
        self.conditional.iter().any(|known| known == name)
    }

    pub(super) fn is_faulty(&self, function: &Rc<Callable>) -> bool {
        self.faulty.borrow().iter().any(|known| Rc::ptr_eq(known, function))
    }

    /// Calls `read` to read a type's fields; `None` if the type is part of itself.
    pub(super) fn once<R>(&self, name: &str, read: impl FnOnce() -> R) -> Option<R> {
        if self.under_way.borrow().iter().any(|known| known == name) {
            return None;
        }
        self.under_way.borrow_mut().push(name.to_owned());
        let made = read();
        self.under_way.borrow_mut().pop();
        Some(made)
    }

    /// Returns the number of functions with reported errors.
    pub(super) fn faults(&self) -> usize {
        self.faulty.borrow().len()
    }

    /// Forgets the errors of all but the first `faults` functions.
    pub(super) fn forget_faults(&self, faults: usize) {
        self.faulty.borrow_mut().truncate(faults);
    }

    pub(super) fn is_at_fault(&self, function: &Rc<Callable>) {
        self.faulty.borrow_mut().push(function.clone());
    }
}

fn derives_default(attributes: &[Attribute]) -> bool {
    let derives = attributes.iter().filter(|attribute| attribute.path().is_ident("derive"));
    let mut found = false;
    for attribute in derives {
        // The compiler rejects derives that cannot be parsed.
        let _ = attribute.parse_nested_meta(|meta| {
            found |= meta.path.segments.last().is_some_and(|last| last.ident == "Default");
            Ok(())
        });
    }
    found
}

/// Returns the first `cfg` attribute in the tokens. A macro cannot evaluate it.
pub(super) fn depends_on_cfg(tokens: TokenStream) -> Option<TokenTree> {
    let mut after_hash = false;
    for token in tokens {
        if let TokenTree::Group(group) = &token {
            let mut inside = group.stream().into_iter();
            if after_hash && matches!(inside.next(), Some(TokenTree::Ident(word)) if word == "cfg") {
                return Some(token);
            }
            if let Some(found) = depends_on_cfg(group.stream()) {
                return Some(found);
            }
        }
        after_hash = matches!(&token, TokenTree::Punct(punct) if punct.as_char() == '#');
    }
    None
}

fn name_of_item(item: &Item) -> Option<String> {
    Some(match item {
        Item::Const(item) => item.ident.to_string(),
        Item::Static(item) => item.ident.to_string(),
        Item::Enum(item) => item.ident.to_string(),
        Item::Trait(item) => item.ident.to_string(),
        Item::Fn(item) => item.sig.ident.to_string(),
        Item::Type(item) => item.ident.to_string(),
        Item::Struct(item) => item.ident.to_string(),
        _ => return None,
    })
}

fn fields(fields: &Fields) -> Vec<(Member, syn::Type)> {
    let named = fields.iter().enumerate().map(|(index, field)| {
        let member = field.ident.clone().map_or_else(|| Member::from(index), Member::from);
        (member, field.ty.clone())
    });
    named.collect()
}

fn parameters(generics: &syn::Generics) -> Vec<Parameter> {
    let parameters = generics.params.iter().filter_map(|parameter| match parameter {
        GenericParam::Const(parameter) => Some(Parameter { name: parameter.ident.to_string(), is_length: true }),
        GenericParam::Type(parameter) => Some(Parameter { name: parameter.ident.to_string(), is_length: false }),
        _ => None,
    });
    parameters.collect()
}

/// Returns the scope inside an item with these generic parameters.
fn inside(scope: &Rc<Scope>, generics: &syn::Generics) -> Rc<Scope> {
    let parameters = parameters(generics);
    if parameters.is_empty() {
        return scope.clone();
    }
    let mut scope = (**scope).clone();
    for Parameter { name, is_length } in parameters {
        if is_length { scope.lengths.push(name) } else { scope.generics.push(name) }
    }
    Rc::new(scope)
}

/// Returns a named function.
pub(super) fn callable(
    signature: &Signature,
    block: &syn::Block,
    scope: Rc<Scope>,
    of_trait: Option<String>,
) -> Callable {
    let parameters = signature.inputs.iter().map(|input| match input {
        FnArg::Typed(typed) => ((*typed.pat).clone(), Some((*typed.ty).clone())),
        FnArg::Receiver(receiver) => {
            (pattern_of_self(receiver), scope.self_written.as_ref().map(|written| (**written).clone()))
        }
    });
    let parameters: Vec<_> = parameters.collect();
    let name = match &scope.self_type {
        Some(of) => format!("{of}::{}", signature.ident),
        None => signature.ident.to_string(),
    };
    let scope = inside(&scope, &signature.generics);
    Callable {
        name: Some(name),
        parameters,
        changed: signature.inputs.iter().map(is_changed).collect(),
        result: match &signature.output {
            syn::ReturnType::Type(_, ty) => Some((**ty).clone()),
            syn::ReturnType::Default => None,
        },
        body: Expr::Block(syn::ExprBlock { attrs: Vec::new(), label: None, block: block.clone() }),
        captured: Vec::new(),
        origin: None,
        scope,
        of_trait,
    }
}

/// Returns `true` if a parameter is `&mut`.
fn is_changed(input: &FnArg) -> bool {
    let is_reference = |ty: &syn::Type| matches!(ty, syn::Type::Reference(reference) if reference.mutability.is_some());
    match input {
        FnArg::Typed(typed) => is_reference(&typed.ty),
        FnArg::Receiver(receiver) => match &receiver.kind {
            syn::ReceiverKind::Reference(.., mutability) => mutability.is_some(),
            syn::ReceiverKind::Typed(_, ty) => is_reference(ty),
            _ => false,
        },
    }
}

fn pattern_of_self(receiver: &syn::Receiver) -> Pat {
    Pat::Ident(syn::PatIdent {
        attrs: Vec::new(),
        by_ref: None,
        mutability: receiver.mutability,
        ident: syn::Ident::new("self", receiver.self_token.span),
        subpat: None,
    })
}
