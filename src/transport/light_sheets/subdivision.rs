use super::cell::{CellCorner, SheetCell};
use super::landing::{self, Landing};
use super::regions::Region;
use super::smoothness::{self, Smoothness};
use crate::geometry::Primitive;
use crate::math::Rgb;
use crate::transport::counters::Counters;
use crate::transport::lights::Pencil;
use crate::transport::photons::Signature;
use crate::world::{Camera, World};
use glam::{DVec2, UVec2};
use std::ops::Range;

/// Share of the light of a ray below which a way is neither claimed nor divided for: photons bring its light. Measured with a mirror ball and a
/// ball of glass, whose many faint sheets lie over each other: as accurate as with 0.02, in two thirds of the time.
const FAINT: f32 = 0.1;

/// A lattice over the unit square of a light's chart: squares of which each is divided on its own, into at most this many steps each way.
pub(in crate::transport) struct Lattice<'a> {
    pub(in crate::transport) world: &'a World,
    /// The camera whose pixels tell what is smooth.
    pub(in crate::transport) camera: &'a Camera,
    pub(in crate::transport) light: usize,
    pub(in crate::transport) pencil: &'a Pencil,
    /// Squares along a side.
    pub(in crate::transport) side: u32,
    /// Where the lattice lies in this iteration, squares from 0 to 1.
    pub(in crate::transport) shift: DVec2,
    /// Steps along a side of a square of the finest lattice; a power of two, at least 2.
    pub(in crate::transport) steps: u32,
    /// Steps along a side of the blocks whose nine points are traced in any case; a power of two from 2 to `steps`.
    pub(in crate::transport) sure_block: u32,
}

/// What the division of a square of the lattice found.
#[derive(Default)]
pub(in crate::transport) struct Divided {
    /// The cells with their sheets, in the order of a space-filling curve.
    pub(super) cells: Vec<(Signature, SheetCell)>,
    pub(super) regions: Vec<Region>,
    pub(super) counters: Counters,
}

impl Lattice<'_> {
    /// The point of the chart at a step of a square of the lattice. Beyond the chart it is the nearest point of its edge.
    fn chart_point(&self, square: UVec2, step: UVec2) -> DVec2 {
        let steps = f64::from(self.steps);
        let place = square.as_dvec2() - self.shift + step.as_dvec2() / steps;
        (place / f64::from(self.side)).clamp(DVec2::ZERO, DVec2::ONE)
    }

    /// The rectangle of the chart between two steps of a square: corner and size.
    fn chart_rectangle(&self, square: UVec2, [from, to]: [UVec2; 2]) -> [DVec2; 2] {
        let min = self.chart_point(square, from);
        [min, self.chart_point(square, to) - min]
    }

    /// A square of the lattice without any sheet.
    pub(in crate::transport) fn undivided(&self, square: UVec2) -> Divided {
        let rectangle = self.chart_rectangle(square, [UVec2::ZERO, UVec2::splat(self.steps)]);
        Divided {
            regions: vec![Region { rectangle, claims: Vec::new(), unclaimed: 0.0, is_traced: false }],
            ..Divided::default()
        }
    }

    /// Divides a square of the lattice until its blocks are smooth.
    pub(in crate::transport) fn divide(&self, square: UVec2) -> Divided {
        let points = (self.steps as usize + 1).pow(2);
        let mut division = Division {
            lattice: self,
            square,
            traced: vec![None; points],
            landings: Vec::new(),
            found: Divided::default(),
        };
        division.divide(Block { min: UVec2::ZERO, half: self.steps / 2 });
        division.found
    }
}

/// The division of one square.
struct Division<'a> {
    lattice: &'a Lattice<'a>,
    square: UVec2,
    /// For each point of the finest lattice, its landings, once it was traced.
    traced: Vec<Option<(u32, u32)>>,
    landings: Vec<Landing>,
    found: Divided,
}

/// The sheets at the nine points of a block.
struct SheetsOfBlock {
    /// Without faint ones.
    sheets: Vec<SheetOfBlock>,
    /// The greatest share that all faint sheets have at one of the points.
    faint: f32,
    /// Whether no sheet was left out because it is not flat.
    are_all: bool,
}

impl SheetsOfBlock {
    fn are_smooth(&self) -> bool {
        self.sheets.iter().all(|sheet| sheet.smoothness >= Smoothness::Smooth)
    }

    fn has(&self, signature: &Signature) -> bool {
        self.sheets.iter().any(|sheet| sheet.signature == *signature)
    }

