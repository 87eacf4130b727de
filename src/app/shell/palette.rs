//! The command palette: finds every action, item and example by parts of its name.

use crate::app::commands::{Action, AppCommand, Next, Purpose};
use crate::app::document::{Edit, Item, NewItem, Selection, new_items};
use crate::scene::{Scene, built_in_scenes};
use egui::{Button, Context, Key, Modifiers, ScrollArea, TextEdit, ThemePreference, Ui};

/// The text and the chosen entry of the open palette.
#[derive(Clone, Debug, PartialEq, Default)]
pub(crate) struct Palette {
    query: String,
    /// The chosen entry among those that the query finds.
    chosen: usize,
}

/// An entry of the palette: what Enter does.
struct Entry {
    label: String,
    shortcut: String,
    command: AppCommand,
}

impl Palette {
    /// The field and the entries that it finds. Enter or a click runs an entry, and closes the palette.
    pub(crate) fn ui(&mut self, ui: &mut Ui, scene: &Scene, commands: &mut Vec<AppCommand>) {
        let found: Vec<_> =
            entries(ui.ctx(), scene).into_iter().filter(|entry| finds(&self.query, &entry.label)).collect();
        let moved = self.move_choice(ui, found.len());
        let field = TextEdit::singleline(&mut self.query)
            .hint_text("Type a part of a command's name")
            .desired_width(f32::INFINITY);
        let field = ui.add(field).accessible_name("Command");
        if field.changed() {
            self.chosen = 0;
        }
        let entered = field.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
        field.request_focus();
        ui.add_space(4.0);
        let mut run = found.get(self.chosen).filter(|_| entered).map(|entry| entry.command.clone());
        ScrollArea::vertical().max_height(320.0).min_scrolled_height(320.0).auto_shrink(false).show(ui, |ui| {
            for (index, entry) in found.iter().enumerate() {
                let is_chosen = index == self.chosen;
                let mut button = Button::selectable(is_chosen, &entry.label);
                if !entry.shortcut.is_empty() {
                    button = button.shortcut_text(&entry.shortcut);
                }
                let row = egui::vec2(ui.available_width(), ui.spacing().interact_size.y);
                let response = ui.add(button.truncate().min_size(row));
                if is_chosen && moved {
                    response.scroll_to_me(None);
                }
                if response.clicked() {
                    run = Some(entry.command.clone());
                }
            }
            if found.is_empty() {
                ui.weak("Nothing has this name");
            }
        });
        if let Some(command) = run {
            // First, because the command may open another dialog.
            commands.extend([AppCommand::CloseDialog, command]);
        }
    }

    /// Moves the choice among `count` entries by the arrow keys. Returns whether it moved.
    fn move_choice(&mut self, ui: &Ui, count: usize) -> bool {
        let pressed = |key| ui.input_mut(|input| input.consume_key(Modifiers::NONE, key));
        let (down, up) = (pressed(Key::ArrowDown), pressed(Key::ArrowUp));
        let last = count.saturating_sub(1);
        let before = self.chosen;
        self.chosen = match (down, up) {
            (true, false) if before >= last => 0,
            (true, false) => before + 1,
            (false, true) => before.checked_sub(1).unwrap_or(last),
            _ => before.min(last),
        };
        down != up
    }
}

/// Whether a label has every word of the query, in any order and case.
fn finds(query: &str, label: &str) -> bool {
    let label = label.to_lowercase();
    query.to_lowercase().split_whitespace().all(|word| label.contains(word))
}

/// Everything that the palette offers, actions first.
fn entries(ctx: &Context, scene: &Scene) -> Vec<Entry> {
    let plain = |label: String, command| Entry { label, shortcut: String::new(), command };
    let actions = Action::all().filter(|action| *action != Action::Palette).map(|action| Entry {
        label: action.label().to_owned(),
        shortcut: action.shortcut(ctx),
        command: AppCommand::Do(action),
    });
    let items =
        items(scene).map(|(name, item)| plain(format!("Select {name}"), AppCommand::Select(Selection::of(item))));
    let new = NewItem::OBJECTS.into_iter().chain(NewItem::LIGHTS);
    let new = new.map(|new| plain(format!("Add {}", new.label()), AppCommand::Add(new)));
    let materials = new_items::models().into_iter().map(|(label, model)| {
        let add = Edit::AddMaterial(new_items::material(scene, label, model));
        plain(format!("Add material {label}"), AppCommand::Edit(add))
    });
    let files = [
        ("Add patches from a file (.bpt, .obj, .pov, .rib)…", Purpose::AddSurface),
        ("Add texture from a PNG or JPEG file…", Purpose::AddTexture),
    ];
    let files = files.map(|(label, purpose)| plain(label.to_owned(), AppCommand::AddFrom(purpose)));
    let examples = built_in_scenes().iter().map(|example| {
        plain(format!("Open example {}", example.title), AppCommand::Leave(Next::Example(example.name)))
    });
    let themes = [ThemePreference::Dark, ThemePreference::Light, ThemePreference::System]
        .into_iter()
        .zip(["Dark theme", "Light theme", "Theme of the system"])
        .map(|(theme, label)| plain(label.to_owned(), AppCommand::Theme(theme)));
    actions.chain(themes).chain(items).chain(new).chain(materials).chain(files).chain(examples).collect()
}

/// The items of a scene with their names.
fn items(scene: &Scene) -> impl Iterator<Item = (&str, Item)> {
    let objects = scene.objects.iter().enumerate().map(|(index, object)| (object.name.as_str(), Item::Object(index)));
    let lights = scene.lights.iter().enumerate().map(|(index, light)| (light.name.as_str(), Item::Light(index)));
    let materials =
        scene.materials.iter().enumerate().map(|(index, material)| (material.name.as_str(), Item::Material(index)));
    let textures =
        scene.textures.iter().enumerate().map(|(index, texture)| (texture.name.as_str(), Item::Texture(index)));
    [("camera", Item::Camera), ("picture and rendering", Item::Settings)]
        .into_iter()
        .chain(objects)
        .chain(lights)
        .chain(materials)
        .chain(textures)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn everything_that_the_outline_adds_is_found() {
        let entries = entries(&Context::default(), &Scene::default());
        let has = |query: &str, wanted: fn(&AppCommand) -> bool| {
            entries.iter().any(|entry| finds(query, &entry.label) && wanted(&entry.command))
        };
        assert!(has("add patch", |command| *command == AppCommand::Add(NewItem::Patch)));
        assert!(has("bpt", |command| *command == AppCommand::AddFrom(Purpose::AddSurface)));
        assert!(has("add texture", |command| *command == AppCommand::AddFrom(Purpose::AddTexture)));
        assert!(has("add glass", |command| matches!(command, AppCommand::Edit(Edit::AddMaterial(_)))));
    }

    #[test]
    fn words_are_found_in_any_order() {
        assert!(finds("", "Save as…") && finds("as SAV", "Save as…"));
        assert!(!finds("save x", "Save as…"));
    }
}
