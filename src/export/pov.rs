//! A scene for POV-Ray: camera, lights, and each object as a mesh with normals and colours and, where it is one, as a function. Text in
//! the shortest digits that read back the same. The same scene gives the same bytes.

use std::collections::BTreeMap;
use std::io::{self, Write};

use super::{Part, fits_together, refuse, stream};
use crate::picture::camera::Camera;
use crate::picture::palette::linear;
use crate::picture::shade::{FILL, GLEAM, GLEAM_EXPONENT, GROUND, KEY, Light, Lights, SKY};

/// An object as a function, inside where it is not negative.
#[derive(Clone, Debug, PartialEq)]
pub struct Formula {
    /// What is declared for it.
    pub declarations: String,
    /// The name of the function of x, y and z.
    pub name: String,
    /// The space in which it is looked for.
    pub lo: [f64; 3],
    /// Its other corner.
    pub hi: [f64; 3],
    /// The gradient is nowhere longer, where the function lies between `-within` and `within`.
    pub gradient: f64,
    /// Infinite if that holds everywhere.
    pub within: f64,
    /// Red, green and blue as functions of linear light, where the colour differs from point to point.
    pub colours: Option<[String; 3]>,
}

/// An object of a scene.
#[derive(Clone, Debug)]
pub struct Thing<'a> {
    /// Its mesh.
    pub part: Part<'a>,
    /// The colour of what has no other.
    pub colour: [u8; 3],
    /// Its function, or why there is none.
    pub formula: Result<Formula, String>,
}

/// A scene.
#[derive(Clone, Debug)]
pub struct Scene<'a> {
    /// What it is called.
    pub name: &'a str,
    /// Functions that those of the objects call.
    pub helpers: String,
    /// The objects.
    pub things: Vec<Thing<'a>>,
    /// The camera of a picture with that width by height.
    pub camera: Camera,
    /// Width by height for which the camera was set up.
    pub aspect: f64,
    /// The lights.
    pub lights: Lights,
    /// How bright the fill light is.
    pub fill: f32,
    /// How dark the key light's shadows are.
    pub shadow: f32,
    /// The background, sRGB; none if there is none.
    pub background: Option<[u8; 3]>,
}

/// Textures that a mesh may have; of more colours the nearest are one.
const TEXTURES: usize = 4096;
/// The accuracy of a function's boundary, as a part of its space.
const ACCURACY: f64 = 2e-5;

/// Writes a scene.
///
/// # Errors
/// Those of the writer; `InvalidInput` without an object, for an empty mesh or arrays that do not fit together.
pub fn write(scene: &Scene<'_>, out: &mut impl Write) -> io::Result<()> {
    if scene.things.is_empty() {
        return Err(refuse("there is no mesh to write"));
    }
    scene.things.iter().try_for_each(|thing| fits_together(&thing.part))?;
    out.write_all(head(scene).as_bytes())?;
    out.write_all(surroundings(scene).as_bytes())?;
    if scene.things.iter().any(|thing| thing.formula.is_ok()) && !scene.helpers.is_empty() {
        write!(out, "// Functions that the objects below share.\n{}\n", scene.helpers)?;
    }
    for thing in &scene.things {
        object(thing, out)?;
    }
    out.flush()
}

fn head(scene: &Scene<'_>) -> String {
    let name = line(scene.name);
    let mut text = format!(
        "// {name}: a scene for POV-Ray 3.7, written by yont; unit mm, Z up, right-handed.\n\
         //   povray NAME.pov +W800 +H600 +A0.1\n"
    );
    if scene.things.iter().any(|thing| thing.formula.is_ok()) {
        text += "// Objects that are formulas are shown as such, exact but slower, by 1 here or by Declare=Yont_Isosurface=1.\n";
    }
    text += "#version 3.7;\n#ifndef (Yont_Isosurface)\n  #declare Yont_Isosurface = 0;\n#end\n\n";
    text + "global_settings { assumed_gamma 1 ambient_light rgb 1 }\n"
}

