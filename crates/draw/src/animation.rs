//! GIF animations.

use crate::canvas::Canvas;
use crate::error::DrawError;
use crate::palette::ColorTable;
use gif::{DisposalMethod, Encoder, Frame, Repeat};
use std::io::Write;

/// Writes a GIF frame by frame: one table of colours for all frames, so that nothing flickers, and
/// of each frame only what has changed.
pub struct Animation<W: Write> {
    state: State<W>,
    colors: Option<ColorTable>,
    /// Milliseconds of a frame, and those that frames so far have been shown too short: a GIF counts in hundredths of a second.
    delay: u32,
    owed: u32,
}

/// The header needs the first frame's size and colours.
enum State<W: Write> {
    Waiting(W),
    Running(Box<Running<W>>),
    Failed,
}

struct Running<W: Write> {
    encoder: Encoder<W>,
    table: ColorTable,
    width: usize,
    shown: Vec<u8>,
}

impl<W: Write> Animation<W> {
    /// An endless animation that shows each frame for `delay_ms` milliseconds; players treat less
    /// than 20 as 100.
    pub fn new(writer: W, delay_ms: u32) -> Self {
        let delay = delay_ms.clamp(20, 60_000);
        Self { state: State::Waiting(writer), colors: None, delay, owed: 0 }
    }

    /// The delay of the next frame, hundredths of a second.
    fn next_delay(&mut self) -> u16 {
        self.owed += self.delay;
        let delay = self.owed / 10;
        self.owed %= 10;
        delay as u16
    }

    /// Sets the colours, where not those of the first frame and of debug drawings.
    pub fn colors(mut self, colors: ColorTable) -> Self {
        self.colors = Some(colors);
        self
    }

    /// Adds a frame; all must have the size of the first.
    ///
    /// # Errors
    /// A frame of another size, or what the writer says.
    pub fn add(&mut self, canvas: &Canvas) -> Result<(), DrawError> {
        let delay = self.next_delay();
        match core::mem::replace(&mut self.state, State::Failed) {
            State::Waiting(writer) => {
                let own = || ColorTable::for_frames(canvas.rgb());
                let table = self.colors.take().unwrap_or_else(own);
                let mut running = Running::start(writer, canvas, table)?;
                running.write_first(canvas, delay)?;
                self.state = State::Running(Box::new(running));
            }
            State::Running(mut running) => {
                running.write_change(canvas, delay)?;
                self.state = State::Running(running);
            }
            State::Failed => return Err(DrawError::Encode("an earlier frame failed".into())),
        }
        Ok(())
    }

    /// Lets the last frame be seen for `ms` milliseconds more.
    ///
    /// # Errors
    /// What the writer says.
    pub fn hold(&mut self, ms: u32) -> Result<(), DrawError> {
        if let State::Running(running) = &mut self.state {
            let delay = (ms.clamp(20, 60_000) / 10) as u16;
            let transparent = running.table.len() as u8;
            let frame = Frame {
                delay,
                dispose: DisposalMethod::Keep,
                transparent: Some(transparent),
                width: 1,
                height: 1,
                buffer: vec![transparent].into(),
                ..Frame::default()
            };
            running.encoder.write_frame(&frame).map_err(encode_error)?;
        }
        Ok(())
    }

    /// Ends the file and gives the writer back.
    ///
    /// # Errors
    /// No frame was added, one failed, or the writer does.
    pub fn finish(self) -> Result<W, DrawError> {
        match self.state {
            State::Running(running) => running.encoder.into_inner().map_err(encode_error),
            State::Waiting(_) => Err(DrawError::Encode("an animation without frames".into())),
            State::Failed => Err(DrawError::Encode("an earlier frame failed".into())),
        }
    }
}

impl<W: Write> Running<W> {
    fn start(writer: W, canvas: &Canvas, table: ColorTable) -> Result<Self, DrawError> {
        let (width, height) = (canvas.width() as u16, canvas.height() as u16);
        let mut encoder =
            Encoder::new(writer, width, height, &table.bytes()).map_err(encode_error)?;
        encoder.set_repeat(Repeat::Infinite).map_err(encode_error)?;
        Ok(Self { encoder, table, width: usize::from(width), shown: Vec::new() })
    }

    fn indices(&mut self, canvas: &Canvas) -> Vec<u8> {
        canvas.rgb().map(|color| self.table.nearest(color)).collect()
    }

    fn write_first(&mut self, canvas: &Canvas, delay: u16) -> Result<(), DrawError> {
        self.shown = self.indices(canvas);
        let frame = Frame {
            delay,
            width: self.width as u16,
            height: canvas.height() as u16,
            buffer: self.shown.as_slice().into(),
            ..Frame::default()
        };
        self.encoder.write_frame(&frame).map_err(encode_error)
    }

