//! The camera pass: camera paths find emission, direct light, and the visible points where photons will be gathered.
//!
//! | file | holds |
//! |---|---|
//! | `batch` | the result of the pass |
//! | `pixel` | first vertices of the paths of one pixel |
//! | `clearance` | distances from a visible point to other objects |
//! | `tracer` | one camera path, which branches at glass |
//! | `sampling` | all samples of a pixel; the pass |

mod batch;
mod clearance;
mod pixel;
mod sampling;
mod tracer;

pub use batch::{CameraBatch, FirstHit};
pub use sampling::camera_pass;
