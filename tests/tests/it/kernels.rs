//! Emitted kernels match their headers: straight-line code, hygienic paths, and as many operations as counted.
//!
//! They are parsed again by syn, by naga and by a small C tokeniser, so that no emitter checks itself.

use std::sync::LazyLock;

use aim_codegen::emit::rust_kernels::trait_kernels;
use aim_codegen::emit::{self, Rig};
use aim_codegen::objective::functions;
use aim_codegen::{Kernel, RigSpec, declare, kernels};
use aim_symbolic::{Count, Program};
use aim_tests::scale::sampled;
use aim_tests::{c, rigs, wgsl};
use syn::visit::{self, Visit};
use syn::{BinOp, Expr, File, ImplItem, Item, ItemFn, Stmt, UnOp};

/// The rigs of [`all_rigs`] with the kernels of all objectives, derived once for all tests.
static RIGS: LazyLock<Vec<(RigSpec, Vec<Kernel>)>> =
    LazyLock::new(|| all_rigs().into_iter().map(|spec| (spec.clone(), kernels(&spec))).collect());

/// Returns the rigs of every convention, or a sample of them, and rigs with every setting of a declaration.
fn all_rigs() -> Vec<RigSpec> {
    let mut all: Vec<RigSpec> = sampled(rigs::rigs()).collect();
    macro_rules! push {
        ($name:ident $($declaration:tt)*) => {
            let item = syn::parse_str(stringify!(#[derive(AimRig)] $($declaration)*)).expect("it is a struct");
            let declared = declare::from_derive_input(&item).unwrap_or_else(|errors| panic!("{}", errors.render()));
            all.push(declared.spec);
        };
    }
    aim_tests::declarations!(push);
    all
}

fn text_of(expr: &impl quote::ToTokens) -> String {
    expr.to_token_stream().to_string().replace(' ', "")
}

/// Counts a kernel's operations, and panics at anything that straight-line code does not need.
struct Straight(Count);

impl Visit<'_> for Straight {
    fn visit_expr(&mut self, expr: &Expr) {
        match expr {
            Expr::Binary(binary) => match binary.op {
                BinOp::Add(_) | BinOp::Sub(_) => self.0.add += 1,
                BinOp::Mul(_) => self.0.mul += 1,
                BinOp::Div(_) => self.0.div += 1,
                BinOp::Lt(_) => self.0.select += 1,
                _ => panic!("no operation of a kernel: {}", text_of(expr)),
            },
            Expr::Unary(unary) => assert!(matches!(unary.op, UnOp::Neg(_)), "{}", text_of(expr)),
            Expr::Call(call) => match text_of(&call.func).as_str() {
                "<Sas::aim::__private::Scalar>::sqrt" | "<::core::primitive::f32as::aim::__private::Scalar>::sqrt" => {
                    self.0.sqrt += 1;
                }
                // A comparison and a select.
                "<Sas::aim::__private::Scalar>::select_less" => self.0.select += 2,
                "<Sas::aim::__private::Scalar>::constant" => {}
                other => panic!("a kernel calls {other}"),
            },
            // `if a < b { c } else { d }`: a comparison and a select.
            Expr::If(select) => {
                let is_less = matches!(&*select.cond, Expr::Binary(binary) if matches!(binary.op, BinOp::Lt(_)));
                assert!(is_less && select.else_branch.is_some(), "{}", text_of(expr));
                self.0.select += 1;
            }
            Expr::Block(block) => assert!(block.block.stmts.len() == 1, "{}", text_of(expr)),
            Expr::Path(_) | Expr::Lit(_) | Expr::Array(_) | Expr::Paren(_) => {}
            // A constant index is checked by the compiler and cannot panic.
            Expr::Index(index) => assert!(matches!(*index.index, Expr::Lit(_)), "{}", text_of(expr)),
            _ => panic!("a kernel is a straight line, without {}", text_of(expr)),
        }
        visit::visit_expr(self, expr);
    }

    fn visit_stmt(&mut self, statement: &Stmt) {
        match statement {
            Stmt::Local(local) => assert!(local.init.as_ref().is_some_and(|init| init.diverge.is_none())),
            Stmt::Expr(Expr::Array(_), None) => {}
            // The value of a branch.
            Stmt::Expr(Expr::Path(_) | Expr::Lit(_) | Expr::Unary(_) | Expr::Index(_), None) => {}
            _ => panic!("a kernel computes and returns, it does not {}", text_of(statement)),
        }
        visit::visit_stmt(self, statement);
    }
}

/// Checks every path of the emitted code: it must start with `::core` or the facade, or be one of these local names.
struct Paths<'a> {
    local: &'a dyn Fn(&str) -> bool,
}

