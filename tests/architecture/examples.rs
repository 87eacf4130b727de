//! Tests of the rules on small made-up crates.

use crate::modules::{Modules, Segments};
use crate::resolve::Target;
use crate::rules;

/// Two modules in order, the lower one with a room and a `pub use`.
const LIB: (&str, &str) = (
    "src/lib.rs",
    "//! | module | holds |\n//! |---|---|\n//! | [`mod@low`] | a |\n//! | [`high`], `side` | b |\nmod low; mod high; mod side;",
);
const LOW: (&str, &str) = ("src/low/mod.rs", "mod a; mod b; pub use a::A; pub use b::B as Bee; pub use glam::Vec3;");

fn read(files: &[(&str, &str)]) -> Modules {
    Modules::read(|file| Some(files.iter().find(|(name, _)| *name == file)?.1.to_owned())).unwrap()
}

/// `LIB` and `LOW` with these contents of the other files.
fn with(a: &str, b: &str, high: &str, side: &str) -> Modules {
    read(&[LIB, LOW, ("src/low/a.rs", a), ("src/low/b.rs", b), ("src/high.rs", high), ("src/side.rs", side)])
}

fn path(path: &str) -> Segments {
    path.split("::").map(str::to_owned).collect()
}

#[test]
fn paths_lead_to_the_file_that_defines_the_item() {
    let high = "use crate::low::{self, Bee as C}; use super::low as l; use crate::low::*;";
    let modules = with("pub enum A { X }", "pub struct B;", high, "");
    let item = |module, name: &str| Some(Target::Item { module: path(module), name: name.to_owned() });
    for (source, expected) in [
        ("crate::low::A", item("low::a", "A")),
        ("crate::low::A::X", item("low::a", "A")),
        ("super::low::Bee", item("low::b", "B")),
        ("C", item("low::b", "B")),
        ("low::Bee::new", item("low::b", "B")),
        ("l::A", item("low::a", "A")),
        ("A", item("low::a", "A")),
        ("self::C", item("low::b", "B")),
        ("crate::low", Some(Target::Module(path("low")))),
        ("std::fmt::Debug", Some(Target::Foreign)),
        ("crate::low::Vec3::ZERO", Some(Target::Foreign)),
        ("crate::low::Nothing", None),
    ] {
        assert_eq!(modules.resolve(&path("high"), &path(source)), expected, "{source}");
    }
}

#[test]
fn functions_that_a_macro_takes_are_items() {
    let modules = with("simd_dispatch! { pub fn A() { crate::high::f() } }", "", "pub fn f() {}", "");
    let item = Target::Item { module: path("low::a"), name: "A".to_owned() };
    assert_eq!(modules.resolve(&path("low"), &path("A")), Some(item));
    assert_eq!(rules::upward(&modules, &modules.uses().0), ["src/low/a.rs -> src/high.rs (f)"]);
}

#[test]
fn an_import_against_the_order_is_found() {
    for (a, high, side, expected) in [
        ("pub struct A;", "use crate::low::A; pub struct H(A);", "", None),
        ("pub struct A(crate::high::H);", "pub struct H;", "", Some("src/low/a.rs -> src/high.rs (H)")),
        ("pub use crate::high::H;", "pub struct H;", "", Some("src/low/a.rs -> src/high.rs (H)")),
        (
            "pub fn A() { assert!(super::super::high::H) }",
            "const H: bool = true;",
            "",
            Some("src/low/a.rs -> src/high.rs (H)"),
        ),
        (
            "fn f() { matches!(1, x if x > crate::high::H) }",
            "pub const H: u8 = 1;",
            "",
            Some("src/low/a.rs -> src/high.rs (H)"),
        ),
        ("pub struct A;", "pub struct H;", "use crate::high::H;", Some("src/side.rs -> src/high.rs (H)")),
        ("pub struct A; #[cfg(test)] mod tests { use crate::high::H; }", "pub struct H;", "", None),
    ] {
        let modules = with(a, "pub struct B;", high, side);
        assert_eq!(rules::upward(&modules, &modules.uses().0), Vec::from_iter(expected), "{a} {high} {side}");
    }
}

