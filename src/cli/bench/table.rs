use super::measurement::{Measurement, log_slope};
use std::fmt::Write;

/// The head of the table that people read.
pub(super) fn header() -> String {
    format!(
        "{:>8} {:>4} {:>10} {:>11} {:>12} {:>10} {:>10} {:>10} {:>10}  {}",
        "seconds",
        "seed",
        "iterations",
        "photons",
        "rays",
        "RMSE",
        "relMSE",
        "RMSE 99.9%",
        "relMSE 99.9%",
        "mean/true R G B"
    )
}

/// A line of it.
pub(super) fn line(row: &Measurement) -> String {
    let (stats, errors) = (&row.stats, &row.errors);
    let [r, g, b] = errors.mean_ratio;
    format!(
        "{:>8.2} {:>4} {:>10} {:>11} {:>12} {:>10.5} {:>10.3e} {:>10.5} {:>12.3e}  {r:.4} {g:.4} {b:.4}",
        stats.seconds,
        row.seed,
        stats.iterations,
        stats.photons_emitted,
        stats.rays,
        errors.rmse,
        errors.rel_mse,
        errors.rmse_trimmed,
        errors.rel_mse_trimmed,
    )
}

/// How fast the errors fall, and where the time went.
pub(super) fn summary(rows: &[Measurement]) -> String {
    let slope = |error: fn(&Measurement) -> f64| log_slope(rows.iter().map(|row| (row.stats.seconds, error(row))));
    let (rmse, rel_mse) = (slope(|row| row.errors.rmse), slope(|row| row.errors.rel_mse));
    let mut text = if rmse.is_finite() && rel_mse.is_finite() {
        format!("RMSE falls like t^{rmse:.2}, relMSE like t^{rel_mse:.2}\n")
    } else {
        String::new()
    };
    if let Some(last) = rows.last() {
        let passes = &last.stats.passes;
        let total = last.stats.seconds / 100.0;
        // Writing to a string cannot fail.
        writeln!(
            text,
            "time: camera {:.0} %, photons {:.0} %, photon map {:.0} %, gather {:.0} %, commit {:.0} %; \
             prepared in {:.3} s",
            passes.camera / total,
            passes.photons / total,
            passes.map / total,
            passes.gather / total,
            passes.commit / total,
            passes.prepare,
        )
        .ok();
    }
    text
}

/// Everything that was measured, for other programs.
pub(super) fn csv(rows: &[Measurement]) -> String {
    let mut text = "seed,mark,seconds,iterations,photons,rays,dropped,rmse,rel_mse,rmse_trimmed,rel_mse_trimmed,\
                    mean_ratio_r,mean_ratio_g,mean_ratio_b,camera,photons_pass,map,gather,commit\n"
        .to_owned();
    for Measurement { seed, mark, stats, errors } in rows {
        let counts = [stats.iterations, stats.photons_emitted, stats.rays, stats.dropped_samples];
        let [r, g, b] = errors.mean_ratio;
        let passes = &stats.passes;
        let numbers = [
            errors.rmse,
            errors.rel_mse,
            errors.rmse_trimmed,
            errors.rel_mse_trimmed,
            r,
            g,
            b,
            passes.camera,
            passes.photons,
            passes.map,
            passes.gather,
            passes.commit,
        ];
        let counts = counts.map(|n| n.to_string()).join(",");
        let numbers = numbers.map(|x| x.to_string()).join(",");
        text += &format!("{seed},{mark},{},{counts},{numbers}\n", stats.seconds);
    }
    text
}