impl Visit<'_> for Paths<'_> {
    fn visit_path(&mut self, path: &syn::Path) {
        let first = path.segments.first().map(|segment| segment.ident.to_string()).unwrap_or_default();
        if path.leading_colon.is_some() {
            assert!(first == "core" || first == "aim", "{}", text_of(path));
        } else {
            assert!(path.segments.len() == 1 && (self.local)(&first), "{} is not local", text_of(path));
        }
        visit::visit_path(self, path);
    }

    /// Paths such as `<[S]>::fill` name an associated item of a type, whatever names are defined nearby.
    fn visit_expr_path(&mut self, path: &syn::ExprPath) {
        match &path.qself {
            Some(qself) if qself.position == 0 => self.visit_qself(qself),
            _ => visit::visit_expr_path(self, path),
        }
    }

    /// Only built-in attributes, which cannot be shadowed, are allowed.
    fn visit_attribute(&mut self, attribute: &syn::Attribute) {
        let name = text_of(attribute.path());
        assert!(["doc", "inline", "allow", "derive", "automatically_derived"].contains(&name.as_str()), "#[{name}]");
    }

    fn visit_macro(&mut self, call: &syn::Macro) {
        panic!("a macro may be shadowed: {}", text_of(call));
    }

    fn visit_expr_unsafe(&mut self, block: &syn::ExprUnsafe) {
        panic!("{}", text_of(block));
    }
}

/// Returns the items inside `const _: () = { … };`, which follows the pose struct.
fn items_of(expansion: &File) -> Vec<&Item> {
    let [Item::Struct(_), Item::Const(constant)] = expansion.items.as_slice() else {
        panic!("an expansion is a struct and a constant")
    };
    let Expr::Block(block) = &*constant.expr else { panic!("its value is a block") };
    assert_eq!(constant.ident, "_");
    block
        .block
        .stmts
        .iter()
        .map(|statement| match statement {
            Stmt::Item(item) => item,
            other => panic!("no item: {}", text_of(other)),
        })
        .collect()
}

fn doc_of(function: &ItemFn) -> String {
    let lines = function.attrs.iter().filter_map(|attribute| match &attribute.meta {
        syn::Meta::NameValue(doc) if doc.path.is_ident("doc") => Some(text_of(&doc.value)),
        _ => None,
    });
    lines.collect()
}

fn expansion_of(rig: &Rig<'_>) -> File {
    let item = emit::rust::Item::of(rig.spec, quote::quote!(::aim));
    syn::parse2(emit::rust::emit(rig, &item)).expect("emitted code is made of items")
}

#[test]
fn rust_kernels_are_straight_lines_with_the_operations_that_were_counted() {
    for (spec, kernels) in RIGS.iter() {
        let expansion = expansion_of(&Rig { spec, kernels });
        let items = items_of(&expansion);
        let mut functions = items.iter().filter_map(|&item| match item {
            Item::Fn(function) => Some(function),
            _ => None,
        });
        let mut expect = |program: &Program, name: &str| {
            let function = functions.next().unwrap_or_else(|| panic!("{} lacks {name}", spec.name));
            assert_eq!(function.sig.ident, name);
            let mut straight = Straight(Count::default());
            straight.visit_block(&function.block);
            assert_eq!(straight.0, program.count(), "{} of {}", name, spec.name);
            let header = program.count().to_string().replace(' ', "");
            assert!(doc_of(function).contains(&header), "{name} of {}: {}", spec.name, doc_of(function));
        };
        // Joints with equal programs share a function, named after the first of them.
        for Kernel { joints, objective, program } in kernels {
            match objective.name {
                "aim_gradient" => expect(program, &format!("aim_gradient_{}", joints[0])),
                name => expect(program, name),
            }
        }
        assert!(functions.next().is_none(), "{} has a function that no program is behind", spec.name);
    }
}

