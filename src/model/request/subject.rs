//! From an object of the session to a shape in a space: which coordinates are axes, what the others are fixed at, which are time.

use crate::diagnostic::{Category, Diagnostic};
use crate::field::{Coordinate, Graph, NodeId};
use crate::limits::Limits;
use crate::source::Span;
use crate::surface::grid::{Grid, GridError, MOST_CELLS};
use crate::syntax::tree::Name;
use crate::vm::{CompileError, Demand, Program, Shape};

use super::Cells;

/// An axis of the space that is shown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axis {
    /// Its coordinate.
    pub coordinate: Coordinate,
    /// Range in the modelling space.
    pub range: [f64; 2],
}

/// The coordinate that shows as time, and its values, one a frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Time {
    /// Its coordinate.
    pub coordinate: Coordinate,
    /// One value a frame.
    pub values: Vec<f64>,
}

/// An object ready to be shown: the function, its axes, and values for every other coordinate.
#[derive(Clone, Debug)]
pub struct Subject {
    /// The object's name.
    pub name: Name,
    /// Where it is defined.
    pub span: Option<Span>,
    /// The function, inside where it is not negative.
    pub node: NodeId,
    /// One to three axes in the order X, Y, Z.
    pub axes: Vec<Axis>,
    /// The other coordinates; time is among them, at its first frame.
    pub fixed: Vec<(Coordinate, f64)>,
    /// Time, unless a section fixed it or nothing moves.
    pub time: Option<Time>,
}

impl Subject {
    /// The object as a shape at its first frame.
    ///
    /// # Errors
    /// If its program would be too large.
    pub fn shape(&self, graph: &Graph, demand: Demand, limits: &Limits) -> Result<Shape, Diagnostic> {
        let inputs: Vec<Coordinate> =
            self.axes.iter().map(|a| a.coordinate).chain(self.fixed.iter().map(|f| f.0)).collect();
        let program = Program::compile(graph, self.node, &inputs, demand, limits).map_err(|e| self.not_compiled(e))?;
        Ok(Shape::new(program, self.axes.len(), self.fixed.iter().map(|f| f.1).collect()))
    }

    /// The same shape, sharing its program, at another moment.
    #[must_use]
    pub fn at(&self, shape: &Shape, moment: f64) -> Shape {
        let mut shape = shape.clone();
        if let Some(time) = &self.time
            && let Some(place) = self.fixed.iter().position(|f| f.0 == time.coordinate)
        {
            shape.fixed[place] = moment;
        }
        shape
    }

    /// The moments of a series: one a frame, or the one moment of what does not move.
    #[must_use]
    pub fn moments(&self) -> Vec<f64> {
        self.time.as_ref().map_or_else(|| vec![0.0], |time| time.values.clone())
    }

    /// The ranges of the axes.
    #[must_use]
    pub fn bounds(&self) -> Vec<[f64; 2]> {
        self.axes.iter().map(|a| a.range).collect()
    }

    /// The modelling space cut into cells.
    ///
    /// # Errors
    /// If it has no extent, or more cells than can be numbered or than the memory holds.
    pub fn grid(&self, cells: Cells, limits: &Limits) -> Result<Grid, Diagnostic> {
        let grid = Grid::new(&self.bounds(), self.along(cells)?).map_err(|error| self.no_grid(error))?;
        self.within_memory(grid.estimated_bytes(), limits)?;
        Ok(grid)
    }

    /// Cells along the longest side.
    ///
    /// # Errors
    /// If the length of a cell makes no sense, or there would be too many.
    pub fn along(&self, cells: Cells) -> Result<usize, Diagnostic> {
        let longest = self.bounds().iter().map(|[lo, hi]| hi - lo).fold(0.0, f64::max);
        match cells {
            Cells::Along(count) if (1..=MOST_CELLS).contains(&count) => Ok(count),
            Cells::Along(count) => Err(self.no_grid(GridError::Resolution(count))),
            Cells::Length(length) if length > 0.0 && length.is_finite() => {
                let count = (longest / length).ceil().min(1e9) as usize;
                if count <= MOST_CELLS { Ok(count) } else { Err(self.no_grid(GridError::Resolution(count))) }
            }
            Cells::Length(length) => {
                let title = format!("a cell cannot have the length {length}");
                Err(Diagnostic::error("cell-length", title).category(Category::Usage))
            }
        }
    }

    /// Refuses what would take more memory than the limits allow.
    ///
    /// # Errors
    /// In words that say how to lower it.
    pub fn within_memory(&self, bytes: u64, limits: &Limits) -> Result<(), Diagnostic> {
        if bytes <= limits.memory_bytes as u64 {
            return Ok(());
        }
        let title = format!("`{}` would take about {} of memory", self.name, size(bytes));
        Err(Diagnostic::error("too-much-memory", title)
            .category(Category::Result)
            .fact(format!("the limit is {}", size(limits.memory_bytes as u64)))
            .help("lower --resolution or --size, or show a smaller part of the space with --bounds"))
    }

    fn no_grid(&self, error: GridError) -> Diagnostic {
        let category = match error {
            GridError::Resolution(_) => Category::Usage,
            GridError::Dimension(_) | GridError::Bounds(_) | GridError::TooFine(_) => Category::Program,
        };
        match error {
            GridError::Bounds(axis) => {
                let Axis { coordinate: c, range: [lo, hi] } = self.axes[axis];
                let title = format!("the modelling space has no extent along {c}: from {lo} to {hi}");
                let help = format!("give a range: `{c}min = -1; {c}max = 1;`, or --bounds {c}=-1:1");
                Diagnostic::error("no-extent", title).help(help)
            }
            GridError::TooFine(axis) => {
                let Axis { coordinate: c, range: [lo, hi] } = self.axes[axis];
                let title = format!("the cells along {c} ({lo} to {hi}) are too small for doubles of that size");
                Diagnostic::error("too-fine", title).help(format!("lower --resolution, or move the space towards {c} = 0"))
            }
            GridError::Dimension(n) => {
                let title =
                    format!("`{}` is an object of {n} coordinates here; this output needs two or three", self.name);
                Diagnostic::error("dimension", title)
            }
            GridError::Resolution(n) => Diagnostic::error("resolution", format!("{n} cells along the longest side"))
                .help(format!("between 1 and {MOST_CELLS} cells are possible: choose --resolution or --cell so")),
        }
        .category(category)
    }

    fn not_compiled(&self, error: CompileError) -> Diagnostic {
        let title = match error {
            CompileError::TooLarge(limit) => format!("`{}` takes more than {limit} operations", self.name),
            CompileError::Unbound(c) => format!("`{}` depends on {c}, which has no value here", self.name),
        };
        let diagnostic =
            Diagnostic::error("too-large", title).help("make it of fewer parts, or give each coordinate a type");
        match self.span {
            Some(span) => diagnostic.at(span, "defined here"),
            None => diagnostic,
        }
    }
}

/// Bytes in the unit that people read.
fn size(bytes: u64) -> String {
    let gigabytes = bytes as f64 / f64::from(1 << 30);
    if gigabytes >= 0.95 { format!("{gigabytes:.1} GiB") } else { format!("{:.0} MiB", gigabytes * 1024.0) }
}
