//! The command line.

use clap::{Args, Parser, Subcommand, ValueEnum};
use std::path::PathBuf;
use tiny_physics::SimdLevel;
use tiny_physics_doctor::Code;

/// A 2D rigid-body physics engine at work: walls hold, stacks stand, it stays light.
#[derive(Parser, Debug)]
#[command(name = "tiny-physics", version, args_conflicts_with_subcommands = true)]
#[command(after_help = "Without a command it plays the demo in the terminal.

Examples:
  tiny-physics                             watch shapes fall, hit, stack and rest
  tiny-physics list                        what scenes there are
  tiny-physics run large_pyramid           time a scene
  tiny-physics render seed_demo -o a.gif   make an animation
  tiny-physics view tumbler                open a window

'tiny-physics help COMMAND' says more about a command.")]
pub struct Cli {
    /// What to do.
    #[command(subcommand)]
    pub command: Option<Command>,
    /// The demo's options count without its name, too.
    #[command(flatten)]
    pub demo: DemoArgs,
}

/// The commands.
#[derive(Subcommand, Debug)]
pub enum Command {
    /// Play a scene in the terminal, in letters (this is what happens without a command)
    #[command(
        after_help = "Letters: # static, o circle, [ ] box, ( ) capsule, < > other polygon, = kinematic.
In a terminal: space steps one frame, p plays or pauses, r restarts, n takes the next seed, q quits.
Without a terminal it plays by itself, prints a few frames and a summary.

Examples:
  tiny-physics demo
  tiny-physics demo --seed 42
  tiny-physics demo --scene domino
  tiny-physics demo --plain > demo.txt"
    )]
    Demo(DemoArgs),
    /// List the built-in scenes
    #[command(after_help = "Examples:
  tiny-physics list
  tiny-physics list --json")]
    List(ListArgs),
    /// Run a scene as fast as it goes and report times, contacts, penetration and state hash
    #[command(
        after_help = "The hash covers the whole state of the world. It is the same for every number of threads, every
SIMD level and every platform.

Examples:
  tiny-physics run seed_demo --steps 900
  tiny-physics run large_pyramid --threads 4 --simd avx2
  tiny-physics run my_scene.json --json"
    )]
    Run(RunArgs),
    /// Watch a run and say what is wrong: where, since when, why, and what to change
    #[command(
        after_help = "Ends with status 0 where nothing worse than a note was found, with 1 where there is, so that a game's build server can
use it.

Examples:
  tiny-physics doctor my_level.json
  tiny-physics doctor crash.recording --json
  tiny-physics doctor seed_demo --pictures moments
  tiny-physics doctor stack --trace 3,4 --steps 60
  tiny-physics doctor --explain jitter"
    )]
    Doctor(DoctorArgs),
    /// Time scenes stage by stage, on every SIMD level
    #[command(
        after_help = "Scenes go by name, by file, or by tag: benchmark (where nothing is said), box2d, show, scale (circles from
10,000 to a million), huge. Each run is a fresh world: one step untimed, then every step timed. Levels take turns,
A B C A B C, so that what disturbs the machine disturbs all. Stages, median and p99 are wall
time; ns/body is CPU time, with several threads wall time.

--figures prints instead: what should cost next to nothing (rest: a world asleep, a level that nothing touches); bytes
a body and a contact take (memory); nanoseconds to add and to remove a body, and of the steps after (changes); each
stage by body in worlds of several sizes (stages); speed of the machine's memory (bandwidth).

Examples:
  tiny-physics bench large_pyramid
  tiny-physics bench tumbler smash --simd avx2,avx512 --repeat 5
  tiny-physics bench scale --simd avx2 --steps 60 --repeat 1
  tiny-physics bench --figures
  tiny-physics bench --figures=memory,stages --bodies 10000,1000000
  tiny-physics bench spinner --json > spinner.jsonl"
    )]
    Bench(BenchArgs),
    /// Measure the engine against scenes whose right answer is known
    #[command(
        after_help = "Columns 'Box2D' and 'Rapier' were measured on the same scenes and are part of this program: crates/quality/peers.json,
which `cargo run --release --manifest-path peers/Cargo.toml -- quality --write` makes anew. 'reference' is what a
perfect engine gets.
docs/quality.md says in plain words what each row is.

