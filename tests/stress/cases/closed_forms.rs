//! The closed forms C1 to C12.

use crate::oracle::reflectance;
use crate::suite::{
    Case, Expected, Tolerance, ball_nets, box_of, camera, component, diffuse, glass, light, mean, mirror, object,
    patch_ball, picture, point_light, quad, quad_light, render_limits, session, sphere, sphere_light, world,
};
use glam::DVec3;
use patchlight::engine::{FilmSums, PassMeter, iterate};
use patchlight::film::LinearImage;
use patchlight::geometry::bezier::ControlNet;
use patchlight::transport::{Component, PassInput, Photon, Plan, caustic_photon_pass, fresnel};
use std::f64::consts::PI;

const IMAGE: (u64, &str) = (16, "iterations");

pub(crate) fn cases() -> Vec<Case> {
    [
        integrating_spheres(),
        furnaces(),
        point_lights(),
        fresnel_values(),
        lenses(),
        water(),
        conservation(),
        balls(),
        noise(),
    ]
    .into_iter()
    .flatten()
    .collect()
}

/// A closed sphere of radius 1 around the camera, seen from a point off its middle.
fn sphere_room(albedo: f64, max_bounces: u32, lamp: &str) -> String {
    [
        &camera([0.1, 0.0, 0.2], [1.0, 0.3, 0.0], 90.0, 16),
        &render_limits(max_bounces, 0.0),
        &diffuse("wall", albedo),
        &sphere("room", [0.0; 3], 1.0, "wall"),
        lamp,
    ]
    .concat()
}

/// C1: the indirect irradiance in a closed sphere is `Phi rho / (4 pi R^2 (1 - rho))`, wherever the lamp is.
fn integrating_spheres() -> Vec<Case> {
    let places =
        [("in the middle", [0.0; 3]), ("off the middle", [0.5, -0.3, 0.2]), ("near the wall", [0.0, 0.0, -0.97])];
    let case = |(place, position): (&str, [f64; 3])| {
        let text = sphere_room(0.5, 100, &point_light(position, 1.0));
        let name = format!("integrating sphere, lamp {place}");
        Case::noisy(name, "C1", 0.5 / PI, Tolerance::Relative(1e-3), IMAGE, move |round| {
            mean(&component(&text, Component::Interreflection, 16, round))
        })
    };
    places.into_iter().map(case).collect()
}

/// C2: a black lamp of radius r in the middle of a sphere of radius R, k = (r / R)^2: `L = rho Le k / (1 - rho (1 - k))`; and the partial
/// sums of a white sphere.
fn furnaces() -> Vec<Case> {
    let mut cases = Vec::new();
    for (albedo, radius) in [(0.5f64, 0.3f64), (0.9, 0.1), (0.99, 0.5)] {
        let k = radius * radius;
        let text = sphere_room(albedo, 1000, &sphere_light([0.0; 3], radius, 2.0))
            .replace("position = [0.1, 0.0, 0.2]", "position = [0.7, 0.0, 0.2]");
        let expected = 2.0 * albedo * k / (1.0 - albedo * (1.0 - k));
        let name = format!("furnace, albedo {albedo}, lamp of radius {radius}");
        cases.push(Case::noisy(name, "C2", expected, Tolerance::Relative(2e-3), IMAGE, move |round| {
            mean(&picture(&text, 16, round))
        }));
    }
    for bounces in [1, 2, 5, 20] {
        let text = sphere_room(1.0, bounces, &point_light([0.0; 3], 1.0));
        let name = format!("white sphere, {bounces} bounces");
        let expected = f64::from(bounces) / PI;
        cases.push(Case::noisy(name, "C2", expected, Tolerance::Relative(2e-3), IMAGE, move |round| {
            mean(&picture(&text, 16, round))
        }));
    }
    cases
}

/// A camera so narrow that its film sees one point.
fn narrow(position: [f64; 3], target: [f64; 3]) -> String {
    camera(position, target, 0.02, 8)
}

