//! Free-form surfaces of Wavefront OBJ: `cstype bezier` of degree 3, with statements `surf`, `parm` and `end`. Points of a surface follow
//! each other along u first.

use super::error::{FormatError, FormatProblem};
use crate::geometry::bezier::ControlNet;
use glam::DVec3;
use std::array::from_fn;
use std::collections::HashMap;

/// The control nets of the Bezier surfaces in an OBJ text, in the order of the file.
///
/// # Errors
///
/// For a text without bicubic Bezier surfaces, or with surfaces that are rational, trimmed or of another degree.
pub fn read_obj(text: &str) -> Result<Vec<ControlNet>, FormatError> {
    let mut reader = Reader::default();
    for (line, words) in statements(text) {
        reader.statement(line, &words)?;
    }
    reader.end()?;
    let last_line = text.lines().count().max(1);
    match (reader.nets.is_empty(), reader.has_faces) {
        (false, _) => Ok(reader.nets),
        (true, true) => Err(FormatError::unsupported(
            last_line,
            "the file holds a mesh (f), but no Bezier surface (cstype bezier, surf); a mesh has no control points",
        )),
        (true, false) => {
            Err(FormatError { line: last_line, problem: FormatProblem::Short("a surface (surf)".to_owned()) })
        }
    }
}

/// The OBJ text of an object of this name with a surface for each control net. Coordinates are the shortest decimals that read back as the
/// same `f64`; points at the same place are one vertex.
pub fn write_obj(name: &str, nets: &[ControlNet]) -> String {
    let (mut numbers, mut vertices, mut surfaces) = (HashMap::new(), String::new(), String::new());
    for net in nets {
        surfaces += "surf 0 1 0 1";
        for p in net.transposed().points.iter().flatten() {
            let next = numbers.len() + 1;
            let number = *numbers.entry(p.to_array().map(f64::to_bits)).or_insert_with(|| {
                vertices += &format!("v {:?} {:?} {:?}\n", p.x, p.y, p.z);
                next
            });
            surfaces += &format!(" {number}");
        }
        surfaces += "\nparm u 0 1\nparm v 0 1\nend\n";
    }
    format!("o {name}\n{vertices}cstype bezier\ndeg 3 3\n{surfaces}")
}

/// The words of each statement with its line. A backslash joins a line with the next one; `#` begins a comment.
fn statements(text: &str) -> impl Iterator<Item = (usize, Vec<&str>)> {
    let mut lines = (1..).zip(text.lines());
    std::iter::from_fn(move || {
        let (first, mut line) = lines.next()?;
        let mut words = Vec::new();
        loop {
            let statement = line.split('#').next().unwrap_or_default().trim_end();
            let joined = statement.strip_suffix('\\');
            words.extend(joined.unwrap_or(statement).split_whitespace());
            match joined.and_then(|_| lines.next()) {
                Some((_, next)) => line = next,
                None => return Some((first, words)),
            }
        }
    })
}

#[derive(Default)]
struct Reader {
    /// Points with their weights.
    points: Vec<(DVec3, f64)>,
    curve_type: String,
    degree: [usize; 2],
    /// The surface before its `end`, and its line.
    surface: Option<(usize, Surface)>,
    nets: Vec<ControlNet>,
    has_faces: bool,
}

struct Surface {
    points: Vec<DVec3>,
    /// Patches along u and along v.
    patches: [usize; 2],
}

