//! Operations and relations of the library with what they are worth, by formulas that are written anew: each an expression, the
//! expected value at a point, and the error that is allowed. Knows nothing of the program.

use std::f64::consts::PI;

use super::shapes::{Case, SMALL, TINY, and, ball, from_segment, gardner, noise, norm, or, slope};

/// Two balls that meet.
fn pair(p: [f64; 4]) -> (f64, f64) {
    (ball(p, [-0.5, 0.0, 0.0], 1.0), ball(p, [0.5, 0.0, 0.0], 1.2))
}

/// The same by their distances.
fn lengths(p: [f64; 4]) -> (f64, f64) {
    let (f, g) = pair(p);
    (1.0 - (1.0 - f).max(0.0).sqrt(), 1.2 - (1.44 - g).max(0.0).sqrt())
}

fn smooth(f: f64, g: f64, m: i32, sign: f64) -> f64 {
    (f + g + sign * f.hypot(g)) * f.hypot(g).powi(m)
}

fn alpha(f: f64, g: f64, a: f64, sign: f64) -> f64 {
    (f + g + sign * (f * f + g * g - 2.0 * a * f * g).sqrt()) / (1.0 + a)
}

fn displaced(f: f64, g: f64) -> f64 {
    0.3 / (1.0 + (f / 0.5).powi(2) + (g / 0.7).powi(2))
}

/// The bounded displacement by its radii, with the bound 1 - |x|^2 - |y|^2 - |z|^2 and the last parameter 0.8.
fn bounded(p: [f64; 4]) -> f64 {
    let ((f, g), h) = (pair(p), ball(p, [0.0; 3], 1.0));
    let (r1, r2) = ((f / 0.5).hypot(g / 0.7), h.max(0.0) / 0.8);
    let rho = if h > 0.0 { r1 * r1 / (r1 * r1 + r2 * r2) } else { 1.0 };
    if rho < 1.0 { 0.3 * (1.0 - rho).powi(3) / (1.0 + rho) } else { 0.0 }
}

/// The larger of two values, where they differ by less than b mixed by how much they do.
fn joined(f: f64, g: f64, b: f64) -> f64 {
    let part = (0.5 + 0.5 * (f - g) / b).clamp(0.0, 1.0);
    part * f + (1.0 - part) * g + b * part * (1.0 - part)
}

/// The box of `tr_place`: its third axis along (1, 2, -2), the first one level and turned by 0.7.
fn placed(p: [f64; 4]) -> f64 {
    let q = [p[0] - 0.3, p[1] + 0.2, p[2] - 0.1];
    let along = |axis: [f64; 3]| (0..3).map(|k| q[k] * axis[k]).sum::<f64>();
    let five = 5.0_f64.sqrt();
    let (x, y) = (along([-2.0 / five, 1.0 / five, 0.0]), along([2.0 / (3.0 * five), 4.0 / (3.0 * five), five / 3.0]));
    let (x, y) = turned(x, y, -0.7);
    let z = along([1.0 / 3.0, 2.0 / 3.0, -2.0 / 3.0]);
    [(x, 1.0), (y, 0.5), (z, 0.25)].into_iter().map(|(v, half)| and(half - v, half + v)).reduce(and).unwrap_or(0.0)
}

/// The cone with its tip at -h/2, by the distance from its side and from its top.
fn cone([x, y, z]: [f64; 3], r: f64, h: f64) -> f64 {
    let side = ((z + h / 2.0) * r - norm(&[x, y]) * h) / r.hypot(h);
    side.min(h / 2.0 - z)
}

/// The fillet of radius r as what lies between the corner and a quarter of a circle, by its defining circle.
fn round(f: f64, g: f64, r: f64) -> f64 {
    if (f - g).abs() >= r {
        return f.max(g);
    }
    // The greater root v of (f + r - v)^2 + (g + r - v)^2 = r^2.
    let (a, b) = (f + r, g + r);
    ((a + b) - ((a + b).powi(2) - 2.0 * (a * a + b * b - r * r)).sqrt()) / 2.0
}

