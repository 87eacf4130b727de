//! The window: shows the scene while it converges and lets the user change it.
//!
//! Frames come in from the engine, commands go out to it. Within, panels and canvas read the [`document`] and push
//! [`command`]s; [`apply`] alone carries them out. What is geometry ([`projection`], [`view`], [`handles`], [`drag`],
//! [`picking`]) knows no widget; [`display`] turns linear light into pixels off the UI thread.

mod action;
mod apply;
mod canvas;
mod chooser;
mod command;
mod dialogs;
mod display;
mod document;
mod drag;
mod edit;
mod editor;
mod export;
mod files;
mod handles;
mod history;
mod menu;
mod new_items;
mod notices;
mod overlay;
mod panels;
mod path_field;
mod picking;
mod projection;
mod rendering;
mod selection;
mod startup;
mod status_bar;
mod theme;
mod view;
mod window;

#[cfg(test)]
mod tests;

pub use startup::{AppError, run};
