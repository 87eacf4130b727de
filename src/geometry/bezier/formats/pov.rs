//! `bicubic_patch` of the POV-Ray scene language, with numbers in place of expressions. POV-Ray has left-handed coordinates: z changes its
//! sign, so that a patch looks as it does there.

use super::error::{FormatError, FormatProblem};
use super::scanner::{Scanner, Syntax};
use crate::geometry::bezier::ControlNet;
use glam::{DAffine3, DVec3};
use std::array::from_fn;

const SYNTAX: Syntax = Syntax { comment: "//", block_comment: ["/*", "*/"], symbols: "<>{}()[];=" };

/// The control nets of the patches in a POV-Ray scene, in the order of the file. All else in the scene is left out.
///
/// # Errors
///
/// For a text without `bicubic_patch`, and for a patch whose numbers are expressions.
pub fn read_pov(text: &str) -> Result<Vec<ControlNet>, FormatError> {
    let mut words = Scanner::new(text, SYNTAX);
    let mut nets = Vec::new();
    while let Some(word) = words.next() {
        if word == "bicubic_patch" {
            words.expect("{")?;
            nets.push(read_patch(&mut words, nets.len() + 1)?);
        }
    }
    if nets.is_empty() {
        return Err(words.error(FormatProblem::Short("bicubic_patch".to_owned())));
    }
    Ok(nets)
}

/// The rest of a patch after its opening brace.
fn read_patch(words: &mut Scanner, patch: usize) -> Result<ControlNet, FormatError> {
    let mut points = Vec::new();
    let mut transform = DAffine3::IDENTITY;
    loop {
        let expected = || format!("point {} of patch {patch}", points.len() + 1);
        match words.parse(|| "`}`".to_owned(), Some)? {
            "}" if points.len() == 16 => break,
            "<" if points.len() < 16 => points.push(read_vector(words, &expected())?),
            "type" | "flatness" | "u_steps" | "v_steps" => {
                words.number(|| "a number".to_owned())?;
            }
            "translate" => transform = DAffine3::from_translation(read_scalar_or_vector(words)?) * transform,
            "scale" => transform = DAffine3::from_scale(read_scalar_or_vector(words)?) * transform,
            "rotate" => {
                let [x, y, z] = read_scalar_or_vector(words)?.to_array().map(f64::to_radians);
                let [x, y, z] =
                    [DAffine3::from_rotation_x(x), DAffine3::from_rotation_y(y), DAffine3::from_rotation_z(z)];
                transform = z * y * x * transform;
            }
            "matrix" | "transform" => {
                let problem = "only translate, rotate and scale of a bicubic_patch can be read";
                return Err(FormatError::unsupported(words.line, problem));
            }
            "uv_vectors" => {
                for _ in 0..4 {
                    skip_block(words, ["<", ">"])?;
                }
            }
            // Properties like `texture { ... }` and `no_shadow`.
            word if word.starts_with(char::is_alphabetic) && !points.is_empty() => {
                if words.peek() == Some("{") {
                    skip_block(words, ["{", "}"])?;
                }
            }
            word => {
                let problem = FormatProblem::Unexpected { expected: expected(), found: word.to_owned() };
                return Err(words.error(problem));
            }
        }
    }
    let to_right_handed = |p: DVec3| transform.transform_point3(p) * DVec3::new(1.0, 1.0, -1.0);
    Ok(ControlNet { points: from_fn(|i| from_fn(|j| to_right_handed(points[4 * i + j]))) })
}

/// The rest of a vector of three numbers after its `<`.
fn read_vector(words: &mut Scanner, name: &str) -> Result<DVec3, FormatError> {
    let mut vector = DVec3::ZERO;
    for axis in 0..3 {
        let expected = || format!("{} of {name} as a number (expressions cannot be read)", ["x", "y", "z"][axis]);
        vector[axis] = words.number(expected)?;
    }
    words.expect(">")?;
    Ok(vector)
}

/// A vector, or a number for all three coordinates.
fn read_scalar_or_vector(words: &mut Scanner) -> Result<DVec3, FormatError> {
    if words.peek() == Some("<") {
        words.next();
        return read_vector(words, "the vector");
    }
    Ok(DVec3::splat(words.number(|| "a vector, or a number".to_owned())?))
}

/// Skips what the next word, the first one of `ends`, begins and the second one ends.
fn skip_block(words: &mut Scanner, [begin, end]: [&str; 2]) -> Result<(), FormatError> {
    words.expect(begin)?;
    let mut depth = 1;
    while depth > 0 {
        let word = words.parse(|| format!("`{end}`"), Some)?;
        depth += i32::from(word == begin) - i32::from(word == end);
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points() -> String {
        (0..16).map(|k| format!("<{}, {}.5, -{}>{}\n", k / 4, k % 4, k, if k < 15 { "," } else { "" })).collect()
    }

    fn scene(options: &str, properties: &str) -> String {
        let camera = "#include \"colors.inc\"\ncamera { location <0, 1, -5> }\n";
        format!("{camera}object {{ bicubic_patch {{ {options}\n{} {properties} }} }} // the end", points())
    }

    #[test]
    fn patches_have_their_points_with_z_to_the_other_side() {
        let text = scene("type 1 flatness 0.01 u_steps 4 v_steps 4", "texture { pigment { rgb <1, 0, 0> } } no_shadow");
        let nets = read_pov(&format!("{text}\n/* {text} */")).unwrap();
        assert_eq!(nets.len(), 1);
        assert_eq!(
            [nets[0].points[0][0], nets[0].points[2][1]],
            [DVec3::new(0.0, 0.5, 0.0), DVec3::new(2.0, 1.5, 9.0)]
        );
        let with_uv = scene("type 0", "uv_vectors <0,0> <1,0> <1,1> <0,1>");
        assert_eq!(read_pov(&with_uv).unwrap(), nets);
    }

    #[test]
    fn patches_are_moved_scaled_and_turned() {
        let net = read_pov(&scene("", "scale <2, 1, 1> rotate 90*0 translate <0, 0, 1>").replace("90*0", "<0, 90, 0>"))
            .unwrap()[0];
        // (1, 1.5, -5), scaled (2, 1.5, -5), turned about y by 90 degrees (-5, 1.5, -2), moved (-5, 1.5, -1).
        assert!(net.points[1][1].distance(DVec3::new(-5.0, 1.5, 1.0)) < 1e-12, "{}", net.points[1][1]);
        assert_eq!(read_pov(&scene("", "scale 2")).unwrap()[0].points[1][1], DVec3::new(2.0, 3.0, 10.0));
    }

    #[test]
    fn what_cannot_be_read_is_named() {
        let message = |text: &str| read_pov(text).unwrap_err().to_string();
        let text = scene("type 1", "");
        let expression = message(&text.replace("<1, 2.5", "<1, H*2"));
        assert_eq!(
            expression,
            "line 10: expected y of point 7 of patch 1 as a number (expressions cannot be read), found `H*2`"
        );
        assert!(message(&text.replace("<0, 1.5, -1>,", "")).contains("expected point 16 of patch 1, found `}`"));
        assert!(message(&scene("", "matrix <1,0,0>")).contains("only translate, rotate and scale"));
        assert!(message(&scene("", "texture { {")).contains("the file ends where `}` was expected"));
        assert!(message("sphere { 0, 1 }").contains("bicubic_patch was expected"));
        assert!(message("bicubic_patch").contains("`{` was expected"));
    }
}