Examples:
  tiny-physics quality
  tiny-physics quality stack pyramid
  tiny-physics quality 6 7 --variant
  tiny-physics quality --json > quality.json"
    )]
    Quality(QualityArgs),
    /// Draw a scene into a PNG picture or a GIF animation
    #[command(
        after_help = "A .png shows the last step; with --every, numbered pictures of every K-th step are written.
A .gif shows every K-th step (2 where not said) from the start on. The camera holds all that moves in the run, or what
the scene file's view says; where bodies go far, it goes along.
With --style debug, contact points are coloured by penetration depth, and bodies that overlap too deeply take that colour.

Examples:
  tiny-physics render seed_demo --steps 300 -o heap.png
  tiny-physics render domino --every 2 -o domino.gif
  tiny-physics render tumbler --area=-11,-1,11,21 --size 800x800 -o drum.png
  tiny-physics render my_scene.json --style debug --show bounds,mass --hide normals -o scene.png
  tiny-physics render bowl --from 60 --steps 300 --every 5 --theme dark --colors 64 -o bowl.gif"
    )]
    Render(RenderArgs),
    /// Watch a scene in a window, step by step if you like, and pull at bodies with the mouse
    #[command(after_help = "Keys are listed in the window; H hides the list. It needs a display.

Examples:
  tiny-physics view
  tiny-physics view tumbler
  tiny-physics view my_scene.json --paused")]
    View(ViewArgs),
    /// Play with scenes in the browser: a timeline to go back in, an inspector, an editor
    #[command(
        after_help = "It serves the playground to this machine alone and prints its address. FILE is a scene file or a recording,
NAME a built-in scene.

Examples:
  tiny-physics play
  tiny-physics play domino
  tiny-physics play my_scene.json
  tiny-physics play bug.tpr"
    )]
    Play(PlayArgs),
    /// Record a run into a file: its first frame and everything that was done since
    #[command(after_help = "Examples:
  tiny-physics record rain --steps 300 -o rain.tpr")]
    Record(RecordArgs),
    /// Play a recording again and check that every step has the same bits
    #[command(after_help = "Examples:
  tiny-physics replay rain.tpr
  tiny-physics replay rain.tpr --to 120")]
    Replay(ReplayArgs),
    /// Find the first step after which two recordings differ
    #[command(after_help = "It fails where they differ.

Examples:
  tiny-physics diff mine.tpr theirs.tpr")]
    Diff(DiffArgs),
    /// Let bodies, shapes and joints come and go for very long, and watch memory, speed and soundness
    #[command(
        after_help = "One line a part of the run: time a step is CPU time where the system tells it, memory is
what the process holds. Two runs with the same seed end with the same hash. It fails where the world's data
are found unsound.

Examples:
  tiny-physics soak
  tiny-physics soak --steps 10000 --seed 7"
    )]
    Soak(SoakArgs),
}

/// Options of `soak`.
#[derive(Args, Clone, Debug)]
pub struct SoakArgs {
    /// Steps to run
    #[arg(long, value_name = "N", default_value_t = 1_000_000, value_parser = clap::value_parser!(u64).range(1..))]
    pub steps: u64,
    /// Check all data after every so many steps
    #[arg(long, value_name = "N", default_value_t = 100, value_parser = clap::value_parser!(u64).range(1..))]
    pub check: u64,
    #[command(flatten)]
    pub world: WorldArgs,
}

/// Which scene, and how the world runs.
#[derive(Args, Clone, Debug)]
pub struct WorldArgs {
    /// Seed of scenes that have chance in them
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub seed: u64,
    /// Threads to use; results do not depend on it
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u16).range(1..=256))]
    pub threads: u16,
    /// SIMD level: scalar, sse2, avx2, avx512, neon or simd128; the best there is where not
    /// said. Results do not depend on it
    #[arg(long, value_name = "LEVEL", value_parser = simd_level)]
    pub simd: Option<SimdLevel>,
}

