//! `doctor`: what is wrong with a scene or a recorded run, in words.

use crate::args::DoctorArgs;
use crate::failure::{Failure, Outcome};
use crate::picture::{self, Overlays};
use crate::simulation::Simulation;
use crate::source;
use std::io::{Write, stderr, stdout};
use std::path::Path;
use tiny_physics::record::{Player, Recording};
use tiny_physics::{
    BodyId, BodyKind, Color, DVec2, DebugDraw, Layer, Pose, Rot, Vec2, World, draw_shape,
};
use tiny_physics_doctor::{Code, Doctor, Finding, Report, Severity, Trace};
use tiny_physics_draw::{Camera, Canvas};

/// Most pictures that are taken.
const PICTURES: usize = 8;
/// Width and height of a picture, pixels.
const SIZE: (u32, u32) = (960, 600);
/// Colours of the bodies that a finding speaks of.
const FIRST: Color = Color::rgb(255, 150, 40);
const SECOND: Color = Color::rgb(110, 230, 120);
/// What a picture shows around a body, metres at least and sizes of the body.
const AROUND: (f64, f64) = (3.0, 6.0);

/// Watches a run and prints the report. Fails without words where it is worse than a note.
///
/// # Errors
/// There is no such scene or recording, or the run is ill.
pub fn run(args: &DoctorArgs) -> Outcome {
    if let Some(code) = args.explain {
        return explain(code);
    }
    let Some(subject) = &args.subject else {
        return Err(Failure::new("there is nothing to watch")
            .hint("name a scene, a scene file or a recording"));
    };
    let mut out = stdout().lock();
    let mut doctor = Doctor::new();
    let mut trace = Trace::new(Vec::new());
    let mut traced = Ok(());
    each_step(args, subject, |world| {
        doctor.watch(world);
        if !args.trace.is_empty() && traced.is_ok() {
            traced = print_trace(&mut out, world, &mut trace, &args.trace);
        }
    })?;
    traced?;
    let report = doctor.report();
    if args.json {
        writeln!(out, "{}", report.to_json())?;
    } else {
        writeln!(out, "{report}")?;
    }
    if let Some(folder) = &args.pictures {
        take_pictures(args, subject, folder, &report)?;
    }
    if report.is_healthy() { Ok(()) } else { Err(Failure::without_words()) }
}

fn explain(code: Code) -> Outcome {
    Ok(writeln!(stdout(), "{code}\n\n{}\n\nsee {}", code.explain(), code.page())?)
}

fn print_trace(
    out: &mut impl Write,
    world: &World,
    trace: &mut Trace,
    indices: &[usize],
) -> Outcome {
    for line in trace.lines(world) {
        if [line.a.0, line.b.0].iter().any(|body| indices.contains(&body.index())) {
            writeln!(out, "{line}")?;
        }
    }
    Ok(())
}

/// Plays a scene or a recording and shows the world after each step.
fn each_step(args: &DoctorArgs, subject: &str, mut show: impl FnMut(&World)) -> Outcome {
    if let Some(recording) = recording(subject)? {
        let mut world = World::new(Vec2::ZERO);
        Simulation::equip(&mut world, &args.world)?;
        let mut player = Player::in_world(&recording, world)?;
        while args.steps.is_none_or(|steps| player.at() < steps as usize) && player.step()? {
            show(player.world());
        }
        return Ok(());
    }
    let scene = source::open(subject, args.world.seed)?;
    let steps = args.steps.unwrap_or(scene.steps);
    let mut simulation = Simulation::new(scene, &args.world)?;
    for _ in 0..steps {
        simulation.step();
        show(simulation.world());
    }
    Ok(())
}

/// The recording at a path, if it is one.
fn recording(subject: &str) -> Outcome<Option<Recording>> {
    let path = Path::new(subject);
    if !path.is_file() || path.extension().is_some_and(|extension| extension == "json") {
        return Ok(None);
    }
    let bytes = std::fs::read(path)?;
    let recording = Recording::from_bytes(&bytes);
    recording.map(Some).map_err(|error| Failure::new(format!("{subject}: {error}")))
}

