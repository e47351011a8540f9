//! Shapes and fields of the library with what they are worth, by formulas that are written anew: each an expression, the expected
//! value at a point, and the error that is allowed. Knows nothing of the program.

use std::f64::consts::PI;

/// An expression, its value at a point (x1, x2, x3, x4), and the error that is allowed.
pub type Case = (&'static str, fn([f64; 4]) -> f64, f64);

/// Rounding.
pub const TINY: f64 = 1e-11;
/// What a difference quotient or a sum over a thousand parts leaves.
pub const SMALL: f64 = 1e-5;

pub fn and(a: f64, b: f64) -> f64 {
    a + b - a.hypot(b)
}

pub fn or(a: f64, b: f64) -> f64 {
    a + b + a.hypot(b)
}

pub fn norm(v: &[f64]) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}

pub fn ball([x, y, z, _]: [f64; 4], c: [f64; 3], r: f64) -> f64 {
    r * r - (x - c[0]).powi(2) - (y - c[1]).powi(2) - (z - c[2]).powi(2)
}

/// The distance of a point from a segment, by the nearest of its ends and the foot.
pub fn from_segment(p: &[f64], a: &[f64], b: &[f64]) -> f64 {
    let to = |q: &[f64]| norm(&p.iter().zip(q).map(|(p, q)| p - q).collect::<Vec<_>>());
    let along: Vec<f64> = a.iter().zip(b).map(|(a, b)| b - a).collect();
    let length = norm(&along);
    let t: f64 = p.iter().zip(a).zip(&along).map(|((p, a), d)| (p - a) * d).sum::<f64>() / length;
    let foot = (to(a).powi(2) - t * t).max(0.0).sqrt();
    if (0.0..=length).contains(&t) { foot } else { to(a).min(to(b)) }
}

/// The gradient by difference quotients.
pub fn slope(f: impl Fn([f64; 4]) -> f64, p: [f64; 4]) -> [f64; 3] {
    std::array::from_fn(|d| {
        let (mut a, mut b) = (p, p);
        a[d] -= 1e-5;
        b[d] += 1e-5;
        (f(b) - f(a)) / 2e-5
    })
}

fn sheet(f: impl Fn([f64; 4]) -> f64, thickness: f64, p: [f64; 4]) -> f64 {
    thickness / 2.0 - f(p).abs() / norm(&slope(&f, p))
}

/// The sum of a function over an interval, by Simpson's rule.
fn integral(f: impl Fn(f64) -> f64, lo: f64, hi: f64, parts: u32) -> f64 {
    let h = (hi - lo) / f64::from(parts);
    let at = |k: u32| lo + f64::from(k) * h;
    (0..parts).map(|k| h / 6.0 * (f(at(k)) + 4.0 * f(at(k) + h / 2.0) + f(at(k + 1)))).sum()
}

fn cauchy(p: [f64; 4], q: [f64; 3], s: f64) -> f64 {
    1.0 / (1.0 + s * s * norm(&[p[0] - q[0], p[1] - q[1], p[2] - q[2]]).powi(2)).powi(2)
}

fn cauchy_line(p: [f64; 4], a: [f64; 3], b: [f64; 3], s: f64) -> f64 {
    let at = |t: f64| std::array::from_fn(|d| a[d] + t * (b[d] - a[d]));
    norm(&[b[0] - a[0], b[1] - a[1], b[2] - a[2]]) * integral(|t| cauchy(p, at(t), s), 0.0, 1.0, 400)
}

fn turns(p: [f64; 4], period: f64) -> [f64; 3] {
    [p[0], p[1], p[2]].map(|x| x * 2.0 * PI / period)
}

fn gyroid(p: [f64; 4]) -> f64 {
    let u = turns(p, 3.0);
    (0..3).map(|i| u[i].sin() * u[(i + 1) % 3].cos()).sum()
}

fn schwarz_p(p: [f64; 4]) -> f64 {
    turns(p, 3.0).iter().map(|u| u.cos()).sum()
}

/// By the addition theorems: sin(x + y + z) + sin x sin y sin z in another dress.
fn schwarz_d(p: [f64; 4]) -> f64 {
    let [x, y, z] = turns(p, 3.0);
    (x + y + z).sin() + 2.0 * x.sin() * y.sin() * z.sin()
}

