//! Probe rays that find what the camera sees of a world. Origins and lengths that serve the whole picture come from here: the box around
//! the scene would follow objects that the picture does not show.

use super::{Camera, Light, Lobe, Surface, SurfacePoint, View, World};
use crate::geometry::Sphere;
use crate::math::{Aabb, OrthonormalBasis, Ray, Sampler, Stream, warp};
use glam::{DVec2, DVec3};
use rayon::prelude::*;
use std::f64::consts::PI;

/// Probe rays along a side of the film.
const SIDE: u32 = 16;
/// Mirrors and surfaces of glass through which a probe ray goes on.
const MOST_SPECULAR: usize = 4;
/// Greatest median free path that counts, over the distance from the camera: in the open light goes on for ever. It leaves the size of a
/// scene that a camera with a common angle of view shows as a whole.
const FAR: f64 = 1.25;

/// Least light over that of the brightest surface with which a surface counts as seen: less leaves it black in any picture.
const LEAST_LIGHT: f64 = 1e-4;
/// Least distance of a lamp for this comparison, over the distance from the camera: the spot beneath a lamp must not outshine the rest.
const NEAREST_LAMP: f64 = 0.1;

/// Radius of the ball around most points over their median distance from its center: of points where diffuse directions meet a plane 94 %.
/// A larger ball takes more photons to places whose light rarely comes to what the camera sees.
const MOST: f64 = 4.0;

/// Least points that tell where most are.
const LEAST_POINTS: usize = 8;

/// The surface that a probe ray shows.
struct Seen {
    film: DVec2,
    distance: f64,
    position: DVec3,
    /// A bound of the light that it scatters straight from the lamps, of any unit.
    light: f64,
    /// Distance to the next surface that scatters light, in a random direction; infinite where there is none.
    free_path: f64,
    /// Where a ray in that direction meets a mirror or glass first.
    specular: Option<DVec3>,
}

/// The view of a world; `target_distance` is the distance of the camera's target, in case the camera sees no surface.
pub(super) fn view(world: &World, target_distance: f64) -> View {
    let camera = &world.camera;
    let mut seen: Vec<Seen> = (0..SIDE * SIDE).into_par_iter().filter_map(|k| probe(world, k)).collect();
    let brightest = seen.iter().map(|seen| seen.light).fold(0.0, f64::max);
    seen.retain(|seen| seen.light >= LEAST_LIGHT * brightest);
    let Some(distance) = median(seen.iter().map(|seen| seen.distance)) else {
        return view_of_nothing(camera, target_distance);
    };
    let coordinate = |axis: usize| median(seen.iter().map(|seen| seen.position[axis])).unwrap_or(0.0);
    let bounds = Aabb::around(seen.iter().map(|seen| seen.position));
    let film = Aabb::around(seen.iter().map(|seen| seen.film.extend(0.0)));
    let stratum = film_size(camera) / f64::from(SIDE);
    let diagonal = (film.max - film.min).truncate() + stratum;
    let free_path = median(seen.iter().map(|seen| seen.free_path)).unwrap_or(f64::INFINITY);
    let spread = 0.5 * diagonal.length() * camera.footprint(1.0);
    View {
        origin: camera.position.clamp(bounds.min, bounds.max),
        center: DVec3::new(coordinate(0), coordinate(1), coordinate(2)),
        distance,
        spread,
        region: spread.max((free_path / distance).min(FAR)),
        specular: ball_around_most(seen.iter().filter_map(|seen| seen.specular).collect()),
    }
}

/// The ball around most of some points, about their median by coordinate; `None` of fewer than [`LEAST_POINTS`], and where they are one.
fn ball_around_most(points: Vec<DVec3>) -> Option<Sphere> {
    if points.len() < LEAST_POINTS {
        return None;
    }
    let coordinate = |axis: usize| median(points.iter().map(|point| point[axis]));
    let center = DVec3::new(coordinate(0)?, coordinate(1)?, coordinate(2)?);
    let distances = points.iter().map(|point| point.distance(center));
    let radius = (MOST * median(distances.clone())?).min(distances.fold(0.0, f64::max));
    (radius > 0.0).then_some(Sphere { center, radius })
}

fn view_of_nothing(camera: &Camera, target_distance: f64) -> View {
    let distance = if target_distance > 0.0 { target_distance } else { 1.0 };
    let spread = 0.5 * film_size(camera).length() * camera.footprint(1.0);
    let center = camera.ray(0.5 * film_size(camera)).at(distance);
    View { origin: camera.position, center, distance, spread, region: spread.max(FAR), specular: None }
}

