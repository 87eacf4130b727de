//! The plan of a scene: the items of work that it needs and how they are rendered, decided before rendering, with the reasons.
//!
//! A plan is made *new* from the world. A *draft* of it serves the first picture after an edit. After iterations 4, 8, 16, ... it is
//! *refined* by their measurements. A plan for *only* one component does no work for the other components.
//!
//! | file | holds |
//! |---|---|
//! | `component` | [`Component`]: direct light, caustics or interreflection |
//! | `notes` | the decisions and their reasons, as text |
//! | `paths` | how many paths leave each light |
//! | `light_importance` | how much of a light's paths matters for the camera |
//! | `radii` | radii of density estimates after one full iteration |
//! | `interleaved_grid` | the pixels that gather for their neighbours |
//! | `sheet_lattice` | how many rays light sheets have |
//! | `render_plan` | the plan itself |
//! | `caustics` | whether there are caustics; photons gathered or splatted |
//! | `interreflection` | whether there is interreflection |
//! | `radius` | the radius at a point in an iteration |
//! | `samples` | camera samples and paths of an iteration |
//! | `unseen_light` | a bound of the light that no path has brought yet |
//! | `new`, `draft`, `refined`, `only` | the four kinds of plans |
//! | `measured` | the measured settings of a plan, for another plan of the same scene |

mod caustics;
mod component;
mod draft;
mod interleaved_grid;
mod interreflection;
mod light_importance;
mod measured;
mod new;
mod notes;
mod only;
mod paths;
mod radii;
mod radius;
mod refined;
mod render_plan;
mod samples;
mod sheet_lattice;
mod unseen_light;

pub use component::Component;
pub use draft::DraftSize;
pub(in crate::transport) use interleaved_grid::InterleavedGrid;
pub use measured::MeasuredPlan;
pub use notes::{PlanItem, PlanNote};
pub use radii::Radii;
pub(in crate::transport) use radius::IterationRadii;
pub use render_plan::{CausticPlan, Plan};
pub use sheet_lattice::SheetLattice;
pub use unseen_light::UnseenLight;
