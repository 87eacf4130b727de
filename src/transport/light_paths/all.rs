use super::edges::edges;
use super::images::image;
use super::polyline::Polyline;
use super::source::Source;
use crate::world::{Light, World};
use glam::DVec2;
use rayon::prelude::*;

/// An object of more patches shows the paths of one of them.
const MOST_PATCHES: usize = 8;
/// Most lights whose paths are shown: those that shine brightest on the first of the patches.
const MOST_LIGHTS: usize = 4;
/// Where more patches than these are shown, each has fewer lines.
const FEW_PATCHES: usize = 2;
/// Parts of a patch between its lines, each way, where few and where many patches are shown. Quarters are where isolines lie.
const PARTS: [usize; 2] = [8, 4];
/// Cells along a patch in which the edges of caustics are looked for, where few and where many patches are shown.
const CELLS: [usize; 2] = [32, 12];
/// About how many ways are shown.
const WAYS: f64 = 144.0;
/// Corners of a way are joined by this many points each, because a part of the way may be hidden.
const POINTS: usize = 6;

/// What light does at a surface of mirror or glass.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LightPaths {
    /// The images of lines of equal u, and of lines of equal v, on the surfaces where their light lands.
    pub lines: [Vec<Polyline>; 2],
    /// The edges of the caustic.
    pub edges: Vec<Polyline>,
    /// Ways of light from the lights to where it lands, evenly spaced in u and v.
    pub ways: Vec<Polyline>,
}

/// The light paths at an object of the scene, by its index: at all of its patches where they are few, else at one of them. Empty for an
/// object without patches, that is neither mirror nor glass, or that no light reaches straight. Draws no random numbers, so that the paths
/// move as smoothly as the surface.
pub fn light_paths(world: &World, object: u32, patch: usize) -> LightPaths {
    let mut patches: Vec<u32> =
        (0..world.surfaces.len() as u32).filter(|&primitive| world.object_of(primitive) == Some(object)).collect();
    if patches.len() > MOST_PATCHES {
        patches = patches.get(patch).copied().into_iter().collect();
    }
    let Some(&first) = patches.first().filter(|&&first| world.is_specular(first)) else { return LightPaths::default() };
    let lights = brightest(world, first);
    let pairs = patches.iter().flat_map(|&patch| lights.iter().map(move |&light| (patch, light)));
    let sources: Vec<Source<'_>> = pairs.filter_map(|(patch, light)| Source::new(world, light, patch)).collect();
    let many = usize::from(patches.len() > FEW_PATCHES);
    let ways_along = (WAYS / sources.len().max(1) as f64).sqrt().ceil() as usize;
    let of_source = |source: &Source<'_>| LightPaths {
        lines: [DVec2::X, DVec2::Y].map(|fixed| lines(source, fixed, PARTS[many])),
        edges: edges(source, CELLS[many]),
        ways: ways(source, ways_along),
    };
    let found: Vec<LightPaths> = sources.par_iter().map(of_source).collect();
    found.into_iter().fold(LightPaths::default(), LightPaths::with)
}

impl LightPaths {
    fn with(mut self, other: Self) -> Self {
        self.lines.iter_mut().zip(other.lines).for_each(|(all, more)| all.extend(more));
        self.edges.extend(other.edges);
        self.ways.extend(other.ways);
        self
    }

    /// Whether no light reaches the surface straight.
    pub fn is_empty(&self) -> bool {
        self.ways.is_empty()
    }
}

/// The lights whose paths are shown, brightest first where there are many.
fn brightest(world: &World, patch: u32) -> Vec<usize> {
    let mut lights: Vec<usize> = (0..world.lights.len()).collect();
    if lights.len() > MOST_LIGHTS {
        let middle = world.aggregate.primitives()[patch as usize].bounds().center();
        let irradiance = |light: &Light| match light {
            Light::Parallel(rays) => f64::from(rays.irradiance.max_element()),
            lamp => {
                f64::from(lamp.power().max_element())
                    / (4.0 * std::f64::consts::PI * lamp.center().distance_squared(middle))
            }
        };
        lights.sort_by(|&a, &b| irradiance(&world.lights[b]).total_cmp(&irradiance(&world.lights[a])));
        lights.truncate(MOST_LIGHTS);
    }
    lights
}

/// The images of the lines on which u (`fixed` is the x axis) or v is fixed, `parts` + 1 of them.
fn lines(source: &Source<'_>, fixed: DVec2, parts: usize) -> Vec<Polyline> {
    let line = |k: usize| image(source, |t| fixed * (k as f64 / parts as f64) + (DVec2::ONE - fixed) * t);
    (0..=parts).into_par_iter().flat_map_iter(line).collect()
}

