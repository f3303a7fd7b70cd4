//! The command line. Every command's help ends with an example.

use std::path::PathBuf;

use aim_character::Settle;
use aim_runtime::{Behind, Solver};
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser, UnknownArgumentValueParser};
use clap::{Args, Parser, Subcommand, ValueEnum};

use crate::facing::Facing;
use crate::plot::Size;
use crate::reduction::{Millimetres, seconds};
use crate::target::{Point, TargetSpec};

/// Turns a character's eyes, neck and spine to a target, with derivatives derived for exactly your rig.
#[derive(Debug, Parser)]
#[command(name = "aim", version, arg_required_else_help = true)]
#[command(after_help = "Example:\n  aim demo\n\nExit codes: 0 done, 1 a check failed, 2 unusable input.")]
pub(crate) struct Arguments {
    #[command(subcommand)]
    pub(crate) command: Command,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Have the bundled mannequin walk and run while a target orbits it; write aimed.glb, report.html, report.json and mannequin.glb.
    #[command(after_help = "Example:\n  aim demo --out aim-demo")]
    Demo(Demo),
    /// Show a model's bones with their measured axes and roles, and its clips.
    #[command(after_help = "Example:\n  aim inspect hero.glb --json")]
    Inspect(Inspect),
    /// Propose a model's declaration: its chain, measured axes, human ranges and rates.
    #[command(after_help = include_str!("help/rig.txt").trim_ascii_end())]
    Rig(Rig),
    /// Write the solver derived for a rig.
    #[command(after_help = "Example:\n  aim generate rigs/thug.toml --lang c -o thug.c")]
    Generate(Generate),
    /// Count the operations of what is emitted for a rig.
    #[command(after_help = "Example:\n  aim count rigs/thug.toml --json")]
    Count(Count),
    /// Compare a rig's derived gradient and Jacobian with central differences, or a rig with a model.
    #[command(after_help = include_str!("help/check.txt").trim_ascii_end())]
    Check(Check),
    /// Tell a rig's derivation step by step, as a page or as LaTeX.
    #[command(after_help = include_str!("help/explain.txt").trim_ascii_end())]
    Explain(Explain),
    /// Draw a joint's aim function over heading and pitch, with the solvers' ways over it.
    #[command(after_help = include_str!("help/plot.txt").trim_ascii_end())]
    Plot(Plot),
    /// Aim a model over a clip and write an ordinary glTF animation.
    #[command(after_help = include_str!("help/bake.txt").trim_ascii_end())]
    Bake(Bake),
    /// Open a window with a character that looks at a target: the mannequin, or a model's.
    #[command(after_help = include_str!("help/view.txt").trim_ascii_end())]
    View(View),
    /// Lead a hand or foot of a clip through points at given times, and write an ordinary glTF animation.
    #[command(after_help = include_str!("help/reach.txt").trim_ascii_end())]
    Reach(Reach),
    /// Tell what a model's clips cost, and make them smaller, loops, or in place.
    #[command(after_help = include_str!("help/clip.txt").trim_ascii_end())]
    Clip(Clip),
}

#[derive(Debug, Args)]
pub(crate) struct Demo {
    #[command(flatten)]
    pub(crate) aiming: Aiming,
    /// The folder to write to; made if it is not there.
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
    /// The declaration that is drawn; the proposed one if not given.
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
    /// The same, and the character to spawn in an app that uses `bevy_aim`.
    Bevy,
}

#[derive(Debug, Args)]
pub(crate) struct Rig {
    /// A .glb, .gltf or .vrm file.
    pub(crate) file: PathBuf,
    /// The bones of the chain, from the effector inward; told by roles and names if not given.
    #[arg(long, value_name = "A,B,C", value_delimiter = ',', value_parser = bone_name)]
    pub(crate) chain: Vec<String>,
    #[command(flatten)]
    pub(crate) facing: Facing,
    /// How to write it.
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
    /// The function of a Rust file that has the attribute `#[differentiate(wrt(…))]`: it and its derivatives, in C or WGSL.
    #[arg(long, value_name = "NAME")]
    pub(crate) function: Option<String>,
    /// The language to emit.
    #[arg(long, value_enum, required_unless_present = "trace")]
    pub(crate) lang: Option<Language>,
    /// Instead of code, list which rules brought the operation counts from what to what, and where derivatives have no limit.
    #[arg(long, conflicts_with_all = ["lang", "check"])]
    pub(crate) trace: bool,
    /// Where to write it; standard output if not given.
    #[arg(short, long, value_name = "FILE", conflicts_with = "check")]
    pub(crate) output: Option<PathBuf>,
    /// Write nothing; exit with 1 if FILE is not what would be emitted.
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
    /// The rig's declaration; with --rig a model.
    #[arg(value_name = "RIG.toml|FILE")]
    pub(crate) rig: PathBuf,
    /// Instead of derivatives, say where this declaration and the model FILE contradict each other.
    #[arg(long = "rig", value_name = "RIG.toml", conflicts_with_all = ["samples", "flip_sign"])]
    pub(crate) model_rig: Option<PathBuf>,
    /// How many random poses to compare.
    #[arg(long, value_name = "N", default_value_t = 10_000, value_parser = clap::value_parser!(u32).range(1..))]
    pub(crate) samples: u32,
    /// Turn the N-th addition of every program into a subtraction (or back) first, to see the check fail.
    #[arg(long, value_name = "N")]
    pub(crate) flip_sign: Option<usize>,
}

