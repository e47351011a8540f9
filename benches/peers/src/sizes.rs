//! How time and memory grow with the size of the work: a table each, the exponents that fit, and a plot of all. Memory is the most that
//! a process of its own takes for the work.

use std::fmt::Write as _;
use std::process::Command;
use std::time::Duration;

use fidget::jit::JitFunction;
use fidget::raster::pixel;
use fidget::vm::VmFunction;
use yont::interrupt::Interrupt;
use yont::picture::Palette;
use yont::picture::plot::{Fill, Window, plot};
use yont::surface::{Grid, check};
use yont::vm::{Demand, Shape};

use crate::meshes::{bare, shaded};
use crate::ours::{GYROID, Object, program, spheres};
use crate::peer::Expression;
use crate::pictures::{ours, theirs};
use crate::table::{exponent, time};
use crate::works::{BUDGET, bound, keep, list};

const WINDOW: Window = Window { lo: [-1.0; 2], hi: [1.0; 2] };

/// What a cell of a table holds, if it was measured.
type Cell = Option<f64>;

/// A table; prints itself, and gives the curves of its first times to the plot.
struct Table<'a> {
    /// What is counted: `prospero, pixels along a side`.
    head: &'a str,
    columns: &'a [&'a str],
    rows: Vec<(f64, Vec<Cell>)>,
}

impl Table<'_> {
    fn print(&self) {
        println!("\n| {} | {} |", self.head, self.columns.join(" | "));
        println!("|---{}|", "|---".repeat(self.columns.len()));
        for (size, cells) in &self.rows {
            let cells: Vec<String> =
                cells.iter().map(|cell| cell.map_or_else(|| "-".into(), |v| format!("{v:.2}"))).collect();
            println!("| {size} | {} |", cells.join(" | "));
        }
        let fitted = |column: usize| format!("{:.2}", exponent(&self.curve(column)));
        println!("| exponent | {} |", (0..self.columns.len()).map(fitted).collect::<Vec<_>>().join(" | "));
    }

    fn curve(&self, column: usize) -> Vec<(f64, f64)> {
        self.rows.iter().filter_map(|(size, cells)| Some((*size, cells[column]?))).collect()
    }
}

fn milliseconds(run: impl FnMut()) -> Cell {
    Some(time(BUDGET, run) * 1e3)
}

/// Pictures of prospero, meshes of the gyroid ball, and many spheres; `YONT_PLOT` names the SVG that shows all.
pub fn all() {
    let tables: Vec<Table<'_>> = [prospero(), Some(gyroid()), Some(many())].into_iter().flatten().collect();
    tables.iter().for_each(Table::print);
    if let Some(path) = std::env::var_os("YONT_PLOT") {
        std::fs::write(path, drawn(&tables)).expect("a file");
    }
}

fn paint(shape: &Shape, side: usize) {
    keep(plot(shape, WINDOW, [side; 2], Fill::of(Palette::Mono), &Interrupt::default()));
}

/// Pictures, 256 to 8192 pixels wide.
fn prospero() -> Option<Table<'static>> {
    let list = list("prospero")?;
    let shape = Object::of(&program(&list)).shape(2, Demand::Sign);
    let jit = bound::<JitFunction>(&Expression::read(&list));
    let row = |side: usize| {
        let config = pixel::RenderConfig::from_size((side as u32).into());
        let own = milliseconds(|| paint(&shape, side));
        (side as f64, vec![own, peak("prospero", side), milliseconds(|| keep(config.run(jit.clone())))])
    };
    let columns = &["Yont, ms", "Yont, peak MiB", "Fidget, JIT, ms"];
    Some(Table {
        head: "prospero, pixels along a side",
        columns,
        rows: [256, 512, 1024, 2048, 4096, 8192].map(row).into(),
    })
}

/// Meshes of 64 to 512 cells along a side.
fn gyroid() -> Table<'static> {
    let row = |cells: usize| {
        let grid = Grid::new(&[[-1.0, 1.0]; 3], cells).expect("a grid");
        let shape = Object::of(GYROID).shape(3, Demand::Sign);
        let mut triangles = 0;
        let own = milliseconds(|| triangles = bare(&shape, &grid).triangles.len());
        let mesh = bare(&shape, &grid);
        let checked = milliseconds(|| keep(check(&mesh).expect("closed")));
        (cells as f64, vec![own, peak("gyroid", cells), checked, Some(triangles as f64)])
    };
    let columns = &["Yont, mesh, ms", "Yont, peak MiB", "check, ms", "triangles"];
    Table { head: "gyroid ball, cells along a side", columns, rows: [64, 96, 128, 192, 256, 384, 512].map(row).into() }
}

