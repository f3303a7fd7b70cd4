//! Command-line arguments. The help of every command contains an example.

use std::path::PathBuf;

use aim_character::Settle;
use aim_runtime::{Behind, Solver};
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser, UnknownArgumentValueParser};
use clap::{Args, Parser, Subcommand, ValueEnum};

use crate::facing::Facing;
use crate::plot::Size;
use crate::reduction::{Millimetres, seconds};
use crate::target::{Point, TargetSpec};

/// Turns a character's eyes, neck and spine towards a target, with derivatives generated for exactly your rig.
#[derive(Debug, Parser)]
#[command(name = "aim", version, arg_required_else_help = true)]
#[command(after_help = "Example:\n  aim demo\n\nExit codes: 0 done, 1 a check failed, 2 unusable input.")]
pub(crate) struct Arguments {
    #[command(subcommand)]
    pub(crate) command: Command,
}

const BAKE_HELP: &str = include_str!("help/bake.txt").trim_ascii_end();
const CHECK_HELP: &str = include_str!("help/check.txt").trim_ascii_end();
const CLIP_HELP: &str = include_str!("help/clip.txt").trim_ascii_end();
const EXPLAIN_HELP: &str = include_str!("help/explain.txt").trim_ascii_end();
const PLOT_HELP: &str = include_str!("help/plot.txt").trim_ascii_end();
const REACH_HELP: &str = include_str!("help/reach.txt").trim_ascii_end();
const RIG_HELP: &str = include_str!("help/rig.txt").trim_ascii_end();
const VIEW_HELP: &str = include_str!("help/view.txt").trim_ascii_end();

