//! The one scattering event at mirrors and smooth dielectric interfaces, for camera paths, photons and caustic photons alike.

use super::bsdf;
use super::interface::Interface;
use super::vertex::Vertex;
use crate::math::{Rgb, Sampler};
use crate::world::{Lobe, Media, World};
use glam::DVec3;

/// How a mirror or an interface sends a path on.
pub(in crate::transport) struct SpecularEvent {
    /// Along the mirror direction.
    pub(in crate::transport) reflected: Continuation,
    /// Through the interface; `None` at mirrors and at total reflection.
    pub(in crate::transport) refracted: Option<Continuation>,
}

/// One direction in which a path goes on.
pub(in crate::transport) struct Continuation {
    /// Unit length.
    pub(in crate::transport) direction: DVec3,
    /// Reflectance of a mirror, tint of glass for refracted light, else 1.
    pub(in crate::transport) tint: Rgb,
    /// Fraction of the light that goes this way by Fresnel's equations, 0 to 1.
    pub(in crate::transport) fraction: f64,
    /// `eta^2` of a refracted direction, else 1. Radiance is divided by it, because the interface squeezes it into another solid
    /// angle; flux is not \[Veach97, 5.2\].
    solid_angle_ratio: f64,
    /// The media that the path is in from here on.
    pub(in crate::transport) media: Media,
    /// Whether light goes straight on, as if there were no surface.
    is_straight: bool,
}

impl SpecularEvent {
    /// The event at a vertex for a path in these media; `None` where the surface neither mirrors nor refracts.
    #[inline]
    pub(in crate::transport) fn at(world: &World, vertex: &Vertex, media: &Media) -> Option<Self> {
        match vertex.scattering.lobe {
            Lobe::None | Lobe::Phong { .. } => None,
            Lobe::Mirror { reflectance } => {
                Some(Self { reflected: Continuation::mirrored(vertex, media, reflectance, 1.0), refracted: None })
            }
            Lobe::Glass { tint, .. } => Some(Self::at_interface(world, vertex, media, tint)),
        }
    }

    #[inline]
    fn at_interface(world: &World, vertex: &Vertex, media: &Media, tint: Rgb) -> Self {
        let (before, behind) = world.across(&vertex.point, media);
        let ior = |media: &Media| world.body(media).map_or(1.0, |body| body.ior);
        let eta = ior(&behind) / ior(&before);
        if eta == 1.0 {
            // A surface inside of a body that counts on both sides is no surface of it.
            let tint = if before.body() == behind.body() { Rgb::ONE } else { tint };
            let reflected = Continuation::mirrored(vertex, &before, Rgb::ONE, 0.0);
            let on = Continuation {
                direction: -vertex.wo,
                tint,
                fraction: 1.0,
                solid_angle_ratio: 1.0,
                media: behind,
                is_straight: true,
            };
            return Self { reflected, refracted: Some(on) };
        }
        let Interface { reflectance, reflected, refracted } =
            Interface::new(vertex.wo, vertex.n_shade, vertex.n_side, eta);
        let reflected = Continuation::reflected(reflected, &before, Rgb::ONE, reflectance);
        let refracted = refracted.map(|direction| Continuation {
            direction,
            tint,
            fraction: 1.0 - reflectance,
            solid_angle_ratio: eta * eta,
            media: behind,
            is_straight: false,
        });
        Self { reflected, refracted }
    }

    /// Whether the path goes on in two directions.
    #[inline]
    pub(in crate::transport) fn is_divided(&self) -> bool {
        self.refracted.is_some() && self.reflected.fraction > 0.0
    }

    /// One of the directions, each with its fraction as probability, by a number in `[0, 1)`; first whether it is the reflected one.
    #[inline]
    pub(in crate::transport) fn choose(self, u: f64) -> (bool, Continuation) {
        match self.refracted {
            Some(refracted) if u >= self.reflected.fraction => (false, refracted),
            _ => (true, self.reflected),
        }
    }
}

impl Continuation {
    /// The factor of radiance along a camera path, without the Fresnel fraction.
    #[inline]
    pub(in crate::transport) fn radiance_weight(&self) -> Rgb {
        self.tint / self.solid_angle_ratio as f32
    }

    /// The factor of flux by the numbers of the material alone, against which the energy balance checks the tint. Where light does not meet the
    /// tint of glass, that factor is exactly 1.
    #[inline]
    pub(in crate::transport) fn material_tint(&self, lobe: &Lobe) -> Rgb {
        match *lobe {
            Lobe::Mirror { reflectance } => reflectance,
            Lobe::Glass { tint } if self.tint != Rgb::ONE => tint,
            _ => Rgb::ONE,
        }
    }

