//! Free space in the picture, where new items go: a ball that the camera sees whole. Knows no widget.

use super::picking::Surfaces;
use super::projection::Projection;
use crate::app::document::Handle;
use crate::geometry::{Primitive, Quad, Sphere};
use crate::math::{OrthonormalBasis, Ray};
use crate::scene::{Emitter, Scene};
use glam::{DVec2, DVec3};
use std::f64::consts::TAU;

/// Part of the picture that an item is meant for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Aim {
    /// The middle: for objects.
    Middle,
    /// Above the middle, and smaller: for lights.
    Above,
}

/// Radii to try for an object, over the smaller side of the picture.
const OBJECT_RADII: [f64; 5] = [0.25, 0.18, 0.12, 0.08, 0.05];
/// Radii to try for a light, over the smaller side of the picture.
const LIGHT_RADII: [f64; 4] = [0.12, 0.09, 0.06, 0.04];
/// Height of a light's place above the middle, over the picture's height.
const ABOVE: f64 = 0.3;
/// Places to try lie on a grid with this step over the picture's width and height, up to as many steps to each side.
const GRID: (f64, i32) = (0.09, 5);
/// Free share of the way to the nearest surface in the cone around a ball.
const CLEAR: f64 = 0.95;
/// Cones are tested, and kept inside of the picture, with this factor: rays on a circle leave gaps, and a margin looks better.
const MARGIN: f64 = 1.06;
/// Half the gap between neighbouring rays in a cone, over the cone's radius.
const GAP: f64 = 0.15;
/// A place this much nearer than the usual depth hides what is seen there, so that other places come first.
const NEAR: f64 = 0.7;
/// The smallest and the largest usual depth, over the median distance of the surfaces in the picture.
const DEPTHS: (f64, f64) = (0.25, 0.9);

/// A ball that lies inside of the picture, in front of all surfaces seen there, and that holds no light: near the part of
/// the picture that `aim` names, at the depth of the camera's target or before the surface behind, as large as a moderate
/// part of the picture. Around the target where the camera has no direction.
pub(crate) fn free_ball(scene: &Scene, surfaces: &Surfaces, aim: Aim) -> Sphere {
    let otherwise = Sphere { center: scene.camera.target, radius: 0.5 };
    let Some(view) = View::new(scene, surfaces) else { return otherwise };
    let radii: &[f64] = if aim == Aim::Middle { &OBJECT_RADII } else { &LIGHT_RADII };
    let (places, usual) = (view.places(aim), view.usual_depth());
    let balls = radii.iter().flat_map(|radius| places.iter().map(|place| (*place, *radius)));
    let mut widest: Option<Sphere> = None;
    for (place, radius) in balls {
        let Some(ball) = view.ball(place, radius, usual) else { continue };
        if ball.center.distance(scene.camera.position) >= NEAR * usual {
            return ball;
        }
        if widest.is_none_or(|widest| widest.radius < ball.radius) {
            widest = Some(ball);
        }
    }
    widest.unwrap_or_else(|| view.ball_at(view.direction(places[0]), view.sine(radii[radii.len() - 1]), usual))
}

/// What the camera sees, for rays.
struct View<'a> {
    projection: Projection,
    position: DVec3,
    target_distance: f64,
    /// Width and height of the film, pixels.
    size: DVec2,
    /// Unit normals of the planes through the picture's sides, inwards.
    sides: [DVec3; 4],
    surfaces: &'a Surfaces,
    /// The lights that the camera sees.
    lamps: Vec<Primitive>,
    /// The centres of lights, which no ball may hold.
    lights: Vec<DVec3>,
    /// The centres of objects, which no ball may lie around: rays may miss an object that they meet from the side.
    objects: Vec<DVec3>,
}

