//! New objects, lights, materials and textures, for "Add", "Duplicate" and "New scene".

use super::edit::Edit;
use super::handles::{Handle, translate_emitter, translate_shape};
use super::kinds::{MODEL_KINDS, emitter_of_size, model_like};
use super::names::free_name;
use super::placement::{facing, fitted, plane_below, way_to_copy};
use super::selection::Item;
use crate::geometry::Sphere;
use crate::geometry::bezier::ControlNet;
use crate::math::Rgb;
use crate::scene::{
    Bezier, Color, Emitter, Encoding, Light, Location, Material, MaterialModel, Object, Revolution, Scene, Shape,
    Texture, Transform,
};
use glam::{DVec2, DVec3};
use std::array;
use std::path::Path;
use std::sync::Arc;

/// Where a new sun shines from: high, and aside, so that shadows show.
const NEW_SUN: DVec3 = DVec3::new(0.4, 0.8, 0.3);
/// Half the side of a new patch or quad, and the radius of a new sphere, over the radius of the ball that holds it: the
/// corners of a square lie on the ball.
const HALF_SIDE: f64 = std::f64::consts::FRAC_1_SQRT_2;
/// The radius of a new lamp over the radius of the ball that holds it.
const LAMP: f64 = 0.5;

/// An object or light of the menus "Add to Objects" and "Add to Lights".
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum NewItem {
    Patch,
    PatchGrid,
    Revolution,
    Sphere,
    Quad,
    Plane,
    PointLight,
    SphereLight,
    QuadLight,
    Sun,
    Beam,
}

impl NewItem {
    /// The entries of the menu "Add to Objects".
    pub(crate) const OBJECTS: [Self; 6] =
        [Self::Patch, Self::PatchGrid, Self::Revolution, Self::Sphere, Self::Quad, Self::Plane];
    /// The entries of the menu "Add to Lights".
    pub(crate) const LIGHTS: [Self; 5] = [Self::PointLight, Self::SphereLight, Self::QuadLight, Self::Sun, Self::Beam];

    /// The name in menus, and of the new item.
    pub(crate) fn label(self) -> &'static str {
        match self {
            Self::Patch => "patch",
            Self::PatchGrid => "grid of patches",
            Self::Revolution => "surface of revolution",
            Self::Sphere => "sphere",
            Self::Quad => "quad",
            Self::Plane => "plane",
            Self::PointLight => "point light",
            Self::SphereLight => "sphere light",
            Self::QuadLight => "quad light",
            Self::Sun => "sun",
            Self::Beam => "beam",
        }
    }

    /// Whether it is a light.
    pub(crate) fn is_light(self) -> bool {
        Self::LIGHTS.contains(&self)
    }

    /// The edit that adds the item inside of `room`, a ball without other items, so that its upper side is seen from `eye`. A
    /// plane lies below that ball.
    pub(crate) fn added(self, scene: &Scene, room: &Sphere, eye: DVec3) -> Edit {
        let turned = Transform { translate: room.center, rotate: facing(room.center, eye), ..Transform::default() };
        let shape = match self {
            Self::Patch => Shape::Bezier(sheet(turned, HALF_SIDE * room.radius)),
            Self::PatchGrid => Shape::Bezier(flat_grid(turned, HALF_SIDE * room.radius)),
            Self::Revolution => Shape::Revolution(vase(room, turned.rotate.y)),
            Self::Sphere => Shape::Sphere { center: room.center, radius: HALF_SIDE * room.radius },
            Self::Quad => {
                let side = 2.0 * HALF_SIDE * room.radius;
                let turn = turned.world_from_object().matrix3;
                let (edge_u, edge_v) = (side * turn.x_axis, -side * turn.z_axis);
                Shape::Quad { corner: room.center - 0.5 * (edge_u + edge_v), edge_u, edge_v }
            }
            Self::Plane => plane_below(scene, room),
            Self::PointLight => return self.added_light(scene, room, "point"),
            Self::SphereLight => return self.added_light(scene, room, "sphere"),
            Self::QuadLight => return self.added_light(scene, room, "quad"),
            Self::Sun => return self.added_light(scene, &Sphere { center: NEW_SUN, ..*room }, "sun"),
            Self::Beam => return self.added_light(scene, room, "beam"),
        };
        Edit::AddObject(object(scene, self.label(), shape))
    }

    fn added_light(self, scene: &Scene, room: &Sphere, kind: &str) -> Edit {
        let point = Emitter::Point { position: room.center, intensity: Rgb::ONE };
        let emitter = emitter_of_size(&point, kind, LAMP * room.radius);
        Edit::AddLight(Light { name: light_name(scene, self.label()), emitter })
    }
}