/// A camera at this height whose film shows the ground from -half to half. It looks straight down, so equal areas of the film show equal
/// areas of the ground.
fn from_above(height: f64, half: f64) -> String {
    camera([0.0, height, 0.0], [0.0; 3], 2.0 * (half / height).atan().to_degrees(), 16)
        .replace("up = [0.1, 0.9, 0.2]", "up = [0, 0, -1]")
}

/// A white plane y = 0.
fn ground() -> String {
    diffuse("white", 1.0) + &object("ground", "plane", "white", "point = [0, 0, 0]\nnormal = [0, 1, 0]")
}

/// C3: `E = I cos / d^2`; the flux on a square is `I Omega`.
fn point_lights() -> Vec<Case> {
    let mut cases = Vec::new();
    for height in [1e-3f64, 0.5, 2.0, 8.0, 1e3] {
        let text = narrow([4.0, 3.0, 0.0], [1.0, 0.0, 0.0]) + &ground() + &point_light([0.0, height, 0.0], 3.0);
        let expected = 3.0 / PI * height / (1.0 + height * height).powf(1.5);
        let name = format!("point light at height {height}");
        // The film covers 0.002 units, over which the irradiance changes by up to 0.6 %, evenly.
        cases.push(Case::noisy(name, "C3", expected, Tolerance::Relative(1e-4), (4, "iterations"), move |round| {
            mean(&picture(&text, 4, round))
        }));
    }
    // The lamp is as high as the square is wide to each side: a sixth of the sphere of directions, on an area of 4.
    let square = quad("square", [[-1.0, 0.0, 1.0], [2.0, 0.0, 0.0], [0.0, 0.0, -2.0]], "white");
    let text = from_above(3.0, 1.0) + &diffuse("white", 1.0) + &square + &point_light([0.0, 1.0, 0.0], 1.0);
    let expected = 4.0 * PI / 6.0 / (4.0 * PI);
    cases.push(Case::noisy("flux on a square", "C3", expected, Tolerance::Relative(1e-3), IMAGE, move |round| {
        mean(&picture(&text, 16, round))
    }));
    cases
}

/// C4: Fresnel's equations, and a plate between the camera and a lamp: `T = (1 - R) / (1 + R)`.
fn fresnel_values() -> Vec<Case> {
    let value = |name: &str, expected, got: fn() -> f64| {
        Case::exact(name, "C4", expected, Tolerance::Absolute(1e-12), (1, "value"), got)
    };
    let brewster = || {
        // At Brewster's angle only light polarised across the plane of incidence is reflected: half of sin^2 of the difference.
        let angle = 1.5f64.atan();
        fresnel(angle.cos(), 1.5).reflectance
    };
    let at_brewster = 0.5 * (2.0 * 1.5f64.atan() - 0.5 * PI).sin().powi(2);
    let critical = || {
        (1..=1_000_000)
            .map(|k| f64::from(k) * 1e-6)
            .find(|sin| fresnel((1.0 - sin * sin).sqrt(), 1.0 / 1.5).reflectance == 1.0)
    };
    let reciprocity = || {
        let error = |k: u32| {
            let cos = f64::from(k) / 1000.0;
            let into = fresnel(cos, 1.5);
            (fresnel(into.cos_transmitted, 1.0 / 1.5).reflectance - into.reflectance).abs()
        };
        (1..=1000).map(error).fold(0.0, f64::max)
    };
    let plate = [
        narrow([0.0, 0.0, 5.0], [0.0; 3]),
        render_limits(64, 0.0),
        glass("glass", 1.5, 0.0),
        box_of("plate", [[-50.0, -50.0, -0.5], [50.0, 50.0, 0.5]], |_| "glass"),
        quad_light([[-50.0, -50.0, -3.0], [100.0, 0.0, 0.0], [0.0, 100.0, 0.0]], 1.0),
    ]
    .concat();
    vec![
        value("reflectance at normal incidence, 1.5", 0.04, || fresnel(1.0, 1.5).reflectance),
        value("reflectance at Brewster's angle, 1.5", at_brewster, brewster),
        value("greatest error of reciprocity", 0.0, reciprocity),
        Case::exact(
            "sine of the critical angle, 1.5",
            "C4",
            1.0 / 1.5,
            Tolerance::Absolute(1e-6),
            (1, "value"),
            move || critical().unwrap_or(f64::NAN),
        ),
        Case::noisy("plate at normal incidence", "C4", 0.96 / 1.04, Tolerance::Relative(1e-4), IMAGE, move |round| {
            mean(&picture(&plate, 16, round))
        }),
    ]
}

