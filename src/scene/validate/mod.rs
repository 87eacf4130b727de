//! The rules of a valid scene, from a file or from the window.
//!
//! | file | holds |
//! |---|---|
//! | `material` | materials |
//! | `body` | bodies of glass |
//! | `shape` | lights and objects |
//! | `checks` | checks of single values, which collect the problems |
//! | `names` | the names that a scene can refer to |

mod body;
mod checks;
mod material;
mod names;
mod shape;

use super::{Camera, Film, Problem, Render, Scene, Texture};
use checks::{Checks, parallel};
pub use checks::{MAX_LENGTH, MAX_RADIANCE, MIN_LENGTH};
use names::Names;
use std::collections::HashSet;

/// All problems of a scene: numbers out of range, names that are missing or ambiguous, materials that reflect more light than
/// they receive. Empty for a valid scene.
pub fn validate(scene: &Scene) -> Vec<Problem> {
    let mut problems = Vec::new();
    let mut checks = Checks::new(&mut problems);
    camera(&scene.camera, &mut checks.at("camera"));
    film(&scene.film, &mut checks.at("film"));
    render(&scene.render, &mut checks.at("render"));
    let names = Names::of(scene);
    each("texture", &scene.textures, |t| &t.name, &mut checks, texture);
    each("material", &scene.materials, |m| &m.name, &mut checks, |m, c| material::material(m, &names, c));
    each("light", &scene.lights, |l| &l.name, &mut checks, shape::light);
    each("object", &scene.objects, |o| &o.name, &mut checks, |o, c| shape::object(o, &names, c));
    body::bodies(scene, &mut checks);
    problems
}

/// Checks every item of a list, and that its name is not empty and unique.
fn each<'a, T>(
    list: &str,
    items: &'a [T],
    name: impl Fn(&'a T) -> &'a String,
    checks: &mut Checks<'_>,
    check: impl Fn(&'a T, &mut Checks<'_>),
) {
    let mut seen = HashSet::new();
    for (index, item) in items.iter().enumerate() {
        let name = name(item);
        let checks = &mut checks.at(&format!("{list}[{index}]"));
        checks.require(!name.is_empty(), "name", || "found an empty name, expected a name".into());
        checks.require(name.is_empty() || seen.insert(name), "name", || {
            format!("found \"{name}\" for the second time, expected a name that is unique among the {list}s")
        });
        check(item, checks);
    }
}

fn camera(camera: &Camera, checks: &mut Checks<'_>) {
    checks.point("position", camera.position);
    checks.point("target", camera.target);
    checks.point("up", camera.up);
    let forward = camera.target - camera.position;
    checks.require(forward.length() >= MIN_LENGTH, "target", || {
        "found the position of the camera, expected another point".into()
    });
    checks.require(forward.length() < MIN_LENGTH || !parallel(forward, camera.up), "up", || {
        format!("found {}, expected a direction that is not parallel to the view direction", camera.up)
    });
    let fov = camera.fov_y;
    checks
        .require(fov > 0.0 && fov < 180.0, "fov_y", || format!("found {fov}, expected degrees above 0 and below 180"));
}

fn film(film: &Film, checks: &mut Checks<'_>) {
    for (key, pixels) in [("width", film.width), ("height", film.height)] {
        checks.require((1..=Film::MOST_PIXELS).contains(&pixels), key, || {
            format!("found {pixels}, expected 1 to {} pixels", Film::MOST_PIXELS)
        });
    }
    checks.within("exposure", film.exposure, -Film::MOST_EXPOSURE, Film::MOST_EXPOSURE);
}

fn render(render: &Render, checks: &mut Checks<'_>) {
    let bounces = render.max_bounces;
    checks.require((1..=1024).contains(&bounces), "max_bounces", || format!("found {bounces}, expected 1 to 1024"));
    checks.radiance("background", render.background);
}

fn texture(texture: &Texture, checks: &mut Checks<'_>) {
    checks.require(!texture.file.is_empty(), "file", || {
        "found an empty path, expected the path of a PNG or JPEG file".into()
    });
}

#[cfg(test)]
mod tests;
