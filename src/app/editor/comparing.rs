//! Snapshots of the picture: takes, compares, restores and keeps them.

use super::state::Editor;
use crate::app::commands::{Comparison, SnapshotCommand};
use crate::app::comparison::{Snapshot, Snapshots, read_snapshots, write_snapshots};
use crate::app::shell::Dialog;
use crate::film::read_exr_with_provenance;
use egui::Context;
use std::path::Path;

impl Editor {
    /// Carries out a request to the snapshots.
    pub(super) fn change_snapshots(&mut self, command: SnapshotCommand) {
        match command {
            SnapshotCommand::First(index) => self.snapshots.set_first(index),
            SnapshotCommand::Second(index) => self.snapshots.set_second(index),
            SnapshotCommand::Compare(comparison) => self.snapshots.compare(comparison),
            SnapshotCommand::Split(split) => self.snapshots.set_split(split),
            SnapshotCommand::Restore(index) => self.restore_snapshot(index),
            SnapshotCommand::Rename(index, name) => self.snapshots.rename(index, name),
            SnapshotCommand::Remove(index) => self.snapshots.remove(index),
            SnapshotCommand::KeepWithScene(keep) => self.snapshots.keep_with_scene(keep),
        }
    }

    /// Takes a snapshot of the picture, once it is no draft.
    pub(super) fn take_snapshot(&mut self) {
        self.wants_snapshot = true;
        if self.rendering.full_frame().is_none() {
            self.toasts.info("The picture is still a draft. The snapshot is taken after its first iteration.");
        }
    }

    /// Takes a snapshot that waits, and prepares what the strip and the canvas show.
    pub(super) fn poll_snapshots(&mut self, ctx: &Context) {
        if self.wants_snapshot
            && let Some(frame) = self.rendering.full_frame()
        {
            let snapshot = Snapshot::of_frame(self.snapshots.free_name(), frame, self.document.file());
            self.snapshots.add(snapshot);
            self.wants_snapshot = false;
        }
        let present = self.rendering.frame().map(|frame| &frame.image);
        self.snapshots.update(ctx, present, &self.viewpoint.seen().scene.film);
    }

    /// Compares in this way, or no longer where that is the present way.
    pub(super) fn toggle_comparison(&mut self, comparison: Comparison) {
        if self.snapshots.is_empty() {
            self.toasts.info("Take a snapshot first (T), then change the scene and compare");
        }
        let is_on = self.snapshots.comparison() == comparison;
        self.snapshots.compare(if is_on { Comparison::Off } else { comparison });
    }

    /// Goes back to the scene of a snapshot, as an undo step.
    fn restore_snapshot(&mut self, index: usize) {
        if let Some(snapshot) = self.snapshots.get(index)
            && let Some(file) = &snapshot.file
        {
            self.document.restore(file, &snapshot.name);
        }
    }

    /// Adds the picture of an OpenEXR file to the snapshots.
    pub(super) fn add_reference(&mut self, path: &Path) {
        match read_exr_with_provenance(path) {
            Ok((image, provenance)) => {
                let stem = path.file_stem().unwrap_or_default().to_string_lossy();
                let location = &self.document.file().location;
                self.snapshots.add(Snapshot::of_file(&stem, image, &provenance, location));
            }
            Err(error) => {
                self.dialog = Some(Dialog::Error("The picture cannot be read".to_owned(), error.to_string()));
            }
        }
    }

    /// Takes the snapshots that were saved with the document that was opened.
    pub(crate) fn open_snapshots(&mut self) {
        let (snapshots, messages) = self.document.path().map(read_snapshots).unwrap_or_default();
        self.snapshots = Snapshots::of_scene(snapshots);
        self.wants_snapshot = false;
        for message in messages {
            self.toasts.warning(message);
        }
    }

    /// Saves the snapshots with the scene in this file, if the user wants that.
    pub(super) fn save_snapshots(&mut self, scene: &Path) {
        if !self.snapshots.are_kept_with_scene() {
            return;
        }
        let snapshots: Vec<Snapshot> = self.snapshots.iter().cloned().collect();
        match write_snapshots(scene, &snapshots) {
            Ok(()) => self.snapshots.saved(),
            Err(error) => {
                self.toasts.error(error);
            }
        }
    }

    /// Whether the scene, or snapshots that are saved with it, have unsaved changes.
    pub(crate) fn has_unsaved(&self) -> bool {
        self.document.is_dirty() || self.snapshots.are_unsaved()
    }
}
