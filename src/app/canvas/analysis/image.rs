//! The analysis as an image, by pixel.

use super::choice::{Analysis, Shading};
use super::raster::{Fragment, Raster};
use super::{curvature, isolines, stripes};
use crate::app::canvas::picking;
use crate::app::canvas::projection::Projection;
use crate::app::theme::overlay;
use crate::geometry::Primitive;
use crate::geometry::bezier::{ControlNet, Derivatives};
use crate::math::Aabb;
use crate::scene::{Bezier, Scene, Shape};
use egui::{Color32, ColorImage};
use glam::{DVec2, DVec3};

/// The longer side of the image, pixels.
const SIZE: f64 = 1024.0;
/// The most pixels of the image along a pixel of the film.
const MOST_DETAIL: f64 = 2.0;
/// Width of the dark margin of isolines, pixels.
const MARGIN: f32 = 1.5;
/// A surface nearer than this part of the distance to the analysed surface hides it.
const IN_FRONT: f64 = 1.0 - 1e-4;

/// A finished analysis.
pub(super) struct Analysed {
    pub(super) image: ColorImage,
    /// The end of the scale of the curvature; `None` without curvature.
    pub(super) scale: Option<f64>,
}

/// The analysed surface, as the pixels need it.
struct Surface {
    nets: Vec<ControlNet>,
    is_mirrored: bool,
    eye: DVec3,
    axis: DVec3,
}

/// The analysis of a Bezier object of the scene, over a film of `film` pixels.
pub(super) fn analysed(
    scene: &Scene,
    object: usize,
    bezier: &Bezier,
    projection: &Projection,
    film: egui::Vec2,
    analysis: Analysis,
) -> Analysed {
    let film = DVec2::new(f64::from(film.x), f64::from(film.y)).max(DVec2::ONE);
    let detail = (SIZE / film.max_element()).min(MOST_DETAIL);
    let nets = bezier.placed_nets();
    let [width, height] = (film * detail).ceil().to_array().map(|side| side as usize);
    let mut raster = Raster::new(width, height);
    let project = |world: DVec3| Some((projection.project(world)? * detail, projection.depth(world)));
    (0..).zip(&nets).for_each(|(patch, net)| raster.draw(net, Some(patch), project));
    for other in other_shapes(scene, object) {
        if let Some(other) = other.surface() {
            other.placed_nets().iter().for_each(|net| raster.draw(net, None, project));
        }
    }
    let eye = projection.ray(DVec2::ZERO).origin;
    let axis = scene.camera.up.try_normalize().unwrap_or(DVec3::Y);
    let surface = Surface { nets, is_mirrored: bezier.transform.is_mirroring(), eye, axis };
    let hiding: Vec<Primitive> = other_shapes(scene, object).filter_map(picking::simple_primitive).collect();
    surface.image(&raster, analysis, |index, distance| {
        let at = DVec2::new((index % width) as f64 + 0.5, (index / width) as f64 + 0.5) / detail;
        let ray = projection.ray(at);
        hiding.iter().filter_map(|shape| shape.intersect(&ray)).any(|(nearer, ..)| nearer < IN_FRONT * distance)
    })
}

/// The shapes of all other objects.
fn other_shapes(scene: &Scene, object: usize) -> impl Iterator<Item = &Shape> {
    let others = scene.objects.iter().enumerate().filter(move |(index, _)| *index != object);
    others.map(|(_, other)| &other.shape)
}

impl Surface {
    fn image(&self, raster: &Raster, analysis: Analysis, is_hidden: impl Fn(usize, f64) -> bool) -> Analysed {
        let visible = |index: usize| {
            let Fragment { patch, uv, .. } = raster.fragment(index)?;
            let point = self.nets[patch as usize].derivatives(f64::from(uv.x), f64::from(uv.y));
            (!is_hidden(index, point.position.distance(self.eye))).then(|| self.value(&point, analysis))
        };
        let values: Vec<Option<f64>> = (0..raster.width * raster.height).map(visible).collect();
        let size = self.nets.iter().fold(Aabb::EMPTY, |bounds, net| bounds.union(&net.bounds())).diagonal();
        let curvature = analysis.shading.filter(|shading| *shading != Shading::Zebra);
        let scale =
            curvature.map(|shading| curvature::scale(shading, values.iter().flatten().copied().collect(), size));
        let pixel = |index: usize| {
            let (Some(fragment), Some(value)) = (raster.fragment(index), values[index]) else {
                return Color32::TRANSPARENT;
            };
            let color = match scale {
                _ if value.is_nan() => Color32::TRANSPARENT,
                Some(scale) => curvature::color(value / scale),
                None => stripe(value, change(&values, index, raster.width)),
            };
            let shaded = color.linear_multiply(overlay::ANALYSIS_OPACITY);
            if analysis.isolines { with_isolines(shaded, &fragment) } else { shaded }
        };
        let pixels = (0..values.len()).map(pixel).collect();
        Analysed { image: ColorImage::new([raster.width, raster.height], pixels), scale }
    }