#[derive(Debug, Args)]
pub(crate) struct Plot {
    /// The rig's declaration.
    pub(crate) rig: PathBuf,
    /// The joint that turns; the first, which carries the effector, if not given.
    #[arg(long, value_name = "NAME")]
    pub(crate) joint: Option<String>,
    /// What to look at, in the joint's space, along its bone's axes; what needs every angle if not given.
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true)]
    pub(crate) target: Option<Point>,
    /// Draw a surface in space instead of contours.
    #[arg(long)]
    pub(crate) surface: bool,
    /// Width and height in pixels.
    #[arg(long, value_name = "WxH", default_value = "1000x720")]
    pub(crate) size: Size,
    /// Where to write it: SVG or, built with the feature `pictures`, PNG, by the name's ending.
    #[arg(short, long, value_name = "OUT.svg|OUT.png")]
    pub(crate) output: PathBuf,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Paper {
    /// A page that needs nothing but itself.
    Html,
    /// A document for a LaTeX compiler.
    Latex,
}

#[derive(Debug, Args)]
pub(crate) struct Explain {
    /// The rig's declaration.
    pub(crate) rig: PathBuf,
    /// Where to write it; standard output if not given.
    #[arg(short, long, value_name = "OUT.html|OUT.tex")]
    pub(crate) output: Option<PathBuf>,
    /// How to write it; told by the ending of OUT if not given.
    #[arg(long, value_enum)]
    pub(crate) format: Option<Paper>,
    /// How many random poses to compare with central differences.
    #[arg(long, value_name = "N", default_value_t = 1_000, value_parser = clap::value_parser!(u32).range(1..))]
    pub(crate) samples: u32,
}

/// Values of a type that does not parse itself, each with its word and its help.
type Choices<T> = [(T, &'static str, &'static str)];

/// The solvers, and all of them side by side; their words are also those of reports.
pub(crate) const SOLVERS: &Choices<&[Solver]> = &[
    (&[Solver::Natural], "natural", "Eyes leap, head and spine follow smoothly, and the eyes return"),
    (&[Solver::Exact], "exact", "All joints at once, with the least displacement that meets the target"),
    (&[Solver::Ascent], "ascent", "The paper's steepest ascent, joint by joint from the eye inward"),
    (&[Solver::Natural, Solver::Exact, Solver::Ascent], "all", "All three, side by side"),
];

const BEHINDS: &Choices<Behind> = &[
    (Behind::Clip, "clip", "Turn to the edge of what is in reach, on the target's side"),
    (Behind::Plane, "plane", "Turn to it as a plane in front has it: at most 80° aside"),
    (Behind::Off, "off", "Go as near as the joints come, on the side they are on"),
    (Behind::Hold, "hold", "Stay as it is"),
    (Behind::Release, "release", "Return to the animation"),
];

const SETTLES: &Choices<Settle> = &[
    (Settle::Snap, "snap", "On the target from the first frame"),
    (Settle::Animation, "animation", "From the animation"),
];

/// Parses a part of a whole.
fn share(text: &str) -> Result<f32, String> {
    let number = text.parse().ok().filter(|share| (0.0..=1.0).contains(share));
    number.ok_or_else(|| "expected a number from 0 to 1, such as 0.5".into())
}

/// Parses one name of several that commas separate; blanks beside commas are not of the name.
fn bone_name(text: &str) -> Result<String, String> {
    match text.trim() {
        "" => Err("a name is missing; write names as a,b or in quotes as \"a, b\"".into()),
        name => Ok(name.to_owned()),
    }
}

/// Parses a time for which to stay.
fn patience(text: &str) -> Result<f32, String> {
    let number = text.parse().ok().filter(|seconds: &f32| *seconds >= 0.0);
    number.ok_or_else(|| "expected seconds from 0 on, such as 2".into())
}

