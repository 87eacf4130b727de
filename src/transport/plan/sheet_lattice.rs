//! How many rays light sheets have.

/// Most steps along a square that are traced everywhere.
const MOST_STEPS: u32 = 64;

/// The lattice of a light whose light sheets an iteration or a draft traces.
#[derive(Clone, Copy, Debug)]
pub struct SheetLattice {
    /// Points of a lamp with an extent that have sheets; they share the rays. With 1, all light comes from the middle of the lamp.
    pub points_of_lamp: u64,
    /// Rays that are traced everywhere, over the photon paths that would bring all caustics; more only where light is not smooth.
    pub everywhere: f64,
    /// Steps along a square of the finest lattice, over those that are traced everywhere.
    pub refinement: u32,
}

impl SheetLattice {
    /// Of an iteration. Measured: with 0.25 of the rays everywhere iterations take longer for no less error; with fewer, small objects
    /// between the rays would cast no shadow. With one point of the lamp a lens shows few points in the first seconds; with eight,
    /// iterations take longer for no less error.
    pub(super) const ITERATION: Self = Self { points_of_lamp: 4, everywhere: 0.125, refinement: 4 };
    /// Of a draft: as many rays as photons, so that its cost stays bounded.
    pub(super) const DRAFT: Self = Self { points_of_lamp: 1, everywhere: 1.0, refinement: 1 };

    /// Steps along each of `squares` squares of the finest lattice, for as many photon paths; a power of two.
    pub(in crate::transport) fn steps(&self, paths: usize, squares: usize) -> u32 {
        let everywhere = (self.everywhere * paths as f64 / squares.max(1) as f64).sqrt() as u32;
        self.refinement * ((everywhere.clamp(2, MOST_STEPS) + 1).next_power_of_two() / 2)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_square_to_the_rays_of_a_square() {
        assert_eq!(SheetLattice::DRAFT.steps(16 * 100, 100), 4);
        assert_eq!(SheetLattice::DRAFT.steps(15 * 100, 100), 2, "no more rays than photons");
        assert_eq!(SheetLattice::ITERATION.steps(16 * 8 * 100, 100), 16);
        assert_eq!(SheetLattice::ITERATION.steps(0, 0), 8, "at least");
        assert_eq!(SheetLattice::ITERATION.steps(1 << 40, 1), 256, "at most");
    }
}
