//! All snapshots of the window, and what is compared how.

use super::difference::{Difference, Numbers};
use super::snapshot::Snapshot;
use super::thumbnail::thumbnail;
use crate::app::commands::Comparison;
use crate::app::rendering::Display;
use crate::film::LinearImage;
use crate::scene::Film;
use egui::{Context, TextureHandle, TextureOptions};
use std::sync::Arc;

/// The snapshots, from the oldest to the newest.
#[derive(Default)]
pub(crate) struct Snapshots {
    list: Vec<(Snapshot, Option<TextureHandle>)>,
    /// The first picture of a comparison, by its place in the list; `None` for the present picture.
    first: Option<usize>,
    /// The second picture of a comparison; `None` where there is no snapshot.
    second: Option<usize>,
    comparison: Comparison,
    /// The place of the line between two pictures, from 0 at the left to 1 at the right.
    pub(super) split: f32,
    /// Whether snapshots are saved with the scene.
    kept_with_scene: bool,
    /// Whether they differ from the ones that were saved with the scene.
    is_changed: bool,
    /// The textures of the first and the second picture, where they are snapshots.
    displays: [Display; 2],
    difference: Difference,
}

/// What the canvas shows in place of the present picture.
pub(crate) struct Shown<'a> {
    /// The picture; `None` for the present one.
    pub(crate) texture: Option<&'a TextureHandle>,
    /// Its linear image; `None` for the present one, and for false colours.
    pub(crate) image: Option<&'a LinearImage>,
    /// The picture to the right of a line, and the line's place from 0 to 1.
    pub(crate) beside: Option<(&'a TextureHandle, f32)>,
}

impl Snapshots {
    /// The snapshots of a scene that was opened.
    pub(crate) fn of_scene(snapshots: Vec<Snapshot>) -> Self {
        let kept_with_scene = !snapshots.is_empty();
        let mut all = Self { kept_with_scene, ..Self::default() };
        snapshots.into_iter().for_each(|snapshot| all.add(snapshot));
        all.saved();
        all
    }

    /// Whether snapshots are saved with the scene.
    pub(crate) fn are_kept_with_scene(&self) -> bool {
        self.kept_with_scene
    }

    /// Saves snapshots with the scene from now on, or does not.
    pub(crate) fn keep_with_scene(&mut self, keep: bool) {
        self.is_changed |= keep != self.kept_with_scene;
        self.kept_with_scene = keep;
    }

    /// The snapshots were saved with the scene.
    pub(crate) fn saved(&mut self) {
        self.is_changed = false;
    }

    /// Whether changes of the snapshots would be lost with the window, although they are to be saved with the scene.
    pub(crate) fn are_unsaved(&self) -> bool {
        self.kept_with_scene && self.is_changed
    }

    /// Adds a snapshot, with which the present picture will be compared.
    pub(crate) fn add(&mut self, snapshot: Snapshot) {
        if self.list.is_empty() {
            self.split = 0.5;
        }
        self.is_changed = true;
        self.second = Some(self.list.len());
        self.list.push((snapshot, None));
    }

    /// A name for the next snapshot.
    pub(crate) fn free_name(&self) -> String {
        let is_taken = |name: &String| self.list.iter().any(|(snapshot, _)| snapshot.name == *name);
        (self.list.len() + 1..)
            .map(|number| format!("Snapshot {number}"))
            .find(|name| !is_taken(name))
            .unwrap_or_default()
    }

    /// The snapshots, from the oldest to the newest.
    pub(crate) fn iter(&self) -> impl ExactSizeIterator<Item = &Snapshot> {
        self.list.iter().map(|(snapshot, _)| snapshot)
    }

    /// Whether there is none.
    pub(crate) fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// The snapshot at a place.
    pub(crate) fn get(&self, index: usize) -> Option<&Snapshot> {
        self.list.get(index).map(|(snapshot, _)| snapshot)
    }

    /// The thumbnail of the snapshot at a place; `None` before the next [`Self::update`].
    pub(super) fn thumbnail(&self, index: usize) -> Option<&TextureHandle> {
        self.list.get(index)?.1.as_ref()
    }

    /// The places of the first and the second picture of a comparison: see [`Self::set_first`].
    pub(super) fn places(&self) -> [Option<usize>; 2] {
        [self.first, self.second]
    }

    /// The way of comparing.
    pub(crate) fn comparison(&self) -> Comparison {
        self.comparison
    }

    /// Compares in this way; without a snapshot there is nothing to compare.
    pub(crate) fn compare(&mut self, comparison: Comparison) {
        self.comparison = if self.second.is_some() { comparison } else { Comparison::Off };
    }

    /// Takes the snapshot at a place, or the present picture, as the first picture of a comparison.
    pub(crate) fn set_first(&mut self, index: Option<usize>) {
        self.first = index.filter(|index| *index < self.list.len());
    }

    /// Takes the snapshot at a place as the second picture of a comparison.
    pub(crate) fn set_second(&mut self, index: usize) {
        self.second = Some(index).filter(|index| *index < self.list.len()).or(self.second);
    }

    /// Moves the line between two pictures.
    pub(crate) fn set_split(&mut self, split: f32) {
        self.split = split.clamp(0.0, 1.0);
    }

    /// Gives the snapshot at a place another name.
    pub(crate) fn rename(&mut self, index: usize, name: String) {
        if let Some((snapshot, _)) = self.list.get_mut(index) {
            self.is_changed |= snapshot.name != name;
            snapshot.name = name;
        }
    }

