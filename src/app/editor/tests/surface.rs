use super::*;
use crate::app::document::PointIndex;
use crate::app::document::surface::{Cut, split};
use crate::math::{Ray, Rgb};
use crate::scene::{Bezier, Color, Location, MaterialModel, Relief, Shape, TextureUse};
use crate::world::{Surface, prepare};
use glam::{DVec2, DVec3};

fn object(ui: &Ui) -> usize {
    let Item::Object(object) = ui.state().document.selection.item else { panic!("an object is selected") };
    object
}

fn bezier(ui: &Ui) -> Bezier {
    ui.state().document.selection.bezier(scene(ui)).unwrap().clone()
}

fn point(ui: &Ui, patch: usize, i: usize, j: usize) -> DVec3 {
    bezier(ui).patches[patch].points[i][j]
}

/// The number of different positions of control points.
fn positions(ui: &Ui) -> usize {
    Welds::of(&bezier(ui)).groups().len()
}

/// Clicks an entry of the menu "Surface"; the label of an entry ends with its shortcut.
fn choose(ui: &mut Ui, entry: &str) {
    click(ui, "Surface");
    ui.get_by(|node| node.role() == Role::Button && node.label().is_some_and(|label| label.starts_with(entry))).click();
    ui.run_steps(3);
}

#[test]
fn several_points_show_their_centre_and_move_by_typed_numbers() {
    let mut ui = open("report");
    click(&mut ui, "P[1][1]");
    for name in ["P[1][2]", "P[2][2]"] {
        ui.get_by_role_and_label(Role::Button, name).click_modifiers(Modifiers::COMMAND);
        ui.run_steps(3);
    }
    assert!(ui.query_by_label("Centre of 3 points").is_some(), "the title");
    let before = bezier(&ui).patches[0];
    let moved = [(1, 1), (1, 2), (2, 2)];
    let center = moved.iter().map(|(i, j)| before.points[*i][*j].z).sum::<f64>() / 3.0;
    type_number(&mut ui, "Position z", "0.25");
    for (i, j) in (0..16).map(|k| (k / 4, k % 4)) {
        let by = if moved.contains(&(i, j)) { DVec3::Z * (0.25 - center) } else { DVec3::ZERO };
        // Coordinates below 1, once rounded.
        assert!(point(&ui, 0, i, j).distance(before.points[i][j] + by) < 1e-15, "P[{i}][{j}]");
    }
    assert_eq!(ui.state().document.undoable(), Some("move control points of sheet"));
    type_number(&mut ui, "Position z", "+0.5");
    assert!((point(&ui, 0, 1, 1).z - (before.points[1][1].z + 0.75 - center)).abs() < 1e-15, "a relative number");
    ui.get_by_role_and_label(Role::Button, "P[1][2]").click_modifiers(Modifiers::SHIFT);
    ui.run_steps(3);
    assert!(ui.query_by_label("Centre of 2 points").is_some(), "Shift removes a point");
}

#[test]
fn a_split_keeps_the_surface_and_closes_every_seam() {
    let mut ui = open("teapot");
    let before = bezier(&ui);
    click(&mut ui, "P[1][1]");
    choose(&mut ui, "Split patch in u");
    let after = bezier(&ui);
    assert!(after.patches.len() > before.patches.len() + 1, "the strip is split");
    assert!(ui.state().document.selection.points.is_empty(), "other points have the indices now");
    assert_eq!(ui.state().document.undoable(), Some("split patch of teapot"));
    assert_eq!(after.file, None, "a .bpt file would hold other patches");
    let area = |bezier: &Bezier| bezier.patches.iter().map(|net| net.area()).sum::<f64>();
    // The quadrature is good to about a millionth, and better on smaller patches.
    assert!((area(&after) / area(&before) - 1.0).abs() < 1e-4, "{} is not {}", area(&after), area(&before));
    press(&mut ui, Key::Z);
    assert_eq!(bezier(&ui), before);
}