/// Camera, lights, background and finish.
fn surroundings(scene: &Scene<'_>) -> String {
    let Scene { camera, aspect, lights, .. } = scene;
    let far = scene.things.iter().flat_map(|thing| &thing.part.mesh.positions).flatten();
    let far = 1e3 * far.fold(1e-3, |far: f64, c| far.max(c.abs()));
    // What a picture shows at depth 1, or with parallel rays at every depth.
    let is_level = camera.growth == [0.0; 2];
    let height = 2.0 * if is_level { camera.base[1] } else { camera.growth[1] };
    let kind = if is_level { "orthographic" } else { "perspective" };
    let mut text = format!(
        "// Whatever is the shape of the picture, all is seen that is seen in one of {aspect} to 1.\n\
         #declare Yont_Aspect = image_width/image_height;\n\
         #declare Yont_Zoom = max(1, {aspect}/Yont_Aspect);\n\
         camera {{\n  {kind}\n  location {}\n  direction {}\n  right Yont_Zoom*Yont_Aspect*{}\n  up Yont_Zoom*{}\n}}\n",
        vector(camera.eye),
        vector(camera.forward),
        vector(camera.right.map(|c| c * height)),
        vector(camera.up.map(|c| c * height)),
    );
    if let Some(background) = scene.background {
        text += &format!("background {{ rgb {} }}\n", shade(background.map(linear)));
    }
    let light = |direction: [f64; 3], colour: Light, is_shadowless: bool| {
        let place = vector(direction.map(|c| c * far));
        let shadowless = if is_shadowless { " shadowless" } else { "" };
        format!("light_source {{ {place} rgb {} parallel point_at <0, 0, 0>{shadowless} }}\n", shade(colour))
    };
    let part = |colour: Light, share: f32| colour.map(|c| c * share);
    let half: Light = std::array::from_fn(|k| 0.5 * (SKY[k] - GROUND[k]));
    text += "// The key light, whose shadows are not black, and a weaker one from the other side.\n";
    text += &light(lights.key(), part(KEY, scene.shadow), false);
    text += &light(lights.key(), part(KEY, 1.0 - scene.shadow), true);
    if scene.fill > 0.0 {
        text += &light(lights.fill(), part(FILL, scene.fill), true);
    }
    text += "// The sky is brighter than the ground: by what it adds above and takes away below.\n";
    text += &light([0.0, 0.0, 1.0], half, true);
    text += &light([0.0, 0.0, -1.0], part(half, -1.0), true);
    let around: Light = std::array::from_fn(|k| 0.5 * (SKY[k] + GROUND[k]));
    text + &format!(
        "#declare Yont_Finish = finish {{ ambient rgb {} diffuse 1 specular {} roughness {} }}\n\n",
        shade(around),
        number(f64::from(GLEAM)),
        number((1e4 / GLEAM_EXPONENT).round() / 1e4),
    )
}

fn object(thing: &Thing<'_>, out: &mut impl Write) -> io::Result<()> {
    let name = line(thing.part.name);
    let pigment = format!("pigment {{ rgb {} }}", shade(thing.colour.map(linear)));
    match &thing.formula {
        Err(why) => writeln!(out, "// {name}: a mesh alone, since {}.", line(why))?,
        Ok(formula) => {
            writeln!(out, "// {name}\n#if (Yont_Isosurface)")?;
            out.write_all(isosurface(formula, &pigment).as_bytes())?;
            writeln!(out, "#else")?;
        }
    }
    mesh(&thing.part, &pigment, out)?;
    if thing.formula.is_ok() {
        writeln!(out, "#end")?;
    }
    writeln!(out)
}

fn isosurface(formula: &Formula, pigment: &str) -> String {
    let Formula { declarations, name, lo, hi, gradient, within, colours } = formula;
    let longest = (0..3).map(|k| hi[k] - lo[k]).fold(0.0, f64::max);
    let value = format!("-{name}(x, y, z)");
    let (about, value) = if within.is_finite() {
        let within = number(*within);
        let about = format!(
            "// Beyond {within} the function may be steeper; that far from the boundary its value does not matter.\n"
        );
        (about, format!("min({within}, max(-{within}, {value}))"))
    } else {
        (String::new(), value)
    };
    let pigment = match colours {
        None => pigment.to_owned(),
        Some(colours) => {
            let mut text = "pigment {\n    average\n    pigment_map {\n".to_owned();
            for (function, colour) in colours.iter().zip(["<3, 0, 0>", "<0, 3, 0>", "<0, 0, 3>"]) {
                text += &format!("      [1 function {{ {function} }} color_map {{ [0 rgb 0] [1 rgb {colour}] }}]\n");
            }
            text + "    }\n  }"
        }
    };
    format!(
        "{declarations}{about}isosurface {{\n  function {{ {value} }}\n  contained_by {{ box {{ {}, {} }} }}\n  threshold 0\n  \
         accuracy {}\n  max_gradient {}\n  texture {{ {pigment} finish {{ Yont_Finish }} }}\n}}\n",
        vector(*lo),
        vector(*hi),
        number(rounded_up(longest * ACCURACY)),
        number(rounded_up(gradient.max(1e-300))),
    )
}