    /// The curvature or the phase of the stripes at a point; NaN without a shading, and where the surface has no normal.
    fn value(&self, point: &Derivatives, analysis: Analysis) -> f64 {
        let value = match analysis.shading {
            Some(Shading::Zebra) => self.phase(point),
            Some(shading) => curvature::value(shading, point, self.is_mirrored),
            None => None,
        };
        value.unwrap_or(f64::NAN)
    }

    fn phase(&self, point: &Derivatives) -> Option<f64> {
        let normal = point.dpdu.cross(point.dpdv).try_normalize()?;
        Some(stripes::phase(normal, (point.position - self.eye).try_normalize()?, self.axis))
    }
}

/// A pixel with its isolines, whose dark margin keeps them visible on bright colours.
fn with_isolines(color: Color32, fragment: &Fragment) -> Color32 {
    let margin = overlay::OUTLINE.linear_multiply(isolines::coverage(fragment, MARGIN));
    color.blend(margin).blend(overlay::ISOLINE.linear_multiply(isolines::coverage(fragment, 0.0)))
}

fn stripe(phase: f64, change: f64) -> Color32 {
    let [black, white] = overlay::ZEBRA;
    black.lerp_to_gamma(white, stripes::whiteness(phase, change) as f32)
}

/// The change of a value over a pixel, by the neighbours that have one.
fn change(values: &[Option<f64>], index: usize, width: usize) -> f64 {
    let at = |other: Option<usize>| other.and_then(|other| values.get(other).copied().flatten()).unwrap_or(f64::NAN);
    let here = at(Some(index));
    // `min` passes over NaN.
    let along = |step: usize| {
        let sides = [at(index.checked_sub(step)), at(index.checked_add(step))];
        sides.into_iter().map(|there| (there - here).abs()).fold(f64::INFINITY, f64::min)
    };
    let finite = |change: f64| if change.is_finite() { change } else { 0.0 };
    finite(along(1)).hypot(finite(along(width)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Camera, Film, Object, SceneFile};

    fn analysis(shading: Option<Shading>, isolines: bool) -> Analysis {
        Analysis { isolines, shading }
    }

    /// The scene of a built-in file with the object of this name.
    fn seen(scene: &Scene, analysis: Analysis) -> Analysed {
        let is_bezier = |object: &Object| matches!(object.shape, Shape::Bezier(_));
        let object = scene.objects.iter().position(is_bezier).unwrap();
        let Shape::Bezier(bezier) = &scene.objects[object].shape else { panic!("a Bezier object") };
        let film = egui::vec2(scene.film.width as f32, scene.film.height as f32);
        analysed(scene, object, bezier, &Projection::new(&scene.camera, &scene.film).unwrap(), film, analysis)
    }

    fn covered(image: &ColorImage) -> usize {
        image.pixels.iter().filter(|pixel| **pixel != Color32::TRANSPARENT).count()
    }

    #[test]
    fn nearer_objects_hide_the_surface() {
        let mut scene = SceneFile::built_in("report").unwrap().scene;
        let whole = covered(&seen(&scene, analysis(Some(Shading::Zebra), false)).image);
        assert!(whole > 10_000, "{whole} pixels of the sheet");
        let eye = scene.camera.position;
        let way = scene.camera.target - eye;
        let screen = |corner: DVec3, edge_u, edge_v| Shape::Quad { corner, edge_u, edge_v };
        // A wall over the left half of the view, halfway to the target.
        let side = way.length();
        let wall = screen(eye + 0.5 * way - side * (DVec3::X + DVec3::Y), side * DVec3::X, 2.0 * side * DVec3::Y);
        scene.objects.push(Object { name: "wall".into(), material: String::new(), shape: wall, body: None });
        let part = covered(&seen(&scene, analysis(Some(Shading::Zebra), false)).image);
        assert!(0 < part && part < whole, "{part} of {whole}");
    }

    #[test]
    fn the_scale_is_the_curvature_of_the_surface_in_world_space() {
        let mut scene = SceneFile::built_in("report").unwrap().scene;
        let scale = |scene: &Scene| seen(scene, analysis(Some(Shading::MeanCurvature), true)).scale.unwrap();
        let before = scale(&scene);
        for object in &mut scene.objects {
            if let Shape::Bezier(bezier) = &mut object.shape {
                bezier.transform.scale *= 10.0;
                bezier.transform.translate *= 10.0;
            }
        }
        scene.objects.retain(|object| matches!(object.shape, Shape::Bezier(_)));
        scene.camera = Camera { position: 10.0 * scene.camera.position, ..scene.camera };
        assert!(
            (scale(&scene) * 10.0 / before - 1.0).abs() < 1e-9,
            "a surface ten times as large is a tenth as curved"
        );
        assert_eq!(seen(&scene, analysis(None, true)).scale, None);
    }

    #[test]
    fn films_of_any_size_have_an_image() {
        let mut scene = SceneFile::built_in("report").unwrap().scene;
        for (width, height) in [(1, 1), (1, 16384), (16384, 16384)] {
            scene.film = Film { width, height, ..scene.film };
            let [columns, rows] = seen(&scene, analysis(None, true)).image.size;
            assert!((1..=1025).contains(&columns) && (1..=1025).contains(&rows), "{columns} x {rows}");
        }
    }
}