/// The root mean square of the distance of caustic photons from their centroid, weighted by flux. All fall on one small receiver.
fn spot_radius(text: &str, round: u64) -> f64 {
    let world = world(text);
    let mut plan = Plan::new(&world);
    // Photons alone bring the caustic: their positions are what is measured.
    plan.caustics.iter_mut().for_each(|caustics| caustics.sheets.fill(false));
    let photons =
        caustic_photon_pass(&PassInput::uncancelled(&world, &plan, 1 + round, 4)).expect("never cancelled").photons;
    let weighted = |photon: &Photon| (f64::from(photon.flux.y), photon.position.as_dvec3());
    let flux = photons.iter().map(weighted).map(|(flux, _)| flux).sum::<f64>();
    let centroid = photons.iter().map(weighted).map(|(flux, position)| flux * position).sum::<DVec3>() / flux;
    let squares = photons.iter().map(weighted).map(|(flux, position)| flux * position.distance_squared(centroid));
    (squares.sum::<f64>() / flux).sqrt()
}

/// A beam along z.
fn beam(center: [f64; 3], direction: [f64; 3], radius: f64, power: f64) -> String {
    let rest = format!("center = {center:?}\ndirection = {direction:?}\nradius = {radius:?}\npower = {:?}", [power; 3]);
    light("lamp", "beam", &rest)
}

/// A patch `z = -(x^2 + y^2) / (2 R)` over the square |x|, |y| < half, which a bicubic patch is exactly: near its vertex a spherical mirror
/// of radius R that opens to -z.
fn mirror_cap(radius: f64, half: f64) -> String {
    // The Bezier ordinates of t^2 over [-1, 1].
    let (t, squares) = ([-1.0, -1.0 / 3.0, 1.0 / 3.0, 1.0], [1.0, -1.0 / 3.0, -1.0 / 3.0, 1.0]);
    let point =
        |i: usize, j: usize| [half * t[i], half * t[j], -(squares[i] + squares[j]) * half * half / (2.0 * radius)];
    let net: [[[f64; 3]; 4]; 4] = std::array::from_fn(|i| std::array::from_fn(|j| point(i, j)));
    mirror("mirror", 1.0) + &object("cap", "bezier", "mirror", &format!("patches = [{net:?}]"))
}

/// A small receiver across the z axis that the camera sees obliquely.
fn receiver(z: f64, [low, high]: [f64; 2], camera_z: f64) -> String {
    let corner = [low, low.min(-high), z];
    [
        camera([0.3, 0.2, camera_z], [0.5 * (low + high), 0.0, z], 30.0, 16),
        diffuse("white", 1.0),
        quad("receiver", [corner, [high - low, 0.0, 0.0], [0.0, -2.0 * corner[1], 0.0]], "white"),
    ]
    .concat()
}

