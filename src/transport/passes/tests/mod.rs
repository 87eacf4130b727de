//! The caustics that light sheets and photons bring together, against closed forms and against photons alone.
//!
//! | file | holds |
//! |---|---|
//! | `caustics` | the caustics of a scene in some iterations, and squares that ask for their light |
//! | `water` | lamps and parallel rays through flat and curved water |
//! | `round_mirror` | lamps and parallel rays in a round mirror: cardioid and nephroid |
//! | `flux` | the flux of all light that the lamp sends |
//! | `degenerate` | perfect foci, and light that comes back to its lamp |

mod caustics;
mod degenerate;
mod flux;
mod round_mirror;
mod water;
