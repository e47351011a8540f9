//! Frames of an object over one of its parameters, time for instance: one program, one camera for all of them. Writes no files.

use super::camera::{Camera, View};
use super::extent::Extent;
use super::image::Image;
use super::raycast::{Picture, Space, Style, framed, raycast};
use crate::interrupt::{Cancelled, Interrupt};
use crate::vm::Shape;

/// An object that changes with an input of its program.
#[derive(Clone, Debug)]
pub struct Frames<'a> {
    /// The object; its program serves all frames.
    pub shape: &'a Shape,
    /// Which of `Shape::fixed` is the parameter.
    pub input: usize,
    /// The parameter's value in each frame.
    pub values: &'a [f64],
    /// The modelling space.
    pub space: Space,
}

impl Frames<'_> {
    /// The object in one frame.
    ///
    /// # Panics
    /// If there is no such frame or input.
    #[must_use]
    pub fn shape(&self, frame: usize) -> Shape {
        let mut shape = self.shape.clone();
        shape.fixed[self.input] = self.values[frame];
        shape
    }

    /// A hull of the object in all frames.
    ///
    /// # Errors
    /// [`Cancelled`] soon after the interrupt was set.
    pub fn extent(&self, interrupt: &Interrupt) -> Result<Extent, Cancelled> {
        let nothing = Extent::nothing(self.space, self.shape.dimension);
        (0..self.values.len())
            .try_fold(nothing, |all, frame| Ok(all.join(&Extent::of(&self.shape(frame), self.space, interrupt)?)))
    }

    /// The one camera that frames the object in every frame.
    ///
    /// # Errors
    /// [`Cancelled`] soon after the interrupt was set.
    pub fn camera(&self, view: &View, style: &Style, interrupt: &Interrupt) -> Result<Camera, Cancelled> {
        Ok(framed(view, &self.extent(interrupt)?, style))
    }

    /// One frame.
    ///
    /// # Errors
    /// [`Cancelled`] soon after the interrupt was set.
    pub fn picture(
        &self,
        frame: usize,
        camera: &Camera,
        style: &Style,
        interrupt: &Interrupt,
    ) -> Result<Picture, Cancelled> {
        raycast(&self.shape(frame), self.space, camera, style, interrupt)
    }

    /// All frames in order.
    ///
    /// # Errors
    /// [`Cancelled`] soon after the interrupt was set.
    pub fn images(&self, view: &View, style: &Style, interrupt: &Interrupt) -> Result<Vec<Image>, Cancelled> {
        let camera = self.camera(view, style, interrupt)?;
        (0..self.values.len()).map(|frame| Ok(self.picture(frame, &camera, style, interrupt)?.image)).collect()
    }
}
