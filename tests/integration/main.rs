//! What the program does, seen from outside.

mod closed_forms;
mod passes;
