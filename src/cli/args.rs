use crate::{scene::SurfaceExport, transport::Component};
use clap::{Args, Parser, Subcommand, ValueEnum};
use serde::Deserialize;
use std::{num::NonZeroUsize, path::PathBuf};

/// See what light does with a curved surface.
///
/// Without a command it opens a window. SCENE is a file, or the name of a built-in scene: report, report-flipped,
/// water, cardioid, lens, teapot, cornell.
#[derive(Debug, Parser)]
#[command(version, args_conflicts_with_subcommands = true)]
pub struct Arguments {
    /// The scene to show [default: the built-in scene report]
    pub(super) scene: Option<PathBuf>,
    #[command(subcommand)]
    pub(super) command: Option<Command>,
}

#[derive(Debug, Subcommand)]
pub(super) enum Command {
    /// Render a picture without a window
    Render(RenderArguments),
    /// Measure the error against a reference picture over time
    Bench(BenchArguments),
    /// Check a scene; print what would be rendered, what is skipped and why
    Check(CheckArguments),
    /// Print the nearest hit of every ray on Bezier patches: `1,t,u,v` or `0,,,`
    Intersect(IntersectArguments),
    /// Write the Bezier patches of a scene as a mesh (.obj) or as control points (.bpt)
    Export(ExportArguments),
}

/// How the rendering is done.
#[derive(Debug, Args)]
pub(super) struct RenderSettings {
    /// Pixels of the picture, instead of what the scene says
    #[arg(long, value_name = "WxH", value_parser = parse_size)]
    pub(super) size: Option<(u32, u32)>,
    /// Threads that render [default: one for each core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub(super) threads: Option<u16>,
    /// Another number gives another noise
    #[arg(long, value_name = "K", default_value_t = 0)]
    pub(super) seed: u64,
    /// Render this part of the light alone; the three add up to the picture
    #[arg(long, value_name = "PART")]
    pub(super) only: Option<Part>,
}

/// A part of the light, as people write it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Part {
    /// Lights themselves, what they light with nothing in between, and most of what gloss reflects of it
    Direct,
    /// What mirrors and glass throw onto surfaces
    Caustics,
    /// What surfaces throw onto each other
    Interreflection,
}

impl From<Part> for Component {
    fn from(part: Part) -> Self {
        match part {
            Part::Direct => Self::Direct,
            Part::Caustics => Self::Caustics,
            Part::Interreflection => Self::Interreflection,
        }
    }
}

#[derive(Debug, Args)]
pub(super) struct RenderArguments {
    /// A scene file or the name of a built-in scene
    pub(super) scene: PathBuf,
    /// Where the picture goes: .png as shown on a screen, .exr in linear 32-bit floats
    #[arg(short, long, value_name = "OUT.(png|exr)")]
    pub(super) output: PathBuf,
    #[command(flatten)]
    pub(super) budget: Budget,
    #[command(flatten)]
    pub(super) settings: RenderSettings,
    /// Write numbers about the rendering to this JSON file
    #[arg(long, value_name = "FILE.json")]
    pub(super) stats: Option<PathBuf>,
}

/// When rendering ends; after ten seconds unless one of them says otherwise.
#[derive(Clone, Copy, Debug, Args)]
#[group(multiple = false)]
pub(super) struct Budget {
    /// Render this long, from the first iteration on [default: 10]
    #[arg(long, value_name = "S", value_parser = parse_positive, allow_negative_numbers = true)]
    pub(super) seconds: Option<f64>,
    /// Render this many iterations
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    pub(super) iterations: Option<u64>,
    /// Render until the estimated error, relative to the mean radiance, is below this: 0.02 is 2 %; the fewer the pixels, the
    /// rougher the estimate
    #[arg(long, value_name = "E", value_parser = parse_positive, allow_negative_numbers = true)]
    pub(super) error: Option<f64>,
}

impl Budget {
    /// The seconds of rendering without a budget on the command line.
    pub(super) const DEFAULT_SECONDS: f64 = 10.0;
}

