use crate::geometry::bezier::ControlNet;
use crate::math::{Aabb, OrthonormalBasis, Ray};
use glam::{DMat3, DVec3, Vec3Swizzles};

/// The map from scene space to the unit space of a patch, where the center of the patch's box is the origin and the box's
/// diagonal is between 1/4 and 1. Tolerances in unit space suit every patch, and a patch far from the world's origin loses
/// no digits.
///
/// The map is affine: rays remain lines with the same parameter t, and patches remain patches. It is a similarity except for needles.
/// Bounds in unit space are stored in single precision and cannot distinguish the parts of a patch that is 1e-6 wide, so the map widens
/// needles.
#[derive(Clone, Copy, Debug)]
pub(crate) struct UnitMap {
    /// The center of the patch's box; for a needle a control point at one of its ends.
    origin: DVec3,
    /// A power of two, by which scaling is exact.
    scale: f64,
    widening: Option<Widening>,
}

/// The map of a needle's offsets from the origin to unit space.
#[derive(Clone, Copy, Debug)]
struct Widening {
    /// Its determinant is positive.
    linear: DMat3,
    /// The center of the patch's box, as `linear` maps it.
    center: DVec3,
}

/// A patch longer than this many times its width is a needle. Measured with one control point of a random patch moved away: rays that
/// hit take a fifth longer at a length of 17 widths, twice as long at 170, eight times as long at 170,000.
const NEEDLE: f64 = 32.0;

/// The width along a scene axis, over the width along the needle, up to which the axis stands for the needle: coordinates along an axis are
/// not mixed, thus not rounded.
const ALIGNED: f64 = 2.0;

impl UnitMap {
    /// The map for a patch with this net, in scene space; NaN where a coordinate is not finite.
    pub(crate) fn new(net: &ControlNet) -> Self {
        let bounds = if net.is_finite() { net.bounds() } else { Aabb::EMPTY };
        let scale = reciprocal_size(bounds.diagonal());
        Self::of_needle(net).unwrap_or(Self { origin: bounds.center(), scale, widening: None })
    }

    /// The map that widens a needle; `None` for other patches.
    fn of_needle(net: &ControlNet) -> Option<Self> {
        let ends = ends(net);
        let axis = (ends[1] - ends[0]).try_normalize()?;
        let scene_axis = DVec3::AXES.into_iter().max_by(|a, b| a.dot(axis).abs().total_cmp(&b.dot(axis).abs()))?;
        let frames = [scene_axis, axis].map(|axis| NeedleFrame::new(net, ends[0], axis));
        let frame = &frames[usize::from(frames[0].width() > ALIGNED * frames[1].width())];
        let (length, width) = (frame.bounds.size().x, frame.width());
        // Twice the size, since the diagonal of both together may not exceed 1.
        let (along, across) = (reciprocal_size(2.0 * length), reciprocal_size(2.0 * width));
        let linear = DMat3::from_diagonal(DVec3::new(along, across, across)) * frame.from_scene;
        let center = DVec3::new(along, across, across) * frame.bounds.center();
        let is_needle = width > 0.0 && length > NEEDLE * width;
        is_needle.then_some(Self { origin: ends[0], scale: across, widening: Some(Widening { linear, center }) })
    }

    /// The greatest number of unit lengths per scene unit.
    pub(crate) fn scale(&self) -> f64 {
        self.scale
    }

    /// Maps a point from scene space to unit space.
    pub(crate) fn point(&self, p: DVec3) -> DVec3 {
        match &self.widening {
            None => (p - self.origin) * self.scale,
            Some(Widening { linear, center }) => *linear * (p - self.origin) - center,
        }
    }

    /// Maps a unit normal from unit space to scene space.
    pub(crate) fn normal_to_scene(&self, n: DVec3) -> DVec3 {
        match &self.widening {
            None => n,
            // The inverse transpose of the inverse map.
            Some(Widening { linear, .. }) => (linear.transpose() * n).normalize_or(n),
        }
    }

