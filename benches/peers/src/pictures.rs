//! Height maps, the picture that POV-Ray makes too, and loading. Each checks what it can before it is timed.

use std::process::Command;
use std::time::{Duration, Instant};

use fidget::jit::JitFunction;
use fidget::raster::voxel;
use fidget::render::CancelToken;
use fidget::shape::BoundShape;
use fidget::vm::VmFunction;
use yont::interrupt::Interrupt;
use yont::picture::raycast::{Space, Style, framed, raycast};
use yont::picture::rays::{Hit, Scene, heights as cast};
use yont::picture::{Camera, View, extent::Extent};
use yont::vm::{Demand, Shape};

use crate::ours::{GYROID, Object, program, spheres};
use crate::peer::Expression;
use crate::table::{Runner, compare, time};
use crate::works::{BUDGET, bound, keep, list};

/// Cells along each side of a height map, and voxels along a column.
const SIDE: usize = 256;

/// How long the peer may take for one height map; it takes minutes for some.
const CAP: Duration = Duration::from_secs(300);

/// Our height map.
pub fn ours(shape: &Shape) -> Vec<Option<Hit>> {
    let camera = Camera {
        eye: [0.0, 0.0, 1.0],
        right: [1.0, 0.0, 0.0],
        up: [0.0, 1.0, 0.0],
        forward: [0.0, 0.0, -1.0],
        base: [1.0; 2],
        growth: [0.0; 2],
    };
    let space = Space { lo: [-1.0; 3], hi: [1.0; 3] };
    let scene = Scene { camera, space, rays: [SIDE; 2], tile: 8 };
    cast(shape, &scene, 1e-6, &Interrupt::default()).expect("no one stops it").0
}

/// The map and whether it came before the cap.
pub fn theirs<F: fidget::eval::Function + fidget::render::RenderHints>(
    shape: BoundShape<'static, F, f32>,
) -> Option<voxel::Image> {
    // Fidget looks at the corners of voxels, Yont at their middles.
    let half = nalgebra::Vector3::repeat(1.0 / SIDE as f32);
    let config = voxel::RenderConfig {
        world_to_model: nalgebra::Matrix4::new_translation(&half),
        ..voxel::RenderConfig::from_size((SIDE as u32).into())
    };
    let cancel = CancelToken::new();
    let own = cancel.clone();
    let (done, is_done) = std::sync::mpsc::channel::<()>();
    let watch = std::thread::spawn(move || {
        if is_done.recv_timeout(CAP) == Err(std::sync::mpsc::RecvTimeoutError::Timeout) {
            own.cancel();
        }
    });
    let image = voxel::render(shape, &config, &voxel::EvalConfig { cancel, ..Default::default() });
    drop(done);
    watch.join().expect("it waits and no more");
    image
}

/// Depths and normals of the same spheres from above.
pub fn heights(name: &str, r_alpha: u8) {
    let object = Object::of(&spheres(10_000, r_alpha));
    let peer = Expression::of(object.graph(), object.root);
    let seen = ours(&object.shape(3, Demand::Sign));
    if r_alpha == 0 && std::env::var_os("YONT_ALONE").is_none() {
        let start = Instant::now();
        let image = theirs(bound::<VmFunction>(&peer));
        let took = start.elapsed().as_secs_f64();
        let own = time(BUDGET, || keep(ours(&object.shape(3, Demand::Sign))));
        let least = if image.is_some() { "" } else { "stopped: more than " };
        println!("| {name} | Yont, double, compile and run | | {:.3} | 1.0 | |", own * 1e3);
        println!("| {name} | Fidget, VM, single, one run | | {least}{:.0} | {:.1} | 1 |", took * 1e3, took / own);
        return image.iter().for_each(|image| agree(name, &seen, image));
    }
    let image = theirs(bound::<JitFunction>(&peer)).expect("a map in time");
    agree(name, &seen, &image);
    compare(
        name,
        &mut [
            Runner::new("Yont, double", || object.shape(3, Demand::Sign), |s| keep(ours(s))),
            Runner::new("Fidget, VM, single", || bound::<VmFunction>(&peer), |b| keep(theirs(b.clone()))),
            Runner::new("Fidget, JIT, single", || bound::<JitFunction>(&peer), |b| keep(theirs(b.clone()))),
        ],
        3,
        BUDGET,
    );
}

