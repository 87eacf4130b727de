//! patchlight shows what light does with a curved surface.
#[cfg(feature = "gui")]
pub mod app;
pub mod cli;
pub mod engine;
pub mod file;
pub mod film;
pub mod geometry;
pub mod math;
pub mod scene;
pub mod transport;
pub mod world;
