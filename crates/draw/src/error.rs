//! What can go wrong while drawing.

use core::fmt;

/// Why a picture or window could not be made.
#[derive(Debug)]
#[non_exhaustive]
pub enum DrawError {
    /// Width and height are not within 16 to 16384 pixels.
    Size {
        /// Pixels.
        width: u32,
        /// Pixels.
        height: u32,
    },
    /// A PNG or GIF could not be encoded or written.
    Encode(String),
    /// No window could be opened; mostly there is no display.
    Window(String),
}

impl fmt::Display for DrawError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Size { width, height } => {
                write!(f, "a picture of {width}x{height} pixels; allowed is 16 to 16384 each way")
            }
            Self::Encode(why) => write!(f, "the picture could not be written: {why}"),
            Self::Window(why) => write!(f, "no window could be opened: {why}"),
        }
    }
}

impl std::error::Error for DrawError {}
