//! The `.bpt` format: the number of patches, then for each patch its degrees `3 3` and 16 points `x y z`, in rows of four
//! along v, one row per index along u. White space or commas separate numbers; line breaks have no other meaning, but to end a comment,
//! which `#` begins.
//!
//! The form of M. Newell's teapot has the same extension: the number of patches, a line with the numbers of the 16 points of each patch,
//! from 1, then the number of points, and a line `x,y,z` for each.

use super::error::{FormatError, FormatProblem};
use super::scanner::{Scanner, Syntax};
use crate::geometry::bezier::ControlNet;
use glam::DVec3;
use std::array::from_fn;

const SYNTAX: Syntax = Syntax { comment: "#", block_comment: [""; 2], symbols: "" };

/// The control nets of a `.bpt` text.
///
/// # Errors
///
/// For a text that does not hold as many bicubic patches with finite coordinates as its first number says.
pub fn read_bpt(text: &str) -> Result<Vec<ControlNet>, FormatError> {
    let mut words = Scanner::new(text, SYNTAX);
    let count = words.integer(|| "the number of patches".to_owned())?;
    let nets = if has_numbers_of_points(words) {
        read_with_numbers(&mut words, count)?
    } else {
        (1..=count).map(|patch| read_patch(&mut words, patch)).collect::<Result<_, _>>()?
    };
    match words.next() {
        Some(word) => Err(words.error(FormatProblem::Surplus(word.to_owned()))),
        None => Ok(nets),
    }
}

/// Whether the next line holds the numbers of 16 points, no degrees.
fn has_numbers_of_points(words: Scanner) -> bool {
    let line = words.words_of_next_line();
    line.len() == 16 && line.iter().all(|word| word.parse::<usize>().is_ok()) && line[..2] != ["3", "3"]
}

fn read_with_numbers(words: &mut Scanner, count: usize) -> Result<Vec<ControlNet>, FormatError> {
    // The line and the number of each point of each patch.
    let mut numbers = Vec::new();
    for patch in 1..=count {
        for k in 1..=16 {
            let number = words.integer(|| format!("the number of point {k} of patch {patch}"))?;
            numbers.push((words.line, number));
        }
    }
    let count = words.integer(|| "the number of points".to_owned())?;
    let points = (1..=count).map(|k| read_point(words, || format!("point {k}"))).collect::<Result<Vec<_>, _>>()?;
    let point = |&(line, number): &(usize, usize)| {
        let problem = FormatProblem::NoPoint { index: number as i64, count };
        number.checked_sub(1).and_then(|k| points.get(k)).copied().ok_or(FormatError { line, problem })
    };
    let points = numbers.iter().map(point).collect::<Result<Vec<_>, _>>()?;
    Ok(points
        .chunks_exact(16)
        .map(|of_patch| ControlNet { points: from_fn(|i| from_fn(|j| of_patch[4 * i + j])) })
        .collect())
}

fn read_patch(words: &mut Scanner, patch: usize) -> Result<ControlNet, FormatError> {
    let degree = || format!("the degrees of patch {patch}");
    let u = words.integer(degree)?;
    let line = words.line;
    let v = words.integer(degree)?;
    if (u, v) != (3, 3) {
        return Err(FormatError { line, problem: FormatProblem::Degree { patch, u, v } });
    }
    let mut points = [[DVec3::ZERO; 4]; 4];
    for (k, point) in points.iter_mut().flatten().enumerate() {
        *point = read_point(words, || format!("point {} of patch {patch}", k + 1))?;
    }
    Ok(ControlNet { points })
}

/// Three coordinates of a point, which `name` names in an error.
fn read_point(words: &mut Scanner, name: impl Fn() -> String) -> Result<DVec3, FormatError> {
    let mut point = DVec3::ZERO;
    for (axis, letter) in ["x", "y", "z"].into_iter().enumerate() {
        point[axis] = words.number(|| format!("{letter} of {}", name()))?;
    }
    Ok(point)
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
    fn points_may_have_numbers() {
        let nets = [net(), net().map(|p| p + DVec3::new(3.0, 0.0, 0.5))];
        let mut points: Vec<DVec3> = Vec::new();
        let mut lines = Vec::new();
        for net in nets {
            let number = |p: &DVec3| match points.iter().position(|known| known == p) {
                Some(known) => known + 1,
                None => {
                    points.push(*p);
                    points.len()
                }
            };
            lines.push(net.points.iter().flatten().map(number).map(|k| k.to_string()).collect::<Vec<_>>().join(","));
        }
        let of_points = points.iter().map(|p| format!("{:?},{:?},{:?}\n", p.x, p.y, p.z)).collect::<String>();
        let text = format!("2\n{}\n{}\n{}\n{of_points}", lines[0], lines[1], points.len());
        assert_eq!(read_bpt(&text).unwrap(), nets);
        let message = |text: &str| read_bpt(text).unwrap_err().to_string();
        assert_eq!(
            message(&text.replacen("1,2,", "1,99,", 1)),
            "line 2: there is no point 99; the file has 32 points up to here"
        );
        assert_eq!(
            message(&text.replacen("1,2,", "0,2,", 1)),
            "line 2: there is no point 0; the file has 32 points up to here"
        );
        assert!(message(&format!("{text}1,2,3")).contains("after the last patch"));
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
