//! The grid that drags snap to. Knows no widget.

use super::drag::Constraint;
use crate::scene::Camera;
use glam::DVec3;

/// Steps of the automatic grid in the height of the picture, at least.
const STEPS: f64 = 20.0;

/// A step of 1, 2 or 5 times a power of ten, by its place in the row ..., 0.5, 1, 2, 5, 10, ...; 1 has place 0.
fn step_at(place: i32) -> f64 {
    let (power, digit) = (place.div_euclid(3), [1.0, 2.0, 5.0][place.rem_euclid(3) as usize]);
    // A quotient of integers is rounded once: 0.2 is the number nearest to 0.2.
    if power < 0 { digit / 10_f64.powi(-power) } else { digit * 10_f64.powi(power) }
}

/// The place of the largest step that does not exceed `length`.
fn place_below(length: f64) -> i32 {
    let length = length.clamp(1e-12, 1e12);
    let first = 3 * length.log10().floor() as i32;
    // One place more and one less than the decade: the logarithm may round across its border.
    (first - 1..=first + 3).rev().find(|place| step_at(*place) <= length).unwrap_or(first)
}

/// The grid's step that fits a camera: the largest of which at least 20 fill the height of the picture at the target.
pub(crate) fn automatic_step(camera: &Camera) -> f64 {
    step_at(place_for(camera))
}

fn place_for(camera: &Camera) -> i32 {
    let height = 2.0 * camera.position.distance(camera.target) * (0.5 * camera.fov_y.to_radians()).tan();
    place_below(height / STEPS)
}

/// Steps to choose from: three below and three above the automatic one.
pub(crate) fn steps_around(camera: &Camera) -> [f64; 7] {
    let middle = place_for(camera);
    std::array::from_fn(|k| step_at(middle - 3 + k as i32))
}

/// The point of the grid nearest to `target`, as far as the constraint allows: along an axis or in a plane of the axes, the free
/// coordinates are whole multiples of `step`; along any other line, the way from `start` is.
pub(crate) fn snapped(target: DVec3, start: DVec3, constraint: Constraint, step: f64) -> DVec3 {
    let whole = target.to_array().map(|coordinate| multiple(coordinate, step));
    let pick = |free: [bool; 3]| {
        let kept = target.to_array();
        DVec3::from_array(std::array::from_fn(|k| if free[k] { whole[k] } else { kept[k] }))
    };
    match constraint {
        Constraint::Facing => DVec3::from_array(whole),
        Constraint::Plane(normal) => pick(normal.to_array().map(|component| component == 0.0)),
        Constraint::Axis(axis) if DVec3::AXES.contains(&axis) => {
            pick(axis.to_array().map(|component| component != 0.0))
        }
        Constraint::Axis(axis) => start + multiple((target - start).dot(axis), step) * axis,
    }
}

/// The multiple of `step` nearest to `value`.
fn multiple(value: f64, step: f64) -> f64 {
    let inverse = (1.0 / step).round();
    // 3 / 10 is the number nearest to 0.3, and 3 * 0.1 is not.
    if step < 1.0 && (inverse * step - 1.0).abs() < 1e-12 {
        (value * inverse).round() / inverse
    } else {
        (value / step).round() * step
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_are_1_2_and_5_times_powers_of_ten() {
        assert_eq!([-4, -3, -2, -1, 0, 1, 2, 3, 4].map(step_at), [0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0]);
        for (length, expected) in
            [(1.0, 1.0), (0.999, 0.5), (0.1, 0.1), (0.0999, 0.05), (7.0, 5.0), (1e6, 1e6), (3e-5, 2e-5)]
        {
            assert_eq!(step_at(place_below(length)), expected, "below {length}");
        }
    }

    #[test]
    fn the_automatic_step_fits_the_picture() {
        for scale in [1e-6, 1.0, 1e6] {
            let camera = Camera { position: 10.0 * scale * DVec3::Z, fov_y: 90.0, ..Camera::default() };
            // 20 / 20 units of the scale, up to the rounding of the tangent.
            let step = automatic_step(&camera) / scale;
            assert!(step > 0.49 && step < 1.01, "{step} at {scale}");
            let steps = steps_around(&camera);
            assert!(steps.is_sorted() && steps[3] == automatic_step(&camera), "{steps:?}");
        }
    }

    #[test]
    fn a_drag_snaps_within_its_constraint() {
        let (target, start) = (DVec3::new(0.31, -0.18, 0.04), DVec3::new(0.017, -0.18, 0.04));
        let snap = |constraint| snapped(target, start, constraint, 0.1);
        assert_eq!(snap(Constraint::Facing), DVec3::new(0.3, -0.2, 0.0));
        assert_eq!(snap(Constraint::Axis(DVec3::X)), DVec3::new(0.3, -0.18, 0.04));
        assert_eq!(snap(Constraint::Plane(DVec3::X)), DVec3::new(0.31, -0.2, 0.0));
        let diagonal = DVec3::new(1.0, 1.0, 0.0).normalize();
        let along = (snap(Constraint::Axis(diagonal)) - start).dot(diagonal) / 0.1;
        assert!((along - along.round()).abs() < 1e-12, "{along} steps");
    }
}
