//! Fields for names, numbers, vectors and colours. Assistive technology and tests find each field by its name.

use super::glossary::{caption, explained, tip};
use super::typing::{self, Typing};
use crate::app::theme;
use crate::math::Rgb;
use crate::scene::{MAX_LENGTH, MAX_RADIANCE};
use egui::emath::Numeric;
use egui::{ComboBox, DragValue, Grid, Layout, Response, RichText, TextEdit, Ui, Vec2, vec2};
use glam::DVec3;
use std::ops::RangeInclusive;

/// Size of a number field, screen points: it fits the longest short number.
const FIELD_SIZE: Vec2 = vec2(60.0, 20.0);
/// Least width of the column of labels, screen points: the fields of all sections stand in line.
const LABEL_WIDTH: f32 = 76.0;
/// Width of the button with a colour, screen points.
const SWATCH_WIDTH: f32 = 24.0;
/// Digits that fit in a number field, before and after the decimal point together.
const DIGITS: usize = 5;

/// The range, unit and dragging speed of a number field.
#[derive(Clone, Debug)]
pub(super) struct Number {
    /// The unit after the field; empty for none.
    pub(super) unit: &'static str,
    /// Change per screen point of dragging.
    pub(super) speed: f64,
    pub(super) range: RangeInclusive<f64>,
    /// Least decimals; `None` for those of the speed.
    pub(super) decimals: Option<usize>,
    pub(super) tip: &'static str,
}

impl Number {
    /// A number of any sign, up to the largest coordinate of a valid scene.
    pub(super) fn any(speed: f64) -> Self {
        Self { unit: "", speed, range: -MAX_LENGTH..=MAX_LENGTH, decimals: None, tip: "" }
    }

    /// A number that cannot be negative.
    pub(super) fn positive(speed: f64) -> Self {
        Self::any(speed).within(0.0..=MAX_LENGTH)
    }

    /// A scale factor of either sign.
    pub(super) fn factor(speed: f64) -> Self {
        Self::any(speed).within(-1e6..=1e6)
    }

    /// The strength of a light, the background or an absorption coefficient.
    pub(super) fn strength(speed: f64) -> Self {
        Self::any(speed).within(0.0..=f64::from(MAX_RADIANCE))
    }

    pub(super) fn unit(self, unit: &'static str) -> Self {
        Self { unit, ..self }
    }

    pub(super) fn within(self, range: RangeInclusive<f64>) -> Self {
        Self { range, ..self }
    }

    pub(super) fn tip(self, tip: &'static str) -> Self {
        Self { tip, ..self }
    }

    /// The field's own tooltip, or the explanation of its name.
    fn tip_of(&self, name: &str) -> &'static str {
        if self.tip.is_empty() { tip(name) } else { self.tip }
    }
}

/// A grid of rows, each with a label and a field.
pub(super) fn rows(ui: &mut Ui, id: &str, content: impl FnOnce(&mut Ui)) {
    Grid::new(id).num_columns(2).min_col_width(LABEL_WIDTH).spacing([8.0, 5.0]).show(ui, content);
}

/// A number field without a label; assistive technology reads `name`.
///
/// All number fields have one width, so that dragging a handle never resizes a panel. A field shows its number rounded, and
/// with all digits while the user types.
pub(super) fn number(ui: &mut Ui, name: &str, value: &mut f64, spec: &Number) {
    let layout = Layout::centered_and_justified(ui.layout().main_dir());
    ui.allocate_ui_with_layout(FIELD_SIZE, layout, |ui| {
        let typing = Typing::of_next(ui, *value, spec.range.clone());
        let field = DragValue::new(value)
            .speed(spec.speed)
            .range(spec.range.clone())
            // A number of the scene file stays unchanged until the user edits it.
            .clamp_existing_to_range(false)
            .custom_formatter(|value, decimals| {
                let least = spec.decimals.unwrap_or(*decimals.start());
                if typing.is_active { value.to_string() } else { short(value, least) }
            })
            .custom_parser(|text| typing.read(text))
            .update_while_editing(false);
        let response = ui.add(field.clip_text(true)).accessible_name(name);
        let tip = spec.tip_of(name);
        response.on_hover_text(format!("{tip}\n{}", typing::HELP).trim_start());
        typing.end(ui.ctx(), name);
    });
    unit_ui(ui, spec.unit);
}

