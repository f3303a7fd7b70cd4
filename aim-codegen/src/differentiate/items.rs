//! [`Items`]: what a module defines that its functions may use.

use std::cell::RefCell;
use std::rc::Rc;

use proc_macro2::{TokenStream, TokenTree};
use quote::ToTokens;
use syn::{Expr, Fields, FnArg, GenericParam, ImplItem, Item, Member, Pat, Signature, UseTree};

use super::lower::Callable;

/// A name of the module, or of a type of it.
type Name = (Option<String>, String);

/// What a module defines.
#[derive(Default)]
pub(super) struct Items {
    constants: Vec<(Name, Expr)>,
    functions: Vec<(Name, Rc<Callable>)>,
    /// Names of several functions.
    several: Vec<Name>,
    structs: Vec<(String, Vec<(Member, syn::Type)>)>,
    aliases: Vec<(String, syn::Type)>,
    /// Names of items that depend on `cfg`, of which nothing is read.
    conditional: Vec<String>,
    /// Functions that errors were reported of: of further calls nothing more is said.
    faulty: RefCell<Vec<Rc<Callable>>>,
}

impl Items {
    /// Reads the items of a module. What its functions cannot use is left out.
    pub(super) fn of(module: &[Item]) -> Self {
        let mut items = Self::default();
        for item in module {
            if depends_on_cfg(item.to_token_stream()).is_some() {
                items.conditional.extend(name_of_item(item));
                continue;
            }
            match item {
                Item::Const(item) => items.constants.push(((None, item.ident.to_string()), (*item.expr).clone())),
                Item::Fn(item) => items.add_function(None, &item.sig, &item.block),
                Item::Type(item) if item.generics.params.is_empty() => {
                    items.aliases.push((item.ident.to_string(), (*item.ty).clone()));
                }
                Item::Struct(item) if item.generics.params.is_empty() => {
                    items.structs.push((item.ident.to_string(), fields(&item.fields)));
                }
                Item::Use(item) => {
                    let used = used_constants(&item.tree).into_iter();
                    items.constants.extend(used.map(|(name, path)| ((None, name), path)));
                }
                Item::Impl(item) => {
                    let syn::Type::Path(path) = &*item.self_ty else { continue };
                    let Some(name) = path.path.get_ident() else { continue };
                    items.add_impl(&name.to_string(), &item.items);
                }
                _ => {}
            }
        }
        items
    }

    fn add_impl(&mut self, name: &str, parts: &[ImplItem]) {
        for part in parts {
            match part {
                ImplItem::Const(part) => {
                    self.constants.push(((Some(name.to_owned()), part.ident.to_string()), part.expr.clone()));
                }
                ImplItem::Fn(part) => self.add_function(Some(name), &part.sig, &part.block),
                _ => {}
            }
        }
    }

    fn add_function(&mut self, of: Option<&str>, signature: &Signature, block: &syn::Block) {
        let name = (of.map(str::to_owned), signature.ident.to_string());
        // Which of several is meant, such as of `From` for two types, is not told.
        if self.function(of, &name.1).is_some() || self.several.contains(&name) {
            self.functions.retain(|(known, _)| *known != name);
            self.several.push(name);
            return;
        }
        self.functions.push((name, Rc::new(callable(signature, block, of))));
    }

    /// The value of a constant of the module or of a type of it.
    pub(super) fn constant(&self, of: Option<&str>, name: &str) -> Option<&Expr> {
        find(&self.constants, of, name)
    }

    pub(super) fn function(&self, of: Option<&str>, name: &str) -> Option<&Rc<Callable>> {
        find(&self.functions, of, name)
    }

    /// The names of the functions of a type of the module.
    pub(super) fn functions_of(&self, of: &str) -> Vec<&str> {
        let of_it = self.functions.iter().filter(|((known, _), _)| known.as_deref() == Some(of));
        of_it.map(|((_, name), _)| name.as_str()).collect()
    }

    /// The fields of a struct, with their types.
    pub(super) fn fields(&self, name: &str) -> Option<&[(Member, syn::Type)]> {
        self.structs.iter().find(|(known, _)| known == name).map(|(_, fields)| fields.as_slice())
    }

    /// The type that this name is short for.
    pub(super) fn alias(&self, name: &str) -> Option<&syn::Type> {
        self.aliases.iter().find(|(known, _)| known == name).map(|(_, ty)| ty)
    }

