//! Charts and pictures of worlds, the three engines beside each other.

use crate::svg::{Anchor, Stroke, Svg};
use peers_worker::Tape;
use std::path::Path;

/// The engines in the order of all lists here: name, colour of lines, colour of bodies, dashes.
///
/// The colours can be told apart by those who see few of them (Okabe and Ito, 2008).
pub const ENGINES: [(&str, &str, &str, &str); 3] = [
    ("tiny-physics", "#0072b2", "#b5d8ee", ""),
    ("Box2D", "#d55e00", "#f6d3b8", ""),
    ("Rapier", "#009e73", "#b4e3d5", "7 4"),
];

const INK: &str = "#222222";
const FAINT: &str = "#e4e4e4";
const GRID: Stroke = Stroke { color: FAINT, width: 1.0, dashes: "" };
const WIDTH: f64 = 860.0;

/// The points of one engine's line.
pub type Series = Vec<(f64, f64)>;

/// What an axis shows.
#[derive(Clone, Copy)]
pub struct Axis {
    label: &'static str,
    from: f64,
    to: f64,
    log: bool,
}

impl Axis {
    /// An axis with even steps.
    pub fn linear(label: &'static str, from: f64, to: f64) -> Self {
        Self { label, from, to, log: false }
    }

    /// An axis on which each step is ten times the last; `from` and `to` are powers of ten. What is less than
    /// `from` is drawn at the edge.
    pub fn log(label: &'static str, from: f64, to: f64) -> Self {
        Self { label, from, to, log: true }
    }

    /// Where a value is: 0 at the start of the axis, 1 at its end, never outside.
    fn part(&self, value: f64) -> f64 {
        let part = if self.log {
            (value.max(self.from) / self.from).ln() / (self.to / self.from).ln()
        } else {
            (value - self.from) / (self.to - self.from)
        };
        part.clamp(0.0, 1.0)
    }

    fn ticks(&self) -> Vec<f64> {
        if self.log {
            let decades = (self.to / self.from).log10().round() as i32;
            return (0..=decades).map(|i| self.from * 10.0_f64.powi(i)).collect();
        }
        let rough = (self.to - self.from) / 5.0;
        let power = 10.0_f64.powf(rough.log10().floor());
        let step = [1.0, 2.0, 5.0, 10.0].map(|k| k * power).into_iter().find(|&s| s >= rough);
        let step = step.unwrap_or(rough);
        let count = ((self.to - self.from) / step + 1e-9) as u32;
        (0..=count).map(|i| self.from + step * f64::from(i)).collect()
    }
}

/// A number at a tick.
fn tick_text(value: f64) -> String {
    let digits = if value == 0.0 { 0 } else { (-value.abs().log10().floor()).max(0.0) as usize };
    let text = format!("{value:.digits$}");
    match text.strip_suffix("000") {
        Some(thousands) if !text.contains('.') && !thousands.is_empty() => {
            format!("{thousands},000")
        }
        _ => text,
    }
}

/// One chart: a line an engine.
pub struct Chart<'a> {
    /// What the lines are.
    pub title: &'a str,
    /// Across.
    pub x: Axis,
    /// Upwards.
    pub y: Axis,
    /// In the order of [`ENGINES`].
    pub series: &'a [Series],
}