/// Returns the method with this name from the impls of an expansion.
fn trait_method<'e>(items: &[&'e Item], name: &str) -> &'e syn::ImplItemFn {
    let methods = items.iter().filter_map(|&item| match item {
        Item::Impl(implementation) => Some(&implementation.items),
        _ => None,
    });
    let mut methods = methods.flatten().filter_map(|item| match item {
        ImplItem::Fn(method) if method.sig.ident == name => Some(method),
        _ => None,
    });
    methods.next().unwrap_or_else(|| panic!("there is no method {name}"))
}

#[test]
fn the_traits_kernels_are_straight_lines_with_the_operations_that_were_counted() {
    for spec in all_rigs() {
        let kernels = trait_kernels(&spec);
        let expansion = expansion_of(&Rig { spec: &spec, kernels: &[] });
        let items = items_of(&expansion);
        // A pattern destructures the slices; then follow steps and one assignment per output.
        let chain = trait_method(&items, "residual_jacobian");
        let mut straight = Straight(Count::default());
        for statement in &chain.block.stmts[1..] {
            match statement {
                Stmt::Expr(Expr::Assign(assignment), Some(_)) => {
                    assert!(matches!(&*assignment.left, Expr::Unary(unary) if matches!(unary.op, UnOp::Deref(_))));
                    straight.visit_expr(&assignment.right);
                }
                statement => straight.visit_stmt(statement),
            }
        }
        assert_eq!(straight.0, kernels[0].program.count(), "{}", spec.name);
        // Each joint's kernel is an arm of the match on the joint.
        let joint = trait_method(&items, "aim_gradient");
        let [Stmt::Expr(Expr::Match(choice), None)] = joint.block.stmts.as_slice() else { panic!("no choice") };
        assert_eq!(choice.arms.len(), kernels.len(), "{}: an arm a kernel, and one for no joint", spec.name);
        for (arm, kernel) in choice.arms.iter().zip(&kernels[1..]) {
            let Expr::Block(block) = &*arm.body else { panic!("{}", text_of(&arm.body)) };
            let mut straight = Straight(Count::default());
            straight.visit_block(&block.block);
            assert_eq!(straight.0, kernel.program.count(), "{} {:?}", spec.name, kernel.joints);
        }
    }
}

/// Names that emitted code binds itself.
#[derive(Default)]
struct Bound {
    types: Vec<String>,
    items: Vec<String>,
    variables: Vec<String>,
}

impl Visit<'_> for Bound {
    fn visit_type_param(&mut self, parameter: &syn::TypeParam) {
        self.types.push(parameter.ident.to_string());
    }

    fn visit_item_fn(&mut self, function: &ItemFn) {
        self.items.push(function.sig.ident.to_string());
        visit::visit_item_fn(self, function);
    }

    fn visit_item_const(&mut self, constant: &syn::ItemConst) {
        self.items.push(constant.ident.to_string());
        visit::visit_item_const(self, constant);
    }

    fn visit_pat_ident(&mut self, pattern: &syn::PatIdent) {
        self.variables.push(pattern.ident.to_string());
    }
}

#[test]
fn rust_names_nothing_but_core_the_facade_and_its_own() {
    for (spec, kernels) in RIGS.iter() {
        let expansion = expansion_of(&Rig { spec, kernels });
        let mut bound = Bound::default();
        bound.visit_file(&expansion);
        // A pattern named like a user's constant would not bind. Names with two leading underscores are reserved for
        // the emitted code.
        for variable in &bound.variables {
            assert!(variable.starts_with("__"), "{variable} may be a constant where the rig is declared");
        }
        let own =
            [bound.types, bound.items, bound.variables, vec![spec.name.clone(), format!("{}Pose", spec.name)]].concat();
        let local = |name: &str| ["self", "Self"].contains(&name) || own.iter().any(|own| own == name);
        Paths { local: &local }.visit_file(&expansion);
    }
}

