//! The command line as data: every option with its help. Nothing is done here; what a value means is in `values`.

use std::path::PathBuf;

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{Args, CommandFactory, Parser, Subcommand, ValueEnum};

use crate::model::request::{FORMATS, Format, Precision};
use crate::picture::camera::View;
use crate::picture::palette::Palette;

use super::text::near;
use super::values::{
    Assignment, Camera, Cutting, Extent, Ground, Section, Size, Slices, angles, assignment, background, camera, cut,
    extent, positive, section, size, slices,
};
use super::way::{Along, Way};

/// The whole command line.
#[derive(Debug, Parser)]
#[command(name = "yont", version, about, max_term_width = 100, after_help = after_help())]
#[command(override_usage = "yont [OPTIONS] [FILE] [-o OUT]...\n       yont [OPTIONS] <COMMAND>")]
pub struct Cli {
    /// What to do with a program when no command is named
    #[command(flatten)]
    pub run: Run,
    /// How to tell the results
    #[command(flatten)]
    pub common: Common,
    /// One of the commands
    #[command(subcommand)]
    pub command: Option<Command>,
}

/// What stands below the options; the formats come from their one list.
fn after_help() -> String {
    let formats =
        FORMATS.iter().map(|(_, extension, what, _)| format!("  .{extension:<5} {what}\n")).collect::<String>();
    format!(
        "Without a program, `yont` is a prompt. The extension of OUT decides what is made:\n{formats}\
         A name with n in braces makes one file a frame, numbered from 0 with at least three digits; `-` is standard\n\
         output, with --format.\n\n\
         Exit status: 0 done; 1 ran and failed (an empty object); 2 usage; 3 an error in the program;\n\
         4 a file could not be read or written; 130 Ctrl-C."
    )
}

/// The commands.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Runs a program; what `yont FILE` does
    Run(Box<Run>),
    /// Each object: dimension, coordinates and types, bounds, size of its program
    Info(Info),
    /// Volume, area, centroid, inertia, bounding box and genus, with error estimates
    Measure(Measure),
    /// Values of the object's function at points
    Sample(Sample),
    /// Reads programs and tells their errors, without making anything
    Check(Check),
    /// Formats programs
    Fmt(Fmt),
    /// Explains a name of the library, a built-in function, or a name of a program; without a name, lists them
    Doc(Doc),
    /// Prints the completions for a shell
    Completions {
        /// The shell
        shell: clap_complete::Shell,
    },
    /// Prints the manual page
    Man,
}

/// How results and messages are told; these stand before or after a command.
#[derive(Args, Clone, Debug)]
#[command(next_help_heading = "How it talks and works")]
pub struct Common {
    /// Threads; by default one for each core
    #[arg(short = 'j', long = "threads", value_name = "N", global = true, value_parser = positive)]
    pub threads: Option<usize>,
    /// Tell what took how long, and the counters of the work
    #[arg(long, global = true)]
    pub timings: bool,
    /// Only results and errors: no notes, no warnings, no progress
    #[arg(short, long, global = true, conflicts_with = "verbose")]
    pub quiet: bool,
    /// Tell more about what was made
    #[arg(short, long, global = true)]
    pub verbose: bool,
    /// Colours; `auto` means on a terminal, unless NO_COLOR is set
    #[arg(long, value_name = "WHEN", global = true, default_value = "auto")]
    pub color: When,
    /// The form of errors, warnings and notes
    #[arg(long, value_name = "FORM", global = true, default_value = "human")]
    pub diagnostics: Rendering,
    /// Start without the settings of the file that `yont info --paths` names
    #[arg(long, global = true)]
    pub no_config: bool,
    /// Warnings count as errors
    #[arg(short = 'W', long = "warnings-as-errors", global = true)]
    pub strict: bool,
}

/// When to colour.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum When {
    /// On a terminal
    #[default]
    Auto,
    /// Always
    Always,
    /// Never
    Never,
}

/// Whether there is something.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Switch {
    /// With it
    On,
    /// Without it
    Off,
}