fn film_size(camera: &Camera) -> DVec2 {
    DVec2::new(f64::from(camera.width), f64::from(camera.height))
}

/// The surface that the ray through the middle of one stratum of the film shows, behind mirrors and glass; `None` for the background.
fn probe(world: &World, k: u32) -> Option<Seen> {
    let stratum = DVec2::new(f64::from(k % SIDE), f64::from(k / SIDE)) + 0.5;
    let film = stratum / f64::from(SIDE) * film_size(&world.camera);
    let (mut ray, mut before) = (world.camera.ray(film), 0.0);
    let mut seen = None;
    for _ in 0..=MOST_SPECULAR {
        let Some(hit) = world.closest_hit(&ray) else { break };
        let point = world.surface_point(&ray, hit);
        let material = scattering_material(world, hit.primitive);
        let scattered = material.map_or(0.0, |(_, scattered)| scattered);
        let distance = (before + hit.t).max(f64::MIN_POSITIVE);
        let light = scattered * irradiance(world, point.position, NEAREST_LAMP * distance);
        seen = Some(Seen { film, distance, position: point.position, light, free_path: f64::INFINITY, specular: None });
        match material {
            Some((material, 0.0)) if world.materials[material as usize].is_specular() => {
                (ray, before) = beyond(world, &ray, &point, material, before);
            }
            _ => {
                let (free_path, specular) = surroundings(world, &point, k);
                return seen.map(|seen| Seen { free_path, specular, ..seen });
            }
        }
    }
    seen
}

/// The material of an object's primitive, and a bound of the fraction of light that it scatters.
fn scattering_material(world: &World, primitive: u32) -> Option<(u32, f64)> {
    let Surface::Object { material, .. } = world.surfaces[primitive as usize] else { return None };
    Some((material, world.materials[material as usize].scattered_bound().into()))
}

/// The power of the lamps over their squared distances from a point, each at least the distance `nearest` away.
fn irradiance(world: &World, position: DVec3, nearest: f64) -> f64 {
    let of_light = |light: &Light| {
        if let Light::Parallel(rays) = light {
            return 4.0 * PI * f64::from(rays.irradiance.max_element());
        }
        let distance = light.center().distance(position).max(nearest);
        f64::from(light.power().max_element()) / distance.powi(2)
    };
    world.lights.iter().map(of_light).sum()
}

/// What is in the k-th of some directions, distributed as diffuse reflection, from a point: the distance to a surface that scatters light, or
/// the place of a mirror or glass.
fn surroundings(world: &World, point: &SurfacePoint, k: u32) -> (f64, Option<DVec3>) {
    let u = Sampler::new(0, Stream::Probe, u64::MAX, u64::from(k)).next_2d();
    let direction = OrthonormalBasis::from_normal(point.n_side()).world_from_local(warp::cosine_hemisphere(u));
    let ray = Ray::new(world.leave(point, direction), direction);
    let hit = world.closest_hit(&ray);
    let scatters = |primitive| scattering_material(world, primitive).is_some_and(|(_, scattered)| scattered > 0.0);
    let free_path = hit.filter(|hit| scatters(hit.primitive)).map_or(f64::INFINITY, |hit| hit.t);
    let is_specular = |primitive| {
        scattering_material(world, primitive).is_some_and(|(m, _)| world.materials[m as usize].is_specular())
    };
    (free_path, hit.filter(|hit| is_specular(hit.primitive)).map(|hit| ray.at(hit.t)))
}

/// The ray beyond a mirror or a surface of glass, and the length of the path before its origin. A ray through glass goes straight on: how
/// far it goes matters here, not where.
fn beyond(world: &World, ray: &Ray, point: &SurfacePoint, material: u32, before: f64) -> (Ray, f64) {
    let (scattering, n_shade) = world.scattering(point, material);
    if matches!(scattering.lobe, Lobe::Glass { .. }) {
        return (Ray { t_min: point.hit.t, ..*ray }, before);
    }
    let direction = ray.direction - 2.0 * ray.direction.dot(n_shade) * n_shade;
    (Ray::new(world.leave(point, direction), direction), before + point.hit.t)
}