impl Reader {
    fn statement(&mut self, line: usize, words: &[&str]) -> Result<(), FormatError> {
        let Some((&keyword, arguments)) = words.split_first() else { return Ok(()) };
        match keyword {
            "v" => self.points.push(read_point(line, arguments)?),
            "f" => self.has_faces = true,
            "cstype" => self.curve_type = arguments.join(" "),
            "deg" => {
                let degree = |k: usize| arguments.get(k).and_then(|word| word.parse().ok());
                let (u, v) = (degree(0), degree(1));
                // Curves have one degree.
                self.degree = [u.unwrap_or(0), v.or(u).unwrap_or(0)];
            }
            "surf" => {
                self.end()?;
                let points = arguments.get(4..).unwrap_or_default();
                let points = points.iter().map(|word| self.point(line, word)).collect::<Result<_, _>>()?;
                self.surface = Some((line, Surface { points, patches: [1; 2] }));
            }
            "parm" => {
                if let (Some((_, surface)), Some((axis, values))) = (&mut self.surface, arguments.split_first()) {
                    surface.patches[usize::from(*axis == "v")] = values.len().saturating_sub(1).max(1);
                }
            }
            "trim" | "hole" | "scrv" if self.surface.is_some() => {
                return Err(FormatError::unsupported(line, "trimmed surfaces cannot be read; remove the trimming"));
            }
            "end" => self.end()?,
            _ => {}
        }
        Ok(())
    }

    /// The point that a word of `surf` names: from 1, or from -1 backwards, perhaps with the numbers of other properties.
    fn point(&self, line: usize, word: &str) -> Result<DVec3, FormatError> {
        let number = word.split('/').next().and_then(|number| number.parse::<i64>().ok());
        let unexpected =
            || FormatProblem::Unexpected { expected: "the number of a point".to_owned(), found: word.to_owned() };
        let index = number.ok_or_else(|| FormatError { line, problem: unexpected() })?;
        let count = self.points.len();
        let position = if index < 0 { count as i64 + index } else { index - 1 };
        let point = usize::try_from(position).ok().and_then(|position| self.points.get(position));
        match point {
            Some((point, 1.0)) => Ok(*point),
            Some(_) => Err(FormatError::unsupported(line, "rational surfaces cannot be read; all weights must be 1")),
            None => Err(FormatError { line, problem: FormatProblem::NoPoint { index, count } }),
        }
    }

    /// Ends the present surface, if there is one.
    fn end(&mut self) -> Result<(), FormatError> {
        let Some((line, Surface { points, patches: [along_u, along_v] })) = self.surface.take() else { return Ok(()) };
        if !["bezier", "rat bezier"].contains(&self.curve_type.as_str()) {
            let kind = if self.curve_type.is_empty() { "unnamed" } else { &self.curve_type };
            let problem = format!("a surface of type `{kind}` cannot be read; only `cstype bezier` can");
            return Err(FormatError::unsupported(line, problem));
        }
        let [u, v] = self.degree;
        if (u, v) != (3, 3) {
            return Err(FormatError { line, problem: FormatProblem::Degree { patch: self.nets.len() + 1, u, v } });
        }
        let width = 3 * along_u + 1;
        if points.len() != width * (3 * along_v + 1) {
            let expected = format!("{} points of {along_u} x {along_v} patches", width * (3 * along_v + 1));
            return Err(FormatError {
                line,
                problem: FormatProblem::Unexpected { expected, found: points.len().to_string() },
            });
        }
        for (row, column) in (0..along_v).flat_map(|row| (0..along_u).map(move |column| (row, column))) {
            let point = |i: usize, j: usize| points[(3 * row + j) * width + 3 * column + i];
            self.nets.push(ControlNet { points: from_fn(|i| from_fn(|j| point(i, j))) });
        }
        Ok(())
    }
}