/// Both see the same: a surface or none at nearly all places, and there its depth within two voxels.
fn agree(name: &str, ours: &[Option<Hit>], theirs: &voxel::Image) {
    let same = |(hit, pixel): &(&Option<Hit>, &voxel::GeometryPixel)| match hit {
        None => pixel.depth == 0,
        Some(hit) => {
            let top = (1.0 - 0.5 * hit.depth) * SIDE as f64;
            pixel.depth > 0 && (top - f64::from(pixel.depth)).abs() <= 2.0
        }
    };
    let count = ours.iter().zip(theirs.iter()).filter(same).count();
    println!("<!-- {name}: {count} of {} depths are the same -->", SIDE * SIDE);
    assert!(count * 100 >= SIDE * SIDE * 98, "the depths agree");
}

/// A picture of the gyroid ball by one thread, and by POV-Ray where it is installed.
pub fn gyroid() {
    let object = Object::of(GYROID);
    let space = Space { lo: [-1.0; 3], hi: [1.0; 3] };
    let style = Style { size: [640, 480], supersample: 1, shadow: 0.0, ..Style::default() };
    let view = View::from_name("3,2,1.5").expect("the place of an eye");
    let camera = framed(&view, &Extent::nothing(space, 3), &style);
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
    let shape = object.shape(3, Demand::Sign);
    let picture = || raycast(&shape, space, &camera, &style, &Interrupt::default()).expect("no one stops it");
    let seen = picture();
    assert!(seen.hits > 10_000, "the ball is in the picture");
    let own = time(BUDGET, || keep(one.install(picture)));
    println!("| gyroid ball, picture 640x480, one thread | Yont, double | | {:.1} | 1.0 | |", own * 1e3);
    let folder = std::env::temp_dir().join(format!("yont-peers-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    let scene = folder.join("gyroid.pov");
    let angle = 2.0 * camera.growth[0].atan().to_degrees();
    std::fs::write(&scene, POV.replace("ANGLE", &angle.to_string())).expect("a file");
    let mut povray = Command::new("povray");
    povray.current_dir(&folder).args(["+Igyroid.pov", "+Ogyroid.png", "+W640", "+H480", "-A", "-D", "+WT1", "-GA"]);
    match povray.output() {
        Err(error) => println!("SKIPPED: POV-Ray: {error}"),
        Ok(output) => {
            assert!(output.status.success(), "POV-Ray: {}", String::from_utf8_lossy(&output.stderr));
            let took = time(BUDGET, || keep(povray.output()));
            let row = "| gyroid ball, picture 640x480, one thread | POV-Ray isosurface, double |";
            println!("{row} | {:.1} | {:.1} | |", took * 1e3, took / own);
        }
    }
    std::fs::remove_dir_all(&folder).expect("a folder that was made");
}

/// The gyroid ball for POV-Ray, negative inside. Its gradient is at most 30 sqrt(3): that of the gyroid's function is at most sqrt(3).
const POV: &str = "#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <3, 2, 1.5> right -4/3*x sky z up z angle ANGLE look_at 0 }
background { rgb 1 }
light_source { <5, -2, 8> rgb 1 shadowless }
#declare G = function(u, v, w) { sin(u)*cos(v) + sin(v)*cos(w) + sin(w)*cos(u) }
isosurface {
  function { max(30*sqrt(x*x + y*y + z*z) - 25, abs(G(30*x, 30*y, 30*z)) - 0.2) }
  contained_by { box { -1, 1 } }
  max_gradient 52
  accuracy 0.0001
  pigment { rgb 0.7 }
}
";

/// From a program of 7,871 definitions to operations.
pub fn load() {
    let Some(list) = list("prospero") else { return };
    let text = program(&list);
    let object = Object::of(&text);
    println!("<!-- load: {} operations -->", object.shape(2, Demand::Sign).program.len());
    let parse = time(BUDGET, || keep(Object::of(&text)));
    let compile = time(BUDGET, || keep(object.shape(2, Demand::Sign)));
    let lines = text.lines().count();
    println!("| prospero, {lines} lines | Yont, parse and resolve | | {:.1} | | |", parse * 1e3);
    println!("| prospero, {lines} lines | Yont, compile | | {:.1} | | |", compile * 1e3);
    println!("| prospero, {lines} lines | Yont, all | | {:.1} | 1.0 | |", (parse + compile) * 1e3);
}
