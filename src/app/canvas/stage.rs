//! The scene on the canvas in one frame: where handles are, and which handles a click or drag affects.

use super::projection::Projection;
use super::sight::Sight;
use super::view::ScreenTransform;
use crate::app::document::{Document, Handle, Item, Selection, handles};
use egui::{Pos2, Rect, Vec2};
use glam::DVec3;
use std::collections::BTreeSet;

/// Side of the square around a handle that takes the pointer, screen points.
const GRAB_SIZE: f32 = 16.0;

/// Distance from a handle at which a press outside of every square still means the handle, screen points.
const REACH: f32 = 14.0;

/// Extent on the screen below which a patch that is not current shows no control points, screen points: they would cover the
/// surface.
const TINY: f32 = 12.0;

/// The document with its transforms to the screen, for one frame of the canvas.
pub(crate) struct Stage<'a> {
    pub(crate) document: &'a Document,
    pub(crate) transform: ScreenTransform,
    pub(crate) projection: Projection,
    pub(crate) sight: &'a Sight,
    /// Whether handles, control nets and the gizmo are shown.
    pub(crate) shows_handles: bool,
}

/// How a handle is drawn, from the back to the front.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Look {
    /// Small and dim: an object hides the handle.
    Hidden,
    /// A tiny dot: a control point of a patch that is not current.
    Faint,
    /// In full.
    Full,
}

/// A handle on the screen.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ScreenHandle {
    /// The handle; of welded control points the one in a current patch.
    pub(crate) handle: Handle,
    /// The handle that names its widget; it stays the same when another patch becomes current.
    pub(crate) id: Handle,
    /// The handle's centre, screen points.
    pub(crate) screen: Pos2,
    pub(crate) look: Look,
    /// Depth in front of the camera, scene units.
    depth: f64,
}

impl ScreenHandle {
    /// The area that takes the pointer, screen points.
    pub(crate) fn grab_rect(&self) -> Rect {
        Rect::from_center_size(self.screen, Vec2::splat(GRAB_SIZE))
    }
}

/// The handle that a press at `at` grabs: the frontmost of the handles whose square contains `at`, or else the nearest within
/// reach. A hidden handle is grabbed only where no visible one is near. `None` away from all handles.
pub(crate) fn grabbed(drawn: &[ScreenHandle], at: Pos2) -> Option<Handle> {
    let of = |hidden: bool| {
        let candidates = || drawn.iter().filter(move |drawn| (drawn.look == Look::Hidden) == hidden);
        let distance = |handle: &&ScreenHandle| handle.screen.distance(at);
        let exact = candidates().filter(|handle| handle.grab_rect().contains(at));
        let near = candidates().filter(|handle| distance(handle) <= REACH);
        exact
            .min_by(|a, b| a.depth.total_cmp(&b.depth))
            .or_else(|| near.min_by(|a, b| distance(a).total_cmp(&distance(b))))
    };
    of(false).or_else(|| of(true)).map(|drawn| drawn.handle)
}

/// Whether a patch with these control points on the screen is too small to show them; `None` is behind the camera.
pub(crate) fn is_tiny(points: &[Option<Pos2>]) -> bool {
    let around = points.iter().flatten().fold(Rect::NOTHING, |around, at| around.union(Rect::from_pos(*at)));
    around.size().max_elem() < TINY
}

