//! The page with the tables of the suite.

use crate::suite::Row;
use crate::{block, machine};
use patchlight::file::write_whole;
use std::fs;
use std::path::Path;
use std::time::Duration;

/// The tables of all groups, with a heading each, below a line that counts the rows.
pub(crate) fn tables(groups: &[(&str, Vec<Row>)]) -> String {
    let rows = || groups.iter().flat_map(|(_, rows)| rows);
    let failed = rows().filter(|row| !row.holds).count();
    let mut text = format!("{} rows, {failed} of which fail.\n", rows().count());
    for (name, rows) in groups.iter().filter(|(_, rows)| !rows.is_empty()) {
        text += &format!("\n### {}{}\n\n", name[..1].to_uppercase(), &name[1..]);
        text += "| name | source | expected | got | tolerance | tried | verdict |\n|---|---|--:|--:|--:|--:|---|\n";
        rows.iter().for_each(|row| text += &format!("{row}\n"));
    }
    text
}

/// Writes the tables, the machine and the time into the blocks of a page.
pub(crate) fn write(file: &Path, tables: &str, time: Duration) -> Result<(), String> {
    let in_page = |error: &dyn std::fmt::Display| format!("{}: {error}", file.display());
    let page = fs::read_to_string(file).map_err(|error| in_page(&error))?;
    let machine =
        format!("{}\n\nTime: {:.0} minutes.", machine::table(&machine::commit()?)?, time.as_secs_f64() / 60.0);
    let page = block::replaced(&page, "machine", &machine).map_err(|error| in_page(&error))?;
    let page = block::replaced(&page, "cases", tables).map_err(|error| in_page(&error))?;
    write_whole(file, page.as_bytes()).map_err(|error| in_page(&error))
}
