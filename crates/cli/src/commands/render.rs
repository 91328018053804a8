//! `render`: a scene into a PNG or GIF.

use crate::args::{Area, RenderArgs};
use crate::failure::{Failure, Outcome};
use crate::picture::{self, Follower, Overlays};
use crate::preview::{Moment, Preview};
use crate::progress::Progress;
use crate::simulation::Simulation;
use crate::source;
use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};
use tiny_physics_draw::{Animation, Camera, Canvas, ColorTable};

/// Draws every so many steps of an animation, where not said: 30 frames a second.
const USUAL_EVERY: u32 = 2;

/// How long an animation stays at its end, milliseconds.
const HOLD_MS: u32 = 800;

#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Format {
    Png,
    Gif,
}

/// Runs the scene and writes the file.
///
/// # Errors
/// No such scene, an extension other than png or gif, a file that cannot be written.
pub fn run(args: &RenderArgs) -> Outcome {
    let format = format_of(&args.output)?;
    let scene = source::open(&args.scene, args.world.seed)?;
    let steps = args.steps.unwrap_or(scene.steps);
    if args.from > steps {
        let range =
            format!("the run has {steps} steps, of which none comes after --from {}", args.from);
        return Err(Failure::new(range).hint("raise --steps"));
    }
    let size = args.size.unwrap_or(match format {
        Format::Png => (1280, 720),
        Format::Gif => (640, 360),
    });
    let overlays = Overlays::of(args.looks).but(&args.show, &args.hide);
    let one = format == Format::Png && args.every.is_none();
    let first = if one { steps } else { args.from };
    let preview = Preview::of(scene.clone(), &args.world, first..=steps)?;
    let Preview { framing, moments, end } = preview;
    end.all_done()?;
    let simulation = if one { end } else { Simulation::new(scene, &args.world)? };
    let eye = match args.area {
        Some(Area { min, max }) => {
            let (min, max) = (min.into(), max.into());
            Follower::fixed(Camera::fit_between(min, max, size, overlays.room()))
        }
        None => Follower::on(&simulation, &framing, size, overlays.room()),
    };
    let canvas = Canvas::new(size.0, size.1)?;
    let mut film = Film { simulation, eye, canvas, overlays, from: args.from };
    match (format, args.every) {
        (Format::Gif, every) => {
            let colors = film.colors(&moments, args.colors)?;
            film.gif(&args.output, steps, every.unwrap_or(USUAL_EVERY), colors)
        }
        (Format::Png, None) => film.png(&args.output, steps),
        (Format::Png, Some(every)) => film.series(&args.output, steps, every),
    }
}

fn format_of(path: &Path) -> Outcome<Format> {
    let extension = path.extension().map(|e| e.to_string_lossy().to_lowercase());
    match extension.as_deref() {
        Some("png") => Ok(Format::Png),
        Some("gif") => Ok(Format::Gif),
        _ => Err(Failure::new(format!("'{}' is neither .png nor .gif", path.display()))
            .hint("name the output like 'out.png' or 'out.gif'")),
    }
}

struct Film {
    simulation: Simulation,
    eye: Follower,
    canvas: Canvas,
    overlays: Overlays,
    /// Steps before this one are left out.
    from: u32,
}

impl Film {
    fn draw(&mut self) {
        self.eye.follow(&self.simulation);
        let camera = &self.eye.camera;
        picture::draw(&mut self.canvas, &self.simulation, camera, &self.overlays, "");
    }

    /// The colours of the whole animation, from moments of it.
    fn colors(&mut self, moments: &[Moment], most: u16) -> Outcome<ColorTable> {
        let (mut eye, overlays) = (self.eye, self.overlays);
        let mut colors = Vec::new();
        for (world, middle) in moments {
            eye.look_at(*middle);
            let waters = self.simulation.waters();
            picture::draw_world(&mut self.canvas, world, &eye.camera, &overlays, waters);
            picture::draw_notes(&mut self.canvas, &overlays, &[" ".into()]);
            colors.extend(self.canvas.rgb());
        }
        Ok(ColorTable::of(colors, most.into()))
    }

    /// Where the run is.
    fn png(&mut self, path: &Path, steps: u32) -> Outcome {
        self.draw();
        self.write_png(path)?;
        report(path, &format!("step {steps}"))
    }

    /// Every so many steps a picture with the step's number in its name.
    fn series(&mut self, path: &Path, steps: u32, every: u32) -> Outcome {
        let progress = Progress::new(steps);
        let mut count = 0;
        for step in 0..=steps {
            if step > 0 {
                self.simulation.step();
            }
            if step >= self.from && (step - self.from).is_multiple_of(every) {
                self.draw();
                self.write_png(&numbered(path, step))?;
                count += 1;
            }
            progress.at(step);
        }
        progress.finish();
        report(&numbered(path, self.from), &format!("and so on, {count} pictures"))
    }

    fn write_png(&self, path: &Path) -> Outcome {
        let png = self.canvas.to_png()?;
        std::fs::write(path, png).map_err(|error| Failure::cannot_write(path, &error))
    }

    /// An animation of every so many steps.
    fn gif(&mut self, path: &Path, steps: u32, every: u32, colors: ColorTable) -> Outcome {
        let file = File::create(path).map_err(|error| Failure::cannot_write(path, &error))?;
        let delay_ms = self.simulation.dt() * 1000.0 * every as f32;
        let file = BufWriter::new(file);
        let mut animation = Animation::new(file, delay_ms.round() as u32).colors(colors);
        let progress = Progress::new(steps);
        let mut count = 0;
        for step in 0..=steps {
            if step > 0 {
                self.simulation.step();
            }
            if step >= self.from && (step - self.from).is_multiple_of(every) {
                self.draw();
                count += 1;
                animation.add(&self.canvas)?;
            }
            progress.at(step);
        }
        progress.finish();
        animation.hold(HOLD_MS)?;
        animation.finish()?.flush().map_err(|error| Failure::cannot_write(path, &error))?;
        report(path, &format!("{count} frames"))
    }
}

fn report(path: &Path, what: &str) -> Outcome {
    Ok(writeln!(std::io::stdout(), "{} ({what})", path.display())?)
}

/// `out.png` becomes `out_00042.png`.
fn numbered(path: &Path, step: u32) -> PathBuf {
    let stem = path.file_stem().map(|s| s.to_string_lossy()).unwrap_or_default();
    path.with_file_name(format!("{stem}_{step:05}.png"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formats_come_from_the_name() {
        assert_eq!(format_of(Path::new("a/b.PNG")).unwrap(), Format::Png);
        assert_eq!(format_of(Path::new("b.gif")).unwrap(), Format::Gif);
        assert!(format_of(Path::new("b.jpg")).unwrap_err().to_string().contains("hint"));
        assert!(format_of(Path::new("png")).is_err());
    }

    #[test]
    fn pictures_of_a_series_are_numbered() {
        assert_eq!(numbered(Path::new("x/out.png"), 42), Path::new("x/out_00042.png"));
    }
}
