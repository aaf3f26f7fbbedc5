//! The source files of a crate, their modules, and what each file names of the others.
//!
//! File A depends on file B if A names an item that B defines: in a private `use`, in a path, or in the arguments of a
//! macro. What does not count: `mod` declarations, re-exports (`pub use`, also with a restricted visibility), the
//! modules that a path passes through, and code under `#[cfg(test)]` or `#[test]`. A re-exported item counts as named
//! from the file that defines it; so a parent and its child depend on each other only if each names an item that the
//! other one defines. Methods and fields are not seen: they carry no path.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use syn::{Attribute, Ident, Item, UseTree};

use super::resolution;

/// A crate as its sources describe it.
pub(super) struct Sources {
    pub(super) name: &'static str,
    /// Paths from the root of the workspace.
    pub(super) files: Vec<String>,
    pub(super) modules: Vec<Module>,
    pub(super) references: Vec<Reference>,
    pub(super) literals: Vec<Literal>,
    /// Handlers of routes: file, line.
    pub(super) routes: Vec<(usize, usize)>,
}

/// A text constant of the program.
pub(super) struct Literal {
    pub(super) file: usize,
    pub(super) line: usize,
    pub(super) text: String,
    /// True for the message of an error or of a broken invariant.
    pub(super) is_message: bool,
}

/// A module: a file, or a block inside one.
pub(super) struct Module {
    pub(super) file: usize,
    pub(super) parent: Option<usize>,
    pub(super) items: BTreeSet<String>,
    pub(super) children: BTreeMap<String, usize>,
    pub(super) imports: Vec<Import>,
}

/// One name that a `use` brings into a module.
pub(super) struct Import {
    /// `*` for all names of the path.
    pub(super) name: String,
    pub(super) path: Vec<String>,
}

/// A line that names something.
pub(super) struct Reference {
    pub(super) file: usize,
    pub(super) line: usize,
    pub(super) target: Target,
}

/// Target of a path.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Target {
    /// An item, by the file that defines it and its name.
    Item(usize, String),
    Module(usize),
    /// A path into another crate, imports expanded.
    External(Vec<String>),
}

/// A folder with files of modules.
struct Folder {
    read: PathBuf,
    /// The folder that they count as: another one where several rooms compile the same files (`#[path = ".."]`).
    room: PathBuf,
}

impl Folder {
    fn of(path: &Path) -> Self {
        Self {
            read: path.to_owned(),
            room: path.to_owned(),
        }
    }

    fn join(&self, name: &str) -> Self {
        Self {
            read: self.read.join(name),
            room: self.room.join(name),
        }
    }

    /// The file of a module whose path is given relative to the file that declares it, and the folder of its child modules.
    fn given(&self, path: &str, name: &str) -> (PathBuf, Self) {
        let file = self.read.with_file_name(path);
        let below = Self {
            read: file.with_file_name(""),
            room: self.room.join(name),
        };
        (file, below)
    }
}

impl Sources {
    /// Reads a crate, the folder `name` of a workspace, from its `src/lib.rs` on.
    pub(super) fn read(workspace: &Path, name: &'static str) -> Self {
        let mut sources = Self {
            name,
            files: Vec::new(),
            modules: Vec::new(),
            references: Vec::new(),
            literals: Vec::new(),
            routes: Vec::new(),
        };
        let mut parsed = Vec::new();
        let top = workspace.join(name).join("src");
        let lib = top.join("lib.rs");
        sources.read_file(&lib, &lib, &Folder::of(&top), None, &mut parsed);
        let root = format!("{}/", workspace.display());
        for file in &mut sources.files {
            *file = file.replacen(&root, "", 1);
        }
        resolution::record(&mut sources, &parsed);
        sources
    }

    /// Adds the module of a file, whose child modules lie in `folder`; returns its number.
    fn read_file(
        &mut self,
        path: &Path,
        counted_as: &Path,
        folder: &Folder,
        parent: Option<usize>,
        parsed: &mut Vec<(usize, syn::File)>,
    ) -> usize {
        let text =
            fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        let file =
            syn::parse_file(&text).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        self.files.push(counted_as.display().to_string());
        let module = self.add_module(self.files.len() - 1, parent);
        self.read_items(&file.items, module, folder, parsed);
        parsed.push((module, file));
        module
    }

    fn add_module(&mut self, file: usize, parent: Option<usize>) -> usize {
        self.modules.push(Module {
            file,
            parent,
            items: BTreeSet::new(),
            children: BTreeMap::new(),
            imports: Vec::new(),
        });
        self.modules.len() - 1
    }

