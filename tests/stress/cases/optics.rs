//! Refraction at its limits, and lamps at awkward places: O1 to O5.

use crate::suite::{
    Case, Tolerance, anomalies, box_of, camera, diffuse, glass, improper, mean, object, patch_ball, picture,
    point_light, quad, render_limits, session, sphere, sphere_light, unit,
};
use patchlight::transport::fresnel;

pub(crate) fn cases() -> Vec<Case> {
    [limits(), interfaces(), internal_reflection(), lamps()].into_iter().flatten().collect()
}

/// O1 and O2: cosines of 0, grazing angles, the critical angle; indices below, at and near 1.
fn limits() -> Vec<Case> {
    const DRAWS: u64 = 1_000_000;
    let wrong = |round| {
        let is_wrong = |k: &u64| {
            let eta: f64 = [1.0 / 1.5, 1.5, 1.0, 1.0 + 1e-15, 0.75, 96.8, 1e-3][(*k % 7) as usize];
            let critical = (1.0 - (eta * eta).min(1.0)).sqrt();
            let near: f64 = 1e-7 * (2.0 * unit(round, *k, 0) - 1.0);
            let cos = [0.0, critical + near, critical + 1e-9 * near, near.abs(), 1.7e-6, 1.0, unit(round, *k, 1)]
                [(*k / 7 % 7) as usize];
            let found = fresnel(cos, eta);
            !((0.0..=1.0).contains(&found.reflectance) && (0.0..=1.0).contains(&found.cos_transmitted))
        };
        (0..DRAWS).filter(is_wrong).count() as u64
    };
    let mut cases = vec![Case::faults("Fresnel terms out of range", "O1", (DRAWS, "angles"), wrong)];
    for ior in [0.75, 1.0, 1.0 + 1e-12, 1.333, 2.42, 96.8] {
        let text = [
            camera([0.3, 0.4, 4.0], [0.0; 3], 40.0, 16),
            render_limits(1000, 1.0),
            glass("glass", ior, 0.0),
            sphere("ball", [0.0; 3], 1.0, "glass"),
        ]
        .concat();
        let name = format!("ball of index {ior} in a furnace");
        cases.push(Case::noisy(name, "O2", 1.0, Tolerance::Relative(1e-3), (16, "iterations"), move |round| {
            mean(&picture(&text, 16, round))
        }));
    }
    cases
}

/// C4, C5: both fractions of the light add up to all of it, and total reflection begins at the critical angle.
fn interfaces() -> Vec<Case> {
    const ANGLES: u64 = 100_000;
    let worst_sum = || {
        let excess = |k: u64| {
            let (cos, eta) = ((k as f64 + 0.5) / ANGLES as f64, [1.5, 1.333, 2.42, 1.0 / 1.5][(k % 4) as usize]);
            let found = fresnel(cos, eta);
            // Transmitted amplitudes by Fresnel's equations; the beam's width changes by the ratio of the cosines.
            let parallel = 2.0 * cos / (eta * cos + found.cos_transmitted);
            let perpendicular = 2.0 * cos / (cos + eta * found.cos_transmitted);
            let amplitudes = 0.5 * (parallel * parallel + perpendicular * perpendicular);
            let transmitted = eta * found.cos_transmitted / cos * amplitudes;
            (found.reflectance + transmitted - 1.0).abs()
        };
        (0..ANGLES).map(excess).fold(0.0, f64::max)
    };
    let exact = |name: String, expected: f64, tolerance, measure: Box<dyn Fn() -> f64>| {
        Case::exact(name, "C4", expected, tolerance, (ANGLES, "angles"), measure)
    };
    let mut cases = vec![exact(
        "reflected plus transmitted light less 1".into(),
        0.0,
        Tolerance::Absolute(1e-12),
        Box::new(worst_sum),
    )];
    // C5: light leaves a ball at the angle at which it came, so no light that comes from outside is reflected totally.
    let worst_exit = || {
        let change = |k: u64| {
            let (cos, index) = ((k as f64 + 0.5) / ANGLES as f64, [1.333, 1.5, 2.42][(k % 3) as usize]);
            let inside = fresnel(cos, index).cos_transmitted;
            let exit = fresnel(inside, 1.0 / index);
            if exit.reflectance < 1.0 { (exit.cos_transmitted - cos).abs() } else { 1.0 }
        };
        (0..ANGLES).map(change).fold(0.0, f64::max)
    };
    let name = "exit less entry cosine of a ball".into();
    cases.push(exact(name, 0.0, Tolerance::Absolute(1e-10), Box::new(worst_exit)));
    for (index, degrees) in [(1.5, 41.81), (1.333, 48.61)] {
        let critical = move || {
            let is_total = |degrees: f64| fresnel(degrees.to_radians().cos(), 1.0 / index).reflectance == 1.0;
            let (mut low, mut high) = (0.0, 90.0);
            for _ in 0..60 {
                let middle: f64 = 0.5 * (low + high);
                if is_total(middle) { high = middle } else { low = middle }
            }
            high
        };
        let name = format!("critical angle of index {index}, degrees");
        cases.push(exact(name, degrees, Tolerance::Absolute(0.005), Box::new(critical)));
    }
    cases
}

