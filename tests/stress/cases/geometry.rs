//! Rays at awkward places of surfaces, and degenerate surfaces: G1 to G8.

use crate::suite::{
    Case, Tolerance, anomalies, ball_nets, box_of, camera, dented_cube, diffuse, direction, glass, mean, object,
    patch_ball, picture, point_light, quad, sphere, unit,
};
use glam::DVec3;
use patchlight::geometry::bezier::{ControlNet, Patch};
use patchlight::geometry::{Aggregate, Hit, Plane, Primitive, Quad, Sphere};
use patchlight::math::{Aabb, Ray};
use patchlight::scene::{Location, SceneFile};
use std::sync::Arc;

const RAYS: u64 = 70_000;

pub(crate) fn cases() -> Vec<Case> {
    [edges(), shapes(), degenerate(), without_area(), seams(), pictures()].into_iter().flatten().collect()
}

/// G6: quads without an area are refused, however small or large their edges are.
fn without_area() -> Vec<Case> {
    const SCENES: u64 = 200;
    let accepted = |round| {
        let scene = |k: &u64| {
            let size = 10f64.powf(14.0 * unit(round, *k, 0) - 7.0);
            let edge = direction(round, *k) * size;
            let other = edge * [0.0, 1.0, -2.0, 1.0 + 1e-17][(k % 4) as usize];
            let text = camera([0.0, 0.0, 3.0], [0.0; 3], 40.0, 8)
                + &diffuse("white", 0.8)
                + &quad("quad", [[0.0; 3], edge.to_array(), other.to_array()], "white");
            SceneFile::parse(&text, Location::Unsaved).is_ok()
        };
        (0..SCENES).filter(scene).count() as u64
    };
    vec![Case::faults("accepted quads without an area", "G6", (SCENES, "scenes"), accepted)]
}

/// A net of these points.
fn net(point: impl Fn(usize, usize) -> DVec3) -> ControlNet {
    ControlNet { points: std::array::from_fn(|i| std::array::from_fn(|j| point(i, j))) }
}

/// A bent patch over the unit square of x and z.
fn bent() -> ControlNet {
    net(|i, j| {
        let (x, z) = (i as f64 / 3.0, j as f64 / 3.0);
        DVec3::new(x, 0.8 * (4.0 * x * z).sin(), z)
    })
}

/// Whether a hit is finite, lies within the patch and near the ray.
fn is_sound(patch: &Patch, ray: &Ray) -> bool {
    patch.intersect(ray).is_none_or(|hit| {
        let size = patch.bounds().diagonal().max(f64::MIN_POSITIVE);
        let far = ray.origin.abs().max_element() + patch.bounds().max.abs().max_element();
        let inside =
            (0.0..=1.0).contains(&hit.u) && (0.0..=1.0).contains(&hit.v) && hit.t.is_finite() && hit.t > ray.t_min;
        let off = patch.net().eval(hit.u, hit.v).distance(ray.at(hit.t));
        inside && off < 1e-6 * size + 1e-12 * far && patch.normal(hit.u, hit.v).is_normalized()
    })
}

/// A point on an isoline, an edge or a corner of the unit square: every third index each.
fn special_parameters(round: u64, k: u64) -> [f64; 2] {
    let x = unit(round, k, 0);
    let step = (unit(round, k, 1) * 5.0).floor() / 4.0;
    match k % 4 {
        0 => [step, x],
        1 => [x, step],
        2 => [x.round(), unit(round, k, 2).round()],
        _ => [x.round(), unit(round, k, 2)],
    }
}

/// G1 and G2: rays along edges, corners and isolines, and rays that graze the silhouette.
fn edges() -> Vec<Case> {
    let patch = Patch::new(bent());
    let misses = move |round| {
        let misses = |k: &u64| {
            let [u, v] = special_parameters(round, *k);
            // Not nearer to the edge than the accuracy of a position.
            let [u, v] = [u, v].map(|x| x.clamp(1e-12, 1.0 - 1e-12));
            let point = patch.net().eval(u, v);
            let normal = patch.normal(u, v);
            let from = point + 3.0 * (normal + 0.5 * direction(round, *k)).normalize();
            patch.intersect(&Ray::new(from, point - from)).is_none()
        };
        (0..RAYS).filter(misses).count() as u64
    };
    let flat = Patch::new(net(|i, j| DVec3::new(i as f64, 0.0, j as f64)));
    let in_plane = move |round| {
        let is_wrong = |k: &u64| {
            let [u, v] = special_parameters(round, *k);
            let target = flat.net().eval(u, v);
            let along = DVec3::new(direction(round, *k).x, 0.0, direction(round, *k).y);
            !is_sound(&flat, &Ray::new(target - 5.0 * along, along))
        };
        (0..RAYS).filter(is_wrong).count() as u64
    };
    let bulged = Patch::new(bent());
    let tangents = move |round| {
        let is_wrong = |k: &u64| {
            let [u, v] = [unit(round, *k, 3), unit(round, *k, 4)];
            let across = bulged.normal(u, v);
            let along = across.cross(direction(round, *k)).normalize();
            // From 1e-12 below to 1e-12 above the tangent.
            let shift = (unit(round, *k, 5) * 2.0 - 1.0) * 1e-12;
            !is_sound(&bulged, &Ray::new(bulged.net().eval(u, v) + shift * across - 2.0 * along, along))
        };
        (0..RAYS).filter(is_wrong).count() as u64
    };
    vec![
        Case::faults("misses at edges, corners and isolines of a patch", "G1", (RAYS, "rays"), misses),
        Case::faults("unsound hits of rays in the plane of a patch", "G1", (RAYS, "rays"), in_plane),
        Case::faults("unsound hits of tangents", "G2", (RAYS, "rays"), tangents),
    ]
}

