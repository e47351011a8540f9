//! The boundary as what a file holds: meshes with their checks, alone, in groups and over time, and outlines in the plane.

use std::io::{self, Write};
use std::time::Instant;

use crate::diagnostic::{Category, Diagnostic};
use crate::export::{self, Part, glb, svg};
use crate::picture::legend::Telling;
use crate::picture::palette::Palette;
use crate::surface::check::{Topology, check};
use crate::surface::contour::outlines;
use crate::surface::grid::Grid;
use crate::surface::marching::{Extraction, Report, SurfaceError, extract};
use crate::surface::mesh::Mesh;
use crate::surface::sampler::Counters;
use crate::vm::{Demand, Shape};

use super::PictureOptions;
use super::charts::legend;
use super::make::{Making, cancelled};
use super::output::Format;
use super::pictures::Artist;
use super::subject::{Member, Subject};
use super::told::{self, empty};

/// Pixels along each side of the picture in a 3MF file.
const THUMBNAIL: usize = 256;
/// The opacity of the members of a group in a mesh, of 255, but for the last.
const SHOWS_THROUGH: u8 = 110;

impl Making<'_> {
    /// One mesh a file, or all frames in one, or all sections in one.
    pub(super) fn meshes(&mut self) -> Result<(), Diagnostic> {
        self.need(3, "a mesh")?;
        let is_glb = self.output.format == Format::Glb;
        let shown = self.subject.shown_by("such a mesh", if is_glb { &["G", "C", "levels"] } else { &[] });
        shown.map_err(|told| if is_glb { told } else { told.help("a .glb holds a group; a .png shows a sheet") })?;
        let grid = self.subject.grid(self.options.view.cells, self.shop.limits)?;
        let members = {
            let _phase = self.shop.interrupt.phase("compile");
            self.subject.members(self.shop.graph, Demand::Sign, self.shop.limits)?
        };
        if members.len() > 1 {
            return self.groups(&grid, &members);
        }
        if self.holds_all() && self.subject.time.is_some() {
            return self.moving(&grid, &members[0].shape);
        }
        for (n, moment) in self.moments().into_iter().enumerate() {
            let begun = Instant::now();
            let (mesh, line) = self.solid(&members[0].shape, &grid, moment)?;
            self.line(n, &line, begun);
            let thumbnail = self.thumbnail(moment)?;
            let (format, name) = (self.output.format, self.subject.name.clone());
            self.put(n, &mut |out| write_mesh(format, &mesh, &name, thumbnail.as_deref(), out))?;
        }
        Ok(())
    }

    /// All frames in one file.
    fn moving(&mut self, grid: &Grid, shape: &Shape) -> Result<(), Diagnostic> {
        let begun = Instant::now();
        let mut meshes = Vec::new();
        let mut bytes = 0;
        for moment in self.moments() {
            let (mesh, _) = self.solid(shape, grid, moment)?;
            bytes += 48 * mesh.positions.len() as u64 + 12 * mesh.triangles.len() as u64;
            self.subject.within_memory(bytes, self.shop.limits)?;
            meshes.push(mesh);
        }
        let triangles: usize = meshes.iter().map(|mesh| mesh.triangles.len()).sum();
        self.line(0, &format!("{} frames, {triangles} triangles", meshes.len()), begun);
        let (delay, name) = (self.delay(), self.subject.name.clone());
        let parts: Vec<Part> = meshes.iter().map(|mesh| Part::of(&name, mesh)).collect();
        self.put(0, &mut |out| glb::write_animation(&parts, delay, &name, &mut { out }))
    }

    /// All sections or levels in one file, one file a frame; members that are empty there are left out.
    fn groups(&mut self, grid: &Grid, members: &[Member]) -> Result<(), Diagnostic> {
        let colours = colours(self.subject, members, &self.options.picture);
        for (n, moment) in self.moments().into_iter().enumerate() {
            let begun = Instant::now();
            let mut meshes = Vec::new();
            for (member, colour) in members.iter().zip(&colours) {
                match self.mesh(&member.shape, grid, moment)? {
                    (Some(mesh), ..) => meshes.push((member, *colour, mesh)),
                    (None, ..) => self.missing(&member.label),
                }
            }
            let count = meshes.len();
            let Some(last) = meshes.last() else { return Err(empty(self.subject, Some(moment), None)) };
            // Of the levels the last lies within all others.
            let innermost = if self.subject.levels.is_empty() { "" } else { last.0.label.as_str() };
            let part = |(member, [r, g, b, _], mesh): &(&Member, [u8; 4], Mesh)| {
                let opacity = if member.label == innermost { 255 } else { SHOWS_THROUGH };
                (member.label.clone(), opacity, [*r, *g, *b], mesh.clone())
            };
            let owned: Vec<_> = meshes.iter().map(part).collect();
            let parts: Vec<Part> = owned
                .iter()
                .map(|(label, opacity, [r, g, b], mesh)| Part { tint: [*r, *g, *b, *opacity], ..Part::of(label, mesh) })
                .collect();
            let triangles: usize = owned.iter().map(|part| part.3.triangles.len()).sum();
            self.line(n, &format!("a group of {count} with {triangles} triangles"), begun);
            let name = self.subject.name.clone();
            self.put(n, &mut |out| glb::write(&parts, &name, &mut { out }))?;
        }
        Ok(())
    }

    fn missing(&mut self, label: &str) {
        let title = format!("`{}` is empty at {label}, which is left out", self.subject.name);
        self.written.notes.push(Diagnostic::warning("empty-section", title));
    }

    /// A mesh that must not be empty, and what there is to say of it.
    fn solid(&mut self, shape: &Shape, grid: &Grid, moment: f64) -> Result<(Mesh, String), Diagnostic> {
        match self.mesh(shape, grid, moment)? {
            (Some(mesh), line, _) => Ok((mesh, line)),
            (None, _, report) => Err(empty(self.subject, Some(moment), Some(&report))),
        }
    }

    /// The checked boundary; none if it is empty.
    fn mesh(&mut self, shape: &Shape, grid: &Grid, moment: f64) -> Result<(Option<Mesh>, String, Report), Diagnostic> {
        let shape = self.subject.at(shape, moment);
        let extraction = extract(&shape, grid, self.shop.limits, self.shop.interrupt).map_err(unmade)?;
        if extraction.mesh.is_empty() {
            return Ok((None, String::new(), extraction.report));
        }
        self.say(told::of_report(self.subject, &extraction.report));
        let topology = check(&extraction.mesh).map_err(|fault| {
            Diagnostic::error("mesh-fault", format!("the mesh of `{}` has a fault: {fault}", self.subject.name))
                .category(Category::Result)
                .help("nothing was written; another --resolution usually avoids it")
        })?;
        let line = mesh_line(&extraction, &topology);
        Ok((Some(extraction.mesh), line, extraction.report))
    }

    /// The bytes of a small picture, for the format that holds one.
    fn thumbnail(&self, moment: f64) -> Result<Option<Vec<u8>>, Diagnostic> {
        if self.output.format != Format::ThreeMf {
            return Ok(None);
        }
        let size = Some((THUMBNAIL, THUMBNAIL));
        let picture = PictureOptions { size, axes: false, ..self.options.picture.clone() };
        let options = super::Options { picture, ..self.options.clone() };
        let artist = Artist::new(self.shop, self.subject, &options, &[moment])?;
        let picture = artist.picture(moment, self.shop.interrupt)?;
        let mut bytes = Vec::new();
        export::png::write(&picture.image, &mut bytes).map_err(|error| {
            Diagnostic::error("not-written", format!("the picture in the file could not be made: {error}"))
                .category(Category::File)
        })?;
        Ok(Some(bytes))
    }

    /// Outlines of a plane figure: one group of paths a section.
    pub(super) fn outlines(&mut self) -> Result<(), Diagnostic> {
        self.need(2, "an outline")?;
        self.subject.shown_by("an outline", &["G", "C", "levels"])?;
        let grid = self.subject.grid(self.options.view.cells, self.shop.limits)?;
        let members = self.subject.members(self.shop.graph, Demand::Sign, self.shop.limits)?;
        let colours = colours(self.subject, &members, &self.options.picture);
        let [x, y] = [0, 1].map(|k| self.subject.axes[k].range);
        let single = self.subject.is_single();
        for (n, moment) in self.moments().into_iter().enumerate() {
            let begun = Instant::now();
            let mut slices = Vec::new();
            for (member, [r, g, b, _]) in members.iter().zip(&colours) {
                let shape = self.subject.at(&member.shape, moment);
                let found = outlines(&shape, &grid, self.shop.limits, self.shop.interrupt).map_err(unmade)?;
                if !found.lines.is_empty() {
                    self.say(told::of_report(self.subject, &found.report));
                }
                let colour = (!single && self.options.slices.is_none()).then_some([*r, *g, *b]);
                slices.push(svg::Slice { marks: member.marks.clone(), loops: found.lines, colour });
            }
            let count: usize = slices.iter().map(|slice| slice.loops.len()).sum();
            if count == 0 {
                return Err(empty(self.subject, Some(moment), None));
            }
            let full = slices.iter().filter(|slice| !slice.loops.is_empty()).count();
            self.line(n, &format!("{count} outlines in {full} of {} sections", slices.len()), begun);
            let name = self.subject.name.clone();
            self.put(n, &mut |out| svg::write(&slices, [x[0], y[0]], [x[1], y[1]], &name, &mut { out }))?;
        }
        Ok(())
    }
}