/// O4: light that never leaves a cube ends at the limit of bounces. No path brings more than `n^2` of the background.
fn internal_reflection() -> Vec<Case> {
    let text = [
        camera([0.1, 0.2, 0.3], [0.5, 0.4, -0.3], 60.0, 16),
        render_limits(255, 1.0),
        glass("glass", 2.5, 0.0),
        box_of("cube", [[-1.0; 3], [1.0; 3]], |_| "glass"),
    ]
    .concat();
    let too_bright = move |round| {
        let image = picture(&text, 8, round);
        // Roulette of weak branches lets a pixel's mean vary by some hundredths.
        let above = image.pixels.iter().filter(|pixel| pixel.y > 1.1 * 6.25).count() as u64;
        above + improper(&image)
    };
    vec![Case::faults("pixels above n^2 inside a cube with total reflection", "O4", (256, "pixels"), too_bright)]
}

/// O5: lamps on surfaces, in glass, at corners, at the camera, and without power.
fn lamps() -> Vec<Case> {
    let room = [
        camera([0.0, 0.0, 3.0], [0.0; 3], 40.0, 16),
        diffuse("white", 0.8),
        glass("glass", 1.5, 0.3),
        quad("floor", [[-1.0, -1.0, 1.0], [2.0, 0.0, 0.0], [0.0, 0.0, -2.0]], "white"),
        quad("back", [[-1.0, -1.0, -1.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0]], "white"),
        patch_ball("ball", [0.4, -0.5, 0.0], 0.5, "glass", ""),
        object("table", "bezier", "white", &format!("patches = [{:?}]", table())),
    ]
    .concat();
    let places = [
        ("on a quad", point_light([0.0, -1.0, 0.0], 1.0)),
        ("1e-9 above a quad", point_light([0.0, -1.0 + 1e-9, 0.0], 1.0)),
        ("in a corner of the room", point_light([-1.0, -1.0, -1.0], 1.0)),
        ("at a corner of a patch", point_light([-0.8, -0.4, 0.2], 1.0)),
        ("on a patch", point_light([-0.5, -0.4, 0.0], 1.0)),
        ("in the middle of glass", point_light([0.4, -0.5, 0.0], 1.0)),
        ("on the surface of glass", point_light([0.4, 0.0, 0.0], 1.0)),
        ("at the camera", point_light([0.0, 0.0, 3.0], 1.0)),
        ("sphere around the camera", sphere_light([0.0, 0.0, 3.0], 0.1, 10.0)),
        ("sphere half in the floor", sphere_light([0.0, -1.0, 0.0], 0.2, 10.0)),
        ("sphere around the glass", sphere_light([0.4, -0.5, 0.0], 0.6, 10.0)),
        ("tiny sphere", sphere_light([0.0, 0.5, 0.0], 1e-6, 1e12)),
        ("without power", point_light([0.0, 0.5, 0.0], 0.0)),
        ("of 1e12 W/sr", point_light([0.0, 0.5, 0.0], 1e12)),
        ("of 1e-30 W/sr", point_light([0.0, 0.5, 0.0], 1e-30)),
    ];
    let mut cases = Vec::new();
    for (place, lamp) in places {
        let text = room.clone() + &lamp;
        let name = format!("improper pixels: lamp {place}");
        cases.push(Case::faults(name, "O5", (256, "pixels"), move |round| anomalies(&text, 8, round)));
    }
    let dark = room + &point_light([0.0, 0.5, 0.0], 0.0);
    cases.push(Case::exact(
        "picture under a lamp without power",
        "O5",
        0.0,
        Tolerance::Absolute(0.0),
        (256, "pixels"),
        move || session(&dark, None, 4, 0).film().mean(),
    ));
    cases
}

/// A flat patch at y = -0.4.
fn table() -> [[[f64; 3]; 4]; 4] {
    std::array::from_fn(|i| std::array::from_fn(|j| [-0.8 + 0.2 * i as f64, -0.4, 0.2 - 0.2 * j as f64]))
}
