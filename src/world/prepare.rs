use super::bodies::{self, LightMedia, Surroundings};
use super::material::{Model, Relief, Source};
use super::probes;
use super::sheets::{Place, welded_sheets};
use super::texture::{self, TextureKey};
use super::texture_place::TexturePlaces;
use super::{Camera, Contacts, Image, Light, Material, ParallelRays, Precision, PrepareError, Surface, View, World};
use crate::geometry::bezier::{ControlNet, Patch};
use crate::geometry::{Aggregate, Plane, Primitive, Quad, Sphere};
use crate::math::float::rounding;
use crate::math::{Aabb, Rgb};
use crate::scene::{self, Emitter, Location, MaterialModel, Scene, Shape, TextureUse};
use glam::DVec3;
use rayon::prelude::*;
use std::f64::consts::PI;
use std::sync::Arc;

/// Radius of the part of an unbounded scene that the photons of a sun reach, distances of the camera from what it sees: the visible
/// ground and its illumination lie mostly in it.
const AROUND_VIEW: f64 = 2.0;

/// Prepares the world of a scene; paths in the scene are relative to `location`. The world shares unchanged parts with
/// `previous`: a moved control point rebuilds the tree of its patch and refits the BVH; a new material or light
/// rebuilds neither; an image is decoded once, and again when its file was written anew.
///
/// # Errors
///
/// If a texture file cannot be read or decoded, or a texture or material that the scene names does not exist.
pub fn prepare(scene: &Scene, location: &Location, previous: Option<&World>) -> Result<World, PrepareError> {
    let mut textures = Textures { scene, location, previous, decoded: Vec::new() };
    let materials = scene.materials.iter().map(|m| textures.material(m)).collect::<Result<Vec<_>, _>>()?;
    let lights: Vec<Light> = scene.lights.iter().map(light).filter(|l| l.power() != Rgb::ZERO).collect();
    let (descriptions, mut surfaces) = surfaces(scene, &lights)?;
    let aggregate = aggregate(descriptions, previous);
    let bodies = bodies::bodies(scene, aggregate.primitives(), &mut surfaces);
    let magnitudes: Vec<DVec3> = aggregate.primitives().iter().map(Primitive::magnitude).collect();
    let contacts = Contacts::new(aggregate.primitives(), &surfaces, &magnitudes);
    let precision = |(k, magnitude)| Precision { magnitude, contact: contacts.tolerance(k) };
    let precisions: Vec<Precision> = (0..).zip(magnitudes).map(precision).collect();
    let light_precisions = light_precisions(&lights, &surfaces, &precisions);
    let around = Surroundings { aggregate: &aggregate, surfaces: &surfaces, bodies: &bodies };
    let camera_media = around.media(scene.camera.position);
    let points = lights.iter().zip(&light_precisions).map(|(light, precision)| light.test_points(precision));
    let light_media = points.map(|points| LightMedia::at(points, &around)).collect();
    let mut world = World {
        contacts,
        camera_media,
        light_media,
        bodies,
        aggregate,
        surfaces,
        materials,
        lights,
        camera: Camera::new(&scene.camera, scene.film.width, scene.film.height),
        background: scene.render.background,
        max_bounces: scene.render.max_bounces,
        view: View::default(),
        precisions,
        light_precisions,
        texture_places: TexturePlaces::of(scene),
        textures: textures.decoded,
    };
    world.view = probes::view(&world, scene.camera.position.distance(scene.camera.target));
    spread_suns(&mut world);
    Ok(world)
}

/// How well the points of each light are known: those of its surface, or of the light itself if it has none.
fn light_precisions(lights: &[Light], surfaces: &[Surface], precisions: &[Precision]) -> Vec<Precision> {
    let without_surface = |light: &Light| {
        let magnitude = light.center().abs();
        // A point has no normal: rounding may move it in any direction.
        Precision { magnitude, contact: rounding(magnitude, DVec3::ONE) }
    };
    let mut found: Vec<Precision> = lights.iter().map(without_surface).collect();
    for (surface, precision) in surfaces.iter().zip(precisions) {
        if let Surface::Light(light) = *surface {
            found[light as usize] = *precision;
        }
    }
    found
}

/// Lets the disc of each sun cover the bounded objects, and a part of the unbounded ones about what the camera sees.
fn spread_suns(world: &mut World) {
    let bounds = world.aggregate.bounds();
    let view = Aabb::around([world.view.center]);
    let has_planes = world.aggregate.unbounded().next().is_some();
    let (center, mut radius) = match (bounds.is_empty(), has_planes) {
        (false, false) => (bounds.center(), 0.5 * bounds.diagonal()),
        _ => {
            let all = bounds.union(&view);
            (all.center(), 0.5 * all.diagonal() + AROUND_VIEW * world.view.distance)
        }
    };
    if radius == 0.0 {
        radius = world.view.distance;
    }
    for light in &mut world.lights {
        if let Light::Parallel(sun @ ParallelRays { from_outside: true, .. }) = light {
            // Paths aslant cross the plane of the disc beside the ball.
            (sun.center, sun.radius) = (center, radius * (1.0 + sun.half_angle.tan()));
        }
    }
}

