use super::table_error::TableError;
use crate::geometry::bezier::ControlNet;
use glam::DVec3;

/// The named patches of a text: for each patch a line `patch NAME`, then 16 lines `x y z` for `P[0][0]`, `P[0][1]`, ..., `P[3][3]`, the
/// first index along u. Empty lines and lines that start with `#` are ignored.
pub(super) fn read(text: &str) -> Result<Vec<(String, ControlNet)>, TableError> {
    let mut patches = Vec::new();
    let mut lines = text.lines().enumerate().map(|(k, line)| (k + 1, line.trim()));
    let mut lines = lines.by_ref().filter(|(_, line)| !line.is_empty() && !line.starts_with('#'));
    while let Some((line, words)) = lines.next() {
        let Some(name) = words.strip_prefix("patch ") else {
            return Err(TableError { line, problem: format!("expected `patch NAME`, found `{words}`") });
        };
        let mut net = ControlNet { points: [[DVec3::ZERO; 4]; 4] };
        let mut last = line;
        for (k, point) in net.points.iter_mut().flatten().enumerate() {
            let Some((line, words)) = lines.next() else {
                return Err(TableError { line: last, problem: format!("patch {name} ends after {k} of 16 points") });
            };
            *point = self::point(words).ok_or_else(|| TableError {
                line,
                problem: format!(
                    "expected point {} of 16 of patch {name} as three finite numbers, found `{words}`",
                    k + 1
                ),
            })?;
            last = line;
        }
        patches.push((name.trim().to_owned(), net));
    }
    Ok(patches)
}

fn point(words: &str) -> Option<DVec3> {
    let numbers: Option<Vec<f64>> = words.split_whitespace().map(|word| word.parse().ok()).collect();
    let point = DVec3::from_array(numbers?.try_into().ok()?);
    point.is_finite().then_some(point)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_patches_and_says_where_they_are_wrong() {
        let points: Vec<String> = (0..16).map(|k| format!("{k} 0.5 -1e-3")).collect();
        let good = format!("# a comment\n\npatch one\n{}\npatch two\n{}\n", points.join("\n"), points.join("\n"));
        let patches = read(&good).unwrap();
        assert_eq!(patches.len(), 2);
        assert_eq!((patches[1].0.as_str(), patches[1].1.points[1][2]), ("two", DVec3::new(6.0, 0.5, -1e-3)));
        let error = |text: &str| read(text).unwrap_err().to_string();
        assert_eq!(error(&good.replace("patch two", "patch")), "line 20: expected `patch NAME`, found `patch`");
        assert!(
            error(&good.replacen("5 0.5", "NaN 0.5", 1)).starts_with("line 9: expected point 6 of 16 of patch one")
        );
        assert!(error("patch a\n0 0 0\n").starts_with("line 2: patch a ends after 1 of 16 points"));
    }
}
