//! Operations on the patches of the selected object.

use super::state::Editor;
use crate::app::commands::Action;
use crate::app::document::surface::{Cut, Mirror, flattened, reset, smoothed, split, thickened, usual_thickness};
use crate::app::document::{Edit, Item, mirror_copy};
use crate::scene::Bezier;

impl Editor {
    /// Splits the shown patch with its strips.
    pub(super) fn split(&mut self, cut: Cut) {
        let Some((object, bezier)) = self.selected_patches() else { return };
        let surface = split(&bezier, self.document.selection.patch, cut);
        let (before, after) = (bezier.patches.len(), surface.patches.len());
        self.document.edit(Edit::Patches(object, surface, "split patch"));
        // Other control points have the indices now.
        self.document.selection.points.clear();
        let patches = if before == 1 { "1 patch".to_owned() } else { format!("{before} patches") };
        self.toasts.info(format!("{patches} became {after}"));
    }

    /// Flattens, smooths or resets the selected control points, or all of the shown patch.
    pub(super) fn fair(&mut self, action: Action) {
        let Some((object, bezier)) = self.selected_patches() else { return };
        let points = self.document.selection.operands();
        let (placed, name) = match action {
            Action::Flatten => (flattened(&bezier, &points), "flatten points"),
            Action::Smooth => (Some(smoothed(&bezier, &points)), "smooth points"),
            _ => (Some(reset(&bezier, &points)), "reset points"),
        };
        match placed {
            Some(placed) => self.document.edit(Edit::Place(object, placed, name)),
            None => drop(self.toasts.warning("Select four or more control points: fewer lie in a plane already")),
        }
    }

    /// Goes on to the next plane of symmetry: none, then x, y and z through the centre of the object.
    pub(super) fn next_mirror(&mut self) {
        let Some((_, bezier)) = self.selected_patches() else { return };
        let axis = self.document.coupling.mirror.map_or(0, |mirror| mirror.axis + 1);
        let mirror = (axis < 3).then(|| Mirror::through_center(&bezier, axis));
        self.document.coupling.mirror = mirror;
        let name = ["x", "y", "z"].get(axis);
        self.toasts.info(name.map_or("Mirror symmetry is off".to_owned(), |name| format!("Mirror symmetry in {name}")));
    }

    /// Replaces the selected surface of revolution by its patches.
    pub(super) fn convert_to_patches(&mut self) {
        let selection = &self.document.selection;
        match (selection.item, selection.revolution(self.document.scene())) {
            (Item::Object(object), Some(revolution)) => {
                let surface = revolution.surface().clone();
                self.document.edit(Edit::Patches(object, surface, "convert to patches"));
            }
            _ => drop(self.toasts.warning("Select a surface of revolution first")),
        }
    }

    /// Closes the selected sheet to a body.
    pub(super) fn thicken(&mut self) {
        let Some((object, bezier)) = self.selected_patches() else { return };
        match thickened(&bezier, usual_thickness(&bezier)) {
            Ok(body) => self.document.edit(Edit::Patches(object, body, "thicken")),
            Err(reason) => drop(self.toasts.warning(reason)),
        }
    }

    /// Adds the mirror image of the selected object or light.
    pub(super) fn mirror_copy(&mut self, axis: usize) {
        match mirror_copy(self.document.scene(), self.document.selection.item, axis) {
            Some(edit) => self.document.edit(edit),
            None => drop(self.toasts.warning("Select an object or a light first")),
        }
    }

    /// The selected object of patches with its index; `None`, with a message, where another item is selected.
    fn selected_patches(&mut self) -> Option<(usize, Bezier)> {
        let selection = &self.document.selection;
        match (selection.item, selection.bezier(self.document.scene())) {
            (Item::Object(object), Some(bezier)) => Some((object, bezier.clone())),
            _ => {
                let is_revolution = selection.revolution(self.document.scene()).is_some();
                self.toasts.warning(if is_revolution {
                    "Convert the surface of revolution to patches first, in the menu \"Surface\""
                } else {
                    "Select an object of patches first"
                });
                None
            }
        }
    }
}
