//! From the paths of a file to the items that they name.

use proc_macro2::{Delimiter, Spacing, TokenStream, TokenTree};
use syn::visit::{self, Visit};
use syn::{Attribute, Expr, ExprCall, ImplItemFn, Item, ItemMod, ItemUse, LitStr, Macro};

use super::sources::{Literal, Reference, Sources, Target, attributes, flatten, is_test, line_of};

/// Macros whose texts are messages of broken invariants.
const ASSERTIONS: [&str; 6] = [
    "assert",
    "assert_eq",
    "debug_assert",
    "debug_assert_eq",
    "panic",
    "unreachable",
];

/// Longest chain of re-exports that is followed.
const MOST_RE_EXPORTS: usize = 16;

/// Records what the files of a crate name.
pub(super) fn record(sources: &mut Sources, parsed: &[(usize, syn::File)]) {
    for (module, file) in parsed {
        let mut reader = Reader {
            sources,
            module: *module,
            is_message: false,
        };
        reader.visit_file(file);
    }
}

/// Reads the code of one file, tests left out.
struct Reader<'a> {
    sources: &'a mut Sources,
    module: usize,
    /// True inside the message of an error or of a broken invariant.
    is_message: bool,
}

impl Reader<'_> {
    fn file(&self) -> usize {
        self.sources.modules[self.module].file
    }

    fn refer(&mut self, path: &[String], line: usize) {
        if let Some(target) = self.sources.resolve(self.module, path, MOST_RE_EXPORTS) {
            let file = self.file();
            self.sources
                .references
                .push(Reference { file, line, target });
        }
    }

    fn refer_path(&mut self, path: &syn::Path) {
        let names = names(path);
        let line = line_of(&path.segments[0].ident);
        if path.leading_colon.is_some() {
            let file = self.file();
            let target = Target::External(names);
            self.sources
                .references
                .push(Reference { file, line, target });
        } else {
            self.refer(&names, line);
        }
    }

    /// Paths and texts among the arguments of a macro.
    fn read_tokens(&mut self, tokens: TokenStream) {
        let mut path: Vec<String> = Vec::new();
        let mut line = 0;
        let mut joined = false;
        let mut tokens = tokens.into_iter().peekable();
        while let Some(token) = tokens.next() {
            match &token {
                TokenTree::Ident(ident) if joined || path.is_empty() => {
                    if path.is_empty() {
                        line = line_of(ident);
                    }
                    path.push(ident.to_string());
                    joined = false;
                    continue;
                }
                TokenTree::Punct(colon)
                    if colon.as_char() == ':'
                        && colon.spacing() == Spacing::Joint
                        && !path.is_empty() =>
                {
                    tokens.next();
                    joined = true;
                    continue;
                }
                _ => {}
            }
            let called = matches!(&token, TokenTree::Group(group) if group.delimiter() == Delimiter::Parenthesis);
            self.refer_tokens(&path, line, called);
            path.clear();
            joined = false;
            match token {
                TokenTree::Ident(ident) => {
                    line = line_of(&ident);
                    path.push(ident.to_string());
                }
                TokenTree::Group(group) => self.read_tokens(group.stream()),
                TokenTree::Literal(literal) => {
                    if let Ok(text) = syn::parse_str::<LitStr>(&literal.to_string()) {
                        self.add_literal(literal.span().start().line, text.value());
                    }
                }
                // Values of attributes are not code.
                TokenTree::Punct(hash) if hash.as_char() == '#' => {
                    tokens.next_if(|next| matches!(next, TokenTree::Group(_)));
                }
                TokenTree::Punct(_) => {}
            }
        }
        self.refer_tokens(&path, line, false);
    }

    /// The same of a message of an error or of a broken invariant.
    fn read_message(&mut self, tokens: TokenStream) {
        let outer = std::mem::replace(&mut self.is_message, true);
        self.read_tokens(tokens);
        self.is_message = outer;
    }

    fn add_literal(&mut self, line: usize, text: String) {
        let literal = Literal {
            file: self.file(),
            line,
            text,
            is_message: self.is_message,
        };
        self.sources.literals.push(literal);
    }

    fn refer_tokens(&mut self, path: &[String], line: usize, called: bool) {
        let Some(first) = path.first() else { return };
        if path.len() > 1 || called || first.starts_with(char::is_uppercase) {
            self.refer(path, line);
        }
    }
}

fn names(path: &syn::Path) -> Vec<String> {
    path.segments.iter().map(|s| s.ident.to_string()).collect()
}

impl Visit<'_> for Reader<'_> {
    fn visit_item(&mut self, item: &Item) {
        if !is_test(attributes(item)) {
            visit::visit_item(self, item);
        }
    }

