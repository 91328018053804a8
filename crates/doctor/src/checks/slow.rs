//! What makes a world slow, told by counts.

use crate::look::{About, Findings, Look, Sighting, Words, figure};
use crate::track::Track;
use crate::{Code, Severity};
use tiny_physics::{Body, BodyKind, Shape, ShapeRef, Stage};

/// Contacts on one body.
const HUB: usize = 200;
/// Static bodies of a level.
const SINGLES: usize = 2000;
/// Sensors that see others.
const SENSORS: usize = 400;
/// Shapes that all sensors together see.
const SEEN: usize = 3000;
/// Times that a contact is solved in a step, and bodies that are few enough for any number.
const ROUNDS: usize = 50;
const FEW: usize = 50;
/// Bodies awake in a debug build.
const DEBUG: usize = 300;
/// Bodies awake that have stayed in their place.
const AWAKE: usize = 200;
/// General polygons that are awake.
const POLYGONS: usize = 1500;

#[derive(Default, Debug, Clone)]
pub(crate) struct Memory {
    bodies: usize,
    shapes: usize,
    /// Seconds of each stage, smoothed, where the program has them timed.
    seconds: [f64; Stage::ALL.len()],
}

impl Memory {
    /// Takes in what the stages of a step took.
    pub(crate) fn note_time(&mut self, look: &Look<'_>) {
        let stats = look.world.stats();
        if stats.total_seconds() > 0.0 {
            for (smooth, stage) in self.seconds.iter_mut().zip(Stage::ALL) {
                *smooth += (stats.seconds(stage) - *smooth) * 0.05;
            }
        }
    }

    /// Does a step take longer than the time that it stands for?
    fn check_time(&self, look: &Look<'_>, findings: &mut Findings) {
        let total: f64 = self.seconds.iter().sum();
        let worst = self.seconds.iter().zip(Stage::ALL).max_by(|a, b| a.0.total_cmp(b.0));
        let Some((most, stage)) = worst.filter(|_| total > f64::from(look.dt)) else { return };
        let share = 100.0 * most / total;
        let figure = figure("step", total as f32, look.dt, " s");
        let seen = Sighting::new(Code::Slow, Severity::Note, About::World, figure);
        findings.add(look, seen, || Words {
            what: format!(
                "a step takes {:.1} ms and stands for {:.1}: {share:.0} % of it are in the stage {}",
                1000.0 * total,
                1000.0 * look.dt,
                stage.name()
            ),
            advice: "more threads (World::set_threads), fewer bodies that are awake; the guide's page on performance has what each stage costs",
            ..Words::default()
        });
    }

    pub(crate) fn check<'a>(
        &mut self,
        look: &Look<'_>,
        tracks: impl Iterator<Item = &'a Track>,
        findings: &mut Findings,
    ) {
        self.check_time(look, findings);
        check_debug(look, findings);
        check_rounds(look, findings);
        check_sight(look, findings);
        check_awake(look, tracks, findings);
        let counts = (look.world.body_count(), look.world.shape_count());
        if counts != (self.bodies, self.shapes) {
            (self.bodies, self.shapes) = counts;
            check_singles(look, findings);
            check_shapes(look, findings);
        }
    }
}

