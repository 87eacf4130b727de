//! The plot of a profile, and its line on the picture.

use super::profile::Profile;
use super::state::Inspection;
use crate::app::commands::{Action, AppCommand};
use crate::app::theme::{self, overlay};
use egui::{Color32, CursorIcon, Id, Pos2, Rect, Role, Sense, Stroke, Ui, WidgetInfo, Window};
use egui_plot::{Line, Plot, PlotPoints};

/// Width of the plot, screen points.
const PLOT_WIDTH: f32 = 340.0;

/// Shows the line of a profile over the picture, which lies in `picture` on the screen and has `film` pixels, and draws a new one if the user
/// asked for it. Call it after the widget of the canvas, over which it lies.
pub(crate) fn line_ui(
    ui: &Ui,
    inspection: &Inspection,
    picture: Rect,
    film: egui::Vec2,
    commands: &mut Vec<AppCommand>,
) {
    let to_film = |at: Pos2| ((at - picture.min) / picture.size() * film).to_pos2();
    let to_screen = |at: Pos2| picture.min + at.to_vec2() / film * picture.size();
    let canvas = ui.clip_rect();
    let mut shown = inspection.line.filter(|_| inspection.has_numbers()).map(|line| line.map(to_screen));
    if inspection.draws_line {
        let response = ui.interact(picture.intersect(canvas), Id::unique("profile line"), Sense::drag());
        response.widget_info(|| WidgetInfo::labeled(Role::Canvas, true, "Line of a profile"));
        ui.set_cursor_icon(CursorIcon::Crosshair);
        let begin = Id::unique("begin of the profile line");
        if response.drag_started()
            && let Some(at) = ui.input(|input| input.pointer.press_origin())
        {
            ui.data_mut(|data| data.insert_temp(begin, at));
        }
        let from = ui.data(|data| data.get_temp::<Pos2>(begin));
        shown = from.zip(response.interact_pointer_pos()).map(<[Pos2; 2]>::from);
        if response.drag_stopped()
            && let Some(line) = shown
        {
            ui.data_mut(|data| data.remove::<Pos2>(begin));
            commands.push(AppCommand::ProfileLine(Some(line.map(to_film))));
        }
    }
    if let Some(line) = shown {
        let painter = ui.painter_at(canvas);
        for (width, color) in [(4.0, overlay::OUTLINE), (1.5, overlay::HANDLE)] {
            painter.line_segment(line, Stroke::new(width, color));
        }
        for end in line {
            painter.circle(end, 4.0, overlay::HANDLE, Stroke::new(1.5, overlay::OUTLINE));
        }
    }
}

/// Shows the plot of the profile, if there is one, with a button that writes it as a table.
pub(crate) fn profile_ui(ui: &Ui, canvas: Rect, inspection: &Inspection, commands: &mut Vec<AppCommand>) {
    let Some(profile) = inspection.profile() else { return };
    let mut is_open = true;
    let title = format!("Profile: {}", inspection.view().label());
    Window::new(title)
        .id(Id::unique("profile"))
        .open(&mut is_open)
        .default_pos(canvas.right_top() + egui::vec2(-PLOT_WIDTH - 40.0, 10.0))
        .constrain_to(canvas)
        .show(ui.ctx(), |ui| {
            let color = theme::palette(ui.visuals().dark_mode).plot;
            plot_ui(ui, &profile, color);
            if ui.button("Export CSV…").clicked() {
                commands.push(AppCommand::Do(Action::ExportProfile));
            }
        });
    if !is_open {
        commands.push(AppCommand::ProfileLine(None));
    }
}

fn plot_ui(ui: &mut Ui, profile: &Profile, color: Color32) {
    let plot =
        Plot::new("profile").height(160.0).width(PLOT_WIDTH).allow_drag(false).allow_scroll(false).allow_zoom(false);
    plot.x_axis_label("pixels").include_y(0.0).show(ui, |plot| {
        // A line for each part with numbers.
        let points: Vec<[f64; 2]> = profile.points().collect();
        for part in points.split(|point| point[1].is_nan()).filter(|part| !part.is_empty()) {
            plot.line(Line::new("", PlotPoints::from(part.to_vec())).color(color));
        }
    });
}