/// A primitive before its tree is built; for a patch, its net and whether its transform mirrors.
#[allow(clippy::large_enum_variant, reason = "lives only while the tree is built; most of a large scene are patches")]
enum Description {
    Ready(Primitive),
    Patch { net: Box<ControlNet>, is_mirrored: bool },
}

/// The light of a scene, as the renderer reads it.
pub(super) fn light(light: &scene::Light) -> Light {
    match light.emitter {
        Emitter::Point { position, intensity } => Light::Point { position, intensity },
        Emitter::Sphere { center, radius, radiance } => Light::Sphere { sphere: Sphere { center, radius }, radiance },
        Emitter::Quad { corner, edge_u, edge_v, radiance } => {
            Light::Quad { quad: Quad::new(corner, edge_u, edge_v), radiance }
        }
        Emitter::Sun { direction, irradiance, diameter } => Light::Parallel(ParallelRays {
            direction: direction.normalize(),
            half_angle: 0.5 * diameter.to_radians(),
            irradiance,
            center: DVec3::ZERO,
            radius: 1.0,
            from_outside: true,
        }),
        Emitter::Beam { center, direction, radius, power } => Light::Parallel(ParallelRays {
            direction: direction.normalize(),
            half_angle: 0.0,
            irradiance: power / (PI * radius * radius) as f32,
            center,
            radius,
            from_outside: false,
        }),
    }
}

fn surfaces(scene: &Scene, lights: &[Light]) -> Result<(Vec<Description>, Vec<Surface>), PrepareError> {
    let mut descriptions = Vec::new();
    let mut surfaces = Vec::new();
    let materials = scene.materials_by_name();
    for (index, object) in scene.objects.iter().enumerate() {
        let material = *materials.get(object.material.as_str()).ok_or_else(|| {
            let user = format!("object `{}`", object.name);
            PrepareError::UnknownName { user, kind: "material", name: object.material.clone() }
        })?;
        // Each sheet has the number of its first primitive.
        let first = surfaces.len() as u32;
        let surface = |place: Place| Surface::Object {
            object: index as u32,
            material: material as u32,
            body: None,
            front_side: (first + place.sheet) << 1 | u32::from(!place.is_flipped),
            shared: place.shared,
        };
        if let Some(bezier) = object.shape.surface() {
            let mut nets = bezier.placed_nets();
            surfaces.extend(welded_sheets(&mut nets).into_iter().map(surface));
            let is_mirrored = bezier.transform.is_mirroring();
            descriptions.extend(nets.into_iter().map(|net| Description::Patch { net: Box::new(net), is_mirrored }));
        } else {
            surfaces.push(surface(Place::default()));
            descriptions.push(Description::Ready(simple_primitive(&object.shape)));
        }
    }
    for (index, light) in lights.iter().enumerate() {
        let primitive = match light {
            Light::Point { .. } | Light::Parallel(_) => continue,
            Light::Sphere { sphere, .. } => Primitive::Sphere(*sphere),
            Light::Quad { quad, .. } => Primitive::Quad(*quad),
        };
        surfaces.push(Surface::Light(index as u32));
        descriptions.push(Description::Ready(primitive));
    }
    Ok((descriptions, surfaces))
}

fn simple_primitive(shape: &Shape) -> Primitive {
    match *shape {
        Shape::Quad { corner, edge_u, edge_v } => Primitive::Quad(Quad::new(corner, edge_u, edge_v)),
        Shape::Sphere { center, radius } => Primitive::Sphere(Sphere { center, radius }),
        Shape::Plane { point, normal, u_axis } => Primitive::Plane(Plane::new(point, normal, u_axis)),
        // Patches have a description of their own; no ray hits an empty quad.
        Shape::Bezier(_) | Shape::Revolution(_) => Primitive::Quad(Quad::new(DVec3::ZERO, DVec3::ZERO, DVec3::ZERO)),
    }
}

fn aggregate(descriptions: Vec<Description>, previous: Option<&World>) -> Aggregate {
    let old = previous.map_or(&[][..], |world| world.aggregate.primitives());
    let primitives: Vec<Primitive> = descriptions
        .into_par_iter()
        .enumerate()
        .map(|(index, description)| match (description, old.get(index)) {
            (Description::Ready(primitive), _) => primitive,
            (Description::Patch { net, is_mirrored }, Some(Primitive::Patch(patch)))
                if (patch.net(), patch.is_mirrored()) == (&*net, is_mirrored) =>
            {
                Primitive::Patch(patch.clone())
            }
            (Description::Patch { net, is_mirrored }, _) => {
                Primitive::Patch(Arc::new(Patch::new(*net).mirrored(is_mirrored)))
            }
        })
        .collect();
    let same_kinds = old.len() == primitives.len()
        && old.iter().zip(&primitives).all(|(a, b)| std::mem::discriminant(a) == std::mem::discriminant(b));
    match previous {
        Some(world) if same_kinds => world.aggregate.refitted(primitives),
        _ => Aggregate::new(primitives),
    }
}

