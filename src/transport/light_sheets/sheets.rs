use super::cell::SheetCell;
use super::query::SheetQuery;
use super::regions::Regions;
use super::subdivision::Divided;
use super::tree::BoxTree;
use crate::math::{Lanes, Rgb};
use crate::transport::counters::Counters;
use crate::transport::lights::Pencil;
use crate::transport::photons::Signature;
use glam::Vec3;
use rayon::prelude::*;

/// The sheets of light of an iteration, of all lights.
#[derive(Clone, Debug, Default)]
pub struct LightSheets {
    cells: Vec<SheetCell>,
    tree: BoxTree,
}

/// What the lattice of one light, or of one of its points, leaves to photons.
pub(in crate::transport) struct SheetsOfLight {
    /// The rays of the lattice, of which its photons are some, too.
    pub(in crate::transport) pencil: Pencil,
    /// Where photons have to go, and what they leave to the sheets.
    pub(in crate::transport) regions: Regions,
}

impl LightSheets {
    /// The sheets of all lights from the divided squares of their lattices; with the regions of each light and the work.
    pub(in crate::transport) fn build(divided: Vec<Vec<Divided>>) -> (Self, Vec<Regions>, Counters) {
        let mut keyed: Vec<(Signature, SheetCell)> = Vec::new();
        let mut counters = Counters::default();
        let mut regions = Vec::new();
        for of_light in divided {
            let mut of_regions = Vec::new();
            for Divided { cells, regions, counters: work } in of_light {
                keyed.extend(cells);
                of_regions.extend(regions);
                counters += work;
            }
            regions.push(Regions::new(of_regions.into_iter()));
        }
        // Cells of one sheet together, in the order of their directions: neighbours in the tree are neighbours on the receiver.
        let mut order: Vec<(Signature, u32)> =
            keyed.iter().zip(0..).map(|((signature, _), index)| (*signature, index)).collect();
        order.par_sort_unstable();
        let cells: Vec<SheetCell> = order.into_par_iter().map(|(_, index)| keyed[index as usize].1).collect();
        counters.sheet_cells += cells.len() as u64;
        let bounds: Vec<[Vec3; 2]> = cells.par_iter().map(SheetCell::bounds).collect();
        (Self { tree: BoxTree::new(&bounds), cells }, regions, counters)
    }

    /// Whether there is no sheet.
    pub fn is_empty(&self) -> bool {
        self.cells.is_empty()
    }

    /// The flux, W, of each cell, with the side of the surface and the number of events on the way as the tag of a photon has them.
    pub fn fluxes(&self) -> impl Iterator<Item = (u32, Rgb)> {
        self.cells.iter().map(|cell| (cell.tag, cell.flux[0] + cell.flux[1]))
    }

    /// Calls `visit` with the irradiance, W per square scene unit, that each cell brings to a point on average over its parallelogram, and with
    /// the unit direction towards where that light comes from.
    #[inline(always)]
    pub(in crate::transport) fn for_each<L: Lanes>(
        &self,
        l: L,
        query: &SheetQuery,
        mut visit: impl FnMut(Rgb, &dyn Fn() -> Vec3),
    ) {
        let [min, max] = query.bounds();
        self.tree.for_each(l, min, max, |index| {
            let cell = &self.cells[index];
            if cell.tag.wrapping_sub(query.tag_start) >= query.tag_span {
                return;
            }
            let irradiance = cell.irradiance(query);
            if irradiance != Rgb::ZERO {
                visit(irradiance, &|| cell.wi());
            }
        });
    }
}
