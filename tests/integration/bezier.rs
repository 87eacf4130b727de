//! Rays against patches whose every root is known from arithmetic in higher precision, in `tests/data/bezier`: well
//! behaved patches, folds, cusps, collapsed edges, slivers, far from the origin, tiny and huge, random, and the teapot.
//!
//! A ray is `clear` if the answer is certain with some margin, `seam` if its nearest hit lies on an edge that two patches
//! have in common, and `delicate` if any finite answer is accepted.

use crate::support::patchlight;
use glam::{DMat3, DVec3};
use patchlight::geometry::bezier::{ControlNet, Patch, read_bpt};
use patchlight::geometry::{Aggregate, Primitive};
use patchlight::math::{LANES, Ray};
use std::{collections::HashMap, fs, sync::Arc};

const PATCHES: &str = include_str!("../data/bezier/patches.txt");
const RAYS: &str = include_str!("../data/bezier/rays.csv");
const TEAPOT: &str = include_str!("../data/bezier/teapot.txt");
const TEAPOT_RAYS: &str = include_str!("../data/bezier/teapot.csv");

/// The named patches of a text with lines `patch NAME` and 16 lines of coordinates each.
fn patches(text: &str) -> Vec<(&str, ControlNet)> {
    let blocks = text.split("patch ").skip(1);
    blocks
        .filter_map(|block| {
            let mut lines = block.lines();
            let name = lines.next()?.trim();
            let points: Vec<DVec3> = lines.map_while(|line| numbers(&line.split(' ').collect::<Vec<_>>())).collect();
            let row = |i: usize| std::array::from_fn(|j| points[4 * i + j]);
            (points.len() == 16).then(|| (name, ControlNet { points: std::array::from_fn(row) }))
        })
        .collect()
}

fn numbers(words: &[&str]) -> Option<DVec3> {
    let numbers: Result<Vec<f64>, _> = words.iter().map(|word| word.parse()).collect();
    numbers.ok()?.try_into().ok().map(DVec3::from_array)
}

/// A ray and its expected answer, from one line of a table.
struct Case<'a> {
    ray: Ray,
    class: &'a str,
    /// The nearest hit's t, if there is a hit.
    t: Option<f64>,
    line: &'a str,
}

impl<'a> Case<'a> {
    /// Parses the fields of origin and direction, of `t_min`, and of class, number of hits and t.
    fn new(line: &'a str, fields: &[&'a str], t_min: &str, [class, hits, t]: [&'a str; 3]) -> Self {
        let (origin, direction) = (numbers(&fields[..3]).unwrap(), numbers(&fields[3..6]).unwrap());
        let ray = Ray { t_min: t_min.parse().unwrap(), ..Ray::new(origin, direction) };
        Self { ray, class, t: (hits != "0").then(|| t.parse().unwrap_or(f64::NAN)), line }
    }

    /// The error of an answer in scene units; infinite for a hit where a miss is expected, and for a miss where a hit is expected.
    fn error(&self, t: Option<f64>) -> f64 {
        match (self.t, t) {
            (Some(expected), Some(t)) => (t - expected).abs() * self.ray.direction.length(),
            (None, None) => 0.0,
            _ => f64::INFINITY,
        }
    }
}

fn prepared() -> HashMap<&'static str, Patch> {
    patches(PATCHES).into_iter().map(|(name, net)| (name, Patch::new(net))).collect()
}

#[test]
fn clear_rays_have_their_answers() {
    let patches = prepared();
    assert_eq!(patches.len(), 50);
    let (mut clear, mut delicate) = (0, 0);
    for line in RAYS.lines().skip(1) {
        let fields: Vec<&str> = line.split(',').collect();
        let patch = &patches[fields[0]];
        let case = Case::new(line, &fields[2..], fields[8], [fields[9], fields[10], fields[11]]);
        let hit = patch.intersect(&case.ray);
        if let Some(hit) = hit {
            assert!(
                hit.t > case.ray.t_min && (0.0..=1.0).contains(&hit.u) && (0.0..=1.0).contains(&hit.v),
                "{line}: {hit:?}"
            );
            assert!(patch.normal(hit.u, hit.v).is_normalized(), "{line}");
            // The reported t is that of the point nearest to S(u, v), which lies within 1e-9 of the ray, the size of a
            // touching piece. Computing that point far from the origin rounds to a few ulp of the coordinates.
            let bounds = patch.bounds();
            let off = patch.net().eval(hit.u, hit.v).distance(case.ray.at(hit.t));
            let far = case.ray.origin.length() + bounds.max.length();
            assert!(off < 3e-9 * bounds.diagonal() + 1e-15 * far, "{line}: S(u, v) is {off} off the ray");
        }
        if case.class == "delicate" {
            delicate += 1;
            continue;
        }
        clear += 1;
        // 1e-6 of the size is the smallest margin of a clear ray; along the ray it grows by 1 / cos, at most 1e2.
        assert!(case.error(hit.map(|h| h.t)) < 1e-4 * patch.bounds().diagonal(), "{line}: {hit:?}");
        assert_eq!(patch.occluded(&case.ray), case.t.is_some(), "{line}");
    }
    assert!(clear > 3000 && delicate > 300, "{clear} clear, {delicate} delicate");
}