/// Returns the examples of a text that follows a command's options: its first paragraph, for the short help.
fn example(help: &'static str) -> &'static str {
    help.split_once("\n\n").map_or(help, |(example, _)| example)
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Aim the bundled mannequin at an orbiting target while it walks and runs; write aimed.glb, report.html,
    /// report.json and mannequin.glb.
    #[command(after_help = "Example:\n  aim demo --out aim-demo")]
    Demo(Demo),
    /// Show a model's bones with their measured axes and roles, and its clips.
    #[command(after_help = "Example:\n  aim inspect hero.glb --json")]
    Inspect(Inspect),
    /// Propose a model's declaration: its chain, measured axes, human ranges and rates.
    #[command(after_help = example(RIG_HELP), after_long_help = RIG_HELP)]
    Rig(Rig),
    /// Write the solver derived for a rig.
    #[command(after_help = "Example:\n  aim generate rigs/thug.toml --lang c -o thug.c")]
    Generate(Generate),
    /// Count the operations in the code generated for a rig.
    #[command(after_help = "Example:\n  aim count rigs/thug.toml --json")]
    Count(Count),
    /// Compare a rig's derived gradient and Jacobian with central differences, or a rig with a model.
    #[command(after_help = example(CHECK_HELP), after_long_help = CHECK_HELP)]
    Check(Check),
    /// Explain a rig's derivation step by step, as a web page or as LaTeX.
    #[command(after_help = example(EXPLAIN_HELP), after_long_help = EXPLAIN_HELP)]
    Explain(Explain),
    /// Plot a joint's aim function over heading and pitch, with the paths of the solvers.
    #[command(after_help = example(PLOT_HELP), after_long_help = PLOT_HELP)]
    Plot(Plot),
    /// Aim a model over a clip and write an ordinary glTF animation.
    #[command(after_help = example(BAKE_HELP), after_long_help = BAKE_HELP)]
    Bake(Bake),
    /// Open a window with a character that looks at a target: the bundled mannequin or a model.
    #[command(after_help = example(VIEW_HELP), after_long_help = VIEW_HELP)]
    View(View),
    /// Guide a hand or foot of a clip through points at given times, and write an ordinary glTF animation.
    #[command(after_help = example(REACH_HELP), after_long_help = REACH_HELP)]
    Reach(Reach),
    /// Report the size of a model's clips, and make them smaller, loops, or in place.
    #[command(after_help = example(CLIP_HELP), after_long_help = CLIP_HELP)]
    Clip(Clip),
}

#[derive(Debug, Args)]
pub(crate) struct Demo {
    #[command(flatten)]
    pub(crate) aiming: Aiming,
    /// The folder to write to; created if it does not exist.
    #[arg(long, value_name = "DIR", default_value = "aim-demo")]
    pub(crate) out: PathBuf,
}

#[derive(Debug, Args)]
pub(crate) struct Inspect {
    /// A .glb, .gltf or .vrm file.
    pub(crate) file: PathBuf,
    /// Print JSON.
    #[arg(long)]
    pub(crate) json: bool,
    /// Also write a page with drawings of the character and its rig's axes.
    #[arg(long, value_name = "OUT.html")]
    pub(crate) html: Option<PathBuf>,
    /// The declaration whose axes are drawn; the proposed one if not given.
    #[arg(long, value_name = "RIG.toml", requires = "html")]
    pub(crate) rig: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) facing: Facing,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Notation {
    /// A rig file.
    Toml,
    /// A struct with a derive.
    Rust,
    /// A struct with a derive, and the character to spawn in an app that uses `bevy_aim`.
    Bevy,
}

#[derive(Debug, Args)]
pub(crate) struct Rig {
    /// A .glb, .gltf or .vrm file.
    pub(crate) file: PathBuf,
    /// The chain's bones, from the effector inward; found if not given.
    ///
    /// They are found by roles and names.
    #[arg(long, value_name = "A,B,C", value_delimiter = ',', value_parser = bone_name)]
    pub(crate) chain: Vec<String>,
    #[command(flatten)]
    pub(crate) facing: Facing,
    /// The output format.
    #[arg(long, value_enum, default_value_t = Notation::Toml)]
    pub(crate) format: Notation,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Language {
    Rust,
    C,
    Wgsl,
    Latex,
    Maxima,
}

#[derive(Debug, Args)]
pub(crate) struct Generate {
    /// The rig's declaration, or a Rust file.
    pub(crate) rig: PathBuf,
    /// A function of a Rust file to emit, with its derivatives.
    ///
    /// It has the attribute `#[differentiate(wrt(…))]` and is emitted in C or WGSL.
    #[arg(long, value_name = "NAME")]
    pub(crate) function: Option<String>,
    /// The language to emit.
    ///
    /// A function is emitted in C and WGSL only: in Rust, the attribute writes its derivatives.
    #[arg(long, value_enum, required_unless_present = "trace")]
    pub(crate) lang: Option<Language>,
    /// Instead of code, list the rewriting rules with operation counts.
    ///
    /// The counts are those after each step. The points where derivatives have no limit follow.
    #[arg(long, conflicts_with_all = ["lang", "check"])]
    pub(crate) trace: bool,
    /// The output file; standard output if not given.
    #[arg(short, long, value_name = "FILE", conflicts_with = "check")]
    pub(crate) output: Option<PathBuf>,
    /// Write nothing; exit with code 1 if FILE is not what would be emitted.
    #[arg(long, value_name = "FILE")]
    pub(crate) check: Option<PathBuf>,
}

#[derive(Debug, Args)]
pub(crate) struct Count {
    /// The rig's declaration.
    pub(crate) rig: PathBuf,
    /// Print JSON.
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Debug, Args)]
pub(crate) struct Check {
    /// The rig's declaration, or, with --rig, a model.
    #[arg(value_name = "RIG.toml|FILE")]
    pub(crate) rig: PathBuf,
    /// Report where this declaration and the model FILE contradict each other.
    ///
    /// Derivatives are then not checked.
    #[arg(long = "rig", value_name = "RIG.toml", conflicts_with_all = ["samples", "flip_sign"])]
    pub(crate) model_rig: Option<PathBuf>,
    /// Number of random poses to compare.
    #[arg(long, value_name = "N", default_value_t = 10_000, value_parser = clap::value_parser!(u32).range(1..))]
    pub(crate) samples: u32,
    /// First break every program, to see the check fail.
    ///
    /// The N-th addition of every program becomes a subtraction, or vice versa.
    #[arg(long, value_name = "N")]
    pub(crate) flip_sign: Option<usize>,
}

#[derive(Debug, Args)]
pub(crate) struct Plot {
    /// The rig's declaration.
    pub(crate) rig: PathBuf,
    /// The joint that turns; the first if not given.
    ///
    /// The first joint carries the effector.
    #[arg(long, value_name = "NAME")]
    pub(crate) joint: Option<String>,
    /// The target, in the joint's space.
    ///
    /// Its coordinates are along the bone's axes. If not given, it is a point that needs every angle of the joint.
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true)]
    pub(crate) target: Option<Point>,
    /// Draw a surface in space instead of contours.
    #[arg(long)]
    pub(crate) surface: bool,
    /// Width and height in pixels.
    #[arg(long, value_name = "WxH", default_value = "1000x720")]
    pub(crate) size: Size,
    /// The output file, SVG or PNG by its extension.
    ///
    /// PNG needs a build with the feature `pictures`.
    #[arg(short, long, value_name = "OUT.svg|OUT.png")]
    pub(crate) output: PathBuf,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Paper {
    /// A self-contained HTML page.
    Html,
    /// A document for a LaTeX compiler.
    Latex,
}

