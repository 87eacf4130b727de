//! The behaviour of the library and the program. One binary, because linking takes long.

#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test that cannot go on has failed")]

mod bezier;
mod bodies;
mod built_in;
mod checkpoints;
mod cli;
mod closed_forms;
mod components;
mod energy;
mod engine;
mod exchange;
mod far_away;
mod far_lamps;
mod glass;
mod gloss;
mod indirect_shadow;
mod parallel_lights;
mod passes;
mod plan;
mod reuse;
mod sheets;
mod skipping;
mod support;
mod texture;
mod warnings;
#[cfg(feature = "gui")]
mod window;
