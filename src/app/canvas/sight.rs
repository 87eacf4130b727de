//! What the camera sees of the scene and its handles, kept from frame to frame. Knows no widget.

use super::picking::Surfaces;
use super::projection::Projection;
use super::visibility::Visibility;
use crate::app::document::{Document, Handle, Item, PointIndex, Welds, handles};
use glam::DVec2;

/// What the camera sees of the scene and its handles.
#[derive(Debug, Default)]
pub(crate) struct Sight {
    /// Whether handles are shown as if no object hid them.
    pub(crate) x_ray: bool,
    /// The surfaces of all objects.
    pub(crate) surfaces: Surfaces,
    /// The welded control points of the selected object.
    pub(crate) welds: Welds,
    visibility: Visibility,
    /// The patch of the selected object under the pointer.
    hovered: Option<usize>,
    /// Whether the visibility of some handles waits for the next frame.
    pub(crate) waits: bool,
}

impl Sight {
    /// Follows the document, the camera and the pointer, which lies at a film point.
    pub(crate) fn update(&mut self, document: &Document, projection: &Projection, pointer: Option<DVec2>) {
        let (scene, selection) = (document.scene(), &document.selection);
        self.surfaces.update(document.file());
        match selection.revolution(scene) {
            Some(revolution) => self.welds.update_profile(revolution),
            None => self.welds.update(selection.bezier(scene)),
        }
        self.hovered = pointer
            .and_then(|film| self.surfaces.nearest(&projection.ray(film)))
            .filter(|pick| selection.item == Item::Object(pick.object))
            .map(|pick| pick.patch);
        let placed = handles::visible(scene, selection.item, self.welds.groups());
        self.waits = !self.visibility.update(&self.surfaces, projection, &placed);
    }

    /// Whether an object hides the handle; never with X-ray.
    pub(crate) fn is_hidden(&self, handle: Handle) -> bool {
        !self.x_ray && self.visibility.is_hidden(handle)
    }

    /// Whether an object hides a control point of this object; never with X-ray.
    pub(crate) fn is_point_hidden(&self, object: usize, point: PointIndex) -> bool {
        self.welds.with(point).next().is_some_and(|point| self.is_hidden(Handle::Point { object, point }))
    }

    /// The control point that stands for a group of welded ones, and whether it lies in the current patches: the patch of
    /// the selection and the patch under the pointer.
    pub(crate) fn representative(&self, point: PointIndex, selected_patch: usize) -> (PointIndex, bool) {
        let in_patch = |patch: usize| self.welds.with(point).find(|member| member.patch == patch);
        match in_patch(selected_patch).or_else(|| in_patch(self.hovered?)) {
            Some(member) => (member, true),
            None => (point, false),
        }
    }

    /// Whether the control points of a patch are shown in full.
    pub(crate) fn is_current(&self, patch: usize, selected_patch: usize) -> bool {
        patch == selected_patch || self.hovered == Some(patch)
    }
}
