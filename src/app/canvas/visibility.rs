//! Which handles the camera sees, and which an object hides. Knows no widget.

use super::picking::Surfaces;
use super::projection::Projection;
use crate::app::document::Handle;
use crate::math::Ray;
use glam::DVec3;
use std::collections::HashMap;
use std::time::{Duration, Instant};

/// Time for rays in one frame. Further handles wait for the next frame: a new patch takes a third of a millisecond before
/// its first ray.
const BUDGET: Duration = Duration::from_millis(2);
/// A handle is a ball of this radius, film pixels: a control point in its surface, or just below, is visible.
const RADIUS: f64 = 4.0;
/// The largest radius of that ball as a fraction of its distance from the camera, for films of a few pixels.
const LARGEST: f64 = 0.01;

/// For each handle, whether an object hides it from the camera. Kept while neither the camera nor a surface changes.
#[derive(Debug, Default)]
pub(crate) struct Visibility {
    /// The camera and the revision of the surfaces that the present generation holds for.
    view: Option<(Projection, u64)>,
    generation: u64,
    known: HashMap<Handle, Known>,
}

/// The last known visibility of a handle.
#[derive(Clone, Copy, Debug)]
struct Known {
    world: DVec3,
    generation: u64,
    hidden: bool,
}

impl Visibility {
    /// Traces rays to the handles whose visibility may have changed. Returns whether the time sufficed for all of them.
    pub(crate) fn update(&mut self, surfaces: &Surfaces, projection: &Projection, handles: &[(Handle, DVec3)]) -> bool {
        self.renew(surfaces, projection);
        let start = Instant::now();
        let known = std::mem::take(&mut self.known);
        let kept = handles.iter().filter_map(|(handle, _)| Some((*handle, *known.get(handle)?)));
        self.known = kept.collect();
        for (handle, world) in self.stale(handles) {
            if start.elapsed() > BUDGET {
                return false;
            }
            let hidden = is_hidden(surfaces, projection, handle, world);
            self.known.insert(handle, Known { world, generation: self.generation, hidden });
        }
        true
    }

    /// Whether an object hides the handle, as far as is known.
    pub(crate) fn is_hidden(&self, handle: Handle) -> bool {
        self.known.get(&handle).is_some_and(|known| known.hidden)
    }

    fn renew(&mut self, surfaces: &Surfaces, projection: &Projection) {
        let view = Some((*projection, surfaces.revision()));
        if self.view != view {
            self.view = view;
            self.generation += 1;
        }
    }

    /// The handles that need a ray, those that have waited longest first.
    fn stale(&self, handles: &[(Handle, DVec3)]) -> Vec<(Handle, DVec3)> {
        let known = |handle: &Handle| self.known.get(handle);
        let is_fresh = |(handle, world): &&(Handle, DVec3)| {
            known(handle).is_some_and(|known| known.generation == self.generation && known.world == *world)
        };
        let mut stale: Vec<_> = handles.iter().filter(|handle| !is_fresh(handle)).copied().collect();
        stale.sort_by_key(|(handle, _)| known(handle).map(|known| known.generation));
        stale
    }
}

/// Whether an object lies between the camera and the handle. The centre of an object lies inside, so its own surface does
/// not count.
fn is_hidden(surfaces: &Surfaces, projection: &Projection, handle: Handle, world: DVec3) -> bool {
    let ray = projection.sight(world);
    let radius = (RADIUS / projection.pixels_per_unit(1.0)).min(LARGEST);
    let except = match handle {
        Handle::Object(object) => Some(object),
        Handle::Point { .. } | Handle::Light(_) => None,
    };
    surfaces.occlude(&Ray { t_max: 1.0 - radius, ..ray }, except)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Camera, Film, Location, Object, Scene, SceneFile, Shape};
    use std::sync::Arc;

    fn surfaces() -> Surfaces {
        let shape = Shape::Sphere { center: DVec3::ZERO, radius: 1.0 };
        let ball = Object { name: String::new(), material: String::new(), shape, body: None };
        let scene = Scene { objects: vec![ball], ..Scene::default() };
        let mut surfaces = Surfaces::default();
        surfaces.update(&Arc::new(SceneFile { scene, location: Location::Unsaved }));
        surfaces
    }

    fn projection(position: DVec3) -> Projection {
        Projection::new(&Camera { position, target: DVec3::ZERO, ..Camera::default() }, &Film::default()).unwrap()
    }

    #[test]
    fn a_ball_hides_what_is_behind_it_and_not_its_own_centre() {
        let (surfaces, projection) = (surfaces(), projection(5.0 * DVec3::Z));
        let hidden = |handle, z| is_hidden(&surfaces, &projection, handle, DVec3::new(0.0, 0.0, z));
        assert!(hidden(Handle::Light(0), -3.0), "behind the ball");
        assert!(hidden(Handle::Light(0), 0.0), "inside the ball");
        assert!(!hidden(Handle::Light(0), 3.0), "in front of the ball");
        assert!(!hidden(Handle::Light(0), 1.0), "on the ball");
        assert!(!hidden(Handle::Object(0), 0.0), "the ball's own centre");
        assert!(hidden(Handle::Object(1), -3.0), "another object's centre");
    }

    #[test]
    fn rays_are_traced_only_after_a_change() {
        let (surfaces, mut visibility) = (surfaces(), Visibility::default());
        let mut handles: Vec<_> = (0..9).map(|k| (Handle::Light(k), DVec3::new(0.0, 0.0, k as f64 - 4.5))).collect();
        let front = projection(9.0 * DVec3::Z);
        while !visibility.update(&surfaces, &front, &handles) {}
        assert!(visibility.is_hidden(Handle::Light(0)) && !visibility.is_hidden(Handle::Light(8)));
        assert_eq!(visibility.stale(&handles), [], "nothing changed");
        handles[3].1.x = 7.0;
        assert_eq!(visibility.stale(&handles), [handles[3]], "one handle moved");
        while !visibility.update(&surfaces, &front, &handles) {}
        let back = projection(-9.0 * DVec3::Z);
        visibility.renew(&surfaces, &back);
        assert_eq!(visibility.stale(&handles).len(), handles.len(), "the camera moved");
        while !visibility.update(&surfaces, &back, &handles) {}
        assert!(!visibility.is_hidden(Handle::Light(0)) && visibility.is_hidden(Handle::Light(8)));
    }
}
