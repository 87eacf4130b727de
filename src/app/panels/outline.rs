//! The list of all items in the scene.

use super::icons::{self, Icon};
use super::presets::presets_ui;
use crate::app::commands::{Action, AppCommand, Purpose};
use crate::app::document::{Document, Edit, Item, NewItem, Selection, kinds, new_items};
use egui::{Align, Atom, Button, CollapsingHeader, IdSalt, Layout, Response, Ui, UiBuilder, Vec2};

/// Spacing between rows, screen points: small, so that all sections fit in the panel.
const SPACING: f32 = 1.0;

/// A collapsible section of the list.
struct Section {
    title: &'static str,
    /// Whether the section starts open.
    open: bool,
    item: fn(usize) -> Item,
    /// What the section lists.
    tip: &'static str,
    /// What the button "+ Add" does.
    add_tip: &'static str,
}

const OBJECTS: Section = Section {
    title: "Objects",
    open: true,
    item: Item::Object,
    tip: "The surfaces of the scene",
    add_tip: "Add an object where the camera looks",
};
const LIGHTS: Section = Section {
    title: "Lights",
    open: true,
    item: Item::Light,
    tip: "What shines in the scene",
    add_tip: "Add a light where the camera looks",
};
const MATERIALS: Section = Section {
    title: "Materials",
    open: false,
    item: Item::Material,
    tip: "How surfaces scatter light",
    add_tip: "Add a material, which objects can then have",
};
const TEXTURES: Section = Section {
    title: "Textures",
    open: false,
    item: Item::Texture,
    tip: "Images that materials use",
    add_tip: "Add an image, which materials can then use",
};

/// What a row shows of an item.
struct Label<'a> {
    name: &'a str,
    /// The kind of the item, or what it is.
    kind: &'static str,
    icon: Icon,
}

/// The scene as a list; a click selects an item.
pub(crate) fn outline_ui(ui: &mut Ui, document: &Document, commands: &mut Vec<AppCommand>) {
    ui.spacing_mut().item_spacing.y = SPACING;
    row_ui(
        ui,
        document,
        Item::Camera,
        &Label { name: "Camera", kind: "Where the scene is seen from", icon: Icon::Camera },
        commands,
    );
    let settings = Label {
        name: "Picture and rendering",
        kind: "Size of the picture, exposure, bounces, background",
        icon: Icon::Settings,
    };
    row_ui(ui, document, Item::Settings, &settings, commands);
    objects_ui(ui, document, commands);
    lights_ui(ui, document, commands);
    materials_ui(ui, document, commands);
    textures_ui(ui, document, commands);
}

fn objects_ui(ui: &mut Ui, document: &Document, commands: &mut Vec<AppCommand>) {
    let scene = document.scene();
    let objects = scene.objects.iter().map(|object| Label {
        name: &object.name,
        kind: kinds::shape_kind(&object.shape),
        icon: Icon::of_shape(&object.shape),
    });
    section_ui(ui, &OBJECTS, objects, document, commands, |ui, commands| {
        add_buttons_ui(ui, NewItem::OBJECTS, commands);
        if ui.button("patches from a file…").clicked() {
            commands.push(AppCommand::AddFrom(Purpose::AddSurface));
        }
    });
}

/// A button for each of the new items.
fn add_buttons_ui(ui: &mut Ui, new: impl IntoIterator<Item = NewItem>, commands: &mut Vec<AppCommand>) {
    for new in new {
        if ui.button(new.label()).clicked() {
            commands.push(AppCommand::Add(new));
        }
    }
}

fn lights_ui(ui: &mut Ui, document: &Document, commands: &mut Vec<AppCommand>) {
    let scene = document.scene();
    let lights = scene.lights.iter().map(|light| Label {
        name: &light.name,
        kind: kinds::emitter_kind(&light.emitter),
        icon: Icon::of_emitter(&light.emitter),
    });
    section_ui(ui, &LIGHTS, lights, document, commands, |ui, commands| {
        add_buttons_ui(ui, NewItem::LIGHTS, commands);
    });
}