fn lidinoid(p: [f64; 4]) -> f64 {
    let u = turns(p, 3.0);
    let mixed: f64 = (0..3).map(|i| u[i].sin() * u[i].cos() * u[(i + 1) % 3].cos() * u[(i + 2) % 3].sin()).sum();
    let doubled: f64 = (0..3).map(|i| (2.0 * u[i]).cos() * (2.0 * u[(i + 1) % 3]).cos()).sum();
    mixed - doubled / 2.0 + 0.15
}

fn neovius(p: [f64; 4]) -> f64 {
    let c = turns(p, 3.0).map(f64::cos);
    3.0 * (c[0] + c[1] + c[2]) + 4.0 * c[0] * c[1] * c[2]
}

pub fn gardner([x, y, z, _]: [f64; 4], a: f64, w: f64, phi: f64) -> f64 {
    let wave = |u: f64, v: f64| a * ((w * u).sin() + (w * u / 1.35 + phi * (w * v).sin()).sin() / 1.17);
    wave(x, z) * wave(y, x) * wave(z, y)
}

/// Gradient noise: the weights of the corners as a product, instead of a chain of blends.
pub fn noise(p: [f64; 3]) -> f64 {
    let mix = |i: i64| ((34 * i.rem_euclid(289) + 18) * i.rem_euclid(289)) % 289;
    let mut sum = 0.0;
    for corner in 0..8_i64 {
        let at: [f64; 3] = std::array::from_fn(|d| p[d].floor() + ((corner >> d) & 1) as f64);
        let h = mix(mix(mix(at[0] as i64) + at[1] as i64) + at[2] as i64) as f64;
        let (z, turn) = ((2.0 * h + 1.0) / 289.0 - 1.0, h * PI * (3.0 - 5_f64.sqrt()));
        let s = (1.0 - z * z).sqrt();
        let away: [f64; 3] = std::array::from_fn(|d| p[d] - at[d]);
        let fade = |t: f64| 1.0 - (6.0 * t.powi(5) - 15.0 * t.powi(4) + 10.0 * t.powi(3));
        let weight: f64 = away.iter().map(|a| fade(a.abs())).product();
        sum += weight * (s * turn.cos() * away[0] + s * turn.sin() * away[1] + z * away[2]);
    }
    sum
}

fn metaball(r: f64, d: f64, b: f64) -> f64 {
    match r / d {
        u if u <= 1.0 / 3.0 => b * (1.0 - 3.0 * u * u),
        u if u <= 1.0 => 1.5 * b * (1.0 - u).powi(2),
        _ => 0.0,
    }
}

fn torus(u: f64, v: f64, w: f64) -> f64 {
    // Multiplied out: (u^2 + v^2 + w^2 + R^2 - r^2) - 2 R sqrt(u^2 + v^2), with the other sign.
    2.0 * (u * u + v * v).sqrt() - (u * u + v * v + w * w + 1.0 - 0.16)
}

fn axis_of(p: [f64; 4], a: [f64; 3], b: [f64; 3]) -> (f64, f64, f64) {
    let d: [f64; 3] = std::array::from_fn(|i| b[i] - a[i]);
    let x: [f64; 3] = std::array::from_fn(|i| p[i] - a[i]);
    let length = norm(&d);
    let t = (0..3).map(|i| x[i] * d[i]).sum::<f64>() / length;
    let cross = [x[1] * d[2] - x[2] * d[1], x[2] * d[0] - x[0] * d[2], x[0] * d[1] - x[1] * d[0]];
    (t, norm(&cross) / length, length)
}