/// A field of a whole number without a label; assistive technology reads `name`.
pub(crate) fn count<N: Numeric>(
    ui: &mut Ui,
    name: &str,
    value: &mut N,
    range: RangeInclusive<N>,
    speed: f64,
) -> Response {
    let typing = Typing::of_next(ui, value.to_f64(), range.start().to_f64()..=range.end().to_f64());
    let field = DragValue::new(value).range(range).speed(speed).update_while_editing(false);
    let response = ui.add(field.custom_parser(|text| typing.read(text))).accessible_name(name);
    typing.end(ui.ctx(), name);
    response.on_hover_text(typing::HELP)
}

pub(super) fn unit_ui(ui: &mut Ui, unit: &str) {
    if !unit.is_empty() {
        ui.weak(unit);
    }
}

/// A number rounded to the digits that fit in a field.
fn short(value: f64, decimals: usize) -> String {
    // Products of directions are often -0.
    let value = if value == 0.0 { 0.0 } else { value };
    let size = value.abs();
    if value != 0.0 && !(1e-3..1e5).contains(&size) {
        return format!("{value:.1e}");
    }
    let before_point = if size < 1.0 { 1 } else { 1 + size.log10() as usize };
    let most = DIGITS.saturating_sub(before_point);
    egui::emath::format_with_decimals_in_range(value, decimals.min(most)..=most)
}

/// A row with a number.
pub(super) fn number_row(ui: &mut Ui, name: &str, value: &mut f64, spec: &Number) {
    caption(ui, name);
    ui.horizontal(|ui| number(ui, name, value, spec));
    ui.end_row();
}

/// A row with a vector.
pub(super) fn vector_row(ui: &mut Ui, name: &str, value: &mut DVec3, spec: &Number) {
    caption(ui, name);
    ui.horizontal(|ui| vector(ui, name, value, spec));
    ui.end_row();
}

/// Three number fields, labelled in the colours of the axes.
pub(super) fn vector(ui: &mut Ui, name: &str, value: &mut DVec3, spec: &Number) {
    let axes = theme::palette(ui.visuals().dark_mode).axes;
    ui.spacing_mut().item_spacing.x = 3.0;
    let tip = spec.tip_of(name);
    for (k, axis) in ["x", "y", "z"].into_iter().enumerate() {
        ui.label(RichText::new(axis).color(axes[k]));
        number(ui, &format!("{name} {axis}"), &mut value[k], &Number { unit: "", tip, ..spec.clone() });
    }
    unit_ui(ui, spec.unit);
}

/// A row with a reflectance: a colour with channels from 0 to 1.
pub(super) fn color_row(ui: &mut Ui, name: &str, value: &mut Rgb) {
    caption(ui, name);
    ui.horizontal(|ui| color(ui, name, value, &Number::any(0.005).within(0.0..=1.0)));
    ui.end_row();
}

/// A colour picker and three number fields, linear RGB.
pub(super) fn color(ui: &mut Ui, name: &str, value: &mut Rgb, spec: &Number) {
    ui.spacing_mut().item_spacing.x = 3.0;
    let mut picked = value.to_array();
    // Beside three fields the button is small, so that the last field is within the panel.
    ui.spacing_mut().interact_size.x = SWATCH_WIDTH;
    let response = ui.color_edit_button_rgb(&mut picked).accessible_name(format!("{name} colour"));
    if response.on_hover_text("Pick a colour (linear RGB)").changed() {
        *value = Rgb::from_array(picked);
    }
    let colors = theme::palette(ui.visuals().dark_mode).axes;
    for (k, channel) in ["red", "green", "blue"].into_iter().enumerate() {
        ui.label(RichText::new(&channel[..1]).color(colors[k]));
        let mut component = decimal(value[k]);
        number(ui, &format!("{name} {channel}"), &mut component, spec);
        if component as f32 != value[k] {
            value[k] = component as f32;
        }
    }
}

/// The f64 with the shortest decimal form of `value`: an f32 of 0.1 becomes an f64 of 0.1, not of 0.100000001.
fn decimal(value: f32) -> f64 {
    value.to_string().parse().unwrap_or_else(|_| f64::from(value))
}

