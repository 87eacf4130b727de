//! The command line: everything that needs no window.

mod args;
mod bench;
mod check;
mod error;
mod export;
mod intersect;
mod output;
mod progress;
mod render;
mod rendering;
mod statistics;
mod words;

pub use args::Arguments;
pub use error::CliError;

use crate::scene::SceneFile;
use args::Command;
use std::path::Path;

/// Does what the command line asks for. Without a command that is `open_window`, which belongs to whoever has one.
pub fn run(arguments: Arguments, open_window: impl FnOnce(SceneFile) -> Result<(), CliError>) -> Result<(), CliError> {
    match arguments.command {
        None => {
            let scene = arguments.scene.as_deref().unwrap_or(Path::new("report"));
            open_window(SceneFile::find(scene)?)
        }
        Some(Command::Render(render)) => render::render(&render),
        Some(Command::Bench(bench)) => bench::bench(&bench),
        Some(Command::Check(check)) => check::check(&check),
        Some(Command::Intersect(intersect)) => intersect::intersect(&intersect),
        Some(Command::Export(export)) => export::export(&export),
    }
}