/// The upper median; `None` of nothing.
fn median(values: impl Iterator<Item = f64>) -> Option<f64> {
    let mut values: Vec<f64> = values.collect();
    values.sort_unstable_by(f64::total_cmp);
    values.get(values.len() / 2).copied()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Location, SceneFile};
    use crate::world::prepare;

    /// A camera at (0, 0, 4) that looks along -z; its film shows 2 x 2 at distance 2.
    fn seen(text: &str) -> View {
        let head = "version = 1\n[camera]\nposition = [0, 0, 4]\ntarget = [0, 0, 0]\nfov_y = 53.13010235415598
            [film]\nwidth = 64\nheight = 64
            [[light]]\nname = \"lamp\"\ntype = \"point\"\nposition = [0, 0, 4]\nintensity = [1, 1, 1]
            [[material]]\nname = \"grey\"\ntype = \"diffuse\"\nalbedo = [0.5, 0.5, 0.5]
            [[material]]\nname = \"black\"\ntype = \"diffuse\"\nalbedo = [0, 0, 0]
            [[material]]\nname = \"mirror\"\ntype = \"mirror\"\nreflectance = [0.8, 0.8, 0.8]\n";
        let file = SceneFile::parse(&[head, text].concat(), Location::Unsaved).expect("the scene is valid");
        prepare(&file.scene, &file.location, None).expect("the scene can be prepared").view
    }

    /// A square in the plane at this height z.
    fn square(name: &str, half: f64, z: f64, material: &str) -> String {
        let (corner, edge) = ([-half, -half, z], 2.0 * half);
        format!(
            "[[object]]\nname = \"{name}\"\ntype = \"quad\"\nmaterial = \"{material}\"\ncorner = {corner:?}
            edge_u = [{edge:?}, 0, 0]\nedge_v = [0, {edge:?}, 0]\n"
        )
    }

    fn ball(name: &str, center: [f64; 3], radius: f64, material: &str) -> String {
        format!(
            "[[object]]\nname = \"{name}\"\ntype = \"sphere\"\nmaterial = \"{material}\"\ncenter = {center:?}\nradius = {radius:?}\n"
        )
    }

    #[test]
    fn the_radius_is_that_of_what_is_in_view() {
        let wall = seen(&square("wall", 10.0, 0.0, "grey"));
        assert!((wall.spread - 0.5f64.sqrt()).abs() < 1e-9, "the whole film: {}", wall.spread);
        assert!((4.0..5.0).contains(&wall.distance) && wall.center.length() < 1.0, "{wall:?}");
        let small = seen(&square("wall", 0.5, 0.0, "grey"));
        assert!(
            (small.spread / (0.25 * 0.5f64.sqrt()) - 1.0).abs() < 1e-9,
            "a fourth of the film each way: {}",
            small.spread
        );
        assert_eq!(small.origin.z, 0.0, "on the wall");
    }

    /// Small, far, black or unseen objects.
    #[test]
    fn objects_that_hardly_show_change_nothing() {
        let wall = square("wall", 10.0, 0.0, "grey");
        let alone = seen(&wall);
        let far = ball("far", [0.0, 1e9, 0.0], 1.0, "grey");
        let around = ball("around", [0.0; 3], 1e6, "black");
        assert_eq!(seen(&[&wall, &far, &around].map(String::as_str).concat()), alone);
        let half = square("wall", 1.0, 0.0, "grey");
        for around in [around, ball("around", [0.0; 3], 1e6, "grey")] {
            assert_eq!(seen(&[half.clone(), around].concat()), seen(&half), "too dark around a wall to show");
        }
    }

    /// Near a wall of a room the film shows a small part of the room.
    #[test]
    fn the_region_around_a_detail_is_larger_than_the_film() {
        let room = ball("room", [0.0, 0.0, 13.99], 10.0, "grey");
        let View { spread, region, distance, .. } = seen(&room);
        assert!((0.01..0.02).contains(&distance) && spread < 1.0 && region == FAR, "{spread}, {region} at {distance}");
    }

    #[test]
    fn views_go_on_in_mirrors() {
        let mirrored = seen(&(square("mirror", 10.0, 0.0, "mirror") + &square("wall", 100.0, 8.0, "grey")));
        assert!((12.0..15.0).contains(&mirrored.distance), "4 to the mirror and 8 back: {}", mirrored.distance);
        assert_eq!(mirrored.center.z, 8.0);
    }

    #[test]
    fn an_empty_view_is_that_of_the_target() {
        let View { origin, center, distance, .. } = seen("");
        assert_eq!((origin, center, distance), (DVec3::new(0.0, 0.0, 4.0), DVec3::ZERO, 4.0));
    }
}