/// Options of `demo`.
#[derive(Args, Clone, Debug)]
pub struct DemoArgs {
    /// Seed of the shapes' places and sizes
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub seed: u64,
    /// Another scene or scene file
    #[arg(long, value_name = "SCENE|FILE", default_value = "seed_demo")]
    pub scene: String,
    /// Play by itself and print a few frames even in a terminal
    #[arg(long)]
    pub plain: bool,
}

/// Options of `record`.
#[derive(Args, Clone, Debug)]
pub struct RecordArgs {
    /// Name of a built-in scene, or a scene file
    #[arg(value_name = "SCENE|FILE")]
    pub scene: String,
    /// Steps to run; the scene's own number where not said
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub steps: Option<u32>,
    /// Seed of scenes that have chance in them
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub seed: u64,
    /// The file to write
    #[arg(short, long, value_name = "FILE")]
    pub output: PathBuf,
}

/// Options of `replay`.
#[derive(Args, Clone, Debug)]
pub struct ReplayArgs {
    /// The recording
    #[arg(value_name = "FILE")]
    pub file: PathBuf,
    /// Stop after this step; at the end where not said
    #[arg(long, value_name = "N")]
    pub to: Option<usize>,
}

/// Options of `play`.
#[derive(Args, Clone, Debug)]
pub struct PlayArgs {
    /// The scene or recording to open
    #[arg(value_name = "NAME|FILE")]
    pub scene: Option<String>,
    /// Port to serve on; any free one where it is 0
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub port: u16,
}

/// Options of `diff`.
#[derive(Args, Clone, Debug)]
pub struct DiffArgs {
    /// One recording
    #[arg(value_name = "A")]
    pub a: PathBuf,
    /// The other
    #[arg(value_name = "B")]
    pub b: PathBuf,
}

/// Options of `list`.
#[derive(Args, Clone, Debug)]
pub struct ListArgs {
    /// As JSON
    #[arg(long)]
    pub json: bool,
}

/// Options of `doctor`.
#[derive(Args, Clone, Debug)]
pub struct DoctorArgs {
    /// Name of a built-in scene, a scene file (.json), or a recording
    #[arg(value_name = "SCENE|FILE|RECORDING")]
    pub subject: Option<String>,
    /// Steps to watch; all of the scene or recording where not said
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub steps: Option<u32>,
    /// Report as JSON
    #[arg(long)]
    pub json: bool,
    /// Print the contacts of these bodies (by index) in each step, and mark normals that flip
    #[arg(long, value_name = "BODY", value_delimiter = ',')]
    pub trace: Vec<usize>,
    /// Write pictures of the moments that the report speaks of into this folder
    #[arg(long, value_name = "FOLDER")]
    pub pictures: Option<PathBuf>,
    /// Say how a finding is told and when it may be wrong, instead of watching anything
    #[arg(long, value_name = "CODE")]
    pub explain: Option<Code>,
    #[command(flatten)]
    pub world: WorldArgs,
}

/// Options of `run`.
#[derive(Args, Clone, Debug)]
pub struct RunArgs {
    /// Name of a built-in scene, or a scene file
    #[arg(value_name = "SCENE|FILE")]
    pub scene: String,
    /// Steps to run; the scene's own number where not said
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub steps: Option<u32>,
    /// Report as JSON
    #[arg(long)]
    pub json: bool,
    #[command(flatten)]
    pub world: WorldArgs,
}

