//! The `patchlight` program.
fn main() {}