    /// Maps a ray to unit space. `None` where it misses the ball around the patch, or has no direction.
    pub(crate) fn ray(&self, ray: &Ray) -> Option<UnitRay> {
        let direction = match &self.widening {
            None => ray.direction * self.scale,
            Some(Widening { linear, .. }) => *linear * ray.direction,
        };
        let speed = direction.length();
        let direction = direction / speed;
        let from_center = self.point(ray.origin);
        let distance = -from_center.dot(direction);
        let origin = from_center + distance * direction;
        let z = |t: f64| t * speed - distance;
        let unit = UnitRay {
            origin,
            direction,
            z_min: z(ray.t_min).max(-1.0),
            z_max: z(ray.t_max).min(1.0),
            speed,
            distance,
            t_min: ray.t_min,
            t_max: ray.t_max,
        };
        // The patch lies in the ball of radius 1/2. The comparisons are false for NaN, which is a miss.
        (origin.length_squared() <= 0.2501 && unit.z_min <= unit.z_max).then_some(unit)
    }
}

/// A ray in unit space: the points `origin + z * direction`. Its origin is the point nearest to the center of the patch, so
/// that a ray that starts far away loses no digits near the patch.
#[derive(Clone, Copy, Debug)]
pub(crate) struct UnitRay {
    /// The point at z = 0.
    pub(crate) origin: DVec3,
    /// Unit length.
    pub(crate) direction: DVec3,
    /// Roots below this are no hits. At least -1: the patch lies within `-1 < z < 1`.
    pub(crate) z_min: f64,
    /// Roots above this are no hits. At most 1; shrinks to the nearest hit so far.
    pub(crate) z_max: f64,
    /// Unit lengths per unit of t.
    speed: f64,
    /// From the origin of the scene ray to `origin`, in unit lengths.
    distance: f64,
    t_min: f64,
    t_max: f64,
}

impl UnitRay {
    /// A ray that misses every patch.
    pub(crate) const MISS: Self = Self {
        origin: DVec3::ZERO,
        direction: DVec3::Z,
        z_min: 1.0,
        z_max: -1.0,
        speed: 1.0,
        distance: 0.0,
        t_min: 0.0,
        t_max: 0.0,
    };

    /// The parameter t of the scene ray at z; `None` outside `t_min < t < t_max`.
    pub(crate) fn t_in_range(&self, z: f64) -> Option<f64> {
        let t = (z + self.distance) / self.speed;
        (self.t_min < t && t < self.t_max).then_some(t)
    }
}

/// The power of two that scales a length to between 1/2 and 1; 1 for an empty or unknown length.
fn reciprocal_size(length: f64) -> f64 {
    let exponent = if length > 0.0 { (length.log2().ceil() as i32).clamp(-1000, 1000) } else { 0 };
    2f64.powi(-exponent)
}

/// Two control points that are about as far apart as any; the first one is nearer to the mean of all, since most points of a needle may
/// lie at one of its ends.
fn ends(net: &ControlNet) -> [DVec3; 2] {
    let points = || net.points.iter().flatten().copied();
    let mean = points().sum::<DVec3>() / 16.0;
    let distance = |a: &DVec3, b: DVec3| a.distance_squared(b);
    let farthest =
        |from: DVec3| points().fold(from, |far, p| if distance(&p, from) > distance(&far, from) { p } else { far });
    let a = farthest(mean);
    let b = farthest(a);
    if distance(&a, mean) < distance(&b, mean) { [a, b] } else { [b, a] }
}

/// A net in the frame of a needle.
struct NeedleFrame {
    /// The rotation from scene space to a frame with its x axis along the needle.
    from_scene: DMat3,
    /// The box of the control points in this frame.
    bounds: Aabb,
}

impl NeedleFrame {
    fn new(net: &ControlNet, origin: DVec3, axis: DVec3) -> Self {
        let OrthonormalBasis { tangent, bitangent, normal } = OrthonormalBasis::from_normal(axis);
        let from_scene = DMat3::from_cols(normal, tangent, bitangent).transpose();
        let points = net.points.iter().flatten();
        Self { from_scene, bounds: Aabb::around(points.map(|&p| from_scene * (p - origin))) }
    }

    /// The diagonal of the box's cross section.
    fn width(&self) -> f64 {
        self.bounds.size().yz().length()
    }
}
