//! `patchlight intersect`: the nearest hit of every ray, by the renderer's own tree.

mod patches;
mod rays;

use super::{CliError, args::IntersectArguments};
use crate::geometry::bezier::{ControlNet, Patch};
use crate::geometry::{Aggregate, Hit, Primitive};
use std::fs;
use std::io::{BufWriter, Write, stdout};
use std::path::Path;
use std::sync::Arc;

/// What is wrong with a file, and the line (from 1) where that shows.
#[derive(Debug, PartialEq, thiserror::Error)]
#[error("line {line}: {problem}")]
struct TableError {
    line: usize,
    problem: String,
}

/// Prints a line for each ray: `1,t,u,v`, with `,patch` (from 0, in the order of the file) where there are several
/// patches, or `0,,,`.
pub(super) fn intersect(arguments: &IntersectArguments) -> Result<(), CliError> {
    let nets =
        chosen(patches::read(&text(&arguments.patches)?).map_err(|e| wrong(&arguments.patches, &e))?, arguments)?;
    let rays = rays::read(&text(&arguments.rays)?).map_err(|e| wrong(&arguments.rays, &e))?;
    let several = nets.len() > 1;
    let aggregate = Aggregate::new(nets.into_iter().map(|net| Primitive::Patch(Arc::new(Patch::new(net)))).collect());
    let mut output = BufWriter::new(stdout().lock());
    for ray in &rays {
        writeln!(output, "{}", line(aggregate.closest_hit(ray), several))?;
    }
    output.flush()?;
    Ok(())
}

fn line(hit: Option<Hit>, several: bool) -> String {
    let Some(Hit { t, u, v, primitive }) = hit else {
        return "0,,,".to_owned();
    };
    let patch = if several { format!(",{primitive}") } else { String::new() };
    format!("1,{t},{u},{v}{patch}")
}

fn chosen(patches: Vec<(String, ControlNet)>, arguments: &IntersectArguments) -> Result<Vec<ControlNet>, CliError> {
    let Some(name) = &arguments.patch else {
        return Ok(patches.into_iter().map(|(_, net)| net).collect());
    };
    match patches.iter().find(|(n, _)| n == name) {
        Some((_, net)) => Ok(vec![*net]),
        None => {
            let names: Vec<&str> = patches.iter().map(|(n, _)| n.as_str()).collect();
            let file = arguments.patches.display();
            Err(CliError::Usage(format!("{file} has no patch `{name}`; it has {}", names.join(", "))))
        }
    }
}

fn text(path: &Path) -> Result<String, CliError> {
    fs::read_to_string(path).map_err(|e| CliError::Usage(format!("{}: {e}", path.display())))
}

fn wrong(path: &Path, error: &TableError) -> CliError {
    CliError::Usage(format!("{}: {error}", path.display()))
}
