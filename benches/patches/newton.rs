use glam::{DMat3, DVec3};
use patchlight::geometry::bezier::ControlNet;
use patchlight::math::{Aabb, Ray, Sampler, Stream};

/// The textbook method: damped Newton steps in (u, v, t) from random starts. Returns the nearest hit that they find.
pub(crate) struct NewtonPatch {
    net: ControlNet,
    bounds: Aabb,
}

const STARTS: u64 = 3;
const STEPS: usize = 60;
const DAMPING: f64 = 0.45;

impl NewtonPatch {
    pub(crate) fn new(net: ControlNet) -> Self {
        Self { net, bounds: net.bounds() }
    }

    fn intersect(&self, ray: &Ray) -> Option<f64> {
        (0..STARTS).filter_map(|start| self.root_from(ray, start)).min_by(f64::total_cmp)
    }

    fn root_from(&self, ray: &Ray, start: u64) -> Option<f64> {
        let mut sampler = Sampler::new(ray.direction.x.to_bits(), Stream::Camera, 0, start);
        let mut x = DVec3::new(sampler.next_1d(), sampler.next_1d(), 1.0);
        for _ in 0..STEPS {
            let (position, dpdu, dpdv) = evaluate(&self.net, x.x, x.y);
            let jacobian = DMat3::from_cols(dpdu, dpdv, -ray.direction);
            x -= DAMPING * (jacobian.inverse() * (position - ray.at(x.z)));
        }
        let inside = |x: f64| (0.0..=1.0).contains(&x);
        let found = self.net.eval(x.x, x.y).distance(ray.at(x.z)) < 1e-6 * self.bounds.diagonal();
        (found && inside(x.x) && inside(x.y) && ray.t_min < x.z && x.z < ray.t_max).then_some(x.z)
    }
}

/// The point and the partial derivatives by Bernstein polynomials.
fn evaluate(net: &ControlNet, u: f64, v: f64) -> (DVec3, DVec3, DVec3) {
    let weights = |t: f64| {
        let s = 1.0 - t;
        (
            [s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t],
            [-3.0 * s * s, 3.0 * s * (s - 2.0 * t), 3.0 * t * (2.0 * s - t), 3.0 * t * t],
        )
    };
    let ((bu, du), (bv, dv)) = (weights(u), weights(v));
    let (mut position, mut dpdu, mut dpdv) = (DVec3::ZERO, DVec3::ZERO, DVec3::ZERO);
    for (i, row) in net.points.iter().enumerate() {
        let along = |w: &[f64; 4]| w[0] * row[0] + w[1] * row[1] + w[2] * row[2] + w[3] * row[3];
        let on_row = along(&bv);
        position += bu[i] * on_row;
        dpdu += du[i] * on_row;
        dpdv += bu[i] * along(&dv);
    }
    (position, dpdu, dpdv)
}

/// The nearest hit on any patch.
pub(crate) fn closest_hit(patches: &[NewtonPatch], ray: &Ray) -> Option<f64> {
    patches.iter().filter_map(|patch| patch.intersect(ray)).min_by(f64::total_cmp)
}

/// The nearest hit on the patches whose box the ray meets.
pub(crate) fn closest_hit_behind_boxes(patches: &[NewtonPatch], ray: &Ray) -> Option<f64> {
    let inverse = ray.direction.recip();
    let meets = |bounds: &Aabb| {
        let (low, high) = ((bounds.min - ray.origin) * inverse, (bounds.max - ray.origin) * inverse);
        low.min(high).max_element() <= low.max(high).min_element()
    };
    patches.iter().filter(|patch| meets(&patch.bounds)).filter_map(|patch| patch.intersect(ray)).min_by(f64::total_cmp)
}