fn report(
    look: &Look<'_>,
    about: About,
    severity: Severity,
    (name, count, bound): (&'static str, usize, usize),
    what: String,
    advice: &'static str,
    findings: &mut Findings,
) {
    let figure = figure(name, count as f32, bound as f32, "");
    let bodies = if let About::Body(id) = about { vec![id] } else { Vec::new() };
    findings.add(look, Sighting::new(Code::Slow, severity, about, figure), || Words {
        what,
        advice,
        bodies,
        ..Words::default()
    });
}

fn check_debug(look: &Look<'_>, findings: &mut Findings) {
    let awake = look.world.awake_body_count();
    if cfg!(debug_assertions) && awake > DEBUG {
        let advice = "build with --release, or give the engine opt-level = 3 in the dev profile";
        let what = format!("{awake} bodies are simulated in a debug build");
        report(
            look,
            About::World,
            Severity::Note,
            ("bodies in a debug build", awake, DEBUG),
            what,
            advice,
            findings,
        );
    }
}

/// Is each contact solved again and again?
fn check_rounds(look: &Look<'_>, findings: &mut Findings) {
    let settings = &look.world.settings;
    let rounds = settings.substeps as usize * settings.iterations as usize;
    let awake = look.world.awake_body_count();
    if rounds > ROUNDS && awake > FEW {
        let advice = "go back to 4 substeps of 1 iteration; islands that need more get more by Settings::refine_up_to";
        let what = format!(
            "{} substeps of {} iterations solve every contact {rounds} times a step",
            settings.substeps, settings.iterations
        );
        report(
            look,
            About::World,
            Severity::Note,
            ("rounds", rounds, ROUNDS),
            what,
            advice,
            findings,
        );
    }
}

/// Do sensors see very many shapes?
fn check_sight(look: &Look<'_>, findings: &mut Findings) {
    let sensors = look.world.shapes().filter(ShapeRef::is_sensor).take(SENSORS);
    let (mut seen, mut most) = (0, (0, None));
    for sensor in sensors {
        let count = look.world.sensor_overlaps(sensor.id()).count();
        seen += count;
        if count > most.0 {
            most = (count, Some(sensor.id()));
        }
    }
    let Some(widest) = most.1.filter(|_| seen > SEEN) else { return };
    let advice =
        "make sensors smaller or give them masks; ask for distance where one question is enough";
    let what = format!("sensors overlap {seen} shapes in all, {widest} alone {}", most.0);
    report(look, About::World, Severity::Note, ("shapes seen", seen, SEEN), what, advice, findings);
}

fn check_awake<'a>(
    look: &Look<'_>,
    tracks: impl Iterator<Item = &'a Track>,
    findings: &mut Findings,
) {
    let awake = tracks.filter(|track| track.still > 10.0).count();
    if awake > AWAKE {
        let advice =
            "turn Settings::sleep on and can_sleep; see what the finding never_sleeps says";
        let what = format!("{awake} bodies are at rest and simulated all the same");
        report(
            look,
            About::World,
            Severity::Note,
            ("bodies awake at rest", awake, AWAKE),
            what,
            advice,
            findings,
        );
    }
}

fn check_singles(look: &Look<'_>, findings: &mut Findings) {
    let fixed = look
        .world
        .bodies()
        .filter(|body| body.kind() == BodyKind::Static && body.shapes().take(2).count() == 1);
    let count = fixed.count();
    if count > SINGLES {
        let advice = "make the level of one body with many shapes, of chains, or of a tile grid (World::add_tiles)";
        let what = format!("the level is made of {count} static bodies with a shape each");
        report(
            look,
            About::World,
            Severity::Note,
            ("static bodies", count, SINGLES),
            what,
            advice,
            findings,
        );
    }
}

fn check_shapes(look: &Look<'_>, findings: &mut Findings) {
    let (mut sensors, mut polygons) = (0, 0);
    for shape in look.world.shape_ids().filter_map(|id| look.world.shape(id)) {
        sensors += usize::from(shape.is_sensor());
        let corners =
            if let Shape::Polygon(polygon) = shape.shape() { polygon.vertices().len() } else { 0 };
        let moves =
            || look.world.body(shape.body()).is_some_and(|body| body.kind() == BodyKind::Dynamic);
        polygons += usize::from(corners > 4 && moves());
    }
    if sensors > SENSORS {
        let advice = "let one larger sensor or an overlap query stand for many; give sensors masks";
        let what = format!("{sensors} sensors ask in each step what they overlap");
        report(
            look,
            About::World,
            Severity::Note,
            ("sensors", sensors, SENSORS),
            what,
            advice,
            findings,
        );
    } else if polygons > POLYGONS {
        let advice =
            "boxes, circles and capsules cost less than polygons of more than four corners";
        let what = format!("{polygons} moving polygons have more than four corners");
        report(
            look,
            About::World,
            Severity::Note,
            ("polygons", polygons, POLYGONS),
            what,
            advice,
            findings,
        );
    }
}

/// Does one body have hundreds of contacts?
pub(crate) fn check_hub(look: &Look<'_>, body: &Body<'_>, touches: usize, findings: &mut Findings) {
    if touches > HUB {
        let advice = "contacts of one body are solved one after the other: make it static or kinematic if you can, or of several bodies";
        let what = format!("{} has {touches} contacts", body.id());
        report(
            look,
            About::Body(body.id()),
            Severity::Note,
            ("contacts", touches, HUB),
            what,
            advice,
            findings,
        );
    }
}