/// C6 and C9: paraxial images of a ball lens and of a curved mirror. The spot on a receiver tells where the focus is.
fn lenses() -> Vec<Case> {
    let photons = (1, "iterations");
    // A focus 1.5 R behind the middle: at 2 R behind, the beam is |1 - 2 / 1.5| times as wide.
    let (width, ball) = (0.02f64, glass("glass", 1.5, 0.0) + &sphere("ball", [0.0; 3], 1.0, "glass"));
    let lens = [receiver(2.0, [-0.01, 0.01], 1.5), ball, beam([0.0, 0.0, -3.0], [0.0, 0.0, 1.0], width, 1.0)].concat();
    // Parallel light: a focus R / 2 before the mirror, the cusp of the nephroid; at 0.7 R the beam is |1 - 0.7 / 0.5| times as wide.
    let nephroid =
        [receiver(-0.7, [-0.1, 0.1], -0.5), mirror_cap(1.0, 0.1), beam([0.0, 0.0, -0.4], [0.0, 0.0, 1.0], width, 1.0)]
            .concat();
    // A lamp on the rim, 2 R away: the image is 2 R / 3 before the mirror, the cusp of the cardioid; at R the light is |1 - 3 / 2| times as
    // wide as the mirror. The lamp stands 0.05 radians off the axis, so that the receiver is not in its light.
    let half = 0.05f64;
    let cardioid =
        [receiver(-1.0, [-0.1, -0.008], -0.8), mirror_cap(1.0, half), point_light([0.1, 0.0, -2.0], 1.0)].concat();
    // Aberrations of third order are some (h / R)^2 = 4e-4 times a small factor, and (angle)^2 / 2 = 1.3e-3 of the focal lengths.
    [
        ("focus of a ball lens", "C6", lens, width / 2f64.sqrt() / 3.0, 3e-3),
        ("cusp of the nephroid", "C9", nephroid, 0.4 * width / 2f64.sqrt(), 3e-3),
        ("cusp of the cardioid", "C9", cardioid, 0.5 * half * (2.0f64 / 3.0).sqrt(), 8e-3),
    ]
    .into_iter()
    .map(|(name, source, text, expected, tolerance)| {
        Case::noisy(name, source, expected, Tolerance::Relative(tolerance), photons, move |round| {
            spot_radius(&text, round)
        })
    })
    .collect()
}

/// The plane y = 0 of water over a floor at y = -1 of albedo 0.5, and a lamp 1 above the water.
fn pool(index: f64, view: &str, max_bounces: u32) -> String {
    let x = |i: i32| f64::from(i) * 20.0 / 3.0 - 10.0;
    let rows: Vec<_> = (0..4).map(|i| (0..4).map(|j| [x(i), 0.0, x(3 - j)]).collect::<Vec<_>>()).collect();
    [
        view,
        &render_limits(max_bounces, 0.0),
        &glass("water", index, 0.0),
        &diffuse("floor", 0.5),
        &object("surface", "bezier", "water", &format!("patches = [{rows:?}]")),
        &quad("ground", [[-1.5, -1.0, 1.5], [3.0, 0.0, 0.0], [0.0, 0.0, -3.0]], "floor"),
        &point_light([0.0, 1.0, 0.0], 1.0),
    ]
    .concat()
}

/// C7: light through flat water, from above and from below; the sky seen from under water within Snell's window.
fn water() -> Vec<Case> {
    let n = 1.33f64;
    let transmittance = 4.0 * n / (n + 1.0).powi(2);
    let irradiance = transmittance / (1.0 + 1.0 / n).powi(2);
    let caustics = |text: String| move |round| mean(&component(&text, Component::Caustics, 32, round));
    let above = pool(n, &camera([0.0, 6.0, 0.0], [0.0, -1.0, 0.001], 1.0, 8), 3);
    let below = pool(n, &camera([0.4, -0.2, 0.0], [0.0, -1.0, 0.0], 4.0, 8), 2);
    let invisible = pool(1.0, &camera([0.0, 6.0, 0.0], [0.2, -1.0, 0.001], 1.0, 8), 3);
    let beside = 0.5 / PI * 2.0 / (4.0f64 + 0.04).powf(1.5);
    // The film covers 0.12 units of the floor, over whose area the irradiance falls by 0.2 % in the mean.
    let noisy = |name: &str, source, expected, text| {
        Case::noisy(name, source, expected, Tolerance::Relative(4e-3), (32, "iterations"), caustics(text))
    };
    let under_sky = |fov: f64, pixels| {
        let view = camera([0.0, -1.0, 0.0], [0.0, 1.0, 0.001], fov, pixels);
        let surface = object("surface", "plane", "water", "point = [0, 0, 0]\nnormal = [0, 1, 0]");
        let floor = object("floor", "plane", "black", "point = [0, -2, 0]\nnormal = [0, 1, 0]");
        [view, render_limits(8, 1.0), glass("water", n, 0.0), diffuse("black", 0.0), surface, floor].concat()
    };
    let (zenith, window) = (under_sky(0.02, 8), under_sky(110.0, 64));
    // Near its rim, asin(1 / n) from the zenith, the window is dark: it shows a radiance of 0.5 where Fresnel's reflectance is 1 - 0.5 / n^2.
    let rim = (0..1_000_000)
        .map(|k| 1e-6 * f64::from(k))
        .take_while(|sin| reflectance((1.0 - sin * sin).sqrt(), n, 1.0) < 1.0 - 0.5 / (n * n));
    // On a film at distance 1.
    let sin = rim.last().unwrap_or(f64::NAN);
    let radius = sin / (1.0 - sin * sin).sqrt();
    let fraction = PI * radius.powi(2) / (4.0 * 55f64.to_radians().tan().powi(2));
    let bright = |image: &LinearImage| image.pixels.iter().filter(|pixel| pixel.y > 0.5).count() as f64;
    vec![
        noisy("pool from above", "C7", 0.5 / PI * irradiance * transmittance / (n * n), above),
        noisy("pool from below", "C7", 0.5 / PI * irradiance, below),
        noisy("water of index 1", "O2", beside, invisible),
        Case::noisy(
            "zenith from under water",
            "C7",
            n * n * transmittance,
            Tolerance::Relative(1e-4),
            IMAGE,
            move |round| mean(&picture(&zenith, 16, round)),
        ),
        // The rim of the window is some 180 pixels long; each may count or not.
        Case::noisy("Snell's window", "C7", fraction, Tolerance::Absolute(20.0 / 4096.0), IMAGE, move |round| {
            bright(&picture(&window, 16, round)) / 4096.0
        }),
    ]
}

