use super::SharedEdges;
use super::edge::Edge;
use super::seam::{Seam, seams};
use super::union_find::UnionFind;
use super::weld::weld;
use crate::geometry::bezier::ControlNet;

/// Least cosine between the normals of two patches along a seam of one sheet, an angle of 14 degrees: a disc of a density estimate
/// holds photons a quarter of its radius off its plane, so up to this angle those of both patches.
const SMOOTH: f64 = 0.97;
/// Least cosine along a seam over which a disc goes on where a crease ends within a sheet: photons beyond it count in any case.
const CREASED: f64 = 0.5;

/// The place of a patch in the sheets of its object.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(in crate::world) struct Place {
    /// The first patch of its sheet, by its index in the object.
    pub(in crate::world) sheet: u32,
    /// Whether its normal points to the other side of the sheet than the first patch's.
    pub(in crate::world) is_flipped: bool,
    /// The edges over which the sheet goes on.
    pub(in crate::world) shared: SharedEdges,
}

/// Makes the edges of an object's patches that nearly meet equal, and finds the place of each patch in the sheets.
pub(in crate::world) fn welded_sheets(nets: &mut [ControlNet]) -> Vec<Place> {
    let edges: Vec<Edge> = nets.iter().enumerate().flat_map(|(k, net)| Edge::of(k, net)).collect();
    let seams = seams(&edges);
    weld(nets, &edges, &seams);
    let cosines: Vec<f64> = seams.iter().map(|seam| seam.least_cosine(&edges, nets)).collect();
    let is_point = |seam: &Seam| seam.edges.iter().any(|&k| edges[k].is_point());
    let smooth = seams.iter().zip(&cosines).filter(|(seam, cosine)| **cosine >= SMOOTH && !is_point(seam));
    let sides = sides(nets.len(), smooth.map(|(seam, _)| (seam.edges.map(|k| edges[k].patch), seam.flips)));
    let mut is_shared = vec![false; edges.len()];
    for (seam, cosine) in seams.iter().zip(&cosines) {
        let [(a, a_flips), (b, b_flips)] = seam.edges.map(|k| sides[edges[k].patch]);
        let goes_on = *cosine >= CREASED && (a_flips != b_flips) == seam.flips;
        if a == b && (goes_on || is_point(seam)) {
            seam.edges.into_iter().for_each(|k| is_shared[k] = true);
        }
    }
    let place = |(&(sheet, is_flipped), edges): (&(usize, bool), &[bool])| Place {
        sheet: sheet as u32,
        is_flipped,
        shared: SharedEdges { u: [edges[0], edges[1]], v: [edges[2], edges[3]] },
    };
    sides.iter().zip(is_shared.chunks(4)).map(place).collect()
}