/// Parses one of these words to its value.
fn one_of<T: Copy + Send + Sync>(all: &'static Choices<T>) -> impl TypedValueParser<Value = T> {
    let words = all.iter().map(|(_, word, help)| PossibleValue::new(*word).help(*help));
    // The words are the only ones that get here.
    let value = |word: String| all.iter().find(|(_, known, _)| *known == word).unwrap_or(&all[0]).0;
    PossibleValuesParser::new(words).map(value)
}

/// Options of every command that aims.
#[derive(Clone, Copy, Debug, Args)]
pub(crate) struct Aiming {
    /// The solver; natural where any joint of the rig has a role, else exact.
    #[arg(long, value_parser = one_of(&SOLVERS[..3]))]
    pub(crate) solver: Option<&'static [Solver]>,
    /// Aim the other eye at the target, too; else it turns as the first one does.
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

/// Of a command whose JSON is its report.
#[derive(Debug, Default, Args)]
pub(crate) struct NoJson {
    /// Always an error that names `--report`.
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
    /// The clip to aim over; if not given, the first called idle, else the first.
    #[arg(long, value_name = "NAME")]
    pub(crate) clip: Option<String>,
    /// Name of the written clip, which it replaces if it is there; if not given, the clip's with "_aimed", beside the clip, or with
    /// "_aimed2" and so on where that is taken.
    #[arg(long = "as", value_name = "NAME", value_parser = clap::builder::NonEmptyStringValueParser::new())]
    pub(crate) name: Option<String>,
    #[command(flatten)]
    pub(crate) facing: Facing,
    #[command(flatten)]
    pub(crate) aiming: Aiming,
    /// What is aimed: a bone of the rig's joints by name, or eyes, head, neck or chest; joints outside it return to rest. The
    /// rig's effector if not given.
    #[arg(long, value_name = "WHAT", value_parser = clap::builder::NonEmptyStringValueParser::new())]
    pub(crate) effector: Option<String>,
    /// How far the gaze goes from the clip's to the target, 0 to 1.
    #[arg(long, value_name = "W", default_value_t = 1.0, value_parser = share, allow_negative_numbers = true)]
    pub(crate) weight: f32,
    /// How far the head takes over from the eyes, 0 to 1 (natural only).
    #[arg(long, value_name = "A", default_value_t = 0.0, value_parser = share, allow_negative_numbers = true)]
    pub(crate) attention: f32,
    /// What becomes of a target behind the character.
    #[arg(long, value_name = "POLICY", value_parser = one_of(BEHINDS), default_value = "clip")]
    pub(crate) behind: Behind,
    /// Seconds for which a natural gaze stays with a target out of reach before it returns to the animation; for ever if not given.
    #[arg(long, value_name = "S", value_parser = patience)]
    pub(crate) patience: Option<f32>,
    /// How long the result is; the clip's length if not given, repeated if longer.
    #[arg(long, value_name = "S", allow_negative_numbers = true)]
    pub(crate) seconds: Option<f32>,
    /// Keys a second.
    #[arg(long, default_value_t = 60.0, allow_negative_numbers = true)]
    pub(crate) fps: f32,
    /// Bones that stay with what carries the joint that they hang on, instead of those of the rig; `none` holds nothing.
    #[arg(long, value_name = "A,B|none", value_delimiter = ',', value_parser = bone_name)]
    pub(crate) hold: Option<Vec<String>>,
    /// How the result begins.
    #[arg(long, value_parser = one_of(SETTLES), default_value = "snap")]
    pub(crate) settle: Settle,
    /// Make the result's first frame follow from its last: the clip's own seam is mended, in place and speed, where it jumps.
    #[arg(long = "loop")]
    pub(crate) looped: bool,
    /// Leave out the keys without which no bone, and nothing looked at from 1 m away, is further off than this, in millimetres of
    /// a 1.7 m figure: 1mm; 0mm leaves out only what changes nothing. It tells how far the clip as written is off: see Reduction below.
    #[arg(long, value_name = "TOL", allow_hyphen_values = true)]
    pub(crate) reduce: Option<Millimetres>,
    /// Exit with 1 if the result looks wrong, although it is written: see Plausibility below.
    #[arg(long)]
    pub(crate) strict: bool,
    #[command(flatten)]
    pub(crate) written: Written,
}

#[derive(Debug, Args)]
pub(crate) struct Reach {
    /// A .glb, .gltf or .vrm file.
    pub(crate) file: PathBuf,
    /// The clip; if not given, the first called idle, else the first.
    #[arg(long, value_name = "NAME")]
    pub(crate) clip: Option<String>,
    /// The node that is led: a hand or a foot. Its parent and grandparent follow.
    #[arg(long, value_name = "NAME")]
    pub(crate) bone: String,
    /// When it is to be there, seconds; once for each target.
    #[arg(long, value_name = "S", required = true, allow_negative_numbers = true)]
    pub(crate) at: Vec<f32>,
    /// Where it is to be, in the file's units; once for each time.
    #[arg(long, value_name = "X,Y,Z", required = true, allow_hyphen_values = true)]
    pub(crate) target: Vec<Point>,
    /// Keys a second.
    #[arg(long, default_value_t = 60.0, allow_negative_numbers = true)]
    pub(crate) fps: f32,
    #[command(flatten)]
    pub(crate) written: Written,
}

/// Kinds of a root's motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Extract {
    /// Along a straight line at constant speed, turning evenly.
    Linear,
    /// Along an arc at constant speed: a screw.
    Composite,
    /// From frame to frame: all of it, so that the hips stay above one place.
    Delta,
}

