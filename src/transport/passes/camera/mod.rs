//! The camera pass: camera paths to what emits, to direct light, and to the visible points where photons will be gathered.
//!
//! | file | holds |
//! |---|---|
//! | `batch` | what the pass finds |
//! | `pixel` | what the paths of one pixel find |
//! | `clearance` | distances from a visible point to other objects |
//! | `tracer` | one camera path, which branches at glass |
//! | `sampling` | all samples of a pixel; the pass |

mod batch;
mod clearance;
mod pixel;
mod sampling;
mod tracer;

pub use batch::CameraBatch;
pub use sampling::camera_pass;
