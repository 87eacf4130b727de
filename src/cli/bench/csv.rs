use super::measurement::Measurement;

/// All measurements as CSV. Columns about pixels outside of a mask stay empty without a mask.
pub(super) fn csv(rows: &[Measurement]) -> String {
    let mut text = "seed,mark,seconds,iterations,photons,rays,dropped,rmse,rel_mse,rmse_trimmed,rel_mse_trimmed,\
                    rmse_outside,rel_mse_outside,flip,flip_outside,mean_ratio_r,mean_ratio_g,mean_ratio_b,estimate_over_error,\
                    camera,photons_pass,map,gather,commit,shadow_rays,caustic_paths,global_paths,photons_stored,splats,\
                    caustic_gathers,global_gathers,map_builds,texture_lookups\n"
        .to_owned();
    for row in rows {
        let Measurement { seed, mark, stats, errors, outside, flip, flip_outside } = row;
        let counts = [stats.iterations, stats.photons_emitted, stats.rays, stats.dropped_samples];
        let [r, g, b] = errors.mean_ratio;
        let passes = &stats.passes;
        let numbers = [
            Some(errors.rmse),
            Some(errors.rel_mse),
            Some(errors.rmse_trimmed),
            Some(errors.rel_mse_trimmed),
            outside.map(|e| e.rmse),
            outside.map(|e| e.rel_mse),
            *flip,
            *flip_outside,
            Some(r),
            Some(g),
            Some(b),
            row.estimate_over_error(),
            Some(passes.camera),
            Some(passes.photons),
            Some(passes.map),
            Some(passes.gather),
            Some(passes.commit),
        ];
        let c = &stats.counters;
        let counters = [
            c.shadow_rays,
            c.caustic_paths,
            c.global_paths,
            c.photons_stored,
            c.splats,
            c.caustic_gathers,
            c.global_gathers,
            c.map_builds,
            c.texture_lookups,
        ];
        let counters = counters.map(|n| n.to_string()).join(",");
        let counts = counts.map(|n| n.to_string()).join(",");
        let numbers = numbers.map(|x| x.map_or(String::new(), |x| x.to_string())).join(",");
        text += &format!("{seed},{mark},{},{counts},{numbers},{counters}\n", stats.seconds);
    }
    text
}
