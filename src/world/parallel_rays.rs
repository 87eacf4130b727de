use crate::geometry::Aggregate;
use crate::geometry::Primitive;
use crate::math::{OrthonormalBasis, Rgb, Sampler, warp};
use glam::{DVec2, DVec3};
use std::f64::consts::PI;

/// Rounding of the place where a sun's rays enter the scene, over the distance that they go back: they must begin before every surface.
const ROUNDING: f64 = 1e-6;

/// Rays that have one direction, or directions in a narrow cone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ParallelRays {
    /// Unit direction in which the light travels: the axis of the cone.
    pub direction: DVec3,
    /// Half the angle of the cone, radians; 0 for parallel rays.
    pub half_angle: f64,
    /// Irradiance of a plane across the direction, W/m^2.
    pub irradiance: Rgb,
    /// Center of the disc across the direction through which the light's paths go, scene units.
    pub center: DVec3,
    /// Radius of that disc, scene units.
    pub radius: f64,
    /// Whether the rays come from outside the scene, and light everything, as those of a sun; otherwise they begin on the disc, as those of
    /// a beam. The disc of a sun covers what its photons are to reach.
    pub from_outside: bool,
}

impl ParallelRays {
    /// Area of the disc, square scene units.
    pub fn area(&self) -> f64 {
        PI * self.radius * self.radius
    }

    /// Power through the disc, W.
    pub fn power(&self) -> Rgb {
        self.irradiance * self.area() as f32
    }

    /// The axes of the plane of the disc, and its normal, the direction.
    pub fn basis(&self) -> OrthonormalBasis {
        OrthonormalBasis::from_normal(self.direction)
    }

    /// Samples the direction in which light travels; returns it with the radiance, times the cosine to the axis, over the density of the
    /// direction. Draws numbers only for a cone.
    #[inline]
    pub fn sample_direction(&self, sampler: &mut Sampler) -> (DVec3, Rgb) {
        if self.half_angle == 0.0 {
            return (self.direction, self.irradiance);
        }
        let one_minus_cos = 2.0 * (0.5 * self.half_angle).sin().powi(2);
        let direction = self.basis().world_from_local(warp::uniform_cone(sampler.next_2d(), one_minus_cos));
        // The irradiance of a cone of even radiance L is L pi sin^2, the density 1 / (2 pi (1 - cos)), so the mean of the weight is 1.
        let weight = 2.0 * direction.dot(self.direction) / (2.0 - one_minus_cos);
        (direction, self.irradiance * weight as f32)
    }

    /// Where a path in this direction through a point crosses the plane of the disc: coordinates along the axes of the plane, radii.
    #[inline]
    pub fn crossing(&self, point: DVec3, direction: DVec3) -> DVec2 {
        let before = (self.center - point).dot(self.direction) / direction.dot(self.direction);
        let OrthonormalBasis { tangent, bitangent, .. } = self.basis();
        let offset = point + before * direction - self.center;
        DVec2::new(offset.dot(tangent), offset.dot(bitangent)) / self.radius
    }

    /// The point of the plane of the disc with these coordinates along its axes, radii.
    #[inline]
    pub fn point(&self, crossing: DVec2) -> DVec3 {
        self.center + self.basis().world_from_local((self.radius * crossing).extend(0.0))
    }

    /// Where a path in this direction through a point of the disc begins: on the disc, or before every surface of the scene.
    pub fn beginning(&self, aggregate: &Aggregate, point: DVec3, direction: DVec3) -> DVec3 {
        if !self.from_outside {
            return point;
        }
        let bounds = aggregate.bounds();
        let of_bounds =
            if bounds.is_empty() { 0.0 } else { (point - bounds.center()).dot(direction) + 0.5 * bounds.diagonal() };
        let to_plane = |primitive: &Primitive| match primitive {
            Primitive::Plane(plane) => {
                Some((point - plane.position(0.0, 0.0)).dot(plane.normal()) / direction.dot(plane.normal()))
            }
            _ => None,
        };
        let planes = aggregate.unbounded().filter_map(to_plane).filter(|t| t.is_finite());
        let back = planes.fold(of_bounds.max(0.0), f64::max);
        point - (back * (1.0 + ROUNDING) + ROUNDING * self.radius) * direction
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Stream;

    fn sun(half_angle: f64) -> ParallelRays {
        ParallelRays {
            direction: DVec3::new(0.3, -0.8, 0.2).normalize(),
            half_angle,
            irradiance: Rgb::new(1.0, 2.0, 3.0),
            center: DVec3::new(1.0, 2.0, 3.0),
            radius: 2.5,
            from_outside: true,
        }
    }

    #[test]
    fn directions_bring_the_irradiance_and_stay_in_the_cone() {
        let (sun, count) = (sun(0.4), 4096);
        let mut sum = 0.0;
        for index in 0..count {
            let mut sampler = Sampler::new(1, Stream::Probe, 0, index);
            let (direction, weight) = sun.sample_direction(&mut sampler);
            assert!(direction.angle_between(sun.direction) < 0.4 + 1e-9);
            sum += f64::from(weight.y) / count as f64;
        }
        assert!((sum - 2.0).abs() < 1e-3, "{sum}");
        assert_eq!(self::sun(0.0).sample_direction(&mut Sampler::new(1, Stream::Probe, 0, 0)).1, sun.irradiance);
    }

    #[test]
    fn a_path_crosses_the_disc_where_it_was_sent_through() {
        let sun = sun(0.4);
        let (crossing, direction) = (DVec2::new(0.3, -0.7), DVec3::new(0.1, -0.9, 0.3).normalize());
        let found = sun.crossing(sun.point(crossing) + 7.0 * direction, direction);
        assert!(found.distance(crossing) < 1e-12, "{found}");
    }
}
