//! The special forms: folds over an index, arrays, vectors, derivatives, projections and data. Their arguments are more than
//! numbers, so the interpreter evaluates them; here they are only described.

use super::table::{Builtin, Meaning, Special, Subject};

/// The files that the examples read, by name: two samples 0 and 1 at 0 and 1; a tetrahedron with the corners 0, 4 x1, 4 x2 and 4 x3; a picture of a
/// black and a white pixel.
pub const FILES: &[(&str, &[u8])] = &[
    ("ramp.nrrd", b"NRRD0004\ntype: float\ndimension: 1\nsizes: 2\nspacings: 1\nencoding: ascii\n\n0 1\n"),
    ("corner.obj", b"v 0 0 0\nv 4 0 0\nv 0 4 0\nv 0 0 4\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"),
    (
        "dark.png",
        b"\x89PNG\x0d\x0a\x1a\x0a\x00\x00\x00\x0dIHDR\x00\x00\x00\x02\x00\x00\x00\x01\x08\x00\x00\x00\x00\xd1I V\
          \x00\x00\x00\x0bIDATx\xdac`\xf8\x0f\x00\x01\x02\x01\x00\xd1\x1a\xcb\x8f\x00\x00\x00\x00IEND\xaeB`\x82",
    ),
];

const fn entry(
    form: Special,
    subject: Subject,
    name: &'static str,
    parameters: &'static [&'static str],
    doc: &'static str,
    example: (&'static str, f64),
) -> Builtin {
    Builtin { name, aliases: &[], subject, parameters, doc, example, meaning: Meaning::Special(form) }
}

use Subject::{Arrays, Data, Functions};

