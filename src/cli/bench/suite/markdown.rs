//! The table of a suite, as Markdown.

use super::result::RunResult;
use crate::cli::{
    bench::{median::Pair, slope::slopes},
    words::counted,
};

/// The medians of several runs as one table. The slopes of a run are in the line of its last mark.
pub(super) fn table(runs: &[RunResult], threads: usize) -> String {
    let has_comparison = runs.iter().any(|run| run.others.is_some());
    let comparison = |text: String| if has_comparison { text } else { String::new() };
    let masked = runs.iter().flat_map(|run| &run.medians).any(|median| median.outside.is_some());
    let outside = |text: String| if masked { text } else { String::new() };
    let has_flip = runs.iter().flat_map(|run| &run.medians).any(|median| median.flip.is_some());
    let flip = |text: String| if has_flip { text } else { String::new() };
    let threads = counted(threads as u64, "thread");
    let mut text = format!(
        "Medians over the seeds of each run, on {threads}. The seconds are the time of the iterations that end before the \
         mark, or of the first iteration. A slope is the power of time by which an error falls in the last two octaves. The \
         estimate is the RMSE of the whole picture, also outside the mask, estimated without the reference.\n\n\
         | scene | mark | seconds | RMSE | relMSE |{}{}{} estimate over RMSE | slope of RMSE | slope of relMSE |\n\
         |---|--:|--:|--:|--:|{}{}{}--:|--:|--:|\n",
        comparison(" compared relMSE | compared over ours |".to_owned()),
        outside(" RMSE outside the mask | relMSE outside the mask |".to_owned()),
        flip(" FLIP |".to_owned()),
        comparison("--:|--:|".to_owned()),
        outside("--:|--:|".to_owned()),
        flip("--:|".to_owned()),
    );
    for RunResult { name, others: compared_rel_mse, medians } in runs {
        for (k, median) in medians.iter().enumerate() {
            let is_last = k + 1 == medians.len();
            let slopes = slopes(medians).filter(|_| is_last);
            text += &format!(
                "| {name} | {} | {:.2} | {} |{}{}{} {} | {} |\n",
                median.mark,
                median.seconds,
                errors(median.errors),
                comparison(format!(" {} |", compared_rel_mse.map_or("|".to_owned(), |e| quotient(e, median.errors)))),
                outside(format!(" {} |", median.outside.map_or("|".to_owned(), errors))),
                flip(format!(" {} |", median.flip.map_or(String::new(), |flip| format!("{flip:.4}")))),
                median.estimate_over_error.map_or(String::new(), |ratio| format!("{ratio:.2}")),
                slopes.map_or("|".to_owned(), |s| format!("{:.2} | {:.2}", s.rmse, s.rel_mse)),
            );
        }
    }
    text
}

fn errors(pair: Pair) -> String {
    format!("{:.5} | {:.2e}", pair.rmse, pair.rel_mse)
}

fn quotient(compared: f64, ours: Pair) -> String {
    if ours.rel_mse > 0.0 {
        format!("{compared:.1e} | {:.1}", compared / ours.rel_mse)
    } else {
        format!("{compared:.1e} |")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cli::bench::median::Median;

    fn median(mark: f64, rmse: f64, outside: Option<f64>) -> Median {
        let pair = |rmse| Pair { rmse, rel_mse: rmse * rmse };
        Median {
            mark,
            seconds: mark,
            errors: pair(rmse),
            outside: outside.map(pair),
            flip: outside,
            estimate_over_error: outside.map(|_| 1.25),
        }
    }

    fn run(name: &str, others: Option<f64>, medians: Vec<Median>) -> RunResult {
        RunResult { name: name.to_owned(), others, medians }
    }

    #[test]
    fn a_line_for_each_mark() {
        let runs = [run("a", None, vec![median(1.0, 0.5, None), median(4.0, 0.25, None)])];
        let text = table(&runs, 1);
        assert!(text.starts_with("Medians over the seeds of each run, on 1 thread. "), "{text}");
        assert!(
            text.ends_with(
                "\n\n| scene | mark | seconds | RMSE | relMSE | estimate over RMSE | slope of RMSE | slope of relMSE |\n\
                 |---|--:|--:|--:|--:|--:|--:|--:|\n\
                 | a | 1 | 1.00 | 0.50000 | 2.50e-1 |  | | |\n\
                 | a | 4 | 4.00 | 0.25000 | 6.25e-2 |  | -0.50 | -1.00 |\n"
            ),
            "{text}"
        );
    }

    #[test]
    fn every_line_has_every_column() {
        let runs = [
            run("a", None, vec![median(1.0, 0.5, None)]),
            run("b", Some(0.5), vec![median(1.0, 0.5, Some(0.1)), median(2.0, 0.25, Some(0.1))]),
        ];
        let text = table(&runs, 2);
        let bars: Vec<_> = text.lines().skip(2).map(|line| line.matches('|').count()).collect();
        assert_eq!(bars, [14; 5], "{text}");
        assert!(
            text.contains(
                "| b | 1 | 1.00 | 0.50000 | 2.50e-1 | 5.0e-1 | 2.0 | 0.10000 | 1.00e-2 | 0.1000 | 1.25 | | |\n"
            ),
            "{text}"
        );
    }
}