#[test]
fn rooms_keep_the_order_of_the_table_in_their_folder() {
    let table = "//! | file | holds |\n//! |---|---|\n//! | `down/` | a |\n//! | `up/` | b |\nmod down; mod up;";
    let files = |down, up| {
        let modules = read(&[
            ("src/lib.rs", table),
            ("src/down/mod.rs", "mod d;"),
            ("src/down/d.rs", down),
            ("src/up/mod.rs", "mod u;"),
            ("src/up/u.rs", up),
        ]);
        rules::upward(&modules, &modules.uses().0)
    };
    assert!(files("pub struct D;", "use crate::down::d::D;").is_empty());
    assert_eq!(files("use crate::up::u::U;", "pub struct U;"), ["src/down/d.rs -> src/up/u.rs (U)"]);
}

#[test]
fn files_keep_the_order_of_a_table_of_modules() {
    let upward = |head| {
        let folder =
            format!("//! | {head} | holds |\n//! |---|---|\n//! | `low` | a |\n//! | `high` | b |\nmod low; mod high;");
        let modules = read(&[
            ("src/lib.rs", "mod f;"),
            ("src/f/mod.rs", &folder),
            ("src/f/low.rs", "use super::high::H;"),
            ("src/f/high.rs", "pub struct H;"),
        ]);
        rules::upward(&modules, &modules.uses().0)
    };
    assert_eq!(upward("module"), ["src/f/low.rs -> src/f/high.rs (H)"]);
    assert!(upward("file").is_empty(), "only folders keep the order");
}

#[test]
fn a_circle_is_found() {
    let circles = |a, b| {
        let modules = with(a, b, "", "");
        rules::circles(&modules, &modules.uses().0)
    };
    let expected = "2 files:\n  src/low/a.rs -> src/low/b.rs (B)\n  src/low/b.rs -> src/low/a.rs (A)";
    assert_eq!(circles("use super::Bee; pub struct A;", "use super::A; pub struct B;"), [expected]);
    assert_eq!(circles("pub struct A(super::b::B);", "pub fn B() { vec![super::A; 2] }"), [expected]);
    assert!(circles("use super::Bee; pub struct A;", "pub struct B;").is_empty());
    assert!(
        circles("use super::Bee; pub struct A;", "pub struct B; #[cfg(test)] mod tests { use super::super::A; }")
            .is_empty()
    );
}

#[test]
fn a_folder_that_uses_its_own_files_makes_a_circle_with_them() {
    let circles = |folder, file| {
        let modules = read(&[("src/lib.rs", "mod f;"), ("src/f/mod.rs", folder), ("src/f/a.rs", file)]);
        rules::circles(&modules, &modules.uses().0)
    };
    let file = "use super::F; pub struct A(F);";
    assert!(circles("mod a; pub use a::A; pub struct F;", file).is_empty(), "`pub use` only hands on");
    let expected = "2 files:\n  src/f/mod.rs -> src/f/a.rs (A)\n  src/f/a.rs -> src/f/mod.rs (F)";
    assert_eq!(circles("mod a; pub use a::A; pub struct F(Vec<A>);", file), [expected]);
    assert_eq!(circles("mod a; pub struct F(Vec<a::A>);", file), [expected]);
}

#[test]
fn tables_list_exactly_the_files() {
    let modules = read(&[
        (
            "src/lib.rs",
            "//! | file | holds |\n//! |---|---|\n//! | `mod` | a |\n//! | `a.rs` | a |\n//! | `c` | c |\nmod a; mod b;",
        ),
        ("src/a.rs", ""),
        ("src/b.rs", ""),
    ]);
    assert_eq!(rules::wrong_tables(&modules), ["src/lib.rs: no row for b", "src/lib.rs: no module for the row of c"]);
}
