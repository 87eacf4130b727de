//! Corrections of egui's handling of keys.

use egui::{Context, Event, Key, Plugin, RawInput};

/// Installs the corrections.
pub(crate) fn install(ctx: &Context) {
    // Ctrl with plus and minus zooms the picture. Under a dialog egui would take these keys to scale the interface.
    ctx.options_mut(|options| options.zoom_with_keyboard = false);
    ctx.add_plugin(TabApart::default());
}

/// Gives Tab and typed text separate frames. egui moves the focus at the start of a frame, so a field would lose what the
/// user typed in the same frame before Tab.
#[derive(Default)]
struct TabApart {
    /// The events for the next frames.
    held: Vec<Event>,
}

impl Plugin for TabApart {
    fn debug_name(&self) -> &'static str {
        "tab apart"
    }

    fn input_hook(&mut self, ctx: &Context, input: &mut RawInput) {
        self.held.append(&mut input.events);
        let later = self.held.split_off(one_frame(&self.held));
        input.events = std::mem::replace(&mut self.held, later);
        if !self.held.is_empty() {
            ctx.request_repaint();
        }
    }
}

/// How many of the first events share a frame.
fn one_frame(events: &[Event]) -> usize {
    let mut first = None;
    let apart = |event: &Event| match is_tab(event) {
        Some(tab) => *first.get_or_insert(tab) != tab,
        None => false,
    };
    events.iter().position(apart).unwrap_or(events.len())
}

/// Whether the event presses Tab; `None` for an event that neither moves the focus nor edits text.
fn is_tab(event: &Event) -> Option<bool> {
    match event {
        Event::Key { key, pressed: true, .. } => Some(*key == Key::Tab),
        Event::Text(_) | Event::Paste(_) | Event::Cut | Event::Ime(_) => Some(false),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use egui::Modifiers;

    fn tab() -> Event {
        Event::Key { key: Key::Tab, physical_key: None, pressed: true, repeat: false, modifiers: Modifiers::NONE }
    }

    #[test]
    fn tab_and_text_share_no_frame() {
        let text = || Event::Text("5".to_owned());
        assert_eq!(one_frame(&[text(), text(), tab(), text()]), 2);
        assert_eq!(one_frame(&[tab(), Event::PointerGone, text()]), 2);
        assert_eq!(one_frame(&[text(), Event::PointerGone]), 2);
        assert_eq!(one_frame(&[]), 0);
    }
}