#[derive(Debug, Args)]
pub(crate) struct Explain {
    /// The rig's declaration.
    pub(crate) rig: PathBuf,
    /// The output file; standard output if not given.
    #[arg(short, long, value_name = "OUT.html|OUT.tex")]
    pub(crate) output: Option<PathBuf>,
    /// The format; else by extension.
    #[arg(long, value_enum)]
    pub(crate) format: Option<Paper>,
    /// Number of random poses to compare.
    ///
    /// Derivatives are compared with central differences.
    #[arg(long, value_name = "N", default_value_t = 1_000, value_parser = clap::value_parser!(u32).range(1..))]
    pub(crate) samples: u32,
}

/// Values of a type without a parser, each with its word on the command line and its help text.
type Choices<T> = [(T, &'static str, &'static str)];

/// Values of `--solver`: each solver, and all of them side by side. Reports use the same words.
pub(crate) const SOLVERS: &Choices<&[Solver]> = &[
    (&[Solver::Natural], "natural", "Eyes jump to the target, head and spine follow smoothly, and the eyes return"),
    (&[Solver::Exact], "exact", "All joints at once, with the least displacement that meets the target"),
    (&[Solver::Ascent], "ascent", "The paper's steepest ascent, joint by joint from the eye inward"),
    (&[Solver::Natural, Solver::Exact, Solver::Ascent], "all", "All three, side by side"),
];

/// Values of `--behind`.
const BEHINDS: &Choices<Behind> = &[
    (Behind::Clip, "clip", "Turn to the edge of the reachable directions, on the target's side"),
    (Behind::Plane, "plane", "Move the target forward until it is at most 80° to the side"),
    (Behind::Off, "off", "Get as close as the joints can, on their current side"),
    (Behind::Hold, "hold", "Keep the current angles"),
    (Behind::Release, "release", "Return to the animation"),
];

/// Values of `--settle`.
const SETTLES: &Choices<Settle> = &[
    (Settle::Snap, "snap", "On the target from the first frame"),
    (Settle::Animation, "animation", "From the animation"),
];

/// Parses a number from 0 to 1.
fn share(text: &str) -> Result<f32, String> {
    let number = text.parse().ok().filter(|share| (0.0..=1.0).contains(share));
    number.ok_or_else(|| "expected a number from 0 to 1, such as 0.5".into())
}

/// Parses one name of a comma-separated list, without the blanks around it.
fn bone_name(text: &str) -> Result<String, String> {
    match text.trim() {
        "" => Err("a name is empty; separate names with commas, as in a,b or \"a, b\"".into()),
        name => Ok(name.to_owned()),
    }
}

/// Parses a number of seconds, at least 0.
fn patience(text: &str) -> Result<f32, String> {
    let number = text.parse().ok().filter(|seconds: &f32| *seconds >= 0.0);
    number.ok_or_else(|| "expected a number of seconds, 0 or more, such as 2".into())
}

/// Parses a length in seconds, more than 0.
fn length(text: &str) -> Result<f32, String> {
    positive(text).ok_or_else(|| "expected a number of seconds above 0, such as 8".into())
}

/// Parses a number of keys per second, more than 0.
fn rate(text: &str) -> Result<f32, String> {
    positive(text).ok_or_else(|| "expected a number of keys per second above 0, such as 60".into())
}

fn positive(text: &str) -> Option<f32> {
    text.parse().ok().filter(|number: &f32| *number > 0.0 && number.is_finite())
}