    /// The number of scattering events of a path that had `bounces` of them before. A surface that light does not see counts only as the
    /// first event: it tells light that comes through glass from direct light.
    #[inline]
    pub(in crate::transport) fn bounces_after(&self, bounces: u32) -> u32 {
        bounces + u32::from(!self.is_straight || bounces == 0)
    }

    #[inline]
    fn mirrored(vertex: &Vertex, media: &Media, tint: Rgb, fraction: f64) -> Self {
        let direction = bsdf::reflect_above(vertex.wo, vertex.n_shade, vertex.n_side);
        Self::reflected(direction, media, tint, fraction)
    }

    #[inline]
    fn reflected(direction: DVec3, media: &Media, tint: Rgb, fraction: f64) -> Self {
        Self { direction, tint, fraction, solid_angle_ratio: 1.0, media: media.clone(), is_straight: false }
    }
}

/// Russian roulette for a path of this strength: the probability with which it went on, 1 from the threshold on; `None` where it
/// ends. The caller divides by the probability.
#[inline]
pub(in crate::transport) fn roulette(strength: f32, threshold: f32, sampler: &mut Sampler) -> Option<f32> {
    // Written so that a strength of NaN goes on: the film counts and drops it.
    if !(strength < threshold) {
        return Some(1.0);
    }
    let survival = strength / threshold;
    (sampler.next_1d() < f64::from(survival)).then_some(survival)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::{Ray, Stream};
    use crate::transport::testing::{self, sphere};
    use glam::DVec3;

    /// A glass ball of radius 1 in a ball of water of radius 2, both absorbing.
    fn glass_in_water() -> World {
        let materials = "[[material]]\nname = \"water\"\ntype = \"glass\"\nior = 1.33\nabsorption = [0.1, 0.2, 0]
            [[material]]\nname = \"glass\"\ntype = \"glass\"\nior = 1.5\nabsorption = [0.3, 0, 0.4]\ntint = [1, 1, 0.5]\n";
        let balls = [sphere("pond", [0.0; 3], 2.0, "water"), sphere("marble", [0.0; 3], 1.0, "glass")];
        testing::world(&[materials, &balls.concat()].concat())
    }

    /// Straight through the middle of glass in water in air: at normal incidence each interface passes `4 a b / (a + b)^2` of the light,
    /// and the bodies absorb over 1, 2 and 1 units.
    #[test]
    fn nested_glass_transmits_by_fresnel_and_beer() {
        let world = glass_in_water();
        let (mut ray, mut media) = (Ray::new(DVec3::new(0.0, 0.0, 4.0), DVec3::NEG_Z), Media::default());
        let (mut flux, mut radiance) = (Rgb::ONE, Rgb::ONE);
        for (before, behind) in [(1.0, 1.33), (1.33, 1.5), (1.5, 1.33), (1.33, 1.0f64)] {
            let vertex = testing::vertex(&world, &ray);
            let absorbed = world.transmittance(&media, vertex.point.position.distance(ray.origin));
            let SpecularEvent { reflected, refracted } = SpecularEvent::at(&world, &vertex, &media).expect("glass");
            let refracted = refracted.expect("there is no total reflection at normal incidence");
            let passed = 4.0 * before * behind / (before + behind).powi(2);
            assert!((refracted.fraction - passed).abs() < 1e-12, "from {before} to {behind}: {}", refracted.fraction);
            assert!((reflected.fraction + refracted.fraction - 1.0).abs() < 1e-12, "nothing is lost");
            assert!(reflected.direction.distance(DVec3::Z) < 1e-9 && refracted.direction.distance(DVec3::NEG_Z) < 1e-9);
            let weight = refracted.radiance_weight() * (behind / before).powi(2) as f32;
            assert!((weight - refracted.tint).length() < 1e-5, "radiance is squeezed by eta^2");
            flux *= absorbed * refracted.tint * refracted.fraction as f32;
            radiance *= absorbed * refracted.radiance_weight() * refracted.fraction as f32;
            (ray, media) = (vertex.ray(&world, refracted.direction), refracted.media);
        }
        let interfaces = (4.0 * 1.33 / 2.33f32.powi(2) * 4.0 * 1.33 * 1.5 / 2.83f32.powi(2)).powi(2);
        let (water, glass) = (Rgb::new(0.1, 0.2, 0.0), Rgb::new(0.3, 0.0, 0.4));
        let expected = interfaces * (-2.0 * water - 2.0 * glass).exp() * Rgb::new(1.0, 1.0, 0.25);
        assert!((flux - expected).length() < 1e-5, "{flux} instead of {expected}");
        assert!((radiance - expected).length() < 1e-5, "back in air, radiance is squeezed no more: {radiance}");
        assert_eq!(media, Media::default(), "outside all bodies");
    }

    #[test]
    fn light_does_not_see_a_surface_inside_of_a_body_that_counts() {
        // The pond's surface inside of a ball of glass that sticks out of it.
        let materials = "[[material]]\nname = \"water\"\ntype = \"glass\"\nior = 1.33\ntint = [0.5, 0.5, 0.5]
            [[material]]\nname = \"glass\"\ntype = \"glass\"\nior = 1.5\n";
        let balls = [sphere("pond", [0.0; 3], 2.0, "water"), sphere("marble", [0.0, 0.0, 2.0], 1.0, "glass")];
        let world = testing::world(&[materials, &balls.concat()].concat());
        let ray = Ray::new(DVec3::new(0.3, 0.0, 2.5), DVec3::new(0.1, 0.0, -1.0).normalize());
        let in_glass = world.media_around(ray.origin);
        let event = SpecularEvent::at(&world, &testing::vertex(&world, &ray), &in_glass).expect("water");
        assert!(!event.is_divided());
        let (_, on) = event.choose(0.0);
        assert!(on.direction == ray.direction && on.radiance_weight() == Rgb::ONE && on.fraction == 1.0);
        assert_eq!((on.bounces_after(0), on.bounces_after(3)), (1, 3), "no scattering event, but not direct light");
        assert_eq!(on.media.body(), in_glass.body());
        assert_ne!(on.media, in_glass, "the water is around it too from here on");
    }

    #[test]
    fn light_that_is_totally_reflected_stays_inside() {
        let world = glass_in_water();
        let inside = world.media_around(DVec3::new(-0.3, 1.9, 0.0));
        // At height 1.9 of 2 in the water the sine is 0.95, beyond that of the critical angle, 1 / 1.33.
        let ray = Ray::new(DVec3::new(-0.3, 1.9, 0.0), DVec3::X);
        let event = SpecularEvent::at(&world, &testing::vertex(&world, &ray), &inside).expect("water");
        assert!(event.refracted.is_none() && event.reflected.fraction == 1.0);
        let (_, on) = event.choose(0.999);
        let outward = DVec3::new((4.0f64 - 1.9 * 1.9).sqrt(), 1.9, 0.0) / 2.0;
        assert!(on.direction.dot(outward) < 0.0);
        assert_eq!(on.media, inside, "the water is around the path still");
    }

    #[test]
    fn directions_are_chosen_by_their_share_of_the_light() {
        let world = glass_in_water();
        let ray = Ray::new(DVec3::new(1.8, 0.0, 4.0), DVec3::NEG_Z);
        let vertex = testing::vertex(&world, &ray);
        let at = || SpecularEvent::at(&world, &vertex, &Media::default()).expect("water");
        let reflected = at().reflected;
        let n = 10_000;
        let is_reflected = |k: i32| at().choose((f64::from(k) + 0.5) / f64::from(n)).0;
        let found = (0..n).filter(|&k| is_reflected(k)).count() as f64 / f64::from(n);
        assert!(reflected.fraction > 0.04 && (found - reflected.fraction).abs() < 1e-4, "{found}");
    }

    /// Strength over survival, averaged, is the strength: roulette has no bias.
    #[test]
    fn roulette_keeps_the_mean() {
        for strength in [1e-3f32, 0.2, 0.7, 1.0, 3.0] {
            let n = 1 << 14;
            let kept = |k| roulette(strength, 1.0, &mut Sampler::new(2, Stream::Camera, 0, k)).map(|p| strength / p);
            let mean = (0..n).filter_map(kept).map(f64::from).sum::<f64>() / n as f64;
            // The sequence is stratified: the number of survivors is exact to one.
            assert!((mean - f64::from(strength)).abs() < 2.0 / n as f64 + 1e-6, "{mean} instead of {strength}");
        }
        assert!(
            roulette(f32::NAN, 1.0, &mut Sampler::new(2, Stream::Camera, 0, 0)) == Some(1.0),
            "for the film to count"
        );
    }
}