fn mesh(part: &Part<'_>, pigment: &str, out: &mut impl Write) -> io::Result<()> {
    let mesh = part.mesh;
    let list = |keyword: &str, items: &[[f64; 3]], out: &mut _| -> io::Result<()> {
        section(out, keyword, items, |_, item, text| *text += &vector(item.map(|c| f64::from(c as f32))))
    };
    out.write_all(b"mesh2 {\n")?;
    list("vertex_vectors", &mesh.positions, out)?;
    if !mesh.normals.is_empty() {
        list("normal_vectors", &mesh.normals, out)?;
    }
    let coloured = part.colours.map(textures);
    if let Some((of, colours)) = &coloured {
        section(out, "texture_list", colours, |_, colour, text| {
            let colour = shade(colour.map(linear));
            *text += &format!("texture {{ pigment {{ rgb {colour} }} finish {{ Yont_Finish }} }}");
        })?;
        section(out, "face_indices", &mesh.triangles, |_, [a, b, c], text| {
            let [i, j, k] = [a, b, c].map(|v| of[*v as usize]);
            *text += &format!("<{a}, {b}, {c}>, {i}, {j}, {k}");
        })?;
    } else {
        section(out, "face_indices", &mesh.triangles, |_, [a, b, c], text| *text += &format!("<{a}, {b}, {c}>"))?;
    }
    out.write_all(b"  inside_vector <0, 0, 1>\n")?;
    if coloured.is_none() {
        writeln!(out, "  texture {{ {pigment} finish {{ Yont_Finish }} }}")?;
    }
    out.write_all(b"}\n")
}

/// A list with its length and its items, a line each.
fn section<T: Sync>(
    out: &mut impl Write,
    keyword: &str,
    items: &[T],
    make: impl Fn(usize, &T, &mut String) + Sync,
) -> io::Result<()> {
    write!(out, "  {keyword} {{\n    {}", items.len())?;
    let lines = |first: usize, items: &[T], bytes: &mut Vec<u8>| {
        let mut text = String::new();
        for (n, item) in (first..).zip(items) {
            text += ",\n    ";
            make(n, item, &mut text);
        }
        bytes.extend_from_slice(text.as_bytes());
    };
    stream(items, lines, out)?;
    out.write_all(b"\n  }\n")
}

/// The texture of each vertex, and their colours. Where there are too many, colours that differ little are one.
fn textures(colours: &[[u8; 3]]) -> (Vec<usize>, Vec<[u8; 3]>) {
    for coarse in 0..8 {
        // The middle of those that become one.
        let rounded = |c: u8| (c >> coarse << coarse) | (1 << coarse >> 1);
        let mut numbers: BTreeMap<[u8; 3], usize> = BTreeMap::new();
        for colour in colours {
            numbers.entry(colour.map(rounded)).or_default();
        }
        if numbers.len() <= TEXTURES {
            numbers.values_mut().zip(0..).for_each(|(number, n)| *number = n);
            let of = colours.iter().map(|colour| numbers[&colour.map(rounded)]).collect();
            return (of, numbers.into_keys().collect());
        }
    }
    (vec![0; colours.len()], vec![[128; 3]])
}

/// Linear light, to six digits: more than a byte of sRGB tells.
fn shade(light: Light) -> String {
    vector(light.map(|c| (f64::from(c) * 1e6).round() / 1e6))
}

/// A bound in four digits.
fn rounded_up(value: f64) -> f64 {
    let unit = 10f64.powi(value.log10().floor() as i32 - 3);
    let rounded = (value / unit).ceil() * unit;
    // Digits of a decimal number, not of a product.
    let told: f64 = format!("{rounded:.3e}").parse().unwrap_or(rounded);
    if told >= value && told.is_finite() { told } else { value }
}

fn vector(v: [f64; 3]) -> String {
    let [x, y, z] = v.map(number);
    format!("<{x}, {y}, {z}>")
}

/// A number: singles in their own digits, no exponent where that is not long.
fn number(value: f64) -> String {
    // Nothing is -0.
    let value = value + 0.0;
    let single = value as f32;
    let is_single = f64::from(single) == value;
    match (value.abs(), is_single) {
        (0.0 | 1e-5..1e9, true) => single.to_string(),
        (0.0 | 1e-5..1e9, false) => value.to_string(),
        (_, true) => format!("{single:e}"),
        (_, false) => format!("{value:e}"),
    }
}

/// Words that stay within a comment.
fn line(words: &str) -> String {
    words.chars().map(|c| if c.is_control() { ' ' } else { c }).collect()
}
