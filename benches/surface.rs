//! How fast meshes are made and checked: a smooth solid, one that fills its space with fine structure, a union of many parts.

use std::hint::black_box;
use std::time::Duration;

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use yont::interrupt::Interrupt;
use yont::limits::Limits;
use yont::number::Ternary;
use yont::surface::{Grid, check, extract};
use yont::vm::{Demand, Shape};

#[allow(dead_code)]
#[path = "../tests/it/solids.rs"]
mod solids;

use solids::{Ex, HARD, KNOWN, shape_of, sphere};

/// The R-union of ten thousand small spheres, in the order in which they are written.
fn spheres() -> Shape {
    let field = |x: Ex, y: Ex, z: Ex| {
        let mut state = 1_u64;
        let mut next = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 33) as f64 / (1_u64 << 31) as f64 * 1.8 - 0.9
        };
        let mut all = x.constant(-1.0);
        for _ in 0..10_000 {
            let at = [next(), next(), next()];
            all = all.ternary(Ternary::Union, &sphere(at, 0.02, [&x, &y, &z]), 0.0);
        }
        all
    };
    shape_of(field, 3, Demand::Sign)
}

fn meshes(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("mesh");
    group.sample_size(10).measurement_time(Duration::from_secs(3));
    let gyroid = HARD.iter().find(|case| case.name == "gyroid in a ball").expect("the gyroid");
    let cube = |half: f64, n| Grid::new(&[[-half, half]; 3], n).expect("a grid");
    for n in [128, 256] {
        let subjects = [
            ("ball", KNOWN[0].shape(), KNOWN[0].grid(n)),
            ("gyroid", gyroid.shape(), gyroid.grid(n)),
            ("10,000 spheres", spheres(), cube(1.0, n)),
        ];
        for (name, shape, grid) in &subjects {
            let make = || extract(shape, grid, &Limits::default(), &Interrupt::default()).expect("a mesh").mesh;
            group.bench_function(BenchmarkId::new(*name, n), |b| b.iter(|| black_box(make())));
            let mesh = make();
            group.bench_function(BenchmarkId::new(format!("{name}, checked"), n), |b| b.iter(|| check(&mesh)));
        }
    }
    group.finish();
}

criterion_group!(benches, meshes);
criterion_main!(benches);