fn ellipsoid([x, y, z, _]: [f64; 4]) -> f64 {
    1.0 - (x / 1.5).powi(2) - y * y - (z / 0.5).powi(2)
}

/// A function at the point moved along the direction of its gradient.
fn moved(f: fn([f64; 4]) -> f64, d: f64, p: [f64; 4]) -> f64 {
    let g = slope(f, p);
    let s = norm(&g);
    f([p[0] + d * g[0] / s, p[1] + d * g[1] / s, p[2] + d * g[2] / s, p[3]])
}

fn turned(u: f64, v: f64, a: f64) -> (f64, f64) {
    (u * a.cos() - v * a.sin(), u * a.sin() + v * a.cos())
}

/// The ball about (0.5, 0.3, 0.2), carried along by turning.
fn carried(p: [f64; 4], axis: usize, a: f64) -> f64 {
    let mut c = [0.5, 0.3, 0.2];
    let (i, j) = ((axis + 1) % 3, (axis + 2) % 3);
    (c[i], c[j]) = turned(c[i], c[j], a);
    ball(p, c, 1.0)
}

/// The place along a rod that is bent with the curvature k about the place 0, and the height above it.
fn unbent(y: f64, z: f64, k: f64) -> [f64; 2] {
    let radius = y.hypot(1.0 / k - z);
    let angle = if k > 0.0 { y.atan2(1.0 / k - z) } else { (-y).atan2(z - 1.0 / k) };
    [angle / k, 1.0 / k - k.signum() * radius]
}

fn pulled(p: [f64; 4], reach: impl Fn(f64) -> f64) -> [f64; 4] {
    let mut q = p;
    for (from, to) in [([0.0, 0.0, 1.0], [0.0, 0.5, 1.5]), ([1.0, 0.0, 0.0], [1.2, 0.0, 0.0])] {
        let d: [f64; 3] = std::array::from_fn(|i| to[i] - from[i]);
        let e: [f64; 3] = std::array::from_fn(|i| (p[i] - to[i]) / (0.8 * (1.0 + f64::abs(d[i]))));
        (0..3).for_each(|i| q[i] -= reach(norm(&e)) * d[i]);
    }
    q
}

fn disk(x: f64, y: f64, r: f64) -> f64 {
    ball([x, y, 0.0, 0.0], [0.0; 3], r)
}

