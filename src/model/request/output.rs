//! Where results go: the format by the extension, numbered names, standard output. Knows names, not contents.

use std::path::PathBuf;

use crate::diagnostic::near::{Candidate, suggest};

/// What can be made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// A mesh of triangles, binary.
    Stl,
    /// A mesh with normals and colours, text.
    Obj,
    /// A mesh with normals and colours, binary.
    Ply,
    /// A mesh with normals and colours, binary, moving over T.
    Glb,
    /// A mesh for printing, with colours and a picture of it.
    ThreeMf,
    /// A mesh with normals and colours, and where it can be the formula, as a scene for POV-Ray.
    Pov,
    /// A picture.
    Png,
    /// Outlines in the plane.
    Svg,
    /// An animation over T, in at most 256 colours.
    Gif,
    /// An animation over T, in all colours.
    Apng,
    /// The function, sampled on a grid.
    Nrrd,
}

/// The kinds of result that the formats hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// The boundary.
    Mesh,
    /// One picture.
    Picture,
    /// The boundary in the plane.
    Outlines,
    /// Pictures over T.
    Animation,
    /// Values on a grid.
    Samples,
}

/// The one list of formats: what is made, its extension, what it is called, what it holds.
pub const FORMATS: &[(Format, &str, &str, Kind)] = &[
    (Format::Stl, "stl", "a mesh of triangles, binary", Kind::Mesh),
    (Format::Obj, "obj", "a mesh with normals and colours, text", Kind::Mesh),
    (Format::Ply, "ply", "a mesh with normals and colours, binary", Kind::Mesh),
    (Format::Glb, "glb", "a mesh for viewers, binary; over T it moves, groups show through", Kind::Mesh),
    (Format::ThreeMf, "3mf", "a mesh for printing, in millimetres, with colours", Kind::Mesh),
    (Format::Pov, "pov", "a scene for POV-Ray: a mesh, and the formula where it has one", Kind::Mesh),
    (Format::Png, "png", "a picture, a graph or a contour map", Kind::Picture),
    (Format::Svg, "svg", "outlines of a plane figure, or slices of a solid (--slices)", Kind::Outlines),
    (Format::Gif, "gif", "an animation over T", Kind::Animation),
    (Format::Apng, "apng", "an animation over T, in all colours", Kind::Animation),
    (Format::Nrrd, "nrrd", "the function, sampled on a grid", Kind::Samples),
];

impl Format {
    fn entry(self) -> &'static (Format, &'static str, &'static str, Kind) {
        FORMATS.iter().find(|entry| entry.0 == self).unwrap_or(&FORMATS[0])
    }

    /// What the format holds.
    #[must_use]
    pub fn kind(self) -> Kind {
        self.entry().3
    }

    /// The extension, without its dot.
    #[must_use]
    pub fn extension(self) -> &'static str {
        self.entry().1
    }

    /// The format with that extension, in any case.
    #[must_use]
    pub fn by_extension(extension: &str) -> Option<Self> {
        FORMATS.iter().find(|entry| entry.1.eq_ignore_ascii_case(extension)).map(|entry| entry.0)
    }
}

/// Where one result goes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Target {
    /// Standard output.
    Standard,
    /// A file.
    File(PathBuf),
    /// One file a frame: what stands before and after `{n}`.
    Series {
        /// Before the number, folders included.
        before: String,
        /// After the number, extension included.
        after: String,
    },
}

/// One output.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Output {
    /// Where it goes.
    pub target: Target,
    /// What is made.
    pub format: Format,
}

impl Output {
    /// Reads the argument of `-o`; `format` is the one of `--format`.
    ///
    /// # Errors
    /// Words for the user when the extension is unknown or missing, and when `-` comes without `--format`.
    pub fn parse(text: &str, format: Option<Format>) -> Result<Self, String> {
        if text == "-" {
            let format = format.ok_or("`-o -` needs --format: standard output has no extension")?;
            return Ok(Self { target: Target::Standard, format });
        }
        let path = PathBuf::from(text);
        let format = match path.extension().and_then(|e| e.to_str()) {
            Some(extension) => Format::by_extension(extension)
                .ok_or_else(|| format!("`{text}`: no format has the extension `.{extension}`; {}", meant(extension)))?,
            None => return Err(format!("`{text}` has no extension to tell the format; {}", known())),
        };
        match text.split_once("{n}") {
            None => Ok(Self { target: Target::File(path), format }),
            Some(_) if format.kind() == Kind::Animation => {
                Err(format!("`{text}`: one {} holds all frames; leave out `{{n}}`", format.extension().to_uppercase()))
            }
            Some((before, after)) => {
                Ok(Self { target: Target::Series { before: before.into(), after: after.into() }, format })
            }
        }
    }
}

/// The name of frame `n` of a series of `count`: at least three digits, all of the same width.
#[must_use]
pub fn numbered(before: &str, after: &str, n: usize, count: usize) -> PathBuf {
    let digits = count.saturating_sub(1).to_string().len().max(3);
    PathBuf::from(format!("{before}{n:0digits$}{after}"))
}

/// The extension that was probably meant, or all there are.
fn meant(extension: &str) -> String {
    let lower = extension.to_ascii_lowercase();
    let all = FORMATS.iter().map(|entry| Candidate { name: entry.1, preferred: false });
    match (suggest(&lower, all).first(), extension) {
        (Some(near), _) => format!("did you mean `.{near}`?"),
        (None, "jpg" | "jpeg" | "bmp" | "webp" | "tif" | "tiff") => "a picture is a `.png`".into(),
        (None, "mp4" | "webm" | "avi") => "an animation is a `.gif` or an `.apng`".into(),
        (None, "step" | "stp" | "iges" | "off" | "amf" | "fbx" | "gltf") => {
            "a mesh is a `.stl .obj .ply .glb .3mf` or `.pov`".into()
        }
        (None, _) => known(),
    }
}

fn known() -> String {
    let all: Vec<String> = FORMATS.iter().map(|entry| format!(".{}", entry.1)).collect();
    format!("the formats are {}", all.join(" "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_extension_decides() {
        let file = |text: &str| Output::parse(text, None).map(|output| output.format);
        assert_eq!(file("a.stl"), Ok(Format::Stl));
        assert_eq!(file("b/c.d/a.NRRD"), Ok(Format::Nrrd));
        assert!(file("a.doc").is_err_and(|e| e.contains(".stl .obj .ply .glb .3mf .pov .png .svg .gif .apng")));
        assert!(file("a.slt").is_err_and(|e| e.contains("did you mean `.stl`")));
        assert!(file("a.jpg").is_err_and(|e| e.contains("`.png`")));
        assert!(file("a").is_err_and(|e| e.contains("no extension")));
        assert!(file("-").is_err_and(|e| e.contains("--format")));
        assert_eq!(file("a{n}.glb"), Ok(Format::Glb));
        assert!(file("a{n}.gif").is_err_and(|e| e.contains("all frames")));
    }

    #[test]
    fn frames_are_numbered_from_zero_with_three_digits_or_more() {
        let name = |n, count| numbered("d/f-", ".stl", n, count).display().to_string();
        assert_eq!([name(0, 9), name(8, 9), name(999, 1000)], ["d/f-000.stl", "d/f-008.stl", "d/f-999.stl"]);
        assert_eq!([name(7, 1001), name(1000, 1001)], ["d/f-0007.stl", "d/f-1000.stl"]);
    }
}