    /// The name of the type that this name means.
    pub(super) fn resolved(&self, name: &str) -> String {
        match self.alias(name) {
            Some(syn::Type::Path(path)) => {
                path.path.segments.last().map(|last| last.ident.to_string()).unwrap_or_default()
            }
            _ => name.to_owned(),
        }
    }

    pub(super) fn is_conditional(&self, name: &str) -> bool {
        self.conditional.iter().any(|known| known == name)
    }

    pub(super) fn is_faulty(&self, function: &Rc<Callable>) -> bool {
        self.faulty.borrow().iter().any(|known| Rc::ptr_eq(known, function))
    }

    pub(super) fn is_at_fault(&self, function: &Rc<Callable>) {
        self.faulty.borrow_mut().push(function.clone());
    }
}

/// The place in tokens of an attribute `cfg`, which a macro cannot tell the truth of.
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
        Item::Fn(item) => item.sig.ident.to_string(),
        Item::Type(item) => item.ident.to_string(),
        Item::Struct(item) => item.ident.to_string(),
        _ => return None,
    })
}

/// The mathematical constants that an import brings, under their names.
pub(super) fn used_constants(tree: &UseTree) -> Vec<(String, Expr)> {
    let constant = |name: &syn::Ident| -> Expr { syn::parse_quote!(core::f64::consts::#name) };
    match tree {
        UseTree::Path(path) if path.ident == "consts" => {
            let leaves = match &*path.tree {
                UseTree::Group(group) => group.items.iter().collect(),
                leaf => vec![leaf],
            };
            let named = leaves.into_iter().filter_map(|leaf| match leaf {
                UseTree::Name(name) => Some((name.ident.to_string(), constant(&name.ident))),
                UseTree::Rename(name) => Some((name.rename.to_string(), constant(&name.ident))),
                _ => None,
            });
            named.collect()
        }
        UseTree::Path(path) if ["std", "core", "f32", "f64"].iter().any(|known| path.ident == known) => {
            used_constants(&path.tree)
        }
        UseTree::Group(group) => group.items.iter().flat_map(used_constants).collect(),
        _ => Vec::new(),
    }
}

fn find<'a, T>(list: &'a [(Name, T)], of: Option<&str>, name: &str) -> Option<&'a T> {
    list.iter().find(|((ty, known), _)| ty.as_deref() == of && known == name).map(|(_, found)| found)
}

fn fields(fields: &Fields) -> Vec<(Member, syn::Type)> {
    let named = fields.iter().enumerate().map(|(index, field)| {
        let member = field.ident.clone().map_or_else(|| Member::from(index), Member::from);
        (member, field.ty.clone())
    });
    named.collect()
}

/// A function with a name; `of` is what `Self` is.
pub(super) fn callable(signature: &Signature, block: &syn::Block, of: Option<&str>) -> Callable {
    let parameters = signature.inputs.iter().map(|input| match input {
        FnArg::Typed(typed) => ((*typed.pat).clone(), Some((*typed.ty).clone())),
        FnArg::Receiver(receiver) => (pattern_of_self(receiver), None),
    });
    let lengths = signature.generics.params.iter().filter_map(|parameter| match parameter {
        GenericParam::Const(parameter) => Some(parameter.ident.to_string()),
        _ => None,
    });
    Callable {
        name: Some(match of {
            Some(of) => format!("{of}::{}", signature.ident),
            None => signature.ident.to_string(),
        }),
        parameters: parameters.collect(),
        changed: signature.inputs.iter().map(is_changed).collect(),
        lengths: lengths.collect(),
        body: Expr::Block(syn::ExprBlock { attrs: Vec::new(), label: None, block: with_typed_end(block, signature) }),
        captured: Vec::new(),
        self_type: of.map(str::to_owned),
    }
}

/// The block; where it ends in a call that makes an array, such as `array::from_fn`, with the array's type said there.
pub(super) fn with_typed_end(block: &syn::Block, signature: &Signature) -> syn::Block {
    let mut block = block.clone();
    if let syn::ReturnType::Type(_, ty) = &signature.output
        && matches!(**ty, syn::Type::Array(_))
        && let Some(syn::Stmt::Expr(end @ Expr::Call(_), None)) = block.stmts.last()
    {
        let typed: Expr = syn::parse_quote!({
            let array: #ty = #end;
            array
        });
        block.stmts.pop();
        block.stmts.push(syn::Stmt::Expr(typed, None));
    }
    block
}

/// Whether a parameter is `&mut`.
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