/// Solids.
pub const SOLIDS: &[Case] = &[
    ("pob_halfspace([0.6, 0, 0.8], 0.5)", |[x, _, z, _]| 0.5 - 0.6 * x - 0.8 * z, TINY),
    ("pob_halfspace([0, 2], 1)", |[_, y, _, _]| 1.0 - 2.0 * y, TINY),
    ("pob_halfspaces([[1, 0, 0], [0, 1, 0]], [1, 0.5])", |[x, y, _, _]| and(1.0 - x, 0.5 - y), TINY),
    (
        "pob_block_3D(-1, -0.5, 0, 2, 1, 1.5)",
        |[x, y, z, _]| (1.0 - x.abs()).min(0.5 - y.abs()).min(0.75 - (z - 0.75).abs()),
        TINY,
    ),
    (
        "pob_box([0.5, 0, 0], [2, 1, 3])",
        |[x, y, z, _]| {
            let slab = |u: f64, h: f64| and(h - u, h + u);
            and(and(slab(x - 0.5, 1.0), slab(y, 0.5)), slab(z, 1.5))
        },
        TINY,
    ),
    (
        "pob_box_d([0.5, 0, 0], [2, 1, 3])",
        |[x, y, z, _]| {
            let e = [(x - 0.5).abs() - 1.0, y.abs() - 0.5, z.abs() - 1.5];
            let inside = e.iter().copied().fold(f64::MIN, f64::max).min(0.0);
            -norm(&e.map(|e| e.max(0.0))) - inside
        },
        TINY,
    ),
    (
        "pob_box_round([0, 0, 0], [2, 1, 3], 0.25)",
        |[x, y, z, _]| {
            let e = [x.abs() - 0.75, y.abs() - 0.25, z.abs() - 1.25];
            let inside = e.iter().copied().fold(f64::MIN, f64::max).min(0.0);
            0.25 - norm(&e.map(|e| e.max(0.0))) - inside
        },
        TINY,
    ),
    ("pob_sphere([0.1, 0.2, -0.3], 1.2)", |p| ball(p, [0.1, 0.2, -0.3], 1.2), TINY),
    ("pob_sphere_d([0.1, 0.2, -0.3], 1.2)", |p| 1.2 - (1.44 - ball(p, [0.1, 0.2, -0.3], 1.2)).sqrt(), TINY),
    (
        "pob_ellipsoid([0, 0.5, 0], 2, 1, 0.5)",
        |[x, y, z, _]| ball([x / 2.0, y - 0.5, z / 0.5, 0.0], [0.0; 3], 1.0),
        TINY,
    ),
    ("pob_cylinder_x([9, 0.1, 0.2], 0.5)", |[_, y, z, _]| ball([0.0, y, z, 0.0], [0.0, 0.1, 0.2], 0.5), TINY),
    ("pob_cylinder_y([0.1, 9, 0.2], 0.5)", |[x, _, z, _]| ball([x, 0.0, z, 0.0], [0.1, 0.0, 0.2], 0.5), TINY),
    ("pob_cylinder_z([0.1, 0.2, 9], 0.5)", |[x, y, _, _]| ball([x, y, 0.0, 0.0], [0.1, 0.2, 0.0], 0.5), TINY),
    ("pob_ell_cylinder_x([0, 0, 0], 2, 0.5)", |[_, y, z, _]| 1.0 - y * y / 4.0 - 4.0 * z * z, TINY),
    ("pob_ell_cylinder_y([0, 0, 0], 2, 0.5)", |[x, _, z, _]| 1.0 - z * z / 4.0 - 4.0 * x * x, TINY),
    ("pob_ell_cylinder_z([0, 0, 0], 2, 0.5)", |[x, y, _, _]| 1.0 - x * x / 4.0 - 4.0 * y * y, TINY),
    (
        "pob_cylinder([-1, 0, 0.5], [1, 0.5, 0], 0.5)",
        |p| {
            let (t, rho, length) = axis_of(p, [-1.0, 0.0, 0.5], [1.0, 0.5, 0.0]);
            and(0.25 - rho * rho, and(t, length - t))
        },
        TINY,
    ),
    (
        "pob_capsule([-1, 0, 0.5], [1, 0.5, 0], 0.5)",
        |p| 0.5 - from_segment(&p[..3], &[-1.0, 0.0, 0.5], &[1.0, 0.5, 0.0]),
        TINY,
    ),
    ("pob_capsule([1, 0, 0], [1, 0, 0], 0.5)", |[x, y, z, _]| 0.5 - norm(&[x - 1.0, y, z]), TINY),
    ("pob_cone_x([0, 0, 0], 0.5)", |[x, y, z, _]| x * x - 4.0 * (y * y + z * z), TINY),
    ("pob_cone_y([0, 0, 0], 0.5)", |[x, y, z, _]| y * y - 4.0 * (x * x + z * z), TINY),
    ("pob_cone_z([0, 0, 0], 0.5)", |[x, y, z, _]| z * z - 4.0 * (y * y + x * x), TINY),
    ("pob_ell_cone_x([0, 0, 0], 0.5, 2)", |[x, y, z, _]| x * x - 4.0 * y * y - z * z / 4.0, TINY),
    ("pob_ell_cone_y([0, 0, 0], 0.5, 2)", |[x, y, z, _]| y * y - 4.0 * z * z - x * x / 4.0, TINY),
    ("pob_ell_cone_z([0, 0, 0], 0.5, 2)", |[x, y, z, _]| z * z - 4.0 * x * x - y * y / 4.0, TINY),
    (
        "pob_cone([-1, 0, 0.5], [1, 0.5, 0], 0.9, 0.2)",
        |p| {
            let (t, rho, length) = axis_of(p, [-1.0, 0.0, 0.5], [1.0, 0.5, 0.0]);
            // The distance from the slanted line in the half-plane of (t, rho).
            let slant = ((length * (0.9 - rho)) - 0.7 * t) / length.hypot(0.7);
            and(slant, and(t, length - t))
        },
        TINY,
    ),
    ("pob_torus_x([0, 0, 0], 1, 0.4)", |[x, y, z, _]| torus(y, z, x), TINY),
    ("pob_torus_y([0, 0, 0], 1, 0.4)", |[x, y, z, _]| torus(z, x, y), TINY),
    ("pob_torus_z([0, 0, 0], 1, 0.4)", |[x, y, z, _]| torus(x, y, z), TINY),
    ("pob_torus([0.5, 0, 0], 1, 0.4)", |[x, y, z, _]| torus(x - 0.5, y, z), TINY),
    ("pob_torus_d([0, 0, 0], 1, 0.4)", |[x, y, z, _]| 0.4 - (0.16 - torus(x, y, z)).max(0.0).sqrt(), TINY),
    (
        "pob_superellipsoid([0, 0, 0], 2, 1, 0.5, 0.5, 0.25)",
        |[x, y, z, _]| 1.0 - ((x / 2.0).powi(8) + y.powi(8)).sqrt() - (z * z / 0.25).powi(2),
        TINY,
    ),
    ("pob_superellipsoid([0, 0, 0], 2, 1, 0.5, 1, 1)", |[x, y, z, _]| 1.0 - x * x / 4.0 - y * y - 4.0 * z * z, TINY),
    ("pob_superquadric_torus([0, 0, 0], 0.4, 0.4, 0.4, 2.5, 1, 1)", |[x, y, z, _]| torus(x, y, z) / 0.16, TINY),
    ("pob_steiner", |[x, y, z, _]| -(x * y * z + (x * y).powi(2) + (y * z).powi(2) + (z * x).powi(2)), TINY),
    (
        "pob_heart",
        |[x, y, z, _]| z.powi(3) * (x * x + 0.1125 * y * y) - (x * x + 2.25 * y * y + z * z - 1.0).powi(3),
        TINY,
    ),
    ("pob_tanglecube", |[x, y, z, _]| [x, y, z].iter().map(|x| x * x * (5.0 - x * x)).sum::<f64>() - 11.8, TINY),
    (
        "pob_barth_sextic(0.8)",
        |[x, y, z, _]| {
            let (p, q, w) = ((1.0 + 5_f64.sqrt()) / 2.0, x * x + y * y + z * z, 0.8);
            let planes = [(x, y), (y, z), (z, x)].iter().map(|(u, v)| (p * u - v) * (p * u + v)).product::<f64>();
            and((1.0 + 2.0 * p) * w * w * (q - w * w).powi(2) - 4.0 * planes, 4.0 * w * w - q)
        },
        TINY,
    ),
    (
        "pob_klein",
        |[x, y, z, _]| {
            let q = x * x + y * y + z * z;
            let (a, b) = (q + 2.0 * y - 1.0, q - 2.0 * y - 1.0);
            -(a * b * b - 8.0 * a * z * z + 16.0 * x * z * b)
        },
        TINY,
    ),
];

