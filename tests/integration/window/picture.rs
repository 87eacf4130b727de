//! Screenshots.

use super::desktop::{Desktop, SCREEN};
use super::wait_for;
use image::RgbImage;
use std::time::Duration;

/// Half the side of the compared square in the middle of the screen, screen pixels.
const HALF: u32 = 300;

/// The middle of the screen.
pub(super) struct Picture(RgbImage);

impl Picture {
    pub(super) fn of(desktop: &Desktop) -> Self {
        let (x, y) = (SCREEN.0 / 2 - HALF, SCREEN.1 / 2 - HALF);
        Self(image::imageops::crop_imm(&desktop.screenshot(), x, y, 2 * HALF, 2 * HALF).to_image())
    }

    /// Mean absolute difference, 8-bit steps a channel.
    pub(super) fn difference(&self, other: &Self) -> f64 {
        let (a, b) = (self.0.as_raw(), other.0.as_raw());
        a.iter().zip(b).map(|(a, b)| f64::from(a.abs_diff(*b))).sum::<f64>() / a.len() as f64
    }

    pub(super) fn brightness(&self) -> f64 {
        self.0.as_raw().iter().map(|value| f64::from(*value)).sum::<f64>() / self.0.as_raw().len() as f64
    }
}

/// Watches the picture until two screenshots a second apart differ by less than `limit`; returns the last and the
/// differences seen on the way.
pub(super) fn settled(desktop: &Desktop, limit: impl Fn(f64) -> f64) -> (Picture, Vec<f64>) {
    let mut differences = Vec::new();
    let mut last = Picture::of(desktop);
    wait_for("converged picture", || {
        std::thread::sleep(Duration::from_secs(1));
        let next = Picture::of(desktop);
        differences.push(next.difference(&last));
        last = next;
        let first = differences.first().copied().unwrap_or_default();
        (differences.len() > 2 && differences.iter().rev().take(2).all(|d| *d < limit(first))).then_some(())
    });
    (last, differences)
}

/// The smallest rectangle around all pixels of this colour: the top left pixel, width and height; `None` without such a pixel.
pub(super) fn rectangle_of(screen: &RgbImage, color: [u8; 3]) -> Option<(i32, i32, i32, i32)> {
    let found =
        || screen.enumerate_pixels().filter(|(.., pixel)| pixel.0 == color).map(|(x, y, _)| (x as i32, y as i32));
    let (left, right) = (found().map(|at| at.0).min()?, found().map(|at| at.0).max()?);
    let (top, bottom) = (found().map(|at| at.1).min()?, found().map(|at| at.1).max()?);
    Some((left, top, right - left + 1, bottom - top + 1))
}