    fn visit_item_mod(&mut self, item: &ItemMod) {
        if item.content.is_none() {
            return;
        }
        let outer = self.module;
        self.module = self.sources.modules[outer].children[&item.ident.to_string()];
        visit::visit_item_mod(self, item);
        self.module = outer;
    }

    fn visit_item_use(&mut self, item: &ItemUse) {
        if !matches!(item.vis, syn::Visibility::Inherited) {
            return;
        }
        let mut names = Vec::new();
        flatten(&item.tree, &mut Vec::new(), &mut names);
        for (name, path, line) in names {
            if name != "*" {
                self.refer(&path, line);
            }
        }
    }

    fn visit_impl_item_fn(&mut self, item: &ImplItemFn) {
        if !is_test(&item.attrs) {
            visit::visit_impl_item_fn(self, item);
        }
    }

    fn visit_item_fn(&mut self, item: &syn::ItemFn) {
        let route = |a: &Attribute| names(a.path()) == ["utoipa", "path"];
        if item.attrs.iter().any(route) {
            let place = (self.file(), line_of(&item.sig.ident));
            self.sources.routes.push(place);
        }
        visit::visit_item_fn(self, item);
    }

    /// Values of attributes (documentation, names of columns) are not code, messages of errors excepted.
    fn visit_attribute(&mut self, attribute: &Attribute) {
        self.visit_path(attribute.path());
        if let syn::Meta::List(list) = &attribute.meta
            && list.path.is_ident("error")
        {
            self.read_message(list.tokens.clone());
        }
    }

    fn visit_expr_call(&mut self, call: &ExprCall) {
        if let Expr::Path(function) = call.func.as_ref()
            && function.path.get_ident().is_some()
        {
            self.refer_path(&function.path);
        }
        visit::visit_expr_call(self, call);
    }

    /// A single name in lower case may be a variable; it is a function where it is called.
    fn visit_path(&mut self, path: &syn::Path) {
        let variable = path
            .get_ident()
            .is_some_and(|name| name.to_string().starts_with(char::is_lowercase));
        if !variable {
            self.refer_path(path);
        }
        visit::visit_path(self, path);
    }

    fn visit_lit_str(&mut self, text: &LitStr) {
        self.add_literal(text.span().start().line, text.value());
    }

    fn visit_macro(&mut self, called: &Macro) {
        self.refer_path(&called.path);
        let tokens = called.tokens.clone();
        if ASSERTIONS.iter().any(|name| called.path.is_ident(name)) {
            self.read_message(tokens);
        } else {
            self.read_tokens(tokens);
        }
    }
}

impl Sources {
    /// Target of a path, seen from a module; `None` for an item that a module of this crate does not define.
    fn resolve(&self, module: usize, path: &[String], re_exports: usize) -> Option<Target> {
        let (first, rest) = path.split_first()?;
        match first.as_str() {
            "crate" => self.resolve_below(0, rest, re_exports),
            "self" => self.resolve_below(module, rest, re_exports),
            "Self" => None,
            "super" => {
                let parent = self.modules[module].parent?;
                if rest.first().is_some_and(|name| name == "super") {
                    self.resolve(parent, rest, re_exports)
                } else {
                    self.resolve_below(parent, rest, re_exports)
                }
            }
            _ => self
                .resolve_below(module, path, re_exports)
                .or_else(|| Some(Target::External(path.to_vec()))),
        }
    }

    /// Target of a path inside a module.
    fn resolve_below(&self, module: usize, path: &[String], re_exports: usize) -> Option<Target> {
        let Some((name, rest)) = path.split_first() else {
            return Some(Target::Module(module));
        };
        let here = &self.modules[module];
        let child = here.children.get(name);
        // A module and a function can share a name; a path continues through the module and ends at the function.
        if let Some(child) = child
            && !rest.is_empty()
        {
            return self.resolve_below(*child, rest, re_exports);
        }
        if here.items.contains(name) {
            return Some(Target::Item(here.file, name.clone()));
        }
        let left = re_exports.checked_sub(1)?;
        let named = here.imports.iter().find(|import| import.name == *name);
        if let Some(import) = named {
            let mut whole = import.path.clone();
            whole.extend_from_slice(rest);
            if let Some(target) = self.resolve(module, &whole, left) {
                return Some(target);
            }
        }
        if let Some(child) = child {
            return Some(Target::Module(*child));
        }
        let mut globs = here.imports.iter().filter(|import| import.name == "*");
        globs.find_map(|glob| match self.resolve(module, &glob.path, left)? {
            Target::Module(inner) if inner != module => self.resolve_below(inner, path, left),
            _ => None,
        })
    }
}
