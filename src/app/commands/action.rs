//! Actions of menus, buttons and keys. One table gives their labels and shortcuts, and the rows of the help.

use crate::app::viewpoint::{NamedView, Side};
use egui::{Context, Key, KeyboardShortcut, Modifiers};

/// A command without parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Action {
    New,
    Open,
    Save,
    SaveAs,
    Export,
    ExportShown,
    ExportDeep,
    CopyPicture,
    ExportSurface,
    Quit,
    Undo,
    Redo,
    ToggleHistory,
    Duplicate,
    Delete,
    SplitU,
    SplitV,
    SplitBoth,
    Flatten,
    Smooth,
    ResetPoints,
    ToggleTangents,
    NextMirror,
    ConvertToPatches,
    Thicken,
    MirrorCopyX,
    MirrorCopyY,
    MirrorCopyZ,
    TogglePause,
    Restart,
    Fit,
    OneToOne,
    ZoomIn,
    ZoomOut,
    Brighter,
    Darker,
    View(NamedView),
    Navigate,
    LookAround,
    UseView,
    MatchWindow,
    ToggleSmoothing,
    ToggleHandles,
    ToggleXRay,
    SelectAll,
    SelectNone,
    SelectRectangle,
    SelectRow,
    SelectColumn,
    ToggleFalloff,
    ToggleIsolines,
    ToggleMeanCurvature,
    ToggleGaussianCurvature,
    ToggleZebra,
    ToggleLightPaths,
    ToggleIrradiance,
    DrawProfile,
    ExportProfile,
    TakeSnapshot,
    OpenReference,
    CompareFlip,
    CompareSplit,
    CompareDifference,
    TogglePanels,
    FullScreen,
    ToggleGuide,
    Palette,
    Help,
}

/// The keyboard focus that blocks a shortcut.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum BlockedBy {
    /// No focus blocks the shortcut.
    Nothing,
    /// A focused text field blocks the shortcut, which has its own meaning there.
    Text,
    /// Any focused widget blocks the shortcut: a plain letter or the space bar.
    AnyFocus,
}

const CTRL: Modifiers = Modifiers::COMMAND;
const CTRL_SHIFT: Modifiers = Modifiers::COMMAND.plus(Modifiers::SHIFT);
const NONE: Modifiers = Modifiers::NONE;

