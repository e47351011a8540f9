//! Cuts a face of any number of corners into triangles. Never drops or adds an edge of its outline, so that a closed surface stays closed.

/// The largest face whose corners are looked at one by one; larger ones are cut from their first corner.
const CORNERS: usize = 2_000;

/// Adds the triangles of a face to `out`: as many as it has corners, less two.
pub(super) fn cut(positions: &[[f64; 3]], corners: &[u32], out: &mut Vec<[u32; 3]>) {
    let fan = |out: &mut Vec<[u32; 3]>, left: &[u32]| {
        out.extend((1..left.len().saturating_sub(1)).map(|k| [left[0], left[k], left[k + 1]]));
    };
    if corners.len() == 3 || corners.len() > CORNERS {
        return fan(out, corners);
    }
    let flat = flattened(positions, corners);
    let mut left: Vec<usize> = (0..corners.len()).collect();
    while left.len() > 3 {
        let n = left.len();
        let ear = (0..n).find(|&k| is_ear(&flat, &left, k));
        // An outline that crosses itself has no ears; what is left of it is cut from one corner.
        let Some(k) = ear else { break };
        out.push([left[(k + n - 1) % n], left[k], left[(k + 1) % n]].map(|i| corners[i]));
        left.remove(k);
    }
    let left: Vec<u32> = left.iter().map(|&i| corners[i]).collect();
    fan(out, &left);
}

/// The corners seen along the axis that the face is turned to most, counter-clockwise.
fn flattened(positions: &[[f64; 3]], corners: &[u32]) -> Vec<[f64; 2]> {
    let at = |i: usize| positions[corners[i % corners.len()] as usize];
    let size = positions_size(positions, corners);
    // The area vector by Newell: its largest part names the axis. Lengths are in units of the face, so that nothing overflows.
    let mut area = [0.0; 3];
    for i in 0..corners.len() {
        let (a, b) = (at(i).map(|c| c / size), at(i + 1).map(|c| c / size));
        for (k, sum) in area.iter_mut().enumerate() {
            let (u, v) = ((k + 1) % 3, (k + 2) % 3);
            *sum += (a[u] - b[u]) * (a[v] + b[v]);
        }
    }
    let axis = (0..3).fold(0, |best, k| if area[k].abs() > area[best].abs() { k } else { best });
    let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
    let (u, v) = if area[axis] > 0.0 { (u, v) } else { (v, u) };
    (0..corners.len()).map(|i| [at(i)[u], at(i)[v]]).collect()
}

fn positions_size(positions: &[[f64; 3]], corners: &[u32]) -> f64 {
    let largest = corners.iter().flat_map(|&i| positions[i as usize]).fold(0.0, |m: f64, c| m.max(c.abs()));
    if largest > 0.0 { largest } else { 1.0 }
}

fn turn(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    let [a, b, c] = [a, b, c].map(|[x, y]| robust::Coord { x, y });
    robust::orient2d(a, b, c)
}

/// Whether a corner's triangle turns left and holds no other corner.
fn is_ear(flat: &[[f64; 2]], left: &[usize], k: usize) -> bool {
    let n = left.len();
    let [a, b, c] = [left[(k + n - 1) % n], left[k], left[(k + 1) % n]].map(|i| flat[i]);
    let inside = |p: [f64; 2]| turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0;
    let own = |p: [f64; 2]| p == a || p == b || p == c;
    turn(a, b, c) > 0.0 && !left.iter().any(|&i| !own(flat[i]) && inside(flat[i]))
}
