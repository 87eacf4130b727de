//! `Patch` and `PatchMesh` of type "bicubic" in the RenderMan Interface Bytestream, with the Bezier basis and as text. Objects are placed by
//! the transforms since `WorldBegin`. Where the world is left-handed, z changes its sign, so that objects look as they do there; a file
//! without a world keeps its coordinates.

use super::error::{FormatError, FormatProblem};
use super::scanner::{Scanner, Syntax};
use crate::geometry::bezier::ControlNet;
use glam::{DAffine3, DMat3, DVec3};
use std::array::from_fn;

const SYNTAX: Syntax = Syntax { comment: "#", block_comment: [""; 2], symbols: "[]" };

/// The control nets of the bicubic patches in a RIB text, in the order of the file.
///
/// # Errors
///
/// For a text without bicubic patches, and for patches that are rational or have another basis than Bezier.
pub fn read_rib(text: &str) -> Result<Vec<ControlNet>, FormatError> {
    let mut words = Scanner::new(text, SYNTAX);
    let mut state = State::default();
    let (mut has_world, mut saved, mut nets) = (false, Vec::new(), Vec::new());
    while let Some(word) = words.next() {
        match word {
            "Patch" => read_mesh(&mut words, &state, false, &mut nets)?,
            "PatchMesh" => read_mesh(&mut words, &state, true, &mut nets)?,
            "Basis" => state.basis = [read_basis(&mut words)?, read_basis(&mut words)?],
            "WorldBegin" => {
                // A transform to the camera that mirrors makes the world right-handed.
                let is_left_handed = state.transform.matrix3.determinant() > 0.0;
                let flip = if is_left_handed { DVec3::new(1.0, 1.0, -1.0) } else { DVec3::ONE };
                state.transform = DAffine3::from_scale(flip);
                (has_world, saved) = (true, Vec::new());
            }
            "AttributeBegin" | "TransformBegin" => saved.push(state.clone()),
            "AttributeEnd" => state = saved.pop().unwrap_or_default(),
            "TransformEnd" => state.transform = saved.pop().unwrap_or_default().transform,
            "Identity" | "Transform" if has_world => {
                let problem = format!("{word} after WorldBegin cannot be read; use ConcatTransform in its place");
                return Err(FormatError::unsupported(words.line, problem));
            }
            "Identity" => state.transform = DAffine3::IDENTITY,
            "Transform" => state.transform = read_matrix(&mut words)?,
            "Translate" => {
                let [x, y, z] = read_numbers(&mut words)?;
                state.transform *= DAffine3::from_translation(DVec3::new(x, y, z));
            }
            "Scale" => {
                let [x, y, z] = read_numbers(&mut words)?;
                state.transform *= DAffine3::from_scale(DVec3::new(x, y, z));
            }
            "Rotate" => {
                let [angle, x, y, z] = read_numbers(&mut words)?;
                if let Some(axis) = DVec3::new(x, y, z).try_normalize() {
                    state.transform *= DAffine3::from_axis_angle(axis, angle.to_radians());
                }
            }
            "ConcatTransform" => state.transform *= read_matrix(&mut words)?,
            _ => {}
        }
    }
    if nets.is_empty() {
        return Err(words.error(FormatProblem::Short("Patch or PatchMesh \"bicubic\"".to_owned())));
    }
    Ok(nets)
}

/// The attributes that change how patches are read.
#[derive(Clone, Debug)]
struct State {
    transform: DAffine3,
    /// Names of the bases in u and v.
    basis: [String; 2],
}

impl Default for State {
    fn default() -> Self {
        Self { transform: DAffine3::IDENTITY, basis: [BEZIER, BEZIER].map(str::to_owned) }
    }
}

const BEZIER: &str = "\"bezier\"";