/// C5 and C8: glass passes on all light.
fn conservation() -> Vec<Case> {
    let room = [
        camera([0.0, 0.0, 4.0], [0.0; 3], 40.0, 16),
        render_limits(64, 0.0),
        diffuse("grey", 0.5),
        glass("glass", 1.5, 0.0),
        sphere("ball", [0.0; 3], 1.0, "glass"),
        sphere("room", [0.0; 3], 5.0, "grey"),
        point_light([0.0, 2.0, 0.0], 1.0),
    ]
    .concat();
    // The ball fills 2 pi (1 - sqrt(1 - 1/4)) steradians of the lamp.
    let into_ball = 2.0 * PI * (1.0 - 0.75f64.sqrt());
    let out_of_ball = move |round| {
        let world = world(&room);
        let mut plan = Plan::new(&world);
        // Photons alone bring the caustic: their positions are what is measured.
        plan.caustics.iter_mut().for_each(|caustics| caustics.sheets.fill(false));
        let input = PassInput::uncancelled(&world, &plan, 1 + round, 4);
        let photons = caustic_photon_pass(&input).expect("never cancelled").photons;
        photons.iter().map(|photon| f64::from(photon.flux.y)).sum()
    };
    // A beam of 2 W through a plate above the camera. Light that is reflected within the plate leaves it 0.43 beside the first spot.
    let plate = box_of("plate", [[-9.0, 1.0, -9.0], [9.0, 1.4, 9.0]], |_| "glass");
    let slanted = beam([2.8, 2.4, 0.0], [-1.0, -1.0, 0.0], 0.2, 2.0);
    let view = from_above(0.9, 1.2);
    let caustic = [view, render_limits(64, 0.0), ground(), glass("glass", 1.5, 0.0), plate, slanted].concat();
    let once = reflectance(0.5f64.sqrt(), 1.0, 1.5);
    let transmitted = (1.0 - once) / (1.0 + once);
    vec![
        Case::noisy(
            "light out of a glass ball",
            "C5",
            into_ball,
            Tolerance::Relative(1e-3),
            (1, "iterations"),
            out_of_ball,
        ),
        Case::noisy(
            "flux of a caustic",
            "C8",
            2.0 * transmitted / PI / 2.4f64.powi(2),
            Tolerance::Relative(2e-3),
            IMAGE,
            move |round| mean(&component(&caustic, Component::Caustics, 16, round)),
        ),
    ]
}

/// The greatest distance of patches from the unit sphere.
fn roundness(nets: &[ControlNet]) -> f64 {
    let grid = (0..=64).flat_map(|i| (0..=64).map(move |j| (f64::from(i) / 64.0, f64::from(j) / 64.0)));
    let off = |net: &ControlNet| grid.clone().map(|(u, v)| (net.eval(u, v).length() - 1.0).abs()).fold(0.0, f64::max);
    nets.iter().map(off).fold(0.0, f64::max)
}

