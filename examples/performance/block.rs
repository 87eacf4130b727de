//! The generated parts of a page.

/// The marker that ends a block.
const END: &str = "<!-- end -->";

/// The page with `content`, between blank lines, in the block `name`.
///
/// # Errors
///
/// When the page has no such block, two such blocks, or a block without an end.
pub(crate) fn replaced(page: &str, name: &str, content: &str) -> Result<String, String> {
    let start = format!("<!-- table: {name} -->");
    let (before, rest) = page.split_once(&start).ok_or_else(|| format!("there is no {start}"))?;
    if rest.contains(&start) {
        return Err(format!("there are two {start}"));
    }
    let (old, after) = rest.split_once(END).ok_or_else(|| format!("no {END} follows {start}"))?;
    if old.contains("<!-- table: ") {
        return Err(format!("no {END} follows {start} before the next table"));
    }
    Ok(format!("{before}{start}\n\n{}\n\n{END}{after}", content.trim()))
}

#[cfg(test)]
mod tests {
    use super::*;

    const PAGE: &str = "a\n\n<!-- table: one -->\n\nold\n\n<!-- end -->\n\nb\n<!-- table: two -->\n<!-- end -->\n";

    #[test]
    fn only_the_block_changes() {
        let page = replaced(PAGE, "one", "\n| new |\n|---|\n").unwrap();
        assert_eq!(page, PAGE.replace("old", "| new |\n|---|"));
        assert_eq!(replaced(&page, "one", "old").unwrap(), PAGE, "and back again");
        let page = replaced(PAGE, "two", "new").unwrap();
        assert!(page.ends_with("b\n<!-- table: two -->\n\nnew\n\n<!-- end -->\n"), "an empty block: {page}");
    }

    #[test]
    fn missing_markers_are_named() {
        let no_end = PAGE.replace("<!-- end -->", "");
        let no_first_end = PAGE.replacen("<!-- end -->", "", 1);
        for (page, name, message) in [
            (PAGE, "three", "there is no <!-- table: three -->"),
            (&format!("{PAGE}{PAGE}"), "one", "there are two <!-- table: one -->"),
            (&no_end, "two", "no <!-- end --> follows <!-- table: two -->"),
            (&no_first_end, "one", "no <!-- end --> follows <!-- table: one --> before the next table"),
        ] {
            assert_eq!(replaced(page, name, "").unwrap_err(), message);
        }
    }
}
