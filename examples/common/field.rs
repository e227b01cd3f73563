//! Surfaces of fields: solids as functions that are negative inside, and the mesh of their zero level.

use glam::{Vec2, Vec3};

use super::mesh::Mesh;

/// The union of two solids whose seam is filled with a fillet about `k` wide (the polynomial of Quílez 2013).
pub fn smooth_union(a: f32, b: f32, k: f32) -> f32 {
    let h = (k - (a - b).abs()).max(0.0) / k;
    a.min(b) - h * h * k / 4.0
}

/// What is in `a` and not in `b`, its edge rounded over about `k`.
pub fn smooth_cut(a: f32, b: f32, k: f32) -> f32 {
    -smooth_union(-a, b, k)
}

/// Distance from a ball.
pub fn ball(p: Vec3, center: Vec3, radius: f32) -> f32 {
    p.distance(center) - radius
}

/// Distance, near enough for blending, from an ellipsoid with the given half axes along x, y and z.
pub fn ellipsoid(p: Vec3, center: Vec3, half: Vec3) -> f32 {
    let q = p - center;
    let k = (q / half).length();
    let slope = (q / (half * half)).length();
    if slope == 0.0 { -half.min_element() } else { k * (k - 1.0) / slope }
}

/// Distance from the hull of two balls: a capsule that tapers from radius `ra` at `a` to `rb` at `b`. The radius
/// follows the nearest point of the axis, which is exact enough while the taper is gentle.
pub fn taper(p: Vec3, (a, ra): (Vec3, f32), (b, rb): (Vec3, f32)) -> f32 {
    let axis = b - a;
    let t = ((p - a).dot(axis) / axis.length_squared()).clamp(0.0, 1.0);
    p.distance(a + axis * t) - (ra + (rb - ra) * t)
}

/// Distance from a chain of tapering capsules.
pub fn chain(p: Vec3, joints: &[(Vec3, f32)]) -> f32 {
    joints.windows(2).map(|w| taper(p, w[0], w[1])).fold(f32::INFINITY, f32::min)
}

/// Signed distance from a polygon in the plane, negative inside (even-odd).
pub fn polygon(p: Vec2, corners: &[Vec2]) -> f32 {
    let mut nearest = f32::INFINITY;
    let mut inside = false;
    for (&a, &b) in corners.iter().zip(corners.iter().cycle().skip(1)) {
        nearest = nearest.min(segment(p, a, b));
        if (a.y <= p.y) != (b.y <= p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x) {
            inside = !inside;
        }
    }
    if inside { -nearest } else { nearest }
}

/// Distance from a segment in the plane.
pub fn segment(p: Vec2, a: Vec2, b: Vec2) -> f32 {
    let axis = b - a;
    let t = ((p - a).dot(axis) / axis.length_squared()).clamp(0.0, 1.0);
    p.distance(a + axis * t)
}

/// A grid of cubic cells over a box.
struct Grid {
    origin: Vec3,
    cell: f32,
    count: [usize; 3],
}

impl Grid {
    fn over(low: Vec3, high: Vec3, cell: f32) -> Self {
        let steps = ((high - low) / cell).ceil();
        Self { origin: low, cell, count: [steps.x as usize + 1, steps.y as usize + 1, steps.z as usize + 1] }
    }

    fn point(&self, [x, y, z]: [usize; 3]) -> Vec3 {
        self.origin + Vec3::new(x as f32, y as f32, z as f32) * self.cell
    }

    fn index(&self, [x, y, z]: [usize; 3]) -> usize {
        (z * self.count[1] + y) * self.count[0] + x
    }

    /// Every grid point at which the cell towards +x, +y and +z lies within the box too.
    fn cells(&self) -> impl Iterator<Item = [usize; 3]> {
        let [nx, ny, nz] = self.count.map(|n| n - 1);
        (0..nz).flat_map(move |z| (0..ny).flat_map(move |y| (0..nx).map(move |x| [x, y, z])))
    }
}

/// The surface on which `field` is zero, within the box from `low` to `high`, in cells of edge `cell`: one vertex for
/// each cell that the surface crosses, one quad for each grid edge that it cuts (surface nets, Gibson 1998). Each
/// vertex then slides down the gradient onto the surface, which takes the steps of the grid out of the shading.
pub fn surface(low: Vec3, high: Vec3, cell: f32, field: impl Fn(Vec3) -> f32) -> Mesh {
    let grid = Grid::over(low, high, cell);
    let [nx, ny, nz] = grid.count;
    let all = (0..nz).flat_map(|z| (0..ny).flat_map(move |y| (0..nx).map(move |x| [x, y, z])));
    let values: Vec<f32> = all.map(|at| field(grid.point(at))).collect();

    // A vertex in every cell with corners on both sides.
    let mut mesh = Mesh::default();
    let mut vertex = vec![u32::MAX; values.len()];
    for at in grid.cells() {
        if let Some(p) = crossing(&grid, &values, at) {
            vertex[grid.index(at)] = mesh.vertex(settle(p, cell, &field));
        }
    }

    // A quad around every edge whose ends differ, through the four cells that share the edge.
    for at in grid.cells() {
        for axis in 0..3 {
            let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
            let inside = values[grid.index(at)] < 0.0;
            if at[u] == 0 || at[v] == 0 || inside == (values[grid.index(step(at, axis))] < 0.0) {
                continue;
            }
            let back = |mut at: [usize; 3], axis: usize| {
                at[axis] -= 1;
                at
            };
            let cells = [back(back(at, u), v), back(at, v), at, back(at, u)];
            let mut quad = cells.map(|c| vertex[grid.index(c)]);
            if !inside {
                quad.reverse();
            }
            mesh.face(&quad);
        }
    }
    mesh
}

/// The grid point one step further along an axis.
fn step(mut at: [usize; 3], axis: usize) -> [usize; 3] {
    at[axis] += 1;
    at
}

/// The mean of the points where the surface cuts the twelve edges of a cell, or nothing where it cuts none.
fn crossing(grid: &Grid, values: &[f32], cell: [usize; 3]) -> Option<Vec3> {
    let mut sum = Vec3::ZERO;
    let mut count = 0.0;
    for axis in 0..3 {
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        for start in [cell, step(cell, u), step(cell, v), step(step(cell, u), v)] {
            let (a, b) = (values[grid.index(start)], values[grid.index(step(start, axis))]);
            if (a < 0.0) != (b < 0.0) {
                sum += grid.point(start).lerp(grid.point(step(start, axis)), a / (a - b));
                count += 1.0;
            }
        }
    }
    (0.0 < count).then(|| sum / count)
}

/// Moves a point towards the zero level by a few Newton steps along the gradient, at most a third of a cell in all, so that
/// neighbours keep their order.
fn settle(start: Vec3, cell: f32, field: &impl Fn(Vec3) -> f32) -> Vec3 {
    let h = cell * 0.05;
    let mut p = start;
    for _ in 0..3 {
        let slope = |axis: Vec3| (field(p + axis * h) - field(p - axis * h)) / (2.0 * h);
        let gradient = Vec3::new(slope(Vec3::X), slope(Vec3::Y), slope(Vec3::Z));
        p -= gradient * (field(p) / gradient.length_squared().max(0.1));
        p = start + (p - start).clamp_length_max(cell * 0.33);
    }
    p
}
