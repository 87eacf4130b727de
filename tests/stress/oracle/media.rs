use super::random::Random;
use super::ray::{Hit, Ray};
use super::surfaces::{Kind, Surfaces, glass, shapes};
use glam::DVec3;
use patchlight::scene::Scene;

/// One body of glass.
pub(super) struct Body {
    /// Index of refraction.
    pub(super) ior: f64,
    /// Absorption, per scene unit.
    pub(super) absorption: DVec3,
}

/// All bodies in ascending order of rank.
pub(super) struct Bodies {
    pub(super) list: Vec<Body>,
    /// The index in `list` of the body of each object.
    of_object: Vec<Option<usize>>,
}

/// How many surfaces of each body are around a point, by the index of the body: surfaces of one body may overlap.
pub(super) type Containing = Vec<i32>;

impl Bodies {
    /// The bodies of a scene: where several contain a point, the one with the highest priority counts, then the one with the smaller box,
    /// then the later one.
    pub(super) fn new(scene: &Scene) -> Self {
        let key = |object: usize| scene.objects[object].body_key();
        let of_glass: Vec<usize> = (0..scene.objects.len()).filter(|&object| glass(scene, object).is_some()).collect();
        let mut groups: Vec<Vec<usize>> = Vec::new();
        for &object in &of_glass {
            match groups.iter_mut().find(|group| key(group[0]) == key(object)) {
                Some(group) => group.push(object),
                None => groups.push(vec![object]),
            }
        }
        let priority =
            |group: &[usize]| group.iter().filter_map(|&object| glass(scene, object)).map(|(_, _, p)| p).max();
        groups.sort_by(|a, b| priority(a).cmp(&priority(b)).then(size(scene, b).total_cmp(&size(scene, a))));
        let rank = |object: usize| groups.iter().position(|group| group.contains(&object));
        let of_object = (0..scene.objects.len()).map(rank).collect();
        let body = |group: &Vec<usize>| glass(scene, group[0]).map(|(ior, absorption, _)| Body { ior, absorption });
        Self { list: groups.iter().filter_map(body).collect(), of_object }
    }

    /// The body of an object.
    pub(super) fn of_object(&self, object: usize) -> Option<usize> {
        self.of_object[object]
    }

    /// The bodies around a point: those whose surface shows its inside to most rays that meet it.
    pub(super) fn around(&self, surfaces: &Surfaces, point: DVec3) -> Containing {
        const RAYS: u64 = 65;
        let is_inside = |body: usize| {
            let mut random = Random::new(1, 0);
            let sides = (0..RAYS).filter_map(|_| {
                let ray = Ray { origin: point, direction: random.direction() };
                surfaces.nearest_of_body(&ray, body).map(|hit| if hit.normal.dot(ray.direction) > 0.0 { 1 } else { -1 })
            });
            i32::from(sides.sum::<i32>() > 0)
        };
        (0..self.list.len()).map(is_inside).collect()
    }

    /// The bodies behind an interface, for a ray in these bodies.
    pub(super) fn behind(&self, surfaces: &Surfaces, before: &Containing, interface: &[Hit], ray: &Ray) -> Containing {
        let mut behind = before.clone();
        for (k, hit) in interface.iter().enumerate() {
            // Newton's method may find a hit of a cell several times.
            let is_repeated = interface[..k].iter().any(|earlier| earlier.surface == hit.surface);
            if let (Kind::Object { body: Some(body), .. }, false) = (&surfaces.list[hit.surface].kind, is_repeated) {
                behind[*body] += if hit.normal.dot(ray.direction) < 0.0 { 1 } else { -1 };
            }
        }
        behind
    }

    /// The medium among these bodies; `None` for air.
    pub(super) fn medium(&self, containing: &Containing) -> Option<&Body> {
        containing.iter().rposition(|&count| count > 0).map(|body| &self.list[body])
    }
}

/// The diagonal of the box around the objects of a body; infinite with a plane.
fn size(scene: &Scene, group: &[usize]) -> f64 {
    let shapes = group.iter().flat_map(|&object| shapes(&scene.objects[object].shape));
    let boxes: Option<Vec<[DVec3; 2]>> = shapes.map(|shape| shape.bounds()).collect();
    boxes.map_or(f64::INFINITY, |boxes| {
        let min = boxes.iter().fold(DVec3::INFINITY, |a, [b, _]| a.min(*b));
        min.distance(boxes.iter().fold(DVec3::NEG_INFINITY, |a, [_, b]| a.max(*b)))
    })
}