impl Switch {
    /// Whether it is on.
    #[must_use]
    pub fn is_on(self) -> bool {
        self == Self::On
    }
}

/// How space is projected onto a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Rays {
    /// What is farther looks smaller
    Perspective,
    /// It does not
    Orthographic,
}

/// The renderings of diagnostics.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum Rendering {
    /// With the lines and the places underlined
    #[default]
    Human,
    /// One line each, as editors read it
    Short,
    /// One JSON object a line
    Json,
}

/// Where the program comes from.
#[derive(Args, Clone, Debug, Default, PartialEq)]
pub struct Program {
    /// The program; `-` is standard input
    #[arg(value_name = "FILE")]
    pub file: Option<PathBuf>,
    /// The program itself, repeatable; runs after FILE
    #[arg(short = 'e', long = "evaluate", value_name = "CODE", allow_hyphen_values = true)]
    pub code: Vec<String>,
    /// Define NAME, whatever the program says, repeatable
    #[arg(short = 'D', long = "define", value_name = "NAME=EXPR", value_parser = assignment)]
    pub define: Vec<Assignment>,
    /// Start without the library of primitives and operations: every name is still to be defined
    #[arg(long)]
    pub no_prelude: bool,
}

/// Which object, and which part of its space.
#[derive(Args, Clone, Debug, Default, PartialEq)]
pub struct Subject {
    /// The object; by default the last `gob_` that is defined. Repeatable: a picture shows several
    #[arg(long, value_name = "NAME", value_delimiter = ',')]
    pub object: Vec<String>,
    /// Hold a coordinate at a value (a section), repeatable
    #[arg(long, value_name = "xN=VALUE", value_parser = section, value_delimiter = ',', allow_hyphen_values = true)]
    pub at: Vec<Section>,
    /// The modelling space; by default the program's x1min, x1max and so on, or what a search finds
    #[arg(long, value_name = "xN=LO:HI", value_parser = extent, value_delimiter = ',', allow_hyphen_values = true)]
    pub bounds: Vec<Extent>,
}

/// How fine the boundary is sampled.
#[derive(Args, Clone, Debug, Default, PartialEq)]
pub struct Fineness {
    /// Cells along the longest side of the modelling space; larger is finer (default 128)
    #[arg(long, value_name = "N", value_parser = positive)]
    pub resolution: Option<usize>,
    /// The length of a cell, instead of --resolution
    #[arg(long, value_name = "LENGTH", conflicts_with = "resolution")]
    pub cell: Option<f64>,
    /// The numbers that points are computed with; `single` is for previews (default double)
    #[arg(long, value_name = "NUMBERS")]
    pub precision: Option<Numbers>,
    /// Creases and corners as they are in meshes and outlines, not beveled (default off)
    #[arg(long, value_name = "SWITCH", num_args = 0..=1, default_missing_value = "on", require_equals = true)]
    pub sharp: Option<Switch>,
}

/// The precisions.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum Numbers {
    /// About sixteen digits
    #[default]
    Double,
    /// About seven digits
    Single,
}

impl From<Numbers> for Precision {
    fn from(numbers: Numbers) -> Self {
        match numbers {
            Numbers::Double => Self::Double,
            Numbers::Single => Self::Single,
        }
    }
}

