//! From an object of the session to a shape in a space: which coordinates are axes, what the others are fixed at, which take several
//! values. Makes no output.

use crate::diagnostic::{Category, Diagnostic};
use crate::field::{Coordinate, Graph, NodeId};
use crate::limits::Limits;
use crate::model::environment::Colour;
use crate::picture::axes::number;
use crate::source::Span;
use crate::surface::grid::{Grid, GridError, MOST_CELLS};
use crate::syntax::tree::Name;
use crate::vm::{CompileError, Demand, Precision, Program, Shape};

use super::Cells;

/// An axis of the space that is shown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axis {
    /// Its coordinate.
    pub coordinate: Coordinate,
    /// Range in the modelling space.
    pub range: [f64; 2],
    /// Which of X, Y and Z it is, from 0.
    pub order: usize,
}

/// A coordinate that takes several values: frames, columns or rows of a sheet, sections.
#[derive(Clone, Debug, PartialEq)]
pub struct Sequence {
    /// Its coordinate.
    pub coordinate: Coordinate,
    /// One value a frame, column, row or section.
    pub values: Vec<f64>,
}

/// Values of coordinates that are no axes.
pub type Place = Vec<(Coordinate, f64)>;

/// A value of the function whose boundary is shown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Level {
    /// The value.
    pub value: f64,
    /// The function less that value.
    pub node: NodeId,
}

/// One of the things that are shown together: a section, or the boundary of a level.
#[derive(Clone, Debug)]
pub struct Member {
    /// What it is: `x8 = 0.5`, or the level.
    pub label: String,
    /// The coordinate's value or the level; of several coordinates that of the last.
    pub value: f64,
    /// The function.
    pub node: NodeId,
    /// Its program, which members may share.
    pub shape: Shape,
    /// The values of the coordinates that tell sections apart.
    pub place: Place,
    /// The coordinates with their values, or `level` with its.
    pub marks: Vec<(String, f64)>,
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
    /// The other coordinates; those that take several values are among them, at their first.
    pub fixed: Place,
    /// Time, unless a section fixed it or nothing moves.
    pub time: Option<Sequence>,
    /// Columns of a sheet, type V.
    pub columns: Option<Sequence>,
    /// Rows of a sheet, type W.
    pub rows: Option<Sequence>,
    /// Sections shown together, type G; also slices.
    pub groups: Vec<Sequence>,
    /// Sections told apart by their colour, type C.
    pub colour: Option<Sequence>,
    /// Levels whose boundaries are shown together, ascending. Empty: the one at 0.
    pub levels: Vec<Level>,
    /// The numbers that points are computed with.
    pub precision: Precision,
    /// What there is to say of the modelling space, if it was found and not given.
    pub notes: Vec<Diagnostic>,
    /// The colour that the program gives it.
    pub colouring: Option<Colour>,
    /// The centre that the program gives it.
    pub centre: Option<Vec<f64>>,
    /// The faces of the space that are cuts: for each axis the lower and the upper one.
    pub cut: [[bool; 2]; 3],
    /// Further objects in the same picture, with the same axes.
    pub beside: Vec<Subject>,
}

impl Subject {
    /// A function whose coordinates have no roles yet.
    #[must_use]
    pub fn of(name: Name, node: NodeId, fixed: Place) -> Self {
        let (axes, groups, levels) = Default::default();
        Self {
            name,
            span: None,
            node,
            axes,
            fixed,
            time: None,
            columns: None,
            rows: None,
            groups,
            colour: None,
            levels,
            precision: Precision::Double,
            notes: Vec::new(),
            colouring: None,
            centre: None,
            cut: [[false; 2]; 3],
            beside: Vec::new(),
        }
    }

    /// The same object with one of its axes cut into slices.
    ///
    /// # Errors
    /// If that coordinate is no axis.
    pub fn sliced(mut self, slices: &Sequence) -> Result<Self, Diagnostic> {
        let c = slices.coordinate;
        let Some(place) = self.axes.iter().position(|axis| axis.coordinate == c) else {
            let title = format!("{c} is no axis of `{}` that could be sliced", self.name);
            let axes: Vec<String> = self.axes.iter().map(|axis| axis.coordinate.to_string()).collect();
            let help = format!("its axes are {}", axes.join(", "));
            return Err(Diagnostic::error("no-axis", title).category(Category::Usage).help(help));
        };
        self.axes.remove(place);
        self.fixed.extend(slices.values.first().map(|&first| (c, first)));
        self.groups.push(slices.clone());
        Ok(self)
    }