/// The coordinates of a vertex, and its weight, 1 if it has none.
fn read_point(line: usize, words: &[&str]) -> Result<(DVec3, f64), FormatError> {
    let mut numbers = [0.0, 0.0, 0.0, 1.0];
    for (k, number) in numbers.iter_mut().enumerate() {
        let expected = || ["x", "y", "z", "a weight"][k].to_owned();
        *number = match words.get(k) {
            Some(word) => word.parse().ok().filter(|x: &f64| x.is_finite()).ok_or_else(|| {
                let found = (*word).to_owned();
                FormatError { line, problem: FormatProblem::Unexpected { expected: expected(), found } }
            })?,
            // Six numbers are a point with its colour; four a point with its weight.
            None if k == 3 => 1.0,
            None => return Err(FormatError { line, problem: FormatProblem::Short(expected()) }),
        };
    }
    let weight = if words.len() == 4 { numbers[3] } else { 1.0 };
    Ok((DVec3::new(numbers[0], numbers[1], numbers[2]), weight))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn net() -> ControlNet {
        let point = |i: usize, j: usize| DVec3::new(i as f64, 0.1 * (i * j) as f64, 1.0 / 3.0 * j as f64);
        ControlNet { points: from_fn(|i| from_fn(|j| point(i, j))) }
    }

    #[test]
    fn written_nets_read_back_bit_for_bit() {
        let nets = [net(), net().map(|p| p + DVec3::X), net().map(|p| 1e-300 * p)];
        let text = write_obj("vase", &nets);
        assert_eq!(read_obj(&text).unwrap(), nets);
        let vertices = text.lines().filter(|line| line.starts_with("v ")).count();
        assert!(vertices < 3 * 16, "common points are one vertex: {vertices}");
        assert!(text.contains("surf 0 1 0 1 1 2 3 4"), "along u first: {text}");
        assert!(text.starts_with("o vase\nv 0.0 0.0 0.0\nv 1.0 0.0 0.0\n"));
    }

    #[test]
    fn a_surface_of_several_patches_is_cut() {
        let whole = |i: usize, j: usize| DVec3::new(i as f64, j as f64, (i * j) as f64);
        let mut text = String::from("# a sheet\ncstype rat bezier\ndeg 3 3\n");
        for (j, i) in (0..4).flat_map(|j| (0..7).map(move |i| (j, i))) {
            let p = whole(i, j);
            text += &format!("v {} {} {}{}\n", p.x, p.y, p.z, if i % 2 == 0 { " 1.0" } else { "" });
        }
        text += "surf 0 2 0 1 \\\n";
        text += &(1..=28).map(|k| format!("{}/1 ", k - 29)).collect::<String>();
        text += "\nparm u 0 1 2\nparm v 0 1\nend\n";
        let nets = read_obj(&text).unwrap();
        assert_eq!(nets.len(), 2);
        assert_eq!(
            [nets[0].points[3][2], nets[1].points[0][2], nets[1].points[3][3]],
            [whole(3, 2), whole(3, 2), whole(6, 3)]
        );
    }

    #[test]
    fn what_cannot_be_read_is_named() {
        let good = write_obj("s", &[net()]);
        let message = |from: &str, to: &str| read_obj(&good.replacen(from, to, 1)).unwrap_err().to_string();
        let line = |start: &str| good.lines().position(|line| line.starts_with(start)).unwrap() + 1;
        assert_eq!(
            message("deg 3 3", "deg 2 3"),
            format!("line {}: patch 1 has degrees 2 3; only bicubic patches (3 3) can be read", line("surf"))
        );
        assert!(message("cstype bezier", "cstype bspline").contains("`bspline`"));
        assert!(message("0 1 0 1 1 ", "0 1 0 1 99 ").contains("no point 99; the file has 16"));
        assert!(message("0 1 0 1 1 ", "0 1 0 1 x ").contains("found `x`"));
        assert!(message("0 1 0 1 1 ", "0 1 0 1 ").contains("expected 16 points of 1 x 1 patches, found `15`"));
        assert!(message("parm u 0 1", "trim 0 1 1").contains("trimmed"));
        assert!(message("v 1.0 0.0 0.0", "v 1.0 0.0 0.0 2.0").contains("weights"));
        assert_eq!(message("v 1.0 0.0 0.0", "v 1.0 nan 0.0"), "line 3: expected y, found `nan`");
        assert!(read_obj("v 0 0 0\nf 1 1 1\n").unwrap_err().to_string().contains("mesh"));
        assert_eq!(read_obj("").unwrap_err().to_string(), "line 1: the file ends where a surface (surf) was expected");
    }
}
