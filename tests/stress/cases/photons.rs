//! Photon maps against sums over all photons, and components without photons: P1 to P5.

use crate::suite::{Case, HEAD, Tolerance, anomalies, glass, point_light, quad, sphere, unit};
use glam::Vec3;
use patchlight::math::Rgb;
use patchlight::transport::{Photon, PhotonMap, Query};

/// Queries of one round.
const QUERIES: u64 = 1000;

/// A name, a number of photons, and the position of a photon for three random numbers.
type Distribution = (&'static str, u64, fn([f32; 3]) -> Vec3);

pub(crate) fn cases() -> Vec<Case> {
    let distributions: [Distribution; 9] =
        [
            ("no photon", 0, |[x, y, z]| Vec3::new(x, y, z)),
            ("one photon", 1, |[x, y, z]| Vec3::new(x, y, z)),
            ("photons in a cube", 5000, |[x, y, z]| Vec3::new(x, y, z)),
            ("photons in a plane", 5000, |[x, _, z]| Vec3::new(x, 0.25, z)),
            ("photons on a line", 5000, |[x, _, _]| Vec3::new(0.0, 1e-3 * x, 0.0)),
            ("photons in one point", 5000, |_| Vec3::splat(0.5)),
            ("photons in one point, and one far away", 5000, |[x, _, _]| {
                if x < 1e-3 { Vec3::splat(1e7) } else { Vec3::splat(0.5) }
            }),
            ("photons in a tiny cube far away", 5000, |[x, y, z]| Vec3::splat(1e5) + 1e-1 * Vec3::new(x, y, z)),
            ("photons at equal places", 4999, |[x, _, _]| Vec3::new((x * 8.0).floor(), 0.0, 0.0) / 8.0),
        ];
    let mut cases = Vec::new();
    for (name, count, distribution) in distributions {
        let wrong = move |round| wrong_sums(count, &distribution, round);
        cases.push(Case::faults(format!("wrong sums over discs: {name}"), "P1, P2, P3, P5", (QUERIES, "discs"), wrong));
    }
    cases.push(crowd());
    cases.extend(components());
    cases
}

/// P1: ten million photons of flux 1 in one point, all in one disc around it.
fn crowd() -> Case {
    const COUNT: u64 = 10_000_000;
    let sum = || {
        let photon = Photon { position: Vec3::splat(0.5), flux: Rgb::ONE, wi: Vec3::Y, cos: 1.0, tag: 0 };
        let map = PhotonMap::build(&vec![photon; COUNT as usize]);
        let (position, normal, slope) = (Vec3::splat(0.5), Vec3::Y, Vec3::ZERO);
        let disc = Query { position, normal, radius: 0.1, slope, tag_start: 0, tag_span: 1 };
        f64::from(map.sums(&[disc])[0].y)
    };
    let name = "flux of ten million photons in one point";
    Case::exact(name, "P1", COUNT as f64, Tolerance::Relative(1e-3), (COUNT, "photons"), sum)
}

/// The number of discs whose sum differs from the sum over all photons by more than rounding.
fn wrong_sums(count: u64, distribution: &impl Fn([f32; 3]) -> Vec3, round: u64) -> u64 {
    let numbers = |k: u64| [0, 1, 2].map(|d| unit(round, k, d) as f32);
    let photon = |k: u64| {
        let flux = Rgb::new(1.0, unit(round, k, 3) as f32, 0.5);
        Photon { position: distribution(numbers(k)), flux, wi: Vec3::Y, cos: 1.0, tag: (k % 3) as u32 }
    };
    let photons: Vec<Photon> = (0..count).map(photon).collect();
    let query = |k: u64| {
        // From discs without extent to discs that hold everything; one in ten is far outside.
        let radius = [1e-18, 1e-9, 1e-3, 0.05, 0.3, 10.0][(k % 6) as usize];
        let outside = if k.is_multiple_of(10) { Vec3::splat(1e6) } else { Vec3::ZERO };
        let position = distribution(numbers(count + k)) + outside;
        Query { position, normal: Vec3::Y, radius, slope: Vec3::ZERO, tag_start: (k % 2) as u32, tag_span: 2 }
    };
    let queries: Vec<Query> = (0..QUERIES).map(query).collect();
    let sums = PhotonMap::build(&photons).sums(&queries);
    let is_wrong = |(found, query): &(Rgb, &Query)| {
        let expected = scanned(&photons, query);
        // Up to 5,000 terms of at most 1 in another order: 5,000 roundings of 6e-8.
        !((*found - expected).abs().max_element() <= 3e-4 * (1.0 + expected.max_element()))
    };
    sums.into_iter().zip(&queries).filter(is_wrong).count() as u64
}

/// The kernel-weighted sum of a query over all photons.
fn scanned(photons: &[Photon], query: &Query) -> Rgb {
    let weighted = |photon: &Photon| {
        let offset = photon.position - query.position;
        let weight = 1.0 - (offset / query.radius).length_squared();
        let is_near = offset.dot(query.normal).abs() < Query::SLAB * query.radius;
        let counts = (query.tag_start..query.tag_start + query.tag_span).contains(&photon.tag);
        if weight > 0.0 && is_near && counts { weight * photon.flux } else { Rgb::ZERO }
    };
    photons.iter().map(weighted).sum()
}

/// P4: components that are planned, but that no photon can reach.
fn components() -> Vec<Case> {
    let head = format!("{HEAD}[film]\nwidth = 16\nheight = 16\n") + &glass("glass", 1.5, 0.0);
    let wall = |material| quad("wall", [[-1.0, -1.0, -1.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0]], material);
    let enclosed = sphere("case", [0.0, 0.0, 9.0], 0.5, "black") + &point_light([0.0, 0.0, 9.0], 1.0);
    let scenes = [
        ("no light", wall("grey")),
        ("no object", point_light([0.0; 3], 1.0)),
        ("nothing at all", String::new()),
        ("a lamp in a black case", wall("grey") + &sphere("ball", [0.0; 3], 0.5, "glass") + &enclosed),
        (
            "everything black",
            wall("black") + &sphere("ball", [0.0; 3], 0.5, "glass") + &point_light([0.0, 2.0, 0.0], 1.0),
        ),
    ];
    let case = |(name, rest): (&str, String)| {
        let text = head.clone() + &rest;
        Case::faults(format!("improper pixels: {name}"), "P4", (256, "pixels"), move |round| anomalies(&text, 8, round))
    };
    scenes.into_iter().map(case).collect()
}
