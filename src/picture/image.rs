//! A picture in memory: eight bits for red, green, blue and opacity of each pixel. Writes no files.

/// Rows from the top, pixels from the left, four bytes (sRGB and opacity) each.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Image {
    /// Pixels in a row.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// `4 * width * height` bytes.
    pub rgba: Vec<u8>,
}

impl Image {
    /// A picture of one colour.
    #[must_use]
    pub fn new(width: usize, height: usize, colour: [u8; 3]) -> Self {
        let [r, g, b] = colour;
        Self { width, height, rgba: [r, g, b, 255].repeat(width * height) }
    }

    /// The pixel in column `i` of row `j`.
    ///
    /// # Panics
    /// If it lies outside.
    #[must_use]
    pub fn pixel(&self, i: usize, j: usize) -> [u8; 4] {
        let at = 4 * (j * self.width + i);
        [self.rgba[at], self.rgba[at + 1], self.rgba[at + 2], self.rgba[at + 3]]
    }

    /// Sets a pixel, opaque.
    ///
    /// # Panics
    /// If it lies outside.
    pub fn set(&mut self, i: usize, j: usize, colour: [u8; 3]) {
        let at = 4 * (j * self.width + i);
        self.rgba[at..at + 3].copy_from_slice(&colour);
        self.rgba[at + 3] = 255;
    }

    /// Bytes that a picture of that size takes while it is made, by estimate.
    #[must_use]
    pub fn memory(width: usize, height: usize) -> usize {
        width.saturating_mul(height).saturating_mul(8)
    }
}
