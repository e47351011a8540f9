//! The boundary as what a file holds: meshes with their checks, alone, in groups and over time, and outlines in the plane.

use std::io::{self, Write};
use std::time::Instant;

use crate::diagnostic::{Category, Diagnostic};
use crate::export::{self, Part, glb, svg};
use crate::field::NodeId;
use crate::picture::legend::Telling;
use crate::picture::paint::Paint;
use crate::picture::palette::Palette;
use crate::surface::check::{Topology, check};
use crate::surface::grid::Grid;
use crate::surface::marching::{Extraction, Report, SurfaceError, extract_bare};
use crate::surface::mesh::Mesh;
use crate::surface::sampler::Counters;
use crate::surface::sharp::{Plain, Sharpened, extract_as, outlines_as};
use crate::vm::{Demand, Shape};

use super::PictureOptions;
use super::charts::legend;
use super::make::{Making, cancelled};
use super::output::Format;
use super::paint::colours_of;
use super::pictures::Artist;
use super::subject::{Member, Place, Subject};
use super::told::{self, empty};
use super::way::Route;

/// Pixels along each side of the picture in a 3MF file.
const THUMBNAIL: usize = 256;
/// The opacity of the members of a group in a mesh, of 255, but for the last.
const SHOWS_THROUGH: u8 = 110;
/// Points whose colours are found together.
const BATCH: usize = 1 << 14;

/// An object whose boundary is wanted.
struct Wanted<'a> {
    subject: &'a Subject,
    shape: Shape,
    paint: Option<Paint>,
}

/// A boundary as a file holds it.
pub(super) struct Body {
    pub(super) name: String,
    pub(super) mesh: Mesh,
    colours: Option<Vec<[u8; 3]>>,
    tint: [u8; 4],
    line: String,
    /// Which of several objects it is.
    pub(super) place: usize,
}

impl Body {
    pub(super) fn part(&self) -> Part<'_> {
        Part { colours: self.colours.as_deref(), tint: self.tint, ..Part::of(&self.name, &self.mesh) }
    }

    fn bytes(&self) -> u64 {
        51 * self.mesh.positions.len() as u64 + 12 * self.mesh.triangles.len() as u64
    }
}

impl<'a> Making<'a> {
    /// One mesh a file, or several objects, all frames or all sections in one.
    pub(super) fn meshes(&mut self) -> Result<(), Diagnostic> {
        self.need(3, "a mesh")?;
        let is_glb = self.output.format == Format::Glb;
        let shown = self.subject.shown_by("such a mesh", if is_glb { &["G", "C", "levels"] } else { &[] });
        shown.map_err(|told| if is_glb { told } else { told.help("a .glb holds a group; a .png shows a sheet") })?;
        self.several()?;
        let grid = self.subject.grid(self.options.view.cells, self.shop.limits)?;
        let phase = self.shop.interrupt.phase("compile");
        let members = self.subject.members(self.shop.graph, Demand::Sign, self.shop.limits)?;
        if members.len() > 1 {
            drop(phase);
            return self.groups(&grid, &members);
        }
        let wanted = self.wanted()?;
        drop(phase);
        if self.holds_all() && self.subject.time.is_some() {
            return self.moving(&grid, &wanted);
        }
        for (n, moment) in self.moments().into_iter().enumerate() {
            let begun = Instant::now();
            let bodies = self.bodies(&wanted, &grid, moment)?;
            let lines: Vec<&str> = bodies.iter().map(|body| body.line.as_str()).collect();
            self.line(n, &lines.join("; "), begun);
            if self.output.format == Format::Pov {
                let scene = self.scene(&bodies, moment)?;
                self.put(n, &mut |out| export::pov::write(&scene, &mut { out }))?;
                continue;
            }
            let thumbnail = self.thumbnail(moment)?;
            let (format, name) = (self.output.format, self.subject.name.clone());
            let parts: Vec<Part> = bodies.iter().map(Body::part).collect();
            self.put(n, &mut |out| write_meshes(format, &parts, &name, thumbnail.as_deref(), out))?;
        }
        Ok(())
    }

    /// Refuses several objects where the format holds one, or where each of them is already several.
    fn several(&self) -> Result<(), Diagnostic> {
        if let Format::Stl | Format::Ply = self.output.format {
            let what = format!("an .{}", self.output.format.extension()).replace("an .p", "a .p");
            let keep = "an .obj, .glb, .3mf or .pov keeps them apart under their names";
            self.subject.is_alone(&what).map_err(|told| told.help(keep))?;
        }
        if self.subject.beside.is_empty() {
            return Ok(());
        }
        self.subject.all().try_for_each(|one| one.shown_by("a mesh of several objects", &[]))
    }

