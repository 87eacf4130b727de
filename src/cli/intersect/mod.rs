//! `patchlight intersect`: the nearest hit of every ray, by the tree of the renderer.
//!
//! | file | holds |
//! |---|---|
//! | `patches` | reads the file of patches |
//! | `rays` | reads the table of rays |
//! | `table_error` | `TableError`: an error with its line |

mod patches;
mod rays;
mod table_error;

use super::{CliError, args::IntersectArguments};
use crate::file::read_text_limited;
use crate::geometry::bezier::{ControlNet, Patch};
use crate::geometry::{Aggregate, Hit, Primitive};
use std::io::{BufWriter, Write, stdout};
use std::path::Path;
use std::sync::Arc;
use table_error::TableError;

/// Most bytes of the files of patches and rays: some ten million rays.
const MAX_BYTES: u64 = 2 << 30;

/// Prints the hits of the command's rays.
pub(super) fn intersect(arguments: &IntersectArguments) -> Result<(), CliError> {
    let mut output = BufWriter::new(stdout().lock());
    write_hits(&arguments.patches, arguments.patch.as_deref(), &arguments.rays, &mut output)?;
    output.flush()?;
    Ok(())
}

/// Writes a line for each ray of a file: `0,,,` for a miss, `1,t,u,v` for a hit, with `,patch` (the index in the file, from 0) if there
/// are several patches. `name` restricts them to one patch.
///
/// # Errors
///
/// If a file cannot be read or has no such patch, with the file and the line; if the output fails.
pub fn write_hits(patches: &Path, name: Option<&str>, rays: &Path, output: &mut impl Write) -> Result<(), CliError> {
    let nets = chosen(patches::read(&text(patches)?).map_err(|e| wrong(patches, &e))?, patches, name)?;
    let rays = rays::read(&text(rays)?).map_err(|e| wrong(rays, &e))?;
    let several = nets.len() > 1;
    let aggregate = Aggregate::new(nets.into_iter().map(|net| Primitive::Patch(Arc::new(Patch::new(net)))).collect());
    for ray in &rays {
        writeln!(output, "{}", line(aggregate.closest_hit(ray), several))?;
    }
    Ok(())
}

fn line(hit: Option<Hit>, several: bool) -> String {
    let Some(Hit { t, u, v, primitive }) = hit else {
        return "0,,,".to_owned();
    };
    let patch = if several { format!(",{primitive}") } else { String::new() };
    format!("1,{t},{u},{v}{patch}")
}

fn chosen(patches: Vec<(String, ControlNet)>, file: &Path, name: Option<&str>) -> Result<Vec<ControlNet>, CliError> {
    let Some(name) = name else {
        return Ok(patches.into_iter().map(|(_, net)| net).collect());
    };
    match patches.iter().find(|(n, _)| n == name) {
        Some((_, net)) => Ok(vec![*net]),
        None => {
            let names: Vec<&str> = patches.iter().map(|(n, _)| n.as_str()).collect();
            let file = file.display();
            Err(CliError::Usage(format!("{file} has no patch `{name}`; its patches are {}", names.join(", "))))
        }
    }
}

fn text(path: &Path) -> Result<String, CliError> {
    read_text_limited(path, MAX_BYTES).map_err(|e| CliError::Usage(format!("{}: cannot be read: {e}", path.display())))
}

fn wrong(path: &Path, error: &TableError) -> CliError {
    CliError::Usage(format!("{}: {error}", path.display()))
}
