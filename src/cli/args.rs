//! The command line, and the texts of `--help`.

use crate::{engine::MOST_ITERATIONS, film::PngDepth, scene::SurfaceOptions, transport::Component};
use clap::{Args, Parser, Subcommand, ValueEnum};
use serde::Deserialize;
use std::{num::NonZeroUsize, path::PathBuf};

/// Progressive photon mapping of Bezier patches.
///
/// Without a command, patchlight opens a window. SCENE is a scene file or the name of a built-in scene: report,
/// report-flipped, water, cardioid, lens, teapot, cornell.
#[derive(Debug, Parser)]
#[command(version, args_conflicts_with_subcommands = true)]
pub struct Arguments {
    /// The scene of the window [default: report]
    pub(super) scene: Option<PathBuf>,
    #[command(subcommand)]
    pub(super) command: Option<Command>,
}

impl Arguments {
    /// Whether the command line asks for a window.
    pub fn opens_window(&self) -> bool {
        self.command.is_none()
    }
}

#[derive(Debug, Subcommand)]
pub(super) enum Command {
    /// Render a picture without a window
    Render(RenderArguments),
    /// Merge checkpoints of consecutive iterations of one run, as if one run had rendered them all
    Merge(MergeArguments),
    /// Measure the error against a reference picture over time
    Bench(BenchArguments),
    /// Validate a scene; print its plan: rendered and skipped work, with reasons
    Check(CheckArguments),
    /// Print the nearest hit of every ray on Bezier patches: `1,t,u,v` or `0,,,`
    Intersect(IntersectArguments),
    /// Write the Bezier patches of a scene as a mesh (.obj, .stl), control points (.bpt) or surfaces (.step)
    Export(ExportArguments),
    /// Print the difference of two pictures: RMSE, relMSE, brightness
    Compare(CompareArguments),
}

/// The settings of rendering.
#[derive(Debug, Args)]
pub(super) struct RenderSettings {
    /// Size of the picture in pixels [default: the size in the scene]
    #[arg(long, value_name = "WxH", value_parser = parse_size)]
    pub(super) size: Option<(u32, u32)>,
    /// Number of rendering threads [default: one per core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub(super) threads: Option<u16>,
    /// Seed of the random numbers; another seed gives other noise
    #[arg(long, value_name = "K", default_value_t = 0)]
    pub(super) seed: u64,
    /// Render only this component of the light; the three components add up to the picture
    #[arg(long, value_name = "COMPONENT")]
    pub(super) only: Option<ComponentName>,
}

/// A component of the light on the command line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum ComponentName {
    /// Visible lights, direct illumination, and most of its glossy reflections
    Direct,
    /// Light that mirrors and glass focus on surfaces
    Caustics,
    /// Light that surfaces reflect onto each other
    Interreflection,
}

impl From<ComponentName> for Component {
    fn from(name: ComponentName) -> Self {
        match name {
            ComponentName::Direct => Self::Direct,
            ComponentName::Caustics => Self::Caustics,
            ComponentName::Interreflection => Self::Interreflection,
        }
    }
}

/// The bits of each channel of a PNG picture on the command line.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(super) enum PngBits {
    /// For screens
    #[default]
    #[value(name = "8")]
    Eight,
    /// For further editing
    #[value(name = "16")]
    Sixteen,
}

impl From<PngBits> for PngDepth {
    fn from(bits: PngBits) -> Self {
        match bits {
            PngBits::Eight => Self::Eight,
            PngBits::Sixteen => Self::Sixteen,
        }
    }
}

#[derive(Debug, Args)]
pub(super) struct RenderArguments {
    /// A scene file or the name of a built-in scene
    pub(super) scene: PathBuf,
    /// The picture file: .png with exposure and tone curve, or .exr with linear 32-bit floats
    #[arg(short, long, value_name = "OUT.(png|exr)", required_unless_present = "checkpoint")]
    pub(super) output: Option<PathBuf>,
    /// Bits of each channel of a PNG picture
    #[arg(long, value_name = "BITS", value_enum, default_value_t)]
    pub(super) png_bits: PngBits,
    #[command(flatten)]
    pub(super) budget: Budget,
    #[command(flatten)]
    pub(super) settings: RenderSettings,
    #[command(flatten)]
    pub(super) checkpoints: CheckpointArguments,
    /// Write statistics of the rendering to this JSON file
    #[arg(long, value_name = "FILE.json")]
    pub(super) stats: Option<PathBuf>,
}

