//! The cases of the stress suite, one file for each kind.
//!
//! | file | holds |
//! |---|---|
//! | `closed_forms` | pictures and photons whose values a formula gives (C1 to C12) |
//! | `geometry` | rays at edges, corners, silhouettes and poles; degenerate patches (G1 to G8) |
//! | `optics` | critical angles, indices of 1 and below, lamps at awkward places (O1 to O5) |
//! | `photons` | photon maps against sums over all photons (P1 to P5) |
//! | `long_runs` | late iterations, sums over many iterations, merged films (A1 to A3) |
//! | `sampling` | samplers against densities, thin cones (S1) |
//! | `sweeps` | scales of 1e-6 to 1e6, offsets up to 1e6 |
//! | `furnaces` | lossless bodies before a uniform background; reflectance and sums (E1, E3, E5) |
//! | `energy` | the energy balance of photon paths (E2, E4) |
//! | `bodies` | bodies of glass and area lights against the oracle |
//! | `far_away` | far lamps and far objects |
//! | `determinism` | threads, repeats, odd sizes of the film |
//! | `field` | scenes from the practice of users |
//! | `files` | damaged and random files |

mod bodies;
mod closed_forms;
mod determinism;
mod energy;
mod far_away;
mod field;
mod files;
mod furnaces;
mod geometry;
mod long_runs;
mod optics;
mod photons;
mod sampling;
mod sweeps;

use crate::suite::Case;

/// A group of cases with its name.
pub(crate) type Group = (&'static str, fn() -> Vec<Case>);

/// All groups, in the order of the table.
pub(crate) const GROUPS: [Group; 14] = [
    ("closed forms", closed_forms::cases),
    ("geometry", geometry::cases),
    ("optics", optics::cases),
    ("photons", photons::cases),
    ("long runs", long_runs::cases),
    ("sampling", sampling::cases),
    ("sweeps", sweeps::cases),
    ("furnaces", furnaces::cases),
    ("energy", energy::cases),
    ("bodies", bodies::cases),
    ("far away", far_away::cases),
    ("determinism", determinism::cases),
    ("field", field::cases),
    ("files", files::cases),
];
