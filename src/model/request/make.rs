//! Makes what an output asks for and hands it to the host, whole or not at all: meshes, pictures, animations, sampled fields.

use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::time::Instant;

use crate::diagnostic::{Category, Diagnostic};
use crate::export;
use crate::field::Graph;
use crate::host::Host;
use crate::interrupt::{Cancelled, Interrupt};
use crate::limits::Limits;
use crate::picture::Image;
use crate::picture::field::sample;
use crate::surface::marching::Report;
use crate::surface::sampler::Counters;
use crate::surface::space::reach;
use crate::vm::region::Counts;
use crate::vm::{Demand, Shape};

use super::output::{Format, Kind, Output, Target, numbered};
use super::subject::Subject;
use super::told::{self, empty};
use super::{Background, Options, pictures};

/// What was written, and what there is to say of it.
#[derive(Debug, Default)]
pub struct Written {
    /// The files, in order.
    pub files: Vec<PathBuf>,
    /// A line for each result: what it is, what it cost.
    pub lines: Vec<String>,
    /// Notes and warnings.
    pub notes: Vec<Diagnostic>,
}

/// What the work needs of the session, without the session.
pub struct Workshop<'a> {
    /// The graph in which the subject stands.
    pub graph: &'a Graph,
    /// Bounds of memory, frames and sizes.
    pub limits: &'a Limits,
    /// Asked and told by every long loop.
    pub interrupt: &'a Interrupt,
    /// Where files go.
    pub host: &'a dyn Host,
    /// The guide shape of the star route.
    pub guide: super::way::Ready,
}

impl Workshop<'_> {
    /// Why an output shows nothing of a subject: there is nothing, or it is too small or lies beside what is seen.
    pub(super) fn nothing(&self, subject: &Subject, moment: Option<f64>, report: Option<&Report>) -> Diagnostic {
        // Enough for a point of it; where it ends is told roughly.
        const PART: f64 = 1e-2;
        let of = |one: &Subject| {
            let shape = one.shape(self.graph, Demand::Sign, self.limits).ok()?;
            let shape = moment.map_or_else(|| shape.clone(), |moment| one.at(&shape, moment));
            let axes = one.axes.iter().map(|axis| (axis.range[0], axis.range[1]));
            let ranges: Vec<(f64, f64)> = axes.chain(shape.fixed.iter().map(|&value| (value, value))).collect();
            reach(shape.program, &ranges, PART, self.limits.search_operations / 30, self.interrupt).ok()?
        };
        let is_found = subject.columns.is_none() && subject.rows.is_none() && subject.all().all(Subject::is_single);
        match subject.all().filter(|_| is_found).find_map(|one| Some((one, of(one)?))) {
            Some((one, found)) => told::unseen(one, moment, &found, report),
            None => empty(subject, moment, report),
        }
    }
}

/// The diagnostic of a computation that was stopped.
#[must_use]
pub fn cancelled() -> Diagnostic {
    Diagnostic::error("cancelled", "stopped; nothing was written").category(Category::Cancelled)
}

impl From<Cancelled> for Diagnostic {
    fn from(_: Cancelled) -> Self {
        cancelled()
    }
}

/// Makes one output of a subject.
///
/// # Errors
/// A diagnostic whose category decides the exit status; then nothing was written but the earlier frames of a series.
pub fn make(
    shop: &Workshop<'_>,
    subject: &Subject,
    output: &Output,
    options: &Options,
    standard: &mut dyn Write,
) -> Result<Written, Diagnostic> {
    let written = Written { notes: subject.notes.clone(), ..Written::default() };
    let mut making = Making { shop, subject, output, options, standard, written };
    match output.format.kind() {
        Kind::Mesh => making.meshes()?,
        Kind::Picture => making.pictures()?,
        Kind::Outlines => making.outlines()?,
        Kind::Animation => making.animation()?,
        Kind::Samples => making.samples()?,
    }
    Ok(making.written)
}

/// One output on its way.
pub(super) struct Making<'a> {
    pub(super) shop: &'a Workshop<'a>,
    pub(super) subject: &'a Subject,
    pub(super) output: &'a Output,
    pub(super) options: &'a Options,
    standard: &'a mut dyn Write,
    pub(super) written: Written,
}