/// The images decoded so far, and the location of the files of further images.
struct Textures<'a> {
    scene: &'a Scene,
    location: &'a Location,
    previous: Option<&'a World>,
    decoded: Vec<(TextureKey, Arc<Image>)>,
}

impl Textures<'_> {
    fn material(&mut self, material: &scene::Material) -> Result<Material, PrepareError> {
        let user = format!("material `{}`", material.name);
        // Textures of materials that no object has are not read.
        if !self.scene.objects.iter().any(|object| object.material == material.name) {
            return Ok(Material::new(Model::Diffuse { albedo: Source::Constant(Rgb::ZERO) }, None));
        }
        let mut source = |color: &scene::Color| match color {
            scene::Color::Constant(value) => Ok(Source::Constant(*value)),
            scene::Color::Texture(texture) => {
                Ok(Source::Image { image: self.image(texture, false, &user)?, scale: texture.scale })
            }
        };
        let model = match &material.model {
            MaterialModel::Diffuse { albedo } => Model::Diffuse { albedo: source(albedo)? },
            MaterialModel::Phong { albedo, specular, exponent } => {
                Model::Phong { albedo: source(albedo)?, specular: source(specular)?, exponent: *exponent }
            }
            MaterialModel::Polished { albedo, reflectance } => {
                Model::Polished { albedo: source(albedo)?, reflectance: source(reflectance)? }
            }
            MaterialModel::Mirror { reflectance } => Model::Mirror { reflectance: source(reflectance)? },
            MaterialModel::Glass { tint, .. } => Model::Glass { tint: source(tint)? },
        };
        let relief = match &material.relief {
            None => None,
            Some(scene::Relief::Normal { map, strength }) => {
                Some(Relief::Normal { image: self.image(map, true, &user)?, scale: map.scale, strength: *strength })
            }
            Some(scene::Relief::Height { map, depth }) => {
                Some(Relief::Height { image: self.image(map, true, &user)?, scale: map.scale, depth: *depth })
            }
        };
        Ok(Material::new(model, relief))
    }

    fn image(&mut self, texture: &TextureUse, is_map: bool, user: &str) -> Result<Arc<Image>, PrepareError> {
        let Some(entry) = self.scene.textures.iter().find(|t| t.name == texture.texture) else {
            let name = texture.texture.clone();
            return Err(PrepareError::UnknownName { user: user.to_owned(), kind: "texture", name });
        };
        let linear = texture::is_linear(entry.encoding, is_map);
        let key = TextureKey::new(self.location, &entry.file, linear);
        let known = self.previous.map_or(&[][..], |world| &world.textures);
        if let Some((_, image)) = self.decoded.iter().chain(known).find(|(k, _)| *k == key) {
            let image = image.clone();
            if !self.decoded.iter().any(|(k, _)| *k == key) {
                self.decoded.push((key, image.clone()));
            }
            return Ok(image);
        }
        let image = Arc::new(key.decode()?);
        self.decoded.push((key, image.clone()));
        Ok(image)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Object, Revolution, SceneFile, Transform};
    use glam::DVec2;

    #[test]
    fn a_revolution_and_its_patches_make_one_world() {
        let profile = [(0.0, -0.5), (0.6, -0.5), (0.8, 0.4), (0.0, 0.5)].map(DVec2::from).to_vec();
        let transform = Transform { rotate: DVec3::new(10.0, 20.0, 30.0), ..Transform::default() };
        let file = SceneFile::built_in("lens").unwrap();
        let mut scene = file.scene;
        let glass =
            scene.materials.iter().find(|m| matches!(m.model, MaterialModel::Glass { .. })).unwrap().name.clone();
        let revolution = Revolution::new(transform, profile, 360.0, false);
        let surface = revolution.surface().clone();
        let shape = Shape::Revolution(revolution);
        scene.objects.push(Object { name: "drop".to_owned(), material: glass, shape, body: Some("drop".to_owned()) });
        let world = prepare(&scene, &file.location, None).unwrap();
        scene.objects.last_mut().unwrap().shape = Shape::Bezier(surface);
        let patches = prepare(&scene, &file.location, None).unwrap();
        let count = world.aggregate.primitives().len();
        for (a, b) in world.aggregate.primitives().iter().zip(patches.aggregate.primitives()) {
            let net = |primitive: &Primitive| match primitive {
                Primitive::Patch(patch) => Some((*patch.net(), patch.is_mirrored())),
                _ => None,
            };
            assert_eq!(net(a), net(b));
        }
        assert_eq!(count, patches.aggregate.primitives().len());
        assert_eq!(format!("{:?}", world.surfaces), format!("{:?}", patches.surfaces), "bodies, sheets, sides");
        assert_eq!(format!("{:?}", world.texture_places), format!("{:?}", patches.texture_places));
        // The whole surface is one sheet: its patches share their edges.
        let sheets = world.surfaces.iter().rev().filter_map(|surface| match surface {
            Surface::Object { object, front_side, .. } if *object as usize == scene.objects.len() - 1 => {
                Some(front_side >> 1)
            }
            _ => None,
        });
        let sheets: std::collections::BTreeSet<_> = sheets.collect();
        assert_eq!(sheets.len(), 1, "{sheets:?}");
    }
}