impl Stage<'_> {
    /// The screen point of a world point; `None` behind the camera.
    pub(crate) fn screen(&self, world: DVec3) -> Option<Pos2> {
        self.projection.project(world).map(|film| self.transform.to_screen(film))
    }

    /// Screen points per scene unit at the depth of a world point, across the view direction.
    pub(crate) fn points_per_unit(&self, world: DVec3) -> f64 {
        self.projection.pixels_per_unit(self.projection.depth(world)) * f64::from(self.transform.scale)
    }

    /// Whether the selection contains the handle's item, or one of the control points at its position.
    pub(crate) fn is_selected(&self, handle: Handle) -> bool {
        let selection = &self.document.selection;
        selection.item == handle.item()
            && match handle {
                Handle::Point { point, .. } => {
                    !selection.points.is_empty() && self.sight.welds.with(point).any(|p| selection.points.contains(&p))
                }
                Handle::Object(_) | Handle::Light(_) => true,
            }
    }

    /// The handles on the canvas, in the order of painting: hidden ones first, then from far to near.
    pub(crate) fn handles(&self) -> Vec<ScreenHandle> {
        if !self.shows_handles {
            return Vec::new();
        }
        let visible = handles::visible(self.document.scene(), self.document.selection.item, self.sight.welds.groups());
        let tiny = self.tiny_patches();
        let mut drawn: Vec<ScreenHandle> =
            visible.into_iter().filter_map(|(handle, world)| self.placed(handle, world, &tiny)).collect();
        drawn.sort_by(|a, b| a.look.cmp(&b.look).then(b.depth.total_cmp(&a.depth)));
        drawn
    }

    /// Which patches of the selected object are too small on the screen to show their control points; empty for other items.
    fn tiny_patches(&self) -> Vec<bool> {
        let Some(bezier) = self.document.selection.surface(self.document.scene()) else { return Vec::new() };
        let world_from_object = bezier.transform.world_from_object();
        let screen = |point: &DVec3| self.screen(world_from_object.transform_point3(*point));
        bezier
            .patches
            .iter()
            .map(|net| is_tiny(&net.points.as_flattened().iter().map(screen).collect::<Vec<_>>()))
            .collect()
    }

    /// Whether a control point belongs only to patches that are too small on the screen.
    fn is_in_tiny(&self, id: Handle, tiny: &[bool]) -> bool {
        let Handle::Point { point, .. } = id else { return false };
        self.sight.welds.with(point).all(|point| tiny.get(point.patch).is_some_and(|tiny| *tiny))
    }

    /// The handle at a world point on the screen; `None` off the canvas, and for a control point that is not current where it is not seen or
    /// its patches are too small.
    fn placed(&self, id: Handle, world: DVec3, tiny: &[bool]) -> Option<ScreenHandle> {
        let screen = self.screen(world).filter(|screen| self.transform.canvas.contains(*screen))?;
        let (handle, current) = match id {
            Handle::Point { object, point } => {
                let (point, current) = self.sight.representative(point, self.document.selection.patch);
                // A profile has one row of handles, of all its patches.
                let is_profile = self.document.selection.revolution(self.document.scene()).is_some();
                let current = current || is_profile || self.sight.x_ray || self.is_selected(id);
                (Handle::Point { object, point }, current)
            }
            Handle::Object(_) | Handle::Light(_) => (id, true),
        };
        let look = match (current, self.sight.is_hidden(id)) {
            (true, false) => Look::Full,
            (true, true) => Look::Hidden,
            (false, false) if self.is_in_tiny(id, tiny) => return None,
            (false, false) => Look::Faint,
            (false, true) => return None,
        };
        Some(ScreenHandle { handle, id, screen, look, depth: self.projection.depth(world) })
    }

    /// The selection after a click on a handle; `extend` toggles a control point instead of selecting it alone.
    pub(crate) fn clicked(&self, handle: Handle, extend: bool) -> Selection {
        let mut selection = self.document.selection.clone();
        if selection.item != handle.item() {
            selection = Selection::of(handle.item());
        }
        match handle {
            Handle::Point { point, .. } if extend && self.is_selected(handle) => {
                for welded in self.sight.welds.with(point) {
                    selection.points.remove(&welded);
                }
                selection.patch = point.patch;
            }
            Handle::Point { point, .. } => selection.click_point(point, extend),
            Handle::Object(_) | Handle::Light(_) => selection.points.clear(),
        }
        selection
    }

    /// The handles that a drag of `handle` moves: for a selected control point all selected control points, with the
    /// control points welded to them.
    pub(crate) fn moved_with(&self, handle: Handle) -> Vec<Handle> {
        let Handle::Point { object, point } = handle else { return vec![handle] };
        let points = &self.document.selection.points;
        let grabbed = if self.is_selected(handle) { points.clone() } else { BTreeSet::from([point]) };
        let moving = self.sight.welds.all_with(&grabbed);
        moving.into_iter().map(|point| Handle::Point { object, point }).collect()
    }

    /// The handles of the selection, whose mean position is the selection's place: its control points, one for each group of
    /// welded ones; else the object or the light. Empty for every other item.
    pub(crate) fn selected_handles(&self) -> Vec<Handle> {
        let selection = &self.document.selection;
        match selection.item {
            Item::Object(object) if selection.points.is_empty() => vec![Handle::Object(object)],
            Item::Object(object) => {
                let firsts: BTreeSet<_> =
                    selection.points.iter().filter_map(|point| self.sight.welds.with(*point).next()).collect();
                firsts.into_iter().map(|point| Handle::Point { object, point }).collect()
            }
            Item::Light(light) => vec![Handle::Light(light)],
            Item::Nothing | Item::Camera | Item::Settings | Item::Material(_) | Item::Texture(_) => Vec::new(),
        }
    }

    /// The mean position of handles, world space; `None` without a handle in the scene.
    pub(crate) fn mean_position(&self, handles: &[Handle]) -> Option<DVec3> {
        let scene = self.document.scene();
        let places: Vec<DVec3> = handles.iter().filter_map(|handle| handle.position(scene)).collect();
        (!places.is_empty()).then(|| places.iter().sum::<DVec3>() / places.len() as f64)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use egui::pos2;

    fn drawn(light: usize, x: f32, look: Look, depth: f64) -> ScreenHandle {
        let handle = Handle::Light(light);
        ScreenHandle { handle, id: handle, screen: pos2(x, 0.0), look, depth }
    }

    #[test]
    fn only_a_small_patch_is_tiny() {
        let corners = |size: f32| [Some(pos2(3.0, 4.0)), None, Some(pos2(3.0 + size, 4.0))];
        assert!(is_tiny(&corners(11.0)) && !is_tiny(&corners(13.0)));
        assert!(is_tiny(&[None; 16]), "behind the camera");
    }

    #[test]
    fn the_front_handle_is_grabbed_and_a_hidden_one_only_alone() {
        let handles = [
            drawn(0, 0.0, Look::Hidden, 1.0),
            drawn(1, 5.0, Look::Full, 3.0),
            drawn(2, 6.0, Look::Faint, 2.0),
            drawn(3, 60.0, Look::Hidden, 1.0),
            drawn(4, 71.0, Look::Full, 9.0),
        ];
        let grabbed = |x: f32| grabbed(&handles, pos2(x, 0.0));
        assert_eq!(grabbed(4.0), Some(Handle::Light(2)), "the nearest to the camera of two under the pointer");
        assert_eq!(grabbed(-7.0), Some(Handle::Light(1)), "a visible one within reach comes before a hidden one");
        assert_eq!(grabbed(-8.5), Some(Handle::Light(1)));
        assert_eq!(grabbed(-12.0), Some(Handle::Light(0)), "no visible one is near");
        assert_eq!(grabbed(60.0), Some(Handle::Light(4)));
        assert_eq!(grabbed(52.0), Some(Handle::Light(3)));
        assert_eq!(grabbed(30.0), None);
    }
}
