//! What the program does, seen from outside; one binary, so that it is linked once.

mod bezier;
mod cli;
mod closed_forms;
mod engine;
mod glass;
mod passes;
