//! The rules between files of the crate.

use crate::modules::{Module, Modules, Segments, child};
use crate::resolve::Uses;
use std::collections::{BTreeMap, BTreeSet};

/// Imports of a module by one that stands before it in the table of the folder that both are in, one a line.
pub(crate) fn upward(modules: &Modules, uses: &Uses) -> Vec<String> {
    let mut edges = Vec::new();
    for ((from, to), names) in uses {
        let common = from.iter().zip(to).take_while(|(a, b)| a == b).count();
        let folder = &from[..common];
        let rank = |path: &Segments| modules.rank(folder, path.get(common)?);
        if let (Some(a), Some(b)) = (rank(from), rank(to))
            && a <= b
        {
            let names = names.used.union(&names.reexported).cloned().collect();
            edges.push(edge(modules, from, to, &names));
        }
    }
    edges
}

impl Modules {
    /// The row of a module in the table of its folder; `None` for a file where the table orders only folders.
    fn rank(&self, folder: &[String], name: &str) -> Option<usize> {
        let Module { table, orders_files, .. } = &self.0[folder];
        let is_ordered = *orders_files || !self.0.get(&child(folder, name))?.files.is_empty();
        is_ordered.then(|| table.iter().position(|names| names.iter().any(|n| n == name))).flatten()
    }
}

/// The circles of imports: of each the imports that tie its files to each other, one a line.
pub(crate) fn circles(modules: &Modules, uses: &Uses) -> Vec<String> {
    let mut next = BTreeMap::<&Segments, Vec<&Segments>>::new();
    for ((from, to), _) in uses.iter().filter(|(_, names)| !names.used.is_empty()) {
        next.entry(from).or_default().push(to);
    }
    let reached: BTreeMap<_, _> = next.keys().map(|from| (*from, reached_from(from, &next))).collect();
    let reaches = |a: &Segments, b: &Segments| reached.get(a).is_some_and(|all| all.contains(b));
    let mut circles = BTreeMap::<BTreeSet<&Segments>, Vec<String>>::new();
    for ((from, to), names) in uses.iter().filter(|(_, names)| !names.used.is_empty()) {
        if reaches(to, from) {
            let members = reached[from].iter().copied().filter(|other| reaches(other, from)).collect();
            circles.entry(members).or_default().push(edge(modules, from, to, &names.used));
        }
    }
    circles.into_iter().map(|(members, edges)| format!("{} files:\n  {}", members.len(), edges.join("\n  "))).collect()
}

fn reached_from<'a>(from: &'a Segments, next: &BTreeMap<&'a Segments, Vec<&'a Segments>>) -> BTreeSet<&'a Segments> {
    let (mut reached, mut open) = (BTreeSet::new(), vec![from]);
    while let Some(file) = open.pop() {
        open.extend(next.get(file).into_iter().flatten().filter(|to| reached.insert(**to)));
    }
    reached
}

fn edge(modules: &Modules, from: &Segments, to: &Segments, names: &BTreeSet<String>) -> String {
    let names: Vec<_> = names.iter().map(String::as_str).collect();
    format!("{} -> {} ({})", modules.0[from].file, modules.0[to].file, names.join(", "))
}

/// Rows of a table that name no module of the crate: the file itself, and its tests.
const OTHER_ROWS: [&str; 2] = ["mod", "tests"];

/// Files that declare modules without a table of them, and rows of tables that are wrong, one a line.
pub(crate) fn wrong_tables(modules: &Modules) -> Vec<String> {
    let mut wrong = Vec::new();
    for module in modules.0.values() {
        let listed: BTreeSet<_> = module.table.iter().flatten().cloned().collect();
        let missing: Vec<_> = module.files.difference(&listed).map(String::as_str).collect();
        let unknown = listed.difference(&module.files).map(String::as_str).filter(|row| !OTHER_ROWS.contains(row));
        let unknown: Vec<_> = unknown.collect();
        if !missing.is_empty() {
            wrong.push(format!("{}: no row for {}", module.file, missing.join(", ")));
        }
        if !unknown.is_empty() {
            wrong.push(format!("{}: no module for the row of {}", module.file, unknown.join(", ")));
        }
    }
    wrong
}