/// Patches without area, with edges that are points, with cusps and self-intersections.
fn degenerate_nets() -> Vec<(&'static str, ControlNet)> {
    let sheet = |i: usize, j: usize| DVec3::new(i as f64, (i * j) as f64 / 9.0, j as f64);
    vec![
        ("collapsed edge", net(|i, j| sheet(i, if i == 0 { 0 } else { j }))),
        ("two collapsed edges", net(|i, j| sheet(i, if i % 3 == 0 { 0 } else { j }))),
        ("all points equal", net(|_, _| DVec3::new(1.0, 2.0, 3.0))),
        ("a line", net(|i, j| DVec3::X * (i + j) as f64)),
        ("a line folded onto itself", net(|i, _| DVec3::X * [0.0, 3.0, -2.0, 1.0][i])),
        ("a cusp", net(|i, j| DVec3::new([0.0, 1.0, 0.0, 1.0][i], [0.0, 1.0, 1.0, 0.0][i], j as f64))),
        ("self-intersection", net(|i, j| DVec3::new([0.0, 4.0, -3.0, 1.0][i], [0.0, 2.0, 2.0, 0.0][i], j as f64))),
        ("duplicate corners", net(|i, j| sheet(if i == 1 { 0 } else { i }, if j == 2 { 3 } else { j }))),
        ("turned inside out", net(|i, j| sheet([0, 2, 1, 3][i], [0, 2, 1, 3][j]))),
        ("far control points", net(|i, j| sheet(i, j) + if i == 1 && j == 2 { DVec3::Y * 1e6 } else { DVec3::ZERO })),
        ("denormal size", net(|i, j| sheet(i, j) * 1e-310)),
        ("huge", net(|i, j| sheet(i, j) * 1e150)),
    ]
}

/// G3 and G8.
fn degenerate() -> Vec<Case> {
    let case = |(name, net): (&str, ControlNet)| {
        let patch = Patch::new(net);
        let wrong = move |round| {
            let bounds = patch.bounds();
            let size = bounds.diagonal().max(1e-300);
            let is_wrong = |k: &u64| {
                let target = patch.net().eval(unit(round, *k, 0), unit(round, *k, 1));
                let from = target + 2.0 * size * direction(round, *k);
                let past = target + 1e-3 * size * direction(round + 1, *k) * f64::from(*k as u32 % 2);
                !is_sound(&patch, &Ray::new(from, (past - from) / size))
            };
            (0..RAYS / 10).filter(is_wrong).count() as u64
        };
        Case::faults(format!("unsound hits: {name}"), "G3", (RAYS / 10, "rays"), wrong)
    };
    let mut cases: Vec<Case> = degenerate_nets().into_iter().map(case).collect();
    let small = |net: &ControlNet| net.bounds().max.abs().max_element() < 1e3;
    for (name, net) in degenerate_nets().into_iter().filter(|(_, net)| small(net)) {
        let points = net.points.map(|row| row.map(|point| point.to_array()));
        let text = [
            camera([1.5, 6.0, 7.0], [1.5, 0.5, 1.5], 40.0, 16),
            diffuse("white", 0.8),
            object("patch", "bezier", "white", &format!("patches = [{points:?}]")),
            object("ground", "plane", "white", "point = [0, -2, 0]\nnormal = [0, 1, 0]"),
            point_light([1.0, 5.0, 2.0], 20.0),
        ]
        .concat();
        let name = format!("improper pixels: {name}");
        cases.push(Case::faults(name, "G3", (256, "pixels"), move |round| anomalies(&text, 8, round)));
    }
    let invalid = || {
        let head = [camera([0.0, 0.0, 4.0], [0.0; 3], 40.0, 8), diffuse("white", 0.8)].concat();
        let objects = [
            sphere("a", [f64::NAN, 0.0, 0.0], 1.0, "white"),
            sphere("a", [0.0, f64::INFINITY, 0.0], 1.0, "white"),
            sphere("a", [0.0; 3], 0.0, "white"),
            sphere("a", [0.0; 3], -1.0, "white"),
            quad("a", [[0.0; 3], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0]], "white"),
            object("a", "plane", "white", "point = [0, 0, 0]\nnormal = [0, 0, 0]"),
            point_light([0.0, -f64::INFINITY, 0.0], 1.0),
            diffuse("bright", 1.5),
            diffuse("dark", -0.5),
            diffuse("none", f64::NAN),
        ];
        let accepted = objects.iter().filter(|object| {
            let text = format!("version = 1\n{head}{object}").replace("NaN", "nan");
            match SceneFile::parse(&text, Location::Unsaved) {
                Ok(_) => true,
                Err(error) => !error.to_string().contains(':'),
            }
        });
        accepted.count() as f64
    };
    cases.push(Case::exact(
        "values out of range that a scene file accepts",
        "G8, E1",
        0.0,
        Tolerance::NoFaults,
        (10, "files"),
        invalid,
    ));
    cases
}