/// How pictures look.
#[derive(Args, Clone, Debug, Default, PartialEq)]
#[command(next_help_heading = "Pictures")]
pub struct Look {
    /// Pixels of a picture, of each picture in a sheet; by default a size that suits the object
    #[arg(long, value_name = "WxH", value_parser = size)]
    pub size: Option<Size>,
    /// Where the camera stands, in degrees: around the object from its front, and above it; or the place of the eye, X,Y,Z;
    /// instead of --view
    #[arg(long, value_name = "AROUND,ABOVE", value_parser = camera, conflicts_with = "view", allow_hyphen_values = true)]
    pub camera: Option<Camera>,
    /// Whether what is farther looks smaller; by default with --camera, not with --view
    #[arg(long, value_name = "RAYS")]
    pub projection: Option<Rays>,
    /// Where the light stands, in degrees: around the object from its front, and above it; by default at the camera's left shoulder
    #[arg(long, value_name = "AROUND,ABOVE", value_parser = angles, allow_hyphen_values = true)]
    pub light: Option<[f64; 2]>,
    /// The second, weaker light (default on)
    #[arg(long, value_name = "SWITCH")]
    pub fill: Option<Switch>,
    /// Shadows of the light (default on)
    #[arg(long, value_name = "SWITCH")]
    pub shadow: Option<Switch>,
    /// The same as --shadow off
    #[arg(long, conflicts_with = "shadow")]
    pub no_shadow: bool,
    /// Ambient occlusion: hollows and corners get less light from the sky (default off)
    #[arg(long, value_name = "SWITCH", num_args = 0..=1, default_missing_value = "on", require_equals = true)]
    pub occlusion: Option<Switch>,
    /// What stands behind the object: a colour (white, black, #ffcc00) or `transparent`
    #[arg(long, value_name = "COLOUR", value_parser = background)]
    pub background: Option<Ground>,
    /// Cut a solid at a plane, repeatable: x1=0 takes away the half on the side of the camera, x1<0 keeps that half
    #[arg(long, value_name = "xN=VALUE", value_parser = cut, allow_hyphen_values = true)]
    pub cut: Vec<Cutting>,
    /// The side that the camera looks from
    #[arg(long, value_name = "SIDE", value_parser = views())]
    pub view: Option<String>,
    /// The colours; in a plot, `mono` is black inside and white outside
    #[arg(long, value_name = "NAME", value_parser = palettes())]
    pub palette: Option<String>,
    /// Rays along each side of a pixel where a picture shows an edge
    #[arg(long, value_name = "N", value_parser = positive)]
    pub supersample: Option<usize>,
    /// Axes with numbers around the picture, which grows by them; graphs and contour maps always have them
    #[arg(long)]
    pub axes: bool,
    /// N sections across an axis, from LO to HI, as outlines of an .svg or lines of one .png
    #[arg(long, value_name = "xN=LO:HI:N", value_parser = slices, allow_hyphen_values = true)]
    pub slices: Option<Slices>,
}

/// Pictures on the terminal.
#[derive(Args, Clone, Debug, Default, PartialEq)]
#[command(next_help_heading = "Pictures")]
pub struct Display {
    /// How small pictures are drawn on the terminal; `auto` goes by the environment
    #[arg(long, value_name = "WAY")]
    pub images: Option<Images>,
}

/// Ways of drawing on a terminal.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum Images {
    /// What the terminal seems to understand; nothing off a terminal
    #[default]
    Auto,
    /// Half blocks, in true or 256 colours
    Half,
    /// The graphics protocol of kitty
    Kitty,
    /// The inline images of iTerm2
    Iterm,
    /// Sixel graphics
    Sixel,
    /// No pictures
    Off,
}

/// The frames of an animation.
#[derive(Args, Clone, Debug, Default, PartialEq)]
#[command(next_help_heading = "Animation")]
pub struct Motion {
    /// Frames; by default those of the step of T
    #[arg(long, value_name = "N", value_parser = positive)]
    pub frames: Option<usize>,
    /// Frames a second in an animation (default 4)
    #[arg(long, value_name = "F")]
    pub fps: Option<f64>,
}

/// Running a program.
#[derive(Args, Clone, Debug, Default, PartialEq)]
pub struct Run {
    /// Where the program comes from
    #[command(flatten)]
    pub program: Program,
    /// What to make, repeatable; the extension decides the format
    #[arg(short, long = "output", value_name = "OUT")]
    pub output: Vec<String>,
    /// The format of `-o -`
    #[arg(long, value_name = "FORMAT", value_parser = formats())]
    pub format: Option<Format>,
    /// Stay at the prompt after the program has run
    #[arg(short, long)]
    pub interactive: bool,
    /// Exit with 1 when the value of the last expression is 0
    #[arg(long)]
    pub exit_status: bool,
    /// How results are made
    #[command(flatten)]
    pub making: Making,
    /// The options that come from the file of settings
    #[arg(skip)]
    pub settings: Vec<String>,
}

