//! Charts: how the unit square of a projection map covers the first rays of a light's paths.

use super::cone::Cone;
use super::small_targets::{Place, PlaceFromSquare};
use crate::geometry::Sphere;
use crate::math::{octahedral, warp};
use crate::world::{Light, ParallelRays};
use glam::{DVec2, DVec3};
use std::f64::consts::PI;

/// The map from the unit square to the first rays of paths; it keeps areas.
#[derive(Clone, Copy, Debug)]
pub(super) enum Chart {
    /// To the directions of paths from a ball that holds the light: the equal-area octahedral map \[Clarberg08\].
    Directions { center: DVec3, radius: f64 },
    /// To the points of the square around the disc of parallel rays.
    Disc(ParallelRays),
}

impl Chart {
    /// The chart of a light.
    pub(super) fn new(light: &Light) -> Self {
        match light {
            Light::Parallel(rays) => Self::Disc(*rays),
            _ => Self::Directions { center: light.center(), radius: light.bounding_radius() },
        }
    }

    /// The map from the square to places.
    #[inline]
    pub(super) fn place_from_square(&self) -> PlaceFromSquare {
        match self {
            Self::Directions { .. } => octahedral::direction_from_square,
            Self::Disc(_) => flat_place_from_square,
        }
    }

    /// The area of the triangle between the places of three points of the square, over the area of the chart. The edges of a triangle of
    /// directions are arcs of great circles: triangles side by side have neither gaps nor overlaps \[VanOosterom83\].
    pub(super) fn triangle_area(&self, corners: [DVec2; 3]) -> f64 {
        let [a, b, c] = corners.map(self.place_from_square());
        let across = (b - a).cross(c - a);
        let area = match self {
            Self::Directions { .. } => 2.0 * a.dot(across).abs().atan2(1.0 + a.dot(b) + b.dot(c) + c.dot(a)),
            Self::Disc(_) => 0.5 * across.length(),
        };
        area / (4.0 * PI)
    }

    /// Where a place lies in the square; beyond it for a place in the plane beyond the square.
    pub(super) fn square_from_place(&self, place: Place) -> DVec2 {
        match self {
            Self::Directions { .. } => octahedral::square_from_direction(place),
            Self::Disc(_) => place.truncate() / flat_side() + 0.5,
        }
    }

    /// A point of the plane of parallel rays from which a ray in this direction meets a ball, even over the ball's disc across them; the
    /// ball's center in a chart of directions.
    pub(super) fn point_before(&self, ball: Sphere, direction: DVec3, u: DVec2) -> DVec3 {
        match self {
            Self::Directions { .. } => ball.center,
            Self::Disc(rays) => {
                let within = ball.radius / rays.radius * warp::concentric_disc(u);
                rays.point(rays.crossing(ball.center, direction) + within)
            }
        }
    }

    /// The places of paths that may meet a ball; `None` if they surround the light.
    pub(super) fn cone(&self, Sphere { center, radius }: Sphere) -> Option<Cone> {
        match self {
            Self::Directions { radius: of_light, .. } => {
                self.cone_of_light_center(Sphere { center, radius: radius + of_light })
            }
            Self::Disc(_) => self.cone_of_light_center(Sphere { center, radius }),
        }
    }

    /// Whether any place of a cone is in the chart. Beside parallel rays none may be.
    pub(super) fn meets(&self, cone: &Cone) -> bool {
        let square = self.square_from_place(cone.middle);
        let nearest = self.place_from_square()(square.clamp(DVec2::ZERO, DVec2::ONE));
        nearest.distance(cone.middle) <= cone.radius
    }

    /// The places of paths from the center of the light that may meet a ball; `None` if they surround the light.
    pub(super) fn cone_of_light_center(&self, Sphere { center, radius }: Sphere) -> Option<Cone> {
        match self {
            Self::Directions { center: from, .. } => Cone::around(center - *from, radius),
            Self::Disc(rays) => {
                // A path aslant meets the ball beside its place.
                let aside = (center - rays.center).dot(rays.direction).abs() * rays.half_angle.tan();
                let radius = (radius + aside) * flat_side() / (2.0 * rays.radius);
                let middle = flat_place(rays.crossing(center, rays.direction));
                (radius < flat_side()).then_some(Cone { middle, radius })
            }
        }
    }
}

/// Side of the square in the plane.
fn flat_side() -> f64 {
    (4.0 * PI).sqrt()
}

fn flat_place_from_square(square: DVec2) -> Place {
    ((square - 0.5) * flat_side()).extend(0.0)
}

/// The place of a point of the plane of parallel rays with these coordinates, radii of the disc.
fn flat_place(crossing: DVec2) -> Place {
    (0.5 * flat_side() * crossing).extend(0.0)
}

/// The point of the plane of parallel rays at a place: coordinates, radii of the disc.
#[inline]
pub(super) fn crossing_at(place: Place) -> DVec2 {
    place.truncate() / (0.5 * flat_side())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::transport::testing;

    /// Over the poles of the octahedral map, too, where straight lines of the square are bent on the sphere.
    #[test]
    fn triangles_side_by_side_cover_the_chart() {
        let beam = "[[light]]\nname = \"l\"\ntype = \"beam\"\ncenter = [0, 1, 0]\ndirection = [0, -1, 0.2]\nradius = 0.3\npower = [1, 1, 1]\n";
        for light in [testing::lamp([0.0; 3]).as_str(), beam] {
            let chart = Chart::new(&testing::world(light).lights[0]);
            let side = 64;
            let corner =
                |k: u32, x: u32, y: u32| DVec2::new(f64::from(k % side + x), f64::from(k / side + y)) / f64::from(side);
            let cell = |k: u32| {
                let [a, b, c, d] = [(0, 0), (1, 0), (1, 1), (0, 1)].map(|(x, y)| corner(k, x, y));
                chart.triangle_area([a, b, c]) + chart.triangle_area([a, c, d])
            };
            let areas: Vec<f64> = (0..side * side).map(cell).collect();
            assert!((areas.iter().sum::<f64>() - 1.0).abs() < 1e-12, "{light}");
            let even = areas.iter().filter(|area| (**area * f64::from(side * side) - 1.0).abs() < 0.01).count();
            assert!(even > 3500, "the map keeps areas: {even} of 4096 cells");
        }
    }
}