impl Making<'_> {
    fn pictures(&mut self) -> Result<(), Diagnostic> {
        let moments = self.moments();
        let artist = pictures::Artist::new(self.shop, self.subject, self.options, &moments)?;
        self.written.notes.extend(artist.notes(self.options));
        if self.subject.axes.len() == 3 {
            let node = self.subject.levels.first().map_or(self.subject.node, |level| level.node);
            let shape = self.subject.shape_of(node, self.shop.graph, Demand::Sign, self.shop.limits)?;
            let shape = self.subject.at(&shape, moments[0]);
            let cut = crate::surface::space::cut(&shape, &self.subject.bounds(), self.shop.interrupt);
            self.say(told::cut(self.subject, &cut));
        }
        for (n, moment) in moments.into_iter().enumerate() {
            let begun = Instant::now();
            let picture = artist.picture(moment, self.shop.interrupt)?;
            self.undefined(&picture.counters);
            if picture.hits == 0 {
                return Err(self.shop.nothing(self.subject, Some(moment), None));
            }
            self.line(n, &picture_line(&picture.image, &picture.counters), begun);
            self.put(n, &mut |out| export::png::write(&picture.image, &mut { out }))?;
        }
        Ok(())
    }

    fn animation(&mut self) -> Result<(), Diagnostic> {
        let moments = self.subject.moments();
        if self.subject.time.is_none() {
            let title = format!("nothing of `{}` moves: an animation of one frame", self.subject.name);
            let help = "give a coordinate the type T and a range: `x4 : T; x4min = 0; x4max = 1; x4_delta = 0.1;`";
            self.written.notes.push(Diagnostic::warning("no-motion", title).help(help));
        }
        if self.output.format == Format::Gif && self.options.picture.background == Some(Background::Transparent) {
            let title = "a GIF has no pixels that are transparent in part, and would have jagged edges";
            let help = "ask for an .apng, or for another --background";
            return Err(Diagnostic::error("no-transparency", title).category(Category::Usage).help(help));
        }
        let begun = Instant::now();
        let artist = pictures::Artist::new(self.shop, self.subject, self.options, &moments)?;
        self.written.notes.extend(artist.notes(self.options));
        let (mut frames, mut counters, mut hits) = (Vec::new(), Counters::default(), 0);
        for &moment in &moments {
            let picture = artist.picture(moment, self.shop.interrupt)?;
            let bytes = moments.len() * Image::memory(picture.image.width, picture.image.height);
            self.subject.within_memory(bytes as u64, self.shop.limits)?;
            hits += picture.hits;
            counters.add(picture.counters);
            frames.push(picture.image);
        }
        self.undefined(&counters);
        if hits == 0 {
            return Err(self.shop.nothing(self.subject, None, None));
        }
        let what = format!("{} frames, {}", frames.len(), picture_line(&frames[0], &counters));
        self.line(0, &what, begun);
        let delay = self.delay();
        let write = if self.output.format == Format::Apng { write_apng } else { write_gif };
        self.put(0, &mut |out| write(&frames, delay, out))
    }

    /// Seconds that a frame stays.
    pub(super) fn delay(&self) -> f64 {
        1.0 / self.options.timing.fps.clamp(0.01, 100.0)
    }

    fn samples(&mut self) -> Result<(), Diagnostic> {
        self.subject.is_alone("a sampled field")?;
        self.subject.shown_by("a sampled field", &["levels"])?;
        let cells = self.subject.along(self.options.view.cells)?;
        let space: Vec<(f64, f64)> = self.subject.bounds().iter().map(|[lo, hi]| (*lo, *hi)).collect();
        if space.is_empty() {
            return self.need(3, "a sampled field");
        }
        let longest = space.iter().map(|(lo, hi)| hi - lo).fold(0.0, f64::max);
        let samples: f64 = space.iter().map(|(lo, hi)| (hi - lo) / longest * cells as f64 + 2.0).product();
        self.subject.within_memory((4.0 * samples) as u64, self.shop.limits)?;
        let shape = self.shape(Demand::Value)?;
        for (n, moment) in self.moments().into_iter().enumerate() {
            let begun = Instant::now();
            let field = sample(&self.subject.at(&shape, moment), &space, cells, self.shop.interrupt)?;
            self.undefined(&field.counters);
            let size: Vec<String> = field.size.iter().map(ToString::to_string).collect();
            self.line(n, &format!("{} samples", size.join(" x ")), begun);
            let written = export::nrrd::Field {
                name: &self.subject.name,
                size: &field.size,
                origin: &field.origin,
                spacing: &field.spacing,
                samples: export::nrrd::Samples::Singles(&field.samples),
            };
            self.put(n, &mut |out| export::nrrd::write(&written, export::nrrd::Encoding::Gzip, &mut { out }))?;
        }
        Ok(())
    }

    fn shape(&self, demand: Demand) -> Result<Shape, Diagnostic> {
        let _phase = self.shop.interrupt.phase("compile");
        self.subject.shape(self.shop.graph, demand, self.shop.limits)
    }

    fn is_series(&self) -> bool {
        matches!(self.output.target, Target::Series { .. })
    }

    /// Whether one file holds all frames.
    pub(super) fn holds_all(&self) -> bool {
        let moves = self.output.format == Format::Glb && self.subject.is_single();
        self.output.format.kind() == Kind::Animation || moves && !self.is_series()
    }

    /// The moments that this output shows: all frames, or the first.
    pub(super) fn moments(&mut self) -> Vec<f64> {
        let mut moments = self.subject.moments();
        if self.is_series() || self.holds_all() {
            return moments;
        }
        if let Some(time) = self.subject.time.as_ref().filter(|_| moments.len() > 1) {
            let c = time.coordinate;
            let title = format!("this shows {c} = {}, the first of {} frames", moments[0], moments.len());
            let help = format!("--at {c}=... shows another moment; a name with {{n}} writes all frames");
            self.written.notes.push(Diagnostic::note("first-frame", title).help(help));
        }
        moments.truncate(1);
        moments
    }

    pub(super) fn need(&self, axes: usize, what: &str) -> Result<(), Diagnostic> {
        if self.subject.axes.len() == axes {
            return Ok(());
        }
        let have: Vec<String> = self.subject.axes.iter().map(|a| a.coordinate.to_string()).collect();
        let name = &self.subject.name;
        let list = if have.is_empty() { String::new() } else { format!(": {}", have.join(", ")) };
        let title = format!("{what} needs {axes} axes; `{name}` has {} here{list}", have.len());
        let help = if have.len() < axes {
            "make a further coordinate an axis (`x3 : Z; x3min = -1; x3max = 1;`), or ask for a .png".into()
        } else {
            let last = &have[have.len() - 1];
            format!("cut it into slices, --slices {last}=LO:HI:N, or take one section: --at {last}=0")
        };
        Err(Diagnostic::error("dimension", title).help(help))
    }

    /// Writes the n-th result to its file or to standard output.
    pub(super) fn put(
        &mut self,
        n: usize,
        content: &mut dyn FnMut(&mut dyn Write) -> io::Result<()>,
    ) -> Result<(), Diagnostic> {
        self.shop.interrupt.tick()?;
        let path = match &self.output.target {
            Target::Standard => return to_standard(self.standard, content),
            Target::File(path) => path.clone(),
            Target::Series { before, after } => numbered(before, after, n, self.subject.moments().len()),
        };
        let _phase = self.shop.interrupt.phase("write");
        self.shop.host.write_whole(Path::new(&path), content).map_err(|error| error.diagnostic())?;
        self.written.files.push(path);
        Ok(())
    }

    pub(super) fn line(&mut self, n: usize, what: &str, begun: Instant) {
        let frame = match &self.subject.time {
            Some(time) if self.is_series() => {
                format!("frame {n} ({} = {}): ", time.coordinate, time.values[n])
            }
            _ => String::new(),
        };
        self.written.lines.push(format!("{frame}{what}, {:.0} ms", begun.elapsed().as_secs_f64() * 1e3));
    }

    /// Adds what was not said before.
    pub(super) fn say(&mut self, told: impl IntoIterator<Item = Diagnostic>) {
        for diagnostic in told {
            if !self.written.notes.iter().any(|said| said.code == diagnostic.code) {
                self.written.notes.push(diagnostic);
            }
        }
    }

    pub(super) fn undefined(&mut self, counters: &Counters) {
        self.shop.interrupt.count("points", counters.points);
        self.shop.interrupt.count("boxes", counters.boxes);
        self.say(told::undefined(self.subject, counters));
    }
}