fn formats() -> impl TypedValueParser<Value = Format> {
    let values = FORMATS.iter().map(|(_, extension, what, _)| PossibleValue::new(*extension).help(*what));
    // The list above admits nothing that is no format.
    PossibleValuesParser::new(values).map(|name| Format::by_extension(&name).unwrap_or(Format::Stl))
}

fn views() -> PossibleValuesParser {
    PossibleValuesParser::new(View::NAMES.iter().map(|named| named.0).chain(["perspective"]))
}

fn palettes() -> PossibleValuesParser {
    PossibleValuesParser::new(Palette::NAMES.iter().map(|named| named.0))
}

/// How results are made: everything that decides what is in a file.
#[derive(Args, Clone, Debug, Default, PartialEq)]
pub struct Making {
    /// Which object
    #[command(flatten)]
    pub subject: Subject,
    /// How fine
    #[command(flatten)]
    pub fineness: Fineness,
    /// Which way
    #[command(flatten)]
    pub way: Way,
    /// How it looks
    #[command(flatten)]
    pub look: Look,
    /// Over time
    #[command(flatten)]
    pub motion: Motion,
    /// On the terminal
    #[command(flatten)]
    pub display: Display,
}

/// The options of a run, without a run, for reading them at the prompt.
#[derive(Debug, Parser)]
#[command(no_binary_name = true, disable_help_flag = true)]
struct Options {
    #[command(flatten)]
    making: Making,
}

/// The names of the options that decide how results are made, without their dashes.
#[must_use]
pub fn option_names() -> Vec<String> {
    Options::command().get_arguments().filter_map(|argument| argument.get_long().map(str::to_owned)).collect()
}

/// The values of an option that has a list of them.
#[must_use]
pub fn option_values(name: &str) -> Vec<String> {
    let command = Options::command();
    let argument = command.get_arguments().find(|argument| argument.get_long() == Some(name));
    let values = argument.map(clap::Arg::get_possible_values).unwrap_or_default();
    values.iter().map(|value| value.get_name().to_owned()).collect()
}

/// What is wrong with an option, in one line: what was found, what would do, what was probably meant.
#[must_use]
pub fn words_of(error: clap::Error) -> String {
    let text = with_near(error, &Options::command()).to_string();
    let mut lines = text.lines().map(str::trim);
    let first = lines.next().unwrap_or_default().trim_start_matches("error: ").to_owned();
    let more = lines.filter_map(|line| {
        let values = line.strip_prefix('[').and_then(|line| line.strip_suffix(']'));
        values.or_else(|| line.strip_prefix("tip: ").filter(|tip| tip.contains("similar")))
    });
    [first].into_iter().chain(more.map(str::to_owned)).collect::<Vec<_>>().join("; ")
}

/// The error with the value or the option that is nearest by our own measure, which counts slips of the keyboard.
#[must_use]
pub fn with_near(mut error: clap::Error, command: &clap::Command) -> clap::Error {
    let word = |kind| match error.get(kind) {
        Some(ContextValue::String(word)) => Some(word.clone()),
        _ => None,
    };
    match error.kind() {
        ErrorKind::InvalidValue => {
            let (Some(value), Some(ContextValue::Strings(valid))) =
                (word(ContextKind::InvalidValue), error.get(ContextKind::ValidValue))
            else {
                return error;
            };
            if let Some(near) = near(&value, valid.iter().map(String::as_str)).map(str::to_owned) {
                error.insert(ContextKind::SuggestedValue, ContextValue::String(near));
            }
        }
        ErrorKind::UnknownArgument => {
            let stray = word(ContextKind::InvalidArg).unwrap_or_default();
            let name = stray.strip_prefix("--").and_then(|stray| stray.split('=').next()).unwrap_or_default();
            let names = command.get_arguments().filter_map(clap::Arg::get_long);
            if let Some(near) = near(name, names).filter(|_| !name.is_empty()) {
                error.insert(ContextKind::SuggestedArg, ContextValue::String(format!("--{near}")));
            }
        }
        _ => {}
    }
    error
}

