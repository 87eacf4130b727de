//! Typed numbers: relative numbers, and messages on texts that are no numbers.

use super::expression;
use egui::{Context, Id, Ui};
use std::cell::RefCell;
use std::ops::RangeInclusive;

/// What a number field takes, for its tooltip.
pub(super) const HELP: &str =
    "Drag, or type a number or a sum. +0.1 adds to the number, -=0.1 subtracts, *2 and /2 scale it; -3 sets it.";

/// Reads the text that the user types into one number field.
#[derive(Debug)]
pub(super) struct Typing {
    /// Whether the field has the keyboard.
    pub(super) is_active: bool,
    /// The number that typed text is relative to.
    present: f64,
    /// The numbers that the field takes.
    range: RangeInclusive<f64>,
    /// The message on the last text, if it is no number or beyond the range.
    refused: RefCell<Option<String>>,
}

impl Typing {
    /// Begins a frame of the field that comes next in `ui`, with its number.
    pub(super) fn of_next(ui: &Ui, number: f64, range: RangeInclusive<f64>) -> Self {
        let field = ui.next_auto_id();
        let (id, is_active) = (field.with("before typing"), ui.memory(|memory| memory.has_focus(field)));
        if is_active {
            ui.data_mut(|data| data.insert_temp(id, number));
        }
        // After Enter egui reads the text once more in the next frame, when its result is the field's number already. The number
        // of the last frame with the keyboard gives the result again.
        let present = ui.data(|data| data.get_temp(id)).unwrap_or(number);
        Self { is_active, present, range, refused: RefCell::default() }
    }

    /// The number that the text gives; `None` for text that is no number, and for a number beyond the range.
    pub(super) fn read(&self, text: &str) -> Option<f64> {
        let number = expression::typed(text, self.present);
        let (least, most) = (self.range.start(), self.range.end());
        let reason = match number {
            None => Some(format!("\"{text}\" is no number")),
            Some(number) if number > *most => Some(format!("{number} is too large, {most} is the most")),
            Some(number) if number < *least => Some(format!("{number} is too small, {least} is the least")),
            Some(_) => None,
        };
        let is_taken = reason.is_none();
        self.refused.replace(reason);
        number.filter(|_| is_taken)
    }

    /// Ends the frame of the field, with a message on a refused text.
    pub(super) fn end(self, ctx: &Context, field: &str) {
        // The text is read for the last time in the frame after the field had the keyboard.
        if let Some(reason) = self.refused.into_inner().filter(|_| !self.is_active) {
            let message = format!("{reason}. {field} keeps its value.");
            ctx.data_mut(|data| data.get_temp_mut_or_default::<Vec<String>>(refusals_id()).push(message));
        }
    }
}

/// A field has no other way to the window than its value, so the window collects the messages of all fields.
fn refusals_id() -> Id {
    Id::unique("refused texts")
}

/// The messages on texts that number fields refused since the last call.
pub(crate) fn refusals(ctx: &Context) -> Vec<String> {
    ctx.data_mut(|data| data.remove_temp(refusals_id())).unwrap_or_default()
}
