//! Meshes as 3MF packages in millimetres, with colours and a thumbnail. Streams the package and never seeks.
//!
//! A model of millions of triangles goes straight into the compressor: no tree of it is ever built.

use super::{Part, fits_together, refuse};
use crate::surface::mesh::Mesh;
use std::collections::BTreeMap;
use std::io::{self, Write};
use zip::ZipWriter;
use zip::write::{SimpleFileOptions, StreamWriter};

const TYPES: &str = r#"<?xml version="1.0" encoding="UTF-8"?>
<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types">
<Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/>
<Default Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/>
<Default Extension="png" ContentType="image/png"/>
</Types>
"#;

const RELATIONS: &str = r#"<?xml version="1.0" encoding="UTF-8"?>
<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">
<Relationship Id="rel0" Target="/3D/3dmodel.model" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/>
"#;

const THUMBNAIL: &str = r#"<Relationship Id="rel1" Target="/Metadata/thumbnail.png" Type="http://schemas.openxmlformats.org/package/2006/relationships/metadata/thumbnail"/>
"#;

const CORE: &str = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02";
const MATERIAL: &str = "http://schemas.microsoft.com/3dmanufacturing/material/2015/02";

/// A vertex and a triangle take at most this many bytes as text; 32-bit lengths of a package part end at 4 GiB.
const VERTEX_BYTES: u64 = 96;
const TRIANGLE_BYTES: u64 = 128;

type Package<'a, W> = ZipWriter<StreamWriter<Gate<'a, W>>>;

/// Writes meshes, each as an object of its own with its colours, and the bytes of a PNG as thumbnail if there is one. `name` is that of
/// the whole.
///
/// # Errors
/// Those of the writer; `InvalidInput` without a part, for an empty mesh or arrays that do not fit together.
pub fn write<W: Write>(parts: &[Part<'_>], thumbnail: Option<&[u8]>, name: &str, out: &mut W) -> io::Result<()> {
    if parts.is_empty() {
        return Err(refuse("there is no mesh to write"));
    }
    parts.iter().try_for_each(fits_together)?;
    let bytes = |mesh: &Mesh| mesh.positions.len() as u64 * VERTEX_BYTES + mesh.triangles.len() as u64 * TRIANGLE_BYTES;
    let text: u64 = parts.iter().map(|part| bytes(part.mesh)).sum();
    let small = SimpleFileOptions::default().compression_method(zip::CompressionMethod::Deflated);
    let mut package = ZipWriter::new_stream(Gate { out, shut: false });
    package.start_file("[Content_Types].xml", small)?;
    package.write_all(TYPES.as_bytes())?;
    package.start_file("_rels/.rels", small)?;
    package.write_all(RELATIONS.as_bytes())?;
    if thumbnail.is_some() {
        package.write_all(THUMBNAIL.as_bytes())?;
    }
    package.write_all(b"</Relationships>\n")?;
    package.start_file("3D/3dmodel.model", small.large_file(text > u64::from(u32::MAX)))?;
    model(&mut package, parts, name)?;
    if let Some(png) = thumbnail {
        package.start_file("Metadata/thumbnail.png", small.compression_method(zip::CompressionMethod::Stored))?;
        package.write_all(png)?;
    }
    package.finish()?.into_inner().flush()
}

/// Lets everything through until a write fails, and swallows what comes after. The package's writer would otherwise try to complete the
/// failed file while it is dropped, and complain to standard error by itself.
struct Gate<'a, W> {
    out: &'a mut W,
    shut: bool,
}

impl<W: Write> Write for Gate<'_, W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        if self.shut {
            return Ok(bytes.len());
        }
        let result = self.out.write(bytes);
        // Interruptions by signals are tried again and are no failure; a writer that takes nothing is full.
        self.shut = match &result {
            Ok(taken) => *taken == 0 && !bytes.is_empty(),
            Err(error) => error.kind() != io::ErrorKind::Interrupted,
        };
        result
    }

    fn flush(&mut self) -> io::Result<()> {
        if self.shut { Ok(()) } else { self.out.flush() }
    }
}