    /// Those of which one cell follows the light.
    fn flat(mut self) -> Self {
        let count = self.sheets.len();
        self.sheets.retain(|sheet| sheet.smoothness == Smoothness::Flat);
        Self { are_all: self.are_all && self.sheets.len() == count, ..self }
    }

    /// Those of which one cell follows the light in all of a block, from those that do so in its parts.
    fn flat_in(self, parts: &[Self; 4]) -> Self {
        let mut flat = self.flat();
        flat.sheets.retain(|sheet| parts.iter().all(|part| part.has(&sheet.signature)));
        let count = flat.sheets.len();
        // A sheet of a part may slip between the points of the block.
        flat.are_all &= parts.iter().all(|part| part.are_all && part.sheets.len() == count);
        flat.faint = parts.iter().map(|part| part.faint).fold(flat.faint, f32::max);
        flat
    }
}

/// A sheet at the nine points of a block.
struct SheetOfBlock {
    signature: Signature,
    /// The index of its landing at each point that has one.
    landings: [Option<usize>; 9],
    smoothness: Smoothness,
}

/// Four cells: a square of nine points, `half` steps apart.
#[derive(Clone, Copy)]
struct Block {
    min: UVec2,
    half: u32,
}

impl Block {
    fn points(self) -> [UVec2; 9] {
        std::array::from_fn(|k| self.min + UVec2::new(k as u32 % 3, k as u32 / 3) * self.half)
    }

    /// The blocks of half the size.
    fn children(self) -> [Self; 4] {
        [0, 1, 3, 4].map(|k| Self { min: self.points()[k], half: self.half / 2 })
    }
}

/// The corners of each cell of a block, as indices of its points, around the cell.
const CELLS: [[usize; 4]; 4] = [[0, 1, 4, 3], [1, 2, 5, 4], [3, 4, 7, 6], [4, 5, 8, 7]];

/// The corners of a block.
const WHOLE: [usize; 4] = [0, 2, 8, 6];

