//! The architecture of the crate, checked on its source.
//!
//! The tables at the beginning of `lib.rs` and of each folder's `mod.rs` say the order: a folder uses only modules in rows above its own,
//! and so does a file in a table headed `module`; modules in one row do not import each other. Files import each other in no circle.
//! Tests and documentation may use anything.
//!
//! An import is a path in the source. A method call names no path, so calls of methods are not seen: where files share out the inherent
//! methods of a type, one of them may call a method of another against the order.
//!
//! | file | holds |
//! |---|---|
//! | `modules` | the names that each module defines, imports and mentions |
//! | `resolve` | where a path leads: to the file that defines the item |
//! | `rules` | imports against the order, circles, tables of files |
//! | `examples` | small crates that keep and break the rules |

#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test that cannot go on has failed")]

mod examples;
mod modules;
mod resolve;
mod rules;

use modules::Modules;
use std::{fs, path::Path};

fn this_crate() -> Modules {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    Modules::read(|file| fs::read_to_string(root.join(file)).ok()).unwrap()
}

#[test]
fn every_path_leads_to_an_item() {
    let (_, lost) = this_crate().uses();
    assert!(
        lost.is_empty(),
        "This test does not find the items of these paths; mend its `resolve.rs`:\n{}",
        lost.join("\n")
    );
}

#[test]
fn modules_import_only_modules_of_rows_above_their_own() {
    let modules = this_crate();
    let upward = rules::upward(&modules, &modules.uses().0);
    assert!(
        upward.is_empty(),
        "These imports go against the order of the tables in lib.rs and mod.rs. Move the imported item down to a file that both may use, \
         pass it in as an argument, or, where the table is wrong, mend its order:\n{}",
        upward.join("\n")
    );
}

#[test]
fn files_import_each_other_in_no_circle() {
    let modules = this_crate();
    let circles = rules::circles(&modules, &modules.uses().0);
    assert!(
        circles.is_empty(),
        "These files cannot be read one after the other. Move one of the imported items to a file of its own, or pass it in as an \
         argument:\n{}",
        circles.join("\n")
    );
}

#[test]
fn every_folder_begins_with_a_table_of_its_files() {
    let wrong = rules::wrong_tables(&this_crate());
    assert!(
        wrong.is_empty(),
        "Begin each file that declares modules with a table `//! | file | holds |`, one row a file, the most imported file first:\n{}",
        wrong.join("\n")
    );
}