/// For each patch, the first patch of its sheet, and whether it is flipped to that one. A smooth seam is given by its two patches and
/// whether their normals point to opposite sides.
fn sides(patches: usize, smooth: impl Iterator<Item = ([usize; 2], bool)>) -> Vec<(usize, bool)> {
    let mut sheets = UnionFind::new(patches);
    let twisted: Vec<usize> = smooth.filter_map(|([a, b], flips)| (!sheets.relate(a, b, flips)).then_some(a)).collect();
    let mut has_one_side = vec![false; patches];
    twisted.into_iter().for_each(|patch| has_one_side[sheets.least(patch)] = true);
    // A strip of one side, as Moebius's, is no sheet: each of its patches is one.
    let side = |patch| Some(sheets.find(patch)).filter(|(sheet, _)| !has_one_side[*sheet]).unwrap_or((patch, false));
    (0..patches).map(side).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;
    use std::array::from_fn;
    use std::f64::consts::TAU;

    fn net(f: impl Fn(f64, f64) -> DVec3) -> ControlNet {
        ControlNet { points: from_fn(|i| from_fn(|j| f(i as f64 / 3.0, j as f64 / 3.0))) }
    }

    /// `n` by `n` patches over the square from 0 to n, the index along x before that along y, each control point moved by up to `error`.
    fn grid(n: usize, error: f64) -> Vec<ControlNet> {
        let moved = |p: DVec3, k: f64| p + error * DVec3::new((1e3 * k).sin(), (2e3 * k).sin(), (3e3 * k).sin());
        let patch = |k: usize| {
            let (x, y) = ((k / n) as f64, (k % n) as f64);
            let flat = net(|u, v| DVec3::new(x + u, y + v, 0.0));
            ControlNet { points: from_fn(|i| from_fn(|j| moved(flat.points[i][j], (16 * k + 4 * i + j) as f64))) }
        };
        (0..n * n).map(patch).collect()
    }

    fn sheets(nets: &[ControlNet]) -> Vec<u32> {
        welded_sheets(&mut nets.to_vec()).into_iter().map(|place| place.sheet).collect()
    }

    #[test]
    fn patches_that_nearly_meet_are_one_sheet_without_gaps() {
        for error in [0.0, 1e-16, 1e-12, 1e-9, 1e-6, 3e-4] {
            let before = grid(3, error);
            let mut nets = before.clone();
            for (k, place) in welded_sheets(&mut nets).into_iter().enumerate() {
                let (x, y) = (k / 3, k % 3);
                let shared = SharedEdges { u: [x > 0, x < 2], v: [y > 0, y < 2] };
                assert_eq!(place, Place { shared, ..Place::default() }, "patch {k}, {error}");
                if x < 2 {
                    assert_eq!(nets[k].points[3], nets[k + 3].points[0], "patch {k}, {error}");
                }
            }
            let moved = |(a, b): (&DVec3, &DVec3)| a.distance(*b);
            let points = |nets: &[ControlNet]| nets.iter().flat_map(|net| net.points).flatten().collect::<Vec<_>>();
            let most = points(&before).iter().zip(&points(&nets)).map(moved).fold(0.0, f64::max);
            assert!(most <= 4.0 * error, "{most} by an error of {error}");
        }
    }

    /// Wherever the edges lie in the grid of cells in which partners are looked for.
    #[test]
    fn edges_of_any_size_and_place_meet() {
        for k in 0..200 {
            let (size, place) = ((0.1 * f64::from(k)).exp2(), DVec3::new(0.37, -0.73, 1.11) * f64::from(k));
            let mut nets = grid(2, 0.0);
            nets.iter_mut().for_each(|net| *net = net.map(|p| size * (p + place)));
            assert_eq!(welded_sheets(&mut nets).iter().map(|place| place.sheet).collect::<Vec<_>>(), [0; 4], "{k}");
        }
    }

    #[test]
    fn edges_in_any_direction_meet() {
        let turned = |net: &ControlNet| ControlNet { points: from_fn(|i| from_fn(|j| net.points[j][3 - i])) };
        let mut nets = grid(3, 1e-9);
        for (k, net) in nets.iter_mut().enumerate() {
            (0..k % 4).for_each(|_| *net = turned(net));
        }
        let places = welded_sheets(&mut nets);
        assert!(places.iter().all(|place| place.sheet == 0));
        assert_eq!(places[4].shared, SharedEdges { u: [true; 2], v: [true; 2] });
    }

    #[test]
    fn patches_turned_over_are_on_the_same_sheet() {
        let over = |net: &ControlNet| ControlNet { points: from_fn(|i| from_fn(|j| net.points[j][i])) };
        let is_over = |k: usize| k * k % 5 < 2;
        for error in [0.0, 1e-9, 1e-4] {
            let mut nets = grid(3, error);
            (0..9).filter(|k| is_over(*k)).for_each(|k| nets[k] = over(&nets[k]));
            let places = welded_sheets(&mut nets);
            for (k, place) in places.iter().enumerate() {
                assert_eq!((place.sheet, place.is_flipped), (0, is_over(k) != is_over(0)), "patch {k}, {error}");
            }
            assert_eq!(places[4].shared, SharedEdges { u: [true; 2], v: [true; 2] });
        }
    }

    /// The two faces of a blade with an angle of 1 degree at its edge have opposite normals, but not as patches of one sheet have them.
    #[test]
    fn a_sharp_blade_has_two_sheets() {
        let face = |z: f64| net(|u, v| DVec3::new(v, 1.0 - u, z * (1.0 - u)));
        let turned = |n: &ControlNet| ControlNet { points: from_fn(|i| from_fn(|j| n.points[i][3 - j])) };
        for second in [face(-0.01), turned(&face(-0.01))] {
            let places = welded_sheets(&mut [face(0.01), second]);
            assert_eq!(places, [0, 1].map(|sheet| Place { sheet, ..Place::default() }));
        }
    }

    #[test]
    fn a_strip_with_one_side_is_no_sheet() {
        let strip = |twist: f64, k: usize| {
            net(move |u, v| {
                let angle = TAU * (k as f64 + u) / 16.0;
                let (out, up) = (DVec3::new(angle.cos(), angle.sin(), 0.0), DVec3::Z);
                out + (v - 0.5) * ((twist * angle).cos() * up + (twist * angle).sin() * out)
            })
        };
        let places = |twist: f64| welded_sheets(&mut (0..16).map(|k| strip(twist, k)).collect::<Vec<_>>());
        for place in places(1.0) {
            assert_eq!(place, Place { shared: SharedEdges { u: [true; 2], v: [false; 2] }, ..Place::default() });
        }
        for (k, place) in (0..).zip(places(0.5)) {
            assert_eq!(place, Place { sheet: k, ..Place::default() });
        }
    }

    /// The surfaces of a box are six sheets, exact or not.
    #[test]
    fn sheets_end_at_creases() {
        let side = |k: usize, error: f64| {
            let (axis, sign) = (k % 3, if k < 3 { 1.0 } else { -1.0 });
            let (a, b) = (DVec3::AXES[(axis + 1) % 3], DVec3::AXES[(axis + 2) % 3]);
            net(|u, v| sign * (DVec3::AXES[axis] + (2.0 * u - 1.0) * a) + (2.0 * v - 1.0) * b + k as f64 * error)
        };
        for error in [0.0, 1e-9, 1e-5] {
            let nets: Vec<_> = (0..6).map(|k| side(k, error)).collect();
            for (k, place) in (0..).zip(welded_sheets(&mut nets.clone())) {
                assert_eq!(place, Place { sheet: k, ..Place::default() }, "{error}");
            }
        }
    }

    #[test]
    fn thin_panes_and_narrow_strips_keep_their_width() {
        let pane = |z: f64| net(|u, v| DVec3::new(u, v, z));
        let strips = |width: f64| (0..4).map(move |k| net(|u, v| DVec3::new((f64::from(k) + u) * width, v, 0.0)));
        let rim = net(|u, v| DVec3::new(1.0, v, 1e-3 * u));
        for before in [vec![pane(0.0), pane(1e-3)], vec![pane(0.0), rim, pane(1e-3)], strips(1e-4).collect()] {
            let mut nets = before.clone();
            welded_sheets(&mut nets);
            for (net, before) in nets.iter().zip(&before) {
                let near = net.points.iter().flatten().zip(before.points.iter().flatten());
                assert!(near.into_iter().all(|(a, b)| a.distance(*b) < 1e-12), "{net:?} for {before:?}");
            }
        }
        assert_eq!(sheets(&[pane(0.0), pane(1e-3)]), [0, 1]);
    }

    #[test]
    fn poles_are_shared_and_stay_points() {
        let sector = |k: i32| {
            let angle = move |v: f64| (f64::from(k) + v) * TAU / 16.0;
            let point = move |r: f64, v: f64| DVec3::new(r * angle(v).cos(), r * angle(v).sin(), 1e-9 * f64::from(k));
            net(point)
        };
        let mut nets: Vec<_> = (0..16).map(sector).collect();
        for place in welded_sheets(&mut nets) {
            assert_eq!(place, Place { shared: SharedEdges { u: [true, false], v: [true; 2] }, ..Place::default() });
        }
        assert!(nets.iter().all(|net| net.points[0] == [nets[0].points[0][0]; 4]));
    }

    #[test]
    fn lunes_between_two_poles_are_one_sheet() {
        let lune = |k: i32| {
            let angle = move |v: f64| (f64::from(k) + v) * TAU / 16.0;
            // No radius at both ends, u = 0 and u = 1.
            net(move |u, v| {
                let radius = u * (1.0 - u);
                DVec3::new(radius * angle(v).cos(), radius * angle(v).sin(), u)
            })
        };
        let mut nets: Vec<_> = (0..16).map(lune).collect();
        for place in welded_sheets(&mut nets) {
            assert_eq!(place, Place { shared: SharedEdges { u: [true; 2], v: [true; 2] }, ..Place::default() });
        }
    }

    #[test]
    fn a_tube_of_one_patch_meets_itself() {
        let tube = |u: f64, v: f64| DVec3::new((TAU * u).cos(), (TAU * u).sin(), v);
        let mut nets = [net(|u, v| tube(u * (1.0 - 1e-9), v))];
        // Four control points make a triangle of the circle, whose corners are creases.
        let places = welded_sheets(&mut nets);
        assert_eq!(nets[0].points[0], nets[0].points[3]);
        assert_eq!(places[0].shared, SharedEdges { u: [false; 2], v: [false; 2] });
    }

    #[test]
    fn a_part_of_an_edge_is_no_seam() {
        let half = |k: f64| net(|u, v| DVec3::new(1.0 + u, 0.5 * (k + v), 0.0));
        assert_eq!(sheets(&[net(|u, v| DVec3::new(u, v, 0.0)), half(0.0), half(1.0)]), [0, 1, 1]);
    }

    #[test]
    fn what_an_edit_does_not_touch_stays_as_it_was() {
        let (mut a, mut b) = (grid(4, 1e-6), grid(4, 1e-6));
        b[0].points[3][3] += DVec3::new(0.0, 0.0, 0.2);
        welded_sheets(&mut a);
        welded_sheets(&mut b);
        for k in (0..16).filter(|k| ![0, 1, 4, 5].contains(k)) {
            assert_eq!(a[k], b[k], "patch {k}");
        }
    }
}
