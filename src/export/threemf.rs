//! Meshes as 3MF packages in millimetres, with colours and a thumbnail. Streams the package and never seeks.
//!
//! A model of millions of triangles goes straight into the compressor: no tree of it is ever built.

use super::fits_together;
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

/// Writes one mesh: one sRGB colour for each vertex if there are any, and the bytes of a PNG as thumbnail if there is one.
///
/// # Errors
/// Those of the writer; `InvalidInput` for an empty mesh or arrays that do not fit together.
pub fn write<W: Write>(
    mesh: &Mesh,
    colours: Option<&[[u8; 3]]>,
    thumbnail: Option<&[u8]>,
    name: &str,
    out: &mut W,
) -> io::Result<()> {
    fits_together(mesh, colours)?;
    let text = mesh.positions.len() as u64 * VERTEX_BYTES + mesh.triangles.len() as u64 * TRIANGLE_BYTES;
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
    model(&mut package, mesh, colours, name)?;
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

fn model<W: Write>(out: &mut Package<W>, mesh: &Mesh, colours: Option<&[[u8; 3]]>, name: &str) -> io::Result<()> {
    let mut out = io::BufWriter::with_capacity(1 << 16, out);
    writeln!(out, r#"<?xml version="1.0" encoding="UTF-8"?>"#)?;
    write!(out, r#"<model unit="millimeter" xml:lang="en-US" xmlns="{CORE}""#)?;
    if colours.is_some() {
        write!(out, r#" xmlns:m="{MATERIAL}""#)?;
    }
    writeln!(out, ">")?;
    writeln!(out, r#"<metadata name="Title">{}</metadata>"#, escaped(name))?;
    writeln!(out, r#"<metadata name="Application">yont</metadata>"#)?;
    writeln!(out, "<resources>")?;
    let numbers = colours.map(|colours| colour_group(&mut out, colours)).transpose()?;
    let group = if numbers.is_some() { r#" pid="1" pindex="0""# } else { "" };
    writeln!(out, r#"<object id="2" type="model" name="{}"{group}><mesh><vertices>"#, escaped(name))?;
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
            write!(out, r#" pid="1" p1="{a}" p2="{b}" p3="{c}""#)?;
        }
        writeln!(out, "/>")?;
    }
    writeln!(out, "</triangles></mesh></object>")?;
    writeln!(out, "</resources>")?;
    writeln!(out, r#"<build><item objectid="2"/></build>"#)?;
    writeln!(out, "</model>")?;
    out.flush()
}

/// Writes each colour once, in the order of first use, and tells which number each vertex has in that list.
fn colour_group(out: &mut impl Write, colours: &[[u8; 3]]) -> io::Result<Vec<u32>> {
    let mut seen = BTreeMap::new();
    let mut numbers = Vec::with_capacity(colours.len());
    writeln!(out, r#"<m:colorgroup id="1">"#)?;
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
