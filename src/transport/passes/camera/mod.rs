//! The camera pass: camera paths find emission, direct light, and the visible points where photons will be gathered.
//!
//! | file | holds |
//! |---|---|
//! | `first_hit` | what the first ray of a pixel meets |
//! | `batch` | the result of the pass |
//! | `pixel` | first vertices of the paths of one pixel |
//! | `clearance` | distances from a visible point to other objects |
//! | `tracer` | one camera path, which branches at glass |
//! | `sampling` | all samples of a pixel; the pass |
//! | `g_buffer` | what first rays meet, without light |

mod batch;
mod clearance;
mod first_hit;
mod g_buffer;
mod pixel;
mod sampling;
mod tracer;

pub use batch::CameraBatch;
pub use first_hit::FirstHit;
pub use g_buffer::g_buffer;
pub use sampling::camera_pass;