#[derive(Debug, Args)]
pub(crate) struct Clip {
    /// A .glb, .gltf or .vrm file.
    pub(crate) file: PathBuf,
    /// The clip; give it several times for several. All of them if not given.
    #[arg(long, value_name = "NAME")]
    pub(crate) clip: Vec<String>,
    /// Take the way of the hips over the ground out of the clip, and tell it.
    #[arg(long, value_enum, value_name = "MOTION")]
    pub(crate) extract: Option<Extract>,
    /// Make the clip's first frame follow from its last: its seam is mended, in place and speed, where it jumps.
    #[arg(long = "loop")]
    pub(crate) looped: bool,
    /// Leave out the keys without which no bone is further off than this, in millimetres of a 1.7 m figure: 1mm; 0mm leaves out only
    /// what changes nothing.
    #[arg(long, value_name = "TOL", allow_hyphen_values = true)]
    pub(crate) reduce: Option<Millimetres>,
    /// Times at which a reduced clip has the poses of the old one, seconds: contacts, transitions, poses that were approved.
    #[arg(long, value_name = "S,S", value_delimiter = ',', requires = "reduce", allow_negative_numbers = true, value_parser = seconds)]
    pub(crate) pin: Vec<f32>,
    #[command(flatten)]
    pub(crate) facing: Facing,
    /// Where to write the model with the changed clips in the place of the old ones; may be FILE, which it then replaces.
    #[arg(long, value_name = "OUT.glb")]
    pub(crate) out: Option<PathBuf>,
    /// Where to write what is told, and the root's motion, as JSON.
    #[arg(long, value_name = "R.json")]
    pub(crate) report: Option<PathBuf>,
    /// Where to write it as a page, with charts.
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
    /// Where the target has been.
    Trail,
    /// Error and angles over time.
    Plots,
    /// How long solving takes.
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
    /// The clip to play; if not given, the first called idle, else the first.
    #[arg(long, value_name = "NAME")]
    pub(crate) clip: Option<String>,
    /// The solver, or all of them side by side; natural where any joint of the rig has a role, else exact.
    #[arg(long, value_parser = one_of(SOLVERS))]
    pub(crate) solver: Option<&'static [Solver]>,
    /// How the target moves.
    #[arg(long, value_enum, default_value_t = TargetPath::Still)]
    pub(crate) path: TargetPath,
    /// How many characters.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u16).range(1..=1000))]
    pub(crate) crowd: u16,
    /// What to show at first.
    #[arg(long, value_enum, value_delimiter = ',', value_name = "LIST")]
    #[arg(default_values_t = [Show::Gaze, Show::Trail, Show::Plots, Show::Timing, Show::Panel])]
    pub(crate) show: Vec<Show>,
    /// On light ground.
    #[arg(long)]
    pub(crate) light: bool,
    /// Take a picture of the window instead of staying open; no display is needed where xvfb-run is installed.
    #[arg(long, value_name = "OUT.png")]
    pub(crate) screenshot: Option<PathBuf>,
    /// After how many frames of a sixtieth of a second the picture is taken.
    #[arg(long, value_name = "N", requires = "screenshot", default_value_t = 60, value_parser = clap::value_parser!(u32).range(1..))]
    pub(crate) frames: u32,
    /// How large the picture is, pixels.
    #[arg(long, value_name = "WxH", requires = "screenshot", default_value = "1280x800")]
    pub(crate) size: Size,
    /// Print what is seen on the picture as JSON: status, error, and where targets and gazes are, pixels.
    #[arg(long, requires = "screenshot")]
    pub(crate) json: bool,
}
