//! Where a path of the source leads: to the module that defines the item, through `use` and `pub use`.

use crate::modules::{Module, Modules, Segments, child};
use std::collections::{BTreeMap, BTreeSet, HashSet};

/// The item or module that a path leads to.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Target {
    /// The module of this path.
    Module(Segments),
    /// An item, and the module that defines it.
    Item { module: Segments, name: String },
    /// An item of another crate, or a local name.
    Foreign,
}

/// The names that one file uses of another file.
#[derive(Default)]
pub(crate) struct Use {
    /// Names that the file only re-exports with `pub use`.
    pub(crate) reexported: BTreeSet<String>,
    /// Names that the file itself uses.
    pub(crate) used: BTreeSet<String>,
}

/// The names that files use of each other, by the modules of the importing and the defining file.
pub(crate) type Uses = BTreeMap<(Segments, Segments), Use>;

impl Modules {
    /// The target of a path in a module; `None` where a path within this crate leads nowhere.
    pub(crate) fn resolve(&self, module: &[String], path: &[String]) -> Option<Target> {
        self.follow(module, path, &mut HashSet::new())
    }

    fn follow(&self, module: &[String], path: &[String], seen: &mut HashSet<(Segments, Segments)>) -> Option<Target> {
        let (first, rest) = path.split_first()?;
        // `use image::Image` in a module does not make the crate `image` a name of that module.
        if !seen.insert((module.to_vec(), path.to_vec())) {
            return Some(Target::Foreign);
        }
        let start = match first.as_str() {
            "crate" => Target::Module(Segments::new()),
            "self" => Target::Module(module.to_vec()),
            "super" => Target::Module(parent(module)?),
            name => self.named(module, name, seen).unwrap_or(Target::Foreign),
        };
        rest.iter().try_fold(start, |target, name| match target {
            Target::Module(module) if name == "super" => Some(Target::Module(parent(&module)?)),
            Target::Module(module) => self.named(&module, name, seen),
            // A variant, a constant or a function of a type.
            target => Some(target),
        })
    }

    /// The target of a name in a module.
    fn named(&self, path: &[String], name: &str, seen: &mut HashSet<(Segments, Segments)>) -> Option<Target> {
        let module = self.0.get(path)?;
        let inner = child(path, name);
        if self.0.contains_key(&inner) {
            return Some(Target::Module(inner));
        }
        if module.items.contains(name) {
            return Some(Target::Item { module: path.to_vec(), name: name.to_owned() });
        }
        if let Some(import) = module.imports.iter().find(|import| import.name == name) {
            return self.follow(path, &import.path, seen);
        }
        let globs = module.imports.iter().filter(|import| import.name == "*");
        let found: Vec<_> = globs.filter_map(|glob| self.follow(path, &child(&glob.path, name), seen)).collect();
        found.iter().find(|target| **target != Target::Foreign).or(found.first()).cloned()
    }

    /// The names that files use of each other, and the paths that lead nowhere.
    pub(crate) fn uses(&self) -> (Uses, Vec<String>) {
        let (mut uses, mut lost) = (Uses::new(), Vec::new());
        for (from, module) in &self.0 {
            for (path, is_reexport) in module.paths() {
                match self.resolve(from, path) {
                    Some(Target::Item { module: to, name }) if self.0[&to].file != module.file => {
                        let entry = uses.entry((self.of_file(from), self.of_file(&to))).or_default();
                        if is_reexport { &mut entry.reexported } else { &mut entry.used }.insert(name);
                    }
                    Some(_) => {}
                    None => lost.push(format!("{}: {}", module.file, path.join("::"))),
                }
            }
        }
        (uses, lost)
    }

    /// The module that the file of a module is; not the module itself where it is inline.
    fn of_file(&self, path: &[String]) -> Segments {
        let above = (0..=path.len()).map(|length| &path[..length]);
        let mut same_file = above.filter(|above| self.0[*above].file == self.0[path].file);
        same_file.next().unwrap_or(path).to_vec()
    }
}

impl Module {
    /// Every path of the source, and whether it stands in `pub use`. Modules of which all names are imported are left out.
    fn paths(&self) -> impl Iterator<Item = (&Segments, bool)> {
        let imports = self.imports.iter().filter(|import| import.name != "*");
        imports.map(|import| (&import.path, import.is_reexport)).chain(self.mentions.iter().map(|path| (path, false)))
    }
}

fn parent(module: &[String]) -> Option<Segments> {
    module.split_last().map(|(_, above)| above.to_vec())
}