impl Division<'_> {
    /// The landings of the ray at a step of the square.
    fn trace(&mut self, step: UVec2) -> Range<usize> {
        let Self { lattice, square, traced, landings, found } = self;
        let index = (step.y * (lattice.steps + 1) + step.x) as usize;
        let (start, end) = *traced[index].get_or_insert_with(|| {
            let start = landings.len();
            if let Some(emission) = lattice.pencil.ray(lattice.chart_point(*square, step)) {
                landing::trace(lattice.world, lattice.light, emission, landings, &mut found.counters);
            }
            (start as u32, landings.len() as u32)
        });
        start as usize..end as usize
    }

    /// Divides a block until its parts are smooth; returns the sheets of which one cell follows the light in all of the block.
    fn divide(&mut self, block: Block) -> SheetsOfBlock {
        let before = [self.found.cells.len(), self.found.regions.len()];
        let is_in_any_case_divided = 2 * block.half > self.lattice.sure_block;
        let mut known = None;
        if !is_in_any_case_divided {
            let found = self.sheets(block);
            if found.are_smooth() {
                self.add_block(block, &found);
                return found.flat();
            }
            if block.half == 1 {
                CELLS.into_iter().for_each(|corners| self.add_last_cell(block, &found, corners));
                return found.flat();
            }
            known = Some(found);
        }
        let parts = block.children().map(|child| self.divide(child));
        let joined = known.unwrap_or_else(|| self.sheets(block)).flat_in(&parts);
        self.join(block, before, &joined);
        joined
    }

    /// Takes one cell of each of these sheets in place of those that were found since `before`; if these are all sheets, one region, too.
    fn join(&mut self, block: Block, before: [usize; 2], joined: &SheetsOfBlock) {
        if joined.are_all {
            self.found.cells.truncate(before[0]);
            self.found.regions.truncate(before[1]);
            self.add_block(block, joined);
        } else if !joined.sheets.is_empty() {
            let parts = self.found.cells.split_off(before[0]);
            self.found.cells.extend(parts.into_iter().filter(|(signature, _)| !joined.has(signature)));
            joined.sheets.iter().for_each(|sheet| self.add_cell(block, sheet, WHOLE));
        }
    }

    /// Claims a block of smooth sheets.
    fn add_block(&mut self, block: Block, found: &SheetsOfBlock) {
        for sheet in &found.sheets {
            let cells = if sheet.smoothness == Smoothness::Flat { &[WHOLE][..] } else { &CELLS };
            cells.iter().for_each(|&corners| self.add_cell(block, sheet, corners));
        }
        let claims = found.sheets.iter().map(|sheet| sheet.signature).collect();
        self.add_region([block.points()[0], block.points()[8]], claims, found.faint);
    }

    /// Claims what can be claimed of a cell of the least size.
    fn add_last_cell(&mut self, block: Block, found: &SheetsOfBlock, corners: [usize; 4]) {
        let (mut claims, mut unclaimed) = (Vec::new(), found.faint);
        for sheet in &found.sheets {
            let of_cell = corners.map(|k| sheet.landings[k].map(|at| &self.landings[at]));
            let is_fair = sheet.smoothness >= Smoothness::Fair
                || (sheet.landings.contains(&None)
                    && all(of_cell).is_some_and(|corners| smoothness::is_fair_cell(self.lattice.camera, &corners)));
            if is_fair {
                claims.push(sheet.signature);
                self.add_cell(block, sheet, corners);
            } else {
                unclaimed += of_cell.into_iter().flatten().map(|landing| landing.share).fold(0.0, f32::max);
            }
        }
        self.add_region([block.points()[corners[0]], block.points()[corners[2]]], claims, unclaimed);
    }

    /// The sheets at the nine points of a block.
    fn sheets(&mut self, block: Block) -> SheetsOfBlock {
        let points = block.points().map(|point| self.trace(point));
        let all_landings = points.iter().flat_map(|range| &self.landings[range.clone()]);
        let mut signatures: Vec<Signature> =
            all_landings.filter(|landing| landing.share >= FAINT).map(|landing| landing.signature).collect();
        signatures.sort_unstable();
        signatures.dedup();
        let at = |range: &Range<usize>, signature: Signature| {
            let found = self.landings[range.clone()].binary_search_by_key(&signature, |landing| landing.signature);
            found.ok().map(|k| range.start + k)
        };
        let sheet = |signature| {
            let landings = points.each_ref().map(|range| at(range, signature));
            let nine = all(landings.map(|at| at.map(|at| &self.landings[at])));
            let smoothness = nine.map_or(Smoothness::Rough, |nine| smoothness::of_block(self.lattice.camera, &nine));
            SheetOfBlock { signature, landings, smoothness }
        };
        let sheets: Vec<SheetOfBlock> = signatures.iter().copied().map(sheet).collect();
        let is_faint = |landing: &&Landing| signatures.binary_search(&landing.signature).is_err();
        let faint = |range: &Range<usize>| -> f32 {
            self.landings[range.clone()].iter().filter(is_faint).map(|landing| landing.share).sum()
        };
        SheetsOfBlock { sheets, faint: points.iter().map(faint).fold(0.0, f32::max), are_all: true }
    }

    fn add_cell(&mut self, block: Block, sheet: &SheetOfBlock, corners: [usize; 4]) {
        let Some(landings) = all(corners.map(|k| sheet.landings[k].map(|at| &self.landings[at]))) else { return };
        let points = block.points();
        let places = corners.map(|k| self.lattice.chart_point(self.square, points[k]));
        let origin = self.lattice.world.view.origin;
        // Not the area in the chart: near the poles of the chart straight lines in it are bent on the sphere, which would crowd the light.
        let flux = |triangle: [usize; 3]| {
            let part = self.lattice.pencil.part_between(triangle.map(|k| places[k]));
            triangle.map(|k| landings[k].flux).into_iter().sum::<Rgb>() * (part / 3.0) as f32
        };
        let flux = [flux([0, 1, 2]), flux([0, 2, 3])];
        let primitive = &self.lattice.world.aggregate.primitives()[landings[0].primitive as usize];
        let corners =
            landings.map(|landing| CellCorner { position: (landing.position - origin).as_vec3(), wi: landing.wi });
        let is_flat = matches!(primitive, Primitive::Quad(_) | Primitive::Plane(_));
        if let Some(cell) = SheetCell::new(corners, flux, landings[0].tag, is_flat) {
            self.found.cells.push((sheet.signature, cell));
        }
    }

    fn add_region(&mut self, steps: [UVec2; 2], claims: Vec<Signature>, unclaimed: f32) {
        let rectangle = self.lattice.chart_rectangle(self.square, steps);
        self.found.regions.push(Region { rectangle, claims, unclaimed, is_traced: true });
    }
}

/// All of the options, if none is `None`.
fn all<T, const N: usize>(options: [Option<T>; N]) -> Option<[T; N]> {
    let values: arrayvec::ArrayVec<T, N> = options.into_iter().flatten().collect();
    values.into_inner().ok()
}