/// Options of `bench`.
#[derive(Args, Clone, Debug)]
pub struct BenchArgs {
    /// Names, tags or files of scenes
    #[arg(value_name = "SCENE|FILE")]
    pub scenes: Vec<String>,
    /// Threads to use
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u16).range(1..=256))]
    pub threads: u16,
    /// SIMD levels to measure, of scalar, sse2, avx2, avx512, neon and simd128; all that this machine
    /// has where not said
    #[arg(long, value_name = "LEVEL", value_delimiter = ',', value_parser = simd_level)]
    pub simd: Vec<SimdLevel>,
    /// Runs of each scene and level; the median counts
    #[arg(long, value_name = "N", default_value_t = 3, value_parser = clap::value_parser!(u16).range(1..=1000))]
    pub repeat: u16,
    /// Steps of a run, the untimed first one included; the scene's own number where not said
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(2..))]
    pub steps: Option<u32>,
    /// Print figures instead of timing scenes: all of them, or those named
    #[arg(
        long,
        value_name = "FIGURE",
        conflicts_with = "scenes",
        value_enum,
        value_delimiter = ',',
        num_args = 0..,
        require_equals = true,
        default_missing_value = "all"
    )]
    pub figures: Vec<Figure>,
    /// Sizes of the worlds that figures are measured on, in bodies
    #[arg(
        long,
        value_name = "N",
        value_delimiter = ',',
        default_value = "1000,10000,100000",
        value_parser = clap::value_parser!(u32).range(1..=1_000_000)
    )]
    pub bodies: Vec<u32>,
    /// Sizes of the memory that the figure bandwidth goes through, 2^20 bytes
    #[arg(
        long,
        value_name = "MIB",
        value_delimiter = ',',
        default_value = "1,16,64,256,1024",
        value_parser = clap::value_parser!(u32).range(1..=4096)
    )]
    pub mebibytes: Vec<u32>,
    /// Print a JSON object a row
    #[arg(long)]
    pub json: bool,
}

/// What `bench --figures` prints.
#[derive(ValueEnum, Clone, Copy, PartialEq, Eq, Debug)]
pub enum Figure {
    /// Everything below
    All,
    /// Time of a world asleep, and of a level that nothing touches: next to nothing
    Rest,
    /// Bytes a body and a contact take
    Memory,
    /// Time to add and remove bodies, and of the steps after
    Changes,
    /// Time of each stage by body, in worlds of several sizes
    Stages,
    /// Speed of the machine's memory, and what a step asks of it
    Bandwidth,
}

/// Options of `quality`.
#[derive(Args, Clone, Debug)]
pub struct QualityArgs {
    /// Numbers or names of rows, `hard` for the second suite, or a family of it (M, J, E, G, F, C); the first suite where
    /// not said
    #[arg(value_name = "ROW")]
    pub rows: Vec<String>,
    /// Play each row in its other variant: other sizes, masses, angles and speeds
    #[arg(long)]
    pub variant: bool,
    /// Let nothing fall asleep: harder than the defaults, which the targets are for
    #[arg(long)]
    pub awake: bool,
    /// Report as JSON
    #[arg(long)]
    pub json: bool,
}

/// Options of `render`.
#[derive(Args, Clone, Debug)]
pub struct RenderArgs {
    /// Name of a built-in scene, or a scene file
    #[arg(value_name = "SCENE|FILE")]
    pub scene: String,
    /// The file to write: .png or .gif
    #[arg(short, long, value_name = "FILE")]
    pub output: PathBuf,
    /// Steps to run; the scene's own number where not said
    #[arg(long, value_name = "N")]
    pub steps: Option<u32>,
    /// Leave out the steps before this one
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub from: u32,
    /// Draw every K-th step
    #[arg(long, value_name = "K", value_parser = clap::value_parser!(u32).range(1..))]
    pub every: Option<u32>,
    /// Pixels; 1280x720 for pictures, 640x360 for animations where not said
    #[arg(long, value_name = "WxH", value_parser = size)]
    pub size: Option<(u32, u32)>,
    /// Colours of an animation, 8 to 255: fewer make a smaller file
    #[arg(long, value_name = "N", default_value_t = 255, value_parser = clap::value_parser!(u16).range(8..=255))]
    pub colors: u16,
    /// The part of the world to show, metres; what moves in the run, or what the scene says, where not said
    #[arg(long, value_name = "X0,Y0,X1,Y1", value_parser = area, allow_hyphen_values = true)]
    pub area: Option<Area>,
    #[command(flatten)]
    pub looks: Looks,
    /// Show more
    #[arg(long, value_name = "WHAT", value_delimiter = ',')]
    pub show: Vec<Overlay>,
    /// Show less
    #[arg(long, value_name = "WHAT", value_delimiter = ',')]
    pub hide: Vec<Overlay>,
    #[command(flatten)]
    pub world: WorldArgs,
}

/// Options of `view`.
#[derive(Args, Clone, Debug)]
pub struct ViewArgs {
    /// Name of a built-in scene, or a scene file
    #[arg(value_name = "SCENE|FILE", default_value = "seed_demo")]
    pub scene: String,
    /// Pixels
    #[arg(long, value_name = "WxH", value_parser = size, default_value = "1280x720")]
    pub size: (u32, u32),
    /// Start paused
    #[arg(long)]
    pub paused: bool,
    #[command(flatten)]
    pub looks: Looks,
    #[command(flatten)]
    pub world: WorldArgs,
}