/// Set operations, blends, edges, offsets, textures.
pub const OPERATIONS: &[Case] = &[
    ("tr_union(A, B, 0.5)", |p| alpha(pair(p).0, pair(p).1, 0.5, 1.0), 1e-9),
    ("tr_intersection(A, B, 0.5)", |p| alpha(pair(p).0, pair(p).1, 0.5, -1.0), 1e-9),
    ("tr_subtraction(A, B, 0.5)", |p| alpha(pair(p).0, -pair(p).1, 0.5, -1.0), 1e-9),
    ("tr_union(A, B, 1)", |p| pair(p).0.max(pair(p).1), TINY),
    ("tr_union_m(A, B, 2)", |p| smooth(pair(p).0, pair(p).1, 2, 1.0), 1e-9),
    ("tr_intersection_m(A, B, 2)", |p| smooth(pair(p).0, pair(p).1, 2, -1.0), 1e-9),
    ("tr_subtraction_m(A, B, 2)", |p| smooth(pair(p).0, -pair(p).1, 2, -1.0), 1e-9),
    ("tr_normalize(A)", |p| pair(p).0 / pair(p).0.hypot(2.0 * norm(&[p[0] + 0.5, p[1], p[2]])), TINY),
    ("tr_bl_uni(A, B, 0.3, 0.5, 0.7)", |p| or(pair(p).0, pair(p).1) + displaced(pair(p).0, pair(p).1), TINY),
    ("tr_bl_int(A, B, 0.3, 0.5, 0.7)", |p| and(pair(p).0, pair(p).1) + displaced(pair(p).0, pair(p).1), TINY),
    ("tr_bl_sub(A, B, 0.3, 0.5, 0.7)", |p| and(pair(p).0, -pair(p).1) + displaced(pair(p).0, pair(p).1), TINY),
    ("tr_bl_bounded(A, B, 0.3, 0.5, 0.7, H, 0.8)", |p| or(pair(p).0, pair(p).1) + bounded(p), TINY),
    ("tr_bl_bounded_int(A, B, 0.3, 0.5, 0.7, H, 0.8)", |p| and(pair(p).0, pair(p).1) + bounded(p), TINY),
    ("tr_bl_bounded_sub(A, B, 0.3, 0.5, 0.7, H, 0.8)", |p| and(pair(p).0, -pair(p).1) + bounded(p), TINY),
    (
        "tr_chamfer_uni(C, D, 0.3)",
        |p| (0.5_f64.sqrt() * (lengths(p).0 + lengths(p).1 + 0.3)).max(lengths(p).0).max(lengths(p).1),
        TINY,
    ),
    (
        "tr_chamfer_int(C, D, 0.3)",
        |p| (0.5_f64.sqrt() * (lengths(p).0 + lengths(p).1 - 0.3)).min(lengths(p).0).min(lengths(p).1),
        TINY,
    ),
    (
        "tr_chamfer_sub(C, D, 0.3)",
        |p| (0.5_f64.sqrt() * (lengths(p).0 - lengths(p).1 - 0.3)).min(lengths(p).0).min(-lengths(p).1),
        TINY,
    ),
    ("tr_round_uni(C, D, 0.3)", |p| round(lengths(p).0, lengths(p).1, 0.3), TINY),
    ("tr_round_int(C, D, 0.3)", |p| -round(-lengths(p).0, -lengths(p).1, 0.3), TINY),
    ("tr_round_sub(C, D, 0.3)", |p| -round(-lengths(p).0, lengths(p).1, 0.3), TINY),
    (
        "tr_groove(C, D, 0.2, 0.3)",
        |p| {
            let (f, g) = lengths(p);
            // In the strip g1 is lowered by the depth, beyond it nothing changes, and walls join both.
            (f - 0.2).max(f.min(g.abs() - 0.3)).min(f)
        },
        TINY,
    ),
    ("tr_carve(C, D, 0)", |p| lengths(p).0.min(-lengths(p).1), TINY),
    ("tr_carve(C, D, 0.6)", |p| -joined(-lengths(p).0, lengths(p).1, 0.6), TINY),
    ("tr_chase(C, D, 0)", |p| lengths(p).0.max(lengths(p).1), TINY),
    ("tr_chase(C, D, 0.6)", |p| joined(lengths(p).0, lengths(p).1, 0.6), TINY),
    ("tr_place(pob_box([0, 0, 0], [2, 1, 0.5]), [0.3, -0.2, 0.1], [1, 2, -2], 0.7)", placed, 1e-9),
    ("tr_place(pob_tool_cone(1, 2), [0, 0, 0.5], [0, 0, -3], 0)", |p| cone([p[0], -p[1], 0.5 - p[2]], 1.0, 2.0), TINY),
    ("pob_tool_cone(0.7, 1.5)", |p| cone([p[0], p[1], p[2]], 0.7, 1.5), TINY),
    ("pob_tool_ellipsoid(1.2, 0.8, 0.5)", |p| 0.5 - 0.5 * norm(&[p[0] / 1.2, p[1] / 0.8, p[2] / 0.5]), TINY),
    ("pob_tool_drill(0.7, 1.5)", |p| (0.7 - norm(&[p[0], p[1]])).min(0.75 - p[2].abs()), TINY),
    (
        "pob_tool_chisel(1.6, 0.8, 1)",
        |p| {
            // Two planes through the edge at x3 = -1/2, each with the normal (1, 0.4), and the ends.
            let side = (0.4 * (p[2] + 0.5) - p[1].abs()) / norm(&[1.0, 0.4]);
            side.min(0.5 - p[2]).min(0.8 - p[0].abs())
        },
        TINY,
    ),
    ("tr_pipe(C, D, 0.25)", |p| 0.25 - norm(&[lengths(p).0, lengths(p).1]), TINY),
    ("tr_offset(A, 0.4)", |p| pair(p).0 + 0.4, TINY),
    // Nearer to the centre than 0.4, the point is moved beyond it.
    ("tr_offset_normal(C, 0.4)", |p| 1.0 - (0.6 - lengths(p).0).abs(), 1e-9),
    ("tr_offset_normal(pob_ellipsoid([0, 0, 0], 1.5, 1, 0.5), -0.2)", |p| moved(ellipsoid, -0.2, p), SMALL),
    ("tr_offset_normal(pob_ellipsoid([0, 0, 0], 1.5, 1, 0.5), 0.1*x3)", |p| moved(ellipsoid, 0.1 * p[2], p), SMALL),
    ("tr_relief(pob_ellipsoid([0, 0, 0], 1.5, 1, 0.5), 0.2*SIN(x1))", |p| moved(ellipsoid, 0.2 * p[0].sin(), p), SMALL),
    ("tr_shell(C, 0.2)", |p| 0.1 - (lengths(p).0 - 0.1).abs(), TINY),
    ("tr_shell_centred(C, 0.2)", |p| (0.1 - lengths(p).0).min(0.1 + lengths(p).0), TINY),
    ("tr_noisy(A, 2.5, 0.7, 1.4)", |p| pair(p).0 + gardner(p, 2.5, 0.7, 1.4), TINY),
    (
        "tr_fur(pob_sphere_d([0, 0, 0], 1), 0.5, 6, 0.4)",
        |p| {
            let r = norm(&p[..3]);
            let g = 1.0 - r;
            let foot = [p[0] / r, p[1] / r, p[2] / r, 0.0];
            g.max((g + 0.5).min(gardner(foot, 1.0, 6.0, 1.4) - 0.4 + 4.0 * g))
        },
        1e-9,
    ),
    (
        "tr_crackle(C, 3, 0.1, 0.05)",
        |p| {
            let f = lengths(p).0;
            f.min((f - 0.1).max((noise([3.0 * p[0], 3.0 * p[1], 3.0 * p[2]]) / 3.0).abs() - 0.05))
        },
        1e-10,
    ),
    ("rel_inside(A, [x1, x2, x3])", |p| f64::from(u8::from(pair(p).0 >= 0.0)), 0.0),
    ("rel_membership(A, [x1, x2, x3])", |p| if pair(p).0 > 0.0 { 2.0 } else { 0.0 }, 0.0),
];

