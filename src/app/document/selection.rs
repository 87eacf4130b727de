//! The selected item and control points.

use crate::scene::{Bezier, Object, Revolution, Scene, Shape};
use std::collections::BTreeSet;

/// A part of the scene that can be selected; an index is its position in the scene's list.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Default)]
pub(crate) enum Item {
    /// Nothing, after a removal.
    Nothing,
    /// The camera.
    #[default]
    Camera,
    /// The settings of the picture and of light transport.
    Settings,
    /// An object.
    Object(usize),
    /// A material.
    Material(usize),
    /// A light.
    Light(usize),
    /// A texture.
    Texture(usize),
}

/// The index of a control point in a Bezier object: `patches[patch].points[i][j]`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Default)]
pub(crate) struct PointIndex {
    pub(crate) patch: usize,
    pub(crate) i: usize,
    pub(crate) j: usize,
}

impl PointIndex {
    /// The place of the control point in a list of all control points of the object.
    pub(crate) fn place(self) -> usize {
        16 * self.patch + 4 * self.i + self.j
    }

    /// The control point of a surface of revolution that is the point `index` of its profile, of `count` points. The segments
    /// of the profile are the rows i = 0 of the first patches; a point that two segments share is the first of the later one.
    pub(crate) fn of_profile(index: usize, count: usize) -> Self {
        let last = (count / 3).saturating_sub(1);
        let patch = (index / 3).min(last);
        Self { patch, i: 0, j: index - 3 * patch }
    }

    /// The index in the profile of a control point in the first rows of a surface of revolution; `None` for other rows. For a patch
    /// after those of the profile the index is beyond its end.
    pub(crate) fn in_profile(self) -> Option<usize> {
        (self.i == 0 && self.j < 4).then(|| 3 * self.patch + self.j)
    }
}

/// The selected item and, for a Bezier object, its selected control points.
#[derive(Clone, Debug, PartialEq, Default)]
pub(crate) struct Selection {
    pub(crate) item: Item,
    pub(crate) points: BTreeSet<PointIndex>,
    /// The patch whose control points the side panel shows.
    pub(crate) patch: usize,
}

impl Selection {
    /// Selects an item without control points.
    pub(crate) fn of(item: Item) -> Self {
        Self { item, ..Self::default() }
    }

    /// Selects the first object of patches, which users edit most; else the first object; else the camera.
    pub(crate) fn first_of(scene: &Scene) -> Self {
        let bezier = scene.objects.iter().position(|object| object.shape.surface().is_some());
        let first = bezier.or((!scene.objects.is_empty()).then_some(0));
        first.map_or_else(Self::default, |object| Self::of(Item::Object(object)))
    }

    /// This selection without items and control points that `scene` lacks.
    pub(crate) fn within(mut self, scene: &Scene) -> Self {
        let exists = match self.item {
            Item::Nothing | Item::Camera | Item::Settings => true,
            Item::Object(index) => index < scene.objects.len(),
            Item::Material(index) => index < scene.materials.len(),
            Item::Light(index) => index < scene.lights.len(),
            Item::Texture(index) => index < scene.textures.len(),
        };
        if !exists {
            return Self::first_of(scene);
        }
        let patches = self.surface(scene).map_or(0, |surface| surface.patches.len());
        match self.object(scene).map(|object| &object.shape) {
            Some(Shape::Revolution(revolution)) => {
                let count = revolution.profile().len();
                self.points.retain(|point| point.in_profile().is_some_and(|index| index < count));
            }
            _ => self.points.retain(|point| point.patch < patches),
        }
        self.patch = self.patch.min(patches.saturating_sub(1));
        self
    }

    /// The selected object; `None` when another kind of item is selected.
    pub(crate) fn object<'a>(&self, scene: &'a Scene) -> Option<&'a Object> {
        match self.item {
            Item::Object(index) => scene.objects.get(index),
            _ => None,
        }
    }

    /// The shape of the selected Bezier object; `None` when any other item is selected.
    pub(crate) fn bezier<'a>(&self, scene: &'a Scene) -> Option<&'a Bezier> {
        match &self.object(scene)?.shape {
            Shape::Bezier(bezier) => Some(bezier),
            _ => None,
        }
    }

    /// The patches of the selected object, given ones or those of a surface of revolution; `None` for other items.
    pub(crate) fn surface<'a>(&self, scene: &'a Scene) -> Option<&'a Bezier> {
        self.object(scene)?.shape.surface()
    }

    /// The selected surface of revolution; `None` when any other item is selected.
    pub(crate) fn revolution<'a>(&self, scene: &'a Scene) -> Option<&'a Revolution> {
        match &self.object(scene)?.shape {
            Shape::Revolution(revolution) => Some(revolution),
            _ => None,
        }
    }

    /// The control points that an operation on the surface changes: the selected ones, or else all of the shown patch.
    pub(crate) fn operands(&self) -> BTreeSet<PointIndex> {
        let all = || (0..16).map(|k| PointIndex { patch: self.patch, i: k / 4, j: k % 4 }).collect();
        if self.points.is_empty() { all() } else { self.points.clone() }
    }

    /// Selects the point alone, or toggles it with `extend`.
    pub(crate) fn click_point(&mut self, point: PointIndex, extend: bool) {
        self.patch = point.patch;
        if !extend {
            self.points.clear();
        }
        if !self.points.remove(&point) {
            self.points.insert(point);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn extending_toggles_points() {
        let (a, b) = (PointIndex::default(), PointIndex { patch: 0, i: 1, j: 2 });
        let mut selection = Selection::of(Item::Object(0));
        selection.click_point(a, false);
        selection.click_point(b, true);
        assert_eq!(selection.points, BTreeSet::from([a, b]));
        selection.click_point(a, true);
        assert_eq!(selection.points, BTreeSet::from([b]));
        selection.click_point(a, false);
        assert_eq!(selection.points, BTreeSet::from([a]));
    }

    #[test]
    fn a_removed_item_is_not_selected() {
        let scene = Scene::default();
        assert_eq!(Selection::of(Item::Object(3)).within(&scene), Selection::of(Item::Camera));
        assert_eq!(Selection::of(Item::Settings).within(&scene), Selection::of(Item::Settings));
    }
}
