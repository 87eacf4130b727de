//! Files of patches, to and from other programs.
//!
//! | file | holds |
//! |---|---|
//! | `error` | why a file holds no patches that can be read |
//! | `scanner` | the words of a text with their lines |
//! | `bpt` | control points as `.bpt`, also with numbered points |
//! | `obj` | free-form surfaces of Wavefront OBJ |
//! | `pov` | patches of POV-Ray scenes |
//! | `rib` | patches of RenderMan scenes |
//! | `stl` | triangles for printers |
//! | `step` | surfaces for CAD programs |

mod bpt;
mod error;
mod obj;
mod pov;
mod rib;
mod scanner;
mod step;
mod stl;

pub use bpt::{read_bpt, write_bpt};
pub use error::{FormatError, FormatProblem};
pub use obj::{read_obj, write_obj};
pub use pov::read_pov;
pub use rib::read_rib;
pub use step::write_step;
pub use stl::write_stl;

use super::ControlNet;
use std::path::Path;

/// A format whose patches can be read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PatchFormat {
    /// Control points.
    Bpt,
    /// Free-form surfaces of Wavefront OBJ.
    Obj,
    /// A POV-Ray scene.
    Pov,
    /// A RenderMan scene.
    Rib,
}

impl PatchFormat {
    /// The extensions of files whose patches can be read, in lower case.
    pub const EXTENSIONS: [&str; 5] = ["bpt", "obj", "pov", "inc", "rib"];

    /// The format by the extension of a file name; `None` for other extensions.
    pub fn of(path: &Path) -> Option<Self> {
        let extension = path.extension()?.to_ascii_lowercase();
        match extension.to_str()? {
            "bpt" => Some(Self::Bpt),
            "obj" => Some(Self::Obj),
            "pov" | "inc" => Some(Self::Pov),
            "rib" => Some(Self::Rib),
            _ => None,
        }
    }

    /// The control nets of a text.
    ///
    /// # Errors
    ///
    /// For a text that breaks the rules of the format, or holds no bicubic Bezier patches; the error names the line.
    pub fn read(self, text: &str) -> Result<Vec<ControlNet>, FormatError> {
        match self {
            Self::Bpt => read_bpt(text),
            Self::Obj => read_obj(text),
            Self::Pov => read_pov(text),
            Self::Rib => read_rib(text),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::{collection::vec, prelude::*, sample::select};

    /// A text of words that the formats know, and of numbers.
    fn text() -> impl Strategy<Value = String> {
        const WORDS: [&str; 37] = [
            "bicubic_patch",
            "{",
            "}",
            "<",
            ">",
            "translate",
            "uv_vectors",
            "texture",
            "/*",
            "//",
            "Patch",
            "PatchMesh",
            "\"bicubic\"",
            "\"periodic\"",
            "\"nonperiodic\"",
            "\"P\"",
            "[",
            "]",
            "Basis",
            "Rotate",
            "WorldBegin",
            "AttributeEnd",
            "v",
            "surf",
            "parm",
            "u",
            "deg",
            "cstype bezier",
            "end",
            "\\\n",
            "\n",
            "#",
            "3 3",
            "1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16",
            "4",
            "\"",
            "ä",
        ];
        let number = prop_oneof![any::<i64>().prop_map(|n| n.to_string()), any::<f64>().prop_map(|x| format!("{x:?}"))];
        let numbers = vec(-9.0..9.0f64, 48).prop_map(|xs| xs.iter().map(|x| format!("{x} ")).collect::<String>());
        let word = prop_oneof![8 => select(&WORDS[..]).prop_map(str::to_owned), 2 => number, 1 => numbers];
        vec(word, 0..40).prop_map(|words| words.join(" "))
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 2000, failure_persistence: None, ..ProptestConfig::default() })]

        /// Whatever a file holds, it is read or refused.
        #[test]
        fn any_text_has_finite_patches_or_an_error_in_one_of_its_lines(text in text()) {
            let lines = text.lines().count().max(1);
            for format in [PatchFormat::Bpt, PatchFormat::Obj, PatchFormat::Pov, PatchFormat::Rib] {
                match format.read(&text) {
                    Ok(nets) => prop_assert!(nets.iter().all(|net| net.points.iter().flatten().all(|p| !p.is_nan()))),
                    Err(error) => prop_assert!((1..=lines).contains(&error.line), "{error}"),
                }
            }
        }
    }

    #[test]
    fn every_extension_has_a_format() {
        for extension in PatchFormat::EXTENSIONS {
            let path = format!("a.b/vase.{}", extension.to_uppercase());
            assert!(PatchFormat::of(Path::new(&path)).is_some(), "{path}");
        }
        assert_eq!(["vase", "vase.toml"].map(|path| PatchFormat::of(Path::new(path))), [None, None]);
    }
}