/// Plane figures.
pub const FIGURES: &[Case] = &[
    ("pob_circle([0.5, 0], 1)", |[x, y, _, _]| ball([x, y, 0.0, 0.0], [0.5, 0.0, 0.0], 1.0), TINY),
    ("pob_ellipse([0.5, 0], 2, 0.5)", |[x, y, _, _]| 1.0 - (x - 0.5).powi(2) / 4.0 - 4.0 * y * y, TINY),
    ("pob_rectangle([0, 0.5], [2, 1])", |[x, y, _, _]| and(and(1.0 - x, 1.0 + x), and(1.0 - y, y)), TINY),
    (
        "pob_rectangle_round([0, 0], [2, 1], 0.3)",
        |[x, y, _, _]| {
            let e = [x.abs() - 0.7, y.abs() - 0.2];
            0.3 - norm(&e.map(|e| e.max(0.0))) - e[0].max(e[1]).min(0.0)
        },
        TINY,
    ),
    ("pob_regular_polygon([0, 0], 4, 0.8)", |[x, y, _, _]| and(and(and(0.8 - x, 0.8 - y), 0.8 + x), 0.8 + y), TINY),
    (
        // Of the five edges from a point to the next corner and their mirror images, the lowest line of the nearest point's two.
        "pob_star_polygon([0, 0], 5, 1, 0.4)",
        |[x, y, _, _]| {
            let corner = |k: i32| {
                let (r, a) = (if k % 2 == 0 { 1.0 } else { 0.4 }, PI / 2.0 + f64::from(k) * PI / 5.0);
                [r * a.cos(), r * a.sin()]
            };
            let k = (0..10).find(|&k| {
                let side = |c: [f64; 2]| c[0] * y - c[1] * x;
                side(corner(k)) >= 0.0 && side(corner(k + 1)) < 0.0
            });
            let (a, b) = (corner(k.unwrap_or(0)), corner(k.unwrap_or(0) + 1));
            let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
            (dx * (y - a[1]) - dy * (x - a[0])) / dx.hypot(dy)
        },
        TINY,
    ),
    ("pob_segment([-1, 0], [1, 0.5], 0.2)", |p| 0.2 - from_segment(&p[..2], &[-1.0, 0.0], &[1.0, 0.5]), TINY),
    (
        "pob_arc([0.1, 0], 1, 0.2, 0.5, 4)",
        |[x, y, _, _]| {
            let to = |k: i32| {
                let a = 0.5 + 3.5 * f64::from(k) / 4000.0;
                (x - 0.1 - a.cos()).hypot(y - a.sin())
            };
            0.2 - (0..=4000).map(to).fold(f64::MAX, f64::min)
        },
        SMALL,
    ),
    ("pob_arc([0, 0], 1, 0.2, 0, 7)", |[x, y, _, _]| 0.2 - (x.hypot(y) - 1.0).abs(), TINY),
    ("pob_ring([0, 0.5], 1, 0.25)", |[x, y, _, _]| 0.25 - (x.hypot(y - 0.5) - 1.0).abs(), TINY),
    ("pob_superellipse([0, 0], 2, 0.5, 4)", |[x, y, _, _]| 1.0 - (x / 2.0).powi(4) - (y / 0.5).powi(4), TINY),
];