impl<'a> View<'a> {
    /// `None` for a camera or a film without a view.
    fn new(scene: &Scene, surfaces: &'a Surfaces) -> Option<Self> {
        let projection = Projection::new(&scene.camera, &scene.film)?;
        let size = DVec2::new(f64::from(scene.film.width), f64::from(scene.film.height));
        let toward = |x: f64, y: f64| projection.ray(size * DVec2::new(x, y)).direction;
        let corners = [toward(0.0, 0.0), toward(1.0, 0.0), toward(1.0, 1.0), toward(0.0, 1.0)];
        let inwards = |k: usize| {
            let normal = corners[k].cross(corners[(k + 1) % 4]).try_normalize()?;
            Some(if normal.dot(toward(0.5, 0.5)) < 0.0 { -normal } else { normal })
        };
        Some(Self {
            sides: [inwards(0)?, inwards(1)?, inwards(2)?, inwards(3)?],
            projection,
            position: scene.camera.position,
            target_distance: scene.camera.position.distance(scene.camera.target),
            size,
            surfaces,
            lamps: scene.lights.iter().filter_map(|light| lamp(&light.emitter)).collect(),
            lights: (0..scene.lights.len()).filter_map(|light| Handle::Light(light).position(scene)).collect(),
            objects: (0..scene.objects.len()).filter_map(|object| Handle::Object(object).position(scene)).collect(),
        })
    }

    /// Points of the film, the wanted one first, then by their distance from it.
    fn places(&self, aim: Aim) -> Vec<DVec2> {
        let up = if aim == Aim::Above { ABOVE } else { 0.0 };
        let wanted = DVec2::new(0.5, 0.5 - up) * self.size;
        let (step, count) = GRID;
        let steps = |k: i32| step * f64::from(k);
        let offsets = (-count..=count).flat_map(|y| (-count..=count).map(move |x| DVec2::new(steps(x), steps(y))));
        let mut places: Vec<_> = offsets.map(|offset| (DVec2::splat(0.5) + offset) * self.size).collect();
        places.sort_by(|a, b| a.distance(wanted).total_cmp(&b.distance(wanted)));
        places.insert(0, wanted);
        places
    }

    /// The direction of the camera ray through a film point, of length 1.
    fn direction(&self, film: DVec2) -> DVec3 {
        self.projection.ray(film).direction
    }

    /// The sine of the angle under which a ball in the middle of the picture has this radius, over the picture's smaller side.
    fn sine(&self, radius: f64) -> f64 {
        let tangent = radius * self.size.min_element() / self.projection.pixels_per_unit(1.0);
        tangent / (1.0 + tangent * tangent).sqrt()
    }

    /// Distance of the nearest surface along a direction; `None` where nothing is seen.
    fn distance(&self, direction: DVec3) -> Option<f64> {
        let ray = Ray::new(self.position, direction);
        let lamps = self.lamps.iter().filter_map(|lamp| Some(lamp.intersect(&ray)?.0));
        lamps.chain(self.surfaces.nearest(&ray).map(|pick| pick.distance)).min_by(f64::total_cmp)
    }

    /// The distance of balls that nothing hides: that of the target, where the picture's surfaces are not much nearer or
    /// farther.
    fn usual_depth(&self) -> f64 {
        let at = |k: i32| (f64::from(k) + 0.5) / 8.0;
        let films = (0..8).flat_map(|y| (0..8).map(move |x| DVec2::new(at(x), at(y))));
        let mut distances: Vec<_> =
            films.filter_map(|film| self.distance(self.direction(film * self.size))).filter(|d| *d > 0.0).collect();
        distances.sort_by(f64::total_cmp);
        match distances.get(distances.len() / 2) {
            Some(median) => self.target_distance.clamp(DEPTHS.0 * median, DEPTHS.1 * median),
            None => self.target_distance,
        }
    }

    /// The ball in the cone around a film point, at the usual depth or before the nearest surface in the cone; `None` where
    /// the cone leaves the picture or the ball holds a light.
    fn ball(&self, film: DVec2, radius: f64, usual: f64) -> Option<Sphere> {
        let (axis, sine) = (self.direction(film), self.sine(radius));
        let is_inside = self.sides.iter().all(|side| side.dot(axis) >= (MARGIN * sine).min(1.0));
        if !is_inside {
            return None;
        }
        let hits = cone(axis, MARGIN * sine).filter_map(|direction| self.distance(direction));
        let nearest = hits.chain(self.centers_in_cone(axis, MARGIN * sine)).min_by(f64::total_cmp);
        // The farthest point of the ball lies within (1 + sine) of the distance of its centre.
        let depth = nearest.map_or(usual, |nearest| usual.min(CLEAR * nearest / (1.0 + sine)));
        let ball = self.ball_at(axis, sine, depth);
        let is_far = |from: &[DVec3], radii: f64| from.iter().all(|at| at.distance(ball.center) > radii * ball.radius);
        (is_far(&self.lights, 1.0) && is_far(&self.objects, 0.5) && ball.radius > 0.0).then_some(ball)
    }

