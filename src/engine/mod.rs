//! The engine that turns scenes into frames: commands in, frames out; cancel, restart, pause.
//!
//! [`Session`] renders one scene, iteration by iteration, on the caller's thread. [`Engine`] runs sessions on a thread of its own, always
//! for the newest scene, and begins each with a quick draft.
//!
//! | file | holds |
//! |---|---|
//! | `messages` | commands, status, settings |
//! | `g_buffer` | what the pixels of a picture show |
//! | `frame` | a picture and its statistics |
//! | `convergence_rates` | how fast the noise of stratified samples falls |
//! | `film_sums` | sums over iterations, and the error estimate |
//! | `film_merge` | films of consecutive iterations become one film |
//! | `pass_meter` | time and work of passes |
//! | `film_part` | consecutive iterations with their measurements |
//! | `run` | what must be equal for parts to belong to one run |
//! | `checkpoint` | a part of a run in a file |
//! | `iteration` | one iteration: the main loop of the algorithm |
//! | `display/` | a filter of the interreflection that the screen shows |
//! | `session` | the rendering of one scene |
//! | `visited` | pictures of scenes that an edit left |
//! | `stand_in` | the scene before an edit and its picture |
//! | `shared` | the state that the caller and the worker share |
//! | `draft/` | quick first pictures |
//! | `worker` | the worker thread |
//! | `handle` | the engine as the caller sees it |

mod checkpoint;
mod convergence_rates;
mod display;
mod draft;
mod film_merge;
mod film_part;
mod film_sums;
mod frame;
mod g_buffer;
mod handle;
mod iteration;
mod messages;
mod pass_meter;
mod run;
mod session;
mod shared;
mod stand_in;
mod visited;
mod worker;

pub use checkpoint::{Checkpoint, CheckpointError, CheckpointFile};
pub use draft::Draft;
pub use film_part::FilmPart;
pub use film_sums::{FilmSums, MOST_ITERATIONS};
pub use frame::{Frame, MissingLight, PassSeconds, PlanSummary, SheetShare, Stats};
pub use g_buffer::GBuffer;
pub use handle::Engine;
pub use iteration::iterate;
pub use messages::{Command, EngineError, EngineSettings, Limits, Status};
pub use pass_meter::PassMeter;
pub use run::{Run, provenance};
pub use session::{BLACK_ITERATIONS, Session, SessionError};

pub use crate::transport::{Counters, Energy, PathEnergy, PlanItem, PlanNote, WorstBalance};