#[test]
fn packets_of_eight_rays_have_their_answers() {
    let patches = prepared();
    let mut clear = 0;
    let lines: Vec<Vec<&str>> = RAYS.lines().skip(1).map(|line| line.split(',').collect()).collect();
    for lines in lines.chunk_by(|a, b| a[0] == b[0]).flat_map(|of_one_patch| of_one_patch.chunks(LANES)) {
        let patch = &patches[lines[0][0]];
        let case = |k: usize| {
            let fields = &lines[k.min(lines.len() - 1)];
            Case::new(fields[1], &fields[2..], fields[8], [fields[9], fields[10], fields[11]])
        };
        let cases: [Case; LANES] = std::array::from_fn(case);
        let hits = patch.intersect_packet(&std::array::from_fn(|k| cases[k].ray), (1 << lines.len()) - 1);
        for (k, (case, hit)) in cases.iter().zip(hits).enumerate() {
            if k >= lines.len() {
                assert!(hit.is_none(), "a ray that does not count");
            } else if case.class == "clear" {
                assert!(case.error(hit.map(|h| h.t)) < 1e-9 * patch.bounds().diagonal(), "{:?}: {hit:?}", lines[k]);
                clear += 1;
            }
        }
    }
    assert!(clear > 3000, "{clear} clear");
}

#[test]
fn hits_are_exact() {
    let patches = prepared();
    let (mut sum, mut largest, mut count, mut tilt) = (0.0, 0f64, 0, 0f64);
    for line in RAYS.lines().skip(1) {
        let fields: Vec<&str> = line.split(',').collect();
        let patch = &patches[fields[0]];
        let net = patch.net();
        let case = Case::new(line, &fields[2..], fields[8], [fields[9], fields[10], fields[11]]);
        let (Some(_), "clear", Some(hit)) = (case.t, case.class, patch.intersect(&case.ray)) else { continue };
        let expected = net.derivatives(fields[12].parse().unwrap(), fields[13].parse().unwrap());
        let error = net.eval(hit.u, hit.v).distance(expected.position) / net.bounds().diagonal();
        (sum, largest, count) = (sum + error, largest.max(error), count + 1);
        // Where the partial derivatives span a plane.
        if let Some(normal) = expected.dpdu.cross(expected.dpdv).try_normalize() {
            tilt = tilt.max(patch.normal(hit.u, hit.v).distance(normal).to_degrees());
        }
    }
    assert!(tilt < 1e-3, "a normal is {tilt} degrees off");
    // Rounding of coordinates 1e5 times the size of a patch makes 1e-11; the rest is exact to 1e-12.
    assert!(sum / f64::from(count) < 1e-11 && largest < 1e-9, "mean {} largest {largest}", sum / f64::from(count));
}

#[test]
fn no_ray_slips_between_two_patches() {
    let nets: Vec<ControlNet> = patches(TEAPOT).into_iter().map(|(_, net)| net).collect();
    let teapot = Aggregate::new(nets.iter().map(|net| Primitive::Patch(Arc::new(Patch::new(*net)))).collect());
    let size = teapot.bounds().diagonal();
    let mut seams = 0;
    for line in TEAPOT_RAYS.lines().skip(1) {
        let fields: Vec<&str> = line.split(',').collect();
        let case = Case::new(line, &fields[1..], "0", [fields[7], fields[8], fields[9]]);
        let hit = teapot.closest_hit(&case.ray);
        seams += usize::from(case.class == "seam");
        assert!(hit.is_none_or(|hit| hit.t.is_finite()), "{}", case.line);
        // The gap between patches at a common edge whose points are given in single precision.
        assert!(case.class == "delicate" || case.error(hit.map(|h| h.t)) < 1e-5 * size, "{line}: {hit:?}");
    }
    assert!(seams > 500, "{seams} seams");
}

