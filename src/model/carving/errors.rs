//! Messages about carving: what was found, and what to do.

use crate::diagnostic::near::{Candidate, suggest};
use crate::diagnostic::{Category, Diagnostic};

use super::tools::{Kind, TOOLS, number, vector};

fn usage(code: &'static str, title: String) -> Diagnostic {
    Diagnostic::error(code, title).category(Category::Usage)
}

/// The nearest of some names, if one is near.
pub fn near<'a>(name: &str, names: impl Iterator<Item = &'a str>) -> Option<String> {
    let found = suggest(name, names.map(|name| Candidate { name, preferred: false }));
    found.first().map(|&name| name.to_owned())
}

/// The names of the tools, in words.
fn set() -> String {
    TOOLS.iter().map(|kind| kind.name).collect::<Vec<_>>().join(", ")
}

/// No such tool.
pub fn unknown_tool(name: &str, near: Option<String>) -> Diagnostic {
    let told = usage("unknown-tool", format!("no tool is called `{name}`"));
    let told = near.into_iter().fold(told, |told, near| told.help(format!("did you mean `{near}`?")));
    told.help(format!("the set is {}; an object about the origin, or an expression, is a tool of your own", set()))
}

/// `blnd=0.1`
pub fn unknown_setting(key: &str) -> Diagnostic {
    let known = ["depth", "blend", "turn"];
    let near = near(key, known.into_iter());
    let told = usage("unknown-setting", format!("a tool has no setting `{key}`"));
    let told = near.into_iter().fold(told, |told, near| told.help(format!("did you mean `{near}`?")));
    told.help("they are depth=LENGTH, blend=LENGTH and turn=DEGREES")
}

/// More sizes than the tool has.
pub fn too_many_sizes(kind: &Kind) -> Diagnostic {
    let sizes: Vec<&str> = kind.sizes.iter().map(|size| size.0).collect();
    let many = if sizes.len() == 1 { "one size".to_owned() } else { format!("{} sizes at most", sizes.len()) };
    usage("bad-size", format!("`{}` has {many}", kind.name)).help(format!(":tool {} {}", kind.name, sizes.join(" ")))
}

/// More than one size of a tool of the user's own.
pub fn one_size(name: &str) -> Diagnostic {
    usage("bad-size", format!("`{name}` takes one size: how many times as large it is as it was defined"))
        .help(format!(":tool {name} 0.5"))
}

/// A length or an angle that is none.
pub fn bad_number(what: &str, text: &str, wanted: &str) -> Diagnostic {
    usage("bad-size", format!("{what} is {wanted}, not `{text}`"))
}

/// A pixel that there is not.
pub fn outside([x, y]: [f64; 2], [width, height]: [usize; 2]) -> Diagnostic {
    usage("no-pixel", format!("the picture has no pixel {x},{y}"))
        .fact(format!("it is {width} x {height} pixels, from 0,0 at the top left to {},{}", width - 1, height - 1))
        .help("a point of space is written in brackets: [x1, x2, x3]")
}

/// A ray that meets nothing.
pub fn missed(name: &str, [x, y]: [usize; 2], seen: Option<[[usize; 2]; 2]>) -> Diagnostic {
    let told = usage("missed", format!("the ray through pixel {x},{y} misses `{name}`"));
    match seen {
        Some([[left, top], [right, bottom]]) => {
            told.fact(format!("`{name}` is seen from {left},{top} to {right},{bottom}"))
        }
        None => told.fact(format!("nothing of `{name}` is seen")).help(":undo takes the last stroke back"),
    }
}

/// A stroke that does nothing.
pub fn nothing_there(name: &str, point: [f64; 3], is_cut: bool) -> Diagnostic {
    let title = format!("nothing there: the tool at {} would change nothing of `{name}`", vector(point, 6));
    let why = if is_cut { "it holds nothing of the workpiece" } else { "the workpiece holds all of it" };
    usage("nothing-there", title).fact(why).help(":pick X,Y tells where the surface is")
}

/// A place without a direction.
pub fn no_normal(point: [f64; 3]) -> Diagnostic {
    let title = format!("the surface has no normal at {}", vector(point, 6));
    usage("no-normal", title).help("choose another point, or a pixel of the picture")
}

/// A place that is neither.
pub fn bad_place(text: &str) -> Diagnostic {
    usage("bad-place", format!("`{text}` is no place"))
        .help("a pixel is written X,Y as in 320,240, a line of strokes X,Y..X,Y, and a point of space [x1, x2, x3]")
}

/// The workpiece is gone.
pub fn gone(name: &str) -> Diagnostic {
    Diagnostic::error("no-workpiece", format!("`{name}`, which was carved, is not defined any more"))
        .help(":undo brings it back; :carve NAME takes another workpiece")
}

/// A workpiece of other than three coordinates.
pub fn not_solid(name: &str, axes: &[String]) -> Diagnostic {
    let title = format!(
        "`{name}` cannot be carved: a workpiece has the axes x1, x2, x3, and it has {}",
        match axes {
            [] => "none".to_owned(),
            axes => axes.join(", "),
        }
    );
    Diagnostic::error("not-solid", title)
        .help("carve a solid of x1, x2 and x3; other coordinates are held by --at x4=0")
}

/// A workpiece that is several things, or moves.
pub fn not_one(name: &str, what: &str) -> Diagnostic {
    Diagnostic::error("not-solid", format!("`{name}` cannot be carved: {what}"))
        .help("hold further coordinates at one value, as in --at x4=0, and carve the boundary at 0")
}

/// A tool that cannot be used.
pub fn no_tool(text: &str, why: &str) -> Diagnostic {
    usage("no-tool", format!("`{text}` is no tool: {why}"))
        .help("a tool is a solid of x1, x2, x3 about the origin, its working end towards -x3, and it ends somewhere")
}

/// A name that cannot be continued.
pub fn no_name(name: &str) -> Diagnostic {
    usage("no-name", format!("`{name}` is no object with a name of yours")).help("give it one first: gob_piece = ...;")
}

/// What is left of a note about a stroke that goes beyond what is shown.
pub fn beyond(name: &str, reach: f64) -> Diagnostic {
    let title = format!(
        "this reaches {} beyond the space that the picture of `{name}` shows, and is cut off there",
        number(reach)
    );
    Diagnostic::note("beyond-space", title).help(":carve again shows all of it; x1min, x1max and so on set the space")
}