    fn write_change(&mut self, canvas: &Canvas, delay: u16) -> Result<(), DrawError> {
        let next = self.indices(canvas);
        if next.len() != self.shown.len() || canvas.width() as usize != self.width {
            return Err(DrawError::Encode("frames of different sizes".into()));
        }
        let (left, top, right, bottom) = self.changed(&next);
        // The index after the last colour means "as before".
        let transparent = self.table.len() as u8;
        let mut buffer = Vec::with_capacity((right - left) * (bottom - top));
        for row in top..bottom {
            let line = row * self.width + left..row * self.width + right;
            let pairs = next[line.clone()].iter().zip(&self.shown[line]);
            buffer.extend(pairs.map(|(new, old)| if new == old { transparent } else { *new }));
        }
        self.shown = next;
        let frame = Frame {
            delay,
            dispose: DisposalMethod::Keep,
            transparent: Some(transparent),
            left: left as u16,
            top: top as u16,
            width: (right - left) as u16,
            height: (bottom - top) as u16,
            buffer: buffer.into(),
            ..Frame::default()
        };
        self.encoder.write_frame(&frame).map_err(encode_error)
    }

    /// The box of changed pixels: left, top, right, bottom (the last two exclusive); one pixel where
    /// nothing has changed.
    fn changed(&self, next: &[u8]) -> (usize, usize, usize, usize) {
        let (mut left, mut top, mut right, mut bottom) = (usize::MAX, usize::MAX, 0, 0);
        for (i, (new, old)) in next.iter().zip(&self.shown).enumerate() {
            if new != old {
                let (x, y) = (i % self.width, i / self.width);
                left = left.min(x);
                right = right.max(x + 1);
                top = top.min(y);
                bottom = bottom.max(y + 1);
            }
        }
        if right == 0 { (0, 0, 1, 1) } else { (left, top, right, bottom) }
    }
}

fn encode_error(error: impl core::fmt::Display) -> DrawError {
    DrawError::Encode(error.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Camera;
    use tiny_physics::{Color, DVec2, DebugDraw, Transform, Vec2};

    fn frame(x: f32) -> Canvas {
        let mut canvas = Canvas::new(64, 48).unwrap();
        canvas.begin(&Camera { center: DVec2::ZERO, scale: 8.0, width: 64, height: 48 });
        let pose = Transform::from_angle(Vec2::new(x, 0.0), 0.0);
        canvas.circle(&pose, 1.0, Color::rgb(76, 158, 248));
        canvas
    }

    /// Hundredths of a second that are cut off one frame are given to the next.
    #[test]
    fn frames_take_as_long_together_as_they_should() {
        let mut animation = Animation::new(Vec::new(), 33);
        (0..30).for_each(|i| animation.add(&frame(0.1 * i as f32)).unwrap());
        let bytes = animation.finish().unwrap();
        let mut decoder = gif::DecodeOptions::new().read_info(bytes.as_slice()).unwrap();
        let mut shown = 0;
        while let Some(part) = decoder.read_next_frame().unwrap() {
            shown += u32::from(part.delay);
        }
        assert_eq!(shown, 99);
    }

    #[test]
    fn frames_come_back_as_they_went_in() {
        let mut animation = Animation::new(Vec::new(), 50);
        for x in [-2.0, -2.0, 1.5] {
            animation.add(&frame(x)).unwrap();
        }
        animation.hold(500).unwrap();
        let bytes = animation.finish().unwrap();

        let mut options = gif::DecodeOptions::new();
        options.set_color_output(gif::ColorOutput::RGBA);
        let mut decoder = options.read_info(bytes.as_slice()).unwrap();
        let mut screen = vec![[0_u8; 3]; 64 * 48];
        let mut count = 0;
        while let Some(part) = decoder.read_next_frame().unwrap() {
            count += 1;
            assert_eq!(part.delay, if count == 4 { 50 } else { 5 });
            for (i, p) in part.buffer.chunks_exact(4).enumerate() {
                let (x, y) = (i % usize::from(part.width), i / usize::from(part.width));
                let at = (y + usize::from(part.top)) * 64 + x + usize::from(part.left);
                if p[3] > 0 {
                    screen[at] = [p[0], p[1], p[2]];
                }
            }
        }
        assert_eq!(count, 4);
        for (shown, meant) in screen.iter().zip(frame(1.5).rgb()) {
            let off = (0..3).map(|i| shown[i].abs_diff(meant[i])).max();
            assert!(off <= Some(24), "{shown:?} for {meant:?}");
        }
    }

    #[test]
    fn sizes_must_agree_and_a_frame_there_must_be() {
        assert!(Animation::new(Vec::new(), 20).finish().is_err());
        let mut animation = Animation::new(Vec::new(), 20);
        animation.add(&frame(0.0)).unwrap();
        assert!(animation.add(&Canvas::new(32, 32).unwrap()).is_err());
        assert!(animation.finish().is_err());
    }
}
