//! Several objects in one picture: one space for all, and what each brings of time, columns and rows. Draws nothing.

use crate::diagnostic::Diagnostic;
use crate::model::session::Session;

use super::ask::alone;
use super::subject::{Axis, Subject};
use super::{Timing, View};

/// The object that a view names as a subject: axes from types and ranges, sections from `at`, frames from time; the further objects beside
/// it in the same space.
///
/// # Errors
/// Messages for the user: what is missing or makes no sense.
pub fn subject(session: &mut Session, view: &View, timing: &Timing) -> Result<Subject, Vec<Diagnostic>> {
    let mut first = alone(session, view, timing)?;
    for name in &view.beside {
        let view = View { object: Some(name.clone()), beside: Vec::new(), ..view.clone() };
        let other = alone(session, &view, timing)?;
        if *other.name != *first.name && first.beside.iter().all(|known| known.name != other.name) {
            first.notes.extend_from_slice(&other.notes);
            first.beside.push(other);
        }
    }
    first.share();
    Ok(first)
}

impl Subject {
    /// Refuses what shows one object alone.
    ///
    /// # Errors
    /// One message, with what to do.
    pub fn is_alone(&self, output: &str) -> Result<(), Diagnostic> {
        let Some(other) = self.beside.first() else { return Ok(()) };
        let title = format!("{output} is of one object, not `{}` and `{}` together", self.name, other.name);
        let help = format!("name one of them, or unite them: gob_all = {} | {};", self.name, other.name);
        Err(Diagnostic::error("several-objects", title).help(help))
    }

    /// All objects of the picture.
    pub fn all(&self) -> impl Iterator<Item = &Self> {
        std::iter::once(self).chain(&self.beside)
    }

    /// Gives all objects the axes of any, over the hull of their ranges, and this one the time, columns and rows of any.
    fn share(&mut self) {
        let mut axes: Vec<Axis> = Vec::new();
        for axis in self.all().flat_map(|one| &one.axes) {
            match axes.iter_mut().find(|known| known.coordinate == axis.coordinate) {
                Some(known) => {
                    known.range = [known.range[0].min(axis.range[0]), known.range[1].max(axis.range[1])];
                }
                None => {
                    let place = axes.partition_point(|known| known.order <= axis.order);
                    axes.insert(place, *axis);
                }
            }
        }
        self.axes.clone_from(&axes);
        for other in &mut self.beside {
            other.axes.clone_from(&axes);
            for (mine, its) in
                [(&mut self.time, &other.time), (&mut self.columns, &other.columns), (&mut self.rows, &other.rows)]
            {
                if mine.is_none() {
                    mine.clone_from(its);
                }
            }
        }
    }
}
