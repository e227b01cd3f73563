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
/// Triangles and convex quadrangles are fanned; the rest is projected along its Newell normal and ear-clipped.
pub fn triangulate_face(corners: &[Vec3]) -> Vec<[u32; 3]> {
    match corners.len() {
        0..3 => Vec::new(),
        3 => vec![[0, 1, 2]],
        _ => {
            let flat = flatten(corners);
            if is_convex(&flat) {
                return (1..corners.len() as u32 - 1).map(|i| [0, i, i + 1]).collect();
            }
            triangulate_region(&flat, &[])
        }
    }
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
}