fn model<W: Write>(out: &mut Package<W>, parts: &[Part<'_>], name: &str) -> io::Result<()> {
    let mut out = io::BufWriter::with_capacity(1 << 16, out);
    writeln!(out, r#"<?xml version="1.0" encoding="UTF-8"?>"#)?;
    write!(out, r#"<model unit="millimeter" xml:lang="en-US" xmlns="{CORE}""#)?;
    if parts.iter().any(|part| part.colours.is_some_and(varies)) {
        write!(out, r#" xmlns:m="{MATERIAL}""#)?;
    }
    writeln!(out, ">")?;
    writeln!(out, r#"<metadata name="Title">{}</metadata>"#, escaped(name))?;
    writeln!(out, r#"<metadata name="Application">yont</metadata>"#)?;
    writeln!(out, "<resources>")?;
    // What a number names must stand above its use: colours take the odd numbers, objects the even ones.
    for (n, part) in parts.iter().enumerate() {
        object(&mut out, part, 2 * n + 1)?;
    }
    writeln!(out, "</resources>")?;
    write!(out, "<build>")?;
    for n in 0..parts.len() {
        write!(out, r#"<item objectid="{}"/>"#, 2 * n + 2)?;
    }
    writeln!(out, "</build>")?;
    writeln!(out, "</model>")?;
    out.flush()
}

/// One object and before it its colours, which have the number `id` as the object has the next one.
fn object(out: &mut impl Write, part: &Part<'_>, id: usize) -> io::Result<()> {
    let Part { name, mesh, colours, .. } = *part;
    let numbers = match colours {
        Some(colours) if varies(colours) => Some(colour_group(out, colours, id)?),
        Some(&[colour, ..]) => {
            base_material(out, name, colour, id)?;
            None
        }
        _ => None,
    };
    let material = if colours.is_some() { format!(r#" pid="{id}" pindex="0""#) } else { String::new() };
    writeln!(out, r#"<object id="{}" type="model" name="{}"{material}><mesh><vertices>"#, id + 1, escaped(name))?;
    for position in &mesh.positions {
        // Adding zero turns -0 into 0.
        let [x, y, z] = position.map(|x| x as f32 + 0.);
        writeln!(out, r#"<vertex x="{x}" y="{y}" z="{z}"/>"#)?;
    }
    writeln!(out, "</vertices><triangles>")?;
    for &[a, b, c] in &mesh.triangles {
        write!(out, r#"<triangle v1="{a}" v2="{b}" v3="{c}""#)?;
        if let Some(numbers) = &numbers {
            let [a, b, c] = [a, b, c].map(|corner| numbers[corner as usize]);
            write!(out, r#" pid="{id}" p1="{a}" p2="{b}" p3="{c}""#)?;
        }
        writeln!(out, "/>")?;
    }
    writeln!(out, "</triangles></mesh></object>")
}

/// Whether the vertices have more than one colour.
fn varies(colours: &[[u8; 3]]) -> bool {
    colours.windows(2).any(|pair| pair[0] != pair[1])
}

/// One colour for the whole object, as the core of the format has it: programs without its extension for colours know it too.
fn base_material(out: &mut impl Write, name: &str, [r, g, b]: [u8; 3], id: usize) -> io::Result<()> {
    let name = escaped(name);
    writeln!(
        out,
        r##"<basematerials id="{id}"><base name="{name}" displaycolor="#{r:02X}{g:02X}{b:02X}"/></basematerials>"##
    )
}

/// Writes each colour once, in the order of first use, and tells which number each vertex has in that list.
fn colour_group(out: &mut impl Write, colours: &[[u8; 3]], id: usize) -> io::Result<Vec<u32>> {
    let mut seen = BTreeMap::new();
    let mut numbers = Vec::with_capacity(colours.len());
    writeln!(out, r#"<m:colorgroup id="{id}">"#)?;
    for colour in colours {
        let next = seen.len() as u32;
        let number = *seen.entry(colour).or_insert(next);
        if number == next {
            let [r, g, b] = colour;
            writeln!(out, r##"<m:color color="#{r:02X}{g:02X}{b:02X}"/>"##)?;
        }
        numbers.push(number);
    }
    writeln!(out, "</m:colorgroup>")?;
    Ok(numbers)
}

/// A name as XML text and attribute value; control characters, which XML cannot hold, are left out.
fn escaped(name: &str) -> String {
    let mut text = String::with_capacity(name.len());
    for c in name.chars().filter(|c| !c.is_control()) {
        match c {
            '&' => text.push_str("&amp;"),
            '<' => text.push_str("&lt;"),
            '>' => text.push_str("&gt;"),
            '"' => text.push_str("&quot;"),
            '\u{fffe}' | '\u{ffff}' => {}
            c => text.push(c),
        }
    }
    text
}
