//! What makes a world slow, told by counts.

use crate::look::{About, Findings, Look, Sighting, Words, figure};
use crate::track::Track;
use crate::{Code, Severity};
use tiny_physics::{Body, BodyId, BodyKind, Shape};

/// Contacts on one body.
const HUB: usize = 200;
/// Static bodies of a level.
const SINGLES: usize = 2000;
/// Sensors that see others.
const SENSORS: usize = 400;
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
}

impl Memory {
    pub(crate) fn check(
        &mut self,
        look: &Look<'_>,
        round: &[BodyId],
        tracks: &[Option<Track>],
        findings: &mut Findings,
    ) {
        check_debug(look, findings);
        check_awake(look, round, tracks, findings);
        let counts = (look.world.body_count(), look.world.shape_count());
        if counts != (self.bodies, self.shapes) {
            (self.bodies, self.shapes) = counts;
            check_singles(look, round, findings);
            check_shapes(look, findings);
        }
    }
}

fn report(
    look: &Look<'_>,
    about: About,
    severity: Severity,
    [count, bound]: [usize; 2],
    what: String,
    advice: &'static str,
    findings: &mut Findings,
) {
    let figure = figure("count", count as f32, bound as f32, "");
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
        report(look, About::World, Severity::Note, [awake, DEBUG], what, advice, findings);
    }
}

fn check_awake(
    look: &Look<'_>,
    round: &[BodyId],
    tracks: &[Option<Track>],
    findings: &mut Findings,
) {
    let of = |id: &BodyId| tracks.get(id.index())?.as_ref();
    let awake = round.iter().filter_map(of).filter(|track| track.still > 10.0).count();
    if awake > AWAKE {
        let advice =
            "turn Settings::sleep on and can_sleep; see what the finding never_sleeps says";
        let what = format!("{awake} bodies are at rest and simulated all the same");
        report(look, About::World, Severity::Note, [awake, AWAKE], what, advice, findings);
    }
}

fn check_singles(look: &Look<'_>, round: &[BodyId], findings: &mut Findings) {
    let fixed = round
        .iter()
        .filter_map(|&id| look.world.body(id))
        .filter(|body| body.kind() == BodyKind::Static && body.shapes().take(2).count() == 1);
    let count = fixed.count();
    if count > SINGLES {
        let advice = "make the level of one body with many shapes, of chains, or of a tile grid (World::add_tiles)";
        let what = format!("the level is made of {count} static bodies with a shape each");
        report(look, About::World, Severity::Note, [count, SINGLES], what, advice, findings);
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
        report(look, About::World, Severity::Note, [sensors, SENSORS], what, advice, findings);
    } else if polygons > POLYGONS {
        let advice =
            "boxes, circles and capsules cost less than polygons of more than four corners";
        let what = format!("{polygons} moving polygons have more than four corners");
        report(look, About::World, Severity::Note, [polygons, POLYGONS], what, advice, findings);
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
            [touches, HUB],
            what,
            advice,
            findings,
        );
    }
}
