//! The output of criterion as a table.

/// A Markdown table with a row for each measurement: the middle of criterion's three values of the time and the throughput.
pub(crate) fn table(output: &str) -> Result<String, String> {
    let (mut name, mut rows) = ("", Vec::<[String; 3]>::new());
    for line in output.lines() {
        // Criterion prints a long name on the line before.
        let name_here = line.split(" time:").next().unwrap_or(line).trim_end();
        if !line.starts_with(' ') && !name_here.is_empty() {
            name = name_here;
        }
        if let Some(time) = middle(line, " time:") {
            rows.push([name.to_owned(), time, String::new()]);
        } else if let (Some(throughput), Some(row)) = (middle(line, " thrpt:"), rows.last_mut()) {
            row[2] = throughput;
        }
    }
    if rows.is_empty() {
        return Err("criterion has printed no times".to_owned());
    }
    let lines: String = rows.iter().map(|row| format!("| {} |\n", row.join(" | "))).collect();
    Ok(format!("| | time | throughput |\n|---|--:|--:|\n{lines}"))
}

/// The middle value of `[1.2 ms 1.3 ms 1.4 ms]` after a label; `None` for the percentages of a change.
fn middle(line: &str, label: &str) -> Option<String> {
    let values = line.split_once(label)?.1.trim().strip_prefix('[')?.strip_suffix(']')?;
    let words: Vec<_> = values.split(' ').collect();
    let [_, _, number, unit, _, _] = words[..] else { return None };
    Some(format!("{number} {unit}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    const OUTPUT: &str = "
five walls and two balls/closest hit
                        time:   [124.65 µs 126.47 µs 128.92 µs]
                        thrpt:  [31.772 Melem/s 32.386 Melem/s 32.860 Melem/s]
                 change:
                        time:   [+3.3795% +4.9792% +6.4845%] (p = 0.00 < 0.05)
                        thrpt:  [−6.0896% −4.7431% −3.2690%]
                        Performance has regressed.
Found 8 outliers among 100 measurements (8.00%)
  5 (5.00%) high mild

build/hill              time:   [300.00 µs 330.00 µs 340.00 µs]
photon map/gather       time:   [843.56 µs 863.36 µs 889.44 µs]
                        thrpt:  [460.96 Melem/s 474.89 Melem/s 486.03 Melem/s]
";

    #[test]
    fn a_line_for_each_measurement() {
        let expected = "| | time | throughput |\n|---|--:|--:|\n\
            | five walls and two balls/closest hit | 126.47 µs | 32.386 Melem/s |\n\
            | build/hill | 330.00 µs |  |\n\
            | photon map/gather | 863.36 µs | 474.89 Melem/s |\n";
        assert_eq!(table(OUTPUT).unwrap(), expected);
        assert!(table("nothing").is_err());
    }
}