/// Reflectance and shading normal where rays from the camera to these points meet the scene.
fn texture_seen(scene: &Scene, targets: &[DVec3]) -> Vec<(Rgb, DVec3)> {
    let world = prepare(scene, &Location::BuiltIn("report".to_owned()), None).unwrap();
    let points = targets.iter().filter_map(|target| {
        let ray = Ray::between(world.camera.position, world.camera.position + 2.0 * (*target - world.camera.position));
        let point = world.surface_point(&ray, world.closest_hit(&ray)?);
        let (scattering, normal) = world.scattering(&point, 0);
        Some((scattering.albedo, normal))
    });
    points.collect()
}

#[test]
fn a_split_keeps_texture_and_relief() {
    let mut scene = SceneFile::built_in("report").unwrap().scene;
    let textured = |name: &str| TextureUse { texture: name.to_owned(), scale: DVec2::new(2.0, 1.5) };
    let reliefs = [
        None,
        Some(Relief::Normal { map: textured("bricks-normal"), strength: 1.0 }),
        Some(Relief::Height { map: textured("face"), depth: 0.05 }),
    ];
    scene.objects.retain(|object| matches!(object.shape, Shape::Bezier(_)));
    scene.objects.truncate(1);
    scene.materials.truncate(1);
    scene.objects[0].material.clone_from(&scene.materials[0].name);
    let Shape::Bezier(whole) = scene.objects[0].shape.clone() else { panic!("a surface of patches") };
    let (nets, place) = (whole.placed_nets(), |k: usize| (0.037 * k as f64) % 1.0);
    let targets: Vec<_> = (0..800).map(|k| nets[0].eval(place(k), place(17 * k + 5))).collect();
    for relief in reliefs {
        scene.materials[0].model = MaterialModel::Diffuse { albedo: Color::Texture(textured("face")) };
        scene.materials[0].relief = relief;
        let before = texture_seen(&scene, &targets);
        let mut parted = scene.clone();
        parted.objects[0].shape = Shape::Bezier(split(&split(&whole, 0, Cut::Both), 0, Cut::U));
        let after = texture_seen(&parted, &targets);
        assert_eq!((before.len(), after.len()), (800, 800), "each ray meets the surface");
        // A ray meets the halves up to 1e-9 of the patch elsewhere; a texel is a hundredth.
        let equal = before.iter().zip(&after).filter(|(a, b)| (a.0 - b.0).length() < 1e-4 && a.1.distance(b.1) < 1e-4);
        assert_eq!(equal.count(), before.len(), "{:?}", scene.materials[0].relief);
        let Shape::Bezier(surface) = &mut parted.objects[0].shape else { panic!("a surface of patches") };
        surface.uv = None;
        let repeated = texture_seen(&parted, &targets);
        let changed = before.iter().zip(&repeated).filter(|(a, b)| (a.0 - b.0).length() > 0.01);
        assert!(changed.count() > 50, "without texture coordinates the texture repeats");
    }
}

#[test]
fn keys_split_the_strips_of_the_shown_patch_with_a_message() {
    let mut ui = open("report");
    press(&mut ui, Key::U);
    assert_eq!((bezier(&ui).patches.len(), positions(&ui)), (4, 49));
    assert_eq!(ui.state().toasts.len(), 1, "the message");
    for (modifiers, patches) in [(Modifiers::NONE, 6), (Modifiers::SHIFT, 9)] {
        ui.key_press_modifiers(modifiers, Key::U);
        ui.run_steps(3);
        assert_eq!(bezier(&ui).patches.len(), patches, "U splits the strip of the shown patch");
    }
}

#[test]
fn a_split_surface_stays_one_sheet_for_the_renderer() {
    let mut ui = open("report");
    press(&mut ui, Key::U);
    ui.key_press(Key::U);
    ui.run_steps(3);
    let file = Arc::clone(ui.state().document.file());
    let world = prepare(&file.scene, &file.location, None).unwrap();
    let index = object(&ui) as u32;
    let mut sides = Vec::new();
    let mut shared_edges = 0;
    for surface in &world.surfaces {
        if let Surface::Object { object, front_side, shared, .. } = surface
            && *object == index
        {
            sides.push(*front_side);
            shared_edges += shared.u.iter().chain(&shared.v).filter(|is_shared| **is_shared).count();
        }
    }
    assert_eq!(sides, vec![sides[0]; 6], "one smooth sheet, seen from one side");
    assert_eq!(shared_edges, 2 * 7, "3 x 2 patches have seven seams");
}

