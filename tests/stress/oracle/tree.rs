use super::ray::Ray;
use glam::DVec3;

/// A tree of boxes over the items with bounds, halved along the longest side.
pub(super) enum Tree {
    Leaf(Vec<usize>),
    Node([DVec3; 2], Box<[Tree; 2]>),
}

/// Most items in a leaf.
const LEAF: usize = 4;

impl Tree {
    /// The tree over these items, which have a number and a box each.
    pub(super) fn new(mut items: Vec<(usize, [DVec3; 2])>) -> Self {
        if items.len() <= LEAF {
            return Self::Leaf(items.into_iter().map(|(item, _)| item).collect());
        }
        let min = items.iter().fold(DVec3::INFINITY, |a, (_, [b, _])| a.min(*b));
        let max = items.iter().fold(DVec3::NEG_INFINITY, |a, (_, [_, b])| a.max(*b));
        let axis = (0..3).max_by(|&a, &b| (max - min)[a].total_cmp(&(max - min)[b])).unwrap_or(0);
        items.sort_by(|a, b| (a.1[0][axis] + a.1[1][axis]).total_cmp(&(b.1[0][axis] + b.1[1][axis])));
        let upper = items.split_off(items.len() / 2);
        Self::Node([min, max], Box::new([Self::new(items), Self::new(upper)]))
    }

    /// Calls `visit` with the items whose box the ray may meet before the distance that `visit` returned last.
    pub(super) fn visit(&self, ray: &Ray, nearest: &mut f64, visit: &mut impl FnMut(usize, &mut f64)) {
        match self {
            Self::Leaf(items) => items.iter().for_each(|item| visit(*item, nearest)),
            Self::Node(bounds, halves) => {
                if is_met(bounds, ray, *nearest) {
                    halves.iter().for_each(|half| half.visit(ray, nearest, visit));
                }
            }
        }
    }
}

fn is_met([min, max]: &[DVec3; 2], ray: &Ray, nearest: f64) -> bool {
    let inverse = ray.direction.recip();
    let (a, b) = ((min - ray.origin) * inverse, (max - ray.origin) * inverse);
    let (enters, leaves) = (a.min(b).max_element().max(0.0), a.max(b).min_element());
    // Written so that NaN, of a ray within a face of the box, counts as met.
    !(enters > leaves + 1e-9 || enters > nearest)
}
