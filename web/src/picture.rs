//! A picture as rows of numbers.

/// Rows of the last picture.
#[derive(Clone, Default)]
pub(crate) struct Picture {
    /// Rounded boxes: place (2), cosine, sine, half extents (2), radius, style, body, tint.
    pub(crate) boxes: Vec<f32>,
    /// Polygons: place (2), cosine, sine, radius, corners, style, body, tint, and up to eight corners.
    pub(crate) polygons: Vec<f32>,
    /// Lines: ends (4), width in pixels (negative: metres), colour (red, green, blue, opacity).
    pub(crate) lines: Vec<f32>,
    /// Waters: how far the camera is below the surface, the direction out of it (2), phase of its waves, and the box in which
    /// it is (left, bottom, right, top).
    pub(crate) waters: Vec<f32>,
    /// How many numbers of the boxes and of the polygons are of what stands still; they come first.
    pub(crate) still: [usize; 2],
    /// What each body is tinted by, by its index.
    pub(crate) tints: Vec<f32>,
}
