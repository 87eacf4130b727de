//! Exact splitting of patches by de Casteljau's algorithm.

use super::connectivity::{Connectivity, Side};
use crate::geometry::bezier::ControlNet;
use crate::scene::{Bezier, UvRect};
use std::sync::Arc;

/// The parameters whose range a split halves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Cut {
    U,
    V,
    Both,
}

/// The patches after a split of the patch number `patch`, with their parts of texture space. The surface, the sides of its normals
/// and its texture stay the same. The split goes on through the strip of patches across the cut edges, so that patches keep meeting in whole edges. The first piece of a patch
/// takes its place in the list, and the other pieces follow at the end.
pub(crate) fn split(bezier: &Bezier, patch: usize, cut: Cut) -> Bezier {
    let cuts = strip(bezier, patch, cut);
    let (patches, uv) = (bezier.patches.to_vec(), bezier.uv.as_ref().map_or(Vec::new(), |uv| uv.to_vec()));
    let rects = uv.into_iter().chain(std::iter::repeat(UvRect::default()));
    let mut pieces: Vec<Piece> = patches.into_iter().zip(rects).collect();
    for (patch, [in_u, in_v]) in cuts.into_iter().enumerate() {
        let whole = vec![pieces[patch]];
        let rows = if in_u { whole.iter().flat_map(halves_in_u).collect() } else { whole };
        let parts = if in_v { rows.iter().flat_map(halves_in_v).collect() } else { rows };
        pieces[patch] = parts[0];
        pieces.extend_from_slice(&parts[1..]);
    }
    let (patches, uv) = pieces.into_iter().unzip();
    // The patches now differ from those of a `.bpt` file.
    Bezier { patches: Arc::new(patches), uv: Some(Arc::new(uv)), file: None, ..*bezier }
}

/// A patch with its part of texture space.
type Piece = (ControlNet, UvRect);

fn halves_in_u((net, rect): &Piece) -> [Piece; 2] {
    let ([a, b], [left, right]) = (net.split_u(), rect.split_u());
    [(a, left), (b, right)]
}

fn halves_in_v((net, rect): &Piece) -> [Piece; 2] {
    let ([a, b], [left, right]) = (net.split_v(), rect.split_v());
    [(a, left), (b, right)]
}

/// For each patch, whether the split halves its range of u and its range of v.
fn strip(bezier: &Bezier, patch: usize, cut: Cut) -> Vec<[bool; 2]> {
    let mesh = Connectivity::of(bezier);
    let mut cuts = vec![[false; 2]; bezier.patches.len()];
    let mut open = match cut {
        Cut::U => vec![(patch, 0)],
        Cut::V => vec![(patch, 1)],
        Cut::Both => vec![(patch, 0), (patch, 1)],
    };
    while let Some((patch, parameter)) = open.pop() {
        let Some(is_cut) = cuts.get_mut(patch).map(|cuts| &mut cuts[parameter]) else { continue };
        if !std::mem::replace(is_cut, true) {
            // A cut in u crosses the sides v = 0 and v = 1, along which u runs.
            let crossed = if parameter == 0 { [2, 3] } else { [0, 1] };
            let beside = crossed.into_iter().flat_map(|side| mesh.along(Side { patch, side }));
            open.extend(beside.map(|Side { patch, side }| (patch, if side < 2 { 1 } else { 0 })));
        }
    }
    cuts
}

#[cfg(test)]
mod tests {
    use super::super::connectivity::tests::sheet;
    use super::*;
    use std::array::from_fn;

    fn wavy() -> Bezier {
        sheet(3, 2, |x, z| (1.3 * x).sin() + (0.7 * z).cos())
    }

    #[test]
    fn a_split_goes_through_the_whole_strip() {
        let bezier = wavy();
        let count = |cut| split(&bezier, 1, cut).patches.len() - 6;
        // u runs along the columns: a cut in u crosses two rows, a cut in v three columns.
        assert_eq!((count(Cut::U), count(Cut::V)), (2, 3));
        assert_eq!(count(Cut::Both), 2 + 3 + 1, "the split patch is one of both strips");
        assert_eq!(split(&bezier, 99, Cut::U).patches, bezier.patches, "a patch that is not there");
    }

    #[test]
    fn the_pieces_are_the_surface_with_its_normals() {
        let bezier = wavy();
        let patches = split(&bezier, 0, Cut::Both).patches;
        // The pieces of patch 0: itself, then (low u, high v), (high u, low v), (high u, high v).
        let pieces = [patches[0], patches[6], patches[7], patches[8]];
        for (k, piece) in pieces.iter().enumerate() {
            let corner = [(k / 2) as f64, (k % 2) as f64];
            for (u, v) in [(0.0, 0.0), (0.3, 0.8), (1.0, 0.5), (1.0, 1.0)] {
                let [whole_u, whole_v] = [0.5 * (corner[0] + u), 0.5 * (corner[1] + v)];
                let (a, b) = (piece.derivatives(u, v), bezier.patches[0].derivatives(whole_u, whole_v));
                // Some twenty roundings of coordinates below 10.
                assert!(a.position.distance(b.position) < 1e-14, "piece {k} at {u} {v}");
                assert!(a.dpdu.distance(0.5 * b.dpdu) < 1e-13 && a.dpdv.distance(0.5 * b.dpdv) < 1e-13);
            }
        }
    }

    #[test]
    fn seams_stay_closed_in_any_direction_of_the_patches() {
        let mut bezier = wavy();
        let turned = |net: &ControlNet| ControlNet { points: from_fn(|i| from_fn(|j| net.points[j][3 - i])) };
        for (k, net) in Arc::make_mut(&mut bezier.patches).iter_mut().enumerate() {
            (0..k % 4).for_each(|_| *net = turned(net));
        }
        let seams = |bezier: &Bezier| Connectivity::of(bezier).crossings().count();
        assert_eq!(seams(&bezier), 7);
        for cut in [Cut::U, Cut::V, Cut::Both] {
            for patch in 0..6 {
                let after = split(&bezier, patch, cut);
                let (count, borders) = (after.patches.len(), Connectivity::of(&after).borders().count());
                // Every side of a patch is on the border or shares a seam with one other side.
                assert_eq!(2 * seams(&after) + borders, 4 * count, "{cut:?} of patch {patch}");
                let mesh = Connectivity::of(&after);
                let points: Vec<_> = mesh.positions(&after);
                for node in mesh.nodes() {
                    let at =
                        |point: &crate::app::document::PointIndex| after.patches[point.patch].points[point.i][point.j];
                    assert!(node.iter().all(|point| at(point) == points[mesh.node(*point)]), "equal bits");
                }
            }
        }
    }
}
