use super::{Object, Shape};
use crate::geometry::bezier::{Patch, QuadMesh, write_bpt};
use std::{num::NonZeroUsize, path::Path};

/// The Bezier patches of objects in world space, for other programs.
///
/// ```
/// use patchlight::scene::{SceneFile, SurfaceExport, SurfaceFormat};
///
/// let file = SceneFile::built_in("teapot")?;
/// let surface = SurfaceExport::of(&file.scene.objects).expect("the teapot has patches");
/// let obj = surface.text(SurfaceFormat::Obj, SurfaceExport::STEPS);
/// assert!(obj.starts_with("o ") && obj.lines().any(|line| line.starts_with("f ")));
/// // 32 patches as control points: the number of patches, then 17 lines each.
/// let bpt = surface.text(SurfaceFormat::Bpt, SurfaceExport::STEPS);
/// assert_eq!(bpt.lines().count(), 1 + 32 * 17);
/// # Ok::<(), patchlight::scene::SceneError>(())
/// ```
#[derive(Clone, Debug)]
pub struct SurfaceExport {
    /// The names of the objects, joined by `+`.
    pub name: String,
    patches: Vec<Patch>,
}

/// The file format of an exported surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SurfaceFormat {
    /// A Wavefront OBJ mesh.
    Obj,
    /// Control points as `.bpt`.
    Bpt,
}

impl SurfaceFormat {
    /// The format by the extension of a file name; `None` for other extensions.
    pub fn of(path: &Path) -> Option<Self> {
        let extension = path.extension()?.to_ascii_lowercase();
        match extension.to_str()? {
            "obj" => Some(Self::Obj),
            "bpt" => Some(Self::Bpt),
            _ => None,
        }
    }
}

impl SurfaceExport {
    /// The default number of quads along each side of a patch.
    pub const STEPS: NonZeroUsize = NonZeroUsize::new(16).unwrap();

    /// The patches of all Bezier objects; `None` if there are none.
    pub fn of<'a>(objects: impl IntoIterator<Item = &'a Object>) -> Option<Self> {
        let (mut names, mut patches) = (Vec::new(), Vec::new());
        for object in objects {
            let Shape::Bezier(bezier) = &object.shape else { continue };
            names.push(object.name.as_str());
            patches.extend(bezier.placed_patches());
        }
        (!names.is_empty()).then(|| Self { name: names.join("+"), patches })
    }

    /// The text of the file. A mesh has `steps` quads along each side of each patch.
    pub fn text(&self, format: SurfaceFormat, steps: NonZeroUsize) -> String {
        match format {
            SurfaceFormat::Obj => QuadMesh::new(&self.patches, steps.get()).to_obj(&self.name),
            // The format has no normals: the outside is along `dS/du x dS/dv`.
            SurfaceFormat::Bpt => {
                let facing_out = |p: &Patch| if p.is_mirrored() { p.net().transposed() } else { *p.net() };
                write_bpt(&self.patches.iter().map(facing_out).collect::<Vec<_>>())
            }
        }
    }
}