impl Making {
    /// These with the options in `words` laid over them: `--resolution 64 --view top`. Of two that exclude each other, the
    /// one said last stays.
    ///
    /// # Errors
    /// Words for the user on the first option that is none or has no such value.
    pub fn with(&self, words: &str) -> Result<Self, String> {
        let mut options = Options { making: self.clone() };
        let says = |name: &str| words.split_whitespace().any(|word| word.split('=').next() == Some(name));
        if says("--resolution") {
            options.making.fineness.cell = None;
        }
        if says("--cell") {
            options.making.fineness.resolution = None;
        }
        if says("--view") {
            options.making.look.camera = None;
        }
        if says("--camera") {
            options.making.look.view = None;
        }
        if says("--no-shadow") {
            options.making.look.shadow = None;
        }
        let read = options.try_update_from(words.split_whitespace());
        read.map_err(words_of)?;
        // A flag that is not said again stays.
        let look = &mut options.making.look;
        look.axes |= self.look.axes;
        look.no_shadow |= self.look.no_shadow && !says("--shadow");
        Ok(options.making)
    }
}

/// Telling about objects.
#[derive(Args, Clone, Debug)]
pub struct Info {
    /// Where the program comes from
    #[command(flatten)]
    pub program: Program,
    /// Only this object
    #[arg(long, value_name = "NAME")]
    pub object: Option<String>,
    /// Instead: where settings, history and journals lie
    #[arg(long, conflicts_with_all = ["file", "code", "define", "object"])]
    pub paths: bool,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
}

/// Measuring an object.
#[derive(Args, Clone, Debug)]
pub struct Measure {
    /// Where the program comes from
    #[command(flatten)]
    pub program: Program,
    /// Which object
    #[command(flatten)]
    pub subject: Subject,
    /// How fine
    #[command(flatten)]
    pub fineness: Fineness,
    /// Which way
    #[command(flatten)]
    pub along: Along,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
}

/// Sampling an object's function.
#[derive(Args, Clone, Debug)]
pub struct Sample {
    /// Where the program comes from
    #[command(flatten)]
    pub program: Program,
    /// Which object
    #[command(flatten)]
    pub subject: Subject,
    /// The points, one a line, numbers apart by white space or commas; `-`, the default, is standard input
    #[arg(long, value_name = "FILE")]
    pub points: Option<PathBuf>,
    /// Where the values go; by default to standard output
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// Write the gradient after the value
    #[arg(long)]
    pub gradient: bool,
    /// The numbers that values are computed with; gradients are always doubles
    #[arg(long, value_name = "NUMBERS", default_value = "double")]
    pub precision: Numbers,
}

/// Checking programs.
#[derive(Args, Clone, Debug)]
pub struct Check {
    /// The programs; `-` is standard input
    #[arg(value_name = "FILE", required = true)]
    pub files: Vec<PathBuf>,
    /// Start without the library of primitives and operations: every name is still to be defined
    #[arg(long)]
    pub no_prelude: bool,
}

/// Formatting programs.
#[derive(Args, Clone, Debug)]
pub struct Fmt {
    /// The programs, which are rewritten; `-` goes from standard input to standard output
    #[arg(value_name = "FILE", required = true)]
    pub files: Vec<PathBuf>,
    /// Write nothing; exit with 1 when a file is not formatted
    #[arg(long)]
    pub check: bool,
}

/// Explaining names.
#[derive(Args, Clone, Debug)]
pub struct Doc {
    /// A name of the library, a built-in function, or a name of the program; all of them are listed without one
    pub name: Option<String>,
    /// A program that defines the name
    #[arg(long, value_name = "FILE")]
    pub file: Option<PathBuf>,
    /// Leave out the library of primitives and operations
    #[arg(long)]
    pub no_prelude: bool,
}
