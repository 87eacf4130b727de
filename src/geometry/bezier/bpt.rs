//! The `.bpt` format: the number of patches, then for each patch its degrees `3 3` and 16 points `x y z`, in rows of four
//! along v, one row per index along u. White space separates numbers; line breaks have no other meaning, but to end a comment, which `#`
//! begins.

use super::ControlNet;
use glam::DVec3;
use thiserror::Error;

/// Why a text is not a valid `.bpt` file, with the line of the error.
#[derive(Clone, Debug, Error, PartialEq)]
#[error("line {line}: {problem}")]
pub struct BptError {
    /// Line number, from 1; for a text that ends too soon, its last line.
    pub line: usize,
    /// The error.
    pub problem: BptProblem,
}

/// An error in a `.bpt` file.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum BptProblem {
    /// The text ends too early. Holds the missing item.
    #[error("the file ends where {0} was expected")]
    Short(String),
    /// A word that is not a finite number.
    #[error("expected {expected}, found `{found}`")]
    Unexpected {
        /// The expected item.
        expected: String,
        /// The word found instead.
        found: String,
    },
    /// Degrees other than 3 3.
    #[error("patch {patch} has degrees {u} {v}; only bicubic patches (3 3) can be read")]
    Degree {
        /// Number of the patch, from 1.
        patch: usize,
        /// Degree in u.
        u: usize,
        /// Degree in v.
        v: usize,
    },
    /// Text after the last patch. Holds the first word of it.
    #[error("found `{0}` after the last patch; is the number of patches in the first line right?")]
    Surplus(String),
}

/// The control nets of a `.bpt` text.
///
/// # Errors
///
/// For a text that does not hold as many bicubic patches with finite coordinates as its first number says.
pub fn read_bpt(text: &str) -> Result<Vec<ControlNet>, BptError> {
    // Some editors begin a file with a byte order mark.
    let mut words = Words::new(text.trim_start_matches('\u{feff}'));
    let count = words.integer("the number of patches")?;
    let nets = (1..=count).map(|patch| read_patch(&mut words, patch)).collect::<Result<_, _>>()?;
    match words.next() {
        Some((line, word)) => Err(BptError { line, problem: BptProblem::Surplus(word.to_owned()) }),
        None => Ok(nets),
    }
}

fn read_patch(words: &mut Words, patch: usize) -> Result<ControlNet, BptError> {
    let u = words.integer(&format!("the degrees of patch {patch}"))?;
    let line = words.line;
    let v = words.integer(&format!("the degrees of patch {patch}"))?;
    if (u, v) != (3, 3) {
        return Err(BptError { line, problem: BptProblem::Degree { patch, u, v } });
    }
    let mut points = [[DVec3::ZERO; 4]; 4];
    for (k, point) in points.iter_mut().flatten().enumerate() {
        for axis in 0..3 {
            point[axis] =
                words.coordinate(|| format!("{} of point {} of patch {patch}", ["x", "y", "z"][axis], k + 1))?;
        }
    }
    Ok(ControlNet { points })
}

/// The `.bpt` text of control nets. Every coordinate is the shortest decimal that reads back as the same `f64`.
pub fn write_bpt(nets: &[ControlNet]) -> String {
    let mut text = format!("{}\n", nets.len());
    for net in nets {
        text.push_str("3 3\n");
        for p in net.points.iter().flatten() {
            text += &format!("{:?} {:?} {:?}\n", p.x, p.y, p.z);
        }
    }
    text
}

/// The words of a text, each with its line.
struct Words<'a> {
    words: Box<dyn Iterator<Item = (usize, &'a str)> + 'a>,
    /// The line of the last word; at the end of the text, its last line.
    line: usize,
    last_line: usize,
}