/// Height maps and sections of 100 to 100,000 spheres; the peer has `max` written by hand.
fn many() -> Table<'static> {
    let row = |count: usize| {
        let text = spheres(count, 0);
        let solid = Object::of(&text);
        let flat = Object::of(&format!("{text}gob_section = gob_s AT (x3 = 0);"));
        let compile = Some(time(Duration::ZERO, || keep(solid.shape(3, Demand::Sign))) * 1e3);
        let (section, shape) = (flat.shape(2, Demand::Sign), solid.shape(3, Demand::Sign));
        let heights = milliseconds(|| keep(ours(&shape)));
        let peer = (count <= 10_000).then(|| {
            let object = Object::of(&spheres(count, 1));
            let shape = bound::<VmFunction>(&Expression::of(object.graph(), object.root));
            time(BUDGET, || keep(theirs(shape.clone()))) * 1e3
        });
        let own = milliseconds(|| paint(&section, 1024));
        (count as f64, vec![heights, peak("spheres", count), own, compile, peer])
    };
    let columns = &[
        "Yont, height map 256, ms",
        "Yont, peak MiB",
        "Yont, section 1024, ms",
        "Yont, compile, ms",
        "Fidget, VM, max, height map 256, ms",
    ];
    Table { head: "spheres", columns, rows: [100, 1_000, 10_000, 100_000].map(row).into() }
}

/// MiB that a process of its own takes at most for one run of a work.
fn peak(work: &str, size: usize) -> Cell {
    let own = std::env::current_exe().expect("this program");
    let output = Command::new(own).args(["--peak", work, &size.to_string()]).output().expect("a process");
    String::from_utf8_lossy(&output.stdout).trim().parse().ok()
}

/// What [`peak`] runs: the work, then the MiB.
pub fn print_peak(work: &str, size: usize) {
    match work {
        "prospero" => paint(&Object::of(&program(&list("prospero").unwrap_or_default())).shape(2, Demand::Sign), size),
        "gyroid" => {
            let grid = Grid::new(&[[-1.0, 1.0]; 3], size).expect("a grid");
            let mesh = shaded(&Object::of(GYROID).shape(3, Demand::Sign), &grid);
            check(&mesh).expect("closed");
            let part = yont::export::Part::of("a", &mesh);
            yont::export::stl::write(&part, &mut std::io::sink()).expect("a sink takes all");
        }
        _ => keep(ours(&Object::of(&spheres(size, 0)).shape(3, Demand::Sign))),
    }
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    let kilobytes = line.and_then(|line| line.trim().trim_end_matches(" kB").parse::<f64>().ok());
    println!("{}", kilobytes.unwrap_or(f64::NAN) / 1024.0);
}

/// The first times of each table against size, both logarithmic, one panel a table, with the peer's dashed where there are some.
fn drawn(tables: &[Table<'_>]) -> String {
    const SIDE: f64 = 260.0;
    let mut svg = String::new();
    let width = 40.0 + (SIDE + 60.0) * tables.len() as f64;
    let _ = writeln!(
        svg,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} 350\" font-family=\"sans-serif\" font-size=\"11\">\n\
         <rect width=\"{width}\" height=\"350\" fill=\"white\"/>"
    );
    for (at, table) in tables.iter().enumerate() {
        let left = 50.0 + (SIDE + 60.0) * at as f64;
        let last = table.columns.len() - 1;
        let peer = table.columns[last].starts_with("Fidget").then(|| table.curve(last)).unwrap_or_default();
        let curves = [(table.curve(0), "#0b6e99", ""), (peer, "#b5482a", " stroke-dasharray=\"5 4\"")];
        let logs = |pick: fn(&(f64, f64)) -> f64| {
            let all = curves.iter().flat_map(|curve| &curve.0).map(|p| pick(p).log10());
            all.fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), v| (lo.min(v), hi.max(v)))
        };
        let ((x0, x1), (y0, y1)) = (logs(|p| p.0), logs(|p| p.1));
        let (y0, y1) = (y0.floor(), y1.ceil());
        let place = |(x, y): (f64, f64)| {
            let (u, v) = ((x.log10() - x0) / (x1 - x0), (y.log10() - y0) / (y1 - y0));
            format!("{:.1},{:.1}", left + SIDE * u, 300.0 - SIDE * v)
        };
        let _ = writeln!(
            svg,
            "<rect x=\"{left}\" y=\"40\" width=\"{SIDE}\" height=\"{SIDE}\" fill=\"none\" stroke=\"#888\"/>"
        );
        let _ = writeln!(svg, "<text x=\"{left}\" y=\"28\" font-weight=\"bold\">{}</text>", table.head);
        let _ = writeln!(
            svg,
            "<text x=\"{left}\" y=\"335\">{}, grows like size^{:.2}</text>",
            table.columns[0],
            exponent(&curves[0].0)
        );
        for power in y0 as i32..=y1 as i32 {
            let y = 300.0 - SIDE * (f64::from(power) - y0) / (y1 - y0);
            let _ = writeln!(svg, "<path d=\"M{left} {y}h{SIDE}\" stroke=\"#ddd\"/>");
            let _ = writeln!(svg, "<text x=\"{}\" y=\"{}\" text-anchor=\"end\">1e{power}</text>", left - 4.0, y + 4.0);
        }
        for (size, _) in &table.rows {
            let x = left + SIDE * (size.log10() - x0) / (x1 - x0);
            let _ = writeln!(svg, "<text x=\"{x:.1}\" y=\"315\" text-anchor=\"middle\">{size}</text>");
        }
        for (points, colour, dashes) in &curves {
            let places: Vec<String> = points.iter().map(|p| place(*p)).collect();
            let _ = writeln!(
                svg,
                "<polyline points=\"{}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"2\"{dashes}/>",
                places.join(" ")
            );
        }
    }
    svg + "</svg>\n"
}
