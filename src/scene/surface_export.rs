use super::Object;
use crate::geometry::bezier::{ControlNet, Patch, QuadMesh, write_bpt, write_obj, write_step, write_stl};
use std::{num::NonZeroUsize, path::Path};

/// The Bezier patches of objects in world space, for other programs.
///
/// ```
/// use patchlight::scene::{SceneFile, SurfaceExport, SurfaceFormat, SurfaceOptions};
///
/// let file = SceneFile::built_in("teapot")?;
/// let surface = SurfaceExport::of(&file.scene.objects).expect("the teapot has patches");
/// let obj = surface.bytes(SurfaceFormat::Obj, SurfaceOptions::default());
/// assert!(obj.starts_with(b"o "));
/// // 32 patches as control points: the number of patches, then 17 lines each.
/// let bpt = surface.bytes(SurfaceFormat::Bpt, SurfaceOptions::default());
/// assert_eq!(bpt.iter().filter(|byte| **byte == b'\n').count(), 1 + 32 * 17);
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
    /// Wavefront OBJ: a mesh, or free-form surfaces.
    Obj,
    /// Control points as `.bpt`.
    Bpt,
    /// Triangles as binary STL, for printers.
    Stl,
    /// Exact surfaces as STEP, for CAD programs.
    Step,
}

/// How to write the formats that leave a choice.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SurfaceOptions {
    /// Quads of a mesh along each side of each patch.
    pub steps: NonZeroUsize,
    /// Whether an OBJ file holds free-form surfaces in place of a mesh. They are exact, but few programs read them.
    pub free_form: bool,
}

impl Default for SurfaceOptions {
    fn default() -> Self {
        const STEPS: NonZeroUsize = NonZeroUsize::new(16).unwrap();
        Self { steps: STEPS, free_form: false }
    }
}

impl SurfaceFormat {
    /// The extensions of the formats, in lower case.
    pub const EXTENSIONS: [&str; 5] = ["obj", "bpt", "stl", "step", "stp"];

    /// The format by the extension of a file name; `None` for other extensions.
    pub fn of(path: &Path) -> Option<Self> {
        let extension = path.extension()?.to_ascii_lowercase();
        match extension.to_str()? {
            "obj" => Some(Self::Obj),
            "bpt" => Some(Self::Bpt),
            "stl" => Some(Self::Stl),
            "step" | "stp" => Some(Self::Step),
            _ => None,
        }
    }
}

impl SurfaceExport {
    /// The patches of all Bezier objects and surfaces of revolution; `None` if there are none.
    pub fn of<'a>(objects: impl IntoIterator<Item = &'a Object>) -> Option<Self> {
        let (mut names, mut patches) = (Vec::new(), Vec::new());
        for object in objects {
            let Some(bezier) = object.shape.surface() else { continue };
            names.push(object.name.as_str());
            patches.extend(bezier.placed_patches());
        }
        (!names.is_empty()).then(|| Self { name: names.join("+"), patches })
    }

    /// The bytes of the file.
    pub fn bytes(&self, format: SurfaceFormat, options: SurfaceOptions) -> Vec<u8> {
        let mesh = || QuadMesh::new(&self.patches, options.steps.get());
        match format {
            SurfaceFormat::Obj if options.free_form => write_obj(&self.name, &self.nets()).into_bytes(),
            SurfaceFormat::Obj => mesh().to_obj(&self.name).into_bytes(),
            SurfaceFormat::Stl => write_stl(&mesh()),
            SurfaceFormat::Bpt => write_bpt(&self.nets()).into_bytes(),
            SurfaceFormat::Step => write_step(&self.name, &self.nets()).into_bytes(),
        }
    }

    /// The control nets. They have no normals: the outside is along `dS/du x dS/dv`.
    fn nets(&self) -> Vec<ControlNet> {
        let facing_out = |p: &Patch| if p.is_mirrored() { p.net().transposed() } else { *p.net() };
        self.patches.iter().map(facing_out).collect()
    }
}