/// Two rows for the intensity or radiance of the light `owner`: its largest channel, and a colour whose largest channel is 1.
/// The window remembers the colour of a light of strength 0.
pub(super) fn strength_row(ui: &mut Ui, name: &str, value: &mut Rgb, unit: &'static str, owner: &str) {
    let peak = value.max_element();
    caption(ui, name);
    let mut factor = decimal(peak);
    let speed = (0.01 * factor).max(0.001);
    let spec = Number::strength(speed).unit(unit).tip("The largest of the red, green and blue values");
    ui.horizontal(|ui| number(ui, name, &mut factor, &spec));
    ui.end_row();
    let remembered = ui.make_persistent_id(("colour", owner));
    let mut hue = match ui.data(|data| data.get_temp(remembered)) {
        _ if peak > 0.0 => *value / peak,
        hue => hue.unwrap_or(Rgb::ONE),
    };
    let before = hue;
    color_row(ui, "Colour", &mut hue);
    ui.data_mut(|data| data.insert_temp(remembered, hue));
    if hue != before || factor as f32 != peak {
        *value = hue * factor as f32;
    }
}

/// A row with a text field. The text takes effect on Enter or when the field loses focus, so no half-typed name is used.
pub(super) fn text_row(ui: &mut Ui, name: &str, value: &mut String, owner: impl std::fmt::Debug) {
    caption(ui, name);
    let id = ui.make_persistent_id(format!("{name} {owner:?}"));
    let mut text = ui.data(|data| data.get_temp::<String>(id)).unwrap_or_else(|| value.clone());
    let response = ui.add(TextEdit::singleline(&mut text).id(id).desired_width(f32::INFINITY)).accessible_name(name);
    let response = explained(response, name);
    if response.has_focus() {
        ui.data_mut(|data| data.insert_temp(id, text));
    } else {
        if response.lost_focus() && !ui.input(|input| input.key_pressed(egui::Key::Escape)) && !text.trim().is_empty() {
            *value = text.trim().to_owned();
        }
        ui.data_mut(|data| data.remove::<String>(id));
    }
    ui.end_row();
}

/// A row with a choice among names.
pub(super) fn choice_row<'a>(ui: &mut Ui, name: &str, value: &mut String, choices: impl Iterator<Item = &'a str>) {
    caption(ui, name);
    choice(ui, name, value, choices);
    ui.end_row();
}

/// A choice among names.
pub(super) fn choice<'a>(ui: &mut Ui, name: &str, value: &mut String, choices: impl Iterator<Item = &'a str>) {
    let combo = ComboBox::from_id_salt(name).selected_text(value.as_str()).width(150.0).truncate();
    let response = combo.show_ui(ui, |ui| {
        for choice in choices {
            ui.selectable_value(value, choice.to_owned(), choice);
        }
    });
    explained(response.response.accessible_name(name), name);
}

/// A row with a choice among kinds; `Some` when the user chose another kind.
pub(super) fn kind_row<T: Copy>(ui: &mut Ui, name: &str, current: &str, kinds: &[(&'static str, T)]) -> Option<T> {
    caption(ui, name);
    let mut chosen = None;
    let combo = ComboBox::from_id_salt(name).selected_text(current).width(150.0);
    let response = combo.show_ui(ui, |ui| {
        for (label, kind) in kinds {
            if ui.selectable_label(*label == current, *label).clicked() && *label != current {
                chosen = Some(*kind);
            }
        }
    });
    explained(response.response.accessible_name(name), name);
    ui.end_row();
    chosen
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn short_numbers_fit_and_keep_their_magnitude() {
        let shown = [0.3, -0.188_712_345, 0.5, 36.0, 1234.5678, -98_765.4, 0.0, 1e12, -2.5e-5].map(|x| short(x, 3));
        assert_eq!(shown, ["0.300", "-0.1887", "0.500", "36.000", "1234.6", "-98765", "0.000", "1.0e12", "-2.5e-5"]);
        assert!(shown.iter().all(|text| text.len() <= 7), "{shown:?}");
        assert_eq!(short(-0.0, 3), "0.000");
    }

    #[test]
    fn a_channel_shows_the_typed_number() {
        for value in [0.1_f32, 1.0 / 3.0, 17.0, 0.0] {
            assert_eq!(decimal(value) as f32, value);
        }
        assert_eq!(decimal(0.1), 0.1);
    }
}