/// Draws charts beside each other, with one legend.
///
/// # Errors
/// The file cannot be written.
pub fn charts(path: &Path, title: &str, charts: &[Chart<'_>]) -> Result<(), String> {
    let mut svg = Svg::new(WIDTH, 380.0);
    head(&mut svg, title);
    let width = WIDTH / charts.len() as f64;
    for (i, chart) in charts.iter().enumerate() {
        let left = width * i as f64;
        panel(&mut svg, chart, (left + 62.0, 84.0), (width - 84.0, 240.0));
    }
    svg.save(path)
}

/// The title, and the engines' names with their colours.
fn head(svg: &mut Svg, title: &str) {
    svg.text((20.0, 28.0), 17.0, Anchor::Start, INK, title);
    legend(svg, svg.width() - 330.0, 52.0 - 4.0, true);
}

fn legend(svg: &mut Svg, mut x: f64, y: f64, lines: bool) {
    for (name, color, _, dashes) in ENGINES {
        if lines {
            let stroke = Stroke { color, width: 3.0, dashes };
            svg.line(&[(x, y), (x + 26.0, y)], stroke);
        } else {
            svg.disk((x + 18.0, y), 5.0, color, Stroke { color, width: 1.0, dashes: "" });
        }
        svg.text((x + 32.0, y + 4.5), 13.0, Anchor::Start, INK, name);
        x += 54.0 + 7.0 * name.len() as f64;
    }
}

fn panel(svg: &mut Svg, chart: &Chart<'_>, corner: (f64, f64), size: (f64, f64)) {
    let (left, top) = corner;
    let (right, bottom) = (left + size.0, top + size.1);
    let x = |value| left + size.0 * chart.x.part(value);
    let y = |value| bottom - size.1 * chart.y.part(value);
    svg.text((left, top - 12.0), 13.5, Anchor::Start, INK, chart.title);
    for tick in chart.x.ticks() {
        svg.line(&[(x(tick), top), (x(tick), bottom)], GRID);
        svg.text((x(tick), bottom + 18.0), 12.0, Anchor::Middle, INK, &tick_text(tick));
    }
    for tick in chart.y.ticks() {
        svg.line(&[(left, y(tick)), (right, y(tick))], GRID);
        svg.text((left - 8.0, y(tick) + 4.0), 12.0, Anchor::End, INK, &tick_text(tick));
    }
    svg.text(((left + right) * 0.5, bottom + 38.0), 12.5, Anchor::Middle, INK, chart.x.label);
    // Ours last, so that it lies on top.
    for (series, (_, color, _, dashes)) in chart.series.iter().zip(ENGINES).rev() {
        let points: Vec<_> = series.iter().map(|&(px, py)| (x(px), y(py))).collect();
        svg.line(&points, Stroke { color, width: 2.5, dashes });
    }
    let frame = [(left, top), (left, bottom), (right, bottom)];
    svg.line(&frame, Stroke { color: INK, width: 1.2, dashes: "" });
}

/// The part of a world that is drawn, metres.
pub struct Window {
    /// Left and right edge.
    pub x: (f64, f64),
    /// Lower and upper edge.
    pub y: (f64, f64),
    /// Radius of a dashed circle around the origin, and what it stands for.
    pub circle: Option<(f64, &'static str)>,
}

/// Draws a frame of a world in each engine, in the order of [`ENGINES`]; `None` where there is none.
///
/// # Errors
/// The file cannot be written.
pub fn worlds(
    path: &Path,
    title: &str,
    window: &Window,
    views: &[Option<(&Tape, usize)>],
) -> Result<(), String> {
    const TOP: f64 = 74.0;
    const GAP: f64 = 14.0;
    let panel_width = (WIDTH - GAP * 4.0) / 3.0;
    let scale = panel_width / (window.x.1 - window.x.0);
    let panel_height = scale * (window.y.1 - window.y.0);
    let mut svg = Svg::new(WIDTH, TOP + panel_height + 20.0);
    svg.text((GAP, 28.0), 17.0, Anchor::Start, INK, title);
    if let Some((_, meaning)) = window.circle {
        svg.text((WIDTH - GAP, 28.0), 12.5, Anchor::End, INK, &format!("dashed: {meaning}"));
    }
    for (i, view) in views.iter().enumerate() {
        let left = GAP + (panel_width + GAP) * i as f64;
        let (name, color, fill, _) = ENGINES[i % ENGINES.len()];
        svg.text((left, TOP - 14.0), 14.0, Anchor::Start, color, name);
        let at = |x: f64, y: f64| (left + scale * (x - window.x.0), TOP + scale * (window.y.1 - y));
        svg.clip(i, (left, TOP), (panel_width, panel_height));
        let corners = [(left, TOP), (left + panel_width, TOP)];
        let floor = TOP + panel_height;
        let corners = [corners[0], corners[1], (corners[1].0, floor), (left, floor)];
        svg.polygon(&corners, "#fafafa", FAINT);
        if let Some((tape, frame)) = view {
            bodies(&mut svg, tape, *frame, at, (fill, color));
        }
        if let Some((radius, _)) = window.circle {
            let stroke = Stroke { color: INK, width: 1.0, dashes: "4 4" };
            svg.disk(at(0.0, 0.0), scale * radius, "none", stroke);
        }
        svg.end_clip();
    }
    svg.save(path)
}

/// The bodies of a frame; the last frame where the tape is shorter. Body 0 stands still.
fn bodies(
    svg: &mut Svg,
    tape: &Tape,
    frame: usize,
    at: impl Fn(f64, f64) -> (f64, f64),
    (fill, edge): (&str, &str),
) {
    let Some(poses) = tape.frames.get(frame).or(tape.frames.last()) else { return };
    for (i, (shapes, pose)) in tape.bodies.iter().zip(poses).enumerate() {
        let Some(pose) = pose else { continue };
        let [x, y, angle] = pose.map(f64::from);
        let (s, c) = angle.sin_cos();
        let (fill, edge) = if i == 0 { ("#cfcfcf", "#9a9a9a") } else { (fill, edge) };
        for shape in shapes {
            let corner = |&[px, py]: &[f32; 2]| {
                let (px, py) = (f64::from(px), f64::from(py));
                at(x + c * px - s * py, y + s * px + c * py)
            };
            svg.polygon(&shape.iter().map(corner).collect::<Vec<_>>(), fill, edge);
        }
    }
}

/// One line of [`overview`]: a row, and how much of its target each engine uses up, in the order of [`ENGINES`].
/// `None` where an engine cannot express the row, infinite where it lost the scene.
pub struct Dots {
    /// The row.
    pub name: String,
    /// Up to 1 passes.
    pub used: [Option<f64>; 3],
}

/// Draws how far each engine is from each row's target.
///
/// # Errors
/// The file cannot be written.
pub fn overview(path: &Path, rows: &[Dots]) -> Result<(), String> {
    const PITCH: f64 = 22.0;
    let (left, right, top) = (190.0, WIDTH - 40.0, 100.0);
    let bottom = top + PITCH * rows.len() as f64;
    let axis = Axis::log("", 0.001, 1000.0);
    let x = |used: f64| left + (right - left) * axis.part(used);
    let mut svg = Svg::new(WIDTH, bottom + 56.0);
    svg.text(
        (20.0, 28.0),
        17.0,
        Anchor::Start,
        INK,
        "How much of what its target allows each row uses up",
    );
    legend(&mut svg, WIDTH - 340.0, 52.0, false);
    let good = [(left, top), (x(1.0), top), (x(1.0), bottom), (left, bottom)];
    svg.polygon(&good, "#f1f7ee", "none");
    for tick in axis.ticks() {
        svg.line(&[(x(tick), top), (x(tick), bottom)], GRID);
        svg.text((x(tick), bottom + 18.0), 12.0, Anchor::Middle, INK, &tick_text(tick));
    }
    let note =
        "times what the target allows; a cross fell apart, or is not 0 where 0 is the target";
    svg.text((WIDTH - 40.0, bottom + 40.0), 12.0, Anchor::End, INK, note);
    svg.line(
        &[(x(1.0), top - 6.0), (x(1.0), bottom)],
        Stroke { color: INK, width: 1.5, dashes: "" },
    );
    svg.text((x(1.0) - 8.0, top - 10.0), 12.5, Anchor::End, INK, "meets the target");
    svg.text((x(1.0) + 8.0, top - 10.0), 12.5, Anchor::Start, INK, "misses it");
    for (i, row) in rows.iter().enumerate() {
        let y = top + PITCH * (i as f64 + 0.5);
        svg.text((left - 14.0, y + 4.5), 12.5, Anchor::End, INK, &row.name);
        svg.line(&[(left, y), (right, y)], GRID);
        for (k, (used, (_, color, ..))) in row.used.iter().zip(ENGINES).enumerate().rev() {
            let Some(used) = used else { continue };
            // Apart, so that equal ones can be seen.
            let at = (x(*used), y + 5.0 * (k as f64 - 1.0));
            if used.is_finite() {
                svg.disk(at, 4.0, color, Stroke { color: "white", width: 0.8, dashes: "" });
            } else {
                let stroke = Stroke { color, width: 2.5, dashes: "" };
                svg.line(&[(at.0 - 4.0, at.1 - 4.0), (at.0 + 4.0, at.1 + 4.0)], stroke);
                svg.line(&[(at.0 - 4.0, at.1 + 4.0), (at.0 + 4.0, at.1 - 4.0)], stroke);
            }
        }
    }
    svg.save(path)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_place_values_and_ticks() {
        let log = Axis::log("", 0.01, 100.0);
        assert!((log.part(1.0) - 0.5).abs() < 1e-12);
        assert_eq!([log.part(0.0), log.part(f64::INFINITY)], [0.0, 1.0]);
        assert_eq!(
            log.ticks().iter().map(|&t| tick_text(t)).collect::<Vec<_>>(),
            ["0.01", "0.1", "1", "10", "100"]
        );
        let linear = Axis::linear("", 0.0, 11.0);
        assert_eq!(linear.part(5.5), 0.5);
        assert_eq!(linear.ticks(), [0.0, 5.0, 10.0]);
        assert_eq!(tick_text(10_000.0), "10,000");
    }
}
