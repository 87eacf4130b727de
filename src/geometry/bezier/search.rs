//! The nearest root by subdivision: halve the patch until a part is missed for certain or holds at most one root,
//! which Newton's method then finds.

use super::ray_net::{RayNet, RaySpace, Roots};

/// Roots this far outside of a part's domain, in (u, v), still count: neighbouring parts and patches overlap by far
/// more than rounding, hence no ray slips between them, and by far less than anyone can see.
const DOMAIN_SLACK: f64 = 1e-9;

/// A part that lies within this distance of the ray, relative to the size of the patch, is a hit even where no single
/// root can be told apart: at a point where the ray touches the surface.
const TOUCHING: f64 = 1e-9;

/// Halvings after which a part counts as a point.
const MAX_DEPTH: usize = 80;

/// Parts looked at before giving up on a ray that runs within the surface; ordinary rays need a few dozen.
const MAX_PARTS: usize = 20_000;

/// Part of the parameter square.
#[derive(Clone, Copy)]
struct Domain {
    u: (f64, f64),
    v: (f64, f64),
}

/// A root in ray space.
#[derive(Clone, Copy)]
pub(super) struct Root {
    pub(super) t: f64,
    pub(super) u: f64,
    pub(super) v: f64,
}

/// One search along one ray.
pub(super) struct Search<'a> {
    net: &'a RayNet,
    space: &'a RaySpace,
    /// Length scale of the patch.
    size: f64,
    t_min: f64,
    t_max: f64,
    best: Option<Root>,
    parts_left: usize,
}

impl<'a> Search<'a> {
    /// A search for the root with the smallest t in `t_min < t < t_max`, on a patch of this size.
    pub(super) fn new(net: &'a RayNet, space: &'a RaySpace, size: f64, t_min: f64, t_max: f64) -> Self {
        Self { net, space, size, t_min, t_max, best: None, parts_left: MAX_PARTS }
    }

    /// The nearest root, if there is one.
    pub(super) fn run(mut self) -> Option<Root> {
        let whole = Domain { u: (0.0, 1.0), v: (0.0, 1.0) };
        let net = *self.net;
        self.visit(&net, whole, 0);
        self.best
    }

    fn visit(&mut self, part: &RayNet, domain: Domain, depth: usize) {
        if self.parts_left == 0 {
            return;
        }
        self.parts_left -= 1;
        if self.is_missed(&part.bounds()) {
            return;
        }
        let part = part.turned();
        let bounds = part.bounds();
        if self.is_missed(&bounds) {
            return;
        }
        match part.roots() {
            Roots::None => {}
            Roots::AtMostOne => self.solve(domain),
            Roots::Unknown if self.is_touching(&bounds) => {
                self.accept(0.5 * (domain.u.0 + domain.u.1), 0.5 * (domain.v.0 + domain.v.1));
            }
            Roots::Unknown if depth == MAX_DEPTH => {}
            Roots::Unknown => self.split(&part, domain, depth),
        }
    }

    /// Whether the box of a part's control points is off the ray, or off the part of the ray that still counts.
    fn is_missed(&self, bounds: &[(f64, f64); 3]) -> bool {
        let slack = 1e-14 * self.size;
        let [x, y, z] = bounds;
        x.0 > slack
            || x.1 < -slack
            || y.0 > slack
            || y.1 < -slack
            || z.1 < self.space.z_from_t(self.t_min) - slack
            || z.0 > self.space.z_from_t(self.t_max) + slack
    }

    fn is_touching(&self, bounds: &[(f64, f64); 3]) -> bool {
        bounds.iter().all(|(low, high)| high - low <= TOUCHING * self.size)
    }

    /// Visits the halves, the nearer one first.
    fn split(&mut self, part: &RayNet, domain: Domain, depth: usize) {
        let middle_u = 0.5 * (domain.u.0 + domain.u.1);
        let middle_v = 0.5 * (domain.v.0 + domain.v.1);
        let ([a, b], domain_a, domain_b) = if part.splits_across_u() {
            let (low, high) = ((domain.u.0, middle_u), (middle_u, domain.u.1));
            (part.split_u(), Domain { u: low, ..domain }, Domain { u: high, ..domain })
        } else {
            let (low, high) = ((domain.v.0, middle_v), (middle_v, domain.v.1));
            (part.split_v(), Domain { v: low, ..domain }, Domain { v: high, ..domain })
        };
        if a.bounds()[2].0 <= b.bounds()[2].0 {
            self.visit(&a, domain_a, depth + 1);
            self.visit(&b, domain_b, depth + 1);
        } else {
            self.visit(&b, domain_b, depth + 1);
            self.visit(&a, domain_a, depth + 1);
        }
    }

    /// Newton's method on a domain that holds at most one root. Steps are clamped to the domain; where they end on its
    /// boundary without a root, there is none inside.
    fn solve(&mut self, domain: Domain) {
        let clamp = |x: f64, (low, high): (f64, f64)| x.clamp(low - DOMAIN_SLACK, high + DOMAIN_SLACK);
        let mut u = 0.5 * (domain.u.0 + domain.u.1);
        let mut v = 0.5 * (domain.v.0 + domain.v.1);
        for _ in 0..32 {
            let p = self.net.eval(u, v);
            let determinant = p.du.perp_dot(p.dv);
            let step_u = p.dv.perp_dot(p.xy) / determinant;
            let step_v = p.xy.perp_dot(p.du) / determinant;
            let next = (clamp(u + step_u, domain.u), clamp(v + step_v, domain.v));
            if next == (u, v) || (step_u.abs().max(step_v.abs())) < 1e-14 {
                break;
            }
            (u, v) = next;
        }
        let p = self.net.eval(u, v);
        let determinant = p.du.perp_dot(p.dv);
        let step_u = p.dv.perp_dot(p.xy) / determinant;
        let step_v = p.xy.perp_dot(p.du) / determinant;
        if step_u.abs().max(step_v.abs()) <= DOMAIN_SLACK || p.xy.abs().max_element() <= 1e-14 * self.size {
            self.accept(u, v);
        }
    }

    fn accept(&mut self, u: f64, v: f64) {
        let (u, v) = (u.clamp(0.0, 1.0), v.clamp(0.0, 1.0));
        let t = self.space.t_from_z(self.net.eval(u, v).z);
        if self.t_min < t && t < self.t_max {
            self.t_max = t;
            self.best = Some(Root { t, u, v });
        }
    }
}