/// The files by which renderings go on later or elsewhere.
#[derive(Debug, Args)]
pub(super) struct CheckpointArguments {
    /// Write the film and all that the rendering needs to go on to this file: at the end, after Ctrl+C or `kill`, and
    /// every minute
    #[arg(long, value_name = "FILE")]
    pub(super) checkpoint: Option<PathBuf>,
    /// Write the checkpoint every S seconds
    #[arg(long, value_name = "S", default_value_t = 60.0, requires = "checkpoint", value_parser = parse_positive, allow_negative_numbers = true)]
    pub(super) checkpoint_seconds: f64,
    /// Go on from this checkpoint: the film will be that of a rendering without a break, bit for bit. --seconds and
    /// --iterations count from the beginning of the film
    #[arg(long, value_name = "FILE")]
    pub(super) resume: Option<PathBuf>,
    /// Render with the plan (radii, samples) that this checkpoint's iterations measured, and measure no other. Without
    /// it, --iterations A..B first renders the iterations before A, too, only for their measurements
    #[arg(long, value_name = "FILE")]
    pub(super) plan: Option<PathBuf>,
}

#[derive(Debug, Args)]
pub(super) struct MergeArguments {
    /// Checkpoints of one run, in any order
    #[arg(required = true, value_name = "FILM")]
    pub(super) films: Vec<PathBuf>,
    /// The picture file: .png with exposure and tone curve, or .exr with linear 32-bit floats
    #[arg(short, long, value_name = "OUT.(png|exr)", required_unless_present = "checkpoint")]
    pub(super) output: Option<PathBuf>,
    /// Bits of each channel of a PNG picture
    #[arg(long, value_name = "BITS", value_enum, default_value_t)]
    pub(super) png_bits: PngBits,
    /// Write the merged film to this checkpoint
    #[arg(long, value_name = "FILE")]
    pub(super) checkpoint: Option<PathBuf>,
    /// Write the statistics of all films together to this JSON file
    #[arg(long, value_name = "FILE.json")]
    pub(super) stats: Option<PathBuf>,
}

/// The end of rendering: a time, a number of iterations, or an error; by default a time.
#[derive(Clone, Copy, Debug, Args)]
#[group(multiple = false)]
pub(super) struct Budget {
    /// Render for S seconds, from the first iteration on [default: 10]
    #[arg(long, value_name = "S", value_parser = parse_positive, allow_negative_numbers = true)]
    pub(super) seconds: Option<f64>,
    /// Render N iterations, or only iterations A to B of a run, which `patchlight merge` adds to the others
    #[arg(long, value_name = "N|A..B", value_parser = parse_iterations)]
    pub(super) iterations: Option<Iterations>,
    /// Render until the estimated RMSE, relative to the mean radiance, is below E: 0.02 is 2 %. The estimate is rough
    /// for small pictures
    #[arg(long, value_name = "E", value_parser = parse_positive, allow_negative_numbers = true)]
    pub(super) error: Option<f64>,
}

/// Iterations of a run, by the numbers of the first and the last one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Iterations {
    pub(super) first: u64,
    pub(super) last: u64,
}

impl Budget {
    /// The seconds of rendering without a budget on the command line.
    pub(super) const DEFAULT_SECONDS: f64 = 10.0;
}

