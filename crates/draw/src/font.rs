//! Text on pixels: Noto Sans Mono, drawn beforehand at 16 pixels.

use noto_sans_mono_bitmap::{FontWeight, RasterHeight, get_raster, get_raster_width};
use tiny_physics::Color;
use tiny_skia::{Pixmap, PremultipliedColorU8};

/// Height of a line, pixels.
pub const LINE_HEIGHT: i32 = 17;

/// Width of every letter, pixels.
pub const LETTER_WIDTH: i32 = get_raster_width(FontWeight::Regular, RasterHeight::Size16) as i32;

/// Width of a text, pixels.
pub fn width(text: &str) -> i32 {
    text.chars().count() as i32 * LETTER_WIDTH
}

/// Draws one line with its upper left corner at a pixel; what lies outside is cut off. Letters that
/// the font lacks come as `?`.
pub fn draw(pixmap: &mut Pixmap, x: i32, y: i32, text: &str, color: Color) {
    for (i, letter) in text.chars().enumerate() {
        let find = |c| get_raster(c, FontWeight::Regular, RasterHeight::Size16);
        let Some(raster) = find(letter).or_else(|| find('?')) else { continue };
        for (row, line) in raster.rows().enumerate() {
            for (column, &strength) in line.iter().enumerate() {
                let at_x = x + i as i32 * LETTER_WIDTH + column as i32;
                blend(pixmap, at_x, y + row as i32, color, strength);
            }
        }
    }
}

/// Lays a colour over one pixel, `strength` 0 to 255 on top of the colour's own opacity.
fn blend(pixmap: &mut Pixmap, x: i32, y: i32, color: Color, strength: u8) {
    let (width, height) = (pixmap.width() as i32, pixmap.height() as i32);
    if strength == 0 || x < 0 || y < 0 || x >= width || y >= height {
        return;
    }
    let alpha = u32::from(strength) * u32::from(color.a) / 255;
    let pixel = &mut pixmap.pixels_mut()[(y * width + x) as usize];
    let over = |below: u8, above: u8| {
        ((u32::from(below) * (255 - alpha) + u32::from(above) * alpha + 127) / 255) as u8
    };
    let (r, g, b) =
        (over(pixel.red(), color.r), over(pixel.green(), color.g), over(pixel.blue(), color.b));
    let a = over(pixel.alpha(), 255);
    if let Some(mixed) = PremultipliedColorU8::from_rgba(r.min(a), g.min(a), b.min(a), a) {
        *pixel = mixed;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_leaves_ink_and_never_leaves_the_picture() {
        let mut pixmap = Pixmap::new(64, 20).unwrap();
        draw(&mut pixmap, 2, 2, "A", Color::WHITE);
        assert!(pixmap.pixels().iter().any(|p| p.alpha() > 128));
        draw(&mut pixmap, -20, -5, "outside \u{1f600}", Color::WHITE);
        draw(&mut pixmap, 60, 15, "outside", Color::WHITE);
    }
}