#[derive(Debug, Args)]
pub(super) struct BenchArguments {
    /// A scene file or the name of a built-in scene
    pub(super) scene: Option<PathBuf>,
    /// The true picture
    #[arg(long, value_name = "REF.exr")]
    pub(super) reference: Option<PathBuf>,
    /// Another true picture with other noise: errors are then measured without the noise of either, and outside the mask by
    /// this one alone
    #[arg(long, value_name = "REF.exr", requires = "reference")]
    pub(super) second_reference: Option<PathBuf>,
    /// Count only pixels that are bright in this picture, and the others apart
    #[arg(long, value_name = "MASK.png")]
    pub(super) mask: Option<PathBuf>,
    /// When to measure
    #[arg(long, value_name = "S,S,..", value_delimiter = ',', default_value = "1,2,4,8,16", value_parser = parse_positive, allow_negative_numbers = true)]
    pub(super) seconds: Vec<f64>,
    /// Measure this often, each time with another noise
    #[arg(long, value_name = "K", default_value_t = 1, value_parser = clap::value_parser!(u64).range(1..))]
    pub(super) seeds: u64,
    /// Threads that render [default: one for each core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub(super) threads: Option<u16>,
    /// Measure this part of the light alone, which is all that the true picture shows
    #[arg(long, value_name = "PART")]
    pub(super) only: Option<Part>,
    /// Write the table to this file
    #[arg(long, value_name = "OUT.csv")]
    pub(super) csv: Option<PathBuf>,
    /// Draw the errors over time, both on logarithmic axes
    #[arg(long, value_name = "OUT.png")]
    pub(super) plot: Option<PathBuf>,
    /// Measure all the scenes that this file lists, instead of SCENE: for each a [[run]] with name, scene, seconds and
    /// perhaps seeds, only, mask, others (a relMSE to compare with), and reference, perhaps with second_reference, or
    /// reference_seconds
    #[arg(long, value_name = "FILE.toml", conflicts_with_all = ["scene", "reference", "second_reference", "mask", "seconds", "seeds", "only", "csv", "plot"])]
    pub(super) suite: Option<PathBuf>,
    /// Where the tables and plots of a suite go: FILE.md, and files that are called like the runs
    #[arg(short, long, value_name = "FOLDER")]
    pub(super) output: Option<PathBuf>,
}

#[derive(Debug, Args)]
pub(super) struct CheckArguments {
    /// A scene file or the name of a built-in scene
    pub(super) scene: PathBuf,
}

#[derive(Debug, Args)]
pub(super) struct IntersectArguments {
    /// For each patch a line `patch NAME` and 16 lines `x y z`, four along v for each step along u
    pub(super) patches: PathBuf,
    /// A table with a header and the columns ox, oy, oz, dx, dy, dz and perhaps tmin: hits at t <= tmin do not count
    #[arg(value_name = "RAYS.csv")]
    pub(super) rays: PathBuf,
    /// Take this patch alone; without it every line names the patch that was hit, from 0, where there are several
    #[arg(long, value_name = "NAME")]
    pub(super) patch: Option<String>,
}

#[derive(Debug, Args)]
pub(super) struct ExportArguments {
    /// A scene file or the name of a built-in scene
    pub(super) scene: PathBuf,
    /// .obj: quads with normals and (u, v), welded where patches meet; .bpt: the control points
    #[arg(short, long, value_name = "OUT.(obj|bpt)")]
    pub(super) output: PathBuf,
    /// Take this object alone [default: all objects of Bezier patches]
    #[arg(long, value_name = "NAME")]
    pub(super) object: Option<String>,
    /// Quads along each side of a patch, in an .obj
    #[arg(long, value_name = "N", default_value_t = SurfaceExport::STEPS, value_parser = parse_steps)]
    pub(super) steps: NonZeroUsize,
}

fn parse_steps(text: &str) -> Result<NonZeroUsize, String> {
    let steps = text.parse().ok().filter(|steps: &NonZeroUsize| steps.get() <= 1024);
    steps.ok_or_else(|| "expected a number from 1 to 1024".to_owned())
}

fn parse_size(text: &str) -> Result<(u32, u32), String> {
    let side = |s: &str| s.parse().ok().filter(|pixels| (1..=16384).contains(pixels));
    let size = text.split_once(['x', 'X']).and_then(|(width, height)| Some((side(width)?, side(height)?)));
    size.ok_or_else(|| "expected two numbers from 1 to 16384 like 640x480".to_owned())
}

fn parse_positive(text: &str) -> Result<f64, String> {
    let number = text.parse().ok().filter(|x: &f64| x.is_finite() && *x > 0.0);
    number.ok_or_else(|| "expected a number above 0".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn the_command_line_is_consistent() {
        Arguments::command().debug_assert();
    }

    #[test]
    fn sizes_are_two_numbers() {
        assert_eq!(parse_size("640x480"), Ok((640, 480)));
        for wrong in ["640", "640x", "0x480", "640x480x2", "20000x10", "-1x5"] {
            assert!(parse_size(wrong).is_err(), "{wrong}");
        }
    }
}
