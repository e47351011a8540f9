//! Axes about a solid: the rear faces of its box with grid lines behind it, numbers and names along the box's outline. Casts no rays.

use super::axes::{Axis, GRID, Look, PAPER, ticks};
use super::camera::Camera;
use super::canvas::{Canvas, Pen};
use super::image::Image;
use super::raycast::Space;
use super::text::{self, Across, Lettering, Upright};

const FACE: [u8; 4] = [246, 247, 249, 255];
const EDGE: [u8; 4] = [120, 120, 120, 255];
/// How opaque faces, grid lines and edges are on a ground of another colour, where they are of ink.
const THIN: [u8; 3] = [10, 40, 130];

/// Puts the axes of a box behind a picture with a transparent ground, seen by the same camera, and room for numbers around it. Through
/// an opaque picture nothing of the box is seen but what lies around it. `ground` is what the box stands on, white unless told. None if
/// there is no memory for it.
#[must_use]
pub fn behind(
    image: &Image,
    camera: &Camera,
    space: Space,
    names: &[String; 3],
    ground: Option<[u8; 4]>,
) -> Option<Image> {
    let look = Look::of(image.width, image.height).on(ground.unwrap_or(PAPER));
    let margin = (look.text * 4.).ceil();
    let size = [image.width, image.height].map(|n| n + 2 * margin as usize);
    let mut canvas = Canvas::new(size[0], size[1], ground.unwrap_or(PAPER))?;
    let axes = [0, 1, 2].map(|k| Axis::new(names[k].clone(), space.lo[k], space.hi[k]));
    let scene = Scene {
        camera,
        space,
        axes,
        picture: [image.width as f64, image.height as f64],
        margin,
        look,
        plain: ground.is_none(),
    };
    for axis in 0..3 {
        for high in [false, true] {
            if !scene.faces(axis, high) {
                scene.face(&mut canvas, axis, high);
            }
        }
    }
    canvas.paste(image, margin as usize, margin as usize);
    for axis in 0..3 {
        scene.numbers(&mut canvas, axis);
    }
    Some(canvas.image())
}

/// The box as the camera sees it.
struct Scene<'a> {
    camera: &'a Camera,
    space: Space,
    axes: [Axis; 3],
    picture: [f64; 2],
    margin: f32,
    look: Look,
    /// Whether it stands on white paper.
    plain: bool,
}

