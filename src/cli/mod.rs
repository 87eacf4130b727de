//! The command line: the window's door, and everything that needs no window.

mod args;
mod bench;
mod check;
mod error;
mod export;
mod intersect;
mod progress;
mod render;
mod statistics;
mod window;

pub use args::Arguments;
pub use error::CliError;

use args::Command;

/// Does what the command line asks for.
pub fn run(arguments: Arguments) -> Result<(), CliError> {
    match arguments.command {
        None => window::open(arguments.scene.as_deref()),
        Some(Command::Render(render)) => render::render(&render),
        Some(Command::Bench(bench)) => bench::bench(&bench),
        Some(Command::Check(check)) => check::check(&check),
        Some(Command::Intersect(intersect)) => intersect::intersect(&intersect),
        Some(Command::Export(export)) => export::export(&export),
    }
}
