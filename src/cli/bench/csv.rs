use super::measurement::Measurement;
use crate::engine::{Counters, Stats};

const HEAD: &str = "seed,mark,seconds,iterations,photons,rays,dropped,rmse,rel_mse,rmse_trimmed,rel_mse_trimmed,\
                    rmse_outside,rel_mse_outside,flip,flip_outside,mean_ratio_r,mean_ratio_g,mean_ratio_b,estimate_over_error,\
                    camera,photons_pass,map,gather,commit,shadow_rays,caustic_paths,global_paths,photons_stored,splats,\
                    caustic_gathers,global_gathers,map_builds,texture_lookups\n";

/// All measurements as CSV. Columns about pixels outside of a mask stay empty without a mask.
pub(super) fn csv(rows: &[Measurement]) -> String {
    rows.iter().fold(HEAD.to_owned(), |text, row| text + &line(row))
}

fn line(row: &Measurement) -> String {
    let Measurement { seed, mark, stats, .. } = row;
    let totals = [stats.iterations, stats.photons_emitted, stats.rays, stats.dropped_samples];
    let (totals, counters) = (joined(totals), joined(counters(&stats.counters)));
    let errors = joined(errors(row).map(|x| x.map_or(String::new(), |x| x.to_string())));
    let passes = joined(pass_seconds(stats));
    format!("{seed},{mark},{},{totals},{errors},{passes},{counters}\n", stats.seconds)
}

fn errors(row: &Measurement) -> [Option<f64>; 12] {
    let Measurement { errors, outside, flip, flip_outside, .. } = row;
    let [r, g, b] = errors.mean_ratio.map(Some);
    [
        Some(errors.rmse),
        Some(errors.rel_mse),
        Some(errors.rmse_trimmed),
        Some(errors.rel_mse_trimmed),
        outside.map(|e| e.rmse),
        outside.map(|e| e.rel_mse),
        *flip,
        *flip_outside,
        r,
        g,
        b,
        row.estimate_over_error(),
    ]
}

fn pass_seconds(stats: &Stats) -> [f64; 5] {
    let passes = &stats.passes;
    [passes.camera, passes.photons, passes.map, passes.gather, passes.commit]
}

fn counters(c: &Counters) -> [u64; 9] {
    [
        c.shadow_rays,
        c.caustic_paths,
        c.global_paths,
        c.photons_stored,
        c.splats,
        c.caustic_gathers,
        c.global_gathers,
        c.map_builds,
        c.texture_lookups,
    ]
}

fn joined<T: ToString, const N: usize>(values: [T; N]) -> String {
    values.map(|value| value.to_string()).join(",")
}