    /// Forgets the snapshot at a place.
    pub(crate) fn remove(&mut self, index: usize) {
        if index >= self.list.len() {
            return;
        }
        self.is_changed = true;
        self.list.remove(index);
        let moved = |place: usize| if place > index { place - 1 } else { place };
        self.first = self.first.filter(|place| *place != index).map(moved);
        let last = self.list.len().checked_sub(1);
        self.second = self.second.map(moved).zip(last).map(|(place, last)| place.min(last));
        self.compare(self.comparison);
    }

    /// Makes what the strip and the canvas will show, with the exposure and tone curve of a film. `present` is the present picture.
    pub(crate) fn update(&mut self, ctx: &Context, present: Option<&Arc<LinearImage>>, film: &Film) {
        for (index, (snapshot, texture)) in self.list.iter_mut().enumerate() {
            texture.get_or_insert_with(|| {
                ctx.load_texture(format!("snapshot {index}"), thumbnail(snapshot, film), TextureOptions::LINEAR)
            });
        }
        self.difference.poll(ctx);
        if self.comparison == Comparison::Off {
            return;
        }
        for (display, place) in self.displays.iter_mut().zip([self.first, self.second]) {
            if let Some((snapshot, _)) = place.and_then(|place| self.list.get(place)) {
                display.show(ctx, &snapshot.image, film);
            }
            display.poll(ctx);
        }
        if self.comparison == Comparison::Difference
            && let Some([image, reference]) = self.pair(present)
            && is_same_size(image, reference)
        {
            let [image, reference] = [image, reference].map(Arc::clone);
            self.difference.ask(ctx, &image, &reference, film);
        }
    }

    /// The two pictures; `None` where one is missing.
    fn pair<'a>(&'a self, present: Option<&'a Arc<LinearImage>>) -> Option<[&'a Arc<LinearImage>; 2]> {
        let image = |index: usize| self.get(index).map(|snapshot| &snapshot.image);
        let first = self.first.map_or(present, image)?;
        Some([first, image(self.second?)?])
    }

    /// Why the two pictures have no difference; `None` where they have one.
    pub(super) fn obstacle(&self, present: Option<&Arc<LinearImage>>) -> Option<String> {
        let [image, reference] = self.pair(present)?;
        let size = |image: &LinearImage| format!("{} × {}", image.width, image.height);
        (!is_same_size(image, reference))
            .then(|| format!("The pictures have {} and {} pixels", size(image), size(reference)))
    }

    /// The numbers of the difference; `None` before they are known.
    pub(super) fn numbers(&self, present: Option<&Arc<LinearImage>>) -> Option<Numbers> {
        self.pair(present).and_then(|[_, reference]| self.difference.numbers(reference))
    }

    /// What the canvas shows in place of the present picture; `None` without a comparison.
    pub(crate) fn shown(&self, present: Option<&Arc<LinearImage>>) -> Option<Shown<'_>> {
        let [first, second] = self.displays.each_ref().map(Display::texture);
        let image = |place: Option<usize>| place.and_then(|place| self.get(place)).map(|snapshot| &*snapshot.image);
        let alone = Shown { texture: first.filter(|_| self.first.is_some()), image: image(self.first), beside: None };
        match self.comparison {
            Comparison::Off => None,
            Comparison::Flip => Some(Shown { texture: second, image: image(self.second), beside: None }),
            Comparison::Split => Some(Shown { beside: second.map(|second| (second, self.split)), ..alone }),
            Comparison::Difference if self.obstacle(present).is_some() => Some(alone),
            Comparison::Difference => Some(Shown { texture: self.difference.texture(), image: None, beside: None }),
        }
    }
}

fn is_same_size(a: &LinearImage, b: &LinearImage) -> bool {
    (a.width, a.height) == (b.width, b.height)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Rgb;

    fn snapshots(count: usize) -> Snapshots {
        let mut all = Snapshots::default();
        for _ in 0..count {
            let image = LinearImage { width: 1, height: 1, pixels: vec![Rgb::ONE] };
            let (name, image) = (all.free_name(), Arc::new(image));
            all.add(Snapshot { name, image, file: None, iterations: 1, seconds: None, error: None });
        }
        all
    }

    #[test]
    fn a_removed_snapshot_leaves_the_others_in_their_roles() {
        let mut all = snapshots(3);
        all.set_first(Some(2));
        all.set_second(1);
        all.compare(Comparison::Split);
        all.remove(0);
        assert_eq!((all.places(), all.comparison()), ([Some(1), Some(0)], Comparison::Split));
        all.remove(1);
        assert_eq!(all.places(), [None, Some(0)], "the present picture again");
        all.remove(0);
        assert_eq!((all.places(), all.comparison()), ([None, None], Comparison::Off));
        all.remove(7);
    }

    #[test]
    fn places_and_the_line_stay_in_their_ranges() {
        let mut all = snapshots(2);
        all.set_first(Some(9));
        all.set_second(9);
        assert_eq!(all.places(), [None, Some(1)]);
        all.set_split(7.0);
        assert_eq!(all.split, 1.0);
    }

    #[test]
    fn names_are_free() {
        let mut all = snapshots(3);
        all.remove(0);
        assert_eq!(all.free_name(), "Snapshot 4", "there is a third one");
    }
}
