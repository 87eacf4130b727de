//! Number fields of lengths.

use super::fields::Number;
use crate::app::commands::LengthUnit;
use crate::scene::{Camera, MAX_LENGTH, MIN_LENGTH};

/// Decimals that a length has at least: as many at any distance of the camera.
const DECIMALS: usize = 3;

/// How fields show lengths, and how fast a drag changes them.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lengths {
    pub(super) unit: LengthUnit,
    /// Change per screen point of dragging, scene units: a thousandth of the distance from the camera to its target.
    speed: f64,
}

impl Lengths {
    pub(super) fn of(camera: &Camera, unit: LengthUnit) -> Self {
        let speed = (0.001 * camera.position.distance(camera.target)).clamp(1e-6, 1e6);
        Self { unit, speed }
    }

    /// A coordinate.
    pub(super) fn coordinate(&self) -> Number {
        Number { decimals: Some(DECIMALS), ..Number::any(self.speed) }.unit(self.unit.suffix())
    }

    /// A length above 0.
    pub(super) fn positive(&self) -> Number {
        self.coordinate().within(MIN_LENGTH..=MAX_LENGTH)
    }
}
