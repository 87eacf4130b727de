use crate::{
    math::Rgb,
    scene::{Problem, problem::suggestion},
};
use glam::DVec3;
use std::collections::BTreeSet;

/// The largest coordinate: its cube in f64, and the square of a transformed coordinate in f32, are far from overflow.
pub const MAX_LENGTH: f64 = 1e9;

/// The smallest length of a vector that must have a direction: its square is far from underflow in f32.
pub const MIN_LENGTH: f64 = 1e-9;

/// The largest radiance: its sums and products are far from overflow in f32.
pub const MAX_RADIANCE: f32 = 1e12;

/// Problems of a scene up to which messages suggest names: each suggestion compares a name with all others.
const MOST_SUGGESTIONS: usize = 100;

/// Checks of the values at one path, which collect the problems.
pub(super) struct Checks<'a> {
    path: String,
    problems: &'a mut Vec<Problem>,
}

impl<'a> Checks<'a> {
    /// Checks of the scene as a whole.
    pub(super) fn new(problems: &'a mut Vec<Problem>) -> Self {
        Self { path: String::new(), problems }
    }

    /// Checks of the values at a key.
    pub(super) fn at(&mut self, key: &str) -> Checks<'_> {
        Checks { path: self.path_of(key), problems: self.problems }
    }

    fn path_of(&self, key: &str) -> String {
        if self.path.is_empty() { key.to_owned() } else { format!("{}.{key}", self.path) }
    }

    /// Reports a problem at `key` unless `holds`.
    pub(super) fn require(&mut self, holds: bool, key: &str, message: impl FnOnce() -> String) {
        if !holds {
            self.problems.push(Problem { path: self.path_of(key), message: message() });
        }
    }

    /// Requires a number from `min` to `max`.
    pub(super) fn within(&mut self, key: &str, x: f64, min: f64, max: f64) {
        self.require((min..=max).contains(&x), key, || {
            format!("found {x:?}, expected a number from {min:?} to {max:?}")
        });
    }

    /// Requires a length above 0.
    pub(super) fn length(&mut self, key: &str, x: f64) {
        self.within(key, x, MIN_LENGTH, MAX_LENGTH);
    }

    /// Requires finite coordinates of at most the largest size.
    pub(super) fn point(&mut self, key: &str, p: DVec3) {
        self.require(is_point(p), key, || {
            format!("found {:?}, expected numbers from {:?} to {MAX_LENGTH:?}", p.to_array(), -MAX_LENGTH)
        });
    }

    /// Requires a vector with a direction.
    pub(super) fn direction(&mut self, key: &str, d: DVec3) {
        self.point(key, d);
        self.require(!is_point(d) || d.length() >= MIN_LENGTH, key, || {
            format!("found {:?}, expected a direction of length at least {MIN_LENGTH:?}", d.to_array())
        });
    }

    /// Requires a radiance, intensity or absorption for each channel.
    pub(super) fn radiance(&mut self, key: &str, c: Rgb) {
        let fits = c.to_array().into_iter().all(|x| (0.0..=MAX_RADIANCE).contains(&x));
        self.require(fits, key, || format!("found {:?}, expected 0 to {MAX_RADIANCE:?} in each channel", c.to_array()));
    }

    /// Requires one of the known names. The first problems suggest a near name.
    pub(super) fn name(&mut self, key: &str, name: &str, kind: &str, known: &BTreeSet<&str>) {
        let suggests = self.problems.len() < MOST_SUGGESTIONS;
        self.require(known.contains(name), key, || {
            let near = if suggests { suggestion(name, known.iter().copied()) } else { String::new() };
            format!("found \"{name}\", expected the name of a {kind}{near}")
        });
    }
}

/// Whether all coordinates are finite and of at most the largest size.
pub(super) fn is_point(p: DVec3) -> bool {
    p.to_array().into_iter().all(|x| x.abs() <= MAX_LENGTH)
}

/// Whether two directions are parallel, up to about 1e-9 radians.
pub(super) fn parallel(a: DVec3, b: DVec3) -> bool {
    a.cross(b).length() <= 1e-9 * a.length() * b.length()
}