/// The number of rays aimed at these points that miss the surface. Rays come from about this distance and from many directions,
/// one of them straight down; rays that would graze a surface with the normal beside the point are left out.
fn leaks(nets: &[ControlNet], points: impl Iterator<Item = (DVec3, DVec3)>, distance: f64) -> usize {
    let surface = Aggregate::new(nets.iter().map(|net| Primitive::Patch(Arc::new(Patch::new(*net)))).collect());
    let directions = (0..300).map(|k| {
        let k = f64::from(k);
        if k < 1.0 { DVec3::NEG_Z } else { DVec3::new((1.3 * k).sin(), (2.1 * k).cos(), (0.7 * k).sin() + 1.5) }
    });
    let rays = points.flat_map(|(point, normal)| {
        let not_grazing = move |d: &DVec3| d.normalize().dot(normal).abs() > 0.2;
        directions.clone().filter(not_grazing).map(move |d| Ray::new(point - distance * d, d))
    });
    rays.filter(|ray| surface.closest_hit(ray).is_none()).count()
}

#[test]
fn no_ray_slips_through_a_point_or_an_edge_without_derivatives() {
    // The poles of the teapot's bottom and lid, in each of which four patches collapse to a point.
    let teapot: Vec<ControlNet> = patches(TEAPOT).into_iter().map(|(_, net)| net).collect();
    let collapsed = |net: &ControlNet| {
        let ends = [net.points[0], net.points[3], net.transposed().points[0], net.transposed().points[3]];
        ends.into_iter().find(|edge| edge.iter().all(|p| *p == edge[0])).map(|edge| edge[0])
    };
    let poles: Vec<DVec3> = teapot.iter().filter_map(collapsed).collect();
    assert!(poles.len() >= 8, "{} patches with a collapsed edge", poles.len());
    assert_eq!(leaks(&teapot, poles.into_iter().map(|pole| (pole, DVec3::Z)), 1.0), 0, "through a pole");

    // Two patches that meet in a ridge, where the edge row of each is equal to the row beside it.
    let slope = |side: f64| {
        let x = [0.0, 0.0, 0.5, 1.0];
        let point = |i: usize, j: usize| DVec3::new(side * x[i], j as f64 / 3.0, 0.2 * x[i]);
        ControlNet { points: std::array::from_fn(|i| std::array::from_fn(|j| point(i, j))) }
    };
    let ridge = (1..100).map(|k| (DVec3::Y * f64::from(k) / 100.0, DVec3::Z));
    assert_eq!(leaks(&[slope(1.0), slope(-1.0)], ridge, 1.0), 0, "through a ridge");
}

#[test]
fn no_far_ray_slips_between_slivers() {
    // Side by side, ten thousand times as long as wide, bent along their length, turned away from the axes.
    let turn = DMat3::from_rotation_z(0.4) * DMat3::from_rotation_x(0.9);
    let sliver = |side: usize| {
        let point = |i: usize, j: usize| {
            let x = i as f64 / 3.0;
            turn * DVec3::new(x, 1e-4 * (side as f64 + j as f64 / 3.0), 0.3 * (5.0 * x).sin())
        };
        ControlNet { points: std::array::from_fn(|i| std::array::from_fn(|j| point(i, j))) }
    };
    let (left, mut right) = (sliver(0), sliver(1));
    (0..4).for_each(|i| right.points[i][0] = left.points[i][3]);
    for distance in [1.0, 1e3, 3e3] {
        let patch = Patch::new(left);
        let seam = (1..200).map(|k| f64::from(k) / 200.0).map(|u| (left.eval(u, 1.0), patch.normal(u, 1.0)));
        assert_eq!(leaks(&[left, right], seam, distance), 0, "from {distance} times their length");
    }
}

