//! Writes what an installed program has beside its binary: man pages, and completions for shells.
//! `cargo run --release --example packaging`.
//!
//! The files lie in `target/packaging`, where the metadata of the Debian package expect them.

use clap::CommandFactory;
use clap_complete::{Shell, generate_to};
use patchlight::cli::Arguments;
use std::fs;
use std::path::Path;

fn main() -> std::io::Result<()> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("target/packaging");
    write(&folder)
}

/// Writes the files into this folder, which need not exist.
fn write(folder: &Path) -> std::io::Result<()> {
    let (man, completions) = (folder.join("man"), folder.join("completions"));
    fs::create_dir_all(&man)?;
    fs::create_dir_all(&completions)?;
    clap_mangen::generate_to(Arguments::command(), man)?;
    for shell in [Shell::Bash, Shell::Zsh, Shell::Fish] {
        generate_to(shell, &mut Arguments::command(), "patchlight", &completions)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

    use super::*;

    #[test]
    fn every_file_of_the_debian_package_exists() {
        let root = Path::new(env!("CARGO_MANIFEST_DIR"));
        let folder = std::env::temp_dir().join(format!("patchlight-packaging-{}", std::process::id()));
        write(&folder).unwrap();
        let manifest: toml::Table = toml::from_str(&fs::read_to_string(root.join("Cargo.toml")).unwrap()).unwrap();
        let assets = manifest["package"]["metadata"]["deb"]["assets"].as_array().unwrap();
        assert!(assets.len() >= 8, "{assets:?}");
        for source in assets.iter().map(|asset| asset[0].as_str().unwrap()) {
            let path = match source.strip_prefix("target/packaging/") {
                Some(written) => folder.join(written),
                None if source.starts_with("target/") => continue,
                None => root.join(source),
            };
            let exists = match path.file_name().and_then(|name| name.to_str()) {
                Some("*.1") => fs::read_dir(path.parent().unwrap()).unwrap().count() > 5,
                _ => path.is_file(),
            };
            assert!(exists, "{source}");
        }
        fs::remove_dir_all(folder).unwrap();
    }
}