/// A hit of a primitive against the formula of its shape.
fn shapes() -> Vec<Case> {
    let mut cases = Vec::new();
    for radius in [1e-4f64, 1.0, 1e5] {
        let center = DVec3::new(0.3, -0.2, 0.1);
        let ball = Primitive::Sphere(Sphere { center, radius });
        let wrong = move |round| {
            let is_wrong = |k: &u64| {
                let target = center + radius * 0.999 * direction(round, *k).cross(DVec3::X).normalize();
                let from = center + radius * (2.0 + 1e4 * unit(round, *k, 2)) * direction(round + 1, *k);
                let ray = Ray::new(from, target - from);
                ball.intersect(&ray).is_none_or(|(t, _, _)| {
                    // Rounding of positions at the origin's distance, over the cosine at the silhouette.
                    let off = (ray.at(t).distance(center) - radius).abs();
                    !(off <= 1e-11 * from.distance(center))
                })
            };
            (0..RAYS).filter(is_wrong).count() as u64
        };
        cases.push(Case::faults(format!("hits off a sphere of radius {radius:e}"), "G6", (RAYS, "rays"), wrong));
    }
    let shapes = || {
        vec![
            Primitive::Quad(Quad::new(DVec3::new(-1.0, 0.0, -1.0), 2.0 * DVec3::X, 2.0 * DVec3::Z)),
            Primitive::Quad(Quad::new(DVec3::ZERO, DVec3::X, DVec3::X)),
            Primitive::Plane(Plane::new(DVec3::Y, DVec3::X, None)),
            Primitive::Sphere(Sphere { center: DVec3::Z, radius: 1.0 }),
            Primitive::Patch(Arc::new(Patch::new(bent()))),
        ]
    };
    let axes = move |round| {
        let aggregate = Aggregate::new(shapes());
        let is_wrong = |k: &u64| {
            let tiny = [0.0, -0.0, f64::MIN_POSITIVE, -5e-324, 1e-300][(*k % 5) as usize];
            let axis = DVec3::AXES[(*k / 5 % 3) as usize] * if k.is_multiple_of(2) { 1.0 } else { -1.0 };
            let along = axis + DVec3::splat(tiny) * (DVec3::ONE - axis.abs());
            let grid = |d| (unit(round, *k, d) * 8.0).floor() / 2.0 - 2.0;
            let ray = Ray::new(DVec3::new(grid(0), grid(1), grid(2)) - 10.0 * axis, along);
            let is_finite = |hit: Hit| hit.t.is_finite() && hit.u.is_finite() && hit.v.is_finite();
            aggregate.closest_hit(&ray).is_some_and(|hit| !is_finite(hit) || !aggregate.occluded(&ray))
        };
        (0..RAYS).filter(is_wrong).count() as u64
    };
    cases.push(Case::faults("unsound hits of rays along axes, -0 and denormal directions", "G6", (RAYS, "rays"), axes));
    cases
}

/// Rays from outside to points on the edges of patches of a closed body, straight towards its middle and obliquely: how many meet no
/// surface up to there.
fn missed_seams(nets: &[ControlNet], aggregate: &Aggregate, round: u64) -> u64 {
    let bounds = nets.iter().fold(Aabb::EMPTY, |all, net| all.union(&net.bounds()));
    let (middle, distance) = (0.5 * (bounds.min + bounds.max), 2.0 * bounds.diagonal());
    let is_missed = |from: DVec3, target: DVec3| {
        aggregate.closest_hit(&Ray::new(from, target - from)).is_none_or(|hit| hit.t > 1.0 + 1e-6)
    };
    let misses = |k: &u64| {
        let net = &nets[(*k % nets.len() as u64) as usize];
        let x = if k.is_multiple_of(16) { unit(round, *k, 0).round() } else { unit(round, *k, 0) };
        let [u, v] = [[0.0, x], [1.0, x], [x, 0.0], [x, 1.0]][(*k / 7 % 4) as usize];
        let target = net.eval(u, v);
        let outward = (target - middle).normalize();
        // Within 60 degrees of the direction outward.
        let oblique = (outward + 0.86 * direction(round, *k)).normalize();
        [outward, oblique].into_iter().filter(|from| is_missed(middle + distance * *from, target)).count() as u64
    };
    (0..RAYS).map(|k| misses(&k)).sum()
}