/// Parses one of the words in `all` to its value.
fn one_of<T: Copy + Send + Sync>(all: &'static Choices<T>) -> impl TypedValueParser<Value = T> {
    let words = all.iter().map(|(_, word, help)| PossibleValue::new(*word).help(*help));
    // `PossibleValuesParser` accepts only these words, so the fallback is never used.
    let value = |word: String| all.iter().find(|(_, known, _)| *known == word).unwrap_or(&all[0]).0;
    PossibleValuesParser::new(words).map(value)
}

/// Options of the commands that aim.
#[derive(Clone, Copy, Debug, Args)]
pub(crate) struct Aiming {
    /// The solver; else by the rig.
    ///
    /// Without this option, it is natural if any joint of the rig has a role, else exact.
    #[arg(long, value_parser = one_of(&SOLVERS[..3]))]
    pub(crate) solver: Option<&'static [Solver]>,
    /// Aim the other eye, too, so that both converge on the target.
    ///
    /// Without this option, it turns as the first one does.
    #[arg(long)]
    pub(crate) both_eyes: bool,
}

/// Output files of a command that changes a model.
#[derive(Debug, Args)]
pub(crate) struct Written {
    /// Where to write the model; may be FILE, which it then replaces.
    #[arg(long, value_name = "OUT.glb")]
    pub(crate) out: PathBuf,
    /// Where to write the result of every frame, as JSON.
    #[arg(long, value_name = "R.json")]
    pub(crate) report: Option<PathBuf>,
    /// Where to write the report as a page, with drawings and charts.
    #[arg(long, value_name = "R.html")]
    pub(crate) html: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) no_json: NoJson,
}

/// Hidden option `--json` of the commands whose JSON output is their report.
#[derive(Debug, Default, Args)]
pub(crate) struct NoJson {
    /// Always rejected, with an error that suggests `--report`.
    #[arg(long = "json", hide = true, num_args = 0, default_missing_value = "")]
    #[arg(value_parser = UnknownArgumentValueParser::suggest_arg("--report"))]
    no_json: Option<String>,
}

