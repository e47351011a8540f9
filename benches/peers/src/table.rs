//! Alternating runs, medians, and the table that is printed. Knows no work.

use std::time::{Duration, Instant};

/// One of those who do the work.
pub struct Runner<'a> {
    /// Who, and with which precision: `Fidget, JIT, single`.
    pub name: String,
    /// Time from the expression to what can be run, taken once by who made it.
    pub compile: Duration,
    /// Does the work once.
    pub run: Box<dyn FnMut() + 'a>,
}

impl<'a> Runner<'a> {
    /// A runner whose compile time is that of `make`.
    pub fn new<T: 'a>(name: &str, make: impl FnOnce() -> T, mut run: impl FnMut(&mut T) + 'a) -> Self {
        let start = Instant::now();
        let mut made = make();
        let compile = start.elapsed();
        Self { name: name.into(), compile, run: Box::new(move || run(&mut made)) }
    }
}

/// Runs them in turn, at least `least` times and for no more than about `budget` each, and prints medians and ratios to the first.
pub fn compare(work: &str, runners: &mut [Runner<'_>], least: usize, budget: Duration) {
    let count = if std::env::var_os("YONT_ALONE").is_some() { 1 } else { runners.len() };
    let runners = &mut runners[..count];
    let mut times: Vec<Vec<Duration>> = vec![Vec::new(); runners.len()];
    for round in 0.. {
        for (runner, times) in runners.iter_mut().zip(&mut times) {
            if round >= least && times.iter().sum::<Duration>() > budget {
                continue;
            }
            let start = Instant::now();
            (runner.run)();
            times.push(start.elapsed());
        }
        let done = times.iter().all(|t| t.len() >= least && (t.iter().sum::<Duration>() > budget || t.len() >= 41));
        if done {
            break;
        }
    }
    let medians: Vec<f64> = times.iter_mut().map(|t| median(t)).collect();
    for ((runner, run), count) in runners.iter().zip(&medians).zip(times.iter().map(Vec::len)) {
        println!(
            "| {work} | {} | {:.2} | {:.3} | {:.1} | {count} |",
            runner.name,
            runner.compile.as_secs_f64() * 1e3,
            run * 1e3,
            run / medians[0],
        );
    }
}

/// The head of the table.
pub fn head() {
    println!("| work | who | compile, ms | run, ms (median) | times ours | runs |");
    println!("|---|---|---|---|---|---|");
}

/// The median time of at least 3 runs of about `budget` in all, in seconds.
pub fn time(budget: Duration, mut run: impl FnMut()) -> f64 {
    let mut times = Vec::new();
    while times.len() < 3 || (times.iter().sum::<Duration>() < budget && times.len() < 41) {
        let start = Instant::now();
        run();
        times.push(start.elapsed());
    }
    median(&mut times)
}

/// The exponent of the power of the size that fits the times best.
pub fn exponent(points: &[(f64, f64)]) -> f64 {
    let logs: Vec<(f64, f64)> = points.iter().map(|(size, time)| (size.ln(), time.ln())).collect();
    let mean = |of: fn(&(f64, f64)) -> f64| logs.iter().map(of).sum::<f64>() / logs.len() as f64;
    let (x, y) = (mean(|p| p.0), mean(|p| p.1));
    let rise: f64 = logs.iter().map(|p| (p.0 - x) * (p.1 - y)).sum();
    rise / logs.iter().map(|p| (p.0 - x).powi(2)).sum::<f64>()
}

fn median(times: &mut [Duration]) -> f64 {
    times.sort_unstable();
    times[times.len() / 2].as_secs_f64()
}