/// Appends the patches of a `Patch`, or of a `PatchMesh`, whose name was read.
fn read_mesh(words: &mut Scanner, state: &State, is_mesh: bool, nets: &mut Vec<ControlNet>) -> Result<(), FormatError> {
    let line = words.line;
    let kind = words.parse(|| "the type of the patch".to_owned(), Some)?;
    if kind != "\"bicubic\"" {
        return Err(FormatError::unsupported(
            line,
            format!("a patch of type {kind} cannot be read; only \"bicubic\" can"),
        ));
    }
    if let Some(other) = state.basis.iter().find(|basis| *basis != BEZIER) {
        return Err(FormatError::unsupported(
            line,
            format!("patches with the basis {other} cannot be read; only \"bezier\" can"),
        ));
    }
    let mut sides = [Side { points: 4, is_periodic: false }; 2];
    if is_mesh {
        for side in &mut sides {
            side.points = words.integer(|| "the number of points along a side".to_owned())?;
            let wrap = words.parse(
                || "\"periodic\" or \"nonperiodic\"".to_owned(),
                |word| ["\"nonperiodic\"", "\"periodic\""].iter().position(|known| *known == word),
            )?;
            side.is_periodic = wrap == 1;
        }
    }
    let count = |side: Side| {
        side.patches().ok_or_else(|| {
            let problem = format!("{} points along a side are no whole number of cubic Bezier curves", side.points);
            FormatError::unsupported(line, problem)
        })
    };
    let (along_u, along_v) = (count(sides[0])?, count(sides[1])?);
    let points = read_points(words)?;
    let expected = sides[0].points.saturating_mul(sides[1].points);
    if points.len() != expected {
        let (expected, found) = (format!("{expected} points"), points.len().to_string());
        return Err(FormatError { line, problem: FormatProblem::Unexpected { expected, found } });
    }
    for (row, column) in (0..along_v).flat_map(|row| (0..along_u).map(move |column| (row, column))) {
        // Along u first. A periodic side ends with its first point.
        let point = |i: usize, j: usize| {
            let [u, v] = [(3 * column + i) % sides[0].points, (3 * row + j) % sides[1].points];
            state.transform.transform_point3(points[v * sides[0].points + u])
        };
        nets.push(ControlNet { points: from_fn(|i| from_fn(|j| point(i, j))) });
    }
    Ok(())
}

/// One direction of a mesh.
#[derive(Clone, Copy, Debug)]
struct Side {
    points: usize,
    is_periodic: bool,
}

impl Side {
    /// The number of patches; `None` if the points do not make whole patches.
    fn patches(self) -> Option<usize> {
        let ends = usize::from(!self.is_periodic);
        let inner = self.points.checked_sub(ends)?;
        (inner >= 3 && inner.is_multiple_of(3)).then_some(inner / 3)
    }
}

/// The points `P` among the parameters of a patch; reads all parameters.
fn read_points(words: &mut Scanner) -> Result<Vec<DVec3>, FormatError> {
    let mut points = None;
    while let Some(name) = words.peek().filter(|word| word.starts_with('"')) {
        words.next();
        let line = words.line;
        let last = name.trim_matches('"').split_whitespace().next_back();
        let values = read_array(words)?;
        match last {
            Some("P") => {
                let numbers = values.iter().map(|(line, word)| {
                    let number = word.parse().ok().filter(|x: &f64| x.is_finite());
                    let problem =
                        || FormatProblem::Unexpected { expected: "a coordinate".to_owned(), found: (*word).to_owned() };
                    number.ok_or_else(|| FormatError { line: *line, problem: problem() })
                });
                let numbers = numbers.collect::<Result<Vec<_>, _>>()?;
                if numbers.len() % 3 != 0 {
                    return Err(FormatError::unsupported(line, "the last point lacks a coordinate"));
                }
                points = Some(numbers.chunks_exact(3).map(DVec3::from_slice).collect());
            }
            Some("Pw" | "Pz") => {
                return Err(FormatError::unsupported(line, format!("points {name} cannot be read; only \"P\" can")));
            }
            _ => {}
        }
    }
    points.ok_or_else(|| words.error(FormatProblem::Short("the points \"P\"".to_owned())))
}

/// The words of an array with their lines, or of a value without brackets.
fn read_array<'a>(words: &mut Scanner<'a>) -> Result<Vec<(usize, &'a str)>, FormatError> {
    let first = words.parse(|| "a value".to_owned(), Some)?;
    let mut values = Vec::new();
    if first != "[" {
        values.push((words.line, first));
        return Ok(values);
    }
    loop {
        match words.parse(|| "`]`".to_owned(), Some)? {
            "]" => return Ok(values),
            word => values.push((words.line, word)),
        }
    }
}

/// This many numbers, perhaps in brackets.
fn read_numbers<const N: usize>(words: &mut Scanner) -> Result<[f64; N], FormatError> {
    let in_brackets = words.peek() == Some("[");
    if in_brackets {
        words.next();
    }
    let mut numbers = [0.0; N];
    for number in &mut numbers {
        *number = words.number(|| "a number".to_owned())?;
    }
    if in_brackets {
        words.expect("]")?;
    }
    Ok(numbers)
}

/// A matrix by which points are multiplied from the left, row by row.
fn read_matrix(words: &mut Scanner) -> Result<DAffine3, FormatError> {
    let [a, b, c, _, d, e, f, _, g, h, i, _, x, y, z, _] = read_numbers(words)?;
    let matrix = DMat3::from_cols_array(&[a, b, c, d, e, f, g, h, i]);
    Ok(DAffine3::from_mat3_translation(matrix, DVec3::new(x, y, z)))
}

