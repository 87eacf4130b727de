//! All that the window shows and remembers.

use super::opened_scene::OpenedScene;
use crate::app::canvas::Canvas;
use crate::app::commands::{LengthUnit, Next};
use crate::app::comparison::Snapshots;
use crate::app::document::{Document, Stamp};
use crate::app::files::{Chooser, Export};
use crate::app::inspection::Inspection;
use crate::app::keeping::{
    Autosave, LastFolders, LeftOvers, PanelSizes, PreferencesFile, RecentFiles, Watch, WindowPlace,
};
use crate::app::rendering::{Display, Rendering};
use crate::app::shell::Dialog;
use crate::app::viewpoint::{RestingSize, Viewpoint, Visited};
use crate::scene::SceneFile;
use egui_commonmark::CommonMarkCache;
use egui_notify::{Anchor, Toasts};

/// All that the window shows and remembers. Widgets read it; only `apply`, and dialogs and exports that end, change it.
pub(crate) struct Editor {
    pub(crate) document: Document,
    pub(crate) rendering: Rendering,
    /// The scene as the window shows it.
    pub(crate) viewpoint: Viewpoint,
    /// The views that the user visited.
    pub(crate) visited: Visited,
    pub(crate) canvas: Canvas,
    /// The size of the canvas, screen pixels.
    pub(crate) canvas_size: RestingSize,
    pub(crate) display: Display,
    pub(crate) inspection: Inspection,
    pub(crate) snapshots: Snapshots,
    /// Whether a snapshot waits for the end of a draft.
    pub(crate) wants_snapshot: bool,
    pub(crate) chooser: Chooser,
    pub(crate) export: Export,
    pub(crate) autosave: Autosave,
    pub(crate) left_overs: LeftOvers,
    pub(crate) recent: RecentFiles,
    pub(crate) watch: Watch,
    /// The scene that another program has written to the scene's file, while the user is asked about it.
    pub(crate) outside: Option<(SceneFile, Stamp)>,
    /// Why the scene's file, which another program has changed, cannot be opened.
    pub(crate) unreadable: Option<String>,
    pub(crate) preferences_file: PreferencesFile,
    pub(crate) last_folders: LastFolders,
    pub(crate) length_unit: LengthUnit,
    pub(crate) panel_sizes: PanelSizes,
    /// The place of the window while it is not maximized; `None` where the desktop does not tell.
    pub(crate) window_place: Option<WindowPlace>,
    pub(crate) dialog: Option<Dialog>,
    pub(crate) toasts: Toasts,
    /// The scene file that the user wants to open, while the user is asked about unsaved changes.
    pub(crate) opened: Option<OpenedScene>,
    /// The step that follows once the scene is saved.
    pub(crate) after_save: Option<Next>,
    pub(crate) show_panels: bool,
    pub(crate) show_history: bool,
    pub(crate) show_guide: bool,
    /// What the guide has laid out.
    pub(crate) guide: CommonMarkCache,
    /// Whether the hint for a first start is shown, until the first edit.
    pub(crate) show_hint: bool,
    /// Whether the window may close, because the changes are saved or the user discards them.
    pub(crate) may_close: bool,
}

impl Editor {
    /// An editor of this scene, which it submits for rendering. It keeps nothing on disk by itself: see `keep_in`.
    pub(crate) fn new(file: SceneFile) -> Self {
        let document = Document::new(file);
        let mut rendering = Rendering::new();
        rendering.submit(document.file());
        Self {
            viewpoint: Viewpoint::new(document.file()),
            visited: Visited::new(document.scene().camera),
            document,
            rendering,
            canvas: Canvas::default(),
            canvas_size: RestingSize::default(),
            display: Display::default(),
            inspection: Inspection::default(),
            snapshots: Snapshots::default(),
            wants_snapshot: false,
            chooser: Chooser::default(),
            export: Export::default(),
            autosave: Autosave::default(),
            left_overs: LeftOvers::default(),
            recent: RecentFiles::default(),
            watch: Watch::default(),
            outside: None,
            unreadable: None,
            preferences_file: PreferencesFile::default(),
            last_folders: LastFolders::default(),
            length_unit: LengthUnit::default(),
            panel_sizes: PanelSizes::default(),
            window_place: None,
            dialog: None,
            toasts: Toasts::default().with_anchor(Anchor::BottomLeft).with_margin(egui::vec2(12.0, 34.0)),
            opened: None,
            after_save: None,
            show_panels: true,
            show_history: false,
            show_guide: false,
            guide: CommonMarkCache::default(),
            show_hint: true,
            may_close: false,
        }
    }
}