/// The materials of the menu "Add to Materials", by their labels.
pub(crate) fn models() -> [(&'static str, MaterialModel); 5] {
    let grey = MaterialModel::Diffuse { albedo: Color::Constant(Rgb::splat(0.6)) };
    MODEL_KINDS.map(|kind| (kind, model_like(&grey, kind)))
}

/// A new object of the scene's first material, under a free name made from `name`.
pub(crate) fn object(scene: &Scene, name: &str, shape: Shape) -> Object {
    let material = scene.materials.first().map_or(String::new(), |material| material.name.clone());
    Object { name: object_name(scene, name), material, shape, body: None }
}

/// A new material under a free name made from `kind`.
pub(crate) fn material(scene: &Scene, kind: &str, model: MaterialModel) -> Material {
    Material { name: material_name(scene, kind), model, relief: None }
}

/// A new sRGB texture of an image file, under a free name made from the file's name.
///
/// # Errors
/// Returns a message when the file is no PNG or JPEG image.
pub(crate) fn texture(scene: &Scene, path: &Path) -> Result<Texture, String> {
    let file = absolute(path);
    Location::Unsaved.check_picture(&file)?;
    let name = free_name(scene, Item::Texture(scene.textures.len()), &stem(path, "texture"));
    Ok(Texture { name, file, encoding: Encoding::Srgb })
}

/// A new object of the patches in a `.bpt` file, under a free name made from the file's name. Its transform
/// brings the patches into `room`, a ball.
///
/// # Errors
/// Returns a message when the file cannot be read or parsed.
pub(crate) fn surface(scene: &Scene, path: &Path, room: &Sphere) -> Result<Object, String> {
    let file = absolute(path);
    let patches = Arc::new(Location::Unsaved.read_patches(&file)?);
    let bezier = Bezier { transform: fitted(&patches, room), patches, file: Some(file), uv: None };
    Ok(object(scene, &stem(path, "patches"), Shape::Bezier(bezier)))
}

/// The file's name without its extension; `otherwise` where the path has no file name.
fn stem(path: &Path, otherwise: &str) -> String {
    path.file_stem().map_or_else(|| otherwise.to_owned(), |stem| stem.to_string_lossy().into_owned())
}

/// The absolute path. Saving the scene makes a path below the scene's folder relative to that folder.
fn absolute(path: &Path) -> String {
    std::path::absolute(path).unwrap_or_else(|_| path.to_owned()).display().to_string()
}

/// The edit that adds a copy of an item under a free name, beside the item; `None` for textures, the camera and the settings.
pub(crate) fn duplicate(scene: &Scene, item: Item) -> Option<Edit> {
    Some(match item {
        Item::Object(index) => {
            let mut copy = scene.objects.get(index)?.clone();
            copy.name = object_name(scene, &copy.name);
            translate_shape(&mut copy.shape, way_to_copy_of(scene, Handle::Object(index)));
            Edit::AddObject(copy)
        }
        Item::Light(index) => {
            let mut copy = scene.lights.get(index)?.clone();
            copy.name = light_name(scene, &copy.name);
            translate_emitter(&mut copy.emitter, way_to_copy_of(scene, Handle::Light(index)));
            Edit::AddLight(copy)
        }
        Item::Material(index) => {
            let original = scene.materials.get(index)?;
            Edit::AddMaterial(Material { name: material_name(scene, &original.name), ..original.clone() })
        }
        Item::Nothing | Item::Camera | Item::Settings | Item::Texture(_) => return None,
    })
}

/// The way from an item to its copy. The copy of a plane must leave the plane, so it goes along the normal.
fn way_to_copy_of(scene: &Scene, original: Handle) -> DVec3 {
    let Some(from) = original.position(scene) else { return DVec3::ZERO };
    let way = way_to_copy(scene, from);
    match original {
        Handle::Object(index) => match &scene.objects[index].shape {
            Shape::Plane { normal, .. } => way.length() * normal.normalize_or_zero(),
            _ => way,
        },
        Handle::Light(_) | Handle::Point { .. } => way,
    }
}

/// The scene of "New scene": a curved patch over a ground plane, lit by a point light.
pub(crate) fn empty_scene() -> Scene {
    let mut scene = Scene { name: "new scene".to_owned(), ..Scene::default() };
    scene.camera.position = DVec3::new(0.0, 1.2, 3.8);
    scene.materials = vec![material(&scene, "white", model_like(&models()[0].1, "diffuse"))];
    scene.lights = vec![Light {
        name: "lamp".to_owned(),
        emitter: Emitter::Point { position: DVec3::new(0.5, 1.8, 0.5), intensity: Rgb::splat(3.0) },
    }];
    let ground = Shape::Plane { point: DVec3::new(0.0, -0.6, 0.0), normal: DVec3::Y, u_axis: None };
    let named = |name: &str, shape| Object { name: name.to_owned(), material: "white".to_owned(), shape, body: None };
    scene.objects = vec![named("ground", ground), named("sheet", Shape::Bezier(sheet(Transform::default(), 0.7)))];
    scene
}

/// A gently curved patch with sides of length `2 half`, around the origin of the object's space.
fn sheet(transform: Transform, half: f64) -> Bezier {
    let along = |k: usize| half * (2.0 * k as f64 / 3.0 - 1.0);
    let lift = |i: usize, j: usize| if (1..3).contains(&i) && (1..3).contains(&j) { 0.6 * half } else { 0.0 };
    let points = array::from_fn(|i| array::from_fn(|j| DVec3::new(along(j), lift(i, j), along(i))));
    Bezier { transform, patches: Arc::new(vec![ControlNet { points }]), file: None, uv: None }
}

/// Flat patches side by side, 2 along each side of a square with sides of length `2 half` around the origin of the object's space.
fn flat_grid(transform: Transform, half: f64) -> Bezier {
    // Patches that share an edge compute its control points from the same numbers.
    let along = |k: usize| half * (k as f64 / 3.0 - 1.0);
    let net = |patch: usize| {
        let (row, column) = (3 * (patch / 2), 3 * (patch % 2));
        let at = |i: usize, j: usize| DVec3::new(along(column + j), 0.0, along(row + i));
        ControlNet { points: array::from_fn(|i| array::from_fn(|j| at(i, j))) }
    };
    Bezier { transform, patches: Arc::new((0..4).map(net).collect()), file: None, uv: None }
}

/// A vase inside of a ball, turned about y by an angle in degrees, so that its profile lies across the line of sight. The profile
/// goes up, with its outside away from the axis.
fn vase(room: &Sphere, turn: f64) -> Revolution {
    // All points lie within a radius of 1.
    let outline = [(0.45, -0.8), (0.8, -0.35), (0.6, 0.1), (0.3, 0.3), (0.15, 0.4), (0.25, 0.7), (0.45, 0.8)];
    let profile = outline.map(|point| room.radius * DVec2::from(point)).to_vec();
    let transform = Transform { translate: room.center, rotate: DVec3::new(0.0, turn, 0.0), ..Transform::default() };
    Revolution::new(transform, profile, 360.0, false)
}

fn object_name(scene: &Scene, wanted: &str) -> String {
    free_name(scene, Item::Object(scene.objects.len()), wanted)
}

fn light_name(scene: &Scene, wanted: &str) -> String {
    free_name(scene, Item::Light(scene.lights.len()), wanted)
}

fn material_name(scene: &Scene, wanted: &str) -> String {
    free_name(scene, Item::Material(scene.materials.len()), wanted)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::SceneFile;

    #[test]
    fn new_planes_do_not_coincide() {
        let (mut scene, room) = (empty_scene(), Sphere { center: DVec3::new(0.0, 0.4, 0.0), radius: 1.0 });
        for _ in 0..3 {
            NewItem::Plane.added(&scene, &room, scene.camera.position).apply(&mut scene);
        }
        let heights: Vec<f64> = scene
            .objects
            .iter()
            .filter_map(|object| match &object.shape {
                Shape::Plane { point, .. } => Some(point.y),
                _ => None,
            })
            .collect();
        let near = |a: f64| heights.iter().filter(|b| (a - **b).abs() < 0.1).count();
        assert!(heights.len() == 4 && heights.iter().all(|&height| near(height) == 1), "{heights:?}");
    }

    #[test]
    fn new_patches_and_quads_are_seen_from_above_at_an_angle() {
        let (scene, room) = (empty_scene(), Sphere { center: DVec3::new(0.3, 0.4, 0.1), radius: 0.8 });
        let eyes = [(0.0, 0.0, 5.0), (4.0, 0.4, -3.0), (0.3, 6.0, 0.1), (-2.0, 1.5, 0.0), (1.0, -1.0, 2.0)];
        for eye in eyes.map(DVec3::from) {
            let shape = |new: NewItem| match new.added(&scene, &room, eye) {
                Edit::AddObject(object) => object.shape,
                edit => panic!("{edit:?}"),
            };
            let Shape::Quad { corner, edge_u, edge_v } = shape(NewItem::Quad) else { panic!("a quad") };
            let Shape::Bezier(bezier) = shape(NewItem::Patch) else { panic!("a patch") };
            let normals = [edge_u.cross(edge_v), bezier.transform.world_from_object().matrix3.y_axis];
            let way = (eye - room.center).normalize();
            let sines = normals.map(|normal| normal.normalize().dot(way));
            assert!(sines.iter().all(|sine| *sine > 0.5), "seen from {eye}: {sines:?}");
            let center = corner + 0.5 * (edge_u + edge_v);
            // Sums of numbers below 1.
            assert!(center.distance(room.center) < 1e-14 && bezier.transform.translate == room.center);
        }
    }

    #[test]
    fn a_new_grid_is_flat_and_its_patches_share_edges() {
        let grid = flat_grid(Transform::default(), 0.7);
        let mut corners: Vec<_> = grid.patches.iter().flat_map(|net| net.points.into_iter().flatten()).collect();
        assert!(corners.iter().all(|at| at.y == 0.0 && at.abs().max_element() <= 0.7));
        corners.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.z.total_cmp(&b.z)));
        corners.dedup();
        assert_eq!(corners.len(), 7 * 7, "equal to the last bit");
        let up = grid.patches.iter().map(|net| net.derivatives(0.5, 0.5)).map(|d| d.dpdu.cross(d.dpdv).y);
        assert!(up.into_iter().all(|y| y > 0.0), "the outside is above");
    }

    #[test]
    fn a_new_surface_of_revolution_lies_in_its_ball() {
        let room = Sphere { center: DVec3::new(0.3, 0.4, 0.1), radius: 0.8 };
        let vase = vase(&room, 30.0);
        let nets = vase.surface().placed_nets();
        let points = nets.iter().flat_map(|net| net.points.into_iter().flatten());
        let farthest = points.map(|point| point.distance(room.center)).fold(0.0, f64::max);
        assert!(farthest < room.radius && farthest > 0.8 * room.radius, "{farthest}");
    }

    #[test]
    fn a_patch_seen_from_above_lies_flat() {
        assert_eq!(facing(DVec3::ZERO, DVec3::new(1.0, 2.0, 1.0)), DVec3::ZERO);
    }

    #[test]
    fn copies_lie_beside_the_others() {
        let mut scene = SceneFile::built_in("report").unwrap().scene;
        let mut places = vec![Handle::Object(0).position(&scene).unwrap()];
        for _ in 0..3 {
            let copied = duplicate(&scene, Item::Object(0)).unwrap();
            copied.apply(&mut scene);
            places.push(Handle::Object(scene.objects.len() - 1).position(&scene).unwrap());
        }
        let near = |a: &DVec3| places.iter().filter(|b| a.distance(**b) < 0.01).count();
        assert!(places.iter().all(|place| near(place) == 1), "{places:?}");
    }

    #[test]
    fn a_copied_plane_is_another_plane() {
        let scene = empty_scene();
        let Some(Edit::AddObject(copy)) = duplicate(&scene, Item::Object(0)) else { panic!("a copy of the ground") };
        let Shape::Plane { point, normal, .. } = copy.shape else { panic!("a plane") };
        assert!((point.dot(normal) + 0.6).abs() > 0.01, "{point} lies off the ground at y = -0.6");
    }
}
