use super::polyline::Polyline;
use super::source::{Landing, Source};
use crate::world::World;
use glam::DVec2;

/// Parts of a line that are divided further as needed.
const PARTS: usize = 16;
/// How often a part is halved.
const HALVINGS: u32 = 5;
/// How often a part is halved whose ends send light different ways, so that curves end where the light turns to another way.
const BISECTIONS: u32 = 12;
/// Distance between a chord and the curve that is not divided further, pixels.
const TOLERANCE: f64 = 0.25;
/// A chord whose middle lies nearer to one of its ends than this part of it may leap over a gap.
const LOPSIDED: f64 = 0.1;
/// Most length of the shortest chords, over those twice as long in the parameter, of a curve without a leap; without leaps it is about a
/// half.
const LEAP: f64 = 0.75;

/// The images of a line of the patch, `at` from 0 to 1, on the surfaces where its light lands: a curve for each part whose light takes one
/// sequence of surfaces.
pub(super) fn image(source: &Source<'_>, at: impl Fn(f64) -> DVec2) -> Vec<Polyline> {
    let mut image = Image { source, at, curves: Vec::new(), open: Polyline::default() };
    let mut start = image.sample(0.0);
    for part in 1..=PARTS {
        let end = image.sample(part as f64 / PARTS as f64);
        image.part([start, end], HALVINGS, f64::INFINITY);
        start = end;
    }
    image.close();
    image.curves
}

/// A point of the line, from 0 to 1, and where its light lands.
type Sample = (f64, Option<Landing>);

struct Image<'a, At> {
    source: &'a Source<'a>,
    at: At,
    curves: Vec<Polyline>,
    /// The curve that the next point may continue.
    open: Polyline,
}

impl<At: Fn(f64) -> DVec2> Image<'_, At> {
    fn sample(&self, t: f64) -> Sample {
        (t, self.source.landing((self.at)(t)))
    }

    /// Adds the part of the curve between two samples. `before` is the length of the chord over the part that was halved, scene units;
    /// infinite without such a chord.
    fn part(&mut self, [start, end]: [Sample; 2], halvings: u32, before: f64) {
        if start.1.is_none() && end.1.is_none() {
            return;
        }
        let both = start.1.zip(end.1).filter(|(a, b)| a.signature == b.signature);
        if halvings == 0 {
            let most = |a: &Landing| (LEAP * before).max(pixel(self.source.world, a));
            match both {
                Some((a, b)) if a.position.distance(b.position) <= most(&a) => self.push(&[a, b]),
                Some(_) => self.close(),
                None => self.divide([start, end]),
            }
            return;
        }
        let middle = self.sample(0.5 * (start.0 + end.0));
        if let (Some(a), Some(m), Some(b)) = (start.1, middle.1, end.1)
            && is_straight(self.source.world, [a, m, b])
        {
            return self.push(&[a, m, b]);
        }
        let chord = both.map_or(f64::INFINITY, |(a, b)| a.position.distance(b.position));
        self.part([start, middle], halvings - 1, chord);
        self.part([middle, end], halvings - 1, chord);
    }

    /// Adds the part between two samples whose light goes different ways, each up to the place where the way changes.
    fn divide(&mut self, [mut start, mut end]: [Sample; 2]) {
        let signature = |sample: Sample| sample.1.map(|landing| landing.signature);
        let (first, last) = (start.1, end.1);
        for _ in 0..BISECTIONS {
            let middle = self.sample(0.5 * (start.0 + end.0));
            if signature(middle) == signature(start) {
                start = middle;
            } else if signature(middle) == signature(end) {
                end = middle;
            } else {
                break;
            }
        }
        let ends = |ends: [Option<Landing>; 2]| ends.into_iter().flatten().collect::<Vec<_>>();
        self.push(&ends([first, start.1]));
        self.close();
        self.push(&ends([end.1, last]));
    }

    /// Adds points to the open curve, unless it ends there already.
    fn push(&mut self, landings: &[Landing]) {
        for landing in landings {
            if self.open.points.last() != Some(&landing.position) {
                self.open.push(self.source.world, landing.position, Some(landing.n_side));
            }
        }
    }

    fn close(&mut self) {
        let curve = std::mem::take(&mut self.open);
        self.curves.extend((curve.points.len() > 1).then_some(curve));
    }
}

/// The side of a pixel at a landing, scene units.
fn pixel(world: &World, landing: &Landing) -> f64 {
    world.camera.footprint(landing.position.distance(world.camera.position))
}

/// Whether three landings lie on a curve of one sequence of surfaces that two chords follow.
pub(super) fn is_straight(world: &World, [a, m, b]: [Landing; 3]) -> bool {
    let (chord, pixel) = (b.position - a.position, pixel(world, &m));
    let sides = [a, b].map(|end| end.position.distance(m.position));
    let off = (m.position - a.position).reject_from_normalized(chord.normalize_or_zero()).length();
    let is_even = sides[0].min(sides[1]) >= LOPSIDED * (sides[0] + sides[1]);
    a.signature == m.signature
        && m.signature == b.signature
        && (sides[0].max(sides[1]) <= pixel || (is_even && off <= TOLERANCE * pixel))
}
