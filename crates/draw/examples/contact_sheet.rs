//! Frames of a GIF side by side in one PNG, to look an animation over at a glance:
//! `cargo run -p tiny-physics-draw --example contact_sheet -- 6 sheet.png a.gif b.gif`, so many frames of each.

use tiny_physics_draw::Canvas;

type Pixels = Vec<[u8; 3]>;
type Failing<T> = Result<T, Box<dyn std::error::Error>>;

fn main() -> Failing<()> {
    let mut arguments = std::env::args().skip(1);
    let (count, sheet) = arguments.next().zip(arguments.next()).ok_or("how many, and where to?")?;
    let count: usize = count.parse()?;
    let (mut width, mut rows) = (0, Vec::new());
    for path in arguments {
        let (size, frames) = frames(&path)?;
        let shown = (0..count).map(|i| &frames[i * (frames.len() - 1) / (count - 1).max(1)]);
        let row: Pixels = (0..size.1)
            .flat_map(|y| shown.clone().flat_map(move |f| &f[y * size.0..(y + 1) * size.0]))
            .copied()
            .collect();
        width = width.max(size.0 * count);
        rows.push((size.0 * count, row));
    }
    let mut all = Pixels::new();
    for (own, row) in rows {
        for line in row.chunks(own) {
            all.extend(line);
            all.extend(core::iter::repeat_n([255; 3], width - own));
        }
    }
    let canvas = Canvas::from_rgb(width as u32, (all.len() / width) as u32, &all)?;
    Ok(std::fs::write(sheet, canvas.to_png()?)?)
}

/// Width, height, and all frames as they are seen.
fn frames(path: &str) -> Failing<((usize, usize), Vec<Pixels>)> {
    let mut options = gif::DecodeOptions::new();
    options.set_color_output(gif::ColorOutput::RGBA);
    let mut decoder = options.read_info(std::fs::File::open(path)?)?;
    let (width, height) = (usize::from(decoder.width()), usize::from(decoder.height()));
    let mut screen = vec![[0_u8; 3]; width * height];
    let mut frames = Vec::new();
    while let Some(part) = decoder.read_next_frame()? {
        for (i, p) in part.buffer.chunks_exact(4).enumerate() {
            let (x, y) = (i % usize::from(part.width), i / usize::from(part.width));
            if p[3] > 0 {
                screen[(y + usize::from(part.top)) * width + x + usize::from(part.left)] =
                    [p[0], p[1], p[2]];
            }
        }
        frames.push(screen.clone());
    }
    Ok(((width, height), frames))
}
