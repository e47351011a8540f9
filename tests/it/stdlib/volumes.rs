//! Solids and plane figures of the library whose volume or area is known in closed form: each an expression, the modelling space, the
//! measure, and the part of it that may be wrong. Knows nothing of the program.

use std::f64::consts::PI;

/// An expression, the half width of its modelling space (of two or three coordinates), its measure, and the relative error allowed.
pub type Known = (&'static str, u8, f64, fn() -> f64, f64);

fn prism() -> f64 {
    6.0 * 0.64 * (PI / 6.0).tan()
}

/// Euler's gamma function, by Stirling's series above 12 and the recurrence below.
fn gamma(x: f64) -> f64 {
    if x < 12.0 {
        return gamma(x + 1.0) / x;
    }
    let series = 1.0 + 1.0 / (12.0 * x) + 1.0 / (288.0 * x * x) - 139.0 / (51_840.0 * x.powi(3));
    (2.0 * PI / x).sqrt() * (x / 1_f64.exp()).powf(x) * series
}

fn beta(a: f64, b: f64) -> f64 {
    gamma(a) * gamma(b) / gamma(a + b)
}

/// Their measures.
pub const KNOWN: &[Known] = &[
    ("pob_prism(6, 0.8, 1)", 3, 1.2, prism, 0.003),
    ("pob_pyramid(6, 0.8, 1)", 3, 1.2, || prism() / 3.0, 0.003),
    ("pob_tetrahedron([0, 0, 0], 0.4)", 3, 1.3, || 8.0 * 3_f64.sqrt() * 0.064, 0.003),
    ("pob_cube([0.1, 0, 0], 0.8)", 3, 1.2, || 1.6_f64.powi(3), 0.003),
    ("pob_octahedron([0, 0.1, 0], 0.6)", 3, 1.3, || 4.0 * 3_f64.sqrt() * 0.216, 0.003),
    (
        "pob_dodecahedron([0, 0, 0.1], 0.8)",
        3,
        1.3,
        || {
            let edge = 1.6 / (2.5 + 1.1 * 5_f64.sqrt()).sqrt();
            (15.0 + 7.0 * 5_f64.sqrt()) / 4.0 * edge.powi(3)
        },
        0.003,
    ),
    (
        "pob_icosahedron([0, 0, 0], 0.8)",
        3,
        1.3,
        || {
            let edge = 0.8 * 12.0 / (3.0 * 3_f64.sqrt() + 15_f64.sqrt());
            5.0 * (3.0 + 5_f64.sqrt()) / 12.0 * edge.powi(3)
        },
        0.003,
    ),
    ("pob_wedge([1, 1.2, 0.8])", 3, 1.3, || 0.48, 0.003),
    ("pob_cylinder([-0.5, 0, 0], [0.5, 0.5, 0.5], 0.4)", 3, 1.2, || PI * 0.16 * 1.5_f64.sqrt(), 0.003),
    (
        "pob_capsule([-0.5, 0, 0], [0.5, 0.5, 0.5], 0.4)",
        3,
        1.2,
        || PI * 0.16 * (1.5_f64.sqrt() + 4.0 / 3.0 * 0.4),
        0.003,
    ),
    ("pob_cone([0, 0, -0.5], [0, 0, 0.5], 0.8, 0.2)", 3, 1.2, || PI / 3.0 * (0.64 + 0.16 + 0.04), 0.003),
    ("pob_torus_d([0, 0, 0], 0.8, 0.3)", 3, 1.2, || 2.0 * PI * PI * 0.8 * 0.09, 0.003),
    (
        "pob_superellipsoid([0, 0, 0], 1, 0.8, 0.6, 0.5, 0.4)",
        3,
        1.2,
        || 2.0 * 0.48 * 0.5 * 0.4 * beta(1.25, 0.5) * beta(0.2, 0.2),
        0.003,
    ),
    (
        "pob_box_round([0, 0, 0], [1.6, 1, 2], 0.25)",
        3,
        1.2,
        || {
            1.1 * 0.5 * 1.5
                + 0.5 * (1.1 * 0.5 + 0.5 * 1.5 + 1.5 * 1.1)
                + PI * 0.0625 * 3.1
                + 4.0 / 3.0 * PI * 0.25_f64.powi(3)
        },
        0.003,
    ),
    ("pob_gyroid_solid(1.5, 0)", 3, 1.5, || 13.5, 0.003),
    ("pob_schwarz_p_solid(1.5, 0)", 3, 1.5, || 13.5, 0.003),
    ("pob_schwarz_d_solid(1.5, 0)", 3, 1.5, || 13.5, 0.003),
    ("pob_neovius_solid(1.5, 0)", 3, 1.5, || 13.5, 0.003),
    ("tr_extrude(pob_ellipse([0, 0], 1, 0.5), 0.8)", 3, 1.2, || PI * 0.4, 0.003),
    ("tr_revolve(pob_ellipse([0.8, 0], 0.3, 0.2))", 3, 1.2, || PI * 0.06 * 2.0 * PI * 0.8, 0.003),
    ("tr_loft(pob_circle([0, 0], 1), pob_circle([0, 0], 0.5), 1)", 3, 1.2, || PI * 0.625, 0.003),
    (
        // The screw carries the part of one turn to that of the next, so a slab of two turns holds two.
        "tr_sweep_helix(pob_circle([0, 0], 0.3), 0.8, 0.9) & 0.81 - x3**2",
        3,
        1.2,
        || 2.0 * PI * 0.09 * (2.0 * PI * 0.8_f64).hypot(0.9),
        0.004,
    ),
    ("tr_sweep(pob_sphere([0, 0, 0], 0.4), fn_circle_path, 0, 2*PI)", 3, 1.5, || 2.0 * PI * PI * 0.16, 0.003),
    ("tr_twist_z(pob_box([0, 0, 0], [1.2, 0.6, 1.6]), 0, 1, 0, 1)", 3, 1.0, || 1.152, 0.003),
    ("tr_bend_x(pob_box([0, 0, 0], [1, 2, 0.8]), 0.5, 0, -1, 1)", 3, 1.2, || 1.6, 0.003),
    ("tr_taper_z(pob_box([0, 0, 0], [1.6, 1, 2]), -1, 1, 1, 0.5)", 3, 1.2, || 3.2 * 7.0 / 12.0, 0.003),
    ("tr_polar_array(pob_sphere_d([0.8, 0, 0], 0.2), 7)", 3, 1.1, || 7.0 * 4.0 / 3.0 * PI * 0.008, 0.005),
    ("tr_reconstruct([pob_circle([0, 0], 1), pob_circle([0, 0], 0.5)], [-1, 1])", 3, 1.2, || 2.0 * PI * 0.625, 0.003),
    ("tr_shell(pob_sphere_d([0, 0, 0], 1), 0.3)", 3, 1.1, || 4.0 / 3.0 * PI * (1.0 - 0.343), 0.003),
    ("tr_offset_normal(pob_sphere([0, 0, 0], 0.7), 0.3)", 3, 1.1, || 4.0 / 3.0 * PI, 0.003),
    ("pob_regular_polygon([0, 0], 7, 0.8)", 2, 1.2, || 7.0 * 0.64 * (PI / 7.0).tan(), 0.003),
    ("pob_star_polygon([0, 0], 5, 1, 0.4)", 2, 1.2, || 5.0 * 0.4 * (PI / 5.0).sin(), 0.003),
    ("pob_segment([-0.5, 0], [0.5, 0.5], 0.3)", 2, 1.2, || 0.6 * 1.25_f64.sqrt() + PI * 0.09, 0.003),
    ("pob_arc([0, 0], 0.8, 0.2, 0, 4)", 2, 1.2, || 4.0 * 0.8 * 0.4 + PI * 0.04, 0.003),
    ("pob_superellipse([0, 0], 1, 0.6, 4)", 2, 1.2, || 2.4 * gamma(1.25).powi(2) / gamma(1.5), 0.003),
    ("tr_offset_radius(pob_rectangle([0, 0], [1, 0.6]), 0.3)", 2, 1.0, || 0.6 + 3.2 * 0.3 + PI * 0.09, 0.003),
    ("tr_round_uni(x1, x2, 0.5)", 2, 1.0, || 3.0 + 0.25 * (1.0 - PI / 4.0), 0.003),
    ("tr_chamfer_uni(x1, x2, 0.5)", 2, 1.0, || 3.125, 0.003),
    ("tr_project(pob_torus([0, 0, 0], 0.7, 0.3), x1, -1, 1) AT (0, x1, x2)", 2, 1.1, || 1.4 * 0.6 + PI * 0.09, 0.003),
];
