//! Curves through points, and surfaces swept along or turned about them.

use std::f32::consts::TAU;

use glam::Vec3;

use super::mesh::Mesh;

/// The point at `t` of the smooth curve through `points` (Catmull & Rom 1974), which should be spaced about evenly.
/// `t` runs from 0 to `points.len() - 1`.
pub fn catmull_rom(points: &[Vec3], t: f32) -> Vec3 {
    let last = points.len() - 1;
    let i = (t.floor() as usize).min(last - 1);
    let u = t - i as f32;
    let [a, b, c, d] = [i.saturating_sub(1), i, i + 1, (i + 2).min(last)].map(|k| points[k]);
    let cubic = (b - c) * 3.0 + d - a;
    let square = a * 2.0 - b * 5.0 + c * 4.0 - d;
    b + ((c - a) + (square + cubic * u) * u) * (u / 2.0)
}

/// Points along a chain of cubic Bézier curves (`3k + 1` control points), `steps` for each curve and the last one.
pub fn bezier_chain(controls: &[[f32; 2]], steps: usize) -> Vec<[f32; 2]> {
    let mut points = Vec::new();
    for c in controls.windows(4).step_by(3) {
        for i in 0..steps {
            let t = i as f32 / steps as f32;
            let s = 1.0 - t;
            let weights = [s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t];
            points.push([0, 1].map(|axis| (0..4).map(|k| weights[k] * c[k][axis]).sum()));
        }
    }
    points.extend(controls.last());
    points
}

/// Turns a profile of (radius, height) about the y axis, `around` steps to the turn. `stretch(angle, i)` widens the
/// radius of the profile's point `i`: 1 for a plain body of revolution. A profile that starts and ends on the axis gives a closed solid.
///
/// The profile runs from the bottom axis point outwards and up, so that the faces look outwards.
pub fn revolve(profile: &[[f32; 2]], around: usize, stretch: impl Fn(f32, usize) -> f32) -> Mesh {
    let mut mesh = Mesh::default();
    let rows: Vec<Vec<u32>> = profile
        .iter()
        .enumerate()
        .map(|(i, &[radius, height])| {
            // On the axis the whole row is one vertex.
            if radius == 0.0 {
                return vec![mesh.vertex(Vec3::Y * height); around];
            }
            let angle = |j: usize| j as f32 / around as f32 * TAU;
            let point = |a: f32| {
                let r = radius * stretch(a, i);
                Vec3::new(r * a.sin(), height, r * a.cos())
            };
            (0..around).map(|j| mesh.vertex(point(angle(j)))).collect()
        })
        .collect();
    mesh.skin(&rows, true);
    mesh
}

/// A tube along a path of points with a radius at each, with `around` sides, closed by blunt points.
///
/// The cross sections are carried along without twist, by turning each frame with the tangent (parallel transport).
pub fn tube(path: &[(Vec3, f32)], around: usize) -> Mesh {
    let mut mesh = Mesh::default();
    let n = path.len();
    let tangent = |i: usize| (path[(i + 1).min(n - 1)].0 - path[i.saturating_sub(1)].0).normalize();
    let mut side = tangent(0).any_orthonormal_vector();

    let start = mesh.vertex(path[0].0 - tangent(0) * path[0].1);
    let mut rows = vec![vec![start; around]];
    for (i, &(center, radius)) in path.iter().enumerate() {
        let along = tangent(i);
        side = (side - along * side.dot(along)).normalize();
        let up = along.cross(side);
        let corner = |j: usize| {
            let (sin, cos) = (j as f32 / around as f32 * TAU).sin_cos();
            center + (side * cos + up * sin) * radius
        };
        rows.push((0..around).map(|j| mesh.vertex(corner(j))).collect());
    }
    let end = mesh.vertex(path[n - 1].0 + tangent(n - 1) * path[n - 1].1);
    rows.push(vec![end; around]);
    mesh.skin(&rows, true);
    mesh
}
