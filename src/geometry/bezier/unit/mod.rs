//! Unit space, in which tolerances suit every patch, and the numbers of patches and rays laid out for SIMD.
//!
//! | file | holds |
//! |---|---|
//! | `space` | `UnitMap` from scene space to unit space, `UnitRay` |
//! | `domain` | `Domain`, a rectangle of the parameter square; `Slack`, the distance outside of it up to which a root is a hit |
//! | `ordinates` | `Ordinates`, one coordinate of a control net; `Interval` |
//! | `soa_net` | `SoaNet`, a control net as a structure of arrays |
//! | `lane_layout` | `LaneLayout`: one ray against eight items, or eight rays against one |
//! | `lane_rays` | `LaneRays`, one ray or a packet of eight in the lanes of vectors |

mod domain;
mod lane_layout;
mod lane_rays;
mod ordinates;
mod soa_net;
mod space;

pub(crate) use domain::{Domain, Slack};
pub(crate) use lane_layout::{Column, ItemPerLane, LaneLayout, RayPerLane};
pub(crate) use lane_rays::{LaneRays, ROUNDING, rounded_z_max};
pub(crate) use ordinates::{Interval, Ordinates, Row};
pub(crate) use soa_net::SoaNet;
pub(crate) use space::{UnitMap, UnitRay};