#[derive(Debug, Args)]
pub(crate) struct Bake {
    /// A .glb, .gltf or .vrm file.
    pub(crate) file: PathBuf,
    #[arg(long, value_name = "SPEC", allow_hyphen_values = true)]
    #[arg(help = "What to look at: x,y,z · orbit:R,H,S · node:NAME · file:PATH.csv")]
    pub(crate) target: TargetSpec,
    /// The rig's declaration; measured from the file if not given.
    #[arg(long, value_name = "RIG.toml")]
    pub(crate) rig: Option<PathBuf>,
    /// The clip to aim over; an idle clip or the first if not given.
    ///
    /// An idle clip is the first whose name contains idle.
    #[arg(long, value_name = "NAME")]
    pub(crate) clip: Option<String>,
    /// Name of the written clip; the clip's with "_aimed" if not given.
    ///
    /// The written clip replaces a clip of this name. Without this option, no clip is replaced: the name ends in
    /// "_aimed2" and so on if "_aimed" is taken.
    #[arg(long = "as", value_name = "NAME", value_parser = clap::builder::NonEmptyStringValueParser::new())]
    pub(crate) name: Option<String>,
    #[command(flatten)]
    pub(crate) facing: Facing,
    #[command(flatten)]
    pub(crate) aiming: Aiming,
    /// What to aim: eyes, head, neck, chest, or a bone of the rig's joints.
    ///
    /// Joints further out return to rest. Without this option, the rig's effector is aimed.
    #[arg(long, value_name = "WHAT", value_parser = clap::builder::NonEmptyStringValueParser::new())]
    pub(crate) effector: Option<String>,
    /// How far the gaze moves from the clip's to the target, 0 to 1.
    #[arg(long, value_name = "W", default_value_t = 1.0, value_parser = share, allow_negative_numbers = true)]
    pub(crate) weight: f32,
    /// How far the head takes over from the eyes, 0 to 1.
    ///
    /// Only the natural solver uses it.
    #[arg(long, value_name = "A", default_value_t = 0.0, value_parser = share, allow_negative_numbers = true)]
    pub(crate) attention: f32,
    /// For a target behind.
    ///
    /// What to do about a target behind the character; clip if not given.
    #[arg(long, value_name = "POLICY", value_parser = one_of(BEHINDS), default_value = "clip", hide_default_value = true)]
    pub(crate) behind: Behind,
    /// Seconds after which a target out of reach is given up.
    ///
    /// The gaze then returns to the animation. Without this option, it never does. Only the natural solver uses it.
    #[arg(long, value_name = "S", value_parser = patience)]
    pub(crate) patience: Option<f32>,
    /// Length of the result, seconds; the clip's length if not given.
    ///
    /// A shorter clip repeats.
    #[arg(long, value_name = "S", allow_negative_numbers = true, value_parser = length)]
    pub(crate) seconds: Option<f32>,
    /// Keys per second.
    #[arg(long, value_name = "N", default_value_t = 60.0, allow_negative_numbers = true, value_parser = rate)]
    pub(crate) fps: f32,
    /// Bones that hang on a joint but stay with the trunk.
    ///
    /// They move with what carries the joint. They replace those that the rig holds; `none` holds nothing.
    #[arg(long, value_name = "A,B|none", value_delimiter = ',', value_parser = bone_name)]
    pub(crate) hold: Option<Vec<String>>,
    /// How the result begins.
    #[arg(long, value_parser = one_of(SETTLES), default_value = "snap")]
    pub(crate) settle: Settle,
    /// Make the result loop.
    ///
    /// Where the clip itself jumps from its last frame to its first, in position or speed, its seam is mended.
    #[arg(long = "loop")]
    pub(crate) looped: bool,
    /// Leave out keys within a tolerance, such as 1mm of a 1.7 m figure.
    ///
    /// No bone, and no point looked at 1 m away, moves by more than the tolerance. 0mm leaves out only keys that change
    /// nothing. The error of the clip as written is reported: see Reduction below.
    #[arg(long, value_name = "TOL", allow_hyphen_values = true)]
    pub(crate) reduce: Option<Millimetres>,
    /// Exit with code 1 if the result looks wrong.
    ///
    /// The result is written nevertheless. See Plausibility below. It is also wrong if no frame has a direction to aim
    /// in, or none is on a target node that moves with the gaze.
    #[arg(long)]
    pub(crate) strict: bool,
    #[command(flatten)]
    pub(crate) written: Written,
}

#[derive(Debug, Args)]
pub(crate) struct Reach {
    /// A .glb, .gltf or .vrm file.
    pub(crate) file: PathBuf,
    /// The clip; an idle clip or the first if not given.
    ///
    /// An idle clip is the first whose name contains idle.
    #[arg(long, value_name = "NAME")]
    pub(crate) clip: Option<String>,
    /// The node to guide: a hand or a foot.
    ///
    /// Its parent and grandparent follow.
    #[arg(long, value_name = "NAME")]
    pub(crate) bone: String,
    /// Time of a target, seconds; once for each target.
    ///
    /// The node is to be at the target at this time.
    #[arg(long, value_name = "S", required = true, allow_negative_numbers = true)]
    pub(crate) at: Vec<f32>,
    /// Target of the node, in the file's units; once for each time.
    #[arg(long, value_name = "X,Y,Z", required = true, allow_hyphen_values = true)]
    pub(crate) target: Vec<Point>,
    /// Keys per second.
    #[arg(long, value_name = "N", default_value_t = 60.0, allow_negative_numbers = true, value_parser = rate)]
    pub(crate) fps: f32,
    #[command(flatten)]
    pub(crate) written: Written,
}

/// Kinds of root motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Extract {
    /// Along a straight line at constant speed, turning evenly.
    Linear,
    /// Along an arc at constant speed: a screw.
    Composite,
    /// Frame by frame: all of the motion, so that the hips stay above one place.
    Delta,
}