/// The name of a basis, and its step, which matters for other bases alone. A basis as a matrix has the name `[`.
fn read_basis(words: &mut Scanner) -> Result<String, FormatError> {
    let name = words.peek().unwrap_or_default().to_owned();
    read_array(words)?;
    words.integer(|| "the step of the basis".to_owned())?;
    Ok(name)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Points (i, j, 0.5 i j), along i first.
    fn points(columns: usize, rows: usize) -> String {
        let point =
            |k: usize| format!("{} {} {} ", k % columns, k / columns, 0.5 * (k % columns * (k / columns)) as f64);
        (0..columns * rows).map(point).collect()
    }

    fn patch() -> String {
        format!("Patch \"bicubic\" \"vertex point P\" [{}] \"Cs\" [1 0 0]\n", points(4, 4))
    }

    fn nets(text: &str) -> Vec<ControlNet> {
        read_rib(text).unwrap()
    }

    #[test]
    fn a_patch_has_its_points() {
        let net = nets(&format!("##RenderMan RIB\nBasis \"bezier\" 3 \"bezier\" 3\n{}", patch()))[0];
        assert_eq!([net.points[1][0], net.points[2][3]], [DVec3::X, DVec3::new(2.0, 3.0, 3.0)]);
    }

    #[test]
    fn transforms_since_the_beginning_of_the_world_count() {
        let placed = "Translate 0 0 9\nWorldBegin\nAttributeBegin\nTranslate 1 2 3\nRotate 90 0 0 1\nScale 2 2 2\n";
        let text = format!("{placed}{}AttributeEnd\n{}WorldEnd\n", patch(), patch());
        let found = nets(&text);
        // (2, 3, 3) scaled (4, 6, 6), turned (-6, 4, 6), moved (-5, 6, 9); the world is left-handed.
        assert!(found[0].points[2][3].distance(DVec3::new(-5.0, 6.0, -9.0)) < 1e-12, "{}", found[0].points[2][3]);
        assert_eq!(found[1].points[2][3], DVec3::new(2.0, 3.0, -3.0));
        let right_handed = text.replacen("Translate 0 0 9", "Scale 1 1 -1", 1);
        assert_eq!(nets(&right_handed)[1].points[2][3], DVec3::new(2.0, 3.0, 3.0));
        let with_matrix = text.replacen("Translate 0 0 9", "Transform [1 0 0 0 0 1 0 0 0 0 -1 0 0 0 5 1]", 1);
        assert_eq!(nets(&with_matrix)[1].points[2][3], DVec3::new(2.0, 3.0, 3.0));
        assert!(read_rib(&text.replacen("Scale", "Identity", 1)).unwrap_err().to_string().contains("ConcatTransform"));
        let concat = format!("ConcatTransform [1 0 0 0 0 1 0 0 0 0 1 0 5 6 7 1]\n{}", patch());
        assert_eq!(nets(&concat)[0].points[0][0], DVec3::new(5.0, 6.0, 7.0));
    }

    #[test]
    fn a_mesh_is_cut_and_a_periodic_side_closes() {
        let mesh =
            |sides: &str, columns, rows| format!("PatchMesh \"bicubic\" {sides} \"P\" [{}]", points(columns, rows));
        let open = nets(&mesh("7 \"nonperiodic\" 4 \"nonperiodic\"", 7, 4));
        assert_eq!(
            (open.len(), open[1].points[0][0], open[1].points[3][3]),
            (2, DVec3::new(3.0, 0.0, 0.0), DVec3::new(6.0, 3.0, 9.0))
        );
        let ring = nets(&mesh("6 \"periodic\" 4 \"nonperiodic\"", 6, 4));
        assert_eq!((ring.len(), ring[1].points[3][1]), (2, ring[0].points[0][1]));
    }

    #[test]
    fn what_cannot_be_read_is_named() {
        let message = |text: &str| read_rib(text).unwrap_err().to_string();
        assert!(message(&patch().replace("bicubic", "bilinear")).starts_with("line 1: a patch of type \"bilinear\""));
        assert!(
            message(&format!("Basis \"b-spline\" 1 \"b-spline\" 1\n{}", patch()))
                .starts_with("line 2: patches with the basis \"b-spline\"")
        );
        assert!(message(&format!("Basis [1 2] 1 \"bezier\" 3\n{}", patch())).contains("basis ["));
        assert!(message(&patch().replace("point P", "hpoint Pw")).contains("Pw"));
        assert!(message(&patch().replace("[0 0 0 ", "[")).contains("expected 16 points, found `15`"));
        assert!(message(&patch().replace("[0 0 0 ", "[0 0 zero ")).contains("found `zero`"));
        assert!(
            message("PatchMesh \"bicubic\" 5 \"nonperiodic\" 4 \"nonperiodic\" \"P\" []")
                .contains("5 points along a side")
        );
        assert!(message("Sphere 1 -1 1 360").contains("Patch or PatchMesh"));
        assert!(message("Patch \"bicubic\"").contains("the points \"P\" was expected"));
    }
}