#[test]
fn rust_branches_only_where_a_joint_or_a_length_is_chosen() {
    struct Branches(usize, usize);
    impl Visit<'_> for Branches {
        fn visit_expr(&mut self, expr: &Expr) {
            match expr {
                Expr::Match(_) => self.0 += 1,
                Expr::If(_) => self.1 += 1,
                Expr::Loop(_) | Expr::While(_) | Expr::ForLoop(_) | Expr::Closure(_) | Expr::Try(_) => {
                    panic!("emitted code has {}", text_of(expr))
                }
                _ => {}
            }
            visit::visit_expr(self, expr);
        }
    }
    for (spec, kernels) in RIGS.iter() {
        let expansion = expansion_of(&Rig { spec, kernels });
        for item in items_of(&expansion) {
            let Item::Impl(implementation) = item else { continue };
            for method in &implementation.items {
                let ImplItem::Fn(method) = method else { continue };
                let mut branches = Branches(0, 0);
                branches.visit_block(&method.block);
                // A select in the trait's kernels is an `if`; another test checks their straight-line code.
                let is_of_trait = implementation.trait_.is_some();
                let expected = match method.sig.ident.to_string().as_str() {
                    "aim_gradient" if is_of_trait => (1, branches.1),
                    "residual_jacobian" => (0, branches.1),
                    "aim_gradient" | "joint_name" | "bone_name" | "held_bone" => (1, 0),
                    "chain_value_gradient" | "chain_residual_jacobian" => (0, 1),
                    _ => (0, 0),
                };
                assert_eq!((branches.0, branches.1), expected, "{} of {}", method.sig.ident, spec.name);
            }
        }
    }
}

/// Returns the functions of emitted C and WGSL: each one's name and its program.
fn functions_of<'p>(spec: &RigSpec, kernels: &'p [Kernel]) -> Vec<(String, &'p Program)> {
    functions(kernels).into_iter().map(|function| (function.name(spec), &function.kernel.program)).collect()
}

#[test]
fn c_kernels_are_straight_lines_with_the_operations_that_were_counted() {
    for (spec, kernels) in RIGS.iter() {
        let source = emit::c::emit(&Rig { spec, kernels });
        for (name, program) in functions_of(spec, kernels) {
            let (header, body) = c::function(&source, &name);
            assert_eq!(c::count(body), program.count(), "{name}");
            assert!(header.contains(&program.count().to_string()), "{name}: {header}");
        }
    }
}

#[test]
fn the_tokenizer_of_c_tells_signs_from_operations() {
    let count = c::count("const float v1 = -a[0] - -1.5e-3f * v2;\nv3 = v1 < 1e-9f ? sqrtf(-v2) : b / 2.0f + -c;");
    assert_eq!(count, Count { add: 2, mul: 1, div: 1, sqrt: 1, select: 2, call: 0, series: 0 });
}

#[test]
fn wgsl_kernels_are_straight_lines_with_the_operations_that_were_counted() {
    for (spec, kernels) in RIGS.iter() {
        let source = emit::wgsl::emit(&Rig { spec, kernels });
        let module = wgsl::Module::read(&source);
        let functions = functions_of(spec, kernels);
        assert_eq!(module.names(), functions.iter().map(|(name, _)| name.as_str()).collect::<Vec<_>>());
        for (name, program) in functions {
            assert_eq!(module.function(&name).count(), program.count(), "{name}");
            // The comment directly above the function.
            let (above, _) = source.split_once(&format!("fn {name}(")).expect("naga found it");
            let header = above.rsplit("\n\n").next().unwrap_or_default();
            assert!(header.lines().all(|line| line.starts_with("// ")), "{name}: {header}");
            assert!(header.contains(&program.count().to_string()), "{name}: {header}");
        }
    }
}