#[derive(Debug, Args)]
pub(crate) struct Clip {
    /// A .glb, .gltf or .vrm file.
    pub(crate) file: PathBuf,
    /// The clip; repeat the option for several clips. All of them if not given.
    #[arg(long, value_name = "NAME")]
    pub(crate) clip: Vec<String>,
    /// Take the hips' motion out.
    ///
    /// Their motion over the ground is taken out of the clip and reported.
    #[arg(long, value_enum, value_name = "MOTION")]
    pub(crate) extract: Option<Extract>,
    /// Make the clip loop.
    ///
    /// Where it jumps from its last frame to its first, in position or speed, its seam is mended.
    #[arg(long = "loop")]
    pub(crate) looped: bool,
    /// Leave out keys within a tolerance, such as 1mm of a 1.7 m figure.
    ///
    /// No bone moves by more than the tolerance. 0mm leaves out only keys that change nothing.
    #[arg(long, value_name = "TOL", allow_hyphen_values = true)]
    pub(crate) reduce: Option<Millimetres>,
    /// Times at which a reduced clip keeps the original poses, seconds.
    ///
    /// Such times are contacts, transitions, approved poses.
    #[arg(long, value_name = "S,S", value_delimiter = ',', requires = "reduce", allow_negative_numbers = true, value_parser = seconds)]
    pub(crate) pin: Vec<f32>,
    #[command(flatten)]
    pub(crate) facing: Facing,
    /// Where to write the changed model; may be FILE, which it then replaces.
    ///
    /// The changed clips are in place of the old ones.
    #[arg(long, value_name = "OUT.glb")]
    pub(crate) out: Option<PathBuf>,
    /// Where to write the report, with the root motion, as JSON.
    #[arg(long, value_name = "R.json")]
    pub(crate) report: Option<PathBuf>,
    /// Where to write the report as a page, with charts.
    #[arg(long, value_name = "R.html")]
    pub(crate) html: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) no_json: NoJson,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Show {
    /// The bones' reference frames.
    Axes,
    /// Gaze rays.
    Gaze,
    /// Limit cones.
    Limits,
    /// The bones' boxes.
    Boxes,
    /// A lamp in the right hand.
    Lamp,
    /// A sloped floor, and feet planted on it.
    Slope,
    /// Past positions of the target.
    Trail,
    /// Error and angles over time.
    Plots,
    /// Time spent on solving.
    Timing,
    /// The panel.
    Panel,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum TargetPath {
    Still,
    Orbit,
    Eight,
    Noise,
}

#[derive(Debug, Args)]
pub(crate) struct View {
    /// A .glb, .gltf or .vrm file; the mannequin if not given.
    pub(crate) file: Option<PathBuf>,
    /// The rig's declaration; measured from the file if not given.
    #[arg(long, value_name = "RIG.toml", requires = "file")]
    pub(crate) rig: Option<PathBuf>,
    /// The clip to play; an idle clip or the first if not given.
    ///
    /// An idle clip is the first whose name contains idle.
    #[arg(long, value_name = "NAME")]
    pub(crate) clip: Option<String>,
    /// The solver, or all.
    ///
    /// All of them are shown side by side. Without this option, it is natural if any joint of the rig has a role, else
    /// exact.
    #[arg(long, value_parser = one_of(SOLVERS))]
    pub(crate) solver: Option<&'static [Solver]>,
    /// How the target moves.
    #[arg(long, value_enum, default_value_t = TargetPath::Still)]
    pub(crate) path: TargetPath,
    /// Number of characters.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u16).range(1..=1000))]
    pub(crate) crowd: u16,
    /// What to show initially.
    #[arg(long, value_enum, value_delimiter = ',', value_name = "LIST")]
    #[arg(default_values_t = [Show::Gaze, Show::Trail, Show::Plots, Show::Timing, Show::Panel])]
    pub(crate) show: Vec<Show>,
    /// Use a light background.
    #[arg(long)]
    pub(crate) light: bool,
    /// Take a picture of the window instead of staying open.
    ///
    /// No display is needed where xvfb-run is installed.
    #[arg(long, value_name = "OUT.png")]
    pub(crate) screenshot: Option<PathBuf>,
    /// Frames of 1/60 s before the picture.
    #[arg(long, value_name = "N", requires = "screenshot", default_value_t = 60, value_parser = clap::value_parser!(u32).range(1..))]
    pub(crate) frames: u32,
    /// Size of the picture, pixels.
    #[arg(long, value_name = "WxH", requires = "screenshot", default_value = "1280x800")]
    pub(crate) size: Size,
    /// Print what the picture shows as JSON.
    ///
    /// That is status, error, and the positions of targets and gazes, pixels.
    #[arg(long, requires = "screenshot")]
    pub(crate) json: bool,
}