/// How a picture looks.
#[derive(Args, Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Looks {
    /// For people who look at it, or for those who look for trouble
    #[arg(long, value_enum, default_value_t)]
    pub style: Style,
    /// By day or by night; the debug style has its own colours
    #[arg(long, value_enum, default_value_t)]
    pub theme: Light,
}

/// What a picture is for.
#[derive(ValueEnum, Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Style {
    /// Bodies as one likes to look at them
    #[default]
    Show,
    /// Kinds of bodies, contacts, normals and depths
    Debug,
}

/// Bright or dark.
#[derive(ValueEnum, Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Light {
    /// By day
    #[default]
    Light,
    /// By night
    Dark,
}

/// Things that can be drawn or left out.
#[derive(ValueEnum, Clone, Copy, PartialEq, Eq, Debug)]
pub enum Overlay {
    /// Joints
    Joints,
    /// Bounding boxes
    Bounds,
    /// Centres of mass
    Mass,
    /// Contact points, coloured by penetration depth
    Contacts,
    /// Contact normals
    Normals,
    /// Velocities
    Velocities,
    /// Bodies in the colour of their deepest contact
    Tint,
    /// Frame and counts
    Text,
    /// The legend
    Legend,
}

/// A box in the world: lower left and upper right, metres.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Area {
    /// Left, bottom.
    pub min: [f64; 2],
    /// Right, top.
    pub max: [f64; 2],
}

fn simd_level(text: &str) -> Result<SimdLevel, String> {
    let level: SimdLevel = text.parse()?;
    if level.is_available() {
        return Ok(level);
    }
    let names: Vec<_> = SimdLevel::available().map(SimdLevel::name).collect();
    Err(format!("this machine cannot run {level}; it has {}", names.join(", ")))
}

fn size(text: &str) -> Result<(u32, u32), String> {
    let parse = || {
        let (width, height) = text.split_once(['x', 'X'])?;
        let size = (width.parse().ok()?, height.parse().ok()?);
        let allowed = 64..=8192;
        (allowed.contains(&size.0) && allowed.contains(&size.1)).then_some(size)
    };
    parse().ok_or_else(|| "width and height in pixels, 64 to 8192 each, like 1280x720".into())
}

fn area(text: &str) -> Result<Area, String> {
    let numbers: Result<Vec<f64>, _> = text.split(',').map(|part| part.trim().parse()).collect();
    match numbers.as_deref() {
        Ok(&[x0, y0, x1, y1])
            if x0 < x1 && y0 < y1 && [x0, y0, x1, y1].iter().all(|x| x.is_finite()) =>
        {
            Ok(Area { min: [x0, y0], max: [x1, y1] })
        }
        _ => Err("left,bottom,right,top in metres, like -10,0,10,20".into()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn the_command_line_is_sound() {
        Cli::command().debug_assert();
    }

    #[test]
    fn every_command_shows_examples() {
        for command in Cli::command().get_subcommands() {
            let help = command.get_after_help().map(|help| help.to_string()).unwrap_or_default();
            assert!(help.contains("Examples:"), "{}", command.get_name());
        }
    }

    #[test]
    fn the_demo_needs_no_name() {
        let cli = Cli::parse_from(["tiny-physics", "--seed", "7"]);
        assert!(cli.command.is_none());
        assert_eq!(cli.demo.seed, 7);
    }

    #[test]
    fn sizes_and_areas() {
        assert_eq!(size("640x480"), Ok((640, 480)));
        assert!(size("640").is_err() && size("0x0").is_err() && size("axb").is_err());
        assert_eq!(area("-1,-2,3,4.5"), Ok(Area { min: [-1.0, -2.0], max: [3.0, 4.5] }));
        assert!(area("1,1,0,0").is_err() && area("1,2,3").is_err() && area("nan,0,1,1").is_err());
        assert!(area("1,2,x,3,4").is_err() && area("1,2,3,4,").is_err());
    }
}