/// G4: closed bodies of patches, hit on their seams and poles.
fn seams() -> Vec<Case> {
    let ball = || -> Vec<ControlNet> {
        ball_nets([0.0; 3], 1.0)
            .into_iter()
            .map(|net| ControlNet { points: net.map(|row| row.map(DVec3::from_array)) })
            .collect()
    };
    let turned = |nets: Vec<ControlNet>| -> Vec<ControlNet> {
        let turn = glam::DMat3::from_axis_angle(DVec3::new(1.0, 2.0, 3.0).normalize(), 0.7);
        nets.into_iter().map(|net| net.map(|p| turn * p)).collect()
    };
    let bodies = [("ball", ball()), ("turned ball", turned(ball())), ("dented cube", turned(dented_cube()))];
    let mut cases = Vec::new();
    for (name, nets) in bodies {
        let aggregate = Aggregate::new(nets.iter().map(|net| Primitive::Patch(Arc::new(Patch::new(*net)))).collect());
        let misses = move |round| missed_seams(&nets, &aggregate, round);
        cases.push(Case::faults(format!("misses at the seams of a {name}"), "G4", (2 * RAYS, "rays"), misses));
    }
    let aggregate = Aggregate::new(ball().into_iter().map(|net| Primitive::Patch(Arc::new(Patch::new(net)))).collect());
    let poles = move |round| {
        let is_far_side = |k: &u64| {
            let pole = DVec3::Y * if k.is_multiple_of(2) { 1.0 } else { -1.0 };
            let target = pole + 2e-7 * direction(round, *k);
            let from = pole * 2.5 + 1.5 * direction(round + 1, *k);
            let ray = Ray::new(from, (target - from).normalize());
            // The near side is met before the middle plane of the ball.
            aggregate.closest_hit(&ray).is_none_or(|hit| ray.at(hit.t).y * pole.y < 0.5)
        };
        (0..RAYS).filter(is_far_side).count() as u64
    };
    cases.push(Case::faults("rays at a pole that meet the far side", "G4, field 11", (RAYS, "rays"), poles));
    cases
}

/// G7: surfaces that coincide are lit once.
fn pictures() -> Vec<Case> {
    let head =
        camera([4.0, 3.0, 0.0], [1.0, 0.0, 0.0], 0.02, 8) + &diffuse("white", 1.0) + &point_light([0.0, 2.0, 0.0], 3.0);
    let flat = net(|i, j| DVec3::new(2.0 * i as f64 - 3.0, 0.0, 3.0 - 2.0 * j as f64))
        .points
        .map(|row| row.map(|p| p.to_array()));
    let twice = head
        + &quad("quad", [[-3.0, 0.0, 3.0], [6.0, 0.0, 0.0], [0.0, 0.0, -6.0]], "white")
        + &object("sheet", "bezier", "white", &format!("patches = [{flat:?}]"));
    let expected = 3.0 / std::f64::consts::PI * 2.0 / 5f64.powf(1.5);
    let crowd = [
        camera([0.5, 1.5, 4.0], [0.0; 3], 40.0, 16),
        diffuse("white", 0.8),
        glass("glass", 1.5, 0.0),
        glass("water", 1.33, 0.0),
        object("ground", "plane", "white", "point = [0, -1, 0]\nnormal = [0, 1, 0]"),
        box_of("lower", [[-1.0, -1.0, -1.0], [0.0, 0.0, 0.0]], |_| "glass"),
        box_of("upper", [[-1.0, 0.0, -1.0], [0.0, 0.5, 0.0]], |_| "water"),
        patch_ball("ball", [0.5, -0.5, 0.0], 0.5, "glass", ""),
        sphere("same ball", [0.5, -0.5, 0.0], 0.5, "water"),
        point_light([1.0, 3.0, 1.0], 10.0),
    ]
    .concat();
    vec![
        Case::noisy("patch on a quad", "G7", expected, Tolerance::Relative(1e-4), (4, "iterations"), move |round| {
            mean(&picture(&twice, 4, round))
        }),
        Case::faults(
            "improper pixels: glass that touches glass, water and ground",
            "G7",
            (256, "pixels"),
            move |round| anomalies(&crowd, 8, round),
        ),
    ]
}
