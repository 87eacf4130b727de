//! Follows changes of the scene's files by other programs.

use super::state::Editor;
use crate::app::document::Stamp;
use crate::app::keeping::OutsideChange;
use crate::app::shell::Dialog;
use crate::scene::SceneFile;
use egui::Context;
use std::path::{Path, PathBuf};

impl Editor {
    /// Takes over the changes of other programs, but neither during a drag nor under a dialog.
    pub(crate) fn poll_watch(&mut self, ctx: &Context) {
        self.watch.update(ctx, &self.document);
        if self.dialog.is_some() || ctx.input(|input| input.pointer.any_down()) {
            return;
        }
        if let Some(change) = self.watch.next() {
            self.follow(change);
        }
    }

    fn follow(&mut self, OutsideChange { scene, others, removed }: OutsideChange) {
        if let Some(path) = removed.filter(|path| self.document.path() == Some(path)) {
            self.document.lose_file();
            let name = file_name(&path);
            self.toasts.warning(format!("Another program has deleted or moved {name}. Save the scene to keep it."));
        }
        match scene {
            Some((path, _, Err(error))) if self.document.path() == Some(&path) => {
                // The first line names the place of the first mistake.
                self.unreadable = error.lines().next().map(str::to_owned);
            }
            Some((path, Some(stamp), Ok(file))) if self.document.path() == Some(&path) => {
                self.unreadable = None;
                self.follow_scene(path, stamp, file);
                self.follow_others(&others);
            }
            Some(_) => {}
            None => self.follow_others(&others),
        }
    }

    fn follow_scene(&mut self, path: PathBuf, stamp: Stamp, file: SceneFile) {
        if self.document.is_saved_as(&file) {
            self.document.keep_over(stamp);
        } else if self.document.is_dirty() {
            self.outside = Some((file, stamp));
            self.dialog = Some(Dialog::Reload(path));
        } else {
            self.document.reload(file, stamp);
            self.toasts.info(format!("Reloaded {}, which another program has changed", file_name(&path)));
        }
    }

    /// Reads changed textures anew. Changed patches come with the scene.
    fn follow_others(&mut self, others: &[PathBuf]) {
        if let [first, ..] = others {
            self.rendering.restart();
            self.toasts.info(format!("Reloaded {}, which another program has changed", file_name(first)));
        }
    }

    /// Takes over the scene that another program has written.
    pub(crate) fn reload(&mut self) {
        self.dialog = None;
        if let Some((file, stamp)) = self.outside.take() {
            self.document.reload(file, stamp);
        }
    }

    /// Keeps the present scene over the one that another program has written.
    pub(crate) fn keep_mine(&mut self) {
        self.dialog = None;
        if let Some((_, stamp)) = self.outside.take() {
            self.document.keep_over(stamp);
        }
    }
}

fn file_name(path: &Path) -> String {
    path.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned())
}