    /// Distances of the items whose centres lie in a cone, less the radius of an item that all rays into the cone may miss.
    fn centers_in_cone(&self, axis: DVec3, sine: f64) -> impl Iterator<Item = f64> {
        let cosine = (1.0 - sine * sine).max(0.0).sqrt();
        let ways = self.lights.iter().chain(&self.objects).map(|center| *center - self.position);
        let seen = ways.filter(move |way| way.dot(axis) >= cosine * way.length() && way.length() > 0.0);
        seen.map(move |way| (1.0 - GAP * sine) * way.length())
    }

    fn ball_at(&self, axis: DVec3, sine: f64, depth: f64) -> Sphere {
        Sphere { center: self.position + depth * axis, radius: depth * sine }
    }
}

/// The surface of a light that rays see.
fn lamp(emitter: &Emitter) -> Option<Primitive> {
    match emitter {
        Emitter::Sphere { center, radius, .. } if *radius > 0.0 => {
            Some(Primitive::Sphere(Sphere { center: *center, radius: *radius }))
        }
        Emitter::Quad { corner, edge_u, edge_v, .. } => Some(Primitive::Quad(Quad::new(*corner, *edge_u, *edge_v))),
        _ => None,
    }
}

/// Unit directions that fill a cone: its axis, and four circles. `sine` is that of its half angle.
fn cone(axis: DVec3, sine: f64) -> impl Iterator<Item = DVec3> {
    let basis = OrthonormalBasis::from_normal(axis);
    let circles = [(0.25, 6), (0.5, 12), (0.75, 18), (1.0, 24)];
    let around = circles.into_iter().flat_map(move |(share, count)| {
        let (sine, basis) = (share * sine.min(1.0), basis);
        (0..count).map(move |k| {
            let (y, x) = (TAU * f64::from(k) / f64::from(count)).sin_cos();
            basis.world_from_local(DVec3::new(sine * x, sine * y, (1.0 - sine * sine).sqrt()))
        })
    });
    std::iter::once(axis).chain(around)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::document::{Edit, Item, NewItem, Selection, new_items};
    use crate::app::viewpoint::of_selection;
    use crate::scene::{Camera, Film, Location, SceneFile, built_in_scenes};
    use std::path::Path;
    use std::sync::Arc;

    const FINITE: [NewItem; 7] = [
        NewItem::Patch,
        NewItem::Sphere,
        NewItem::Quad,
        NewItem::PointLight,
        NewItem::SphereLight,
        NewItem::QuadLight,
        NewItem::Beam,
    ];

    fn surfaces(scene: &Scene) -> Surfaces {
        let mut surfaces = Surfaces::default();
        surfaces.update(&Arc::new(SceneFile { scene: scene.clone(), location: Location::Unsaved }));
        surfaces
    }

    fn aim(new: NewItem) -> Aim {
        if new.is_light() { Aim::Above } else { Aim::Middle }
    }

    /// Points of the boxes around the parts of the newest object or light.
    fn extent(scene: &Scene, new: NewItem) -> Vec<DVec3> {
        let item =
            if new.is_light() { Item::Light(scene.lights.len() - 1) } else { Item::Object(scene.objects.len() - 1) };
        let balls = of_selection(scene, &Selection::of(item));
        let ends = balls.iter().flat_map(|ball| {
            let axes = [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| ball.radius * axis);
            axes.into_iter().flat_map(|axis| [ball.center, ball.center + axis, ball.center - axis])
        });
        ends.collect()
    }

    /// Panics unless the camera sees every point of the extent.
    fn assert_seen(scene: &Scene, extent: &[DVec3], what: &str) {
        let surfaces = surfaces(scene);
        let view = View::new(scene, &surfaces).unwrap();
        for point in extent {
            let film = view.projection.project(*point).unwrap_or_else(|| panic!("{what}: {point} behind the camera"));
            let inside = film.cmpge(DVec2::ZERO).all() && film.cmple(view.size).all();
            assert!(inside, "{what}: {point} lies at {film} beside the picture");
            let way = *point - scene.camera.position;
            let seen = view.distance(way.normalize());
            assert!(seen.is_none_or(|seen| seen >= way.length()), "{what}: {point} lies behind {seen:?}");
        }
    }

    /// Adds every item twice, then the patches of a file, each with the others in the scene.
    fn assert_new_items_are_seen(scene: &Scene, name: &str) {
        let mut scene = scene.clone();
        let mut centers: Vec<DVec3> = Vec::new();
        for new in FINITE.into_iter().chain(FINITE) {
            let room = free_ball(&scene, &surfaces(&scene), aim(new));
            let edit = new.added(&scene, &room, scene.camera.position);
            let near = centers.iter().position(|center| center.distance(room.center) < 0.1 * room.radius);
            assert_eq!(near, None, "{new:?} in {name} coincides with another");
            centers.push(room.center);
            let before = scene.clone();
            edit.apply(&mut scene);
            assert_seen(&before, &extent(&scene, new), &format!("{new:?} in {name}"));
        }
        let room = free_ball(&scene, &surfaces(&scene), Aim::Middle);
        let teapot = new_items::surface(&scene, Path::new("scenes/teapot.bpt"), &room).unwrap();
        let before = scene.clone();
        Edit::AddObject(teapot).apply(&mut scene);
        assert_seen(&before, &extent(&scene, NewItem::Patch), &format!("the teapot in {name}"));
    }

    #[test]
    fn new_items_are_seen_whole_in_every_built_in_scene() {
        for example in built_in_scenes() {
            let scene = SceneFile::built_in(example.name).unwrap().scene;
            assert_new_items_are_seen(&scene, example.name);
        }
    }

    #[test]
    fn new_items_are_seen_whole_close_to_a_wall_and_in_any_picture() {
        for example in built_in_scenes() {
            let mut scene = SceneFile::built_in(example.name).unwrap().scene;
            let camera = scene.camera;
            let way = camera.target - camera.position;
            let surfaces = surfaces(&scene);
            let wall =
                surfaces.nearest(&Ray::new(camera.position, way.normalize())).map_or(way.length(), |p| p.distance);
            let near = camera.position + (0.95 * wall) * way.normalize();
            scene.camera = Camera { position: near, target: near + way, ..camera };
            assert_new_items_are_seen(&scene, &format!("{} near a wall", example.name));
            scene.camera = Camera { fov_y: 120.0, ..camera };
            scene.film = Film { width: 90, height: 400, ..scene.film };
            assert_new_items_are_seen(&scene, &format!("{} in a high picture", example.name));
        }
    }

    #[test]
    fn where_nothing_is_seen_an_item_goes_to_the_target() {
        let scene = Scene::default();
        let ball = free_ball(&scene, &Surfaces::default(), Aim::Middle);
        assert!(ball.center.distance(scene.camera.target) < 1e-12, "{ball:?}");
        let part = ball.radius / (scene.camera.position.distance(ball.center) * 20.0f64.to_radians().tan());
        assert!((0.3..0.6).contains(&part), "{part} of half the picture's height");
    }

    #[test]
    fn a_camera_without_direction_still_gets_a_place() {
        let mut scene = Scene::default();
        scene.camera.target = scene.camera.position;
        assert!(free_ball(&scene, &Surfaces::default(), Aim::Above).radius > 0.0);
    }

    #[test]
    fn a_camera_on_a_wall_still_gets_a_place() {
        let scene = SceneFile::built_in("cornell").unwrap().scene;
        let wall = surfaces(&scene);
        let ahead = (scene.camera.target - scene.camera.position).normalize();
        let on_wall =
            scene.camera.position + wall.nearest(&Ray::new(scene.camera.position, ahead)).unwrap().distance * ahead;
        let camera = Camera { position: on_wall, target: on_wall + ahead, ..scene.camera };
        let ball = free_ball(&Scene { camera, ..scene }, &wall, Aim::Middle);
        assert!(ball.radius > 0.0 && ball.center.is_finite(), "{ball:?}");
    }
}