/// A crumpled patch with one far control point, along an axis or across all axes, and rays at its points from near by.
#[test]
fn hits_on_needles_are_exact_across_the_needle() {
    for far in [DVec3::new(0.0, -1e6, 0.0), DVec3::new(7e5, -3e5, 5e5)] {
        let crumpled = |k: usize| DVec3::new(2.1, 3.3, 4.7).map(|turn| (turn * (k as f64 + 1.0)).sin());
        let mut net = ControlNet { points: std::array::from_fn(|i| std::array::from_fn(|j| crumpled(4 * i + j))) };
        net.points[1][2] += far;
        let patch = Patch::new(net);
        let length = net.bounds().diagonal();
        for k in 1..2000 {
            let k = f64::from(k);
            let (u, v) = ((0.618 * k).fract(), (0.414 * k).fract());
            let direction = DVec3::new((1.1 * k).sin(), (2.3 * k).cos(), (0.7 * k).sin() + 1e-3);
            let ray = Ray::new(net.eval(u, v) - 4.0 * direction, direction);
            let hit = patch.intersect(&ray).unwrap_or_else(|| panic!("{far}: {u} {v} is missed"));
            // Coordinates along the needle are rounded to 1e-16 of its length; 1e-9 of it would be a thousandth of its width.
            let off = net.eval(hit.u, hit.v).distance(ray.at(hit.t));
            assert!(off < 1e-11 * length, "{far}: S({}, {}) is {off} off the ray", hit.u, hit.v);
            assert!(hit.t < 4.0 + 1e-9 * length, "{far}: {u} {v} is hit at {}", hit.t);
            let at = net.derivatives(hit.u, hit.v);
            let normal = at.dpdu.cross(at.dpdv).normalize();
            // The cross product of derivatives of a millionth of their width apart keeps 1e-10 of its digits.
            assert!(patch.normal(hit.u, hit.v).distance(normal) < 1e-6, "{far}: {u} {v} {normal}");
        }
    }
}

#[test]
fn the_command_line_gives_the_same_answers() {
    let dir = tempfile::tempdir().unwrap();
    let path = |name: &str, text: &str| {
        fs::write(dir.path().join(name), text).unwrap();
        dir.path().join(name).to_str().unwrap().to_owned()
    };
    let header = "ox,oy,oz,dx,dy,dz,tmin\n";
    let (patches, rays) =
        (path("patches.txt", PATCHES), path("rays.csv", &format!("{header}0.5,0.25,2,0,0,-4,0\n9,9,9,0,0,1,\n")));
    let output = patchlight(dir.path(), &["intersect", &patches, &rays, "--patch", "flat"]);
    let lines: Vec<String> = String::from_utf8(output.stdout).unwrap().lines().map(str::to_owned).collect();
    let numbers: Vec<f64> = lines[0].split(',').map(|word| word.parse().unwrap()).collect();
    // The points of the patch are thirds in single precision, so u and v are off by up to 1e-8.
    for (number, expected) in numbers.iter().zip([1.0, 0.5, 0.5, 0.25]) {
        assert!((number - expected).abs() < 1e-7, "{lines:?}");
    }
    assert_eq!((numbers.len(), lines[1].as_str(), lines.len()), (4, "0,,,", 2));

    let wrong = path("wrong.csv", &format!("{header}1,2,3,4,5,x,0\n"));
    let output = patchlight(dir.path(), &["intersect", &patches, &wrong]);
    let message = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2), "{message}");
    assert!(message.contains("wrong.csv: line 2: expected a finite number for dz, found `x`"), "{message}");
}

#[test]
fn exported_files_read_back() {
    let dir = tempfile::tempdir().unwrap();
    let to = |name: &str| dir.path().join(name).to_str().unwrap().to_owned();
    assert!(patchlight(dir.path(), &["export", "teapot", "-o", &to("teapot.bpt")]).status.success());
    let nets = read_bpt(&fs::read_to_string(to("teapot.bpt")).unwrap()).unwrap();
    assert_eq!(nets.len(), 32);
    assert!(patchlight(dir.path(), &["export", "teapot", "-o", &to("teapot.obj"), "--steps", "3"]).status.success());
    let text = fs::read_to_string(to("teapot.obj")).unwrap();
    let count = |start: &str| text.lines().filter(|line| line.starts_with(start)).count();
    assert_eq!((count("f "), count("vn ")), (32 * 9, count("v ")));
    let output = patchlight(dir.path(), &["export", "teapot", "-o", &to("teapot.ply")]);
    assert_eq!(output.status.code(), Some(2), "{}", String::from_utf8_lossy(&output.stderr));
}