/// The colours of what is shown together.
fn colours(subject: &Subject, members: &[Member], picture: &PictureOptions) -> Vec<[u8; 4]> {
    match &subject.colour {
        Some(colour) => {
            let palette = Palette::from_name(&picture.palette).unwrap_or_default();
            let legend = legend(colour.coordinate, &colour.values, palette);
            Telling::values(members.iter().map(|member| member.value), legend).colours
        }
        None => Telling::names(members.iter().map(|member| member.label.clone())).colours,
    }
}

pub(super) fn unmade(error: SurfaceError) -> Diagnostic {
    match error {
        SurfaceError::Cancelled => cancelled(),
        other => Diagnostic::error("no-mesh", other.to_string()).category(Category::Result),
    }
}

fn mesh_line(extraction: &Extraction, topology: &Topology) -> String {
    let Counters { points, boxes, .. } = extraction.report.counters;
    format!(
        "{} triangles, Euler characteristic {}, {points} points and {boxes} boxes evaluated of {} samples",
        topology.triangles, topology.euler, extraction.report.samples
    )
}

fn write_mesh(
    format: Format,
    mesh: &Mesh,
    name: &str,
    thumbnail: Option<&[u8]>,
    mut out: &mut dyn Write,
) -> io::Result<()> {
    let part = Part::of(name, mesh);
    match format {
        Format::Obj => export::obj::write(&[part], &mut out),
        Format::Ply => export::ply::write(&part, &mut out),
        Format::Glb => glb::write(&[part], name, &mut out),
        Format::ThreeMf => export::threemf::write(&[part], thumbnail, name, &mut out),
        _ => export::stl::write(&part, &mut out),
    }
}
