//! The modules of a crate, read from its source: the names that each defines, imports and mentions.

use std::collections::{BTreeMap, BTreeSet, HashSet};
use syn::visit::{self, Visit};
use syn::{Attribute, Expr, Ident, Item, ItemUse, Macro, Path, UseTree, VisRestricted, Visibility};

/// The path of a module from the crate's root, or a path as the source has it.
pub(crate) type Segments = Vec<String>;

/// All modules of a crate by their paths, modules of tests left out.
#[derive(Default)]
pub(crate) struct Modules(pub(crate) BTreeMap<Segments, Module>);

/// The names in one module.
pub(crate) struct Module {
    /// The file, from the package's folder. An inline module has the file that it stands in.
    pub(crate) file: String,
    /// The table that begins the file: the names in the first cell of each row, from the top.
    pub(crate) table: Vec<Vec<String>>,
    /// Whether the first cell of the table's head is `module`: then also files keep the order of the rows, not only folders.
    pub(crate) orders_files: bool,
    /// The modules that it declares with `mod name;`.
    pub(crate) files: BTreeSet<String>,
    /// The names that it defines, modules left out.
    pub(crate) items: HashSet<String>,
    /// The names that `use` brings in.
    pub(crate) imports: Vec<Import>,
    /// The paths outside `use`, single names included.
    pub(crate) mentions: BTreeSet<Segments>,
}

/// One name that `use` brings in.
#[derive(Clone)]
pub(crate) struct Import {
    /// The name in the importing module; `*` for all names of a module.
    pub(crate) name: String,
    /// The path of the imported item; of the module where the name is `*`.
    pub(crate) path: Segments,
    /// Whether other modules may take the name from here: `pub use`.
    pub(crate) is_reexport: bool,
}

impl Modules {
    /// Reads `src/lib.rs` and the modules below it. `source` returns the content of a file, `None` where there is no such file.
    pub(crate) fn read(source: impl Fn(&str) -> Option<String>) -> Result<Self, String> {
        let mut modules = Self::default();
        let mut open = vec![Segments::new()];
        while let Some(path) = open.pop() {
            let stem = path.join("/");
            let files = match path.len() {
                0 => vec!["src/lib.rs".to_owned()],
                _ => vec![format!("src/{stem}.rs"), format!("src/{stem}/mod.rs")],
            };
            let found = files.iter().find_map(|file| Some((file, source(file)?)));
            let (file, text) = found.ok_or_else(|| format!("there is no {}", files.join(" and no ")))?;
            let parsed = syn::parse_file(&text).map_err(|error| format!("{file}: {error}"))?;
            modules.add(&path, file, &text, &parsed.items);
            open.extend(modules.0[&path].files.iter().map(|name| child(&path, name)));
        }
        Ok(modules)
    }

    /// Adds the module of this path in `file`, whose documentation begins `text`.
    fn add(&mut self, path: &[String], file: &str, text: &str, items: &[Item]) {
        let mut module = Module {
            file: file.to_owned(),
            table: table(text),
            orders_files: head(text).is_some_and(|head| head == "module"),
            files: BTreeSet::new(),
            items: HashSet::new(),
            imports: Vec::new(),
            mentions: BTreeSet::new(),
        };
        for item in items.iter().flat_map(items_of) {
            let (name, attributes) = name_and_attributes(&item);
            match &item {
                _ if is_for_tests(attributes) => {}
                Item::Mod(inner) => match &inner.content {
                    None => _ = module.files.insert(inner.ident.to_string()),
                    Some((_, items)) => self.add(&child(path, &inner.ident.to_string()), file, "", items),
                },
                _ => {
                    module.items.extend(name.map(Ident::to_string));
                    module.visit_item(&item);
                }
            }
        }
        self.0.insert(path.to_vec(), module);
    }
}

/// The path of a module's child.
pub(crate) fn child(path: &[String], name: &str) -> Segments {
    [path, &[name.to_owned()]].concat()
}

impl<'ast> Visit<'ast> for Module {
    fn visit_item_use(&mut self, item: &'ast ItemUse) {
        let is_reexport = !matches!(item.vis, Visibility::Inherited);
        flatten(&item.tree, &mut Segments::new(), &mut |name, path| {
            self.imports.push(Import { name: name.to_owned(), path: path.to_vec(), is_reexport });
        });
    }

    fn visit_path(&mut self, path: &'ast Path) {
        self.mentions.insert(path.segments.iter().map(|segment| segment.ident.to_string()).collect());
        visit::visit_path(self, path);
    }