    /// The objects of the file with their colours.
    fn wanted(&self) -> Result<Vec<Wanted<'a>>, Diagnostic> {
        let palette = Palette::from_name(&self.options.picture.palette).unwrap_or_default();
        let (graph, limits) = (self.shop.graph, self.shop.limits);
        let coloured = !matches!(self.output.format, Format::Stl);
        let one = |subject: &'a Subject| {
            let paint = if coloured { subject.paint(graph, palette, limits)? } else { None };
            Ok(Wanted { subject, shape: subject.shape(graph, Demand::Sign, limits)?, paint })
        };
        self.subject.all().map(one).collect()
    }

    /// The boundaries of all objects at a moment; one that is empty beside others is left out.
    fn bodies(&mut self, wanted: &[Wanted<'a>], grid: &Grid, moment: f64) -> Result<Vec<Body>, Diagnostic> {
        let (first, mut nothing) = (self.subject, None);
        let mut bodies = Vec::with_capacity(wanted.len());
        for (place, one) in wanted.iter().enumerate() {
            // What is told meanwhile is told of that object.
            self.subject = one.subject;
            match self.mesh(one.subject.node, &one.shape, grid, moment)? {
                (Some(mesh), line, _) => {
                    let colours = one.paint.as_ref().map(|paint| self.colours(paint, &mesh, moment)).transpose()?;
                    let name = one.subject.name.to_string();
                    bodies.push(Body { name, mesh, colours, tint: [255; 4], line, place });
                }
                (None, _, report) => {
                    nothing.get_or_insert(report);
                    if wanted.len() > 1 {
                        self.missing("this place");
                    }
                }
            }
        }
        self.subject = first;
        if bodies.is_empty() {
            return Err(self.shop.nothing(first, Some(moment), nothing.as_ref()));
        }
        Ok(bodies)
    }

    /// The colour of each vertex.
    fn colours(&self, paint: &Paint, mesh: &Mesh, moment: f64) -> Result<Vec<[u8; 3]>, Diagnostic> {
        let place: Place = self.subject.time.iter().map(|time| (time.coordinate, moment)).collect();
        let paint = self.subject.painted(paint, &place);
        let mut all = Vec::with_capacity(mesh.positions.len());
        for points in mesh.positions.chunks(BATCH) {
            self.shop.interrupt.tick()?;
            all.extend(colours_of(&paint, points).into_iter().map(|c| c.map(|share| (share * 255.0).round() as u8)));
        }
        Ok(all)
    }

    /// All frames in one file.
    fn moving(&mut self, grid: &Grid, wanted: &[Wanted<'a>]) -> Result<(), Diagnostic> {
        let begun = Instant::now();
        let mut frames = Vec::new();
        let mut bytes = 0;
        for moment in self.moments() {
            let bodies = self.bodies(wanted, grid, moment)?;
            bytes += bodies.iter().map(Body::bytes).sum::<u64>();
            self.subject.within_memory(bytes, self.shop.limits)?;
            frames.push(bodies);
        }
        let triangles: usize = frames.iter().flatten().map(|body| body.mesh.triangles.len()).sum();
        self.line(0, &format!("{} frames, {triangles} triangles", frames.len()), begun);
        let (delay, name) = (self.delay(), self.subject.name.clone());
        let frames: Vec<Vec<Part>> = frames.iter().map(|bodies| bodies.iter().map(Body::part).collect()).collect();
        self.put(0, &mut |out| glb::write_animation(&frames, delay, &name, &mut { out }))
    }

    /// All sections or levels in one file, one file a frame; members that are empty there are left out.
    fn groups(&mut self, grid: &Grid, members: &[Member]) -> Result<(), Diagnostic> {
        let colours = colours(self.subject, members, &self.options.picture);
        for (n, moment) in self.moments().into_iter().enumerate() {
            let begun = Instant::now();
            let mut bodies = Vec::new();
            for (member, [r, g, b, _]) in members.iter().zip(&colours) {
                match self.mesh(member.node, &member.shape, grid, moment)? {
                    (Some(mesh), line, _) => {
                        let (name, tint) = (member.label.clone(), [*r, *g, *b, SHOWS_THROUGH]);
                        bodies.push(Body { name, mesh, colours: None, tint, line, place: 0 });
                    }
                    (None, ..) => self.missing(&member.label),
                }
            }
            let Some(last) = bodies.last_mut() else { return Err(empty(self.subject, Some(moment), None)) };
            if !self.subject.levels.is_empty() {
                // Of the levels the last lies within all others.
                last.tint[3] = 255;
            }
            let triangles: usize = bodies.iter().map(|body| body.mesh.triangles.len()).sum();
            self.line(n, &format!("a group of {} with {triangles} triangles", bodies.len()), begun);
            let name = self.subject.name.clone();
            let parts: Vec<Part> = bodies.iter().map(Body::part).collect();
            self.put(n, &mut |out| glb::write(&parts, &name, &mut { out }))?;
        }
        Ok(())
    }

    fn missing(&mut self, label: &str) {
        let title = format!("`{}` is empty at {label}, which is left out", self.subject.name);
        self.written.notes.push(Diagnostic::warning("empty-section", title));
    }

    /// Whether the format holds no normals.
    pub(super) fn is_bare(&self) -> bool {
        matches!(self.output.format, Format::Stl | Format::ThreeMf)
    }

    /// The checked boundary; none if it is empty.
    fn mesh(
        &mut self,
        node: NodeId,
        shape: &Shape,
        grid: &Grid,
        moment: f64,
    ) -> Result<(Option<Mesh>, String, Report), Diagnostic> {
        let shape = self.subject.at(shape, moment);
        // Creases as they are come from the search, which knows where they lie.
        let searched = self.options.view.sharp && self.options.view.route == Route::Auto;
        if !searched && let Some((mesh, line, report)) = self.star_mesh(node, &shape, grid)? {
            self.say(told::of_report(self.subject, &report));
            return Ok((Some(mesh), line, report));
        }
        let (limits, interrupt, sharp) = (self.shop.limits, self.shop.interrupt, self.options.view.sharp);
        let is_bare = !sharp && self.is_bare();
        let extraction = if is_bare {
            extract_bare(&shape, grid, limits, interrupt)
        } else {
            extract_as(&shape, grid, sharp, limits, interrupt)
        };
        let extraction = extraction.map_err(unmade)?;
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
        self.subject.is_alone("an outline")?;
        self.subject.shown_by("an outline", &["G", "C", "levels"])?;
        let grid = self.subject.grid(self.options.view.cells, self.shop.limits)?;
        let members = self.subject.members(self.shop.graph, Demand::Sign, self.shop.limits)?;
        let colours = colours(self.subject, &members, &self.options.picture);
        let [x, y] = [0, 1].map(|k| self.subject.axes[k].range);
        let single = self.subject.is_single();
        for (n, moment) in self.moments().into_iter().enumerate() {
            let begun = Instant::now();
            let (mut slices, mut corners) = (Vec::new(), Sharpened::default());
            for (member, [r, g, b, _]) in members.iter().zip(&colours) {
                let shape = self.subject.at(&member.shape, moment);
                let sharp = self.options.view.sharp;
                // Corners as they are come from the search, which knows where they lie.
                let searched = sharp && self.options.view.route == Route::Auto;
                let star = if searched { None } else { self.star_outline(member.node, &shape, &grid)? };
                let found = match star {
                    Some(found) => found,
                    None => outlines_as(&shape, &grid, sharp, self.shop.limits, self.shop.interrupt).map_err(unmade)?,
                };
                if let Some(sharpened) = &found.report.sharpened {
                    corners.add(sharpened);
                }
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
            let sharp = if self.options.view.sharp { corners_line(&corners) } else { String::new() };
            self.line(n, &format!("{count} outlines in {full} of {} sections{sharp}", slices.len()), begun);
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
    let Counters { points, boxes, regions, .. } = extraction.report.counters;
    format!(
        "{} triangles, Euler characteristic {}, {points} points and {boxes} boxes evaluated of {} samples{}{}",
        topology.triangles,
        topology.euler,
        extraction.report.samples,
        super::make::regions_line(regions),
        extraction.report.sharpened.as_ref().map(creases_line).unwrap_or_default()
    )
}

/// What became of the cells that creases cross.
fn creases_line(sharpened: &Sharpened) -> String {
    let why = why_plain(sharpened) + &torn_line(sharpened);
    format!(", {} cells sharp, {} left plain{why}", sharpened.cells, sharpened.left())
}

/// What became of the corners of outlines.
fn corners_line(sharpened: &Sharpened) -> String {
    format!(
        ", {} corners, {} left beveled{}{}",
        sharpened.vertices,
        sharpened.left(),
        why_plain(sharpened),
        torn_line(sharpened)
    )
}

fn torn_line(sharpened: &Sharpened) -> String {
    match sharpened.torn {
        0 => String::new(),
        1 => ", 1 torn-off tip put back".to_owned(),
        torn => format!(", {torn} torn-off tips put back"),
    }
}

fn why_plain(sharpened: &Sharpened) -> String {
    let reasons = Plain::ALL.iter().zip(sharpened.plain).filter(|(_, count)| *count > 0);
    let reasons: Vec<String> = reasons.map(|(reason, count)| format!("{count}: {}", reason.told())).collect();
    if reasons.is_empty() { String::new() } else { format!(" ({})", reasons.join(", ")) }
}

fn write_meshes(
    format: Format,
    parts: &[Part<'_>],
    name: &str,
    thumbnail: Option<&[u8]>,
    mut out: &mut dyn Write,
) -> io::Result<()> {
    match format {
        Format::Obj => export::obj::write(parts, &mut out),
        Format::Glb => glb::write(parts, name, &mut out),
        Format::ThreeMf => export::threemf::write(parts, thumbnail, name, &mut out),
        // These hold one object, which was seen to before.
        Format::Ply => parts.iter().take(1).try_for_each(|part| export::ply::write(part, &mut out)),
        _ => parts.iter().take(1).try_for_each(|part| export::stl::write(part, &mut out)),
    }
}
