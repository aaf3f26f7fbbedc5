//! Public names of a crate that nothing outside of it uses: the compiler reports an unused function only if it is not public.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use syn::visit::{self, Visit};
use syn::{Field, Ident, ImplItemFn, Item, ItemMod, TypePath, Visibility};

use super::sources::{attributes, is_test, line_of};

/// Folders of Rust code that may use the engine, from the root of the workspace.
pub(super) const USERS: [&str; 4] = ["server/src", "solver/benches", "solver/examples", "tests"];

/// Public names of the crate in a folder, each with its place, that no file of its users has. Names are compared, whatever they stand for.
/// A type is also used by the public signatures and fields of the crate.
pub(super) fn unused(workspace: &Path, folder: &str, users: &[&str]) -> Vec<String> {
    let mut names = Names::default();
    for file in files(&workspace.join(folder)) {
        let text = read(&file);
        names.file = file
            .strip_prefix(workspace)
            .map_or(file.clone(), Path::to_path_buf);
        names.visit_file(&syn::parse_file(&text).expect("Rust"));
    }
    let used: BTreeSet<String> = users
        .iter()
        .flat_map(|folder| files(&workspace.join(folder)))
        .flat_map(|file| words(&read(&file)))
        .collect();
    names
        .public
        .iter()
        .filter(|(name, _)| !used.contains(name) && !names.of_signatures.contains(name))
        .map(|(name, place)| format!("{place}: `{name}` is public, and no other crate uses it"))
        .collect()
}

/// Public names of a crate, and the types in their signatures.
#[derive(Default)]
struct Names {
    file: PathBuf,
    /// Each public name and its place.
    public: Vec<(String, String)>,
    /// Types in signatures and fields that are public.
    of_signatures: BTreeSet<String>,
    /// True within what is public, so that types count.
    is_public: bool,
}

impl Names {
    fn add(&mut self, name: &Ident) {
        let place = format!("{}:{}", self.file.display(), line_of(name));
        self.public.push((name.to_string(), place));
    }

    /// Adds the types of a part of a public item.
    fn signature(&mut self, visit: impl FnOnce(&mut Self)) {
        self.is_public = true;
        visit(self);
        self.is_public = false;
    }
}

impl<'ast> Visit<'ast> for Names {
    fn visit_item(&mut self, item: &'ast Item) {
        if is_test(attributes(item)) {
            return;
        }
        match item {
            Item::Fn(item) if is_public(&item.vis) => {
                self.add(&item.sig.ident);
                self.signature(|names| names.visit_signature(&item.sig));
            }
            Item::Const(item) if is_public(&item.vis) => {
                self.add(&item.ident);
                self.signature(|names| names.visit_type(&item.ty));
            }
            Item::Static(item) if is_public(&item.vis) => {
                self.add(&item.ident);
                self.signature(|names| names.visit_type(&item.ty));
            }
            Item::Type(item) if is_public(&item.vis) => {
                self.add(&item.ident);
                self.signature(|names| names.visit_type(&item.ty));
            }
            Item::Struct(item) if is_public(&item.vis) => {
                self.add(&item.ident);
                visit::visit_fields(self, &item.fields);
            }
            Item::Enum(item) if is_public(&item.vis) => {
                self.add(&item.ident);
                let variants = item.variants.iter();
                self.signature(|names| variants.for_each(|variant| names.visit_variant(variant)));
            }
            Item::Trait(item) if is_public(&item.vis) => {
                self.add(&item.ident);
                self.signature(|names| visit::visit_item_trait(names, item));
            }
            Item::Impl(item) => visit::visit_item_impl(self, item),
            Item::Mod(item) => self.visit_item_mod(item),
            _ => {}
        }
    }

    fn visit_item_mod(&mut self, item: &'ast ItemMod) {
        let items = item.content.iter().flat_map(|(_, items)| items);
        items.for_each(|item| self.visit_item(item));
    }

    fn visit_impl_item_fn(&mut self, method: &'ast ImplItemFn) {
        if is_public(&method.vis) && !is_test(&method.attrs) {
            self.add(&method.sig.ident);
            self.signature(|names| names.visit_signature(&method.sig));
        }
    }

    fn visit_field(&mut self, field: &'ast Field) {
        if is_public(&field.vis) || self.is_public {
            let outer = self.is_public;
            self.is_public = true;
            self.visit_type(&field.ty);
            self.is_public = outer;
        }
    }

    fn visit_type_path(&mut self, path: &'ast TypePath) {
        if self.is_public {
            let segments = path.path.segments.iter();
            self.of_signatures
                .extend(segments.map(|segment| segment.ident.to_string()));
        }
        visit::visit_type_path(self, path);
    }
}

fn is_public(visibility: &Visibility) -> bool {
    matches!(visibility, Visibility::Public(_))
}

/// The words of a text without its comments.
fn words(text: &str) -> BTreeSet<String> {
    let code = text
        .lines()
        .map(|line| line.split("//").next().unwrap_or_default());
    let words = code.flat_map(|line| line.split(|c: char| !c.is_alphanumeric() && c != '_'));
    words.map(str::to_owned).collect()
}

/// The files of Rust code below a folder.
fn files(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).expect("a folder of the workspace") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            found.extend(files(&path));
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            found.push(path);
        }
    }
    found
}

fn read(file: &Path) -> String {
    fs::read_to_string(file).unwrap_or_else(|error| panic!("{}: {error}", file.display()))
}
