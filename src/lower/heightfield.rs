//! Heights over a grid, as triangles.

use super::tessellate::Triangles;
use crate::math::{DVec3, Vec2};

/// Heights over the plane y = 0, row by row; the first row lies at z = 0, the last at the far side.
pub struct Heights<'a> {
    /// Points in a row; at least 2.
    pub width: usize,
    /// Row by row, in shares of `size.y`; at least 2 rows.
    pub values: &'a [f32],
    /// What it spans: x along a row, y for a height of 1, z from the first row to the last.
    pub size: DVec3,
}

/// A surface over the grid, seen from above. Each cell is parted along the diagonal whose ends differ less in height.
///
/// u runs along x and v towards −z, so that a picture that gave the heights fits on it.
pub fn surface(heights: &Heights<'_>, smooth: bool) -> Triangles {
    let (width, rows) = (heights.width, heights.values.len() / heights.width);
    let at = |i: usize, j: usize| f64::from(heights.values[j * width + i]);
    let share = |i: usize, count: usize| i as f64 / (count - 1) as f64;
    let point = |i, j| DVec3::new(share(i, width), at(i, j), share(j, rows)) * heights.size;
    let grid = || (0..rows).flat_map(|j| (0..width).map(move |i| (i, j)));
    let normal = |(i, j): (usize, usize)| {
        let along = point((i + 1).min(width - 1), j) - point(i.saturating_sub(1), j);
        let across = point(i, (j + 1).min(rows - 1)) - point(i, j.saturating_sub(1));
        across.cross(along).normalize_or(DVec3::Y)
    };
    let mut indices = Vec::with_capacity(2 * (width - 1) * (rows - 1));
    for (i, j) in (0..rows - 1).flat_map(|j| (0..width - 1).map(move |i| (i, j))) {
        let index = |i: usize, j: usize| (j * width + i) as u32;
        let [a, b, c, d] = [index(i, j), index(i, j + 1), index(i + 1, j + 1), index(i + 1, j)];
        let by_ac = (at(i, j) - at(i + 1, j + 1)).abs() <= (at(i, j + 1) - at(i + 1, j)).abs();
        indices.extend(if by_ac { [[a, b, c], [a, c, d]] } else { [[a, b, d], [b, c, d]] });
    }
    Triangles {
        positions: grid().map(|(i, j)| point(i, j)).collect(),
        indices,
        normals: smooth.then(|| grid().map(normal).collect()),
        uvs: Some(
            grid().map(|(i, j)| Vec2::new(share(i, width) as f32, 1.0 - share(j, rows) as f32)).collect(),
        ),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slope_is_flat_and_faces_up() {
        let values: Vec<f32> = (0..4 * 5).map(|i| (i % 5) as f32 / 4.0).collect();
        let slope = surface(&Heights { width: 5, values: &values, size: DVec3::new(4.0, 2.0, 3.0) }, true);
        assert_eq!((slope.positions.len(), slope.indices.len()), (20, 24));
        assert_eq!(slope.positions[19], DVec3::new(4.0, 2.0, 3.0));
        let expected = DVec3::new(-0.5, 1.0, 0.0).normalize();
        assert!(slope.normals.as_ref().expect("smooth").iter().all(|n| n.distance(expected) < 1e-12));
        for &[a, b, c] in &slope.indices {
            let [a, b, c] = [a, b, c].map(|i| slope.positions[i as usize]);
            assert!((b - a).cross(c - a).normalize().distance(expected) < 1e-12);
        }
        let area: f64 = slope
            .indices
            .iter()
            .map(|t| t.map(|i| slope.positions[i as usize]))
            .map(|[a, b, c]| (b - a).cross(c - a).length() / 2.0)
            .sum();
        assert!((area - 3.0 * (20.0_f64).sqrt()).abs() < 1e-12);
    }

    #[test]
    fn the_surface_goes_through_its_points_and_the_picture_lies_on_it() {
        let values = [0.0, 1.0, 0.5, 0.25];
        let field = surface(&Heights { width: 2, values: &values, size: DVec3::ONE }, false);
        let heights: Vec<f64> = field.positions.iter().map(|p| p.y).collect();
        assert_eq!(heights, values.map(f64::from));
        // The first row of the picture, which is its top, has v = 1.
        assert_eq!(field.uvs.expect("always")[0], Vec2::Y);
        assert!(field.normals.is_none());
    }
}
