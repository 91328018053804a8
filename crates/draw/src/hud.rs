//! What lies on top of a picture: lines of text and the legend.

use crate::canvas::Canvas;
use crate::font::{self, LETTER_WIDTH, LINE_HEIGHT};
use tiny_physics::{Color, DEPTH_SCALE, Layer, Palette, depth_color};

const INK: Color = Color::rgb(226, 230, 238);
const FAINT: Color = Color::rgb(150, 158, 172);
const PANEL: Color = Color::rgb(8, 10, 14).with_alpha(190);
/// Distance of panels from the edge, and of text from the edge of its panel, pixels.
const MARGIN: i32 = 10;
/// Width of the legend's colour bar, pixels.
const BAR_WIDTH: i32 = 260;

impl Canvas {
    /// Height that the legend takes along the lower edge, pixels.
    pub const LEGEND_HEIGHT: u32 = 78;

    /// Height that so many lines of [`Canvas::status`] take along the upper edge, pixels.
    pub const fn status_height(lines: u32) -> u32 {
        if lines == 0 { 0 } else { lines * LINE_HEIGHT as u32 + MARGIN as u32 }
    }

    /// Lines of text in a strip of their own along the upper edge; the first stands out.
    pub fn status<S: AsRef<str>>(&mut self, lines: &[S]) {
        let [paper, ink] = self.note;
        self.strip = Self::status_height(lines.len() as u32) as i32;
        self.fill_rect(0.0, 0.0, self.width() as f32, self.strip as f32, paper);
        for (i, line) in lines.iter().enumerate() {
            let color = if i == 0 { ink } else { ink.mix(paper, 0.3) };
            let y = MARGIN / 2 + i as i32 * LINE_HEIGHT;
            font::draw(&mut self.pixmap, MARGIN, y, line.as_ref(), color);
        }
    }

    /// Lines of text on the picture, in its upper right corner.
    pub fn side_text<S: AsRef<str>>(&mut self, lines: &[S]) {
        let widest = lines.iter().map(|line| font::width(line.as_ref())).max().unwrap_or(0);
        let x = self.width() as i32 - widest - 3 * MARGIN;
        self.text_panel(x, self.strip + MARGIN, lines);
    }

    /// The legend in a strip along the lower edge: the colours of bodies, and the scale of penetration depth.
    /// Pictures that are too small for it go without.
    pub fn legend(&mut self, palette: &Palette) {
        let (width, height) = (self.width() as i32, self.height() as i32);
        let bar_panel = BAR_WIDTH + 4 * MARGIN;
        if height < 160 || width < bar_panel + 2 * MARGIN {
            return;
        }
        let strip = Self::LEGEND_HEIGHT as f32;
        self.fill_rect(0.0, height as f32 - strip, width as f32, strip, self.note[0]);
        self.depth_legend(width - bar_panel - MARGIN, height - MARGIN);
        let names = [
            ("static", Layer::Static),
            ("kinematic", Layer::Kinematic),
            ("dynamic", Layer::Awake),
            ("asleep", Layer::Asleep),
        ];
        let swatch = LINE_HEIGHT - 5;
        let room: i32 = names.iter().map(|(name, _)| font::width(name) + swatch + 22).sum();
        if width < bar_panel + room + 5 * MARGIN {
            return;
        }
        let top = height - MARGIN - LINE_HEIGHT - MARGIN;
        self.panel(MARGIN, top, room + MARGIN, LINE_HEIGHT + MARGIN);
        let mut x = 2 * MARGIN;
        for (name, layer) in names {
            let color = palette.color(layer);
            let y = top + MARGIN / 2 + 2;
            self.fill_rect(x as f32, y as f32, swatch as f32, swatch as f32, color);
            self.fill_rect(
                x as f32 + 1.5,
                y as f32 + 1.5,
                swatch as f32 - 3.0,
                swatch as f32 - 3.0,
                color.mix(Self::BACKGROUND, 0.45),
            );
            x += swatch + 6;
            font::draw(&mut self.pixmap, x, top + MARGIN / 2, name, FAINT);
            x += font::width(name) + 16;
        }
    }

    /// The colour bar of penetration depth, with its lower left corner at a pixel. Each stretch
    /// between two marks of the scale is equally long.
    fn depth_legend(&mut self, left: i32, bottom: i32) {
        let height = 2 * LINE_HEIGHT + 14 + MARGIN;
        let top = bottom - height;
        self.panel(left, top, BAR_WIDTH + 4 * MARGIN, height);
        let x0 = left + 2 * MARGIN;
        font::draw(&mut self.pixmap, x0, top + MARGIN / 2, "penetration depth (mm)", FAINT);
        let bar_y = top + MARGIN / 2 + LINE_HEIGHT + 2;
        let stretches = DEPTH_SCALE.len() - 1;
        for x in 0..BAR_WIDTH {
            let along = x as f32 / BAR_WIDTH as f32 * stretches as f32;
            let i = (along as usize).min(stretches - 1);
            let (lower, upper) = (DEPTH_SCALE[i].0, DEPTH_SCALE[i + 1].0);
            let color = depth_color(lower + (upper - lower) * (along - i as f32));
            self.fill_rect((x0 + x) as f32, bar_y as f32, 1.0, 10.0, color);
        }
        for (i, (depth, _)) in DEPTH_SCALE.iter().enumerate() {
            let label = format!("{:.0}", depth * 1000.0);
            let at = x0 + BAR_WIDTH * i as i32 / stretches as i32;
            let x = at - font::width(&label) / 2;
            font::draw(&mut self.pixmap, x, bar_y + 11, &label, INK);
        }
    }

    fn text_panel<S: AsRef<str>>(&mut self, x: i32, y: i32, lines: &[S]) {
        let widest = lines.iter().map(|line| line.as_ref().chars().count()).max().unwrap_or(0);
        if widest == 0 {
            return;
        }
        let width = widest as i32 * LETTER_WIDTH + 2 * MARGIN;
        self.panel(x, y, width, lines.len() as i32 * LINE_HEIGHT + MARGIN);
        for (i, line) in lines.iter().enumerate() {
            let color = if i == 0 { INK } else { FAINT };
            let line_y = y + MARGIN / 2 + i as i32 * LINE_HEIGHT;
            font::draw(&mut self.pixmap, x + MARGIN, line_y, line.as_ref(), color);
        }
    }

    fn panel(&mut self, x: i32, y: i32, width: i32, height: i32) {
        self.fill_rect(x as f32, y as f32, width as f32, height as f32, PANEL);
    }
}