fn materials_ui(ui: &mut Ui, document: &Document, commands: &mut Vec<AppCommand>) {
    let scene = document.scene();
    let materials = scene.materials.iter().map(|material| Label {
        name: &material.name,
        kind: kinds::model_kind(&material.model),
        icon: Icon::of_model(&material.model),
    });
    section_ui(ui, &MATERIALS, materials, document, commands, |ui, commands| {
        for (label, model) in new_items::models() {
            if ui.button(label).clicked() {
                commands.push(AppCommand::Edit(Edit::AddMaterial(new_items::material(scene, label, model))));
            }
        }
        if let Some(preset) = ui.menu_button("presets", presets_ui).inner.flatten() {
            let material = new_items::material(scene, preset.name, preset.model.clone());
            commands.push(AppCommand::Edit(Edit::AddMaterial(material)));
        }
    });
}

fn textures_ui(ui: &mut Ui, document: &Document, commands: &mut Vec<AppCommand>) {
    let textures = document.scene().textures.iter().map(|texture| Label {
        name: &texture.name,
        kind: kinds::encoding_kind(texture.encoding),
        icon: Icon::Texture,
    });
    section_ui(ui, &TEXTURES, textures, document, commands, |ui, commands| {
        if ui.button("from a PNG or JPEG file…").clicked() {
            commands.push(AppCommand::AddFrom(Purpose::AddTexture));
        }
    });
}

/// A section with its entries, and a button "+ Add" that opens the menu `add_ui`.
fn section_ui<'a>(
    ui: &mut Ui,
    section: &Section,
    entries: impl ExactSizeIterator<Item = Label<'a>>,
    document: &Document,
    commands: &mut Vec<AppCommand>,
    add_ui: impl FnOnce(&mut Ui, &mut Vec<AppCommand>),
) {
    let header = format!("{} ({})", section.title, entries.len());
    let fold = CollapsingHeader::new(header).id_salt(section.title).default_open(section.open);
    let fold = fold.show(ui, |ui| {
        for (index, label) in entries.enumerate() {
            row_ui(ui, document, (section.item)(index), &label, commands);
        }
    });
    // The button stands at the right end of the header's row.
    let row = fold.header_response.on_hover_text(section.tip).rect.with_max_x(ui.max_rect().right());
    let builder = UiBuilder::new().max_rect(row).layout(Layout::right_to_left(Align::Center));
    let add = ui.new_child(builder).menu_button("+ Add", |ui| add_ui(ui, commands)).response;
    add.on_hover_text(section.add_tip).accessible_name(format!("Add to {}", section.title));
}

/// The row of an item: a click selects it, a right click opens its menu.
fn row_ui(ui: &mut Ui, document: &Document, item: Item, label: &Label<'_>, commands: &mut Vec<AppCommand>) {
    let response = label_ui(ui, document.selection.item == item, label);
    if response.clicked() || response.secondary_clicked() {
        commands.push(AppCommand::Select(Selection::of(item)));
    }
    if !matches!(item, Item::Camera | Item::Settings) {
        response.context_menu(|ui| {
            let copy = (!matches!(item, Item::Texture(_))).then_some(Action::Duplicate);
            for action in copy.into_iter().chain([Action::Delete]) {
                if ui.add(Button::new(action.label()).shortcut_text(action.shortcut(ui.ctx()))).clicked() {
                    commands.push(AppCommand::Do(action));
                }
            }
        });
    }
}

/// A button over the whole width with icon and name.
fn label_ui(ui: &mut Ui, selected: bool, label: &Label<'_>) -> Response {
    let icon = IdSalt::new("icon");
    let height = ui.spacing().interact_size.y;
    let button = Button::selectable(selected, (Atom::custom(icon, Vec2::splat(icons::SIZE)), label.name)).truncate();
    let button = button.min_size(Vec2::new(ui.available_width(), height)).atom_ui(ui);
    let color = ui.style().interact_selectable(&button.response, selected).text_color();
    if let Some(square) = button.rect(icon) {
        label.icon.paint(ui.painter(), square, color);
    }
    button.response.on_hover_text(label.kind)
}