#[test]
fn flatten_smooth_and_reset_are_edits_with_names() {
    let mut ui = open("report");
    for (entry, name) in [
        ("Smooth control points", "smooth points"),
        ("Flatten control points", "flatten points"),
        ("Reset control points", "reset points"),
    ] {
        let before = bezier(&ui);
        choose(&mut ui, entry);
        assert_ne!(bezier(&ui), before, "{entry} changes the patch");
        assert_eq!(ui.state().document.undoable(), Some(format!("{name} of sheet").as_str()));
        press(&mut ui, Key::Z);
        assert_eq!(bezier(&ui), before, "one step reverts it");
    }
    click(&mut ui, "P[1][1]");
    let before = scene(&ui).clone();
    choose(&mut ui, "Flatten control points");
    assert_eq!((scene(&ui) == &before, ui.state().toasts.len()), (true, 1), "a point is flat, with a message");
}

#[test]
fn operations_on_patches_need_patches() {
    let mut ui = open("report");
    let ball = first_object(&ui, |shape| matches!(shape, Shape::Sphere { .. }));
    select(&mut ui, Item::Object(ball));
    let before = scene(&ui).clone();
    ui.key_press(Key::U);
    ui.run_steps(2);
    assert_eq!((scene(&ui) == &before, ui.state().toasts.len()), (true, 1));
}

#[test]
fn tangents_across_a_seam_are_kept_where_wanted() {
    let mut ui = open("report");
    ui.key_press(Key::U);
    ui.run_steps(3);
    let straight = |ui: &Ui| {
        let [a, seam, b] = [point(ui, 0, 2, 1), point(ui, 0, 3, 1), point(ui, 1, 1, 1)];
        (a - seam).normalize().cross((b - seam).normalize()).length()
    };
    assert!(straight(&ui) < 1e-12, "a split is smooth");
    click(&mut ui, "P[2][1]");
    type_number(&mut ui, "Position y", "+0.2");
    assert!(straight(&ui) > 0.1, "a point alone makes a crease");
    press(&mut ui, Key::Z);
    ui.key_press(Key::G);
    ui.run_steps(2);
    assert!(ui.state().document.coupling.tangents, "G switches the tangents on");
    type_number(&mut ui, "Position y", "+0.2");
    // The legs have lengths of about 0.1.
    assert!(straight(&ui) < 1e-12, "{}", straight(&ui));
    click(&mut ui, "P[3][1]");
    let neighbour = point(&ui, 1, 1, 1);
    type_number(&mut ui, "Position y", "+0.1");
    assert!((point(&ui, 1, 1, 1) - neighbour).distance(0.1 * DVec3::Y) < 1e-12, "neighbours move with the seam");
}

#[test]
fn points_move_in_mirrored_pairs() {
    let mut ui = open("report");
    choose(&mut ui, "Reset control points");
    // The corners of a square patch around the origin of the object.
    let object = object(&ui);
    let half = [-1.5, -0.5, 0.5, 1.5];
    let place = |k: usize| (PointIndex { patch: 0, i: k / 4, j: k % 4 }, DVec3::new(half[k / 4], 0.0, half[k % 4]));
    let square = crate::app::document::Edit::Place(object, (0..16).map(place).collect(), "move control points");
    ui.state_mut().document.edit(square);
    ui.run_steps(2);
    ui.key_press(Key::M);
    ui.run_steps(3);
    assert!(ui.query_by_label("16 of 16 positions have a mirror image").is_some());
    click(&mut ui, "P[3][1]");
    type_number(&mut ui, "Position x", "2");
    assert_eq!((point(&ui, 0, 3, 1).x, point(&ui, 0, 0, 1).x), (2.0, -2.0));
    type_number(&mut ui, "Mirror plane", "7");
    type_number(&mut ui, "Position x", "3");
    assert_eq!(point(&ui, 0, 0, 1).x, -2.0, "no point has a mirror image in another plane");
    for _ in 0..3 {
        ui.key_press(Key::M);
        ui.run_steps(2);
    }
    assert_eq!(ui.state().document.coupling.mirror, None, "M goes through the axes");
}
