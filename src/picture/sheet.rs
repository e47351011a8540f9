//! Sheets: many pictures in rows and columns under the values that they were made for, the geometric spreadsheet of \[P95\]. Makes none
//! of the pictures.

use super::axes::{INK, Look, PAPER, number};
use super::canvas::{Area, Canvas, LARGEST, Pen};
use super::image::Image;
use super::text::{self, Across, Lettering, Upright};

/// What changes from column to column, or from row to row.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Heading {
    /// The coordinate.
    pub name: String,
    /// Its value for each column or row. None: there is one column or row, without a heading.
    pub values: Vec<f64>,
}

impl Heading {
    /// Columns or rows, at least one.
    #[must_use]
    pub fn count(&self) -> usize {
        self.values.len().max(1)
    }

    fn label(&self, i: usize) -> String {
        self.values.get(i).map_or_else(String::new, |&value| {
            if self.name.is_empty() { number(value) } else { format!("{} = {}", self.name, number(value)) }
        })
    }
}

/// Why a sheet cannot be made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SheetError {
    /// There must be one picture for each pair of values.
    Count {
        /// Pairs of values.
        wanted: usize,
        /// Pictures.
        given: usize,
    },
    /// The sheet would be larger than [`LARGEST`] pixels, or there is no memory for it.
    TooLarge {
        /// Pixels that it would take.
        size: [usize; 2],
    },
}

impl std::fmt::Display for SheetError {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        match self {
            SheetError::Count { wanted, given } => write!(f, "the sheet needs {wanted} pictures, not {given}"),
            SheetError::TooLarge { size: [width, height] } => {
                write!(f, "the sheet would be {width} x {height} pixels; make its pictures smaller or fewer")
            }
        }
    }
}

impl std::error::Error for SheetError {}

/// Lays out pictures, row by row, with the values of `columns` above and those of `rows` at the left. Pictures are not scaled; a
/// smaller one is centred in its place.
///
/// # Errors
/// [`SheetError`].
pub fn compose(images: &[Image], columns: &Heading, rows: &Heading, title: &str) -> Result<Image, SheetError> {
    let (across, down) = (columns.count(), rows.count());
    if images.len() != across * down {
        return Err(SheetError::Count { wanted: across * down, given: images.len() });
    }
    let cell = [images.iter().map(|i| i.width).max().unwrap_or(1), images.iter().map(|i| i.height).max().unwrap_or(1)];
    let layout = Layout::new(cell, columns, rows, title);
    let size = layout.size(across, down);
    if size.iter().any(|&side| side > LARGEST) {
        return Err(SheetError::TooLarge { size });
    }
    let mut canvas = Canvas::new(size[0], size[1], PAPER).ok_or(SheetError::TooLarge { size })?;
    for (k, image) in images.iter().enumerate() {
        layout.cell(&mut canvas, k % across, k / across, image);
    }
    layout.headings(&mut canvas, columns, rows, title, size);
    Ok(canvas.image())
}

/// Where things lie, in pixels.
struct Layout {
    look: Look,
    cell: [usize; 2],
    gap: usize,
    left: usize,
    top: usize,
    upright: bool,
}

impl Layout {
    fn new(cell: [usize; 2], columns: &Heading, rows: &Heading, title: &str) -> Self {
        let mut look = Look::of(2 * cell[0], 2 * cell[1]);
        let fits = |look: Look| {
            let widest = (0..columns.count()).map(|i| text::width(&columns.label(i), look.text)).fold(0., f32::max);
            widest <= cell[0] as f32 || look.text <= 7.
        };
        while !fits(look) {
            look.text *= 0.9;
        }
        let widest = (0..rows.count()).map(|j| text::width(&rows.label(j), look.text)).fold(0., f32::max);
        // Short row headings stand beside their row as they are read; long ones are turned so as not to cost width.
        let upright = widest <= 0.45 * cell[0] as f32;
        let beside = if rows.values.is_empty() {
            0.
        } else if upright {
            widest + look.text * 1.2
        } else {
            look.text * 1.9
        };
        let heading = if columns.values.is_empty() { 0. } else { look.text * 1.9 };
        let above = if title.is_empty() { 0. } else { look.text * 2.2 };
        let gap = (look.text * 0.5).ceil() as usize;
        Layout { look, cell, gap, left: gap + beside as usize, top: gap + (heading + above) as usize, upright }
    }

    fn size(&self, across: usize, down: usize) -> [usize; 2] {
        let along =
            |start: usize, cell: usize, count: usize| start.saturating_add((cell + self.gap).saturating_mul(count));
        [along(self.left, self.cell[0], across), along(self.top, self.cell[1], down)]
    }

    fn corner(&self, i: usize, j: usize) -> [usize; 2] {
        [self.left + i * (self.cell[0] + self.gap), self.top + j * (self.cell[1] + self.gap)]
    }

    fn cell(&self, canvas: &mut Canvas, i: usize, j: usize, image: &Image) {
        let [left, top] = self.corner(i, j);
        canvas.paste(image, left + (self.cell[0] - image.width) / 2, top + (self.cell[1] - image.height) / 2);
        let area = Area {
            left: left as f32,
            top: top as f32,
            right: (left + self.cell[0]) as f32,
            bottom: (top + self.cell[1]) as f32,
        };
        canvas.frame(area, &Pen::solid([190, 190, 190, 255], 1.));
    }

    fn headings(&self, canvas: &mut Canvas, columns: &Heading, rows: &Heading, title: &str, size: [usize; 2]) {
        let text = self.look.text;
        let centred = Lettering { size: text, colour: INK, across: Across::Middle, upright: Upright::Base, turn: 0. };
        let middle = 0.5 * (self.left + size[0] - self.gap) as f32;
        let title_row = text * 1.7;
        canvas.text(title, [middle, title_row], &Lettering { size: text * 1.15, ..centred });
        for i in 0..columns.values.len() {
            let column = self.corner(i, 0)[0] as f32 + 0.5 * self.cell[0] as f32;
            canvas.text(&columns.label(i), [column, self.top as f32 - text * 0.6], &centred);
        }
        for j in 0..rows.values.len() {
            let row = self.corner(0, j)[1] as f32 + 0.5 * self.cell[1] as f32;
            let column = self.left as f32 - text * 0.6;
            let (across, upright, turn) =
                if self.upright { (Across::Right, Upright::Middle, 0.) } else { (Across::Middle, Upright::Base, 90.) };
            canvas.text(&rows.label(j), [column, row], &Lettering { across, upright, turn, ..centred });
        }
    }
}