    /// Whether there is one thing to show at a time: neither sections nor levels.
    #[must_use]
    pub fn is_single(&self) -> bool {
        self.groups.is_empty() && self.colour.is_none() && self.levels.is_empty()
    }

    /// The sections that hold for all that is shown, as `x6 = 0.5`: of coordinates that take one value.
    pub fn held(&self) -> impl Iterator<Item = String> + '_ {
        let many = [&self.time, &self.columns, &self.rows, &self.colour].into_iter().flatten().chain(&self.groups);
        let many: Vec<Coordinate> = many.map(|sequence| sequence.coordinate).collect();
        self.fixed.iter().filter(move |(c, _)| !many.contains(c)).map(|(c, value)| format!("{c} = {}", number(*value)))
    }

    /// Everything that is shown together in one picture: each pair, triple ... of sections; one without a value if there are none.
    #[must_use]
    pub fn sections(&self) -> Vec<Place> {
        let all = self.groups.iter().chain(&self.colour);
        all.fold(vec![Vec::new()], |sections, next| {
            let more =
                |section: &Place| next.values.iter().map(|&v| with(section, next.coordinate, v)).collect::<Vec<_>>();
            sections.iter().flat_map(more).collect()
        })
    }

    /// The cells of the sheet at a moment, row by row; one cell if there is no sheet.
    #[must_use]
    pub fn cells(&self, moment: f64) -> Vec<Place> {
        let time = self.time.iter().map(|time| (time.coordinate, moment)).collect();
        [&self.rows, &self.columns].into_iter().flatten().fold(vec![time], |cells: Vec<Place>, next| {
            let more = |cell: &Place| next.values.iter().map(|&v| with(cell, next.coordinate, v)).collect::<Vec<_>>();
            cells.iter().flat_map(more).collect()
        })
    }

    /// Refuses coordinates with types, and levels, that an output cannot show: `shows` lists the types that it can.
    ///
    /// # Errors
    /// One message, with what to do.
    pub fn shown_by(&self, output: &str, shows: &[&str]) -> Result<(), Diagnostic> {
        let typed = [("V", &self.columns), ("W", &self.rows), ("C", &self.colour)];
        let typed = typed.into_iter().filter_map(|(name, sequence)| Some((name, sequence.as_ref()?)));
        let mut all = typed.chain(self.groups.iter().map(|group| ("G", group)));
        if let Some((name, Sequence { coordinate: c, values })) = all.find(|(name, _)| !shows.contains(name)) {
            let title = format!("{c} of `{}` has the type {name}, which {output} cannot show", self.name);
            let first = values.first().unwrap_or(&0.0);
            let help = format!("fix it at one value: --at {c}={first}, or `{c} : CONSTANT = {first};`");
            return Err(Diagnostic::error("type-not-shown", title).help(help));
        }
        if self.levels.is_empty() || shows.contains(&"levels") {
            return Ok(());
        }
        let (name, count) = (&self.name, self.levels.len());
        let title = format!("`{name}` has {count} levels, which {output} cannot show together");
        let help = format!("choose one: `{name} : CONSTANT = {};`", self.levels[0].value);
        Err(Diagnostic::error("type-not-shown", title).help(help))
    }

    /// The object as a shape at its first frame.
    ///
    /// # Errors
    /// If its program would be too large.
    pub fn shape(&self, graph: &Graph, demand: Demand, limits: &Limits) -> Result<Shape, Diagnostic> {
        self.shape_of(self.node, graph, demand, limits)
    }

    /// Everything that is shown together in one picture: each level of each section; the object alone if there is one of each.
    ///
    /// # Errors
    /// If a program would be too large.
    pub fn members(&self, graph: &Graph, demand: Demand, limits: &Limits) -> Result<Vec<Member>, Diagnostic> {
        let each = |place: &Place| place.iter().map(|(c, v)| format!("{c} = {}", number(*v))).collect::<Vec<_>>();
        let sections = self.sections();
        let mut levels = Vec::new();
        for level in &self.levels {
            let shape = self.shape_of(level.node, graph, demand, limits)?;
            levels.push((Some((level.value, level.node)), shape));
        }
        if levels.is_empty() {
            levels.push((None, self.shape(graph, demand, limits)?));
        }
        let member = |place: &Place, level: Option<(f64, NodeId)>, shape: &Shape| {
            let mut label = each(place);
            let mut marks: Vec<(String, f64)> = place.iter().map(|(c, v)| (c.to_string(), *v)).collect();
            if let Some((value, _)) = level {
                label.push(if place.is_empty() { number(value) } else { format!("level {}", number(value)) });
                marks.push(("level".into(), value));
            }
            // A section of type C is told by its colour, whatever the level.
            let told = if self.colour.is_some() { None } else { level.map(|level| level.0) };
            Member {
                label: label.join(", "),
                value: told.or(place.last().map(|last| last.1)).unwrap_or(0.0),
                node: level.map_or(self.node, |(_, node)| node),
                shape: self.placed(shape, place),
                place: place.clone(),
                marks,
            }
        };
        let of_section =
            |place: &Place| levels.iter().map(|(level, shape)| member(place, *level, shape)).collect::<Vec<_>>();
        Ok(sections.iter().flat_map(of_section).collect())
    }

    /// The coordinates of the axes, then the others: the inputs of its programs.
    #[must_use]
    pub fn inputs(&self) -> Vec<Coordinate> {
        self.axes.iter().map(|a| a.coordinate).chain(self.fixed.iter().map(|f| f.0)).collect()
    }

    pub(super) fn shape_of(
        &self,
        node: NodeId,
        graph: &Graph,
        demand: Demand,
        limits: &Limits,
    ) -> Result<Shape, Diagnostic> {
        let program =
            Program::compile(graph, node, &self.inputs(), demand, limits).map_err(|e| self.not_compiled(e))?;
        let shape = Shape::new(program, self.axes.len(), self.fixed.iter().map(|f| f.1).collect());
        Ok(Shape { precision: self.precision, ..shape })
    }

    /// The same shape, sharing its program, at another place.
    #[must_use]
    pub fn placed(&self, shape: &Shape, place: &[(Coordinate, f64)]) -> Shape {
        let mut shape = shape.clone();
        for (coordinate, value) in place {
            if let Some(k) = self.fixed.iter().position(|f| f.0 == *coordinate) {
                shape.fixed[k] = *value;
            }
        }
        shape
    }

    /// The same shape at another moment.
    #[must_use]
    pub fn at(&self, shape: &Shape, moment: f64) -> Shape {
        let place: Place = self.time.iter().map(|time| (time.coordinate, moment)).collect();
        self.placed(shape, &place)
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
                let Axis { coordinate: c, range: [lo, hi], .. } = self.axes[axis];
                let title = format!("the modelling space has no extent along {c}: from {lo} to {hi}");
                let help = format!("give a range: `{c}min = -1; {c}max = 1;`, or --bounds {c}=-1:1");
                Diagnostic::error("no-extent", title).help(help)
            }
            GridError::TooFine(axis) => {
                let Axis { coordinate: c, range: [lo, hi], .. } = self.axes[axis];
                let title = format!("the cells along {c} ({lo} to {hi}) are too small for doubles of that size");
                Diagnostic::error("too-fine", title)
                    .help(format!("lower --resolution, or move the space towards {c} = 0"))
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

fn with(place: &Place, coordinate: Coordinate, value: f64) -> Place {
    let mut place = place.clone();
    place.push((coordinate, value));
    place
}

/// Bytes in the unit that people read.
fn size(bytes: u64) -> String {
    let gigabytes = bytes as f64 / f64::from(1 << 30);
    if gigabytes >= 0.95 { format!("{gigabytes:.1} GiB") } else { format!("{:.0} MiB", gigabytes * 1024.0) }
}