impl<'a> Words<'a> {
    fn new(text: &'a str) -> Self {
        let without_comment = |line: &'a str| line.split('#').next().unwrap_or_default();
        // LF or CRLF end a line, and so does a CR alone.
        let lines = || text.lines().flat_map(|line| line.trim_end_matches('\r').split('\r'));
        let words = lines()
            .enumerate()
            .flat_map(move |(k, line)| without_comment(line).split_whitespace().map(move |word| (k + 1, word)));
        Self { last_line: lines().count().max(1), words: Box::new(words), line: 1 }
    }

    fn next(&mut self) -> Option<(usize, &'a str)> {
        let next = self.words.next();
        self.line = next.map_or(self.last_line, |(line, _)| line);
        next
    }

    fn integer(&mut self, expected: &str) -> Result<usize, BptError> {
        self.parse(|| expected.to_owned(), |word| word.parse().ok())
    }

    fn coordinate(&mut self, expected: impl Fn() -> String) -> Result<f64, BptError> {
        self.parse(expected, |word| word.parse().ok().filter(|x: &f64| x.is_finite()))
    }

    fn parse<T>(&mut self, expected: impl Fn() -> String, parse: impl Fn(&str) -> Option<T>) -> Result<T, BptError> {
        let word = self.next();
        let problem = match word {
            Some((_, word)) => match parse(word) {
                Some(value) => return Ok(value),
                None => BptProblem::Unexpected { expected: expected(), found: word.to_owned() },
            },
            None => BptProblem::Short(expected()),
        };
        Err(BptError { line: self.line, problem })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn net() -> ControlNet {
        ControlNet {
            points: std::array::from_fn(|i| {
                std::array::from_fn(|j| DVec3::new(i as f64, j as f64, 0.1 * (i * j) as f64))
            }),
        }
    }

    #[test]
    fn written_nets_read_back_bit_for_bit() {
        let nets = vec![net(), net().map(|p| p * 1e-300 + 1e5 / 3.0)];
        assert_eq!(read_bpt(&write_bpt(&nets)).unwrap(), nets);
        assert_eq!(read_bpt("0\n").unwrap(), vec![]);
    }

    #[test]
    fn any_line_end_ends_a_comment_and_counts() {
        let text = format!("# patches\n{}", write_bpt(&[net()]));
        for end in ["\n", "\r\n", "\r"] {
            assert_eq!(read_bpt(&text.replace('\n', end)).unwrap(), vec![net()], "{end:?}");
            let error = read_bpt(&text.replace("3 3\n", "3 3\nx\n").replace('\n', end)).unwrap_err();
            assert_eq!(error.line, 4, "{end:?}");
        }
    }

    #[test]
    fn comments_end_with_their_line() {
        let text = write_bpt(&[net()]);
        let commented = format!("# patches\n{}# the end", text.replace("3 3\n", "3 3 # bicubic, 4 x 4\n#\n"));
        assert_eq!(read_bpt(&commented).unwrap(), vec![net()]);
        assert_eq!(read_bpt("1 # patch\n\nx").unwrap_err().line, 3);
    }

    #[test]
    fn errors_name_the_line() {
        let good = write_bpt(&[net()]);
        let message = |text: &str| read_bpt(text).unwrap_err().to_string();
        assert_eq!(message(""), "line 1: the file ends where the number of patches was expected");
        assert_eq!(message("x"), "line 1: expected the number of patches, found `x`");
        assert!(message(&good.replace("3 3", "2 3")).starts_with("line 2: patch 1 has degrees 2 3"));
        assert_eq!(message(&good.replacen("1.0", "NaN", 1)), "line 4: expected y of point 2 of patch 1, found `NaN`");
        assert_eq!(
            message(&good.replacen("1.0", "1e999", 1)),
            "line 4: expected y of point 2 of patch 1, found `1e999`"
        );
        let short = good.lines().take(10).collect::<Vec<_>>().join("\n");
        assert_eq!(message(&short), "line 10: the file ends where x of point 9 of patch 1 was expected");
        assert!(message(&format!("{good}7")).starts_with("line 19: found `7` after the last patch"));
    }
}