impl Scene<'_> {
    /// The colours of faces, grid lines and edges.
    fn colours(&self) -> [[u8; 4]; 3] {
        let [r, g, b, _] = self.look.ink;
        if self.plain { [FACE, GRID, EDGE] } else { THIN.map(|a| [r, g, b, a]) }
    }

    /// The pixel of a point; none behind the eye.
    fn at(&self, point: [f64; 3]) -> Option<[f32; 2]> {
        let camera = self.camera;
        let from: [f64; 3] = std::array::from_fn(|k| point[k] - camera.eye[k]);
        let along = |axis: [f64; 3]| (0..3).map(|k| from[k] * axis[k]).sum::<f64>();
        let depth = along(camera.forward);
        let half = [0, 1].map(|k| camera.base[k] + depth * camera.growth[k]);
        if !(half[0] > 0. && half[1] > 0.) {
            return None;
        }
        let (u, v) = (along(camera.right) / half[0], along(camera.up) / half[1]);
        let (x, y) = (0.5 * (1. + u) * self.picture[0], 0.5 * (1. - v) * self.picture[1]);
        Some([x as f32 + self.margin, y as f32 + self.margin])
    }

    /// The corner with the high end of an axis where asked for.
    fn corner(&self, high: [bool; 3]) -> [f64; 3] {
        std::array::from_fn(|k| if high[k] { self.space.hi[k] } else { self.space.lo[k] })
    }

    /// Whether a face turns its outside to the eye. A face seen edge-on does not.
    fn faces(&self, axis: usize, high: bool) -> bool {
        let camera = self.camera;
        let outward = if high { 1. } else { -1. };
        let parallel = camera.growth == [0.; 2];
        let to_eye = if parallel { -camera.forward[axis] } else { camera.eye[axis] - self.corner([high; 3])[axis] };
        outward * to_eye > 1e-12
    }

    /// A rear face with its grid lines.
    fn face(&self, canvas: &mut Canvas, axis: usize, high: bool) {
        let (a, b) = ((axis + 1) % 3, (axis + 2) % 3);
        let corner = |p: bool, q: bool| {
            let mut ends = [high; 3];
            (ends[a], ends[b]) = (p, q);
            self.corner(ends)
        };
        let outline = [(false, false), (true, false), (true, true), (false, true)].map(|(p, q)| corner(p, q));
        let Some(points) = outline.iter().map(|&p| self.at(p)).collect::<Option<Vec<_>>>() else { return };
        let [face, grid, edge] = self.colours();
        canvas.fill(&points, face);
        let pen = Pen::solid(grid, self.look.thin);
        for (along, across) in [(a, b), (b, a)] {
            for value in self.marks(along) {
                let mut ends = [corner(false, false); 2];
                (ends[0][along], ends[1][along]) = (value, value);
                ends[1][across] = self.space.hi[across];
                if let [Some(from), Some(to)] = ends.map(|p| self.at(p)) {
                    canvas.line(&[from, to], false, &pen);
                }
            }
        }
        canvas.line(&points, true, &Pen::solid(edge, self.look.thin));
    }

    /// The values marked on an axis: the same on faces and on the outline.
    fn marks(&self, axis: usize) -> Vec<f64> {
        self.outline(axis)
            .map_or_else(Vec::new, |edge| ticks(self.axes[axis].lo, self.axes[axis].hi, edge.room(self.look)).values)
    }

    /// The edge along an axis that carries its numbers: one of the outline, the lowest, or for the upright axis the leftmost.
    fn outline(&self, axis: usize) -> Option<Edge> {
        let (a, b) = ((axis + 1) % 3, (axis + 2) % 3);
        let edges = [(false, false), (true, false), (true, true), (false, true)].into_iter().filter_map(|(p, q)| {
            let mut ends = [[false; 3]; 2];
            for (end, high) in ends.iter_mut().zip([false, true]) {
                (end[axis], end[a], end[b]) = (high, p, q);
            }
            // Of the outline: one of the two faces that meet here is seen, the other is not.
            let outer = self.faces(a, p) != self.faces(b, q);
            let points = [self.at(self.corner(ends[0]))?, self.at(self.corner(ends[1]))?];
            outer.then_some(Edge { high: ends[0], points })
        });
        let place = |edge: &Edge| {
            let [from, to] = edge.points;
            if axis == 2 { -(from[0] + to[0]) } else { from[1] + to[1] }
        };
        edges.max_by(|x, y| place(x).total_cmp(&place(y))).filter(|edge| edge.length() > 3. * self.look.text)
    }

    /// Marks, numbers and the name along the axis's edge of the outline, on the side away from the box.
    fn numbers(&self, canvas: &mut Canvas, axis: usize) {
        let Some(edge) = self.outline(axis) else { return };
        let middle: [f64; 3] = std::array::from_fn(|k| 0.5 * (self.space.lo[k] + self.space.hi[k]));
        let Some(centre) = self.at(middle) else { return };
        let (away, size) = (edge.away(centre), self.look.text);
        let marks = ticks(self.axes[axis].lo, self.axes[axis].hi, edge.room(self.look));
        let shift = |p: [f32; 2], by: f32| [p[0] + away[0] * by, p[1] + away[1] * by];
        let mut widest = 0_f32;
        for (&value, label) in marks.values.iter().zip(&marks.labels) {
            let mut point = self.corner(edge.high);
            point[axis] = value;
            let Some(foot) = self.at(point) else { continue };
            canvas.line(&[foot, shift(foot, size * 0.35)], false, &Pen::solid(self.look.ink, self.look.thin));
            let half = half_extent(label, size, away);
            self.write(canvas, label, shift(foot, size * 0.65 + half), size);
            widest = widest.max(2. * half);
        }
        canvas.line(&edge.points, false, &Pen::solid(self.look.ink, self.look.thin));
        let name = format!("{} {}", self.axes[axis].name, marks.factor());
        let name = name.trim();
        let [from, to] = edge.points;
        let half = half_extent(name, size, away);
        let foot = [0.5 * (from[0] + to[0]), 0.5 * (from[1] + to[1])];
        self.write(canvas, name, shift(foot, size * 1.1 + widest + half), size * 1.05);
    }

    /// A text centred on a point, moved onto the sheet if it would be cut off.
    fn write(&self, canvas: &mut Canvas, text: &str, at: [f32; 2], size: f32) {
        let half = 0.5 * text::width(text, size) + 1.;
        let width = self.picture[0] as f32 + 2. * self.margin;
        let height = self.picture[1] as f32 + 2. * self.margin;
        let at = [at[0].min(width - half).max(half), at[1].min(height - size).max(size)];
        let lettering =
            Lettering { size, colour: self.look.ink, across: Across::Middle, upright: Upright::Middle, turn: 0. };
        canvas.text(text, at, &lettering);
    }
}

/// How far a text centred on a point reaches in a direction.
fn half_extent(text: &str, size: f32, away: [f32; 2]) -> f32 {
    0.5 * (away[0].abs() * text::width(text, size) + away[1].abs() * size * text::CAPITAL)
}

/// An edge of the box in pixels.
struct Edge {
    high: [bool; 3],
    points: [[f32; 2]; 2],
}

impl Edge {
    fn length(&self) -> f32 {
        let [from, to] = self.points;
        ((to[0] - from[0]).powi(2) + (to[1] - from[1]).powi(2)).sqrt()
    }

    /// How many marks have room along it.
    fn room(&self, look: Look) -> usize {
        ((self.length() / (look.text * 3.2)) as usize).clamp(2, 8)
    }

    /// The unit vector at right angles to it that points away from a pixel.
    fn away(&self, centre: [f32; 2]) -> [f32; 2] {
        let ([from, to], length) = (self.points, self.length());
        let normal = [(from[1] - to[1]) / length, (to[0] - from[0]) / length];
        let side = (0..2).map(|k| normal[k] * (0.5 * (from[k] + to[k]) - centre[k])).sum::<f32>();
        if side < 0. { normal.map(|n| -n) } else { normal }
    }
}