fn to_standard(
    standard: &mut dyn Write,
    content: &mut dyn FnMut(&mut dyn Write) -> io::Result<()>,
) -> Result<(), Diagnostic> {
    match content(standard).and_then(|()| standard.flush()) {
        Ok(()) => Ok(()),
        // A reader that has seen enough is no error.
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(()),
        Err(error) => {
            let title = format!("standard output could not be written: {error}");
            Err(Diagnostic::error("not-written", title).category(Category::File))
        }
    }
}

fn picture_line(image: &Image, counters: &Counters) -> String {
    format!(
        "{} x {} pixels, {} points and {} boxes evaluated{}",
        image.width,
        image.height,
        counters.points,
        counters.boxes,
        regions_line(counters.regions)
    )
}

/// What loops and searches took, behind the rest of a line; nothing if there was none.
pub(super) fn regions_line(counts: Counts) -> String {
    let mut line = String::new();
    for (count, what) in [(counts.turns, "turns of loops"), (counts.searches, "searches for a highest value")] {
        if count > 0 {
            line += &format!(", {count} {what}");
        }
    }
    line
}

fn write_gif(frames: &[Image], delay: f64, out: &mut dyn Write) -> io::Result<()> {
    export::gif::write(frames, delay, &mut { out })
}

fn write_apng(frames: &[Image], delay: f64, out: &mut dyn Write) -> io::Result<()> {
    export::apng::write(frames, delay, &mut { out })
}