    fn read_items(
        &mut self,
        items: &[Item],
        module: usize,
        folder: &Folder,
        parsed: &mut Vec<(usize, syn::File)>,
    ) {
        for item in items.iter().filter(|item| !is_test(attributes(item))) {
            match item {
                Item::Mod(inner) => {
                    let name = inner.ident.to_string();
                    let below = folder.join(&name);
                    let child = if let Some((_, items)) = &inner.content {
                        let child = self.add_module(self.modules[module].file, Some(module));
                        self.read_items(items, child, &below, parsed);
                        child
                    } else {
                        let counted_as = folder.room.join(format!("{name}.rs"));
                        let (path, below) = match given_path(&inner.attrs) {
                            None => (folder.read.join(format!("{name}.rs")), below),
                            Some(given) => folder.given(&given, &name),
                        };
                        self.read_file(&path, &counted_as, &below, Some(module), parsed)
                    };
                    self.modules[module].children.insert(name, child);
                }
                Item::Use(import) => {
                    let mut names = Vec::new();
                    flatten(&import.tree, &mut Vec::new(), &mut names);
                    let imports = names
                        .into_iter()
                        .map(|(name, path, _)| Import { name, path });
                    self.modules[module].imports.extend(imports);
                }
                other => self.modules[module].items.extend(defined_name(other)),
            }
        }
    }
}

/// The path of a module's file where an attribute gives it.
fn given_path(attributes: &[syn::Attribute]) -> Option<String> {
    let value = attributes.iter().find_map(|attribute| {
        let pair = attribute.meta.require_name_value().ok()?;
        pair.path.is_ident("path").then_some(&pair.value)
    })?;
    match value {
        syn::Expr::Lit(syn::ExprLit {
            lit: syn::Lit::Str(path),
            ..
        }) => Some(path.value()),
        _ => None,
    }
}

/// Every name of a use tree with its path and line.
pub(super) fn flatten(
    tree: &UseTree,
    prefix: &mut Vec<String>,
    names: &mut Vec<(String, Vec<String>, usize)>,
) {
    match tree {
        UseTree::Path(path) => {
            prefix.push(path.ident.to_string());
            flatten(&path.tree, prefix, names);
            prefix.pop();
        }
        UseTree::Group(group) => {
            for tree in &group.items {
                flatten(tree, prefix, names);
            }
        }
        UseTree::Glob(glob) => {
            let line = glob.star_token.spans[0].start().line;
            names.push(("*".to_owned(), prefix.clone(), line));
        }
        UseTree::Name(leaf) => {
            let path = joined(prefix, &leaf.ident);
            let name = path.last().cloned().unwrap_or_default();
            names.push((name, path, line_of(&leaf.ident)));
        }
        UseTree::Rename(leaf) => {
            let path = joined(prefix, &leaf.ident);
            names.push((leaf.rename.to_string(), path, line_of(&leaf.ident)));
        }
    }
}

/// The path of a leaf of a use tree; `self` stands for the path itself.
fn joined(prefix: &[String], leaf: &Ident) -> Vec<String> {
    let mut path = prefix.to_vec();
    if leaf != "self" {
        path.push(leaf.to_string());
    }
    path
}

pub(super) fn line_of(ident: &Ident) -> usize {
    ident.span().start().line
}

/// Checks whether attributes restrict an item to tests.
pub(super) fn is_test(attributes: &[Attribute]) -> bool {
    attributes.iter().any(|attribute| {
        let of_cfg = attribute.path().is_ident("cfg");
        let last = attribute.path().segments.last();
        last.is_some_and(|segment| segment.ident == "test")
            || of_cfg
                && attribute
                    .parse_args::<Ident>()
                    .is_ok_and(|name| name == "test")
    })
}

pub(super) fn attributes(item: &Item) -> &[Attribute] {
    match item {
        Item::Const(item) => &item.attrs,
        Item::Enum(item) => &item.attrs,
        Item::Fn(item) => &item.attrs,
        Item::Impl(item) => &item.attrs,
        Item::Macro(item) => &item.attrs,
        Item::Mod(item) => &item.attrs,
        Item::Static(item) => &item.attrs,
        Item::Struct(item) => &item.attrs,
        Item::Trait(item) => &item.attrs,
        Item::Type(item) => &item.attrs,
        Item::Use(item) => &item.attrs,
        _ => &[],
    }
}

fn defined_name(item: &Item) -> Option<String> {
    let ident = match item {
        Item::Const(item) => &item.ident,
        Item::Enum(item) => &item.ident,
        Item::Fn(item) => &item.sig.ident,
        Item::Macro(item) => item.ident.as_ref()?,
        Item::Static(item) => &item.ident,
        Item::Struct(item) => &item.ident,
        Item::Trait(item) => &item.ident,
        Item::Type(item) => &item.ident,
        _ => return None,
    };
    Some(ident.to_string())
}