#[derive(Debug, Args)]
pub(super) struct BenchArguments {
    /// A scene file or the name of a built-in scene
    pub(super) scene: Option<PathBuf>,
    /// The reference picture
    #[arg(long, value_name = "REF.exr")]
    pub(super) reference: Option<PathBuf>,
    /// A second reference picture with independent noise: errors then exclude the noise of the references. Outside the
    /// mask, errors are against this reference alone
    #[arg(long, value_name = "REF.exr", requires = "reference")]
    pub(super) second_reference: Option<PathBuf>,
    /// Measure inside the mask, the bright pixels of this file, and separately outside
    #[arg(long, value_name = "MASK.png")]
    pub(super) mask: Option<PathBuf>,
    /// Measure after each of these times, in seconds
    #[arg(long, value_name = "S,S,..", value_delimiter = ',', default_value = "1,2,4,8,16", value_parser = parse_positive, allow_negative_numbers = true)]
    pub(super) seconds: Vec<f64>,
    /// Repeat the measurement with K seeds
    #[arg(long, value_name = "K", default_value_t = 1, value_parser = clap::value_parser!(u64).range(1..))]
    pub(super) seeds: u64,
    /// Number of rendering threads [default: one per core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub(super) threads: Option<u16>,
    /// Measure only this component of the light, which the reference picture must show alone
    #[arg(long, value_name = "COMPONENT")]
    pub(super) only: Option<ComponentName>,
    /// Write the measurements to this CSV file
    #[arg(long, value_name = "OUT.csv")]
    pub(super) csv: Option<PathBuf>,
    /// Plot the errors over time, on logarithmic axes
    #[arg(long, value_name = "OUT.png")]
    pub(super) plot: Option<PathBuf>,
    /// Measure all runs of this file instead of SCENE: each run has name, scene and seconds; optionally seeds, only, mask,
    /// others (the relMSE of another program); and either reference, optionally with second_reference, or
    /// reference_seconds
    #[arg(long, value_name = "FILE.toml", conflicts_with_all = ["scene", "reference", "second_reference", "mask", "seconds", "seeds", "only", "csv", "plot"])]
    pub(super) suite: Option<PathBuf>,
    /// The folder for the results of a suite: the table FILE.md, and a table and a plot for each run
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
    /// The patches: for each patch a line `patch NAME` and 16 lines `x y z`, in rows of four along v
    pub(super) patches: PathBuf,
    /// The rays: a table with a header and the columns ox, oy, oz, dx, dy, dz and optionally tmin; hits have t > tmin
    #[arg(value_name = "RAYS.csv")]
    pub(super) rays: PathBuf,
    /// Intersect only this patch [default: all patches; each hit then has the index of its patch, from 0]
    #[arg(long, value_name = "NAME")]
    pub(super) patch: Option<String>,
}

#[derive(Debug, Args)]
pub(super) struct ExportArguments {
    /// A scene file or the name of a built-in scene
    pub(super) scene: PathBuf,
    /// The file: .obj for a mesh of quads with normals and (u, v), welded between patches; .stl for its triangles; .bpt for control points;
    /// .step for exact surfaces
    #[arg(short, long, value_name = "OUT.(obj|stl|bpt|step)")]
    pub(super) output: PathBuf,
    /// Export only this object [default: all objects of Bezier patches]
    #[arg(long, value_name = "NAME")]
    pub(super) object: Option<String>,
    /// Number of quads along each side of a patch in a mesh
    #[arg(long, value_name = "N", default_value_t = SurfaceOptions::default().steps, value_parser = parse_steps)]
    pub(super) steps: NonZeroUsize,
    /// Write Bezier surfaces (cstype bezier) in place of a mesh into an .obj file
    #[arg(long)]
    pub(super) free_form: bool,
}

#[derive(Debug, Args)]
pub(super) struct CompareArguments {
    /// The picture
    #[arg(value_name = "PICTURE.exr")]
    pub(super) picture: PathBuf,
    /// The picture to compare with
    #[arg(value_name = "REF.exr")]
    pub(super) reference: PathBuf,
    /// Compare inside the mask, the bright pixels of this file
    #[arg(long, value_name = "MASK.png")]
    pub(super) mask: Option<PathBuf>,
    /// Write the difference in false colours: blue where the picture is darker, red where it is brighter, in full at 25 %
    #[arg(short, long, value_name = "OUT.png", value_parser = parse_png)]
    pub(super) output: Option<PathBuf>,
}

fn parse_png(text: &str) -> Result<PathBuf, String> {
    let path = PathBuf::from(text);
    let is_png = path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("png"));
    is_png.then_some(path).ok_or_else(|| "expected a name that ends in .png".to_owned())
}

fn parse_iterations(text: &str) -> Result<Iterations, String> {
    let number = |s: &str| s.parse().ok().filter(|n| (1..=MOST_ITERATIONS).contains(n));
    let (first, last) = text.split_once("..").unwrap_or(("1", text));
    let iterations = number(first).zip(number(last)).filter(|(first, last)| first <= last);
    let iterations = iterations.map(|(first, last)| Iterations { first, last });
    iterations.ok_or_else(|| "expected a number above 0 like 200, or two like 101..200".to_owned())
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
    fn iterations_are_a_number_or_a_range() {
        assert_eq!(parse_iterations("200"), Ok(Iterations { first: 1, last: 200 }));
        assert_eq!(parse_iterations("101..200"), Ok(Iterations { first: 101, last: 200 }));
        for wrong in ["0", "0..5", "6..5", "5..", "..5", "1..2..3", "1-5", "99999999999999"] {
            assert!(parse_iterations(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn sizes_are_two_numbers() {
        assert_eq!(parse_size("640x480"), Ok((640, 480)));
        for wrong in ["640", "640x", "0x480", "640x480x2", "20000x10", "-1x5"] {
            assert!(parse_size(wrong).is_err(), "{wrong}");
        }
    }
}
