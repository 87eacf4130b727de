use super::{Object, Shape};
use crate::geometry::bezier::{ControlNet, QuadMesh, write_bpt};
use std::{num::NonZeroUsize, path::Path};

/// Bezier patches of a scene where they stand in the world, for other programs.
#[derive(Clone, Debug, PartialEq)]
pub struct SurfaceExport {
    /// Of the objects that the patches are from.
    pub name: String,
    nets: Vec<ControlNet>,
}

/// What a surface can be written as.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SurfaceFormat {
    /// A Wavefront mesh.
    Obj,
    /// The control points.
    Bpt,
}

impl SurfaceFormat {
    /// By the file's extension; `None` where there is no such format.
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
    /// Quads along each side of a patch, unless somebody wants another number.
    pub const STEPS: NonZeroUsize = NonZeroUsize::new(16).unwrap();

    /// The patches of those objects that have any; `None` where none has.
    pub fn of<'a>(objects: impl IntoIterator<Item = &'a Object>) -> Option<Self> {
        let (mut names, mut nets) = (Vec::new(), Vec::new());
        for object in objects {
            let Shape::Bezier(bezier) = &object.shape else { continue };
            names.push(object.name.as_str());
            nets.extend(bezier.placed_nets());
        }
        (!names.is_empty()).then(|| Self { name: names.join("+"), nets })
    }

    /// The text of a file; a mesh has `steps` quads along each side of a patch.
    pub fn text(&self, format: SurfaceFormat, steps: NonZeroUsize) -> String {
        match format {
            SurfaceFormat::Obj => QuadMesh::new(&self.nets, steps.get()).to_obj(&self.name),
            SurfaceFormat::Bpt => write_bpt(&self.nets),
        }
    }
}
