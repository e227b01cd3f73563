//! Flat polygons to triangles, concave ones and ones with holes too.

use crate::math::{DVec2, Vec3};
use earcut::Earcut;

/// Triangles (indices into `outline` followed by the `holes`) that cover a flat region.
///
/// The outline and the holes are closed by their first point, in any direction. The triangles are counter-clockwise.
/// A self-intersecting outline gives some triangles, not an error.
pub fn triangulate_region(outline: &[DVec2], holes: &[Vec<DVec2>]) -> Vec<[u32; 3]> {
    let mut starts = Vec::with_capacity(holes.len());
    let mut points: Vec<[f64; 2]> = outline.iter().map(|p| p.to_array()).collect();
    for hole in holes {
        starts.push(points.len() as u32);
        points.extend(hole.iter().map(|p| p.to_array()));
    }
    let mut indices: Vec<u32> = Vec::new();
    Earcut::new().earcut(points.iter().copied(), &starts, &mut indices);
    indices.chunks_exact(3).map(|c| counter_clockwise([c[0], c[1], c[2]], &points)).collect()
}

fn counter_clockwise(t: [u32; 3], points: &[[f64; 2]]) -> [u32; 3] {
    let [a, b, c] = t.map(|i| DVec2::from_array(points[i as usize]));
    if (b - a).perp_dot(c - a) < 0.0 { [t[0], t[2], t[1]] } else { t }
}

/// Triangles (indices into `corners`) of one face in space, in the face's own direction.
///
/// Triangles and convex faces are fanned; the rest is projected along its Newell normal and ear-clipped. A twisted face,
/// which has no such projection without crossings, is fanned from the corner that folds it least: the sides of a face are
/// always those of its triangles, so that closed meshes stay closed.
pub fn triangulate_face(corners: &[Vec3]) -> Vec<[u32; 3]> {
    match corners.len() {
        0..3 => Vec::new(),
        3 => vec![[0, 1, 2]],
        _ => {
            let flat = flatten(corners);
            if is_convex(&flat) {
                return fan(0, corners.len());
            }
            let ears = triangulate_region(&flat, &[]);
            if has_sides_of_face(&ears, corners.len()) { ears } else { best_fan(&flat) }
        }
    }
}

/// The triangles of `n` corners that all have the corner `first`.
fn fan(first: usize, n: usize) -> Vec<[u32; 3]> {
    let corner = |i: usize| ((first + i) % n) as u32;
    (1..n - 1).map(|i| [corner(0), corner(i), corner(i + 1)]).collect()
}

/// The fan whose smallest triangle, turned ones counting as less than nothing, is the largest.
fn best_fan(flat: &[DVec2]) -> Vec<[u32; 3]> {
    let smallest = |first: &usize| {
        let area = |t: &[u32; 3]| {
            let [a, b, c] = t.map(|i| flat[i as usize]);
            (b - a).perp_dot(c - a)
        };
        fan(*first, flat.len()).iter().map(area).fold(f64::INFINITY, f64::min)
    };
    let first = (0..flat.len()).max_by(|a, b| smallest(a).total_cmp(&smallest(b))).unwrap_or(0);
    fan(first, flat.len())
}

/// Whether the sides that only one triangle has are those of the face, in its direction.
fn has_sides_of_face(triangles: &[[u32; 3]], n: usize) -> bool {
    let mut sides: Vec<(u32, u32)> =
        triangles.iter().flat_map(|&[a, b, c]| [(a, b), (b, c), (c, a)]).collect();
    sides.sort_unstable();
    let is_side = |&(a, b): &(u32, u32)| (a + 1) % n as u32 == b;
    let is_inner = |&(a, b): &(u32, u32)| sides.binary_search(&(b, a)).is_ok();
    triangles.len() == n - 2 && sides.iter().all(|side| is_side(side) != is_inner(side))
}

/// The corners in a plane across their Newell normal (Newell's method: Tampieri 1992), counter-clockwise.
fn flatten(corners: &[Vec3]) -> Vec<DVec2> {
    let next = corners.iter().cycle().skip(1);
    let normal = corners
        .iter()
        .zip(next)
        .fold(Vec3::ZERO, |sum, (a, b)| sum + (*a - corners[0]).cross(*b - corners[0]));
    let normal = normal.as_dvec3().normalize_or_zero();
    let (x, y) = normal.any_orthonormal_pair();
    corners
        .iter()
        .map(|&p| p.as_dvec3() - corners[0].as_dvec3())
        .map(|p| DVec2::new(p.dot(x), p.dot(y)))
        .collect()
}

fn is_convex(flat: &[DVec2]) -> bool {
    let n = flat.len();
    (0..n).all(|i| {
        let (a, b, c) = (flat[i], flat[(i + 1) % n], flat[(i + 2) % n]);
        (b - a).perp_dot(c - b) >= 0.0
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn area(triangles: &[[u32; 3]], points: &[DVec2]) -> f64 {
        let signed = |t: &[u32; 3]| {
            let [a, b, c] = t.map(|i| points[i as usize]);
            (b - a).perp_dot(c - a) / 2.0
        };
        triangles.iter().map(signed).sum()
    }

    #[test]
    fn a_square_with_a_hole_keeps_its_area() {
        let square = |r: f64| [(-r, -r), (r, -r), (r, r), (-r, r)].map(DVec2::from).to_vec();
        let triangles = triangulate_region(&square(2.0), &[square(1.0)]);
        let points = [square(2.0), square(1.0)].concat();
        assert!((area(&triangles, &points) - 12.0).abs() < 1e-12);
    }

    #[test]
    fn a_concave_face_is_not_fanned() {
        // An arrow head whose notch lies inside the fan from corner 0.
        let corners = [(0.0, 0.0), (2.0, -1.0), (1.0, 0.0), (2.0, 1.0)].map(|(x, y)| Vec3::new(x, y, 5.0));
        let triangles = triangulate_face(&corners);
        let points: Vec<DVec2> = corners.iter().map(|p| p.truncate().as_dvec2()).collect();
        assert!(triangles.iter().all(|t| area(&[*t], &points) > 0.0), "{triangles:?}");
        assert!((area(&triangles, &points) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn a_twisted_face_keeps_its_sides() {
        // Its projection along the Newell normal crosses itself.
        let corners = [(0.0, 0.0, 0.0), (1.0, 1.0, 0.3), (1.0, 0.0, 1.0), (0.0, 1.0, 0.6)];
        let corners = corners.map(|(x, y, z)| Vec3::new(x, y, z));
        let triangles = triangulate_face(&corners);
        assert!(has_sides_of_face(&triangles, 4), "{triangles:?}");
        assert!(has_sides_of_face(&fan(2, 5), 5) && !has_sides_of_face(&fan(2, 5)[1..], 5));
    }
}
