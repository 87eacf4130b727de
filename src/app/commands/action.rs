//! What menus, buttons and keys do: one table for all of them, and for the help.

use egui::{Context, Key, KeyboardShortcut, Modifiers};

/// A command without parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Action {
    New,
    Open,
    Save,
    SaveAs,
    Export,
    ExportSurface,
    Quit,
    Undo,
    Redo,
    Duplicate,
    Delete,
    TogglePause,
    Restart,
    Fit,
    OneToOne,
    ZoomIn,
    ZoomOut,
    Brighter,
    Darker,
    ToggleHandles,
    TogglePanels,
    FullScreen,
    Help,
}

/// What may not have the keyboard for a shortcut to work.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Yields {
    /// Works always.
    Never,
    /// A text field has its own meaning for it.
    ToText,
    /// Every focused widget has: plain letters, the space bar.
    ToFocus,
}

const CTRL: Modifiers = Modifiers::COMMAND;
const CTRL_SHIFT: Modifiers = Modifiers::COMMAND.plus(Modifiers::SHIFT);
const NONE: Modifiers = Modifiers::NONE;

type Keys = &'static [(Modifiers, Key)];
type Row = (Action, &'static str, Keys);

/// Action, what it is called, its keys; of keys that differ in Shift alone, the one with Shift first.
const TABLE: &[Row] = &[
    (Action::New, "New scene", &[(CTRL, Key::N)]),
    (Action::Open, "Open…", &[(CTRL, Key::O)]),
    (Action::SaveAs, "Save as…", &[(CTRL_SHIFT, Key::S)]),
    (Action::Save, "Save", &[(CTRL, Key::S)]),
    (Action::ExportSurface, "Export surface…", &[(CTRL_SHIFT, Key::E)]),
    (Action::Export, "Export picture…", &[(CTRL, Key::E)]),
    (Action::Quit, "Quit", &[(CTRL, Key::Q)]),
    (Action::Redo, "Redo", &[(CTRL_SHIFT, Key::Z), (CTRL, Key::Y)]),
    (Action::Undo, "Undo", &[(CTRL, Key::Z)]),
    (Action::Duplicate, "Duplicate", &[(CTRL, Key::D)]),
    (Action::Delete, "Delete", &[(NONE, Key::Delete)]),
    (Action::TogglePause, "Pause or resume", &[(NONE, Key::Space)]),
    (Action::Restart, "Restart", &[(NONE, Key::R)]),
    (Action::Fit, "Fit picture", &[(NONE, Key::F), (CTRL, Key::Num0)]),
    (Action::OneToOne, "Actual pixels", &[(CTRL, Key::Num1)]),
    (Action::ZoomIn, "Zoom in", &[(CTRL, Key::Plus), (CTRL, Key::Equals)]),
    (Action::ZoomOut, "Zoom out", &[(CTRL, Key::Minus)]),
    (Action::Darker, "Half a stop darker", &[(Modifiers::SHIFT, Key::E)]),
    (Action::Brighter, "Half a stop brighter", &[(NONE, Key::E)]),
    (Action::ToggleHandles, "Show handles", &[(NONE, Key::H)]),
    (Action::TogglePanels, "Show panels", &[(CTRL, Key::B)]),
    (Action::FullScreen, "Full screen", &[(NONE, Key::F11)]),
    (Action::Help, "Keys and mouse", &[(NONE, Key::F1)]),
];

impl Action {
    /// What it is called in menus.
    pub(crate) fn label(self) -> &'static str {
        TABLE.iter().find(|(action, ..)| *action == self).map_or("", |(_, label, _)| label)
    }

    /// Its first key, as text; empty where it has none.
    pub(crate) fn shortcut(self, ctx: &Context) -> String {
        self.shortcuts(ctx).into_iter().next().unwrap_or_default()
    }

    /// All its keys, as text.
    pub(crate) fn shortcuts(self, ctx: &Context) -> Vec<String> {
        let keys = TABLE.iter().find(|(action, ..)| *action == self).map_or(&[][..], |(.., keys)| keys);
        keys.iter().map(|(modifiers, key)| ctx.format_shortcut(&KeyboardShortcut::new(*modifiers, *key))).collect()
    }

    /// Every action, in the order of the help.
    pub(crate) fn all() -> impl Iterator<Item = Self> {
        TABLE.iter().map(|(action, ..)| *action)
    }
}

fn yields(action: Action, modifiers: Modifiers, key: Key) -> Yields {
    let function_key = matches!(key, Key::F1 | Key::F11);
    match action {
        Action::Undo | Action::Redo => Yields::ToText,
        _ if modifiers.command || function_key => Yields::Never,
        _ => Yields::ToFocus,
    }
}

/// The actions whose keys were pressed; takes those keys away from the widgets.
pub(crate) fn pressed(ctx: &Context) -> Vec<Action> {
    let (text, focus) = (ctx.text_edit_focused(), ctx.egui_wants_keyboard_input());
    let mut actions = Vec::new();
    for (action, _, keys) in TABLE {
        for (modifiers, key) in *keys {
            let blocked = match yields(*action, *modifiers, *key) {
                Yields::Never => false,
                Yields::ToText => text,
                Yields::ToFocus => focus,
            };
            if !blocked && ctx.input_mut(|input| input.consume_shortcut(&KeyboardShortcut::new(*modifiers, *key))) {
                actions.push(*action);
            }
        }
    }
    actions
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_key_is_taken_twice() {
        let mut seen = std::collections::HashSet::new();
        for (action, _, keys) in TABLE {
            for key in *keys {
                assert!(seen.insert(*key), "{key:?} of {action:?} is taken");
            }
        }
    }

    #[test]
    fn the_key_with_shift_comes_first() {
        let place = |wanted| TABLE.iter().position(|(action, ..)| *action == wanted).unwrap();
        assert!(place(Action::SaveAs) < place(Action::Save), "consume_shortcut ignores Shift that was not asked for");
        assert!(
            place(Action::ExportSurface) < place(Action::Export),
            "consume_shortcut ignores Shift that was not asked for"
        );
        assert!(place(Action::Redo) < place(Action::Undo), "consume_shortcut ignores Shift that was not asked for");
        assert!(
            place(Action::Darker) < place(Action::Brighter),
            "consume_shortcut ignores Shift that was not asked for"
        );
    }
}