/// Lattices, fields of skeletons, and noise.
pub const FIELDS: &[Case] = &[
    ("fn_sheet(x1*x2, 0.5)", |[x, y, _, _]| 0.25 - (x * y).abs() / x.hypot(y), TINY),
    ("fn_gyroid(3)", gyroid, TINY),
    ("fn_schwarz_p(3)", schwarz_p, TINY),
    ("fn_schwarz_d(3)", schwarz_d, TINY),
    ("fn_lidinoid(3)", lidinoid, TINY),
    ("fn_neovius(3)", neovius, TINY),
    ("pob_gyroid(3, 0.3)", |p| sheet(gyroid, 0.3, p), SMALL),
    ("pob_schwarz_p(3, 0.3)", |p| sheet(schwarz_p, 0.3, p), SMALL),
    ("pob_schwarz_d(3, 0.3)", |p| sheet(schwarz_d, 0.3, p), SMALL),
    ("pob_lidinoid(3, 0.3)", |p| sheet(lidinoid, 0.3, p), SMALL),
    ("pob_neovius(3, 0.3)", |p| sheet(neovius, 0.3, p), SMALL),
    ("pob_gyroid_solid(3, 0.2)", |p| gyroid(p) - 0.2, TINY),
    ("pob_schwarz_p_solid(3, 0.2)", |p| schwarz_p(p) - 0.2, TINY),
    ("pob_schwarz_d_solid(3, 0.2)", |p| schwarz_d(p) - 0.2, TINY),
    ("pob_lidinoid_solid(3, 0.2)", |p| lidinoid(p) - 0.2, TINY),
    ("pob_neovius_solid(3, 0.2)", |p| neovius(p) - 0.2, TINY),
    (
        "pob_blobby([[1, 0, 0], [0, 1, 0]], [2, 1], 0.5, 0.1)",
        |p| {
            let square = |c| -ball(p, c, 0.0);
            0.5 * (-2.0 * square([1.0, 0.0, 0.0])).exp() + 0.5 * (-square([0.0, 1.0, 0.0])).exp() - 0.1
        },
        TINY,
    ),
    (
        "pob_metaball([[1, 0, 0], [0, 1, 0]], [2, 1], 2.5, 0.1)",
        |[x, y, z, _]| metaball(norm(&[x - 1.0, y, z]), 2.5, 2.0) + metaball(norm(&[x, y - 1.0, z]), 2.5, 1.0) - 0.1,
        TINY,
    ),
    (
        "pob_soft([[1, 0, 0], [0, 1, 0]], [2, 3], 0.1)",
        |[x, y, z, _]| {
            // Wyvill's sextic as it was published: 1 - 22/9 u + 17/9 u^2 - 4/9 u^3.
            let soft = |r: f64, d: f64| {
                let u = r * r / (d * d);
                if u < 1.0 { 1.0 + u * (-22.0 + u * (17.0 - 4.0 * u)) / 9.0 } else { 0.0 }
            };
            soft(norm(&[x - 1.0, y, z]), 2.0) + soft(norm(&[x, y - 1.0, z]), 3.0) - 0.1
        },
        TINY,
    ),
    (
        "pob_convolution_point([[1, 0, 0], [0, 1, 0]], 2, 0.1)",
        |p| cauchy(p, [1.0, 0.0, 0.0], 2.0) + cauchy(p, [0.0, 1.0, 0.0], 2.0) - 0.1,
        TINY,
    ),
    (
        "pob_convolution_line([[1, 0, 0], [0, 1, 0.5]], [[0, 0, 1], [1, -1, 0]], 2, 0.1)",
        |p| {
            cauchy_line(p, [1.0, 0.0, 0.0], [0.0, 0.0, 1.0], 2.0)
                + cauchy_line(p, [0.0, 1.0, 0.5], [1.0, -1.0, 0.0], 2.0)
                - 0.1
        },
        1e-8,
    ),
    (
        "pob_convolution_polyline([[1, 0, 0], [0, 0, 1], [-1, 1, 0]], 2, 0.1)",
        |p| {
            cauchy_line(p, [1.0, 0.0, 0.0], [0.0, 0.0, 1.0], 2.0)
                + cauchy_line(p, [0.0, 0.0, 1.0], [-1.0, 1.0, 0.0], 2.0)
                - 0.1
        },
        1e-8,
    ),
    (
        "pob_convolution_arc([0.2, 0, 0], 1.1, 4, 2, 0.1)",
        |p| {
            let at = |a: f64| [0.2 + 1.1 * a.cos(), 1.1 * a.sin(), 0.0];
            1.1 * integral(|a| cauchy(p, at(a), 2.0), 0.0, 4.0, 400) - 0.1
        },
        1e-8,
    ),
    (
        "pob_convolution_triangle([1, 0, 0], [0, 1, 0.5], [-1, -1, 0], 2, 0.1)",
        |p| {
            let (a, u, v) = ([1.0, 0.0, 0.0], [-1.0, 1.0, 0.5], [-2.0, -1.0, 0.0]);
            let cross = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
            let at = |s: f64, t: f64| std::array::from_fn(|d| a[d] + s * u[d] + t * v[d]);
            let strip = |s: f64| integral(|t| cauchy(p, at(s, t), 2.0), 0.0, 1.0 - s, 60);
            norm(&cross) * integral(strip, 0.0, 1.0, 60) - 0.1
        },
        1e-5,
    ),
    ("pob_noise(2.5, 0.7, 1.4)", |p| gardner(p, 2.5, 0.7, 1.4), TINY),
    ("fn_noise([x1, x2, x3])", |[x, y, z, _]| noise([x, y, z]), TINY),
    (
        "fn_turbulence([x1, x2, x3], 3)",
        |[x, y, z, _]| {
            let octave = |k: i32| {
                let (f, o) = (2_f64.powi(k), 17.0 * f64::from(k));
                noise([f * x + o, f * y + o, f * z + o]) / f
            };
            octave(0).abs() + octave(1).abs() + octave(2).abs()
        },
        TINY,
    ),
    (
        "fn_fractal_noise([x1, x2, x3], 2)",
        |[x, y, z, _]| noise([x, y, z]) + noise([2.0 * x + 17.0, 2.0 * y + 17.0, 2.0 * z + 17.0]) / 2.0,
        TINY,
    ),
];