type Keys = &'static [(Modifiers, Key)];
type Row = (Action, &'static str, Keys);

/// Each action with its label and shortcuts, in the order of the help and of the palette.
const TABLE: &[Row] = &[
    (Action::New, "New scene", &[(CTRL, Key::N)]),
    (Action::Open, "Open…", &[(CTRL, Key::O)]),
    (Action::Save, "Save", &[(CTRL, Key::S)]),
    (Action::SaveAs, "Save as…", &[(CTRL_SHIFT, Key::S)]),
    (Action::Export, "Export picture…", &[(CTRL, Key::E)]),
    (Action::ExportShown, "Export picture as shown…", &[]),
    (Action::ExportDeep, "Export 16-bit picture…", &[]),
    (Action::CopyPicture, "Copy picture", &[]),
    (Action::ExportSurface, "Export surface…", &[(CTRL_SHIFT, Key::E)]),
    (Action::Quit, "Quit", &[(CTRL, Key::Q)]),
    (Action::Undo, "Undo", &[(CTRL, Key::Z)]),
    (Action::Redo, "Redo", &[(CTRL_SHIFT, Key::Z), (CTRL, Key::Y)]),
    (Action::ToggleHistory, "Show history", &[(CTRL, Key::H)]),
    (Action::Duplicate, "Duplicate", &[(CTRL, Key::D)]),
    (Action::Delete, "Delete", &[(NONE, Key::Delete)]),
    (Action::SelectAll, "Select all of the patch, then of the object", &[(CTRL, Key::A)]),
    (Action::SelectNone, "Select no control points", &[(CTRL_SHIFT, Key::A)]),
    (Action::SelectRectangle, "Select by rectangle", &[(NONE, Key::B)]),
    (Action::SelectRow, "Select row, then the whole strip", &[(NONE, Key::I)]),
    (Action::SelectColumn, "Select column, then the whole strip", &[(NONE, Key::J)]),
    (Action::ToggleFalloff, "Soft selection", &[(NONE, Key::O)]),
    (Action::SplitU, "Split patch in u (insert row)", &[(NONE, Key::U)]),
    (Action::SplitV, "Split patch in v (insert column)", &[(Modifiers::SHIFT, Key::U)]),
    (Action::SplitBoth, "Split patch into four", &[(CTRL, Key::U)]),
    (Action::Flatten, "Flatten control points", &[(Modifiers::SHIFT, Key::P)]),
    (Action::Smooth, "Smooth control points", &[(Modifiers::SHIFT, Key::S)]),
    (Action::ResetPoints, "Reset control points", &[(Modifiers::SHIFT, Key::R)]),
    (Action::ToggleTangents, "Keep tangents across seams", &[(NONE, Key::G)]),
    (Action::NextMirror, "Mirror symmetry", &[(NONE, Key::M)]),
    (Action::ConvertToPatches, "Convert to patches", &[]),
    (Action::Thicken, "Thicken to a closed body", &[]),
    (Action::MirrorCopyX, "Mirror copy in x", &[]),
    (Action::MirrorCopyY, "Mirror copy in y", &[]),
    (Action::MirrorCopyZ, "Mirror copy in z", &[]),
    (Action::TogglePause, "Pause or resume", &[(NONE, Key::Space)]),
    (Action::Restart, "Restart rendering", &[(NONE, Key::R)]),
    (Action::Fit, "Fit picture", &[(NONE, Key::F), (CTRL, Key::Num0)]),
    (Action::OneToOne, "Actual pixels", &[(CTRL, Key::Num1)]),
    (Action::ZoomIn, "Zoom in", &[(CTRL, Key::Plus), (CTRL, Key::Equals)]),
    (Action::ZoomOut, "Zoom out", &[(CTRL, Key::Minus)]),
    (Action::Brighter, "Increase exposure by half a stop", &[(NONE, Key::E)]),
    (Action::Darker, "Decrease exposure by half a stop", &[(Modifiers::SHIFT, Key::E)]),
    (Action::View(NamedView::Selection), "Frame selection", &[(NONE, Key::Period)]),
    (Action::View(NamedView::All), "Frame all", &[(NONE, Key::Home)]),
    (Action::View(NamedView::From(Side::Front)), "View from the front", &[(NONE, Key::Num1)]),
    (Action::View(NamedView::From(Side::Right)), "View from the right", &[(NONE, Key::Num3)]),
    (Action::View(NamedView::From(Side::Top)), "View from above", &[(NONE, Key::Num7)]),
    (Action::View(NamedView::From(Side::Opposite)), "View from the opposite side", &[(NONE, Key::Num9)]),
    (Action::View(NamedView::Own), "Scene's own view", &[(NONE, Key::Num0)]),
    (Action::View(NamedView::Previous), "Previous view", &[(Modifiers::ALT, Key::ArrowLeft)]),
    (Action::View(NamedView::Next), "Next view", &[(Modifiers::ALT, Key::ArrowRight)]),
    (Action::Navigate, "Navigate with the mouse", &[(NONE, Key::V)]),
    (Action::LookAround, "Look around", &[(NONE, Key::L)]),
    (Action::UseView, "Use as camera", &[]),
    (Action::MatchWindow, "Match window", &[(NONE, Key::W)]),
    (Action::ToggleSmoothing, "Smooth interreflection", &[(NONE, Key::N)]),
    (Action::ToggleHandles, "Show handles", &[(NONE, Key::H)]),
    (Action::ToggleXRay, "Show hidden handles (X-ray)", &[(Modifiers::ALT, Key::Z)]),
    (Action::ToggleIsolines, "Show isolines", &[(CTRL, Key::K)]),
    (Action::ToggleZebra, "Show reflection lines (zebra)", &[(CTRL_SHIFT, Key::K)]),
    (Action::ToggleMeanCurvature, "Show mean curvature", &[(NONE, Key::K)]),
    (Action::ToggleGaussianCurvature, "Show Gaussian curvature", &[(Modifiers::SHIFT, Key::K)]),
    (Action::ToggleLightPaths, "Show light paths", &[(Modifiers::ALT, Key::K)]),
    (Action::ToggleIrradiance, "Show irradiance", &[(NONE, Key::Q)]),
    (Action::DrawProfile, "Draw the line of a profile", &[(NONE, Key::P)]),
    (Action::ExportProfile, "Export profile…", &[]),
    (Action::TakeSnapshot, "Take snapshot", &[(NONE, Key::T)]),
    (Action::OpenReference, "Open reference picture…", &[]),
    (Action::CompareFlip, "Flip to the snapshot", &[(NONE, Key::C)]),
    (Action::CompareSplit, "Compare side by side", &[(Modifiers::SHIFT, Key::C)]),
    (Action::CompareDifference, "Show the difference", &[(NONE, Key::D)]),
    (Action::TogglePanels, "Show panels", &[(CTRL, Key::B)]),
    (Action::FullScreen, "Full screen", &[(NONE, Key::F11)]),
    (Action::Palette, "Find a command…", &[(CTRL, Key::P)]),
    (Action::Help, "Keys and mouse", &[(NONE, Key::F1)]),
    (Action::ToggleGuide, "Guide", &[(Modifiers::SHIFT, Key::F1)]),
];

impl Action {
    /// The action's label in menus.
    pub(crate) fn label(self) -> &'static str {
        TABLE.iter().find(|(action, ..)| *action == self).map_or("", |(_, label, _)| label)
    }

    /// What the action does, for its tooltip; empty where the label says it.
    pub(crate) fn tip(self) -> &'static str {
        match self {
            Self::ExportShown => "A PNG as the screen shows the picture: with less noise, where it is smoothed",
            Self::CopyPicture => "The picture as the screen shows it, to paste into another program",
            Self::ExportDeep => "A PNG with 16 bits per channel, for further editing",
            Self::SplitU | Self::SplitV | Self::SplitBoth => {
                "Halves the shown patch exactly, and with it the whole strip of patches across, so that seams stay closed. \
                 The surface stays the same."
            }
            Self::Flatten => {
                "Moves the selected control points, or all of the shown patch, into the plane nearest to them"
            }
            Self::Smooth => {
                "Moves the selected control points, or all of the shown patch, half the way to the mean of their \
                 neighbours. Corners of the surface stay."
            }
            Self::ResetPoints => {
                "Moves the selected control points, or all of the shown patch, onto the bilinear surface of the patch's \
                 corners"
            }
            Self::ToggleTangents => {
                "Keeps smooth seams smooth (G1): the neighbours of a moved control point across the seam follow it"
            }
            Self::ToggleIsolines => "Lines of constant u and v on the selected surface, at quarters of each patch",
            Self::ToggleMeanCurvature => {
                "The mean of the principal curvatures of the selected surface, positive where it bends towards its outside"
            }
            Self::ToggleGaussianCurvature => {
                "The product of the principal curvatures of the selected surface: positive on bowls, negative on saddles"
            }
            Self::ToggleZebra => {
                "Stripes that the selected surface reflects: a kink in a stripe is a crease, a corner a jump of curvature"
            }
            Self::ToggleLightPaths => {
                "Where the selected surface of mirror or glass sends light: images of its lines of equal u and v, the edges of the \
                 caustic, and ways of light. Relief counts as flat."
            }
            Self::ToggleSmoothing => {
                "Takes noise out of the interreflection that the screen shows while the picture has few photons. The picture itself, \
                 exports and the error estimate stay as they are."
            }
            Self::ToggleIrradiance => "The irradiance of matte surfaces in false colours with isolines, W/m²",
            Self::DrawProfile => {
                "The next drag over the picture draws a line, along which a plot shows the numbers of the view"
            }
            Self::ExportProfile => "The numbers along the line of the profile as a table",
            Self::TakeSnapshot => "Keeps the picture and its scene, to compare with them and to go back to them",
            Self::OpenReference => "A picture of an OpenEXR file, to compare with",
            Self::CompareFlip => "Shows the chosen snapshot in place of the picture, and back",
            Self::CompareSplit => "The chosen snapshot to the right of a line that the pointer drags",
            Self::CompareDifference => {
                "False colours: blue where the picture is darker than the snapshot, red where it is brighter; with RMSE, relMSE and FLIP"
            }
            Self::ToggleGuide => {
                "Ten minutes from the first start to a caustic of your own, and a section for each task"
            }
            Self::ConvertToPatches => {
                "Replaces the surface of revolution by its patches, whose control points can then be moved one by one"
            }
            Self::Thicken => {
                "Closes the sheet to a body: with a copy on its inside at a twentieth of its size, and walls along the border"
            }
            Self::MirrorCopyX | Self::MirrorCopyY | Self::MirrorCopyZ => {
                "Adds the mirror image of the selected object or light, across the plane of the world's other two axes"
            }
            Self::NextMirror => "Moves control points in pairs, mirrored across a plane: off, x, y, z in turn",
            _ => "",
        }
    }

    /// The action's first shortcut as text; empty for an action without a shortcut.
    pub(crate) fn shortcut(self, ctx: &Context) -> String {
        self.shortcuts(ctx).into_iter().next().unwrap_or_default()
    }

    /// All shortcuts of the action as text.
    pub(crate) fn shortcuts(self, ctx: &Context) -> Vec<String> {
        let keys = TABLE.iter().find(|(action, ..)| *action == self).map_or(&[][..], |(.., keys)| keys);
        keys.iter().map(|(modifiers, key)| ctx.format_shortcut(&KeyboardShortcut::new(*modifiers, *key))).collect()
    }

    /// Every action, in the order of the help.
    pub(crate) fn all() -> impl Iterator<Item = Self> {
        TABLE.iter().map(|(action, ..)| *action)
    }
}

