//! Operations on the patches of the selected object.

use super::state::Editor;
use crate::app::commands::Action;
use crate::app::document::surface::{Cut, Mirror, flattened, reset, smoothed, split};
use crate::app::document::{Edit, Item, texture_names};
use crate::scene::Bezier;

impl Editor {
    /// Splits the shown patch with its strips. The message tells what happens to textures.
    pub(super) fn split(&mut self, cut: Cut) {
        let Some((object, bezier)) = self.selected_patches() else { return };
        let patches = split(&bezier, self.document.selection.patch, cut);
        let (before, after, is_textured) = (bezier.patches.len(), patches.len(), self.is_textured(object));
        self.document.edit(Edit::Patches(object, patches, "split patch"));
        // Other control points have the indices now.
        self.document.selection.points.clear();
        self.toasts.info(split_message(before, after, is_textured));
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

    /// The selected object of patches with its index; `None`, with a message, where another item is selected.
    fn selected_patches(&mut self) -> Option<(usize, Bezier)> {
        let selection = &self.document.selection;
        match (selection.item, selection.bezier(self.document.scene())) {
            (Item::Object(object), Some(bezier)) => Some((object, bezier.clone())),
            _ => {
                self.toasts.warning("Select an object of patches first");
                None
            }
        }
    }

    /// Whether the material of the object has a texture.
    fn is_textured(&self, object: usize) -> bool {
        let scene = self.document.scene();
        let Some(object) = scene.objects.get(object) else { return false };
        let mut materials = scene.materials.iter().filter(|material| material.name == object.material);
        materials.any(|material| !texture_names(&mut material.clone()).is_empty())
    }
}

/// The message after a split: a patch shows its texture from 0 to 1, so a split repeats the texture.
fn split_message(before: usize, after: usize, is_textured: bool) -> String {
    let patches = if before == 1 { "1 patch".to_owned() } else { format!("{before} patches") };
    let texture = if is_textured { ". Each patch shows its whole texture, so the texture repeats." } else { "" };
    format!("{patches} became {after}{texture}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_message_of_a_split_tells_what_happens_to_textures() {
        assert_eq!(split_message(1, 2, false), "1 patch became 2");
        assert!(split_message(3, 5, true).starts_with("3 patches became 5. Each patch shows its whole texture"));
    }
}