/// The special forms.
pub(super) static TABLE: &[Builtin] = &[
    entry(
        Special::Sum,
        Arrays,
        "SUM",
        &["i = first TO last", "e"],
        "The sum of e over the index, or of one array: SUM(a). Without terms 0. Added from left to right.",
        ("SUM(i = 1 TO 4, i**2)", 30.0),
    ),
    entry(
        Special::Product,
        Arrays,
        "PRODUCT",
        &["i = first TO last", "e"],
        "The product of e over the index, or of one array: PRODUCT(a). Without factors 1.",
        ("PRODUCT(i = 1 TO 5, i)", 120.0),
    ),
    entry(
        Special::Union,
        Arrays,
        "UNION",
        &["i = first TO last", "e"],
        "The R-union (|) of e over the index, or of one array, from left to right, with the system in force.",
        ("UNION([3, 4])", 12.0),
    ),
    entry(
        Special::Intersection,
        Arrays,
        "INTERSECTION",
        &["i = first TO last", "e"],
        "The R-intersection (&) of e over the index, or of one array, from left to right, with the system in force.",
        ("INTERSECTION([3, 4])", 2.0),
    ),
    entry(
        Special::Minimum,
        Arrays,
        "MINIMUM",
        &["i = first TO last", "e"],
        "The smallest e over the index, or element of one array; undefined if one is.",
        ("MINIMUM(i = 1 TO 3, (i - 2)**2)", 0.0),
    ),
    entry(
        Special::Maximum,
        Arrays,
        "MAXIMUM",
        &["i = first TO last", "e"],
        "The largest e over the index, or element of one array; undefined ones do not count.",
        ("MAXIMUM(i = 1 TO 3, i*(3 - i))", 2.0),
    ),
    entry(
        Special::Array,
        Arrays,
        "ARRAY",
        &["i = first TO last", "e"],
        "The array of the values of e over the index.",
        ("ARRAY(i = 1 TO 3, 10*i)[2]", 20.0),
    ),
    entry(
        Special::Join,
        Arrays,
        "JOIN",
        &["a", "b", "..."],
        "One array with the elements of a, then those of b, and so on.",
        ("JOIN([1, 2], [3])[3]", 3.0),
    ),
    entry(Special::Len, Arrays, "LEN", &["a"], "The number of elements of an array.", ("LEN([5, 6, 7])", 3.0)),
    entry(
        Special::Dot,
        Arrays,
        "DOT",
        &["a", "b"],
        "The scalar product of two vectors of one length.",
        ("DOT([1, 2, 3], [4, 5, 6])", 32.0),
    ),
    entry(
        Special::Cross,
        Arrays,
        "CROSS",
        &["a", "b"],
        "The vector product of two vectors of length 3.",
        ("CROSS([1, 0, 0], [0, 1, 0])[3]", 1.0),
    ),
    entry(Special::Norm, Arrays, "NORM", &["a"], "The Euclidean length of a vector.", ("NORM([2, 3, 6])", 7.0)),
    entry(
        Special::PNorm,
        Arrays,
        "PNORM",
        &["a", "b", "...", "p"],
        "The p-norm (|a|**p + |b|**p + ...)**(1/p) of its other arguments, or of the elements of one array: PNORM(h, p). For p < 0 below \
         all of them, for p = INFINITY and -INFINITY their largest and smallest magnitude; undefined for p = 0. Never overflows.",
        ("PNORM(3, 4, 2)", 5.0),
    ),
    entry(
        Special::Random,
        Arrays,
        "RANDOM",
        &["seed", "i"],
        "The number i of the random sequence `seed`, from 0 to below 1: the same one every time.",
        ("RANDOM(1, 5) == RANDOM(1, 5)", 1.0),
    ),
    entry(
        Special::Diff,
        Functions,
        "DIFF",
        &["e", "v"],
        "The exact derivative of e by a coordinate or a parameter. IF, MIN, MAX, ABS: that of the taken branch.",
        ("DIFF(x1**3, x1) AT (x1 = 2)", 12.0),
    ),
    entry(
        Special::Grad,
        Functions,
        "GRAD",
        &["e"],
        "The gradient: the array of the derivatives of e by x1, x2, ... up to the highest coordinate that it uses.",
        ("(GRAD(x1*x2) AT (x1 = 2, x2 = 7))[1]", 7.0),
    ),
    entry(
        Special::Project,
        Functions,
        "PROJECT",
        &["e", "x4", "lo", "hi"],
        "The highest e over a coordinate from lo to hi: the union of the sections, the projection along that coordinate. The bounds may \
         depend on the other coordinates; where lo > hi it is undefined.",
        ("PROJECT(1 - x1**2 - (x4 - 2)**2, x4, 0, 5) AT (x1 = 0.5)", 0.75),
    ),
    entry(
        Special::OffsetBall,
        Functions,
        "OFFSET_BALL",
        &["e", "d"],
        "The highest e in the closed ball of radius d about the point, in the coordinates that e uses: the object grown by d. For d < 0 \
         the lowest in the ball of radius -d: the object shrunk.",
        ("OFFSET_BALL(2 - x1, 0.5) AT (x1 = 1)", 1.5),
    ),
    entry(
        Special::Star,
        Functions,
        "STAR",
        &["P", "p_local", "p_global"],
        "The star solid of a control shape about the origin: the union, blended by p_global, of the convex polyhedra in the array P. Each is \
         an array of half-spaces: [a, b, c] is a*x1 + b*x2 + c*x3 <= 1; their edges are blended by p_local, one number or one for each \
         polyhedron. INFINITY keeps edges sharp.",
        ("STAR([[[1, 0], [-1, 0], [0, 1], [0, -1]]], 2, INFINITY) AT (3, 4)", -4.0),
    ),
    entry(
        Special::Interpolate,
        Data,
        "INTERPOLATE",
        &["kind", "file", "e1", "..."],
        "A volume's value at the world coordinates e1, e2, e3: \"nearest\", \"trilinear\" or \"tricubic\", of a 1-D to 3-D grid in a file.",
        ("INTERPOLATE(\"trilinear\", \"ramp.nrrd\", 0.25)", 0.25),
    ),
    entry(
        Special::Polygon,
        Data,
        "POLYGON",
        &["px", "py"],
        "The simple polygon with the vertices (px[i], py[i]) in the plane of x1 and x2: positive inside, each edge's half-plane once, joined \
         by | and & of the system in force.",
        ("POLYGON([0, 4, 4, 0], [0, 0, 4, 4]) AT (x1 = -1, x2 = 2) < 0", 1.0),
    ),
    entry(
        Special::Contours,
        Data,
        "CONTOURS",
        &["contours"],
        "The region inside an odd number of contours, each [px, py] as for POLYGON: outlines with holes, and islands in them. Contours may \
         lie within each other but not meet.",
        ("CONTOURS([[[0, 4, 4, 0], [0, 0, 4, 4]], [[1, 3, 3, 1], [1, 1, 3, 3]]]) AT (x1 = 2, x2 = 2) < 0", 1.0),
    ),
    entry(
        Special::Medial,
        Data,
        "MEDIAL",
        &["P", "R", "edges"],
        "The body about a medial axis: the points are the rows of P, each with a radius from R, joined along edges, rows of two numbers of \
         points; the radius runs linearly along an edge. Its value is R^2 less the squared distance, the highest over the edges.",
        ("MEDIAL([[0, 0, 0], [4, 0, 0]], [1, 1], [[1, 2]]) AT (x1 = 2, x2 = 0.5, x3 = 0)", 0.75),
    ),
    entry(
        Special::Mesh,
        Data,
        "MESH",
        &["file", "..."],
        "The solid within the closed mesh of an .obj or .stl file: the distance to the nearest triangle, positive where the mesh goes round \
         the point, at x1, x2, x3 or at three expressions behind the file.",
        ("MESH(\"corner.obj\") AT (x1 = 1, x2 = 0.5, x3 = 1)", 0.5),
    ),
    entry(
        Special::Scatter,
        Data,
        "SCATTER",
        &["points", "values", "smoothness", "nx", "ny", "e1", "e2"],
        "The smooth function near the values at scattered points, rows [x, y], at e1, e2: nx by ny elements of quadratic splines over the points' \
         box, which make the mean squared distance from the values plus smoothness times the bending energy least (in lengths of the box's \
         longer side). Beyond the box it stays as at its border.",
        ("ROUND(1000*SCATTER([[0, 0], [2, 0], [0, 2], [2, 2]], [0, 2, 4, 6], 0, 4, 4, 0.5, 1))", 2500.0),
    ),
    entry(
        Special::Height,
        Data,
        "HEIGHT",
        &["file", "e1", "e2"],
        "The brightness, 0 to 1, of a PNG picture over the unit square at e1 (from left to right) and e2 (from the bottom up), smoothed by \
         cubic splines. Beyond the square it stays as at its border.",
        ("HEIGHT(\"dark.png\", 0, 0.5) < HEIGHT(\"dark.png\", 1, 0.5)", 1.0),
    ),
    entry(
        Special::Fit,
        Data,
        "FIT",
        &["residual", "start", "points"],
        "The array of parameters for which the squares of residual(parameters, point), summed over the rows of points, are least, sought from \
         `start` by Levenberg and Marquardt with exact derivatives. The residual is a function of two arrays; its value may be an array.",
        ("ROUND(1000*FIT(fn_line_residual, [0, 1], [[0, 1], [1, 3], [2, 5]])[2])", 2000.0),
    ),
];
