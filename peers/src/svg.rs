//! Just enough SVG.

use std::fmt::Write;
use std::path::Path;

/// Where a text is held.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Anchor {
    /// At its start.
    Start,
    /// In its middle.
    Middle,
    /// At its end.
    End,
}

/// How a line looks.
#[derive(Clone, Copy)]
pub struct Stroke {
    /// Colour as in CSS.
    pub color: &'static str,
    /// Pixels.
    pub width: f64,
    /// Lengths of dashes and gaps as in SVG; empty for none.
    pub dashes: &'static str,
}

/// A picture; the origin is at the top left, pixels.
pub struct Svg {
    width: f64,
    height: f64,
    body: String,
}

impl Svg {
    /// An empty white picture.
    pub fn new(width: f64, height: f64) -> Self {
        Self { width, height, body: String::new() }
    }

    /// Width, pixels.
    pub fn width(&self) -> f64 {
        self.width
    }

    // Writing to a string cannot fail, so results of `write!` are dropped here.

    /// A line of text; `at` is on its baseline.
    pub fn text(&mut self, at: (f64, f64), size: f64, anchor: Anchor, color: &str, text: &str) {
        let anchor = match anchor {
            Anchor::Start => "start",
            Anchor::Middle => "middle",
            Anchor::End => "end",
        };
        let text = text.replace('&', "&amp;").replace('<', "&lt;");
        let (x, y) = at;
        let _ = writeln!(
            self.body,
            r#"<text x="{x:.1}" y="{y:.1}" font-size="{size}" text-anchor="{anchor}" fill="{color}">{text}</text>"#
        );
    }

    /// A line through points.
    pub fn line(&mut self, points: &[(f64, f64)], stroke: Stroke) {
        let points = list(points);
        let Stroke { color, width, dashes } = stroke;
        let _ = writeln!(
            self.body,
            r#"<polyline points="{points}" fill="none" stroke="{color}" stroke-width="{width}" stroke-dasharray="{dashes}" stroke-linejoin="round"/>"#
        );
    }

    /// A filled polygon with a thin edge.
    pub fn polygon(&mut self, points: &[(f64, f64)], fill: &str, edge: &str) {
        let points = list(points);
        let _ = writeln!(
            self.body,
            r#"<polygon points="{points}" fill="{fill}" stroke="{edge}" stroke-width="0.8"/>"#
        );
    }

    /// A disk; without `fill` a ring.
    pub fn disk(&mut self, (x, y): (f64, f64), radius: f64, fill: &str, stroke: Stroke) {
        let Stroke { color, width, dashes } = stroke;
        let _ = writeln!(
            self.body,
            r#"<circle cx="{x:.1}" cy="{y:.1}" r="{radius:.1}" fill="{fill}" stroke="{color}" stroke-width="{width}" stroke-dasharray="{dashes}"/>"#
        );
    }

    /// From here to [`Svg::end_clip`] only what lies in this rectangle shows. `number` is this picture's own for it.
    pub fn clip(&mut self, number: usize, (x, y): (f64, f64), (width, height): (f64, f64)) {
        let _ = writeln!(
            self.body,
            r##"<clipPath id="c{number}"><rect x="{x}" y="{y}" width="{width}" height="{height}"/></clipPath><g clip-path="url(#c{number})">"##
        );
    }

    /// Ends the last clip.
    pub fn end_clip(&mut self) {
        self.body += "</g>\n";
    }

    /// Writes the picture.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn save(&self, path: &Path) -> Result<(), String> {
        let (width, height, body) = (self.width, self.height, &self.body);
        let text = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
             viewBox=\"0 0 {width} {height}\" font-family=\"DejaVu Sans, Verdana, Arial, sans-serif\">\n\
             <rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n{body}</svg>\n"
        )
        .replace(" stroke-dasharray=\"\"", "");
        std::fs::write(path, text).map_err(|error| format!("{}: {error}", path.display()))?;
        eprintln!("written: {}", path.display());
        Ok(())
    }
}

fn list(points: &[(f64, f64)]) -> String {
    points.iter().map(|(x, y)| format!("{x:.1},{y:.1}")).collect::<Vec<_>>().join(" ")
}
