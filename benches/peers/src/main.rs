//! The same work through Yont and its peers in one run: results are compared first, then runs alternate, and medians are printed beside
//! each other. `cargo run --release --manifest-path benches/peers/Cargo.toml [WORK ...]` from the root of the repository. `YONT_ALONE=1` runs
//! our side alone, for a profile of it; `sizes` prints how time and memory grow instead.

mod meshes;
mod ours;
mod peer;
mod pictures;
mod sizes;
mod table;
mod works;

fn main() {
    let wanted: Vec<String> = std::env::args().skip(1).collect();
    rayon::ThreadPoolBuilder::new().num_threads(2).build_global().expect("threads");
    if let [flag, work, size] = &wanted[..]
        && flag == "--peak"
    {
        sizes::print_peak(work, size.parse().expect("a size"));
        return;
    }
    if wanted == ["sizes"] {
        sizes::all();
        return;
    }
    table::head();
    for (name, work) in works::WORKS {
        if wanted.is_empty() || wanted.iter().any(|w| name.starts_with(w.as_str())) {
            work();
        }
    }
}