    fn visit_macro(&mut self, call: &'ast Macro) {
        self.visit_path(&call.path);
        // Only macros that take expressions, like `assert!` and `vec!`; the guard of `matches!` is read as one more.
        let arguments = |tokens: &str| syn::parse_str::<Expr>(&format!("[{tokens}]"));
        let tokens = call.tokens.to_string();
        if let Ok(arguments) = arguments(&tokens).or_else(|_| arguments(&tokens.replace(" if ", ", "))) {
            Visit::visit_expr(self, &arguments);
        }
    }

    // `pub(in crate::a)` and `#[a::b]` use no item of `a`.
    fn visit_vis_restricted(&mut self, _: &'ast VisRestricted) {}
    fn visit_attribute(&mut self, _: &'ast Attribute) {}
}

/// Calls `add` with each name that a `use` brings in, and with the path that the name stands for.
fn flatten(tree: &UseTree, path: &mut Segments, add: &mut impl FnMut(&str, &[String])) {
    match tree {
        UseTree::Path(tree) => {
            path.push(tree.ident.to_string());
            flatten(&tree.tree, path, add);
            path.pop();
        }
        UseTree::Group(group) => group.items.iter().for_each(|tree| flatten(tree, path, add)),
        UseTree::Glob(_) => add("*", path),
        // `use a::{self}` brings in `a`.
        UseTree::Name(tree) if tree.ident == "self" => add(path.last().map_or("self", String::as_str), path),
        UseTree::Name(tree) => add(&tree.ident.to_string(), &child(path, &tree.ident.to_string())),
        UseTree::Rename(tree) if tree.ident == "self" => add(&tree.rename.to_string(), path),
        UseTree::Rename(tree) => add(&tree.rename.to_string(), &child(path, &tree.ident.to_string())),
    }
}

/// The item, or the items that a macro like `simd_dispatch!` takes.
fn items_of(item: &Item) -> Vec<Item> {
    match item {
        Item::Macro(call) if call.ident.is_none() => syn::parse2::<syn::File>(call.mac.tokens.clone()).ok(),
        _ => None,
    }
    .map_or_else(|| vec![item.clone()], |file| file.items)
}

/// The name that an item defines, where it defines one, and the item's attributes.
fn name_and_attributes(item: &Item) -> (Option<&Ident>, &[Attribute]) {
    match item {
        Item::Const(item) => (Some(&item.ident), &item.attrs),
        Item::Enum(item) => (Some(&item.ident), &item.attrs),
        Item::Fn(item) => (Some(&item.sig.ident), &item.attrs),
        Item::Impl(item) => (None, &item.attrs),
        Item::Macro(item) => (item.ident.as_ref(), &item.attrs),
        Item::Mod(item) => (None, &item.attrs),
        Item::Static(item) => (Some(&item.ident), &item.attrs),
        Item::Struct(item) => (Some(&item.ident), &item.attrs),
        Item::Trait(item) => (Some(&item.ident), &item.attrs),
        Item::Type(item) => (Some(&item.ident), &item.attrs),
        Item::Union(item) => (Some(&item.ident), &item.attrs),
        Item::Use(item) => (None, &item.attrs),
        _ => (None, &[]),
    }
}

/// Whether an item is compiled for tests only: `#[cfg(test)]`, `#[cfg(all(test, ...))]`.
fn is_for_tests(attributes: &[Attribute]) -> bool {
    attributes.iter().any(|attribute| {
        let condition = attribute.meta.require_list().map(|list| list.tokens.to_string()).unwrap_or_default();
        attribute.path().is_ident("cfg") && (condition == "test" || condition.starts_with("all (test"))
    })
}

/// The table of files or modules in the documentation that begins a file.
fn table(text: &str) -> Vec<Vec<String>> {
    let rows = from_head(text).skip(2).map_while(|cell| cell);
    rows.map(|cell| cell.split(',').map(module_name).collect()).collect()
}

/// The first cell of the head of the table.
fn head(text: &str) -> Option<&str> {
    from_head(text).next()?
}

/// The first cell of each line of the documentation that begins a file, from the head of its table on; `None` for other lines.
fn from_head(text: &str) -> impl Iterator<Item = Option<&str>> {
    let rows = text.lines().map_while(|line| line.strip_prefix("//!")).map(|line| line.trim().strip_prefix("| "));
    let cells = rows.map(|row| Some(row?.split('|').next()?.trim()));
    cells.skip_while(|cell| !cell.is_some_and(|cell| ["file", "folder", "module"].contains(&cell)))
}

/// The module that a cell of a table names: `name.rs`, `name/` or a link to it.
fn module_name(cell: &str) -> String {
    let name = cell.trim().trim_matches(['[', ']', '`']);
    name.trim_start_matches("mod@").trim_end_matches('/').trim_end_matches(".rs").to_owned()
}
