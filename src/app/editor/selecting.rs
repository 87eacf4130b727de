//! Selects control points: all, none, by rectangle, rows and columns.

use super::state::Editor;
use crate::app::document::{Direction, PointIndex, Selection, Welds, all_points, profile_points, with_lines};
use std::collections::BTreeSet;

impl Editor {
    /// Selects an item and its control points. Moves before and after are two undo steps.
    pub(crate) fn select(&mut self, selection: Selection) {
        let selection = selection.within(self.document.scene());
        if selection != self.document.selection {
            self.document.end_gesture();
            self.document.selection = selection;
        }
    }

    /// Selects all control points of the patch in the side panel; a second time all of the object.
    pub(crate) fn select_all(&mut self) {
        let selection = &self.document.selection;
        let scene = self.document.scene();
        let points = match selection.revolution(scene) {
            Some(revolution) => Some(profile_points(revolution)),
            None => selection.bezier(scene).map(|bezier| all_points(bezier, selection)),
        };
        self.select_points(points);
    }

    /// Selects the item without control points.
    pub(crate) fn select_none(&mut self) {
        self.select_points(Some(BTreeSet::new()));
    }

    /// Lets the next drag select control points by a rectangle.
    pub(crate) fn select_rectangle(&mut self) {
        let has_points = self.document.selection.surface(self.document.scene()).is_some();
        if has_points && self.canvas.show_handles {
            self.canvas.grasp.selects_rectangle = true;
        } else {
            self.select_points(None);
        }
    }

    /// Adds the rows or the columns through the selected control points; a second time the strips across seams.
    pub(crate) fn select_lines(&mut self, direction: Direction) {
        let selection = &self.document.selection;
        let bezier = selection.bezier(self.document.scene());
        let points = bezier.map(|bezier| with_lines(&Welds::of(bezier), &selection.points, direction));
        self.select_points(points.filter(|points| !points.is_empty()));
    }

    /// Switches soft selection, with a message: nothing on the canvas shows it before a drag.
    pub(crate) fn toggle_falloff(&mut self) {
        let on = !self.canvas.grasp.falloff.on;
        self.canvas.grasp.falloff.on = on;
        self.toasts.info(if on {
            "Soft selection is on: neighbours follow a moved control point. The wheel sets how far, during a drag."
        } else {
            "Soft selection is off"
        });
    }

    /// Selects these control points; without any, says where to find some.
    fn select_points(&mut self, points: Option<BTreeSet<PointIndex>>) {
        match points {
            Some(points) => self.select(Selection { points, ..self.document.selection.clone() }),
            None => {
                self.toasts.info("Select a control point of a Bezier object first");
            }
        }
    }
}