/// Ways through the middles of `side` x `side` cells of the patch.
fn ways(source: &Source<'_>, side: usize) -> Vec<Polyline> {
    let way = |k: usize| {
        let uv = (DVec2::new((k % side) as f64, (k / side) as f64) + 0.5) / side as f64;
        let corners = source.way(uv);
        let mut way = Polyline::default();
        for ends in corners.windows(2) {
            let points = (0..POINTS).map(|k| ends[0].lerp(ends[1], k as f64 / POINTS as f64));
            points.for_each(|point| way.push(source.world, point, None));
        }
        corners.last().into_iter().for_each(|end| way.push(source.world, *end, None));
        way
    };
    (0..side * side).into_par_iter().map(way).filter(|way| !way.points.is_empty()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::transport::testing::{self, quad};
    use glam::DVec3;

    /// Landing places are a few roundings of coordinates of size 1.
    const TOLERANCE: f64 = 1e-9;
    /// The slope dx/dz of the rays that fall on mirrors and glass.
    const SLOPE: f64 = 0.3;

    /// The polar form of a cubic function of x.
    type Height<'a> = &'a dyn Fn([f64; 3]) -> f64;

    /// An object of patches over the square [-1, 1]^2 with these heights: u goes along x, v along y. A flipped patch faces down.
    fn surface(material: &str, sheets: &[(Height<'_>, bool)]) -> String {
        let patch = |&(height, is_flipped): &(Height<'_>, bool)| {
            let point = |i: usize, j: usize| {
                // Polar forms: the control point i is the height at three arguments, i of which are 1 and the others -1.
                let arguments = std::array::from_fn(|k| if k < i { 1.0 } else { -1.0 });
                [2.0 * i as f64 / 3.0 - 1.0, 2.0 * j as f64 / 3.0 - 1.0, height(arguments)]
            };
            let at = |i, j| if is_flipped { point(j, i) } else { point(i, j) };
            (0..4).map(|i| (0..4).map(|j| at(i, j)).collect::<Vec<_>>()).collect::<Vec<_>>()
        };
        let patches: Vec<_> = sheets.iter().map(patch).collect();
        format!("[[object]]\nname = \"surface\"\ntype = \"bezier\"\nmaterial = {material:?}\npatches = {patches:?}\n")
    }

    fn mirror(height: Height<'_>) -> String {
        surface("mirror", &[(height, false)])
    }

    /// A receiver in the plane z, and a beam from z = 1.5 along -z with dx/dz = -slope, which covers the square of the surface.
    fn lit(z: f64, slope: f64) -> String {
        let (side, normal) = (f64::from(if z > 0.0 { -1 } else { 1 }), "normal");
        let start = -1.5 * slope;
        format!(
            "[[object]]\nname = \"wall\"\ntype = \"plane\"\nmaterial = \"white\"\npoint = [0, 0, {z:?}]\n{normal} = [0, 0, {side:?}]
             [[light]]\nname = \"beam\"\ntype = \"beam\"\ncenter = [{start:?}, 0, 1.5]\ndirection = [{slope:?}, 0, -1]
             radius = 3\npower = [1, 1, 1]\n"
        )
    }

    fn paths(text: &[&str]) -> LightPaths {
        light_paths(&testing::world(&text.concat()), 0, 0)
    }

    fn points(curves: &[Polyline]) -> impl Iterator<Item = DVec3> {
        curves.iter().flat_map(|curve| curve.points.iter().copied())
    }

    /// Asserts that the lines of equal u land at these x, one curve each, all along y.
    fn assert_lands(found: &LightPaths, landing: impl Fn(f64) -> f64) {
        let lines = &found.lines[0];
        assert_eq!(lines.len(), 9);
        for (k, line) in lines.iter().enumerate() {
            let expected = landing(0.25 * k as f64 - 1.0);
            let ends = [line.points[0].y, line.points[line.points.len() - 1].y];
            assert!(ends[0].abs() > 0.999 && ends[1].abs() > 0.999, "{ends:?}");
            // Lines along edges keep a little away from them.
            let tolerance = if k % 8 == 0 { 1e-4 } else { TOLERANCE };
            for point in &line.points {
                assert!((point.x - expected).abs() < tolerance, "line {k}: {point} instead of {expected}");
            }
        }
    }

    #[test]
    fn a_plane_mirror_shows_its_lines_as_they_are() {
        let found = paths(&[&mirror(&|_| 0.0), &lit(2.0, SLOPE)]);
        assert_lands(&found, |x| x + 2.0 * SLOPE);
        assert_eq!(found.edges, [], "a plane mirror makes no caustic");
        for way in &found.ways {
            let [start, end] = [0, way.points.len() - 1].map(|k| way.points[k]);
            let corner = way.points[POINTS];
            let down = DVec3::new(SLOPE, 0.0, -1.0);
            assert!(
                (start - DVec3::new(-1.5 * SLOPE, 0.0, 1.5)).dot(down).abs() < TOLERANCE,
                "{start} is not in the beam"
            );
            assert!(
                (corner - start).cross(down).length() < TOLERANCE && corner.z.abs() < TOLERANCE,
                "{start} to {corner}"
            );
            let up = DVec3::new(2.0 * SLOPE, 0.0, 2.0);
            assert!((end - corner).distance(up) < TOLERANCE, "{corner} to {end}");
        }
        assert_eq!(found.ways.len(), 144);
    }

    /// A parabola of focal length 1 sends light along its axis through its focus: from (x, z) to `x (1 - h) / (1 - z)` at height h.
    #[test]
    fn a_parabola_sends_light_through_its_focus() {
        let height = |[a, b, c]: [f64; 3]| (a * b + b * c + c * a) / 12.0;
        let found = paths(&[&mirror(&height), &lit(2.5, 0.0)]);
        assert_lands(&found, |x| -1.5 * x / (1.0 - 0.25 * x * x));
        assert_eq!(found.edges, [], "light crosses in the focal line alone");
    }

    /// A mirror of height `g = a x^2 + b x^3` reflects light along -z at x to `x - 2 (h - g) g' / (1 - g'^2)` at height h, by the law of
    /// reflection. The caustic's edge is where that has its extremum.
    #[test]
    fn the_edge_of_a_caustic_is_where_its_map_turns() {
        let (a, b, h) = (0.1, 0.1, 2.0);
        let height = |[p, q, r]: [f64; 3]| a * (p * q + q * r + r * p) / 3.0 + b * p * q * r;
        let found = paths(&[&mirror(&height), &lit(h, 0.0)]);
        let landing = |x: f64| {
            let (g, slope) = (a * x * x + b * x * x * x, 2.0 * a * x + 3.0 * b * x * x);
            x - 2.0 * (h - g) * slope / (1.0 - slope * slope)
        };
        // The extremum by the finest of samples; the map is flat there, so its value is good to rounding.
        let samples = (0..=1_000_000).map(|k| landing(2e-6 * f64::from(k) - 1.0));
        let expected = samples.fold(f64::NEG_INFINITY, f64::max);
        let [edge] = &found.edges[..] else { panic!("{} edges", found.edges.len()) };
        assert!(edge.points.iter().all(|point| (point.x - expected).abs() < 1e-6), "{edge:?} beside {expected}");
        let ys = [edge.points[0].y, edge.points[edge.points.len() - 1].y];
        assert!((ys[0] - ys[1]).abs() > 1.999, "from one side of the mirror to the other");
        assert!(points(&found.lines[1]).all(|point| point.x < expected + TOLERANCE), "no light beyond the edge");
    }

    #[test]
    fn an_object_in_the_light_breaks_the_lines() {
        // At height 1 it shades the mirror from x = 0.2 to 0.4, and stops its light from x = -0.4 to -0.2.
        let stop = quad("stop", [[-0.1, -0.5, 1.0], [0.2, 0.0, 0.0], [0.0, 1.0, 0.0]], "black");
        let found = paths(&[&mirror(&|_| 0.0), &stop, &lit(2.0, SLOPE)]);
        for point in points(&found.lines[0]).chain(points(&found.lines[1])).filter(|point| point.y.abs() < 0.499) {
            let x = point.x - 2.0 * SLOPE;
            assert!(!(0.201..0.399).contains(&x) && !(-0.399..-0.201).contains(&x), "light at {point}");
        }
        let across = found.lines[1].iter().filter(|line| line.points[0].y.abs() < 0.01).count();
        assert_eq!(across, 3, "the middle line in three parts");
        let gaps = points(&found.lines[1]).filter(|point| point.y.abs() < 0.01);
        let nearest = gaps.map(|point| (point.x - 2.0 * SLOPE - 0.2).abs()).fold(f64::INFINITY, f64::min);
        assert!(nearest < 1e-4, "a part ends {nearest} before the shadow");
        let opaque = paths(&[&surface("white", &[(&|_| 0.0, false)]), &lit(2.0, SLOPE)]);
        assert!(opaque.is_empty(), "the surface is no mirror");
    }

    /// A plate of glass shifts light aside, by Snell's law.
    #[test]
    fn glass_sends_light_on_to_what_is_behind_it() {
        let glass = "[[material]]\nname = \"glass\"\ntype = \"glass\"\nior = 1.5\n";
        let plate = surface("glass", &[(&|_| 0.0, false), (&|_| -0.2, true)]);
        let found = paths(&[glass, &plate, &lit(-1.0, SLOPE)]);
        let sine = SLOPE / SLOPE.hypot(1.0) / 1.5;
        let shift = 0.2 * sine / (1.0 - sine * sine).sqrt() + 0.8 * SLOPE;
        // Beside the upper face, light enters and leaves through the open sides.
        let is_whole = |line: &&Polyline| (line.points[0].y - line.points[line.points.len() - 1].y).abs() > 1.99;
        let whole = found.lines[0].iter().filter(is_whole);
        let inside: Vec<&Polyline> = whole.filter(|line| line.points[0].x < 0.9 + shift).collect();
        assert_eq!(inside.len(), 8);
        for (k, line) in inside.into_iter().enumerate() {
            let expected = 0.25 * k as f64 - 1.0 + shift;
            assert!(line.points.iter().all(|point| (point.x - expected).abs() < 1e-4), "{line:?} beside {expected}");
        }
    }
}