/// Draws the first moments of the findings that are worse than notes.
fn take_pictures(args: &DoctorArgs, subject: &str, folder: &Path, report: &Report) -> Outcome {
    std::fs::create_dir_all(folder).map_err(|error| Failure::cannot_write(folder, &error))?;
    let worse =
        |finding: &&Finding| finding.severity > Severity::Note && !finding.bodies.is_empty();
    let moments: Vec<&Finding> = report.findings.iter().filter(worse).take(PICTURES).collect();
    let mut canvas = Canvas::new(SIZE.0, SIZE.1)?;
    let mut taken = Ok(());
    each_step(args, subject, |world| {
        for finding in moments.iter().filter(|finding| finding.first_step == world.step_count()) {
            let path = folder.join(format!("{:05}-{}.png", finding.first_step, finding.code));
            let drawn = take_picture(&mut canvas, world, finding, &path);
            if taken.is_ok() {
                taken = drawn;
            }
        }
    })?;
    taken
}

fn take_picture(canvas: &mut Canvas, world: &World, finding: &Finding, path: &Path) -> Outcome {
    let Some((center, reach)) = finding.bodies.first().and_then(|who| surroundings(world, who.id))
    else {
        return Ok(());
    };
    let corner = DVec2::new(1.6 * reach, reach);
    let camera = Camera::fit(center - corner, center + corner, SIZE.0, SIZE.1);
    let text = [format!("{}   step {}", finding.code, finding.first_step), finding.what.clone()];
    let overlays = Overlays::debug();
    picture::draw_world(canvas, world, &camera, &overlays, Vec::new());
    mark(canvas, world, &camera, finding);
    picture::draw_notes(canvas, &overlays, &text);
    std::fs::write(path, canvas.to_png()?).map_err(|error| Failure::cannot_write(path, &error))?;
    // Not among the report's lines, which a program may read.
    Ok(writeln!(stderr(), "{}", path.display())?)
}

/// Shows what a finding speaks of: its bodies in colours of their own with their names, the first one also where the step began,
/// the way between, and the anchors of its joints.
fn mark(canvas: &mut Canvas, world: &World, camera: &Camera, finding: &Finding) {
    let near = |point: DVec2| point.relative_to(camera.center);
    canvas.layer(Layer::Contact);
    let bodies = finding.bodies.iter().filter_map(|who| world.body(who.id));
    for (body, color) in bodies.zip([FIRST, SECOND]).filter(|(b, _)| b.kind() != BodyKind::Static) {
        let (from, to) = (body.interpolated_pose(0.0), body.pose());
        for shape in body.shapes().filter_map(|id| world.shape(id)) {
            for (pose, color) in [(from, color.with_alpha(70)), (to, color)] {
                let pose = pose
                    .compose(shape.local())
                    .relative_to(Pose::new(camera.center, Rot::IDENTITY));
                draw_shape(canvas, shape.shape(), &pose, color);
            }
        }
        let way = [from, to].map(|pose| near(pose.apply(body.local_center())));
        canvas.segment(way[0], way[1], color);
        canvas.text(way[1], &body.id().to_string(), color);
    }
    for joint in finding.joints.iter().filter_map(|who| world.joint(who.id)) {
        let (a, b) = joint.anchors();
        canvas.segment(near(a), near(b), FIRST);
        canvas.point(near(a), 7.0, FIRST);
        canvas.point(near(b), 7.0, SECOND);
    }
}

/// Where a body is, and how much around it to show, metres.
fn surroundings(world: &World, id: BodyId) -> Option<(DVec2, f64)> {
    let body = world.body(id)?;
    let shapes = body.shapes().filter_map(|id| world.shape(id));
    let size = shapes.map(|shape| shape.shape().bounding_radius()).fold(0.0, f32::max);
    Some((body.center(), (AROUND.1 * f64::from(size)).max(AROUND.0)))
}
