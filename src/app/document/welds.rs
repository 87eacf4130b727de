//! The welded control points of an object, kept while its patches stay the same.

use super::handles::weld_groups;
use super::selection::PointIndex;
use crate::geometry::bezier::ControlNet;
use crate::scene::{Bezier, Revolution};
use std::collections::BTreeSet;
use std::sync::Arc;

/// The control points of an object in groups of equal position.
#[derive(Clone, Debug, Default)]
pub(crate) struct Welds {
    /// The patches that the groups belong to.
    patches: Option<Arc<Vec<ControlNet>>>,
    groups: Vec<BTreeSet<PointIndex>>,
    /// The group of each control point, 16 a patch.
    group_of: Vec<usize>,
}

impl Welds {
    /// The groups of an object's control points.
    pub(crate) fn of(bezier: &Bezier) -> Self {
        let mut welds = Self::default();
        welds.update(Some(bezier));
        welds
    }

    /// Finds the groups again where the patches have changed; no groups without patches.
    pub(crate) fn update(&mut self, bezier: Option<&Bezier>) {
        let Some(bezier) = bezier else {
            *self = Self::default();
            return;
        };
        if self.patches.as_ref().is_some_and(|kept| Arc::ptr_eq(kept, &bezier.patches)) {
            return;
        }
        self.patches = Some(Arc::clone(&bezier.patches));
        self.groups = weld_groups(bezier);
        self.group_of = vec![0; 16 * bezier.patches.len()];
        for (group, points) in self.groups.iter().enumerate() {
            points.iter().for_each(|point| self.group_of[point.place()] = group);
        }
    }

    /// Makes a group of each point of a profile: a surface of revolution has handles on its profile alone.
    pub(crate) fn update_profile(&mut self, revolution: &Revolution) {
        let count = revolution.profile().len();
        let patches = &revolution.surface().patches;
        let points = if patches.is_empty() { 0 } else { count };
        self.patches = None;
        self.groups = (0..points).map(|k| BTreeSet::from([PointIndex::of_profile(k, count)])).collect();
        // Control points off the profile belong to no group.
        self.group_of = vec![usize::MAX; 16 * patches.len()];
        for (patch, j) in (0..points / 3).flat_map(|patch| (0..4).map(move |j| (patch, j))) {
            self.group_of[PointIndex { patch, i: 0, j }.place()] = 3 * patch + j;
        }
    }

    /// All groups.
    pub(crate) fn groups(&self) -> &[BTreeSet<PointIndex>] {
        &self.groups
    }

    /// The control points at the position of `point`, including itself.
    pub(crate) fn with(&self, point: PointIndex) -> impl Iterator<Item = PointIndex> + '_ {
        let group = self.group_of.get(point.place()).and_then(|group| self.groups.get(*group));
        let alone = group.is_none().then_some(point);
        group.into_iter().flatten().copied().chain(alone)
    }

    /// The control points at the positions of `points`.
    pub(crate) fn all_with(&self, points: &BTreeSet<PointIndex>) -> BTreeSet<PointIndex> {
        points.iter().flat_map(|point| self.with(*point)).collect()
    }
}