fn blocked_by(action: Action, modifiers: Modifiers, key: Key) -> BlockedBy {
    let function_key = matches!(key, Key::F1 | Key::F11);
    match action {
        Action::Undo | Action::Redo | Action::SelectAll | Action::SelectNone => BlockedBy::Text,
        _ if modifiers.command || function_key => BlockedBy::Nothing,
        _ => BlockedBy::AnyFocus,
    }
}

/// All shortcuts with their actions, those with Shift or Alt first: egui's `consume_shortcut` ignores Shift and Alt where a
/// shortcut does not ask for them.
fn shortcuts() -> impl Iterator<Item = (Action, Modifiers, Key)> {
    let all =
        || TABLE.iter().flat_map(|(action, _, keys)| keys.iter().map(|(modifiers, key)| (*action, *modifiers, *key)));
    let with_more = |more: bool| all().filter(move |(_, modifiers, _)| (modifiers.shift || modifiers.alt) == more);
    with_more(true).chain(with_more(false))
}

/// The actions whose shortcuts were pressed in this frame. Widgets do not see these key presses.
pub(crate) fn pressed(ctx: &Context) -> Vec<Action> {
    let (text, focus) = (ctx.text_edit_focused(), ctx.egui_wants_keyboard_input());
    let mut actions = Vec::new();
    for (action, modifiers, key) in shortcuts() {
        let blocked = match blocked_by(action, modifiers, key) {
            BlockedBy::Nothing => false,
            BlockedBy::Text => text,
            BlockedBy::AnyFocus => focus,
        };
        if !blocked && ctx.input_mut(|input| input.consume_shortcut(&KeyboardShortcut::new(modifiers, key))) {
            actions.push(action);
        }
    }
    actions
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shortcuts_are_unique() {
        let mut seen = std::collections::HashSet::new();
        for (action, _, keys) in TABLE {
            for key in *keys {
                assert!(seen.insert(*key), "{key:?} of {action:?} is taken");
            }
        }
    }

    #[test]
    fn each_shortcut_performs_its_action_alone() {
        for (action, modifiers, key) in shortcuts() {
            let ctx = Context::default();
            let event = egui::Event::Key { key, physical_key: None, pressed: true, repeat: false, modifiers };
            let input = egui::RawInput { events: vec![event], ..Default::default() };
            let mut found = Vec::new();
            ctx.run_ui(input, |ui| found.extend(pressed(ui.ctx()))).textures_delta.clear();
            assert_eq!(found, [action], "{modifiers:?} {key:?}");
        }
    }

    #[test]
    fn the_simple_action_stands_before_its_variant() {
        let row = |wanted| Action::all().position(|action| action == wanted).unwrap();
        for (simple, variant) in [
            (Action::Save, Action::SaveAs),
            (Action::Export, Action::ExportShown),
            (Action::Export, Action::ExportSurface),
            (Action::Undo, Action::Redo),
            (Action::SelectAll, Action::SelectNone),
            (Action::SplitU, Action::SplitBoth),
        ] {
            assert!(row(simple) < row(variant), "{simple:?}");
        }
    }
}
