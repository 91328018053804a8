//! What the doctor knows by name.

use core::fmt;
use core::str::FromStr;

/// How bad it is.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug, Hash, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Severity {
    /// Worth knowing; may well be meant.
    Note,
    /// Looks wrong or will.
    Warning,
    /// The world does what no user wants.
    Error,
}

impl Severity {
    /// The word used in reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Note => "note",
            Self::Warning => "warning",
            Self::Error => "error",
        }
    }
}

macro_rules! codes {
    ($($(#[doc = $doc:literal])+ $code:ident $name:literal $page:literal: $explain:literal;)+) => {
        /// The kinds of findings.
        #[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug, Hash, serde::Serialize)]
        #[serde(rename_all = "snake_case")]
        #[non_exhaustive]
        pub enum Code {
            $($(#[doc = $doc])+ $code,)+
        }

        impl Code {
            /// All of them, in the order in which causes come before their effects.
            pub const ALL: &[Self] = &[$(Self::$code,)+];

            /// The name used in reports and on command lines.
            pub fn name(self) -> &'static str {
                match self { $(Self::$code => $name,)+ }
            }

            /// The section of the guide's troubleshooting page.
            pub fn page(self) -> &'static str {
                match self { $(Self::$code => concat!("docs/guide/troubleshooting.md#", $page),)+ }
            }

            /// How it is told, and when the doctor may be wrong.
            pub fn explain(self) -> &'static str {
                match self { $(Self::$code => $explain,)+ }
            }
        }
    };
}

codes! {
    /// Numbers were refused, or bodies frozen because theirs stopped being finite.
    RefusedInput "refused_input" "numbers-that-did-nothing":
        "The engine counts steps and numbers that it refused, bodies that it froze because their numbers stopped being finite, \
         and handles of what is gone that were to be changed. Any count above zero is a finding; stale handles are a note, \
         since asking may be how the program finds out. It cannot say which line of your program did it.";
    /// Sizes far from what the engine is made for, or units that look like pixels.
    Size "size" "sizes-and-units":
        "Moving bodies are measured against the length unit: below 0.02 units or above 100 units is out of range; a median above 12 \
         units with the length unit at 1 looks like pixels; a ratio above 1000 between the largest and the smallest looks like mixed \
         units. Wrong where a world really is that large: then the sizes still cost precision, but may be meant.";
    /// Stuff far lighter or heavier than the rest.
    Density "density" "masses":
        "Mass by area of each moving body against the median of all moving bodies: a factor of 1000 or more is a finding. Wrong where one \
         body is meant to be a balloon or a neutron star.";
    /// A heavy body on a light one.
    MassRatio "mass_ratio" "masses":
        "A body lies on a lighter one, or hangs from it by a joint, and is heavier by a factor of 2000 (warning) or 50 (note). \
         What joints hold need not be carried and does not count.";
    /// Time steps too long for the speeds.
    StepTooLong "step_too_long" "time-steps":
        "A step above 1/29 s is a finding: contacts and joints get softer with the square of the step. A note where less than \
         half of the last 64 steps are so long (hitches), an error above half a second (milliseconds for seconds). Wrong for \
         slow scenes that nobody looks at.";
    /// Time steps of many lengths.
    VariableStep "variable_step" "time-steps":
        "The lengths of the last 64 steps: more than a tenth of them differ by over 2 % from the most usual one. Runs can then not be repeated, and \
         warm starting loses its accuracy.";
    /// Bodies created inside others.
    OverlapAtStart "overlap_at_start" "overlaps":
        "At the poses that a body and its neighbours had before its first step, a pair is deeper than 4 cm (length units) and \
         than a tenth of the thinner shape. Bodies that locks hold there are told as stuck. Of bodies that come by the hundred \
         in one step, only 64 are asked.";
    /// A position set into or through others.
    Teleport "teleport" "teleports":
        "A body is somewhere else than its last step left it, further than its speed explains, and is deeper in a shape that it \
         collides with than before, or the straight way there leads through one. A note where that way is longer than 16 times \
         its radius and ends in the open: portals and respawns do so on purpose.";
    /// Shapes that look as if they should meet, and never do.
    Filter "filter" "filters":
        "Two shapes overlap by more than a seventh of the thinner one and never meet. The reason is read from masks, groups, \
         sensors, kinds of bodies, `is_enabled`, and joints whose pin is in neither shape. A note, since it may be meant; a \
         warning where a body falls through wide static ground. What a program's own pair filter excludes is not seen.";
    /// Went through something.
    Tunnelling "tunnelling" "things-pass-through-each-other":
        "The way of a body's centre in one step, seen from the other body, enters a shape that it collides with at one face and \
         leaves it at the opposite one, and the two were apart before the step. Where many bodies are fast for long, each is \
         looked at in some of the steps only, so that a single passage may be missed.";
    /// Moves further in a step than what it hits is thick.
    NearMiss "near_miss" "things-pass-through-each-other":
        "A body hit something while it moved further in a step than both are thick: only the sweep of continuous collision held it. A note, as long as it holds.";
    /// At the speed limit.
    SpeedLimit "speed_limit" "speed-limit":
        "A body's speed is at 98 % or more of `Settings::max_speed`.";
    /// Falls for ever.
    FellOut "fell_out" "falling-for-ever":
        "A body is below everything static by more than 30 units and ten times its size and still falls, or falls freely for more than 8 s.";
    /// Inside something and does not come out.
    Stuck "stuck" "overlaps":
        "A body's overlap is over half of the radius of the disk in its thinnest shape for half a second while it stays where \
         it is although nothing drives or loads it, or it falls asleep so; or its middle is inside static ground and it has no \
         contact at all.";
    /// Squeezed, pushed or loaded into another body.
    DeepOverlap "deep_overlap" "overlaps":
        "A contact is deeper than 4 cm (length units) and a tenth of the thinner shape in two looks. A note where it passes \
         within a quarter of a second and the time in which the defaults push it out (0.4 units a second), as a hard hit does. \
         The cause is looked for in this order: a moved or motor-driven body that crushes, a teleport, a mass ratio above 10, \
         the bound on pushing apart.";
    /// A joint beyond its limits.
    LimitOverrun "limit_overrun" "joints":
        "A joint's coordinate is outside its limits by more than 0.07 rad or 3 cm (length units) in two looks, or by three times that in one.";
    /// Two constraints that exclude each other.
    JointFight "joint_fight" "joints":
        "A joint stays apart by more than 2 % of its smaller body (and 1 cm) for 0.75 s, or as its bodies fall asleep, while \
         they stand still and it bears over five times their weight: something holds against it, another joint, a limit or a \
         contact. Or two motors between the same bodies want speeds that differ by over a fifth.";
    /// A joint whose anchors are apart.
    JointStretch "joint_stretch" "joints":
        "What a joint holds rigid is apart by more than 3 % of its smaller body and 2 cm (length units), in two looks. A note \
         where it passes within 0.4 s and is less than half of the body, as a knock does. A weld made of springs is told, as a \
         note, where it gives way by a quarter of the body.";
    /// A motor that pushes into a limit.
    MotorAtLimit "motor_at_limit" "joints":
        "A motor drives a joint into the end of its range for a third of a second. A very strong one shakes there.";
    /// Energy comes from nowhere.
    EnergyGain "energy_gain" "energy":
        "Kinetic and potential energy of all bodies, summed up every eighth step in worlds of up to 512 that can move, grows \
         past what it has been by half and more, though no motor, belt, spring, mouse or moved body is there to do work. A note \
         where the program pushed bodies or changed joints meanwhile, which may be meant. The island is that of the body with \
         the most energy, which need not be where it came from.";
    /// Speed lost at a seam between two shapes.
    GhostBump "ghost_bump" "bumps-at-seams":
        "A body that slides along the level loses over 3 % of its speed along the surface and 0.3 m/s in one step, more than \
         friction takes, while a second shape of the level stands against it whose upper face goes on with the first within 11 \
         degrees and a fifth of the body's radius in height. Higher ledges are taken for steps and walls.";
    /// Does not bounce though its material does.
    RestitutionLost "restitution_lost" "bounces":
        "A body with a restitution of 0.2 or more meets something whose mix with it is below a third of that, or hits slower \
         than the restitution threshold though it fell by a fifth of its radius.";
    /// At rest, yet it moves.
    Jitter "jitter" "stacks-shake-sink-or-slide":
        "A body stays within a tenth of its size for a second and more, and for another second and a half its velocity (or its \
         turning) changes its sign in more than one step of five, at over 2 cm/s and by over 1 mm to and fro (length units). A \
         note for the first three seconds, in which piles settle.";
    /// Goes down slowly though it rests.
    Sinking "sinking" "stacks-shake-sink-or-slide":
        "The overlap of a body at rest is over 1 cm (length units) deeper than when it came to rest, in three looks in a row.";
    /// At rest, but never asleep.
    NeverSleeps "never_sleeps" "never-asleep":
        "A body stays in its place for five seconds and stays awake, or is woken ten times there. What keeps it awake is read from its settings, its neighbours and joints, and the events.";
    /// Slow, and why.
    Slow "slow" "it-is-slow":
        "Told by counts: a debug build with many bodies, one body with hundreds of contacts, sensors in great number or that \
         see thousands of shapes, more than 50 rounds of the solver, a level of thousands of static bodies, bodies kept awake \
         at rest, many polygons of more than four corners. By the clock only where the program has stages timed and a step \
         takes longer than the time that it stands for.";
}

impl Code {
    /// What it brings about, where it concerns the same bodies or the whole world: findings that are told after it.
    pub(crate) fn brings_about(self) -> &'static [Self] {
        use Code::*;
        match self {
            Size | StepTooLong => &[
                Tunnelling,
                NearMiss,
                SpeedLimit,
                Stuck,
                DeepOverlap,
                LimitOverrun,
                JointFight,
                JointStretch,
                EnergyGain,
                RestitutionLost,
                Jitter,
                Sinking,
                NeverSleeps,
            ],
            VariableStep => {
                &[StepTooLong, DeepOverlap, JointStretch, EnergyGain, Jitter, Sinking, NeverSleeps]
            }
            Density | MassRatio => &[
                Stuck,
                DeepOverlap,
                LimitOverrun,
                JointFight,
                JointStretch,
                Jitter,
                Sinking,
                NeverSleeps,
            ],
            OverlapAtStart => &[Stuck, DeepOverlap, JointStretch, EnergyGain, Jitter],
            Teleport => &[Tunnelling, Stuck, DeepOverlap, JointStretch, EnergyGain, Jitter],
            LimitOverrun => &[JointFight, JointStretch, DeepOverlap, EnergyGain],
            JointFight => &[JointStretch, DeepOverlap, EnergyGain, Jitter],
            JointStretch => &[DeepOverlap],
            // What is made fast by force hits hard and tears joints.
            EnergyGain => &[JointStretch, DeepOverlap, NearMiss, RestitutionLost],
            Sinking => &[Stuck, DeepOverlap],
            Filter => &[FellOut],
            _ => &[],
        }
    }
}

impl fmt::Display for Code {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for Code {
    type Err = String;

    fn from_str(name: &str) -> Result<Self, String> {
        let found = Self::ALL.iter().copied().find(|code| code.name() == name);
        found.ok_or_else(|| {
            let names: Vec<_> = Self::ALL.iter().map(|code| code.name()).collect();
            format!("there is no finding `{name}`; there are {}", names.join(", "))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_found_again_and_are_those_of_json() {
        for &code in Code::ALL {
            assert_eq!(code.name().parse(), Ok(code));
            assert_eq!(serde_json::to_string(&code).unwrap(), format!("\"{code}\""));
            assert!(code.explain().ends_with('.'));
        }
        assert!("wobble".parse::<Code>().unwrap_err().contains("jitter"));
    }
}