/// Mappings, patterns, products, sweeps, metamorphosis and time.
pub const MAPPINGS: &[Case] = &[
    ("tr_shift(A, [1, 0.5])", |[x, y, z, t]| pair([x - 1.0, y - 0.5, z, t]).0, TINY),
    ("tr_scale(A, 2)", |p| ball(p, [-1.0, 0.0, 0.0], 2.0) / 4.0, TINY),
    ("tr_stretch(A, [1, 0, 0], [2, 1, 0.5])", |[x, y, z, t]| pair([0.5 + x / 2.0, y, 2.0 * z, t]).0, TINY),
    ("tr_rotate_x(E, 0.7)", |p| carried(p, 0, 0.7), TINY),
    ("tr_rotate_y(E, 0.7)", |p| carried(p, 1, 0.7), TINY),
    ("tr_rotate_z(E, 0.7)", |p| carried(p, 2, 0.7), TINY),
    ("tr_rotate(E, [0, 2, 0], 0.7)", |p| carried(p, 1, 0.7), TINY),
    ("tr_rotate(E, [1, 1, 1], 2*PI/3)", |p| ball(p, [0.2, 0.5, 0.3], 1.0), TINY),
    ("tr_mirror(E, [0, 2, 0], 1)", |p| ball(p, [0.5, 0.7, 0.2], 1.0), TINY),
    (
        "tr_affine(pob_sphere([0, 0, 0], 1), [[2, 1, 0], [0, 1, 0], [0, 0.5, 1]], [0.5, 0, 1])",
        // x = 2u + v + 0.5, y = v, z = v/2 + w + 1, solved by hand.
        |[x, y, z, _]| ball([(x - 0.5 - y) / 2.0, y, z - 1.0 - y / 2.0, 0.0], [0.0; 3], 1.0),
        TINY,
    ),
    (
        "tr_affine(1 - x1**2 - x2**2 - x3**2 - x4**2, [[0, 1, 0, 0], [1, 0, 0, 0], [0, 0, 0, 2], [0, 0, 1, 0]], [0, 0, 0, 1])",
        |[x, y, z, t]| 1.0 - x * x - y * y - (t - 1.0).powi(2) - z * z / 4.0,
        TINY,
    ),
    ("tr_cylindrical(x1 + 10*x2 + 100*x3)", |[x, y, z, _]| x.hypot(y) + 10.0 * y.atan2(x) + 100.0 * z, TINY),
    (
        "tr_spherical(x1 + 10*x2 + 100*x3)",
        |[x, y, z, _]| {
            let r = norm(&[x, y, z]);
            r + 10.0 * y.atan2(x) + 100.0 * (z / r).acos()
        },
        1e-9,
    ),
    ("tr_twist_x(E, -1, 1, 0.2, 1)", |p| carried(p, 0, 0.6 + 0.4 * p[0]), TINY),
    ("tr_twist_y(E, -1, 1, 0.2, 1)", |p| carried(p, 1, 0.6 + 0.4 * p[1]), TINY),
    ("tr_twist_z(E, -1, 1, 0.2, 1)", |p| carried(p, 2, 0.6 + 0.4 * p[2]), TINY),
    (
        "tr_taper_x(E, -1, 1, 2, 0.5)",
        |[x, y, z, t]| {
            let s = (1.25 - 0.75 * x).clamp(0.5, 2.0);
            ball([x, y / s, z / s, t], [0.5, 0.3, 0.2], 1.0)
        },
        TINY,
    ),
    (
        "tr_taper_y(E, 1, -1, 0.5, 2)",
        |[x, y, z, t]| {
            let s = (1.25 - 0.75 * y).clamp(0.5, 2.0);
            ball([x / s, y, z / s, t], [0.5, 0.3, 0.2], 1.0)
        },
        TINY,
    ),
    (
        "tr_taper_z(E, -1, 1, 2, 0.5)",
        |[x, y, z, t]| {
            let s = (1.25 - 0.75 * z).clamp(0.5, 2.0);
            ball([x / s, y / s, z, t], [0.5, 0.3, 0.2], 1.0)
        },
        TINY,
    ),
    (
        "tr_bend_x(x1 + 10*x2 + 100*x3, 0.4, 0, -9, 9)",
        |[x, y, z, _]| {
            let [y, z] = unbent(y, z, 0.4);
            x + 10.0 * y + 100.0 * z
        },
        TINY,
    ),
    (
        "tr_bend_y(x2 + 10*x3 + 100*x1, -0.4, 0, -9, 9)",
        |[x, y, z, _]| {
            let [z, x] = unbent(z, x, -0.4);
            y + 10.0 * z + 100.0 * x
        },
        TINY,
    ),
    (
        "tr_bend_z(x3 + 10*x1 + 100*x2, 0.4, 0, -9, 9)",
        |[x, y, z, _]| {
            let [x, y] = unbent(x, y, 0.4);
            z + 10.0 * x + 100.0 * y
        },
        TINY,
    ),
    ("tr_bend_x(10*x2 + 100*x3, 0, 0, -1, 1)", |[_, y, z, _]| 10.0 * y + 100.0 * z, TINY),
    (
        // Beyond the bent part the rod goes on straight: turned about its end.
        "tr_bend_x(10*x2 + 100*x3, 0.4, 0, -0.5, 0.5)",
        |[_, y, z, _]| {
            let t = f64::atan2(y, 2.5 - z).clamp(-0.2, 0.2);
            let (py, pz) = turned(y, z - 2.5, -t);
            10.0 * (t / 0.4 + py) + 100.0 * (2.5 + pz)
        },
        TINY,
    ),
    (
        "tr_space_map(E, [[0, 0, 1], [1, 0, 0]], [[0, 0.5, 1.5], [1.2, 0, 0]], 0.8)",
        |p| ball(pulled(p, |e| if e < 1.0 { (1.0 - e).powi(3) / (1.0 + e) } else { 0.0 }), [0.5, 0.3, 0.2], 1.0),
        TINY,
    ),
    (
        "tr_space_map_exp(E, [[0, 0, 1], [1, 0, 0]], [[0, 0.5, 1.5], [1.2, 0, 0]], 0.8)",
        |p| ball(pulled(p, |e| (-e * e).exp()), [0.5, 0.3, 0.2], 1.0),
        TINY,
    ),
    (
        "tr_repeat(pob_sphere([0, 0, 0], 0.4), [1, 0.8, 0])",
        |p| {
            let copies = (-3..=3).flat_map(|i| (-3..=3).map(move |j| (f64::from(i), 0.8 * f64::from(j))));
            copies.map(|(x, y)| ball(p, [x, y, 0.0], 0.4)).fold(f64::MIN, f64::max)
        },
        TINY,
    ),
    (
        "tr_repeat_n(pob_sphere([0, 0, 0], 0.4), [1, 0.8, 1], [2, 3, 1])",
        |p| {
            let copies = (0..2).flat_map(|i| (0..3).map(move |j| (f64::from(i), 0.8 * f64::from(j))));
            copies.map(|(x, y)| ball(p, [x, y, 0.0], 0.4)).fold(f64::MIN, f64::max)
        },
        TINY,
    ),
    (
        "tr_polar_array(E, 3)",
        |p| or(or(carried(p, 2, 0.0), carried(p, 2, 2.0 * PI / 3.0)), carried(p, 2, 4.0 * PI / 3.0)),
        TINY,
    ),
    (
        "tr_linear_array(A, [0.5, 0, 1], 3)",
        |p| {
            let copy = |k: f64| ball(p, [-0.5 + 0.5 * k, 0.0, k], 1.0);
            or(or(copy(0.0), copy(1.0)), copy(2.0))
        },
        TINY,
    ),
    ("tr_extrude(pob_circle([0, 0], 1), 1.5)", |[x, y, z, _]| and(disk(x, y, 1.0), and(z, 1.5 - z)), TINY),
    ("tr_revolve(pob_circle([1, 0], 0.4))", |[x, y, z, _]| disk(x.hypot(y) - 1.0, z, 0.4), TINY),
    (
        "tr_sweep_helix(pob_circle([0, 0], 0.3), 1, 1.2)",
        |[x, y, z, _]| {
            let c = 1.0 / (1.0 + (1.2 / (2.0 * PI)).powi(2)).sqrt();
            let turn = |k: i32| disk(x.hypot(y) - 1.0, c * (z - 1.2 * (y.atan2(x) / (2.0 * PI) + f64::from(k))), 0.3);
            (-9..=9).map(turn).fold(f64::MIN, f64::max)
        },
        1e-10,
    ),
    (
        "tr_loft(pob_circle([0, 0], 1), pob_circle([1, 0], 0.5), 1.5)",
        |[x, y, z, _]| {
            let t = z / 1.5;
            and(disk(x, y, 1.0) * (1.0 - t) + disk(x - 1.0, y, 0.5) * t, and(z, 1.5 - z))
        },
        TINY,
    ),
    ("tr_project(pob_torus([0, 0, 0], 1, 0.4), x3, -1, 1)", |[x, y, _, _]| disk(x.hypot(y) - 1.0, 0.0, 0.4), 1e-10),
    (
        "tr_project(pob_torus([0, 0, 0], 1, 0.4), 1, -2, 2)",
        |[_, y, z, _]| {
            let at = |k: i32| disk((f64::from(k) / 2000.0).hypot(y) - 1.0, z, 0.4);
            (0..=4000).map(at).fold(f64::MIN, f64::max)
        },
        SMALL,
    ),
    ("tr_section(pob_torus([0, 0, 0], 1, 0.4), x3, 0.2)", |[x, y, _, _]| disk(x.hypot(y) - 1.0, 0.2, 0.4), TINY),
    ("tr_section(pob_torus([0, 0, 0], 1, 0.4), 2, x4)", |[x, _, z, t]| disk(x.hypot(t) - 1.0, z, 0.4), TINY),
    (
        "tr_sweep(pob_sphere_d([0, 0, 0], 0.5), along, 0, 1)",
        |p| 0.5 - from_segment(&p[..3], &[-1.0, 0.0, 0.5], &[1.0, 0.5, 0.0]),
        1e-9,
    ),
    (
        "tr_sweep(pob_sphere_d([0, 0, 0], 0.4), fn_circle_path, -PI, PI)",
        |[x, y, z, _]| 0.4 - (x.hypot(y) - 1.0).hypot(z),
        1e-9,
    ),
    ("tr_metamorphosis(A, B, SIN(x3))", |p| pair(p).0 + p[2].sin() * (pair(p).1 - pair(p).0), TINY),
    (
        "tr_metamorphosis_n([A, B, 3*A], [-1, 0, 1.5])",
        |p| {
            let (f, g) = pair(p);
            match p[3] {
                t if t < -1.0 => f,
                t if t < 0.0 => -f * t + g * (t + 1.0),
                t if t < 1.5 => g * (1.0 - t / 1.5) + 3.0 * f * t / 1.5,
                _ => 3.0 * f,
            }
        },
        TINY,
    ),
    (
        "tr_space_time_blend(A, B, 0.3, 0.5, 0.7, 0.8)",
        |p| {
            let (f, g) = (and(pair(p).0, -p[3]), and(pair(p).1, p[3] - 1.0));
            let slab = and(p[3] + 10.0, 10.0 - p[3]);
            let (r1, r2) = ((f / 0.5).powi(2) + (g / 0.7).powi(2), (slab / 0.8).powi(2));
            let rho = r1 / (r1 + r2);
            or(f, g) + 0.3 * (1.0 - rho).powi(3) / (1.0 + rho)
        },
        TINY,
    ),
    ("tr_time_segment(A, -1, 0.5)", |p| and(pair(p).0, and(p[3] + 1.0, 0.5 - p[3])), TINY),
    ("tr_move(A, fn_circle_path, x4)", |[x, y, z, t]| pair([x - t.cos(), y - t.sin(), z, t]).0, TINY),
    ("tr_delay(x4*x1, 0.5)", |[x, _, _, t]| x * (t - 0.5), TINY),
    ("tr_time_map(x4*x1, 3*x4)", |[x, _, _, t]| 3.0 * x * t, TINY),
    (
        "tr_reconstruct([pob_circle([0, 0], 1), pob_circle([0.5, 0], 0.5), pob_circle([0, 0], 1)], [-1, 0, 1.5])",
        |[x, y, z, _]| {
            let (f, g) = (disk(x, y, 1.0), disk(x - 0.5, y, 0.5));
            let t = if z < 0.0 { (1.0 + z).max(0.0) } else { (1.0 - z / 1.5).max(0.0) };
            and(f + (g - f) * t, and(z + 1.0, 1.5 - z))
        },
        TINY,
    ),
];
