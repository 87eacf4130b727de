use super::ray::{NEAR, Ray};
use glam::{DMat3, DVec3};
use std::sync::Arc;

/// The 4 x 4 control points of a patch, the first index along u.
pub(super) type Net = [[DVec3; 4]; 4];

/// A simple shape.
pub(super) enum Shape {
    Sphere {
        center: DVec3,
        radius: f64,
    },
    Quad {
        corner: DVec3,
        edge_u: DVec3,
        edge_v: DVec3,
    },
    Plane {
        point: DVec3,
        normal: DVec3,
    },
    /// A piece of a patch over a small square of its parameters, nearly flat.
    Cell {
        net: Arc<Net>,
        low: [f64; 2],
        side: f64,
        is_mirrored: bool,
    },
}

/// Cells along each side of a patch: on a quarter circle 2.8 degrees each.
const CELLS: usize = 32;
/// Steps of Newton's method: on a nearly flat cell each step doubles the digits.
const STEPS: usize = 6;

impl Shape {
    /// The cells of a patch.
    pub(super) fn cells(net: Net, is_mirrored: bool) -> impl Iterator<Item = Self> {
        let (net, side) = (Arc::new(net), 1.0 / CELLS as f64);
        (0..CELLS * CELLS).map(move |k| Self::Cell {
            net: net.clone(),
            low: [(k / CELLS) as f64 * side, (k % CELLS) as f64 * side],
            side,
            is_mirrored,
        })
    }

    /// Two opposite corners of a box around the shape; `None` for a plane.
    pub(super) fn bounds(&self) -> Option<[DVec3; 2]> {
        match self {
            Self::Sphere { center, radius } => Some([*center - *radius, *center + *radius]),
            Self::Quad { corner, edge_u, edge_v } => {
                Some(around([*corner, corner + edge_u, corner + edge_v, corner + edge_u + edge_v]))
            }
            Self::Plane { .. } => None,
            Self::Cell { net, low: [u, v], side, .. } => {
                let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0], [0.5, 0.5]];
                let [min, max] = around(corners.map(|[x, y]| eval(net, u + x * side, v + y * side)[0]));
                // The sagitta is below a hundredth of a nearly flat cell.
                let margin = 0.1 * (max - min).length();
                Some([min - margin, max + margin])
            }
        }
    }

    /// Calls `found` with the distance and the normal of each hit.
    pub(super) fn intersect(&self, ray: &Ray, mut found: impl FnMut(f64, DVec3)) {
        match self {
            Self::Sphere { center, radius } => {
                let to_center = center - ray.origin;
                let along = to_center.dot(ray.direction);
                let squared = radius * radius - (to_center - along * ray.direction).length_squared();
                if squared >= 0.0 {
                    for distance in [along - squared.sqrt(), along + squared.sqrt()] {
                        found(distance, (ray.at(distance) - center) / radius);
                    }
                }
            }
            Self::Quad { corner, edge_u, edge_v } => {
                // corner + u edge_u + v edge_v = origin + distance direction
                let columns = DMat3::from_cols(*edge_u, *edge_v, -ray.direction);
                if columns.determinant() != 0.0 {
                    let solution = columns.inverse() * (ray.origin - corner);
                    if (0.0..=1.0).contains(&solution.x) && (0.0..=1.0).contains(&solution.y) {
                        found(solution.z, edge_u.cross(*edge_v).normalize());
                    }
                }
            }
            Self::Plane { point, normal } => {
                let cos = normal.dot(ray.direction);
                if cos != 0.0 {
                    found((point - ray.origin).dot(*normal) / cos, *normal);
                }
            }
            Self::Cell { net, low, side, is_mirrored } => {
                // A ray near the silhouette meets a cell twice: each root has a start nearby.
                for start in [[0.2, 0.2], [0.8, 0.2], [0.2, 0.8], [0.8, 0.8]] {
                    if let Some((distance, normal)) = newton(net, ray, *low, *side, start) {
                        found(distance, if *is_mirrored { -normal } else { normal });
                    }
                }
            }
        }
    }

    /// A point, its normal, and the area of the shape, for two numbers from 0 to 1; a lamp is a sphere or a quad.
    pub(super) fn sample(&self, x: f64, y: f64) -> (DVec3, DVec3, f64) {
        use std::f64::consts::{PI, TAU};
        match self {
            Self::Sphere { center, radius } => {
                let z = 1.0 - 2.0 * x;
                let (sin, cos) = (TAU * y).sin_cos();
                let ring = (1.0 - z * z).sqrt();
                let normal = DVec3::new(ring * cos, ring * sin, z);
                (*center + *radius * normal, normal, 4.0 * PI * radius * radius)
            }
            Self::Quad { corner, edge_u, edge_v } => {
                let across = edge_u.cross(*edge_v);
                (corner + x * edge_u + y * edge_v, across.normalize(), across.length())
            }
            Self::Plane { .. } | Self::Cell { .. } => unreachable!("lamps are spheres and quads"),
        }
    }
}

fn around<const N: usize>(points: [DVec3; N]) -> [DVec3; 2] {
    let min = points.iter().fold(DVec3::INFINITY, |a, b| a.min(*b));
    [min, points.iter().fold(DVec3::NEG_INFINITY, |a, b| a.max(*b))]
}

/// The position on a patch and its derivatives by u and v.
fn eval(net: &Net, u: f64, v: f64) -> [DVec3; 3] {
    let weights = |t: f64| {
        let s = 1.0 - t;
        [s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t]
    };
    let slopes = |t: f64| {
        let s = 1.0 - t;
        [-3.0 * s * s, 3.0 * s * (s - 2.0 * t), 3.0 * t * (2.0 * s - t), 3.0 * t * t]
    };
    let sum = |a: [f64; 4], b: [f64; 4]| (0..16).map(|k| a[k / 4] * b[k % 4] * net[k / 4][k % 4]).sum::<DVec3>();
    [sum(weights(u), weights(v)), sum(slopes(u), weights(v)), sum(weights(u), slopes(v))]
}

/// The distance and the normal where a ray meets a cell, by Newton's method from a start within the cell.
fn newton(net: &Net, ray: &Ray, [low_u, low_v]: [f64; 2], side: f64, start: [f64; 2]) -> Option<(f64, DVec3)> {
    let (mut u, mut v) = (low_u + start[0] * side, low_v + start[1] * side);
    let mut distance = 0.0;
    for _ in 0..STEPS {
        let [position, by_u, by_v] = eval(net, u, v);
        let columns = DMat3::from_cols(by_u, by_v, -ray.direction);
        let step = columns.inverse() * (ray.origin - position);
        (u, v, distance) = (u + step.x, v + step.y, step.z);
        // Farther off, it is another cell's root, or none.
        if !((u - low_u).abs() < 3.0 * side && (v - low_v).abs() < 3.0 * side) {
            return None;
        }
    }
    let is_inside = |x: f64, low: f64| x >= low - 1e-9 && x <= low + side + 1e-9;
    let [position, by_u, by_v] = eval(net, u, v);
    let is_root = position.distance(ray.at(distance)) < 1e-3 * NEAR;
    (is_root && is_inside(u, low_u) && is_inside(v, low_v)).then(|| (distance, by_u.cross(by_v).normalize()))
}