/// C10: patches in place of a sphere or a plane.
fn balls() -> Vec<Case> {
    let nets: Vec<ControlNet> = ball_nets([0.0; 3], 1.0)
        .into_iter()
        .map(|net| ControlNet { points: net.map(|row| row.map(DVec3::from_array)) })
        .collect();
    let middle = camera([0.0; 3], [0.3, 0.2, -1.0], 60.0, 8) + &render_limits(64, 1.0) + &glass("glass", 1.5, 0.7);
    let patches = middle + &patch_ball("ball", [0.0; 3], 1.0, "glass", "");
    let passed = (-0.7f64).exp();
    let radiance = 2.25 * 0.96 * passed / (1.0 - 0.04 * passed * passed);
    let flat: [[[f64; 3]; 4]; 4] =
        std::array::from_fn(|i| std::array::from_fn(|j| [2.0 * i as f64 - 3.0, 0.0, 3.0 - 2.0 * j as f64]));
    let planar = [
        narrow([4.0, 3.0, 0.0], [1.0, 0.0, 0.0]),
        diffuse("white", 1.0),
        object("sheet", "bezier", "white", &format!("patches = [{flat:?}]")),
        point_light([0.0, 2.0, 0.0], 3.0),
    ]
    .concat();
    vec![
        // Two cubic arcs, each at most 2.73e-4 outside its circle.
        Case::exact(
            "roundness of eight octants",
            "C10",
            2.73e-4,
            Tolerance::Absolute(2.8e-4),
            (33_800, "points"),
            move || roundness(&nets),
        ),
        // The surface is up to 5.5e-4 too far out, and 1e-3 radians off the normal.
        Case::noisy(
            "camera inside a ball of patches",
            "C10",
            radiance,
            Tolerance::Relative(1e-3),
            IMAGE,
            move |round| mean(&picture(&patches, 16, round)),
        ),
        Case::noisy(
            "planar patch",
            "C10",
            3.0 / PI * 2.0 / 5f64.powf(1.5),
            Tolerance::Relative(1e-4),
            (4, "iterations"),
            move |round| mean(&picture(&planar, 4, round)),
        ),
    ]
}

/// The sphere of C1 with a ball of glass in it.
fn room_with_glass() -> String {
    sphere_room(0.5, 100, &point_light([0.5, -0.3, 0.2], 1.0))
        + &glass("glass", 1.5, 0.0)
        + &sphere("ball", [0.6, 0.2, 0.2], 0.2, "glass")
}

/// The mean of the film of iterations 1 to 8 merged with the film of iterations 9 to 16.
fn mean_of_merged_films(text: &str, round: u64) -> f64 {
    let mut first = session(text, None, 8, round).film().clone();
    let mut second = FilmSums::new(16, 16);
    let world = world(text);
    let plan = Plan::new(&world);
    for iteration in 9..=16 {
        let input = PassInput::uncancelled(&world, &plan, 1 + round, iteration);
        let weight = plan.weight(iteration);
        iterate(&input, &PassMeter::default(), |c| second.commit(weight, &c.photons, &c.samples))
            .expect("never cancelled");
    }
    first.merge(&second);
    first.mean()
}

/// C11: two workers with half of the iterations each are as right as one; C12: the components add up to the whole picture.
fn noise() -> Vec<Case> {
    let whole = |seed: u64| {
        Expected::Sampled(Box::new(move |round| vec![mean(&picture(&room_with_glass(), 16, seed + round))]))
    };
    let sum = |round| {
        let components = [Component::Direct, Component::Caustics, Component::Interreflection];
        vec![components.map(|only| mean(&component(&room_with_glass(), only, 16, round))).iter().sum()]
    };
    let merged = |round| vec![mean_of_merged_films(&room_with_glass(), round)];
    vec![
        Case::values("film of two workers", "C11", whole(100), Tolerance::Relative(1e-3), IMAGE, merged),
        Case::values("sum of the components", "C12", whole(0), Tolerance::Relative(1e-3), IMAGE, sum),
    ]
}
